# SPDX-License-Identifier: MIT
"""The shape of a human head: a field that is zero on its surface, and that surface in small triangles.

A head looks along -y, z is up, and 0 is the height of the eyes; top and chin are 1 unit from there. Only x >= 0 is
described; the other half is its mirror image. It uses only sums, products, quotients and square roots, which every
machine rounds alike.
"""
from math import sqrt

CENTRE = 0.0, 0.08, -0.12  # all of the surface is visible from here


def ellipsoid(centre, radii, turn=None):
    """Approximate distance to an ellipsoid; turn: its three axes, as rows."""
    cx, cy, cz = centre
    a, b, c = (1 / r for r in radii)

    def distance(x, y, z):
        x, y, z = x - cx, y - cy, z - cz
        if turn:
            x, y, z = (r[0] * x + r[1] * y + r[2] * z for r in turn)
        x, y, z = x * a, y * b, z * c
        k = sqrt(x * x + y * y + z * z)
        x, y, z = x * a, y * b, z * c
        return k * (k - 1) / (sqrt(x * x + y * y + z * z) + 1e-9)

    return distance


def capsule(start, end, first, last):
    """Distance to a rod from start to end, whose radius goes from first to last."""
    sx, sy, sz = start
    dx, dy, dz = (e - s for s, e in zip(start, end))
    square = 1 / (dx * dx + dy * dy + dz * dz)

    def distance(x, y, z):
        x, y, z = x - sx, y - sy, z - sz
        t = (x * dx + y * dy + z * dz) * square
        t = 0.0 if t < 0 else 1.0 if t > 1 else t
        x, y, z = x - t * dx, y - t * dy, z - t * dz
        return sqrt(x * x + y * y + z * z) - first - t * (last - first)

    return distance


def blend(a, b, width):
    """The smaller distance, with a fillet of that width."""
    h = width - (a - b if a > b else b - a)
    least = a if a < b else b
    return least - h * h / (4 * width) if h > 0 else least


def unit(*v):
    length = sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


EYE = 0.27, -0.655, -0.01
EAR_OUT = unit(0.92, -0.39, 0.0)
EAR_UP = unit(0.0, 0.22, 0.975)
EAR_TURN = EAR_OUT, unit(*cross(EAR_UP, EAR_OUT)), unit(*cross(EAR_OUT, cross(EAR_UP, EAR_OUT)))

# The parts of a head. First the region in which a part matters: the middle and the radius of a ball, or None for everywhere.
# Then the distance to the part, how it is joined ('+' added, '-' cut out), and the width of the fillet.
PARTS = [
    # skull, forehead, face, neck, jaw, chin, cheekbone, the part behind the lips
    (None, ellipsoid((0, 0.12, 0.24), (0.68, 0.84, 0.77)), "+", 0.1),
    (None, ellipsoid((0, -0.33, 0.32), (0.55, 0.49, 0.52)), "+", 0.2),
    (None, ellipsoid((0, -0.38, -0.32), (0.50, 0.40, 0.64)), "+", 0.2),
    (None, capsule((0.0, 0.24, -0.4), (0.0, 0.34, -1.6), 0.44, 0.46), "+", 0.16),
    (None, capsule((0.42, 0.0, -0.47), (0.15, -0.63, -0.84), 0.14, 0.14), "+", 0.2),
    (((0, -0.7, -0.87), 0.5), ellipsoid((0, -0.70, -0.87), (0.18, 0.17, 0.13)), "+", 0.14),
    (((0.36, -0.5, -0.2), 0.5), ellipsoid((0.36, -0.48, -0.20), (0.20, 0.23, 0.15)), "+", 0.2),
    (((0.3, -0.42, -0.48), 0.6), ellipsoid((0.31, -0.44, -0.46), (0.18, 0.27, 0.30)), "+", 0.2),
    (((0, -0.64, -0.57), 0.55), ellipsoid((0, -0.62, -0.60), (0.29, 0.22, 0.24)), "+", 0.14),
    # brow, eye socket
    (((0.25, -0.75, 0.15), 0.5), capsule((0.07, -0.80, 0.13), (0.40, -0.66, 0.18), 0.07, 0.06), "+", 0.12),
    (((0.28, -0.84, 0.0), 0.45), ellipsoid((0.27, -0.88, -0.02), (0.20, 0.17, 0.13)), "-", 0.10),
    # nose: bridge, tip, side
    (((0, -0.92, -0.12), 0.5), capsule((0, -0.81, 0.10), (0, -0.95, -0.29), 0.065, 0.105), "+", 0.12),
    (((0, -1.0, -0.32), 0.35), ellipsoid((0, -0.99, -0.32), (0.11, 0.115, 0.09)), "+", 0.06),
    (((0.11, -0.9, -0.36), 0.3), ellipsoid((0.115, -0.88, -0.345), (0.085, 0.12, 0.075)), "+", 0.06),
    # eyelids, the slit between them, the eyeball
    (((0.27, -0.7, 0), 0.35), ellipsoid(EYE, (0.178, 0.17, 0.155)), "+", 0.03),
    (((0.27, -0.7, 0), 0.35), ellipsoid((0.275, -0.83, -0.015), (0.145, 0.17, 0.075)), "-", 0.015),
    (((0.27, -0.7, 0), 0.35), ellipsoid(EYE, (0.14, 0.14, 0.14)), "+", 0.01),
    # lips
    (((0.1, -0.86, -0.58), 0.4), capsule((0, -0.86, -0.575), (0.12, -0.83, -0.575), 0.046, 0.044), "+", 0.05),
    (((0.1, -0.86, -0.58), 0.4), capsule((0.12, -0.83, -0.575), (0.25, -0.73, -0.615), 0.044, 0.018), "+", 0.05),
    (((0.1, -0.86, -0.65), 0.4), capsule((0, -0.845, -0.672), (0.11, -0.815, -0.665), 0.055, 0.048), "+", 0.02),
    (((0.1, -0.86, -0.65), 0.4), capsule((0.11, -0.815, -0.665), (0.24, -0.73, -0.625), 0.048, 0.018), "+", 0.02),
    (((0.1, -0.86, -0.62), 0.3), capsule((0, -0.925, -0.622), (0.2, -0.815, -0.62), 0.022, 0.016), "-", 0.03),
    # ear
    (((0.68, 0.1, -0.14), 0.6), ellipsoid((0.64, 0.11, -0.12), (0.09, 0.18, 0.29), EAR_TURN), "+", 0.08),
    (((0.68, 0.1, -0.14), 0.5), ellipsoid((0.76, 0.06, -0.10), (0.10, 0.10, 0.18), EAR_TURN), "-", 0.04),
]
BOTTOM = -1.32


def field(x, y, z):
    """The field: below 0 inside."""
    value = 9.0
    for near, part, how, width in PARTS:
        if near:
            (cx, cy, cz), radius = near
            cx, cy, cz = x - cx, y - cy, z - cz
            if cx * cx + cy * cy + cz * cz > radius * radius:
                continue
        d = part(x, y, z)
        value = blend(value, d, width) if how == "+" else -blend(-value, d, width)
    return -blend(-value, z - BOTTOM, 0.1)


def on_surface(x, y, z):
    """The outermost place of the surface on the ray from CENTRE through a point."""
    cx, cy, cz = CENTRE
    x, y, z = unit(x - cx, y - cy, z - cz)

    def at(t):
        return field(cx + t * x, cy + t * y, cz + t * z)

    outside, inside = 1.6, 1.52
    while at(inside) > 0:
        outside, inside = inside, inside - 0.08
    for _ in range(9):
        middle = (outside + inside) / 2
        if at(middle) > 0:
            outside = middle
        else:
            inside = middle
    t = (outside + inside) / 2
    return cx + t * x, cy + t * y, cz + t * z


def settled(x, y, z, middle):
    """The place of the surface nearest to a point close to it; with middle, it stays in the plane x = 0."""
    step = 0.004
    for _ in range(2):
        d = field(x, y, z)
        gx = 0.0 if middle else (field(x + step, y, z) - d) / step
        gy = (field(x, y + step, z) - d) / step
        gz = (field(x, y, z + step) - d) / step
        d /= gx * gx + gy * gy + gz * gz + 0.1
        x, y, z = x - d * gx, y - d * gy, z - d * gz
    return (0.0 if middle else max(x, 0.003)), y, z


def detail(x, y, z):
    """The largest length of an edge of a small triangle at a point."""
    if y < -0.55 and z > -0.75 and z < 0.3 and x < 0.5:
        return 0.037
    if x > 0.5 and y > -0.2 and y < 0.4 and z > -0.5 and z < 0.25:
        return 0.055
    return 0.07 if z < -1.2 else 0.12


def surface():
    """The half with x >= 0: points and triangles, counter-clockwise from outside."""
    cx, cy, cz = CENTRE
    corners = [(0, -1, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1)]
    points = [on_surface(cx + x, cy + y, cz + z) for x, y, z in corners]
    faces = [(0, 1, 3), (1, 2, 3), (1, 0, 4), (2, 1, 4)]
    for turn in range(7):
        halves = {}
        for a, b, c in faces:
            for p, q in ((a, b), (b, c), (c, a)):
                if (q, p) in halves or (p, q) in halves:
                    continue
                middle = tuple((s + t) / 2 for s, t in zip(points[p], points[q]))
                length = sum((s - t) * (s - t) for s, t in zip(points[p], points[q]))
                limit = detail(*middle)
                if length > limit * limit:
                    halves[p, q] = middle
        index = {}
        for (p, q), middle in halves.items():
            index[p, q] = index[q, p] = len(points)
            points.append(on_surface(*middle) if turn < 4 else settled(*middle, points[p][0] + points[q][0] == 0))
        faces = [small for face in faces for small in split(face, index, points)]
    return relaxed(points, faces), faces


def relaxed(points, faces):
    """Move each point halfway to the middle of its neighbours, then back onto the surface."""
    sums = [[0.0, 0.0, 0.0, 0] for _ in points]
    for face in faces:
        for p, q in zip(face, face[1:] + face[:1]):
            for to, of in ((p, q), (q, p)):
                if points[to][0] != 0 or points[of][0] == 0:
                    entry = sums[to]
                    for k in range(3):
                        entry[k] += points[of][k]
                    entry[3] += 1
    return [
        settled(*((c + s / n) / 2 for c, s in zip(point, (x, y, z))), point[0] == 0)
        for point, (x, y, z, n) in zip(points, sums)
    ]


def split(face, index, points):
    """Split a face whose edges in `index` have a point in the middle."""
    a, b, c = face
    while (a, b) not in index and (b, c) in index or (c, a) in index and (a, b) not in index:
        a, b, c = b, c, a
    # rotate the corners so that the edge a-b has a point, if any edge has one
    ab, bc, ca = index.get((a, b)), index.get((b, c)), index.get((c, a))
    if ab is None:
        return [(a, b, c)]
    if bc is None and ca is None:
        return [(a, ab, c), (ab, b, c)]
    if bc is not None and ca is not None:
        return [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]

    def square(p, q):
        return sum((s - t) * (s - t) for s, t in zip(points[p], points[q]))

    if bc is not None:
        first = [(ab, b, bc)]
        rest = [(a, ab, c), (ab, bc, c)] if square(ab, c) < square(a, bc) else [(a, ab, bc), (a, bc, c)]
    else:
        first = [(a, ab, ca)]
        rest = [(ab, b, c), (ab, c, ca)] if square(ab, c) < square(b, ca) else [(ab, b, ca), (ca, b, c)]
    return first + rest


# The importance of places for the eye: the middle and the radius of a ball, and a weight.
MATTER = [
    ((0.28, -0.76, -0.01), 0.2, 30.0),  # eye
    ((0.10, -0.85, -0.62), 0.2, 30.0),  # lips
    ((0.05, -0.92, -0.25), 0.25, 12.0),  # nose
    ((0.1, -0.7, -0.35), 0.65, 6.0),  # face
    ((0.68, 0.1, -0.12), 0.35, 4.0),  # ear
    ((0.0, 0.3, -1.2), 0.6, 0.6),  # neck
]


def weight(x, y, z):
    for (cx, cy, cz), radius, much in MATTER:
        cx, cy, cz = x - cx, y - cy, z - cz
        if cx * cx + cy * cy + cz * cz < radius * radius:
            return much
    return 1.0

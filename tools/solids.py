# SPDX-License-Identifier: MIT
"""Ways to make a closed mesh from outlines: points, and faces that are counter-clockwise seen from outside."""


def extrude(outline, low, high, triangles=None):
    """A prism along y over an outline in x, z, counter-clockwise seen from -y: its points and faces."""
    n = len(outline)
    points = [(x, y, z) for y in (low, high) for x, z in outline]
    caps = triangles or [(0, k, k + 1) for k in range(1, n - 1)]
    faces = list(caps) + [(a + n, c + n, b + n) for a, b, c in caps]
    for k in range(n):
        i = (k + 1) % n
        faces += [(k, k + n, i + n), (k, i + n, i)]
    return points, faces


def ears(outline):
    """Triangles of an outline that is counter-clockwise and does not cross itself."""
    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    left, found = list(range(len(outline))), []
    while len(left) > 3:
        for i, b in enumerate(left):
            a, c = left[i - 1], left[(i + 1) % len(left)]
            corners = [outline[k] for k in (a, b, c)]
            if turn(*corners) > 0 and not any(
                    all(turn(corners[k], corners[(k + 1) % 3], outline[p]) >= 0 for k in range(3))
                    for p in left if outline[p] not in corners):
                found.append((a, b, c))
                left.pop(i)
                break
    return found + [tuple(left)]


def rings(outlines):
    """Outlines with the same number of corners, joined from one to the next. Quads or fans close the first
    and the last."""
    n = len(outlines[0])
    points = [p for outline in outlines for p in outline]
    faces = [(0, k + 1, k) for k in range(1, n - 1)]
    for ring in range(len(outlines) - 1):
        for k in range(n):
            a, b = ring * n + k, ring * n + (k + 1) % n
            faces += [(a, b, b + n), (a, b + n, a + n)]
    last = len(points) - n
    return points, faces + [(last, last + k, last + k + 1) for k in range(1, n - 1)]


def joined(loops):
    """Join the first loop and the holes in it into one outline by the shortest bridges, as indices into all their corners."""
    places, first = [], 0
    for loop in loops:
        places.append(list(range(first, first + len(loop))))
        first += len(loop)
    corners = [p for loop in loops for p in loop]

    def away(pair):
        (ax, ay), (bx, by) = corners[pair[0]], corners[pair[1]]
        return (ax - bx) ** 2 + (ay - by) ** 2

    whole, holes = places[0], places[1:]
    while holes:
        hole, (a, b) = min(((hole, min(((a, b) for a in whole for b in hole), key=away)) for hole in holes),
                           key=lambda one: away(one[1]))
        at, turn = whole.index(a), hole.index(b)
        whole = whole[:at + 1] + hole[turn:] + hole[:turn + 1] + whole[at:]
        holes.remove(hole)
    return whole


def pierced(loops, low, high):
    """A prism along y over an outline in x, z with clockwise holes. Its sides come first, in the order of the
    corners."""
    corners = [p for loop in loops for p in loop]
    whole = joined(loops)
    n, first, faces = len(corners), 0, []
    for loop in loops:
        for k in range(len(loop)):
            a, b = first + k, first + (k + 1) % len(loop)
            faces += [(a, a + n, b + n), (a, b + n, b)]
        first += len(loop)
    caps = [tuple(whole[k] for k in ear) for ear in ears([corners[k] for k in whole])]
    faces += caps + [(a + n, c + n, b + n) for a, b, c in caps]
    return [(x, y, z) for y in (low, high) for x, z in corners], faces

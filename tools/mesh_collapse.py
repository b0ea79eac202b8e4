# SPDX-License-Identifier: MIT
"""Reduces half of a symmetric mesh to fewer faces: the edge whose loss changes the surface least is removed first.

The error of a vertex's place is the sum of squares of its distances to the planes of the faces that were merged into it,
weighted by area and by how much the place matters (Garland and Heckbert, "Surface simplification using quadric error
metrics", 1997). The mesh is the half with x >= 0. Vertices of its rim stay in the plane x = 0, and both halves together
stay a closed surface without handles.
"""
import heapq
from math import sqrt


def normal(p, q, r):
    """The normal of a face, twice its area long."""
    ax, ay, az = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    bx, by, bz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def square(p, q):
    x, y, z = p[0] - q[0], p[1] - q[1], p[2] - q[2]
    return x * x + y * y + z * z


def shape(p, q, r):
    """1 for an equilateral triangle, 0 for a flat one."""
    x, y, z = normal(p, q, r)
    edges = square(p, q) + square(q, r) + square(r, p)
    return 3.4641016 * sqrt(x * x + y * y + z * z) / edges if edges else 0.0


def plane(n, p, weight):
    """The weighted square of the distance to a plane, as coefficients of xx xy xz yy yz zz x y z 1."""
    x, y, z = n
    d = -(x * p[0] + y * p[1] + z * p[2])
    return [weight * c for c in (x * x, x * y, x * z, y * y, y * z, z * z, x * d, y * d, z * d, d * d)]


def error(quadric, p):
    xx, xy, xz, yy, yz, zz, x, y, z, one = quadric
    a, b, c = p
    return (a * (xx * a + 2 * (xy * b + xz * c + x)) + b * (yy * b + 2 * (yz * c + y))
            + c * (zz * c + 2 * z) + one)  # fmt: skip


def best(quadric, middle):
    """The place of the smallest error, moved a little towards `middle`; in the plane x = 0 if `middle` is."""
    xx, xy, xz, yy, yz, zz, x, y, z, _ = quadric
    pull = 0.002 * (xx + yy + zz) + 1e-12
    mx, my, mz = middle
    xx, yy, zz = xx + pull, yy + pull, zz + pull
    x, y, z = x - pull * mx, y - pull * my, z - pull * mz
    if mx == 0:
        det = yy * zz - yz * yz
        return 0.0, (yz * z - zz * y) / det, (yz * y - yy * z) / det
    a, b, c = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    det = xx * a + xy * b + xz * c
    e, f, g = xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy
    place = -(a * x + b * y + c * z) / det, -(b * x + e * y + f * z) / det, -(c * x + f * y + g * z) / det
    return place if place[0] > 0 else (0.001, place[1], place[2])


class Half:
    def __init__(self, points, faces, weight):
        self.points = list(points)
        self.faces = [list(face) for face in faces]
        self.around = [set() for _ in points]  # faces of each vertex
        self.quadrics = [[0.0] * 10 for _ in points]
        self.count = len(faces)
        self.stamp = [0] * len(points)
        self.heap = []
        for i, face in enumerate(self.faces):
            self.enter(i, face, weight)
        for p, q in sorted({tuple(sorted(e)) for f in self.faces for e in zip(f, f[1:] + f[:1])}):
            self.offer(p, q)

    def enter(self, i, face, weight):
        p, q, r = (self.points[v] for v in face)
        n = normal(p, q, r)
        area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
        centre = [(a + b + c) / 3 for a, b, c in zip(p, q, r)]
        flat = plane([c / area for c in n], p, area * weight(*centre))
        for v in face:
            self.around[v].add(i)
            self.quadrics[v] = [a + b for a, b in zip(self.quadrics[v], flat)]
        for v, w in zip(face, face[1:] + face[:1]):  # the mirror image keeps the rim in its plane
            if self.points[v][0] == 0 == self.points[w][0]:
                self.keep_outline(v, w, n, weight(*centre))

    def keep_outline(self, v, w, n, weight):
        """A plane through an edge of the rim, at right angles to x = 0."""
        p, q = self.points[v], self.points[w]
        y, z = q[2] - p[2], p[1] - q[1]
        length = sqrt(y * y + z * z)
        if length:
            wall = plane((0.0, y / length, z / length), p, length * length * weight)
            for u in (v, w):
                self.quadrics[u] = [a + b for a, b in zip(self.quadrics[u], wall)]

    def neighbours(self, v):
        return {u for i in self.around[v] for u in self.faces[i]} - {v}

    def offer(self, v, w):
        """Add the cost of losing an edge to the heap."""
        p, q = self.points[v], self.points[w]
        quadric = [a + b for a, b in zip(self.quadrics[v], self.quadrics[w])]
        rim = p[0] == 0 or q[0] == 0
        middle = (0.0 if rim else (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2)
        place = best(quadric, middle)
        cost = error(quadric, place)
        # of edges that cost about nothing, the shortest is removed first, which makes even
        # triangles
        cost += 1e-5 * (quadric[0] + quadric[3] + quadric[5]) * square(p, q)
        heapq.heappush(self.heap, (cost, v, w, self.stamp[v], self.stamp[w], place))

    def allowed(self, v, w, place, worst, fold):
        """True if the surface stays simple, without folds and slivers."""
        points, faces = self.points, self.faces
        shared = self.around[v] & self.around[w]
        on_rim = points[v][0] == 0, points[w][0] == 0
        if not shared or all(on_rim) and len(shared) != 1:
            return False
        near_v, near_w = self.neighbours(v), self.neighbours(w)
        if len(near_v & near_w) != len(shared):
            return False
        if place[0] == 0:  # no new edge from rim to rim
            rim = {u for u in near_v ^ near_w if points[u][0] == 0} - {v, w}
            along = {u for u in rim if all(on_rim)}
            if rim - along and on_rim[0] != on_rim[1]:
                inner = near_w if on_rim[0] else near_v
                if rim & inner:
                    return False
        for i in (self.around[v] | self.around[w]) - shared:
            old = [points[u] for u in faces[i]]
            new = [place if u in (v, w) else points[u] for u in faces[i]]
            if all(p[0] == 0 for p in new):
                return False
            a, b = normal(*old), normal(*new)
            dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            size = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2])
            if dot <= fold * sqrt(size):
                return False
            quality = shape(*new)
            if quality < worst and quality < shape(*old):
                return False
        return True

    def collapse(self, v, w, place):
        """Merge w into v."""
        for i in self.around[v] & self.around[w]:
            for u in self.faces[i]:
                self.around[u].discard(i)
            self.faces[i] = None
            self.count -= 1
        for i in self.around[w]:
            self.faces[i][self.faces[i].index(w)] = v
        self.around[v] |= self.around[w]
        self.around[w] = set()
        self.points[v] = place
        self.quadrics[v] = [a + b for a, b in zip(self.quadrics[v], self.quadrics[w])]
        self.stamp[v] += 1
        self.stamp[w] += 1
        for u in sorted(self.neighbours(v)):
            self.offer(min(u, v), max(u, v))

    def reduce(self, count):
        """Collapse edges until only so many faces are left."""
        refused, worst, fold = [], 0.35, 0.3
        while self.count > count:
            if not self.heap:
                if worst < 0.0001:
                    raise ValueError("no edge can go")
                self.heap, refused, worst, fold = refused, [], worst * 0.8, fold * 0.8
                heapq.heapify(self.heap)
            entry = heapq.heappop(self.heap)
            _, v, w, stamp_v, stamp_w, place = entry
            if stamp_v != self.stamp[v] or stamp_w != self.stamp[w]:
                continue
            both = self.points[v][0] == 0 == self.points[w][0]
            if self.count - count == 1 and not both or not self.allowed(v, w, place, worst, fold):
                refused.append(entry)
            else:
                self.collapse(v, w, place)

    def whole(self):
        """Both halves: points and faces."""
        faces = [f for f in self.faces if f]
        used = sorted({v for f in faces for v in f})
        index = {v: i for i, v in enumerate(used)}
        points = [self.points[v] for v in used]
        faces = [tuple(index[v] for v in f) for f in faces]
        mirror = {}
        for i, p in enumerate(list(points)):
            mirror[i] = i if p[0] == 0 else len(points)
            if p[0] != 0:
                points.append((-p[0], p[1], p[2]))
        return points, faces + [(mirror[a], mirror[c], mirror[b]) for a, b, c in faces]

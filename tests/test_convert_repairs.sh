#!/bin/sh
# SPDX-License-Identifier: MIT
# The mesh converter's repairs: holes that are filled, meshes that are simplified, parts that overlap or
# nest. Volumes are those of the shapes by their formulas. Prints TAP.

# shellcheck source=tests/lib/convert.inc
. "$(dirname "$0")/lib/convert.inc"

python3 - <<'END_OF_FILES' || exit 1
from math import cos, pi, sin

def write(name, *bodies):
    points, faces = [], []
    for p, f in bodies:
        faces += [[i + len(points) for i in q] for q in f]
        points += p
    lines = ["v %.9g %.9g %.9g" % tuple(p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in q) for q in faces]
    open(name, "w").write("\n".join(lines) + "\n")

quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
def box(low, high):
    return [[c[k][i] for i, k in enumerate(s)] for s in
            [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)] for c in [(low, high)]], quads
def turned(body):
    return body[0], [q[::-1] for q in body[1]]
def walls(loop, low=0, high=1):
    n = len(loop)
    return ([(x, y, z) for z in (low, high) for x, y in loop],
            [(i, (i + 1) % n, (i + 1) % n + n, i + n) for i in range(n)])
def square(r):
    return [(-r, -r), (r, -r), (r, r), (-r, r)]

plain = box((0, 0, 0), (3, 2, 1))
write("open.obj", (plain[0], quads[:5]))
write("tube.obj", (plain[0], quads[:4]))
corner = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
write("bent.obj", walls(corner))
write("ring.obj", walls(square(2)), turned(walls(square(1))))
write("isle.obj", walls(square(3)), turned(walls(square(2))), walls(square(1)))
# two slots, one of them bent, in a plate with corners along its straight sides
plate = [(0, 0), (2, 0), (5, 0), (9, 0), (9, 4), (9, 8), (4, 8), (0, 8), (0, 3)]
write("slots.obj", walls(plate), turned(walls([(x + 1, y + 1) for x, y in corner])),
      turned(walls([(5, 5), (8, 5), (8, 6), (5, 6)])))
warped = [list(p) for p in plain[0]]
warped[7][2] = 2
write("warped.obj", (warped, quads[:1] + quads[2:]))
write("leaf.obj", ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
# a bow tie of walls: its ends intersect themselves
write("crossed.obj", walls([(0, 0), (2, 2), (2, 0), (0, 2)]))

write("shifted.obj", plain, box((1, 0, 0), (4, 2, 1)))
write("plus.obj", box((0, 1, 0), (3, 2, 1)), box((1, 0, 0), (2, 3, 1)))
write("poked.obj", plain, box((1, 0.5, 0.25), (2, 1, 5)))
l_shape = (walls(corner)[0], walls(corner)[1] + [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11)])
write("beside.obj", l_shape, box((1.25, 1.25, 0.25), (2, 2, 0.75)))
cube = lambda a, b: box((a, a, a), (b, b, b))
write("nested.obj", cube(0, 8), cube(2, 6))
write("flush.obj", cube(0, 8), box((0, 2, 2), (3, 4, 4)))
write("matryoshka.obj", cube(0, 8), turned(cube(1, 7)), cube(2, 6))
write("hollow_within.obj", cube(0, 8), cube(1, 7), turned(cube(2, 6)), cube(3, 5))

def grid(n, m, place, name):
    faces = []
    for i in range(n):
        for j in range(m):
            a, b, c, d = [(i + k) % n * m + (j + l) % m for k, l in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces += [(a, b, c), (a, c, d)]
    write(name, ([place(2 * pi * i / n, 2 * pi * j / m) for i in range(n) for j in range(m)], faces))
grid(300, 120, lambda a, b: ((1 + 0.3 * cos(b)) * cos(a), (1 + 0.3 * cos(b)) * sin(a), 0.3 * sin(b)), "torus.obj")
# a cube with 120 x 120 squares a side, which needs only 12 faces
points = {}
def at(*p):
    return points.setdefault(p, len(points))
faces = []
for k in range(3):
    for end in (0, 120):
        for u in range(120):
            for v in range(120):
                q = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    p = [0, 0, 0]
                    p[k], p[(k + 1) % 3], p[(k + 2) % 3] = end, u + du, v + dv
                    q.append(at(*p))
                faces.append(q if end else q[::-1])
write("fine.obj", ([[c / 128 for c in p] for p in points], faces))
END_OF_FILES

# ---------------------------------------------------------------------- holes

refuses open_names_close open.obj '4 open edges' --close
accepts close_one '--close open.obj' '12 faces, 18 edges, 8 vertices' 'volume    6' \
    'closed 1 hole, 2 faces added'
accepts close_two '--close tube.obj' 'volume    6' 'closed 2 holes, 4 faces added'
accepts close_concave '--close bent.obj' 'volume    3' 'closed 2 holes, 8 faces added'
# 4 x 4 minus 2 x 2; a ring of 4 and 4 corners takes 8 faces
accepts close_ring '--close ring.obj' 'volume    12' 'closed 4 holes, 16 faces added'
# 36 - 16 + 4; at each end a ring of 8 faces and a square of 2
accepts close_island '--close isle.obj' 'volume    24' 'closed 6 holes, 20 faces added'
# 72 - 3 - 3; a polygon of n corners with h holes takes n + 2 h - 2 faces: 19 + 4 - 2, twice
accepts close_slots '--close slots.obj' 'volume    66' 'closed 6 holes, 42 faces added'
accepts close_nothing '--close plus.obj --overlaps allow' 'mended    nothing'
# three corners of the hole lie in z = 1 and one a unit above. Its plane lies 1 / 4 unit below or above
# each, measured upright; tilted by slopes of 1 / 6 and 1 / 4 that is 0.25 / sqrt(1 + 1/36 + 1/16) =
# 0.239
refuses close_warped '--close warped.obj' '1 hole' 'not flat: 0.239 units'
refuses close_crossed '--close crossed.obj' 'cannot be filled'
refuses close_leaf '--close leaf.obj'

# ----------------------------------------------------------- parts within parts

both='1 pair of parts overlap'
refuses parts_shifted shifted.obj "$both" '(0, 0, 0) - (3, 2, 1) and (1, 0, 0) - (4, 2, 1)' --overlaps
refuses parts_plus plus.obj "$both"
refuses parts_poked poked.obj "$both"
accepts parts_allowed '--overlaps allow shifted.obj' 'volume    12' 'counts twice'
accepts parts_beside beside.obj 'volume    3.28125' 'mended    nothing' # 3 + 0.75^2 * 0.5
accepts parts_nested nested.obj 'volume    512' '12 faces, 18 edges, 8 vertices' \
    'dropped a part within another' '(2, 2, 2) - (6, 6, 6)'
accepts parts_flush flush.obj 'volume    512' 'dropped a part within another'
accepts parts_in_hollow matryoshka.obj 'volume    360' '36 faces' '1 part of negative volume' # 512 - 216 + 64
accepts parts_hollow_within hollow_within.obj 'volume    512' '12 faces, 18 edges, 8 vertices'

# ------------------------------------------------------------------ simplifying

refuses fine_names_simplify fine.obj '172800 faces' 'at most 65535' '--simplify'
# (120 / 128)^3
accepts simplify_flat '--simplify 12 fine.obj' '12 faces, 18 edges, 8 vertices' 'volume    0.823974609' \
    'simplified 172800 faces to 12'
"$convert" --simplify 2000 -b torus.crm torus.obj >said 2>&1 && python3 - >>said 2>&1 <<'END'
import math, struct

blob = open("torus.crm", "rb").read()
bits = blob[6]
nv, nf = struct.unpack_from("<II", blob, 8)
v = list(struct.iter_unpack("<hhh", blob[16:16 + 6 * nv]))
f = list(struct.iter_unpack("<HHH", blob[16 + 6 * nv:16 + 6 * nv + 6 * nf]))
assert 1000 < nf <= 2000, nf
ways = [(t[k], t[k - 2]) for t in f for k in range(3)]
assert len(set(ways)) == len(ways) and all((b, a) in set(ways) for a, b in ways[:300])
assert {(b, a) for a, b in ways} == set(ways)
assert nv - len(ways) // 2 + nf == 0 # still a torus
volume = 0
for t in f:
    a, b, c = (v[i] for i in t)
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
               + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
volume /= 2 ** (3 * bits)
assert abs(volume / (2 * math.pi ** 2 * 0.09) - 1) < 0.02, volume
# no vertex moved: each is on the torus within half a quantum along each axis
for x, y, z in v:
    off = math.hypot(math.hypot(x, y) / 2 ** bits - 1, z / 2 ** bits) - 0.3
    assert abs(off) < 0.9 / 2 ** bits, off
import math, struct

blob = open("torus.crm", "rb").read()
bits = blob[6]
nv, nf = struct.unpack_from("<II", blob, 8)
v = list(struct.iter_unpack("<hhh", blob[16:16 + 6 * nv]))
f = list(struct.iter_unpack("<HHH", blob[16 + 6 * nv:16 + 6 * nv + 6 * nf]))
assert 1000 < nf <= 2000, nf
ways = [(t[k - 1], t[k]) for t in f for k in range(3)]
assert len(set(ways)) == len(ways) and {(b, a) for a, b in ways} == set(ways)
assert nv - len(ways) // 2 + nf == 0 # still a torus
volume = 0
for t in f:
    a, b, c = (v[i] for i in t)
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
               + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
volume /= 2 ** (3 * bits)
assert abs(volume / (2 * math.pi ** 2 * 0.09) - 1) < 0.02, volume
# no vertex moved: each is on the torus within half a quantum along each axis
for x, y, z in v:
    off = math.hypot(math.hypot(x, y) / 2 ** bits - 1, z / 2 ** bits) - 0.3
    assert abs(off) < 0.9 / 2 ** bits, off
END
report $? simplify_torus
# the smallest torus of triangles has 14 faces
refuses simplify_too_far '--simplify 13 torus.obj' '--simplify 13 cannot be reached'
refuses simplify_open '--simplify 8 open.obj' 'open edges'
accepts simplify_small '--simplify 100 nested.obj' 'volume    512'

# ----------------------------------------------------------------- bad options

# wrong OPTIONS TEXT: ends with status 1, and writes nothing
wrong()
{
    rm -f out.crm
    # shellcheck disable=SC2086
    "$convert" $1 -b out.crm open.obj >said 2>&1
    [ $? -eq 1 ] && [ ! -e out.crm ] && says "$2"
    report $? "wrong_${1##* }"
}
wrong '--overlaps maybe' '--overlaps: allow or refuse'
wrong '--simplify few' '--simplify: not a number'
wrong '--simplify 3' '--simplify: a whole number from 4 to 65535'

echo "1..$tests"
[ $failed -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# The mesh converter on grids of heights and shapes; each object by itself; previews. Prints TAP.

# shellcheck source=tests/lib/convert.inc
. "$(dirname "$0")/lib/convert.inc"

# ----------------------------------------------------- grids of heights, shapes

python3 - <<'END' || exit 1
import struct, zlib

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

def png(width, height, bits, colour, rows, interlaced=0, size=None):
    head = struct.pack(">IIBBBBB", *(size or (width, height)), bits, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b""))

def packed(samples, bits):
    return b"".join(struct.pack(">B" if bits == 8 else ">H", s) for s in samples)

def rows_of(grid, bits):
    return b"".join(b"\0" + packed(row, bits) for row in grid)

# 7 x 5 samples; for the interlaced picture, in the order of Adam7's passes.
grid = [[(3 * x + 40 * y) % 256 for x in range(7)] for y in range(5)]
passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
adam = b""
for x0, y0, dx, dy in passes:
    part = [row[x0::dx] for row in grid[y0::dy]]
    adam += rows_of([row for row in part if row], 8)
def write(name, data):
    open(name, "wb").write(data if isinstance(data, bytes) else data.encode())
write("grey8.png", png(7, 5, 8, 0, rows_of(grid, 8)))
write("woven.png", png(7, 5, 8, 0, adam, 1))
write("grey16.png", png(7, 5, 16, 0, rows_of([[257 * s for s in row] for row in grid], 16)))
write("colour.png", png(1, 1, 8, 2, b"\0abc"))
write("alpha.png", png(1, 1, 8, 4, b"\0ab"))
write("cut.png", open("grey8.png", "rb").read()[:60])
write("short.png", png(7, 5, 8, 0, rows_of(grid[:3], 8)))
write("head.png", open("grey8.png", "rb").read()[:20])
write("huge.png", png(7, 5, 8, 0, rows_of(grid, 8), size=(900000, 900000)))
write("absurd.png", png(7, 5, 8, 0, rows_of(grid, 8), size=(2**31 - 1, 2**31 - 1)))
damaged = bytearray(open("grey8.png", "rb").read())
damaged[50] ^= 0xff
write("damaged.png", bytes(damaged))
write("dot.png", png(1, 1, 8, 0, b"\0a"))
write("large.png", png(300, 200, 8, 0, rows_of([[9] * 300] * 200, 8)))
# z = 2 x + 3 y at places 1 apart, with the first row in the north
plane = [[2 * x + 3 * y for x in (-1.5, -0.5, 0.5, 1.5)] for y in (1, 0, -1)]
for name, separator in (("comma", ","), ("semicolon", ";"), ("blank", "  "), ("tab", "\t")):
    write(name + ".csv", "\n".join(separator.join("%g" % z for z in row) for row in plane) + "\n")
write("dos.csv", b"\xef\xbb\xbf" + "\r\n".join(", ".join("%g" % z for z in row) for row in plane).encode() + b"\r\n\r\n")
write("ragged.csv", "1,2,3\n4,5\n")
write("word.csv", "1,2\n3,high\n")
write("nan.csv", "1,2\n3,nan\n")
write("inf.csv", "1,2\n3,1e999\n")
write("gap.csv", "1,2\n3,\n")
write("decimal.csv", "1,5;2\n3;4\n")
write("one.csv", "1\n")
write("line.csv", "1,2,3\n")
write("empty.csv", "")
write("blank_lines.csv", "\n\n \n")
write("binary.csv", bytes(range(256)))
write("long.csv", "\n".join(["1 2"] * 300))
END

# grid_is FILE CELL HEIGHT OFFSET EVERY GREY: out.crm has the samples of the test's picture, each at its
# place, and faces that look up and cover the whole rectangle
grid_is()
{
    python3 - "$@" >>said 2>&1 <<'END'
import struct, sys
cell, height, offset = map(float, sys.argv[1:4])
every = int(sys.argv[4])
blob = open("out.crm", "rb").read()
kind, bits = blob[5], blob[6]
nv, nf = struct.unpack_from("<II", blob, 8)
v = [[c / 2.0**bits for c in t] for t in struct.iter_unpack("<hhh", blob[16:16 + 6 * nv])]
f = list(struct.iter_unpack("<HHH", blob[16 + 6 * nv:16 + 6 * nv + 6 * nf]))
xs, ys = range(0, 7, every), range(0, 5, every)
want = {}
wide, deep = cell * every * (len(xs) - 1), cell * every * (len(ys) - 1)
for i, x in enumerate(xs):
    for j, y in enumerate(ys):
        want[(i, j)] = (cell * every * i - wide / 2, deep / 2 - cell * every * j,
                        (3 * x + 40 * y) % 256 / 255 * height + offset)
assert kind == 1 and nv == len(want) and nf == 2 * (len(xs) - 1) * (len(ys) - 1)
half = 2.0**-bits / 2 + 1e-12
for place in want.values():
    assert any(all(abs(a - b) <= half for a, b in zip(place, p)) for p in v), place
area = 0
for a, b, c in f:
    (ax, ay, _), (bx, by, _), (cx, cy, _) = v[a], v[b], v[c]
    twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    assert twice > 0
    area += twice / 2
assert abs(area - wide * deep) <= 4 * half * (wide + deep) + 1e-9, area
END
}

for file in grey8 woven grey16; do
    rm -f out.crm
    "$convert" --heights --cell 0.5 --height 4 --offset -1 -b out.crm $file.png >said 2>&1 &&
        says '7 x 5 samples' 'SURFACE' && grid_is 0.5 4 -1 1
    report $? heights_$file
done
"$convert" --heights -b out.crm grey8.png >said 2>&1 && says 'white is 10 units above black' &&
    grid_is 1 10 0 1
report $? heights_by_default
"$convert" --heights --every 2 -b out.crm grey8.png >said 2>&1 && grid_is 1 10 0 2
report $? heights_every_2
"$convert" --heights --every 3 -b out.crm grey8.png >said 2>&1 && grid_is 1 10 0 3 &&
    says 'left out the last 0 columns and 1 rows'
report $? heights_every_3
accepts heights_scaled '--heights --scale 2 grey8.png' '7 x 5 samples'

# the plane z = 2 x + 3 y, for every separator of its numbers
for file in comma semicolon blank tab dos; do
    rm -f out.crm
    "$convert" --heights -b out.crm $file.csv >said 2>&1 && python3 - >>said 2>&1 <<'END'
import struct
blob = open("out.crm", "rb").read()
one = 2**blob[6]
v = list(struct.iter_unpack("<hhh", blob[16:16 + 6 * 12]))
assert struct.unpack_from("<II", blob, 8) == (12, 12)
assert {(x / one, y / one) for x, y, _ in v} == {(x, y) for x in (-1.5, -0.5, 0.5, 1.5) for y in (1, 0, -1)}
assert all(z == 2 * x + 3 * y for x, y, z in v)
END
    report $? heights_$file
done

refuses heights_colour '--heights colour.png' 'has colours or transparency'
refuses heights_alpha '--heights alpha.png' 'has colours or transparency'
for file in cut short head damaged absurd; do
    refuses heights_png_$file "--heights $file.png" 'truncated or damaged'
done
refuses heights_huge '--heights huge.png' '900000 x 900000 is too large to read'
refuses heights_dot '--heights dot.png' '1 x 1 samples has no face'
refuses heights_large '--heights --cell 0.5 large.png' '60000 vertices and 119002 faces' '--every 2 takes'
accepts heights_large_thinned '--heights --cell 0.5 --every 2 large.png' '150 x 100 samples, 1 units apart'
refuses heights_too_thin '--heights --every 7 grey8.png' '1 x 1 samples has no face' '--every leaves too few'
refuses heights_ragged '--heights ragged.csv' 'line 2 has 2 numbers, the first one 3'
refuses heights_word '--heights word.csv' "line 2, column 2 is not a number: 'high'"
refuses heights_nan '--heights nan.csv' "line 2, column 2 is not a finite number: 'nan'"
refuses heights_infinite '--heights inf.csv' 'line 2, column 2 is not a finite number'
refuses heights_gap '--heights gap.csv' 'line 2, column 2 is empty'
refuses heights_decimal_comma '--heights decimal.csv' 'line 1, column 1 is not a number' 'write 1.5, not 1,5'
refuses heights_one '--heights one.csv' '1 x 1 samples has no face'
refuses heights_line '--heights line.csv' '3 x 1 samples has no face'
refuses heights_empty '--heights empty.csv' 'the file is empty'
refuses heights_blank_lines '--heights blank_lines.csv' 'holds no numbers'
refuses heights_binary '--heights binary.csv' 'not a number'
refuses heights_long '--heights long.csv' 'a side of 299 units is too long' '--cell 0.85618 fits'
accepts heights_long_fits '--heights --cell 0.85618 long.csv' '2 x 300 samples'
"$convert" --heights --cell 0 grey8.png >said 2>&1
[ $? -eq 1 ] && says '--cell: must be above 0'
report $? heights_no_cell
"$convert" --cell 2 comma.csv >said 2>&1
[ $? -eq 1 ] && says 'go with --heights'
report $? cell_alone

# shape NAME TEXT CALL SIDES: the blob is equal to the run-time shape in quanta of 2^-10 units
shape()
{
    cat >shape.c <<END
#include <stdio.h>
#include "carom_shapes.h"
static int16_t v[CAROM_CAPSULE_VERTICES(128)][3];
static uint16_t f[CAROM_CAPSULE_FACES(128)][3];
static const struct carom_shape_room room = {v, f, CAROM_CAPSULE_VERTICES(128), CAROM_CAPSULE_FACES(128), 10};
int main(void)
{
    struct carom_mesh_raw raw;
    if ($3 != CAROM_OK) {
        return 1;
    }
    fwrite(v, sizeof v[0], raw.vertex_count, stdout);
    fwrite(f, sizeof f[0], raw.face_count, stdout);
    return 0;
}
END
    rm -f out.crm
    "${CC:-cc}" -std=c11 -I"$root/include" -o shape shape.c "$root/src/mesh/shapes.c" \
        "$root"/src/num/*.c >said 2>&1 && ./shape >shape.bytes &&
        "$convert" --quantum-bits 10 --shape "$2" -b out.crm >said 2>&1 &&
        python3 -c '
made, blob = open("shape.bytes", "rb").read(), open("out.crm", "rb").read()
assert made and blob[16:-8] == made and blob[5:7] == bytes([0, 10])' >>said 2>&1
    report $? "shape_$1"
}
shape box box:1,0.5,2 'carom_shape_box(&raw, &room, (const int32_t[]){512, 256, 1024})'
shape sphere sphere:0.5,16 'carom_shape_sphere(&raw, &room, 512, 16)'
shape capsule capsule:0.25,1,12 'carom_shape_capsule(&raw, &room, 256, 512, 12)'
shape cylinder cylinder:1,0.5,9 'carom_shape_cylinder(&raw, &room, 1024, 256, 9)'
shape cone cone:1,3,7 'carom_shape_cone(&raw, &room, 1024, 1536, 7)'

# volume OPTIONS EXPRESSION: the reported volume is within 1/1000 of a closed form
volume()
{
    # shellcheck disable=SC2086
    "$convert" $1 >said 2>&1 && python3 -c "
from math import *
import re
said = float(re.search(r'volume +(\S+)', open('said').read()).group(1))
assert abs(said / ($2) - 1) < 1e-3, said" >>said 2>&1
    report $? "volume_${1##*--shape }"
}
volume '--shape box:2,3,4' '2 * 3 * 4'
volume '--shape cylinder:0.5,2,24' '2 * 24 / 2 * 0.25 * sin(2 * pi / 24)'
volume '--shape cone:0.5,2,24' '2 * 24 / 6 * 0.25 * sin(2 * pi / 24)'
volume '--shape sphere:2,128' '4 / 3 * pi * 8 * (1 - 16.5 / 128**2)'
volume '--unit mm --shape box:20,30,40' '24e-6'
refuses shape_unknown '--shape torus:1,2' "no shape 'torus'"
refuses shape_numbers_few '--shape box:1,2' 'box:X,Y,Z is wanted'
refuses shape_not_a_number '--shape sphere:x,16' 'not a number: x'
refuses shape_negative '--shape box:1,-2,3' 'each number above 0'
refuses shape_sides '--shape sphere:1,200' 'from 3 to 128'
refuses shape_sides_by_4 '--shape sphere:1,10' 'no multiple of 4'
refuses shape_long '--shape box:300,1,1' 'a side may have 256 units'
refuses shape_huge '--shape sphere:1e30,16' 'too large'
refuses shape_coarse '--quantum-bits 7 --shape sphere:0.02,128' 'cannot be made'

# ------------------------------------------------------------- each object

python3 - <<'END' || exit 1
# boxes of 3 x 2 x 1 and (1, 2, 3) times as long, at different places
box = [(x, y, z) for z in (0, 1) for y in (0, 2) for x in (0, 3)]
quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
def write(path, names, last=6):
    with open(path, "w") as out:
        for k, name in enumerate(names):
            out.write("o %s\n" % name)
            for x, y, z in box:
                out.write("v %d %d %d\n" % ((k + 1) * x + 9 * k, y, z))
            for q in quads[:6 if k + 1 < len(names) else last]:
                out.write("f " + " ".join(str(i + 1 + 8 * k) for i in q) + "\n")
write("parts.obj", ["left.arm", "left-arm", "int"])
write("names.obj", ["a", "a_vertices"])
write("broken.obj", ["whole", "half"], 5)
write("box.obj", ["box"])
END
"$convert" --objects -o parts.c -b parts.crm parts.obj >said 2>&1 &&
    says "'left.arm' as left_arm" "'left-arm' as left_arm_2" "'int' as mesh_int" 'volume    6' \
        'volume    12' 'volume    18' && [ "$(echo parts.*.crm)" = \
        'parts.left_arm.crm parts.left_arm_2.crm parts.mesh_int.crm' ] && [ ! -e parts.crm ]
report $? objects
for option in '' --index; do
    # shellcheck disable=SC2086
    "$convert" $option --objects -o names.c names.obj >said 2>&1 &&
        "$convert" $option --objects -o parts.c parts.obj >>said 2>&1 &&
        for file in parts names; do
            "${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Wconversion -Werror -I"$root/include" \
                -c $file.c >>said 2>&1 || break
        done && [ -e names.o ] && grep -q 'carom_mesh.* left_arm_2 = {' parts.c
    report $? "objects_compile$option"
done
rm -f kept*
"$convert" --objects -o kept.c -b kept.crm --preview kept.png broken.obj >said 2>&1
[ $? -eq 1 ] && says "object 'half': 4 open edges" && [ -z "$(ls kept* 2>/dev/null)" ]
report $? objects_all_or_none
mkdir -p kept.left_arm_2.crm
"$convert" --objects -b kept.crm parts.obj >said 2>&1
[ $? -eq 1 ] && says 'cannot write kept.left_arm_2.crm' && [ ! -e kept.left_arm.crm ]
report $? objects_written_all_or_none
"$convert" --objects --name x parts.obj >said 2>&1
[ $? -eq 1 ] && says 'not with --object or --name'
report $? objects_named

# --------------------------------------------------------------- previews

# seen OPTIONS LEAST MOST: the picture has 1200 x 600 pixels; in its left half, the share in percent that is
# not background is between LEAST and MOST. The background has one colour in each row.
seen()
{
    rm -f seen.png
    # shellcheck disable=SC2086
    "$convert" $1 --preview seen.png >said 2>&1 && python3 - "$2" "$3" >>said 2>&1 <<'END'
import struct, sys, zlib
data = open("seen.png", "rb").read()
at, packed = 8, b""
while at < len(data):
    size, kind = struct.unpack_from(">I4s", data, at)
    body = data[at + 8:at + 8 + size]
    if kind == b"IHDR":
        width, height, bits, colour, _, _, woven = struct.unpack(">IIBBBBB", body)
    if kind == b"IDAT":
        packed += body
    at += size + 12
assert (width, height, bits, colour, woven) == (1200, 600, 8, 2, 0)
raw, rows, last = zlib.decompress(packed), [], bytes(3600)
def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
for y in range(600):
    how, row = raw[3601 * y], bytearray(raw[3601 * y + 1:3601 * (y + 1)])
    for i in range(3600):
        a, b, c = (row[i - 3] if i > 2 else 0), last[i], (last[i - 3] if i > 2 else 0)
        row[i] = row[i] + (0, a, b, (a + b) // 2, paeth(a, b, c))[how] & 255
    rows.append(bytes(row))
    last = rows[-1]
for side in (0, 600):
    covered, colours, touched = 0, set(), False
    for y in range(40, 560):
        for x in range(side, side + 600):
            pixel = rows[y][3 * x:3 * x + 3]
            other = max(abs(p - q) for p, q in zip(pixel, rows[y][3 * side:3 * side + 3])) > 8
            covered += other
            touched |= other and (x - side in (0, 1, 598, 599))
            if other:
                colours.add(pixel)
    share = 100 * covered / 360000
    assert float(sys.argv[1]) <= share <= float(sys.argv[2]), share
    assert len(colours) > 10 and not touched, (len(colours), touched)
END
    report $? "preview_$(echo "${1##*--shape }" | tr -c 'a-z0-9\n' '_')"
}
# a ball as wide as 84 % of the picture: pi / 4 * 0.84^2 = 55 %, and a little less as a polygon
seen '--shape sphere:0.5,32' 50 57
seen '--unit mm --shape sphere:1,32' 50 57
seen '--shape sphere:100,32' 50 57
seen '--shape box:1,1,1' 35 60
seen '--shape cylinder:0.1,200,8' 0.05 2
seen '--heights grey8.png' 10 60 # a slope of 58 degrees that looks north, away from the front
seen '--heights --cell 0.8 --height 40 --every 2 large.png' 15 60
"$convert" --check --preview no.png box.obj >said 2>&1 && [ ! -e no.png ]
report $? preview_check_writes_nothing
"$convert" --objects --preview parts.png parts.obj >said 2>&1 && [ -s parts.left_arm_2.png ]
report $? preview_of_each_object

echo "1..$tests"
[ $failed -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# The mesh converter, build/tools/carom-mesh, on files made here; prints TAP.
# With ../shared/meshes beside the project its meshes are converted too.

# shellcheck source=tests/lib/convert.inc
. "$(dirname "$0")/lib/convert.inc"

# ------------------------------------------------------------------ the files

python3 - <<'END' || exit 1
import base64, json, struct

def write(name, data):
    open(name, "wb").write(data if isinstance(data, bytes) else data.encode())

def obj(points, polygons):
    lines = ["v %s %s %s" % tuple(p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in q) for q in polygons]
    return "\n".join(lines) + "\n"

def back(polygons):
    return [tuple(reversed(q)) for q in polygons]

def moved(polygons, by):
    return [tuple(i + by for i in q) for q in polygons]

# A box of 3 x 2 x 1 with one corner at the origin.
box = [(x, y, z) for z in (0, 1) for y in (0, 2) for x in (0, 3)]
quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
nan = float("nan")

write("box.obj", obj(box, quads))
write("inside_out.obj", obj(box, back(quads)))
write("one_turned.obj", obj(box, quads[:2] + back(quads[2:3]) + quads[3:]))
write("open.obj", obj(box, quads[:5]))
write("twice.obj", obj(box, quads + quads[:1]))
write("cut.obj", obj(box, quads)[:-12])
write("empty.obj", "")
write("points.obj", obj(box, []))
write("index.obj", obj(box, quads + [(0, 1, 99)]))
write("nan.obj", obj([("nan", 0, 0)] + box[1:], quads))
write("infinite.obj", obj([("inf", 0, 0)] + box[1:], quads))
write("long.obj", obj([(100 * x - 150, y, z) for x, y, z in box], quads))
write("diagonal.obj", obj([(x * 83 - 125, y * 124 - 124, z * 249 - 124) for x, y, z in box], quads))
write("micro.obj", obj([(1e-6 * (x / 3 - 0.5), 1e-6 * (y / 2 - 0.5), 1e-6 * (z - 0.5))
                        for x, y, z in box], quads))
write("large.obj", obj([(x / 300, y / 300, (x * y % 7) / 300) for x in range(661) for y in range(661)],
                       [(a, a + 661, a + 662, a + 1) for x in range(660)
                        for a in range(661 * x, 661 * x + 660)]))
def named(name, points, polygons, before=0):
    return "o %s\n" % name + obj(points, moved(polygons, before))
write("two.obj", named("left", box, quads)
      + named("right", [(x / 3 + 10, y, z) for x, y, z in box], quads, 8))
write("nested.obj", named("out", [(3 * x - 3, 3 * y - 2, 3 * z - 1) for x, y, z in box], quads)
      + named("in", box, quads, 8))
write("holes.obj", obj(box, quads[:4]))
write("far.obj", obj([(200 * x, y, z) for x, y, z in box], quads))
write("hollow.obj", obj([(3 * x - 3, 3 * y - 2, 3 * z - 1) for x, y, z in box] + box,
                        quads + moved(back(quads), 8)))
write("edge.obj", obj(box + [(x + 3, y + 2, z) for x, y, z in box], quads + moved(quads, 8)))
# The box with a vertex on its lower front edge, and a face without area there.
front, floor = (1, 5, 0), (1, 0, 3)
assert {front, floor} <= {t[k:] + t[:k] for t in triangles for k in range(3)}
whole = [t for t in triangles if set(t) not in (set(front), set(floor))]
write("sliver.obj", obj(box + [(1, 0, 0)], whole + [floor, (0, 1, 8), (8, 1, 5), (8, 5, 0)]))
# 280 x 251 = 70280 vertices of a flat surface.
write("many.obj", obj([(x / 4, y / 4, 0) for x in range(280) for y in range(251)],
                      [(a, a + 251, a + 252, a + 1) for x in range(279)
                       for a in range(251 * x, 251 * x + 250)]))
# An L of two hexagons that are not convex, and six walls.
corners = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
write("bent.obj", obj([(x, y, z) for z in (0, 1) for x, y in corners],
                      [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11)]
                      + [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]))
write("ground.obj", obj(box, [(4, 6, 7, 5)]))
write("wall.obj", obj(box, [quads[2]]))
write("layers.obj", obj(box, [(0, 1, 3, 2), (4, 5, 7, 6)]))
write("strip.obj", obj([(0, 0, 0), (4, 0, 0), (2, 3, 0), (2, 1, 1), (1, 2, 2)],
                       [(0, 1, 2), (1, 2, 3), (2, 3, 4), (3, 4, 0), (4, 0, 1)]))

facet = struct.Struct("<12fH")
stl = bytes(80) + struct.pack("<I", 12)
stl += b"".join(facet.pack(0, 0, 0, *(c for i in t for c in box[i]), 0) for t in triangles)
write("box_binary.stl", stl)
write("cut_binary.stl", stl[:300])
text = "solid box\n"
for t in triangles:
    text += "facet normal 0 0 0\nouter loop\n"
    text += "".join("vertex %g %g %g\n" % box[i] for i in t) + "endloop\nendfacet\n"
text += "endsolid box\n"
write("box_text.stl", text)
write("cut_text.stl", text[:700])
write("nan_text.stl", text.replace("vertex 3 2 1", "vertex nan 2 1"))

def ply(kind, faces):
    return ("ply\nformat %s 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
            "end_header\n" % (kind, faces))

text = ply("ascii", 6) + "".join("%g %g %g\n" % p for p in box)
text += "".join("4 %d %d %d %d\n" % q for q in quads)
write("box_text.ply", text)
write("cut_text.ply", text[:-30])
for kind, mark in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
    data = ply(kind, 12).encode() + b"".join(struct.pack(mark + "3f", *p) for p in box)
    data += b"".join(struct.pack(mark + "B3i", 3, *t) for t in triangles)
    write("box_%s.ply" % kind, data)
    write("cut_%s.ply" % kind, data[:-40])

def gltf(buffer, uri):
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "translation": [4, 0, 0]}, {"mesh": 0, "scale": [1, 2, -1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [dict(byteLength=len(buffer), **uri)],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                        {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [0, 0, 0], "max": [3, 2, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
    }
    return json.dumps(scene).encode()

buffer = b"".join(struct.pack("<3f", *p) for p in box)
buffer += b"".join(struct.pack("<3H", *t) for t in triangles)

def inline(buffer):
    code = base64.b64encode(buffer).decode()
    return gltf(buffer, {"uri": "data:application/octet-stream;base64," + code})

write("placed.gltf", inline(buffer))
write("cut.gltf", inline(buffer)[:600])
write("nan.gltf", inline(struct.pack("<f", nan) + buffer[4:]))
scene = gltf(buffer, {})
scene += b" " * (-len(scene) % 4)
glb = struct.pack("<4sII", b"glTF", 2, 28 + len(scene) + len(buffer))
glb += struct.pack("<I4s", len(scene), b"JSON") + scene
glb += struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
write("placed.glb", glb)
write("cut.glb", glb[:-50])
END

# ---------------------------------------------------------------- what works

# (4 + 1) / 12, (9 + 1) / 12, (9 + 4) / 12
box_mass='inertia   0.416666667 0.833333333 1.08333333 0 0 0'
box_place='centre    1.5 1 0.5'
box_faces='12 faces, 18 edges, 8 vertices'

accepts box_of_quads box.obj '6 polygons, 12 triangles' "$box_faces" 'volume    6' \
    "$box_place" "$box_mass" 'mended    nothing'
for file in box_binary.stl box_text.stl box_binary_little_endian.ply box_binary_big_endian.ply; do
    accepts "$file" $file '12 polygons, 12 triangles' "$box_faces" 'volume    6' "$box_place" \
        "$box_mass" 'mended    nothing'
done
accepts box_text.ply box_text.ply '6 polygons, 12 triangles' "$box_faces" 'volume    6' \
    "$box_place" "$box_mass" 'mended    nothing'
# The transforms of two nodes: doubled along y, mirrored in z, moved by 4 along x.
for file in placed.gltf placed.glb; do
    accepts "$file" $file "$box_faces" 'volume    12' 'centre    5.5 2 -0.5' 'mended    nothing'
done
accepts polygons_not_convex bent.obj '8 polygons, 20 triangles' 'volume    3' \
    'centre    0.833333333 0.833333333 0.5'
accepts scale '--scale 0.5 box.obj' 'volume    0.75'
accepts unit_mm '--unit mm --scale 1000 box.obj' 'volume    6'
accepts unit_guessed '--scale 40 box.obj' 'looks like millimetres'
accepts up_y '--up y box.obj' 'volume    6' 'centre    1.5 -0.5 1'
# corners at half a micrometre are 0.52 quanta of 2^-20 from the origin: 2^-60 * 2^3 / 10^-18 = 6.94
accepts bent_by_quanta micro.obj 'makes the volume 6.94 times'
accepts objects_joined two.obj 'joined    2 objects' left right '24 faces' 'volume    8'
accepts one_object '--object right two.obj' '12 faces' 'volume    2'
accepts own_grid box.obj 'quantum 2^-7 '
accepts finest_grid '--scale 0.7 box.obj' 'quantum 2^-13 ' # 2.1 * 2^13 < 32767 < 2.1 * 2^14
accepts asked_grid '--quantum-bits 9 box.obj' 'quantum 2^-9 '
accepts surface '--surface ground.obj' 'SURFACE' '2 faces, 5 edges, 4 vertices' \
    'turned 2 faces that looked down'

# --------------------------------------------------------------- what is mended

accepts inside_out inside_out.obj 'volume    6' 'turned 12 faces of a part that was inside out'
accepts one_turned one_turned.obj 'volume    6' 'turned 2 faces that disagreed'
accepts face_given_twice twice.obj "$box_faces" 'volume    6' 'dropped 2 faces given twice'
accepts face_without_area sliver.obj '14 faces, 21 edges, 9 vertices' 'volume    6' \
    'mended 1 face without area'
accepts hollow hollow.obj '24 faces' 'volume    156' 'as hollow' # 9 x 6 x 3 minus 3 x 2 x 1

# -------------------------------------------------------------- what is refused

refuses open_solid open.obj '4 open edges' '(3, 0, 0) - (3, 2, 0)' '(3, 0, 0) - (3, 0, 1)' \
    '(3, 2, 0) - (3, 2, 1)' '(3, 0, 1) - (3, 2, 1)' '--surface'
refuses crowded_edge edge.obj '1 non-manifold edge' '(3, 2, 0) - (3, 2, 1): 4 faces'
refuses empty empty.obj 'the file is empty'
refuses absent absent.obj 'cannot be opened'
refuses no_faces points.obj 'holds no faces'
refuses index_too_large index.obj 'cannot be read'
refuses cut_obj cut.obj 'open edges' 'may be truncated'
refuses cut_binary_stl cut_binary.stl 'truncated'
refuses cut_text_stl cut_text.stl 'truncated' endsolid
for file in cut_text.ply cut_binary_little_endian.ply cut_binary_big_endian.ply cut.gltf cut.glb; do
    refuses $file $file truncated
done
for file in nan.obj infinite.obj nan_text.stl nan.gltf; do
    refuses $file $file 'not a finite number'
done
refuses many_vertices '--surface many.obj' '70280 vertices' 'at most 65535' simplify
refuses coordinates_too_large far.obj '600 units is too large' '255.9921875' --scale
refuses side_too_long long.obj '300 x 2 x 1 units is too large' 'a side may have 256 units'
refuses diagonal_too_long '--scale 1 diagonal.obj' '249 x 248 x 249 units is too large' 'the diagonal 384'
refuses many_faces '--surface large.obj' '436921 vertices and 871200 faces' 'at most 65535' simplify
refuses bad_unit_size '--unit m long.obj' '300 x 2 x 1 units is too large'
refuses no_such_object '--object middle two.obj' "no faces of an object 'middle'" left right
refuses two_holes holes.obj '8 open edges' 'hole 1, 4 edges' 'hole 2, 4 edges'
refuses quantum_too_fine '--quantum-bits 14 box.obj' 'use --quantum-bits 13'
refuses too_small '--scale 0.0000001 box.obj' 'too small' --scale
refuses no_volume ground.obj '4 open edges'
refuses upright_surface '--surface wall.obj' '2 faces upright or overhanging' 'z is up'
refuses two_layers '--surface layers.obj' '2 pairs of faces above each other'
refuses one_sided '--surface strip.obj' Moebius
refuses closed_surface '--surface box.obj' '10 faces upright or overhanging'

"$convert" --name 9x box.obj >said 2>&1
[ $? -eq 1 ] && says 'not an identifier'
report $? bad_name
"$convert" >said 2>&1
[ $? -eq 2 ] && says usage:
report $? usage
"$convert" -b kept.crm -o absent/out.c box.obj >said 2>&1
[ $? -eq 1 ] && [ ! -e kept.crm ] && says 'cannot write absent/out.c'
report $? both_outputs_or_none
"$convert" --check -o checked.c box.obj >said 2>&1 && [ ! -e checked.c ]
report $? check_writes_nothing

# ------------------------------------------------------------------ the outputs

"$convert" -b box.crm -o box.c --name my_box box.obj >said 2>&1 && python3 - >said 2>&1 <<'END'
import struct

blob = open("box.crm", "rb").read()
assert blob[:8] == b"CRM1" + bytes([1, 0, 7, 0]), blob[:8]
assert struct.unpack_from("<II", blob, 8) == (8, 12)
assert len(blob) == 24 + 6 * 8 + 6 * 12
vertices = list(struct.iter_unpack("<hhh", blob[16:64]))
assert vertices == [(x, y, z) for z in (0, 128) for y in (0, 256) for x in (0, 384)], vertices
faces = list(struct.iter_unpack("<HHH", blob[64:136]))
assert faces[:2] in ([(0, 2, 3), (0, 3, 1)], [(0, 2, 1), (2, 3, 1)]), faces[:2]
h = 0xcbf29ce484222325
for byte in blob[:-8]:
    h = (h ^ byte) * 0x100000001b3 % 2**64
assert struct.unpack("<Q", blob[-8:]) == (h,)
END
report $? blob
"${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Wconversion -Werror -I"$root/include" -c box.c \
    >said 2>&1 && grep -q 'const struct carom_mesh_raw my_box = {' box.c
report $? c_source

# --------------------------------------------------------------- larger meshes

# same FILE C-SOURCE: an OBJ on a grid of 1/1024 and a converted mesh have the same vertices and
# faces, in the same order
same()
{
    python3 - "$1" "$2" >said 2>&1 <<'END'
import re, sys

text = open(sys.argv[2]).read()
rows = [[tuple(map(int, t)) for t in re.findall(r"\{(-?\d+), (-?\d+), (-?\d+)\}", part)]
        for part in text.split("faces[", 1)]
lines = [line.split() for line in open(sys.argv[1])]
assert rows[0] == [tuple(round(1024 * float(c)) for c in w[1:]) for w in lines if w[0] == "v"]
assert rows[1] == [tuple(int(c) - 1 for c in w[1:]) for w in lines if w[0] == "f"]
END
}

"$root/tools/gen_head" .
accepts head '-o head.c head.obj' 'SOLID' '2^-10 ' '1876 faces, 2814 edges, 940 vertices' \
    'mended    nothing'
same head.obj head.c
report $? head_keeps_its_order
"$root/tools/gen_field" >field.obj
accepts field '--surface -o field.c field.obj' 'SURFACE' '2^-10 ' \
    '3034 faces, 4629 edges, 1596 vertices' 'mended    nothing'
same field.obj field.c
report $? field_keeps_its_order

# an indexed mesh is equal to the result of carom_mesh_build
cat >index.c <<'END'
#include <string.h>
#include "carom.h"
extern const struct carom_mesh indexed;
static _Alignas(8) uint8_t memory[CAROM_MESH_BYTES(2000, 4000)];
#define SAME(part, n) same &= memcmp(mesh.part, indexed.part, (n) * sizeof *mesh.part) == 0
int main(void)
{
    struct carom_mesh mesh;
    int same = carom_mesh_build(&mesh, &indexed.raw, memory, sizeof memory) == CAROM_OK;
    size_t cells = (size_t)mesh.grid_nx * mesh.grid_ny;
    const struct carom_leaf *last = &mesh.leaves[mesh.leaf_count - 1];

    same &= mesh.mass.volume_q32 == indexed.mass.volume_q32;
    same &= memcmp(&mesh.mass.centre, &indexed.mass.centre, sizeof mesh.mass.centre) == 0;
    same &= memcmp(&mesh.mass.inertia, &indexed.mass.inertia, sizeof mesh.mass.inertia) == 0;
    same &= mesh.edge_count == indexed.edge_count && mesh.leaf_count == indexed.leaf_count;
    same &= mesh.zref_count == indexed.zref_count && mesh.radius_q22 == indexed.radius_q22;
    same &= memcmp(mesh.box, indexed.box, sizeof mesh.box) == 0 && !indexed.surface;
    same &= mesh.grid_x0 == indexed.grid_x0 && mesh.grid_y0 == indexed.grid_y0;
    same &= mesh.grid_shift == indexed.grid_shift && mesh.grid_nx == indexed.grid_nx;
    same &= mesh.grid_ny == indexed.grid_ny;
    for (uint32_t i = 0; i < mesh.raw.face_count; i++) {
        const struct carom_face *a = &mesh.faces[i], *b = &indexed.faces[i];
        same &= memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 && a->own == b->own;
        same &= a->offset_q22 == b->offset_q22 && memcmp(a->edge, b->edge, sizeof a->edge) == 0;
    }
    for (uint32_t i = 0; i < mesh.leaf_count; i++) {
        same &= memcmp(&mesh.leaves[i], &indexed.leaves[i], offsetof(struct carom_leaf, face_count)) == 0;
        same &= mesh.leaves[i].face_count == indexed.leaves[i].face_count;
        same &= mesh.leaves[i].vertex_count == indexed.leaves[i].vertex_count;
    }
    SAME(edges, mesh.edge_count);
    SAME(ring_start, mesh.raw.vertex_count + 1);
    SAME(ring, mesh.ring_start[mesh.raw.vertex_count]);
    SAME(leaf_faces, last->first_face + last->face_count);
    SAME(leaf_vertices, last->first_vertex + last->vertex_count);
    SAME(leaf_corners, last->first_face + last->face_count);
    SAME(cell_start, cells + 1);
    SAME(zrefs, mesh.zref_count);
    return !same;
}
END
for kind in head field; do
    [ $kind = field ] && option=--surface || option=
    # shellcheck disable=SC2086
    "$convert" $option --index --name indexed -o indexed.c $kind.obj >said 2>&1 &&
        cc -std=c11 -I"$root/include" -o index index.c indexed.c "$root"/src/*/*.c >>said 2>&1 &&
        ./index
    report $? "${kind}_indexed"
done

if [ -d "$meshes" ]; then
    for file in "$meshes/field"*.obj; do
        faces=$(basename "$file" .obj)
        "$root/tools/gen_field" "${faces#field}" >made.obj
        "$convert" --surface -o made.c made.obj >said 2>&1 && same "$file" made.c
        report $? "generated_$faces"
    done
    cp "$meshes/teapot.obj" .
    refuses teapot teapot.obj '64 open edges' \
        '(0.4619140625, -0.046875, 0) - (0.4619140625, -0.0869140625, 0.115234375)'
    [ "$(grep -c ' - ' said)" -eq 64 ]
    report $? teapot_edges_listed
else
    echo "# SKIP convert/generated_*, convert/teapot: there is no ../shared/meshes"
fi

echo "1..$tests"
[ $failed -eq 0 ]

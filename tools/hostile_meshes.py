#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Give the mesh converter hostile files: tools/hostile_meshes.py CONVERTER [--first N] [--count N] [--record]

File N is the same on every machine. It holds a box, a ring, a plate, needles, boxes that share an edge or cross, or triangles anywhere;
of a usual, huge or tiny size; with numbers that are none; as OBJ, STL, PLY, OFF or glTF; and in half of the cases its bytes are changed.
The converter must end soon, with an error that it names and no output, or with a closed mesh. The volume, centre and inertia that it
prints must be those of that mesh, which this tool computes in rationals from the C source. Prints a line for each file that fails.
"""
import argparse
import base64
import concurrent.futures
import fractions
import json
import os
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile
from math import cos, pi, sin

import evidence

SECONDS, BYTES = 30, 3 << 30  # that a conversion may take
BOX = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]


# ---------------------------------------------------------------------- shapes

def box(r, low=(0, 0, 0), side=(1, 1, 1)):
    return [tuple(low[k] + side[k] * (corner >> k & 1) for k in range(3)) for corner in range(8)], list(BOX)


def joined(*parts):
    points, faces = [], []
    for more, sides in parts:
        faces += [tuple(i + len(points) for i in side) for side in sides]
        points += more
    return points, faces


def ring(r):
    n, m = r.randint(3, 16), r.randint(3, 8)
    thick = r.choice([0.01, 0.3, 0.99, 1.5])
    points = [((1 + thick * cos(2 * pi * k / m)) * cos(2 * pi * i / n), (1 + thick * cos(2 * pi * k / m)) * sin(2 * pi * i / n),
               thick * sin(2 * pi * k / m)) for i in range(n) for k in range(m)]
    at = lambda i, k: i % n * m + k % m
    return points, [f for i in range(n) for k in range(m) for f in
                    ((at(i, k), at(i + 1, k), at(i + 1, k + 1)), (at(i, k), at(i + 1, k + 1), at(i, k + 1)))]


def anywhere(r):
    n = r.randint(1, 60)
    return [tuple(r.uniform(-1, 1) for _ in range(3)) for _ in range(n)], \
        [tuple(r.randrange(n) for _ in range(3)) for _ in range(r.randint(1, 120))]


SHAPES = [
    box, box, ring, ring, anywhere,
    lambda r: box(r, side=(1, 1, r.choice([1e-3, 1e-6, 1e-12, 0]))),
    lambda r: box(r, side=(1e-5, 1e-5, 1)),
    lambda r: joined(box(r), box(r, low=(1, 1, 0))),
    lambda r: joined(box(r), box(r, low=(1, 0, 0))),
    lambda r: joined(box(r), box(r, low=tuple(r.uniform(-1, 1) for _ in range(3)))),
    lambda r: joined(box(r), box(r)),
    lambda r: (lambda mesh: (mesh[0], mesh[1][:-1]))(box(r)),
]


def shape(r):
    """Points, as they are written, and faces."""
    points, faces = r.choice(SHAPES)(r)
    scale = r.choice([1] * 12 + [100, 1e-4, 1e6, 1e30, 1e-30, 1e300])
    numbers = [[c * scale for c in p] for p in points]
    if r.random() < 0.05:
        numbers[r.randrange(len(numbers))][r.randrange(3)] = r.choice([float("nan"), float("inf"), -1e39, 1e-320])
    if r.random() < 0.05:
        faces[r.randrange(len(faces))] = tuple(r.randrange(len(points) + 3) for _ in range(3))
    return numbers, faces


# --------------------------------------------------------------------- formats

def single(v):
    try:
        return struct.pack("<f", v)
    except OverflowError:
        return struct.pack("<f", float("inf"))


def corners(points, faces):
    return [[points[min(i, len(points) - 1)] for i in face] for face in faces]


def as_obj(points, faces):
    return "".join("v %r %r %r\n" % tuple(p) for p in points) + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces)


def as_stl(points, faces):
    return "solid s\n" + "".join("facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n" % "".join(
        "vertex %r %r %r\n" % tuple(p) for p in triangle) for triangle in corners(points, faces)) + "endsolid s\n"


def as_binary_stl(points, faces):
    return bytes(80) + struct.pack("<I", len(faces)) + b"".join(
        bytes(12) + b"".join(single(c) for p in triangle for c in p) + bytes(2) for triangle in corners(points, faces))


def as_ply(points, faces):
    return ("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face %d\n"
            "property list uchar int vertex_indices\nend_header\n" % (len(points), len(faces)) +
            "".join("%r %r %r\n" % tuple(p) for p in points) + "".join("3 %d %d %d\n" % f for f in faces))


def as_off(points, faces):
    return "OFF\n%d %d 0\n" % (len(points), len(faces)) + "".join("%r %r %r\n" % tuple(p) for p in points) + \
        "".join("3 %d %d %d\n" % f for f in faces)


def as_gltf(points, faces):
    data = b"".join(single(c) for p in points for c in p) + b"".join(struct.pack("<I", i) for f in faces for i in f)
    cut = 12 * len(points)
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": cut}, {"buffer": 0, "byteOffset": cut, "byteLength": len(data) - cut}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"}]})


FORMATS = [("obj", as_obj), ("stl", as_stl), ("stl", as_binary_stl), ("ply", as_ply), ("off", as_off), ("gltf", as_gltf)]


def change(r, data):
    """Change bytes, or a stretch of them, in some places."""
    data = bytearray(data)
    for _ in range(r.choice([1, 1, 2, 5, 20])):
        at, length = r.randrange(len(data)), r.choice([1, 2, 5, 30])
        data[at:at + r.choice([0, length])] = r.choice([b"", bytes(r.randrange(256) for _ in range(length)), data[at:at + length] * 2,
                                                        b"9" * length, b"-1 ", b"\n"])
        if not data:
            return b"\n"
    return bytes(data[:r.randrange(len(data)) + 1] if r.random() < 0.1 else data)


def make(number):
    """The name, the bytes and the options of a file."""
    r = random.Random(number)
    suffix, written = r.choice(FORMATS)
    data = written(*shape(r))
    data = data if isinstance(data, bytes) else data.encode()
    if r.random() < 0.5:
        data = change(r, data)
    options = r.choice([[], [], ["--close"], ["--simplify", str(r.randint(1, 60))], ["--quantum-bits", str(r.randint(7, 20))],
                        ["--overlaps", "allow"], ["--surface"], ["--scale", r.choice(["0.001", "1000", "1e-30"])]])
    return "mesh." + suffix, data, options


# ---------------------------------------------------------------------- checks

def numbers_of(text, name):
    body = re.search(r"%s\[\d+\]\[3\] = \{(.*?)\n\};" % name, text, re.S).group(1)
    return [tuple(map(int, row)) for row in re.findall(r"\{(-?\d+), (-?\d+), (-?\d+)\}", body)]


def mass_of(points, faces):
    """Volume, centre, and inertia by mass about the centre: exact, in quanta."""
    volume, first, second = 0, [0] * 3, [[0] * 3 for _ in range(3)]
    for a, b, c in ([points[i] for i in face] for face in faces):
        d = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
        s = [a[k] + b[k] + c[k] for k in range(3)]
        volume += d
        for i in range(3):
            first[i] += d * s[i]
            for k in range(3):
                second[i][k] += d * (s[i] * s[k] + a[i] * a[k] + b[i] * b[k] + c[i] * c[k])
    if volume <= 0:
        return None
    volume6 = fractions.Fraction(volume)
    centre = [fractions.Fraction(f, 4) / volume6 for f in first]
    m = [[fractions.Fraction(second[i][k], 20) / volume6 - centre[i] * centre[k] for k in range(3)] for i in range(3)]
    return volume6 / 6, centre, [m[1][1] + m[2][2], m[2][2] + m[0][0], m[0][0] + m[1][1], -m[0][1], -m[1][2], -m[2][0]]


def differ(said, exact, size):
    return any(abs(a - float(b)) > 1e-6 * float(size) for a, b in zip(said, exact))


def judge_mesh(source, said):
    """None, or what is wrong with a mesh that was made."""
    with open(source) as file:
        text = file.read()
    if "CAROM_SURFACE" in text:
        return None
    points, faces = numbers_of(text, "vertices"), numbers_of(text, "faces")
    sides = [(f[k], f[(k + 1) % 3]) for f in faces for k in range(3)]
    if sorted(sides) != sorted((b, a) for a, b in sides) or len(set(sides)) != len(sides):
        return "a mesh that is not closed"
    quantum = fractions.Fraction(1, 1 << int(re.search(r"quantum_bits = (\d+)", text).group(1)))
    mass = mass_of(points, faces)
    if not mass:
        return "no volume"
    printed = {line.split()[0]: [float(word) for word in line.split("(")[0].split()[1:]]
               for line in said.splitlines() if re.match(r"  (volume|centre|inertia) ", line)}
    volume, centre, inertia = mass[0] * quantum ** 3, [c * quantum for c in mass[1]], [i * quantum ** 2 for i in mass[2]]
    if differ(printed["volume"], [volume], volume):
        return "volume %s, not %.9g" % (printed["volume"], volume)
    if differ(printed["centre"], centre, max(max(map(abs, p)) for p in points) * quantum):
        return "centre %s" % printed["centre"]
    if differ(printed["inertia"], inertia, max(inertia)):
        return "inertia %s, not %s" % (printed["inertia"], [float(i) for i in inertia])
    return None


def convert(converter, folder, name, options):
    """None, or what is wrong; and if a mesh was made."""
    source = os.path.join(folder, "mesh.c")
    try:
        done = subprocess.run([converter, *options, "-o", source, os.path.join(folder, name)], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", timeout=SECONDS,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES)))
    except subprocess.TimeoutExpired:
        return "more than %d s" % SECONDS, False
    if done.returncode not in (0, 1, 2):
        return "status %d: %s" % (done.returncode, done.stderr.strip()[-200:]), False
    if done.returncode:
        wrong = "no named error" if "carom-mesh: " not in done.stderr else "an output in spite of an error" if os.path.exists(source) else None
        return wrong, False
    return judge_mesh(source, done.stdout), True


def one(converter, number):
    name, data, options = make(number)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)
        wrong, made = convert(converter, folder, name, options)
    if wrong:
        print("file %d (%s %s): %s" % (number, name, " ".join(options), wrong), flush=True)
    return bool(wrong), made


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("converter")
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--write", help="write the file with the first number into this folder")
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    if arguments.write:
        name, data, options = make(arguments.first)
        with open(os.path.join(arguments.write, name), "wb") as file:
            file.write(data)
        print(" ".join([name, *options]))
        return 0
    numbers = range(arguments.first, arguments.first + arguments.count)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda number: one(arguments.converter, number), numbers))
    wrong, made = sum(w for w, _ in found), sum(m for _, m in found)
    print("%d files: %d meshes, %d named errors, %d wrong" % (len(found), made, len(found) - made - wrong, wrong))
    if arguments.record:
        evidence.record("meshes", {"files": (len(found), "sum"), "meshes made": (made, "sum"), "wrong": (wrong, "sum")})
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())

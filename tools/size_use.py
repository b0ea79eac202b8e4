#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The cost in code of each use of the engine: Thumb-2 at -Os, linked, without unused sections.

The programs use more and more of the engine; each has the calls of the one before. The engine is compiled for a Cortex-M3, one
section a function, and linked to the calls alone; the linker drops everything that no call reaches. The bytes are code and
constants, including the functions of the compiler's library for the engine (64-bit division), without memcpy and the like, which
belong to the program.

Then come the blocks of memory that a program gives to the engine, with pointers of 32 bits: worlds of the head scene and of heaps,
with the capacities that these need, and built meshes.

out/size_of_use.csv and out/blocks.csv have the tables; tests/size_of_use.csv and tests/blocks.csv have the committed ones. No row
of code may exceed the committed one by more than 1 %, because releases of a compiler differ that much; no block may be larger at
all.
"""
import argparse
import csv
import os
import re
import sys

import gate

CODE, CODE_COLUMNS = "size_of_use.csv", ["use", "bytes", "adds"]
BLOCKS, BLOCKS_COLUMNS = "blocks.csv", ["block", "bytes"]
GROWN = 1.01
FOLDER = "build/size_of_use"
TARGET = ["arm-none-eabi-gcc", "-std=c11", "-mcpu=cortex-m3", "-mthumb", "-Os", "-Iinclude"]
SECTIONS = ["-ffunction-sections", "-fdata-sections"]
LIBRARY = ["memcpy", "memmove", "memset", "memcmp"]

# The uses: what a program does in addition to the one before it, and the functions that it calls
# for that.
USES = [
    ("a world and its step with meshes in ROM", "carom_world_bytes carom_world_init carom_body_add "
     "carom_world_step carom_body_get"),
    ("bodies are looked at and set and leave", "carom_body_look carom_body_mesh carom_body_count "
     "carom_body_remove carom_body_set"),
    ("forces and pushes and other gravity", "carom_world_set_gravity carom_body_set_force "
     "carom_body_push"),
    ("filters that change", "carom_body_set_filter carom_body_get_filter"),
    ("events and contacts and interfering faces", "carom_events carom_event_hit carom_contacts "
     "carom_interfering_faces"),
    ("statistics and texts", "carom_stats carom_usage carom_stage_name carom_result_text "
     "carom_version"),
    ("a hash of the state", "carom_world_hash"),
    ("ids and a pointer of the caller's", "carom_body_id carom_body_number carom_body_user "
     "carom_body_set_user"),
    ("other masses", "carom_body_mass carom_body_set_mass"),
    ("places and directions and velocities", "carom_body_matrix carom_body_world_point "
     "carom_body_local_point carom_body_world_vector carom_body_local_vector "
     "carom_body_velocity_at"),
    ("torque and damping and twists", "carom_body_forces carom_body_set_force_at "
     "carom_body_set_torque carom_body_set_gravity_scale carom_body_set_damping "
     "carom_body_push_centre carom_body_twist"),
    ("materials that change", "carom_body_material carom_body_set_material "
     "carom_body_set_face_materials carom_world_set_combine"),
    ("bodies that are led", "carom_body_move_to"),
    ("joints", "carom_joint_add carom_joint_remove carom_joint_set carom_joint_get "
     "carom_joint_count"),
    ("meshes from vertices and faces", "carom_mesh_bytes carom_mesh_build carom_mesh_check "
     "carom_mesh_read"),
    ("faces of pairs and points inside", "carom_query_faces carom_query_inside"),
    ("rays", "carom_cast_ray carom_cast_ray_all"),
    ("meshes that are cast and overlaps", "carom_cast_mesh carom_overlap_mesh"),
    ("closest points", "carom_closest_points"),
    ("surfaces that move", "carom_surface_build carom_surface_move carom_surface_set"),
    ("snapshots", "carom_snapshot_size carom_snapshot_save carom_snapshot_load"),
    ("drawing", "carom_draw"),
    ("drawing of what changed", "carom_draw_changes"),
    ("picking", "carom_view_ray carom_draw_pick"),
    ("lines and text over pictures", "carom_draw_line carom_draw_text carom_draw_ramp"),
    ("triangles and lines for other renderers", "carom_debug_draw carom_debug_keep_line"),
    ("shapes as meshes", "carom_shape_box carom_shape_sphere carom_shape_capsule "
     "carom_shape_cylinder carom_shape_cone"),
    ("recordings", " ".join(name for _, name in gate.public_functions()
                            if name.startswith("carom_record_"))),
    ("playing recordings", "carom_replay_begin carom_replay_frame carom_replay_call_name "
     "carom_replay_part_name carom_replay_digests"),
]

HEAPS = {"16": "17, 88, 48, 136, 0, 128", "32": "33, 136, 72, 208, 0, 256"}  # tests/host_pools.c
MEMORY = [
    ("a world of the head scene", "CAROM_WORLD_BYTES(2, 1, 64, 1024, 256, 1024)"),
    ("a world of 16 boxes in a heap", "CAROM_WORLD_BYTES(%s)" % HEAPS["16"]),
    ("a world of 32 mixed bodies in a heap", "CAROM_WORLD_BYTES(%s)" % HEAPS["32"]),
    ("a joint in a world", "CAROM_JOINT_BYTES"),
    ("an extra in a world", "CAROM_EXTRA_BYTES"),
    ("and what it adds to a contact", "CAROM_DRIFT_BYTES + CAROM_MIXED_BYTES"),
    ("details of a hit in a world", "CAROM_HIT_BYTES"),
    ("a box as a mesh", "CAROM_MESH_BYTES(8, 12)"),
    ("the head as a mesh", "CAROM_MESH_BYTES(940, 1876)"),
    ("a moving sheet of 800 faces", "CAROM_SURFACE_BYTES(441, 800)"),
    ("a picture of the head scene", "CAROM_DRAW_BYTES(940 + 1596, 1876 + 3034)"),
]


def program(calls):
    """A program that refers to the functions of these names, and does nothing else."""
    path = "%s/calls.c" % FOLDER
    with open(path, "w") as file:
        file.write('#include "carom.h"\n#include "carom_body.h"\n#include "carom_joint.h"\n'
                   '#include "carom_query.h"\n#include "carom_draw.h"\n#include "carom_debug.h"\n'
                   '#include "carom_shapes.h"\n#include "carom_replay.h"\n'
                   "typedef void any(void);\nany *const calls[] = {%s};\n" %
                   ", ".join("(any *)%s" % name for name in calls))
    return path


def collected(objects, calls):
    """Bytes of code and constants that the linker keeps for calls, without their list."""
    image = "%s/use.elf" % FOLDER
    gate.output([*TARGET, *SECTIONS, program(calls), *objects, "-o", image, "-nostdlib",
                 "-Wl,--gc-sections,--entry=0,--undefined=calls,-z,noexecstack",
                 *("-Wl,--defsym=%s=0" % name for name in LIBRARY), "-lgcc"])
    said = gate.output(["arm-none-eabi-readelf", "-SW", image])
    kept = re.findall(r"\] (\S+) +PROGBITS +\S+ \S+ ([0-9a-f]+) \S+ +\w*A", said)
    return sum(int(size, 16) for name, size in kept if name != ".ARM.exidx") - 4 * len(calls)


def blocks():
    """The rows of the blocks: name, bytes."""
    os.makedirs(FOLDER, exist_ok=True)
    path = "%s/blocks" % FOLDER
    with open(path + ".c", "w") as file:
        file.write('#include "carom.h"\n#include "carom_draw.h"\n' + "".join(
            "char block%d[%s];\n" % (i, size) for i, (_, size) in enumerate(MEMORY)))
    gate.output([*TARGET, "-c", path + ".c", "-o", path + ".o"])
    said = gate.output(["arm-none-eabi-nm", "-S", path + ".o"])
    size = {int(number): int(size, 16)
            for size, number in re.findall(r"^\S+ (\S+) \S block(\d+)$", said, re.M)}
    return [[name, size[i]] for i, (name, _) in enumerate(MEMORY)]


def compiled():
    """The engine's objects."""
    os.makedirs(FOLDER, exist_ok=True)
    return [made for _, made in gate.objects("size_of_use", TARGET[0], [*TARGET[2:], *SECTIONS])]


def measure():
    """The rows of the table: use, bytes, and bytes added to the use before it."""
    made = compiled()
    calls, rows, before = [], [], 0
    for use, names in USES:
        calls += names.split()
        size = collected(made, calls)
        rows.append([use, size, size - before])
        before = size
    left_out = {name for _, name in gate.public_functions()} - set(calls)
    if left_out:
        sys.exit("no use calls " + ", ".join(sorted(left_out)))
    return rows


def grown(rows, file_name, allowed):
    """The gate's complaints: rows with more bytes than the committed ones."""
    with open("tests/" + file_name, newline="") as file:
        committed = {row[0]: row[1] for row in csv.reader(file)}
    for name, size, *_ in rows:
        before = committed.get(name)
        if before is None or size > allowed * int(before):
            yield "%s: %d bytes, in tests/%s %s" % (name, size, file_name, before)


def failures(code, memory):
    return [*grown(code, CODE, GROWN), *grown(memory, BLOCKS, 1)]


def write(path, columns, rows):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--baseline", action="store_true", help="write the committed tables")
    arguments = parser.parse_args()

    gate.need("arm")
    code, memory = measure(), blocks()
    print("%-40s %9s %9s" % ("bytes of Thumb-2 at -Os", "in all", "adds"))
    for row in code:
        print("%-40s %9d %9d" % tuple(row))
    print("\n%-40s %9s" % ("bytes of memory", "32-bit"))
    for row in memory:
        print("%-40s %9d" % tuple(row))
    for folder in ["out/"] + ["tests/"] * arguments.baseline:
        write(folder + CODE, CODE_COLUMNS, code)
        write(folder + BLOCKS, BLOCKS_COLUMNS, memory)


if __name__ == "__main__":
    main()

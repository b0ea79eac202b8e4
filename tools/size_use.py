#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""What a program pays for what it uses of the engine: Thumb-2 at -Os, linked and collected.

Programs of growing use, each with the calls of the one before it. The engine is compiled for a
Cortex-M3, a function a section, and linked to calls alone; the linker drops what none of them
reaches. The bytes are code and constants, what the compiler's library adds to the engine (64-bit
division) included; memcpy and its like are the program's own, and are left out.

out/size_of_use.csv has the table. tests/size_of_use.csv has the committed one, and no row may be
larger than it by more than 1 %: other releases of a compiler differ by as much.
"""
import argparse
import csv
import os
import re
import sys

import gate

COMMITTED = "tests/size_of_use.csv"
COLUMNS = ["use", "bytes", "adds"]
GROWN = 1.01
FOLDER = "build/size_of_use"
TARGET = ["arm-none-eabi-gcc", "-std=c11", "-mcpu=cortex-m3", "-mthumb", "-Os", "-Iinclude"]
SECTIONS = ["-ffunction-sections", "-fdata-sections"]
LIBRARY = ["memcpy", "memmove", "memset", "memcmp"]

# What a program does besides the one before it, and the functions that it calls for that.
USES = [
    ("a world and its step, meshes in ROM", "carom_world_init carom_body_add carom_world_step "
     "carom_body_get"),
    ("bodies look, count, leave, are set", "carom_body_look carom_body_mesh carom_body_count "
     "carom_body_remove carom_body_set"),
    ("forces, pushes, other gravity", "carom_world_set_gravity carom_body_set_force "
     "carom_body_push"),
    ("events, contacts, interfering faces", "carom_events carom_contacts carom_interfering_faces"),
    ("statistics, usage, hash, texts", "carom_stats carom_usage carom_stage_name "
     "carom_result_text carom_world_hash"),
    ("meshes from vertices and faces", "carom_mesh_build carom_mesh_check carom_mesh_read"),
    ("queries", "carom_query_faces carom_query_inside"),
    ("surfaces that move", "carom_surface_build carom_surface_move carom_surface_set"),
    ("snapshots", "carom_snapshot_size carom_snapshot_save carom_snapshot_load"),
    ("drawing", "carom_draw"),
    ("drawing of what changed", "carom_draw_changes"),
]


def program(calls):
    """A program that needs the functions of these names, and does nothing else."""
    path = "%s/calls.c" % FOLDER
    with open(path, "w") as file:
        file.write('#include "carom.h"\n#include "carom_draw.h"\n'
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


def measure():
    """The rows of the table: use, bytes, and what it adds to the use before it."""
    made = gate.objects("size_of_use", TARGET[0], [*TARGET[2:], *SECTIONS])
    os.makedirs(FOLDER, exist_ok=True)
    calls, rows, before = [], [], 0
    for use, names in USES:
        calls += names.split()
        size = collected([path for _, path in made], calls)
        rows.append([use, size, size - before])
        before = size
    left_out = {name for _, name in gate.public_functions()} - set(calls)
    if left_out:
        sys.exit("no use calls " + ", ".join(sorted(left_out)))
    return rows


def grown(rows):
    """What the gate complains of: uses that take more than the committed bytes."""
    with open(COMMITTED, newline="") as file:
        committed = {row["use"]: int(row["bytes"]) for row in csv.DictReader(file)}
    for use, size, _ in rows:
        if use not in committed or size > GROWN * committed[use]:
            yield "%s: %d bytes, in %s %s" % (use, size, COMMITTED, committed.get(use, "none"))


def write(path, rows):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


def print_table(rows):
    print("%-40s %9s %9s" % ("bytes of Thumb-2 at -Os", "in all", "adds"))
    for row in rows:
        print("%-40s %9d %9d" % tuple(row))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--baseline", action="store_true", help="write " + COMMITTED)
    parser.add_argument("--gate", action="store_true", help="fail when a use has grown by 1 %%")
    arguments = parser.parse_args()

    gate.need("arm")
    rows = measure()
    print_table(rows)
    write("out/size_of_use.csv", rows)
    if arguments.baseline:
        write(COMMITTED, rows)
    if arguments.gate:
        gate.finish(list(grown(rows)), "no use has grown by more than 1 %")


if __name__ == "__main__":
    main()

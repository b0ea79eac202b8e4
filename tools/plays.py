#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Compare the hashes of a program's scenes with those committed: tools/plays.py PROGRAM [--write]

build/host/matrix.elf prints the plays and build/host/worlds.elf random worlds; tests/plays.csv and tests/worlds.csv have a row for each:
its frames, how many of them end with a body awake, its hash, which covers state, status and events of every frame, and for worlds
what their steps counted. A change of the engine that changes a row commits the new one with its reason. Prints TAP.
"""
import os
import subprocess
import sys

import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COLUMNS = {"plays": "scene,frames,awake,hash", "worlds": "scene,frames,awake,hash,substeps,hits,candidates,roots,sweeps"}


def part_of(program):
    return "worlds" if "worlds" in os.path.basename(program) else "plays"


def columns_of(program):
    """How many words after "scene" a program's line must have as committed."""
    return COLUMNS[part_of(program)].count(",") + 1


def kept_in(part, root=ROOT):
    return os.path.join(root, "tests", part + ".csv")


def kept(part, root=ROOT):
    """The committed rows."""
    return [list(row.values()) for row in results.read(kept_in(part, root))]


def played(program):
    """The rows that a program prints."""
    said = subprocess.run([program], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [line.split()[1:columns_of(program) + 1] for line in said.splitlines() if line.startswith("scene ")]


def main(program, write=None):
    part, found = part_of(program), played(program)
    if write:
        results.write(kept_in(part), COLUMNS[part], found)
        return 0
    expected = {row[0]: row for row in kept(part)}
    failed = 0
    for number, row in enumerate(found, 1):
        was = expected.pop(row[0], None)
        failed += row != was
        print("%s %d - %s/%s" % ("ok" if row == was else "not ok", number, part, row[0]))
        if row != was:
            print("# %s, was %s" % (" ".join(row), was and " ".join(was)))
    for scene in expected:
        print("# %s is in tests/%s.csv and was not played" % (scene, part))
    print("1..%d" % len(found))
    return bool(failed or expected or not found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Compare the hashes of the plays of a build with those committed: tools/plays.py PROGRAM [--write]

PROGRAM is build/host/matrix.elf. tests/plays.csv has a row a play: its frames, how many of them end with a body awake, and its hash,
which covers state, status, events and answers of every frame. A change of the engine that changes a hash commits the new one with its
reason. Prints TAP.
"""
import os
import subprocess
import sys

import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KEPT = os.path.join(ROOT, "tests", "plays.csv")
COLUMNS = "scene,frames,awake,hash"


def played(program):
    """The rows that a program prints."""
    said = subprocess.run([program], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [line.split()[1:5] for line in said.splitlines() if line.startswith("scene ")]


def main(program, write=None):
    found = played(program)
    if write:
        results.write(KEPT, COLUMNS, found)
        return 0
    kept = {row["scene"]: list(row.values()) for row in results.read(KEPT)}
    failed = 0
    for number, row in enumerate(found, 1):
        same = row == kept.pop(row[0], None)
        failed += not same
        print("%s %d - plays/%s" % ("ok" if same else "not ok", number, row[0]))
    for scene in kept:
        print("# %s is in tests/plays.csv and was not played" % scene)
    print("1..%d" % len(found))
    return bool(failed or kept or not found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

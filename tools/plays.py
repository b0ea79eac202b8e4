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


def kept_in(part):
    return os.path.join(ROOT, "tests", part + ".csv")


def played(program, columns):
    """The rows that a program prints."""
    said = subprocess.run([program], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [line.split()[1:columns + 1] for line in said.splitlines() if line.startswith("scene ")]


def main(program, write=None):
    part = "worlds" if "worlds" in os.path.basename(program) else "plays"
    found = played(program, COLUMNS[part].count(",") + 1)
    if write:
        results.write(kept_in(part), COLUMNS[part], found)
        return 0
    kept = {row["scene"]: list(row.values()) for row in results.read(kept_in(part))}
    failed = 0
    for number, row in enumerate(found, 1):
        was = kept.pop(row[0], None)
        failed += row != was
        print("%s %d - %s/%s" % ("ok" if row == was else "not ok", number, part, row[0]))
        if row != was:
            print("# %s, was %s" % (" ".join(row), was and " ".join(was)))
    for scene in kept:
        print("# %s is in tests/%s.csv and was not played" % (scene, part))
    print("1..%d" % len(found))
    return bool(failed or kept or not found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

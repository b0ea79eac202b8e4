#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Change the bytes of snapshots, recordings and blobs (tests/host_bytes.c, host_replay.c): bytes.py [--random 20000] [--seed 1] [--worlds 0,1].

Each world's snapshot has each byte changed to each other value, and so many random changes with the check sum corrected. The
random changes of another seed are others, so the count of changes adds up over time.
"""
import argparse
import re
import subprocess
import sys

import evidence

WORLDS = 9  # of host_bytes.c
BYTES, REPLAY = "build/host/host_bytes.elf", "build/host/host_replay.elf"


def figures(command):
    """The numbers of a program's lines of results, by the name of the test."""
    text = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout
    print(text, end="", flush=True)
    found = re.findall(r"^(?:not )?ok \d+ - (\S+) \((.*)\)$", text, re.MULTILINE)
    return {name: [float(n) for n in re.findall(r"-?[\d.]+", said)] for name, said in found}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--random", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--worlds", default=",".join(map(str, range(WORLDS))), help="numbers of the worlds; none: recordings only")
    parser.add_argument("--only-random", action="store_true", help="leave out each byte and recordings")
    options = parser.parse_args()
    one = [str(options.random)] + ([str(options.seed)] if options.only_random else [])
    found = [figures([BYTES, str(n), str(n + 1), *one]) for n in map(int, re.findall(r"\d+", options.worlds))]
    snapshots = [lines.get("bytes/snapshots", [0, 0, 0, 0, 0, 0, 0, 0, 0, 1]) for lines in found] or [[0] * 10]
    recordings = [] if options.only_random else figures([REPLAY, "long"]).get("replay/hostile", [0, 0, 0, 1])
    total = [sum(column) for column in zip(*snapshots)]
    wrong = total[9] + (recordings[3] if recordings else 0)
    counted = {
        "snapshots, changed": (int(total[0]), "sum"), "snapshots, taken": (int(total[1]), "sum"),
        "steps after them": (int(total[2]), "sum"), "steps that lacked room": (int(total[3]), "sum"),
        "most candidates of a step, a face": (int(max(line[4] for line in snapshots)), "most"),
        "longest step, s": (max(line[5] for line in snapshots), "most"),
        "worlds faster than calls allow, with energy from nothing": (int(total[8]), "sum"),
        "steps with more than 1,024 candidates a face": (int(total[7]), "sum"), "wrong": (int(wrong), "less")}
    if not options.only_random:  # what did not run keeps its date
        if found:
            counted["blobs, changed"] = int(found[0].get("bytes/blobs", [0])[0]), "sum"
        counted["recordings, changed"] = int(sum(recordings[:3])), "sum"
    evidence.record("bytes", counted)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

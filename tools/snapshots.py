#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Save and load a world after every frame of the matrix's scenes (tests/matrix.c, reload=): snapshots.py PROGRAM.

PROGRAM is build/host/matrix.elf. It plays each scene as it is, and with a snapshot after every frame that is loaded into the same
world and then into one made anew, which goes on. All hashes must be equal. --big plays scenes with snapshots on a big-endian
processor, too: the hash of a frame is that of its snapshot's bytes, so equal hashes mean equal snapshots in both byte orders.
"""
import argparse
import os
import sys

import evidence
import gate
import matrix

SCENES = ["head", "pile", "sheet", "door", "walker"]  # what --big plays; the last four are those that the matrix hands over
BIG = "m68k"
# its calls follow from the events of the last step, which a world made anew does not have; loaded in the same world only
BY_EVENTS = ["car"]


def big_build():
    """The program for a big-endian processor."""
    build = matrix.Linux(BIG, "gcc", "-O2")
    gate.need(*build.need)
    matrix.make_meshes(build)
    build.make()
    return [*build.runner, os.path.join(matrix.ROOT, build.elf)]


def results(command, frames, *options):
    """The results of scenes by name."""
    text = matrix.call([*command, "asks=0", "frames=%d" % frames, *options], " ".join(options))
    words = [line.split() for line in text.splitlines()]
    return {line[1]: line[2:] for line in words if line and line[0] == "scene"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--frames", type=int, default=500)
    parser.add_argument("--big", action="store_true")
    parser.add_argument("--record", action="store_true", help="add the figures to tests/evidence.csv")
    options = parser.parse_args()
    matrix.TIMEOUT = 7200
    program = [os.path.abspath(options.program)]
    plain = results(program, options.frames)
    again = results(program, options.frames, "reload=2")
    for scene in BY_EVENTS:
        again.update(results(program, options.frames, "reload=1", "scene=" + scene))
    wrong = sorted(set(plain) ^ set(again)) + [scene for scene in plain if again.get(scene) != plain[scene]]
    count, big_count = len(again), 0
    if options.big:
        command = big_build()
        for scene in SCENES:
            other = results(command, options.frames, "scene=" + scene, "reload=2")
            big_count += 1
            wrong += [] if other[scene] == plain[scene] else ["%s on %s" % (scene, BIG)]
    for scene in wrong:
        print("not ok snapshots/%s: another hash" % scene)
    print("%s snapshots (%d scenes of %d frames, %d of them on a big-endian processor, each frame loaded twice, %d differ)"
          % ("not ok" if wrong or not again else "ok", count, options.frames, big_count, len(wrong)))
    if options.record:
        evidence.record("snapshots", {
            "frames of a scene": (options.frames, "fact"), "scenes, little-endian": (count, "more"),
            "scenes, big-endian": (big_count, "more"), "snapshots loaded": (options.frames * (2 * (count + big_count) - len(BY_EVENTS)), "sum"),
            "scenes that differ": (len(wrong), "less")})
    return 1 if wrong or not again else 0


if __name__ == "__main__":
    sys.exit(main())

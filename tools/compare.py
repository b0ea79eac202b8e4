#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Carom beside the paper's way and other engines: queries, whole steps, heaps of boxes.

usage: compare.py QUERIES HEAPS WASM SCENE=MOVING,STILL ...
      compare.py --short HEAPS

QUERIES is build/tools/carom-compare: the same meshes at the same poses. Callgrind counts instructions; times are the
best of several in one run; figures are means of a phase. Phases: apart, the boxes of the bodies do not overlap; near, they
do but no faces cross; contact, faces cross. out/recall.csv has the part of the crossing face pairs that was found. Carom
and the paper's way find face pairs, FCL pairs and points, ODE and Bullet points. HEAPS is build/tools/carom-heaps,
WASM Carom's heap as WebAssembly (tools/compare_heaps.py). All figures go to out/compare.csv, those that are shown to
docs/compare.csv, docs/compare.md and the table in README.md. With --short one scene's queries are compared with FCL, and one
heap is counted and compared with the committed figures.

It fails if a query of Carom takes more than half of ODE's instructions, misses a crossing pair, or disagrees with FCL on
contact; and if a heap takes more than its bound.
"""
import csv
import os
import sys

import compare_heaps
import compare_table

OUT = "out/compare.csv"
RECALL = "out/recall.csv"
RECALL_COLUMNS = ["scene", "contender", "crossing", "found", "frames", "frames_missed"]
BAR = 0.5  # as a part of ODE's instructions
AIM = 0.7  # as a part of ODE's time


def instructions(program, meshes):
    """{(phase, contender): instructions of a query}."""
    found = compare_heaps.counted([program, "count", *meshes])
    return {(phase, who): total / int(count) for (phase, who, count), total in found.items()}


def timed(program, scene, meshes):
    """What the program says of a scene: frames, times, agreement with FCL, crossing pairs found."""
    said = compare_heaps.run([program, "time", *meshes])
    frames = {row[1]: row[2] for row in said if row[0] == "phase"}
    print("%s: %s" % (scene, ", ".join("%s %s" % (name, n) for name, n in frames.items())))
    return said


def findings(said, scene):
    """The rows of RECALL, and the faults: a pose on which another answer than FCL's was given, a crossing pair missed."""
    recall, wrong = [], []
    for kind, poses, who, *numbers in said:
        if kind == "agreement":
            asked, differ = map(int, numbers)
            print("%s: %s differs from FCL on contact in %d of %d frames (%s)"
                  % (scene, who, differ, asked, poses))
            if differ and who != "paper":
                wrong.append("%s: %s differs from FCL" % (scene, who))
        if kind == "recall" and poses == "free":  # follows the agreement of the same contender
            crossing, found = map(int, numbers)
            print("%s: %s finds %d of %d crossing pairs" % (scene, who, found, crossing))
            recall.append([scene, who, crossing, found, asked, differ])
            if found < crossing and who != "paper":
                wrong.append("%s: %s misses crossing pairs" % (scene, who))
    return recall, wrong


def scene_rows(program, scene, meshes):
    """The figures of the queries, the rows of RECALL, and the faults."""
    said = timed(program, scene, meshes)
    counted = instructions(program, meshes)
    rows = [[scene, phase, contender, round(counted[phase, contender]), float(time)]
            for kind, phase, contender, time in [row for row in said if len(row) == 4]
            if kind == "microseconds"]
    return (rows, *findings(said, scene))


def ratios(rows):
    """Print the cost of every contender over Carom's; returns those that miss the bar."""
    costs = {(scene, phase, who): (count, time) for scene, phase, who, count, time in rows}
    wrong = []
    for (scene, phase, who), (count, time) in costs.items():
        carom = costs[scene, phase, "carom"]
        print("%-8s %-8s %-7s %9d instructions %9.2f us   carom's part of it %.2g %.2g"
              % (scene, phase, who, count, time, carom[0] / count, carom[1] / time))
        if who == "ode" and phase != "apart":
            if carom[0] > BAR * count:
                wrong.append("%s, %s: more than %.2f of ODE's instructions" % (scene, phase, BAR))
            if carom[1] > AIM * time:
                print("%s, %s: more than %.2f of ODE's time" % (scene, phase, AIM))
    return wrong


def write(path, columns, rows):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([columns] + rows)
    print("%d rows in %s" % (len(rows), path))


def query_figures(rows):
    """Return the figures in the common form."""
    for scene, phase, who, count, time in rows:
        yield ["query", scene, phase, who, count, compare_heaps.UNIT]
        yield ["query", scene, phase, who, time, "us"]


def queries(program, scenes):
    """The figures of all queries, and the faults."""
    rows, recall, wrong = [], [], []
    for each in scenes:
        scene, meshes = each.split("=")
        for whole, part in zip([rows, recall, wrong],
                               scene_rows(program, scene, meshes.split(","))):
            whole += part
    wrong += ratios(rows)
    write(RECALL, RECALL_COLUMNS, recall)
    return list(query_figures(rows)), wrong


def verdict(wrong):
    for text in wrong:
        print("not met: " + text)
    return 1 if wrong else 0


def short(program, heaps, each):
    scene, meshes = each.split("=")
    _, wrong = findings(timed(program, scene, meshes.split(",")), scene)
    return verdict(wrong + compare_heaps.complaints(compare_heaps.short(heaps), compare_table.read()))


def main(program, heaps, image, *scenes):
    figures, wrong = queries(program, scenes)
    figures += compare_heaps.long(heaps) + compare_heaps.wasm(heaps, image)
    write(OUT, compare_table.COLUMNS, figures)
    wrong += compare_heaps.complaints(figures, [])
    # times of queries differ from run to run, and bodies that are apart tell nothing
    shown = [row for row in figures if row[-1] != "us" and row[2] != "apart"]
    compare_table.write(shown)
    print(compare_table.table(compare_table.read(), False), end="")
    return verdict(wrong)


if __name__ == "__main__":
    sys.exit(short(*sys.argv[2:]) if sys.argv[1:2] == ["--short"] else main(*sys.argv[1:]))

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Carom beside the paper's way and Debian's ODE, Bullet and FCL: same meshes, same poses.

usage: compare.py PROGRAM SCENE=MOVING,STILL ...

Every query of build/tools/carom-compare: instructions are counted by callgrind, times are the best
of several in one run; means of a phase go to out/compare.csv. Phases: apart, the boxes of the
bodies do not overlap; near, they do but no faces cross; contact, faces cross. How many of the
crossing face pairs are found goes to out/recall.csv. Carom and the paper's way find face pairs, FCL
pairs and points, ODE and Bullet points. Fails when Carom takes more than half of ODE's
instructions, misses a crossing pair, or finds contact where FCL does not, or the other way.
"""
import csv
import glob
import os
import re
import subprocess
import sys
import tempfile

OUT = "out/compare.csv"
COLUMNS = ["scene", "phase", "contender", "instructions", "microseconds"]
RECALL = "out/recall.csv"
RECALL_COLUMNS = ["scene", "contender", "crossing", "found", "frames", "frames_missed"]
BAR = 0.5  # of ODE's instructions
AIM = 0.7  # of its time
TIMEOUT = 1800  # seconds a run


def run(command, **others):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                          timeout=TIMEOUT, **others)
    if done.returncode:
        sys.exit("%s: status %d" % (" ".join(command), done.returncode))
    return [line.split(",") for line in done.stdout.splitlines()]


def instructions(program, meshes):
    """{(phase, contender): instructions of a query}, by callgrind."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        run(["valgrind", "--quiet", "--tool=callgrind", "--collect-atstart=no",
             "--callgrind-out-file=%s/out" % folder, program, "count", *meshes],
            # else the first call of a function includes the linker's search for it
            env=dict(os.environ, LD_BIND_NOW="1"))
        for path in glob.glob(folder + "/out.*"):
            with open(path) as file:
                text = file.read()
            label = re.search(r"^desc: Trigger: Client Request: (\w+),(\w+),(\d+)$", text, re.M)
            if label:
                total = re.search(r"^totals: (\d+)$", text, re.M)
                found[label[1], label[2]] = int(total[1]) / int(label[3])
    return found


def scene_rows(program, scene, meshes):
    """The rows of OUT and RECALL, and what is wrong."""
    said = run([program, "time", *meshes])
    counted = instructions(program, meshes)
    frames = {row[1]: row[2] for row in said if row[0] == "phase"}
    print("%s: %s" % (scene, ", ".join("%s %s" % (name, n) for name, n in frames.items())))
    wrong = []
    rows = [[scene, phase, contender, round(counted[phase, contender]), float(time)]
            for kind, phase, contender, time in [row for row in said if len(row) == 4]
            if kind == "microseconds"]
    recall = []
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
    return rows, recall, wrong


def ratios(rows):
    """Print every contender's cost by Carom's; returns what misses the bar."""
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


def main(program, *scenes):
    rows, recall, wrong = [], [], []
    for each in scenes:
        scene, meshes = each.split("=")
        for whole, part in zip([rows, recall, wrong],
                               scene_rows(program, scene, meshes.split(","))):
            whole += part
    wrong += ratios(rows)
    write(OUT, COLUMNS, rows)
    write(RECALL, RECALL_COLUMNS, recall)
    for text in wrong:
        print("not met: " + text)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Instructions by stage of the scenes of tests/bench_scenes.csv, on a board that counts them.

Every scene must end in its committed state, on the host and on the board, before its figures are
used. They go to out/bench.csv (scene, phase, stage, mean, max of a frame); rows of scenes that do
not run stay there. Phases: apart, the broad boxes of no two bodies overlap; near, they do but
nothing touches; contact, bodies touch; asleep, all of them; all. Beside the stages: total;
draw-WxH of the frames that are drawn; whole, total and the larger picture of the same frame;
candidates, pairs of features handed to the collision test.
"""
import argparse
import csv
import os
import subprocess
import sys

import run_board

BOARD = "mps2-an385"
OUT = "out/bench.csv"
BASELINE = "tests/bench_baseline.csv"
SCENES = "tests/bench_scenes.csv"
PHASES = ["apart", "near", "contact", "asleep", "all"]
DISPLAY = "draw-512x512"
TIMEOUT = 900  # seconds a run

# scene, phase, stage, mean or worst, at most
BARS = [
    ("head", "near", "total", "mean", 110000),
    ("head", "contact", "total", "mean", 267000),
    ("head", "all", "total", "worst", 800000),
    ("head", "contact", "draw-320x240", "mean", 1300000),
    ("head", "contact", "draw-512x512", "mean", 2200000),
    ("head", "contact", "whole", "mean", 2600000),
]


def run(board, scene, frames, options):
    """The columns and rows that a scene prints, and its last state."""
    command = run_board.command("build/%s/bench.elf" % board,
                                ["scene=" + scene, "frames=" + frames] + options.split())
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          text=True, timeout=TIMEOUT)
    words = [line.partition(" ") for line in done.stdout.splitlines()]
    said = {word: rest for word, _, rest in words}
    if done.returncode or "hash" not in said:
        sys.exit("%s on %s: status %d\n%s" % (scene, board, done.returncode, done.stdout[-500:]))
    columns = said["columns"].split(",")
    rows = [dict(zip(columns, rest.split(","))) for word, _, rest in words if word == "frame"]
    return [{name: text if name == "phase" else int(text) for name, text in row.items()}
            for row in rows], said["hash"]


def measure(entry):
    """The rows of an entry of SCENES, from the board; the state must be as committed."""
    scene = entry["scene"]
    for board in ["host", BOARD]:
        options = entry["options"] if board == BOARD else \
            " ".join(o for o in entry["options"].split() if not o.startswith("draw="))
        rows, state = run(board, scene, entry["frames"], options)
        if state != entry["hash"]:
            sys.exit("%s: the last state of %s on %s is %s; %s has %s. No figures."
                     % (scene, entry["frames"], board, state, SCENES, entry["hash"] or "none"))
    for row in rows:
        if DISPLAY in row:
            row["whole"] = row["total"] + row[DISPLAY]
    return rows


def summary(label, rows):
    """(scene, phase, stage): (frames, mean, worst)."""
    found = {}
    for phase in PHASES:
        chosen = [row for row in rows if phase in ("all", row["phase"])]
        stages = dict.fromkeys(name for row in chosen for name in row if name != "phase")
        for stage in stages:
            values = [row[stage] for row in chosen if stage in row]
            found[label, phase, stage] = len(values), sum(values) / len(values), max(values)
    return found


def read_csv(path):
    """(scene, phase, stage): (mean, worst), in order; nothing when there is no such file."""
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        return {(row["scene"], row["phase"], row["stage"]):
                (int(row["instructions_mean"]), int(row["instructions_max"]))
                for row in csv.DictReader(file)}


def write_csv(path, found):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "phase", "stage", "instructions_mean", "instructions_max"])
        for key, (mean, worst) in found.items():
            writer.writerow([*key, mean, worst])


def merged(old, new):
    """The new figures in place of all old ones of the same scenes."""
    scenes = {key[0] for key in new}
    return {**{key: value for key, value in old.items() if key[0] not in scenes}, **new}


def change(now, before):
    return "%+.1f %%" % (100 * (now - before) / before) if before else "new"


def print_totals(found, baseline):
    print("\n%-16s %-8s %7s %10s %9s %10s %9s"
          % ("instructions", "phase", "frames", "mean", "change", "worst", "change"))
    for (scene, phase, stage), (frames, mean, worst) in found.items():
        if stage == "total" or stage == "whole" or stage.startswith("draw-"):
            before = baseline.get((scene, phase, stage), (0, 0))
            print("%-16s %-8s %7d %10d %9s %10d %9s   %s" % (
                scene, phase, frames, round(mean), change(round(mean), before[0]), worst,
                change(worst, before[1]), "" if stage == "total" else stage))


def print_bars(figures):
    print("\n%-44s %10s %10s" % ("bar", "limit", "measured"))
    for scene, phase, stage, which, limit in BARS:
        if (scene, phase, stage) in figures:
            value = figures[scene, phase, stage][which == "worst"]
            print("%-44s %10d %10d  %s" % ("%s %s %s, %s" % (scene, phase, stage, which), limit,
                                           value, "ok" if value <= limit else "over"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", default="", help="labels, with commas; all when empty")
    parser.add_argument("--baseline", action="store_true", help="write the committed baseline")
    arguments = parser.parse_args()
    os.chdir(run_board.ROOT)
    with open(SCENES, newline="") as file:
        entries = list(csv.DictReader(file))
    wanted = arguments.scenes.split(",") if arguments.scenes else [e["label"] for e in entries]

    found = {}
    for label in dict.fromkeys(e["label"] for e in entries if e["label"] in wanted):
        print(label, flush=True)
        rows = []
        for entry in entries:
            if entry["label"] == label:
                rows += measure(entry)
        found.update(summary(label, rows))
    figures = {key: (round(mean), worst) for key, (_, mean, worst) in found.items()}
    baseline = read_csv(BASELINE)
    write_csv(OUT, merged(read_csv(OUT), figures))
    if arguments.baseline:
        write_csv(BASELINE, merged(baseline, figures))
    print_totals(found, baseline)
    print_bars(figures)


if __name__ == "__main__":
    main()

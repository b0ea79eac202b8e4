#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Instructions by stage of the scenes of tests/bench_scenes.csv, on a board that counts them.

Every scene must end in its committed state, on the host and on the board, before its figures are used. The figures go
to out/bench.csv (scene, phase, stage; mean, median, 99th percentile and worst frame); rows of scenes that do not run
stay there. A label may have many throws of one body: one trajectory is one chaotic sample, and its worst frame says
little.

Phases: apart, no two broad boxes overlap; near, some do but nothing touches; contact, bodies touch; asleep, all
bodies sleep; all. There are four more rows besides the stages: total; draw-WxH, for the drawn frames; whole, the sum
of total and the larger picture of the same frame; candidates, the number of feature pairs handed to the collision
test.

With the label paper the images use the paper's interference detection. It may miss contacts, so its state is not the
committed one: host and board must only agree.
"""
import argparse
import collections
import csv
import os
import re
import sys

import gate
import run_board
import size_use

OUT = "out/bench.csv"
BARS_OUT = "out/bench_bars.csv"
BASELINE = "tests/bench_baseline.csv"
SCENES = "tests/bench_scenes.csv"
PHASES = ["apart", "near", "contact", "asleep", "all"]
DISPLAY = "draw-512x512"

Cost = collections.namedtuple("Cost", "mean p50 p99 worst")

# scene, phase, stage, statistic of Cost, upper bound
BARS = [
    ("head", "near", "total", "mean", 110000),
    ("head", "contact", "total", "mean", 267000),
    ("head-throws", "all", "total", "p99", 450000),
    ("head-throws", "all", "total", "worst", 800000),
    ("head-spin", "all", "total", "worst", 1200000),
    ("head450", "contact", "total", "mean", 150000),
    ("head836", "contact", "total", "mean", 180000),
    ("apart", "apart", "total", "worst", 3000),
    ("head", "asleep", "total", "worst", 500),
    ("asleep", "asleep", "total", "worst", 500),
    ("flight32", "all", "total", "mean", 300000),
    ("pile32", "all", "total", "mean", 3500000),
    ("boxes10", "all", "total", "mean", 300000),
    ("stack10", "all", "total", "mean", 400000),
    ("head", "contact", "draw-320x240", "mean", 1300000),
    ("head", "contact", "draw-512x512", "mean", 2200000),
    ("head", "contact", "whole", "mean", 2600000),
]
GROWTH = "growth-512", "growth-49928", 5  # the second may cost at most so many times the first, in
                                          # contact
RAM = 16384  # a world that just holds the head scene, plus the stack
# bytes of code at -Os: a program that builds meshes and makes steps; and everything except drawing
CODE_STEP = "carom_mesh_build carom_world_init carom_body_add carom_world_step carom_body_get"
CODE = {"build + step": 60 * 1024, "all but drawing": 75 * 1024}
BLOCKS = {"a world of 16 boxes in a heap": 40 * 1024,
          "a world of 32 mixed bodies in a heap": 80 * 1024, "a box as a mesh": 2 * 1024}
GROWN = 1.01  # the gate: a frame may cost so many times the committed one

# The paper's table: seconds a frame, on a machine with so many instructions a second
PAPER = {"head": 0.24, "head450": 0.35, "espresso": 0.53}
PAPER_RATE = 16e6
PAPER_LABEL = "paper"  # the paper's interference detection in place of Carom's
PAPER_SCENES = [*PAPER, "growth-512", "growth-3034", "growth-12012"]  # a larger mesh does not fit
PAPER_FRAMES = 200  # covers the first impacts; a frame takes about 40 million instructions


def options_of(entry, *without):
    every = ["scene=" + entry["scene"], "frames=" + entry["frames"]] + entry["options"].split()
    return [option for option in every if not option.startswith(without)]


def paper_entry(entry):
    """A few frames of a scene, all of them drawn, without a committed state."""
    options = [o for o in entry["options"].split() if not o.startswith("draw=")] + ["draw=1"]
    return {**entry, "frames": str(min(PAPER_FRAMES, int(entry["frames"]))),
            "options": " ".join(options), "hash": None}


def measure(entry, host, board):
    """The rows of an entry of SCENES, from the board; its state must be the committed one, if one is
    committed."""
    expected, source = entry["hash"], SCENES
    for image, options in [(host, options_of(entry, "draw=")), (board, options_of(entry, "-"))]:
        result = run_board.run(image, options)
        found = result.said.get("hash")
        if result.status or not found:
            sys.exit("%s: %s ended with status %d\n%s" % (entry["scene"], image, result.status,
                                                         result.text[-300:]))
        if expected is None:
            expected, source = found, image
        if found != expected:
            sys.exit("%s: the state after %s frames of %s is %s; %s has %s. No figures."
                     % (entry["scene"], entry["frames"], image, found, source,
                        expected or "none"))
    if entry["hash"] is None:
        print("  %s: host and board agree on %s after %s frames; it is not compared with Carom's"
              % (entry["scene"], expected, entry["frames"]))
    for row in result.rows:
        if DISPLAY in row:
            row["whole"] = row["total"] + row[DISPLAY]
    return result.rows


def cost(values):
    """The statistics of `values`, one value a frame. A percentile is the figure of a frame, not one between
    two frames."""
    ordered = sorted(values)
    return Cost(round(sum(ordered) / len(ordered)), ordered[len(ordered) // 2],
                ordered[len(ordered) * 99 // 100], ordered[-1])


def summary(label, rows):
    """(scene, phase, stage): (frames, Cost)."""
    found = {}
    for phase in PHASES:
        chosen = [row for row in rows if phase in ("all", row["phase"])]
        stages = dict.fromkeys(name for row in chosen for name in row if name != "phase")
        for stage in stages:
            values = [row[stage] for row in chosen if stage in row]
            found[label, phase, stage] = len(values), cost(values)
    return found


COLUMNS = ["instructions_" + which for which in Cost._fields]


def read_csv(path):
    """(scene, phase, stage): Cost, in order; empty if there is no such file, or an old one."""
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        rows = csv.DictReader(file)
        if not set(COLUMNS) <= set(rows.fieldnames):
            return {}
        return {(row["scene"], row["phase"], row["stage"]):
                Cost(*[int(row[column]) for column in COLUMNS]) for row in rows}


def write_csv(path, found):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "phase", "stage", *COLUMNS])
        for key, figures in found.items():
            writer.writerow([*key, *figures])


def merged(old, new):
    """Replace all old figures of the scenes that ran."""
    scenes = {key[0] for key in new}
    return {**{key: value for key, value in old.items() if key[0] not in scenes}, **new}


def change(now, before):
    return "%+.1f %%" % (100 * (now - before) / before) if before else "new"


def print_totals(found, baseline):
    print("\n%-16s %-8s %-13s %6s" % ("instructions", "phase", "", "frames"),
          *["%10s %9s" % (which, "change") for which in Cost._fields])
    for (scene, phase, stage), (frames, now) in found.items():
        if stage == "total" or phase == "all" and (stage == "whole" or stage.startswith("draw-")):
            before = baseline.get((scene, phase, stage), Cost(0, 0, 0, 0))
            print("%-16s %-8s %-13s %6d" % (scene, phase, stage, frames),
                  *["%10d %9s" % (n, change(n, b)) for n, b in zip(now, before)])


def print_paper(figures):
    names = [(scene, scene + suffix) for suffix in ["", "-" + PAPER_LABEL] for scene in PAPER]
    measured = [pair for pair in names if (pair[1], "contact", "whole") in figures]
    if measured:
        print("\n%-16s %12s %14s %14s"
              % ("in contact, drawn", "paper, s", "instructions", "here, whole"))
    for scene, name in measured:
        print("%-16s %13.2f %14d %14d" % (name, PAPER[scene], PAPER[scene] * PAPER_RATE,
                                          figures[name, "contact", "whole"].mean))


def head_ram(entry, host, room):
    """Bytes and pools of the smallest world that takes the head scene to the same state. The rest of its room
    holds candidates, and the faces of a gather that keeps that many."""
    def caps(contacts, faces, candidates):
        return "2,1,%d,%d,0,%d" % (contacts, faces, candidates)

    def world(*pools):
        result = run_board.run(host, options_of(entry, "draw=") + ["caps=" + caps(*pools)])
        same = result.status == 0 and result.said.get("hash") == entry["hash"]
        return int(result.said["world"]) if same else None

    def least(fits, most):
        low, high = 0, most  # `low` is too small, `high` is enough
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if fits(middle) else (middle, high)
        return high

    def pools(candidates):
        return contacts, least(lambda n: world(contacts, n, candidates), 1024), candidates

    contacts = least(lambda n: world(n, 1024, 1), 64)
    most = least(lambda n: world(*pools(n)) > room, 1024) - 1
    kept = pools(max(1, most))
    return world(*kept), caps(*kept)


def deepest_stack():
    said = gate.output(["tools/check_stack"])
    return int(re.search(r"^pass: .* (\d+) bytes of stack", said, re.M).group(1))


def memory_bars(entries, host, board):
    """(bar, limit, measured) of RAM, and the cost of a frame in that little RAM."""
    entry = next(e for e in entries if e["scene"] == "head")
    stack = deepest_stack()
    block, caps = head_ram(entry, host, RAM - stack)
    yield "head, world of %s: %d bytes, and stack: %d" % (caps, block, stack), RAM, block + stack
    rows = run_board.run(board, options_of(entry, "draw=") + ["caps=" + caps]).rows
    totals = [row["total"] for row in rows]
    yield "head in that world, mean", None, round(sum(totals) / len(totals))
    yield "head in that world, worst", None, max(totals)
    for name, size in size_use.blocks():
        yield name, BLOCKS.get(name), size


def code_bars():
    """(bar, limit, measured) of code: the part of the engine that a linker keeps."""
    uses = {name: size for name, size, _ in size_use.measure()}
    step = size_use.collected(size_use.compiled(), CODE_STEP.split())
    yield "code of build + step, -Os", CODE["build + step"], step
    yield "code of all but drawing, -Os", CODE["all but drawing"], uses["snapshots"]
    yield "code with drawing, -Os", None, uses["drawing of what changed"]


def cost_bars(figures):
    """(bar, limit, measured) of instructions."""
    for scene, phase, stage, which, limit in BARS:
        if (scene, phase, stage) in figures:
            value = getattr(figures[scene, phase, stage], which)
            yield "%s %s %s, %s" % (scene, phase, stage, which), limit, value
    first, last = [figures.get((scene, "contact", "total")) for scene in GROWTH[:2]]
    if first and last:
        yield "%s by %s, contact, mean" % (GROWTH[1], GROWTH[0]), GROWTH[2], \
            round(last.mean / first.mean, 2)


def print_bars(bars):
    print("\n%-60s %8s %9s" % ("bar", "limit", "measured"))
    with open(BARS_OUT, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["bar", "limit", "measured", "ok"])
        for name, limit, value in bars:
            verdict = "" if limit is None else "ok" if value <= limit else "over"
            print("%-60s %8s %9s  %s" % (name, limit or "", value, verdict))
            writer.writerow([name, limit or "", value, verdict])


def grown(figures, baseline):
    """The gate's complaints: scenes whose frames cost more than the committed ones."""
    for key, now in figures.items():
        if key[1] == "all" and (key[2] == "total" or key[2].startswith("draw-")):
            before = baseline.get(key)
            for which, value in now._asdict().items():
                limit = getattr(before, which) if before else -1
                if value > GROWN * limit:
                    yield "%s %s, %s: %d instructions; %s has %s" % (
                        key[0], key[2], which, value, BASELINE, limit if before else "none")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("host", help="tests/bench.c for the host")
    parser.add_argument("board", help="and for a board that counts instructions")
    parser.add_argument("--scenes", help="labels of %s, with commas, and no bars of size; else all" % SCENES)
    parser.add_argument("--label", default="", help="what is measured: scenes become NAME-LABEL")
    parser.add_argument("--baseline", action="store_true", help="write " + BASELINE)
    parser.add_argument("--gate", action="store_true",
                        help="only fail when mean, median, 99th percentile or worst frame have"
                        " grown by more than 1 %%, or code or blocks have grown")
    arguments = parser.parse_args()
    with open(SCENES, newline="") as file:
        entries = list(csv.DictReader(file))
    labels = dict.fromkeys(entry["label"] for entry in entries)
    paper = arguments.label == PAPER_LABEL
    wanted = arguments.scenes.split(",") if arguments.scenes else \
        PAPER_SCENES if paper else labels
    if not set(wanted) <= set(labels):
        sys.exit("scenes are: " + ",".join(labels))

    found = {}
    for label in wanted:
        print(label, flush=True)
        rows = []
        for entry in entries:
            if entry["label"] == label:
                rows += measure(paper_entry(entry) if paper else entry, arguments.host,
                                arguments.board)
        name = "-".join(filter(None, [label, arguments.label]))
        found.update(summary(name, rows))
    figures = {key: figure for key, (_, figure) in found.items()}
    baseline = read_csv(BASELINE)
    write_csv(OUT, merged(read_csv(OUT), figures))
    if arguments.baseline:
        write_csv(BASELINE, merged(baseline, figures))
    print_totals(found, baseline)
    if arguments.gate:
        gate.finish([*grown(figures, baseline),
                     *size_use.failures(size_use.measure(), size_use.blocks())],
                    "no frames or code have grown by more than 1 %, and no block")
    print_paper(figures)
    if not paper:
        sizes = [] if arguments.scenes else \
            [*code_bars(), *memory_bars(entries, arguments.host, arguments.board)]
        print_bars([*cost_bars(figures), *sizes])


if __name__ == "__main__":
    main()

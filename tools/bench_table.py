#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The figures of instructions, code and blocks in docs/measured.md and README.md: tools/bench_table.py [--write]

They come from what `make bench` and `make size` committed: tests/bench_baseline.csv, size_of_use.csv and blocks.csv. Without
--write the pages are compared.
"""
import os
import sys

import bench
import claims
import marked
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE, README = "docs/measured.md", "README.md"
USES, BLOCKS = "tests/size_of_use.csv", "tests/blocks.csv"
# the uses that README.md shows, with its words for them
NAMED = {"a world and its step with meshes in ROM": "a program that takes steps, with its meshes in ROM",
         "meshes from vertices and faces": "one with joints that builds its meshes at run time",
         "snapshots": "everything but drawing", "drawing of what changed": "everything with drawing"}
NAMES = {"p50": "median", "p99": "99th percentile"}
STATISTICS = ["mean", "p50", "p99", "worst"]


def bars(figures):
    yield "| scene | frames | what | bar | measured | |"
    yield "|---|---|---|---|---|---|"
    for (scene, phase, stage, which, limit), (_, _, value) in zip(bench.BARS, bench.cost_bars(figures)):
        what = {"total": "step", "whole": "step and picture"}.get(stage, stage.replace("draw-", "picture, "))
        yield "| `%s` | %s | %s, %s | %s | %s | %s |" % (
            scene, phase, what, NAMES.get(which, which), f"{limit:,}", f"{value:,}", "holds" if value <= limit else "missed")
    *_, (name, limit, value) = bench.cost_bars(figures)
    yield "| `%s` | contact | step, mean, against `%s` | %s times | %s times | %s |" % (
        *reversed(bench.GROWTH[:2]), limit, value, "holds" if value <= limit else "missed")


def scenes(figures):
    yield "| scene | mean | median | 99th percentile | worst |"
    yield "|---|---|---|---|---|"
    for (scene, phase, stage), cost in figures.items():
        if (phase, stage) == ("all", "total"):
            yield "| `%s` | %s |" % (scene, " | ".join(f"{getattr(cost, which):,}" for which in STATISTICS))


def sizes(path, name, limits):
    yield "| %s | bytes | wanted |" % name
    yield "|---|---|---|"
    for row in results.read(path):
        yield "| %s | %s | %s |" % (row[name], f"{int(row['bytes']):,}", f"{limits[row[name]]:,}" if row[name] in limits else "")


def code():
    kept = {row["use"]: int(row["bytes"]) for row in results.read(USES)}
    yield "Code of the engine, Thumb-2 at -Os, as a program links it: %s." % "; ".join(
        "%d KB for %s" % (round(kept[use] / 1024), words) for use, words in NAMED.items())


def main(arguments):
    os.chdir(ROOT)
    figures = bench.read_csv(bench.BASELINE)
    made = {PAGE: {"bars": bars(figures), "frames": scenes(figures), "uses": sizes(USES, "use", {"snapshots": bench.CODE["all but drawing"]}),
                   "blocks": sizes(BLOCKS, "block", bench.BLOCKS)}, README: {"code": code()}}
    for path, parts in made.items():
        with open(path) as file:
            before = after = file.read()
        for name, lines in parts.items():
            after = marked.put(after, name, lines)
        if arguments == ["--write"]:
            with open(path, "w") as file:
                file.write(after)
        elif after != before:
            sys.exit("%s shows other figures than those committed in tests/: tools/bench_table.py --write" % path)
    if arguments == ["--write"]:
        claims.write()
    print("pass: %s show the figures committed in tests/" % " and ".join(made))


if __name__ == "__main__":
    main(sys.argv[1:])

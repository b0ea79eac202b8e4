#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The tables of docs/measured.md that speak of instructions: tools/bench_table.py [--write]

They come from the committed figures of `make bench`, tests/bench_baseline.csv. Without --write the page is compared.
"""
import os
import sys

import bench
import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "measured.md")
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


def main(arguments):
    os.chdir(ROOT)
    figures = bench.read_csv(bench.BASELINE)
    with open(PAGE) as file:
        before = after = file.read()
    for name, rows in ("bars", bars(figures)), ("frames", scenes(figures)):
        after = marked.put(after, name, rows)
    if arguments == ["--write"]:
        with open(PAGE, "w") as file:
            file.write(after)
    elif after != before:
        sys.exit("docs/measured.md shows other figures than tests/bench_baseline.csv: tools/bench_table.py --write")
    print("pass: docs/measured.md shows the figures of tests/bench_baseline.csv")


if __name__ == "__main__":
    main(sys.argv[1:])

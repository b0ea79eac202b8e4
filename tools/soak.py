#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run random worlds by number and put what came of them together: tools/soak.py PROGRAM.

PROGRAM is build/host/host_soak.elf. Every world is a row of out/soak.csv; the summary is printed and,
with --docs, written into docs/soak.md between its two comments. A world that ends the program, or that
takes longer than it may, is a row of its own: the others are run without it. A line a failing world
says how to run it alone, frame by frame. The exit status is 1 when anything is not as it should be.
"""
import argparse
import concurrent.futures
import csv
import os
import subprocess
import sys
import threading
import time

import gate

OUT, DOCS = "out/soak.csv", "docs/soak.md"
BEGIN, END = "<!-- soak -->\n", "<!-- end of soak -->\n"
CHUNK = 20  # worlds a process
SECONDS = 150  # for a world, in which its steps may take 60
CUT_ALLOWED = 0.01  # of all frames
FAULTS = ["crosses", "error", "stands still", "cut short", "energy", "momentum", "slow step",
          "much work"]
LOST = "lost"  # the program ended, or did not


def lines_of(command):
    """The whole lines that a program prints until it ends, or takes too long for one; and its end."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    lines, late = [], False

    def stop():
        nonlocal late
        late = True
        process.kill()

    while True:
        clock = threading.Timer(SECONDS, stop)
        clock.start()
        line = process.stdout.readline()
        clock.cancel()
        if not line.endswith("\n"):
            break
        lines.append(line)
    status = process.wait()
    return lines, "more than %d s" % SECONDS if late else "status %d" % status


def rows_of(program, first, count):
    """The rows of some worlds, in their order."""
    found = []
    while count > 0:
        lines, end = lines_of([program, "rows", str(first), str(count)])
        made = list(csv.DictReader(lines))
        found += made
        first, count = first + len(made), count - len(made)
        if count > 0:
            found.append({"seed": str(first), "frames": "0", "faults": LOST, "error": end})
            first, count = first + 1, count - 1
    return found


def run(program, first, count, jobs):
    """All rows; chunks go to whoever is free."""
    starts = list(range(first, first + count, CHUNK))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        parts = pool.map(lambda start: rows_of(program, start, min(CHUNK, first + count - start)),
                         starts)
        return [row for part in parts for row in part]


def number(row, column):
    return float(row.get(column) or 0)


def has(row, fault):
    return fault in row["faults"].split("; ")


def most(rows, column):
    return max(rows, key=lambda row: number(row, column))


def summary(rows, wall):
    """Columns of the table, and their cells."""
    frames = sum(number(row, "frames") for row in rows)
    cut = sum(number(row, "cut") for row in rows)
    slowest = most(rows, "step_seconds")

    def count(fault):
        return "%d" % sum(has(row, fault) for row in rows)

    return [
        ("worlds", "%d" % len(rows)),
        ("frames", "%d" % frames),
        ("crossings", count("crosses")),
        ("deepest, skins", "%.2g" % number(most(rows, "skins"), "skins")),
        ("errors", count("error")),
        ("lost", count(LOST)),
        ("stand still", count("stands still")),
        ("cut frames", "%.2f %%" % (100 * cut / max(frames, 1))),
        ("energy", count("energy")),
        ("momentum", count("momentum")),
        ("slow steps", count("slow step")),
        ("worst step", "%.2g s (%s)" % (number(slowest, "step_seconds"), slowest["seed"])),
        ("most candidates a step", "%d" % number(most(rows, "candidates"), "candidates")),
        ("wall", "%d s" % wall),
    ]


def write_csv(rows):
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", newline="") as file:
        writer = csv.DictWriter(file, max(rows, key=len).keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def write_docs(table, rows):
    """The summary, the kinds of worlds that fail, and the first numbers of each fault."""
    with open(DOCS) as file:
        text = file.read()
    head, rest = text.split(BEGIN)
    lines = ["| " + " | ".join(cell[i] for cell in table) + " |" for i in range(2)]
    lines.insert(1, "|---" * len(table) + "|")
    lines += ["", "| fault | worlds | the first of them |", "|---|---|---|"]
    for fault in FAULTS + [LOST]:
        seeds = [row["seed"] for row in rows if has(row, fault)]
        lines.append("| %s | %d | %s |" % (fault, len(seeds), ", ".join(seeds[:12])))
    with open(DOCS, "w") as file:
        file.write(head + BEGIN + "\n".join(lines) + "\n" + END + rest.split(END)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=1, help="number of the first world")
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--docs", action="store_true", help="write the summary into " + DOCS)
    arguments = parser.parse_args()
    os.chdir(gate.ROOT)
    start = time.monotonic()
    rows = run(arguments.program, arguments.first, arguments.count, arguments.jobs)
    table = summary(rows, time.monotonic() - start)
    write_csv(rows)
    if arguments.docs:
        write_docs(table, rows)
    # frames cut short are counted over all worlds: one of them alone is no failure
    failing = [row for row in rows if set(row["faults"].split("; ")) - {"", "cut short"}]
    for row in failing:
        print("%s %s: %s" % (arguments.program, row["seed"], row["faults"] +
                             (" (%s)" % row["error"] if row.get("error") else "")))
    widths = [max(len(text) for text in cell) for cell in table]
    for i in range(2):
        print("  ".join(cell[i].rjust(width) for cell, width in zip(table, widths)))
    cut = sum(number(row, "cut") for row in rows)
    frames = sum(number(row, "frames") for row in rows)
    return bool(failing) or cut > CUT_ALLOWED * frames


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run random worlds by number and summarise them: tools/soak.py PROGRAM.

PROGRAM is build/host/host_soak.elf. It makes worlds of four kinds, with names like 12, u12, m12 and w12: bodies alone, bodies under
a surface, machines, and wild machines. Every world is a row of out/soak.csv. The summary is printed and, with --docs, written into docs/soak.md, bodies and
machines each between two comments. With --record its counts are added to those of docs/evidence.md. A world that ends the program,
or takes too long, gets a row of its own, and the others run without it. For each failing world a line says how to run it alone, frame
by frame. The exit status is 1 if there is any fault.
"""
import argparse
import concurrent.futures
import csv
import os
import subprocess
import sys
import threading
import time

import claims
import evidence
import gate
import marked

OUT, DOCS = "out/soak.csv", "docs/soak.md"
CHUNK = 20  # worlds a process
SECONDS = 150  # of a processor for a world; its steps may take 60
CUT_ALLOWED = 0.01  # as a part of all frames
FAULTS = ["crosses", "error", "stands still", "cut short", "energy", "momentum", "slow step",
          "much work", "joint", "sensor", "other hash"]
KINDS = {"": "bodies", "u": "under a surface", "m": "machines", "w": "wild machines"}
SHARES = {"": 1, "u": 0.2, "m": 0.2, "w": 0.02}  # as a part of the number of worlds that was asked for
JOINTED = ("m", "w")
LOST = "lost"  # the program ended early, or did not end
COUNTED = ["crosses", "energy", "stands still", "error", LOST, "other hash"]  # over time


def processor_seconds(pid):
    """The time of the processors that a process has used."""
    with open("/proc/%d/stat" % pid, encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def lines_of(command):
    """The complete lines of a program until it ends, or takes too long for one line; and how it ended."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    lines, late, begin, ended = [], False, 0, threading.Event()

    def watch():
        nonlocal late
        while not late and not ended.wait(1):
            late = processor_seconds(process.pid) - begin > SECONDS
        if late:
            process.kill()

    watcher = threading.Thread(target=watch)
    watcher.start()
    for line in process.stdout:
        if line.endswith("\n"):
            lines.append(line)
        begin = processor_seconds(process.pid)
    ended.set()
    watcher.join()
    status = process.wait()
    return lines, "more than %d s" % SECONDS if late else "status %d" % status


def rows_of(program, kind, first, count):
    """The rows of some worlds of a kind, in order."""
    found = []
    while count > 0:
        lines, end = lines_of([program, "rows", kind + str(first), str(count)])
        made = list(csv.DictReader(lines))
        found += made
        first, count = first + len(made), count - len(made)
        if count > 0:
            found.append({"seed": kind + str(first), "frames": "0", "faults": LOST, "error": end})
            first, count = first + 1, count - 1
    return found


def run(program, kind, first, count, jobs):
    """All rows of a kind; a free process takes the next chunk."""
    starts = list(range(first, first + count, CHUNK))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        parts = pool.map(lambda start: rows_of(program, kind, start, min(CHUNK, first + count - start)),
                         starts)
        return [row for part in parts for row in part]


def number(row, column):
    return float(row.get(column) or 0)


def has(row, fault):
    return fault in row["faults"].split("; ")


def most(rows, column):
    return max(rows, key=lambda row: number(row, column))


def figure(rows, column):
    """The largest value of a column, and its world."""
    row = most(rows, column)
    return "%.2g (%s)" % (number(row, column), row["seed"])


def summary(kind, rows, wall):
    """Columns of the table, and their cells for a kind of world."""
    frames = sum(number(row, "frames") for row in rows)
    cut = sum(number(row, "cut") for row in rows)
    slowest = most(rows, "step_seconds")

    def count(fault):
        return "%d" % sum(has(row, fault) for row in rows)

    return [
        ("kind", KINDS[kind]),
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


def joints(kind, rows):
    """The remarks about machines."""
    return [
        ("kind", KINDS[kind]),
        ("joints", "%d" % sum(number(row, "joints") for row in rows)),
        ("broke", "%d" % sum(number(row, "breaks") for row in rows)),
        ("joint", "%d" % sum(has(row, "joint") for row in rows)),
        ("free: anchors, skins", figure(rows, "apart")),
        ("axes, radians", figure(rows, "axes")),
        ("limits, skins", figure(rows, "beyond")),
        ("touched: anchors, skins", figure(rows, "touched_apart")),
        ("energy gained", figure(rows, "gained")),
        ("led, blocked", "%d" % sum(number(row, "blocked") for row in rows)),
        ("sensor events", "%d" % sum(number(row, "sensed") for row in rows)),
        ("asked", "%d" % sum(number(row, "sensor_asked") for row in rows)),
        ("wrong", "%d" % sum(has(row, "sensor") for row in rows)),
        ("other hash", "%d" % sum(has(row, "other hash") for row in rows)),
    ]


def lines_of_table(tables):
    """A table with one row for each list of columns and cells."""
    lines = ["| " + " | ".join(cell[0] for cell in tables[0]) + " |", "|---" * len(tables[0]) + "|"]
    return lines + ["| " + " | ".join(cell[1] for cell in table) + " |" for table in tables]


def write_csv(rows):
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", newline="") as file:
        writer = csv.DictWriter(file, max(rows, key=len).keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def faults_of(rows):
    """The faults, and the first numbers of each."""
    lines = ["", "| fault | worlds | the first of them |", "|---|---|---|"]
    for fault in FAULTS + [LOST]:
        seeds = [row["seed"] for row in rows if has(row, fault)]
        lines.append("| %s | %d | %s |" % (fault, len(seeds), ", ".join(seeds[:12])))
    return lines


def document(by_kind):
    """Write the page: worlds of bodies, and machines, as far as they were run."""
    alone = {kind: made for kind, made in by_kind.items() if kind not in JOINTED}
    if alone:
        rows = [row for made, _ in alone.values() for row in made]
        marked.write(DOCS, "soak", lines_of_table([summary(kind, *made) for kind, made in alone.items()]) +
                     faults_of(rows))
    machines = {kind: made for kind, made in by_kind.items() if kind in JOINTED}
    if machines:
        rows = [row for made, _ in machines.values() for row in made]
        marked.write(DOCS, "machines",
                     lines_of_table([summary(kind, *made) for kind, made in machines.items()]) + [""] +
                     lines_of_table([joints(kind, made) for kind, (made, _) in machines.items()]) +
                     faults_of(rows))
    claims.write()


def keep_counts(by_kind):
    """Add what was run and found to the counts over time."""
    counts = {}
    for kind, (rows, _) in by_kind.items():
        found = {"worlds": len(rows), "frames": sum(int(number(row, "frames")) for row in rows)}
        found.update({fault: sum(has(row, fault) for row in rows) for fault in COUNTED})
        counts.update({"%s: %s" % (KINDS[kind], what): (count, "sum") for what, count in found.items()})
    evidence.record("soak", counts)


def print_table(table):
    widths = [max(len(text) for text in cell) for cell in table]
    for i in range(2):
        print("  ".join(cell[i].rjust(width) for cell, width in zip(table, widths)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=1, help="number of the first world")
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--kinds", default="bumw", help="of worlds: bodies, under a surface, machines, wild ones")
    parser.add_argument("--docs", action="store_true", help="write the summary into " + DOCS)
    parser.add_argument("--record", action="store_true", help="add the counts to those of docs/evidence.md")
    arguments = parser.parse_args()
    os.chdir(gate.ROOT)
    by_kind = {}
    for kind, share in SHARES.items():
        if (kind or "b") not in arguments.kinds:
            continue
        start = time.monotonic()
        count = max(1, int(arguments.count * share))
        made = run(arguments.program, kind, arguments.first, count, arguments.jobs)
        by_kind[kind] = made, time.monotonic() - start
    rows = [row for made, _ in by_kind.values() for row in made]
    write_csv(rows)
    if arguments.record:
        keep_counts(by_kind)
        claims.write()
    if arguments.docs:
        document(by_kind)
    # frames cut short are counted over all worlds: one world alone is no failure
    failing = [row for row in rows if set(row["faults"].split("; ")) - {"", "cut short"}]
    for row in failing:
        print("%s %s: %s" % (arguments.program, row["seed"], row["faults"] +
                             (" (%s)" % row["error"] if row.get("error") else "")))
    for kind, (made, wall) in by_kind.items():
        print_table(summary(kind, made, wall))
        if kind in JOINTED:
            print_table(joints(kind, made))
    cut = sum(number(row, "cut") for row in rows)
    frames = sum(number(row, "frames") for row in rows)
    return bool(failing) or cut > CUT_ALLOWED * frames


if __name__ == "__main__":
    sys.exit(main())

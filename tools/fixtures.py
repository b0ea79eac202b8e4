#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run every fixture in its own process: tools/fixtures.py PROGRAM [NAME...]

Rows go to out/fixtures.csv, where the rows of other scenes stay; when all scenes ran, the table in docs/fixtures.md is
written. A scene that hangs or crashes gets a row that says so. The exit status is 1 if a scene that ran fails.
"""
import csv
import os
import subprocess
import sys

import claims
import marked
import results

SECONDS = 900
OUT, DOCS = "out/fixtures.csv", "docs/fixtures.md"
COLUMNS = ["scene", "frames", "crossed", "deepest_skins", "cut_short", "still", "drift", "should",
           "does", "worst_ms", "total_ms", "note"]
TITLES = ["scene", "frames", "with crossings", "deepest, skins", "cut short", "longest still",
          "drift", "should", "does", "worst, ms", "all, ms", ""]


def play(program, name):
    """The row of a scene as a dictionary."""
    row = dict.fromkeys(COLUMNS, "")
    row.update(scene=name, does="no")
    try:
        found = subprocess.run([program, name, "csv"], stdin=subprocess.DEVNULL, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        row["note"] = "not ready after %d s" % SECONDS
        return row
    lines = found.stdout.splitlines()
    rows = list(csv.DictReader(lines))
    if found.returncode or len(rows) != 1 or None in rows[0].values():
        row["note"] = "status %d: %s" % (found.returncode, lines[-1] if lines else "")
        return row
    return rows[0]


def write_docs(rows):
    lines = ["| %s |" % " | ".join(TITLES), "|" + "---|" * len(TITLES)]
    lines += ["| %s |" % " | ".join(row[name] for name in COLUMNS) for row in rows]
    marked.write(DOCS, "fixtures", lines)
    claims.write()


def main():
    program, chosen = sys.argv[1], sys.argv[2:]
    names = subprocess.run([program, "list"], stdout=subprocess.PIPE, text=True,
                           check=True).stdout.split()
    rows = {row["scene"]: row for row in results.read(OUT)} if chosen else {}
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    for name in chosen or names:
        row = rows[name] = play(program, name)
        print("%-3s %s: %s" % (row["does"], name, "; ".join(
            "%s %s" % (title, row[column]) for title, column in
            zip(TITLES[1:-1], COLUMNS[1:-1]) if column != "does") + "; " + row["note"]), flush=True)
        with open(OUT, "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows[name] for name in names if name in rows)
    if set(names) <= set(rows):
        write_docs([rows[name] for name in names])
    good = sum(rows[name]["does"] == "yes" for name in chosen or names)
    print("%d of %d scenes do what they should" % (good, len(chosen or names)))
    return good < len(chosen or names)


sys.exit(main())

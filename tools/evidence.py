#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Figures of the tests that search for faults: tests/evidence.csv keeps them, docs/evidence.md shows them.

The command of a test calls record() in its long form, and ratchet() in the short form that CI runs. A figure is one of
five kinds:
    more    more is better: a short form may not find less
    less    less is better: a short form may not find more
    sum     a count that each run adds to
    most    the most of all runs
    fact    neither is better
"""
import datetime
import os
import subprocess
import sys

import marked
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KEPT, PAGE = os.path.join(ROOT, "tests", "evidence.csv"), os.path.join(ROOT, "docs", "evidence.md")
COLUMNS = ["test", "figure", "value", "kind", "date", "commit"]
KINDS = "more", "less", "sum", "most", "fact"


def commit():
    """The commit that was measured, with a + if files differ from that commit."""
    said = [subprocess.run(["git", "-C", ROOT, *command.split()], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
            for command in ("rev-parse --short=7 HEAD", "status --porcelain --untracked-files=no")]
    return said[0] + ("+" if said[1] else "")


def number(text):
    return float(text) if "." in text else int(text)


def lines(rows):
    """The table of one test."""
    yield "| figure | measured | date | commit |"
    yield "|---|---|---|---|"
    for row in rows:
        value = number(row["value"])
        yield "| %s | %s | %s | %s |" % (row["figure"], f"{value:,}" if isinstance(value, int) else row["value"],
                                         row["date"], row["commit"])


def page(text, rows):
    """The page with the tables of all tests."""
    for test in sorted({row["test"] for row in rows}):
        text = marked.put(text, test, lines([row for row in rows if row["test"] == test]))
    return text


def record(test, figures):
    """Keep the figures {name: (value, kind)} of a test in place of the former ones of these names, and write them into the page."""
    assert all(kind in KINDS for _, kind in figures.values())
    rows = results.read(KEPT)
    former = {row["figure"]: number(row["value"]) for row in rows if row["test"] == test}
    now, at = datetime.date.today().isoformat(), commit()
    values = {name: value + former.get(name, 0) if kind == "sum" else max(value, former.get(name, value)) if kind == "most" else value
              for name, (value, kind) in figures.items()}
    mine = [dict(zip(COLUMNS, (test, name, str(values[name]), kind, now, at))) for name, (_, kind) in figures.items()]
    rows = sorted([row for row in rows if row["test"] != test or row["figure"] not in figures] + mine, key=lambda row: row["test"])
    results.write(KEPT, ",".join(COLUMNS), [list(row.values()) for row in rows])
    with open(PAGE) as file:
        text = file.read()
    with open(PAGE, "w") as file:
        file.write(page(text, rows))


def ratchet(test, found):
    """Compare figures {name: value} with the kept ones: prints a line for each, and returns True if none is
    worse."""
    held = True
    for row in results.read(KEPT):
        if row["test"] == test and row["figure"] in found and row["kind"] in ("more", "less"):
            value, kept = found[row["figure"]], number(row["value"])
            ok = value >= kept if row["kind"] == "more" else value <= kept
            held = held and ok
            print("%s: %s: %s, kept %s" % ("ok" if ok else "WORSE", row["figure"], value, kept))
    return held


def stale():
    """True if the page and the kept figures differ."""
    with open(PAGE) as file:
        text = file.read()
    return page(text, results.read(KEPT)) != text


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        with open(PAGE) as whole:
            before = whole.read()
        with open(PAGE, "w") as whole:
            whole.write(page(before, results.read(KEPT)))
    else:
        if stale():
            sys.exit("docs/evidence.md shows other figures than tests/evidence.csv: tools/evidence.py --write")
        print("pass: docs/evidence.md shows the figures of tests/evidence.csv")

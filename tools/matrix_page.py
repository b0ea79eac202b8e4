#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The builds that `make matrix` found right: tests/matrix.csv keeps a row for each, docs/matrix.md shows them.

A row says that a build played every scene as tests/plays.csv has it, with the date, the commit and a digest of that file. So
parts of the matrix can run at different times; and once a change of the engine changes a play, the page says that the
builds before it are of an earlier engine. Compares the page with the files, or writes it: matrix_page.py [--write]
"""
import collections
import datetime
import hashlib
import os
import sys

import claims
import marked
import plays
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KEPT, PAGE = os.path.join(ROOT, "tests", "matrix.csv"), os.path.join(ROOT, "docs", "matrix.md")
COLUMNS = "target,compiler,options,version,bits,order,runs on,absent,plays,date,commit"
KEY = "target", "compiler", "options"


def key_of(row):
    return tuple(row[column] for column in KEY)


def key_of_build(build):
    return tuple(getattr(build, column) for column in KEY)


def digest():
    """The state of tests/plays.csv."""
    with open(plays.kept_in("plays", ROOT), "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:8]


def faults(build):
    """The scenes of a build that differ from tests/plays.csv, a line each."""
    for scene, frames, awake, wanted in plays.kept("plays", ROOT):
        played = build.scenes.get(scene)
        if played and played[:3] != [frames, awake, wanted] or not played and scene not in build.absent:
            yield "%s: %s has %s; tests/plays.csv has %s" % (build, scene, played and played[2], wanted)


def missing(builds):
    """Those without a row of today's plays."""
    now = digest()
    there = {key_of(row) for row in results.read(KEPT) if row["plays"] == now}
    return [build for build in builds if key_of_build(build) not in there]


def keep(build, good, version, commit):
    """Write the row of a build that was good, drop that of one that was not, and write the page."""
    rows = {key_of(row): row for row in results.read(KEPT)}
    key = key_of_build(build)
    rows.pop(key, None)
    if good:
        rows[key] = dict(zip(COLUMNS.split(","), (
            *key, version, str(build.bits), build.order, build.where, " ".join(build.absent), digest(),
            datetime.date.today().isoformat(), commit)))
    results.write(KEPT, COLUMNS, [list(rows[key].values()) for key in sorted(rows)])
    marked.write(PAGE, "matrix", lines(results.read(KEPT)))
    claims.write()


def builds_of(rows):
    """A line for each target and compiler."""
    yield from ["", "| target | bits | byte order | compiler | runs on | builds | date | commit |", "|---|---|---|---|---|---|---|---|"]
    groups = collections.defaultdict(list)
    for row in rows:
        groups[row["target"], row["compiler"]].append(row)
    for group in groups.values():
        oldest = min(group, key=lambda row: row["date"])
        yield "| %s | %s | %s | %s %s | %s | %d | %s | %s |" % (*(oldest[column] for column in (
            "target", "bits", "order", "compiler", "version", "runs on")), len(group), oldest["date"], oldest["commit"])


def lines(rows):
    """A summary: the targets, the options and the hashes, each once."""
    scenes, now = plays.kept("plays", ROOT), digest()
    earlier = sum(row["plays"] != now for row in rows)
    yield "%d builds, %d scenes, one hash each.%s" % (
        len(rows), len(scenes), " %d of these builds played an earlier engine." % earlier if earlier else "")
    yield from builds_of(rows)
    yield from ["", "| compiler | option sets, each a build |", "|---|---|"]
    options = collections.defaultdict(dict)
    for row in rows:
        options[row["compiler"]][row["options"]] = None
    for compiler, sets in options.items():
        yield "| %s | %s |" % (compiler, ", ".join("`%s`" % each for each in sets))
    yield from ["", "| scene | frames | with a body awake | hash |", "|---|---|---|---|"]
    for scene in scenes:
        yield "| %s | %s | %s | `%s` |" % tuple(scene)
    for row in rows:
        if row["absent"]:
            yield from ["", "%s has no room for %s." % (row["target"], ", ".join(row["absent"].split()))]


def main():
    wanted = lines(results.read(KEPT))
    if "--write" in sys.argv[1:]:
        marked.write(PAGE, "matrix", wanted)
        return 0
    with open(PAGE) as file:
        shown = marked.split(file.read(), "matrix")[1]
    if shown != "".join(line + "\n" for line in wanted):
        sys.exit("docs/matrix.md does not show tests/matrix.csv and tests/plays.csv; tools/matrix_page.py --write does")
    print("pass: docs/matrix.md shows the builds of tests/matrix.csv and the hashes of tests/plays.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main())

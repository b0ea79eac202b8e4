#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The lines of README.md, docs/limits.md and SPEC.md that quote figures of other files: tools/claims.py [--write]

A command that writes a page of figures writes these lines, too. Without --write they are compared.
"""
import os
import re
import sys

import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# what single calls may take, in instructions; what the boards of docs/limits.md are to hold
COSTS = {"vertex and face that meet": 1800, "edges that meet": 2800}
SLOW_BOARD, SLOW_SCENE, SLOW_RATE = "microbit", "boxes3", 15
PAPERS_BOARDS = {"paper-arm": "0.60 M", "paper-mips": "0.90 M"}


def lines_of(path, name):
    """The lines between two comments of a page."""
    with open(os.path.join(ROOT, path)) as file:
        return marked.split(file.read(), name)[1].splitlines()


def tables_of(path, name):
    """The tables among these lines: lists of rows by column."""
    tables, cells = [], []
    for line in lines_of(path, name) + [""]:
        if line.startswith("|"):
            cells.append([cell.strip() for cell in line.strip("|").split("|")])
        elif cells:
            tables.append([dict(zip(cells[0], row)) for row in cells[2:]])
            cells = []
    return tables


def table_of(path, name):
    """The first table; none if the lines have no table yet."""
    return next(iter(tables_of(path, name)), [])


def number(text):
    return int(text.replace(",", ""))


def sentences():
    """The sentences of README.md."""
    counted = {row["figure"]: row["measured"] if row["measured"] != "0" else "none" for row in table_of("docs/evidence.md", "soak")}
    fixtures = [row["does"] for row in table_of("docs/fixtures.md", "fixtures")]
    builds, scenes, earlier = re.match(r"(\d+) builds, (\d+) scenes, one hash each\.(.*)", lines_of("docs/matrix.md", "matrix")[0]).groups()
    yield ("[docs/evidence.md](docs/evidence.md) counts %s random worlds of bodies: faces crossed in %s of them, and a body that had to "
           "move stood still in %s. Of %s random machines on joints, faces crossed in %s, and a body stood still in %s. "
           "[docs/fixtures.md](docs/fixtures.md) has %d published and special scenes, and %d of them do what they should. "
           "[docs/matrix.md](docs/matrix.md) has %s scenes, which ended in one hash each in %s builds.%s" % (
               *(counted["%s: %s" % (kind, figure)] for kind in ("bodies", "machines") for figure in ("worlds", "crosses", "stands still")),
               len(fixtures), fixtures.count("yes"), scenes, builds, earlier))


def missed_costs():
    """Instructions and bytes that are above their bars: what, wanted, measured, page."""
    page = "docs/measured.md"
    for row in table_of(page, "bars"):
        if "missed" in row.values():
            yield "%s, %s: %s" % (row["scene"], row["frames"], row["what"]), row["bar"], row["measured"], page
    for row in table_of(page, "costs"):
        if number(row["mean"]) > COSTS.get(row["what"], number(row["mean"])):
            yield "collision test, %s" % row["what"], f"{COSTS[row['what']]:,}", row["mean"], page
    for name, words in ("uses", "bytes of code up to: %s"), ("blocks", "bytes of %s"):
        for row in table_of(page, name):
            if row["wanted"] and number(row["bytes"]) > number(row["wanted"]):
                yield words % row[next(iter(row))], row["wanted"], row["bytes"], page


def missed_boards():
    """Boards whose frames take more than wanted."""
    for row in table_of("README.md", "boards"):
        mean_worst = row["a frame of the first, mean / worst"]
        if row["board"] == SLOW_BOARD:
            rate = re.search(SLOW_SCENE + r" (\d+)", row["scenes, frames a second"])[1]
            yield "%s: `%s`, frames a second" % (SLOW_BOARD, SLOW_SCENE), str(SLOW_RATE), rate, "README.md"
        elif row["board"] in PAPERS_BOARDS:
            yield ("%s: worst frame of `head`" % row["board"], PAPERS_BOARDS[row["board"]],
                   mean_worst.split(" / ")[1], "README.md")


def dearer_heaps():
    """Heaps that cost more than ODE's."""
    with open(os.path.join(ROOT, "docs", "compare.md")) as file:
        rows = re.findall(r"\| (step, \d+ boxes) \| (falling|resting) \|.*\| (\S+) of ODE's \|", file.read())
    for what, phase, part in rows:
        if float(part) > 1:
            yield "%s, %s, of ODE's instructions" % (what, phase), "1", part, "docs/compare.md"


def faults():
    """Counts of what should be none: what, of how many, measured, page."""
    for name, kinds in ("soak", "bodies"), ("machines", "machines"):
        counts, *_, found = tables_of("docs/soak.md", name)
        worlds = sum(int(row["worlds"]) for row in counts)
        for row in found:
            if int(row["worlds"]):
                yield "random worlds of %s: %s" % (kinds, row["fault"]), f"0 of {worlds:,}", row["worlds"], "docs/soak.md"
    for row in table_of("docs/fixtures.md", "fixtures"):
        if row["does"] != "yes":
            yield "fixture `%s`, frames cut short" % row["scene"], "0 of " + row["frames"], row["cut short"], "docs/fixtures.md"
    special = table_of("docs/measured.md", "special")
    for fault in "stand still", "cut short":
        found = sum(number(row[fault]) for row in special)
        if found:
            yield ("meetings in special positions: " + fault,
                   f"0 of {sum(number(row['cases']) for row in special):,}", str(found), "docs/measured.md")
    motions = table_of("docs/physics.md", "physics")
    yield ("motions off by more than their bar", "0 of %d" % len(motions),
           str(sum(row["holds"] != "yes" for row in motions)), "docs/physics.md")


def limits():
    """The table of docs/limits.md."""
    yield "| what | wanted | measured | page |"
    yield "|---|---|---|---|"
    for part in missed_costs, missed_boards, dearer_heaps, faults:
        for what, wanted, measured, page in part():
            name = os.path.basename(page)
            yield "| %s | %s | %s | [%s](%s) |" % (what, wanted, measured, name, name if page.startswith("docs") else "../" + page)


def memory():
    """The table of SPEC.md, section 4: the bytes that include/carom_memory.h gives for one of each."""
    with open(os.path.join(ROOT, "include", "carom_memory.h")) as file:
        found = re.findall(r"/\*\* Bytes of (.*)\. \*/\n#define CAROM_\w+_BYTES (?:CAROM_BYTES_\((\d+), (\d+)\)|(\d+))\n", file.read())
    yield "| bytes of | pointers of 32 bits | of 64 bits |"
    yield "|---|---|---|"
    for words, narrow, wide, both in found:
        yield "| %s | %s | %s |" % (words, f"{int(narrow or both):,}", f"{int(wide or both):,}")


PARTS = [("README.md", "claims", sentences), ("docs/limits.md", "limits", limits), ("SPEC.md", "memory", memory)]


def write():
    for path, name, lines in PARTS:
        marked.write(os.path.join(ROOT, path), name, lines())


def main(arguments):
    if arguments == ["--write"]:
        write()
    for path, name, lines in PARTS:
        if lines_of(path, name) != list(lines()):
            sys.exit("%s shows other figures than the files that it quotes: tools/claims.py --write" % path)
    print("pass: %s show the figures of the files that they quote" % ", ".join(path for path, _, _ in PARTS))


if __name__ == "__main__":
    main(sys.argv[1:])

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Write the rows of build/host/host_physics.elf into docs/physics.md: tools/physics.py PROGRAM

They also go to out/physics.csv, and tests/evidence.csv keeps how many hold.
"""
import csv
import os
import subprocess
import sys

import claims
import evidence
import marked

OUT, DOCS = "out/physics.csv", "docs/physics.md"
COLUMNS = ["motion", "from", "expected", "measured", "error", "bar", "holds", "why"]


def cell(name, row):
    """A cell of the table: a row that misses its bar is to be seen."""
    return "**no**" if name == "holds" and row[name] == "no" else row[name]


def main():
    said = subprocess.run([sys.argv[1], "csv"], stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = list(csv.DictReader(said.splitlines()))
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w") as file:
        file.write(said)
    marked.write(DOCS, "physics", ["| %s |" % " | ".join(COLUMNS), "|" + "---|" * len(COLUMNS)] +
                 ["| %s |" % " | ".join(cell(name, row) for name in COLUMNS) for row in rows])
    claims.write()
    held = sum(row["holds"] == "yes" for row in rows)
    evidence.record("physics", {"rows": (len(rows), "fact"), "rows within their bar": (held, "more")})
    print("%d of %d rows hold" % (held, len(rows)))


main()

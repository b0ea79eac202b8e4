#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The sentences of README.md with numbers of docs/soak.md, docs/fixtures.md and docs/matrix.md: tools/claims.py [--write]

`make soak`, `make fixtures` and `make matrix` write these pages, and then these sentences. Without --write they are compared.
"""
import os
import re
import sys

import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
README, NAME = "README.md", "claims"


def lines_of(name):
    """The lines that a command wrote into docs/NAME.md."""
    with open(os.path.join(ROOT, "docs", name + ".md")) as file:
        return marked.split(file.read(), name)[1].splitlines()


def table_of(name):
    """The rows of the first table among these lines, by column."""
    lines = lines_of(name)
    first = next(i for i, line in enumerate(lines) if line.startswith("| "))
    cells = []
    for line in lines[first:]:
        if not line.startswith("|"):
            break
        cells.append([cell.strip() for cell in line.strip("|").split("|")])
    return [dict(zip(cells[0], row)) for row in cells[2:]]


def sentences():
    worlds = {key: int(text) for key, text in table_of("soak")[0].items() if text.isdigit()}
    fixtures = [row["does"] for row in table_of("fixtures")]
    builds, scenes = re.match(r"(\d+) builds, (\d+) scenes, one hash each", lines_of("matrix")[0]).groups()
    yield ("[docs/soak.md](docs/soak.md) has %s random worlds: faces crossed in %s of them, and a body that had to move stood still in %s. "
           "[docs/fixtures.md](docs/fixtures.md) has %d published and special scenes, and %d of them do what they should. "
           "[docs/matrix.md](docs/matrix.md) has %s scenes, which ended in one hash each in %s builds." % (
               f"{worlds['worlds']:,}", worlds["crossings"] or "none", worlds["stand still"] or "none",
               len(fixtures), fixtures.count("yes"), scenes, builds))


def write():
    marked.write(os.path.join(ROOT, README), NAME, sentences())


def main(arguments):
    if arguments == ["--write"]:
        write()
    with open(os.path.join(ROOT, README)) as file:
        shown = marked.split(file.read(), NAME)[1].splitlines()
    if shown != list(sentences()):
        sys.exit("README.md shows other figures than docs/: tools/claims.py --write")
    print("pass: README.md shows the figures of docs/soak.md, docs/fixtures.md and docs/matrix.md")


if __name__ == "__main__":
    main(sys.argv[1:])

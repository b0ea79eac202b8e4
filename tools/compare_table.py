# SPDX-License-Identifier: MIT
"""The table of the comparison, in README.md and in docs/compare.md, from docs/compare.csv.

`make compare` writes all three. tools/check_compare checks that the tables show the figures.
"""
import csv
import os

import claims
import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FIGURES, DOCS, README = [os.path.join(ROOT, path)
                         for path in ("docs/compare.csv", "docs/compare.md", "README.md")]
COLUMNS = ["what", "size", "phase", "contender", "value", "unit"]
CONTENDERS = {"carom": "Carom", "ode": "ODE", "bullet": "Bullet", "fcl": "FCL", "rapier": "Rapier",
              "jolt": "Jolt"}
BESIDE = ["ode", "rapier"]  # Carom's figure is divided by the figure of the first of these that has
                            # one
TITLES = {"query": "query, %s", "step": "step, %s", "heap": "step, %s boxes",
          "wasm": "step, %s boxes, WebAssembly"}
# the part that README.md shows
SHOWN = {"query": ["head"], "step": ["head"], "heap": ["8", "32", "128"], "wasm": ["100"]}
NOT_SHOWN = ["settling"]

DOCS_HEAD = """<!-- SPDX-License-Identifier: MIT -->
# Carom beside others

`make compare` measures these figures and writes this page, the table in README.md and docs/compare.csv. A
query asks for all contacts of a moving mesh with a stationary one, when their boxes overlap (near) or their
faces cross (contact). A step is a whole step of a world: of the scene `head`, or of a heap of boxes that fall
in layers. Steps 1 to 60 are falling, 61 to 120 settling, 121 to 180 resting, without sleep; asleep is a heap
of Carom in which all boxes sleep. Figures are x86-64 instructions, counted by callgrind: means of a phase and
of some heaps. For WebAssembly, in one node process, they are medians of milliseconds. Each library has its
default settings.

"""


def read():
    """The committed figures, or none."""
    if not os.path.exists(FIGURES):
        return []
    with open(FIGURES, newline="") as file:
        return list(csv.reader(file))[1:]


def value_text(value, unit):
    """A figure for people: 94.2 k, 1.23 M, 0.45 ms."""
    if unit == "ms":
        return "%.2f ms" % value
    for size, name in [(1e6, " M"), (1e3, " k")]:
        if value >= size:
            scaled = value / size
            return "%.*f" % (2 if scaled < 10 else 1 if scaled < 100 else 0, scaled) + name
    return "%d" % value


def ratio_text(costs):
    """Carom's figure over that of another."""
    for who in BESIDE:
        if who in costs:
            return "%.2g of %s's" % (costs["carom"] / costs[who], CONTENDERS[who])
    return ""


def table(figures, short):
    """The lines of a table; if short, only those that README.md shows."""
    rows, units = {}, {}
    for what, size, phase, who, value, unit in figures:
        shown = size in SHOWN.get(what, []) and phase not in NOT_SHOWN
        if what in TITLES and who in CONTENDERS and (shown or not short):
            rows.setdefault((what, size, phase), {})[who] = float(value)
            units[what, size, phase] = unit
    cells = [["", "phase", *CONTENDERS.values(), "Carom's part"]]
    for (what, size, phase), costs in rows.items():
        texts = [value_text(costs[who], units[what, size, phase]) if who in costs else ""
                 for who in CONTENDERS]
        cells.append([TITLES[what] % size, phase, *texts, ratio_text(costs)])
    lines = ["| " + " | ".join(row) + " |\n" for row in cells]
    lines.insert(1, "|---" * len(cells[0]) + "|\n")
    return "".join(lines)


def expected(figures):
    """{path: the text that the file is to have}."""
    with open(README) as file:
        page = file.read()
    return {README: marked.put(page, "compare", table(figures, True).splitlines()),
            DOCS: DOCS_HEAD + table(figures, False)}


def write(figures):
    """The committed figures, and the tables from them."""
    with open(FIGURES, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS] + figures)
    for path, text in expected(read()).items():
        with open(path, "w") as file:
            file.write(text)
    claims.write()

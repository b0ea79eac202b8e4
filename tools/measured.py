#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Tables of docs/measured.md that programs measure, one for each word:

    tools/measured.py kernels       errors of kernels, from the out/accuracy.csv of `make accuracy`
    tools/measured.py hits          first hits, from the out/oracle.csv of `make oracle`
    tools/measured.py special PROGRAM   runs host_special and counts what became of its meetings
    tools/measured.py costs IMAGE...    runs suites on a board and lists the instructions that they print
"""
import os
import re
import subprocess
import sys

import claims
import marked
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "measured.md")
ACCURACY, ORACLE = (os.path.join(ROOT, "out", name + ".csv") for name in ("accuracy", "oracle"))
# what the error of a kernel in out/accuracy.csv is
KERNELS = {
    "impulse9": "impulse of an impact, 9 unknowns, relative",
    "impulse15": "impulse of an impact, 15 unknowns, relative",
    "impulse9_q22": "the same of 9, with arms rounded to q22",
    "impulse15_q22": "the same of 15, with arms rounded to q22",
    "impulse9_given": "the same of 9, where the oracle sees the rounded numbers",
    "impulse15_given": "the same of 15, where the oracle sees the rounded numbers",
    "solve9": "solution of the quantised system of 9",
    "solve15": "solution of the quantised system of 15",
    "restitution": "restitution, V'.N against -e V.N",
    "energy": "rise of kinetic energy by an impact",
    "energy_firm": "the same for impulses from 2^-6 on",
    "linear_momentum": "linear momentum of 32 bodies, units of the last place",
    "angular_momentum": "angular momentum about the origin, of the impulse's moment",
    "boyse_vf_translate": "time of impact, vertex and face, translation: gap off by, 2^-16 units",
    "boyse_vf_rotate": "the same with rotation",
    "boyse_ee_translate": "time of impact, two edges, translation: gap off by, 2^-16 units",
    "boyse_ee_rotate": "the same with rotation",
    "boyse_combined": "the same of both kinds, translation and rotation, one and two bodies moving",
    "tumble": "a million torque-free steps: energy, orthonormality",
    "mass": "mass, centre, inertia of closed meshes",
}
# the instructions that a suite prints after a #
COST = re.compile(r"# (.*): (?:mean )?(\d+)(?:, worst (\d+))? instructions(?: on average, (\d+) at most)?")
COUNTS = re.compile(r"(ok|not ok) \d+ - special/(\w+) \((.*)\)")


def table(titles, rows):
    return ["| %s |" % " | ".join(titles), "|" + "---|" * len(titles)] + ["| %s |" % " | ".join(row) for row in rows]


def grouped(text):
    return f"{int(text):,}"


def kernels():
    rows = {row["kernel"]: row for row in results.read(ACCURACY)}
    return table(["kernel", "cases", "bars", "99.9 %", "99.99 %", "largest"],
                 [[words, grouped(row["cases"]), row["bars"], row["p999"], row["p9999"], row["max"]]
                  for name, words in KERNELS.items() for row in [rows[name]]])


def hits():
    rows = results.read(ORACLE)
    names = ["motions", "hits", "different", "missed", "early", "late", "crossed"]
    return table(["bodies that move", *names],
                 [[movers, *(f"{sum(int(row[name]) for row in rows if row['movers'] == movers):,}" for name in names)]
                  for movers in ("1", "2")])


def said_by(command):
    return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, check=True).stdout


def special(program):
    rows = []
    for line in said_by([program, "long"]).splitlines():
        found = COUNTS.match(line)
        if found:
            counts = dict(re.match(r"(\S+) (.*)", part).groups()[::-1] for part in found[3].split(", "))
            rows.append({"features": found[2].replace("_", " "), **counts})
    titles = [name for name in rows[0] if name != "skins deep"]
    return table(titles, [[row[name] if name == "features" else grouped(row[name]) for name in titles] for row in rows])


def costs(*images):
    rows = []
    for image in images:
        suite = os.path.basename(image).removeprefix("suite_").removesuffix(".elf")
        for line in said_by([os.path.join(ROOT, "tools", "run_board.py"), image]).splitlines():
            found = COST.match(line)
            if found:
                most = found[3] or found[4]
                rows.append([suite, found[1], grouped(found[2]), grouped(most) if most else ""])
    return table(["suite", "what", "mean", "most"], rows)


if __name__ == "__main__":
    WRITERS = {writer.__name__: writer for writer in (kernels, hits, special, costs)}
    if len(sys.argv) < 2 or sys.argv[1] not in WRITERS:
        sys.exit(__doc__)
    lines = WRITERS[sys.argv[1]](*sys.argv[2:])
    print("\n".join(lines))
    marked.write(PAGE, sys.argv[1], lines)
    claims.write()

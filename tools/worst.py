#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run the search for the dearest step and keep what it found: tools/worst.py PROGRAM TRIES"""
import csv
import subprocess
import sys

import evidence


def main():
    run = subprocess.run([sys.argv[1], sys.argv[2], "csv"], stdout=subprocess.PIPE, text=True)
    rows = [row for row in csv.reader(run.stdout.splitlines()) if not row[0].startswith("#")]
    found = {row[0]: row for row in rows}
    if "steps" not in found:
        sys.exit("status %d: %s" % (run.returncode, run.stdout))
    figures = {"steps": (int(found["steps"][1]), "fact"),
               "counts above their bound": (int(found["above their bound"][1]), "less"),
               "most candidates for each face of the world": (float(found["candidates a face"][1]), "fact")}
    for name in ("hits", "sub-steps", "refinements", "gathers", "candidates", "sweeps"):
        figures["most %s of a step" % name] = (int(found[name][1]), "fact")
    evidence.record("worst", figures)
    print(run.stdout, end="")
    return run.returncode


sys.exit(main())

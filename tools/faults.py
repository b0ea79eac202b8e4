#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run host_faults in its long form, scene by scene, and keep the figures: tools/faults.py PROGRAM [NAME...]

Without names all scenes run, and the figures are kept. A scene that takes longer than SECONDS is named and not counted.
"""
import re
import subprocess
import sys

import evidence

SECONDS = 1800
LINE = re.compile(r"^(?:not )?ok \d+ - faults/\S+ \((\d+) sizes, (\d+) calls met a full pool, (\d+) left a change, (\d+) a list; (\d+) unequal\)", re.M)


def main():
    program, names = sys.argv[1], sys.argv[2:]
    names = names or subprocess.run([program, "list"], stdout=subprocess.PIPE, text=True, check=True).stdout.split()
    rows, late = [], []
    for name in names:
        try:
            said = subprocess.run([program, "long", name], stdout=subprocess.PIPE, text=True, timeout=SECONDS).stdout
        except subprocess.TimeoutExpired:
            late.append(name)
            print("%s: not ready after %d s" % (name, SECONDS), flush=True)
            continue
        found = LINE.search(said)
        if not found:
            sys.exit("%s: %s" % (name, said))
        rows.append([int(number) for number in found.groups()])
        print("%s: %d sizes, %d calls met a full pool, %d left a change, %d a list, %d unequal" % (name, *rows[-1]), flush=True)
    sizes, failures, changed, listed, unequal = (sum(column) for column in zip(*rows))
    if not sys.argv[2:]:
        evidence.record("faults", {"scenes": (len(rows), "fact"), "sizes of pools": (sizes, "fact"),
                                   "calls that met a full pool": (failures, "fact"),
                                   "of these, calls that left a change": (changed + listed, "less"),
                                   "worlds that did not go on as one with room": (unequal, "less")})
    return bool(changed or listed or unequal or late)


sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run host_faults in its long form, scene by scene, then host_errors, and keep the figures: tools/faults.py FAULTS ERRORS [NAME...]

A name is that of a scene, or `errors` for host_errors alone. Without names all run, and the scenes' figures are kept, too. A scene that
takes longer than SECONDS is named and not counted.
"""
import re
import subprocess
import sys

import evidence

SECONDS = 1800
ERRORS = re.compile(r"^(?:not )?ok \d+ - errors/\S+ \((\d+) steps in which calls failed, (\d+) that went well at the second try; (\d+) other errors, "
                    r"(\d+) states that changed, (\d+) worlds", re.M)
LINE = re.compile(r"^(?:not )?ok \d+ - faults/\S+ \((\d+) sizes, (\d+) calls met a full pool, (\d+) left a change, (\d+) a list; (\d+) unequal\)", re.M)


def errors(program):
    """Let calls within steps fail, and keep the figures; returns whether a world was wrong, or late."""
    try:
        run = subprocess.run([program, "long"], stdout=subprocess.PIPE, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        print("errors: not ready after %d s" % SECONDS)
        return True
    print(run.stdout, end="")
    failed, again, *wrong = (sum(map(int, column)) for column in zip(*ERRORS.findall(run.stdout)))
    evidence.record("faults", {"steps in which a call was made to fail": (failed, "fact"),
                               "steps whose second try went well": (again, "fact"),
                               "of these, steps that left a change or went another way": (sum(wrong), "less")})
    return run.returncode != 0


def main():
    program, second, names = sys.argv[1], sys.argv[2], sys.argv[3:]
    if names == ["errors"]:
        return errors(second)
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
    if not sys.argv[3:]:
        evidence.record("faults", {"scenes": (len(rows), "fact"), "sizes of pools": (sizes, "fact"),
                                   "calls that met a full pool": (failures, "fact"),
                                   "of these, calls that left a change": (changed + listed, "less"),
                                   "worlds that did not go on as one with room": (unequal, "less")})
        late += ["errors"] if errors(second) else []
    return bool(changed or listed or unequal or late)


sys.exit(main())

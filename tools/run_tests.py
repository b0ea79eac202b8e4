#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run programs and scripts that print TAP, and count: tools/run_tests.py [--select PART] FILE...

A .elf file is run by run_board.py, on the board it was built for. The last line is
"N passed, M failed"; the exit status is 1 when M > 0 or N = 0. With --select, the runner of the
suites (tests.elf) runs the tests whose names contain PART; of the other files only those run whose
own names match it.
"""
import argparse
import os
import re
import subprocess
import sys
import threading

import run_board

SECONDS = 240  # a program that takes longer hangs


def stem(path):
    return os.path.splitext(os.path.basename(path))[0].removeprefix("host_").removeprefix("test_")


def wanted(path, select):
    return stem(path) == "tests" or select in path or select.split("/")[0] == stem(path)


def command(path, select):
    if path.endswith(".sh"):
        return ["sh", path]
    return run_board.command(path, [select] if select and stem(path) == "tests" else [])


def run(path, select):
    """Run one file, pass its lines on; returns how many tests passed and failed."""
    passed = failed = 0
    nothing_selected = False
    process = subprocess.Popen(command(path, select), stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, text=True, errors="replace")
    clock = threading.Timer(SECONDS, process.kill)
    clock.start()
    for line in process.stdout:
        print(line, end="", flush=True)
        passed += bool(re.match(r"ok\b", line))
        failed += bool(re.match(r"not ok\b", line))
        nothing_selected |= line.startswith("1..0") and bool(select)
    status = process.wait()
    clock.cancel()
    if failed == 0 and not nothing_selected and (status != 0 or passed == 0):
        print("not ok - %s: %d tests, exit status %d" % (path, passed, status))
        failed += 1
    return passed, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--select", default="")
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    passed = failed = 0
    for path in arguments.files:
        if wanted(path, arguments.select):
            print("# " + path, flush=True)
            counts = run(path, arguments.select)
            passed += counts[0]
            failed += counts[1]
    print("%d passed, %d failed" % (passed, failed))
    return failed > 0 or passed == 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The part of README.md about `make run` shows what the command prints: tools/sample.py [--write] LOG

LOG is the output of `make run`, all of its frames. README.md shows the table between <!-- run --> and its
end, and the last lines at its top. Without --write they are compared. The line about pictures stays as it is,
because a run without pictures has none.
"""
import os
import sys

import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
README = os.path.join(ROOT, "README.md")
FIRST, LAST = "instructions ", "hash "


def shown(log):
    """The lines from the table's head to the hash, and the lines of these that are about all frames."""
    lines = [line.rstrip() for line in log if not line.startswith(("pictures:", "a row a frame:"))]
    first = next(i for i, line in enumerate(lines) if line.startswith(FIRST))
    last = next(i for i, line in enumerate(lines) if line.startswith(LAST))
    table = lines[first:last + 1]
    return table, [line for line in table if line.startswith(("frames ", "frame budget ", LAST))]


def main(arguments):
    write = "--write" in arguments
    with open(arguments[-1], errors="replace") as log:
        table, ending = shown(log)
    with open(README) as file:
        before = file.read()
    after = marked.put(before, "run", ["```", *table, "```"])
    after = marked.put(after, "ending", ["```", *ending, "```"])
    if write:
        with open(README, "w") as file:
            file.write(after)
    elif after != before:
        sys.exit("README.md shows other figures than `make run` prints: make run > log; tools/sample.py --write log")
    print("pass: README.md shows what make run prints")


if __name__ == "__main__":
    main(sys.argv[1:])

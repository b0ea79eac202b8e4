#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Write compile_commands.json, which editors read, from the commands of `make -Bn` on standard input."""
import json
import os
import shlex
import sys


def main():
    rows = []
    for line in sys.stdin:
        words = line.split()
        if "-c" in words and "-o" in words and words[-1].endswith((".c", ".cpp")):
            rows.append({"directory": os.getcwd(), "file": words[-1], "arguments": shlex.split(line)})
    if not rows:
        sys.exit("make names no command that compiles")
    with open("compile_commands.json", "w") as file:
        json.dump(rows, file, indent=1)
    print("compile_commands.json: %d files" % len(rows))


main()

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Static analysis of the engine: `make analysis`.

    tools/analysis.py [--record]

gcc -fanalyzer, clang-tidy (bugprone-*, cert-*), cppcheck with its MISRA addon, and a build without a warning by the newest gcc
and clang that Debian 12 has. A finding is a rule, a file and a line. tests/analysis_deviations.txt explains findings: a rule,
the files in which it is not followed, and why. MISRA's rules are asked of src/num, which has the arithmetic: its addon takes
seconds a file. --record writes the figures to tests/evidence.csv and docs/evidence.md.
"""
import argparse
import collections
import concurrent.futures
import fnmatch
import glob
import os
import re
import subprocess
import sys

import evidence
import gate

DEVIATIONS = "tests/analysis_deviations.txt"
LANGUAGE = ["-std=c11", "-ffreestanding", "-Iinclude"]
# one configuration: that of a board, without assertions
ONE = ["--max-configs=1", "-D__GNUC__=12", "-DUINT_MAX=0xffffffff", "-UCAROM_DEBUG", "-U__cplusplus", "-U__OPTIMIZE_SIZE__"]
CPPCHECK = ["cppcheck", "--quiet", "--std=c11", "--inline-suppr", "-Iinclude", "--enable=warning,performance,portability",
            "--suppress=missingInclude", "--template={file}:{line}: {message} [{id}]", *ONE]
FOUND = re.compile(r"^([\w/.-]+):(\d+):(?:\d+:)? (.*) \[([\w.,=+-]+)\]$", re.M)

TOOLS = {
    "gcc -fanalyzer": lambda path: ["gcc", *LANGUAGE, "-O1", "-fanalyzer", "-c", "-o", os.devnull, path],
    "newest gcc": lambda path: [newest("gcc"), *LANGUAGE, *gate.WARNINGS[:-1], "-fsyntax-only", path],
    "newest clang": lambda path: [newest("clang"), *LANGUAGE, *gate.WARNINGS[:-1], "-fsyntax-only", path],
    "clang-tidy": lambda path: ["clang-tidy", "--quiet", "--checks=-*,bugprone-*,cert-*", path, "--", *LANGUAGE],
    "cppcheck": lambda path: [*CPPCHECK, path],
    # 8.7 asks whether other sources call a function, which a run on one source cannot know
    "MISRA": lambda path: [*CPPCHECK, "--addon=misra", "--suppress=misra-c2012-8.7", path],
}


def newest(compiler):
    """The highest version of a compiler that is installed: gcc-12 and clang-19 on Debian 12."""
    found = [re.fullmatch(r".*/%s-(\d+)" % compiler, path) for path in glob.glob("/usr/bin/%s-*" % compiler)]
    return "%s-%d" % (compiler, max(int(match.group(1)) for match in found if match))


def findings(tool, path):
    """(tool, rule, file, line, text) of all that a tool says of a source."""
    said = subprocess.run(TOOLS[tool](path), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace").stdout
    found = set()
    for file, line, text, rule in FOUND.findall(said):
        if "note:" not in text:
            found.add((tool, rule, os.path.relpath(file), int(line), text))
    if ": error: " in said and not found:
        found.add((tool, "cannot read", path, 0, said[:200]))
    return found


def deviations():
    """(rule, files, reason) of each line."""
    rows = []
    with open(DEVIATIONS) as file:
        for line in file:
            if line.strip() and line[0] != "#":
                rule, files, reason = line.split(None, 2)
                rows.append((rule, files, reason.strip()))
    return rows


def explained(finding, rows):
    """The deviation that explains a finding, or None."""
    for row in rows:
        if any(fnmatch.fnmatch(rule, row[0]) for rule in finding[1].split(",")) and fnmatch.fnmatch(finding[2], row[1]):
            return row
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    gate.need("cc", "clang", "clang-19", "clang-tidy", "cppcheck")
    sources = gate.engine()
    with concurrent.futures.ThreadPoolExecutor(gate.JOBS) as pool:
        found = set().union(*pool.map(lambda job: findings(*job), [(tool, path) for tool in TOOLS for path in sources
                                                                if tool != "MISRA" or path.startswith("src/num/")]))
    rows, used, left = deviations(), collections.Counter(), []
    for finding in sorted(found):
        row = explained(finding, rows)
        if row:
            used[row] += 1
        else:
            left.append(finding)
    for tool, rule, file, line, text in left:
        print("%s: %s:%d: %s [%s]" % (tool, file, line, text, rule))
    for row in rows:
        if not used[row]:
            print("explains nothing: %s %s" % row[:2])
            left.append(row)
    for tool in TOOLS:
        print("%-15s %5d findings" % (tool, sum(finding[0] == tool for finding in found)))
    print("%d findings, %d explained by %d deviations, %d unexplained" %
          (len(found), sum(used.values()), len(used), len(left)))
    if options.record:
        evidence.record("analysis", {
            "findings unexplained": (len(left), "less"), "findings explained": (sum(used.values()), "fact"),
            "deviations": (len(rows), "fact"), "sources": (len(sources), "fact")})
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Lines, branches and conditions of src/ that the host tests run: tools/coverage.py [--short] PROGRAM...

The programs are built by the clang of COVERED=1, which counts lines, both ways of every branch, and for MC/DC each condition
that decides alone. Two run at a time; the counts of all are one. out/coverage/files.csv has the figures of each file,
out/coverage/gaps.txt what never happens:

    FILE FUNCTION: never runs
    FILE FUNCTION: never true: CONDITION       (or never false)
    FILE FUNCTION: never alone: CONDITION      it goes both ways, and no pair of runs shows that it alone decides

Each gap must stand in tests/coverage_gaps.txt with its reason. In the long form each that stands there must be one, too. Two gaps
that read the same are two lines there.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import shutil
import subprocess
import sys
import time

import evidence
import results

ROOT = evidence.ROOT
KEPT, OUT = os.path.join(ROOT, "tests", "coverage_gaps.txt"), os.path.join(ROOT, "out", "coverage")
COUNTS = os.path.join(ROOT, "build", "coverage")
LLVM = "-19"
SECONDS = 1500  # a program that takes longer hangs


def run(program):
    """Run a program; a complaint if it fails, and its counts go to a file of its own."""
    began, name = time.monotonic(), os.path.basename(program).removesuffix(".elf")
    into = dict(os.environ, LLVM_PROFILE_FILE=os.path.join(COUNTS, name + "-%p.profraw"))
    with open(os.path.join(COUNTS, name + ".log"), "w") as log:
        status = subprocess.run([os.path.abspath(program)], stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=into,
                                timeout=SECONDS).returncode
    print("%5.0f s  %s" % (time.monotonic() - began, name), flush=True)
    return status and "%s: exit status %d, see %s" % (name, status, log.name)


def counted(programs):
    """What all runs together counted, as llvm-cov exports it."""
    whole, first = os.path.join(COUNTS, "all.profdata"), [os.path.join(COUNTS, name) for name in sorted(os.listdir(COUNTS))]
    subprocess.run(["llvm-profdata" + LLVM, "merge", "-o", whole, *[name for name in first if name.endswith(".profraw")]], check=True)
    objects = [word for program in programs[1:] for word in ("-object", program)]
    said = subprocess.run(["llvm-cov" + LLVM, "export", "-instr-profile", whole, programs[0], *objects, os.path.join(ROOT, "src"),
                           os.path.join(ROOT, "include")], stdout=subprocess.PIPE, check=True).stdout
    return json.loads(said)["data"][0]


def lines(segments):
    """{line: how often it ran} by the rule of llvm-cov: the largest count of a region that begins in a line, or the one that
    it lies in."""
    found, before = {}, None
    by_line = collections.defaultdict(list)
    for segment in segments:
        by_line[segment[0]].append(segment)
    for line in range(segments[0][0], segments[-1][0] + 1):
        here = by_line[line]
        begin = [count for _, _, count, has, entry, gap in here if has and entry and not gap]
        skipped = here and not here[0][3] and here[0][4]
        if begin or not skipped and before and before[3]:
            found[line] = max(begin + ([before[2]] if before and before[3] else []))
        before = here[-1] if here else before
    return found


class File:
    """A source or header: its lines, branches, decisions, and the functions in it."""

    def __init__(self, data):
        self.path = os.path.relpath(data["filename"], ROOT)
        with open(data["filename"]) as file:
            self.text = file.read().split("\n")
        self.lines = lines(data["segments"]) if data["segments"] else {}
        self.branches, self.decisions, self.functions = {}, {}, {}
        # a function of a header is there once for each source
        for branch in data["branches"]:
            old = self.branches.get(tuple(branch[:4]), (0, 0))
            self.branches[tuple(branch[:4])] = old[0] + branch[4], old[1] + branch[5]
        for decision in data["mcdc_records"]:
            old = self.decisions.get(tuple(decision[:4]), [False] * len(decision[-1]))
            self.decisions[tuple(decision[:4])] = [a or b for a, b in zip(old, decision[-1])]

    def function(self, line):
        """The function that a line is in."""
        return max((place for place in self.functions if place[0] <= line), default=(0, "?"))[1]

    def source(self, place):
        """The text between two places."""
        top, left, end, right = place
        text = [self.text[line - 1][(left - 1 if line == top else 0):(right - 1 if line == end else None)]
                for line in range(top, end + 1)]
        return " ".join(" ".join(text).split())

    def conditions(self, decision):
        """The branches of a decision, in the order of the text."""
        return sorted(place for place in self.branches if decision[:2] <= place[:2] and place[2:] <= decision[2:])

    def gaps(self):
        """(line, what) of all that never happens; a branch in what never runs is no gap of its own."""
        for (line, name), count in self.functions.items():
            if count == 0:
                yield line, "never runs"
        for place, (true, false) in self.branches.items():
            if (true == 0) != (false == 0):
                yield place[0], "never %s: %s" % ("true" if true == 0 else "false", self.source(place))
        for decision, alone in self.decisions.items():
            conditions = self.conditions(decision)
            for number, shown in enumerate(alone):
                place = conditions[number] if len(conditions) == len(alone) else decision
                if not shown and all(self.branches.get(place, (1, 1))):
                    yield place[0], "never alone: " + self.source(place)

    def totals(self):
        """Covered and all: lines, branches, conditions."""
        ways = [way > 0 for branch in self.branches.values() for way in branch]
        alone = [shown for decision in self.decisions.values() for shown in decision]
        return [sum(count > 0 for count in self.lines.values()), len(self.lines), sum(ways), len(ways), sum(alone), len(alone)]


def files(data):
    """The files, by name."""
    found = {each["filename"]: File(each) for each in data["files"]}
    for function in data["functions"]:
        name = function["name"].rpartition(":")[2]
        for path in function["filenames"][:1]:
            if path in found:
                key = function["regions"][0][0], name
                found[path].functions[key] = found[path].functions.get(key, 0) + function["count"]
    return sorted(found.values(), key=lambda file: file.path)


def kept():
    """The gaps that are explained, as often as they stand there. A comment gives the reason of those below it."""
    found, reason = collections.Counter(), False
    with open(KEPT) as file:
        for line in file.read().split("\n"):
            if line.startswith("#") or not line:
                reason = bool(line) and "SPDX" not in line
            elif reason:
                found[line] += 1
            else:
                sys.exit("%s: no reason above: %s" % (KEPT, line))
    return found


def judge(found, short):
    """Compare gaps {text: places} with those that are explained; the complaints."""
    explained = kept()
    for text, places in sorted(found.items()):
        if len(places) > explained[text]:
            yield "not explained, line %s: %s" % (", ".join(map(str, sorted(places))), text)
    for text, times in sorted(explained.items()):
        if not short and times > len(found.get(text, ())):
            yield "no gap any more: " + text


def write(all_files):
    """The files of out/coverage; the gaps {text: places} and the totals."""
    os.makedirs(OUT, exist_ok=True)
    found, rows, totals = collections.defaultdict(list), [], [0] * 6
    for file in all_files:
        for line, what in file.gaps():
            found["%s %s: %s" % (file.path, file.function(line), what)].append(line)
        rows.append([file.path, *file.totals()])
        totals = [a + b for a, b in zip(totals, file.totals())]
    results.write(os.path.join(OUT, "files.csv"), "file,lines run,lines,branches gone,branches,conditions alone,conditions", rows)
    with open(os.path.join(OUT, "gaps.txt"), "w") as text:
        for gap, places in sorted(found.items()):
            text.writelines("%s  (line %d)\n" % (gap, line) for line in sorted(places))
    with open(os.path.join(OUT, "lines.txt"), "w") as text:
        for file in all_files:
            text.writelines("%s:%d: %s\n" % (file.path, line, file.text[line - 1]) for line, count in file.lines.items() if count == 0)
    return found, totals


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", action="store_true", help="compare with the figures kept, and keep none")
    parser.add_argument("--again", action="store_true", help="run nothing: judge the counts that are there")
    parser.add_argument("programs", nargs="+")
    asked = parser.parse_args()
    failed = []
    if not asked.again:
        shutil.rmtree(COUNTS, ignore_errors=True)
        os.makedirs(COUNTS)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            failed = [complaint for complaint in pool.map(run, asked.programs) if complaint]
    found, totals = write(files(counted(asked.programs)))
    names = "line, %", "branch, %", "MC/DC, %"
    values = [round(100.0 * totals[2 * k] / totals[2 * k + 1], 2) for k in range(3)]
    for name, value, k in zip(names, values, range(3)):
        print("%-10s %6.2f   %d of %d" % (name, value, totals[2 * k], totals[2 * k + 1]))
    failed += judge(found, asked.short)
    held = True
    if asked.short:
        held = evidence.ratchet("coverage", dict(zip(names, values)))
    elif not failed:
        evidence.record("coverage", {**{name: (value, "more") for name, value in zip(names, values)},
                                     "gaps": (sum(map(len, found.values())), "less")})
    for complaint in failed:
        print("FAIL " + complaint)
    return bool(failed) or not held


if __name__ == "__main__":
    sys.exit(main())

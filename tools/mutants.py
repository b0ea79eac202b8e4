#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Change the engine in one place at a time and see whether the tests notice: tools/mutants.py [--count N] [--most N] [--files PART]

A mutant is one change in a source of src/: an operator, a constant by one, a dropped statement or a negated condition. Files have
mutants by their length, each at least one; the same numbers are the same mutants as long as the file does not change. A mutant
is
    caught    a test fails, ends early or does not end
    equal     the compiler makes the same object of it
    refused   it does not compile
    judged    no test notices, and tests/mutants_alive.csv gives the reason: it changes nothing, or costs alone
    alive     no test notices, and it is not listed there
Each worker has a clone of the last commit in build/mutants, compiled at -O1. The suites of the mutant's folder run
first, then the plays, all suites, and the host's programs. Results go to out/mutants.csv. Mutants that are alive are
printed, and count as missed. --record writes the share of those caught to docs/evidence.md.
"""
import argparse
import collections
import concurrent.futures
import csv
import glob
import os
import queue
import random
import re
import subprocess
import sys
import time

import evidence
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT, JUDGED = os.path.join(ROOT, "out", "mutants.csv"), os.path.join(ROOT, "tests", "mutants_alive.csv")
COLUMNS = ["file", "line", "change", "column", "became", "result", "by", "seconds"]
SLOWER = 4  # a test may take so many times as long as without a change, and a few seconds
BUILD = ["make", "-s", "BOARD=host", "OPT=-O1", "WARNINGS=-w"]
# host programs that judge the engine, the quick ones first; the rest (soaks, fuzzers, oracles of many worlds) takes minutes
PROGRAMS = ["host_head", "host_motion", "host_pools", "host_wake", "host_replay", "host_encounter", "host_roll", "host_bounce",
            "host_rest", "host_scenes", "host_sheet", "host_recall", "host_rules", "host_physics"]
# suites of a folder whose names do not begin with it
SUITES = {"step": "world", "contact": "solve", "interfere": "boyse"}

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "+", "/": "*", "<<": ">>",
         ">>": "<<", "&": "|", "|": "&", "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "|=": "&=", "&=": "|=", "^": "|"}
OPERATOR = re.compile(r"(?<=[\w)\]] )(%s)(?= [\w(~!&*-])" % "|".join(re.escape(o) for o in sorted(SWAPS, key=len, reverse=True)))
CONSTANT = re.compile(r"(?<![\w.])(\d+)(?![\w.])")
STATEMENT = re.compile(r"^( +)((?!return|break|continue|goto|case|default|else|do\b|typedef|const |static |struct |enum |unsigned |int\w* "
                       r"|uint\w+ |bool |size_t |char |void |carom_\w+ \w)[\w(*].*;)$")
ROOM = re.compile(r"^[^=(]*\[\w+\][^=(]*;$")  # a declaration of arrays: one more place changes nothing
CONDITION = re.compile(r"^ +(?:} else )?if \((.*)\) {$")
BLANKED = re.compile(r'/\*.*?\*/|"(?:[^"\\\n]|\\.)*"|^#(?:[^\n\\]|\\.|\\\n)*', re.S | re.M)
SKIPPED = re.compile(r"ASSERT|PHASE_|_Static_assert")  # assertions are compiled out

Mutant = collections.namedtuple("Mutant", "file line change column became")


def blanked(text):
    """The text with blanks for comments, strings and directives."""
    return BLANKED.sub(lambda found: re.sub(r"[^\n]", " ", found.group(0)), text)


def changes_of(line, begins):
    """All changes of a line: kind, place, length, new text. `begins`: a statement begins here."""
    for found in OPERATOR.finditer(line):
        yield "operator", found.start(1), len(found.group(1)), SWAPS[found.group(1)]
    for found in () if ROOM.match(line) else CONSTANT.finditer(line):
        yield "constant", found.start(1), len(found.group(1)), str(int(found.group(1)) + 1)
    found = STATEMENT.match(line)
    if found and begins:
        yield "dropped", found.start(2), len(found.group(2)), ";"
    found = CONDITION.match(line)
    if found:
        yield "negated", found.start(1), len(found.group(1)), "!(%s)" % found.group(1)


def mutants_of(path):
    """All mutants of a file, within its functions."""
    with open(os.path.join(ROOT, path)) as file:
        lines = blanked(file.read()).split("\n")
    begins = True
    for number, line in enumerate(lines, 1):
        if line.startswith(" ") and not SKIPPED.search(line):
            for kind, at, length, text in changes_of(line, begins):
                yield Mutant(path, number, kind, at, (length, text))
        if line.strip():
            begins = line.rstrip().endswith((";", "{", "}", ":"))


def chosen(count, part):
    """Mutants of all files, by their length."""
    paths = [path for path in sorted(glob.glob("src/*/*.c", root_dir=ROOT)) if part in path]
    everything = {path: list(mutants_of(path)) for path in paths}
    total = sum(map(len, everything.values()))
    for path, mutants in everything.items():
        share = min(len(mutants), max(1, round(count * len(mutants) / total)))
        yield from random.Random(path).sample(mutants, share)


def changed(text, mutant):
    lines = text.split("\n")
    line, (length, new) = lines[mutant.line - 1], mutant.became
    lines[mutant.line - 1] = line[:mutant.column] + new + line[mutant.column + length:]
    return "\n".join(lines)


class Worker:
    """A clone in which mutants are made one after another."""

    def __init__(self, number):
        self.folder = os.path.join(ROOT, "build", "mutants", str(number))
        if not os.path.isdir(self.folder):
            subprocess.run(["git", "clone", "--quiet", "--no-local", ROOT, self.folder], check=True)
        subprocess.run(["git", "fetch", "--quiet", "origin", "HEAD"], cwd=self.folder, check=True)
        subprocess.run(["git", "reset", "--quiet", "--hard", "FETCH_HEAD"], cwd=self.folder, check=True)
        self.programs = [name for name in PROGRAMS if os.path.exists(os.path.join(self.folder, "tests", name + ".c"))]
        self.make("tests", "matrix", *self.programs, check=True)
        self.limits = {}
        for command in [["tests.elf"], ["matrix.elf"], *([name + ".elf"] for name in self.programs)]:
            start = time.monotonic()
            if not self.passes(command, 1800):
                sys.exit("%s fails without a change" % command)
            self.limits[command[0]] = 10 + SLOWER * (time.monotonic() - start)

    def make(self, *programs, check=False):
        return subprocess.run([*BUILD, *("build/host/%s.elf" % name for name in programs)], cwd=self.folder, check=check,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0

    def object_of(self, path):
        with open(os.path.join(self.folder, "build/host", path[:-2] + ".o"), "rb") as file:
            return file.read()

    def passes(self, command, limit):
        """True if a program succeeds and no line of it says "not ok"."""
        if command[0] == "matrix.elf":
            command = ["tools/plays.py", "build/host/matrix.elf"]
        else:
            command = ["build/host/" + command[0], *command[1:]]
        process = subprocess.Popen(["timeout", "-k", "1", "%d" % limit, *command], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, errors="replace")
        held = True
        for line in process.stdout:
            if line.startswith("not ok"):
                held = False
                process.terminate()
                break
        process.stdout.close()
        return process.wait() == 0 and held

    def noticed(self, mutant):
        """The first test that notices a mutant that is built, or None."""
        folder = mutant.file.split("/")[1]
        for command in [["tests.elf", SUITES.get(folder, folder)], ["matrix.elf"], ["tests.elf"]]:
            if not self.passes(command, self.limits[command[0]]):
                return " ".join(command)
        for name in self.programs:
            self.make(name)
            if not self.passes([name + ".elf"], self.limits[name + ".elf"]):
                return name
        return None

    def judge(self, mutant):
        """A row of the results."""
        path = os.path.join(self.folder, mutant.file)
        with open(path) as file:
            text = file.read()
        before, start, by = self.object_of(mutant.file), time.monotonic(), ""
        try:
            with open(path, "w") as file:
                file.write(changed(text, mutant))
            if not self.make("tests", "matrix"):
                result = "refused"
            elif self.object_of(mutant.file) == before:
                result = "equal"
            else:
                by = self.noticed(mutant) or ""
                result = "caught" if by else "alive"
        finally:
            with open(path, "w") as file:
                file.write(text)
        return [mutant.file, mutant.line, mutant.change, mutant.column, mutant.became[1], result, by,
                "%.0f" % (time.monotonic() - start)]


def judged():
    """Mutants that are known to change nothing, or costs alone, by file, text of the line and change."""
    return {(row["file"], row["code"], row["change"], row["became"]): row["reason"] for row in results.read(JUDGED)}


def code_of(row):
    with open(os.path.join(ROOT, row[0])) as file:
        return file.read().split("\n")[row[1] - 1].strip()


def run(mutants, jobs):
    """Judge all mutants; prints those alive."""
    free, known, rows = queue.Queue(), judged(), []
    for number in range(jobs):
        free.put(Worker(number))

    def one(mutant):
        worker = free.get()
        try:
            row = worker.judge(mutant)
        finally:
            free.put(worker)
        if row[5] == "alive" and (row[0], code_of(row), row[2], row[4]) in known:
            row[5] = "judged"
        if row[5] == "alive":
            print("alive: %s:%d: %s at %d becomes %s: %s" % (*row[:5], code_of(row)), flush=True)
        rows.append(row)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, mutants))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--most", type=int, help="of these, spread over all files")
    parser.add_argument("--files", default="", help="a part of their paths")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    mutants = list(chosen(arguments.count, arguments.files))
    if arguments.most:
        mutants = random.Random(1).sample(mutants, min(arguments.most, len(mutants)))
    rows = run(mutants, arguments.jobs)
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([COLUMNS, *sorted(rows)])
    counts = collections.Counter(row[5] for row in rows)
    asked = counts["caught"] + counts["alive"]
    share = round(100 * counts["caught"] / max(asked, 1), 1)
    print("%d mutants: %s; %.1f %% of %d caught" % (len(rows), ", ".join("%d %s" % (n, what) for what, n in sorted(counts.items())),
                                                    share, asked))
    if arguments.record:
        evidence.record("mutants", {"mutants that tests could notice": (asked, "fact"), "caught, %": (share, "more"),
                                    "judged equal or of cost alone": (counts["judged"], "fact")})
        return 0
    return not evidence.ratchet("mutants", {"caught, %": share}) if not arguments.most else counts["alive"] > 0


if __name__ == "__main__":
    sys.exit(main())

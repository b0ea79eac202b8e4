#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Change the engine in one place at a time and see whether the tests notice:
tools/mutants.py [--count N] [--most N] [--seed N] [--files PART] [--seconds S] [--resume] [--again]

A mutant is one change in a source of src/: an operator, a constant by one, a dropped statement or a negated condition. Files have
mutants by their length, each at least one; the same numbers are the same mutants as long as the file does not change. A mutant
is
    caught    a test fails, ends early or does not end
    equal     the compiler makes the same object of it
    refused   it does not compile
    judged    no test notices, and tests/mutants_alive.csv gives the reason: it changes nothing, or costs alone
    alive     no test notices, and it is not listed there
    open      no test noticed in --seconds, and some were not asked
Each worker has a clone of the last commit in build/mutants. It asks the tests that run the changed line (tools/mutant_tests.py): first
the one that tests/mutants_caught.csv names, which --record writes, then those that caught most mutants of the folder for their time. Rows go to out/mutants.csv as they come. --resume keeps those that are there if
src/ is the same, so parts of a whole run are merged; --again asks again for those that no test noticed. Mutants that are alive or
open are printed, and count as missed. --record writes the share of those caught to docs/evidence.md.
"""
import argparse
import collections
import concurrent.futures
import csv
import glob
import hashlib
import os
import queue
import random
import re
import resource
import subprocess
import sys
import threading
import time

import evidence
import mutant_tests
import plays
import results

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUT = os.path.join(ROOT, "out", "mutants.csv")
JUDGED, CAUGHT = (os.path.join(ROOT, "tests", "mutants_%s.csv" % name) for name in ("alive", "caught"))
COLUMNS = ["file", "line", "change", "column", "became", "result", "by", "seconds", "src"]
SLOWER = 4  # a test may take so much more processor time as without a change, and a few seconds
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


def chosen(count, part, seed):
    """Mutants by the length of their files; those of a part are the same ones as in the whole."""
    paths = sorted(glob.glob("src/*/*.c", root_dir=ROOT))
    everything = {path: list(mutants_of(path)) for path in paths}
    total = sum(map(len, everything.values()))
    for path, mutants in everything.items():
        if not any(one in path for one in part.split(",")):
            continue
        share = min(len(mutants), max(1, round(count * len(mutants) / total)))
        yield from random.Random(path if seed == 1 else "%s %d" % (path, seed)).sample(mutants, share)


def changed(text, mutant):
    lines = text.split("\n")
    line, (length, new) = lines[mutant.line - 1], mutant.became
    lines[mutant.line - 1] = line[:mutant.column] + new + line[mutant.column + length:]
    return "\n".join(lines)


class Caught:
    """Who caught how many mutants of a folder."""

    def __init__(self):
        self.counts, self.lock = collections.Counter(), threading.Lock()
        self.before = {tuple(row.values())[:5]: row["by"] for row in results.read(CAUGHT)}

    def add(self, folder, name):
        with self.lock:
            self.counts[folder, name] += 1

    def order(self, mutant, tests):
        """First the test that caught the mutant in a former run; then those that caught most of its folder for their time; before
        any did, the folder's own suites, the quick ones, and those that run most of the engine."""
        folder, by = folder_of(mutant.file), self.before.get(name_of(mutant))
        own = "tests.elf " + SUITES.get(folder, folder)
        first = {"worlds.elf": 5, "matrix.elf": 1}
        return sorted(tests, key=lambda test: (test.name != by, -(self.counts[folder, test.name] +
                                                                 first.get(test.name, .1 if test.name.startswith(own) else .01)) /
                                               (test.seconds + .02)))


class Worker:
    """A clone in which mutants are made one after another."""

    def __init__(self, number, caught):
        self.folder, self.caught = mutant_tests.clone(number), caught
        self.tests = mutant_tests.known(self.folder)
        self.plays = [row for part in plays.COLUMNS for row in plays.kept(part, self.folder)]
        self.links = mutant_tests.links(self.folder, {test.program for test in self.tests})

    def object_of(self, path):
        with open(os.path.join(self.folder, "build/host", path[:-2] + ".o"), "rb") as file:
            return file.read()

    def put_back(self, path, text, time_ns, before):
        """The source as it was, and its object."""
        source, compiled = (os.path.join(self.folder, name) for name in (path, "build/host/%s.o" % path[:-2]))
        with open(source, "w") as file:
            file.write(text)
        os.utime(source, ns=(time_ns, time_ns))
        with open(compiled, "wb") as file:
            file.write(before)
        checked = compiled.replace("/build/host/", "/build/host-debug/")
        if os.path.exists(checked):
            os.remove(checked)

    def passes(self, test):
        """True if a test succeeds in its time, no line is "not ok", and no play ends in another hash. The time is the
        processor's, so that a busy machine fails none."""
        limit, end = int(5 + SLOWER * test.seconds), 1 + plays.columns_of(test.program)
        process = subprocess.Popen(test.command(), cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True, errors="replace", start_new_session=True,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
        held = True
        for line in process.stdout:
            if line.startswith("not ok") or line.startswith("scene ") and line.split()[1:end] not in self.plays:
                held = False
                process.kill()
                break
        process.stdout.close()
        return process.wait() == 0 and held

    def noticed(self, mutant, seconds):
        """Whether a mutant that is built is caught, alive or open, and the first test that notices it."""
        asked = [test for test in self.tests if mutant.line in test.lines.get(mutant.file, ())]
        if not any(mutant.line in test.executable.get(mutant.file, ()) for test in self.tests):
            asked = self.tests  # a line that the compiler does not count
        linked, spent, result = set(), 0, "alive"
        for test in self.caught.order(mutant, asked):
            if seconds and spent + test.seconds > seconds:
                result = "open"
                continue
            if test.program not in linked:
                if test.program == mutant_tests.DEBUG:
                    mutant_tests.make(self.folder, "DEBUG=1", "build/host-debug/libcarom.a", check=True)
                subprocess.run(self.links[test.program], shell=True, cwd=self.folder, check=True)
                linked.add(test.program)
            spent += test.seconds
            if not self.passes(test):
                self.caught.add(folder_of(mutant.file), test.name)
                return "caught", test.name
        return result, ""

    def judge(self, mutant, seconds):
        """The result of a mutant, and who noticed it."""
        path = os.path.join(self.folder, mutant.file)
        with open(path) as file:
            text = file.read()
        time_ns, before = os.stat(path).st_mtime_ns, self.object_of(mutant.file)
        try:
            with open(path, "w") as file:
                file.write(changed(text, mutant))
            if not mutant_tests.make(self.folder, "build/host/libcarom.a"):
                return "refused", ""
            if self.object_of(mutant.file) == before:
                return "equal", ""
            return self.noticed(mutant, seconds)
        finally:
            self.put_back(mutant.file, text, time_ns, before)


def judged():
    """Mutants that are known to change nothing, or costs alone, by file, text of the line and change."""
    return {(row["file"], row["code"], row["change"], row["became"]): row["reason"] for row in results.read(JUDGED)}


def folder_of(path):
    return path.split("/")[1]


def code_of(mutant):
    with open(os.path.join(ROOT, mutant.file)) as file:
        return file.read().split("\n")[mutant.line - 1].strip()


def name_of(mutant):
    """A mutant as tests/mutants_caught.csv names it: by the text of its line, since lines move."""
    return mutant.file, code_of(mutant), *map(str, mutant[2:4]), mutant.became[1]


def judgement(mutant):
    """A mutant as the list of those that were judged names it."""
    return mutant.file, code_of(mutant), mutant.change, mutant.became[1]


def key_of(mutant):
    """A mutant as the results name it."""
    return (mutant.file, *map(str, mutant[1:4]), mutant.became[1])


def run(mutants, jobs, seconds, known, others):
    """Judge all mutants that are not known; the rows. Prints those that no test noticed. `others` stay in the file."""
    caught, free, reasons, rows = Caught(), queue.Queue(), judged(), list(known.values())
    for mutant in mutants:
        row = known.get(key_of(mutant))
        if row and row[5] == "caught":
            caught.add(folder_of(row[0]), row[6])
        elif row and row[5] in ("alive", "open") and judgement(mutant) in reasons:
            row[5] = "judged"
    asked, src = [mutant for mutant in mutants if key_of(mutant) not in known], source()
    for number in range(min(jobs, len(asked))):
        free.put(Worker(number, caught))

    def one(mutant):
        worker, start = free.get(), time.monotonic()
        try:
            result, by = worker.judge(mutant, seconds)
        finally:
            free.put(worker)
        if result in ("alive", "open"):
            if judgement(mutant) in reasons:
                result = "judged"
            print("%s: %s:%s: %s at %s becomes %s: %s" % (result, *key_of(mutant), code_of(mutant)), flush=True)
        with caught.lock:
            rows.append([*key_of(mutant), result, by, "%.0f" % (time.monotonic() - start), src])
            write(rows + others)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, asked))
    write(rows + others)
    return rows


def source():
    """A digest of src/ without its comments."""
    said = hashlib.sha256()
    for path in sorted(glob.glob("src/*/*.[ch]", root_dir=ROOT)):
        with open(os.path.join(ROOT, path)) as file:
            said.update(re.sub(r"\s+", " ", blanked(file.read())).encode())
    return said.hexdigest()[:8]


def write(rows):
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *sorted(rows, key=lambda row: (row[0], int(row[1]), row))])


def keep_caught(rows):
    """Write which test caught which mutant."""
    with open(CAUGHT, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["file", "code", "change", "column", "became", "by"])
        for row in sorted(rows, key=lambda row: (row[0], int(row[1]), row)):
            if row[5] == "caught":
                writer.writerow([*name_of(Mutant(row[0], int(row[1]), row[2], row[3], (0, row[4]))), row[6]])


def former(again):
    """The rows of former runs of the same src/, by mutant; without those that more tests may change, if they are asked again."""
    src = source()
    return {tuple(row.values())[:5]: list(row.values()) for row in results.read(OUT)
            if row["src"] == src and not (again and row["result"] in ("alive", "open"))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--most", type=int, help="of these, spread over all files")
    parser.add_argument("--seed", type=int, default=1, help="of another choice of mutants")
    parser.add_argument("--files", default="", help="parts of their paths, with commas")
    parser.add_argument("--seconds", type=float, help="that the tests of a mutant may take without it")
    parser.add_argument("--resume", action="store_true", help="keep the results of former runs of the same src/")
    parser.add_argument("--again", action="store_true", help="the same, but ask again for those that no test noticed")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    mutants = list(chosen(arguments.count, arguments.files, arguments.seed))
    if arguments.most:
        mutants = random.Random(1).sample(mutants, min(arguments.most, len(mutants)))
    asked = set(map(key_of, mutants))
    kept = former(arguments.again) if arguments.resume or arguments.again else {}
    known = {key: row for key, row in kept.items() if key in asked}
    rows = run(mutants, arguments.jobs, arguments.seconds, known, [row for key, row in kept.items() if key not in asked])
    counts = collections.Counter(row[5] for row in rows)
    asked = counts["caught"] + counts["alive"] + counts["open"]
    share = round(100 * counts["caught"] / max(asked, 1), 1)
    print("%d mutants: %s; %.1f %% of %d caught" % (len(rows), ", ".join("%d %s" % (n, what) for what, n in sorted(counts.items())),
                                                    share, asked))
    if arguments.seed != 1:
        if arguments.record:
            evidence.record("mutants", {"other mutants that tests could notice": (asked, "sum"),
                                        "other mutants, caught": (counts["caught"], "sum")})
        return 0
    if arguments.record:
        keep_caught(rows)
        evidence.record("mutants", {"mutants": (len(rows), "fact"),
                                    "refused, or the same object": (counts["refused"] + counts["equal"], "fact"),
                                    "judged equal or of cost alone": (counts["judged"], "fact"),
                                    "that tests could notice": (asked, "fact"), "caught": (counts["caught"], "fact"),
                                    "caught, %": (share, "more"),
                                    "missed by all tests": (counts["alive"], "fact"),
                                    "missed by those that were asked": (counts["open"], "fact")})
        return 0
    return not evidence.ratchet("mutants", {"caught, %": share}) if not arguments.most else counts["alive"] > 0


if __name__ == "__main__":
    sys.exit(main())

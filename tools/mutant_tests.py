# SPDX-License-Identifier: MIT
"""The tests that judge mutants: the time of each, and the lines of src/ that it runs.

They are the plays, random worlds, each test of tests.elf by itself, host programs, and the suites of tests.elf with the sanitizers
and the assertions. A build with the counters of `make coverage`
tells once for each commit which lines a test runs: a change in any other line it cannot notice.
"""
import collections
import json
import os
import re
import resource
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# host programs that judge the engine in seconds; the rest (soaks, fuzzers, oracles of many worlds) takes minutes
PROGRAMS = ["host_head", "host_motion", "host_pools", "host_wake", "host_replay", "host_encounter", "host_roll", "host_bounce",
            "host_rest", "host_scenes", "host_sheet", "host_recall", "host_rules", "host_physics"]
BUILT = ("tests", "matrix", "worlds", *PROGRAMS)
COUNTED, DEBUG = "build/host-covered/", "host-debug/tests.elf"
# without what debuggers want, so that objects that are the same code are the same bytes
BUILD = ["make", "-s", "BOARD=host", "WARNINGS=-w -g0"]


class Test(collections.namedtuple("Test", "name seconds lines executable")):
    """`lines` that it runs, and the `executable` ones, are {file: set of lines}."""

    @property
    def program(self):
        return self.name.split()[0]

    def command(self, folder="build/host/"):
        program, *select = self.name.split()
        # the sanitizers refuse what stdbuf loads
        return ["build/" + DEBUG, *select] if program == DEBUG else ["stdbuf", "-oL", folder + program, *select]


def make(folder, *targets, check=False):
    return subprocess.run([*BUILD, *targets], cwd=folder, check=check, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode == 0


def links(folder, programs):
    """The commands that link programs: make would make the converter of the changed engine first, and all meshes with it."""
    said = subprocess.run([*BUILD, "-n", "-W", "build/host/libcarom.a",
                           *("build/host/" + name for name in sorted(programs - {DEBUG}))], cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout
    said += subprocess.run([*BUILD, "-n", "DEBUG=1", "-W", "build/host-debug/libcarom.a", "build/" + DEBUG], cwd=folder,
                           stdout=subprocess.PIPE, text=True, check=True).stdout
    return dict(reversed(found) for found in re.findall(r"^(cc .* -o build/(?:host/)?(\S+\.elf) .*)$", said, re.M))


def clone(number):
    """A clone of the last commit, built."""
    folder = os.path.join(ROOT, "build", "mutants", str(number))
    if not os.path.isdir(folder):
        subprocess.run(["git", "clone", "--quiet", "--no-local", ROOT, folder], check=True)
    subprocess.run(["git", "fetch", "--quiet", "origin", "HEAD"], cwd=folder, check=True)
    subprocess.run(["git", "reset", "--quiet", "--hard", "FETCH_HEAD"], cwd=folder, check=True)
    make(folder, *("build/host/%s.elf" % name for name in BUILT), check=True)
    make(folder, "DEBUG=1", "build/" + DEBUG, check=True)
    return folder


def names(folder):
    """The tests; a test of tests.elf prints its name on a line of its own."""
    said = subprocess.run(["build/host/tests.elf"], cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout
    return ["matrix.elf", "worlds.elf", *(name + ".elf" for name in PROGRAMS), *("tests.elf " + name for name in re.findall(r"^ok \d+ - (\S+)", said, re.M))]


def lines(folder, counts, program):
    """The lines of src/ that ran, and those that could."""
    subprocess.run(["llvm-profdata-19", "merge", "-o", counts, counts + ".raw"], check=True)
    said = subprocess.run(["llvm-cov-19", "export", "-format=lcov", "-skip-branches", "-skip-functions", "-instr-profile", counts,
                           COUNTED + program], cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout
    ran, could = {}, {}
    for line in said.splitlines():
        if line.startswith("SF:"):
            path = os.path.relpath(line[3:], folder)
        elif line.startswith("DA:"):
            number, count = map(int, line[3:].split(",")[:2])
            could.setdefault(path, []).append(number)
            if count:
                ran.setdefault(path, []).append(number)
    return ran, could


def measured(folder):
    """[name, seconds, lines that it runs] of each test, and {program: lines that could run}."""
    make(folder, "COVERED=1", *("%s%s.elf" % (COUNTED, name) for name in BUILT), check=True)
    rows, executable, counts = [], {}, os.path.join(folder, "build", "counts")
    for test in (Test(name, 0, {}, {}) for name in names(folder)):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(test.command(COUNTED), cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True,
                       env=dict(os.environ, LLVM_PROFILE_FILE=counts + ".raw"))
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        ran, executable[test.program] = lines(folder, counts, test.program)
        rows.append([test.name, seconds, ran])
    return [[*rows, *checked(folder, rows)], executable]


def checked(folder, rows):
    """The rows of the suites with sanitizers: a suite runs what its tests run."""
    suites = {}
    for name, _, ran in rows:
        if name.startswith("tests.elf "):
            of_suite = suites.setdefault(name.split()[1].split("/")[0] + "/", {})
            for path, numbers in ran.items():
                of_suite.setdefault(path, set()).update(numbers)
    for suite, of_suite in suites.items():
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        if subprocess.run(["build/" + DEBUG, suite], cwd=folder, stdout=subprocess.DEVNULL).returncode == 0:
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            yield [DEBUG + " " + suite, seconds, {path: sorted(numbers) for path, numbers in of_suite.items()}]


def known(folder):
    """The tests of the last commit; measured if they were not yet."""
    tree = subprocess.run(["git", "rev-parse", "HEAD:src", "HEAD:tests"], cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout
    kept = os.path.join(ROOT, "build", "mutants", "tests-%s.json" % "-".join(word[:8] for word in tree.split()))
    if not os.path.exists(kept):
        found = measured(folder)
        with open(kept, "w") as file:
            json.dump(found, file)
    with open(kept) as file:
        rows, executable = json.load(file)
    sets = {program: {path: set(numbers) for path, numbers in files.items()} for program, files in executable.items()}
    return [Test(name, seconds, {path: set(numbers) for path, numbers in ran.items()}, sets[os.path.basename(name.split()[0])])
            for name, seconds, ran in rows]

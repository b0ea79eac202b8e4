#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run programs and scripts that print TAP, and count: tools/run_tests.py [--select PART] FILE...

run_board.py runs a .elf file on the board that it was built for. The last line is "N passed, M failed"; the exit status is 1 if
M > 0 or N = 0. With --select, the runner of the suites (tests.elf) runs the tests whose names contain PART; other files run only
if their own names match it.

With --boards, every scene of those boards (with --first, the first one) runs on the board and on the host, and after some
frames both must have the same state.

Two workers share the files. Scripts and scenes on boards call make in this tree, so one worker runs them, one after
another; the other one begins with the programs, and both end there. The lines of a file are printed together, and
after them how long it took, and the processors' time of that.
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import threading
import time

import run_board

SECONDS = 480  # a program that takes longer hangs; it shares the machine with another program


def stem(path):
    return os.path.splitext(os.path.basename(path))[0].removeprefix("host_").removeprefix("test_")


def is_runner(path):
    """True if a program is the runner of the suites, which selects tests itself."""
    return stem(path) == "tests" or stem(path).startswith("suite_")


def wanted(path, select):
    return is_runner(path) or select in path or select.split("/")[0] == stem(path)


def command(path, select):
    if path.endswith(".sh"):
        return ["sh", path]
    if path.endswith(".mjs"):
        return ["node", path]
    if path.endswith(".py"):
        return [sys.executable, "-B", path]
    return run_board.command(path, [select] if select and is_runner(path) else [])


class Counts:
    """Counts the tests that passed and failed, and the cases that are left out because they are known to fail
    (tests/lib/open_cases.c)."""

    def __init__(self):
        self.lock = threading.Lock()
        self.passed = self.failed = self.left_out = 0

    def add(self, said, passed, failed, left_out=0):
        """Print the lines of a file, and count."""
        with self.lock:
            print(said, end="", flush=True)
            self.passed += passed
            self.failed += failed
            self.left_out += left_out


def run(path, select, counts, seconds):
    """Run one file."""
    began = time.monotonic()
    process = subprocess.Popen(command(path, select), stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, text=True, errors="replace")
    clock = threading.Timer(seconds, process.kill)
    clock.start()
    said = process.stdout.read()
    _, status, used = os.wait4(process.pid, 0)
    status = process.returncode = os.waitstatus_to_exitcode(status)
    clock.cancel()
    passed, failed = len(re.findall(r"^ok\b", said, re.M)), len(re.findall(r"^not ok\b", said, re.M))
    left_out = sum(map(int, re.findall(r"^# (\d+) known to fail, left out", said, re.M)))
    nothing_selected = bool(select) and re.search(r"^1\.\.0", said, re.M)
    if failed == 0 and not nothing_selected and (status != 0 or passed == 0):
        said += "not ok - %s: %d tests, exit status %d\n" % (path, passed, status)
        failed += 1
    counts.add("# %s\n%s# %s: %.0f s; processors %.0f s\n" % (
        path, said, path, time.monotonic() - began, used.ru_utime + used.ru_stime), passed, failed, left_out)


def scene_ends(board, scene, frames, seconds):
    """The state in which a scene ends on a board, or the failure."""
    image = os.path.join(run_board.ROOT, "build", board, "head.elf")
    result = run_board.run(image, ["scene=" + scene, "frames=%d" % frames], seconds)
    if result.status or len(result.rows) != frames:
        return "status %d after %d frames" % (result.status, len(result.rows))
    return result.said.get("hash", "no state")


def run_scenes(boards, first, frames, select, counts, seconds):
    """Compare boards with the host, scene by scene."""
    expected, number = {}, 0
    counts.add("# scenes on boards, against the host\n", 0, 0)
    for board in boards:
        for scene in list(run_board.scenes(board))[:1 if first else None]:
            name = "%s/%s" % (board, scene)
            if select not in name or board == "host":
                continue
            if scene not in expected:
                expected[scene] = scene_ends("host", scene, frames, seconds)
            found = scene_ends(board, scene, frames, seconds)
            ok = found == expected[scene] and bool(re.fullmatch("[0-9a-f]{16}", found))
            number += 1
            counts.add("%s %d - %s %s (%d frames)%s\n" % (
                "ok" if ok else "not ok", number, name, found, frames,
                "" if ok else ", on the host " + expected[scene]), ok, not ok)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--select", default="")
    parser.add_argument("--boards", default="", help="names, with spaces")
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--first", action="store_true")
    parser.add_argument("--seconds", type=int, default=SECONDS, help="that a program may take")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    counts = Counts()
    programs = [path for path in arguments.files if path.endswith(".elf") and wanted(path, arguments.select)]
    programs.reverse()  # the first is taken from the end

    def run_programs():
        while True:
            try:
                path = programs.pop()
            except IndexError:
                return
            run(path, arguments.select, counts, arguments.seconds)

    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        other = pool.submit(run_programs)
        if arguments.boards:
            run_scenes(arguments.boards.split(), arguments.first, arguments.frames, arguments.select, counts, arguments.seconds)
        for path in arguments.files:
            if not path.endswith(".elf") and wanted(path, arguments.select):
                run(path, arguments.select, counts, arguments.seconds)
        run_programs()
        other.result()
    if counts.left_out:
        print("%d cases that are known to fail were left out" % counts.left_out)
    print("%d passed, %d failed" % (counts.passed, counts.failed))
    return counts.failed > 0 or counts.passed == 0


if __name__ == "__main__":
    sys.exit(main())

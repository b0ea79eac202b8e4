#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run programs and scripts that print TAP, and count: tools/run_tests.py [--select PART] FILE...

run_board.py runs a .elf file on the board that it was built for. The last line is "N passed, M failed"; the exit status is 1 if
M > 0 or N = 0. With --select, the runner of the suites (tests.elf) runs the tests whose names contain PART; other files run only
if their own names match it.

With --boards, every scene of those boards (or with --first the first one) runs there and on the host, and after so many frames
both must be in the same state.
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


def run(path, select):
    """Run one file and pass its lines on; returns how many tests passed and failed, and how many cases were left out because
    they are known to fail (tests/lib/open_cases.c)."""
    passed = failed = left_out = 0
    nothing_selected = False
    process = subprocess.Popen(command(path, select), stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, text=True, errors="replace")
    clock = threading.Timer(SECONDS, process.kill)
    clock.start()
    for line in process.stdout:
        print(line, end="", flush=True)
        passed += bool(re.match(r"ok\b", line))
        failed += bool(re.match(r"not ok\b", line))
        known = re.match(r"# (\d+) known to fail, left out", line)
        left_out += int(known.group(1)) if known else 0
        nothing_selected |= line.startswith("1..0") and bool(select)
    status = process.wait()
    clock.cancel()
    if failed == 0 and not nothing_selected and (status != 0 or passed == 0):
        print("not ok - %s: %d tests, exit status %d" % (path, passed, status))
        failed += 1
    return passed, failed, left_out


def scene_ends(board, scene, frames):
    """The state in which a scene ends on a board, or the failure."""
    image = os.path.join(run_board.ROOT, "build", board, "head.elf")
    result = run_board.run(image, ["scene=" + scene, "frames=%d" % frames], SECONDS)
    if result.status or len(result.rows) != frames:
        return "status %d after %d frames" % (result.status, len(result.rows))
    return result.said.get("hash", "no state")


def run_scenes(boards, first, frames, select):
    """Compare boards with the host, scene by scene; returns how many passed and failed."""
    expected, passed, failed = {}, 0, 0
    for board in boards:
        for scene in list(run_board.scenes(board))[:1 if first else None]:
            name = "%s/%s" % (board, scene)
            if select not in name or board == "host":
                continue
            if scene not in expected:
                expected[scene] = scene_ends("host", scene, frames)
            found = scene_ends(board, scene, frames)
            ok = found == expected[scene] and re.fullmatch("[0-9a-f]{16}", found)
            passed, failed = passed + bool(ok), failed + (not ok)
            print("%s %d - %s %s (%d frames)%s" % (
                "ok" if ok else "not ok", passed + failed, name, found, frames,
                "" if ok else ", on the host " + expected[scene]), flush=True)
    return passed, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--select", default="")
    parser.add_argument("--boards", default="", help="names, with spaces")
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--first", action="store_true")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    passed = failed = left_out = 0
    if arguments.boards:
        print("# scenes on boards, against the host", flush=True)
        passed, failed = run_scenes(arguments.boards.split(), arguments.first, arguments.frames,
                                    arguments.select)
    for path in arguments.files:
        if wanted(path, arguments.select):
            print("# " + path, flush=True)
            counts = run(path, arguments.select)
            passed += counts[0]
            failed += counts[1]
            left_out += counts[2]
    if left_out:
        print("%d cases that are known to fail were left out" % left_out)
    print("%d passed, %d failed" % (passed, failed))
    return failed > 0 or passed == 0


if __name__ == "__main__":
    sys.exit(main())

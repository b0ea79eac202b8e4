# SPDX-License-Identifier: MIT
"""Tests in Python of a board's build results, in TAP."""
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def board_cases(suite, board, built, cases):
    """Build a board's programs and report each (name, whether it holds) of cases(); returns whether any failed.
    A board that cannot be built is skipped, but not in CI."""
    subprocess.run(["make", "-s", "-C", ROOT, "BOARD=" + board, "build"], stdout=subprocess.DEVNULL,
                   env={k: v for k, v in os.environ.items()
                        if not k.startswith("MAKE") and k != "MFLAGS"})
    if not os.path.exists(built) and "CI" not in os.environ:
        print("ok 1 - %s/built # SKIP the board cannot be built here\n1..1" % suite)
        return False
    failed = number = 0
    for number, (name, ok) in enumerate(cases(), 1):
        failed += not ok
        print("%s %d - %s/%s" % ("ok" if ok else "not ok", number, suite, name), flush=True)
    print("1..%d" % number)
    return failed > 0

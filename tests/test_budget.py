#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
A board that counts instructions reports for every step whether it kept its budget; for a step that did not, it
names the costliest stage. The test compares that with the counts of a run without a budget, to the instruction.
TAP.
"""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tools"))
import run_board  # noqa: E402

BOARD = "mps2-an385"
OPTIONS = ["scene=box", "frames=150"]
OVER = 1  # CAROM_OVER_BUDGET, a bit of the status
IMAGE = os.path.join(ROOT, "build", BOARD, "head.elf")


def run(*more):
    result = run_board.run(IMAGE, [*OPTIONS, *more])
    if result.status or not result.rows:
        sys.exit("status %d: %s" % (result.status, result.text[-300:]))
    return result


def stages(result):
    return result.columns[result.columns.index("faces") + 1:result.columns.index("total")]


def as_counted(result, counted, budget):
    """Whether a run with a budget reports what the counts of a run without one show."""
    for row, free in zip(result.rows, counted.rows):
        over = free["total"] > budget
        dearest = max(stages(counted), key=lambda stage: free[stage])  # the first of equal ones
        if bool(row["status"] & OVER) != over or row["over"] != (dearest if over else "-"):
            print("# frame %d takes %d of %d, most in %s; said is %d, %s" % (
                row["frame"], free["total"], budget, dearest, row["status"], row["over"]))
            return False
    return result.said["hash"] == counted.said["hash"]


def main():
    subprocess.run(["make", "-s", "-C", ROOT, "BOARD=" + BOARD, "build"], check=True,
                   stdout=subprocess.DEVNULL, env={k: v for k, v in os.environ.items()
                                                   if not k.startswith("MAKE") and k != "MFLAGS"})
    counted = run()
    totals = sorted(row["total"] for row in counted.rows)
    named = {max(stages(counted), key=lambda s: row[s]) for row in counted.rows}
    cases = [("none_is_over", totals[-1]), ("the_worst_by_one", totals[-1] - 1),
             ("half_of_them", totals[len(totals) // 2]), ("all_but_the_cheapest", totals[0]),
             ("all", totals[0] - 1)]
    failed = 0
    for n, (name, budget) in enumerate(cases, 1):
        ok = as_counted(run("budget=%d" % budget), counted, budget)
        failed += not ok
        print("%s %d - budget/%s (%d instructions, %d frames over)" % (
            "ok" if ok else "not ok", n, name, budget, sum(t > budget for t in totals)))
    ok = len(named) > 2
    failed += not ok
    print("%s %d - budget/frames_differ_in_their_stage (%s)" % (
        "ok" if ok else "not ok", len(cases) + 1, ", ".join(sorted(named))))
    print("1..%d" % (len(cases) + 1))
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run libFuzzer over every target of tests/lib/target.h, and count the runs.

    fuzz.py PROGRAM [--seconds 60] [--runs N] [--targets calls,draw] [--record]

Targets take turns of equal time, or get N runs each, which begin from one seed; `snapshot` and `small` get a part of that, since a step after a damaged
snapshot is dear. Most of it goes to short inputs: a world of few calls, which takes a fraction of the time that a long one takes. Inputs that reach new code
are kept in build/fuzz/TARGET, and the next run goes on from some of them. An input that fails goes to out/fuzz; a line of tests/lib/inputs.c makes a test of it.
"""
import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

import evidence

TARGETS = {"calls": 1, "ask": 1, "draw": 1, "snapshot": 0.1, "small": 0.3, "replay": 1, "mesh": 1}  # and their shares
# bytes of an input, at most, and their share of the time or of the runs. Many inputs are as long as they may be, and those of a multiple
# of 4 may push a body out (tests/lib/target.c), which is dear
LENGTHS = {127: 0.9, 599: 0.1}
TIMEOUT = 20  # seconds of one input, at most
SEEDS = 32    # inputs of chance for a target that has none
START = 500   # inputs that a run begins from, at most: what runs keep is dear, and a run with all of it slows down


def kept_inputs(target):
    """The folder of the inputs that runs of a target have kept."""
    path = os.path.join("build", "fuzz", target)
    os.makedirs(path, exist_ok=True)
    if not os.listdir(path):
        chance = random.Random(target)
        for i in range(SEEDS):
            with open(os.path.join(path, "seed%d" % i), "wb") as file:
                file.write(chance.randbytes(chance.randrange(20, max(LENGTHS))))
    return path


def fuzz(command, target, chance):
    """Run libFuzzer from some of a target's inputs, and keep what it finds."""
    kept = kept_inputs(target)
    names = sorted(os.listdir(kept))
    with tempfile.TemporaryDirectory() as start, tempfile.TemporaryDirectory() as found:
        for name in chance.sample(names, min(START, len(names))):
            shutil.copy(os.path.join(kept, name), start)
        done = subprocess.run([*command, found, start], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              check=False)
        for name in os.listdir(found):
            shutil.copy(os.path.join(found, name), kept)
    return done


def run(program, target, length, limit, chance):
    """Run one target. Returns how many runs it made, in how many seconds, and how many inputs failed."""
    # entropic schedules cost more time than the calls do; nobody else writes to the folders
    command = [program, target, "-entropic=0", "-reload=0", "-max_len=%d" % length, "-timeout=%d" % TIMEOUT,
               "-artifact_prefix=out/fuzz/%s-" % target, "-print_final_stats=1", *limit]
    before = os.times()
    done = fuzz(command, target, chance)
    after = os.times()
    counted = re.search(r"number_of_executed_units: (\d+)", done.stdout)
    runs = int(counted.group(1)) if counted else 0
    processor = after.children_user + after.children_system - before.children_user - before.children_system
    if done.returncode != 0 or not counted:
        print(done.stdout[-6000:])
    return runs, processor, int(done.returncode != 0 or not counted)


def limit_of(options, share, all_shares):
    """The limit of a part of a target's runs, as libFuzzer takes it."""
    if options.runs:
        return ["-runs=%d" % max(1, options.runs * share), "-seed=1"]
    return ["-max_total_time=%d" % max(1, options.seconds * share / all_shares)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--runs", type=int)
    parser.add_argument("--targets", default=",".join(TARGETS))
    parser.add_argument("--record", action="store_true", help="add the runs to tests/evidence.csv")
    options = parser.parse_args()
    targets, failed, chance = options.targets.split(","), 0, random.Random(1 if options.runs else None)
    if not set(targets) <= set(TARGETS):
        parser.error("--targets: some of %s" % ",".join(TARGETS))
    shares = sum(TARGETS[target] for target in targets)
    figures = {"%s, runs" % target: (0, "sum") for target in TARGETS}
    os.makedirs("out/fuzz", exist_ok=True)
    for target in targets:
        parts = [run(options.program, target, length, limit_of(options, TARGETS[target] * share, shares), chance)
                 for length, share in LENGTHS.items()]
        runs, seconds, bad = map(sum, zip(*parts))
        failed += bad
        figures["%s, runs" % target] = (runs, "sum")
        print("%s %-9s %9d runs, %6.0f a second of processor time" % ("not ok" if bad else "ok", target, runs, runs / max(seconds, 1)),
              flush=True)
    if options.record:
        every = sum(runs for runs, _ in figures.values())
        evidence.record("fuzz", {**figures, "all targets, runs": (every, "sum"), "inputs that fail": (failed, "less")})
    held = evidence.ratchet("fuzz", {"inputs that fail": failed})
    sys.exit(0 if held and failed == 0 else 1)


if __name__ == "__main__":
    main()

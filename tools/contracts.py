#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Prove the contracts of tests/contracts for all inputs, by Frama-C: `make contracts`.

    tools/contracts.py [--short] [--seconds N] [NAME...]

A program there gives contracts to functions of the engine, in ACSL, and WP proves each function against its own, with no
overflow, no shift out of range and no access outside of an object; Z3 and CVC4 answer. Its first comment says what that
proves, and
    machine: NAME...                     sizes of types, gcc_x86_32 if it does not say
    assumed: FUNCTION by PROGRAM         a contract that WP is not asked about; tests/proof/PROGRAM.c proves it
    by hand: FUNCTION                    the same for a function without a body
    eva: FUNCTION...                     Eva runs these for all their inputs instead, and must give no alarm
    mutant: FUNCTION in FILE: OLD -> NEW a change of the engine after which the function may not be proved
"""
import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import time

import evidence
import proof

os.chdir(proof.ROOT)
WORK = "build/contracts"
ENVIRONMENT = {**os.environ, "WHY3CONFIG": os.path.join(WORK, "why3.conf")}
EVA = "-eva-auto-loop-unroll 64 -eva-slevel 60 -eva-split-limit 100".split()
LIMIT = 900  # seconds for a run of Frama-C: its server of provers may stay silent
PROVERS = "tip,z3,cvc4"  # tip tries the cases of a small range, one by one, where the others do not answer


class Contracts:
    """A program of tests/contracts and what its first comment says."""

    def __init__(self, path):
        self.path, self.name = path, os.path.basename(path)[:-2]
        with open(path) as file:
            text = file.read()
        comment = re.search(r"/\*\n(.*?)\*/", text, re.S).group(1)
        lines = [line.strip().lstrip("*").strip() for line in comment.split("\n")]
        said = "\n".join(lines)
        self.proves = lines[0]
        self.machines = (re.findall(r"^machine: (.*)$", said, re.M) or ["gcc_x86_32"])[0].split()
        self.eva = " ".join(re.findall(r"^eva: (.*)$", said, re.M)).split()
        self.assumed = re.findall(r"^assumed: (\w+) by \w+$", said, re.M)
        left = self.assumed + re.findall(r"^by hand: (\w+)$", said, re.M)
        found = re.findall(r"\*/\n(?:static )?(?:inline )?(?:struct )?\w+ \**(\w+)\([^{;]*\);", text)
        self.functions = [name for name in found if name not in left]
        changes = re.findall(r"^mutant: (\w+) in (\S+): (.*) -> (.*)$", said, re.M)
        self.changed, self.mutants = [change[0] for change in changes], [change[1:] for change in changes]


def frama_c(contracts, folder, machine, options):
    """What Frama-C says of a program with the engine's sources of a folder."""
    # without __GNUC__ for Eva: it knows nothing of the builtin that counts bits, and runs the loop that is there without it
    flags = "-DCAROM_DEBUG -I%s/src -I%s/include -Itests/contracts%s" % (folder, folder, " -U__GNUC__" if contracts.eva else "")
    command = ["frama-c", "-c11", "-machdep", machine, "-cpp-extra-args=" + flags, *options, contracts.path]
    said = subprocess.run(["timeout", str(LIMIT), *command], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True).stdout
    if os.environ.get("V"):
        print(said)
    return said


def wp(contracts, folder, machine, functions, seconds):
    """(goals proved, goals, those not proved) of functions."""
    session = os.path.join(WORK, "session")
    shutil.rmtree(session, ignore_errors=True)
    said = frama_c(contracts, folder, machine, [
        "-wp", "-wp-rte", "-wp-model", "Typed+cast", "-wp-fct", ",".join(functions), "-wp-prover", PROVERS, "-wp-auto", "wp:range",
        "-wp-session", session, "-wp-par", "2", "-wp-timeout", str(seconds)])
    counted = re.search(r"Proved goals: *(\d+) */ *(\d+)", said)
    if not counted:
        sys.exit("%s: Frama-C ends: %s" % (contracts.path, said.strip()[-300:]))
    return int(counted[1]), int(counted[2]), re.findall(r"\[Failed\] Goal (\S+)", said)


def eva(contracts, folder, functions):
    """The alarms of functions that Eva runs."""
    alarms = []
    for name in functions:
        said = frama_c(contracts, folder, contracts.machines[0], [
            "-eva", *EVA, "-eva-use-spec", ",".join(contracts.assumed), "-main", name,
            "-eva-msg-key=-initial-state,-final-states"])
        ended = re.search(r"(\d+) alarms? generated", said)
        found = re.findall(r"\[eva:alarm\] (\S+): Warning:\s+(.*?)\.?\n", said)
        alarms += ["%s: %s %s" % (name, *alarm) for alarm in found]
        if not ended or int(ended[1]) != len(found):
            sys.exit("%s: Frama-C ends: %s" % (contracts.path, said.strip()[-300:]))
    return alarms


def refuted(contracts, number):
    """Whether a change of the engine is noticed: the function that has it is not proved, or Eva gives an alarm."""
    harness = argparse.Namespace(name="contracts." + contracts.name, path=contracts.path, mutants=contracts.mutants)
    folder = proof.mutated(harness, number)
    if contracts.eva:
        return bool(eva(contracts, folder, [contracts.changed[number]]))
    good, all_goals, _ = wp(contracts, folder, contracts.machines[0], [contracts.changed[number]], 5)
    return good < all_goals


def detect():
    """Let Why3 write down which provers there are."""
    subprocess.run(["why3", "config", "detect"], env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--short", action="store_true", help="no mutants; compares with what is kept")
    parser.add_argument("--seconds", type=int, default=20, help="for a prover and a goal")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    os.makedirs(WORK, exist_ok=True)
    detect()
    figures = dict.fromkeys(("goals proved", "goals", "functions with a contract", "functions in Eva", "alarms", "changes noticed",
                             "changes"), 0)
    for path in sorted(glob.glob("tests/contracts/*.c")):
        contracts = Contracts(path)
        if options.names and contracts.name not in options.names:
            continue
        begun, left = time.time(), []
        if contracts.eva:
            left = eva(contracts, ".", contracts.eva)
            figures["functions in Eva"] += len(contracts.eva)
            figures["alarms"] += len(left)
            said = "%d functions, %d alarms" % (len(contracts.eva), len(left))
        else:
            runs = [wp(contracts, ".", machine, contracts.functions, options.seconds) for machine in contracts.machines]
            left = [goal for run in runs for goal in run[2]]
            figures["goals proved"] += sum(run[0] for run in runs)
            figures["goals"] += sum(run[1] for run in runs)
            figures["functions with a contract"] += len(contracts.functions)
            said = "%d functions, %d of %d goals" % (len(contracts.functions), sum(r[0] for r in runs), sum(r[1] for r in runs))
        noticed = [] if options.short else [refuted(contracts, number) for number in range(len(contracts.mutants))]
        figures["changes noticed"] += sum(noticed)
        figures["changes"] += len(noticed)
        print("%-8s %-36s %5.0f s  mutants: %s" % (contracts.name, said, time.time() - begun,
                                                  ", ".join("noticed" if one else "NOT NOTICED" for one in noticed) or "none"))
        print("    " + contracts.proves)
        for goal in left:
            print("    NOT PROVED: " + goal)
        sys.stdout.flush()
    print(", ".join("%s: %d" % figure for figure in figures.items()))
    failed = figures["goals"] != figures["goals proved"] or figures["alarms"] or figures["changes"] != figures["changes noticed"]
    if not options.names and not options.short:
        kinds = {"goals proved": "more", "functions with a contract": "more", "functions in Eva": "more", "alarms": "less",
                 "changes noticed": "more"}
        evidence.record("contracts", {name: (value, kinds.get(name, "fact")) for name, value in figures.items()})
    elif not options.names:
        kept = {name: figures[name] for name in ("goals proved", "functions with a contract", "functions in Eva", "alarms")}
        failed = not evidence.ratchet("contracts", kept) or failed
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

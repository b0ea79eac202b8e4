#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Prove the programs of tests/proof for all inputs: `make proof`.

    tools/proof.py [--short] [--seconds N] [NAME...]

Each program says in its first comment what it proves, and
    bound: for which inputs
    mutant: FILE: OLD -> NEW      a change of the engine that must be refuted
    unwind: N                     turns of a loop at most, 70 if it does not say; that there are no more is proved, too
    contract: FUNCTION by NAME    a function of the program that stands for one of the engine, which another program proves
    cases: LOW..HIGH              the program is proved once for each CASE
    every: FUNCTION...            the program itself tries all inputs of these

A question that cvc5 does not answer within the seconds of the processor that are allowed is not proved.
"""
import argparse
import concurrent.futures
import glob
import os
import re
import resource
import shutil
import subprocess
import sys
import time

import evidence

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
os.chdir(ROOT)
WORK = "build/proof"
SANITIZERS = "-fsanitize=signed-integer-overflow,shift,integer-divide-by-zero"
LANGUAGE = ["-std=c11", "-DCAROM_DEBUG", "-Itests/proof"]
RANDOM = 2000
AT_ONCE = 12


class Harness:
    """A program of tests/proof and what its first comment says."""

    def __init__(self, path):
        self.path, self.name = path, os.path.basename(path)[:-2]
        with open(path) as file:
            comment = re.search(r"/\*\n(.*?)\*/", file.read(), re.S).group(1)
        lines = [line.strip().lstrip("*").strip() for line in comment.split("\n")]
        self.proves = lines[0]
        said = dict(re.findall(r"^(bound|unwind|cases): (.*)$", "\n".join(lines), re.M))
        self.bound, self.unwind = said["bound"], int(said.get("unwind", 70))
        low, _, high = said.get("cases", "0..0").partition("..")
        self.cases = range(int(low), int(high) + 1)
        self.contracts = dict(re.findall(r"^contract: (\w+) by (\w+)$", "\n".join(lines), re.M))
        self.every = " ".join(re.findall(r"^every: (.*)$", "\n".join(lines), re.M)).split()
        self.mutants = re.findall(r"^mutant: (\S+): (.*) -> (.*)$", "\n".join(lines), re.M)


def mutated(harness, number):
    """A folder with the engine's sources and one change in them."""
    folder = "%s/mutants/%s.%d" % (WORK, harness.name, number)
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("include", "src/num", "src/mesh"):
        shutil.copytree(part, os.path.join(folder, part))
    path, old, new = harness.mutants[number]
    with open(os.path.join(folder, path)) as file:
        text = file.read()
    if text.count(old) < 1:
        sys.exit("%s: %s does not have %s" % (harness.path, path, old))
    with open(os.path.join(folder, path), "w") as file:
        file.write(text.replace(old, new))
    return folder


def compiled(harness, folder, case):
    """The program as clang writes it down."""
    made = "%s/%s.%s.%d.ll" % (WORK, harness.name, folder.replace("/", "_"), case)
    subprocess.run(["clang-19", "--target=wasm32", "-O0", "-ffreestanding", *LANGUAGE, "-DCASE=%d" % case, SANITIZERS,
                    "-fsanitize-trap=all", "-I%s/src" % folder, "-I%s/include" % folder, "-S", "-emit-llvm",
                    "-o", made, harness.path], check=True)
    return made


def native(harness, folder, case, words):
    """True if the program fails on this machine with these inputs."""
    made = "%s/%s.%s.%d.elf" % (WORK, harness.name, folder.replace("/", "_"), case)
    source = [*LANGUAGE, "-DCASE=%d" % case, "-I%s/src" % folder, "-I%s/include" % folder, harness.path]
    if harness.contracts:
        written = made[:-4] + ".native.ll"
        subprocess.run(["clang-19", SANITIZERS, "-fsanitize-trap=all", "-S", "-emit-llvm", "-o", written, *source], check=True)
        stand_in(written, harness.contracts)
        subprocess.run(["clang-19", "-O1", "-Wno-override-module", "-Iinclude", "-o", made, written, "tests/proof/native.c"], check=True)
    else:
        subprocess.run(["gcc", "-O1", SANITIZERS, "-fno-sanitize-recover=all", "-o", made, *source, "tests/proof/native.c"], check=True)
    return subprocess.run([made, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0


def stand_in(path, contracts):
    """Make calls in a file of clang's go to the functions of contracts, but for those in these themselves."""
    inside, lines = None, []
    with open(path) as file:
        for line in file:
            begun = re.match(r"define .*?@(\w+)\(", line)
            inside = begun.group(1) if begun else inside
            if re.search(r"\bcall\b", line):
                line = re.sub(r"@(\w+)\(", lambda found: found.group(0) if contracts.get(found.group(1), inside) == inside else
                              "@%s(" % contracts[found.group(1)], line)
            lines.append(line)
    with open(path, "w") as file:
        file.writelines(lines)


def limited(seconds):
    """Called in a process to end it after so many seconds of the processor, however busy the machine is."""
    return lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))


def ask(facts, condition, path, seconds, ways=False):
    """("proved", "refuted" or "unknown", the inputs that refute) of what must not hold, by cvc5. With WAYS it also
    says which inputs were asked for at all; a proof does not need to know."""
    import z3
    goal = z3.Solver()
    goal.add(*facts.known, condition)
    names = [str(value.term) for value, _ in facts.inputs]
    asked = {name: "way_" + name for (_, guard), name in zip(facts.inputs, names) if ways and guard}
    for (_, guard), name in zip(facts.inputs, names):
        if name in asked:
            goal.add(z3.Bool(asked[name]) == z3.And(*guard))
    # z3's own names of quotients whose denominator cannot be 0
    text = re.sub(r"\b(bv[us](?:div|rem|mod))_i\b", r"\1", goal.to_smt2())
    known = [name for name in [*names, *asked.values()] if "declare-fun %s " % name in text]
    with open(path, "w") as file:
        file.write("(set-logic QF_BV)\n(set-option :produce-models true)\n" + text)
        file.write("(get-value (true %s))\n" % " ".join(known))
    said = subprocess.run(["cvc5", path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          preexec_fn=limited(seconds)).stdout
    if said.startswith("unsat"):
        return "proved", []
    if not said.startswith("sat"):
        return "unknown", []
    if not ways:
        return ask(facts, condition, path, seconds, True)
    found = {name: int(bits, 2) for name, bits in re.findall(r"\((\S+) #b([01]+)\)", said)}
    missed = set(re.findall(r"\((\S+) false\)", said))
    return "refuted", [str((found.get(name, 0) + (1 << 63)) % (1 << 64) - (1 << 63)) for name in names if asked.get(name) not in missed]


def solve(run, path, seconds):
    """The same of all that must never happen, at most AT_ONCE questions."""
    import z3
    found = [z3.And(*guard, condition) for guard, condition, _ in run.failures]
    each = -(-len(found) // AT_ONCE)
    for start in range(0, len(found), each or 1):
        verdict = ask(run.facts, z3.Or(*found[start:start + each]), path, seconds)
        if verdict[0] != "proved":
            return verdict[0], [*verdict[1], "(" + "; ".join(text for _, _, text in run.failures[start:start + each]) + ")"]
    return "proved", []


def attempt(harness, folder, case, seconds):
    """(verdict, what fails, functions entered): with nothing known of products first, then exactly."""
    import proof_read
    import proof_run
    import proof_values
    program = proof_read.Program(compiled(harness, folder, case))
    verdict, inputs, entered = "unknown", [], set()
    for exact in (False, True):
        facts = proof_values.Facts(exact)
        run = proof_run.Run(program, facts, harness.unwind, harness.contracts)
        entered = run.entered
        verdict, inputs = solve(run, program.path + ".smt2", seconds)
        if verdict == "proved" or verdict == "refuted" and native(harness, folder, case, inputs[:-1]):
            break
    else:
        verdict, inputs = "unknown" if verdict == "unknown" else "not confirmed", inputs
    return verdict, inputs, entered


def refute(harness, number, seconds):
    """Whether a change of the engine is found, by the prover or at least by random inputs."""
    folder, cases = mutated(harness, number), harness.cases
    for case in dict.fromkeys((cases[len(cases) // 2], cases[0], cases[-1])):
        if attempt(harness, folder, case, seconds)[0] == "refuted":
            return "refuted"
    return "by random inputs" if any(native(harness, folder, case, ["random", "20000"]) for case in cases) else "NOT REFUTED"


def every(harness, folder, short):
    """True if a program that tries all inputs ends well; a part of them if it is to be short."""
    made = "%s/%s.%s.elf" % (WORK, harness.name, folder.replace("/", "_"))
    subprocess.run(["gcc", "-O2", "-std=c11", "-I%s/src" % folder, "-I%s/include" % folder, "-o", made, harness.path], check=True)
    ends = [(0x8000, 0x8040), (0xffc0, 0x10000)] if short else [(0x8000, 0xc000), (0xc000, 0x10000)]
    runs = [subprocess.Popen([made, str(low), str(high)]) for low, high in ends]
    return not any([run.wait() for run in runs])


def task(harness, number, case, seconds):
    """(verdict, inputs, functions entered, seconds of the processor) of a case, or of a mutant."""
    begun = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime + time.process_time()
    sys.setrecursionlimit(100000)
    try:
        if harness.every:
            good = every(harness, "." if number is None else mutated(harness, number), seconds < 60 or number is not None)
            found = ("proved" if good else "refuted", [], set(harness.every))
        elif number is not None:
            found = refute(harness, number, min(seconds, 20)), [], set()
        else:
            found = attempt(harness, ".", case, seconds)
            if found[0] == "proved" and case == harness.cases[0] and native(harness, ".", case, ["random", str(RANDOM)]):
                found = "refuted", ["random inputs make it fail"], set()
    except Exception as error:  # a program that this tool cannot run is not proved
        if os.environ.get("V"):
            raise
        found = "unknown", ["%s: %s" % (type(error).__name__, error)], set()
    return *found, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime + time.process_time() - begun


def functions():
    """The functions of num/ and of the public header that is its other half."""
    found = {}
    for path in sorted(glob.glob("src/num/*.[ch]") + ["include/carom_fix.h"]):
        with open(path) as file:
            text = re.sub(r"\\\n", "\n", file.read())
        for name in re.findall(r"^(?:FIX_APART )?(?:(?:static|inline) )*(?:struct )?\w+ \**(\w+)\([^;{]*?\)\s*\n\{", text, re.M):
            found.setdefault(name, path)
    return {name: path for name, path in found.items() if name != "main"}


class Result:
    """What is known of a program when all its cases have been tried."""

    def __init__(self):
        self.verdicts, self.mutants, self.entered, self.notes, self.seconds = [], [], set(), [], 0.0

    def add(self, number, found):
        verdict, notes, entered, seconds = found
        (self.verdicts if number is None else self.mutants).append(verdict)
        self.entered |= entered
        self.notes += notes if number is None and verdict != "proved" else []
        self.seconds += seconds

    @property
    def proved(self):
        return all(verdict == "proved" for verdict in self.verdicts)


def show(harness, result):
    """Print a line of a program, and one of what is not proved of it."""
    said = "proved" if result.proved else "%d of %d cases proved" % (result.verdicts.count("proved"), len(result.verdicts))
    print("%-16s %-24s %5.0f s  mutants: %s" % (harness.name, said, result.seconds, ", ".join(result.mutants) or "none"))
    print("    %s\n    for %s" % (harness.proves, harness.bound))
    if result.notes:
        print("    NOT PROVED: " + " ".join(sorted(set(result.verdicts)) + result.notes[:12]), flush=True)


def tell(results):
    """Write out/proof.csv; returns the figures."""
    os.makedirs("out", exist_ok=True)
    with open("out/proof.csv", "w") as file:
        file.write("program,proved,cases,mutants,refuted,seconds\n")
        for h, r in results.items():
            file.write("%s,%d,%d,%d,%d,%.0f\n" % (h.name, r.proved, len(r.verdicts), len(r.mutants),
                                                 sum(m == "refuted" for m in r.mutants), r.seconds))
    known = functions()
    covered = set().union(*[r.entered for r in results.values() if r.proved]) & set(known)
    for name in sorted(set(known) - covered):
        print("in no proof: %s (%s)" % (name, known[name]))
    refuted = [m for r in results.values() for m in r.mutants]
    return {"programs proved": (sum(r.proved for r in results.values()), "more"),
            "programs": (len(results), "fact"),
            "functions of src/num and carom_fix.h in a proof": (len(covered), "more"),
            "functions of src/num and carom_fix.h": (len(known), "fact"),
            "changes of the engine that are refuted": (refuted.count("refuted"), "more"),
            "changes of the engine": (len(refuted), "fact")}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--short", action="store_true", help="first and last cases, no mutants, ten seconds each; compares with what is kept")
    parser.add_argument("--seconds", type=int, default=90)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    os.makedirs(WORK, exist_ok=True)
    harnesses = [Harness(path) for path in sorted(glob.glob("tests/proof/*.c")) if not path.endswith("native.c")]
    harnesses = [h for h in harnesses if not options.names or h.name in options.names]
    jobs = []
    for h in harnesses:
        jobs += [(h, None, case) for case in (sorted({h.cases[0], h.cases[-1]}) if options.short else h.cases)]
        jobs += [] if options.short else [(h, number, None) for number in range(len(h.mutants))]
    results, left = {h: Result() for h in harnesses}, {h: sum(job[0] is h for job in jobs) for h in harnesses}
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        futures = {pool.submit(task, *job, 10 if options.short else options.seconds): job for job in jobs}
        for future in concurrent.futures.as_completed(futures):
            h, number, _ = futures[future]
            h = next(known for known in harnesses if known.name == h.name)
            results[h].add(number, future.result())
            left[h] -= 1
            if left[h] == 0:
                show(h, results[h])
    figures = tell(results)
    print(", ".join("%s: %d" % (name, value) for name, (value, _) in figures.items()))
    if options.names:
        return 0
    if options.short:
        return 0 if evidence.ratchet("proof", {name: value for name, (value, _) in figures.items()
                                               if not name.startswith("changes")}) else 1
    evidence.record("proof", figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())

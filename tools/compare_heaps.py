# SPDX-License-Identifier: MIT
"""Heaps of boxes, whole steps of the head scene and heaps as WebAssembly, for tools/compare.py.

Instructions a step are counted by callgrind, milliseconds taken in one node. A figure is
(what, size, phase, contender, value, unit).
"""
import concurrent.futures
import glob
import os
import re
import subprocess
import sys
import tempfile

CONTENDERS = ["carom", "ode", "bullet"]
PHASES = ["falling", "settling", "resting", "asleep"]
# Seeds of heaps by number of boxes; the figure is their mean. In the heap of 256 boxes and seed 1 boxes overlap at first.
SEEDS = {8: [1, 2, 3, 4], 16: [1, 2, 3, 4], 32: [1, 2, 3], 64: [1, 2], 128: [1, 2], 256: [2]}
ASLEEP = 32  # boxes of Carom's heap that sleeps
SHORT = 32  # boxes: the heap of seed 1 that CI counts
WASM = 100  # boxes
WASM_SEEDS = 4
# Carom's instructions over ODE's, for the heap that CI counts. They are set by hand when the engine
# gets better.
BOUNDS = {"falling": 4.0, "resting": 0.9}
NOISE = 1.03  # times the committed instructions: libraries differ a little from machine to machine
TIMEOUT = 600  # seconds a run
UNIT = "instructions"


def run(command, **others):
    """The output of a command as cells; a command that fails ends the comparison."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                          timeout=TIMEOUT, **others)
    if done.returncode:
        sys.exit("%s: status %d" % (" ".join(command), done.returncode))
    return [line.split(",") for line in done.stdout.splitlines()]


def counted(command, *options):
    """The counts of callgrind: the total of every dump by its label, split at commas."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        run(["valgrind", "--quiet", "--tool=callgrind", "--collect-atstart=no", *options,
             "--callgrind-out-file=%s/out" % folder, *command],
            # otherwise the first call of a function includes the linker's search for it
            env=dict(os.environ, LD_BIND_NOW="1"))
        for path in glob.glob(folder + "/out.*"):
            with open(path) as file:
                text = file.read()
            label = re.search(r"^desc: Trigger: Client Request: (\S+)$", text, re.M)
            if label:
                total = re.search(r"^totals: (\d+)$", text, re.M)
                found[tuple(label[1].split(","))] = int(total[1])
    return found


def steps(program, *arguments):
    """{phase: instructions a step} for a run of carom-heaps."""
    found = counted([program, *arguments], "--instr-atstart=no")
    a_step = {phase: total / int(count) for (phase, count), total in found.items()}
    return {phase: a_step[phase] for phase in PHASES if phase in a_step}


def all_steps(program, tasks):
    """The steps() of tasks, in their order; the longest start first."""
    order = sorted(tasks, key=lambda task: int(task[1]) if task[1].isdigit() else 0, reverse=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = dict(zip(order, pool.map(lambda task: steps(program, *task), order)))
    return [(task, found[task]) for task in tasks]


def means(what, found):
    """Figures of tasks; tasks that differ only in the seed are combined."""
    groups = {}
    for (who, size, *_), phases in found:
        for phase, value in phases.items():
            name = "carom" if who == "asleep" else who
            groups.setdefault((what, size, phase, name), []).append(value)
    return [[*key, round(sum(values) / len(values)), UNIT] for key, values in groups.items()]


def short(program):
    """Figures of the heap that CI counts."""
    return means("short", all_steps(program, [(who, str(SHORT), "1") for who in CONTENDERS]))


def long(program):
    """Figures of all heaps, of a sleeping one, and of the scene `head`."""
    heaps = [(who, str(boxes), str(seed)) for boxes, seeds in SEEDS.items()
             for seed in seeds for who in CONTENDERS]
    asleep = [("asleep", str(ASLEEP), "1")]
    scene = [(who, "head") for who in CONTENDERS]
    found = all_steps(program, scene + heaps + asleep)
    first = [(task, got) for task, got in found if task[1:] == (str(SHORT), "1")
             and task[0] in CONTENDERS]
    return means("step", found[:len(scene)]) + means("heap", found[len(scene):]) + \
        means("short", first)


def wasm(program, image):
    """Figures of heaps in node."""
    with tempfile.TemporaryDirectory() as folder:
        layouts = []
        for seed in range(1, WASM_SEEDS + 1):
            layouts.append("%s/%d" % (folder, seed))
            with open(layouts[-1], "w") as file:
                for cells in run([program, "layout", str(WASM), str(seed)]):
                    file.write(",".join(cells) + "\n")
        said = run(["node", "tools/compare_wasm/heaps.mjs", image, *layouts])
    for kind, who, height in said:
        if kind == "end":
            print("wasm: %s's boxes lie %s high on average" % (who, height))
    return [["wasm", str(WASM), phase, who, float(value), "ms"]
            for phase, who, value in said if phase != "end"]


def complaints(figures, committed):
    """Figures of the CI heap that exceed the bounds or the committed ones."""
    now, before = [{(phase, who): float(value) for what, _, phase, who, value, _ in rows
                    if what == "short"} for rows in (figures, committed)]
    wrong = []
    for phase, bound in BOUNDS.items():
        ratio = now[phase, "carom"] / now[phase, "ode"]
        print("%d boxes, %s: %.2f of ODE's instructions, at most %.2f" % (SHORT, phase, ratio, bound))
        if ratio > bound:
            wrong.append("%d boxes, %s: more than %.2f of ODE's instructions" % (SHORT, phase, bound))
    for (phase, who), value in now.items():
        if who == "carom" and value > NOISE * before.get((phase, who), value):
            wrong.append("%d boxes, %s: %d instructions, %d committed"
                         % (SHORT, phase, value, before[phase, who]))
    return wrong

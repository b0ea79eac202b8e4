#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""One answer from every instruction set, compiler and option: tests/matrix.c, built in many ways.

Every build plays the scenes of tests/lib/plays.c and must print the same hash for each. A build that cannot be made or run
fails, and so does one with a different hash. The tool then searches the first frame that differs, and in that frame the
first stage with a different result. Builds of the other byte order or word length continue from snapshots of a build, for
as many frames. out/matrix.csv has a row a build and scene. A build that played every scene in full, as tests/plays.csv has it,
gets a row of tests/matrix.csv at once, so that a part of the builds, or a run that was ended, counts (matrix_page.py).
"""
import argparse
import concurrent.futures
import csv
import glob
import itertools
import os
import platform
import re
import shutil
import struct
import subprocess
import sys
import threading
import time

import evidence
import gate
import matrix_page
import run_board

ROOT = run_board.ROOT
OUT = "out/matrix.csv"
WORK = "build/matrix"
TIMEOUT = 900  # seconds a command
FRAMES = 2000, 600  # frames of a scene; of a scene in the short form: it goes on from the snapshots for 100
AT = 500  # the frame whose snapshot is handed on
CROSSED = ["pile", "sheet", "door", "walker"]  # scenes that another build continues

WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Werror".split()
INCLUDES = ["-I%s/%s" % (ROOT, name) for name in "include src port examples tests".split()]
PROGRAM = ["tests/matrix.c", "tests/lib/plays.c", "port/option.c"] + sorted(
    name for name in glob.glob("examples/scene*.c", root_dir=ROOT)
    if not name.endswith(("_rom.c", "_play.c")))
SCENE_MESHES = ["build/gen/*_mesh.c", "build/gen/*_ramps.c"]  # constants: compiled once a target

# Undefined behaviour ends the program. A trap needs no library, so it works everywhere.
GCC_TRAP = "-O1 -fsanitize=undefined -fsanitize-undefined-trap-on-error"
CLANG_TRAP = "-O1 -fsanitize=undefined -fsanitize-trap=undefined"
SANITIZE = "-fsanitize=address,undefined -fno-sanitize-recover=all -DCAROM_DEBUG"

LEVELS = ["-O2", "-O0", "-O1", "-O3", "-Os"]
MORE = ["-O3 -fwrapv", "-O1 -funsigned-char", "-O2 -fsigned-char"]
GCC = LEVELS + MORE + ["-O2 -flto", GCC_TRAP]
CLANG = ["-O2", "-O0", "-Os -funsigned-char", CLANG_TRAP]
NATIVE = {"gcc": GCC + ["-O1 " + SANITIZE, "-O3 " + SANITIZE],
          "clang": LEVELS + MORE + ["-O2 -flto -fuse-ld=lld", CLANG_TRAP, "-O1 " + SANITIZE]}
WASM = LEVELS + MORE + ["-Oz"]

# name: triple of the GNU tools, emulator, bits, byte order, if clang 14 generates code for it
LINUX = {
    "i686": ("i686-linux-gnu", "i386", 32, "little", True),
    "armel": ("arm-linux-gnueabi", "arm", 32, "little", True),
    "armhf": ("arm-linux-gnueabihf", "arm", 32, "little", True),
    "aarch64": ("aarch64-linux-gnu", "aarch64", 64, "little", True),
    "riscv64": ("riscv64-linux-gnu", "riscv64", 64, "little", True),
    "powerpc": ("powerpc-linux-gnu", "ppc", 32, "big", True),
    "powerpc64": ("powerpc64-linux-gnu", "ppc64", 64, "big", True),
    "ppc64el": ("powerpc64le-linux-gnu", "ppc64le", 64, "little", True),
    "s390x": ("s390x-linux-gnu", "s390x", 64, "big", True),
    "mips": ("mips-linux-gnu", "mips", 32, "big", True),
    "mipsel": ("mipsel-linux-gnu", "mipsel", 32, "little", True),
    "mips64": ("mips64-linux-gnuabi64", "mips64", 64, "big", True),
    "mips64el": ("mips64el-linux-gnuabi64", "mips64el", 64, "little", True),
    "m68k": ("m68k-linux-gnu", "m68k", 32, "big", False),
    "sparc64": ("sparc64-linux-gnu", "sparc64", 64, "big", True),
    "hppa": ("hppa-linux-gnu", "hppa", 32, "big", False),
    "alpha": ("alpha-linux-gnu", "alpha", 64, "little", False),
    "sh4": ("sh4-linux-gnu", "sh4", 32, "little", False),
}
# For MIPS32 clang before 15 compiles (int64_t)a * b - c to msub, which is c - a * b: LLVM issue 50458. MIPS II has no
# msub.
CLANG_ARCH = {"mips": ["-march=mips2"], "mipsel": ["-march=mips2"]}
# The short form plays on boards whose instruction set no other target has, and on those in place of a target, because `make
# test` has compiled for them.
SHORT_BOARDS = ["microbit", "mps2-an385", "riscv32"]
IN_PLACE_OF = {(platform.machine(), "gcc"): "host", ("armel", "gcc"): "paper-arm", ("mips", "gcc"): "paper-mips"}
ELF = {bytes([size, order]): (32 * size, {1: "little", 2: "big"}[order])
       for size in (1, 2) for order in (1, 2)}  # bits and byte order, by two bytes of an ELF header
DYNAMIC = ["alpha"]  # its static programs do not start in QEMU 7.2
# GCC 12.2 for SuperH loses comparisons before a branch when it optimises: int f(const int *p) that calls a function p[2]
# times loses the first one. The C library that it compiled hangs.
ONLY = {"sh4": ["-O0", "-O0 -fwrapv", "-O0 -funsigned-char"]}
NO_LIBRARY = {"sh4": "port/sh4/sh4.c"}
NO_LIBRARY_PORT = ["port/nolibc/string.c"]
NO_LIBRARY_OPTIONS = ["-ffreestanding", "-I%s/port/nolibc" % ROOT]
MESHES = {}  # by target: objects
MAKING = threading.Lock()  # boards share tools and meshes
KEEPING = threading.Lock()  # builds share tests/matrix.csv


class Failure(Exception):
    """The failure of a build, in words."""


def call(command, what, folder=ROOT):
    """Run a command; returns its output, or raises a Failure that ends with the output's last lines."""
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              errors="replace", timeout=TIMEOUT)
    except FileNotFoundError:
        raise Failure("%s: there is no %s" % (what, command[0])) from None
    except subprocess.TimeoutExpired:
        raise Failure("%s: more than %d s" % (what, TIMEOUT)) from None
    if done.returncode:
        tail = (done.stdout[-400:] + done.stderr[-800:]).strip()
        raise Failure("%s: status %d\n%s" % (what, done.returncode, tail))
    return done.stdout


class Build:
    """One way to make the program, and its output."""
    need = []  # things for tools/need
    where = ""  # the name of the runner, for people
    libraries = []  # after the objects

    def __init__(self, target, compiler, options, bits, order):
        self.target, self.compiler, self.options = target, compiler, options
        self.bits, self.order = bits, order
        self.engine = "src"  # folder
        self.folder = os.path.join(WORK, target, compiler,
                                   re.sub(r"\W+", "_", options).strip("_"))
        self.elf = os.path.join(self.folder, "matrix")
        self.scenes, self.snapshots, self.absent = {}, {}, []

    def __str__(self):
        return " ".join([self.target, self.compiler, self.options])

    def compile(self, sources, *options):
        """Objects of sources in the build's folder; clang warns of options that only a linker takes."""
        of_compiler = [word for word in self.options.split() if not word.startswith("-fuse-ld")]
        call([*self.command, "-std=c11", *of_compiler, *INCLUDES, *options, "-c",
              *[os.path.join(ROOT, source) for source in sources]], "compile", self.folder)

    def make(self):
        if self.target not in MESHES:
            raise Failure("its meshes could not be made")
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        self.compile(sorted(glob.glob(self.engine + "/*/*.c")), "-ffreestanding", *WARNINGS)
        self.compile(PROGRAM + self.port, *self.port_options)
        made = glob.glob(self.folder + "/*.o")
        call([*self.linker, "-o", self.elf, *made, *MESHES[self.target],
              *self.libraries], "link")
        for path in made:
            os.remove(path)

    def run(self, *options):
        """The words of every line of the output."""
        text = call([*self.runner, self.elf, *options], "run")
        return [line.split() for line in text.splitlines()]

    def play(self, scenes, *options):
        """Play scenes, or all if none is named; keeps the result of each, and the snapshots."""
        runs = [["scene=" + scene] for scene in scenes] or [[]]
        for words in [words for which in runs for words in self.run(*options, *which, "save=1")]:
            if words[0] == "scene":
                self.scenes[words[1]] = words[2:]
            elif words[0] == "snapshot":
                self.snapshots[words[1]] = bytes.fromhex(words[2])
            elif words[0] == "absent":
                self.absent.append(words[1])
        if not self.scenes:
            raise Failure("run: it played nothing")

    def discard(self):
        shutil.rmtree(self.folder)


class Linux(Build):
    """For Linux: on this machine, or on another processor by QEMU's user mode."""
    port, port_options = ["port/linux/console.c", "port/print.c", "port/assert.c"], []

    def __init__(self, target, compiler, options):
        triple, emulator, bits, order, _ = LINUX.get(
            target, (None, None, struct.calcsize("P") * 8, sys.byteorder, True))
        super().__init__(target, compiler, options, bits, order)
        self.need = ([triple, "qemu-user"] if triple else ["cc", "libc"]) + \
            (["clang", "lld"] if compiler == "clang" else [])
        gcc = [triple + "-gcc" if triple else "gcc"]
        static = [] if target in DYNAMIC else ["-static"]
        # clang takes the headers of the newest GCC for a processor, and one for bare machines has none for Linux
        self.command = gcc if compiler == "gcc" else \
            ["clang"] + (["--target=" + triple, "-isystem", "/usr/%s/include" % triple] if triple else []) + CLANG_ARCH.get(target, [])
        # Debian's clang does not find every cross linker: for those targets gcc links what clang
        # compiled
        self.linker = [*self.command, *options.split()] if compiler == "gcc" or not triple else gcc
        self.linker = self.linker + static if triple else self.linker
        self.runner = ["qemu-" + emulator] if triple else []
        self.where = self.runner[0] if triple else "this machine"
        if target in DYNAMIC:
            self.runner += ["-L", "/usr/" + triple]
        if target in NO_LIBRARY:
            self.port = [NO_LIBRARY[target], *NO_LIBRARY_PORT]
            self.port_options, self.libraries = NO_LIBRARY_OPTIONS, ["-nostdlib", "-lgcc"]


class Wasm(Build):
    """WebAssembly without a library, in node."""
    port, port_options = ["port/wasm/wasm.c", *NO_LIBRARY_PORT], NO_LIBRARY_OPTIONS
    command = ["clang", "--target=wasm32"]
    linker = [*command, "-nostdlib", "-Wl,--no-entry,--export=main,-z,stack-size=262144"]
    runner = ["node", "port/wasm/run.mjs"]
    need = ["clang", "lld", "node"]
    where = "node"

    def __init__(self, options):
        super().__init__("wasm32", "clang", options, 32, "little")


class Board(Build):
    """The image that make builds for a board."""

    def __init__(self, board):
        settings = run_board.settings(board)
        super().__init__(board, settings.get("CROSS", "") + "gcc",
                         settings.get("MATRIX_OPT") or settings.get("OPT", "-O2"), 32, "little")
        self.need = settings.get("NEED", "cc libc").split()
        self.elf = "build/%s/matrix.elf" % board
        runner = settings.get("QEMU") or settings.get("QEMU_USER") or settings.get("RUNNER")
        self.where = os.path.basename(runner.split()[0]) if runner else "this machine"
        self.extra = [settings["RUNNER"]] if "RUNNER" in settings else []
        self.command = [self.compiler]

    def make(self):
        with MAKING:
            call(["make", "-s", "-j2", "BOARD=" + self.target, "OPT=" + self.options, self.elf, *self.extra], "make")
        with open(self.elf, "rb") as file:
            self.bits, self.order = ELF[file.read(6)[4:]]

    def run(self, *options):
        text = call(run_board.command(self.elf, list(options)), "run")
        return [line.split() for line in text.splitlines()]

    def discard(self):
        pass


def every_build(short):
    """All builds; the others are compared with the first."""
    def some(target, compiler, sets):
        if short and (target, compiler) in IN_PLACE_OF:
            return [Board(IN_PLACE_OF[target, compiler])]
        return [Linux(target, compiler, options) for options in (sets[:1] if short else sets)]

    for compiler, sets in NATIVE.items():
        yield from some(platform.machine(), compiler, sets)
    for target, row in LINUX.items():
        yield from some(target, "gcc", ONLY.get(target, GCC))
        if row[4] and not short:
            yield from [Linux(target, "clang", options) for options in CLANG]
    yield from [Wasm(options) for options in (WASM[:1] if short else WASM)]
    for board in run_board.boards():
        if board != "host" and run_board.settings(board).get("MATRIX") != "0" and (
                not short or board in SHORT_BOARDS):
            yield Board(board)


# ------------------------------------------------------------------ what differs

def lines(build, kind, scene, frames, option):
    """The words of every line of a kind, from a build with an option."""
    said = build.run("scene=" + scene, "frames=%d" % frames, option)
    return [words for words in said if words[0] == kind]


def first_difference(build, other, scene, frames):
    """In words: the first frame of a scene after which two builds differ, and the stage that differs."""
    pairs = zip(lines(build, "frame", scene, frames, "each=1"),
                lines(other, "frame", scene, frames, "each=1"))
    frame = next((int(mine[1]) for mine, theirs in pairs if mine != theirs), None)
    if frame is None:
        return "the same, frame by frame, when it runs again"
    trace = "trace=%d" % frame
    pairs = itertools.zip_longest(lines(build, "mark", scene, frame, trace),
                                  lines(other, "mark", scene, frame, trace))
    for number, (mine, theirs) in enumerate(pairs, 1):
        if mine != theirs:
            return "first in frame %d, after stage %s, the %d. to end in it" % (
                frame, (theirs or mine)[1], number)
    return "first in frame %d, in what is asked after its last stage" % frame


def compared(build, first):
    """The faults of a build compared with the first, a line each."""
    for scene, words in build.scenes.items():
        if words != first.scenes[scene]:
            try:
                place = first_difference(build, first, scene, int(words[0]))
            except Failure as failure:
                place = str(failure)
            yield "%s: %s has %s; %s has %s: %s" % (build, scene, words[2], first,
                                                    first.scenes[scene][2], place)
    for scene, snapshot in build.snapshots.items():
        if snapshot != first.snapshots[scene]:
            yield "%s: %s has another snapshot of frame %d" % (build, scene, AT)
    if not isinstance(build, Board) and build.absent:
        yield "%s: does not hold %s" % (build, ", ".join(build.absent))


# ------------------------------------------------------------------------ crossing

def other_kinds(builds):
    """(from, to): for every build one of the other byte order and one of the other word length."""
    for number, to in enumerate(builds):
        around = builds[number + 1:] + builds[:number]
        for kind in ["order", "bits"]:
            there = [each for each in around if getattr(each, kind) != getattr(to, kind)]
            if there:
                yield there[0], to, "%s to %s" % (getattr(there[0], kind), getattr(to, kind))


def snapshot_path(build, scene):
    return os.path.join(WORK, "%s-%s.snapshot" % (build.target, scene))


def cross(source, to, scene):
    """The fault of continuing from another build's snapshot, or None."""
    frames = min(2 * AT, int(source.scenes[scene][0]))
    words = to.run("scene=" + scene, "at=%d" % AT, "frames=%d" % frames,
                   "load=" + snapshot_path(source, scene))[-1]
    if words[0] != "scene" or words[-1] != source.scenes[scene][-1]:
        return "%s, goes on with %s of %s to %s; that to %s" % (
            to, scene, source, words[-1], source.scenes[scene][-1])
    return None


# ----------------------------------------------------------------------------- all

def make_meshes(build):
    """The meshes of the scenes, for every build of a target."""
    folder = os.path.join(WORK, build.target, "meshes")
    os.makedirs(folder, exist_ok=True)
    call([*build.command, "-c", "-O0", *INCLUDES,
          *[os.path.join(ROOT, path) for each in SCENE_MESHES for path in glob.glob(each)]], "meshes", folder)
    MESHES[build.target] = glob.glob(folder + "/*.o")


def attempt(action, build, *arguments):
    """None, or the failure."""
    try:
        action(*arguments)
    except Failure as failure:
        return "%s: %s" % (build, failure)
    return None


def do(build, number, scenes, play, commit):
    """Make and run a build; memory first holds zeros or other bytes, in turn. With a commit, keep whether it played as committed."""
    start = time.monotonic()

    def all_of_it():
        build.make()
        build.play(scenes, *play, "fill=%d" % (165 * (number % 2)))

    wrong = attempt(all_of_it, build)
    if commit:
        wrong = wrong or "\n".join(matrix_page.faults(build))
        with KEEPING:
            matrix_page.keep(build, not wrong, "" if wrong else compiler_version(build), commit)
    print("  %-58s %4d s%s" % (build, time.monotonic() - start,
                                 "  FAILS: " + wrong.splitlines()[0] if wrong else ""), flush=True)
    return wrong


def do_all(builds, scenes, play, jobs, commit):
    """Make and run all builds; returns the faults, a line each."""
    failures = []
    targets = {build.target: build for build in builds if not isinstance(build, Board)}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        failures += pool.map(lambda build: attempt(make_meshes, build, build), targets.values())
        failures += pool.map(lambda item: do(item[1], item[0], scenes, play, commit), enumerate(builds))
    done = [build for build in builds if build.scenes]
    kept = {build.target: build for build in reversed(done)}
    for build in done:
        wrong = list(compared(build, done[0]))
        failures += wrong
        if not wrong and build is not kept[build.target]:
            build.discard()
    return list(filter(None, failures)), done, list(kept.values())[::-1]


def cross_all(kept, jobs):
    """Continue snapshots on other builds; returns the faults, and how many continued by kind."""
    tasks = [(source, to, kind, scene) for source, to, kind in other_kinds(kept)
             for scene in CROSSED if scene in source.snapshots and scene in to.snapshots]
    found = {}
    os.makedirs(WORK, exist_ok=True)
    for build in kept:
        for scene in filter(build.snapshots.get, CROSSED):
            with open(snapshot_path(build, scene), "wb") as file:
                file.write(build.snapshots[scene])

    def one(task):
        source, to, kind, scene = task
        answer = []
        wrong = attempt(lambda: answer.append(cross(source, to, scene)), to)
        return kind, wrong or answer[0]

    failures = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for kind, wrong in pool.map(one, tasks):
            found[kind] = found.get(kind, 0) + (not wrong)
            failures += [wrong] if wrong else []
    return failures, found


def write_csv(builds):
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["target", "compiler", "options", "scene", "hash"])
        for build in builds:
            for scene, words in build.scenes.items():
                writer.writerow([build.target, build.compiler, build.options, scene, words[2]])


def report(builds, failures, crossings):
    scenes = builds[0].scenes if builds else {}
    frames = sum(int(words[0]) for words in scenes.values())
    awake = sum(int(words[1]) for words in scenes.values())
    for scene, words in scenes.items():
        print("  %-9s %5s frames, %5s awake, %s" % (scene, *words[:3]))
    for build in builds:
        if build.absent:
            print("  %s has no room for %s" % (build.target, ", ".join(build.absent)))
    print("%d frames, in %d of them a body is awake" % (frames, awake))
    print("%d snapshots gone on with elsewhere: %s" % (
        sum(crossings.values()), ", ".join("%d from %s" % (n, k) for k, n in crossings.items())))
    if 2 * awake < frames:
        failures.append("most frames are of bodies asleep")
    for failure in failures:
        print("FAIL " + failure)
    hashes = max((len({build.scenes[scene][2] for build in builds if scene in build.scenes})
                  for scene in scenes), default=0)
    print("%d builds, %d scenes, %s" % (len(builds), len(scenes),
                                        "1 hash each" if hashes == 1 and not failures else
                                        "%d failures" % len(failures)))


def compiler_version(build):
    """gcc 12.2.0 or clang 14.0.6."""
    return re.search(r"\d+\.\d+\.\d+", call([build.command[0], "--version"], "version")).group()


def chosen(arguments):
    """The builds that were asked for."""
    builds = list(every_build(arguments.short))
    if arguments.targets:
        builds = [build for build in builds if build.target in arguments.targets.split(",")]
    if arguments.compilers:
        builds = [build for build in builds if build.compiler in arguments.compilers.split(",")]
    if arguments.options:
        builds = [build for build in builds if build.options == arguments.options]
    if arguments.missing:
        builds = matrix_page.missing(builds)
    for target, folder in (text.split("=") for text in arguments.engine):
        for build in builds:
            build.engine = folder if build.target == target else build.engine
    return builds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", action="store_true", help="one build an instruction set")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--frames", type=int, help="of a scene; else %d, or %d" % FRAMES)
    parser.add_argument("--targets", help="only these, with commas")
    parser.add_argument("--compilers", help="only these, with commas")
    parser.add_argument("--options", help="only builds with these")
    parser.add_argument("--missing", action="store_true", help="only builds without a row of today's plays in tests/matrix.csv")
    parser.add_argument("--scenes", help="only these, with commas")
    parser.add_argument("--engine", metavar="TARGET=FOLDER", action="append", default=[],
                        help="for a target, the engine in another folder")
    arguments = parser.parse_args()
    builds = chosen(arguments)
    gate.need(*sorted({thing for build in builds for thing in build.need}))
    scenes = arguments.scenes.split(",") if arguments.scenes else []
    play = ["frames=%d" % (arguments.frames or FRAMES[arguments.short]), "at=%d" % AT]
    whole = not (scenes or arguments.frames or arguments.short or arguments.engine)
    failures, done, kept = do_all(builds, scenes, play, arguments.jobs, whole and evidence.commit())
    wrong, crossings = cross_all(kept, arguments.jobs)
    failures += wrong
    if not scenes:
        write_csv(done)
    report(done, failures, crossings)
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""One answer from every instruction set, compiler and option: tests/matrix.c, built in many ways.

Every build plays the scenes of tests/plays.c and must print the same hash for each. What cannot be
built or run is a failure, as is a hash that differs; then the first frame that differs is looked for,
and in it the stage that left something else. A snapshot that one build takes on the way is gone on
with by another, of the other byte order or word length. A row a build and scene goes to
out/matrix.csv.
"""
import argparse
import concurrent.futures
import csv
import glob
import os
import re
import shutil
import subprocess
import sys

import run_board

ROOT = run_board.ROOT
OUT = "out/matrix.csv"
DOCS = "docs/matrix.md"
WORK = "build/matrix"
TIMEOUT = 900  # seconds a run
AT = 500  # the frame whose snapshot is handed on
CROSSED = ["pile", "sheet"]  # scenes that are gone on with elsewhere

WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Werror".split()
INCLUDES = ["-I%s/%s" % (ROOT, name) for name in "include src port examples tests".split()]
PROGRAM = ["tests/matrix.c", "tests/plays.c", "examples/scene.c", "examples/scene_sheet.c",
           "port/option.c", "port/assert.c"]
SCENE_MESHES = "build/gen/*_mesh.c"

# Undefined behaviour ends the program; a trap needs no library, so this runs everywhere.
GCC_TRAP = "-fsanitize=undefined -fsanitize-undefined-trap-on-error"
CLANG_TRAP = "-fsanitize=undefined -fsanitize-trap=undefined"
SANITIZE = "-fsanitize=address,undefined -fno-sanitize-recover=all -DCAROM_DEBUG"

LEVELS = ["-O2", "-O0", "-O1", "-O3", "-Os"]
GCC = LEVELS + ["-O2 -flto", "-O3 -fwrapv", "-O1 -funsigned-char", "-O2 -fsigned-char",
                "-O1 " + GCC_TRAP]
CLANG_FEW = ["-O2", "-O0", "-Os -funsigned-char", "-O1 " + CLANG_TRAP]
NATIVE = {"gcc": GCC + ["-O0 -fwrapv", "-O1 " + SANITIZE, "-O3 " + SANITIZE],
          "clang": LEVELS + ["-O2 -flto -fuse-ld=lld", "-O3 -fwrapv", "-O1 -funsigned-char",
                             "-O2 -fsigned-char", "-O1 " + CLANG_TRAP, "-O1 " + SANITIZE]}
WASM = LEVELS + ["-Oz", "-O2 -fwrapv", "-O2 -funsigned-char", "-O2 -fsigned-char"]

# name: triple of the GNU tools, emulator, bits, byte order, whether clang makes code for it too
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
}
DYNAMIC = ["alpha"]  # its static programs do not start in QEMU 7.2


class Failure(Exception):
    """What went wrong with a build, in words."""


def call(command, what, folder=ROOT):
    """Run a command; returns what it prints, or raises a Failure that ends with its last lines."""
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              errors="replace", timeout=TIMEOUT)
    except FileNotFoundError:
        raise Failure("%s: %s is not there" % (what, command[0])) from None
    except subprocess.TimeoutExpired:
        raise Failure("%s: takes more than %d s" % (what, TIMEOUT)) from None
    if done.returncode:
        tail = (done.stdout[-400:] + done.stderr[-800:]).strip()
        raise Failure("%s: status %d\n%s" % (what, done.returncode, tail))
    return done.stdout


class Build:
    """One way to make the program, and what it printed."""

    def __init__(self, target, compiler, options, bits, order):
        self.target, self.compiler, self.options = target, compiler, options
        self.bits, self.order = bits, order
        self.engine = ROOT + "/src"
        self.folder = os.path.join(ROOT, WORK, target, compiler,
                                   re.sub(r"[^\w]+", "_", options).strip("_"))
        self.image = self.folder + "/matrix"
        self.scenes, self.snapshots, self.absent = {}, {}, []

    def __str__(self):
        return " ".join([self.target, self.compiler, self.options])

    def compile(self, command, sources, extra=()):
        """Objects of sources in the build's folder."""
        call([*command, "-std=c11", *INCLUDES, *extra, "-c",
              *[os.path.join(ROOT, source) for source in sources]], "compile", self.folder)

    def make(self, meshes):
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        self.compile([*self.command(), *self.options.split()],
                     sorted(glob.glob(self.engine + "/*.c")), ["-ffreestanding", *WARNINGS])
        self.compile([*self.command(), *self.options.split()], [*PROGRAM, *self.port()],
                     self.hosted())
        self.link(meshes)
        for path in glob.glob(self.folder + "/*.o"):
            os.remove(path)

    def hosted(self):
        return []

    def run(self, *options):
        """The words of every line that it prints."""
        text = call(self.runner() + list(options), "run")
        return [line.split() for line in text.splitlines()]

    def play(self, options):
        """Play all scenes."""
        for words in self.run(*options, "save=1"):
            if words[0] == "scene":
                self.scenes[words[1]] = words[2:]
            elif words[0] == "snapshot":
                self.snapshots[words[1]] = bytes.fromhex(words[2])
            elif words[0] == "absent":
                self.absent.append(words[1])
        if not self.scenes:
            raise Failure("run: no scene was played")


class Linux(Build):
    """For Linux on some processor, under QEMU's user mode or on this machine."""

    def __init__(self, target, kind, options):
        triple, self.emulator, bits, order, _ = LINUX.get(
            target, (None, None, 64, sys.byteorder, True))
        self.triple, self.kind = triple, kind
        super().__init__(target, kind, options, bits, order)

    def gcc(self):
        return [self.triple + "-gcc-12" if self.triple else "gcc"]

    def command(self):
        if self.kind == "gcc":
            return self.gcc()
        return ["clang"] + (["--target=" + self.triple] if self.triple else [])

    def port(self):
        return ["port/linux/console.c"]

    def link(self, meshes):
        # Debian's clang does not find every cross linker: gcc links what either has compiled
        linker = self.command() if not self.triple else self.gcc()
        static = ["-static"] if self.triple and self.target not in DYNAMIC else []
        call([*linker, *self.options.split(), *static, "-o", self.image,
              *glob.glob(self.folder + "/*.o"), meshes], "link") \
            if self.kind == "gcc" or not self.triple else \
            call([*linker, *static, "-o", self.image, *glob.glob(self.folder + "/*.o"), meshes],
                 "link")

    def runner(self):
        if not self.triple:
            return [self.image]
        library = ["-L", "/usr/" + self.triple] if self.target in DYNAMIC else []
        return ["qemu-" + self.emulator, *library, self.image]


class Wasm(Build):
    """WebAssembly without a library, in node."""

    def __init__(self, options):
        super().__init__("wasm32", "clang", options, 32, "little")

    def command(self):
        return ["clang", "--target=wasm32"]

    def hosted(self):
        return ["-ffreestanding", "-I%s/port/wasm" % ROOT]

    def port(self):
        return ["port/wasm/wasm.c"]

    def link(self, meshes):
        call([*self.command(), "-nostdlib", "-Wl,--no-entry,--export=main,-z,stack-size=262144",
              "-o", self.image, *glob.glob(self.folder + "/*.o"), meshes], "link")

    def runner(self):
        return ["node", ROOT + "/port/wasm/run.mjs", self.image]


class Board(Build):
    """The image that make builds for a bare board."""

    def __init__(self, board, settings):
        super().__init__(board, settings["CROSS"] + "gcc", "-O2", 32, "little")
        self.image = os.path.join("build", board, "matrix.elf")

    def make(self, meshes):
        call(["make", "-s", "BOARD=" + self.target, self.image], "make")

    def runner(self):
        return run_board.command(self.image, [])

    def run(self, *options):
        text = call(run_board.command(self.image, list(options)), "run")
        return [line.split() for line in text.splitlines()]


def boards():
    for path in sorted(glob.glob(ROOT + "/port/*/board.mk")):
        name = os.path.basename(os.path.dirname(path))
        settings = run_board.settings(name)
        if "QEMU" in settings:
            yield Board(name, settings)


def every_build(short):
    """All builds, the one that the others are compared with first."""
    yield from [Linux("x86_64", kind, options) for kind, sets in NATIVE.items()
                for options in (sets[:1] if short else sets)]
    for target, row in LINUX.items():
        yield from [Linux(target, "gcc", options) for options in (GCC[:1] if short else GCC)]
        if row[4] and not short:
            yield from [Linux(target, "clang", options) for options in CLANG_FEW]
    yield from [Wasm(options) for options in (WASM[:1] if short else WASM)]
    yield from boards()

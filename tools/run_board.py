#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run a program on a board: tools/run_board.py IMAGE [ARGUMENT...]

The name of the image's folder names the board: build/BOARD/program.elf, build/BOARD-debug, or build/BOARD-joined. The
program's text goes to stdout, and its exit status is passed on. On a QEMU board one instruction takes exactly 2^ICOUNT_SHIFT ns
of virtual time; a board that QEMU does not have names a RUNNER.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def board_of(image):
    return os.path.basename(os.path.dirname(os.path.abspath(image))).removesuffix("-joined").removesuffix("-debug")


def variables(path):
    """The variables of a Makefile that are set with := and compute nothing."""
    with open(os.path.join(ROOT, "port", path)) as file:
        return dict(re.findall(r"^(\w+) *:= *(.*?) *$", file.read(), re.M))


def settings(board):
    """The variables of a board's board.mk, and of its family's family.mk."""
    own = variables(board + "/board.mk")
    return {**variables(own["FAMILY"] + "/family.mk"), **own} if "FAMILY" in own else own


def boards():
    """The boards that have scenes to show."""
    found = sorted(os.listdir(os.path.join(ROOT, "port")))
    return [name for name in found
            if os.path.exists(os.path.join(ROOT, "port", name, "board.mk")) and scenes(name)]


def scenes(board):
    """{scene: frames a second}; the first scene is the board's default; 0: no rate."""
    pairs = (text.partition(":") for text in settings(board).get("SCENES", "").split())
    return {scene: int(rate or 0) for scene, _, rate in pairs}


def budget(board, scene):
    """
    The budget of a frame of a scene on a board: half of the frame, since the other half is the program's own; the whole frame
    where CYCLES are modelled, or where MIPS is a measured rate. None: no rate.
    """
    its, rate = settings(board), scenes(board).get(scene)
    if not rate:
        return None
    if "MIPS" in its:
        return int(float(its["MIPS"]) * 1e6 / rate)
    return int(float(its["CLOCK_MHZ"]) * 1e6 / rate / (1 if "CYCLES" in its else 2))


class Result:
    """The output of a program that ran a scene: its exit status, a row a frame, and the rest by its first
    word."""

    def __init__(self, done):
        words = [line.partition(" ") for line in done.stdout.splitlines()]
        self.status, self.text = done.returncode, done.stdout
        self.said = {word: rest for word, _, rest in words}
        self.columns = self.said.get("columns", "").split(",")
        self.rows = [dict(zip(self.columns, map(number, rest.split(","))))
                     for word, _, rest in words if word == "frame"]


def number(text):
    """A number of a row, or a word; a state hash has 16 digits and is no number."""
    return int(text) if text.isdecimal() and len(text) < 16 else text


def run(image, arguments, seconds=900):
    """Run an image without a display to photograph; returns a Result."""
    try:
        return Result(subprocess.run(command(image, arguments), stdin=subprocess.DEVNULL, text=True,
                                     stdout=subprocess.PIPE, timeout=seconds, errors="replace"))
    except subprocess.TimeoutExpired as late:
        said = (late.stdout or b"").decode(errors="replace")
        return Result(subprocess.CompletedProcess(late.cmd, 124, said))


def command(image, arguments, monitor=None):
    """The command that runs an image with arguments; monitor: a socket for QEMU's QMP."""
    board = settings(board_of(image))
    if "QEMU_USER" in board:
        return [board["QEMU_USER"], "-plugin", os.path.join(ROOT, board["RUNNER"]),
                os.path.abspath(image)] + arguments
    if "QEMU" not in board and "RUNNER" in board:
        return [os.path.join(ROOT, board["RUNNER"]), image] + arguments
    if "QEMU" not in board:
        return [os.path.abspath(image)] + arguments
    config = "enable=on,target=native,chardev=console"
    for argument in [os.path.basename(image)] + arguments:
        config += ",arg=" + argument.replace(",", ",,")
    return board["QEMU"].split() + [
        "-display", "none", "-serial", "none", "-monitor", "none",
        "-icount", "shift=%s,sleep=%s" % (board["ICOUNT_SHIFT"], board.get("ICOUNT_SLEEP", "off")),
        "-chardev", "stdio,id=console,signal=off",
        "-semihosting-config", config,
        "-kernel", image,
    ] + (["-qmp", "unix:%s,server=on,wait=off" % monitor] if monitor else [])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    return subprocess.run(command(sys.argv[1], sys.argv[2:]), stdin=subprocess.DEVNULL).returncode


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run a program on a board: tools/run_board.py IMAGE [ARGUMENT...]

The board is the name of the folder that holds the image: build/BOARD/program.elf, or
build/BOARD-debug. The program's text goes to stdout, its exit status is passed on. On a QEMU board
one instruction takes exactly 2^ICOUNT_SHIFT ns of virtual time.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def board_of(image):
    return os.path.basename(os.path.dirname(os.path.abspath(image))).removesuffix("-debug")


def settings(board):
    """The variables of a board's board.mk."""
    with open(os.path.join(ROOT, "port", board, "board.mk")) as file:
        return dict(re.findall(r"^(\w+) *:= *(.*?) *$", file.read(), re.M))


def command(image, arguments, monitor=None):
    """The command that runs an image with arguments; monitor: a socket for QEMU's QMP."""
    board = settings(board_of(image))
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

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Play a recording on the host and on boards: tools/replay.py FILE [--board BOARD]... [--against FILE]

It names the first frame and stage that differ, and the first body if two machines differ. With --against it compares two
recordings of one game, for example of two players in lockstep, frame by frame on the host. The exit status is 0 if all is
the same, 1 for a difference, 2 for a file that cannot be played.
"""
import argparse
import itertools
import subprocess
import sys

import run_board


def play(board, file, *more):
    """The exit status and the lines of a board that plays a file."""
    image = "build/%s/replay.elf" % board
    done = subprocess.run(run_board.command(image, ["file=" + file, *more]), text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, errors="replace")
    return done.returncode, done.stdout.splitlines() or ["it ended with status %d" % done.returncode]


def first_difference(one, other):
    """The number of the first lines that differ, and both; or None."""
    for number, pair in enumerate(itertools.zip_longest(one, other, fillvalue="nothing")):
        if pair[0] != pair[1]:
            return (number, *pair)
    return None


def name_machines(file, board, frame):
    """The difference in a frame between the host and a board."""
    trace = "trace=%d" % frame
    mine, theirs = play("host", file, trace)[1], play(board, file, trace)[1]
    for kind in ["stage", "body"]:
        found = first_difference([line for line in mine if line.startswith(kind)],
                                 [line for line in theirs if line.startswith(kind)])
        if found:
            print("  host: %s\n  %s: %s" % (found[1], board, found[2]))


def compare(file, other):
    """Play two recordings on the host, and report where their states or their calls differ."""
    found = first_difference(play("host", file, "each=1")[1], play("host", other, "each=1")[1])
    if not found:
        print("both recordings are the same")
        return 0
    number, mine, theirs = found
    print("the recordings part in frame %d:\n  %s: %s\n  %s: %s" % (
        number + 1, file, mine, other, theirs))
    return 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("--board", action="append", default=[])
    parser.add_argument("--against")
    given = parser.parse_args()
    if given.against:
        return compare(given.file, given.against)
    status, lines = play("host", given.file)
    print("host: " + lines[-1], flush=True)
    for board in given.board:
        on_board, said = play(board, given.file)
        print("%s: %s" % (board, said[-1]), flush=True)
        words = said[-1].split()
        played = "cannot be played" not in said[-1]
        if played and said[-1] != lines[-1] and words[0] == "frame" and words[1].strip(",").isdecimal():
            name_machines(given.file, board, int(words[1].strip(",")))
        status = max(status, on_board)
    return status


if __name__ == "__main__":
    sys.exit(main())

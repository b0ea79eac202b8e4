#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
The game of the Game Boy Advance, its keys pressed by a script: what they do to the body is read off
the states and the pictures. TAP.
"""
import os
import shutil
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tools"))
import run_board  # noqa: E402
from tap import board_cases  # noqa: E402

BOARD = "gba"
IMAGE = os.path.join(ROOT, "build", BOARD, "head.elf")
OUT = os.path.join(ROOT, "build", "tests", "pad")
STEPS = 200
A, B, SELECT, START, RIGHT, LEFT = 1, 2, 4, 8, 16, 32
HELD_FROM, TILTED = 12, 32  # pictures
HEAD, FIGURES = range(0, 150), range(153, 160)  # rows of the screen


class Picture:
    """A picture of 240 x 160 pixels, as the runner writes it."""

    def __init__(self, path):
        with open(path, "rb") as file:
            size = list(map(int, file.readline().split()[1:3]))
            bytes_ = file.read()
        self.width = size[0]
        self.pixels = list(zip(bytes_[0::3], bytes_[1::3], bytes_[2::3]))

    def rows(self, numbers):
        return [self.pixels[y * self.width:(y + 1) * self.width] for y in numbers]

    def centre(self):
        """Of the body, which alone is brown: column and row, in pixels."""
        at = [(x, y) for y, row in zip(HEAD, self.rows(HEAD)) for x, (r, g, b) in enumerate(row)
              if r > g + 16 and g >= b]
        return [sum(axis) / len(at) for axis in zip(*at)] if at else None

    def sky(self):
        """Pixels that are bluish: sky, which is seen through a wire frame."""
        return sum(b > g + 8 for row in self.rows(HEAD) for _, g, b in row)


def play(name, press=None, *options):
    """Play with some keys; returns the last state and the pictures in turn."""
    folder = os.path.join(OUT, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    every = ["play=1", "frames=%d" % STEPS, "pictures=" + folder, *options]
    result = run_board.run(IMAGE, every + (["press=" + press] if press else []), 100)
    return result.said.get("hash"), [Picture(os.path.join(folder, each))
                                     for each in sorted(os.listdir(folder))]


def tap(from_, keys):
    return "%d:%d,%d:0" % (from_, keys, from_ + 2)


def hash_after(frames, *options):
    """The state of the scene when nobody plays."""
    return run_board.run(IMAGE, ["frames=%d" % frames, *options], 100).said.get("hash")


def cases():
    """(name, whether it holds)"""
    untouched, plain = play("untouched")
    last = len(plain) - 1
    yield "untouched_it_is_the_scene", untouched is not None and untouched == hash_after(STEPS)

    # thrown up at 3.5 m/s: it is at the top a third of a second later, some 5 pictures
    state, pictures = play("a", tap(last - 6, A))
    yield "a_throws_it_up", state != untouched and \
        pictures[last].centre()[1] < plain[last].centre()[1] - 5

    for name, key, sign in [("left", LEFT, -1), ("right", RIGHT, 1)]:
        state, pictures = play(name, "%d:%d" % (HELD_FROM, key))
        yield name + "_tilts_gravity", state != untouched and \
            sign * (pictures[TILTED].centre()[0] - plain[TILTED].centre()[0]) > 5

    # begins again: it ends as a scene that has had only the steps since, four a picture at most
    state, pictures = play("start", tap(last - 8, START))
    yield "start_begins_again", state in map(hash_after, range(20, 45))

    state, pictures = play("b", tap(HELD_FROM, B))
    white = [any(min(pixel) > 240 for row in shown[last].rows(FIGURES) for pixel in row)
             for shown in (plain, pictures)]
    yield "b_hides_the_figures", state == untouched and white == [True, False]

    state, pictures = play("select", tap(HELD_FROM, SELECT))
    yield "select_draws_lines", state == untouched and pictures[last].sky() > 1.2 * plain[last].sky()


def main():
    return board_cases("pad", BOARD, IMAGE, cases)


if __name__ == "__main__":
    sys.exit(main())

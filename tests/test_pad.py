#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
The games of the Game Boy Advance, the Nintendo DS and the PlayStation, with keys pressed by a script. The
states and the pictures show the keys' effect on the body. TAP.
"""
import os
import shutil
import sys
from functools import partial

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tools"))
import run_board  # noqa: E402
from lib.tap import board_cases  # noqa: E402

SCENES = {"gba": "head48", "nds": "head450", "psx": "head450"}
STEPS = 200
A, B, SELECT, START, RIGHT, LEFT = 1, 2, 4, 8, 16, 32
HELD_FROM, TILTED = 12, 32  # pictures
FIGURES = 10  # rows at the bottom of a screen that the game's figures take, plus an edge


class Picture:
    """A picture as the runner writes it."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.width, self.height = map(int, file.readline().split()[1:3])
            bytes_ = file.read()
        pixels = list(zip(bytes_[0::3], bytes_[1::3], bytes_[2::3]))
        rows = [pixels[y * self.width:(y + 1) * self.width] for y in range(self.height)]
        self.scene, self.figures = rows[:-FIGURES], rows[3 - FIGURES:]

    def centre(self):
        """Column and row, in pixels, of the body, which alone is brown."""
        at = [(x, y) for y, row in enumerate(self.scene) for x, (r, g, b) in enumerate(row)
              if r > g + 16 and g >= b]
        return [sum(axis) / len(at) for axis in zip(*at)] if at else None

    def grass(self):
        """The number of green pixels; a wire frame of the ground has few of them."""
        return sum(g > r + 16 and g > b + 16 for row in self.scene for r, g, b in row)

    def white(self):
        """Whether figures are shown."""
        return any(min(pixel) > 240 for row in self.figures for pixel in row)


class Game:
    def __init__(self, board):
        self.image = os.path.join(ROOT, "build", board, "head.elf")
        self.scene = "scene=" + SCENES[board]
        self.out = os.path.join(ROOT, "build", "tests", "pad", board)

    def play(self, name, press=None):
        """Play with some keys; returns the last state and the pictures in order."""
        folder = os.path.join(self.out, name)
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        options = [self.scene, "play=1", "frames=%d" % STEPS, "pictures=" + folder]
        result = run_board.run(self.image, options + (["press=" + press] if press else []), 100)
        return result.said.get("hash"), [Picture(os.path.join(folder, each))
                                         for each in sorted(os.listdir(folder))]

    def hashes(self, most):
        """The states of the scene without keys, one a frame."""
        result = run_board.run(self.image, [self.scene, "frames=%d" % most], 100)
        return [row["hash"] for row in result.rows]


def tap(from_, keys):
    return "%d:%d,%d:0" % (from_, keys, from_ + 2)


def cases(board):
    """(name, whether it holds)"""
    game = Game(board)
    alone = game.hashes(STEPS)
    untouched, plain = game.play("untouched")
    last = len(plain) - 1
    yield "untouched_it_is_the_scene", untouched is not None and untouched == alone[-1]

    # thrown up at 3.5 m/s: the body is at the top a third of a second later, some 5 pictures
    state, pictures = game.play("a", tap(last - 6, A))
    yield "a_throws_it_up", state != untouched and \
        pictures[last].centre()[1] < plain[last].centre()[1] - 5

    for name, key, sign in [("left", LEFT, -1), ("right", RIGHT, 1)]:
        state, pictures = game.play(name, "%d:%d" % (HELD_FROM, key))
        yield name + "_tilts_gravity", state != untouched and \
            sign * (pictures[TILTED].centre()[0] - plain[TILTED].centre()[0]) > 5

    # the game begins again: it ends like a scene that had only the steps since then, at most four a
    # picture
    state, pictures = game.play("start", tap(last - 8, START))
    yield "start_begins_again", state in alone[19:44]

    state, pictures = game.play("b", tap(HELD_FROM, B))
    yield "b_hides_the_figures", state == untouched and \
        [plain[last].white(), pictures[last].white()] == [True, False]

    state, pictures = game.play("select", tap(HELD_FROM, SELECT))
    yield "select_draws_lines", state == untouched and 0 < 2 * pictures[-1].grass() < plain[last].grass()


def main():
    failed = [board_cases("pad_" + board, board, Game(board).image, partial(cases, board)) for board in SCENES]
    return any(failed)


if __name__ == "__main__":
    sys.exit(main())

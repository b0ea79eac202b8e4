#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""tools/run_scene.py keeps every picture of a run, whether the emulator writes it on request or the board
itself."""
import io
import os
import sys
import tempfile
import types

from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import run_scene  # noqa: E402

FRAMES, SIZE = 40, (64, 20)
failed = count = 0


def check(name, ok, seen):
    global failed, count
    count += 1
    failed += not ok
    print("%s %d - album/%s%s" % ("ok" if ok else "not ok", count, name, "" if ok else " (%r)" % (seen,)))


def write(path, frame):
    """The picture of a frame: a bar whose length is the frame's number."""
    image = Image.new("RGB", SIZE, "white")
    image.paste("black", (0, 0, frame, SIZE[1]))
    image.save(path)


def bar(path):
    image = Image.open(path).convert("L")
    return sum(image.getpixel((x, 3)) == 0 for x in range(image.width))


class Emulator:
    """An emulator that photographs the screen."""

    frame = 0

    def photograph(self, path):
        self.frame += 1
        write(path, self.frame)


def said_by_board(out):
    """A board that writes a picture before it reports the end of a frame."""
    for frame in range(1, FRAMES + 1):
        write(os.path.join(out, "frame-%04d.ppm" % frame), frame)
        yield "frame %d\n" % frame


def said_to_emulator():
    for frame in range(1, FRAMES + 1):
        yield "picture\n"
        yield "frame %d\n" % frame


def run(name, lines, camera):
    with tempfile.TemporaryDirectory() as out:
        album = run_scene.Album(out)
        process = types.SimpleNamespace(stdout=lines(out), stdin=io.StringIO())
        keep, sys.stdout = sys.stdout, io.StringIO()
        try:
            rows = len(run_scene.follow(process, camera, album, FRAMES).rows)
            album.finish("film")
        finally:
            sys.stdout = keep
        left = sorted(os.listdir(out))
        wanted = sorted(["film.gif"] + ["frame-%04d.png" % n for n in range(1, FRAMES + 1)])
        check(name + "/all_are_there_and_no_others", rows == FRAMES and left == wanted, (rows, left[:3]))
        seen = [bar(run_scene.png_name(out, n)) for n in range(1, FRAMES + 1)]
        check(name + "/each_in_its_place", seen == list(range(1, FRAMES + 1)), seen[:3])
        # every third picture from the first: 1, 4, ... 40
        film = Image.open(os.path.join(out, "film.gif"))
        check(name + "/animation", film.n_frames == 14 and film.width == 256, (film.n_frames, film.size))


run("emulator", lambda out: said_to_emulator(), Emulator())
run("board", said_by_board, None)
run("board_in_emulator", said_by_board, Emulator())
print("1..%d" % count)
sys.exit(failed > 0)

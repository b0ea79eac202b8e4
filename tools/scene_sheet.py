#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""List the scenes. Each scene that the host shows has a thumbnail of a typical frame.

A terminal with colours shows the thumbnails in characters. The folder gets NAME.png of each, index.html with all of them, and
scenes.png, one small picture with all of them.
"""
import argparse
import concurrent.futures
import html
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap

from PIL import Image, ImageDraw, ImageFont

import run_board
import terminal

FRAME = 90  # frame of a scene without an entry here
FRAMES = {"head": 16, "pile": 120, "sheet": 150, "box": 40, "car": 170, "walker": 150, "door": 60, "chain": 60,
          "crusher": 108, "conveyor": 60, "gears": 100, "screw": 240, "pour": 310, "espresso": 60, "espresso-fine": 100, "newton": 60, "dominoes": 120,
          "cards": 285, "arch": 290, "bowl": 60, "lockstep": 120}
THUMBNAIL, LABEL, GAP, ACROSS = 160, 46, 8, 5  # pixels, and thumbnails in a row of scenes.png
COLOURS = 128  # colours of scenes.png
CHARACTERS = 26  # characters across a thumbnail in a terminal

PAGE = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Scenes of Carom</title>
<style>
:root { color-scheme: light dark; font-family: sans-serif }
body { margin: 1rem }
ul { display: grid; grid-template-columns: repeat(auto-fill, minmax(14rem, 1fr)); gap: 1rem; padding: 0; list-style: none }
img { width: 100%%; display: block; border-radius: .5rem }
</style>
<h1>Scenes of Carom</h1>
<p><code>make run SCENE=name</code> runs one; the pictures are of the frame that is named.
<ul>
%s
</ul>
</html>
"""
ITEM = '<li><img src="%s.png" alt="" width="512" height="512"><b>%s</b>: %s (frame %d)'


def scenes(program):
    """Name and description of every scene, in order."""
    said = subprocess.run([program, "scenes=1"], check=True, capture_output=True, text=True).stdout
    return dict(line[len("scene "):].split(": ", 1) for line in said.splitlines() if line.startswith("scene "))


def shown():
    """The scenes with a thumbnail: those of port/host/board.mk."""
    return list(run_board.scenes("host"))


def photograph(program, name, out):
    """Write the scene's picture at its frame to out/NAME.png."""
    frame = FRAMES.get(name, FRAME)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "scene=" + name, "frames=%d" % frame, "only=%d" % frame, "pictures=" + folder],
                       check=True, stdout=subprocess.DEVNULL)
        shutil.move(os.path.join(folder, "frame-0001.png"), os.path.join(out, name + ".png"))


def load(out, name):
    return Image.open(os.path.join(out, name + ".png")).convert("RGB")


def write_page(out, names, texts):
    items = (ITEM % (name, name, html.escape(texts[name]), FRAMES.get(name, FRAME)) for name in names)
    with open(os.path.join(out, "index.html"), "w", encoding="utf-8") as file:
        file.write(PAGE % "\n".join(items))


def write_sheet(out, names, texts):
    """One picture: thumbnails in rows, each with its name and description below."""
    wide, high = THUMBNAIL + GAP, THUMBNAIL + LABEL + GAP
    sheet = Image.new("RGB", (ACROSS * wide + GAP, -(-len(names) // ACROSS) * high + GAP), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default()
    columns = THUMBNAIL // font.getbbox("m")[2]
    for i, name in enumerate(names):
        x, y = GAP + i % ACROSS * wide, GAP + i // ACROSS * high
        sheet.paste(load(out, name).resize((THUMBNAIL, THUMBNAIL), Image.LANCZOS), (x, y))
        lines = textwrap.wrap("%s: %s" % (name, texts[name]), columns)
        pen.multiline_text((x, y + THUMBNAIL + 2), "\n".join(lines[:4]), "black", font, spacing=0)
    sheet.quantize(COLOURS, dither=Image.Dither.NONE).save(os.path.join(out, "scenes.png"), optimize=True)


def show(out, names, stream=sys.stdout, environment=os.environ):
    """Print rows of thumbnails with their names, as many side by side as the terminal holds."""
    columns, count = terminal.shows(stream, environment)
    across = max(1, columns // (CHARACTERS + 1))
    for first in range(0, len(names) if count else 0, across):
        row = names[first:first + across]
        pictures = (terminal.picture(load(out, name), CHARACTERS, count) for name in row)
        print(" ".join(name.ljust(CHARACTERS) for name in row), file=stream)
        for line in zip(*pictures):
            print(" ".join(line), file=stream)
    return count > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("out")
    arguments = parser.parse_args()
    texts, names, out = scenes(arguments.program), shown(), arguments.out
    os.makedirs(out, exist_ok=True)
    for name, text in texts.items():
        print("  %-14s %s" % (name, text))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda name: photograph(arguments.program, name, out), names))
    write_page(out, names, texts)
    write_sheet(out, names, texts)
    show(out, names)
    print("thumbnails: %s, %s" % (os.path.join(out, "index.html"), os.path.join(out, "scenes.png")))


if __name__ == "__main__":
    main()

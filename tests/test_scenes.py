#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""tools/scene_sheet.py puts a thumbnail, a line and a place on both sheets for each scene that the host
shows. TAP."""
import html
import io
import itertools
import os
import pty
import re
import subprocess
import sys
import tempfile

from PIL import Image, ImageChops, ImageStat

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tools"))
import run_board  # noqa: E402
import scene_sheet  # noqa: E402
import terminal  # noqa: E402

PROGRAM = os.path.join(ROOT, "build", "host", "head.elf")
COLOURS_LEAST = 12  # colours of a picture with something in it; sky and ground alone have eleven
SHEET_MOST = 300000  # bytes, because the sheet is committed
failed = count = 0


def check(name, bad):
    """A case that passes when the list of faults is empty."""
    global failed, count
    count += 1
    failed += bool(bad)
    print("%s %d - scenes/%s%s" % ("not ok" if bad else "ok", count, name, " (%r)" % (bad,) if bad else ""))


def mean(image):
    return ImageStat.Stat(image).mean


def pictures(out, names):
    images = {name: scene_sheet.load(out, name) for name in names}
    check("size", [name for name, image in images.items() if image.size != (512, 512)])
    check("not_empty", [name for name, image in images.items()
                        if len(image.getcolors(512 * 512)) < COLOURS_LEAST])
    check("all_different", [pair for pair in itertools.combinations(names, 2)
                            if not ImageChops.difference(images[pair[0]], images[pair[1]]).getbbox()])
    return images


def page(out, names, texts):
    with open(os.path.join(out, "index.html"), encoding="utf-8") as file:
        text = file.read()
    check("page_lines", [name for name in names if "<b>%s</b>: %s" % (name, html.escape(texts[name])) not in text])
    check("page_pictures", [name for name in re.findall(r'src="([^"]*)"', text) if not os.path.exists(os.path.join(out, name))]
          or text.count("<img") != len(names))


def sheet(out, names, images):
    """Each place of the sheet has its scene's picture: the colours match, within what a palette changes."""
    path = os.path.join(out, "scenes.png")
    whole, off = Image.open(path).convert("RGB"), []
    size, wide, high = scene_sheet.THUMBNAIL, scene_sheet.THUMBNAIL + scene_sheet.GAP, \
        scene_sheet.THUMBNAIL + scene_sheet.LABEL + scene_sheet.GAP
    for i, name in enumerate(names):
        x = scene_sheet.GAP + i % scene_sheet.ACROSS * wide
        y = scene_sheet.GAP + i // scene_sheet.ACROSS * high
        place = whole.crop((x, y, x + size, y + size))
        difference = ImageChops.difference(place, images[name].resize((size, size)))
        off += [name] if max(mean(difference)) > 8 else []
    check("sheet", off)
    check("sheet_bytes", os.path.getsize(path) > SHEET_MOST and os.path.getsize(path))


def in_a_terminal(out, names):
    ours, theirs = pty.openpty()
    rows = names[:2]  # a terminal of unknown width has as many columns as fit into 72
    with os.fdopen(theirs, "w", encoding="utf-8") as stream:
        shown = terminal.shows(stream, {"COLORTERM": "truecolor"})
    os.close(ours)
    check("terminal_columns", shown != (terminal.COLUMNS_MOST, 1 << 24) and shown)

    class Screen(io.StringIO):
        encoding = "utf-8"

        def isatty(self):
            return True

        def fileno(self):
            return ours

    ours, theirs = pty.openpty()
    screen = Screen()
    scene_sheet.show(out, rows, screen, {"COLORTERM": "truecolor"})
    os.close(ours)
    os.close(theirs)
    lines = screen.getvalue().splitlines()
    check("terminal_names", lines[0].split() != rows and lines[:1])
    check("terminal_pictures", [line for line in lines[1:]
                                if line.count(terminal.UPPER_HALF) != 2 * scene_sheet.CHARACTERS] or len(lines) < 10)
    nothing = io.StringIO()
    check("not_into_a_file", scene_sheet.show(out, rows, nothing, {"COLORTERM": "truecolor"}) or nothing.getvalue())


def one_frame_alone():
    """A run that draws one frame only gives the same picture and the same state as a run that draws every
    frame."""
    with tempfile.TemporaryDirectory() as folder:
        said = []
        for name, options in (("all", []), ("one", ["only=12"])):
            os.mkdir(os.path.join(folder, name))
            run = subprocess.run([PROGRAM, "scene=door", "frames=12", "pictures=" + os.path.join(folder, name), *options],
                                 check=True, capture_output=True, text=True)
            said.append(run.stdout.splitlines()[-1])
        check("only_hash", said[0] != said[1] and said)
        files = [sorted(os.listdir(os.path.join(folder, name))) for name in ("all", "one")]
        check("only_files", (len(files[0]), len(files[1])) != (12, 1) and files)
        images = [Image.open(os.path.join(folder, name, names[-1])) for name, names in zip(("all", "one"), files)]
        check("only_picture", ImageChops.difference(*images).getbbox())


def main():
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([os.path.join(ROOT, "tools", "scene_sheet.py"), PROGRAM, out], check=True, stdout=subprocess.DEVNULL)
        names, texts = list(run_board.scenes("host")), scene_sheet.scenes(PROGRAM)
        check("frames_of_scenes", [name for name in scene_sheet.FRAMES if name not in names])
        images = pictures(out, names)
        page(out, names, texts)
        sheet(out, names, images)
        in_a_terminal(out, names)
    one_frame_alone()
    print("1..%d" % count)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())

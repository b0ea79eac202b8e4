#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""tools/terminal.py: the progress of a run, and a picture in characters, on a terminal and without one."""
import io
import os
import pty
import re
import sys
import threading

from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import terminal  # noqa: E402


class Tap:
    def __init__(self):
        self.count = self.failed = 0

    def check(self, name, ok, seen):
        self.count += 1
        self.failed += not ok
        print("%s %d - terminal/%s%s" % ("ok" if ok else "not ok", self.count, name, "" if ok else " (%r)" % (seen,)))


class Screen(io.StringIO):
    """A stream that claims to be a terminal."""

    def isatty(self):
        return True


def progress_says(tap):
    now = [0.0]
    screen = Screen()
    progress = terminal.Progress(40, screen, lambda: now[0])
    for frame in range(1, 41):
        now[0] += 0.25
        progress.show(frame)
    shown = screen.getvalue().split("\r")[1:]
    tap.check("a_frame_a_time", len(shown) == 40 and shown[0].strip() == "frame 1 of 40", shown[:2])
    # a quarter of a second each: after 10 of them 30 are left
    tap.check("time_left", "frame 10 of 40, 8 s left" in shown[9], shown[9])
    tap.check("time_it_took", shown[-1].rstrip() == "frame 40 of 40, 10 s" and shown[-1].endswith("\n"), shown[-1])
    late = shown[-1].rstrip("\n")
    tap.check("nothing_left_of_longer_lines", len(late) >= len(shown[-2].rstrip()), (shown[-2], late))


def progress_is_quiet(tap):
    stream = io.StringIO()
    progress = terminal.Progress(250, stream)
    for frame in range(1, 251):
        progress.show(frame)
    lines = stream.getvalue().splitlines()
    tap.check("without_a_terminal", lines == ["frame %d of 250" % n for n in (100, 200, 250)], lines)


def halves():
    """A picture that is red above and blue below."""
    image = Image.new("RGB", (16, 16), (255, 0, 0))
    image.paste((0, 0, 255), (0, 8, 16, 16))
    return image


def picture_is_right(tap):
    lines = list(terminal.picture(halves(), 8, 1 << 24))
    cells = [re.findall(r"\033\[38;2;(\d+);(\d+);(\d+);48;2;(\d+);(\d+);(\d+)m\u2580", line) for line in lines]
    tap.check("size", [len(row) for row in cells] == [8] * 4, [len(row) for row in cells])
    red, blue = ("255", "0", "0"), ("0", "0", "255")
    tap.check("colours", cells and cells[0][3] == red + red and cells[-1][3] == blue + blue, cells[0][:1])
    tap.check("ends_plain", all(line.endswith("\033[0m") for line in lines), lines[:1])
    few = [terminal.colour(rgb, 256) for rgb in ((0, 0, 0), (255, 255, 255), (255, 0, 0), (0, 0, 255))]
    # the corners of the cube of 6 x 6 x 6 that begins at 16
    tap.check("of_256", few == ["5;16", "5;231", "5;196", "5;21"], few)


def terminals(tap):
    cases = (({"COLORTERM": "truecolor", "TERM": "xterm"}, 1 << 24), ({"TERM": "xterm-256color"}, 256),
             ({"TERM": "dumb"}, 0), ({}, 0), ({"COLORTERM": "truecolor", "NO_COLOR": "1"}, 0))
    said = [terminal.colours(environment) for environment, _ in cases]
    tap.check("how_many_colours", said == [count for _, count in cases], said)


def all_of_it_is_seen(tap):
    """A square picture is twice as wide in characters as it is high; five lines stay free below it."""
    cases = (((200, 100), 72), ((50, 100), 50), ((200, 40), 70), ((80, 24), 38), ((80, 6), 20), ((72, 0), 72))
    said = [terminal.columns_for(halves(), *size) for size, _ in cases]
    tap.check("fits_the_terminal", said == [columns for _, columns in cases], said)


def on_a_terminal(environment):
    """Whether a picture was shown on a terminal that is read while it is written, and the text that was read."""
    ours, theirs = pty.openpty()
    seen = []

    def read():
        try:
            while data := os.read(ours, 1 << 16):
                seen.append(data)
        except OSError:  # the other end is closed
            pass

    reader = threading.Thread(target=read)
    reader.start()
    with os.fdopen(theirs, "w", encoding="utf-8") as stream:
        shown = terminal.show_picture(halves(), stream, environment)
    reader.join()
    os.close(ours)
    return shown, b"".join(seen).decode("utf-8", "replace")


def picture_needs_a_terminal(tap):
    truecolor = {"COLORTERM": "truecolor"}
    tap.check("not_into_a_file", not terminal.show_picture(halves(), io.StringIO(), truecolor), "shown")
    shown, seen = on_a_terminal(truecolor)
    tap.check("on_a_terminal", shown and "\u2580" in seen, seen[:80])
    ours, theirs = pty.openpty()
    with os.fdopen(theirs, "w", encoding="ascii") as stream:
        tap.check("not_in_ascii", not terminal.show_picture(halves(), stream, truecolor), "shown")
    os.close(ours)


def main():
    tap = Tap()
    for test in (progress_says, progress_is_quiet, picture_is_right, terminals, all_of_it_is_seen, picture_needs_a_terminal):
        test(tap)
    print("1..%d" % tap.count)
    return tap.failed > 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""For a user at a terminal: the progress of a run, the time left, and a picture in characters."""
import os
import sys
import time

COLUMNS_MOST = 72  # characters of a picture
LINES_BELOW = 5  # lines that stay visible below a picture
LINES_LEAST = 10  # least lines of a picture, however low the terminal is
UPPER_HALF = "\u2580"  # the upper half has the text's colour, the lower half the background's
SURE_AFTER = 0.5  # seconds until a guess of the time left is worth reading


class Progress:
    """A line that is overwritten frame by frame; without a terminal, a line for every hundred frames."""

    def __init__(self, frames, stream=sys.stdout, clock=time.monotonic):
        self.frames, self.stream, self.clock = frames, stream, clock
        self.start, self.width = clock(), 0

    def text(self, frame):
        passed = self.clock() - self.start
        text = "frame %d of %d" % (frame, self.frames)
        if frame == self.frames:
            return "%s, %.0f s" % (text, passed)
        if passed < SURE_AFTER:
            return text
        return "%s, %.0f s left" % (text, passed / frame * (self.frames - frame))

    def show(self, frame):
        if self.stream.isatty():
            text = self.text(frame)
            end = "\n" if frame == self.frames else ""
            print("\r" + text.ljust(self.width), end=end, file=self.stream, flush=True)
            self.width = len(text)
        elif frame % 100 == 0 or frame == self.frames:
            print("frame %d of %d" % (frame, self.frames), file=self.stream, flush=True)


def colours(environment):
    """The number of colours of a terminal, by its own description: 2^24, 256, or 0 for too few."""
    if environment.get("NO_COLOR"):
        return 0
    if environment.get("COLORTERM") in ("truecolor", "24bit"):
        return 1 << 24
    return 256 if "256color" in environment.get("TERM", "") else 0


def colour(rgb, count):
    """The end of an escape sequence for a colour; with 256 colours, the nearest one in their cube of 6 x 6 x
    6."""
    if count > 256:
        return "2;%d;%d;%d" % rgb
    red, green, blue = (min(range(6), key=lambda i: abs(part - (i and 55 + 40 * i))) for part in rgb)
    return "5;%d" % (16 + 36 * red + 6 * green + blue)


def picture(image, columns, count):
    """Lines of characters for an image of Pillow's, two rows of pixels a line."""
    rows = max(1, columns * image.height // image.width // 2)
    small = image.convert("RGB").resize((columns, 2 * rows))
    for y in range(0, 2 * rows, 2):
        cells = ("\033[38;%s;48;%sm%s" % (colour(small.getpixel((x, y)), count),
                                          colour(small.getpixel((x, y + 1)), count), UPPER_HALF)
                 for x in range(columns))
        yield "".join(cells) + "\033[0m"


def shows(stream=sys.stdout, environment=os.environ):
    """Columns and colours for pictures; none if the stream is no terminal that takes the character."""
    count = colours(environment)
    if not stream.isatty() or count == 0 or "utf" not in (stream.encoding or "").lower():
        return 0, 0
    return os.get_terminal_size(stream.fileno()).columns or COLUMNS_MOST, count


def columns_for(image, columns, lines):
    """The largest width at which a picture of that size is visible as a whole; 0 lines: height unknown."""
    fit = max(LINES_LEAST, lines - LINES_BELOW) if lines else COLUMNS_MOST
    return max(1, min(COLUMNS_MOST, columns, 2 * fit * image.width // image.height))


def show_picture(image, stream=sys.stdout, environment=os.environ):
    """Show an image if the stream is a terminal with colours that takes the character. True if it was shown."""
    columns, count = shows(stream, environment)
    if not count:
        return False
    lines = os.get_terminal_size(stream.fileno()).lines
    for line in picture(image, columns_for(image, columns, lines), count):
        print(line, file=stream)
    return True

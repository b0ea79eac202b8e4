# SPDX-License-Identifier: MIT
"""Lines of a page that a command writes: those between <!-- NAME --> and <!-- end of NAME -->."""
import sys


def split(text, name):
    """The text before the lines, the lines, and the text behind them; both comments stay outside."""
    begin, end = "<!-- %s -->\n" % name, "<!-- end of %s -->\n" % name
    before, found, rest = text.partition(begin)
    inside, closed, after = rest.partition(end)
    if not found or not closed:
        sys.exit("a page has no place for %s: it lacks %s or %s" % (name, begin.strip(), end.strip()))
    return before + begin, inside, end + after


def put(text, name, lines):
    """The page with other lines in place of the present ones."""
    before, _, after = split(text, name)
    return before + "".join(line + "\n" for line in lines) + after


def write(path, name, lines):
    """Put lines into the page of a file."""
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(put(text, name, lines))

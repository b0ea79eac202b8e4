#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Draw the diagrams of DESIGN.md: tools/diagrams.py [--check]

It writes docs/diagram-*.svg. With --check it writes nothing, and names the files that differ from
what this program draws; tools/check_diagrams does that.
"""
import os
import sys

from svg import BLUE, GREEN, GREY, INK, ORANGE, PALE, PINK, Picture

DOCS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "docs")
YELLOW, LILAC = "#fff3d0", "#b98bd0"


# ---------------------------------------------------------------- a swept leaf

def leaf():
    """A leaf of a over cells of b."""
    p = Picture(820, 450, "A swept leaf over cells")
    floor, side, left = 390, 100, 60
    top = [330, 300, 262, 268, 300, 286, 312, 330]
    bottom = [330, 352, 366, 362, 354, 360, 350, 330]
    box = (230, 84, 520, 300)

    def line(heights):
        return [(left + side * i, y) for i, y in enumerate(heights)]

    p.text(60, 24, "Seen from b, in section: z is up.", bold=True)
    p.path(line(top) + line(bottom)[::-1], "none", "#e2f0e2", closed=True)
    p.rect(box[0], box[1], box[2] - box[0], box[3] - box[1], YELLOW, INK, dash="6 4", opacity="0.6")
    p.path(line(top) + line(bottom)[::-1], INK, thick=1.6, closed=True)
    for i in range(len(top)):
        p.path([(left + side * i, 46), (left + side * i, floor)], GREY, thick=0.7, dash="4 3")
    for i in range(len(top) - 1):
        asked = box[0] < left + side * (i + 1) and box[2] > left + side * i
        p.text(left + side * i + side / 2, floor + 18, "asked" if asked else "not asked", "middle",
               INK if asked else GREY)
        # the list of the cell, highest first from left to right: two faces of the upper side, one of the lower one
        over, under = top[i:i + 2], bottom[i:i + 2]
        for k, (low, high) in enumerate([(max(over) - 2, min(over) - 4), (max(over) + 5, min(over) + 2),
                                         (max(under) + 3, min(under) - 3)]):
            colour = PALE if not asked else PINK if high < box[3] else GREY
            p.rect(left + side * i + 21 + 25 * k, high, 8, low - high, colour, GREY if not asked else None,
                   thick=0.5 if not asked else None)
    # the leaf at three times
    shape = [(0, 20), (34, -6), (74, 4), (108, 30), (70, 46), (28, 44)]
    for dx, dy, opacity, dash in ((248, 104, "0.15", "3 3"), (322, 164, "0.5", None), (396, 224, "0.15", "3 3")):
        p.path([(x + dx, y + dy) for x, y in shape], INK, LILAC, 1, dash=dash, opacity=opacity, closed=True)
    p.path([(302, 126), (450, 246)], INK, arrow=True)
    p.text(372, 150, "shift")
    p.text(236, 100, "start")
    p.text(316, 204, "middle", "end")
    p.text(506, 240, "end")
    p.measure(548, box[1], box[3], "swept box: the leaf in the middle of\nits way, with half of the shift and\n"
              "a tolerance on either side")
    p.rect(60, 420, 8, 18, PINK)
    p.text(76, 434, "reaches the height of the box: its face is asked")
    p.rect(430, 420, 8, 18, GREY)
    p.text(446, 434, "below the box: the walk down the list has ended")
    return p


# ------------------------------------------------------------------------ gaps

def gaps():
    """Distances from a surface and their meanings, in skins."""
    p = Picture(820, 460, "Gaps above a surface, in skins")
    zero, skin, left, right = 310, 48, 60, 760
    p.text(60, 24, "The gap between two surfaces. One skin is 1/2048 of the radius; of a pair it is the larger one.", bold=True)

    def at(skins):
        return zero - skins * skin

    p.rect(left, at(0), right - left, 2.5 * skin, "#dddddd")
    p.rect(left, at(5), right - left, 5 * skin, "#eef5fb")
    p.rect(left, at(1.125), right - left, 0.625 * skin, "#cde6c8")
    for skins, colour, dash, name in ((5, BLUE, "6 4", "margin, 5 skins: what is nearer is a contact"),
                                      (1, GREEN, None, "skin: an open contact closes down to this"),
                                      (0.5, PINK, None, "event gap, half a skin: here a hit stops both bodies"),
                                      (0, INK, None, "surface of b"),
                                      (-2.5, GREY, "6 4", "2.5 skins deep: what is deeper is no contact")):
        p.path([(left, at(skins)), (right, at(skins))], colour, thick=2 if dash is None else 1.5, dash=dash)
        p.text(right - 8, at(skins) + (17 if 0 <= skins < 1 else -6), name, "end", INK if colour == GREY else colour)
        p.text(left - 8, at(skins) + 5, "%g" % skins, "end")
    p.text(left - 8, at(5) - 14, "skins", "end")
    # examples of bodies
    p.path([(130, 78), (160, at(0.5)), (190, 82)], INK, "#ffffff", 1.5)
    p.path([(160, at(4.2)), (160, at(1.9))], PINK, arrow=True)
    p.text(160, 64, "a hit", "middle")
    p.path([(250, at(0.8)), (330, at(0.8)), (330, at(2.9)), (250, at(2.9))], INK, "#ffffff", 1.5, closed=True)
    p.text(290, at(2.1), "at rest", "middle")
    p.text(290, at(1.55), "0.5 to 1.125", "middle", GREEN)
    p.path([(390, at(3)), (470, at(3)), (470, at(4.6)), (390, at(4.6))], INK, "#ffffff", 1.5, closed=True)
    p.text(430, at(3.9), "contact,", "middle")
    p.text(430, at(3.9) + 16, "still open", "middle")
    p.path([(430, at(3) + 4), (430, at(1.2))], GREEN, dash="3 3", arrow=True)
    p.text(320, at(0) + 50, "Faces cross below 0. A hit stops above it, so rounding\ncannot put one body"
           " across the surface of the other.", "middle")
    return p


# ---------------------------------------------------------------------- a body

def state(p, x, y, width, name, words, fill):
    """A box of two lines below its name."""
    p.rect(x, y, width, 68, fill, INK, round_by=8)
    p.text(x + width / 2, y + 20, name, "middle", bold=True)
    p.text(x + width / 2, y + 38, words, "middle", size=12)


def body():
    """States of a moving body, and the events that lead from one to another."""
    p = Picture(900, 650, "What a body is when")
    p.rect(10, 36, 236, 604, "#f4f4f4")
    p.rect(256, 36, 634, 604, "#eef5fb")
    p.text(128, 26, "between frames", "middle", bold=True)
    p.text(560, 26, "within a frame", "middle", bold=True)
    state(p, 30, 110, 180, "awake", "has a position, a rotation\nand momenta", "#ffffff")
    state(p, 30, 360, 180, "asleep, standing", "momenta 0; path, region and\nbox are those of its place", PALE)
    state(p, 30, 500, 180, "out, standing", "its centre or speed left the\nrange of the formats", PALE)
    state(p, 350, 66, 220, "in flight", "its path is a parabola and a turn;\ngravity acts along it", "#ffffff")
    state(p, 350, 236, 220, "in contact", "its path is straight: its momenta\nhave all of the frame's gravity", "#cde6c8")
    state(p, 350, 400, 220, "stands", "for the rest of the frame:\na path of no motion", YELLOW)
    state(p, 430, 530, 220, "rewound", "is back where the frame found it;\nmomenta 0 or a quarter", YELLOW)
    p.rect(800, 66, 20, 560, "#ffffff", INK)
    p.text(810, 56, "the frame ends", "middle", size=12)

    # a frame begins
    p.path([(210, 130), (350, 100)], INK, arrow=True)
    p.text(262, 96, "a frame begins", size=12)
    p.path([(210, 150), (350, 262)], INK, arrow=True)
    p.text(262, 264, "with a slow\ncontact", size=12)
    # events
    for y in (84, 254):
        p.curve("M570 %d C632 %d 632 %d 574 %d" % (y - 6, y - 22, y + 34, y + 18), INK, arrow=True)
        p.text(626, y + 2, "a hit: its island is solved;\nor its slice ends: next path", size=12)
        p.path([(570, y + 38), (800, y + 38)], INK, arrow=True)
    p.path([(570, 440), (800, 440)], INK, arrow=True)
    p.path([(460, 134), (460, 236)], INK, arrow=True)
    p.text(470, 166, "a hit, and a contact is slow: it takes the gravity\nof the rest of the frame at once", size=12)
    p.path([(460, 304), (460, 400)], INK, arrow=True)
    p.text(470, 340, "its last hit (32, or substep_cap):\nits island is cut short, event CUT", size=12)
    p.curve("M350 116 C316 180 316 380 346 430", INK, arrow=True)
    # the frame ends
    p.path([(800, 564), (650, 564)], INK, arrow=True)
    p.text(664, 532, "its island gained more\nenergy than it has to give", size=12)
    p.path([(430, 564), (230, 564)], INK)
    p.path([(800, 616), (230, 616), (230, 164), (212, 164)], INK, arrow=True)
    p.text(540, 611, "all others", "middle", size=12)
    # sleep
    p.path([(50, 178), (50, 358)], INK, arrow=True)
    p.text(58, 236, "slow in contact\nfor 20 frames, and\nso is its island", size=12)
    p.path([(170, 360), (170, 180)], INK, arrow=True)
    p.text(162, 304, "touched, pushed,\nlost its support", "end", size=12)
    return p


# ---------------------------------------------------------------------- clocks

def clocks():
    """Slices, windows and a hit."""
    p = Picture(860, 420, "Clocks of three bodies over a frame")
    left, right = 150, 810
    rows = {"A": 90, "B": 190, "C": 290}
    hit = 0.56

    def at(t):
        return left + (right - left) * t

    p.text(20, 26, "Three bodies in one frame. Each bar is a path, which takes a slice of the frame.", bold=True)
    words = {"A": "A spins:\nshort slices", "B": "B", "C": "C hits\nnobody"}
    for name, y in rows.items():
        p.text(20, y + 12, words[name])
        p.path([(left, y + 20), (right, y + 20)], PALE)

    def bar(name, from_t, to_t, fill, words="", dash=None):
        y = rows[name]
        p.rect(at(from_t) + 1, y, at(to_t) - at(from_t) - 2, 32, fill, INK, dash=dash)
        p.text((at(from_t) + at(to_t)) / 2, y + 21, words, "middle", size=12)

    bar("A", 0, 0.38, "#cfe2f0", "slice")
    bar("A", 0.38, hit, "#cfe2f0", "ends at the hit")
    bar("A", hit, 0.86, "#f6cfe0", "new path")
    bar("A", 0.86, 1, "#f6cfe0", "slice")
    bar("B", 0, hit, "#cfe2f0", "one path, ends at the hit")
    bar("B", hit, 1, "#f6cfe0", "new path")
    bar("C", 0, 1, "#cfe2f0", "its path goes on: the hit does not change a bit of it")
    # the rest of the paths that were cut
    for name, to_t in (("A", 0.76), ("B", 1)):
        y = rows[name] - 12
        p.path([(at(hit), y), (at(to_t), y)], GREY, dash="4 3")
        p.text(at(hit) + 8, y - 4, "its path without the hit", colour=GREY, size=11)
    # windows of A and B
    y = 148
    for from_t, to_t in ((0, 0.38), (0.38, hit), (hit, 0.86), (0.86, 1)):
        p.path([(at(from_t) + 4, y), (at(to_t) - 4, y)], ORANGE, thick=4)
    p.text(20, y + 5, "windows of A, B", colour=ORANGE)
    y = 248
    for from_t, to_t in ((0, hit), (hit, 1)):
        p.path([(at(from_t) + 4, y), (at(to_t) - 4, y)], ORANGE, thick=4)
    p.text(20, y + 5, "windows of B, C", colour=ORANGE)
    p.path([(at(hit), 60), (at(hit), 228)], PINK, thick=2)
    p.text(at(hit), 54, "hit of A and B", "middle", PINK)
    for t, word in ((0, "0"), (1, "1")):
        p.path([(at(t), 330), (at(t), 340)], INK)
        p.text(at(t), 356, word, "middle")
    p.path([(left, 335), (right, 335)], INK)
    p.text((left + right) / 2, 356, "time of the frame", "middle")
    p.path([(20, 384), (50, 384)], ORANGE, thick=4)
    p.text(58, 389, "window: the time that two paths have in common. A pair looks for its hit in one window after the other;")
    p.text(58, 405, "a pair of which neither path is new keeps the hit that it has.")
    return p


DIAGRAMS = {"leaf": leaf, "gaps": gaps, "body": body, "clocks": clocks}


def main():
    checks = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not checks:
        sys.exit(__doc__)
    status = 0
    for name, draw in DIAGRAMS.items():
        path, text = os.path.join(DOCS, "diagram-%s.svg" % name), draw().string()
        if not checks:
            with open(path, "w") as file:
                file.write(text)
        elif not os.path.exists(path) or open(path).read() != text:
            print("docs/diagram-%s.svg is not what tools/diagrams.py draws" % name)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""Parts of machines: toothed wheels, a bolt and its nut."""
from functools import partial
from math import acos, atan2, cos, pi, sin, tan

from solids import pierced, rings

MODULE = 0.1  # the radius at which a wheel rolls on the next is half of this times its teeth
PRESSURE = 25 * pi / 180  # the pressure angle
BACKLASH = 0.006  # units along the rolling circle, for each tooth


def circle(x, y, radius, sides, turn=0.0):
    """A circular hole, clockwise."""
    return [(x + radius * cos(turn - 2 * pi * k / sides), y + radius * sin(turn - 2 * pi * k / sides))
            for k in range(sides)]


def flank(teeth):
    """Half a tooth, from its root to its tip, as an involute in two pieces: radius, and angle from the middle of the tooth."""
    rolling = MODULE * teeth / 2
    base, root, tip = rolling * cos(PRESSURE), rolling - 1.15 * MODULE, rolling + 0.85 * MODULE

    def involute(angle):
        return tan(angle) - angle

    def half(radius):
        return (pi * MODULE - 2 * BACKLASH) / 4 / rolling + involute(PRESSURE) - involute(acos(min(1, base / radius)))

    low = max(root, base)
    places = [low + (tip - low) * part for part in (0, 0.5, 1)]
    return ([(root, half(base))] if root < base - 0.01 else []) + [(r, half(r)) for r in places]


def gear(teeth, turn=0.0, holes=0, half=0.15):
    """A wheel about the y axis, twice `half` thick, with a square bore and round holes; `turn` puts the middle of a tooth from x towards z."""
    side, outline = flank(teeth), []
    for k in range(teeth):
        middle = turn + 2 * pi * k / teeth
        outline += [(r, middle - a) for r, a in side] + [(r, middle + a) for r, a in reversed(side)]
    outline = [(r * cos(angle), r * sin(angle)) for r, angle in outline]
    root = side[0][0]
    loops = [outline, circle(0, 0, 0.14, 4, turn + pi / 4)]
    for k in range(holes):
        angle, away, radius = turn + 2 * pi * (k + 0.5) / holes, 0.56 * root, (0.21 if holes > 4 else 0.17) * root
        loops.append(circle(away * cos(angle), away * sin(angle), radius, 8, angle))
    return pierced(loops, -half, half)


# Wheels that turn each other in order: number of teeth, and the axle's x, z
# (examples/scene_gears.c).
TRAIN = ((10, -1.5, 0.95), (24, 0, 1.75), (16, 1.6, 2.95), (12, 2.44, 1.83))


def train():
    """Meshes by name. Each wheel is turned so that its teeth lie between those of the wheel before."""
    wheels, turn = {}, 0.0
    for i, (teeth, x, z) in enumerate(TRAIN):
        if i > 0:
            before, from_x, from_z = TRAIN[i - 1]
            way = atan2(z - from_z, x - from_x)
            # the phase of the wheel before at this place, minus half a tooth, in teeth
            part = 0.5 - (way - turn) * before / (2 * pi)
            turn = way + pi - part * 2 * pi / teeth
        half = 0.15 if i % 2 else 0.12  # edges that lie on each other would need more tests
        wheels["gear%d" % teeth] = partial(gear, teeth, turn, {16: 4, 24: 5}.get(teeth, 0), half)
    return wheels


# A thread rises by a pitch in a turn. A pitch has four rows, at these heights and radii.
PITCH, SEGMENTS, LOOSE = 0.4, 18, 0.012
ROWS = ((0, 0.30), (0.06, 0.42), (0.15, 0.42), (0.21, 0.30))


class Thread:
    """Column i of row m is at angle i of SEGMENTS, i / SEGMENTS of a pitch above row m of column 0. Column 0 has four rows more
    than the others: column SEGMENTS is column 0, four rows up, and each end has a step there."""

    def __init__(self, rows, count):
        self.count, self.points = count, []
        for i in range(SEGMENTS):
            for m in range(count + (4 if i == 0 else 0)):
                z, radius = rows[m % 4]
                self.place(i, radius, z + PITCH * (m // 4 + i / SEGMENTS))

    def place(self, i, radius, z):
        angle = 2 * pi * i / SEGMENTS
        self.points.append((radius * cos(angle), radius * sin(angle), z))
        return len(self.points) - 1

    def at(self, i, m):
        return m + 4 if i == SEGMENTS else m if i == 0 else self.count + 4 + (i - 1) * self.count + m

    def faces(self):
        """Faces seen from outside. The diagonals have the same direction in bolt and nut, because these lie
        on each other."""
        for i in range(SEGMENTS):
            for m in range(self.count - 1):
                a, b, c, d = self.at(i, m), self.at(i + 1, m), self.at(i + 1, m + 1), self.at(i, m + 1)
                yield from ((a, b, c), (a, c, d))


def bolt():
    thread = Thread(ROWS, 4 * 7)
    last = thread.count - 1
    low, high = thread.place(0, 0, PITCH / 2), thread.place(0, 0, ROWS[3][0] + PITCH * (last // 4) + PITCH / 2)
    faces = list(thread.faces())
    for i in range(SEGMENTS):
        faces += [(low, thread.at(i + 1, 0), thread.at(i, 0)), (high, thread.at(i, last), thread.at(i + 1, last))]
    for m in range(4):
        faces += [(low, m, m + 1), (high, last + m + 1, last + m)]
    return thread.points, faces


def nut():
    """The nut: six-sided outside, with flat ends."""
    rows = [(z + (LOOSE if m > 1 else -LOOSE), (radius + LOOSE) / cos(pi / SEGMENTS)) for m, (z, radius) in enumerate(ROWS)]
    thread = Thread(rows, 4)
    last = thread.count - 1
    heights = rows[0][0], rows[3][0] + PITCH * (last // 4 + 1)
    faces = [(a, c, b) for a, b, c in thread.faces()]
    rim = []
    for i in range(SEGMENTS):
        side = 2 * pi * i / SEGMENTS % (pi / 3) - pi / 6
        rim.append([thread.place(i, 0.85 * cos(pi / 6) / cos(side), z) for z in heights])
    for i in range(SEGMENTS):
        (a, d), (b, c) = rim[i], rim[(i + 1) % SEGMENTS]
        faces += [(a, b, c), (a, c, d), (b, a, thread.at(i, 0)), (b, thread.at(i, 0), thread.at(i + 1, 0)),
                  (d, c, thread.at(i + 1, last)), (d, thread.at(i + 1, last), thread.at(i, last))]
    for m in range(4):
        faces += [(rim[0][0], m + 1, m), (rim[0][1], last + m, last + m + 1)]
    return thread.points, faces


def hexagon():
    """The head of the bolt."""
    return rings([[(0.85 * cos(pi * k / 3), 0.85 * sin(pi * k / 3), z) for k in range(6)] for z in (0, 0.35)])

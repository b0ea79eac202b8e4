# SPDX-License-Identifier: MIT
"""Parts of machines: toothed wheels, threads."""
from functools import partial
from math import acos, atan2, cos, pi, sin, tan

from solids import pierced

MODULE = 0.1  # a wheel's radius, where it rolls on the next one, is half of that a tooth
PRESSURE = 25 * pi / 180  # between the line on which teeth press and the way that they go
BACKLASH = 0.006  # units along the rolling circle, of each tooth


def circle(x, y, radius, sides, turn=0.0):
    """Clockwise: a hole."""
    return [(x + radius * cos(turn - 2 * pi * k / sides), y + radius * sin(turn - 2 * pi * k / sides))
            for k in range(sides)]


def flank(teeth):
    """Of half a tooth, from its root to its tip: radius, and angle from the middle of the tooth. An involute in two pieces."""
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
    """A wheel about the y axis, twice `half` thick, with a square bore and round holes; the middle of a tooth is at `turn` from x towards z."""
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


# Teeth of wheels that turn each other one after the other, and where their axles are: x, z (examples/scene_gears.c).
TRAIN = ((10, -1.5, 0.95), (24, 0, 1.75), (16, 1.6, 2.95), (12, 2.44, 1.83))


def train():
    """Meshes by name, each turned so that its teeth are between those of the one before."""
    wheels, turn = {}, 0.0
    for i, (teeth, x, z) in enumerate(TRAIN):
        if i > 0:
            before, from_x, from_z = TRAIN[i - 1]
            way = atan2(z - from_z, x - from_x)
            # in teeth: where the one before is on the way here, and so half a tooth less on the way back
            part = 0.5 - (way - turn) * before / (2 * pi)
            turn = way + pi - part * 2 * pi / teeth
        half = 0.15 if i % 2 else 0.12  # edges that lie on each other would have more to test
        wheels["gear%d" % teeth] = partial(gear, teeth, turn, {16: 4, 24: 5}.get(teeth, 0), half)
    return wheels

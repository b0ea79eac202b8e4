# SPDX-License-Identifier: MIT
"""Small non-convex things, 0.4 across, to be poured, and the bucket and tray for them."""
from math import cos, pi, sin

from solids import ears, extrude, rings


def polygon(sides, radius, z):
    return [(radius * cos(2 * pi * k / sides), radius * sin(2 * pi * k / sides), z) for k in range(sides)]


def ring():
    """Six-sided, with a square section: the two outlines at one height, then the two at the other."""
    outlines = [polygon(6, radius, z) for radius, z in ((0.2, -0.05), (0.2, 0.05), (0.11, 0.05), (0.11, -0.05))]
    points, faces = [p for outline in outlines for p in outline], []
    for k in range(6):
        for i in range(4):
            a, b = 6 * i + k, 6 * i + (k + 1) % 6
            c, d = 6 * ((i + 1) % 4) + (k + 1) % 6, 6 * ((i + 1) % 4) + k
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def star():
    outline = [((0.21, 0.09)[k % 2] * sin(-pi * k / 5), (0.21, 0.09)[k % 2] * cos(pi * k / 5)) for k in range(10)]
    return extrude(outline, -0.06, 0.06, ears(outline))


def hook():
    outline = [(-0.16, -0.2), (0.16, -0.2), (0.16, 0), (0.07, 0), (0.07, -0.11), (-0.07, -0.11), (-0.07, 0.2), (-0.16, 0.2)]
    return extrude(outline, -0.06, 0.06, ears(outline))


def beaker():
    return rings([polygon(6, 0.14, -0.16), polygon(6, 0.19, 0.16), polygon(6, 0.14, 0.16), polygon(6, 0.1, -0.1)])


def box(x, y, z, wall):
    """A box that is open above; x, y and z are inside measures, from the middle and up from 0."""
    def outline(more, height):
        return [(i * (x + more), j * (y + more), height) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    return rings([outline(wall, -wall), outline(wall, z), outline(0, z), outline(0, 0)])


def bucket():
    return box(0.68, 0.68, 0.9, 0.06)


def tray():
    return box(1.2, 0.95, 0.45, 0.08)

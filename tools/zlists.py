#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Draw the z-lists of a step: tools/zlists.py PROGRAM [--check]

PROGRAM is built from tests/zlists.c; it prints the content of a row of cells, and the gather of one leaf. This tool
writes docs/zlists-row.svg, docs/zlists-leaf.svg, docs/zlists-view.png and the tables of docs/z-lists.md. With --check
it writes nothing, and compares the drawings and tables in docs/ with what it would write.
"""
import os
import subprocess
import sys

from PIL import Image

import marked
from svg import BLUE, GREEN, GREY, INK, ORANGE, PALE, PINK, Picture

OUT, DOCS = "out/zlists", "docs"
PAGE = os.path.join(DOCS, "z-lists.md")
WIDTH, LEFT, TOP = 960, 20, 44
NARROW = 600  # width of a picture that is higher than wide
# fate of an entry below the leaf: colour, words
FATES = {"candidate": (PINK, "its features become candidates"),
         "near": (ORANGE, "the leaf reaches its plane; no features can touch"),
         "parted": (BLUE, "parted by box, slab or plane"),
         "above": (GREEN, "above the box: passed over"),
         "below": (GREY, "below the box: the walk has ended")}
CROP = (0, 150, 440, 430)  # the part of a picture of the viewer


class Row:
    """A row of cells: its place, and its entries (column, z0, z1, face, fate, corners) in the order of the
    lists."""

    def __init__(self, words):
        self.entries = []
        for name in ("faces", "side", "x0", "y", "of"):
            setattr(self, name, int(words[words.index(name) + 1]))
        at = words.index("cells")
        self.columns, self.rows = int(words[at + 1]), int(words[at + 2])

    def add(self, words):
        column, z0, z1, face = map(int, words[:4])
        numbers = list(map(int, words[5:]))
        self.entries.append((column, z0, z1, face, words[4], [numbers[i:i + 3] for i in (0, 3, 6)]))

    def cell(self, column):
        return [entry for entry in self.entries if entry[0] == column]


class Said:
    """The output of the program."""

    def __init__(self, text):
        self.rows, self.leaf_faces, self.leaf = {}, [], {}
        row = None
        for line in text.splitlines():
            word, *words = line.split()
            if word == "row":
                row = self.rows[words[0]] = Row(words)
            elif word == "entry":
                row.add(words)
            elif word == "leafface":
                numbers = list(map(float, words))
                self.leaf_faces.append([numbers[i:i + 3] for i in (0, 3, 6)])
            elif word == "leaf":
                self.leaf = {"faces": int(words[1]), "candidates": int(words[3]), "leaves": int(words[5]),
                             "box": list(map(int, words[7:]))}
            elif word == "frame":
                self.frame = int(words[0])


def cut(corners, y):
    """The line in which a face meets the plane of this y: two points (x, z), or none."""
    points = []
    for i in range(3):
        p, q = corners[i], corners[(i + 1) % 3]
        if (p[1] < y) != (q[1] < y):
            t = (y - p[1]) / (q[1] - p[1])
            points.append((p[0] + t * (q[0] - p[0]), p[2] + t * (q[2] - p[2])))
    return points


class Section:
    """A picture of some columns of a row: quanta to pixels."""

    def __init__(self, row, columns, z_range, width, height, title):
        """height: pixels of z_range; None: the scale of x."""
        self.row, self.columns = row, columns
        self.x0 = row.x0 + columns[0] * row.side
        self.scale = (width - 2 * LEFT) / (len(columns) * row.side)
        tall = z_range[1] - z_range[0]
        self.z1, self.z_scale = z_range[1], height / tall if height else self.scale
        self.bottom = TOP + round(tall * self.z_scale)
        self.picture = Picture(width, self.bottom + 130, title)

    def at(self, x, z):
        return LEFT + (x - self.x0) * self.scale, TOP + (self.z1 - z) * self.z_scale

    def cells(self):
        for column in [*self.columns, self.columns[-1] + 1]:
            x = self.at(self.row.x0 + column * self.row.side, 0)[0]
            self.picture.path([(x, TOP - 10), (x, self.bottom + 10)], GREY, thick=0.7, dash="4 3")

    def lists(self, colour_of):
        """The entries of each cell as bars from z0 to z1, from left to right in the order of the list."""
        for column in self.columns:
            cell = self.row.cell(column)
            pitch = self.row.side * self.scale / (len(cell) + 1)
            for i, (_, z0, z1, face, fate, _) in enumerate(cell):
                x, y = self.at(self.row.x0 + column * self.row.side, z1)
                thick = min(pitch * 0.6, 7)
                self.picture.rect(x + pitch * (i + 1) - thick / 2, y - 0.5, thick, (z1 - z0) * self.z_scale + 1,
                                  colour_of(fate))

    def surface(self):
        for corners in {entry[3]: entry[5] for entry in self.row.entries if entry[0] in self.columns}.values():
            points = cut(corners, self.row.y)
            if len(points) == 2:
                self.picture.path([self.at(*p) for p in points], INK, thick=1.6)


def draw_row(said):
    """The moving body's own lists, whole."""
    row = said.rows["a"]
    low, high = min(e[1] for e in row.entries), max(e[2] for e in row.entries)
    section = Section(row, range(row.columns), (low, high), NARROW, None, "A row of the cells of the head, in section")
    section.cells()
    section.lists(lambda fate: BLUE)
    section.surface()
    p, y = section.picture, section.bottom + 40
    p.text(LEFT, 22, "Row %d of %d of the head's %d x %d cells, in section. z is up." % (
        row.of + 1, row.rows, row.columns, row.rows), bold=True)
    p.path([(LEFT, y - 5), (LEFT + 24, y - 5)], INK, thick=1.6)
    p.text(LEFT + 32, y, "the surface where the middle of the row cuts it")
    p.rect(LEFT + 9, y + 8, 6, 22, BLUE)
    p.text(LEFT + 32, y + 24, "an entry: the interval of z that one face spans over the whole cell;\n"
           "in each cell the list goes from left to right, highest first")
    p.path([(LEFT + 12, y + 50), (LEFT + 12, y + 74)], GREY, thick=0.7, dash="4 3")
    p.text(LEFT + 32, y + 66, "sides of cells, %d quanta apart" % row.side)
    return p


def draw_leaf(said):
    """The leaf over the cells that it visits."""
    row, box = said.rows["b"], said.leaf["box"]
    columns = range((box[0] - row.x0) // row.side, (box[3] - row.x0) // row.side + 1)
    columns = range(max(columns[0] - 1, 0), min(columns[-1] + 2, row.columns))
    shown = [e for e in row.entries if e[0] in columns and e[4] != "unasked"]
    z_range = min(e[1] for e in shown) - 40, box[5] + 15
    section = Section(row, columns, z_range, WIDTH, 330, "A swept leaf of the head over cells of the field")
    p = section.picture
    section.cells()
    (x0, y0), (x1, y1) = section.at(box[0], box[5]), section.at(box[3], box[2])
    p.rect(x0, y0, x1 - x0, y1 - y0, "#fff3d0", INK, dash="6 4", opacity="0.6")
    for corners in said.leaf_faces:
        p.path([section.at(c[0], c[2]) for c in corners], GREY, "#b98bd0", 0.8, closed=True, opacity="0.35")
    section.lists(lambda fate: FATES[fate][0] if fate in FATES else PALE)
    section.surface()
    p.text(LEFT, 22, "A leaf of %d faces over row %d of the field's cells, frame %d. z is up, and stretched by %.1f." % (
        said.leaf["faces"], row.of + 1, said.frame, section.z_scale / section.scale), bold=True)
    p.text((x0 + x1) / 2, y0 + 16, "swept box of the leaf", "middle")
    y, half = section.bottom + 34, WIDTH / 2
    p.rect(LEFT, y - 10, 24, 12, "#b98bd0", GREY, opacity="0.35")
    p.text(LEFT + 32, y, "the leaf's faces, in the middle of their way")
    p.path([(LEFT + half, y - 5), (LEFT + half + 24, y - 5)], INK, thick=1.6)
    p.text(LEFT + half + 32, y, "the field where the middle of the row cuts it")
    present = {e[4] for e in row.entries}
    keys = [(c, "entry: " + words) for fate, (c, words) in FATES.items() if fate in present]
    keys.append((PALE, "entry of a cell that is not under the box: nobody reads it"))
    for i, (colour, words) in enumerate(keys):
        x, foot = LEFT + half * (i % 2), y + 26 + 26 * (i // 2)
        p.rect(x + 8, foot - 13, 7, 18, colour)
        p.text(x + 32, foot, words)
    return p


# ------------------------------------------------------------------ the page

def table_cell(said):
    """The list of the cell whose entries have the most fates."""
    row = said.rows["b"]
    asked = [column for column in range(row.columns) if any(e[4] in FATES for e in row.cell(column))]
    column = max(asked, key=lambda c: (len({e[4] for e in row.cell(c)}), len(row.cell(c))))
    lines = ["Cell %d of row %d, whose list has %d entries; the leaf's box goes from z = %d to %d:" % (
        column + 1, row.of + 1, len(row.cell(column)), said.leaf["box"][2], said.leaf["box"][5]), "",
             "| z0 | z1 | face | what becomes of it |", "|---|---|---|---|"]
    lines += ["| %d | %d | %d | %s |" % (z0, z1, face, FATES[fate][1])
              for _, z0, z1, face, fate, _ in row.cell(column)]
    return lines


def table_counts(said):
    row = said.rows["b"]
    counts = {fate: len({e[3] for e in row.entries if e[4] == fate}) for fate in FATES}
    asked = {e[0] for e in row.entries if e[4] in FATES}
    lines = ["| what | number |", "|---|---|",
             "| faces of the field | %d |" % row.faces,
             "| faces in this row of %d cells | %d |" % (row.columns, len({e[3] for e in row.entries})),
             "| faces in the %d cells under the leaf | %d |" % (
                 len(asked), len({e[3] for e in row.entries if e[0] in asked}))]
    return lines + ["| of these: %s | %d |" % (words, counts[fate]) for fate, (_, words) in FATES.items() if counts[fate]]


def side_by_side(paths):
    images = [Image.open(path).convert("RGB").crop(CROP) for path in paths]
    joined = Image.new("RGB", (2 * images[0].width + 8, images[0].height), "white")
    for i, image in enumerate(images):
        joined.paste(image, (i * (image.width + 8), 0))
    return joined.quantize(96, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)


def main():
    checks = sys.argv[2:] == ["--check"]
    if len(sys.argv) < 2 or (len(sys.argv) > 2 and not checks):
        sys.exit(__doc__)
    os.makedirs(OUT, exist_ok=True)
    done = subprocess.run([sys.argv[1], "pictures=" + OUT], stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(done.stdout)
    said = Said(done.stdout)
    with open(PAGE) as file:
        page = file.read()
    page = marked.put(marked.put(page, "cell", table_cell(said)), "counts", table_counts(said))
    made = {"zlists-row.svg": draw_row(said).string(), "zlists-leaf.svg": draw_leaf(said).string(), "z-lists.md": page}
    status = 0
    for name, text in made.items():
        path = os.path.join(DOCS, name)
        if checks:
            with open(path) as file:
                if file.read() != text:
                    print("%s is not what make zlists writes" % path)
                    status = 1
            continue
        with open(path, "w") as file:
            file.write(text)
        print(path)
    if not checks:
        path = os.path.join(DOCS, "zlists-view.png")
        side_by_side([os.path.join(OUT, "frame-%04d.png" % n) for n in (1, 2)]).save(path, optimize=True)
        print(path)
    return status


if __name__ == "__main__":
    sys.exit(main())

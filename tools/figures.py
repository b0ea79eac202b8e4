#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The paper's figures 6, 7 and 8, measured, beside the paper's numbers: tools/figures.py PROGRAM

Figure 6 is a picture of examples/figures.c with the interfering faces coloured just before the impact, and
their counts. Figure 7 is the cost of a frame in contact over the number of polygons. Figure 8 is the paper's
other two scenes. Costs come from out/bench.csv. Everything goes to out/figures; the page and its small
pictures also go to docs/.
"""
import os
import subprocess
import sys

from PIL import Image

import bench
import run_board

OUT, DOCS = "out/figures", "docs"
FIELDS = [512, 3034, 12012, 49928]  # faces, of the growth of figure 7
HEAD = 1876
# The paper's seconds a frame are in bench.PAPER
POLYGONS = {"head": (1875, 3032), "head450": (450, 386), "espresso": (836, 512)}
TITLES = {"head": "a head on a height field", "head450": "450 + 386", "espresso": "836 + 512"}
PAPER_TOTAL = {scene: seconds * bench.PAPER_RATE for scene, seconds in bench.PAPER.items()}

# a part of a frame: its stages, its colour
PARTS = {
    "detection": (["predict", "broad", "interfere", "boyse"], "#1f78b4"),
    "dynamics": (["contact", "impact", "rest", "advance", "commit"], "#33a02c"),
    "display": ([bench.DISPLAY], "#e08214"),
}
RED = "#d00000"  # the paper's colour

STYLE = """
set terminal pngcairo size 900,520 font "sans,12" background "#ffffff"
set border 3 lc rgb "#666666"
set tics nomirror
set grid ytics lc rgb "#dddddd" lt 1
"""


class Page:
    """The sources of a figure, as Markdown."""

    def __init__(self):
        self.lines = ["<!-- SPDX-License-Identifier: MIT -->"]

    def text(self, *lines):
        self.lines += [*lines, ""]

    def picture(self, name, about):
        self.text("![%s](%s)" % (about, name))

    def table(self, *rows):
        lines = ["| " + " | ".join(row) + " |" for row in rows]
        self.text(lines[0], "|---" * len(rows[0]) + "|", *lines[1:])

    def write(self, path):
        with open(path, "w") as file:
            file.write("\n".join(self.lines).rstrip() + "\n")


def save(image, name):
    """A picture of 256 colours, including rare ones, for the page in either place."""
    few = image.convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    for folder in (OUT, DOCS):
        few.save(os.path.join(folder, name), optimize=True)


def million(instructions):
    return "%.2f" % (instructions / 1e6)


def parts_of(figures, scene):
    """The cost of each part of a frame in contact; nothing if it was not measured."""
    keys = {part: [(scene, "contact", stage) for stage in stages] for part, (stages, _) in PARTS.items()}
    if not all(key in figures for every in keys.values() for key in every):
        sys.exit("%s: %s is not in it" % (bench.OUT, scene))
    return {part: sum(figures[key].mean for key in every) for part, every in keys.items()}


# ------------------------------------------------------------------ pictures

def photograph(program, scene):
    """Run examples/figures.c; returns its output and its pictures."""
    folder = os.path.join(OUT, scene)
    os.makedirs(folder, exist_ok=True)
    done = run_board.run(program, ["scene=" + scene, "pictures=" + folder])
    if done.status:
        sys.exit("%s: %s" % (scene, done.text))
    said = {word: [int(number) for number in done.said[word].split()]
            for word in ("faces", "first", "interfering")}
    return said, [Image.open(os.path.join(folder, "frame-%04d.png" % n)) for n in (1, 2, 3)]


def side_by_side(images):
    gap, (width, height) = 8, images[0].size
    joined = Image.new("RGB", (len(images) * (width + gap) - gap, height), "white")
    for i, image in enumerate(images):
        joined.paste(image, (i * (width + gap), 0))
    return joined


def plot(name, text):
    path = os.path.join(OUT, name)
    done = subprocess.run(["gnuplot"], input="%sset output '%s'\n%s" % (STYLE, path, text), text=True)
    if done.returncode:
        sys.exit("gnuplot: status %d" % done.returncode)
    save(Image.open(path), name)


# ------------------------------------------------------------------- figures

def figure6(page, said, images):
    save(side_by_side(images), "figure6.png")
    faces, hot = said["faces"], said["interfering"]
    page.text("## Figure 6: interfering faces")
    page.picture("figure6.png", "The head where it first meets the field: the scene, near by, and from below, the field"
                 " hiding nothing; faces that interfere are orange on the head and pink on the field")
    page.text("The head in frame %d, where it first meets the field and before the impact is solved: the scene, near by, and"
              % said["first"][0],
              "from below, where the field hides nothing because it is seen from its back. The collision test got the faces that are orange",
              "on the head and pink on the field.")
    page.table(["", "head", "field", "both", "faces that interfere"],
               ["the paper", *["%d" % n for n in POLYGONS["head"]], "%d" % sum(POLYGONS["head"]),
                "coloured; their number is not given"],
               ["Carom", *["%d" % n for n in faces], "%d" % sum(faces),
                "%d of the head, %d of the field" % tuple(hot)])


def figure7(page, figures):
    costs = {HEAD + field: parts_of(figures, "growth-%d" % field) for field in FIELDS}
    blocks, plots = [], []
    series = [(part, colour, "lw 2 ps 1.2 pt 7") for part, (_, colour) in PARTS.items()]
    # above the line of the display, which is nearly all of the cost
    for part, colour, style in series + [("all of it", "#000000", "lw 2 ps 1.6 pt 6 dt 2")]:
        rows = ["%d %f" % (polygons, cost.get(part, sum(cost.values())) / 1e6) for polygons, cost in costs.items()]
        blocks.append("$p%d << EOD\n%s\nEOD\n" % (len(blocks), "\n".join(rows)))
        plots.append("$p%d with linespoints %s lc rgb '%s' title \"%s\"" % (len(plots), style, colour, part))
    blocks.append("$paper << EOD\n%d %f\nEOD\n" % (sum(POLYGONS["head"]), PAPER_TOTAL["head"] / 1e6))
    plots.append("$paper with points ps 2.5 pt 13 lc rgb '%s' title \"the paper, all of it\"" % RED)
    plot("figure7.png", "".join(blocks) + """
set title "A frame in contact, a head on finer and finer fields"
set key outside right top Left reverse spacing 1.4
set logscale xy
set xrange [2000:60000]
set yrange [0.005:*]
set format y "%%g"
set xtics (%s)
set xlabel "polygons of both objects"
set ylabel "million instructions a frame"
plot %s
""" % (", ".join("'%s' %d" % (format(polygons, ","), polygons) for polygons in costs), ", ".join(plots)))
    page.text("## Figure 7: execution time against the number of polygons")
    page.picture("figure7.png", "Instructions of a frame in contact against polygons, by part, and the paper's one figure")
    page.table(["polygons", *PARTS, "all of it", "display's part", "the paper, all of it"],
               *[[format(polygons, ","), *map(million, cost.values()), million(sum(cost.values())),
                  "%.0f %%" % (100 * cost["display"] / sum(cost.values())),
                  million(PAPER_TOTAL["head"]) if polygons == HEAD + 3034 else "in its figure only"]
                 for polygons, cost in costs.items()])
    page.text("Million instructions a frame, the mean of the frames in contact of a head that was put on each field; display is a picture of 512 x 512 pixels, all of"
              " it drawn. The paper",
              "gives one figure in words, 0.24 s for %d polygons, which is 3.84 million instructions at 16 million a second;"
              % sum(POLYGONS["head"]),
              "its text does not have the curves of its figure, and nothing was read off them. It says that \"the display time"
              " clearly is the largest component\".",
              "The same holds here, in software and without its graphics hardware.")


def figure8(page, figures, pictures):
    scenes = [scene for scene in POLYGONS if scene != "head"]
    save(side_by_side([pictures[scene][1][0] for scene in scenes]), "figure8.png")
    costs = {scene: parts_of(figures, scene) for scene in POLYGONS}
    page.text("## Figure 8: other scenes")
    page.picture("figure8.png", "Both scenes just before the first impact: " + " and ".join(TITLES[s] for s in scenes))
    rows = []
    for scene, cost in costs.items():
        total = sum(cost.values())
        rows.append(["%d + %d" % POLYGONS[scene], "%d + %d" % tuple(pictures[scene][0]["faces"]), "`%s`" % scene,
                     "%.2f s" % bench.PAPER[scene], million(PAPER_TOTAL[scene]), *map(million, cost.values()),
                     million(total), "%.2f" % (total / PAPER_TOTAL[scene])])
    page.table(["the paper's polygons", "ours", "`SCENE=`", "the paper's frame", "at 16 MIPS", *PARTS, "all of it",
                "of the paper's"], *rows)
    plot("figure8-bars.png", """
$rows << EOD
%s
EOD
set title "A frame in contact, drawn at 512 x 512"
set key outside right top Left reverse spacing 1.4
set xrange [-0.6:%f]
set yrange [0:*]
set style fill solid
set boxwidth 0.3
set xtics (%s)
set xlabel "polygons of both objects, in the paper"
set ylabel "million instructions a frame"
plot $rows using ($0-0.17):1 with boxes lc rgb "%s" title "the paper, all of it", \\
     $rows using ($0+0.17):($2+$3+$4) with boxes lc rgb "%s" title "display", \\
     $rows using ($0+0.17):($2+$3) with boxes lc rgb "%s" title "dynamics", \\
     $rows using ($0+0.17):2 with boxes lc rgb "%s" title "detection"
""" % ("\n".join(" ".join("%f" % (value / 1e6) for value in [PAPER_TOTAL[scene], *cost.values()])
                 for scene, cost in costs.items()), len(costs) - 0.4,
       ", ".join("'%d + %d' %d" % (*POLYGONS[scene], i) for i, scene in enumerate(costs)), RED,
       *[PARTS[part][1] for part in ("display", "dynamics", "detection")]))
    page.picture("figure8-bars.png", "Instructions of a frame: the paper's three scenes there and here")
    page.text("Million instructions a frame in contact. The paper's seconds are those of its machine with graphics hardware, 16 million"
              " instructions a second.")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    figures = bench.read_csv(bench.OUT)
    os.makedirs(OUT, exist_ok=True)
    pictures = {scene: photograph(sys.argv[1], scene) for scene in POLYGONS}
    page = Page()
    page.text("# The paper's figures 6, 7 and 8", "",
              "`make figures` counts, draws and writes this page. The paper's machine was an IRIS 4D/25 (MIPS R3000, 16 million"
              " instructions a",
              "second, graphics hardware); here a Cortex-M3 in QEMU steps and draws by itself, and its instructions are counted"
              " (`make bench`).")
    figure6(page, *pictures["head"])
    figure7(page, figures)
    figure8(page, figures, pictures)
    for path in (os.path.join(OUT, "index.md"), os.path.join(DOCS, "figures.md")):
        page.write(path)
        print(path)


if __name__ == "__main__":
    main()

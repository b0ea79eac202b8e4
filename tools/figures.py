#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The paper's figures 7 and 8 from out/bench.csv, by gnuplot: tools/figures.py FOLDER

Figure 7: what a frame in contact costs against the number of polygons, by stage. Figure 8: the
paper's three scenes, drawn, beside its machine. What was not measured is left out.
"""
import os
import subprocess
import sys

import bench

HEAD = 1876
FIELDS = [512, 3034, 12012, 49928]

# title, stages, colour
STAGES = [
    ("interference", ["interfere"], "#1b9e77"),
    ("collision test", ["boyse"], "#d95f02"),
    ("contact, impact, rest", ["contact", "impact", "rest"], "#7570b3"),
    ("the rest of the step", ["predict", "broad", "advance", "commit"], "#999999"),
    ("step, all stages", ["total"], "#000000"),
    ("drawing, 512 x 512", [bench.DISPLAY], "#e7298a"),
]
# The paper's way draws the same. Nearly all of its step is interference: that comes last, on top.
PAPER_STAGES = [("paper's way: " + title, names, colour)
                for title, names, colour in reversed(STAGES[:-1])]


STYLE = """
set terminal pngcairo size 1000,640 font "sans,11" background "#ffffff"
set border 3 lc rgb "#666666"
set tics nomirror
set grid ytics lc rgb "#dddddd" lt 1
set key outside right top Left reverse spacing 1.3
"""


def plot(path, text):
    """Draw one PNG."""
    script = STYLE + "set output '%s'\n%s" % (path, text)
    done = subprocess.run(["gnuplot"], input=script, text=True)
    if done.returncode:
        sys.exit("gnuplot: status %d" % done.returncode)
    print(path)


def series(figures, stages, suffix):
    """(polygons, instructions) of the fields that were measured."""
    for field in FIELDS:
        keys = [("growth-%d%s" % (field, suffix), "contact", stage) for stage in stages]
        if all(key in figures for key in keys):
            yield HEAD + field, sum(figures[key].mean for key in keys)


def figure7(figures, folder):
    blocks, plots = [], []
    for suffix, stages, style in [("", STAGES, "dt 1 pt 7"),
                                  ("-" + bench.PAPER_LABEL, PAPER_STAGES, "dt 2 pt 6")]:
        for title, names, colour in stages:
            points = list(series(figures, names, suffix))
            if points:
                blocks.append("$s%d << EOD\n%s\nEOD\n" % (
                    len(blocks), "\n".join("%d %d" % point for point in points)))
                plots.append("$s%d with linespoints lw %g ps 1 %s lc rgb '%s' title \"%s\"" % (
                    len(plots), 3 if names == ["total"] else 1.5, style, colour, title))
    if not plots:
        return
    for seconds, title, dash in [(bench.PAPER["head"], "the paper's 0.24 s at 16 MIPS", 1),
                                 (1 / 60, "1/60 s at 16 MIPS", 2)]:
        plots.append("%d with lines dt %d lw 1.5 lc rgb '#d00000' title \"%s\"" %
                     (seconds * bench.PAPER_RATE, dash, title))
    plot(os.path.join(folder, "figure7.png"), "".join(blocks) + """
set title "Cost of a frame in contact against the number of polygons"
set logscale xy
set xrange [2000:60000]
set format y "10^{%%T}"
set xtics (%s)
set xlabel "polygons of both objects"
set ylabel "instructions, Cortex-M3"
plot %s
""" % (", ".join("'%d' %d" % (HEAD + field, HEAD + field) for field in FIELDS), ", ".join(plots)))


def figure8(figures, folder):
    rows = [(scene, seconds * bench.PAPER_RATE / 1e6,
             figures[scene, "contact", "total"].mean / 1e6,
             figures[scene, "contact", bench.DISPLAY].mean / 1e6)
            for scene, seconds in bench.PAPER.items()
            if (scene, "contact", bench.DISPLAY) in figures]
    if not rows:
        return
    polygons = {"head": "1876 + 3034", "head450": "450 + 386", "head836": "836 + 512"}
    plot(os.path.join(folder, "figure8.png"), """
$rows << EOD
%s
EOD
set title "A frame of the paper's scenes, in contact and drawn at 512 x 512"
set xrange [-0.6:%f]
set yrange [0:*]
set style fill solid
set boxwidth 0.3
set xtics ()
set for [i=0:%d] xtics add (word("%s", i + 1) i)
set ylabel "million instructions"
set xlabel "polygons"
plot $rows using ($0-0.17):1 with boxes lc rgb "#d00000" title "the paper's, at 16 MIPS", \\
     $rows using ($0+0.17):($2+$3) with boxes lc rgb "#e7298a" title "drawing", \\
     $rows using ($0+0.17):2 with boxes lc rgb "#1b9e77" title "step"
""" % ("\n".join("%f %f %f" % row[1:] for row in rows), len(rows) - 0.4, len(rows) - 1,
       " ".join("'%s'" % polygons[row[0]] for row in rows)))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    figures = bench.read_csv(bench.OUT)
    if not figures:
        sys.exit("no %s: make bench" % bench.OUT)
    os.makedirs(sys.argv[1], exist_ok=True)
    figure7(figures, sys.argv[1])
    figure8(figures, sys.argv[1])


if __name__ == "__main__":
    main()

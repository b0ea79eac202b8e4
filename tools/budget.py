#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The worst frame of every scene of a board against the time that a frame has there.

A board's board.mk has its clock and SCENES := name:rate ...; run_board.budget() computes what a frame may take. A frame
costs its step and, where there is a display, its picture, by the board's own exact counter. out/budget.csv has a row a
scene; out/budget_stages.csv has the cost of each stage; out/budget_over.csv has every frame that takes too much, with its
costliest stage.

For a machine with a measured rate (MIPS, the paper's machine) the row shows frames in contact, as the paper does; the
worst frame is the worst of all frames.
"""
import argparse
import collections
import os
import sys

import results
import run_board


class Scene:
    """A scene that ran on a board: its frames, their cost, and their budget."""

    def __init__(self, board, name, rows, columns):
        self.board, self.name, self.rows = board, name, rows
        self.stages = columns[columns.index("faces") + 1:columns.index("over")]
        self.stages.remove("total")
        self.budget = run_board.budget(board, name)
        self.costs = [row["total"] + row["draw"] for row in rows]
        self.contact = [cost for row, cost in zip(rows, self.costs) if row["contacts"] or row["hits"]]
        of_contact = "MIPS" in run_board.settings(board)
        self.counted = self.contact if of_contact else self.costs
        self.worst = max(self.costs)
        self.ok = self.worst <= self.budget

    def over(self):
        """Frames over the budget: number, cost, costliest stage, cost of that stage."""
        for row, cost in zip(self.rows, self.costs):
            if cost > self.budget:
                stage = max(self.stages, key=lambda name: row[name])
                yield row["frame"], cost, stage, row[stage]

    def summary(self):
        """Phase, stage, frames, mean and worst; the stage "frame" is the sum of all stages."""
        in_contact = [row for row in self.rows if row["contacts"] or row["hits"]]
        for phase, rows in [("all", self.rows), ("contact", in_contact)]:
            for stage in [*self.stages, "frame"]:
                values = [row["total"] + row["draw"] if stage == "frame" else row[stage]
                          for row in rows]
                if values:
                    yield phase, stage, len(values), round(mean(values)), max(values)


def mean(values):
    return sum(values) / len(values) if values else 0


def measure(board, name, frames):
    image = os.path.join(run_board.ROOT, "build", board, "head.elf")
    result = run_board.run(image, ["scene=" + name, "frames=%d" % frames])
    if result.status or len(result.rows) != frames:
        sys.exit("%s: %s ended with status %d after %d frames\n%s" % (
            board, name, result.status, len(result.rows), result.text[-300:]))
    return Scene(board, name, result.rows, result.columns)


def print_row(scene):
    """A line of the table; for a scene over its budget also the stages that cause it."""
    print("%-16s %-10s %6d %10d %10d %10d %10d  %s" % (
        scene.board, scene.name, len(scene.counted), mean(scene.costs), mean(scene.contact),
        scene.worst, scene.budget, "ok" if scene.ok else "over"), flush=True)
    long = list(scene.over())
    if long:
        stages = collections.Counter(stage for _, _, stage, _ in long)
        number, _, stage, spent = max(long, key=lambda frame: frame[1])
        print("%27s %d frames are too long, most of it in %s; frame %d is the worst, %d in %s" % (
            "", len(long), ", ".join("%s (%d)" % pair for pair in stages.most_common()), number,
            spent, stage))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--keep", action="store_true", help="the rows of boards that do not run")
    parser.add_argument("boards", nargs="*")
    arguments = parser.parse_args()

    print("%-16s %-10s %6s %10s %10s %10s %10s" % ("a frame", "scene", "frames", "mean",
                                                   "in contact", "worst", "budget"))
    scenes = []
    for board in arguments.boards:
        for name in run_board.scenes(board):
            if run_board.budget(board, name):
                scenes.append(measure(board, name, arguments.frames))
                print_row(scenes[-1])
    measured = arguments.boards if arguments.keep else None
    results.write("out/budget.csv", "board,scene,frames,worst,budget,ok",
                  [[s.board, s.name, len(s.counted), s.worst, s.budget, int(s.ok)] for s in scenes],
                  measured)
    results.write("out/budget_stages.csv", "board,scene,phase,stage,frames,mean,worst",
                  [[s.board, s.name, *row] for s in scenes for row in s.summary()], measured)
    results.write("out/budget_over.csv", "board,scene,frame,cost,stage,instructions",
                  [[s.board, s.name, *row] for s in scenes for row in s.over()], measured)
    over = sum(not scene.ok for scene in scenes)
    print("%d scenes held, %d over" % (len(scenes) - over, over))
    return over > 0


if __name__ == "__main__":
    sys.exit(main())

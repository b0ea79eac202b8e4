#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Write the table of boards in README.md, between its two comments.

A board's board.mk and linker file describe the board; its figures come from the files that `make budget` and `make size`
leave in out/. A board that was not measured keeps its figures in the table. tools/check_boards checks only the first
part.
"""
import os

import claims
import marked
import results
import run_board
import size

README = os.path.join(run_board.ROOT, "README.md")
MARK = "boards"
COLUMNS = ["board", "processor", "ROM, RAM", "display", "scenes, frames a second",
           "a frame of the first, mean / worst", "code", "RAM used"]
STATIC = 5  # number of columns that need no run


def bytes_text(number):
    """A number of bytes for people: 128 KB, 16 MB."""
    for unit, name in [(1 << 20, "MB"), (1 << 10, "KB")]:
        if number >= unit:
            value = "%.1f" % (number / unit)
            return "%s %s" % (value.removesuffix(".0") if number < 100 * unit else
                              str(round(number / unit)), name)
    return "%d bytes" % number


def count_text(number):
    return "%.2f M" % (number / 1e6) if number >= 1e6 else "%.0f k" % (number / 1e3)


def static_cells(board):
    """The cells of a board that need no run."""
    its, places = run_board.settings(board), size.linker(board)
    clock = ", %s MHz" % its["CLOCK_MHZ"] if "CLOCK_MHZ" in its else \
        ", %s million a second" % its["MIPS"] if "MIPS" in its else ""
    scenes = ["%s %d" % pair if pair[1] else pair[0] for pair in run_board.scenes(board).items()]
    memory = ["%s" % bytes_text(places[name]) for name in ("ROM_SIZE", "RAM_SIZE") if places]
    return [board, its.get("CPU", "") + clock, ", ".join(memory) or "as it has",
            its.get("DISPLAY", "none"), ", ".join(scenes)]


def figures(board):
    """The cells of measured figures; None if the board was not measured."""
    def row(path, **wanted):
        return next((row for row in results.read(path)
                     if all(row[name] == value for name, value in wanted.items())), None)

    frame = row("out/budget_stages.csv", board=board, scene=next(iter(run_board.scenes(board))),
                phase="all", stage="frame")
    program, parts = row("out/size.csv", board=board), row("out/size_parts.csv", board=board)
    unit = " cycles" if "CYCLES" in run_board.settings(board) else ""
    return [
        frame and "%s / %s%s" % (count_text(int(frame["mean"])), count_text(int(frame["worst"])), unit),
        program and bytes_text(int(program["text"])),
        parts and (bytes_text(int(parts["ram"])) if parts["ram"] else ""),
    ]


def read_table():
    """The rows of README.md's table as cells, by board."""
    with open(README) as file:
        _, table, _ = marked.split(file.read(), MARK)
    rows = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in table.splitlines()]
    return {row[0]: row for row in rows[2:]}


def main():
    old = read_table()
    rows = []
    for board in run_board.boards():
        had = old.get(board, [""] * len(COLUMNS))[STATIC:]
        new = [had[i] if cell is None else cell for i, cell in enumerate(figures(board))]
        rows.append(static_cells(board) + new)
    lines = ["| " + " | ".join(row) + " |" for row in [COLUMNS, *rows]]
    lines.insert(1, "|---" * len(COLUMNS) + "|")
    marked.write(README, MARK, lines)
    claims.write()


if __name__ == "__main__":
    main()

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Code, data and stack of the program of `make run`, board by board.

out/size.csv has a row a board: the program's sections, and the deepest stack of the board's first scene, by painting.
out/size_parts.csv has: the engine's archive alone, the scene's world, and the ROM and RAM of the whole program, including the used
part of the stack.
"""
import argparse
import os
import re
import subprocess
import sys

import results
import run_board


def sections(path):
    """Name, type, address, bytes and flags of the sections of an ELF file, or of all in an archive."""
    said = subprocess.run(["readelf", "-SW", path], check=True, stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.DEVNULL).stdout
    for name, kind, address, size, flags in re.findall(
            r"^ *\[ *\d+\] (\S+) +(\w+) +([0-9a-f]+) [0-9a-f]+ ([0-9a-f]+) [0-9a-f]+ +(\w*) ", said,
            re.M):
        if "A" in flags and "T" not in flags:
            yield name, kind, int(address, 16), int(size, 16), flags


def kinds(path):
    """Bytes of text, rodata, data and bss, without the stack."""
    total = dict.fromkeys(["text", "rodata", "data", "bss"], 0)
    for name, kind, _, size, flags in sections(path):
        if name != ".stack":
            total["text" if "X" in flags else "rodata" if "W" not in flags else
                  "bss" if kind == "NOBITS" else "data"] += size
    return total


def memory(board, image, stack):
    """Bytes of ROM and RAM, for a bare board; RAM with an initial value counts in both."""
    places = linker(board)
    if not places:
        return "", ""
    low, high = places["RAM_START"], places["RAM_START"] + places["RAM_SIZE"]
    rom, ram = 0, stack
    for name, kind, address, size, flags in sections(image):
        if name != ".stack":
            rom += size if kind != "NOBITS" else 0
            ram += size if low <= address < high or "W" in flags else 0
    return rom, ram


def linker(board):
    """The five numbers of a board's linker file; nothing for a board without one."""
    path = os.path.join(run_board.ROOT, "linker", board + ".ld")
    if not os.path.exists(path):
        return {}
    unit = {"": 1, "K": 1 << 10, "M": 1 << 20}
    with open(path) as file:
        return {name: int(value, 0) * unit[suffix] for name, value, suffix in re.findall(
            r"^(\w+) = (0x[0-9a-fA-F]+|\d+)([KM]?);", file.read(), re.M)}


def measure(board, frames):
    """The rows of a board, without its name, in the order of the two files."""
    folder = os.path.join(run_board.ROOT, "build", board)
    image, scene = folder + "/head.elf", next(iter(run_board.scenes(board)))
    result = run_board.run(image, ["scene=" + scene, "frames=%d" % frames])
    if result.status or len(result.rows) != frames:
        sys.exit("%s: %s ended with status %d\n%s" % (board, scene, result.status,
                                                      result.text[-300:]))
    program, engine = kinds(image), kinds(folder + "/libcarom.a")
    stack, world = int(result.said.get("stack", 0)), int(result.said["world"])
    rom, ram = memory(board, image, stack)
    return ([*program.values(), stack or ""],
            [engine["text"], engine["rodata"], world, rom, ram])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--keep", action="store_true", help="the rows of boards that do not run")
    parser.add_argument("boards", nargs="*")
    arguments = parser.parse_args()

    print("%-16s %9s %9s %9s %9s %7s | %9s %7s | %9s %9s" % (
        "bytes", "text", "rodata", "data", "bss", "stack", "engine", "world", "ROM", "RAM"))
    rows = [[], []]
    for board in arguments.boards:
        program, parts = measure(board, arguments.frames)
        rows[0].append([board, *program])
        rows[1].append([board, *parts])
        print("%-16s %9d %9d %9d %9d %7s | %9d %7d | %9s %9s" % (
            board, *program, parts[0] + parts[1], *parts[2:]), flush=True)
    measured = arguments.boards if arguments.keep else None
    results.write("out/size.csv", "board,text,rodata,data,bss,stack", rows[0], measured)
    results.write("out/size_parts.csv", "board,engine_code,engine_rodata,world,rom,ram", rows[1],
                  measured)


if __name__ == "__main__":
    main()

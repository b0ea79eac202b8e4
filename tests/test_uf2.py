#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
The files that a Raspberry Pi Pico's boot ROM takes, against Microsoft's UF2 and the RP2040's datasheet: blocks,
check sum of the loader, vectors. tools/uf2.py and the runner refuse a damaged loader. TAP.
"""
import os
import shutil
import struct
import subprocess
import sys
import zlib

from lib.tap import board_cases

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILT = os.path.join(ROOT, "build", "pico", "head")
OUT = os.path.join(ROOT, "build", "tests", "uf2")
FLASH, FLASH_BYTES = 0x10000000, 2 << 20
RAM, RAM_BYTES = 0x20000000, 264 << 10
BLOCK = struct.Struct("<8I476sI")


def read(path):
    with open(path, "rb") as file:
        return file.read()


def mirrored(value, bits):
    return int(format(value, "0%db" % bits)[::-1], 2)


def check_sum(data):
    """zlib's check sum takes the bits of a byte from the low end, and is inverted."""
    crc = zlib.crc32(bytes(mirrored(byte, 8) for byte in data)) ^ 0xffffffff
    return mirrored(crc, 32)


def blocks_are_right(uf2, image):
    """Whether all blocks are there, in order, for this chip, and hold the image."""
    count = len(uf2) // BLOCK.size
    if len(uf2) % BLOCK.size or count * 256 < len(image):
        return False
    payloads = b""
    for number in range(count):
        *head, data, end = BLOCK.unpack_from(uf2, number * BLOCK.size)
        if head != [0x0a324655, 0x9e5d5157, 0x2000, FLASH + 256 * number, 256, number, count,
                    0xe48bff56] or end != 0x0ab16f30 or any(data[256:]):
            return False
        payloads += data[:256]
    return payloads[:len(image)] == image and not any(payloads[len(image):])


def starts(image):
    """Whether the vectors hold a stack in RAM and a Thumb function in flash."""
    stack, begin = struct.unpack_from("<2I", image, 256)
    return RAM < stack <= RAM + RAM_BYTES and stack % 8 == 0 and \
        begin % 2 == 1 and FLASH + 256 < begin < FLASH + len(image)


def damaged(place):
    """(whether the tool refuses an image with a changed bit, whether the runner refuses such a file)"""
    image, uf2 = bytearray(read(BUILT + ".bin")), bytearray(read(BUILT + ".uf2"))
    image[place] ^= 1
    uf2[32 + place] ^= 1
    for name, data in [("bad.bin", image), ("bad.uf2", uf2)]:
        with open(os.path.join(OUT, name), "wb") as file:
            file.write(data)
    tool = subprocess.run([os.path.join(ROOT, "tools", "uf2.py"), os.path.join(OUT, "bad.bin")],
                          stderr=subprocess.DEVNULL)
    runner = subprocess.run([os.path.join(ROOT, "tools", "pico", "run.mjs"),
                             os.path.join(OUT, "bad.elf"), "frames=1"], stderr=subprocess.PIPE)
    return tool.returncode != 0, runner.returncode != 0 and b"check sum" in runner.stderr


def cases():
    """(name, whether it holds)"""
    image, uf2 = read(BUILT + ".bin"), read(BUILT + ".uf2")
    yield "check_value", check_sum(b"123456789") == 0x0376e6e7  # of CRC-32/MPEG-2, as published
    yield "loader_check_sum", struct.unpack_from("<I", image, 252)[0] == check_sum(image[:252])
    yield "blocks", blocks_are_right(uf2, image)
    yield "fits", len(image) <= FLASH_BYTES
    yield "vectors", starts(image)
    yield "no_arguments", not any(image[0x140:0x240])
    for name, place in [("loader", 17), ("sum", 255)]:
        tool, runner = damaged(place)
        yield "tool_refuses_damaged_" + name, tool
        yield "runner_refuses_damaged_" + name, runner


def main():
    shutil.rmtree(OUT, ignore_errors=True)
    os.makedirs(OUT)
    return board_cases("uf2", "pico", BUILT + ".uf2", cases)


if __name__ == "__main__":
    sys.exit(main())

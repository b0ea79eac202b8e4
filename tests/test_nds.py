#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
The files for a Nintendo DS: places, sizes and check sum as GBATEK describes a cartridge's header; they hold the
program; and the front end writes arguments to the place where the program reads them. TAP.
"""
import os
import re
import shutil
import struct
import subprocess
import sys

from lib.tap import board_cases

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILT = os.path.join(ROOT, "build", "nds", "head")
TOOL = os.path.join(ROOT, "tools", "nds.py")
OUT = os.path.join(ROOT, "build", "tests", "nds")
MAIN, MAIN_LOADED = 0x02000000, 0x3bfe00  # main memory, and the part of it that a loader fills
SECOND, SECOND_LOADED = 0x037f8000, 0xfe00  # the second processor's own memory
SECURE = 0x4000  # a cartridge is encrypted from here to 0x8000
LOGO = slice(0xc0, 0x15e)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def check_sum(data):
    """
    The remainder of a division of polynomials. Each byte's bits come from the low end; the bits of the first
    two bytes are inverted; the remainder is read from the low end.
    """
    bits = [byte >> i & 1 for byte in data for i in range(8)] + [0] * 16
    bits[:16] = [1 - bit for bit in bits[:16]]
    for i in range(len(bits) - 16):
        if bits[i]:
            for power in (16, 15, 2, 0):
                bits[i + 16 - power] ^= 1
    return sum(bit << i for i, bit in enumerate(bits[-16:]))


def words(data, at, count):
    return struct.unpack_from("<%dI" % count, data, at)


def holds_program(cartridge, image):
    place, entry, address, size = words(cartridge, 0x20, 4)
    return 0x200 <= place < SECURE and entry == address == MAIN and len(image) <= size <= MAIN_LOADED and \
        cartridge[place:place + len(image)] == image


def second_sleeps(cartridge):
    """Its code as binutils disassemble it: interrupts off, then the BIOS's Halt, in a loop."""
    place, entry, address, size = words(cartridge, 0x30, 4)
    path = os.path.join(OUT, "second.bin")
    with open(path, "wb") as file:
        file.write(cartridge[place:place + 16])
    said = subprocess.run(["arm-none-eabi-objdump", "-D", "-b", "binary", "-m", "arm",
                           "--adjust-vma=%d" % address, path], stdout=subprocess.PIPE, text=True).stdout
    code = [" ".join(words_) for words_ in re.findall(r"^ *\w+:\t\w+ \t(\w+)\t([^\t;\n]*\w\]?)", said, re.M)]
    return entry == address and SECOND <= address < address + size <= SECOND + SECOND_LOADED and code == [
        "mov r0, #67108864", "str r0, [r0, #520]", "svc 0x00060000", "b 0x%x" % (address + 8)]


def fits(cartridge):
    """Whether the parts of the file follow each other, and the file fits the chip of the size in its header."""
    (first, _, _, first_size), (second, _, _, second_size) = words(cartridge, 0x20, 4), words(cartridge, 0x30, 4)
    used, header = words(cartridge, 0x80, 2)
    chip = (128 << 10) << cartridge[0x14]
    return header <= first and first + first_size <= second and second + second_size == used == len(cartridge) and \
        chip / 2 < used <= chip


def room():
    """The place in the cartridge at which the program looks for arguments."""
    said = subprocess.run(["arm-none-eabi-nm", BUILT + ".elf"], stdout=subprocess.PIPE, text=True).stdout
    return int(re.search(r"^(\w+) . room$", said, re.M)[1], 16) - MAIN + 0x200


def told_where():
    """The place at which the front end writes arguments."""
    source = read(os.path.join(ROOT, "tools", "retro_nds.c")).decode()
    return int(re.search(r"\.arguments_at = (\w+)", source)[1], 0)


def refuses(size):
    """Whether the tool refuses a program of so many bytes."""
    path = os.path.join(OUT, "large.bin")
    with open(path, "wb") as file:
        file.write(bytes(size))
    done = subprocess.run([TOOL, path], stderr=subprocess.DEVNULL)
    return done.returncode != 0 and not os.path.exists(path.replace(".bin", ".nds"))


def cases():
    """(name, whether it holds)"""
    image, cartridge = read(BUILT + ".bin"), read(BUILT + ".nds")
    yield "check_value", check_sum(b"123456789") == 0x4b37  # of CRC-16/MODBUS, as published
    yield "header_check_sum", struct.unpack_from("<H", cartridge, 0x15e)[0] == check_sum(cartridge[:0x15e])
    yield "program", holds_program(cartridge, image)
    yield "second_processor_sleeps", second_sleeps(cartridge)
    yield "parts_fit", fits(cartridge)
    yield "no_logo", not any(cartridge[LOGO][:-2])
    yield "no_arguments", not any(cartridge[room():room() + 256])
    yield "front_end_knows_the_room", told_where() == room()
    yield "tool_refuses_too_large", refuses(MAIN_LOADED + 1) and not refuses(MAIN_LOADED)


def main():
    shutil.rmtree(OUT, ignore_errors=True)
    os.makedirs(OUT)
    return board_cases("nds", "nds", BUILT + ".nds", cases)


if __name__ == "__main__":
    sys.exit(main())

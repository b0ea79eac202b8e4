#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Make a program for a PlayStation's loader from an image: tools/psx_exe.py IMAGE.bin

IMAGE.exe has a head of one sector, 2048 bytes, with the load address and the entry point, and then the image
in whole sectors. The image starts with its first instruction, at the lowest address above the BIOS's memory.
"""
import struct
import sys

SECTOR = 2048
START = 0x80010000  # linker/psx.ld
STACK = 0x801ffff0  # until the program sets its own


def main():
    if len(sys.argv) != 2 or not sys.argv[1].endswith(".bin"):
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        image = file.read()
    image += bytes(-len(image) % SECTOR)
    # entry point, global pointer, load address, bytes; the stack
    head = struct.pack("<8s8xIIII", b"PS-X EXE", START, 0, START, len(image)).ljust(0x30, b"\0")
    head = (head + struct.pack("<I", STACK)).ljust(SECTOR, b"\0")
    with open(sys.argv[1].removesuffix(".bin") + ".exe", "wb") as file:
        file.write(head + image)
    return 0


if __name__ == "__main__":
    sys.exit(main())

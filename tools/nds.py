#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Make a file that a Nintendo DS starts from a program: tools/nds.py IMAGE.bin

IMAGE.nds is a header of 512 bytes, the program for the first processor (ARM9) and one for the second (ARM7), which
sleeps. The program begins before 0x4000, where a cartridge has encrypted parts, so the file has no encrypted parts;
emulators and flash cards start it. The maker's logo and its check sum are left empty, because we may not distribute the
logo.
"""
import struct
import sys

HEADER, PAGE, MOST = 0x200, 512, 0x3bfe00  # bytes; MOST: the most that a loader brings to main
                                           # memory
ARM9, ARM7 = 0x02000000, 0x03800000  # load addresses and entry points
SLEEP = struct.pack("<4I",
                    0xe3a00301,  # mov r0, #0x04000000
                    0xe5800208,  # str r0, [r0, #0x208]: interrupts off
                    0xef060000,  # swi 0x060000: the BIOS waits for one
                    0xeafffffd)  # again, if an interrupt was pending



def crc16(data):
    """CRC-16 with the polynomial 0x8005 from the low end, starting with all ones."""
    crc = 0xffff
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xa001 if crc & 1 else 0)
    return crc


def padded(data):
    return data + bytes(-len(data) % PAGE)


def cartridge(program):
    """The whole file. Fields of the header by their addresses: GBATEK, "DS Cartridge Header"."""
    first, second = padded(program), padded(SLEEP)
    used = HEADER + len(first) + len(second)
    header = bytearray(HEADER)
    header[0x00:0x10] = b"CAROM".ljust(12, b"\0") + b"####"
    header[0x14] = max(0, (used - 1).bit_length() - 17)  # 128 KB times 2^n
    struct.pack_into("<4I", header, 0x20, HEADER, ARM9, ARM9, len(first))
    struct.pack_into("<4I", header, 0x30, HEADER + len(first), ARM7, ARM7, len(second))
    struct.pack_into("<2I", header, 0x60, 0x00586000, 0x001808f8)  # how the card is read
    struct.pack_into("<H", header, 0x6e, 0x051e)
    struct.pack_into("<2I", header, 0x80, used, HEADER)
    struct.pack_into("<H", header, 0x15e, crc16(header[:0x15e]))
    return bytes(header) + first + second


def main():
    if len(sys.argv) != 2 or not sys.argv[1].endswith(".bin"):
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        program = file.read()
    if len(program) > MOST:
        sys.exit("%s: %d bytes; a loader brings at most %d" % (sys.argv[1], len(program), MOST))
    with open(sys.argv[1].removesuffix(".bin") + ".nds", "wb") as file:
        file.write(cartridge(program))
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Make a file for a Raspberry Pi Pico's boot ROM from a flash image: tools/uf2.py IMAGE.bin

IMAGE.uf2 has a block of 512 bytes for each 256 of the image. The ROM runs the first 256 bytes only if the last four of them are
the check sum of the others. The tool refuses an image without that check sum, and writes nothing.
"""
import struct
import sys

FLASH = 0x10000000
PAYLOAD, ROOM = 256, 476  # used bytes of a block, and its room
MAGIC = 0x0a324655, 0x9e5d5157, 0x0ab16f30  # two before the data, one behind
HAS_FAMILY, RP2040 = 0x2000, 0xe48bff56
LOADER = 252


def crc32(data):
    """The check sum of the RP2040's datasheet (2.8.1.3.1): not reflected, starts with all ones, not inverted."""
    crc = 0xffffffff
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04c11db7 if crc >> 31 else 0)) & 0xffffffff
    return crc


def blocks(image):
    """The blocks of an image, from the start of the flash."""
    count = -(-len(image) // PAYLOAD)
    for number in range(count):
        payload = image[number * PAYLOAD:(number + 1) * PAYLOAD].ljust(ROOM, b"\0")
        yield struct.pack("<8I", *MAGIC[:2], HAS_FAMILY, FLASH + number * PAYLOAD, PAYLOAD, number,
                          count, RP2040) + payload + struct.pack("<I", MAGIC[2])


def main():
    if len(sys.argv) != 2 or not sys.argv[1].endswith(".bin"):
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        image = file.read()
    said, = struct.unpack_from("<I", image, LOADER)
    found = crc32(image[:LOADER])
    if said != found:
        sys.exit("%s: the loader's check sum is 0x%08x, and 0x%08x stands there" % (
            sys.argv[1], found, said))
    with open(sys.argv[1].removesuffix(".bin") + ".uf2", "wb") as file:
        file.writelines(blocks(image))
    return 0


if __name__ == "__main__":
    sys.exit(main())

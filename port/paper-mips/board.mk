# SPDX-License-Identifier: MIT
# The processor of the paper's machine, an R3000 (MIPS I, big-endian), in QEMU's user mode. The machine took 0.24 s for 3.84
# million instructions; a 60 Hz frame of it is 267,000.
CPU := R3000, big-endian
DISPLAY := none
MIPS := 16.02
SCENES := head:60
FAMILY := linux
CROSS := mips-linux-gnu-
ARCH := -march=r3000 -mfp32
QEMU_USER := qemu-mips
NEED := mips-linux-gnu qemu-user
PICTURES := 0

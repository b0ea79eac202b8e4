# SPDX-License-Identifier: MIT
# The paper's machine with an ARM9 in place of its processor, in QEMU's user mode (see port/paper-mips).
CPU := ARM926EJ-S
DISPLAY := none
MIPS := 16.02
SCENES := head:60
FAMILY := linux
CROSS := arm-linux-gnueabi-
ARCH := -march=armv5te -marm
QEMU_USER := qemu-arm
NEED := arm-linux-gnueabi qemu-user
PICTURES := 0

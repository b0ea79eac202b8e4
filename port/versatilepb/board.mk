# SPDX-License-Identifier: MIT
# ARM Versatile/PB in QEMU: ARM926EJ-S at 210 MHz, PL110 LCD.
FAMILY := arm
ARCH := -mcpu=arm926ej-s -marm
PORT := port/versatilepb/versatile.c port/arm/classic.S
QEMU := qemu-system-arm -M versatilepb -audiodev none,id=none -global pl041.audiodev=none
ICOUNT_SHIFT := 10
# Half of a frame at 30 frames a second, the other half being the program's own.
BUDGET := 3500000
PICTURES := 1

# SPDX-License-Identifier: MIT
# ARM Versatile/PB in QEMU: ARM926EJ-S at 210 MHz, PL110 LCD.
FAMILY := arm
ARCH := -mcpu=arm926ej-s -marm
PORT := port/versatilepb/versatile.c port/arm/classic.S
QEMU := qemu-system-arm -M versatilepb -audiodev none,id=none -global pl041.audiodev=none
ICOUNT_SHIFT := 10
CPU := ARM926EJ-S
CLOCK_MHZ := 210
DISPLAY := LCD 512 x 512
SCENES := head:30 head450:30 sheet:20 pile:2 box:30 car:1 walker:14 door:15 crusher:3 conveyor:15 espresso:20 gears:1 screw:3 newton:6 dominoes:2 cards:1 arch:2 bowl:4 pour:1 espresso-fine:25
PICTURES := 1

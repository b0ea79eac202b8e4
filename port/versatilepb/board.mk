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
SCENES := head:35 head450:60 head836:57 sheet:41 pile:8 box:60 car:1 walker:47 lockstep door:42 crusher:3 conveyor:18 gears:5 screw:4 newton:14 dominoes:3 cards:1 arch:2 bowl:9 pour:1 espresso:48 espresso-fine:41
PICTURES := 1

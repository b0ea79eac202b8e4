# SPDX-License-Identifier: MIT
# Raspberry Pi Zero in QEMU: ARM1176 at 1 GHz, HDMI. On an SD card head.bin is called kernel.img.
FAMILY := arm
ARCH := -mcpu=arm1176jz-s -marm -mno-unaligned-access
PORT := port/raspi0/raspi0.c port/raspi0/memory.c port/raspi0/start.S
IMAGE_SUFFIX := .bin
QEMU := qemu-system-arm -M raspi0
# An instruction takes 1024 ns, the smallest power of two above a tick of the timer, 1000 ns.
ICOUNT_SHIFT := 10
CPU := ARM1176JZF-S
CLOCK_MHZ := 1000
DISPLAY := HDMI 512 x 512
SCENES := head:60 head450:60 head836:60 sheet:60 pile:40 box:60 car:6 walker:60 lockstep door:60 chain:2 crusher:18 conveyor:60 gears:24 screw:21 newton:60 dominoes:17 cards:9 arch:13 bowl:46 pour:6 espresso:60 espresso-fine:60
PICTURES := 1
SUITE_IMAGES := 1

# SPDX-License-Identifier: MIT
# Raspberry Pi Zero in QEMU: ARM1176 at 1 GHz, HDMI. On an SD card head.bin is called kernel.img.
FAMILY := arm
ARCH := -mcpu=arm1176jz-s -marm -mno-unaligned-access
PORT := port/raspi0/raspi0.c port/raspi0/memory.c port/raspi0/start.S
IMAGE_SUFFIX := .bin
QEMU := qemu-system-arm -M raspi0
# A tick of the timer, 1000 ns, is the longest that is shorter than an instruction.
ICOUNT_SHIFT := 10
CPU := ARM1176JZF-S
CLOCK_MHZ := 1000
DISPLAY := HDMI 512 x 512
SCENES := head:30 head450:30 sheet:20 pile:2 box:30 car:1 walker:15 door:15 chain:1 crusher:3 conveyor:15
PICTURES := 1

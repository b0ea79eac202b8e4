# SPDX-License-Identifier: MIT
# ARM MPS2 with application note 385, in QEMU: Cortex-M3 at 25 MHz, headless.
FAMILY := arm
ARCH := -mcpu=cortex-m3 -mthumb
PORT := port/mps2/mps2.c port/bare/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M mps2-an385
ICOUNT_SHIFT := 10
# Unrolled loops, for scene head at 15 frames a second. `make bench` counts at -O2.
OPT := -O2 -funroll-loops
CPU := Cortex-M3
CLOCK_MHZ := 25
DISPLAY := none; frames by semihosting
SCENES := head:13 head450:20 head836:22 sheet:16 pile:1 box:49 car walker:60 lockstep door:8 chain crusher conveyor:4 gears:1 screw newton:3 dominoes cards arch bowl:2 pour espresso:32 espresso-fine:27
PICTURES := 0
SUITE_IMAGES := 1

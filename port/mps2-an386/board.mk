# SPDX-License-Identifier: MIT
# ARM MPS2 with application note 386, in QEMU: Cortex-M4 at 25 MHz, headless.
CPU := Cortex-M4
DISPLAY := none; frames by semihosting
CLOCK_MHZ := 25
SCENES := head:13 head450:20 head836:23 sheet:16 pile:1 box:49 car walker:60 lockstep door:9 chain crusher conveyor:4 gears:1 screw newton:3 dominoes cards arch bowl:2 pour espresso:32 espresso-fine:27
FAMILY := arm
ARCH := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
PORT := port/mps2/mps2.c port/bare/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M mps2-an386
ICOUNT_SHIFT := 10
# Unrolled loops, for scene head at 15 frames a second.
OPT := -O2 -funroll-loops
PICTURES := 0

# SPDX-License-Identifier: MIT
# ARM MPS2 with application note 500, in QEMU: Cortex-M7 at 25 MHz, headless.
CPU := Cortex-M7
DISPLAY := none; frames by semihosting
CLOCK_MHZ := 25
SCENES := head:13 head450:19 head836:23 sheet:16 pile:1 box:50 car walker:60 lockstep door:9 chain crusher conveyor:4 gears:1 screw newton:3 dominoes cards arch bowl:2 pour espresso:31 espresso-fine:27
FAMILY := arm
ARCH := -mcpu=cortex-m7 -mthumb -mfloat-abi=soft
PORT := port/mps2/mps2.c port/bare/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M mps2-an500
ICOUNT_SHIFT := 10
# For scene head at 15 frames a second.
OPT := -O3 -funroll-loops
PICTURES := 0

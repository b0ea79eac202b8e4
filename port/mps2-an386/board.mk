# SPDX-License-Identifier: MIT
# ARM MPS2 with application note 386, in QEMU: Cortex-M4 at 25 MHz, headless.
CPU := Cortex-M4
DISPLAY := none; frames by semihosting
CLOCK_MHZ := 25
SCENES := head:13 head836:15 head450:20 walker:60 door:8 conveyor:4 espresso:30
FAMILY := arm
ARCH := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
PORT := port/mps2/mps2.c port/bare/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M mps2-an386
ICOUNT_SHIFT := 10
# Unrolled loops, for scene head at 15 frames a second.
OPT := -O2 -funroll-loops
PICTURES := 0

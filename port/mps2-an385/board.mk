# SPDX-License-Identifier: MIT
# ARM MPS2 with application note 385, in QEMU: Cortex-M3 at 25 MHz, headless.
FAMILY := arm
ARCH := -mcpu=cortex-m3 -mthumb
PORT := port/mps2/mps2.c port/arm/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M mps2-an385
ICOUNT_SHIFT := 10
# Half of a frame at 15 frames a second, the other half being the program's own.
BUDGET := 833000
PICTURES := 0

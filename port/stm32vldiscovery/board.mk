# SPDX-License-Identifier: MIT
# STM32VLDISCOVERY in QEMU: STM32F100, Cortex-M3 at 24 MHz, headless.
CPU := Cortex-M3
DISPLAY := none
CLOCK_MHZ := 24
SCENES := brick:30
FAMILY := arm
ARCH := -mcpu=cortex-m3 -mthumb
# at -O2 the program does not fit 128 KB
OPT := -Os
PORT := port/arm/headless.c port/arm/systick.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M stm32vldiscovery
# SysTick's 24 bits are 5.4 million instructions.
ICOUNT_SHIFT := 7
ROM_SCENES := brick
CAPS := 2,1,4,6,0,6
DRAW_BYTES := 0
LINE_BYTES := 64
PICTURES := 0
SUITES := port num_fix num_arena mesh_scan mesh_zlist mesh_mass
SUITE_IMAGES := 1
# The program of the matrix is too large; make test BOARD=stm32vldiscovery compares the hash of the scene in place
# of it.
MATRIX := 0

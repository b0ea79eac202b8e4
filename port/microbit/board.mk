# SPDX-License-Identifier: MIT
# BBC micro:bit in QEMU: nRF51822, Cortex-M0 at 16 MHz, headless.
CPU := Cortex-M0
DISPLAY := none
CLOCK_MHZ := 16
SCENES := boxes3:6
FAMILY := arm
ARCH := -mcpu=cortex-m0 -mthumb
PORT := port/arm/headless.c port/arm/systick.c port/arm/cortex_m.c port/arm/multiply_v6m.S port/bare/divide.c
QEMU := qemu-system-arm -M microbit
# SysTick's 24 bits are 4 million instructions.
ICOUNT_SHIFT := 8
ROM_SCENES := boxes3
CAPS := 4,3,10,32,0,24
DRAW_BYTES := 0
LINE_BYTES := 96
PICTURES := 0
SUITES := port num_fix num_arena num_gauss num_gauss_cost mesh_scan mesh_zlist mesh_mass solve_impact
SUITE_IMAGES := 1
# With -O2 the matrix's program is larger than the ROM.
MATRIX_OPT := -Os

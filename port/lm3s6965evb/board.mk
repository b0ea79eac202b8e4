# SPDX-License-Identifier: MIT
# Luminary LM3S6965 evaluation board in QEMU: Cortex-M3 at 50 MHz, OLED.
CPU := Cortex-M3
DISPLAY := OLED 128 x 64, 16 greys
CLOCK_MHZ := 50
SCENES := head100:59
FAMILY := arm
ARCH := -mcpu=cortex-m3 -mthumb
OPT := -O2
PORT := port/lm3s6965evb/lm3s.c port/arm/systick.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M lm3s6965evb
# SysTick's 24 bits are 2.6 million instructions.
ICOUNT_SHIFT := 7
ROM_SCENES := head100
CAPS := 2,1,16,64,1,64
DRAW_BYTES := 16384
PICTURES := 1
SUITES := port num_fix num_arena num_gauss num_gauss_cost mesh_scan mesh_zlist mesh_mass mesh_blob solve_impact
SUITE_IMAGES := 1

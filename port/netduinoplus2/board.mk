# SPDX-License-Identifier: MIT
# Netduino Plus 2 in QEMU: STM32F405, Cortex-M4 at 168 MHz, headless.
CPU := Cortex-M4
DISPLAY := none; frames by semihosting
CLOCK_MHZ := 168
SCENES := head:60 head450:60 box:60 door:43 crusher:3 newton:13 bowl:9
FAMILY := arm
ARCH := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
# Room for more scenes.
OPT := -Os
PORT := port/netduinoplus2/netduino.c port/bare/picture.c port/arm/cortex_m.c
QEMU := qemu-system-arm -M netduinoplus2
# The counter runs at 1 GHz: one tick is one instruction.
ICOUNT_SHIFT := 0
ROM_SCENES := head head450 box door crusher newton bowl
CAPS := 2,1,16,128,1,128
GAME_CAPS := 20,32,64,192,0,512
# With pictures only, which are drawn in parts.
DRAW_BYTES := 20480
PICTURES := 0
SUITES := port num_fix num_arena num_gauss num_gauss_cost mesh_scan mesh_zlist mesh_mass mesh_blob solve_impact world_cost world_idle world_step draw_rays
SUITE_IMAGES := 1

# SPDX-License-Identifier: MIT
# Game Boy Advance in mGBA: ARM7TDMI, 240 x 160. The .gba files are what an emulator plays.
CROSS := arm-none-eabi-
NEED := arm newlib cc libc mgba
# no scheduling: a load takes the same time anywhere, and fewer registers are spilled; no unrolled loops: the functions of
# fast.ld must fit the RAM
ARCH := -mcpu=arm7tdmi -marm -mthumb-interwork -fno-schedule-insns -fno-schedule-insns2 -DFIX_UNROLL=
PORT := port/gba/gba.c port/gba/memory.c port/gba/start.S port/bare/arguments.c port/newlib/syscalls.c port/bare/start.c
FAMILY_LDFLAGS := --specs=nano.specs -Wl,--wrap=carom_draw_changes
IMAGE_SUFFIX := .gba
RUNNER := build/tools/retro_run
CPU := ARM7TDMI
CLOCK_MHZ := 16.78
CYCLES := 1
DISPLAY := LCD 240 x 160
SCENES := head48:12 head450:3
ROM_SCENES := head48 head450
CAPS := 2,1,32,256,0,256
DRAW_BYTES := 12800
PICTURES := 1
SUITES := port num_fix num_arena num_gauss num_gauss_cost mesh_scan mesh_zlist mesh_mass mesh_blob solve_impact
SUITE_IMAGES := 1

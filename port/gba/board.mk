# SPDX-License-Identifier: MIT
# Game Boy Advance in mGBA: ARM7TDMI at 16.78 MHz, 240 x 160. The .gba files are what an emulator plays.
CROSS := arm-none-eabi-
NEED := arm newlib mgba
ARCH := -mcpu=arm7tdmi -marm -mthumb-interwork -Iport/arm
PORT := port/gba/gba.c port/gba/start.S port/newlib/syscalls.c port/arm/start.c
FAMILY_LDFLAGS := --specs=nano.specs
IMAGE_SUFFIX := .gba
RUNNER := build/tools/gba_run
ROM_SCENES := head450
CAPS := 2,1,32,256,0,256
DRAW_BYTES := 26000
UNIT := cycles
# A frame at 15 frames a second, drawing included.
BUDGET := 1118000
PICTURES := 1

# SPDX-License-Identifier: MIT
# Nintendo DS in DeSmuME: ARM946E-S, 256 x 192. The .nds files are what an emulator or a flash card plays.
CROSS := arm-none-eabi-
NEED := arm newlib cc libc desmume
ARCH := -mcpu=arm946e-s -marm
PORT := port/nds/nds.c port/nds/start.S port/bare/arguments.c port/newlib/syscalls.c port/bare/start.c
FAMILY_LDFLAGS := --specs=nano.specs
IMAGE_SUFFIX := .bin
IMAGE_TOOL := tools/nds.py
RUNNER := build/tools/retro_run
CPU := ARM946E-S
CLOCK_MHZ := 67.03
CYCLES := 1
DISPLAY := LCD 256 x 192
SCENES := head:8 head450:20 head836:16 pile:1 box:52 walker:25 door:14 crusher:1 conveyor:6 newton:4 cards arch bowl:3 espresso:19 espresso-fine:14
ROM_SCENES := head head836 head450 pile box walker door conveyor crusher newton cards arch bowl espresso espresso-fine
GAME_CAPS := 18,80,192,512,0,1024,5,4
PICTURES := 1
# some tests use scenes that the board lacks, one uses larger worlds
SUITES := $(filter-out scene_models draw_rows scene_games scene_lockstep query_recall,$(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c)))
SUITE_IMAGES := 1

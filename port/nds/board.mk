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
SCENES := head:9 head836:9 head450:9 pile:1 box:9 car:1 walker:4 door:4 chain:1 crusher:2 conveyor:4
ROM_SCENES := head head836 head450 pile box car walker door chain crusher conveyor
GAME_CAPS := 24,64,128,512,0,1024,8,0
PICTURES := 1
# models are of meshes that its scenes have indexed; recall has larger worlds
SUITES := $(filter-out models recall,$(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c)))
SUITE_IMAGES := 1

# SPDX-License-Identifier: MIT
# PlayStation in pcsxr: R3000A, 320 x 240. The .exe files are what an emulator plays.
CROSS := mipsel-linux-gnu-
NEED := mipsel-linux-gnu cc libc python3 pcsxr
# leaves out code for Linux; no number here is floating-point
ARCH := -march=r3000 -mfp32 -mno-abicalls -fno-pic -G0
FAMILY_CFLAGS := -ffreestanding -Iport/nolibc
FAMILY_LDFLAGS := -nostdlib -static -Wl,--build-id=none
PORT := port/psx/psx.c port/psx/gpu.c port/psx/pad.c port/psx/divide.c port/psx/start.S port/bare/arguments.c \
    port/bare/start.c port/bare/divide.c port/nolibc/string.c
IMAGE_SUFFIX := .bin
IMAGE_TOOL := tools/psx_exe.py
RUNNER := build/tools/psx_run
CPU := R3000A
CLOCK_MHZ := 33.87
CYCLES := 1
# Room for more scenes; what takes most of the time is faster.
OPT := -Os
$(foreach part,num interfere boyse draw,build/psx/src/$(part)/%.o): private CFLAGS += -O2
DISPLAY := television 320 x 240
SCENES := head:3 head450:6 box:19 walker:7 door:4 crusher conveyor:1 newton:1 cards arch bowl espresso:6
ROM_SCENES := head head450 box walker door chain crusher conveyor newton dominoes cards arch bowl espresso
CAPS := 2,1,64,1024,256,1024
GAME_CAPS := 42,128,224,512,0,1024
PICTURES := 1
# the suites that need no floating point, because the processor has none
SUITES := port world_ask draw_debug draw draw_paint draw_picture draw_text world_filter world_identity mesh_blob world_overlap draw_pick mesh_scan scene \
    world_sensor mesh_surface world_idle world_query world_range world_snapshot mesh_zlist
SUITE_IMAGES := 1

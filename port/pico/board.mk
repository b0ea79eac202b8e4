# SPDX-License-Identifier: MIT
# Raspberry Pi Pico with a Pico-LCD-1.3, in rp2040js: Cortex-M0+, 240 x 240. The .uf2 files are what the Pico's own loader takes.
CPU := Cortex-M0+
CLOCK_MHZ := 125
CYCLES := 1
DISPLAY := LCD 240 x 240, by rows
SCENES := head450:29 boxes3:60
CROSS := arm-none-eabi-
NEED := arm newlib python3 node npm npm:tools/pico
ARCH := -mcpu=cortex-m0plus -mthumb
PORT := port/pico/pico.c port/pico/lcd.c port/pico/start.c port/pico/boot.S port/arm/cortex_m.c \
    port/bare/arguments.c port/bare/start.c port/arm/systick.c port/arm/multiply_v6m.S \
    port/bare/divide.c port/arm/copy_v6m.S port/pico/quotient.S port/newlib/syscalls.c
FAMILY_LDFLAGS := --specs=nano.specs
IMAGE_SUFFIX := .bin
IMAGE_TOOL := tools/uf2.py
RUNNER := tools/pico/run.mjs
ROM_SCENES := head450 boxes3
CAPS := 4,3,16,128,1,256
DRAW_BYTES := 19264
PICTURES := 1
SUITES := port num_fix num_arena num_gauss mesh_scan mesh_zlist mesh_mass mesh_blob body solve_impact draw_picture draw_rays
SUITE_IMAGES := 1

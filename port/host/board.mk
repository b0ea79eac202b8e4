# SPDX-License-Identifier: MIT
# The machine that compiles: Linux, a framebuffer in memory, pictures by libpng.
PORT := port/host/host.c port/linux/console.c
LIBS := -lpng -lm
CPU := of the machine that compiles
DISPLAY := memory 512 x 512
SCENES := head pile sheet box car walker lockstep door chain crusher conveyor gears screw newton dominoes cards arch bowl pour espresso espresso-fine
PICTURES := 1
SHADOWS := 1
SMOOTH := 1

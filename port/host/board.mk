# SPDX-License-Identifier: MIT
# The machine that compiles: Linux, a framebuffer in memory, pictures by libpng.
PORT := port/host/host.c port/linux/console.c
LIBS := -lpng -lm
PICTURES := 1

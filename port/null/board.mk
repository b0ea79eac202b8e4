# SPDX-License-Identifier: MIT
# A board that compiles everywhere and does nothing. A bare board also has linker/BOARD.ld.
PORT := port/null/null.c

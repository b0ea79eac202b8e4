# SPDX-License-Identifier: MIT
# Compiles everywhere, does nothing. A board that runs bare also has linker/BOARD.ld.
PORT := port/null/null.c

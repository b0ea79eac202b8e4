#!/bin/sh
# SPDX-License-Identifier: MIT
# The commands of README.md and docs/board.md do what they promise, in a clean clone: the program, a mesh of one's own, a board
# begun, its picture, its budget; prints TAP.
exec "$(dirname "$0")/../tools/five_minutes" --short

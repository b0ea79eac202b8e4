#!/bin/sh
# SPDX-License-Identifier: MIT
# README.md's commands do what they promise, in a clean clone: the program, a mesh of one's own, a board begun; prints TAP.
exec "$(dirname "$0")/../tools/five_minutes" --short

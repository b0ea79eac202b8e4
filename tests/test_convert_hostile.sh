#!/bin/sh
# SPDX-License-Identifier: MIT
# The mesh converter on hostile files: each ends in a named error or a right mesh. Prints TAP.
cd "$(dirname "$0")/.." || exit 1
said=$(tools/hostile_meshes.py build/tools/carom-mesh --first 1001 --count 150)
status=$?
echo "$said" | sed 's/^/# /'
[ "$status" -eq 0 ] || printf 'not '
echo "ok 1 - convert_hostile/files"
echo 1..1

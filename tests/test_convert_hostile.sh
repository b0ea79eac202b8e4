#!/bin/sh
# SPDX-License-Identifier: MIT
# The mesh converter on hostile files: each ends in a named error or a right mesh. Prints TAP.
cd "$(dirname "$0")/.." || exit 1
mkdir -p build/tests
if tools/hostile_meshes.py build/tools/carom-mesh --first 1001 --count 150 | sed 's/^/# /' | tee build/tests/hostile | grep -q ' 0 wrong$'; then
    echo "ok 1 - convert_hostile/files"
else
    cat build/tests/hostile
    echo "not ok 1 - convert_hostile/files"
fi
echo 1..1

#!/bin/sh
# SPDX-License-Identifier: MIT
# The drawings and tables of docs/z-lists.md are those of a step; prints TAP.

cd "$(dirname "$0")/.." || exit 1
if said=$(tools/zlists.py build/host/zlists.elf --check); then
    echo "ok 1 - zlists/page"
    status=0
else
    echo "not ok 1 - zlists/page"
    echo "$said" | sed 's/^/# /'
    status=1
fi
echo "1..1"
exit "$status"

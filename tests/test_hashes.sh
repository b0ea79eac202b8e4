#!/bin/sh
# SPDX-License-Identifier: MIT
# The same state hashes from every compiler, option and board: builds host_hashes.c with the engine
# in many ways, runs it and compares all its hashes with those of the first build. Prints TAP.

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MAKELEVEL MFLAGS

includes='-Iinclude -Isrc -Iport -Iexamples -Itests'
# nothing is drawn
engine=$(ls src/*.c | grep -v '^src/draw')
others='examples/scene.c examples/scene_sheet.c build/gen/*_mesh.c tests/host_hashes.c
        tests/lab.c tests/oracle.c port/host/host.c port/option.c port/print.c port/assert.c'

# hashes NAME COMMAND...: run a program, keep its hashes; fails when it fails
hashes()
{
    name=$1
    shift
    "$@" >"$work/$name.out" 2>"$work/$name.err" </dev/null && [ ! -s "$work/$name.err" ] &&
        grep '^# hash' "$work/$name.out" >"$work/$name.hashes"
}

# host NAME COMPILER OPTION...: build with the engine compiled so, and run
host()
{
    name=$1 compiler=$2
    shift 2
    if ! command -v "$compiler" >/dev/null; then
        echo "$compiler is not there" >"$work/$name.err"
        return
    fi
    # shellcheck disable=SC2086
    "$compiler" -std=c11 $includes "$@" -w -o "$work/$name" $engine "$work"/others/*.o -lpng -lm \
        2>"$work/$name.err" && hashes "$name" "$work/$name"
}

# board BOARD: the image that make builds, under QEMU
board()
{
    make -s BOARD="$1" "build/$1/host_hashes.elf" >/dev/null 2>"$work/$1.err" &&
        hashes "$1" timeout 120 tools/run_board.py "build/$1/host_hashes.elf"
}

# report NAME: compare with the first
tests=0
report()
{
    tests=$((tests + 1))
    if [ -s "$work/$1.hashes" ] && cmp -s "$work/$1.hashes" "$work/gcc_O2.hashes"; then
        echo "ok $tests - hashes/$1 ($(wc -l <"$work/$1.hashes") hashes)"
        return
    fi
    echo "not ok $tests - hashes/$1"
    if [ -s "$work/$1.hashes" ]; then
        diff "$work/gcc_O2.hashes" "$work/$1.hashes" | head -n 4 | sed 's/^/# /'
    fi
    head -n 8 "$work/$1.err" | sed 's/^/# /'
}

# What is not the engine is compiled once.
mkdir "$work/others"
for file in $others; do
    # shellcheck disable=SC2086
    gcc -std=c11 -O2 $includes -c -o "$work/others/$(basename "$file" .c).o" "$file" || exit 1
done

sanitize='-fsanitize=address,undefined -fno-sanitize-recover=all -DCAROM_DEBUG'
(
    host gcc_O2 gcc -O2
    host gcc_O3_wrapv gcc -O3 -fwrapv
    host clang_O0 clang -O0
    host clang_O2 clang -O2
    board versatilepb
) &
(
    host gcc_O0 gcc -O0
    host gcc_Os_unsigned_char gcc -Os -funsigned-char
    # shellcheck disable=SC2086
    host gcc_sanitized gcc -O1 $sanitize
    board mps2-an385
) &
wait

for name in gcc_O0 gcc_O2 gcc_O3_wrapv gcc_Os_unsigned_char gcc_sanitized clang_O0 clang_O2 \
    mps2-an385 versatilepb; do
    report "$name"
done
echo "1..$tests"

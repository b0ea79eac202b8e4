#!/bin/sh
# SPDX-License-Identifier: MIT
# A fiftieth of the cases of `make accuracy`, held to the same bars. Prints TAP, a line for each
# kernel: tests/test_accuracy.sh

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

tests=0
for source in tests/accuracy_*.c; do
    program=build/host/$(basename "$source" .c).elf
    "$program" share=50 >"$work/rows" 2>"$work/missed" </dev/null
    status=$?
    while IFS=, read -r kernel cases _ _ _ max failures _; do
        tests=$((tests + 1))
        if grep -q "^$kernel:" "$work/missed"; then
            echo "not ok $tests - accuracy/$kernel"
            sed -n "s/^$kernel:/# $kernel:/p" "$work/missed"
        else
            echo "ok $tests - accuracy/$kernel ($cases cases, max $max, $failures failures)"
        fi
    done <"$work/rows"
    # the program ended early
    if [ ! -s "$work/rows" ] || [ "$status" -gt 1 ]; then
        tests=$((tests + 1))
        echo "not ok $tests - accuracy/$(basename "$source" .c) (exit status $status)"
        sed 's/^/# /' "$work/missed"
    fi
done
echo "1..$tests"

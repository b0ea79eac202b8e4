#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/figures.c finds the hit that a run of the scene has, with the faces of that frame, and colours them; prints TAP.

cd "$(dirname "$0")/.." || exit 1
work=build/tests/figures
mkdir -p "$work" || exit 1
tests=0
failed=0

# report STATUS NAME FILE: one line of TAP; after a failure, the file
report()
{
    tests=$((tests + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tests - figures/$2"
    else
        failed=$((failed + 1))
        echo "not ok $tests - figures/$2"
        sed 's/^/# /' "$3"
    fi
}

# The first frame with a hit, and its faces, from the columns of a run.
hit_of_run()
{
    build/host/head.elf "scene=$1" frames=60 | awk '
        $1 == "columns" { n = split($2, name, ","); for (i = 1; i <= n; i++) at[name[i]] = i }
        $1 == "frame" { split($2, cell, ","); if (cell[at["hits"]] > 0) { print cell[1], cell[at["faces"]]; exit } }'
}

for scene in head head836; do
    build/host/figures.elf "scene=$scene" "pictures=$work" >"$work/said"
    report $? "$scene/runs" "$work/said"
    hit_of_run "$scene" >"$work/run"
    awk '$1 == "first" { first = $2 } $1 == "interfering" { print first, $2 + $3 }' "$work/said" | diff "$work/run" - >"$work/difference"
    report $? "$scene/the_hit_of_the_run" "$work/difference"
    # seen from near or from below, some faces of the body have the orange of its ramp, with red well
    # above blue
    /usr/bin/python3 - "$work/frame-0002.png" "$work/frame-0003.png" >"$work/colours" 2>&1 <<'END'
import sys
from PIL import Image
images = [Image.open(path).convert("RGB") for path in sys.argv[1:]]
orange = [sum(n for n, (r, g, b) in image.getcolors(1 << 20) if r > 120 and b < r // 6 and g < r // 2) for image in images]
print(orange, "orange pixels")
sys.exit(not 30 < max(orange) < images[0].width * images[0].height // 4)
END
    report $? "$scene/faces_are_coloured" "$work/colours"
done

echo "1..$tests"
[ "$failed" -eq 0 ]

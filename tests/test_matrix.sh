#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/matrix.py: it finds one hash where there is one, and says where and when there is not. The
# faults are put into a copy of the engine, for m68k: big-endian, of 32 bits. Prints TAP.

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MAKELEVEL MFLAGS

# matrix OPTION...: a few quick builds
matrix()
{
    tools/matrix.py --targets "$(uname -m),m68k" --compilers gcc --options=-O0 --frames 600 "$@" \
        >"$work/said" 2>&1
}

# report STATUS NAME: a line of TAP; after a failure, the tool's last output
tests=0
report()
{
    tests=$((tests + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tests - matrix/$2"
    else
        echo "not ok $tests - matrix/$2"
        tail -n 8 "$work/said" | sed 's/^/# /'
    fi
}

# says TEXT...: the tool's output has every text
says()
{
    for text in "$@"; do
        grep -qF -- "$text" "$work/said" || { echo "# missing: $text"; return 1; }
    done
}

# copy: a fresh copy of the engine, for faults
copy()
{
    rm -rf "$work/src"
    cp -r src "$work/src"
}

# spoil FRAME STAGE STATEMENT: the statement runs when a stage ends in a frame; a frame ends with
# commit
spoil()
{
    copy
    sed -i "/^void step_mark(/,/^{/ s/^{/{\n    static int frame = 1;\n\n    if (frame == $1 \&\& \
stage == CAROM_STAGE_$2) {\n        $3;\n    }\n    frame += stage == CAROM_STAGE_COMMIT;/" \
        "$work/src/step/slice.c"
    ! cmp -s src/step/slice.c "$work/src/step/slice.c"
}

# Four scenes continue from a snapshot, from each machine on the other.
matrix --scenes pile,sheet,door,walker
status=$?
says '2 builds, 4 scenes, 1 hash each' \
    '16 snapshots gone on with elsewhere' '4 from big to little' '4 from little to big' \
    '4 from 32 to 64' '4 from 64 to 32' && [ "$status" -eq 0 ]
report $? 'one hash, and snapshots go from one machine to another'

# The box of this scene lies on the ground, so every frame comes to rest.
spoil 137 REST 'w->states[w->now == w->states].bodies[1].momentum.c[0] += 1' &&
    { matrix --scenes slide --engine "m68k=$work/src"; [ $? -eq 1 ]; } &&
    says 'FAIL m68k gcc -O0: slide has ' 'first in frame 137, after stage rest'
report $? 'a state that differs by a bit: its frame and stage'

# The findings of a stage are in no state yet; the state differs only after advance.
spoil 41 PREDICT 'w->bodies[1].path.v.c[0] += 1 << 20' &&
    { matrix --scenes slide --engine "m68k=$work/src"; [ $? -eq 1 ]; } &&
    says 'first in frame 41, after stage predict'
report $? 'a path that differs: the stage that made it'

# A hash of swapped bytes agrees with itself on one machine, but not with other machines.
copy
sed -i 's/v >> (8 \* i)/v >> (8 * (bytes - 1 - i))/' "$work/src/world/stream.c"
! cmp -s src/world/stream.c "$work/src/world/stream.c" &&
    { matrix --scenes pile --engine "m68k=$work/src"; [ $? -eq 1 ]; } &&
    says 'has another snapshot of frame 500' 'load: ' '0 snapshots gone on with'
report $? 'a snapshot of another byte order is refused'

copy
echo 'int one = "one";' >>"$work/src/num/fix.c"
{ matrix --targets m68k --engine "m68k=$work/src"; [ $? -eq 1 ]; } &&
    says 'FAIL m68k gcc -O0: compile: ' '0 builds, 0 scenes, 1 failures'
report $? 'a build that cannot be made is a failure'

# The page, in a copy: a build of today's engine, and one of an earlier one.
mkdir "$work/page" "$work/page/tests"
cp -r tools docs include README.md SPEC.md "$work/page"
cp tests/*.csv "$work/page/tests"
{
    head -n 1 tests/matrix.csv
    echo "m68k,gcc,-O2,12.2.0,32,big,qemu-m68k,,$(sha256sum tests/plays.csv | cut -c1-8),2026-01-02,1234567"
    echo "sh4,gcc,-O0,12.2.0,32,little,qemu-sh4,,00000000,2026-01-01,7654321"
} >"$work/page/tests/matrix.csv"
plays=$(($(wc -l <tests/plays.csv) - 1))
"$work/page/tools/matrix_page.py" --write && "$work/page/tools/claims.py" --write >"$work/said" &&
    cat "$work/page/docs/matrix.md" "$work/page/README.md" >"$work/said" &&
    says "2 builds, $plays scenes, one hash each. 1 of these builds played an earlier engine." \
        "$plays scenes, which ended in one hash each in 2 builds. 1 of these builds played an earlier engine."
report $? 'builds of an earlier engine are named'

sed -i '/^box,/ s/.$/x/' "$work/page/tests/plays.csv"
! "$work/page/tools/matrix_page.py" >"$work/said" 2>&1 && says 'docs/matrix.md does not show'
report $? 'a page that does not show the committed hashes is noticed'

# A build that plays as committed gets a row; one that does not loses it, and is named.
cat >"$work/page/tools/try.py" <<'EOF'
import types

import matrix_page
import plays
import results

rows = plays.kept("plays", matrix_page.ROOT)
right = types.SimpleNamespace(target="armel", compiler="gcc", options="-O1", bits=32, order="little", where="qemu-arm", absent=["box"],
                              scenes={row[0]: row[1:4] for row in rows if row[0] != "box"})
for build, bad in (right, None), (right, "pile"):
    if bad:
        build.scenes[bad] = ["2000", "1", "0"]
    faults = list(matrix_page.faults(build))
    matrix_page.keep(build, not faults, "12.2.0", "1234567")
    print(len(faults), *faults, [row["options"] for row in results.read(matrix_page.KEPT)], len(matrix_page.missing([build])), "missing")
EOF
/usr/bin/python3 -B "$work/page/tools/try.py" >"$work/said" 2>&1 &&
    says "0 ['-O1', '-O2', '-O0'] 0 missing" "pile has 0; tests/plays.csv has" "['-O2', '-O0'] 1 missing"
report $? 'a build has a row while it plays as committed'
echo "1..$tests"

#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/hello.c, built by the command that README.md gives, prints what README.md says; prints TAP.

cd "$(dirname "$0")/.." || exit 1
work=build/tests/hello
mkdir -p "$work" || exit 1

tests=0
failed=0

# report STATUS NAME FILE: one line of TAP; after a failure, the file
report()
{
    tests=$((tests + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tests - hello/$2"
    else
        failed=$((failed + 1))
        echo "not ok $tests - hello/$2"
        sed 's/^/# /' "$3"
    fi
}

# Whether the tetrahedron falls as it must: 1/2 g t^2 in the air, then rest on a face. Its corners are
# those of a cube of half side 99/256, so a face is 99/256 / sqrt 3 from the centre: 223.3 mm.
plausible()
{
    awk '
        { gsub(/[:,]/, "") }
        $2 == 10 || $2 == 20 {
            # gravity acts for whole frames; the height is printed to 1 mm, rounded down
            fallen = 9810 / 2 * ($2 / 60) ^ 2
            if ($3 < 2000 - fallen - 2 || $3 > 2000 - fallen + 1) bad = 1
            seen++
        }
        $2 > 30 && $3 > 1000 || $3 < 222 { bad = 1 }
        { rest = $3 }
        END { exit bad || seen != 2 || rest < 222 || rest > 224 }' "$1"
}

# The fenced output that follows the program in README.md.
readme_output()
{
    awk '/^```/ { inside = !inside
                  if (inside) { take = program && ($0 == "```" || $0 == "```text") }
                  else if (take) exit
                  next }
         inside && take { print }
         inside && /int main\(void\)/ { program = 1 }' README.md
}

gcc -Iinclude examples/hello.c src/*/*.c -o "$work/hello" >"$work/said" 2>&1 && [ ! -s "$work/said" ]
report $? "builds" "$work/said"
"$work/hello" >"$work/output" 2>&1 </dev/null
report $? "runs" "$work/output"
plausible "$work/output"
report $? "falls_and_rests" "$work/output"
if [ -e README.md ]; then
    readme_output >"$work/expected"
    diff "$work/expected" "$work/output" >"$work/difference"
    report $? "prints_what_the_readme_says" "$work/difference"
else
    echo "# no README.md yet"
fi

echo "1..$tests"
[ "$failed" -eq 0 ]

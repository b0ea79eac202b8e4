#!/bin/sh
# SPDX-License-Identifier: MIT
# Numbers that are not fixed-point ones: the compilers refuse them or warn, with the options that carom_fix.h
# names; prints TAP.

cd "$(dirname "$0")/.." || exit 1
work=build/tests/numbers
mkdir -p "$work" || exit 1

tests=0
failed=0

# report OK NAME FILE: one line of TAP; after a failure, the file
report()
{
    tests=$((tests + 1))
    if [ "$1" = 0 ]; then
        echo "ok $tests - numbers/$2"
    else
        failed=$((failed + 1))
        echo "not ok $tests - numbers/$2"
        sed 's/^/# /' "$3"
    fi
}

# try COMMAND NAME CODE MINDS: whether the compiler reports the code, by an error or a warning, as it
# should
try()
{
    printf '#include "carom_body.h"\n%s\n' "$3" >"$work/it.c"
    minded=0
    # shellcheck disable=SC2086
    if $1 -Iinclude -c -o "$work/it.o" "$work/it.c" >"$work/said" 2>&1 && [ ! -s "$work/said" ]; then
        minded=1
    fi
    [ "$minded" = "$4" ]
    report $? "$2" "$work/said"
}

for compiler in "gcc -std=c11 -Wfloat-conversion" "clang -std=c11" "g++ -x c++ -std=c++20" \
                "clang++ -x c++ -std=c++20"; do
    name=${compiler%% *}
    command -v "$name" >/dev/null || { echo "# no $name"; continue; }
    # each macro with a number that is not whole, and with one that is
    for macro in "POSITION_MM(%s)" "POSITION_M(%s)" "VELOCITY_MM_S(%s, 60)" "VELOCITY_M_S(%s, 60)" \
                 "VELOCITY_MM_S(9, %s)" "GRAVITY_MM_S2(%s, 60)" "GRAVITY_MM_S2(9, %s)" "SPIN_MRAD_S(%s, 60)" \
                 "SPIN_DEG_S(%s, 60)" "SPIN_DEG_S(9, %s)" "ANGLE_MRAD(%s)" "ANGLE_DEG(%s)" "MASS_G(%s)" \
                 "MASS_KG(%s)" "FORCE_MN(%s, 60)" "FORCE_N(%s, 60)" "IMPULSE_MN_S(%s, 60)" \
                 "IMPULSE_N_S(%s, 60)" "TORQUE_MN_M(%s, 60)" "TORQUE_N_M(%s, 60)" "TWIST_MN_M_S(%s, 60)" \
                 "TWIST_N_M_S(9, %s)" "RATIO(%s, 2, 30)" "RATIO(1, %s, 30)"; do
        # shellcheck disable=SC2059
        for number in 1.5 1.0 5; do
            of=$(printf "$macro" "$number")
            try "$compiler" "$name/$(echo "$of" | tr ' ' _)" "int64_t v = CAROM_$of;" \
                "$([ $number = 5 ] && echo 1 || echo 0)"
        done
    done
    try "$compiler" "$name/velocity" "struct carom_body_def d = {.velocity = {{9.81}}};" 0
    try "$compiler" "$name/position" "carom_v3_q32 p = {{0, 0, 1.5}};" 0
    try "$compiler" "$name/restitution" \
        "void f(struct carom_body_def *d); void f(struct carom_body_def *d) { d->restitution_q30 = 0.5; }" \
        "$([ "$name" = g++ ] && echo 1 || echo 0)"
    try "$compiler" "$name/plain" "struct carom_body_def d = {.velocity = {{CAROM_VELOCITY_M_S(2, 60)}}};" 1
done
# gcc's warnings for C alone, with -Wconversion
try "gcc -std=c11 -Wconversion" "gcc/conversion" "struct carom_body_def d = {.velocity = {{9.81}}};" 0
try "g++ -x c++ -std=c++20 -Wfloat-conversion" "g++/assigned" \
    "void f(struct carom_body_def *d); void f(struct carom_body_def *d) { d->restitution_q30 = 0.5; }" 0

echo "1..$tests"
[ "$failed" -eq 0 ]

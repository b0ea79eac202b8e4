#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Lines of units.txt that must compile do compile, and their twins with other units do not: units.py
COMPILER..."""
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
OPTIONS = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
           "-Wno-unused-but-set-variable", "-fsyntax-only", "-x", "c++",
           "-I" + os.path.join(HERE, "../../include"), "-"]
PROGRAM = """
#include "carom.hpp"
using namespace carom;
using namespace carom::literals;
void tried(World<Caps<2, 1, 16, 16, 0, 64>> &world, BodyDef &def, Body body);
void tried(World<Caps<2, 1, 16, 16, 0, 64>> &world, BodyDef &def, Body body)
{
    constexpr Fps<60> fps{};
    const Impulse impulse = fps(1_N_s);
    const Force force = fps(1_N);
    const Torque torque = fps(1_N_m);
    const Vec<Length> at{0_m, 0_m, 1_m};
    const Vec<Part> axis{0_of_1, 0_of_1, 1_of_1};
    (void)world, (void)def, (void)body, (void)fps, (void)impulse, (void)force, (void)torque;
    (void)at, (void)axis;
    %s
}
"""


def refusal(compiler, line):
    """A compiler's error for a line; empty if the compiler accepts the line."""
    done = subprocess.run([compiler, *OPTIONS], input=PROGRAM % line, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.stdout if done.returncode else ""


failures, tried = [], 0
with open(os.path.join(HERE, "units.txt")) as file:
    pairs = [line.strip().split(" | ") for line in file if not line.startswith("#")]
for compiler in sys.argv[1:]:
    for good, bad in pairs:
        tried += 1
        said = refusal(compiler, good)
        if said:
            failures.append("%s does not take: %s\n%s" % (compiler, good, said))
        if not refusal(compiler, bad):
            failures.append("%s takes: %s" % (compiler, bad))
for failure in failures:
    print(failure)
print("%d pairs of lines, %d wrong" % (tried, len(failures)))
sys.exit(bool(failures) or not tried)

/* SPDX-License-Identifier: MIT */
/*
 * Motions whose outcome is known, by a closed form or by a publication: expected, measured, error, bar.
 *
 *   host_physics             all of them
 *   host_physics PART...     fall, slope, roll, swing, spin, stone
 *   host_physics csv         rows as CSV, for the table of docs/physics.md
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/physics.h"

static const struct {
    const char *name;
    void (*measure)(void);
} parts[] = {{"fall", physics_fall},   {"slope", physics_slope}, {"roll", physics_roll},
             {"swing", physics_swing}, {"spin", physics_spin},   {"stone", physics_stone}};

static bool csv;

static void row(const char *name, const char *from, double expected, double measured, double bar,
                double most, const char *why)
{
    double error = expected != 0 ? measured / expected - 1 : measured;

    if (csv) {
        printf("\"%s\",\"%s\",%.7g,%.7g,%.1e,%g,%s,\"%s\"\n", name, from, expected, measured, error,
               bar, fabs(error) <= bar ? "yes" : "no", why ? why : "");
        fflush(stdout);
        return;
    }
    lab_report(fabs(error) <= most, name, "%s: expected %.7g, measured %.7g, error %.1e, bar %g%s",
               from, expected, measured, error, bar, most > bar ? ", known to miss" : "");
}

void physics_row(const char *name, const char *from, double expected, double measured, double bar,
                 const char *why)
{
    row(name, from, expected, measured, bar, bar, why);
}

void physics_miss(const char *name, const char *from, double expected, double measured, double bar,
                  double most, const char *why)
{
    row(name, from, expected, measured, bar, most, why);
}

int main(int argc, char **argv)
{
    csv = lab_given("csv", argc, argv);
    if (csv) {
        puts("motion,from,expected,measured,error,bar,holds,why");
    }
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (argc - 1 == csv || lab_given(parts[i].name, argc, argv)) {
            parts[i].measure();
        }
    }
    return csv ? 0 : lab_finish();
}

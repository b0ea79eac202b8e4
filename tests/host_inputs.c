/* SPDX-License-Identifier: MIT */
/*
 * Inputs of the fuzzer that once failed (lib/inputs.c) are given to their targets again; so are inputs of chance, a few of each
 * target. The debug build has sanitizers.
 *
 *   host_inputs               all of them
 *   host_inputs TARGET FILE   a file, such as one that `make fuzz` has left in out/fuzz
 *   host_inputs TARGET COUNT SEED   inputs of chance
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/inputs.h"
#include "lib/target.h"

#define BYTES  4096 /* of an input, at most */
#define LONG   600  /* bytes of an input of chance, at most */
#define CHANCE 300

static uint8_t input[BYTES];

/* The bytes that a line of digits names, two each. */
static size_t read_digits(const char *digits)
{
    size_t n = 0;
    unsigned v;

    for (; n < BYTES && sscanf(digits + 2 * n, "%2x", &v) == 1; n++) {
        input[n] = (uint8_t)v;
    }
    return n;
}

static void run_chance(const struct target *target, long count, uint64_t seed)
{
    struct test_random r = {seed};

    for (long i = 0; i < count; i++) {
        const size_t n = (size_t)test_random_range(&r, 0, LONG);

        for (size_t k = 0; k < n; k++) {
            input[k] = (uint8_t)test_random_next(&r);
        }
        target->run(input, n);
    }
}

static int run_file(const struct target *target, const char *name)
{
    FILE *file = fopen(name, "rb");
    size_t n;

    if (!file) {
        perror(name);
        return 1;
    }
    n = fread(input, 1, sizeof input, file);
    fclose(file);
    target->run(input, n);
    printf("%s: nothing wrong\n", name);
    return 0;
}

int main(int argc, char **argv)
{
    const struct target *target = argc > 2 ? target_find(argv[1]) : NULL;
    int count = 0;

    if (target && argc > 3) {
        run_chance(target, atol(argv[2]), strtoull(argv[3], NULL, 10));
        return 0;
    }
    if (argc > 1) {
        return target ? run_file(target, argv[2]) : 2;
    }
    for (const struct input *i = inputs; i->target; i++, count++) {
        printf("# %s, %s\n", i->target, i->why);
        fflush(stdout);
        target_find(i->target)->run(input, read_digits(i->digits));
    }
    lab_report(true, "inputs/known", "%d that once failed", count);
    for (target = targets; target->name; target++) {
        printf("# %s, inputs of chance\n", target->name);
        fflush(stdout);
        run_chance(target, CHANCE, 1);
    }
    lab_report(true, "inputs/chance", "%d of each target", CHANCE);
    return lab_finish();
}

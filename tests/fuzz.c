/* SPDX-License-Identifier: MIT */
/* libFuzzer over a target of lib/target.h: fuzz TARGET [options of libFuzzer]. tools/fuzz.py runs it. */
#include <stdio.h>
#include <stdlib.h>

#include "lib/target.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static const struct target *target;

/* Take the target's name out of the arguments. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    target = *argc > 1 ? target_find((*argv)[1]) : NULL;
    if (!target) {
        fprintf(stderr, "fuzz TARGET: one of");
        for (const struct target *t = targets; t->name; t++) {
            fprintf(stderr, " %s", t->name);
        }
        fputs("\n", stderr);
        exit(2);
    }
    (*argv)[1] = (*argv)[0];
    ++*argv;
    --*argc;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    target->run(bytes, count);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* inputs - inputs of the fuzzer that once failed. Who finds one adds a line; `xxd -p` writes the digits. */
#ifndef CAROM_TESTS_INPUTS_H
#define CAROM_TESTS_INPUTS_H

struct input {
    const char *target, *why, *digits; /* two digits a byte */
};

/* Ends with one without a target. */
extern const struct input inputs[];

#endif

/* SPDX-License-Identifier: MIT */
/*
 * target - what a fuzzer's bytes are given to. A target ends the program with a message when a promise is broken; sanitizers and
 * assertions of a debug build end it, too. tests/fuzz.c links libFuzzer, host_inputs.c plays the inputs that once failed.
 */
#ifndef CAROM_TESTS_TARGET_H
#define CAROM_TESTS_TARGET_H

#include "fuzz.h"

struct target {
    const char *name;
    void (*run)(const uint8_t *bytes, size_t count);
};

/* Ends with one without a name. */
extern const struct target targets[];
/* NULL if there is none of this name. */
const struct target *target_find(const char *name);

void target_calls(const uint8_t *bytes, size_t count);
void target_ask(const uint8_t *bytes, size_t count);
void target_draw(const uint8_t *bytes, size_t count);
void target_snapshot(const uint8_t *bytes, size_t count);
void target_small(const uint8_t *bytes, size_t count);
void target_replay(const uint8_t *bytes, size_t count);
void target_mesh(const uint8_t *bytes, size_t count);

/* End the program if there is a fault. */
void target_expect(const char *fault, int result);

#endif

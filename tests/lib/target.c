/* SPDX-License-Identifier: MIT */
/* Targets of a fuzzer: calls, questions, pictures, and bytes of files that were changed. */
#include "target.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bytes.h"
#include "edits.h"
#include "recording.h"
#include "saved.h"

const struct target targets[] = {
    {"calls", target_calls},
    {"ask", target_ask},
    {"draw", target_draw},
    {"snapshot", target_snapshot},
    {"small", target_small},
    {"replay", target_replay},
    {"mesh", target_mesh},

    {0},
};

const struct target *target_find(const char *name)
{
    for (const struct target *t = targets; t->name; t++) {
        if (strcmp(t->name, name) == 0) {
            return t;
        }
    }
    return NULL;
}

void target_expect(const char *fault, int result)
{
    if (fault) {
        fprintf(stderr, "%s: %s\n", fault, carom_result_text(result));
        abort();
    }
}

/* ------------------------------------------------------------- calls of a world */

/* A step is the dearest call, so an input has few. */
#define STEPS 8

static struct fuzz fuzz;

/* Calls until there are no bytes, each followed by a step or not. */
static void calls(const uint8_t *bytes, size_t count, int (*call)(struct fuzz *f), int steps)
{
    int result;

    fuzz_begin_bytes(&fuzz, bytes, count);
    fuzz.searches = count % 4 == 0; /* no more: calls would hardly do anything else */
    while (!chance_over(&fuzz.chance)) {
        const char *fault = fuzz_try(&fuzz, call, &result);

        target_expect(fault, result);
        if (steps > 0 && fuzz_pick(&fuzz, 4) == 0) {
            steps--;
            fault = fuzz_try_step(fuzz.world, &result);
            target_expect(fault, result);
        }
    }
}

void target_calls(const uint8_t *bytes, size_t count)
{
    calls(bytes, count, fuzz_call, STEPS);
}

/* Questions and pictures change nothing. */
static int unchanged(int (*call)(struct fuzz *f), struct fuzz *f)
{
    const uint64_t before = carom_world_hash(f->world);
    const int result = call(f);

    return carom_world_hash(f->world) == before ? result : FUZZ_DIFFERS;
}

static int ask(struct fuzz *f)
{
    return unchanged(fuzz_ask, f);
}

static int draw(struct fuzz *f)
{
    return unchanged(fuzz_draw, f);
}

void target_ask(const uint8_t *bytes, size_t count)
{
    calls(bytes, count, ask, 1);
}

void target_draw(const uint8_t *bytes, size_t count)
{
    calls(bytes, count, draw, 1);
}

/* ------------------------------------------------------------------ bytes of files */

/* A saved world, which is made when it is first asked for. */
static struct saved *saved_world(struct saved **all, struct chance *c,
                                 void (*make)(struct saved *s, int number))
{
    const int number = chance_pick(c, SAVED_WORLDS);

    if (!all[number]) {
        all[number] = (struct saved *)lab_need(sizeof **all);
        make(all[number], number);
    }
    return all[number];
}

/* What loads is a world: it steps, saves, and takes back what it saved. */
static void load(struct saved **all, void (*make)(struct saved *s, int number),
                 const uint8_t *bytes, size_t count)
{
    static uint8_t changed[SAVED_BYTES];
    struct chance c = {.bytes = bytes, .left = count};
    struct saved *s = saved_world(all, &c, make);
    const int steps = chance_pick(&c, 3);
    int result;

    memcpy(changed, s->good, s->size);
    edit_bytes(&c, changed, s->size - 8);
    bytes_mend(changed, s->size);
    target_expect(saved_try_load(s, changed, s->size, &result), result);
    for (int i = 0; i < steps && result >= 0; i++) {
        const char *fault = fuzz_try_step(s->world, &result);

        target_expect(fault, result);
    }
    result = carom_snapshot_save(s->world, changed, sizeof changed);
    if (result >= 0) {
        result = carom_snapshot_load(s->world, changed, (size_t)result);
    }
    target_expect(result < 0 ? "what a step left is refused" : NULL, result);
    target_expect(saved_back(s), CAROM_OK);
}

void target_snapshot(const uint8_t *bytes, size_t count)
{
    static struct saved *all[SAVED_WORLDS];

    load(all, saved_make, bytes, count);
}

void target_small(const uint8_t *bytes, size_t count)
{
    static struct saved *all[SAVED_WORLDS];

    load(all, saved_make_small, bytes, count);
}

/* A recording that was changed, or the bytes as a recording. */
void target_replay(const uint8_t *bytes, size_t count)
{
    enum { FILES = 8, CALLS = 16 };
    static struct recording *all[FILES];
    static struct carom_replay player;
    static uint8_t changed[RECORDING_BYTES];
    struct chance c = {.bytes = bytes, .left = count};
    const int number = chance_pick(&c, FILES + 1);
    size_t size = c.left;
    int result;

    if (number == FILES) {
        memcpy(changed, c.bytes, size);
    } else {
        if (!all[number]) {
            all[number] = (struct recording *)lab_need(sizeof **all);
            (void)recording_make(all[number], &fuzz, (uint64_t)number + 1, 3,
                                 number % 2 * CALLS / 2, CALLS);
        }
        size = all[number]->bytes;
        memcpy(changed, all[number]->file, size);
        edit_bytes(&c, changed, size);
        size -= chance_pick(&c, 4) ? 0 : (size_t)chance_range(&c, 0, (int64_t)size);
    }
    edit_mend32(changed, size);
    target_expect(recording_try(&player, changed, size, &result), result);
}

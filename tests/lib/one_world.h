/* SPDX-License-Identifier: MIT */
/* one_world - the world of a test source, its states, steps and events, and the calls that it refuses. */
#ifndef CAROM_TEST_ONE_WORLD_H
#define CAROM_TEST_ONE_WORLD_H

#include <string.h>

#include "carom.h"
#include "test.h"

static struct carom_world *world;

static inline struct carom_body_state state_of(int body)
{
    struct carom_body_state s;

    memset(&s, 0, sizeof s);
    CHECK_EQ(carom_body_get(world, body, &s), CAROM_OK);
    return s;
}

/* Take steps that must succeed. */
static inline void steps(int frames)
{
    for (int i = 0; i < frames; i++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
}

/* Count the events of a kind between two bodies in the last step. */
static inline int events_of(int kind, int a, int b)
{
    const struct carom_event *e;
    int found = 0;

    for (int i = carom_events(world, &e) - 1; i >= 0; i--) {
        found += e[i].kind == kind && e[i].a == a && e[i].b == b;
    }
    return found;
}

/* Check that a call is refused and leaves the state unchanged. */
#define REFUSE(call, error)                                                                        \
    do {                                                                                           \
        const uint64_t hash = carom_world_hash(world);                                             \
        CHECK_EQ(call, error);                                                                     \
        CHECK_EQ(carom_world_hash(world), hash);                                                   \
    } while (0)

#endif

/* SPDX-License-Identifier: MIT */
/* jointed - a small world for joints: boxes of one mesh, and what holds them together. */
#ifndef CAROM_TEST_JOINTED_H
#define CAROM_TEST_JOINTED_H

#include <string.h>

#include "carom_joint.h"
#include "one_world.h"
#include "shapes.h"

#define PAIRS 4
#define CAPS  4, PAIRS, 24, 32, 0, 32, 3, 1
#define UNIT  ((int64_t)1 << 32)
#define ONE   ((int64_t)1 << 40)
#define FALL  (ONE / 367) /* 9.81 m / s^2 at 60 frames */
/* A skin of the box: its radius, 0.573, over 2048, is 2^-11.8. */
#define SKIN (UNIT >> 12)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box;
static struct carom_body_def def;

/* An empty world; def becomes a box with sides of 1, 1/2 and 1/4, a mass of 1 and a friction of 1/2. */
static inline void setup_pairs(int64_t gravity_q40, uint32_t pairs)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -gravity_q40}}};

    config.caps.pairs = pairs;
    shape_box(&box, 12, 4096, 2048, 1024);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.mass_q20 = 1 << 20;
    def.friction_q16 = 1 << 15;
}

static inline void setup(int64_t gravity_q40)
{
    setup_pairs(gravity_q40, PAIRS);
}

/* Add a body of def. */
static inline int add(int64_t x, int64_t y, int64_t z)
{
    int body;

    def.position = (carom_v3_q32){{x, y, z}};
    body = carom_body_add(world, &def);
    CHECK_AT_LEAST(body, 0);
    return body;
}

/* A joint with its anchor at a place, and its axis along z. */
static inline struct carom_joint_def joint(int kind, int a, int b, int64_t x, int64_t y, int64_t z)
{
    struct carom_joint_def j;

    memset(&j, 0, sizeof j);
    j.kind = (uint8_t)kind;
    j.a = a;
    j.b = b;
    j.anchor = (carom_v3_q32){{x, y, z}};
    j.axis.c[2] = CAROM_ONE_Q30;
    return j;
}

static inline struct carom_joint_state joint_of(int number)
{
    struct carom_joint_state s;

    memset(&s, 0, sizeof s);
    CHECK_EQ(carom_joint_get(world, number, &s), CAROM_OK);
    return s;
}

/* The largest distance of two anchors along an axis, in units of 2^-32. */
static inline int64_t apart(int number)
{
    struct carom_joint_state s = joint_of(number);
    int64_t most = 0;

    for (int k = 0; k < 3; k++) {
        int64_t d = carom_abs(s.anchor[0].c[k] - s.anchor[1].c[k]);

        most = d > most ? d : most;
    }
    return most;
}

#endif

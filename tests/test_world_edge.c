/* SPDX-License-Identifier: MIT */
/*
 * Bodies that leave the world while they meet, lean on each other, hang on joints or are pushed by one that is led. A body that is
 * out stays where it left, in range, and is told of once; the others go on.
 */
#include <string.h>

#include "carom_joint.h"
#include "lib/one_world.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
enum { WORLDS = 300 };
#else
enum { WORLDS = 2 };
#endif
enum { BODIES = 9, FRAMES = 40 };

#define CAPS  BODIES, 36, 200, 400, 0, 400, 3, 2, 16
#define UNIT  ((int64_t)1 << 32)
#define FRAME ((int64_t)1 << 40)
#define EDGE  (4096 * UNIT)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box, ball, plate;

static int64_t any(struct test_random *r, int64_t most)
{
    return test_random_range(r, -most, most);
}

/* A body near the corner of the world, that goes towards it faster than away. */
static void add(struct test_random *r, int i, int64_t speed_q40)
{
    struct carom_body_def def = {.mesh = i % 3 ? &box.mesh : &ball.mesh,
                                 .kinematic = i == 1,
                                 .stationary = i == 0,
                                 .friction_q16 = 1 << 15,
                                 .restitution_q30 = i % 2 ? CAROM_ONE_Q30 / 2 : 0,
                                 .overlap = CAROM_OVERLAP_PASS};

    for (int k = 0; k < 3; k++) {
        def.position.c[k] = EDGE - test_random_range(r, UNIT / 2, 5 * UNIT);
        def.velocity.c[k] = i == 0 ? 0 : test_random_range(r, -speed_q40 / 2, speed_q40);
        def.spin.c[k] = i == 0 ? 0 : any(r, FRAME / 8);
    }
    if (i == 0) {
        def.mesh = &plate.mesh;
        def.position.c[2] = EDGE - 6 * UNIT;
    }
    CHECK_EQ(carom_body_add(world, &def), i);
}

static void make(struct test_random *r, int64_t speed_q40)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .sleep = true};

    config.gravity.c[0] = any(r, FRAME / 256);
    config.gravity.c[2] = any(r, FRAME / 128);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    for (int i = 0; i < BODIES; i++) {
        add(r, i, speed_q40);
    }
    for (int i = 0; i < 3; i++) {
        struct carom_joint_def joint = {.kind = (uint8_t)test_random_range(r, 0, 4),
                                        .touch = i == 0,
                                        .a = 3 + 2 * i,
                                        .b = i == 1 ? 1 : 4 + 2 * i};

        joint.axis.c[i] = CAROM_ONE_Q30;
        joint.anchor = joint.anchor_b = state_of(joint.a).position;
        CHECK_EQ(carom_joint_add(world, &joint), i);
    }
}

/* One frame: who is out now stays, and only those who were not out before are told of. */
static int watch(void)
{
    const struct carom_event *events;
    struct carom_body_state before[BODIES];
    int told[BODIES] = {0}, out = 0;

    for (int i = 0; i < BODIES; i++) {
        before[i] = state_of(i);
    }
    CHECK_AT_LEAST(carom_world_step(world), 0);
    for (int i = 0, n = carom_events(world, &events); i < n; i++) {
        told[events[i].a] += events[i].kind == CAROM_EVENT_OUT;
    }
    for (int i = 0; i < BODIES; i++) {
        const struct carom_body_state s = state_of(i);

        for (int k = 0; k < 3; k++) {
            CHECK_AT_MOST(s.position.c[k], EDGE + UNIT / 4);
        }
        CHECK_EQ(told[i], s.out && !before[i].out);
        if (before[i].out) {
            CHECK(s.out);
            CHECK_EQ(memcmp(&s.position, &before[i].position, sizeof s.position), 0);
            CHECK_EQ(memcmp(&s.rotation, &before[i].rotation, sizeof s.rotation), 0);
        }
        out += s.out;
    }
    return out;
}

static void leave(void)
{
    struct test_random r = {23};
    int left = 0;

    shape_box(&box, 12, 4096, 3000, 2000);
    shape_ball(&ball, 12, 2400);
    shape_box(&plate, 10, 6144, 6144, 512);
    for (int n = 0; n < WORLDS; n++) {
        make(&r, FRAME >> (1 + n % 5));
        for (int frame = 0; frame < FRAMES; frame++) {
            if (frame == 10) {
                const struct carom_pose pose = {.position = {{EDGE, EDGE - UNIT, EDGE}}};

                (void)carom_body_move_to(world, 1, &pose);
            }
            left += watch() > 0;
        }
    }
    CHECK_MORE(left, WORLDS);
}

/*
 * A box rides on a kinematic plate and leaves the world there. The plate stops: by itself where it was led to, or by a call. Nothing is
 * awake any more, and the world can be saved and loaded.
 */
static void ride_out(void)
{
    static uint8_t bytes[4096];

    shape_box(&box, 12, 4096, 3000, 2000);
    shape_box(&plate, 10, 6144, 6144, 512);
    for (int to = 0; to < 2; to++) {
        struct carom_config config = {.caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -FRAME / 367}}};
        struct carom_body_def def = {.mesh = &plate.mesh, .kinematic = true};
        struct carom_body_state state;
        int size, frame = 0;

        CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
        def.position.c[0] = EDGE - 2 * UNIT;
        def.velocity.c[0] = to ? 0 : FRAME / 64;
        def.friction_q16 = 1 << 15;
        CHECK_EQ(carom_body_add(world, &def), 0);
        def.mesh = &box.mesh;
        def.kinematic = false;
        def.position.c[0] = EDGE - UNIT / 4;
        def.position.c[2] = UNIT / 4 + UNIT * 1000 / 4096 + UNIT / 4096;
        def.velocity.c[0] = FRAME / 64;
        CHECK_EQ(carom_body_add(world, &def), 1);
        while (frame++ < 40 && !state_of(1).out) {
            struct carom_body_state at = state_of(0);
            const struct carom_pose pose = {{{at.position.c[0] + UNIT / 64, 0, 0}}, at.rotation};

            if (to) {
                CHECK_EQ(carom_body_move_to(world, 0, &pose), CAROM_OK);
            }
            steps(1);
        }
        CHECK(state_of(1).out);
        state = state_of(0);
        memset(&state.velocity, 0, sizeof state.velocity);
        CHECK_EQ(carom_body_set(world, 0, &state), CAROM_OK);
        for (int later = 0; later < 3; later++) {
            size = carom_snapshot_save(world, bytes, sizeof bytes);
            CHECK_MORE(size, 0);
            CHECK_EQ(carom_snapshot_load(world, bytes, (size_t)size), CAROM_OK);
            steps(1);
        }
    }
}

const struct test tests_world_edge[] = {
    {"world_edge/leave", leave},
    {"world_edge/ride_out", ride_out},
    {0},
};

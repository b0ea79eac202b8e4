/* SPDX-License-Identifier: MIT */
/*
 * host_soak_watch - the checker of random worlds sees each of its faults, and reports none where
 * there is none.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/real.h"
#include "lib/soak.h"

static struct soak_world world;
static struct soak_result result;

/* Two boxes of 1 x 0.6 x 0.3 without gravity move and turn; the second is far away. */
static struct crowd *begin(void)
{
    const double v[3] = {0.01, 0.02, -0.03}, w[3] = {0.1, 0.05, 0.2};
    struct crowd *crowd = crowd_new();
    int box = crowd_box(crowd, 1, 0.6, 0.3);

    memset(&world, 0, sizeof world);
    world.crowd = crowd;
    world.exact = true;
    crowd->config.gravity = (carom_v3_q40){{0}};
    for (int i = 0; i < 2; i++) {
        struct carom_body_def *def = crowd_body(crowd, box);

        crowd_place(def, 10 * i, 0, 0);
        crowd_move(def, v, w);
        world.halvings[i] = 3 * i;
        def->mass_q20 = (1u << 20) >> world.halvings[i];
    }
    return crowd;
}

static void finish(bool ok, const char *name)
{
    lab_report(ok, name, "%ld frames, %ld cross, %.3f skins, %ld inside, still %d, energy %.3g",
               result.tally.frames, result.tally.crossed, result.tally.crossed_skins,
               result.tally.inside, result.still.longest, result.tally.rise);
    soak_free(&world);
}

static bool has_only(enum soak_fault fault)
{
    for (enum soak_fault other = 0; other < SOAK_FAULTS; other++) {
        if (soak_has(&result, other) != (other == fault)) {
            return false;
        }
    }
    return true;
}

static void steps(int count)
{
    while (count-- > 0) {
        soak_step(&world, &result);
    }
}

/* Change the first component of a body's velocity. */
static void nudge(int body, int64_t by_q40)
{
    struct carom_body_state state = lab_state(world.crowd->world, body);

    state.velocity.c[0] += by_q40;
    lab_expect(carom_body_set(world.crowd->world, body, &state), "set");
}

static void test_nothing(void)
{
    begin();
    soak_start(&world, &result);
    steps(30);
    finish(has_only(SOAK_FAULTS) && result.tally.frames == 30, "soak_watch/nothing");
}

/* The second box enters the end of the first by so many skins. */
static void test_crossing(double skins, const char *name)
{
    struct crowd *crowd = begin();
    double skin = crowd->meshes[0].skin, found;

    crowd_place(&crowd->bodies[1].def, 2 * 0.5 - skins * skin, 0.1, 0.05);
    crowd->bodies[1].def.overlap = CAROM_OVERLAP_PASS;
    soak_start(&world, &result);
    found = result.tally.crossed_skins;
    finish(skins > 0 ? has_only(SOAK_CROSSES) && fabs(found - skins) < 0.02 : found == 0, name);
}

static void test_inside(void)
{
    struct crowd *crowd = begin();
    int small = crowd_box(crowd, 0.2, 0.1, 0.1);

    crowd->bodies[1].mesh = small;
    crowd->bodies[1].def.mesh = &crowd->meshes[small].mesh;
    crowd_place(&crowd->bodies[1].def, 0.1, 0.1, 0);
    crowd->bodies[1].def.overlap = CAROM_OVERLAP_PASS;
    soak_start(&world, &result);
    finish(has_only(SOAK_CROSSES) && result.tally.inside == 1, "soak_watch/inside");
}

/*
 * A body below a sheet is a fault; a body that went beside the sheet before it went below is none.
 */
static void test_under(bool beside, const char *name)
{
    struct crowd *crowd = begin();
    struct carom_body_state state;

    crowd_place(&crowd->bodies[1].def, 100, 0, -3);
    crowd_place(&crowd->bodies[0].def, beside ? 50 : 0, 0, beside ? 3 : -3);
    crowd_body(crowd, crowd_mesh(crowd, &lab_sheet));
    world.exact = false;
    soak_start(&world, &result);
    state = lab_state(crowd->world, 0);
    state.position.c[0] = 0;
    state.position.c[2] = -((int64_t)3 << 32);
    lab_expect(carom_body_set(crowd->world, 0, &state), "set");
    steps(1);
    finish(beside ? has_only(SOAK_FAULTS) : has_only(SOAK_CROSSES), name);
}

static void test_room(void)
{
    struct crowd *crowd = begin();

    world.ground = SOAK_ROOM;
    world.room[0] = 1;
    world.room_half = 10.05; /* the second box moves 0.01 a frame, from 10 */
    soak_start(&world, &result);
    steps(8);
    finish(crowd->body_count == 2 && has_only(SOAK_CROSSES) && result.escaped == 1 &&
               (result.escaped_frame == 5 || result.escaped_frame == 6),
           "soak_watch/room");
}

/* A body is put back to the same place after each frame. */
static void test_still(void)
{
    struct crowd *crowd = begin();
    struct carom_body_state state;
    bool early;

    soak_start(&world, &result);
    state = lab_state(crowd->world, 0);
    for (int frame = 1; frame <= 4; frame++) {
        early = soak_has(&result, SOAK_STANDS_STILL);
        lab_expect(carom_world_step(crowd->world), "step");
        lab_expect(carom_body_set(crowd->world, 0, &state), "set");
        crowd_look(crowd);
        /* a change that crowd_look does not know about: the other body moved */
        crowd->bodies[1].before.state.position.c[0] -= (int64_t)1 << 24;
        soak_watch_still(crowd, &result.still, frame);
    }
    finish(!early && has_only(SOAK_STANDS_STILL) && result.still.body == 0, "soak_watch/still");
}

static void test_momentum(void)
{
    begin();
    soak_start(&world, &result);
    steps(2);
    nudge(1, 8); /* one unit of the momentum of a mass of 1/8, and 2^-35 of the energy */
    steps(1);
    finish(has_only(SOAK_MOMENTUM) && result.momentum_frame == 3, "soak_watch/momentum");
}

static void test_energy(void)
{
    struct crowd *crowd = begin();

    world.exact = false;
    soak_start(&world, &result);
    steps(2);
    nudge(0, crowd->bodies[0].def.velocity.c[0] >> 16); /* 2^-15 of the kinetic energy along x */
    steps(1);
    finish(has_only(SOAK_ENERGY), "soak_watch/energy");
}

static void test_error(void)
{
    struct crowd *crowd = begin();

    crowd->config.caps.faces = crowd->config.caps.pairs = 1;
    crowd_place(&crowd->bodies[1].def, 1.001, 0, 0);
    soak_start(&world, &result);
    steps(1);
    finish(has_only(SOAK_ERROR) && result.error == CAROM_ERR_FACES_FULL, "soak_watch/error");
}

int main(void)
{
    test_nothing();
    test_crossing(3, "soak_watch/crosses_by_3_skins");
    test_crossing(0.1, "soak_watch/crosses_by_a_tenth");
    test_crossing(-0.1, "soak_watch/does_not_cross");
    test_inside();
    test_under(false, "soak_watch/under");
    test_under(true, "soak_watch/beside_and_under");
    test_room();
    test_still();
    test_momentum();
    test_energy();
    test_error();
    return lab_finish();
}

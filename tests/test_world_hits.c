/* SPDX-License-Identifier: MIT */
/* HIT events: their place, where a box in any pose falls onto a floor or another box; tips that meet. */
#include <string.h>

#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define CAPS 3, 4, 32, 64, 0, 128, 0, 0, 2
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box, floor_shape;
static struct carom_world *world;
static struct carom_config config;
static struct carom_body_def def;

static void setup(uint32_t hits)
{
    memset(&config, 0, sizeof config);
    config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    config.caps.hits = hits;
    shape_box(&box, 12, 4096, 2048, 3072);
    shape_plane(&floor_shape, 9, 4, 4096);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &floor_shape.mesh;
    def.stationary = true;
    CHECK_EQ(carom_body_add(world, &def), 0);
    def.stationary = false;
    def.mesh = &box.mesh;
    def.velocity.c[2] = -ONE / 4;
    def.restitution_q30 = CAROM_ONE_Q30 / 2;
}

/* The HIT event of the step, or NULL. */
static const struct carom_event *hit_event(void)
{
    const struct carom_event *events;
    int count = carom_events(world, &events);

    for (int i = 0; i < count; i++) {
        if (events[i].kind == CAROM_EVENT_HIT) {
            return &events[i];
        }
    }
    return NULL;
}

/*
 * The lowest corner of the box at the hit, from its rotation before the step; and whether a second
 * corner is almost as low.
 */
static uint32_t lowest(const carom_quat_q30 *q, double at[3], bool *unsure)
{
    double m[3][3], turn[4], best = 1e9;
    uint32_t corner = 0;

    for (int k = 0; k < 4; k++) {
        turn[k] = real(q->c[k], 30);
    }
    real_matrix(m, turn);
    *unsure = false;
    for (uint32_t v = 0; v < 8; v++) {
        double p[3];

        for (int k = 0; k < 3; k++) {
            p[k] = 0;
            for (int i = 0; i < 3; i++) {
                p[k] += m[k][i] * box.vertices[v][i] / 4096.0;
            }
        }
        *unsure = p[2] < best ? best - p[2] < 0.02 : *unsure || p[2] - best < 0.02;
        if (p[2] < best) {
            best = p[2];
            corner = v;
            memcpy(at, p, sizeof p);
        }
    }
    return corner;
}

/*
 * The point is the lowest corner, on the floor; N points up; the floor's face has the point; the
 * box's face is the one at that corner that looks down most.
 */
static void test_floor(void)
{
    struct test_random r = {21};
    int seen = 0;

    for (int n = 0; n < 25; n++) {
        struct carom_body_state before;
        const struct carom_event *e = NULL;
        struct carom_matrix m;
        struct carom_stats stats;
        struct carom_hit hit;
        double corner[3];
        bool unsure;

        setup(2);
        def.rotation = shape_random_turn(&r);
        def.position.c[0] = test_random_range(&r, -((int64_t)10 << 32), (int64_t)10 << 32);
        def.position.c[1] = test_random_range(&r, -((int64_t)10 << 32), (int64_t)10 << 32);
        def.position.c[2] = (int64_t)2 << 32;
        CHECK_EQ(carom_body_add(world, &def), 1);
        lowest(&def.rotation, corner, &unsure);
        while (!e) {
            CHECK_EQ(carom_body_get(world, 1, &before), CAROM_OK);
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            e = hit_event();
        }
        CHECK_EQ(carom_stats(world, &stats), CAROM_OK);
        if (unsure || stats.hits > 1) {
            continue; /* a second hit in the frame may have had a larger impulse */
        }
        seen++;
        memset(&hit, 0, sizeof hit);
        CHECK_EQ(carom_event_hit(world, e, &hit), CAROM_OK);
        for (int k = 0; k < 2; k++) {
            double wanted = real(before.position.c[k], 32) + corner[k];

            CHECK_LESS(real_abs(real(hit.point.c[k], 32) - wanted), 0.001);
        }
        CHECK_LESS(real_abs(real(hit.point.c[2], 32)), 0.001);
        CHECK_NEAR(hit.normal.c[2], CAROM_ONE_Q30, 1 << 10);
        /* squares of 8 units from -16 on; either half of the square may have the point */
        CHECK_EQ(hit.face_b / 2,
                 ((hit.point.c[1] >> 32) + 16) / 8 * 4 + ((hit.point.c[0] >> 32) + 16) / 8);
        /* the box's face with the lowest normal is at the lowest corner */
        CHECK_EQ(carom_body_matrix(world, 1, &m), CAROM_OK);
        fix_matrix(&m.r, &def.rotation);
        for (uint32_t f = 0; f < 12; f++) {
            const carom_v3_q30 *a = &box.mesh.faces[f].normal,
                               *b = &box.mesh.faces[hit.face_a].normal;

            CHECK_AT_MOST(carom_dot(m.r.c[2], b->c),
                          carom_dot(m.r.c[2], a->c) + ((int64_t)1 << 50));
        }
    }
    CHECK_MORE(seen, 10);
}

/*
 * Events carry details while there is room; the others have none. The room is free again in the
 * next frame.
 */
static void test_room(void)
{
    for (uint32_t room = 0; room <= 2; room++) {
        int with = 0, hits = 0;

        setup(room);
        def.position.c[2] = (int64_t)2 << 32;
        for (int i = 1; i <= 2; i++) {
            def.position.c[0] = i * ((int64_t)6 << 32);
            CHECK_EQ(carom_body_add(world, &def), i);
        }
        for (int n = 0; n < 60; n++) {
            const struct carom_event *events;
            int count, kept = 0, now = 0;

            CHECK_EQ(carom_world_step(world), CAROM_OK);
            count = carom_events(world, &events);
            for (int i = 0; i < count; i++) {
                struct carom_hit hit;
                int result = carom_event_hit(world, &events[i], &hit);

                now += events[i].kind == CAROM_EVENT_HIT;
                CHECK_EQ(result, events[i].details > 0 ? CAROM_OK : CAROM_ERR_ARGUMENT);
                CHECK(events[i].kind == CAROM_EVENT_HIT || events[i].details == 0);
                kept += result == CAROM_OK;
            }
            CHECK_EQ(kept, now < (int)room ? now : (int)room);
            with += kept;
            hits += now;
        }
        CHECK_MORE(hits, 1);
        CHECK_EQ((with > 0), (room > 0));
    }
}

/* A stale event, another world's event, no event. */
static void test_refused(void)
{
    struct carom_event old;
    struct carom_hit hit;

    setup(2);
    def.position.c[2] = (int64_t)2 << 32;
    CHECK_EQ(carom_body_add(world, &def), 1);
    while (!hit_event()) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    old = *hit_event();
    CHECK_EQ(carom_event_hit(world, &old, &hit), CAROM_OK);
    CHECK_EQ(carom_event_hit(NULL, &old, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_event_hit(world, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_event_hit(world, &old, NULL), CAROM_ERR_NULL);
    old.details = 3;
    CHECK_EQ(carom_event_hit(world, &old, &hit), CAROM_ERR_ARGUMENT);
    old.details = 1;
    old.kind = CAROM_EVENT_BEGIN;
    CHECK_EQ(carom_event_hit(world, &old, &hit), CAROM_ERR_ARGUMENT);
    old.kind = CAROM_EVENT_HIT;
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(carom_event_hit(world, &old, &hit), CAROM_ERR_ARGUMENT);
}

/*
 * Two tetrahedra, tip over tip a little aside; the upper one starts from rest, and gravity alone takes it to the lower one within a
 * frame. Before that not even the spheres around them meet.
 */
static void test_tips(void)
{
    static struct shape tip;
    struct test_random r = {12};

    shape_tetrahedron(&tip, 12, 4096);
    for (int n = 0; n < 20; n++) {
        const int64_t up = CAROM_RATIO(test_random_range(&r, 2005, 2030), 1000, 32);
        const int64_t aside = CAROM_RATIO(test_random_range(&r, 1, 4), 1000, 32);
        const int lower = n % 2; /* the number of the lower one */
        const struct carom_event *event;

        setup(0);
        CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
        CHECK_EQ(carom_world_set_gravity(world, &(carom_v3_q40){{-ONE / 8, -ONE / 8, -ONE / 8}}),
                 CAROM_OK);
        for (int i = 0; i < 2; i++) {
            memset(&def, 0, sizeof def);
            def.mesh = &tip.mesh;
            def.stationary = i == lower;
            if (i != lower) {
                def.position = (carom_v3_q32){{up + aside, up - aside, up}};
                /* half a turn about (1, -1, 0): its tip is below */
                def.rotation = (carom_quat_q30){{0, 759250125, -759250125, 0}};
            }
            CHECK_EQ(carom_body_add(world, &def), i);
        }
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_events(world, &event), 1);
        CHECK_EQ(event->kind, CAROM_EVENT_BEGIN); /* a frame of gravity is no impact */
    }
}

const struct test tests_world_hits[] = {
    {"world_hits/floor", test_floor},
    {"world_hits/room", test_room},
    {"world_hits/refused", test_refused},
    {"world_hits/tips", test_tips},
    {0},
};

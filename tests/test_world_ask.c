/* SPDX-License-Identifier: MIT */
/* The contact callback: what it is told, and the effect of its answer. */
#include <string.h>

#include "lib/boxes.h"
#include "lib/real.h"

enum { PLATE, BOX, NEEDLE };

/* Orders for the callback, and what it was told. */
static struct said {
    int calls, body; /* contacts of this body are dropped; -1: none */
    bool changes;
    int32_t e_q30;
    uint32_t mu_q16;
    struct carom_touch first; /* a contact that approaches by more than 1/1024 unit a frame */
} said;

static bool answer(void *user, struct carom_touch *touch)
{
    struct said *s = user;

    s->calls++;
    if (touch->speed_q40 > BOXES_Q40(1) && s->first.speed_q40 == 0) {
        s->first = *touch;
    }
    if (s->changes) {
        touch->restitution_q30 = s->e_q30;
        touch->friction_q16 = s->mu_q16;
    }
    return touch->a != s->body && touch->b != s->body;
}

static struct carom_world *make(int number, bool asks, int32_t e_q30, uint32_t mu_q16)
{
    struct carom_world *w;
    struct carom_body_def def;

    boxes_begin();
    boxes_config.caps.contacts = 64; /* includes the room of an extra */
    boxes_config.caps.extras = 1;
    boxes_make(PLATE, 2048, 2048, 128);
    boxes_make(BOX, 256, 200, 150);
    memset(&said, 0, sizeof said);
    said.body = -1;
    if (asks) {
        boxes_config.contact = answer;
        boxes_config.contact_user = &said;
    }
    w = boxes_world(number);
    def = boxes_def(PLATE, 0, 0, 0);
    def.stationary = true;
    def.restitution_q30 = e_q30;
    def.friction_q16 = mu_q16;
    CHECK_EQ(boxes_add(w, &def), 0);
    def = boxes_def(BOX, 30, 20, 400);
    def.restitution_q30 = e_q30;
    def.friction_q16 = mu_q16;
    def.velocity = (carom_v3_q40){{BOXES_Q40(4), 0, BOXES_Q40(-10)}};
    CHECK_EQ(boxes_add(w, &def), 1);
    return w;
}

/*
 * One face falls on another: four corners, at the height of the plate's face, with the speed of the
 * box.
 */
static void test_told(void)
{
    struct carom_world *w = make(0, true, 0, 1 << 15);
    int64_t fall_q40;

    do {
        fall_q40 = -boxes_state(w, 1).velocity.c[2];
        boxes_step(w, 1);
    } while (said.first.speed_q40 == 0 && fall_q40 < BOXES_Q40(100));
    CHECK_EQ(said.first.a, 1);
    CHECK_EQ(said.first.b, 0);
    CHECK_EQ(said.first.normal.c[2], CAROM_ONE_Q30);
    CHECK_NEAR(said.first.point.c[2], BOXES_Q32(128), BOXES_Q32(1));
    /* the box gains at most g within the frame */
    CHECK_AT_LEAST(said.first.speed_q40, fall_q40);
    CHECK_AT_MOST(said.first.speed_q40, fall_q40 - boxes_config.gravity.c[2] + 1000);
    /* boxes.c: the top faces are 6 and 7; each of their corners is up there */
    for (int k = 0; k < 3; k++) {
        const struct carom_mesh_raw *plate = &boxes_mesh[PLATE].raw, *box = &boxes_mesh[BOX].raw;

        CHECK_EQ(plate->vertices[plate->faces[said.first.face_b][k]][2], 128);
        CHECK_EQ(box->vertices[box->faces[said.first.face_a][k]][2], -150);
    }
    CHECK_EQ(said.first.restitution_q30, 0);
    CHECK_EQ(said.first.friction_q16, 1 << 15);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_HIT, 1, 0), 1);
}

/*
 * A changed e and mu act like those of the bodies, bit for bit; a callback that keeps everything
 * changes nothing.
 */
static void test_changed(void)
{
    for (int kind = 0; kind < 3; kind++) {
        int32_t e_q30 = kind == 1 ? CAROM_ONE_Q30 / 2 : 0;
        uint32_t mu_q16 = kind == 2 ? 1 << 14 : 1 << 16;
        struct carom_world *own = make(0, false, e_q30, mu_q16), *w;

        w = kind == 0 ? make(1, true, 0, 1 << 16) : make(1, true, CAROM_ONE_Q30 / 8, 3 << 12);
        said.changes = kind > 0;
        said.e_q30 = e_q30;
        said.mu_q16 = mu_q16;
        for (int frame = 0; frame < 60; frame++) {
            struct carom_body_state one, other;

            boxes_step(own, 1);
            boxes_step(w, 1);
            one = boxes_state(own, 1);
            other = boxes_state(w, 1);
            CHECK(boxes_same(&one, &other));
        }
        CHECK_MORE(said.calls, 20);
    }
}

/*
 * A snapshot holds whatever friction the callback has chosen: bodies without friction slide on a
 * plate that answers with mu 4.
 */
static void test_saved(void)
{
    static uint8_t saved[8192];
    struct carom_world *w = make(0, true, 0, 0);
    const carom_v3_q40 weight = {{0, 0, BOXES_Q40(-200)}};
    struct carom_body_state state;
    int loads = 0;

    said.changes = true;
    said.mu_q16 = 4 << 16;
    CHECK_EQ(carom_world_set_gravity(w, &weight), CAROM_OK);
    boxes_step(w, 10); /* the box lies on the plate by now */
    state = boxes_state(w, 1);
    state.velocity.c[0] = BOXES_Q40(700);
    CHECK_EQ(carom_body_set(w, 1, &state), CAROM_OK);
    for (int frame = 0; frame < 60; frame++) {
        int size = carom_snapshot_save(w, saved, sizeof saved);

        CHECK_MORE(size, 0);
        loads += size > 0 && carom_snapshot_load(w, saved, (size_t)size) == CAROM_OK;
        boxes_step(w, 1);
    }
    CHECK_EQ(loads, 60);
    CHECK_NEAR(boxes_state(w, 1).velocity.c[0], 0, BOXES_Q40(1)); /* so friction did act */
}

/* A box whose contacts are dropped falls through and takes no hits; the other box stays. */
static void test_dropped(void)
{
    struct carom_world *w = make(0, true, 0, 1 << 15);
    struct carom_body_def def = boxes_def(BOX, 1000, 0, 400);
    int other = boxes_add(w, &def), calls;

    said.body = 1;
    for (int frame = 0; frame < 50; frame++) {
        calls = said.calls;
        boxes_step(w, 1); /* CAROM_OK: no frame is cut short */
        CHECK_LESS(said.calls - calls, 40);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_HIT, 1, 0), 0);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_BEGIN, 1, 0), 0);
    }
    /* free fall: 10 a frame and g n (n + 1) / 2; paths that end early are rounded, and gravity is
     * exact */
    CHECK_NEAR(boxes_state(w, 1).velocity.c[2], BOXES_Q40(-10) + 50 * boxes_config.gravity.c[2],
               100000);
    CHECK_NEAR(boxes_state(w, 1).velocity.c[0], BOXES_Q40(4), 1000);
    CHECK_MORE(boxes_state(w, other).position.c[2], BOXES_Q32(128));
}

/* Half sides of the needle, 2^-10 units. */
static const int needle[3] = {900, 20, 6};

/* Kinetic energy of the needle, whose mass is 1: its inertia about an axis is a third of the squares of the other half sides. */
static double energy_of(const struct carom_world *w, int body)
{
    const struct carom_body_state s = boxes_state(w, body);
    double m[3][3], q[4], spin[3], own[3], v[3], square[3], sum = 0;

    for (int k = 0; k < 4; k++) {
        q[k] = real(s.rotation.c[k], 30);
    }
    for (int k = 0; k < 3; k++) {
        spin[k] = real(s.spin.c[k], 40);
        v[k] = real(s.velocity.c[k], 40);
        square[k] = real(needle[k], 10) * real(needle[k], 10);
    }
    real_matrix(m, q);
    real_rotate_back(own, m, spin);
    for (int k = 0; k < 3; k++) {
        sum += own[k] * own[k] * (square[(k + 1) % 3] + square[(k + 2) % 3]) / 3;
    }
    return (sum + real_dot(v, v)) / 2;
}

/*
 * Boxes fly through a needle that tumbles, and it leaves its path for each contact that is dropped:
 * between the ends of a slice a turn does not keep the energy. It gains no more than 2^-20 of it in a
 * frame, though nothing touches it.
 */
static void tumble(int spin_x)
{
    struct carom_world *w = make(0, true, 0, 1 << 15);
    struct carom_body_def def;

    CHECK_EQ(carom_world_set_gravity(w, &(carom_v3_q40){{0, 0, 0}}), CAROM_OK);
    CHECK_EQ(carom_body_remove(w, 1), CAROM_OK);
    boxes_make(NEEDLE, needle[0], needle[1], needle[2]);
    def = boxes_def(NEEDLE, 0, 0, 1500);
    def.mass_q20 = 1 << 20;
    def.spin = (carom_v3_q40){{BOXES_Q40(spin_x), BOXES_Q40(1500), BOXES_Q40(459)}};
    said.body = boxes_add(w, &def);
    for (int i = 0; i < 4; i++) {
        int side = i & 1 ? -1 : 1, way = side * (1300 + 500 * i);

        def = boxes_def(BOX, i < 2 ? way : 0, i < 2 ? 0 : way, 1500 + 100 * i);
        def.velocity.c[i / 2] = BOXES_Q40(-side * (150 + 17 * i));
        def.spin = (carom_v3_q40){{BOXES_Q40(900), BOXES_Q40(700), BOXES_Q40(-500)}};
        (void)boxes_add(w, &def);
    }
    for (int frame = 0; frame < 50; frame++) {
        double before = energy_of(w, said.body), gained;

        boxes_step(w, 1);
        gained = energy_of(w, said.body) - before;
        CHECK_LESS(real_round(gained / before * real_power2(40)), (int64_t)1 << 20);
    }
    CHECK_MORE(said.calls, 4);
}

static void test_tumbling(void)
{
    tumble(2500);
    tumble(-4300);
}

static void test_needs(void)
{
    struct carom_world *w = NULL;
    static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(1, 1, 1, 1, 0, 1)];
    struct carom_config config = {.caps = CAROM_CAPS(1, 1, 1, 1, 0, 1), .contact = answer};

    CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_ERR_ARGUMENT);
    config.contact = NULL;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_OK);
}

const struct test tests_world_ask[] = {{"world_ask/told", test_told},
                                       {"world_ask/changed", test_changed},
                                       {"world_ask/saved", test_saved},
                                       {"world_ask/dropped", test_dropped},
                                       {"world_ask/tumbling", test_tumbling},
                                       {"world_ask/needs", test_needs},
                                       {0}};

/* SPDX-License-Identifier: MIT */
/*
 * Parts of a step, called by hand in states that a scene seldom has: an island that has nothing to give back, others that came to its
 * place, a kinematic body that carries a pile, hits of sleepers, a full list of events.
 */
#include <string.h>

#include "carom_shapes.h"
#include "lib/boxes.h"
#include "step/parts.h"

enum { FLAT, CUBE, ROD };
enum { GROUND, A, B, C, D };

static struct carom_world *world;
static struct step step;

/* Room for kinematic bodies, a flat box of half sides 8000, 8000 and 100, and cubes of half side 100. */
static void begin(void)
{
    boxes_begin();
    boxes_make(FLAT, 8000, 8000, 100);
    boxes_make(CUBE, 100, 100, 100);
    boxes_config.caps.extras = BOXES_EXTRAS;
    world = boxes_world(0);
}

static void add_ground(void)
{
    struct carom_body_def def = boxes_def(FLAT, 0, 0, 0);

    def.stationary = true;
    CHECK_EQ(boxes_add(world, &def), GROUND);
}

static int add_cube(int x, int z)
{
    const struct carom_body_def def = boxes_def(CUBE, x, 0, z);

    return boxes_add(world, &def);
}

/* Begin a step, up to its first solve. */
static void start(void)
{
    step_begin(&step, world);
    CHECK_EQ(step_begin_regions(&step), CAROM_OK);
    CHECK_EQ(step_start_contacts(&step), CAROM_OK);
}

static uint32_t pair_of(uint16_t a, uint16_t b)
{
    const uint32_t number = step_find_pair(world, &(struct pair){a, b});

    CHECK_LESS(number, world->pools[CAROM_POOL_pairs].used);
    return number;
}

static bool as_before(int body)
{
    return memcmp(&step.next->bodies[body], &world->now->bodies[body], sizeof *step.next->bodies) ==
           0;
}

/*
 * A has come up by a unit and has hardly any motion: it goes back and stops. C, which touches it, has left the world up there: it goes
 * back as well, and stays out. A kinematic body, B, has come to where A was: it goes back, too, and is blocked, which is told once. D may
 * pass A and stays.
 */
static void climbed(void)
{
    for (int again = 0; again < 2; again++) {
        struct carom_body_def def = boxes_def(CUBE, -2000, 0, 200);
        struct body_state d;

        begin();
        add_ground();
        CHECK_EQ(add_cube(0, 200), A);
        def.kinematic = true;
        def.velocity.c[0] = BOXES_Q40(2000);
        CHECK_EQ(boxes_add(world, &def), B);
        CHECK_EQ(add_cube(220, 200), C);
        CHECK_EQ(add_cube(2000, 200), D);
        step_begin(&step, world);
        step.next->bodies[A].position.c[2] += BOXES_Q32(1024);
        step.next->bodies[A].momentum.c[0] = 1000;
        step.next->bodies[B].position = world->now->bodies[A].position;
        step.next->bodies[C].out = 1;
        step.next->bodies[C].position.c[2] += BOXES_Q32(1024);
        step.next->bodies[D].position = world->now->bodies[A].position;
        world->pairs[0] = (struct pair){D, A};
        world->pools[CAROM_POOL_pairs].used = 1;
        memset(&world->meetings[0], 0, sizeof world->meetings[0]);
        world->meetings[0].passes = 1;
        CHECK_EQ(step_note_touching(&step, &(struct pair){A, GROUND}), CAROM_OK);
        CHECK_EQ(step_note_touching(&step, &(struct pair){C, A}), CAROM_OK);
        world->bodies[B].def.extra->blocked = again;
        d = step.next->bodies[D];
        step_limit_energy(&step);
        CHECK(as_before(A));
        CHECK(as_before(B));
        CHECK(step.next->bodies[C].out);
        step.next->bodies[C].out = 0;
        CHECK(as_before(C));
        CHECK_EQ(memcmp(&d, &step.next->bodies[D], sizeof d), 0);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_BLOCKED, B, A), !again);
        CHECK(world->bodies[B].def.extra->blocked);
    }
}

/* Twice the kinetic energy of two bodies of mass 1 that do not turn, with 32 fractional bits. */
static int64_t moving2_q32(const struct body_state state[2])
{
    int64_t sum = 0;

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            int64_t v_q16 = state[i].momentum.c[k] >> 24;

            sum += v_q16 * v_q16;
        }
    }
    return sum;
}

/*
 * Two cubes of 2^-9 of a unit, 60 units apart, count as touching and have gained energy. About the line through both they have no
 * inertia that 30 bits would show, so they have no motion as one rigid body: all of their motion gives what they gained.
 */
static void in_a_line(void)
{
    struct carom_body_def def = boxes_def(CUBE, -30720, 0, 0);
    int64_t before;

    begin();
    boxes_make(CUBE, 1, 1, 1);
    def.mass_q20 = 1 << 20;
    def.velocity.c[0] = BOXES_Q40(100);
    CHECK_EQ(boxes_add(world, &def), 0);
    def.position.c[0] = BOXES_Q32(30720);
    CHECK_EQ(boxes_add(world, &def), 1);
    step_begin(&step, world);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            step.next->bodies[i].momentum.c[k] += BOXES_Q40(50 + i);
        }
    }
    CHECK_EQ(step_note_touching(&step, &(struct pair){1, 0}), CAROM_OK);
    before = moving2_q32(world->now->bodies);
    CHECK_LESS(before + before / 2, moving2_q32(step.next->bodies));
    step_limit_energy(&step);
    CHECK_LESS(moving2_q32(step.next->bodies), before + 1);
    CHECK_LESS(before - before / 1000, moving2_q32(step.next->bodies));
    CHECK_EQ(step.next->bodies[0].momentum.c[1], step.next->bodies[0].momentum.c[2]);
}

/* A kinematic plate, as body 0, and two cubes on it, at a corner or in the middle. */
static void pile_on(int at, double vx, double vy, double spin)
{
    struct carom_body_def def = boxes_def(FLAT, 0, 0, 0);

    begin();
    def.kinematic = true;
    def.velocity.c[0] = (int64_t)(vx * (double)BOXES_Q40(1024));
    def.velocity.c[1] = (int64_t)(vy * (double)BOXES_Q40(1024));
    def.spin.c[2] = (int64_t)(spin * (double)BOXES_Q40(1024));
    CHECK_EQ(boxes_add(world, &def), GROUND);
    def = boxes_def(CUBE, at, at, 200);
    def.friction_q16 = 0;
    CHECK_EQ(boxes_add(world, &def), A);
    def.position.c[2] += BOXES_Q32(200);
    CHECK_EQ(boxes_add(world, &def), B);
    start();
    CHECK_EQ(world->bodies[A].island.lowest, world->bodies[B].island.lowest);
}

/*
 * The pile goes along with the plate: both cubes have its velocity. It does not with a plate that stands, nor with one whose corner
 * turns so fast that a cube there would be faster than the limit of 64.
 */
static void carried(void)
{
    pile_on(0, 0.25, 0, 0);
    CHECK(step_carry_island(&step, world->bodies[A].island.lowest, false));
    for (int i = A; i <= B; i++) {
        struct body_state *s = &step.next->bodies[i];
        carom_v3_q40 v;

        body_velocity(&world->bodies[i], s, &v);
        CHECK_NEAR(v.c[0], BOXES_Q40(256), 1 << 12);
        CHECK_EQ(v.c[1], 0);
        CHECK_EQ(v.c[2], 0);
    }
    for (int fast = 0; fast < 2; fast++) {
        struct body_state before[2];

        /* radius 11.05: 30.6 + 3 * 11.05 = 63.75, and a cube adds 3 * 0.17 */
        pile_on(fast ? 8000 : 0, fast ? -21.64 : 0.25, fast ? 21.64 : 0, fast ? 3 : 0);
        world->bodies[GROUND].clock.stands = !fast;
        memcpy(before, &step.next->bodies[A], sizeof before);
        CHECK(!step_carry_island(&step, world->bodies[A].island.lowest, false));
        CHECK_EQ(memcmp(before, &step.next->bodies[A], sizeof before), 0);
    }
}

/*
 * The features of a hit do not face each other at its time, and one of its bodies sleeps: it sleeps on. The other one counts the hit, is
 * not held up, though it was the sixth in a row, and the count of a row ends at 127.
 */
static void asleep(void)
{
    for (int n = 0; n < 4; n++) {
        const int sleeper = n % 2 ? A : B, other = n % 2 ? B : A;
        struct carom_body_def def = boxes_def(CUBE, 0, 0, 600);
        struct pair_work *m;
        carom_v3_q40 v;

        begin();
        add_ground();
        for (int i = A; i <= B; i++) {
            def.position.c[0] = BOXES_Q32(i == sleeper ? 0 : 201);
            def.velocity.c[1] = i == sleeper ? 0 : BOXES_Q40(10);
            CHECK_EQ(boxes_add(world, &def), i);
        }
        world->states[0].bodies[sleeper].asleep = world->states[1].bodies[sleeper].asleep = 1;
        start();
        for (int i = A; i <= B; i++) {
            if (i == other) {
                CHECK_EQ(step_set_path(&step, (uint32_t)i), CAROM_OK);
            }
        }
        m = &world->meetings[pair_of(B, A)];
        m->kind = CANDIDATE_VERTEX_FACE;
        m->hit_q30 = m->answered_q30 = CAROM_ONE_Q30 / 2;
        m->root_q30 = CAROM_ONE_Q30 / 2 + 1000;
        m->repeats = n / 2 ? 127 : 5;
        CHECK_EQ(step_answer(&step, pair_of(B, A)), CAROM_OK);
        CHECK_EQ(world->meetings[pair_of(B, A)].repeats, n / 2 ? 127 : 6);
        CHECK(as_before(sleeper));
        CHECK_EQ(world->bodies[sleeper].clock.events, 0);
        CHECK_EQ(world->bodies[other].clock.events, 1);
        body_velocity(&world->bodies[other], &step.next->bodies[other], &v);
        CHECK_NEAR(v.c[1], BOXES_Q40(10), 1 << 12);
        /* half a frame of gravity */
        CHECK_NEAR(v.c[2], CAROM_GRAVITY_MM_S2(-9810, 60) / 2, 1 << 12);
    }
}

/*
 * The lower cube hits the plate again and again at one time: the pile goes along with the plate for so many repeats, and at the next
 * one the plate stops.
 */
static void again_and_again(void)
{
    for (int stops = 0; stops < 2; stops++) {
        struct pair_work *m;
        carom_v3_q40 v;

        pile_on(0, 0.25, 0, 0);
        for (uint32_t i = GROUND; i <= B; i++) {
            CHECK_EQ(step_set_path(&step, i), CAROM_OK);
        }
        m = &world->meetings[pair_of(A, GROUND)];
        m->kind = CANDIDATE_VERTEX_FACE;
        m->hit_q30 = m->answered_q30 = CAROM_ONE_Q30 / 2;
        m->root_q30 = CAROM_ONE_Q30 / 2 + 1000;
        m->repeats = stops ? STEP_HARD_AFTER : STEP_HARD_AFTER - 1;
        CHECK_EQ(step_answer(&step, pair_of(A, GROUND)), CAROM_OK);
        CHECK_EQ(world->bodies[GROUND].def.extra->blocked, stops);
        body_velocity(&world->bodies[A], &step.next->bodies[A], &v);
        CHECK_NEAR(v.c[0], stops ? 0 : BOXES_Q40(256), 1 << 12);
    }
}

/*
 * A cube goes along with a kinematic plate. Another cube hits it from beside, which is its last hit of the frame, so it stands. A
 * plate that comes up stops with it; one that slides away below it goes on.
 */
static void stands_on(void)
{
    for (int up = 0; up < 2; up++) {
        struct carom_body_def def = boxes_def(FLAT, 0, 0, 0);

        begin();
        boxes_config.substep_cap = 1;
        world = boxes_world(0);
        def.kinematic = true;
        def.velocity.c[up ? 2 : 1] = BOXES_Q40(64);
        CHECK_EQ(boxes_add(world, &def), GROUND);
        def = boxes_def(CUBE, 0, 0, 200);
        def.velocity.c[up ? 2 : 1] = BOXES_Q40(64);
        CHECK_EQ(boxes_add(world, &def), A);
        def.position.c[0] = BOXES_Q32(400);
        def.velocity.c[0] = BOXES_Q40(-400);
        CHECK_EQ(boxes_add(world, &def), B);
        CHECK_EQ(carom_world_step(world), CAROM_SUBSTEP_CAP);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_HIT, B, A), 1);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_BLOCKED, GROUND, A), up);
        CHECK_NEAR(boxes_state(world, GROUND).position.c[up ? 2 : 1], BOXES_Q32(up ? 32 : 64),
                   BOXES_Q32(1));
    }
}

/* The list of events holds so many, and forgets others. */
static void events(void)
{
    const struct carom_event *e;
    int most;

    begin();
    most = (int)(3 * boxes_config.caps.pairs + 2 * boxes_config.caps.bodies +
                 boxes_config.caps.joints);
    for (int i = 0; i < most + 3; i++) {
        step_add_event(world, CAROM_EVENT_WAKE, (uint16_t)i, 0);
    }
    CHECK_EQ(carom_events(world, &e), most);
    for (int i = 0; i < most; i++) {
        CHECK_EQ(e[i].a, i);
    }
}

/* A step whose only body has this velocity and spin, in units and radians a frame. */
static struct body_state *begin_leaving(struct step *s, int velocity, int spin)
{
    struct carom_body_def def;
    struct body_state *state;

    begin();
    boxes_make(ROD, 6 * 64, 64, 64);
    world = boxes_world(0);
    def = boxes_def(ROD, 0, 0, 0);
    def.spin.c[0] = (int64_t)1 << 40;
    def.velocity.c[1] = (int64_t)1 << 40;
    CHECK_EQ(boxes_add(world, &def), 0);
    step_begin(s, world);
    state = &s->next->bodies[0];
    state->momentum.c[1] *= velocity;
    state->angular.c[0] *= spin;
    return state;
}

/*
 * A body that leaves the world keeps the momenta it leaves with, halved together until they are in
 * range: 200 units a frame become 50, and a spin of 12 becomes 3.
 */
static void leaves(void)
{
    struct step s;
    struct body_state *state = begin_leaving(&s, 200, 12);
    carom_v3_q40 velocity, spin;
    carom_m3_q30 r;

    state->position.c[2] += 5;
    CHECK(step_retire(&s, 0));
    CHECK(state->out);
    CHECK_EQ(state->position.c[2], world_now(world)->bodies[0].position.c[2] + 5);
    body_velocity(&world->bodies[0], state, &velocity);
    fix_matrix(&r, &state->rotation);
    body_spin(&world->bodies[0], state, &r, &spin);
    CHECK_NEAR(velocity.c[1], (int64_t)50 << 40, (int64_t)1 << 20);
    CHECK_NEAR(spin.c[0], (int64_t)3 << 40, (int64_t)1 << 20);
    CHECK(!step_retire(&s, 0));
}

/* A body whose place is out of range leaves as it was when the frame began. */
static void leaves_from(void)
{
    struct step s;
    struct body_state *state = begin_leaving(&s, 2, 2);

    state->position.c[0] = (int64_t)5000 << 32;
    CHECK(step_retire(&s, 0));
    CHECK(state->out);
    CHECK_EQ(
        memcmp(&state->position, &world_now(world)->bodies[0].position, sizeof state->position), 0);
    CHECK_EQ(
        memcmp(&state->momentum, &world_now(world)->bodies[0].momentum, sizeof state->momentum), 0);
    CHECK_EQ(memcmp(&state->angular, &world_now(world)->bodies[0].angular, sizeof state->angular),
             0);
}

/*
 * A heavy cube has one hit, with a light one, which would be faster than the limit of 64: it leaves the world where it was. The heavy
 * one stands there for the rest of the frame.
 */
static void thrown_out(void)
{
    struct carom_body_def def;
    struct carom_body_state s;

    begin();
    boxes_config.gravity.c[2] = 0;
    boxes_config.substep_cap = 1;
    world = boxes_world(0);
    def = boxes_def(CUBE, 0, 0, 0);
    def.restitution_q30 = CAROM_ONE_Q30;
    def.mass_q20 = 1 << 10;
    CHECK_EQ(boxes_add(world, &def), 0);
    def.position.c[0] = BOXES_Q32(-20480);
    def.velocity.c[0] = BOXES_Q40(40960); /* 40 units a frame, and twice as fast after the hit */
    def.mass_q20 = 1 << 30;
    CHECK_EQ(boxes_add(world, &def), 1);
    CHECK_EQ(carom_world_step(world), CAROM_SUBSTEP_CAP);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_OUT, 0, 0), 1);
    s = boxes_state(world, 0);
    CHECK(s.out);
    CHECK_EQ(s.position.c[0], 0);
    s = boxes_state(world, 1);
    CHECK(!s.out);
    CHECK_NEAR(s.position.c[0], BOXES_Q32(-200), BOXES_Q32(1));
}

/*
 * Two cubes sleep on the ground, and a third comes to lie elsewhere: that is one pair more than there is room for, which shows where
 * the events are made. With a sensor in the world it is an error, too, and nothing changes.
 */
static void full_at_the_end(void)
{
    struct carom_body_def def;
    uint64_t hash = 0;
    int result = CAROM_OK;

    begin();
    boxes_config.caps.pairs = 2;
    world = boxes_world(0);
    add_ground();
    CHECK_EQ(add_cube(-500, 200), A);
    CHECK_EQ(add_cube(500, 200), B);
    boxes_step(world, 35);
    CHECK(boxes_state(world, A).asleep && boxes_state(world, B).asleep);
    def = boxes_def(CUBE, 20000, 0, 0);
    def.stationary = true;
    CHECK_EQ(boxes_add(world, &def), C);
    def.sensor = true;
    def.position.c[0] = BOXES_Q32(40000);
    CHECK_EQ(boxes_add(world, &def), D);
    (void)add_cube(20000, 220);
    for (int i = 0; i < 60 && result == CAROM_OK; i++) {
        hash = carom_world_hash(world);
        result = carom_world_step(world);
    }
    CHECK_EQ(result, CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(carom_world_hash(world), hash);
}

/* The features of a hit with a one-way ground do not face each other: no side can be told, and the pair does not pass. */
static void no_side(void)
{
    struct carom_body_def def = boxes_def(FLAT, 0, 0, 0);
    uint32_t number;

    begin();
    def.stationary = true;
    def.one_way = CAROM_ONE_WAY_Z;
    CHECK_EQ(boxes_add(world, &def), GROUND);
    CHECK_EQ(add_cube(0, 200), A);
    start();
    CHECK_EQ(step_set_path(&step, A), CAROM_OK);
    number = pair_of(A, GROUND);
    world->meetings[number].kind = CANDIDATE_VERTEX_FACE;
    world->meetings[number].i = 7; /* the top of the cube */
    world->meetings[number].hit_q30 = CAROM_ONE_Q30 / 2;
    world->meetings[number].root_q30 = CAROM_ONE_Q30 / 2;
    CHECK(!step_let_pass(&step, number));
    CHECK(!world->meetings[number].passes);
    CHECK_EQ(world->meetings[number].hit_q30, CAROM_ONE_Q30 / 2);
}

#ifdef TEST_LONG
#define SIDES 36
/*
 * A ball of 1224 faces flies to another one, which sleeps: so many pairs of faces that candidates for regions of several frames cost
 * much. They meet when the gap is used up; then both are awake, and no momentum is lost.
 */
static void many_faces(void)
{
    static int16_t vertices[CAROM_SPHERE_VERTICES(SIDES)][3];
    static uint16_t faces[CAROM_SPHERE_FACES(SIDES)][3];
    static _Alignas(8)
        uint8_t block[CAROM_MESH_BYTES(CAROM_SPHERE_VERTICES(SIDES), CAROM_SPHERE_FACES(SIDES))];
    const struct carom_shape_room room = {vertices, faces, CAROM_SPHERE_VERTICES(SIDES),
                                          CAROM_SPHERE_FACES(SIDES), 10};
    struct carom_body_def def = boxes_def(CUBE, 0, 0, 0);
    struct carom_mesh_raw raw;
    struct carom_mesh ball;
    int hits = 0, frame = 0;

    begin();
    boxes_config.gravity.c[2] = 0;
    world = boxes_world(0);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1000, SIDES), CAROM_OK);
    CHECK_EQ(carom_mesh_build(&ball, &raw, block, sizeof block), CAROM_OK);
    def.mesh = &ball;
    def.mass_q20 = 1 << 20;
    def.friction_q16 = 0;
    def.velocity.c[0] = BOXES_Q40(100);
    CHECK_EQ(boxes_add(world, &def), 0);
    def.velocity.c[0] = 0;
    def.position = (carom_v3_q32){{BOXES_Q32(4450), BOXES_Q32(30), BOXES_Q32(20)}};
    CHECK_EQ(boxes_add(world, &def), 1);
    world->states[0].bodies[1].asleep = world->states[1].bodies[1].asleep = 1;
    for (int i = 0; i < 2; i++) { /* regions last where any bodies are near each other */
        def = boxes_def(CUBE, 0, 5000 + 201 * i, 0);
        def.velocity.c[0] = BOXES_Q40(10);
        (void)boxes_add(world, &def);
    }
    while (hits == 0 && frame < 40) {
        boxes_step(world, 1);
        hits = boxes_events(world, CAROM_EVENT_HIT, 1, 0);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, 1, 0), hits);
        frame++;
    }
    CHECK_EQ(frame, 25); /* 2450 of 100 each */
    CHECK_NEAR(boxes_state(world, 0).velocity.c[0] + boxes_state(world, 1).velocity.c[0],
               BOXES_Q40(100), 1 << 12);
    CHECK_LESS(boxes_state(world, 0).velocity.c[0], BOXES_Q40(60));
}
#endif

/*
 * Balls of 48 faces turn by 1/32 of a radian each, or by some times that. A part may hold a sixteenth in all, so one part is enough for
 * both; more turns have as many parts as they need, or one more.
 */
static void turns_in_parts(void)
{
    enum { SIDES_FEW = 8 };
    static int16_t vertices[CAROM_SPHERE_VERTICES(SIDES_FEW)][3];
    static uint16_t faces[CAROM_SPHERE_FACES(SIDES_FEW)][3];
    static _Alignas(8) uint8_t
        block[CAROM_MESH_BYTES(CAROM_SPHERE_VERTICES(SIDES_FEW), CAROM_SPHERE_FACES(SIDES_FEW))];
    const struct carom_shape_room room = {vertices, faces, CAROM_SPHERE_VERTICES(SIDES_FEW),
                                          CAROM_SPHERE_FACES(SIDES_FEW), 10};
    struct carom_body_def def = boxes_def(CUBE, 0, 0, 0);
    struct carom_mesh_raw raw;
    struct carom_mesh ball;

    begin();
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1000, SIDES_FEW), CAROM_OK);
    CHECK_EQ(carom_mesh_build(&ball, &raw, block, sizeof block), CAROM_OK);
    def.mesh = &ball;
    CHECK_EQ(boxes_add(world, &def), 0);
    def.position.c[0] = BOXES_Q32(2010);
    CHECK_EQ(boxes_add(world, &def), 1);
    start();
    for (int turns = 0; turns < 64; turns++) {
        const int each[2] = {turns % 8, turns / 8};

        for (int i = 0; i < 2; i++) { /* u is half of the turn */
            world->bodies[i].path.turns = each[i] > 0;
            world->bodies[i].path.u2_q30 = each[i] * each[i] << 18;
        }
        if (each[0] <= 1 && each[1] <= 1) {
            CHECK_EQ(step_parts(&step, pair_of(1, 0)), 1);
        } else {
            CHECK_AT_LEAST(2 * step_parts(&step, pair_of(1, 0)), each[0] + each[1]);
            CHECK_AT_MOST(2 * step_parts(&step, pair_of(1, 0)), each[0] + each[1] + 2);
        }
    }
}

/* Two rods lie end to end, so their centres are as far apart as both radii and a gap: they touch within five skins. */
static void end_to_end(void)
{
    for (int gap = 1; gap <= 9; gap += 2) { /* of eighths */
        struct carom_body_def def;
        int64_t skin_q32;
        int touch;

        begin();
        boxes_config.gravity = (carom_v3_q40){{0}};
        world = boxes_world(0);
        boxes_make(CUBE, 1000, 20, 20);
        def = boxes_def(CUBE, 0, 0, 0);
        CHECK_EQ(boxes_add(world, &def), 0);
        skin_q32 = carom_shl(world->bodies[0].def.skin_q22, 10);
        def.position.c[0] = BOXES_Q32(2000) + gap * skin_q32 * 3 / 4;
        CHECK_EQ(boxes_add(world, &def), 1);
        boxes_step(world, 1);
        touch = boxes_events(world, CAROM_EVENT_BEGIN, 1, 0);
        CHECK_EQ(touch, gap * 3 < 5 * 4);
    }
}

const struct test tests_step[] = {
    {"step/climbed", climbed},
    {"step/in_a_line", in_a_line},
    {"step/carried", carried},
    {"step/asleep", asleep},
    {"step/again_and_again", again_and_again},
    {"step/stands_on", stands_on},
    {"step/events", events},
    {"step/leaves", leaves},
    {"step/leaves_from", leaves_from},
    {"step/thrown_out", thrown_out},
    {"step/full_at_the_end", full_at_the_end},
    {"step/no_side", no_side},
    {"step/turns_in_parts", turns_in_parts},
    {"step/end_to_end", end_to_end},
#ifdef TEST_LONG
    {"step/many_faces", many_faces},
#endif

    {0},
};

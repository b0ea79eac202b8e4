/* SPDX-License-Identifier: MIT */
/*
 * Groups of joints within a frame: one that stands since it has had its last hit and is hit once more, and one that comes near to
 * another body just where a slice ends.
 */
#include "lib/jointed.h"
#include "lib/real.h"
#include "step/parts.h"

enum { WALL, A, B, C };

static struct step step;

/* A world without gravity, with a cap of hits, and a stationary box at a place. */
static void begin(uint8_t cap, int64_t x, int64_t z)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .substep_cap = cap};

    setup(0);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    def.stationary = true;
    CHECK_EQ(add(x, 0, z), WALL);
    def.stationary = false;
}

/* Two boxes side by side along y, as one body. */
static void add_group(void)
{
    struct carom_joint_def j;

    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(0, UNIT, 0), B);
    j = joint(CAROM_JOINT_FIXED, A, B, 0, UNIT / 2, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
}

/* A group is stopped by a wall at z = 3/4, as it has one hit. Later in the frame another box hits it: all stand where they are. */
static void test_stands(void)
{
    begin(1, 0, UNIT);
    def.velocity.c[2] = ONE;
    add_group();
    CHECK_EQ(carom_body_set_filter(world, B, &(struct carom_filter){1, 0xffff, -1}), CAROM_OK);
    CHECK_EQ(carom_body_set_filter(world, WALL, &(struct carom_filter){1, 0xffff, -1}), CAROM_OK);
    def.velocity.c[2] = 0;
    def.velocity.c[1] = -ONE;
    CHECK_EQ(add(0, UNIT + UNIT / 2 + UNIT * 9 / 10, UNIT * 3 / 4), C); /* nine tenths from B */
    CHECK_EQ(carom_world_step(world), CAROM_SUBSTEP_CAP);
    CHECK_EQ(events_of(CAROM_EVENT_HIT, A, WALL), 1);
    CHECK_EQ(events_of(CAROM_EVENT_HIT, C, B), 1);
    for (int i = A; i <= C; i++) {
        const struct carom_body_state s = state_of(i);
        const int64_t y = i == A ? 0 : i == B ? UNIT : UNIT * 3 / 2;

        CHECK_NEAR(s.position.c[0], 0, UNIT >> 11);
        CHECK_NEAR(s.position.c[1], y, UNIT >> 11);
        CHECK_NEAR(s.position.c[2], UNIT * 3 / 4, UNIT >> 11);
    }
    CHECK_LESS(apart(0), UNIT >> 11);
}

/*
 * A group flies along x and turns about x by a fifth of a radian a frame, so its first slice, of an eighth of a radian, ends at 5/8 of
 * the frame. There it is half a skin to five skins from another body, which is a contact and no hit.
 */
static void near_at_slice(void)
{
    begin(0, 8 * UNIT, 0);
    def.velocity.c[0] = ONE / 4;
    def.spin.c[0] = ONE / 5;
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(-UNIT, 0, 0), B);
    {
        struct carom_joint_def j = joint(CAROM_JOINT_FIXED, A, B, -UNIT / 2, 0, 0);

        CHECK_EQ(carom_joint_add(world, &j), 0);
    }
    memset(&def.velocity, 0, sizeof def.velocity);
    memset(&def.spin, 0, sizeof def.spin);
    CHECK_EQ(add(UNIT + UNIT / 4 * 5 / 8 + (UNIT >> 11), 0, 0), C);
}

/* Contacts that come with a slice have no room: the step changes nothing. */
static void test_no_room(void)
{
    near_at_slice();
    world->pools[CAROM_POOL_contacts].size = 1;
    REFUSE(carom_world_step(world), CAROM_ERR_CONTACTS_FULL);
    world->pools[CAROM_POOL_contacts].size = 24;
    steps(1);
}

/* The other body sleeps: it wakes with the slice, and takes its part of the momentum. */
static void test_wakes(void)
{
    int64_t sum = 0;

    near_at_slice();
    world->states[0].bodies[C].asleep = world->states[1].bodies[C].asleep = 1;
    steps(1);
    CHECK_EQ(events_of(CAROM_EVENT_WAKE, C, 0), 1);
    CHECK(!state_of(C).asleep);
    for (int i = A; i <= C; i++) {
        sum += state_of(i).velocity.c[0];
    }
    CHECK_NEAR(sum, ONE / 2, 1 << 12);
}

/* A and B sleep and touch, and there is no room to note it: the step changes nothing, though it has a joint to break. */
static void test_no_room_to_touch(void)
{
    struct carom_joint_def j;

    setup(FALL);
    CHECK_EQ(add(0, 0, 0), 0);
    CHECK_EQ(add(4 * UNIT, 0, 0), 1);
    CHECK_EQ(add(4 * UNIT, UNIT / 2, 0), 2);
    j = joint(CAROM_JOINT_BALL, 0, CAROM_WORLD, 0, 0, 0);
    j.most_impulse_q40 = 1;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int i = 1; i <= 2; i++) {
        world->states[0].bodies[i].asleep = world->states[1].bodies[i].asleep = 1;
    }
    world->now->touching[0] = (struct pair){2, 1};
    world->now->touching_count = 1;
    world->config.caps.pairs = 0;
    REFUSE(carom_world_step(world), CAROM_ERR_PAIRS_FULL);
    CHECK(!joint_of(0).broken);
    world->config.caps.pairs = PAIRS;
    steps(1);
    CHECK(joint_of(0).broken);
}

/* A body of an island that a kinematic one leads by a joint: A, by C, and by no other body; B is led by none. */
static void test_led(void)
{
    uint32_t a, b;

    begin(0, 4 * UNIT, 0);
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(0, 4 * UNIT, 0), B);
    def.kinematic = true;
    def.velocity.c[2] = ONE / 64;
    CHECK_EQ(add(0, UNIT, 0), C);
    {
        struct carom_joint_def j = joint(CAROM_JOINT_BALL, A, C, 0, UNIT / 2, 0);

        CHECK_EQ(carom_joint_add(world, &j), 0);
        j = joint(CAROM_JOINT_BALL, B, WALL, 2 * UNIT, 2 * UNIT, 0);
        CHECK_EQ(carom_joint_add(world, &j), 1);
    }
    step_begin(&step, world);
    rest_find_islands(&world->rest, world->bodies, world->body_count, NULL, 0);
    a = world->bodies[A].island.lowest;
    b = world->bodies[B].island.lowest;
    CHECK_EQ(world->joint_steps->led_by(&step, a, ISLAND_END), A);
    CHECK_EQ(world->joint_steps->led_by(&step, a, C), A);
    CHECK_EQ(world->joint_steps->led_by(&step, a, WALL), ISLAND_END);
    CHECK_EQ(world->joint_steps->led_by(&step, b, C), ISLAND_END);
    CHECK_EQ(world->joint_steps->led_by(&step, b, ISLAND_END), ISLAND_END);
}

/* A kinematic body leads A up, more slowly than bodies that sleep; A stays awake. B hangs still on the world, and sleeps. */
static void test_keeps_awake(void)
{
    const struct carom_config config = {
        .caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -FALL}}, .sleep = true};
    struct carom_joint_def j;

    setup(0);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    def.stationary = true;
    CHECK_EQ(add(4 * UNIT, 0, 0), WALL);
    def.stationary = false;
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(0, 4 * UNIT, 0), B);
    def.kinematic = true;
    def.velocity.c[2] = FALL / REST_QUIET_DIVISOR / 2;
    CHECK_EQ(add(0, 0, UNIT), C);
    j = joint(CAROM_JOINT_BALL, A, C, 0, 0, UNIT / 2);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_BALL, B, CAROM_WORLD, 0, 4 * UNIT, UNIT / 2);
    CHECK_EQ(carom_joint_add(world, &j), 1);
    for (int frame = 0; frame < 3 * REST_QUIET_FRAMES; frame++) {
        steps(1);
        CHECK(!state_of(A).asleep);
    }
    CHECK(state_of(B).asleep);
}

/* A goes along with C, which turns about x as it flies along z: A gets the motion that C has there, and the energy counts as work. */
static void test_goes_along(void)
{
    const int64_t spin = ONE / 50, speed = ONE / 64 - spin; /* A is at -1 along y from C */
    const double inertia = (1. / 4 + 1. / 16) / 12;         /* of sides of 1/2 and 1/4 */
    const double work2 =
        real(speed, 40) * real(speed, 40) + inertia * real(spin, 40) * real(spin, 40);
    const struct body_state *state;
    const struct fix_wide *work;

    begin(0, 4 * UNIT, 0);
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(0, 4 * UNIT, 0), B);
    def.kinematic = true;
    def.velocity.c[2] = ONE / 64;
    def.spin.c[0] = spin;
    CHECK_EQ(add(0, UNIT, 0), C);
    {
        struct carom_joint_def j = joint(CAROM_JOINT_BALL, A, C, 0, UNIT / 2, 0);

        CHECK_EQ(carom_joint_add(world, &j), 0);
    }
    step_begin(&step, world);
    for (uint32_t i = A; i <= C; i++) {
        CHECK_EQ(step_set_path(&step, i), CAROM_OK);
    }
    rest_find_islands(&world->rest, world->bodies, world->body_count, NULL, 0);
    CHECK(step_carry_island(&step, world->bodies[A].island.lowest, false));
    state = &step.next->bodies[A];
    work = body_work2(&world->bodies[A]);
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(state->momentum.c[k], k == 2 ? speed : 0, 1 << 10);
        CHECK_NEAR(state->angular.c[k], k == 0 ? real_round(inertia * (double)spin) : 0, 1 << 10);
    }
    CHECK_NEAR(carom_shl(work->hi, 16) + (int64_t)(work->lo >> 48),
               real_round(work2 * (double)UNIT), 4);
    CHECK_EQ(step.next->bodies[B].momentum.c[2], 0);
}

/*
 * At the end of a frame a limit stops what moves on to it if it is closer than an eighth of a skin: not at that distance, and at less by
 * the last place of a limit.
 */
static void test_near_limits(void)
{
    for (int nearer = 0; nearer < 4; nearer++) {
        const bool low = nearer & 1, high = nearer & 2;
        struct carom_joint_def j;
        const struct joint_work *work;
        int64_t close_q32;

        setup(0);
        CHECK_EQ(add(0, 0, 0), 0);
        close_q32 = (int64_t)world->bodies[0].def.skin_q22 * 1024 / 8;
        j = joint(CAROM_JOINT_SLIDER, 0, CAROM_WORLD, 0, 0, 0);
        j.drive.limited = true;
        j.drive.lower_q32 = -close_q32 + low;
        j.drive.upper_q32 = close_q32 - high;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        step_begin(&step, world);
        CHECK_EQ(step_set_path(&step, 0), CAROM_OK);
        world->rest.joints.joints[0].chosen = true;
        step.now_q30 = CAROM_ONE_Q30;
        (void)world->joint_steps->measure(&step, JOINT_PROJECT);
        work = &world->rest.joints.joints[0].work;
        CHECK_EQ(work->law.lower, low);
        CHECK_EQ(work->law.upper, high);
    }
}

/* A slides between the world's limits and is at one: at the upper one, or with a negative sign at the lower one. */
static struct carom_joint_def at_limit(int sign)
{
    struct carom_joint_def j;

    setup(0);
    CHECK_EQ(add(0, 0, 0), 0);
    j = joint(CAROM_JOINT_SLIDER, 0, CAROM_WORLD, 0, 0, 0);
    j.drive.limited = true;
    j.drive.lower_q32 = sign < 0 ? 0 : -UNIT;
    j.drive.upper_q32 = sign < 0 ? UNIT : 0;
    return j;
}

/* A spring between A and B pulls A off that limit, by 1/512 of mass 1 a frame and more softly later. */
static void pull_off(int sign)
{
    struct carom_joint_def j;

    CHECK_EQ(add(2 * UNIT, 0, 0), 1);
    j = joint(CAROM_JOINT_SLIDER, 1, 0, UNIT, 0, 0);
    j.drive.spring = true;
    j.drive.stiffness_q40 = ONE / 256;
    j.drive.rest_q32 = sign * UNIT / 2;
    CHECK_EQ(carom_joint_add(world, &j), 1);
}

/* A stands at the limit after each of ten frames; or B has pulled it off. */
static void check_pulled(int sign, bool holds)
{
    for (int frame = 0; frame < 10; frame++) {
        steps(1);
        if (holds) {
            CHECK_NEAR(state_of(0).velocity.c[2], 0, 1 << 14);
            CHECK_NEAR(state_of(0).position.c[2], 0, UNIT >> 18);
        }
    }
    CHECK_MORE(sign * state_of(1).velocity.c[2], ONE / 128);
    if (!holds) {
        CHECK_LESS(sign * state_of(0).position.c[2], -UNIT / 64);
    }
}

/* A motor or a spring presses A into a limit, and B pulls. A press of 1/64 holds A, one of 1/4096 cannot. */
static void test_pressed(void)
{
    for (int way = 0; way < 8; way++) {
        const int sign = way & 1 ? -1 : 1;
        const bool holds = way & 2;
        struct carom_joint_def j = at_limit(sign);

        j.drive.motor = way & 4;
        j.drive.motor_speed_q40 = sign * ONE / 32;
        j.drive.motor_most_q40 = holds ? ONE / 64 : ONE / 4096;
        j.drive.spring = !j.drive.motor;
        j.drive.stiffness_q40 = j.drive.motor_most_q40;
        j.drive.rest_q32 = sign * UNIT;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        pull_off(sign);
        check_pulled(sign, holds);
    }
}

/* The motor between C and A pushes C off and so presses A into its limit, and B pulls. The same press holds A, and A does not slow C. */
static void test_pressed_by_another(void)
{
    for (int way = 0; way < 4; way++) {
        const int sign = way & 1 ? -1 : 1;
        const bool holds = way & 2;
        struct carom_joint_def j = at_limit(sign);

        CHECK_EQ(carom_joint_add(world, &j), 0);
        pull_off(sign);
        CHECK_EQ(add(-2 * UNIT, 0, 0), 2);
        j = joint(CAROM_JOINT_SLIDER, 2, 0, -UNIT, 0, 0);
        j.drive.motor = true;
        j.drive.motor_speed_q40 = -sign * ONE;
        j.drive.motor_most_q40 = holds ? ONE / 64 : ONE / 4096;
        CHECK_EQ(carom_joint_add(world, &j), 2);
        check_pulled(sign, holds);
        if (holds) {
            CHECK_NEAR(state_of(2).velocity.c[2], -sign * 10 * ONE / 64, ONE >> 16);
        }
    }
}

/* A motor drives A off a limit, however weak it is: its own impulse does not hold A there. */
static void test_pushed_off(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        struct carom_joint_def j = at_limit(-sign);

        j.drive.motor = true;
        j.drive.motor_speed_q40 = sign * ONE;
        j.drive.motor_most_q40 = ONE >> 20;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        for (int frame = 1; frame <= 10; frame++) {
            steps(1);
            CHECK_NEAR(state_of(0).velocity.c[2], sign * frame * (ONE >> 20), 1 << 10);
        }
    }
}

/*
 * A motor presses two boxes that fly together against each other. Their contact opens a gap against
 * the motor, and they keep their momentum, though a wall beside their way does not let them go
 * through a frame as one.
 */
static void test_pressed_together(void)
{
    struct carom_joint_def j;

    begin(0, UNIT / 2, -UNIT * 9 / 10);
    def.velocity.c[1] = ONE / 64;
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(UNIT + 2 * SKIN, 0, 0), B);
    j = joint(CAROM_JOINT_HINGE, B, A, UNIT / 2 + SKIN, 0, UNIT / 2);
    j.axis = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    j.touch = true;
    j.drive.motor = true;
    j.drive.motor_speed_q40 = ONE / 8;
    j.drive.motor_most_q40 = ONE / 32;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int frame = 0; frame < 60; frame++) {
        steps(1);
        CHECK_NEAR(state_of(A).velocity.c[1] + state_of(B).velocity.c[1], ONE / 32, ONE >> 24);
    }
}

/*
 * B swings about A, which slides along z and touches a wall above it: the pull of the swing presses A into the wall. A has no velocity
 * after a frame, and B keeps its speed.
 */
static void test_pulled_to_a_wall(void)
{
    struct carom_joint_def j;

    begin(0, 0, UNIT);
    CHECK_EQ(add(0, 0, UNIT * 3 / 4 - SKIN / 2), A);
    def.velocity.c[0] = ONE / 16;
    CHECK_EQ(add(0, 0, UNIT * 11 / 4), B);
    j = joint(CAROM_JOINT_SLIDER, A, CAROM_WORLD, 0, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_HINGE, B, A, 0, 0, UNIT * 3 / 4);
    j.axis = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    CHECK_EQ(carom_joint_add(world, &j), 1);
    for (int frame = 0; frame < 20; frame++) {
        steps(1);
        CHECK_NEAR(state_of(A).velocity.c[2], 0, ONE >> 16);
    }
    CHECK_MORE(state_of(B).velocity.c[0], ONE / 24);
}

/*
 * A hangs on the world, and a kinematic body leads it away by a part of a skin: no round of solves brings both joints together. The
 * last round counts as one of a hit at the first unit of time after the start of the frame, and not at the start.
 */
static void test_first_moment(void)
{
    for (int now = 0; now < 2; now++) {
        struct carom_joint_def j;

        begin(0, 4 * UNIT, 0);
        CHECK_EQ(add(0, 0, 0), A);
        def.kinematic = true;
        def.velocity.c[2] = ONE >> 13;
        CHECK_EQ(add(0, UNIT, 0), B);
        j = joint(CAROM_JOINT_BALL, A, B, 0, UNIT / 2, 0);
        CHECK_EQ(carom_joint_add(world, &j), 0);
        j = joint(CAROM_JOINT_FIXED, A, CAROM_WORLD, 0, 0, 0);
        CHECK_EQ(carom_joint_add(world, &j), 1);
        step_begin(&step, world);
        step.now_q30 = now;
        for (uint32_t i = A; i <= B; i++) {
            CHECK_EQ(step_set_path(&step, i), CAROM_OK);
        }
        for (int i = 0; i < 2; i++) {
            world->rest.joints.joints[i].chosen = true;
        }
        CHECK_EQ(step_solve(&step, false), CAROM_OK);
        CHECK(!world->rest.joints.joints[0].work.torn);
        CHECK_EQ(world->rest.joints.solve, now > 0 ? JOINT_HIT_MORE : JOINT_MORE);
    }
}

enum { HUNG, LED, SPRUNG, FALLING };

/* HUNG hangs on the world and holds LED, a kinematic body, back. SPRUNG slides along z on a spring to LED, at its rest. */
static void begin_held_back(int64_t speed_q40)
{
    struct carom_joint_def j;

    setup(0);
    CHECK_EQ(add(0, 0, 0), HUNG);
    def.kinematic = true;
    def.velocity.c[2] = speed_q40;
    CHECK_EQ(add(0, UNIT, 0), LED);
    def.kinematic = false;
    def.velocity.c[2] = 0;
    CHECK_EQ(add(0, 2 * UNIT, 0), SPRUNG);
    j = joint(CAROM_JOINT_FIXED, HUNG, CAROM_WORLD, 0, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_BALL, HUNG, LED, 0, UNIT / 2, 0);
    CHECK_EQ(carom_joint_add(world, &j), 1);
    j = joint(CAROM_JOINT_SLIDER, SPRUNG, LED, 0, UNIT * 3 / 2, 0);
    j.drive.spring = true;
    j.drive.stiffness_q40 = ONE / 8;
    CHECK_EQ(carom_joint_add(world, &j), 2);
}

/* LED stops in every frame: no pull comes from the way that it was to take. */
static void test_held_back(void)
{
    begin_held_back(ONE / 16);
    for (int frame = 0; frame < 20; frame++) {
        steps(1);
        CHECK_EQ(events_of(CAROM_EVENT_BLOCKED, LED, HUNG), 1);
        CHECK_EQ(state_of(LED).position.c[2], 0);
        CHECK_EQ(state_of(SPRUNG).position.c[2], 0);
        CHECK_EQ(state_of(SPRUNG).velocity.c[2], 0);
    }
}

/*
 * The same, and a box falls on SPRUNG from half a skin above it. The frame begins anew after its first hit, and all but the BLOCKED event is
 * as in a world whose LED stands: states, the hit, and for 30 frames the number of faces that interfere.
 */
static void test_held_back_hit(void)
{
    struct carom_body_state state[2][2];
    const struct carom_event *events;
    struct carom_event hit[2];
    uint32_t faces[2][30];

    for (int led = 0; led < 2; led++) {
        begin_held_back(led * ONE / 16);
        def.velocity.c[2] = -ONE / 64;
        CHECK_EQ(add(0, 2 * UNIT, UNIT / 4 + SKIN / 2), FALLING);
        steps(1);
        CHECK_EQ(events_of(CAROM_EVENT_BLOCKED, LED, HUNG), led);
        CHECK_EQ(events_of(CAROM_EVENT_HIT, FALLING, SPRUNG), 1);
        for (int i = 0; i < 2; i++) {
            state[led][i] = state_of(i == 0 ? SPRUNG : FALLING);
        }
        CHECK_EQ(carom_events(world, &events), led + 2); /* and that the two touch */
        hit[led] = events[led];
        for (int frame = 0; frame < 30; frame++) {
            faces[led][frame] = world->pools[CAROM_POOL_faces].used;
            steps(1);
        }
    }
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(memcmp(&state[1][i].position, &state[0][i].position, sizeof(carom_v3_q32)), 0);
        CHECK_EQ(memcmp(&state[1][i].velocity, &state[0][i].velocity, sizeof(carom_v3_q40)), 0);
        CHECK_EQ(memcmp(&state[1][i].spin, &state[0][i].spin, sizeof(carom_v3_q40)), 0);
    }
    CHECK_EQ(hit[1].kind, CAROM_EVENT_HIT);
    CHECK_EQ(memcmp(&hit[1], &hit[0], sizeof hit[0]), 0);
    CHECK_MORE(faces[0][0], 0);
    CHECK_EQ(memcmp(faces[1], faces[0], sizeof faces[0]), 0);
}

/*
 * The factors of two joints' rows fill their room to the last entry: each joint holds six rows, and each row has an entry for every
 * row up to itself. What comes next in the memory stays, and the chain moves as with room to spare.
 */
static void test_room(void)
{
    const int32_t guard = 0x5a5a5a5a;
    uint64_t hash[2];

    for (int tight = 0; tight < 2; tight++) {
        struct joint_list *list;

        setup(FALL);
        for (int i = 0; i < 3; i++) {
            CHECK_EQ(add(i * UNIT, 0, 0), i);
        }
        for (int i = 0; i < 2; i++) {
            struct carom_joint_def j =
                joint(CAROM_JOINT_FIXED, i, i + 1, i * UNIT + UNIT / 2, 0, 0);

            CHECK_EQ(carom_joint_add(world, &j), i);
        }
        list = &world->rest.joints;
        if (tight) {
            list->room_size = 12 * 13 / 2;
        }
        list->room[12 * 13 / 2] = guard;
        steps(3);
        CHECK_EQ(list->room[12 * 13 / 2], guard);
        hash[tight] = carom_world_hash(world);
    }
    CHECK_EQ(hash[1], hash[0]);
}

const struct test tests_step_joint[] = {
    {"step_joint/stands", test_stands},
    {"step_joint/no_room", test_no_room},
    {"step_joint/wakes", test_wakes},
    {"step_joint/no_room_to_touch", test_no_room_to_touch},
    {"step_joint/led", test_led},
    {"step_joint/keeps_awake", test_keeps_awake},
    {"step_joint/goes_along", test_goes_along},
    {"step_joint/room", test_room},
    {"step_joint/first_moment", test_first_moment},
    {"step_joint/held_back", test_held_back},
    {"step_joint/held_back_hit", test_held_back_hit},
    {"step_joint/near_limits", test_near_limits},
    {"step_joint/pressed_by_another", test_pressed_by_another},
    {"step_joint/pushed_off", test_pushed_off},
    {"step_joint/pressed", test_pressed},
    {"step_joint/pulled_to_a_wall", test_pulled_to_a_wall},
    {"step_joint/pressed_together", test_pressed_together},
    {0},
};

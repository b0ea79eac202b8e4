/* SPDX-License-Identifier: MIT */
/*
 * The energy rule of a step, called by hand after a frame that no scene makes so plainly: two boxes side by side in the air, which
 * touch or hang together by a joint, end it with more energy than they had.
 */
#include "lib/jointed.h"
#include "step/energy.h"

enum { A, B, OTHER };

static struct step step;

/* Two boxes, side by side along x, at y = z = 0, with the motion of `def`. */
static void add_two(void)
{
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(UNIT, 0, 0), B);
}

/* A plate that stands just below the two. */
static void add_plate(void)
{
    def.stationary = true;
    CHECK_EQ(add(UNIT / 2, 0, -UNIT / 2), OTHER);
    def.stationary = false;
}

/* Scale all momenta of the two at the end of the frame by a ratio. */
static void scale(int over, int under)
{
    for (int i = A; i <= B; i++) {
        for (int k = 0; k < 3; k++) {
            step.next->bodies[i].momentum.c[k] = step.next->bodies[i].momentum.c[k] / under * over;
            step.next->bodies[i].angular.c[k] = step.next->bodies[i].angular.c[k] / under * over;
        }
    }
}

static void raise(int64_t way_q32)
{
    for (int i = A; i <= B; i++) {
        step.next->bodies[i].position.c[2] += way_q32;
    }
}

static void touch(void)
{
    CHECK_EQ(step_note_touching(&step, &(struct pair){B, A}), CAROM_OK);
}

/* True if a body has moved along y. */
static bool went(int body)
{
    return step.next->bodies[body].position.c[1] != world->now->bodies[body].position.c[1];
}

/* ------------------------------------------------------------ through a frame as one */

enum way {
    CLEAR,
    IN_THE_WAY,
    REMOVED,
    SENSOR,
    BESIDE,    /* the other box is beside the way */
    CAME_NEAR, /* as far away, but it moved by a unit */
    SLEPT,
    PULLED, /* one of the two has another acceleration */
};

/*
 * Both move along y by a quarter of a unit a frame, and their momenta have doubled. They have no motion against each other that could
 * give this back. So the frame is undone, and they go through it as one body, with the momenta that they had. They may not do so when
 * a solid body is where they may come, nor if they did not move alike: then their momenta are scaled where they are.
 */
static void goes_as_one(void)
{
    static const bool goes[PULLED + 1] = {
        [CLEAR] = true, [REMOVED] = true, [SENSOR] = true, [BESIDE] = true};

    for (int way = CLEAR; way <= PULLED; way++) {
        setup(0);
        def.velocity.c[1] = ONE / 4;
        add_two();
        def.velocity.c[1] = 0;
        def.stationary = way < BESIDE;
        def.sensor = way == SENSOR;
        if (way != CLEAR) {
            CHECK_EQ(add(UNIT / 2, way < BESIDE ? UNIT * 3 / 2 : UNIT * 5 / 2, 0), OTHER);
        }
        def.stationary = def.sensor = false;
        if (way == REMOVED) {
            CHECK_EQ(carom_body_remove(world, OTHER), CAROM_OK);
        }
        step_begin(&step, world);
        scale(2, 1);
        touch();
        if (way == CAME_NEAR) {
            step.next->bodies[OTHER].position.c[0] += UNIT;
        } else if (way == SLEPT) {
            world->now->bodies[B].asleep = 1;
        } else if (way == PULLED) {
            world->bodies[B].def.acceleration.c[1] = ONE / 100;
        }
        /* in a frame before */
        world->bodies[A].clock.grounded = world->bodies[B].clock.rewound = true;
        step_limit_energy(&step);
        CHECK_EQ(world->stats.calmed, 1);
        for (int i = A; i <= B; i++) {
            CHECK_EQ(went(i), goes[way]);
            if (went(i)) {
                CHECK_NEAR(step.next->bodies[i].position.c[1], UNIT / 4, 4);
            }
            CHECK_NEAR(step.next->bodies[i].momentum.c[1], ONE / 4, 1 << 12);
        }
    }
}

/* The two turn about their middle, by more than a frame may have as one body: the turn gives the gain, and they stay in their places. */
static void turns_too_fast(void)
{
    setup(0);
    add_two();
    step_begin(&step, world);
    for (int i = A; i <= B; i++) {
        const carom_v3_q40 spin = {{0, 0, 70 * ONE}};
        const carom_v3_q40 v = {{ONE / 8, i == A ? -35 * ONE : 35 * ONE, 0}};

        body_set_motion(&world->bodies[i], &step.next->bodies[i], &v, &spin);
        world->now->bodies[i] = step.next->bodies[i];
    }
    scale(2, 1);
    for (int i = A; i <= B; i++) {
        step.next->bodies[i].momentum.c[0] =
            ONE / 8; /* the common motion gains nothing, and gives nothing */
    }
    touch();
    step_limit_energy(&step);
    for (int i = A; i <= B; i++) {
        const struct body_state *now = &world->now->bodies[i], *next = &step.next->bodies[i];

        CHECK(!went(i));
        CHECK_NEAR(next->momentum.c[0], ONE / 8, 1 << 12);
        CHECK_NEAR(next->momentum.c[1], now->momentum.c[1], ONE >> 12);
        CHECK_NEAR(next->angular.c[2], now->angular.c[2], ONE >> 12);
    }
}

/*
 * One of the two leaves the world with twice its momentum, and the other one has twice its momentum, too. The gain is three times the
 * energy e that both had at first. The one that left gives all that it has, 2 e; the other one keeps e.
 */
static void one_left(void)
{
    setup(0);
    def.velocity.c[1] = ONE / 4;
    add_two();
    step_begin(&step, world);
    scale(2, 1);
    touch();
    step.next->bodies[B].out = 1;
    step_limit_energy(&step);
    CHECK_EQ(step.next->bodies[B].momentum.c[1], 0);
    CHECK_NEAR(step.next->bodies[A].momentum.c[1], 388736063997, 1 << 20); /* 2^38 sqrt(2) */
    CHECK(!went(A));
}

/*
 * The two came up by a unit without any motion, and a plate is in their way: they stay where they were. Without the plate they fall
 * from there as one body.
 */
static void rose(void)
{
    for (int in_the_way = 0; in_the_way < 2; in_the_way++) {
        setup(FALL);
        add_two();
        if (in_the_way) {
            add_plate();
        }
        step_begin(&step, world);
        raise(UNIT);
        touch();
        step_limit_energy(&step);
        for (int i = A; i <= B; i++) {
            CHECK_NEAR(step.next->bodies[i].position.c[2], in_the_way ? 0 : -FALL / 512, 4);
            CHECK_NEAR(step.next->bodies[i].momentum.c[2], in_the_way ? 0 : -FALL, 1 << 12);
        }
    }
}

/* As before, with the plate in the way, and one of the two left the world up there: both are where they were, and it stays out. */
static void rose_and_left(void)
{
    setup(FALL);
    add_two();
    add_plate();
    step_begin(&step, world);
    raise(UNIT);
    touch();
    step.next->bodies[B].out = 1;
    step_limit_energy(&step);
    for (int i = A; i <= B; i++) {
        CHECK_EQ(step.next->bodies[i].position.c[2], world->now->bodies[i].position.c[2]);
        CHECK_EQ(step.next->bodies[i].momentum.c[2], 0);
    }
    CHECK(step.next->bodies[B].out);
}

/* ------------------------------------------------------------ joints */

static void join_two(void)
{
    const struct carom_joint_def j = joint(CAROM_JOINT_FIXED, A, B, UNIT / 2, 0, 0);

    CHECK_EQ(carom_joint_add(world, &j), 0);
}

/* Twice an energy of mass 1, with 60 fractional bits. */
static int64_t q60(const struct fix_wide *energy2)
{
    return fix_wide_shift(energy2, 20);
}

/*
 * The joint raised both by a part of a skin, and nothing moves: the gain is owed. It may be up to half of the height that contact may
 * lift, 0.075 of a skin a body; a larger one undoes the frame, and nothing is owed.
 */
static void raised_by_a_joint(void)
{
    for (int much = 0; much < 2; much++) {
        int64_t way_q32, owed_q60;

        setup(FALL);
        add_two();
        join_two();
        way_q32 = carom_shl(world->bodies[A].def.skin_q22, 10) * (much ? 80 : 70) / 1000;
        /* two bodies of mass 1: 2 x 2 m g h, q40 times q32 */
        owed_q60 = much ? 0 : 4 * FALL * way_q32 >> 12;
        step_begin(&step, world);
        raise(way_q32);
        step_limit_energy(&step);
        for (int i = A; i <= B; i++) {
            CHECK_NEAR(step.next->bodies[i].position.c[2], much ? -FALL / 512 : way_q32, 4);
            CHECK_NEAR(step.next->bodies[i].momentum.c[2], much ? -FALL : 0, 1 << 12);
        }
        CHECK_NEAR(q60(&step.next->joints[0].owed2), owed_q60, FALL >> 10);
    }
}

/*
 * One box turns, the other one does not, and both fly along y. The joint added a hundredth to the turn. The motion of the two against
 * each other gives this back: nothing is owed, and the sums of the momenta stay.
 */
static void turn_pays(void)
{
    struct step_account sum;
    int64_t turn_q40;

    setup(0);
    def.velocity.c[1] = ONE / 8;
    add_two();
    join_two();
    step_begin(&step, world);
    world->now->bodies[A].angular.c[0] = ONE / 64;
    turn_q40 = step.next->bodies[A].angular.c[0] = ONE / 64 + ONE / 6400;
    step_limit_energy(&step);
    sum = step_audit(&step, A);
    /* 2^-24 of the energy */
    CHECK_NEAR(q60(&sum.excess), 0, q60(&sum.kinetic) >> 24);
    CHECK_NEAR(q60(&step.next->joints[0].owed2), 0, q60(&sum.kinetic) >> 24);
    CHECK_NEAR(step.next->bodies[A].angular.c[0] + step.next->bodies[B].angular.c[0], turn_q40, 2);
    CHECK_LESS(step.next->bodies[A].angular.c[0], turn_q40);
    CHECK_NEAR(step.next->bodies[A].momentum.c[1], ONE / 8, 1 << 12);
}

/*
 * A debt just below what the energy allows comes over it by a gain of the last places. The frame would be undone, but a plate is in
 * the way, and the frame gained nothing that counts: it stays as it is, and so does the debt.
 */
static void debt_alone(void)
{
    struct fix_wide owed2;

    setup(0);
    def.velocity.c[1] = ONE / 4;
    add_two();
    join_two();
    def.stationary = true;
    CHECK_EQ(add(UNIT / 2, UNIT * 3 / 2, 0), OTHER);
    step_begin(&step, world);
    owed2 = fix_wide_mul(ONE / 8, ONE >> 11); /* 2 m v^2 over 2^11 */
    step.next->joints[0].owed2 = owed2;
    for (int i = A; i <= B; i++) {
        step.next->bodies[i].momentum.c[1] += 2;
    }
    step_limit_energy(&step);
    for (int i = A; i <= B; i++) {
        CHECK(!went(i));
        CHECK_NEAR(step.next->bodies[i].momentum.c[1], ONE / 4, 8);
    }
    fix_wide_subtract(&owed2, &step.next->joints[0].owed2);
    CHECK_LESS(fix_wide_sign(&owed2), 0);
    CHECK_NEAR(q60(&owed2), 0, (int64_t)1 << 22); /* 2 m v dv for each */
}

/*
 * Two cubes of 2^-9 of a unit, 32 units apart, that a distance joint holds: about the line through both they have no inertia that 30
 * bits would show, so they have no motion as one rigid body. What the joint added is no accuracy of its solve: all of the motion
 * gives it.
 */
static void in_a_line(void)
{
    static struct shape tiny;
    struct carom_joint_def j;

    setup(0);
    shape_box(&tiny, 10, 2, 2, 2);
    def.mesh = &tiny.mesh;
    def.velocity.c[1] = ONE / 4;
    CHECK_EQ(add(0, 0, 0), A);
    CHECK_EQ(add(32 * UNIT, 0, 0), B);
    j = joint(CAROM_JOINT_DISTANCE, A, B, 0, 0, 0);
    j.anchor_b.c[0] = 32 * UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    step_begin(&step, world);
    scale(5, 4);
    step_limit_energy(&step);
    for (int i = A; i <= B; i++) {
        CHECK_NEAR(step.next->bodies[i].momentum.c[1], ONE / 4, 1 << 14);
    }
    CHECK_NEAR(q60(&step.next->joints[0].owed2), 0, (int64_t)1 << 34);
}

/* A kinematic body stretches a spring to a body that left the world before: it goes its way, and owes nothing. */
static void led_alone(void)
{
    struct carom_joint_def j;

    setup(0);
    CHECK_EQ(add(0, 0, 0), A);
    def.kinematic = true;
    CHECK_EQ(add(UNIT, 0, 0), B);
    def.kinematic = false;
    j = joint(CAROM_JOINT_DISTANCE, A, B, 0, 0, 0);
    j.anchor_b.c[0] = UNIT;
    j.drive = (struct carom_joint_drive){.spring = true, .rest_q32 = UNIT, .stiffness_q40 = ONE};
    CHECK_EQ(carom_joint_add(world, &j), 0);
    world->now->bodies[A].out = 1;
    step_begin(&step, world);
    step.next->bodies[B].position.c[0] += UNIT;
    step_limit_energy(&step);
    CHECK_EQ(step.next->bodies[B].position.c[0], 2 * UNIT);
    CHECK(!world->bodies[B].clock.rewound);
    CHECK_EQ(q60(&step.next->joints[0].owed2), 0);
}

/*
 * A spring of stiffness 1 has the energy x^2 / 2, x being the way from where it is loose. Beyond a limit it has no less than at the
 * limit. The limits are at 4 and 12 eighths of a unit. Each case, in eighths: where the spring is loose, where the joint is, and the x
 * that counts.
 */
static void beyond_a_limit(void)
{
    static const int64_t cases[][3] = {{16, 12, 4},  {16, 14, 4}, {16, 16, 4}, {16, 19, 4},
                                       {16, 26, 10}, {16, 10, 6}, {16, 4, 12}, {16, 2, 14},
                                       {1, 4, 3},    {1, 2, 3},   {1, 12, 11}, {1, 20, 19},
                                       {8, 8, 0},    {8, 13, 5},  {8, 3, 5}};
    struct carom_joint_def j;

    setup(0);
    add_two();
    j = joint(CAROM_JOINT_DISTANCE, A, B, 0, 0, 0);
    j.anchor_b.c[0] = UNIT;
    j.drive = (struct carom_joint_drive){.limited = true,
                                         .lower_q32 = UNIT / 2,
                                         .upper_q32 = 3 * UNIT / 2,
                                         .spring = true,
                                         .stiffness_q40 = ONE};
    CHECK_EQ(carom_joint_add(world, &j), 0);
    step_begin(&step, world);
    step_limit_energy(&step);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct step_account sum;

        step.next->joints[0].drive.rest_q32 = UNIT / 8 * cases[i][0];
        world->now->bodies[B].position.c[0] = UNIT / 8 * cases[i][1];
        sum = step_audit(&step, A);
        CHECK_NEAR(q60(&sum.kept), (int64_t)(cases[i][2] * cases[i][2]) << 54, (int64_t)1 << 40);
    }
}

/*
 * Two joined boxes that touch lost their motion and came up, and the limits of their joint took more than that in the frame. Half of a unit takes
 * less energy than their motion had: they have less than before, and stay there. A whole unit takes more: the frame is undone. So it is
 * in the air, where a plate is in the way of the two as one body, and for two that touch that plate.
 */
static void took_again(void)
{
    for (int way = 0; way < 4; way++) {
        const bool grounded = way & 1, more = way & 2;

        setup(FALL);
        def.velocity.c[1] = ONE / 16; /* v^2 / 2 is 1/512, and g h is 1/367 or 1/734 */
        add_two();
        join_two();
        def.velocity.c[1] = 0;
        add_plate();
        step_begin(&step, world);
        scale(0, 1);
        raise(more ? UNIT : UNIT / 2);
        touch();
        if (grounded) {
            CHECK_EQ(step_note_touching(&step, &(struct pair){A, OTHER}), CAROM_OK);
        }
        world->rest.joints.joints[0].work.given2 = fix_wide_mul(-ONE, ONE);
        step_limit_energy(&step);
        for (int i = A; i <= B; i++) {
            CHECK_EQ(step.next->bodies[i].position.c[2], more ? 0 : UNIT / 2);
            CHECK_EQ(step.next->bodies[i].momentum.c[1], more && !grounded ? ONE / 64 : 0);
        }
    }
}

const struct test tests_step_energy[] = {
    {"step_energy/goes_as_one", goes_as_one},
    {"step_energy/turns_too_fast", turns_too_fast},
    {"step_energy/one_left", one_left},
    {"step_energy/rose", rose},
    {"step_energy/rose_and_left", rose_and_left},
    {"step_energy/raised_by_a_joint", raised_by_a_joint},
    {"step_energy/turn_pays", turn_pays},
    {"step_energy/debt_alone", debt_alone},
    {"step_energy/in_a_line", in_a_line},
    {"step_energy/led_alone", led_alone},
    {"step_energy/beyond_a_limit", beyond_a_limit},
    {"step_energy/took_again", took_again},
    {0},
};

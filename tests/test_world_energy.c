/* SPDX-License-Identifier: MIT */
/*
 * The energy of contact over a frame: what an island gained is taken out of its momenta, island by
 * island. The states before and after are made by hand.
 */
#include <math.h>
#include <string.h>

#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "step/parts.h"

#define CAPS 4, 4, 4, 4, 4, 4
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */

enum { STILL, LOW, HIGH, APART, BODIES };

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape cube;
static struct carom_world *world;
static struct step step;

/* Three moving cubes of mass 1, 2 and 1, and one static cube, all far from each other. */
static void begin(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -ONE / 256}}};
    struct carom_body_def def;

    shape_box(&cube, 12, 4096, 4096, 4096);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &cube.mesh;
    for (int i = 0; i < BODIES; i++) {
        def.stationary = i == STILL;
        def.mass_q20 = i == HIGH ? 2 << 20 : 1 << 20;
        def.position.c[0] = (int64_t)(10 * i) << 32;
        def.velocity.c[0] = i == LOW ? ONE / 8 : ONE / 64;
        def.velocity.c[1] = i == HIGH ? -ONE / 16 : ONE / 512;
        def.spin.c[2] = ONE / 32;
        CHECK_EQ(carom_body_add(world, &def), i);
    }
    step_begin(&step, world);
    for (int i = 0; i < BODIES; i++) {
        struct body *b = &world->bodies[i];

        b->clock.contact = BODY_FLIES;
        CHECK(world_acceleration(b, 1 << 16, &config.gravity, &b->def.force, &b->def.acceleration));
        b->def.acceleration_q40 = fix_length(b->def.acceleration.c);
    }
}

static void touch(uint16_t a, uint16_t b)
{
    CHECK_EQ(step_note_touching(&step, &(struct pair){a, b}), CAROM_OK);
}

static double kinetic(const struct world_state *states, int body)
{
    const struct body_state *s = &states->bodies[body];
    double m = body == HIGH ? 2 : 1, sum = 0;

    /* the inertia of a cube of side 1 is m / 6 about any axis */
    for (int k = 0; k < 3; k++) {
        sum += real(s->momentum.c[k], 40) * real(s->momentum.c[k], 40) / m / 2;
        sum += real(s->angular.c[k], 40) * real(s->angular.c[k], 40) / m * 3;
    }
    return sum;
}

/* All momenta of a body grow by a part. */
static void speed_up(int body, int64_t part)
{
    struct body_state *s = &step.next->bodies[body];

    for (int k = 0; k < 3; k++) {
        s->momentum.c[k] += s->momentum.c[k] / part;
        s->angular.c[k] += s->angular.c[k] / part;
    }
}

static bool unchanged(int body, const struct body_state *as)
{
    return memcmp(&step.next->bodies[body], as, sizeof *as) == 0;
}

/* x x p + L of the two bodies, about the world's origin. */
static void angular(double sum[3])
{
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;

        sum[k] = 0;
        for (int i = LOW; i <= HIGH; i++) {
            const struct body_state *s = &step.next->bodies[i];

            sum[k] += real(s->position.c[m], 32) * real(s->momentum.c[n], 40);
            sum[k] -= real(s->position.c[n], 32) * real(s->momentum.c[m], 40);
            sum[k] += real(s->angular.c[k], 40);
        }
    }
}

/*
 * Two bodies that touch only each other: the gain is removed. Their momentum stays to the bit, and
 * their angular momentum to the worth of the last bit of a place.
 */
static void test_free(void)
{
    struct body_state before[BODIES];
    double now, turn_before[3], turn[3];
    int64_t sum[3];

    begin();
    speed_up(LOW, 5);
    speed_up(HIGH, 7);
    speed_up(APART, 5);
    for (int k = 0; k < 3; k++) {
        sum[k] = step.next->bodies[LOW].momentum.c[k] + step.next->bodies[HIGH].momentum.c[k];
    }
    memcpy(before, step.next->bodies, sizeof before);
    angular(turn_before);
    step_limit_energy(&step); /* no body touched another */
    CHECK(unchanged(LOW, &before[LOW]));
    CHECK(unchanged(HIGH, &before[HIGH]));
    touch(HIGH, LOW);
    step_limit_energy(&step); /* though neither is in contact now */
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(step.next->bodies[LOW].momentum.c[k] + step.next->bodies[HIGH].momentum.c[k],
                 sum[k]);
    }
    angular(turn);
    for (int k = 0; k < 3; k++) {
        CHECK_LESS(fabs(turn[k] - turn_before[k]), 1e-11);
    }
    now = kinetic(step.next, LOW) + kinetic(step.next, HIGH);
    now /= kinetic(world_now(world), LOW) + kinetic(world_now(world), HIGH);
    CHECK_LESS(now, 1 + 1e-7);
    CHECK_MORE(now, 1 - 1e-7);
    CHECK(unchanged(APART, &before[APART])); /* touches nothing */
}

/* One of them touches a static body: all momenta shrink alike. */
static void test_grounded(void)
{
    struct body_state before[BODIES];
    double now, factor;

    begin();
    touch(HIGH, LOW);
    touch(LOW, STILL);
    world->bodies[LOW].clock.contact = BODY_LIES;
    speed_up(LOW, 5);
    speed_up(HIGH, 7);
    memcpy(before, step.next->bodies, sizeof before);
    step_limit_energy(&step);
    now = kinetic(step.next, LOW) + kinetic(step.next, HIGH);
    now -= kinetic(world_now(world), LOW) + kinetic(world_now(world), HIGH);
    /* up to the cost of a lift by a part of the skin: 0.15 m g skin */
    CHECK_MORE(now, -1e-9);
    CHECK_LESS(now, 0.15 * real(cube.mesh.radius_q22, 22) / 2048 / 256 + 1e-9);
    factor = real(step.next->bodies[LOW].momentum.c[0], 40) / real(before[LOW].momentum.c[0], 40);
    CHECK_LESS(factor, 1);
    for (int i = LOW; i <= HIGH; i++) {
        for (int k = 0; k < 3; k++) {
            CHECK_LESS(real_abs(real(step.next->bodies[i].momentum.c[k], 40) -
                                factor * real(before[i].momentum.c[k], 40)),
                       1e-9);
        }
    }
}

/* Less than 2^-24 of the kinetic energy is rounding. */
static void test_slack(void)
{
    struct body_state before[BODIES];

    for (int gain = 0; gain < 2; gain++) {
        begin();
        touch(HIGH, LOW);
        speed_up(LOW, gain ? 1 << 22 : 1 << 27);
        speed_up(HIGH, gain ? 1 << 22 : 1 << 27);
        memcpy(before, step.next->bodies, sizeof before);
        world->bodies[HIGH].clock.stands = true;
        step_limit_energy(&step);
        CHECK_EQ((unchanged(LOW, &before[LOW]) && unchanged(HIGH, &before[HIGH])), !gain);
    }
}

/*
 * A body that climbed by more than its energy allows goes back to its place at the start of the
 * frame and stands still. Another body at that place goes back as well, with a quarter of its
 * energy.
 */
static void test_climbed(void)
{
    for (int taken = 0; taken < 3; taken++) {
        const struct body_state *was, *other_was;
        struct body_state *s, *other;

        begin();
        was = &world_now(world)->bodies[LOW];
        s = &step.next->bodies[LOW];
        other = &step.next->bodies[APART];
        other_was = &world_now(world)->bodies[APART];
        touch(LOW, STILL);
        world->bodies[LOW].clock.contact = BODY_LIES;
        s->position.c[2] += (int64_t)8 << 32; /* 8 / 256 more than (1/8)^2 / 2 */
        if (taken > 0) {
            other->position = was->position;
            other->position.c[0] += taken == 1 ? (int64_t)1 << 31 : (int64_t)3 << 32;
        }
        step_limit_energy(&step);
        CHECK_EQ(s->position.c[2], was->position.c[2]);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(s->momentum.c[k], 0);
            CHECK_EQ(s->angular.c[k], 0);
        }
        CHECK_DIFFER(other->momentum.c[0], 0);
        CHECK_EQ(other->momentum.c[0], other_was->momentum.c[0] / (taken == 1 ? 4 : 1));
        CHECK_EQ(memcmp(&other->position, &other_was->position, sizeof other->position) == 0,
                 taken != 2);
    }
}

const struct test tests_world_energy[] = {{"world_energy/free", test_free},
                                          {"world_energy/grounded", test_grounded},
                                          {"world_energy/slack", test_slack},
                                          {"world_energy/climbed", test_climbed},
                                          {0}};

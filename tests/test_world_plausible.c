/* SPDX-License-Identifier: MIT */
/*
 * The numbers of a snapshot, one by one: each value that no step could have left is refused, and the value that was
 * there is taken. test_world_load changes bytes by chance; here each rule of world_plausible and of the parts that it
 * shares with calls is broken alone.
 */
#include "lib/one_world.h"
#include "lib/shapes.h"
#include "world/joints.h"
#include "world/world.h"

#define CAPS 5, 10, 64, 128, 0, 512, 2, 1
#define ONE  ((int64_t)1 << 40)

enum { GROUND, LOW, HIGH, FAR, LED };

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape ground, box;

/* Two boxes of given masses on each other and on a plane, one far from them, and a kinematic one. */
static void make_masses(uint32_t low, uint32_t high)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .sleep = true};
    struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true, .friction_q16 = 1 << 15};

    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    shape_plane(&ground, 12, 1, 16384);
    shape_box(&box, 12, 4096, 4096, 2048);
    CHECK_EQ(carom_body_add(world, &def), GROUND);
    def.mesh = &box.mesh;
    def.stationary = false;
    for (int i = LOW; i <= LED; i++) {
        def.position.c[0] = CAROM_RATIO(i <= HIGH ? 0 : i, 1, 32) * 3;
        def.position.c[2] = CAROM_RATIO(i == HIGH ? 78 : 26, 100, 32);
        def.kinematic = i == LED;
        def.mass_q20 = (i == HIGH ? high : i == LOW ? low : 1) << 20;
        CHECK_EQ(carom_body_add(world, &def), i);
    }
    steps(10);
    /* a load has read the forces by now, into the room of a solve */
    for (int i = GROUND; i <= LED; i++) {
        PHASE_BEGIN(world->bodies[i].solve.work_phase, BODY_LOADED);
        body_loaded(&world->bodies[i])->forces = world_forces(&world->bodies[i]);
    }
}

static void make(void)
{
    make_masses(1, 1);
}

static bool good(void)
{
    return world_plausible(world, world->now, &world->config.gravity);
}

/* Check that a number is refused where another one is taken. */
#define REFUSED(place, value)                                                                      \
    do {                                                                                           \
        __typeof__(place) was_ = (place);                                                          \
        (place) = (__typeof__(place))(value);                                                      \
        CHECK(!good());                                                                            \
        (place) = was_;                                                                            \
        CHECK(good());                                                                             \
    } while (0)

static void test_bodies(void)
{
    struct body_state *s;

    make();
    s = world->now->bodies;
    REFUSED(s[LOW].rotation.c[0], s[LOW].rotation.c[0] / 2);
    REFUSED(s[LOW].position.c[1], INT64_MAX);
    REFUSED(s[LOW].asleep, 2);
    REFUSED(s[LOW].out, 2);
    REFUSED(s[LOW].woken, 2);
    REFUSED(s[LOW].quiet, REST_QUIET_FRAMES + 1);
    REFUSED(s[LOW].asleep, 1); /* it has momenta */
    REFUSED(s[GROUND].asleep, 1);
    REFUSED(s[GROUND].woken, 1);
    REFUSED(s[GROUND].quiet, 1);
    REFUSED(s[LED].out, 1);
    s[FAR].out = 1;
    CHECK(good());
    REFUSED(s[FAR].woken, 1); /* only one of the two */
}

static void test_pairs(void)
{
    struct pair *p;

    make();
    p = world->now->touching;
    CHECK_AT_LEAST(world->now->touching_count, 2);
    REFUSED(p[0].a, world->body_count);
    REFUSED(p[0].b, world->body_count);
    REFUSED(p[0].a, GROUND);                    /* it does not move */
    REFUSED(p[0].b, FAR);                       /* the higher number comes first */
    REFUSED(world->bodies[LOW].def.mesh, NULL); /* HIGH is on it */
    REFUSED(p[1].a, p[0].a - 1);                /* in order */
    p[world->now->touching_count] = p[world->now->touching_count - 1];
    REFUSED(world->now->touching_count, world->now->touching_count + 1); /* each once */
}

static void test_impulses(void)
{
    struct rest_warm *i;
    struct rest_warm first, second;

    make();
    i = world->now->warm;
    CHECK_AT_LEAST(world->now->warm_count, 2);
    REFUSED(i[0].a, FAR); /* of a touching pair */
    REFUSED(i[0].arm.c[0], 100 << 22);
    REFUSED(i[0].normal.c[2], i[0].normal.c[2] / 2);
    REFUSED(i[0].impulse.c[2], -i[0].impulse.c[2] - ONE); /* it pulls */
    REFUSED(i[0].impulse.c[2], INT64_MAX / 4);
    REFUSED(i[0].impulse.c[0], 1024 * ONE); /* no friction is that large */
    /* the same place and normal twice, and the same place alone */
    first = i[0];
    second = i[1];
    CHECK(first.a == second.a && first.b == second.b);
    i[1].arm = first.arm;
    i[1].normal = first.normal;
    CHECK(!good());
    i[1].normal = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    i[1].impulse = (carom_v3_q40){{0, 1, 0}};
    CHECK(good());
    i[1] = second;
    /* kept for a pair of which nobody is awake */
    for (int b = LOW; b <= HIGH; b++) {
        memset(&world->now->bodies[b].momentum, 0, sizeof world->now->bodies[b].momentum);
        memset(&world->now->bodies[b].angular, 0, sizeof world->now->bodies[b].angular);
        world->now->bodies[b].asleep = 1;
    }
    CHECK(!good());
}

/* No solve changes a speed by 2^18 units a frame: that times the mass of the lighter body is the largest impulse of a pair. */
static void test_lighter(void)
{
    for (uint32_t mass = 1; mass < 4; mass++) {
        const int64_t most = (ONE << 18) * mass;
        struct rest_warm *i, *end;

        make_masses(mass, 64);
        i = world->now->warm;
        end = i + world->now->warm_count;
        while (i < end && !(i->a == HIGH && i->b == LOW)) {
            i++;
        }
        CHECK_LESS(i - world->now->warm, world->now->warm_count);
        if (i < end) {
            CHECK_EQ(i->normal.c[2], CAROM_ONE_Q30);
            i->impulse.c[2] = most;
            CHECK(good());
            REFUSED(i->impulse.c[2], most + (ONE << 10));
            REFUSED(i->impulse.c[2], most + most / 8);
        }
    }
}

static void test_forces(void)
{
    make();
    REFUSED(world->config.gravity.c[0], INT64_MAX / 2);
    REFUSED(body_loaded(&world->bodies[GROUND])->forces.force.c[0], 1); /* it does not move */
    REFUSED(body_loaded(&world->bodies[GROUND])->forces.torque.c[0], 1);
    REFUSED(body_loaded(&world->bodies[LOW])->forces.force.c[0], INT64_MAX / 2);
    REFUSED(body_loaded(&world->bodies[LOW])->forces.linear_damping_q30, -1);
}

static void test_drives(void)
{
    const struct body *b;
    const struct body_state *s;
    struct body_drive drive;

    make();
    b = &world->bodies[LED];
    s = &world->now->bodies[LED];
    memset(&drive, 0, sizeof drive);
    CHECK(world_drive_plausible(b, s, &drive));
    drive.kind = BODY_DRIVE_ON;
    CHECK(!world_drive_plausible(b, s, &drive)); /* it goes nowhere */
    drive.spin.c[1] = 1;
    CHECK(world_drive_plausible(b, s, &drive));
    drive.velocity.c[0] = 1000 * ONE;
    CHECK(!world_drive_plausible(b, s, &drive));
    memset(&drive, 0, sizeof drive);
    drive.kind = BODY_DRIVE_TO;
    drive.position = s->position;
    drive.rotation = s->rotation;
    CHECK(!world_drive_plausible(b, s, &drive)); /* it is there */
    drive.position.c[0]++;
    CHECK(world_drive_plausible(b, s, &drive));
    drive.rotation.c[0] /= 2;
    CHECK(!world_drive_plausible(b, s, &drive));
    drive.rotation = s->rotation;
    drive.position.c[0] += (int64_t)1000 << 32;
    CHECK(!world_drive_plausible(b, s, &drive)); /* too far for a frame */
    drive.position = s->position;
    drive.position.c[0]++;
    drive.kind = BODY_DRIVE_TO + 1;
    CHECK(!world_drive_plausible(b, s, &drive));
}

/* Check that a joint is refused with another number at a place. */
#define NO_JOINT(place, value)                                                                     \
    do {                                                                                           \
        struct joint was_ = joint;                                                                 \
        (place) = (__typeof__(place))(value);                                                      \
        CHECK_EQ(step_restore_joint(world, &joint), CAROM_ERR_FORMAT);                             \
        joint = was_;                                                                              \
    } while (0)

static void test_joints(void)
{
    struct carom_joint_def def = {.kind = CAROM_JOINT_BALL, .a = FAR, .b = LED};
    struct joint joint;

    make();
    def.anchor = state_of(FAR).position;
    CHECK_EQ(carom_joint_add(world, &def), 0);
    joint = world->rest.joints.joints[0];
    NO_JOINT(joint.kind, CAROM_JOINT_FIXED + 1);
    NO_JOINT(joint.most_impulse_q40, -1);
    NO_JOINT(joint.a, LED); /* both are one body */
    NO_JOINT(joint.a, world->body_count);
    NO_JOINT(joint.a, GROUND);
    NO_JOINT(joint.b, world->body_count);
    NO_JOINT(joint.frame[1].c[0], 0);
    NO_JOINT(joint.arm[0].c[2], ONE << 15);
    NO_JOINT(joint.arm[0].c[2], 100 * ONE); /* farther than 64 radii */
    CHECK_EQ(carom_body_remove(world, LOW), CAROM_OK);
    NO_JOINT(joint.a, LOW);
    NO_JOINT(joint.b, LOW);
    joint.b = JOINT_WORLD;
    CHECK_EQ(step_restore_joint(world, &joint), CAROM_OK);
    CHECK_EQ(step_restore_joint(world, &joint), CAROM_ERR_JOINTS_FULL);
    joint.used = false;
    CHECK_EQ(step_restore_joint(world, &joint), CAROM_ERR_JOINTS_FULL);
}

const struct test tests_world_plausible[] = {
    {"world_plausible/bodies", test_bodies},     {"world_plausible/pairs", test_pairs},
    {"world_plausible/impulses", test_impulses}, {"world_plausible/lighter", test_lighter},
    {"world_plausible/forces", test_forces},     {"world_plausible/drives", test_drives},
    {"world_plausible/joints", test_joints},     {0},
};

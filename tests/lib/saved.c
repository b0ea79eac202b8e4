/* SPDX-License-Identifier: MIT */
/* Worlds for snapshots: with contacts, joints, kinematic bodies, filters, forces and a surface that moves. */
#include "saved.h"

#include <string.h>

#define UNIT ((int64_t)1 << 32)

static int add(struct saved *s, int mesh, int64_t x, int64_t z)
{
    struct carom_body_def def = {.mesh = &s->fuzz.meshes[mesh], .friction_q16 = 1 << 15};

    def.position.c[0] = x;
    def.position.c[2] = z;
    def.spin.c[1] = (int64_t)1 << 34;
    return lab_expect(carom_body_add(s->world, &def), "body");
}

/* Two boxes and a tetrahedron fall on the surface, one onto the other. */
static void make_pile(struct saved *s)
{
    const carom_v3_q40 torque = {{0, 0, (int64_t)1 << 30}};

    (void)add(s, 0, 0, -UNIT);
    (void)add(s, 0, UNIT / 4, 0);
    (void)add(s, 1, -UNIT / 4, 2 * UNIT);
    lab_expect(carom_body_set_torque(s->world, 2, &torque), "torque");
}

/* Two boxes on a ball joint under a kinematic plate that moves, one that a hinge holds in the world. */
static void make_joints(struct saved *s)
{
    struct carom_body_def plate = {.mesh = &s->fuzz.meshes[3], .kinematic = true};
    struct carom_joint_def joint = {.kind = CAROM_JOINT_BALL, .a = 1, .b = 2};

    plate.position.c[0] = UNIT / 2;
    plate.position.c[2] = 2 * UNIT;
    plate.velocity.c[0] = (int64_t)1 << 33;
    (void)add(s, 0, 0, 0);
    lab_expect(carom_body_add(s->world, &plate) - 2, "plate");
    (void)add(s, 2, 3 * UNIT, 0);
    joint.anchor.c[2] = UNIT;
    lab_expect(carom_joint_add(s->world, &joint), "ball");
    joint = (struct carom_joint_def){.kind = CAROM_JOINT_HINGE, .a = 3, .b = CAROM_WORLD};
    joint.anchor.c[0] = 2 * UNIT;
    joint.axis.c[1] = CAROM_ONE_Q30;
    joint.drive.spring = true;
    joint.drive.stiffness_q40 = (int64_t)1 << 34;
    lab_expect(carom_joint_add(s->world, &joint), "hinge");
}

static void make_random(struct saved *s, int calls)
{
    for (int call = 0; call < calls; call++) {
        (void)fuzz_call(&s->fuzz);
        if (fuzz_pick(&s->fuzz, 4) == 0) {
            (void)carom_world_step(s->world);
        }
    }
}

static void begin(struct saved *s, uint64_t seed, int bodies)
{
    fuzz_begin(&s->fuzz, seed, bodies);
    s->world = s->fuzz.world;
}

/* Go on for some frames, and save. */
static void save(struct saved *s, int frames)
{
    int result = 0;

    for (int frame = 0; frame < frames; frame++) {
        result = carom_world_step(s->world);
    }
    lab_expect(result, "step");
    s->size = (size_t)lab_expect(carom_snapshot_save(s->world, s->good, sizeof s->good), "save");
    s->hash = carom_world_hash(s->world);
}

/* At least two, so that the surface has been still for one. */
#define FRAMES 2

void saved_make(struct saved *s, int number)
{
    if (number < 2) {
        begin(s, (uint64_t)number + 1, 0);
        (number == 0 ? make_pile : make_joints)(s);
        save(s, 40);
    } else {
        begin(s, (uint64_t)number, 6);
        make_random(s, 40);
        save(s, FRAMES);
    }
}

void saved_make_small(struct saved *s, int number)
{
    begin(s, (uint64_t)number + 1, 2);
    make_random(s, 8);
    save(s, FRAMES);
}

const char *saved_try_load(struct saved *s, const uint8_t *bytes, size_t size, int *result)
{
    const uint64_t before = carom_world_hash(s->world);

    *result = carom_snapshot_load(s->world, bytes, size);
    if (*result >= 0) {
        return NULL;
    }
    if (*result != CAROM_ERR_FORMAT && *result != CAROM_ERR_EXTRAS_FULL) {
        return "no error of carom_snapshot_load";
    }
    return carom_world_hash(s->world) == before ? NULL
                                                : "bytes that were refused changed the world";
}

const char *saved_back(struct saved *s)
{
    const int result = carom_snapshot_load(s->world, s->good, s->size);

    return result < 0                              ? "its own snapshot was refused"
           : carom_world_hash(s->world) != s->hash ? "its own snapshot is another state"
                                                   : NULL;
}

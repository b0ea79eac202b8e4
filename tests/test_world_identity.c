/* SPDX-License-Identifier: MIT */
/*
 * Ids of bodies that come and go, and the caller's pointer: every public function accepts both
 * names of a body.
 */
#include <string.h>

#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define BODIES 4
#define CAPS   BODIES, 4, 16, 48, 8, 32, 0, 2, 0

/* bodies of test_contacts */
enum { STAND, OTHER_STAND, BOX_OVER, OTHER_BOX };

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box, floor_shape;
static struct carom_world *world;
static struct carom_body_def def;

static void setup(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};

    shape_box(&box, 12, 4096, 4096, 4096);
    shape_plane(&floor_shape, 9, 1, 4096);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
}

static int add(int64_t units)
{
    def.position.c[0] = units * ((int64_t)1 << 32);
    return carom_body_add(world, &def);
}

/* Bodies come and go at random. The ids of present bodies name them; all other ids name none. */
static void test_come_and_go(void)
{
    struct test_random r = {7};
    int ids[200], alive[BODIES], made = 0;

    setup();
    memset(alive, -1, sizeof alive);
    while (made < 200) {
        int place = (int)test_random_range(&r, 0, BODIES - 1);

        if (alive[place] >= 0) {
            /* by its id or by its number */
            CHECK_EQ(carom_body_remove(world, made % 2 ? ids[alive[place]] : place), CAROM_OK);
            alive[place] = -1;
        } else {
            int number = add(10 * made);

            CHECK(number >= 0 && alive[number] < 0);
            ids[made] = carom_body_id(world, number);
            CHECK_MORE(ids[made], 4095);
            CHECK_EQ(carom_body_number(ids[made]), number);
            alive[number] = made++;
        }
        for (int i = 0; i < made; i++) {
            bool there = alive[ids[i] & 4095] == i;
            struct carom_body_state s;

            CHECK_EQ(carom_body_get(world, ids[i], &s), there ? CAROM_OK : CAROM_ERR_BODY);
            CHECK_EQ(carom_body_id(world, ids[i]), there ? ids[i] : CAROM_ERR_BODY);
            for (int k = 0; there && k < i; k++) {
                CHECK_DIFFER(ids[k], ids[i]);
            }
            if (there) {
                CHECK_EQ(s.position.c[0], (int64_t)10 * i << 32);
            }
        }
    }
}

/* The generation has 16 bits and is never 0. */
static void test_wraps(void)
{
    setup();
    CHECK_EQ(add(0), 0);
    CHECK_EQ(carom_body_id(world, 0), 1 << 12);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    world->bodies[0].def.generation = 65533; /* as if so many bodies had used this place */
    for (int n = 65534; n < 65539; n++) {
        CHECK_EQ(add(0), 0);
        CHECK_EQ(carom_body_id(world, 0), (n <= 65535 ? n : n - 65535) << 12);
        CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    }
}

/* The result of public function `which` for a body. */
static int call(int which, int body)
{
    static struct carom_body_state state;
    static const carom_v3_q40 none = {{0, 0, 0}};
    static const carom_v3_q32 centre = {{0, 0, 0}};
    const int64_t vector[3] = {1, 2, 3};
    struct carom_body_look look;
    struct carom_matrix matrix;
    struct carom_material material;
    struct carom_forces forces;
    carom_v3_q32 point;
    carom_v3_q40 out;
    uint32_t mass;

    memset(&material, 0, sizeof material);
    material.rolling_q16 = CAROM_ROLLING_Q16;
    switch (which) {
    case 0:
        return carom_body_get(world, body, &state);
    case 1:
        return carom_body_set(world, body, &state);
    case 2:
        return carom_body_look(world, body, &look);
    case 3:
        return carom_body_mesh(world, body) == &box.mesh ? CAROM_OK : CAROM_ERR_BODY;
    case 4:
        return carom_body_set_force(world, body, &none);
    case 5:
        return carom_body_push(world, body, &none, &centre);
    case 6:
        return carom_query_faces(world, body, 1, NULL, 0);
    case 7:
        return carom_query_faces(world, 1, body, NULL, 0);
    case 8:
        return carom_query_inside(world, body, 1);
    case 9:
        return carom_query_inside(world, 1, body);
    case 10:
        return carom_body_set_user(world, body, &box);
    case 11:
        return carom_body_user(world, body) == &box ? CAROM_OK : CAROM_ERR_BODY;
    case 12:
        return carom_body_matrix(world, body, &matrix);
    case 13:
        return carom_body_world_point(world, body, &centre, &point);
    case 14:
        return carom_body_local_point(world, body, &centre, &point);
    case 15:
        return carom_body_world_vector(world, body, vector, out.c);
    case 16:
        return carom_body_local_vector(world, body, vector, out.c);
    case 17:
        return carom_body_velocity_at(world, body, &centre, &out);
    case 18:
        return carom_body_set_material(world, body, &material);
    case 19:
        return carom_body_material(world, body, &material);
    case 20:
        return carom_body_set_face_materials(world, body, NULL, 0, NULL);
    case 21:
        return carom_body_set_mass(world, body, 0);
    case 22:
        return carom_body_mass(world, body, &mass);
    case 23:
        return carom_body_forces(world, body, &forces);
    case 24:
        return carom_body_set_force_at(world, body, &none, &centre);
    case 25:
        return carom_body_set_torque(world, body, &none);
    case 26:
        return carom_body_set_gravity_scale(world, body, 1 << 16);
    case 27:
        return carom_body_set_damping(world, body, 0, 0);
    case 28:
        return carom_body_push_centre(world, body, &none);
    case 29:
        return carom_body_twist(world, body, &none);
    default:
        return carom_body_remove(world, body);
    }
}

#define CALLS 31

/* The number, the id, and names of no body. */
static void test_every_call(void)
{
    setup();
    for (int which = 0; which < CALLS; which++) {
        int old, now;

        CHECK_EQ(carom_world_init(block, sizeof block,
                                  &(struct carom_config){.caps = CAROM_CAPS(CAPS)}, &world),
                 CAROM_OK);
        CHECK_EQ(add(0), 0);
        CHECK_EQ(add(50), 1);
        old = carom_body_id(world, 0);
        CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
        CHECK_EQ(add(0), 0);
        now = carom_body_id(world, 0);
        CHECK_DIFFER(old, now);
        (void)call(0, 0);
        CHECK_EQ(call(which, old), CAROM_ERR_BODY);
        CHECK_EQ(call(which, -1), CAROM_ERR_BODY);
        CHECK_EQ(call(which, 2), CAROM_ERR_BODY);
        CHECK_EQ(call(which, INT32_MAX), CAROM_ERR_BODY);
        CHECK_EQ(call(which, INT32_MIN), CAROM_ERR_BODY);
        (void)carom_body_set_user(world, 0, &box);
        if (which < CALLS - 1) {
            CHECK_EQ(call(which, 0), CAROM_OK);
        }
        CHECK_EQ(call(which, now), CAROM_OK);
    }
    /* a body and itself, by both names */
    CHECK_EQ(carom_query_inside(world, 1, carom_body_id(world, 1)), CAROM_ERR_ARGUMENT);
}

/* A pointer comes with the definition, can be changed, and goes with the body. */
static void test_user(void)
{
    int things[2];

    setup();
    def.user = &things[0];
    CHECK_EQ(add(0), 0);
    CHECK_SAME(carom_body_user(world, 0), &things[0]);
    CHECK_EQ(carom_body_set_user(world, 0, &things[1]), CAROM_OK);
    CHECK_SAME(carom_body_user(world, 0), &things[1]);
    CHECK_EQ(carom_body_set_user(NULL, 0, &things[1]), CAROM_ERR_NULL);
    CHECK_SAME(carom_body_user(NULL, 0), NULL);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    CHECK_SAME(carom_body_user(world, 0), NULL);
    def.user = NULL;
    CHECK_EQ(add(0), 0);
    CHECK_SAME(carom_body_user(world, 0), NULL);
    CHECK_EQ(carom_body_id(NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_number(-3), -3);
}

/* Extras: one a body, returned when the body goes. */
static void test_extras(void)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    setup();
    for (int i = 0; i < 3; i++) {
        CHECK_EQ(add(10 * i), i);
    }
    for (int n = 0; n < 3; n++) {
        CHECK_EQ(carom_body_set_damping(world, 0, 1000, 0), CAROM_OK);
        CHECK_EQ(carom_body_set_gravity_scale(world, 0, 0), CAROM_OK);
        CHECK_EQ(carom_body_set_damping(world, 1, 1000, 0), CAROM_OK);
        CHECK_EQ(carom_body_set_damping(world, 2, 1000, 0), CAROM_ERR_EXTRAS_FULL);
        CHECK_EQ(carom_usage(world, usage), CAROM_OK);
        CHECK_EQ(usage[CAROM_POOL_extras].used, 2);
        CHECK_EQ(usage[CAROM_POOL_extras].refused, n + 1);
        /* settings that need no extra are not refused */
        CHECK_EQ(carom_body_set_damping(world, 2, 0, 0), CAROM_OK);
        CHECK_EQ(carom_body_remove(world, n % 2), CAROM_OK);
        CHECK_EQ(carom_body_set_damping(world, 2, 1000, 0), CAROM_OK);
        CHECK_EQ(carom_body_remove(world, 2), CAROM_OK);
        CHECK_EQ(add(40 + 10 * n), n % 2);
        CHECK_EQ(add(20), 2);
    }
}

/* Two boxes on a stationary one each. A removed body takes its contacts along, and no others. */
static void test_contacts(void)
{
    struct carom_contact before[16], after[16];
    const carom_v3_q40 down = {{0, 0, -((int64_t)1 << 32)}};
    const int removed[] = {BOX_OVER, STAND};
    int count, others;

    for (int i = 0; i < 2; i++) {
        setup();
        CHECK_EQ(carom_world_set_gravity(world, &down), CAROM_OK);
        CHECK_EQ(add(0), STAND);
        CHECK_EQ(add(10), OTHER_STAND);
        def.mass_q20 = 1 << 20;
        def.position.c[2] = ((int64_t)1 << 32) + ((int64_t)1 << 21);
        CHECK_EQ(add(0), BOX_OVER);
        CHECK_EQ(add(10), OTHER_BOX);
        for (int frame = 0; frame < 4; frame++) {
            CHECK_EQ(carom_world_step(world), CAROM_OK);
        }
        count = carom_contacts(world, before, 16);
        others = 0;
        for (int n = 0; n < count; n++) {
            if (before[n].a == OTHER_BOX) {
                before[others++] = before[n];
            }
        }
        CHECK_MORE(others, 0);
        CHECK_MORE(count, others);
        CHECK_EQ(carom_body_remove(world, removed[i]), CAROM_OK);
        CHECK_EQ(carom_contacts(world, after, 16), others);
        CHECK_EQ(memcmp(before, after, (size_t)others * sizeof *after), 0);
        /* nor does the next body at its place find any */
        CHECK_EQ(add(30), removed[i]);
        CHECK_EQ(carom_contacts(world, after, 16), others);
        CHECK_EQ(memcmp(before, after, (size_t)others * sizeof *after), 0);
    }
}

const struct test tests_world_identity[] = {
    {"world_identity/come_and_go", test_come_and_go},
    {"world_identity/wraps", test_wraps},
    {"world_identity/every_call", test_every_call},
    {"world_identity/user", test_user},
    {"world_identity/extras", test_extras},
    {"world_identity/contacts", test_contacts},
    {0},
};

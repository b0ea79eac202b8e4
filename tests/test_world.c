/* SPDX-License-Identifier: MIT */
/*
 * The calls around a step: they accept and refuse as carom.h says, at the limits that it states.
 * After an error a world is as it was.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS 3, 2, 32, 64, 64, 128
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */

/* A constant expression: the size of an array. Each further element takes more bytes. */
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS) + 16];
_Static_assert(CAROM_WORLD_BYTES(4, 2, 32, 64, 64, 128) > CAROM_WORLD_BYTES(CAPS), "bodies");
_Static_assert(CAROM_WORLD_BYTES(3, 3, 32, 64, 64, 128) > CAROM_WORLD_BYTES(CAPS), "pairs");
_Static_assert(CAROM_WORLD_BYTES(3, 2, 33, 64, 64, 128) > CAROM_WORLD_BYTES(CAPS), "contacts");
_Static_assert(CAROM_WORLD_BYTES(3, 2, 32, 65, 64, 128) > CAROM_WORLD_BYTES(CAPS), "faces");
_Static_assert(CAROM_WORLD_BYTES(3, 2, 32, 64, 65, 128) > CAROM_WORLD_BYTES(CAPS), "entries");
_Static_assert(CAROM_WORLD_BYTES(3, 2, 32, 64, 64, 129) > CAROM_WORLD_BYTES(CAPS), "candidates");
_Static_assert(CAROM_WORLD_BYTES(CAPS, 1) > CAROM_WORLD_BYTES(CAPS), "joints");
_Static_assert(CAROM_WORLD_BYTES(CAPS, 0, 1) > CAROM_WORLD_BYTES(CAPS), "extras");
_Static_assert(CAROM_WORLD_BYTES(CAPS, 0, 0, 1) > CAROM_WORLD_BYTES(CAPS), "hits");
_Static_assert(CAROM_WORLD_BYTES(CAPS, 0, 0, 0) == CAROM_WORLD_BYTES(CAPS), "may be left out");
_Static_assert(CAROM_WORLD_BYTES(3, 2, 33, 65, 1, 129, 1, 1, 1) % 8 == 0, "end to end");

static struct shape box, ground, odd;
static struct carom_config config;
static struct carom_body_def floor_def, box_def, def;

/* ------------------------------------------------------------------- helpers */

/* A box of 1 x 0.7 x 0.5 and a plane of 4 x 4 units; nothing is in the world yet. */
static void setup(void)
{
    const struct carom_caps caps = CAROM_CAPS(CAPS);

    shape_box(&box, 12, 4096, 2868, 2048);
    shape_plane(&ground, 12, 2, 8192);
    memset(&config, 0, sizeof config);
    config.caps = caps;
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    config.sleep = true;
    memset(&floor_def, 0, sizeof floor_def);
    floor_def.mesh = &ground.mesh;
    floor_def.stationary = true;
    floor_def.friction_q16 = 1 << 15;
    memset(&box_def, 0, sizeof box_def);
    box_def.mesh = &box.mesh;
    box_def.position.c[2] = CAROM_RATIO(26, 100, 32);
    box_def.friction_q16 = 1 << 15;
    box_def.overlap = CAROM_OVERLAP_PASS; /* in some tests the places of bodies do not matter */
    def = box_def;
    world = NULL;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
}

/* The plane as body 0. */
static void setup_floor(void)
{
    setup();
    CHECK_EQ(carom_body_add(world, &floor_def), 0);
}

/* The plane, and the box above it as body 1. */
static void setup_bodies(void)
{
    setup_floor();
    CHECK_EQ(carom_body_add(world, &box_def), 1);
}

/* The state that an error must leave as it was. */
struct record {
    uint64_t hash;
    struct carom_usage usage[CAROM_POOL_COUNT];
};

static void take(struct record *r)
{
    r->hash = carom_world_hash(world);
    CHECK_EQ(carom_usage(world, r->usage), CAROM_OK);
}

static void check_unchanged(const struct record *before)
{
    struct record now;

    take(&now);
    CHECK_EQ(now.hash, before->hash);
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        CHECK_EQ(now.usage[i].size, before->usage[i].size);
        CHECK_EQ(now.usage[i].used, before->usage[i].used);
        CHECK_EQ(now.usage[i].peak, before->usage[i].peak);
    }
}

/* `def` gives the error and leaves the world unchanged; then `def` is reset. */
static void refuse(int error)
{
    struct record before;

    take(&before);
    CHECK_EQ(carom_body_add(world, &def), error);
    check_unchanged(&before);
    def = box_def;
}

/* `def` makes a body; the body is removed again. */
static void accept(void)
{
    int body = carom_body_add(world, &def);

    CHECK_AT_LEAST(body, 0);
    if (body >= 0) {
        CHECK_EQ(carom_body_remove(world, body), CAROM_OK);
    }
    def = box_def;
}

/* Events of a kind in the last step; every one must be about this body. */
static int count_events(int kind, int body)
{
    const struct carom_event *events = NULL;
    int n = carom_events(world, &events), found = 0;

    for (int i = 0; i < n; i++) {
        if (events[i].kind == kind) {
            CHECK_EQ(events[i].a, body);
            found++;
        }
    }
    return found;
}

static void settle(void)
{
    int frame;

    for (frame = 0; frame < 300 && !state_of(1).asleep; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK_LESS(frame, 300);
}

/* ---------------------------------------------------------------------- init */

/* An error of init: neither the block nor the pointer is written. */
static void refuse_init(void *mem, size_t bytes, int error)
{
    struct carom_world *const nobody = (struct carom_world *)(void *)&config;
    struct carom_world *w = nobody;
    bool clean = true;

    memset(block, 0xa5, sizeof block);
    CHECK_EQ(carom_world_init(mem, bytes, &config, &w), error);
    CHECK_SAME(w, nobody);
    for (size_t i = 0; i < sizeof block; i++) {
        clean = clean && block[i] == 0xa5;
    }
    CHECK(clean);
}

static void test_init_memory(void)
{
    const size_t need = CAROM_WORLD_BYTES(CAPS);

    setup();
    refuse_init(NULL, need, CAROM_ERR_NULL);
    CHECK_EQ(carom_world_init(block, need, NULL, &world), CAROM_ERR_NULL);
    CHECK_EQ(carom_world_init(block, need, &config, NULL), CAROM_ERR_NULL);
    refuse_init(block, need - 1, CAROM_ERR_MEMORY);
    refuse_init(block, 0, CAROM_ERR_MEMORY);
    for (int shift = 1; shift < 8; shift++) {
        refuse_init(block + shift, need, CAROM_ERR_MEMORY);
    }

    /* exactly enough; the bytes behind the block stay, whatever the world does */
    memset(block, 0xa5, sizeof block);
    CHECK_EQ(carom_world_init(block, need, &config, &world), CAROM_OK);
    CHECK_SAME((void *)world, (void *)block);
    CHECK_EQ(carom_body_add(world, &floor_def), 0);
    CHECK_EQ(carom_body_add(world, &box_def), 1);
    def.stationary = true;
    CHECK_EQ(carom_body_add(world, &def), 2);
    for (int frame = 0; frame < 5; frame++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    for (size_t i = need; i < sizeof block; i++) {
        CHECK_EQ(block[i], 0xa5);
    }
}

/*
 * Each capacity at its limits. The largest ones need more than the block, but their sums do not
 * overflow.
 */
static void test_init_capacities(void)
{
    setup();
#define CHECK_CAPACITY(name, bytes, low, high)                                                     \
    {                                                                                              \
        const struct carom_config good = config;                                                   \
                                                                                                   \
        config.caps.name = (low)-1u;                                                               \
        refuse_init(block, sizeof block, CAROM_ERR_ARGUMENT);                                      \
        config.caps.name = (high) + 1;                                                             \
        refuse_init(block, SIZE_MAX / 2, CAROM_ERR_ARGUMENT);                                      \
        config.caps.name = UINT32_MAX;                                                             \
        refuse_init(block, SIZE_MAX / 2, CAROM_ERR_ARGUMENT);                                      \
        config.caps.name = (high);                                                                 \
        refuse_init(block, CAROM_WORLD_BYTES(CAPS) + 8, CAROM_ERR_MEMORY);                         \
        config.caps.name = (low);                                                                  \
        CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);                \
        config = good;                                                                             \
    }
    CAROM_POOLS(CHECK_CAPACITY)
#undef CHECK_CAPACITY
}

static void test_init_range(void)
{
    setup();
    for (int k = 0; k < 3; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            memset(&config.gravity, 0, sizeof config.gravity);
            config.gravity.c[k] = sign * ONE;
            CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
            config.gravity.c[k] = sign * (ONE + 1);
            refuse_init(block, sizeof block, CAROM_ERR_RANGE);
            config.gravity.c[k] = sign < 0 ? INT64_MIN : INT64_MAX;
            refuse_init(block, sizeof block, CAROM_ERR_RANGE);
        }
    }
}

/*
 * 60 radians take 120 slices of half a radian. Slices belong to the body alone: no cap of hits cuts
 * them short, and another body far away has none.
 */
static void test_fast_spin(void)
{
    static const uint8_t caps[3] = {0, 1, 255};

    setup();
    for (int i = 0; i < 3; i++) {
        struct carom_stats stats;

        config.substep_cap = caps[i];
        def.spin.c[0] = 60 * ONE;
        def.position.c[0] = 0;
        CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
        CHECK_EQ(carom_body_add(world, &def), 0);
        def.spin.c[0] = ONE / 8;
        def.position.c[0] = (int64_t)100 << 32;
        CHECK_EQ(carom_body_add(world, &def), 1);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_stats(world, &stats), CAROM_OK);
        CHECK_AT_LEAST(stats.substeps, 120);
        CHECK_AT_MOST(stats.substeps, 122);
        CHECK_EQ(stats.cut_islands, 0);
    }
}

/* ----------------------------------------------------------------------- add */

static void test_add_arguments(void)
{
    static const int32_t bad_e[] = {-1, INT32_MIN, CAROM_ONE_Q30 + 1, INT32_MAX};
    static const uint32_t bad_mu[] = {(4 << 16) + 1, UINT32_MAX};
    static const uint32_t bad_mass[] = {1, 1023, ((uint32_t)1 << 30) + 1, UINT32_MAX};

    setup_floor();
    for (int i = 0; i < 4; i++) {
        def.restitution_q30 = bad_e[i];
        refuse(CAROM_ERR_ARGUMENT);
        def.mass_q20 = bad_mass[i];
        refuse(CAROM_ERR_ARGUMENT);
    }
    for (int i = 0; i < 2; i++) {
        def.friction_q16 = bad_mu[i];
        refuse(CAROM_ERR_ARGUMENT);
    }
    def = floor_def;
    def.stationary = false;
    refuse(CAROM_ERR_ARGUMENT);
    /* the limits themselves */
    def.restitution_q30 = 0;
    def.friction_q16 = 0;
    def.mass_q20 = 1024;
    accept();
    def.restitution_q30 = CAROM_ONE_Q30;
    def.friction_q16 = 4 << 16;
    def.mass_q20 = (uint32_t)1 << 30;
    accept();
}

static void test_add_null(void)
{
    setup_floor();
    CHECK_EQ(carom_body_add(NULL, &def), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_add(world, NULL), CAROM_ERR_NULL);
    def.mesh = NULL;
    refuse(CAROM_ERR_NULL);
}

/* (1, 1, 1, 1) / 2 and (1, 0, 0, 0), made longer or shorter by parts of 2^30. */
static carom_quat_q30 stretched(bool even, int32_t by)
{
    carom_quat_q30 q = {{CAROM_ONE_Q30 + by, 0, 0, 0}};

    for (int k = 0; even && k < 4; k++) {
        q.c[k] = (CAROM_ONE_Q30 + by) / 2;
    }
    return q;
}

static void test_add_rotation(void)
{
    const int32_t limit = CAROM_ONE_Q30 >> 10, part = limit / 16;

    setup_floor();
    for (int even = 0; even < 2; even++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            carom_quat_q30 q;

            def.rotation = stretched(even, sign * (limit + part));
            refuse(CAROM_ERR_ARGUMENT);
            def.rotation = stretched(even, sign * (limit - part));
            CHECK_EQ(carom_body_add(world, &def), 1);
            q = state_of(1).rotation;
            for (int k = 0; k < 4; k++) {
                CHECK_NEAR(q.c[k], stretched(even, 0).c[k], 3);
            }
            CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
        }
    }
    for (int k = 0; k < 4; k++) {
        memset(&def.rotation, 0, sizeof def.rotation);
        def.rotation.c[k] = INT32_MIN;
        refuse(CAROM_ERR_ARGUMENT);
        def.rotation.c[k] = 1;
        refuse(CAROM_ERR_ARGUMENT);
    }
    /* all zero means none */
    memset(&def.rotation, 0, sizeof def.rotation);
    CHECK_EQ(carom_body_add(world, &def), 1);
    for (int k = 0; k < 4; k++) {
        CHECK_EQ(state_of(1).rotation.c[k], stretched(false, 0).c[k]);
    }
}

/* A speed along one axis, and one that is too large only as a length: 37^2 * 3 > 64^2. */
static void check_add_speed(carom_v3_q40 *speed)
{
    for (int k = 0; k < 3; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            speed->c[k] = sign * 64 * ONE;
            refuse(CAROM_ERR_RANGE);
            speed->c[k] = sign < 0 ? INT64_MIN : INT64_MAX;
            refuse(CAROM_ERR_RANGE);
            speed->c[k] = sign * (64 * ONE - ONE / 1024);
            accept();
        }
    }
    speed->c[0] = speed->c[1] = speed->c[2] = 37 * ONE;
    refuse(CAROM_ERR_RANGE);
    speed->c[0] = speed->c[1] = speed->c[2] = 36 * ONE;
    accept();
}

static void test_add_range(void)
{
    const int64_t limit = (int64_t)4096 << 32;

    setup_floor();
    for (int k = 0; k < 3; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            def.position.c[k] = sign * limit;
            accept();
            def.position.c[k] = sign * (limit + 1);
            refuse(CAROM_ERR_RANGE);
            def.position.c[k] = sign < 0 ? INT64_MIN : INT64_MAX;
            def.stationary = true;
            refuse(CAROM_ERR_RANGE);
        }
    }
    check_add_speed(&def.velocity);
    check_add_speed(&def.spin);
    /* its points, 0.66 units from the centre, move at 32 + 0.66 x 50 and 32 + 0.66 x 48 */
    def.velocity.c[0] = 32 * ONE;
    def.spin.c[1] = 50 * ONE;
    refuse(CAROM_ERR_RANGE);
    def.velocity.c[0] = 32 * ONE;
    def.spin.c[1] = 48 * ONE;
    accept();
}

/* The moving body becomes a box whose sides are powers of two. */
static void use_box(int quantum_bits, int x, int y, int z)
{
    shape_box(&odd, quantum_bits, x, y, z);
    def.mesh = &odd.mesh;
}

/* Mass from the mesh: 2^-10 and 2^10 are the limits. A given mass takes precedence. */
static void test_add_volume(void)
{
    setup_floor();
    use_box(12, 512, 512, 256); /* 2^-3 2^-3 2^-4 */
    accept();
    use_box(12, 512, 512, 254);
    refuse(CAROM_ERR_RANGE);
    use_box(12, 512, 512, 254);
    def.mass_q20 = 1 << 20;
    accept();
    use_box(7, 2048, 1024, 1024); /* 16 8 8 */
    accept();
    use_box(7, 2048, 1024, 1026);
    refuse(CAROM_ERR_RANGE);
    use_box(7, 2048, 1024, 1026);
    def.stationary = true;
    accept();
    /* so thin that its inertia has no inverse: moments are 2^25 to 1, and 2^22 to 1 */
    use_box(12, 32000, 4, 4);
    def.mass_q20 = 1 << 20;
    refuse(CAROM_ERR_RANGE);
    use_box(12, 32000, 4, 4);
    def.mass_q20 = 1 << 20;
    def.stationary = true;
    accept();
    use_box(12, 12000, 4, 4);
    def.mass_q20 = 1 << 20;
    accept();
}

/* A heavy body with a radius of 30.6 units; the largest allowed for a moving body is 32. */
static void use_giant(void)
{
    use_box(7, 36 * 128, 36 * 128, 34 * 128);
    def.mass_q20 = (uint32_t)1 << 30;
}

/*
 * Its points may move at 64 units a frame, which is a spin of 2.09; then no momentum is out of
 * range.
 */
static void test_add_giant(void)
{
    setup_floor();
    for (int k = 0; k < 3; k++) {
        use_giant();
        def.spin.c[k] = 60 * ONE;
        refuse(CAROM_ERR_RANGE);
        use_giant();
        def.spin.c[k] = 22 * ONE / 10;
        refuse(CAROM_ERR_RANGE);
        use_giant();
        def.spin.c[k] = 2 * ONE;
        accept();
    }
    use_box(7, 40 * 128, 40 * 128, 40 * 128);
    def.mass_q20 = 1 << 20;
    refuse(CAROM_ERR_RANGE);
    use_box(7, 40 * 128, 40 * 128, 40 * 128);
    def.stationary = true;
    accept();
}

static void test_add_full(void)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    setup_bodies();
    CHECK_EQ(carom_body_add(world, &def), 2);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    CHECK_EQ(usage[CAROM_POOL_bodies].refused, 0);
    def.stationary = true;
    refuse(CAROM_ERR_BODIES_FULL);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    CHECK_EQ(usage[CAROM_POOL_bodies].refused, 1);
}

/* ---------------------------------------------------------------- remove, get */

static void check_no_body(int body)
{
    struct carom_body_state state, same;
    struct record before;

    memset(&state, 0x5a, sizeof state);
    same = state;
    take(&before);
    CHECK_EQ(carom_body_get(world, body, &state), CAROM_ERR_BODY);
    CHECK_EQ(memcmp(&state, &same, sizeof state), 0);
    state = state_of(0);
    CHECK_EQ(carom_body_set(world, body, &state), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_remove(world, body), CAROM_ERR_BODY);
    check_unchanged(&before);
}

static void test_numbers(void)
{
    struct carom_body_state state;
    int a, b;

    setup_bodies();
    check_no_body(-1);
    check_no_body(2);
    check_no_body(3);
    check_no_body(INT32_MAX);
    check_no_body(INT32_MIN);
    CHECK_EQ(carom_body_remove(NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_get(NULL, 0, &state), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_get(world, 0, NULL), CAROM_ERR_NULL);
    state = state_of(0);
    CHECK_EQ(carom_body_set(NULL, 0, &state), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_set(world, 0, NULL), CAROM_ERR_NULL);

    /* the number of a removed body names no body, then the next one */
    CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
    check_no_body(1);
    CHECK_EQ(carom_body_add(world, &box_def), 1);
    def.stationary = true;
    CHECK_EQ(carom_body_add(world, &def), 2);
    CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
    CHECK_EQ(carom_body_remove(world, 2), CAROM_OK);
    a = carom_body_add(world, &box_def);
    def.stationary = true;
    b = carom_body_add(world, &def);
    CHECK((a == 1 && b == 2) || (a == 2 && b == 1));
    CHECK_EQ(state_of(a).position.c[2], box_def.position.c[2]);
}

/* Velocities are derived from momenta, which keep 40 fractional bits for any mass. */
static void check_get_set(uint32_t mass_q20, struct test_random *r)
{
    struct carom_body_state in, out;
    /* one q40 unit of momentum as a speed, and one of angular momentum with k^2 >= 0.05 */
    const int64_t unit = mass_q20 && mass_q20 < 1 << 20 ? (1 << 20) / mass_q20 : 1;

    setup();
    def.mass_q20 = mass_q20;
    CHECK_EQ(carom_body_add(world, &def), 0);
    for (int n = 0; n < 8; n++) {
        memset(&in, 0, sizeof in);
        in.rotation = shape_random_turn(r);
        for (int k = 0; k < 3; k++) {
            in.position.c[k] = test_random_range(r, -((int64_t)4096 << 32), (int64_t)4096 << 32);
            in.velocity.c[k] = test_random_range(r, -15 * ONE, 15 * ONE);
            in.spin.c[k] = test_random_range(r, -30 * ONE, 30 * ONE);
        }
        in.asleep = in.out = true; /* ignored */
        CHECK_EQ(carom_body_set(world, 0, &in), CAROM_OK);
        out = state_of(0);
        CHECK(!out.asleep);
        CHECK(!out.out);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(out.position.c[k], in.position.c[k]);
            /* the mass and its inverse are right to 2^-29 each */
            CHECK_NEAR(out.velocity.c[k], in.velocity.c[k], (15 * ONE >> 28) + unit);
            /* two turns there and back, right to 2^-27 of |w| < 52 each, and the same inverse of an
             * inertia whose entries are within a factor of 2 of each other */
            CHECK_NEAR(out.spin.c[k], in.spin.c[k], (64 * ONE >> 24) + 40 * unit);
        }
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(out.rotation.c[k], in.rotation.c[k], 3);
        }
    }
}

static void test_get_set(void)
{
    struct test_random r = {1};

    check_get_set(0, &r);
    check_get_set(1024, &r);
    check_get_set((uint32_t)1 << 30, &r);
}

static void refuse_set(const struct carom_body_state *s, int error)
{
    struct record before;

    take(&before);
    CHECK_EQ(carom_body_set(world, 1, s), error);
    check_unchanged(&before);
}

static void test_set_range(void)
{
    struct carom_body_state good, s;

    setup_bodies();
    s = good = state_of(1);
    for (int k = 0; k < 3; k++) {
        s.position.c[k] = ((int64_t)4096 << 32) + 1;
        refuse_set(&s, CAROM_ERR_RANGE);
        s.position.c[k] = INT64_MIN;
        refuse_set(&s, CAROM_ERR_RANGE);
        s = good;
        s.velocity.c[k] = -64 * ONE;
        refuse_set(&s, CAROM_ERR_RANGE);
        s.velocity.c[k] = INT64_MIN;
        refuse_set(&s, CAROM_ERR_RANGE);
        s = good;
        s.spin.c[k] = 64 * ONE;
        refuse_set(&s, CAROM_ERR_RANGE);
        s.spin.c[k] = INT64_MIN;
        refuse_set(&s, CAROM_ERR_RANGE);
        s = good;
    }
    s.rotation = stretched(true, CAROM_ONE_Q30 >> 9);
    refuse_set(&s, CAROM_ERR_ARGUMENT);
    s.rotation = stretched(false, -(CAROM_ONE_Q30 >> 9));
    refuse_set(&s, CAROM_ERR_ARGUMENT);
    s.rotation.c[2] = INT32_MIN;
    refuse_set(&s, CAROM_ERR_ARGUMENT);

    /* a spin that only a small body may have */
    CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
    use_giant();
    CHECK_EQ(carom_body_add(world, &def), 1);
    s = state_of(1);
    s.spin.c[1] = 60 * ONE;
    refuse_set(&s, CAROM_ERR_RANGE);
}

/*
 * A sleeping body wakes when it is placed again, even at the same place, and when another body is
 * removed.
 */
static void test_wake(void)
{
    struct carom_body_state s;

    setup_bodies();
    settle();
    s = state_of(1);
    CHECK(s.asleep);
    CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
    CHECK(!state_of(1).asleep);
    settle();
    s = state_of(1);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    CHECK(!state_of(1).asleep);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_LESS(state_of(1).position.c[2], s.position.c[2]);
}

/* -------------------------------------------------------------------- reports */

static void test_usage(void)
{
    static const char *const names[] = {"bodies",     "pairs",  "contacts", "faces", "entries",
                                        "candidates", "joints", "extras",   "hits"};
    static const uint32_t sizes[CAROM_POOL_COUNT] = {CAPS}; /* the last three have no room */
    const struct carom_face_ref *faces;
    struct carom_usage usage[CAROM_POOL_COUNT], last[CAROM_POOL_COUNT];
    uint32_t most_contacts = 0, most_faces = 0;

    setup();
    CHECK_EQ(CAROM_POOL_COUNT, 9);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        CHECK_EQ(strcmp(usage[i].name, names[i]), 0);
        CHECK_EQ(usage[i].size, sizes[i]);
        CHECK_EQ(usage[i].used, 0);
        CHECK_EQ(usage[i].peak, 0);
        CHECK_EQ(usage[i].refused, 0);
    }
    CHECK_EQ(carom_body_add(world, &floor_def), 0);
    CHECK_EQ(carom_body_add(world, &box_def), 1);
    memcpy(last, usage, sizeof last);
    for (int frame = 0; frame < 12; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_usage(world, usage), CAROM_OK);
        CHECK_EQ(usage[CAROM_POOL_bodies].used, 2);
        CHECK_EQ(usage[CAROM_POOL_contacts].used, carom_contacts(world, NULL, 0));
        /* bodies that touch are a pair; others may be one */
        CHECK(usage[CAROM_POOL_pairs].used == 1 || usage[CAROM_POOL_contacts].used == 0);
        CHECK_EQ(usage[CAROM_POOL_faces].used, carom_interfering_faces(world, &faces));
        for (int i = 0; i < CAROM_POOL_COUNT; i++) {
            CHECK_AT_MOST(usage[i].used, usage[i].peak);
            CHECK_AT_MOST(usage[i].peak, usage[i].size);
            CHECK_AT_LEAST(usage[i].peak, last[i].peak);
        }
        most_contacts = usage[CAROM_POOL_contacts].used > most_contacts
                            ? usage[CAROM_POOL_contacts].used
                            : most_contacts;
        most_faces =
            usage[CAROM_POOL_faces].used > most_faces ? usage[CAROM_POOL_faces].used : most_faces;
        memcpy(last, usage, sizeof last);
    }
    CHECK_MORE(most_contacts, 0);
    CHECK_AT_LEAST(usage[CAROM_POOL_contacts].peak, most_contacts);
    CHECK_MORE(most_faces, 0);
    CHECK_AT_LEAST(usage[CAROM_POOL_faces].peak, most_faces);
    CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    CHECK_EQ(usage[CAROM_POOL_bodies].used, 1);
    CHECK_EQ(usage[CAROM_POOL_bodies].peak, 2);
}

static void test_texts(void)
{
    /* all sums of status bits, all errors, and numbers that are neither */
    const char *text[25];
    int n = 0;

    for (int result = 3; result >= CAROM_ERR_NO_ENTRIES - 1; result--) {
        text[n++] = carom_result_text(result);
    }
    CHECK_EQ(n, 25);
    for (int i = 0; i < n; i++) {
        CHECK(text[i] != NULL);
        CHECK(text[i] && text[i][0] != '\0');
        for (int k = 0; k < i; k++) {
            CHECK(text[i]);
            CHECK(text[k]);
            CHECK_DIFFER(strcmp(text[i], text[k]), 0);
        }
    }
    CHECK(carom_result_text(INT32_MIN) != NULL);
    CHECK(carom_result_text(INT32_MAX) != NULL);
    CHECK(carom_result_text(4) != NULL);
}

/* The library's version is that of the header, and the text has its three parts. */
static void test_version(void)
{
    int part[3] = {0, 0, 0}, k = 0;

    for (const char *at = CAROM_VERSION_TEXT; *at; at++) {
        if (*at == '.') {
            k++;
            CHECK_LESS(k, 3);
            continue;
        }
        part[k] = part[k] * 10 + (*at - '0');
    }
    CHECK_EQ(k, 2);
    CHECK_EQ(part[0], CAROM_VERSION_MAJOR);
    CHECK_EQ(carom_version(), part[0] * 10000 + part[1] * 100 + part[2]);
}

static void test_stage_names(void)
{
    static const char *const names[] = {"predict", "broad", "interfere", "boyse", "contact",
                                        "impact",  "rest",  "advance",   "commit"};

    CHECK_EQ(CAROM_STAGE_COUNT, 9);
    for (int i = 0; i < CAROM_STAGE_COUNT; i++) {
        CHECK_EQ(strcmp(carom_stage_name(i), names[i]), 0);
    }
    CHECK_EQ(strcmp(carom_stage_name(-1), "unknown"), 0);
    CHECK_EQ(strcmp(carom_stage_name(CAROM_STAGE_COUNT), "unknown"), 0);
    CHECK_EQ(strcmp(carom_stage_name(INT32_MIN), "unknown"), 0);
    CHECK_EQ(strcmp(carom_stage_name(INT32_MAX), "unknown"), 0);
}

static void test_report_null(void)
{
    struct carom_usage usage[CAROM_POOL_COUNT];
    const struct carom_face_ref *faces;
    const struct carom_event *events;
    struct carom_contact contact;
    struct carom_stats stats;

    setup_bodies();
    CHECK_EQ(carom_world_step(NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_events(NULL, &events), CAROM_ERR_NULL);
    CHECK_EQ(carom_events(world, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_interfering_faces(NULL, &faces), CAROM_ERR_NULL);
    CHECK_EQ(carom_interfering_faces(world, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_contacts(NULL, &contact, 1), CAROM_ERR_NULL);
    CHECK_EQ(carom_contacts(world, NULL, 1), CAROM_ERR_NULL);
    CHECK_EQ(carom_stats(NULL, &stats), CAROM_ERR_NULL);
    CHECK_EQ(carom_stats(world, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_usage(NULL, usage), CAROM_ERR_NULL);
    CHECK_EQ(carom_usage(world, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_world_hash(NULL), 0);
    /* there are no events before the first step */
    CHECK_EQ(carom_events(world, &events), 0);
    CHECK_EQ(carom_interfering_faces(world, &faces), 0);
    CHECK_EQ(carom_contacts(world, &contact, 1), 0);
}

/* ------------------------------------------------------------------------ out */

/* One OUT event, in this frame. Then the body is frozen until it is placed again. */
static void check_frozen(const struct carom_body_state *last)
{
    struct carom_body_state s = state_of(0);

    CHECK(s.out);
    CHECK_EQ(count_events(CAROM_EVENT_OUT, 0), 1);
    for (int k = 0; k < 3; k++) {
        /* a unit of 2^-22: the mass and the velocity are rounded */
        CHECK_NEAR(s.position.c[k], last->position.c[k], 1 << 10);
    }
    CHECK_EQ(memcmp(&s.rotation, &last->rotation, sizeof s.rotation), 0);
    for (int frame = 0; frame < 3; frame++) {
        uint64_t hash = carom_world_hash(world);

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(count_events(CAROM_EVENT_OUT, 0), 0);
        CHECK_EQ(carom_world_hash(world), hash);
    }
    CHECK_EQ(carom_body_set(world, 0, &(struct carom_body_state){.rotation = s.rotation}),
             CAROM_OK);
    CHECK(!state_of(0).out);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_LESS(state_of(0).position.c[2], 0);
}

/*
 * Step until the body is out. The number of frames is worked out by hand, and so is the distance
 * along z in the last frame: 0 when that place is out of range.
 */
static void check_leaves(int frames, int64_t way_q32)
{
    struct carom_body_state last;

    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), 0);
    for (int frame = 1; frame < frames; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(count_events(CAROM_EVENT_OUT, 0), 0);
        CHECK(!state_of(0).out);
    }
    last = state_of(0);
    last.position.c[2] += way_q32;
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    check_frozen(&last);
    def = box_def;
}

static void test_out(void)
{
    setup();
    for (int k = 0; k < 2; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            /* 3.9 units in the first three frames stay inside, 5.2 in four do not */
            def.position.c[k] = sign * ((int64_t)4092 << 32);
            def.velocity.c[k] = sign * (13 * ONE / 10);
            def.spin.c[0] = ONE / 8;
            check_leaves(4, 0);
        }
    }
    /* from rest at 1 unit / frame^2 the 64th frame ends with a speed of 64, 63.5 units farther */
    config.gravity.c[2] = -ONE;
    def.position.c[2] = 0;
    check_leaves(64, -((int64_t)127 << 31));
}

const struct test tests_world[] = {
    {"world/init_memory", test_init_memory},
    {"world/init_capacities", test_init_capacities},
    {"world/init_range", test_init_range},
    {"world/fast_spin", test_fast_spin},
    {"world/add_arguments", test_add_arguments},
    {"world/add_null", test_add_null},
    {"world/add_rotation", test_add_rotation},
    {"world/add_range", test_add_range},
    {"world/add_volume", test_add_volume},
    {"world/add_giant", test_add_giant},
    {"world/add_full", test_add_full},
    {"world/numbers", test_numbers},
    {"world/get_set", test_get_set},
    {"world/set_range", test_set_range},
    {"world/wake", test_wake},
    {"world/usage", test_usage},
    {"world/texts", test_texts},
    {"world/version", test_version},
    {"world/stage_names", test_stage_names},
    {"world/report_null", test_report_null},
    {"world/out", test_out},
    {0},
};

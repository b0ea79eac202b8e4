/* SPDX-License-Identifier: MIT */
/*
 * Snapshots and the hash: a world goes on from a snapshot as if nothing had happened, in flight, in
 * contact and asleep; incomplete or changed bytes are refused; the layout is the one of SPEC.md.
 */
#include <string.h>

#include "lib/bytes.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define STRIDE 1
#else
#define STRIDE 7 /* every STRIDE-th byte of a large snapshot; every byte of a small one */
#endif

#define FRAMES 50
#define CAPS   3, 2, 16, 64, 64, 128
#define ONE    ((int64_t)1 << 40)

/* Offsets in a snapshot of a stationary body, a moving one and a free place. */
enum {
    AT_GRAVITY = 4,
    AT_PLACES = 28,
    AT_GROUND = 32,
    BODY_BYTES = 117,
    AT_BOX = AT_GROUND + BODY_BYTES,
    AT_POSITION = 1, /* offsets in a body */
    AT_MOMENTUM = 25,
    AT_ANGULAR = 49,
    AT_FORCE = 73,
    AT_ROTATION = 97,
    AT_ASLEEP = 113,
    AT_OUT = 114,
    AT_QUIET = 115,
    AT_WOKEN = 116,
    AT_FREE = AT_BOX + BODY_BYTES,
    AT_WARM = AT_FREE + 1,
    WARM_BYTES = 60
};

static _Alignas(8) uint8_t block[2][CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[2048], other[2048];
static struct shape box, ground;
static struct carom_config config;
static struct carom_body_def floor_def, box_def;

/* ------------------------------------------------------------------- helpers */

/* A box a little above a plane that leans by 3.6 degrees; the box leans alike and has some spin. */
static void setup(void)
{
    const struct carom_caps caps = CAROM_CAPS(CAPS);
    const carom_quat_q30 lean = {{CAROM_ONE_Q30, CAROM_ONE_Q30 / 32, 0, 0}};

    shape_box(&box, 12, 4096, 2868, 2048);
    shape_plane(&ground, 12, 2, 8192);
    memset(&config, 0, sizeof config);
    config.caps = caps;
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    config.sleep = true;
    memset(&floor_def, 0, sizeof floor_def);
    floor_def.mesh = &ground.mesh;
    floor_def.stationary = true;
    floor_def.rotation = lean;
    floor_def.friction_q16 = 1 << 15;
    floor_def.restitution_q30 = CAROM_ONE_Q30 / 4;
    box_def = floor_def;
    box_def.mesh = &box.mesh;
    box_def.stationary = false;
    box_def.position.c[2] = CAROM_RATIO(30, 100, 32);
    box_def.velocity.c[0] = ONE / 256;
    box_def.spin.c[1] = ONE / 128;
    box_def.spin.c[2] = ONE / 64;
}

static struct carom_world *empty_world(int n)
{
    struct carom_world *w = NULL;

    CHECK_EQ(carom_world_init(block[n], sizeof block[n], &config, &w), CAROM_OK);
    return w;
}

/* The plane as body 0, the box as body 1; number 2 was in use and is free. */
static struct carom_world *make(int n)
{
    struct carom_world *w = empty_world(n);

    CHECK_EQ(carom_body_add(w, &floor_def), 0);
    box_def.overlap = floor_def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(carom_body_add(w, &box_def), 1);
    CHECK_EQ(carom_body_add(w, &floor_def), 2);
    CHECK_EQ(carom_body_remove(w, 2), CAROM_OK);
    return w;
}

/* The same bodies with another history. */
static struct carom_world *make_elsewhere(int n)
{
    struct carom_world *w = make(n);
    struct carom_body_state s;

    for (int frame = 0; frame < 4; frame++) {
        CHECK_EQ(carom_world_step(w), CAROM_OK);
    }
    CHECK_EQ(carom_body_get(w, 1, &s), CAROM_OK);
    s.position.c[0] -= (int64_t)1 << 31;
    s.spin.c[0] += ONE / 16;
    CHECK_EQ(carom_body_set(w, 1, &s), CAROM_OK);
    CHECK_EQ(carom_world_step(w), CAROM_OK);
    return w;
}

static int save(const struct carom_world *w, uint8_t *bytes)
{
    int n = carom_snapshot_save(w, bytes, sizeof saved);

    CHECK_MORE(n, AT_WARM);
    CHECK_EQ(n, carom_snapshot_size(w));
    CHECK_AT_MOST(n, CAROM_SNAPSHOT_BYTES(CAPS));
    return n > 0 ? n : 0;
}

enum phase { FLIGHT, CONTACT, ASLEEP };

/* Go on until the box has flown a little, has lain quietly with impulses to keep, or sleeps. */
static void run_to(struct carom_world *w, enum phase phase)
{
    bool there = false;
    int frame;

    for (frame = 0; frame < 400 && !there; frame++) {
        CHECK_EQ(carom_world_step(w), CAROM_OK);
        save(w, saved);
        if (phase == FLIGHT) {
            there = frame == 2;
            CHECK_EQ(saved[AT_BOX + AT_QUIET], 0);
            CHECK_EQ(bytes_number(saved + AT_WARM, 4), 0);
        } else if (phase == CONTACT) {
            there = saved[AT_BOX + AT_QUIET] >= 5 && bytes_number(saved + AT_WARM, 4) > 0;
        } else {
            there = saved[AT_BOX + AT_ASLEEP] == 1;
        }
    }
    CHECK(there);
}

/* --------------------------------------------------------------------- future */

static void check_same_events(const struct carom_world *a, const struct carom_world *b)
{
    const struct carom_event *e, *f;
    int n = carom_events(a, &e);

    CHECK_EQ(carom_events(b, &f), n);
    for (int i = 0; i < n; i++) {
        CHECK_EQ(e[i].kind, f[i].kind);
        CHECK_EQ(e[i].a, f[i].a);
        CHECK_EQ(e[i].b, f[i].b);
        CHECK_EQ(e[i].speed_q40, f[i].speed_q40);
        CHECK_EQ(e[i].impulse_q40, f[i].impulse_q40);
    }
}

static void push(struct carom_world *w)
{
    struct carom_body_state s;

    CHECK_EQ(carom_body_get(w, 1, &s), CAROM_OK);
    s.velocity.c[2] = ONE / 64;
    CHECK_EQ(carom_body_set(w, 1, &s), CAROM_OK);
}

/*
 * A world with another history loads the snapshot and goes on like the first; halfway it is pushed.
 */
static void check_future(enum phase phase)
{
    struct carom_world *a, *b;
    uint64_t last;
    int size, changes = 0;

    setup();
    a = make(0);
    run_to(a, phase);
    size = save(a, saved);
    b = make_elsewhere(1);
    CHECK_DIFFER(carom_world_hash(a), carom_world_hash(b));
    CHECK_EQ(carom_snapshot_load(b, saved, (size_t)size), CAROM_OK);
    CHECK_EQ(carom_world_hash(a), carom_world_hash(b));
    CHECK_EQ(save(b, other), size);
    CHECK_EQ(memcmp(saved, other, (size_t)size), 0);
    last = carom_world_hash(a);
    for (int frame = 0; frame < FRAMES; frame++) {
        if (frame == FRAMES / 2) {
            push(a);
            push(b);
        }
        CHECK_EQ(carom_world_step(a), CAROM_OK);
        CHECK_EQ(carom_world_step(b), CAROM_OK);
        CHECK_EQ(carom_world_hash(a), carom_world_hash(b));
        CHECK_EQ(carom_contacts(a, NULL, 0), carom_contacts(b, NULL, 0));
        check_same_events(a, b);
        changes += carom_world_hash(a) != last;
        last = carom_world_hash(a);
    }
    /* those frames were not idle */
    CHECK_AT_LEAST(changes, FRAMES / 2);
}

static void test_flight(void)
{
    check_future(FLIGHT);
}

static void test_contact(void)
{
    check_future(CONTACT);
}

static void test_asleep(void)
{
    check_future(ASLEEP);
}

/* A world goes back to its own snapshot and comes to the same end. */
static void test_rewind(void)
{
    struct carom_world *w;
    uint64_t end[2];
    int size;

    setup();
    w = make(0);
    run_to(w, FLIGHT);
    size = save(w, saved);
    for (int run = 0; run < 2; run++) {
        CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
        CHECK_EQ(carom_world_hash(w), bytes_fnv64(saved, (size_t)size));
        for (int frame = 0; frame < 20; frame++) {
            CHECK_EQ(carom_world_step(w), CAROM_OK);
        }
        end[run] = carom_world_hash(w);
    }
    CHECK_EQ(end[0], end[1]);
    CHECK_DIFFER(end[0], bytes_fnv64(saved, (size_t)size));
}

/* -------------------------------------------------------------------- refusal */

static void refuse(struct carom_world *w, const uint8_t *bytes, int n)
{
    const uint64_t hash = carom_world_hash(w);

    CHECK_EQ(carom_snapshot_load(w, bytes, (size_t)n), CAROM_ERR_FORMAT);
    CHECK_EQ(carom_world_hash(w), hash);
}

/* Every part of the snapshot, every byte altered, and some bytes too many. */
static void check_altered(struct carom_world *w, int size, int stride)
{
    CHECK_MORE(size, 0);
    CHECK_AT_MOST(size + 8, (int)sizeof saved);
    memcpy(other, saved, sizeof other);
    for (int n = 0; n < size; n += stride) {
        refuse(w, saved, n);
    }
    refuse(w, saved, size - 1);
    for (int i = 0; i < size; i += stride) {
        other[i] ^= 0xff;
        refuse(w, other, size);
        other[i] ^= 0xff ^ 1;
        refuse(w, other, size);
        other[i] = saved[i];
    }
    for (int more = 1; more <= 8; more++) {
        refuse(w, saved, size + more);
    }
}

/*
 * A refusal leaves the world as it was: it goes on like a twin that was never given any of the
 * snapshots, and it loads the complete snapshot.
 */
static void test_altered(void)
{
    struct carom_world *w, *twin;
    int size;

    setup();
    w = make(0);
    run_to(w, CONTACT);
    size = save(w, saved);
    w = make_elsewhere(0);
    twin = make_elsewhere(1);
    check_altered(w, size, STRIDE);
    for (int frame = 0; frame < 3; frame++) {
        CHECK_EQ(carom_world_step(w), CAROM_OK);
        CHECK_EQ(carom_world_step(twin), CAROM_OK);
        CHECK_EQ(carom_world_hash(w), carom_world_hash(twin));
    }
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    CHECK_EQ(carom_world_hash(w), bytes_fnv64(saved, (size_t)size));
}

/* One body in flight: every length and every byte, on every machine. */
static void test_altered_small(void)
{
    struct carom_world *w;
    int size;

    setup();
    w = empty_world(0);
    CHECK_EQ(carom_body_add(w, &box_def), 0);
    CHECK_EQ(carom_world_step(w), CAROM_OK);
    size = carom_snapshot_save(w, saved, sizeof saved);
    CHECK_EQ(size, AT_GROUND + BODY_BYTES + 4 + 4 + 8);
    CHECK_EQ(carom_world_step(w), CAROM_OK);
    check_altered(w, size, 1);
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
}

/* Worlds with other bodies: fewer, more, of another kind, in another order, with less room. */
static void test_other_bodies(void)
{
    struct carom_world *w;
    int size;

    setup();
    w = make(0);
    run_to(w, CONTACT);
    size = save(w, saved);
    CHECK_MORE(bytes_number(saved + AT_WARM, 4), 1);

    refuse(empty_world(1), saved, size);
    w = empty_world(1);
    CHECK_EQ(carom_body_add(w, &floor_def), 0);
    CHECK_EQ(carom_body_add(w, &box_def), 1);
    refuse(w, saved, size); /* no third place */
    CHECK_EQ(carom_body_add(w, &floor_def), 2);
    refuse(w, saved, size); /* a third body */
    CHECK_EQ(carom_body_remove(w, 2), CAROM_OK);
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    CHECK_EQ(carom_body_remove(w, 1), CAROM_OK);
    refuse(w, saved, size); /* no box */
    box_def.stationary = true;
    CHECK_EQ(carom_body_add(w, &box_def), 1);
    refuse(w, saved, size); /* a stationary box */
    box_def.stationary = false;

    w = empty_world(1);
    CHECK_EQ(carom_body_add(w, &box_def), 0);
    CHECK_EQ(carom_body_add(w, &floor_def), 1);
    CHECK_EQ(carom_body_add(w, &floor_def), 2);
    CHECK_EQ(carom_body_remove(w, 2), CAROM_OK);
    refuse(w, saved, size);
    config.caps.contacts = 1;
    refuse(make(1), saved, size);
}

/*
 * Alter one number and correct the check sum: the bytes are complete, but no step could have left
 * them.
 */
static void refuse_number(struct carom_world *w, int size, int at, uint64_t v, int n)
{
    memcpy(other, saved, sizeof other);
    bytes_put(other + at, v, n);
    bytes_mend(other, (size_t)size);
    refuse(w, other, size);
}

static void test_implausible(void)
{
    const int far = AT_BOX + AT_POSITION, fast = AT_BOX + AT_MOMENTUM;
    struct carom_world *w;
    int size, touching;

    setup();
    w = make(0);
    run_to(w, CONTACT);
    size = save(w, saved);
    w = make_elsewhere(0);
    touching = AT_WARM + 4 + WARM_BYTES * (int)bytes_number(saved + AT_WARM, 4);
    CHECK_EQ(bytes_number(saved + touching, 4), 1);

    refuse_number(w, size, 0, 0x31534d43, 4);
    refuse_number(w, size, AT_PLACES, 2, 4);
    refuse_number(w, size, AT_BOX, 1, 1);
    refuse_number(w, size, AT_BOX, 3, 1);
    for (int k = 0; k < 3; k++) {
        refuse_number(w, size, far + 8 * k, ((uint64_t)4096 << 32) + 1, 8);
        refuse_number(w, size, far + 8 * k, (uint64_t)1 << 63, 8);
        /* the box has mass 0.35: a momentum of 23 is a speed above 64 */
        refuse_number(w, size, fast + 8 * k, (uint64_t)(23 * ONE), 8);
        refuse_number(w, size, fast + 8 * k, (uint64_t)(-23 * ONE), 8);
        refuse_number(w, size, fast + 8 * k, (uint64_t)1 << 62, 8);
        refuse_number(w, size, fast + 8 * k, (uint64_t)1 << 63, 8);
        refuse_number(w, size, AT_BOX + AT_ANGULAR + 8 * k, (uint64_t)1 << 62, 8);
        refuse_number(w, size, AT_BOX + AT_ANGULAR + 8 * k, (uint64_t)1 << 63, 8);
        refuse_number(w, size, AT_BOX + AT_ANGULAR + 8 * k, INT64_MAX, 8);
        refuse_number(w, size, AT_GROUND + AT_MOMENTUM + 8 * k, 1, 8);
    }
    for (int k = 0; k < 3; k++) {
        refuse_number(w, size, AT_GRAVITY + 8 * k, (uint64_t)ONE + 1, 8);
        refuse_number(w, size, AT_GRAVITY + 8 * k, (uint64_t)1 << 63, 8);
        refuse_number(w, size, AT_GROUND + AT_FORCE + 8 * k, 1, 8);
        /* by mass, 1.14 */
        refuse_number(w, size, AT_BOX + AT_FORCE + 8 * k, (uint64_t)(ONE / 5 * 2), 8);
        refuse_number(w, size, AT_BOX + AT_FORCE + 8 * k, (uint64_t)(-ONE / 5 * 2), 8);
        refuse_number(w, size, AT_BOX + AT_FORCE + 8 * k, (uint64_t)1 << 63, 8);
    }
    refuse_number(w, size, AT_BOX + AT_ROTATION, 0, 4);
    refuse_number(w, size, AT_BOX + AT_ROTATION, (uint32_t)INT32_MIN, 4);
    refuse_number(w, size, AT_GROUND + AT_ROTATION + 8, CAROM_ONE_Q30, 4);
    refuse_number(w, size, AT_BOX + AT_ASLEEP, 2, 1);
    refuse_number(w, size, AT_BOX + AT_OUT, 2, 1);
    refuse_number(w, size, AT_BOX + AT_WOKEN, 2, 1);
    refuse_number(w, size, AT_GROUND + AT_WOKEN, 1, 1);
    refuse_number(w, size, AT_GROUND + AT_ASLEEP, 1, 1);
    refuse_number(w, size, AT_WARM, 17, 4);
    for (int side = 0; side < 2; side++) {
        refuse_number(w, size, AT_WARM + 4 + 2 * side, 3, 2);
        refuse_number(w, size, AT_WARM + 4 + 2 * side, 0xffff, 2);
        refuse_number(w, size, touching + 4 + 2 * side, 3, 2);
        refuse_number(w, size, touching + 4 + 2 * side, 0xffff, 2);
    }
    /* correcting the check sum does not itself spoil a snapshot */
    memcpy(other, saved, sizeof other);
    bytes_put(other + far, 0, 8);
    bytes_mend(other, (size_t)size);
    CHECK_EQ(carom_snapshot_load(w, other, (size_t)size), CAROM_OK);
}

/* --------------------------------------------------------------------- memory */

static void test_memory(void)
{
    struct carom_world *w;
    bool clean = true;
    int size;

    setup();
    w = make(0);
    size = carom_snapshot_size(w);
    /* no impulses and no touching pairs yet */
    CHECK_EQ(size, AT_WARM + 4 + 4 + 8);
    memset(saved, 0xa5, sizeof saved);
    CHECK_EQ(carom_snapshot_save(w, saved, 0), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_snapshot_save(w, saved, (size_t)size - 1), CAROM_ERR_MEMORY);
    for (size_t i = 0; i < sizeof saved; i++) {
        clean = clean && saved[i] == 0xa5;
    }
    CHECK(clean);
    CHECK_EQ(carom_snapshot_save(w, saved, (size_t)size), size);
    for (int i = size; i < (int)sizeof saved; i++) {
        clean = clean && saved[i] == 0xa5;
    }
    CHECK(clean);
    /* any alignment will do */
    CHECK_EQ(carom_snapshot_save(w, other + 3, (size_t)size), size);
    CHECK_EQ(memcmp(saved, other + 3, (size_t)size), 0);
    CHECK_EQ(carom_snapshot_load(w, other + 3, (size_t)size), CAROM_OK);

    CHECK_EQ(carom_snapshot_size(NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_snapshot_save(NULL, saved, sizeof saved), CAROM_ERR_NULL);
    CHECK_EQ(carom_snapshot_save(w, NULL, sizeof saved), CAROM_ERR_NULL);
    CHECK_EQ(carom_snapshot_load(NULL, saved, (size_t)size), CAROM_ERR_NULL);
    CHECK_EQ(carom_snapshot_load(w, NULL, (size_t)size), CAROM_ERR_NULL);
}

/* --------------------------------------------------------------------- layout */

static void check_bytes(int at, const uint8_t *expected, int n)
{
    for (int i = 0; i < n; i++) {
        CHECK_EQ(saved[at + i], expected[i]);
    }
}

/* Fixed places, byte by byte. */
static void test_layout(void)
{
    static const uint8_t start[] = {'C', 'M', 'S', '2'}, places[] = {3, 0, 0, 0, 1};
    /* 0x123456789ab, -2, 7 << 32 */
    static const uint8_t position[] = {0xab, 0x89, 0x67, 0x45, 0x23, 0x01, 0,    0,
                                       0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                                       0,    0,    0,    0,    7,    0,    0,    0};
    /* half a turn about z: (0, 0, 0, 1) */
    static const uint8_t rotation[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x40};
    static const uint8_t none[72] = {0};
    static const uint8_t through[] = {'T', 'H', 'R', '1', 1, 0, 0, 0, 1, 0, 0, 0};
    const carom_v3_q40 gravity = {{-5, 0x123456789a, 7}}, force = {{0, -1, (int64_t)1 << 36}};
    struct carom_world *w;
    struct carom_body_state s;
    int size;

    setup();
    /* a cube of volume, and so mass, 1: its momentum is its velocity */
    shape_box(&box, 12, 4096, 4096, 4096);
    w = make(0);
    memset(&s, 0, sizeof s);
    s.position = (carom_v3_q32){{0x123456789ab, -2, (int64_t)7 << 32}};
    s.rotation.c[3] = CAROM_ONE_Q30;
    s.overlap = CAROM_OVERLAP_PASS; /* both are in one place */
    CHECK_EQ(carom_body_set(w, 0, &s), CAROM_OK);
    s.velocity.c[1] = -3 * ONE;
    CHECK_EQ(carom_body_set(w, 1, &s), CAROM_OK);
    CHECK_EQ(carom_world_set_gravity(w, &gravity), CAROM_OK);
    CHECK_EQ(carom_body_set_force(w, 1, &force), CAROM_OK);
    size = save(w, saved);
    CHECK_EQ(size, AT_WARM + 4 + 4 + 12 + 8);
    check_bytes(AT_WARM + 8, through, sizeof through);
    check_bytes(0, start, sizeof start);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(bytes_number(saved + AT_GRAVITY + 8 * k, 8), gravity.c[k]);
    }
    check_bytes(AT_PLACES, places, sizeof places);
    check_bytes(AT_GROUND + AT_POSITION, position, sizeof position);
    check_bytes(AT_GROUND + AT_MOMENTUM, none, 72);
    check_bytes(AT_GROUND + AT_ROTATION, rotation, sizeof rotation);
    check_bytes(AT_GROUND + AT_ASLEEP, none, 4);
    CHECK_EQ(saved[AT_BOX], 2);
    check_bytes(AT_BOX + AT_POSITION, position, sizeof position);
    CHECK_EQ(bytes_number(saved + AT_BOX + AT_MOMENTUM + 8, 8), -3 * ONE);
    check_bytes(AT_BOX + AT_ANGULAR, none, 24);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(bytes_number(saved + AT_BOX + AT_FORCE + 8 * k, 8), force.c[k]);
    }
    check_bytes(AT_BOX + AT_ROTATION, rotation, sizeof rotation);
    check_bytes(AT_BOX + AT_ASLEEP, none, 4);
    CHECK_EQ(saved[AT_FREE], 0);
    check_bytes(AT_WARM, none, 8);
    CHECK_EQ(bytes_number(saved + size - 8, 8), bytes_fnv64(saved, (size_t)(size - 8)));
}

/* Kept impulses and the touching pair of a box that lies on the plane. */
static void test_layout_contact(void)
{
    struct carom_world *w;
    int size, count, touching;

    setup();
    w = make(0);
    run_to(w, CONTACT);
    size = save(w, saved);
    count = (int)bytes_number(saved + AT_WARM, 4);
    touching = AT_WARM + 4 + WARM_BYTES * count;
    CHECK_AT_LEAST(count, 3);
    CHECK_AT_MOST(count, 16); /* it lies on a face */
    CHECK_EQ(size, touching + 4 + 4 + 8);
    CHECK_EQ(bytes_number(saved + touching, 4), 1);
    CHECK_EQ(saved[touching + 4] + saved[touching + 6], 1);
    for (int i = 0; i < count; i++) {
        const uint8_t *warm = saved + AT_WARM + 4 + WARM_BYTES * i;
        int64_t square_q60 = 0;

        /* the same two bodies, a unit normal, and an impulse that does not pull */
        CHECK_EQ(memcmp(warm, saved + touching + 4, 4), 0);
        for (int k = 0; k < 3; k++) {
            int64_t n_q30 = (int32_t)(uint32_t)bytes_number(warm + 16 + 4 * k, 4);

            square_q60 += n_q30 * n_q30;
        }
        CHECK_NEAR(square_q60, (int64_t)1 << 60, (int64_t)1 << 34);
        CHECK_AT_LEAST((int64_t)bytes_number(warm + 28, 8), 0);
    }
    CHECK_EQ(carom_world_hash(w), bytes_fnv64(saved, (size_t)size));
}

/* The hash is the FNV-1a of the saved bytes, in every phase. */
static void test_hash(void)
{
    setup();
    for (int phase = FLIGHT; phase <= ASLEEP; phase++) {
        struct carom_world *w = make(0);
        int size;

        run_to(w, (enum phase)phase);
        size = save(w, saved);
        CHECK_EQ(carom_world_hash(w), bytes_fnv64(saved, (size_t)size));
        CHECK_EQ(bytes_number(saved + size - 8, 8), bytes_fnv64(saved, (size_t)(size - 8)));
    }
    CHECK_EQ(carom_world_hash(NULL), 0);
}

const struct test tests_world_snapshot[] = {
    {"world_snapshot/flight", test_flight},
    {"world_snapshot/contact", test_contact},
    {"world_snapshot/asleep", test_asleep},
    {"world_snapshot/rewind", test_rewind},
    {"world_snapshot/altered", test_altered},
    {"world_snapshot/altered_small", test_altered_small},
    {"world_snapshot/other_bodies", test_other_bodies},
    {"world_snapshot/implausible", test_implausible},
    {"world_snapshot/memory", test_memory},
    {"world_snapshot/layout", test_layout},
    {"world_snapshot/layout_contact", test_layout_contact},
    {"world_snapshot/hash", test_hash},
    {0},
};

/* SPDX-License-Identifier: MIT */
/*
 * Where a thing stands in its pool means nothing. One world has bodies with joints, materials, sensors and more, and random calls;
 * the other has the same, and before them a group far away, which takes the first places of each pool. The bodies of both move alike
 * to the bit, their events come in the same order, and queries find the same. So do two worlds of which one gets calls that are refused,
 * or goes on by a step and back before each step.
 */
#include <string.h>

#include "carom_body.h"
#include "carom_joint.h"
#include "carom_query.h"
#include "lib/box.h"
#include "lib/test.h"

#define CAPS   16, 64, 160, 256, 0, 512, 4, 10, 64
#define FRAMES 130
#ifdef TEST_LONG
#define WORLDS 9
#else
#define WORLDS 2
#endif
/* 2^-10 unit */
#define Q32(n) ((int64_t)(n) * ((int64_t)1 << 22))
#define Q40(n) ((int64_t)(n) * ((int64_t)1 << 30))

enum { PLATE, CUBE, BAR, MESHES };
/* The parts of both worlds, a body each. Another one is first in each run. */
enum { FIRST, JOINED, HANGING, GROUND, PUSHER, SENSOR, ONE_WAY, PASSING, LAST, BODIES };
enum { FAR_GROUND, FAR_A, FAR_B, FAR_SENSOR, FAR_PUSHER, BEFORE };
#define FAR_X 3000000

static const int halves[MESHES][3] = {{3000, 3000, 100}, {150, 140, 130}, {60, 400, 50}};
static _Alignas(8) uint8_t mesh_block[MESHES][CAROM_MESH_BYTES(8, 12)];
static _Alignas(8) uint8_t block[2][CAROM_WORLD_BYTES(CAPS)];
static int16_t corners[MESHES][8][3];
static struct carom_mesh mesh[MESHES];
static uint8_t saved[8192];
static struct carom_world *world[2];
static struct test_random chance, more;
static int first; /* the number of part 0 in the first world */

static int64_t any(int64_t most)
{
    return test_random_range(&chance, -most, most);
}

/* A body's number in a world, by its number in the first one. */
static int numbered(int which, int body)
{
    return body + which * BEFORE;
}

/* The number of a part in a world. */
static int part(int which, int played)
{
    return numbered(which, (played + first) % BODIES);
}

static void make_meshes(void)
{
    for (int i = 0; i < MESHES; i++) {
        const int low[3] = {-halves[i][0], -halves[i][1], -halves[i][2]};
        struct carom_mesh_raw raw = {
            (const int16_t(*)[3])corners[i], box_faces, 8, 12, 10, CAROM_SOLID};

        box_corners(corners[i], low, halves[i]);
        CHECK_EQ(carom_mesh_build(&mesh[i], &raw, mesh_block[i], sizeof mesh_block[i]), CAROM_OK);
    }
}

static struct carom_body_def body_of(int number, int x, int y, int z)
{
    return (struct carom_body_def){.mesh = &mesh[number],
                                   .position = {{Q32(x), Q32(y), Q32(z)}},
                                   .restitution_q30 = CAROM_ONE_Q30 / 4,
                                   .friction_q16 = 1 << 15};
}

/* A cube on a ground of its own, and another one that a joint holds; a sensor and a kinematic bar in them. */
static void add_far(struct carom_world *w)
{
    const struct carom_material rough = {CAROM_ONE_Q30 / 8, 1 << 16, 1 << 12, {{0, 1 << 28, 0}}};
    struct carom_joint_def joint = {.kind = CAROM_JOINT_BALL, .a = FAR_B, .b = FAR_A};
    struct carom_body_def def = body_of(PLATE, FAR_X, 0, 0);

    def.stationary = true;
    CHECK_EQ(carom_body_add(w, &def), FAR_GROUND);
    def = body_of(CUBE, FAR_X, 0, 240);
    CHECK_EQ(carom_body_add(w, &def), FAR_A);
    def = body_of(CUBE, FAR_X, 100, 600);
    CHECK_EQ(carom_body_add(w, &def), FAR_B);
    joint.anchor = def.position;
    CHECK_EQ(carom_joint_add(w, &joint), 0);
    def = body_of(CUBE, FAR_X, 100, 300);
    def.sensor = def.stationary = true;
    CHECK_EQ(carom_body_add(w, &def), FAR_SENSOR);
    def = body_of(BAR, FAR_X + 350, 0, 200);
    def.kinematic = true;
    def.velocity.c[0] = -Q40(1);
    CHECK_EQ(carom_body_add(w, &def), FAR_PUSHER);
    CHECK_EQ(carom_body_set_material(w, FAR_A, &rough), CAROM_OK);
}

static struct carom_body_def def_of(int number)
{
    const int body = (number + BODIES - first) % BODIES;
    struct carom_body_def def = body_of(body == GROUND || body == SENSOR ? PLATE
                                        : body % 2                       ? BAR
                                                                         : CUBE,
                                        400 * (body % 3), 900 * (body / 3), 300 + 60 * body);

    if (body == GROUND ||
        body == SENSOR) { /* the sensor lies over the ground, around what rests on it */
        def.position = (carom_v3_q32){{0, 0, body == SENSOR ? Q32(210) : 0}};
        def.stationary = true;
    }
    def.kinematic = body == PUSHER;
    def.sensor = body == SENSOR;
    def.one_way = body == ONE_WAY ? CAROM_ONE_WAY_Z : CAROM_BOTH_WAYS;
    if (body == PASSING) { /* in the joined bar */
        def.position = (carom_v3_q32){{Q32(400), Q32(100), Q32(360)}};
    }
    def.overlap = body == PASSING || body == JOINED ? CAROM_OVERLAP_PASS : CAROM_OVERLAP_REFUSE;
    return def;
}

static void begin(int which)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                  .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}},
                                  .sleep = true,
                                  .sweep_cap = 8};
    struct carom_joint_def joint = {.kind = CAROM_JOINT_HINGE, .axis = {{0, 0, CAROM_ONE_Q30}}};

    CHECK_EQ(carom_world_init(block[which], sizeof block[which], &config, &world[which]), CAROM_OK);
    if (which == 1) {
        add_far(world[which]);
    }
    for (int i = 0; i < BODIES; i++) {
        struct carom_body_def def = def_of(i);

        CHECK_EQ(carom_body_add(world[which], &def), numbered(which, i));
    }
    joint.a = part(which, JOINED);
    joint.b = part(which, FIRST);
    joint.anchor = def_of(part(0, JOINED)).position;
    CHECK_EQ(carom_joint_add(world[which], &joint), which);
    joint.kind = CAROM_JOINT_DISTANCE;
    joint.a = part(which, HANGING);
    joint.b = CAROM_WORLD;
    joint.anchor = joint.anchor_b = def_of(part(0, HANGING)).position;
    joint.drive = (struct carom_joint_drive){.limited = true, .upper_q32 = Q32(100)};
    CHECK_EQ(carom_joint_add(world[which], &joint), which + 1);
}

/* ------------------------------------------------------------------- the same in both */

/* The world's second result must be the first one's. */
#define BOTH(result, call)                                                                         \
    for (int which = 0, result = 0; which < 2; which++) {                                          \
        struct carom_world *w = world[which];                                                      \
        const int b = numbered(which, body);                                                       \
        const int got = (call);                                                                    \
                                                                                                   \
        result = which == 0 ? got : result;                                                        \
        CHECK_EQ(got, result);                                                                     \
    }

/* A body goes, and comes anew. */
static void renew(int body)
{
    BOTH(result, carom_body_remove(w, b));
    for (int which = 0; which < 2; which++) {
        struct carom_body_def def = def_of(body);

        def.overlap = CAROM_OVERLAP_PASS;
        CHECK_EQ(carom_body_add(world[which], &def), numbered(which, body));
    }
}

static void act(void)
{
    const int body = (int)test_random_range(&chance, 0, BODIES - 1);
    const carom_v3_q40 vector = {{any(Q40(1)), any(Q40(1)), any(Q40(1))}};
    const struct carom_material material = {
        CAROM_ONE_Q30 / 2, (uint32_t)(any(1 << 15) + (1 << 15)), 1 << 12, {{0, 0, 0}}};
    struct carom_filter filter = {.category = (uint16_t)(any(3) + 4), .mask = 0xffff};
    struct carom_pose pose = {.position = {{any(Q32(600)), any(Q32(600)), Q32(400)}},
                              .rotation = {{CAROM_ONE_Q30, (int32_t)any(1 << 22),
                                            (int32_t)any(1 << 22), (int32_t)any(1 << 22)}}};
    struct carom_body_state state;

    switch (test_random_range(&chance, 0, 9)) {
    case 0:
        BOTH(result, carom_body_push_centre(w, b, &vector));
        break;
    case 1:
        BOTH(result, carom_body_twist(w, b, &vector));
        break;
    case 2:
        BOTH(result, carom_body_set_force(w, b, &vector));
        break;
    case 3:
        BOTH(result, carom_body_set_material(w, b, &material));
        break;
    case 4:
        BOTH(result, carom_body_set_filter(w, b, &filter));
        break;
    case 5:
        pose.position.c[0] += any(Q32(3));
        BOTH(result, carom_body_move_to(w, part(which, PUSHER), &pose) + 0 * b);
        break;
    case 6:
        CHECK_EQ(carom_body_get(world[0], body, &state), CAROM_OK);
        state.position.c[2] += Q32(200);
        BOTH(result, carom_body_set(w, b, &state));
        break;
    case 7:
        BOTH(result, carom_body_set_damping(w, b, 1 << 24, 1 << 23));
        break;
    case 8:
        BOTH(result, carom_body_set_gravity_scale(w, b, 3 << 14));
        break;
    default:
        if (body != part(0, GROUND)) {
            renew(body);
        }
        break;
    }
}

/* Let bodies come to rest: no force acts any more. */
static void calm(void)
{
    const carom_v3_q40 none = {{0, 0, 0}};

    for (int body = 0; body < BODIES; body++) {
        BOTH(result, carom_body_set_force(w, b, &none));
    }
}

static void check_bodies(int count)
{
    for (int i = 0; i < count; i++) {
        struct carom_body_state s[2];

        memset(s, 0, sizeof s);
        for (int which = 0; which < 2; which++) {
            CHECK_EQ(carom_body_get(world[which], numbered(which, i), &s[which]), CAROM_OK);
        }
        CHECK_EQ(memcmp(&s[0], &s[1], sizeof s[0]), 0);
    }
}

static bool has_b(int kind)
{
    return kind != CAROM_EVENT_REST && kind != CAROM_EVENT_OUT && kind != CAROM_EVENT_WAKE;
}

/* Events of far bodies have far bodies on either side, and come where they like. */
static void check_events(void)
{
    const struct carom_event *e[2];
    int count = carom_events(world[0], &e[0]), found = 0;

    for (int i = carom_events(world[1], &e[1]); i > 0; i--, e[1]++) {
        if (e[1]->a < BEFORE) {
            CHECK(!has_b(e[1]->kind) || e[1]->b < BEFORE);
            continue;
        }
        CHECK_LESS(found++, count);
        CHECK_EQ(e[1]->kind, e[0]->kind);
        CHECK_EQ(e[1]->a, numbered(1, e[0]->a));
        CHECK_EQ(e[1]->b, has_b(e[0]->kind) ? numbered(1, e[0]->b) : 0);
        CHECK_EQ(e[1]->speed_q40, e[0]->speed_q40);
        CHECK_EQ(e[1]->impulse_q40, e[0]->impulse_q40);
        e[0]++;
    }
    CHECK_EQ(found, count);
}

/* A ray, a swept cube, the bodies in a cube and the closest points of two bodies. */
static void check_queries(void)
{
    const struct carom_query_filter filter = {.flags = 0};
    const struct carom_ray ray = {{{any(Q32(800)), any(Q32(800)), Q32(2000)}},
                                  {{any(Q32(300)), any(Q32(300)), -Q32(3000)}}};
    const struct carom_query_mesh cube = {.mesh = &mesh[CUBE],
                                          .position = {{any(Q32(800)), any(Q32(800)), Q32(300)}}};
    const struct carom_mesh_way way = {.way = {{any(Q32(500)), any(Q32(500)), -Q32(400)}}};
    struct carom_ray_hit hit[2];
    struct carom_mesh_hit swept[2];
    struct carom_closest closest[2];
    uint16_t in[2][BODIES];
    static struct carom_cast_workspace workspace; /* with other content for each world */
    int got[4][2];

    memset(hit, 0, sizeof hit);
    memset(swept, 0, sizeof swept);
    memset(closest, 0, sizeof closest);
    for (int which = 0; which < 2; which++) {
        struct carom_world *w = world[which];

        got[0][which] = carom_cast_ray(w, &ray, &filter, &hit[which]);
        memset(&workspace, which * 0xa5, sizeof workspace);
        got[1][which] = carom_cast_mesh(w, &cube, &way, &filter, &workspace, &swept[which]);
        got[2][which] = carom_overlap_mesh(w, &cube, &filter, in[which], BODIES);
        got[3][which] =
            carom_closest_points(w, part(which, FIRST), part(which, LAST), &closest[which]);
    }
    for (int i = 0; i < 4; i++) {
        CHECK_EQ(got[i][1], got[i][0]);
    }
    if (got[0][0] > 0) {
        CHECK_EQ(hit[1].body, numbered(1, hit[0].body));
        CHECK_EQ(hit[1].face, hit[0].face);
        CHECK_EQ(hit[1].t_q30, hit[0].t_q30);
        CHECK_EQ(memcmp(&hit[1].point, &hit[0].point, sizeof hit[0].point), 0);
    }
    if (got[1][0] > 0) {
        CHECK_EQ(swept[1].body, numbered(1, swept[0].body));
        CHECK_EQ(swept[1].face, swept[0].face);
        CHECK_EQ(swept[1].t_q30, swept[0].t_q30);
        CHECK_EQ(memcmp(&swept[1].point, &swept[0].point, sizeof swept[0].point), 0);
    }
    CHECK_EQ(memcmp(&closest[0], &closest[1], sizeof closest[0]), 0);
    for (int i = 0; i < got[2][0]; i++) {
        CHECK_EQ(in[1][i], numbered(1, in[0][i]));
    }
}

/* A call on the second world that is refused, whatever its state. */
static int refused_call(struct carom_world *w, int b)
{
    const carom_v3_q40 huge = {{0, INT64_MAX, 0}};
    const struct carom_joint_def joint = {.kind = 77, .a = b, .b = CAROM_WORLD};
    struct carom_body_def def = body_of(CUBE, 0, 0, 0); /* in the ground */
    struct carom_body_state state;
    int bytes;

    switch (test_random_range(&more, 0, 7)) {
    case 0:
        return carom_body_add(w, &def);
    case 1:
        CHECK_EQ(carom_body_get(w, part(1, LAST), &state), CAROM_OK);
        state.position = def.position;
        return carom_body_set(w, part(1, LAST), &state);
    case 2:
        return carom_joint_add(w, &joint);
    case 3:
        return carom_body_set_mass(w, b, 1);
    case 4:
        bytes = carom_snapshot_save(w, saved, sizeof saved);
        CHECK_MORE(bytes, 0);
        saved[test_random_range(&more, 0, bytes - 1)] ^= 4;
        return carom_snapshot_load(w, saved, (size_t)bytes);
    case 5:
        return carom_body_set_damping(w, b, -1, 0);
    case 6:
        return carom_body_push_centre(w, b, &huge);
    default:
        return carom_world_set_gravity(w, &huge);
    }
}

static void refuse(struct carom_world *w)
{
    const uint64_t hash = carom_world_hash(w);

    CHECK_LESS(refused_call(w, numbered(1, (int)test_random_range(&more, 0, BODIES - 1))), 0);
    CHECK_EQ(carom_world_hash(w), hash);
}

/* Go on by a frame, and back. */
static void roll_back(struct carom_world *w)
{
    int bytes = carom_snapshot_save(w, saved, sizeof saved);

    CHECK_MORE(bytes, 0);
    CHECK_AT_LEAST(carom_world_step(w), 0);
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)bytes), CAROM_OK);
}

/* `trouble` comes before each step of the second world, and must change nothing of what follows. */
static void run_both(void (*trouble)(struct carom_world *))
{
    make_meshes();
    for (uint64_t n = 0; n < WORLDS; n++) {
        more = (struct test_random){n};
        chance = (struct test_random){n};
        first = (int)n % BODIES;
        begin(0);
        begin(1);
        for (int frame = 0; frame < FRAMES; frame++) {
            if (frame % 3 == 0 && frame >= 10 && (frame < 30 || frame >= 100)) {
                act();
            }
            if (frame == 30) {
                calm();
            }
            if (frame == 90) { /* around what sleeps by now */
                renew(part(0, SENSOR));
            }
            if (trouble) {
                trouble(world[1]);
            }
            CHECK_AT_LEAST(carom_world_step(world[0]), 0);
            CHECK_AT_LEAST(carom_world_step(world[1]), 0);
            check_bodies(BODIES);
            check_events();
            if (frame % 10 == 0) {
                check_queries();
            }
        }
    }
}

static void test_alike(void)
{
    run_both(NULL);
}

static void test_refused(void)
{
    run_both(refuse);
}

static void test_rolled_back(void)
{
    run_both(roll_back);
}

/* Each part by itself, as the only body of its world; it is pushed. */
static void test_only(void)
{
    const carom_v3_q40 push = {{Q40(1) / 8, Q40(1) / 16, Q40(1) / 4}};
    const int body = 0;

    make_meshes();
    for (first = 0; first < BODIES; first++) {
        begin(0);
        begin(1);
        for (int which = 0; which < 2; which++) {
            for (int i = 1; i < BODIES; i++) {
                CHECK_EQ(carom_body_remove(world[which], numbered(which, i)), CAROM_OK);
            }
        }
        for (int frame = 0; frame < 30; frame++) {
            if (frame == 10) {
                BOTH(result, carom_body_push_centre(w, b, &push));
            }
            CHECK_AT_LEAST(carom_world_step(world[0]), 0);
            CHECK_AT_LEAST(carom_world_step(world[1]), 0);
            check_bodies(1);
            check_events();
        }
    }
}

const struct test tests_world_beside[] = {{"world_beside/alike", test_alike},
                                          {"world_beside/refused", test_refused},
                                          {"world_beside/rolled_back", test_rolled_back},
                                          {"world_beside/only", test_only},
                                          {0}};

/* SPDX-License-Identifier: MIT */
/*
 * carom_query_faces, carom_query_inside and carom_body_look: the arguments that they accept and
 * refuse, and that asking changes nothing in a step. Contacts are reported where they are.
 */
#include <string.h>

#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS   4, 4, 32, 256, 16, 64
#define ROOM   64
#define FRAMES 40

static _Alignas(8) uint8_t block[2][CAROM_WORLD_BYTES(CAPS)];
static struct shape box, ground;
static struct carom_face_pair pairs[ROOM];

/* A plane as body 0 and a box as body 1, half in the plane, with a corner down. */
static struct carom_world *setup_capped(int n, uint8_t substep_cap)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                        .gravity = {{0, 0, -((int64_t)1 << 31)}},
                                        .substep_cap = substep_cap};
    struct carom_body_def def;
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block[n], sizeof block[n], &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &ground.mesh;
    def.stationary = true;
    CHECK_EQ(carom_body_add(world, &def), 0);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.rotation = (carom_quat_q30){{900000000, 400000000, 300000000, 303000000}};
    def.restitution_q30 = CAROM_ONE_Q30 / 2;
    def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(carom_body_add(world, &def), 1);
    return world;
}

static struct carom_world *setup(int n)
{
    return setup_capped(n, 0);
}

static void make_shapes(void)
{
    shape_box(&box, 12, 4096, 2868, 2048);
    shape_plane(&ground, 12, 2, 8192);
}

static void set_height(struct carom_world *world, int64_t z_q32)
{
    struct carom_body_state state;

    CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
    state.position.c[2] = z_q32;
    CHECK_EQ(carom_body_set(world, 1, &state), CAROM_OK);
}

static void test_errors(void)
{
    static const struct {
        int a, b, error;
    } wrong[] = {{0, 2, CAROM_ERR_BODY},         {-1, 0, CAROM_ERR_BODY},
                 {1, INT32_MAX, CAROM_ERR_BODY}, {1, 1, CAROM_ERR_ARGUMENT},
                 {0, 0, CAROM_ERR_ARGUMENT},     {3, 3, CAROM_ERR_BODY}};
    struct carom_world *world;
    int count;

    make_shapes();
    world = setup(0);
    CHECK_EQ(carom_query_faces(NULL, 1, 0, pairs, ROOM), CAROM_ERR_NULL);
    CHECK_EQ(carom_query_faces(world, 1, 0, NULL, 1), CAROM_ERR_NULL);
    CHECK_EQ(carom_query_inside(NULL, 1, 0), CAROM_ERR_NULL);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        memset(pairs, 0x5a, sizeof pairs);
        CHECK_EQ(carom_query_faces(world, wrong[i].a, wrong[i].b, pairs, ROOM), wrong[i].error);
        CHECK_EQ(carom_query_inside(world, wrong[i].a, wrong[i].b), wrong[i].error);
        CHECK_EQ(pairs[0].a, 0x5a5a);
        CHECK_EQ(pairs[0].b, 0x5a5a);
    }
    count = carom_query_faces(world, 1, 0, pairs, ROOM);
    CHECK_MORE(count, 2);
    CHECK_LESS(count, ROOM);
    CHECK_EQ(carom_query_faces(world, 1, 0, pairs, UINT32_MAX), count);
    CHECK_EQ(carom_query_faces(world, 1, 0, pairs, (uint32_t)count), count);
    CHECK_EQ(carom_query_faces(world, 1, 0, pairs, (uint32_t)count - 1), CAROM_ERR_FACES_FULL);
    CHECK_EQ(carom_query_faces(world, 0, 1, NULL, 0), CAROM_ERR_FACES_FULL);
    for (int i = 0; i < count; i++) {
        CHECK_LESS(pairs[i].a, box.raw.face_count);
        CHECK_LESS(pairs[i].b, ground.raw.face_count);
    }
}

/* Above the plane, through it, and below it. */
static void test_places(void)
{
    struct carom_world *world;

    make_shapes();
    world = setup(0);
    set_height(world, (int64_t)2 << 32);
    CHECK_EQ(carom_query_faces(world, 1, 0, NULL, 0), 0);
    CHECK_EQ(carom_query_inside(world, 1, 0), 0);
    CHECK_EQ(carom_query_inside(world, 0, 1), 0);
    set_height(world, -((int64_t)2 << 32));
    CHECK_EQ(carom_query_faces(world, 1, 0, NULL, 0), 0);
    CHECK_EQ(carom_query_faces(world, 0, 1, NULL, 0), 0);
    CHECK_EQ(carom_query_inside(world, 1, 0), 1);
    CHECK_EQ(carom_query_inside(world, 0, 1), 0);
}

/*
 * Two worlds run the same steps; one of them is asked between its steps, also with too little room.
 * Both stay equal.
 */
static void test_no_change(void)
{
    struct carom_world *asked, *other;
    const struct carom_face_ref *faces[2];

    make_shapes();
    asked = setup(0);
    other = setup(1);
    set_height(asked, (int64_t)3 << 30);
    set_height(other, (int64_t)3 << 30);
    for (int frame = 0; frame < FRAMES; frame++) {
        struct carom_usage usage[2][CAROM_POOL_COUNT];
        int count;

        CHECK_AT_LEAST(carom_query_faces(asked, 1, 0, pairs, ROOM), 0);
        carom_query_faces(asked, 0, 1, NULL, 0);
        count = carom_interfering_faces(asked, &faces[0]);
        CHECK_EQ(count, carom_interfering_faces(other, &faces[1]));
        CHECK_EQ(memcmp(faces[0], faces[1], (size_t)count * sizeof faces[0][0]), 0);
        CHECK_EQ(carom_usage(asked, usage[0]), CAROM_OK);
        CHECK_EQ(carom_usage(other, usage[1]), CAROM_OK);
        CHECK_EQ(memcmp(usage[0], usage[1], sizeof usage[0]), 0);
        CHECK_AT_LEAST(carom_world_step(asked), 0);
        CHECK_AT_LEAST(carom_world_step(other), 0);
        CHECK_EQ(carom_world_hash(asked), carom_world_hash(other));
    }
    CHECK_MORE(carom_contacts(asked, NULL, 0), 0); /* the box has come down */
}

/*
 * Contacts of a box with a plane are on the plane and on the box. This holds when the frame goes on
 * after them, and when it runs out of hits and ends with an impact.
 */
static void test_contacts(void)
{
    const int64_t near_q32 = (int64_t)1 << 24; /* some skins: 2^-8 of the box's size */

    make_shapes();
    for (uint8_t cap = 0; cap < 2; cap++) {
        struct carom_world *world = setup_capped(0, cap);
        int seen = 0, cut = 0;

        set_height(world, (int64_t)3 << 30);
        for (int frame = 0; frame < FRAMES; frame++) {
            struct carom_contact contacts[32];
            struct carom_body_state state;
            int status = carom_world_step(world), n = carom_contacts(world, contacts, 32);

            CHECK_AT_LEAST(status, 0);
            CHECK_AT_MOST(n, 32);
            CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
            for (int i = 0; i < n; i++) {
                int64_t arm[3];

                for (int k = 0; k < 3; k++) {
                    arm[k] = contacts[i].point.c[k] - state.position.c[k];
                }
                CHECK_NEAR(contacts[i].point.c[2], 0, near_q32);
                if (status != CAROM_OK) { /* the box is where it hit */
                    CHECK_LESS(fix_length(arm), ((int64_t)box.mesh.radius_q22 << 10) + near_q32);
                    cut++;
                }
            }
            seen += n;
        }
        CHECK_MORE(seen, 0);
        CHECK_EQ((cut > 0), (cap > 0));
    }
}

/* carom_body_look shows a body's mesh and pose; free numbers show nothing. */
static void test_look(void)
{
    struct carom_body_look look = {.mesh = NULL};
    struct carom_body_state state;
    struct carom_world *world;

    make_shapes();
    world = setup(0);
    CHECK_EQ(carom_body_count(NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_look(NULL, 1, &look), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_look(world, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_look(world, -1, &look), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_look(world, 2, &look), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_count(world), 2);
    CHECK_SAME(carom_body_mesh(NULL, 1), NULL);
    CHECK_SAME(carom_body_mesh(world, -1), NULL);
    CHECK_SAME(carom_body_mesh(world, 2), NULL);
    CHECK_SAME(carom_body_mesh(world, 1), &box.mesh);
    CHECK_EQ(carom_body_look(world, 0, &look), CAROM_OK);
    CHECK_SAME(look.mesh, &ground.mesh);
    CHECK(!look.moving);
    set_height(world, (int64_t)3 << 30);
    for (int frame = 0; frame < 4; frame++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
        CHECK_EQ(carom_body_look(world, 1, &look), CAROM_OK);
        CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
        CHECK_SAME(look.mesh, &box.mesh);
        CHECK(look.moving);
        CHECK_EQ(memcmp(&look.position, &state.position, sizeof look.position), 0);
        CHECK_EQ(memcmp(&look.rotation, &state.rotation, sizeof look.rotation), 0);
    }
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    CHECK_EQ(carom_body_count(world), 2);
    CHECK_EQ(carom_body_look(world, 0, &look), CAROM_ERR_BODY);
    CHECK_SAME(look.mesh, &box.mesh);
    CHECK_SAME(carom_body_mesh(world, 0), NULL);
}

/* ----------------------------------------------------------------------- faces */

static int64_t larger(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* By how much a direction parts two triangles, over 1600 units; below 0 if it does not. */
static int64_t gap_along(const int64_t w[3], int32_t p[3][3], int32_t q[3][3])
{
    int64_t low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};
    int64_t length = carom_abs(w[0]) + carom_abs(w[1]) + carom_abs(w[2]);

    for (int n = 0; n < 6; n++) {
        const int32_t *at = n < 3 ? p[n] : q[n - 3];
        int64_t along = w[0] * at[0] + w[1] * at[1] + w[2] * at[2];

        low[n / 3] = along < low[n / 3] ? along : low[n / 3];
        high[n / 3] = along > high[n / 3] ? along : high[n / 3];
    }
    if (length == 0) {
        return INT64_MIN;
    }
    return 100 * (low[1] - high[0] > low[0] - high[1] ? low[1] - high[0] : low[0] - high[1]) /
           length;
}

/* The largest gap that one of the 17 axes shows which part two triangles if any direction does. */
static int64_t largest_gap(int32_t p[3][3], int32_t q[3][3])
{
    int32_t edge[2][3][3], normal[2][3];
    int64_t w[3], most = INT64_MIN;

    for (int t = 0; t < 2; t++) {
        int32_t(*at)[3] = t == 0 ? p : q;

        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                edge[t][i][k] = at[(i + 1) % 3][k] - at[i][k];
            }
        }
        fix_cross(w, edge[t][0], edge[t][1]);
        most = larger(most, gap_along(w, p, q));
        for (int k = 0; k < 3; k++) {
            normal[t][k] = (int32_t)w[k];
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            fix_cross(w, edge[0][i], edge[1][j]);
            most = larger(most, gap_along(w, p, q));
        }
        for (int t = 0; t < 2; t++) {
            fix_cross(w, edge[t][i], normal[t]);
            most = larger(most, gap_along(w, p, q));
        }
    }
    return most;
}

/* In 16ths of a unit. */
static void face_corners(const struct shape *s, uint32_t face, int32_t out[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            out[i][k] = s->vertices[s->faces[face][i]][k] / 16;
        }
    }
}

static bool is_listed(int count, uint32_t a, uint32_t b)
{
    for (int i = 0; i < count; i++) {
        if (pairs[i].a == a && pairs[i].b == b) {
            return true;
        }
    }
    return false;
}

/*
 * Random tetrahedra whose corners are whole 16ths of a unit, so that corners often lie in the plane of a
 * face of the other, but for 2^-15 units by which each body is moved. The pairs of faces are those
 * that no axis parts; pairs that touch, or nearly, are not judged.
 */
static void test_faces(void)
{
    struct test_random r = {6};
    int listed = 0, apart = 0;

    for (int n = 0; n < 300; n++) {
        const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
        struct shape *const shape[2] = {&box, &ground};
        struct carom_world *world = NULL;
        int count;

        CHECK_EQ(carom_world_init(block[0], sizeof block[0], &config, &world), CAROM_OK);
        for (int i = 0; i < 2; i++) {
            struct carom_body_def def = {.overlap = CAROM_OVERLAP_PASS};

            shape_random_tetrahedron(shape[i], &r);
            def.mesh = &shape[i]->mesh;
            def.rotation.c[0] = CAROM_ONE_Q30;
            for (int k = 0; k < 3; k++) {
                def.position.c[k] = (int64_t)shape[i]->mesh.mass.centre.c[k] * 1024 +
                                    test_random_range(&r, -(1 << 17), 1 << 17);
            }
            CHECK_EQ(carom_body_add(world, &def), i);
        }
        count = carom_query_faces(world, 0, 1, pairs, ROOM);
        CHECK_AT_LEAST(count, 0);
        for (uint32_t a = 0; a < 4; a++) {
            for (uint32_t b = 0; b < 4; b++) {
                int32_t p[3][3], q[3][3];
                int64_t gap;

                face_corners(&box, a, p);
                face_corners(&ground, b, q);
                gap = largest_gap(p, q);
                if (gap != 0) {
                    CHECK_EQ(is_listed(count, a, b), gap < 0);
                    apart += gap > 0;
                }
            }
        }
        listed += count;
    }
    CHECK_MORE(listed, 300);
    CHECK_MORE(apart, 300);
}

const struct test tests_world_query[] = {{"world_query/errors", test_errors},
                                         {"world_query/look", test_look},
                                         {"world_query/places", test_places},
                                         {"world_query/no_change", test_no_change},
                                         {"world_query/contacts", test_contacts},
                                         {"world_query/faces", test_faces},
                                         {0}};

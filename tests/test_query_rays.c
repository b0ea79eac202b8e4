/* SPDX-License-Identifier: MIT */
/*
 * Rays: their hits by hand, also through edges and vertices; the march over cells against every
 * face; asking changes nothing in a step.
 */
#include <string.h>

#include "lib/asked.h"

#ifdef TEST_LONG
#define RAYS 20000
#else
#define RAYS 300
#endif

#define ROOM 64

static struct shape shape[3];
static struct carom_ray_hit hits[ROOM];

/* ------------------------------------------------------------------- by hand */

static struct carom_ray ray_of(int64_t x, int64_t y, int64_t z, int64_t dx, int64_t dy, int64_t dz)
{
    return (struct carom_ray){{{x, y, z}}, {{dx, dy, dz}}};
}

/* A box of 2 x 1 x 1 units behind another, and a plane under both. */
static void test_by_hand(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_ray ray = ray_of(-8 * UNIT, UNIT / 8, UNIT / 16, 16 * UNIT, 0, 0);
    struct carom_ray_hit hit;
    int count;

    shape_box(&shape[0], 12, 8192, 4096, 4096);
    shape_plane(&shape[1], 12, 2, 16384);
    CHECK_EQ(asked_add(world, &shape[1].mesh, false, 0, 0, -2 * UNIT, upright), 0);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 3 * UNIT, 0, 0, upright), 1);
    CHECK_EQ(asked_add(world, &shape[0].mesh, false, 0, 0, 0, upright), 2);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_EQ(hit.body, 2);
    CHECK_EQ(hit.t_q30, CAROM_ONE_Q30 / 16 * 7);
    CHECK_EQ(hit.t_rest, 0);
    CHECK_EQ(hit.point.c[0], -UNIT);
    CHECK_EQ(hit.point.c[1], UNIT / 8);
    CHECK_EQ(hit.normal.c[0], -CAROM_ONE_Q30);
    CHECK_EQ(carom_cast_ray_all(world, &ray, NULL, hits, ROOM), 2);
    CHECK_EQ(hits[1].body, 1);
    CHECK_EQ(hits[1].point.c[0], 2 * UNIT);
    /* backs as well: in, out, in, out */
    struct carom_query_filter filter = {.flags = CAROM_QUERY_BACK};
    static const int body[4] = {2, 2, 1, 1}, x[4] = {-1, 1, 2, 4};

    count = carom_cast_ray_all(world, &ray, &filter, hits, ROOM);
    CHECK_EQ(count, 4);
    for (int i = 0; i < 4; i++) {
        CHECK_EQ(hits[i].body, body[i]);
        CHECK_EQ(hits[i].point.c[0], x[i] * UNIT);
    }
    CHECK_EQ(carom_cast_ray_all(world, &ray, &filter, hits, 3), CAROM_ERR_FACES_FULL);
    CHECK_EQ(hits[2].body, 1);
    /* down, past the boxes and through one */
    ray = ray_of(0, 3 * UNIT / 4, 8 * UNIT, 0, 0, -20 * UNIT);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_EQ(hit.body, 0);
    CHECK_EQ(hit.t_q30, CAROM_ONE_Q30 / 2);
    CHECK_EQ(hit.normal.c[2], CAROM_ONE_Q30);
    /* a surface is not hit from below, nor a body from inside */
    ray = ray_of(0, 3 * UNIT / 4, -8 * UNIT, 0, 0, 20 * UNIT);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 0);
    ray = ray_of(0, 0, 0, -3 * UNIT, 0, 0);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 0);
    /* ends on the face, or just before it; begins on it */
    ray = ray_of(-2 * UNIT, UNIT / 8, UNIT / 16, UNIT, 0, 0);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_EQ(hit.t_q30, CAROM_ONE_Q30);
    CHECK_EQ(hit.body, 2);
    /* the same face of a later body is as far: the lower body's counts */
    CHECK_EQ(asked_add(world, &shape[0].mesh, false, 0, 0, 0, upright), 3);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_EQ(hit.t_q30, CAROM_ONE_Q30);
    CHECK_EQ(hit.body, 2);
    CHECK_EQ(carom_body_remove(world, 3), CAROM_OK);
    ray.way.c[0]--;
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 0);
    ray = ray_of(-UNIT, UNIT / 8, UNIT / 16, UNIT, 0, 0);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_EQ(hit.t_q30, 0);
}

/*
 * The shortest rays, 2^-20 units, are half as long as the unit in which the march counts places on a plane of the coarsest quanta. They
 * hit the plane exactly if it lies between their ends, wherever that is.
 */
static void test_shortest(void)
{
    enum { WAY = 1 << 12 };
    struct carom_world *world = asked_world(0);
    struct carom_ray_hit hit;

    shape_plane(&shape[1], 7, 2, 512);
    CHECK_EQ(asked_add(world, &shape[1].mesh, false, 0, 0, 0, upright), 0);
    for (int64_t height = -WAY; height <= 2 * WAY; height += WAY / 8) {
        const struct carom_ray ray = ray_of(UNIT / 8, UNIT / 16, height, 0, 0, -WAY);
        const bool meets = height >= 0 && height <= WAY;

        CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), meets);
        if (meets) {
            CHECK_EQ(hit.t_q30, height << 18);
            CHECK_EQ(hit.point.c[2], 0);
        }
    }
}

static bool wants_2(void *context, int body)
{
    return body != *(int *)context;
}

static void test_errors(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_ray ray = ray_of(0, 0, 0, UNIT, 0, 0);
    struct carom_ray_hit hit = {.body = 77};
    int not_this = 0;
    struct carom_query_filter filter = {.wants = wants_2, .context = &not_this};

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 2 * UNIT, 0, 0, upright), 0);
    CHECK_EQ(carom_cast_ray(NULL, &ray, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_ray(world, NULL, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_ray_all(world, &ray, NULL, NULL, 1), CAROM_ERR_NULL);
    ray.way.c[0] = (1 << 12) - 1;
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), CAROM_ERR_ARGUMENT);
    ray.way.c[0] = 32768 * UNIT + 1;
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), CAROM_ERR_RANGE);
    ray.way.c[0] = INT64_MIN;
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), CAROM_ERR_RANGE);
    ray = ray_of(-32768 * UNIT - 1, 0, 0, UNIT, 0, 0);
    CHECK_EQ(carom_cast_ray_all(world, &ray, NULL, NULL, 0), CAROM_ERR_RANGE);
    CHECK_EQ(hit.body, 77);
    ray = ray_of(-16384 * UNIT, 0, 0, 32768 * UNIT, 0, 0);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &hit), 1);
    CHECK_NEAR(hit.point.c[0], 3 * UNIT / 2, 1 << 16);
    CHECK_EQ(carom_cast_ray_all(world, &ray, NULL, NULL, 0), CAROM_ERR_FACES_FULL);
    CHECK_EQ(carom_cast_ray(world, &ray, &filter, &hit), 0);
    not_this = 1;
    CHECK_EQ(carom_cast_ray(world, &ray, &filter, &hit), 1);
    filter.mask = 1; /* the body has no category */
    world->bodies[0].def.category = 2;
    CHECK_EQ(carom_cast_ray(world, &ray, &filter, &hit), 0);
    filter.mask = 3;
    CHECK_EQ(carom_cast_ray(world, &ray, &filter, &hit), 1);
    world->now->bodies[0].out = 1;
    CHECK_EQ(carom_cast_ray(world, &ray, &filter, &hit), 0);
}

/* --------------------------------------------------- through edges and vertices */

/* Count the faces of the last hits that look at the ray, and those that look away. */
static void count_sides(const struct carom_ray *ray, int count, int *front, int *back)
{
    *front = *back = 0;
    for (int i = 0; i < count; i++) {
        int64_t along = 0;

        for (int k = 0; k < 3; k++) {
            along += (ray->way.c[k] >> 24) * hits[i].normal.c[k];
        }
        *(along < 0 ? front : back) += 1;
    }
}

/*
 * Upright and slanting rays through every vertex and the middle of every edge. In a closed mesh
 * they hit as many faces from the front as from the back, alternating; in a plane they hit one
 * face.
 */
static void test_watertight(void)
{
    struct carom_world *world;
    const struct carom_query_filter both = {.flags = CAROM_QUERY_BACK};

    shape_ball(&shape[0], 12, 4096);
    shape_l(&shape[1], 12, 2048);
    shape_plane(&shape[2], 12, 6, 1024);
    for (int n = 0; n < 3; n++) {
        const struct carom_mesh *mesh = &shape[n].mesh;

        world = asked_world(0);
        CHECK_EQ(asked_add(world, mesh, false, 0, 0, 0, upright), 0);
        for (uint32_t i = 0; i < mesh->edge_count; i++) {
            static const int8_t ways[6][3] = {{0, 0, -1},  {1, 0, -1}, {1, 1, -1},
                                              {-1, 0, -2}, {2, 3, -4}, {-1, 1, -1}};
            const int16_t *a = mesh->raw.vertices[mesh->edges[i].vertex[0]];
            const int16_t *b = mesh->raw.vertices[mesh->edges[i].vertex[1]];

            for (int way = 0; way < 12; way++) {
                const int8_t *d = ways[way % 6];
                struct carom_ray ray;
                int count, front, back;

                for (int k = 0; k < 3; k++) {
                    int64_t at = way < 6 ? 2 * a[k] : a[k] + b[k];

                    at = at * (1 << 19) - carom_shl(mesh->mass.centre.c[k], 10);
                    ray.from.c[k] = at - 4 * UNIT * d[k];
                    ray.way.c[k] = 8 * UNIT * d[k];
                }
                count = carom_cast_ray_all(world, &ray, &both, hits, ROOM);
                count_sides(&ray, count, &front, &back);
                if (n < 2) {
                    CHECK_EQ(front, back);
                } else {
                    CHECK_EQ(back, 0);
                    CHECK_AT_MOST(front, 1);
                    if (mesh->edges[i].face[1] != CAROM_NO_FACE && way >= 6) {
                        CHECK_EQ(front, 1);
                    }
                }
                for (int j = 1; j < count; j++) {
                    CHECK_AT_LEAST(hits[j].t_q30, hits[j - 1].t_q30);
                }
            }
        }
    }
}

/*
 * Upright rays 2^-32 units beside the diagonal of a square, which is 2^-20 of its quanta: face 0 is
 * on the right, face 1 on the left.
 */
static void test_beside_edge(void)
{
    struct test_random r = {21};
    struct carom_world *world = asked_world(0);

    shape_plane(&shape[0], 12, 1, 8192);
    CHECK_EQ(asked_add(world, &shape[0].mesh, false, 0, 0, 0, upright), 0);
    for (int n = 0; n < 40; n++) {
        int64_t at = test_random_range(&r, -UNIT, UNIT), side = n % 2 ? 1 : -1;
        struct carom_ray ray = ray_of(at + side, at, UNIT, 0, 0, -2 * UNIT);

        CHECK_EQ(carom_cast_ray_all(world, &ray, NULL, hits, ROOM), 1);
        CHECK_EQ(hits[0].face, side > 0 ? 0 : 1);
    }
}

/* ------------------------------------------------------- cells, and every face */

struct all_hits {
    struct query_struck base;
    uint32_t count;
    struct query_strike strike[ROOM];
};

static void note(struct query_struck *self, struct query_ray *ray, const struct query_strike *s)
{
    struct all_hits *a = (struct all_hits *)self;

    (void)ray;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->strike[i].face == s->face) {
            CHECK_EQ(a->strike[i].way_q32, s->way_q32);
            return;
        }
    }
    CHECK_LESS(a->count, ROOM);
    a->strike[a->count++] = *s;
}

/* The march over cells finds the same hits as a test of every face. */
static uint32_t compare_march(struct query_ray *ray)
{
    struct all_hits found = {{note}, 0, {{0, 0}}};
    uint32_t count = 0;

    query_march(ray, &found.base);
    for (uint32_t f = 0; f < ray->mesh->raw.face_count; f++) {
        struct query_strike strike;

        if (query_strike(ray, (uint16_t)f, &strike)) {
            uint32_t i = 0;

            while (i < found.count && found.strike[i].face != f) {
                i++;
            }
            CHECK_LESS(i, found.count);
            count++;
        }
    }
    CHECK_EQ(found.count, count);
    return count;
}

/* A ray from around a body towards a place in it or near it; some are upright, some level. */
static struct carom_ray random_ray(struct test_random *r, int64_t size)
{
    struct carom_ray ray;
    int special = (int)test_random_range(r, 0, 15), axis = (int)test_random_range(r, 0, 2);

    for (int k = 0; k < 3; k++) {
        int64_t to = test_random_range(r, -size, size);

        ray.from.c[k] = test_random_range(r, -4 * size, 4 * size);
        ray.way.c[k] = to - ray.from.c[k];
        if ((special == 0 && k != axis) || (special == 1 && k == axis)) {
            ray.way.c[k] = 0;
            ray.from.c[k] = to;
        }
        if (special == 2 && k != axis) {
            ray.way.c[k] >>= 24;
            ray.from.c[k] = to;
        }
        if (special == 3) { /* a lattice on which vertices lie */
            ray.from.c[k] = carom_shl(ray.from.c[k] >> 28, 28);
            ray.way.c[k] = carom_shl(ray.way.c[k] >> 28, 28);
        }
    }
    if ((ray.way.c[0] | ray.way.c[1] | ray.way.c[2]) >> 12 == 0) {
        ray.way.c[axis] = size;
    }
    return ray;
}

static void test_march(void)
{
    struct test_random r = {5};
    uint32_t struck = 0;

    shape_ball(&shape[0], 12, 6000);
    shape_field(&shape[1], 9, 20, 100, 150, 3);
    shape_field(&shape[2], 14, 12, 2000, 9000, 4);
    for (int n = 0; n < RAYS; n++) {
        static const int64_t size[3] = {2 * UNIT, 2 * UNIT, UNIT};
        struct body body;
        struct body_state state;
        struct query_ray carried;
        struct carom_ray ray = random_ray(&r, size[n % 3]);

        shape_body(&shape[n % 3], false, &body, &state);
        if (n % 2) {
            state.rotation = shape_random_turn(&r);
        }
        if (query_carry(&carried, &ray, &body, &state)) {
            carried.back = n % 5 != 0;
            struck += compare_march(&carried) > 0;
        }
    }
    CHECK_MORE(struck, RAYS / 4);
}

/* A visitor that one hit is enough for: it ends the ray where it starts. */
static void note_one(struct query_struck *self, struct query_ray *ray, const struct query_strike *s)
{
    note(self, ray, s);
    ray->end_q32 = 0;
}

/* A ray that begins outside a field is ended by its first hit: no other one follows. */
static void test_ended(void)
{
    struct test_random r = {6};
    uint32_t more = 0;

    shape_field(&shape[1], 9, 20, 100, 150, 3);
    for (int n = 0; n < RAYS; n++) {
        struct body body;
        struct body_state state;
        struct query_ray carried, again;
        struct carom_ray ray = random_ray(&r, 2 * UNIT);

        shape_body(&shape[1], false, &body, &state);
        if (query_carry(&carried, &ray, &body, &state)) {
            struct all_hits one = {{note_one}, 0, {{0, 0}}}, all = {{note}, 0, {{0, 0}}};

            carried.back = true;
            again = carried;
            query_march(&carried, &one.base);
            query_march(&again, &all.base);
            CHECK_EQ(one.count, all.count > 0);
            more += all.count > 1;
        }
    }
    CHECK_MORE(more, 0);
}

/*
 * A ray that goes up beside a box, 2 quanta and the least more from its side, and comes nearer by less than that: the march takes it
 * for one that passes the border of its margin, though the border's line is far above. It meets nothing.
 */
static void test_along_margin(void)
{
    struct query_ray ray = {&shape[0].mesh, {0, 1, 2}, {0, 0}, {-1, 0}, 0, 0, true, true, 0};
    struct all_hits found = {{note}, 0, {{0, 0}}};

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    /* the ray's places along x have 30 bits, the march's 12; its height is 2 units, from one below the middle */
    ray.at_q30[0] = ((int64_t)(2048 + 2) << 30) + (1 << 18) - 2048;
    ray.start_q32 = -UNIT;
    ray.length_q32 = ray.end_q32 = 2 * UNIT;
    query_march(&ray, &found.base);
    CHECK_EQ(found.count, 0);
}

/* ------------------------------------------------------------------- no change */

/* Two worlds run the same steps; one of them is asked between its steps. Both stay equal. */
static void test_no_change(void)
{
    struct test_random r = {11};
    struct carom_world *world[2];
    int met = 0;

    shape_box(&shape[0], 12, 4096, 2868, 2048);
    shape_field(&shape[1], 12, 8, 2048, 500, 6);
    for (int n = 0; n < 2; n++) {
        world[n] = asked_world(n);
        CHECK_EQ(asked_add(world[n], &shape[1].mesh, false, 0, 0, 0, upright), 0);
        CHECK_EQ(asked_add(world[n], &shape[0].mesh, true, 0, 0, 2 * UNIT, upright), 1);
        CHECK_EQ(asked_add(world[n], &shape[0].mesh, true, UNIT / 3, 0, 4 * UNIT, upright), 2);
    }
    for (int frame = 0; frame < 30; frame++) {
        for (int i = 0; i < 4; i++) {
            struct carom_ray ray = random_ray(&r, UNIT + UNIT / 2);
            uint64_t hash = carom_world_hash(world[0]);

            met += carom_cast_ray(world[0], &ray, NULL, hits) > 0;
            CHECK_AT_LEAST(carom_cast_ray_all(world[0], &ray, NULL, hits, ROOM), 0);
            CHECK_EQ(carom_world_hash(world[0]), hash);
        }
        CHECK_AT_LEAST(carom_world_step(world[0]), 0);
        CHECK_AT_LEAST(carom_world_step(world[1]), 0);
        CHECK_EQ(carom_world_hash(world[0]), carom_world_hash(world[1]));
    }
    CHECK_MORE(met, 15);
}

const struct test tests_query_rays[] = {{"query_rays/by_hand", test_by_hand},
                                        {"query_rays/shortest", test_shortest},
                                        {"query_rays/errors", test_errors},
                                        {"query_rays/watertight", test_watertight},
                                        {"query_rays/beside_edge", test_beside_edge},
                                        {"query_rays/march", test_march},
                                        {"query_rays/ended", test_ended},
                                        {"query_rays/along_margin", test_along_margin},
                                        {"query_rays/no_change", test_no_change},
                                        {0}};

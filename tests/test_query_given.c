/* SPDX-License-Identifier: MIT */
/* Arguments that no question can take, and answers that two bodies share: then the lower number comes first. */
#include <string.h>

#include "carom_draw.h"
#include "lib/asked.h"

static struct shape box, tiny, large;
static struct carom_cast_workspace workspace;

/* The box of test_shared's worlds; a mesh in the middle, upright. */
static struct carom_query_mesh put(const struct carom_mesh *mesh)
{
    return (struct carom_query_mesh){mesh, {{0, 0, 0}}, upright};
}

static void test_null(void)
{
    const struct carom_ray ray = {{{0, 0, 0}}, {{UNIT, 0, 0}}};
    const struct carom_mesh_way way = {{{UNIT, 0, 0}}, {{0, 0, 0}}};
    const struct carom_query_mesh nothing = put(NULL), solid = put(&box.mesh);
    struct carom_world *world = asked_world(0);
    struct carom_mesh_hit swept;
    uint16_t bodies[1];

    CHECK_EQ(carom_cast_ray_all(NULL, &ray, NULL, NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_ray_all(world, NULL, NULL, NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_overlap_mesh(world, &nothing, NULL, bodies, 1), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, NULL, &way, NULL, &workspace, &swept), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &solid, &way, NULL, NULL, &swept), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &nothing, &way, NULL, &workspace, &swept), CAROM_ERR_NULL);
}

/* A mesh that no moving body may have, and ways that are too long or turn too far. */
static void test_range(void)
{
    const int32_t quarter = CAROM_ONE_Q30 / 4;
    struct carom_world *world = asked_world(0);
    struct carom_mesh_way way = {{{0, 0, 0}}, {{quarter, 0, 0}}};
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    uint16_t bodies[1];

    shape_box(&box, 12, 8192, 4096, 2048);
    shape_box(&tiny, 20, 64, 64, 64);      /* a radius of 2^-14 sqrt(3) / 2 */
    shape_box(&large, 8, 16384, 256, 256); /* a radius above 32 */
    mesh = put(&tiny.mesh);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 1), CAROM_ERR_RANGE);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
    mesh = put(&large.mesh);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 1), CAROM_ERR_RANGE);
    mesh = put(&box.mesh);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 0);
    way.turn.c[0] = quarter + 1;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
    way.turn.c[0] = way.turn.c[1] = quarter / 4 * 3; /* each is short, both are not */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
    way.turn.c[0] = way.turn.c[1] = 0;
    way.way.c[2] = 4097 * UNIT;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
    way.way.c[2] = 513 * UNIT; /* its radius is 1.15 */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 0);
    way.way.c[2] = 600 * UNIT;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
}

/* A ray into two boxes that lie in one place meets the same face of both at the same time. */
static void test_shared_ray(void)
{
    const struct carom_query_filter back = {.flags = CAROM_QUERY_BACK};
    const struct carom_ray ray = {{{UNIT / 8, UNIT / 16, 4 * UNIT}}, {{0, 0, -8 * UNIT}}};
    struct carom_world *world = asked_world(0);
    struct carom_ray_hit hits[4], first;

    shape_box(&box, 12, 8192, 4096, 2048);
    CHECK_EQ(asked_add(world, &box.mesh, true, 0, 0, 0, upright), 0);
    CHECK_EQ(asked_add(world, &box.mesh, true, 0, 0, 0, upright), 1);
    CHECK_EQ(carom_cast_ray_all(world, &ray, &back, hits, 4), 4);
    for (int i = 0; i < 4; i++) {
        CHECK_EQ(hits[i].body, i % 2);
        CHECK_EQ(hits[i].face, hits[i / 2 * 2].face);
        CHECK_EQ(hits[i].t_q30, hits[i / 2 * 2].t_q30);
    }
    CHECK_LESS(hits[1].t_q30, hits[2].t_q30);
    CHECK_EQ(carom_cast_ray(world, &ray, NULL, &first), 1);
    CHECK_EQ(first.body, 0);
}

/* A mesh swept between two boxes that stand like mirror images meets both at the same time, in either order of their numbers. */
static void test_shared_sweep(void)
{
    const struct carom_mesh_way way = {{{0, 0, -4 * UNIT}}, {{0, 0, 0}}};

    shape_box(&box, 12, 4096, 4096, 4096);
    for (int side = -1; side <= 1; side += 2) {
        struct carom_world *world = asked_world(0);
        struct carom_query_mesh mesh = put(&box.mesh);
        struct carom_mesh_hit hit;

        CHECK_EQ(asked_add(world, &box.mesh, true, side * (UNIT / 2 + UNIT / 4), 0, 0, upright), 0);
        CHECK_EQ(asked_add(world, &box.mesh, true, -side * (UNIT / 2 + UNIT / 4), 0, 0, upright),
                 1);
        mesh.position.c[2] = 3 * UNIT;
        CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
        CHECK_EQ(hit.body, 0);
        CHECK_NEAR(hit.t_q30, CAROM_ONE_Q30 / 2, CAROM_ONE_Q30 >> 10);
    }
}

/* A pixel outside the picture, or a picture of no size, has no ray. */
static void test_pixels(void)
{
    const struct carom_camera camera = {{{0, -8 * UNIT, 0}}, {{0, 0, 0}}, 1 << 16};
    struct carom_picture picture = {.width = 64, .height = 32};
    struct carom_world *world = asked_world(0);
    struct carom_ray_hit hit;
    struct carom_ray ray;

    CHECK_EQ(carom_view_ray(&camera, 64, 32, 64 * 256, 32 * 256, &ray), CAROM_OK);
    CHECK_EQ(carom_view_ray(&camera, 64, 32, 64 * 256 + 1, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 64, 32, -1, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 64, 32, 0, 32 * 256 + 1, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 64, 32, 0, -1, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 64, 0, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 64, 1 << 20, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 0, 32, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&camera, 1 << 20, 32, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 63, 31, NULL, &hit), 0);
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 63, 32, NULL, &hit), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 64, 31, NULL, &hit), CAROM_ERR_ARGUMENT);
}

const struct test tests_query_given[] = {
    {"query_given/null", test_null},
    {"query_given/range", test_range},
    {"query_given/shared_ray", test_shared_ray},
    {"query_given/shared_sweep", test_shared_sweep},
    {"query_given/pixels", test_pixels},
    {0},
};

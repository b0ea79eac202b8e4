/* SPDX-License-Identifier: MIT */
/*
 * Meshes on straight ways, by hand: the ends of what the search for the faces ahead holds - fine quanta, many faces, many axes, many
 * lists - and a surface that has moved.
 */
#include <string.h>

#include "carom_shapes.h"
#include "lib/asked.h"
#include "lib/real.h"

#define STRIPS 72

static struct shape shape[3];
static struct carom_cast_workspace workspace;

static struct carom_query_mesh put(const struct carom_mesh *mesh, int64_t x, int64_t y, int64_t z)
{
    return (struct carom_query_mesh){mesh, {{x, y, z}}, upright};
}

/* A box of these half sides in quanta comes down by `way` from `gap` above a place of the world; the part of the way that it goes. */
static double goes_down(struct carom_world *world, int quantum_bits, const int half[3],
                        const double at[3], double gap, double way, struct carom_mesh_hit *hit)
{
    struct carom_mesh_way down = {{{0, 0, -real_round(way * real_power2(32))}}, {{0, 0, 0}}};
    struct carom_query_mesh mesh;
    double to[3] = {at[0], at[1], at[2] + gap + real(half[2], quantum_bits)};

    shape_box(&shape[0], quantum_bits, 2 * half[0], 2 * half[1], 2 * half[2]);
    mesh = put(&shape[0].mesh, real_round(to[0] * real_power2(32)),
               real_round(to[1] * real_power2(32)), real_round(to[2] * real_power2(32)));
    if (carom_cast_mesh(world, &mesh, &down, NULL, &workspace, hit) != 1) {
        return 2;
    }
    /* where it stops it is half a skin above what it hits */
    return real(hit->t_q30, 30) + real(shape[0].mesh.radius_q22 >> 12, 22) / way;
}

/*
 * Boxes so large, or skins so wide, that b's quanta are too fine for the faces ahead: of a box 2^-5 units wide, whose quanta are 2^-20
 * units, and of one whose quanta are 2^-12 units.
 */
static void test_fine_quanta(void)
{
    const double top[3] = {0, 0, 1. / 64}, half[3] = {0, 0, 0.5};
    struct carom_world *world = asked_world(0);
    struct carom_mesh_hit hit;

    shape_box(&shape[1], 20, 32768, 32768, 32768);
    shape_box(&shape[2], 12, 4096, 4096, 4096);
    CHECK_EQ(asked_add(world, &shape[1].mesh, false, 0, 0, 0, upright), 0);
    /* places of the box beyond all that a mesh of these quanta can have */
    CHECK_NEAR(real_round(1e6 * goes_down(world, 12, (const int[3]){600, 600, 600}, top, 0.006,
                                          0.01, &hit)),
               600000, 5000);
    CHECK_EQ(hit.body, 0);
    /* a skin as wide */
    CHECK_NEAR(real_round(1e6 * goes_down(world, 8, (const int[3]){4000, 4000, 2000}, top, 0.0125,
                                          0.015, &hit)),
               833333, 5000);
    /* a part of the way, half a radius, as long */
    world = asked_world(0);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_NEAR(
        real_round(1e6 * goes_down(world, 8, (const int[3]){4000, 4000, 2000}, half, 30, 40, &hit)),
        750000, 5000);
    CHECK_EQ(hit.body, 0);
}

/* More faces right under the box than a list has room for. */
static void test_many_under(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_mesh_hit hit;

    shape_plane(&shape[2], 12, 24, 512);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_NEAR(real_round(1e6 * goes_down(world, 12, (const int[3]){4000, 4000, 2000},
                                          (const double[3]){0, 0, 0}, 0.0625, 0.625, &hit)),
               100000, 2000);
    CHECK_EQ(hit.body, 0);
}

/* A six-sided cone has seven axes, one more than a body ahead: it comes down on its base. */
static void test_many_axes(void)
{
    static int16_t vertices[CAROM_CONE_VERTICES(6)][3];
    static uint16_t faces[CAROM_CONE_FACES(6)][3];
    static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(CAROM_CONE_VERTICES(6), CAROM_CONE_FACES(6))];
    const struct carom_shape_room room = {vertices, faces, CAROM_CONE_VERTICES(6),
                                          CAROM_CONE_FACES(6), 12};
    const struct carom_mesh_way way = {{{0, 0, -2 * UNIT}}, {{0, 0, 0}}};
    struct carom_world *world = asked_world(0);
    struct carom_query_mesh mesh;
    struct carom_mesh_raw raw;
    struct carom_mesh cone;
    struct carom_mesh_hit hit;

    CHECK_EQ(carom_shape_cone(&raw, &room, 2048, 1024, 6), CAROM_OK);
    CHECK_EQ(carom_mesh_build(&cone, &raw, block, sizeof block), CAROM_OK);
    CHECK_EQ(cone.leaf_count, 1);
    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    /* the base is a quarter of the height, 1/2 unit, below the centre of mass */
    mesh = put(&cone, 0, UNIT / 8, UNIT + UNIT / 8);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_NEAR(hit.t_q30, CAROM_ONE_Q30 / 2, CAROM_ONE_Q30 >> 10);
    CHECK_NEAR(hit.position.c[2], UNIT / 8, UNIT >> 10);
}

/*
 * A plate as thick as a strip of the plane is wide goes over 64 of them, two skins above: it touches none, though it comes by more
 * faces than the lists of its way hold.
 */
static void test_many_lists(void)
{
    const struct carom_mesh_way way = {{{UNIT / 4, 0, 0}}, {{0, 0, 0}}};
    struct carom_world *world = asked_world(0);
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    int64_t skin_q32;

    shape_box(&shape[0], 12, 16, 2048, 4096);
    shape_plane(&shape[2], 12, 1, 4096); /* strips of 1/256 by 1 unit in its place */
    shape[2].raw.vertex_count = 2 * (STRIPS + 1);
    shape[2].raw.face_count = 2 * STRIPS;
    for (int v = 0; v < 2 * (STRIPS + 1); v++) {
        shape[2].vertices[v][0] = (int16_t)(16 * (v / 2 - STRIPS / 2));
        shape[2].vertices[v][1] = v % 2 ? 2048 : -2048;
        shape[2].vertices[v][2] = 0;
    }
    for (uint16_t f = 0; f < 2 * STRIPS; f++) {
        shape[2].faces[f][0] = f;
        shape[2].faces[f][1] = (uint16_t)(f + (f % 2 ? 1 : 2));
        shape[2].faces[f][2] = (uint16_t)(f + (f % 2 ? 2 : 1));
    }
    CHECK_EQ(carom_mesh_build(&shape[2].mesh, &shape[2].raw, shape[2].block, sizeof shape[2].block),
             CAROM_OK);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    skin_q32 = (int64_t)(shape[0].mesh.radius_q22 >> 11) << 10;
    mesh = put(&shape[0].mesh, -UNIT / 8, 0, UNIT / 2 + 2 * skin_q32);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 0);
}

/* A plane that the caller has moved up by an eighth: a box comes down on it there, though its own z-lists have it where it was. */
static void test_moved_surface(void)
{
    static _Alignas(8) uint8_t block[CAROM_SURFACE_BYTES(9, 8)];
    static _Alignas(8) uint8_t room[CAROM_WORLD_BYTES(2, 1, 16, 64, 64, 64)];
    const struct carom_config config = {.caps = CAROM_CAPS(2, 1, 16, 64, 64, 64)};
    struct carom_world *world = NULL;
    struct carom_body_def def;
    struct carom_mesh_hit hit;
    struct carom_mesh surface;

    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(carom_surface_build(&surface, &shape[2].raw, block, sizeof block), CAROM_OK);
    CHECK_EQ(carom_world_init(room, sizeof room, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &surface;
    def.stationary = true;
    def.rotation = upright;
    CHECK_EQ(carom_body_add(world, &def), 0);
    for (int v = 0; v < 9; v++) {
        shape[2].vertices[v][2] = 512;
    }
    CHECK_EQ(carom_surface_set(world, 0, (const int16_t(*)[3])shape[2].vertices), CAROM_OK);
    CHECK_NEAR(real_round(1e6 * goes_down(world, 12, (const int[3]){2000, 2000, 1000},
                                          (const double[3]){0, 0.25, 0.125}, 1, 2, &hit)),
               500000, 2000);
    CHECK_EQ(hit.body, 0);
}

const struct test tests_query_ahead[] = {
    {"query_ahead/fine_quanta", test_fine_quanta},     {"query_ahead/many_under", test_many_under},
    {"query_ahead/many_axes", test_many_axes},         {"query_ahead/many_lists", test_many_lists},
    {"query_ahead/moved_surface", test_moved_surface}, {0},
};

/* SPDX-License-Identifier: MIT */
/*
 * The meshes of examples/models.h are closed, and have the size and the volume that they were made
 * for.
 */
#include "models.h"
#include "lib/test.h"

static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(BOWL_VERTICES, BOWL_FACES)];

/*
 * Volumes and sides in thousandths, by hand. Rounding to quanta changes less than a hundredth of
 * them.
 */
static const struct {
    const struct carom_mesh_raw *raw;
    int vertices, faces;
    int32_t volume, side[3];
} models[] = {
    {&wheel_mesh, WHEEL_VERTICES, WHEEL_FACES, 75, {700, 200, 700}}, /* 8 0.35^2 sin 22.5 0.2 */
    {&door_mesh, DOOR_VERTICES, DOOR_FACES, 90, {900, 50, 2000}},
    {&ramp_mesh, RAMP_VERTICES, RAMP_FACES, 500, {2000, 1000, 500}},    /* half of a box */
    {&steps_mesh, STEPS_VERTICES, STEPS_FACES, 450, {1200, 1000, 600}}, /* 10 of 0.3 x 0.15 */
    {&jump_mesh, JUMP_VERTICES, JUMP_FACES, 1890, {3000, 3600, 350}},   /* half of a box */
    {&tower_mesh, TOWER_VERTICES, TOWER_FACES, 7200, {1200, 1200, 5000}},
    {&mat_mesh, MAT_VERTICES, MAT_FACES, 72, {2400, 1000, 30}},
    {&domino_mesh, DOMINO_VERTICES, DOMINO_FACES, 35, {125, 375, 750}},
    {&beam_mesh, BEAM_VERTICES, BEAM_FACES, 10, {2900, 60, 60}},
    {&post_mesh, POST_VERTICES, POST_FACES, 9, {60, 60, 2400}},
    {&card_mesh, CARD_VERTICES, CARD_FACES, 14, {20, 700, 1000}},
    {&cover_mesh, COVER_VERTICES, COVER_FACES, 11, {809, 700, 20}},
    {&stone_mesh, STONE_VERTICES, STONE_FACES, 202, {555, 700, 600}}, /* 2 1.985 tan (pi / 26) */
    {&plinth_mesh, PLINTH_VERTICES, PLINTH_FACES, 648, {900, 900, 800}},
    /* n sin (2 pi / n) / 6 times the sum of h (r^2 + r s + s^2), minus the same for the inside */
    {&bowl_mesh, BOWL_VERTICES, BOWL_FACES, 1183, {3000, 3000, 1100}},
    {&cup_mesh, CUP_VERTICES, CUP_FACES, 91, {1000, 951, 500}},
};

static void check(const struct carom_mesh_raw *raw, int vertices, int faces)
{
    struct carom_mesh mesh;

    CHECK_EQ(raw->vertex_count, vertices);
    CHECK_EQ(raw->face_count, faces);
    CHECK_EQ(raw->kind, CAROM_SOLID);
    CHECK_EQ(carom_mesh_build(&mesh, raw, block, sizeof block), CAROM_OK);
    /* one closed piece without a hole; the link has a hole, and three links: V - E + F = 2 pieces -
     * 2 holes */
    CHECK_EQ(vertices - (int)mesh.edge_count + faces, raw == &link_mesh       ? 0
                                                      : raw == &pendulum_mesh ? 6
                                                                              : 2);
    CHECK_MORE(mesh.mass.volume_q32, 0);
}

static void closed(void)
{
    check(&character_mesh, CHARACTER_VERTICES, CHARACTER_FACES);
    check(&wheel_mesh, WHEEL_VERTICES, WHEEL_FACES);
    check(&car_mesh, CAR_VERTICES, CAR_FACES);
    check(&door_mesh, DOOR_VERTICES, DOOR_FACES);
    check(&link_mesh, LINK_VERTICES, LINK_FACES);
    check(&ramp_mesh, RAMP_VERTICES, RAMP_FACES);
    check(&steps_mesh, STEPS_VERTICES, STEPS_FACES);
    check(&jump_mesh, JUMP_VERTICES, JUMP_FACES);
    check(&tower_mesh, TOWER_VERTICES, TOWER_FACES);
    check(&mat_mesh, MAT_VERTICES, MAT_FACES);
    check(&domino_mesh, DOMINO_VERTICES, DOMINO_FACES);
    check(&pendulum_mesh, PENDULUM_VERTICES, PENDULUM_FACES);
    check(&beam_mesh, BEAM_VERTICES, BEAM_FACES);
    check(&post_mesh, POST_VERTICES, POST_FACES);
    check(&card_mesh, CARD_VERTICES, CARD_FACES);
    check(&cover_mesh, COVER_VERTICES, COVER_FACES);
    check(&stone_mesh, STONE_VERTICES, STONE_FACES);
    check(&plinth_mesh, PLINTH_VERTICES, PLINTH_FACES);
    check(&bowl_mesh, BOWL_VERTICES, BOWL_FACES);
    check(&cup_mesh, CUP_VERTICES, CUP_FACES);
}

static void sizes(void)
{
    for (size_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        struct carom_mesh mesh;

        CHECK_EQ(carom_mesh_build(&mesh, models[i].raw, block, sizeof block), CAROM_OK);
        CHECK_NEAR(mesh.mass.volume_q32 * 1000 >> 32, models[i].volume, models[i].volume / 50 + 1);
        for (int k = 0; k < 3; k++) {
            int32_t side = (mesh.box[1][k] - mesh.box[0][k]) * 1000 >> mesh.raw.quantum_bits;

            CHECK_NEAR(side, models[i].side[k], 3);
        }
    }
}

const struct test tests_scene_models[] = {
    {"scene_models/closed", closed}, {"scene_models/sizes", sizes}, {0}};

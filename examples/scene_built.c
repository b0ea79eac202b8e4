/* SPDX-License-Identifier: MIT */
/* The meshes of the scenes, built when a scene is loaded. */
#include <string.h>

#include "models.h"
#include "scene.h"
#include "scene_box.h"

/* A box of 1 x 0.7 x 0.5 units; a quantum is 1/4096 unit. */
static const int16_t box_vertices[8][3] = SCENE_BOX_CORNERS(2048, 1434, 1024);
static const struct carom_mesh_raw box_mesh = {
    box_vertices, scene_box_faces, 8, 12, 12, CAROM_SOLID,
};

/* A tetrahedron and an L of three cubes, for piles; half the size of the box. */
#define PILE_BITS 13
#define TIP       1900
static const int16_t tetrahedron_vertices[4][3] = {
    {TIP, TIP, TIP}, {TIP, -TIP, -TIP}, {-TIP, TIP, -TIP}, {-TIP, -TIP, TIP}};
static const uint16_t tetrahedron_faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const struct carom_mesh_raw tetrahedron_mesh = {
    tetrahedron_vertices, tetrahedron_faces, 4, 4, PILE_BITS, CAROM_SOLID,
};
#define CUBE 1600
static const int16_t l_vertices[12][3] = {
    {-CUBE, -CUBE, 0}, {CUBE, -CUBE, 0}, {CUBE, 0, 0},         {0, 0, 0},
    {0, CUBE, 0},      {-CUBE, CUBE, 0}, {-CUBE, -CUBE, CUBE}, {CUBE, -CUBE, CUBE},
    {CUBE, 0, CUBE},   {0, 0, CUBE},     {0, CUBE, CUBE},      {-CUBE, CUBE, CUBE},
};
static const uint16_t l_faces[20][3] = {
    {0, 2, 1},   {0, 3, 2},  {0, 4, 3},  {0, 5, 4},   {6, 7, 8}, {6, 8, 9},  {6, 9, 10},
    {6, 10, 11}, {0, 1, 7},  {0, 7, 6},  {1, 2, 8},   {1, 8, 7}, {2, 3, 9},  {2, 9, 8},
    {3, 4, 10},  {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11},
};
static const struct carom_mesh_raw l_mesh = {
    l_vertices, l_faces, 12, 20, PILE_BITS, CAROM_SOLID,
};

/* 12 to 80 faces each. */
#define SMALL_BODIES &box_mesh, &l_mesh, &head48_mesh, &head80_mesh

/* A plane of 8 x 8 units. */
#define PLANE 16384
static const int16_t plane_vertices[4][3] = {
    {-PLANE, -PLANE, 0}, {PLANE, -PLANE, 0}, {PLANE, PLANE, 0}, {-PLANE, PLANE, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw plane_mesh = {
    plane_vertices, plane_faces, 4, 2, 12, CAROM_SURFACE,
};

/* The ground of small games: 64 x 64 units. */
static const struct carom_mesh_raw flat_mesh = {
    plane_vertices, plane_faces, 4, 2, 9, CAROM_SURFACE,
};

/* A ball of 20 faces, 1/4 unit from the middle to its corners. */
#define NEAR_Q12 538
#define FAR_Q12  871
static const int16_t ball_vertices[12][3] = {
    {-NEAR_Q12, FAR_Q12, 0},  {NEAR_Q12, FAR_Q12, 0},   {-NEAR_Q12, -FAR_Q12, 0},
    {NEAR_Q12, -FAR_Q12, 0},  {0, -NEAR_Q12, FAR_Q12},  {0, NEAR_Q12, FAR_Q12},
    {0, -NEAR_Q12, -FAR_Q12}, {0, NEAR_Q12, -FAR_Q12},  {FAR_Q12, 0, -NEAR_Q12},
    {FAR_Q12, 0, NEAR_Q12},   {-FAR_Q12, 0, -NEAR_Q12}, {-FAR_Q12, 0, NEAR_Q12},
};
static const uint16_t ball_faces[20][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
};
static const struct carom_mesh_raw ball_mesh = {
    ball_vertices, ball_faces, 12, 20, 12, CAROM_SOLID,
};

/* A slab of 6 x 1 x 0.2 units. */
static const int16_t belt_vertices[8][3] = SCENE_BOX_CORNERS(12288, 2048, 410);
static const struct carom_mesh_raw belt_mesh = {
    belt_vertices, scene_box_faces, 8, 12, 12, CAROM_SOLID,
};

/*
 * The same mesh with the quantum that makes its largest side 1.25 to 2.5 units; the head is 2.1
 * wide. Quanta are powers of two, so the vertices stay as they are.
 */
static struct carom_mesh_raw scaled(const struct carom_mesh_raw *user)
{
    struct carom_mesh_raw mesh = *user;
    int32_t side = 1;

    for (int k = 0; k < 3; k++) {
        int32_t low = INT16_MAX, high = INT16_MIN;

        for (uint32_t v = 0; v < mesh.vertex_count; v++) {
            low = mesh.vertices[v][k] < low ? mesh.vertices[v][k] : low;
            high = mesh.vertices[v][k] > high ? mesh.vertices[v][k] : high;
        }
        side = high - low > side ? high - low : side;
    }
    mesh.quantum_bits = 7;
    while (mesh.quantum_bits < 20 && side * 2 > 5 << mesh.quantum_bits) {
        mesh.quantum_bits++;
    }
    return mesh;
}

/* Take room from the start of the caller's memory; NULL if there is too little. */
static void *take(uint8_t **mem, size_t *left, size_t bytes)
{
    void *taken = *mem;

    if (*left < bytes) {
        return NULL;
    }
    *mem += bytes;
    *left -= bytes;
    return taken;
}

/* Build the next mesh in the caller's memory, with its index behind it. */
static int build(const struct carom_mesh **built, const struct carom_mesh_raw *raw, uint8_t **mem,
                 size_t *left)
{
    size_t index_bytes = CAROM_MESH_BYTES(raw->vertex_count, raw->face_count);
    struct carom_mesh *mesh = take(mem, left, SCENE_MESH(raw->vertex_count, raw->face_count));

    if (!mesh) {
        return CAROM_ERR_MEMORY;
    }
    *built = mesh;
    return carom_mesh_build(mesh, raw, *mem - index_bytes, index_bytes);
}

/* The same for the sheet, which moves, with its vertices in front. */
static int build_sheet(struct scene *scene, uint8_t **mem, size_t *left)
{
    size_t index_bytes = CAROM_SURFACE_BYTES(SCENE_SHEET_VERTICES, SCENE_SHEET_FACES);
    struct scene_sheet *sheet = take(mem, left, (sizeof *sheet + 7) / 8 * 8);
    struct carom_mesh *mesh = take(mem, left, SCENE_MESH(0, 0) - CAROM_MESH_BYTES(0, 0));
    void *index = take(mem, left, index_bytes);
    struct carom_mesh_raw raw;

    if (!sheet || !mesh || !index) {
        return CAROM_ERR_MEMORY;
    }
    raw = scene_sheet_raw(sheet);
    scene->sheet = sheet;
    scene->ground.mesh = mesh;
    return carom_surface_build(mesh, &raw, index, index_bytes);
}

/* The meshes of a scene. */
static const struct materials {
    const char *name;
    const struct carom_mesh_raw *ground; /* NULL: the sheet */
    const struct carom_mesh_raw *bodies[SCENE_MESHES];
    uint8_t quantum_bits; /* quanta of the bodies; 0: their own */
} materials[] = {
    {"head", &field_mesh, {&head_mesh}, 0},
    {"head-spin", &field_mesh, {&head_mesh}, 0},
    {"head-spin2", &field_mesh, {&head_mesh}, 0},
    {"head48", &field128_mesh, {&head48_mesh}, 11},
    {"head100", &field128_mesh, {&head100_mesh}, 0},
    {"head450", &field386_mesh, {&head450_mesh}, 0},
    {"head836", &field512_mesh, {&head836_mesh}, 0},
    {"apart", &field_mesh, {&head_mesh}, 0},
    {"box", &plane_mesh, {&box_mesh}, 0},
    {"pair", &plane_mesh, {&tetrahedron_mesh, &box_mesh}, 13},
    {"brick", &plane_mesh, {&box_mesh}, 0},
    {"boxes3", &field128_mesh, {&box_mesh}, 13},
    {"boxes10", &plane_mesh, {&box_mesh}, 0},
    {"stack10", &plane_mesh, {&box_mesh}, 0},
    {"pile", &field_mesh, {&box_mesh, &tetrahedron_mesh, &l_mesh}, 13},
    {"pile32", &field_mesh, {SMALL_BODIES}, 13},
    {"flight32", &field_mesh, {SMALL_BODIES}, 13},
    {"growth-512", &field512_mesh, {&head_mesh}, 0},
    {"growth-3034", &field_mesh, {&head_mesh}, 0},
    {"growth-12012", &field12012_mesh, {&head_mesh}, 0},
    {"growth-49928", &field49928_mesh, {&head_mesh}, 0},
    {"sheet", NULL, {&box_mesh}, 0},
    {"user", &field_mesh, {NULL}, 0},
    {"door", &flat_mesh, {&door_mesh, &ball_mesh}, 0},
    {"chain", &flat_mesh, {&link_mesh}, 0},
    {"crusher", &flat_mesh, {&box_mesh, &ball_mesh}, 0},
    {"car", &yard_mesh, {&car_mesh, &wheel_mesh, &jump_mesh, &ball_mesh, &tower_mesh}, 0},
    {"walker",
     &yard_mesh,
     {&character_mesh, &steps_mesh, &ramp_mesh, &door_mesh, &box_mesh, &mat_mesh},
     0},
    {"conveyor", &flat_mesh, {&box_mesh, &belt_mesh}, 0},
    {"gears", &flat_mesh, {&gear10_mesh, &gear24_mesh, &gear16_mesh, &gear12_mesh, &board_mesh}, 0},
    {"screw", &flat_mesh, {&nut_mesh, &bolt_mesh, &hexagon_mesh}, 0},
    {"newton", &flat_mesh, {&pendulum_mesh, &beam_mesh, &post_mesh}, 0},
    {"dominoes", &flat_mesh, {&domino_mesh, &ball_mesh}, 0},
    {"cards", &flat_mesh, {&card_mesh, &cover_mesh, &ball_mesh}, 0},
    {"arch", &flat_mesh, {&stone_mesh, &plinth_mesh, &ball_mesh}, 0},
    {"bowl", &flat_mesh, {&bowl_mesh, &cup_mesh, &ball_mesh}, 0},
    {"espresso", &mandelbrot512_mesh, {&espresso_mesh}, 0},
    {"espresso-fine", &mandelbrot3200_mesh, {&espresso_mesh}, 0},
    {"pour",
     &flat_mesh,
     {&ring_mesh, &star_mesh, &hook_mesh, &beaker_mesh, &bucket_mesh, &tray_mesh},
     0},
    {"lockstep", &flat_mesh, {&rink_mesh, &puck_mesh, &ball_mesh, &box_mesh}, 0},
};

static const struct materials *find(const char *name)
{
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        if (strcmp(name, materials[i].name) == 0) {
            return &materials[i];
        }
    }
    return NULL;
}

int scene_meshes(struct scene *scene, const char *name, const struct carom_mesh_raw *user,
                 void *mem, size_t bytes)
{
    const struct materials *of = find(name);
    uint8_t *next = mem;
    int result;

    if (!of || (of->bodies[0] == NULL) != (user != NULL)) {
        return CAROM_ERR_ARGUMENT;
    }
    result = of->ground ? build(&scene->ground.mesh, of->ground, &next, &bytes)
                        : build_sheet(scene, &next, &bytes);
    while (result >= 0 && scene->mesh_count < SCENE_MESHES &&
           (user ? scene->mesh_count == 0 : of->bodies[scene->mesh_count] != NULL)) {
        struct carom_mesh_raw raw = user ? scaled(user) : *of->bodies[scene->mesh_count];

        raw.quantum_bits = of->quantum_bits ? of->quantum_bits : raw.quantum_bits;
        result = build(&scene->mesh[scene->mesh_count++], &raw, &next, &bytes);
    }
    return result;
}

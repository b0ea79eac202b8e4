/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include <string.h>

#define FPS 60
#define POSITION(x, y, z)                                                                          \
    {                                                                                              \
        {                                                                                          \
            CAROM_POSITION_MM(x), CAROM_POSITION_MM(y), CAROM_POSITION_MM(z)                       \
        }                                                                                          \
    }
#define VELOCITY(x, y, z)                                                                          \
    {                                                                                              \
        {                                                                                          \
            CAROM_VELOCITY_MM_S(x, FPS), CAROM_VELOCITY_MM_S(y, FPS), CAROM_VELOCITY_MM_S(z, FPS)  \
        }                                                                                          \
    }
#define SPIN(x, y, z)                                                                              \
    {                                                                                              \
        {                                                                                          \
            CAROM_SPIN_MRAD_S(x, FPS), CAROM_SPIN_MRAD_S(y, FPS), CAROM_SPIN_MRAD_S(z, FPS)        \
        }                                                                                          \
    }

#define RESTITUTION_Q30 (CAROM_ONE_Q30 / 2)
#define FRICTION_Q16    (1u << 15)

/* How the body starts, in mm, mm/s and mrad/s, and where the camera is. */
static const struct carom_body_def head_start = {
    .position = POSITION(-1600, 600, 2800),
    .velocity = VELOCITY(900, -400, 0),
    .spin = SPIN(1500, -1800, 900),
    .restitution_q30 = RESTITUTION_Q30,
    .friction_q16 = FRICTION_Q16,
};
static const struct carom_body_def box_start = {
    .position = POSITION(-900, -300, 2200),
    .velocity = VELOCITY(900, 300, 0),
    .spin = SPIN(2100, 700, -1300),
    .restitution_q30 = RESTITUTION_Q30,
    .friction_q16 = FRICTION_Q16,
};
static const struct carom_body_def ground_start = {
    .stationary = true,
    .restitution_q30 = RESTITUTION_Q30,
    .friction_q16 = FRICTION_Q16,
};
static const struct carom_camera camera = {
    .eye = POSITION(1900, -6500, 3600),
    .target = POSITION(-600, 0, 900),
    .focal_q16 = 1 << 16,
};

/* A box of 1 x 0.7 x 0.5 units; a quantum is 1/4096 unit. */
#define BOX_X 2048
#define BOX_Y 1434
#define BOX_Z 1024
static const int16_t box_vertices[8][3] = {
    {-BOX_X, -BOX_Y, -BOX_Z}, {BOX_X, -BOX_Y, -BOX_Z}, {BOX_X, BOX_Y, -BOX_Z},
    {-BOX_X, BOX_Y, -BOX_Z},  {-BOX_X, -BOX_Y, BOX_Z}, {BOX_X, -BOX_Y, BOX_Z},
    {BOX_X, BOX_Y, BOX_Z},    {-BOX_X, BOX_Y, BOX_Z},
};
static const uint16_t box_faces[12][3] = {
    {0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7},
};
static const struct carom_mesh_raw box_mesh = {
    box_vertices, box_faces, 8, 12, 12, CAROM_SOLID,
};

/* A tetrahedron and an L of three cubes, for the pile; all smaller by half than the box. */
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

/* A plane of 8 x 8 units. */
#define PLANE 16384
static const int16_t plane_vertices[4][3] = {
    {-PLANE, -PLANE, 0}, {PLANE, -PLANE, 0}, {PLANE, PLANE, 0}, {-PLANE, PLANE, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw plane_mesh = {
    plane_vertices, plane_faces, 4, 2, 12, CAROM_SURFACE,
};

struct carom_config scene_config(void)
{
    struct carom_config config = {
        .caps = {SCENE_CAPS},
        .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, FPS)}},
        .sleep = true,
    };

    return config;
}

/*
 * The same mesh with the quantum that makes its largest side 1.25 to 2.5 units; the head is 2.1
 * wide. Powers of two only, so that the vertices stay as they are.
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

/* The next of the caller's memory for a mesh, built from it. */
static int build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, uint8_t **mem,
                 size_t *bytes)
{
    size_t wanted = CAROM_MESH_BYTES(raw->vertex_count, raw->face_count);
    int result = *bytes < wanted ? CAROM_ERR_MEMORY : carom_mesh_build(mesh, raw, *mem, wanted);

    if (result >= 0) {
        *mem += wanted;
        *bytes -= wanted;
    }
    return result;
}

/* The same for the sheet, which is going to move. */
static int build_sheet(struct scene *scene, uint8_t **mem, size_t *bytes)
{
    struct carom_mesh_raw raw = scene_sheet_raw(&scene->sheet);
    size_t wanted = CAROM_SURFACE_BYTES(SCENE_SHEET_VERTICES, SCENE_SHEET_FACES);
    int result = *bytes < wanted ? CAROM_ERR_MEMORY
                                 : carom_surface_build(&scene->ground_mesh, &raw, *mem, wanted);

    if (result >= 0) {
        *mem += wanted;
        *bytes -= wanted;
    }
    return result;
}

/* Layers of four, each turned and shifted against the one below, falling close together. */
static void pour(struct scene *scene)
{
    for (int i = 0; i < SCENE_OTHERS + 1; i++) {
        struct carom_body_def *def = i == 0 ? &scene->body : &scene->others[i - 1];
        int column = i % 4, layer = i / 4;

        *def = head_start;
        def->mesh = i % 3 == 0 ? &scene->body_mesh : &scene->other_mesh[i % 3 - 1];
        def->position.c[0] = CAROM_POSITION_MM(-700 + 750 * (column % 2) + 90 * layer);
        def->position.c[1] = CAROM_POSITION_MM(-500 + 750 * (column / 2) - 70 * layer);
        def->position.c[2] = CAROM_POSITION_MM(1900 + 800 * layer + 60 * column);
        def->velocity.c[0] = CAROM_VELOCITY_MM_S(100 * (2 - column), FPS);
        def->velocity.c[1] = CAROM_VELOCITY_MM_S(150 - 100 * layer, FPS);
        def->spin.c[0] = CAROM_SPIN_MRAD_S(1500 - 400 * column, FPS);
        def->spin.c[1] = CAROM_SPIN_MRAD_S(300 * layer, FPS);
        def->spin.c[2] = CAROM_SPIN_MRAD_S(250 * (i % 5), FPS);
    }
    scene->other_count = SCENE_OTHERS;
    scene->caps = (struct carom_caps){SCENE_PILE_CAPS};
}

int scene_load(struct scene *scene, const char *name, const struct carom_mesh_raw *user, void *mem,
               size_t bytes)
{
    bool box = strcmp(name, "box") == 0, pile = strcmp(name, "pile") == 0;
    bool sheet = strcmp(name, "sheet") == 0;
    struct carom_mesh_raw ground = box ? plane_mesh : field_mesh;
    struct carom_mesh_raw body = box || pile || sheet ? box_mesh : head_mesh;
    uint8_t *next = mem;
    int result;

    if (strcmp(name, "user") == 0 && user) {
        body = scaled(user);
    } else if (!box && !pile && !sheet && strcmp(name, "head") != 0) {
        return CAROM_ERR_ARGUMENT;
    }
    memset(scene, 0, sizeof *scene);
    if (pile) {
        body.quantum_bits = PILE_BITS;
    }
    result = sheet ? build_sheet(scene, &next, &bytes)
                   : build(&scene->ground_mesh, &ground, &next, &bytes);
    if (result >= 0) {
        result = build(&scene->body_mesh, &body, &next, &bytes);
    }
    if (result >= 0 && pile) {
        result = build(&scene->other_mesh[0], &tetrahedron_mesh, &next, &bytes);
    }
    if (result >= 0 && pile) {
        result = build(&scene->other_mesh[1], &l_mesh, &next, &bytes);
    }
    scene->ground = ground_start;
    scene->ground.mesh = &scene->ground_mesh;
    scene->body = box || sheet ? box_start : head_start;
    scene->body.mesh = &scene->body_mesh;
    scene->camera = camera;
    scene->caps = (struct carom_caps){SCENE_CAPS};
    if (pile) {
        pour(scene);
    }
    if (sheet) {
        scene->caps = (struct carom_caps){SCENE_SHEET_CAPS};
        scene->waves = true;
    }
    return result;
}

int scene_make(const struct scene *scene, const struct carom_config *config, void *block,
               size_t bytes, struct carom_world **world)
{
    struct carom_config own = *config;
    int result;

    if (scene->other_count > 0 || scene->waves) {
        own.caps = scene->caps;
    }
    result = carom_world_init(block, bytes, &own, world);
    if (result >= 0) {
        result = carom_body_add(*world, &scene->ground);
    }
    if (result >= 0) {
        result = carom_body_add(*world, &scene->body);
    }
    for (int i = 0; i < scene->other_count && result >= 0; i++) {
        result = carom_body_add(*world, &scene->others[i]);
    }
    return result < 0 ? result : CAROM_OK;
}

int scene_before(struct scene *scene, struct carom_world *world, int frame)
{
    if (!scene->waves) {
        return CAROM_OK;
    }
    scene_sheet_shape(scene->sheet.vertices, frame);
    return carom_surface_move(world, SCENE_GROUND, (const int16_t(*)[3])scene->sheet.vertices);
}

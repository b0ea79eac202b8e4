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

int scene_load(struct scene *scene, const char *name, const struct carom_mesh_raw *user, void *mem,
               size_t bytes)
{
    bool box = strcmp(name, "box") == 0;
    struct carom_mesh_raw ground = box ? plane_mesh : field_mesh;
    struct carom_mesh_raw body = box ? box_mesh : head_mesh;
    size_t ground_bytes = CAROM_MESH_BYTES(ground.vertex_count, ground.face_count);
    int result;

    if (strcmp(name, "user") == 0 && user) {
        body = scaled(user);
    } else if (!box && strcmp(name, "head") != 0) {
        return CAROM_ERR_ARGUMENT;
    }
    if (bytes < ground_bytes) {
        return CAROM_ERR_MEMORY;
    }
    result = carom_mesh_build(&scene->ground_mesh, &ground, mem, ground_bytes);
    if (result >= 0) {
        result = carom_mesh_build(&scene->body_mesh, &body, (uint8_t *)mem + ground_bytes,
                                  bytes - ground_bytes);
    }
    scene->ground = ground_start;
    scene->ground.mesh = &scene->ground_mesh;
    scene->body = box ? box_start : head_start;
    scene->body.mesh = &scene->body_mesh;
    scene->camera = camera;
    return result;
}

int scene_make(const struct scene *scene, const struct carom_config *config, void *block,
               size_t bytes, struct carom_world **world)
{
    int result = carom_world_init(block, bytes, config, world);

    if (result >= 0) {
        result = carom_body_add(*world, &scene->ground);
    }
    if (result >= 0) {
        result = carom_body_add(*world, &scene->body);
    }
    return result < 0 ? result : CAROM_OK;
}

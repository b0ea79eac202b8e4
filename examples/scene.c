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
/* Thrown at 4 units/s, turning by 8 rad/s. */
#define THROW(x, y, z, vx, vy, vz, wx, wy, wz)                                                     \
    {                                                                                              \
        .position = POSITION(x, y, z), .velocity = VELOCITY(vx, vy, vz), .spin = SPIN(wx, wy, wz), \
        .restitution_q30 = RESTITUTION_Q30, .friction_q16 = FRICTION_Q16,                          \
    }
static const struct carom_body_def spin_starts[] = {
    THROW(-2600, 1300, 2400, 3200, -2400, 0, 4800, -6400, 0),
    THROW(900, -600, 2700, -1600, 1200, -3464, 0, 0, 8000),
    THROW(-300, 1900, 2100, 0, -3200, -2400, -6400, 0, 4800),
    THROW(1500, 1500, 3200, -1600, -1200, 3464, 4619, 4619, -4619),
};
/* Some 3 mm over the fields of 512, 3034, 12012 and 49928 faces. */
#define PUT(z)                                                                                     \
    {                                                                                              \
        .position = POSITION(-600, 200, z), .velocity = VELOCITY(300, -100, 0),                    \
        .friction_q16 = FRICTION_Q16,                                                              \
    }
static const struct carom_body_def growth_starts[] = {PUT(1006), PUT(1015), PUT(1019), PUT(1019)};
static const struct carom_body_def far_start = {.position = POSITION(0, 0, 1000000)};
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

/* A tetrahedron and an L of three cubes, for piles; all smaller by half than the box. */
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

/* Layers of side x side bodies, each turned and shifted against the one below, close together. */
static void pour(struct scene *scene, int side, int z_mm, int up_mm_s)
{
    for (int i = 0; i <= scene->other_count; i++) {
        struct carom_body_def *def = i == 0 ? &scene->body : &scene->others[i - 1];
        int cell = i % (side * side), layer = i / (side * side), column = i % 4;

        def->position.c[0] = CAROM_POSITION_MM(50 - 375 * side + 750 * (cell % side) + 90 * layer);
        def->position.c[1] = CAROM_POSITION_MM(250 - 375 * side + 750 * (cell / side) - 70 * layer);
        def->position.c[2] = CAROM_POSITION_MM(z_mm + 800 * layer + 60 * column);
        def->velocity.c[0] = CAROM_VELOCITY_MM_S(100 * (2 - column), FPS);
        def->velocity.c[1] = CAROM_VELOCITY_MM_S(150 - 100 * layer, FPS);
        def->velocity.c[2] = CAROM_VELOCITY_MM_S(up_mm_s, FPS);
        def->spin.c[0] = CAROM_SPIN_MRAD_S(1500 - 400 * column, FPS);
        def->spin.c[1] = CAROM_SPIN_MRAD_S(300 * layer, FPS);
        def->spin.c[2] = CAROM_SPIN_MRAD_S(250 * (i % 5), FPS);
    }
}

static void pile(struct scene *scene)
{
    pour(scene, scene->other_count < 16 ? 2 : 3, 1900, 0);
}

/* Thrown up from just above the field. */
static void fly(struct scene *scene)
{
    pour(scene, 6, 1000, 1500);
}

/* In two rows on the plane. */
static void lay(struct scene *scene)
{
    for (int i = 0; i <= scene->other_count; i++) {
        struct carom_body_def *def = i == 0 ? &scene->body : &scene->others[i - 1];

        def->position.c[0] = CAROM_POSITION_MM(-3000 + 1500 * (i % 5));
        def->position.c[1] = CAROM_POSITION_MM(-1000 + 2000 * (i / 5));
        def->position.c[2] = CAROM_POSITION_MM(252);
        def->spin = (carom_v3_q40){{0, 0, 0}};
        def->velocity = def->spin;
    }
}

/* What a scene is made of. */
static const struct recipe {
    const char *name;
    const struct carom_mesh_raw *ground;               /* NULL: the sheet */
    const struct carom_mesh_raw *bodies[SCENE_MESHES]; /* the bodies take them in turn */
    const struct carom_body_def *start;
    void (*arrange)(struct scene *); /* where further bodies are */
    uint8_t others;                  /* bodies but the first */
    uint8_t quantum_bits;            /* of the bodies; 0: as they have */
} recipes[] = {
    {"head", &field_mesh, {&head_mesh}, &head_start, NULL, 0, 0},
    {"head-spin", &field_mesh, {&head_mesh}, &spin_starts[0], NULL, 0, 0},
    {"head-spin2", &field_mesh, {&head_mesh}, &spin_starts[1], NULL, 0, 0},
    {"head-spin3", &field_mesh, {&head_mesh}, &spin_starts[2], NULL, 0, 0},
    {"head-spin4", &field_mesh, {&head_mesh}, &spin_starts[3], NULL, 0, 0},
    {"head450", &field386_mesh, {&head450_mesh}, &head_start, NULL, 0, 0},
    {"head836", &field512_mesh, {&head836_mesh}, &head_start, NULL, 0, 0},
    {"apart", &field_mesh, {&head_mesh}, &far_start, NULL, 0, 0},
    {"box", &plane_mesh, {&box_mesh}, &box_start, NULL, 0, 0},
    {"boxes10", &plane_mesh, {&box_mesh}, &box_start, lay, 9, 0},
    {"pile", &field_mesh, {&box_mesh, &tetrahedron_mesh, &l_mesh}, &head_start, pile, 15, 13},
    {"pile32", &field_mesh, {SMALL_BODIES}, &head_start, pile, 31, 13},
    {"flight32", &field_mesh, {SMALL_BODIES}, &head_start, fly, 31, 13},
    {"growth-512", &field512_mesh, {&head_mesh}, &growth_starts[0], NULL, 0, 0},
    {"growth-3034", &field_mesh, {&head_mesh}, &growth_starts[1], NULL, 0, 0},
    {"growth-12012", &field12012_mesh, {&head_mesh}, &growth_starts[2], NULL, 0, 0},
    {"growth-49928", &field49928_mesh, {&head_mesh}, &growth_starts[3], NULL, 0, 0},
    {"sheet", NULL, {&box_mesh}, &box_start, NULL, 0, 0},
    {"user", &field_mesh, {NULL}, &head_start, NULL, 0, 0},
};

static const struct recipe *find(const char *name)
{
    for (size_t i = 0; i < sizeof recipes / sizeof recipes[0]; i++) {
        if (strcmp(name, recipes[i].name) == 0) {
            return &recipes[i];
        }
    }
    return NULL;
}

static struct carom_mesh *mesh_of(struct scene *scene, int number)
{
    return number == 0 ? &scene->body_mesh : &scene->other_mesh[number - 1];
}

/* Build the meshes and hand them to the bodies in turn. */
static int build_bodies(struct scene *scene, const struct recipe *recipe,
                        const struct carom_mesh_raw *user, uint8_t **mem, size_t *bytes)
{
    int count = 0, result = CAROM_OK;

    while (count < SCENE_MESHES && result >= 0 &&
           (user ? count == 0 : recipe->bodies[count] != NULL)) {
        struct carom_mesh_raw raw = user ? scaled(user) : *recipe->bodies[count];

        raw.quantum_bits = recipe->quantum_bits ? recipe->quantum_bits : raw.quantum_bits;
        result = build(mesh_of(scene, count++), &raw, mem, bytes);
    }
    scene->body = *recipe->start;
    scene->body.mesh = &scene->body_mesh;
    scene->other_count = recipe->others;
    for (int i = 0; i < scene->other_count; i++) {
        scene->others[i] = scene->body;
        scene->others[i].mesh = mesh_of(scene, (i + 1) % count);
    }
    return result;
}

int scene_load(struct scene *scene, const char *name, const struct carom_mesh_raw *user, void *mem,
               size_t bytes)
{
    const struct recipe *recipe = find(name);
    uint8_t *next = mem;
    int result;

    if (!recipe || (recipe->bodies[0] == NULL) != (user != NULL)) {
        return CAROM_ERR_ARGUMENT;
    }
    memset(scene, 0, sizeof *scene);
    scene->ground = ground_start;
    scene->ground.mesh = &scene->ground_mesh;
    scene->camera = camera;
    scene->waves = recipe->ground == NULL;
    result = scene->waves ? build_sheet(scene, &next, &bytes)
                          : build(&scene->ground_mesh, recipe->ground, &next, &bytes);
    if (result >= 0) {
        result = build_bodies(scene, recipe, user, &next, &bytes);
    }
    if (recipe->arrange) {
        recipe->arrange(scene);
    }
    scene->caps = scene->waves          ? (struct carom_caps){SCENE_SHEET_CAPS}
                  : recipe->others == 0 ? (struct carom_caps){SCENE_CAPS}
                  : recipe->others < 16 ? (struct carom_caps){SCENE_PILE_CAPS}
                                        : (struct carom_caps){SCENE_LARGE_CAPS};
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

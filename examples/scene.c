/* SPDX-License-Identifier: MIT */
/* The scenes: their meshes, the starts of their bodies, and worlds of them. */
#include "scene.h"

#include <string.h>

#include "scene_games.h"

#define RESTITUTION_Q30 (CAROM_ONE_Q30 / 2)
#define FRICTION_Q16    (1u << 15)

/* The start of the body, in mm, mm/s and mrad/s, and the place of the camera. */
static const struct carom_body_def head_start = {
    .position = POSITION(-1600, 600, 2800),
    .velocity = VELOCITY(900, -400, 0),
    .spin = SPIN(1500, -1800, 1200),
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
};
/* About 3 mm above the fields of 512, 3034, 12012 and 49928 faces. */
#define PUT(z)                                                                                     \
    {                                                                                              \
        .position = POSITION(-600, 200, z), .velocity = VELOCITY(300, -100, 0),                    \
        .friction_q16 = FRICTION_Q16,                                                              \
    }
static const struct carom_body_def growth_starts[] = {PUT(973), PUT(965), PUT(964), PUT(964)};
static const struct carom_body_def far_start = {.position = POSITION(0, 0, 1000000)};
static const struct carom_body_def box_start = {
    .position = POSITION(-900, -300, 2200),
    .velocity = VELOCITY(900, 300, 0),
    .spin = SPIN(2100, 700, -1300),
    .restitution_q30 = RESTITUTION_Q30,
    .friction_q16 = FRICTION_Q16,
};
/* A rough body that hardly bounces. */
static const struct carom_body_def dull_start = {
    .restitution_q30 = 0,
    .friction_q16 = 1u << 16,
};
#if SCENE_GAMES
static const struct carom_body_def still; /* a game adds its own bodies */
#endif
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

/* A head of half the size is seen from nearer. */
static const struct carom_camera near_camera = {
    .eye = POSITION(1250, -5050, 2950),
    .target = POSITION(-800, 150, 1050),
    .focal_q16 = 1 << 16,
};

struct carom_config scene_config(void)
{
    struct carom_config config = {
        .caps = CAROM_CAPS(SCENE_CAPS),
        .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, FPS)}},
        .sleep = true,
    };

    return config;
}

/* Layers of side x side bodies, close together; each layer is turned and shifted against the one below. */
static void pour(int i, int side, int z_mm, int up_mm_s, struct carom_body_def *def)
{
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

static void pile(int i, struct carom_body_def *def)
{
    pour(i, 2, 1900, 0, def);
}

static void wide_pile(int i, struct carom_body_def *def)
{
    pour(i, 3, 1900, 0, def);
}

/* Side by side, the second so high that it lands after the first has come to rest. */
static void in_turn(int i, struct carom_body_def *def)
{
    def->position.c[0] = CAROM_POSITION_MM(-1500 + 1000 * i);
    def->position.c[1] = CAROM_POSITION_MM(200 - 300 * i);
    def->position.c[2] = CAROM_POSITION_MM(1000 + 4000 * i);
    def->velocity.c[0] = CAROM_VELOCITY_MM_S(500 - 400 * i, FPS);
    def->velocity.c[1] = CAROM_VELOCITY_MM_S(100, FPS);
    def->velocity.c[2] = 0;
    def->spin.c[0] = CAROM_SPIN_MRAD_S(1500 - 900 * i, FPS);
    def->spin.c[1] = CAROM_SPIN_MRAD_S(700, FPS);
    def->spin.c[2] = CAROM_SPIN_MRAD_S(400 * i, FPS);
}

/* Side by side and far above each other: each comes to rest before the next one lands. */
static void one_by_one(int i, struct carom_body_def *def)
{
    static const int16_t height_mm[] = {600, 7000, 19000};

    def->position.c[0] = CAROM_POSITION_MM(1500 * (i - 1));
    def->position.c[1] = CAROM_POSITION_MM(i == 1 ? 1600 : -400);
    def->position.c[2] = CAROM_POSITION_MM(height_mm[i]);
    def->velocity = (carom_v3_q40){{0, 0, 0}};
    def->spin.c[0] = CAROM_SPIN_MRAD_S(300, FPS);
    def->spin.c[1] = CAROM_SPIN_MRAD_S(100, FPS);
    def->spin.c[2] = 0;
}

/* Thrown up from just above the field. */
static void fly(int i, struct carom_body_def *def)
{
    pour(i, 6, 1000, 1500, def);
}

/* In two rows on the plane. */
static void lay(int i, struct carom_body_def *def)
{
    def->position.c[0] = CAROM_POSITION_MM(-3000 + 1500 * (i % 5));
    def->position.c[1] = CAROM_POSITION_MM(-1000 + 2000 * (i / 5));
    def->position.c[2] = CAROM_POSITION_MM(252);
    def->spin = (carom_v3_q40){{0, 0, 0}};
    def->velocity = def->spin;
}

/* On top of each other on the plane, each a little to the side of the one below. */
static void stack(int i, struct carom_body_def *def)
{
    lay(0, def);
    def->position.c[0] = CAROM_POSITION_MM(i % 3 * 10);
    def->position.c[1] = CAROM_POSITION_MM(i % 2 * 10);
    def->position.c[2] = CAROM_POSITION_MM(252 + 502 * i);
}

/* The start of a scene's bodies. scene_meshes has their meshes. */
static const struct scene_recipe {
    const char *name, *text;
    const struct carom_body_def *start;
    void (*arrange)(int i, struct carom_body_def *def); /* NULL: one body, at start */
    uint8_t others;                                     /* bodies besides the first */
    /* bounds that keep a frame short on a small board; 0: the engine chooses */
    uint8_t substep_cap, sweep_cap;
    const struct scene_game *game;     /* adds the bodies */
    const struct carom_camera *camera; /* NULL: the game's camera, or the default one */
} recipes[] = {
    {"head", "a head of 1876 faces falls on a height field of 3034", &head_start, NULL, 0, 0, 0,
     NULL, NULL},
    {"head-spin", "the head, thrown and turning fast", &spin_starts[0], NULL, 0, 0, 0, NULL, NULL},
    {"head-spin2", "the head, thrown down and turning about the upright", &spin_starts[1], NULL, 0,
     0, 0, NULL, NULL},
    {"head48", "a head of 48 faces and half the size on a field of 128", &head_start, NULL, 0, 1, 5,
     NULL, &near_camera},
    {"head100", "a head of 100 faces on a field of 128", &head_start, NULL, 0, 3, 10, NULL, NULL},
    {"head450", "a head of 450 faces on a field of 386", &head_start, NULL, 0, 0, 0, NULL, NULL},
    {"head836", "a head of 836 faces on a field of 512", &head_start, NULL, 0, 0, 0, NULL, NULL},
    {"apart", "the head a thousand units above the field", &far_start, NULL, 0, 0, 0, NULL, NULL},
    {"box", "a box falls on a plane", &box_start, NULL, 0, 0, 0, NULL, NULL},
    {"pair", "a tetrahedron and a box fall one after the other", &dull_start, in_turn, 1, 3, 10,
     NULL, NULL},
    {"brick", "the box on the plane, for the smallest boards", &box_start, NULL, 0, 3, 10, NULL,
     NULL},
    {"boxes3", "three boxes fall on a field one after the other", &dull_start, one_by_one, 2, 2, 6,
     NULL, NULL},
    {"boxes10", "ten boxes lie on the plane", &box_start, lay, 9, 0, 0, NULL, NULL},
    {"stack10", "ten boxes stand on each other", &box_start, stack, 9, 0, 0, NULL, NULL},
    {"pile", "16 boxes, tetrahedra and L-shapes are poured on the field", &head_start, pile, 15, 0,
     0, NULL, NULL},
    {"pile32", "32 bodies of 12 to 80 faces are poured on the field", &head_start, wide_pile, 31, 0,
     0, NULL, NULL},
    {"flight32", "the same 32 are thrown up", &head_start, fly, 31, 0, 0, NULL, NULL},
    {"growth-512", "the head put on a field of 512 faces", &growth_starts[0], NULL, 0, 0, 0, NULL,
     NULL},
    {"growth-3034", "the head put on a field of 3034 faces", &growth_starts[1], NULL, 0, 0, 0, NULL,
     NULL},
    {"growth-12012", "the head put on a field of 12012 faces", &growth_starts[2], NULL, 0, 0, 0,
     NULL, NULL},
    {"growth-49928", "the head put on a field of 49928 faces", &growth_starts[3], NULL, 0, 0, 0,
     NULL, NULL},
    {"sheet", "a box rides on a sheet of 800 faces that waves", &box_start, NULL, 0, 0, 0, NULL,
     NULL},
    {"user", "a mesh of your own falls on the field", &head_start, NULL, 0, 0, 0, NULL, NULL},
#if SCENE_GAMES
    {"door", "a ball opens a door on a hinge with limits", &still, NULL, 3, 0, 0, &scene_door,
     NULL},
    {"chain", "20 links on ball joints swing", &still, NULL, 19, 0, 0, &scene_chain, NULL},
    {"crusher", "a block comes down on a box, and stops there", &still, NULL, 2, 0, 0,
     &scene_crusher, NULL},
    {"conveyor", "boxes ride a belt whose surface moves", &still, NULL, 4, 0, 0, &scene_conveyor,
     NULL},
    {"car", "a car of hinges, springs and motors in a yard with ramps", &still, NULL,
     CAR_PICKUP + CAR_PICKUPS - 2, 0, 0, &scene_car, NULL},
    {"walker", "someone walks, jumps, pushes and goes through a door", &still, NULL,
     WALKER_CRATE - 1, 0, 0, &scene_walker, NULL},
    {"gears", "four toothed wheels, of which a motor turns the first", &still, NULL, GEARS - 1 + 1,
     0, 0, &scene_gears, NULL},
    {"screw", "a nut turns down a bolt by its weight, and is wound up again", &still, NULL, 2, 0, 0,
     &scene_screw, NULL},
    {"newton", "Newton's cradle: what swings in on one side swings out on the other", &still, NULL,
     NEWTON_BALLS + 5, 0, 0, &scene_newton, NULL},
    {"dominoes", "a ball brings down a row of dominoes", &still, NULL, DOMINOES, 0, 10,
     &scene_dominoes, NULL},
    {"cards", "a house of cards stands, until a ball comes", &still, NULL, CARDS, 0, 0,
     &scene_cards, NULL},
    {"arch", "an arch of stones stands without mortar, until a ball comes", &still, NULL,
     ARCH_STONES + 2, 0, 0, &scene_arch, NULL},
    {"bowl", "cups and balls fall into a bowl", &still, NULL, BOWL_PIECES, 0, 0, &scene_bowl, NULL},
    {"pour", "a bucket of 32 rings, stars, hooks and beakers is poured into a tray", &still, NULL,
     POUR_THINGS + 1, 0, 12, &scene_pour, NULL},
    {"espresso", "an espresso machine of 836 faces falls on a Mandelbrot field of 512", &still,
     NULL, 0, 0, 0, &scene_espresso, NULL},
    {"espresso-fine", "the espresso machine on a Mandelbrot field of 3200 faces", &still, NULL, 0,
     0, 0, &scene_espresso_fine, NULL},
#ifndef SCENE_ROM /* there is no memory for three worlds */
    {"lockstep", "two machines play one game over a link that loses, delays and reorders", &still,
     NULL, LOCKSTEP_BODIES - 2, 0, 0, &scene_lockstep, NULL},
#endif
#endif
};

static const struct scene_recipe *find(const char *name)
{
    for (size_t i = 0; i < sizeof recipes / sizeof recipes[0]; i++) {
        if (strcmp(name, recipes[i].name) == 0) {
            return &recipes[i];
        }
    }
    return NULL;
}

const char *scene_name(int n)
{
    return n >= 0 && n < (int)(sizeof recipes / sizeof recipes[0]) ? recipes[n].name : NULL;
}

const char *scene_text(int n)
{
    return scene_name(n) ? recipes[n].text : NULL;
}

void scene_body(const struct scene *scene, int i, struct carom_body_def *def)
{
    *def = scene->body;
    if (i > 0) {
        def->mesh = scene->mesh[i % scene->mesh_count];
        scene->recipe->arrange(i, def);
    }
}

/* Capacities that suffice for any scene of a kind. */
static struct carom_caps caps_of(const struct scene *scene)
{
    return scene->game               ? scene->game->caps
           : scene->sheet            ? (struct carom_caps)CAROM_CAPS(SCENE_SHEET_CAPS)
           : scene->other_count == 0 ? (struct carom_caps)CAROM_CAPS(SCENE_CAPS)
           : scene->other_count < 16 ? (struct carom_caps)CAROM_CAPS(SCENE_PILE_CAPS)
                                     : (struct carom_caps)CAROM_CAPS(SCENE_LARGE_CAPS);
}

int scene_load(struct scene *scene, const char *name, const struct carom_mesh_raw *user, void *mem,
               size_t bytes)
{
    const struct scene_recipe *recipe = find(name);
    int result;

    if (!recipe) {
        return CAROM_ERR_ARGUMENT;
    }
    memset(scene, 0, sizeof *scene);
    scene->recipe = recipe;
    scene->ground = ground_start;
    scene->body = *recipe->start;
    scene->other_count = recipe->others;
    scene->game = recipe->game;
    scene->camera = recipe->camera ? recipe->camera
                    : recipe->game ? &recipe->game->camera
                                   : &camera;
    result = scene_meshes(scene, name, user, mem, bytes);
    if (result >= 0) {
        scene->body.mesh = scene->mesh[0];
        scene->caps = caps_of(scene);
    }
    if (recipe->arrange) {
        recipe->arrange(0, &scene->body);
    }
    return result;
}

int scene_make(const struct scene *scene, const struct carom_config *config, void *block,
               size_t bytes, struct carom_world **world)
{
    struct carom_config own = *config;
    int result;

    if (scene->other_count > 0 || scene->sheet || scene->game) {
        own.caps = scene->caps;
    }
    if (scene->recipe) {
        own.substep_cap = own.substep_cap ? own.substep_cap : scene->recipe->substep_cap;
        own.sweep_cap = own.sweep_cap ? own.sweep_cap : scene->recipe->sweep_cap;
    }
    result = carom_world_init(block, bytes, &own, world);
    if (result >= 0) {
        result = carom_body_add(*world, &scene->ground);
    }
    if (scene->game && result >= 0) {
        result = scene->game->fill(scene, *world);
    }
    for (int i = 0; i <= scene->other_count && result >= 0 && !scene->game; i++) {
        struct carom_body_def def;

        scene_body(scene, i, &def);
        result = carom_body_add(*world, &def);
    }
    return result < 0 ? result : CAROM_OK;
}

int scene_before(struct scene *scene, struct carom_world *world, int frame)
{
    return SCENE_GAMES && scene->game ? scene_game_before(scene->game, world, frame, SCENE_NOBODY)
                                      : scene_sheet_move(scene->sheet, world, frame);
}

int scene_sheet_move(struct scene_sheet *sheet, struct carom_world *world, int frame)
{
    if (!sheet) {
        return CAROM_OK;
    }
    scene_sheet_shape(sheet->vertices, frame);
    return carom_surface_move(world, SCENE_GROUND, (const int16_t(*)[3])sheet->vertices);
}

/* SPDX-License-Identifier: MIT */
/*
 * Scenes that go on for thousands of frames. The acts of each frame follow from its number and from
 * the state.
 */
#include "plays.h"

#include "carom_query.h"
#include "scene_games.h"

uint64_t play_fold(uint64_t digest, uint64_t number)
{
    for (int i = 0; i < 8; i++) {
        digest = (digest ^ (number >> (8 * i) & 0xff)) * 0x100000001b3u;
    }
    return digest;
}

uint64_t play_fold_step(const struct carom_world *world, int status, uint64_t digest)
{
    const struct carom_event *events;
    int count = carom_events(world, &events);

    digest = play_fold(digest, carom_world_hash(world));
    digest = play_fold(digest, (uint64_t)status);
    for (int i = 0; i < count; i++) {
        digest = play_fold(digest, (uint64_t)events[i].kind << 32 | (uint64_t)events[i].a << 16 |
                                       events[i].b);
        digest = play_fold(digest, (uint64_t)events[i].speed_q40);
        digest = play_fold(digest, (uint64_t)events[i].impulse_q40);
    }
    return digest;
}

/* ---------------------------------------------------------------- before a frame */

/* A number in [-range, range] that differs for each frame, body and axis. */
static int64_t chance(int frame, int body, int axis, int64_t range)
{
    uint32_t x = (uint32_t)frame * 2654435761u + (uint32_t)body * 40503u + (uint32_t)axis * 977u;

    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (int64_t)(x & 0xffff) * range / 0x8000 - range;
}

/*
 * Throw the bodies up and back to the middle of the ground, each by an impulse beside its centre.
 * Their mass is 1, so an impulse is a velocity: 1/64 unit a frame for each unit of distance from
 * the middle.
 */
static int throw_all(struct carom_world *world, int bodies, int frame)
{
    int result = CAROM_OK;

    for (int body = SCENE_BODY; body <= bodies && result >= 0; body++) {
        struct carom_body_state state;
        carom_v3_q40 impulse = {{0, 0, CAROM_VELOCITY_MM_S(2600, FPS)}};
        carom_v3_q32 point;

        result = carom_body_get(world, body, &state);
        for (int k = 0; k < 3; k++) {
            impulse.c[k] += chance(frame, body, k, CAROM_VELOCITY_MM_S(500, FPS));
            impulse.c[k] -= k < 2 ? state.position.c[k] * 4 : 0;
            point.c[k] = state.position.c[k] + chance(frame, body, k + 3, CAROM_POSITION_MM(60));
        }
        if (result >= 0 && !state.out) {
            result = carom_body_push(world, body, &impulse, &point);
        }
    }
    return result;
}

static int throw_often(struct carom_world *world, int bodies, int frame)
{
    return frame % 125 == 100 ? throw_all(world, bodies, frame) : CAROM_OK;
}

static int throw_sometimes(struct carom_world *world, int bodies, int frame)
{
    return frame % 250 == 200 ? throw_all(world, bodies, frame) : CAROM_OK;
}

/*
 * Lift one body after the other straight up, so that some sleep while others move, and none meet.
 */
static int lift_one(struct carom_world *world, int bodies, int frame)
{
    const carom_v3_q40 impulse = {{0, 0, CAROM_VELOCITY_MM_S(1500, FPS)}};
    int body = SCENE_BODY + frame / 100 % bodies;
    struct carom_body_state state;
    int result = CAROM_OK;

    if (frame % 100 == 60) {
        result = carom_body_get(world, body, &state);
        if (result >= 0) {
            result = carom_body_push(world, body, &impulse, &state.position);
        }
    }
    return result;
}

/* Gravity leans by 18 degrees along each axis, away from the side of the first body. */
static int lean(struct carom_world *world, int bodies, int frame)
{
    const int64_t across = CAROM_GRAVITY_MM_S2(3030, FPS);
    struct carom_body_state state;
    carom_v3_q40 gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9330, FPS)}};
    int result = CAROM_OK;

    (void)bodies;
    if (frame % 20 == 0) {
        result = carom_body_get(world, SCENE_BODY, &state);
        for (int k = 0; k < 2; k++) {
            gravity.c[k] = state.position.c[k] < 0 ? across : -across;
        }
        if (result >= 0) {
            result = carom_world_set_gravity(world, &gravity);
        }
    }
    return result;
}

/* Height at which bodies without gravity meet: far above the ground. */
#define MEET_MM 500000

static int take_up(struct carom_world *world, int bodies)
{
    int result = CAROM_OK;

    for (int body = SCENE_BODY; body <= bodies && result >= 0; body++) {
        struct carom_body_state state;

        result = carom_body_get(world, body, &state);
        state.position.c[2] += CAROM_POSITION_MM(MEET_MM);
        state.spin.c[1] += CAROM_SPIN_MRAD_S(900, FPS) * body;
        if (result >= 0) {
            result = carom_body_set(world, body, &state);
        }
    }
    return result;
}

/*
 * A force of 7 units / s^2 a unit draws each body to the middle; from time to time all are thrown.
 */
static int draw_together(struct carom_world *world, int bodies, int frame)
{
    const carom_v3_q40 none = {{0, 0, 0}};
    int result = frame == 1 ? take_up(world, bodies) : CAROM_OK;

    if (result >= 0) {
        result = carom_world_set_gravity(world, &none);
    }
    for (int body = SCENE_BODY; body <= bodies && result >= 0; body++) {
        struct carom_body_state state;
        carom_v3_q40 force;

        result = carom_body_get(world, body, &state);
        for (int k = 0; k < 3; k++) {
            force.c[k] = ((k == 2 ? CAROM_POSITION_MM(MEET_MM) : 0) - state.position.c[k]) / 2;
        }
        if (result >= 0) {
            result = carom_body_set_force(world, body, &force);
        }
    }
    return result >= 0 && frame % 200 == 0 ? throw_all(world, bodies, frame) : result;
}

/* ----------------------------------------------------------------- after a frame */

/* Ask which faces of two bodies interfere, and whether one body is inside the other. */
static int ask_pair(struct carom_world *world, int a, int b, uint64_t *digest)
{
    static struct carom_face_pair found[48];
    int count = carom_query_faces(world, a, b, found, 48);
    int inside = carom_query_inside(world, a, b);

    for (int i = 0; i < count; i++) {
        *digest = play_fold(*digest, (uint64_t)found[i].a << 16 | found[i].b);
    }
    *digest = play_fold(*digest, (uint64_t)(int64_t)inside);
    return count < 0 ? count : inside;
}

static int ask_pairs(struct carom_world *world, const struct scene *scene, int frame,
                     uint64_t *digest)
{
    int result = CAROM_OK;

    for (int a = SCENE_BODY; frame % 20 == 0 && a <= 1 + scene->other_count; a++) {
        for (int b = SCENE_GROUND; b < a && result >= 0; b++) {
            result = ask_pair(world, a, b, digest);
        }
    }
    return result;
}

#if SCENE_GAMES /* a board without the games has neither the scenes nor the memory */
static bool is_not(void *context, int body)
{
    return body != *(const int *)context;
}

/*
 * Ask for the first hit of a slanting ray down on a body, and for the number of faces that it
 * passes.
 */
static int ask_ray(const struct carom_world *world, const carom_v3_q32 *at, uint64_t *digest)
{
    const struct carom_ray ray = {
        .from = {{at->c[0] + CAROM_POSITION_MM(700), at->c[1] - CAROM_POSITION_MM(300),
                  at->c[2] + CAROM_POSITION_MM(4000)}},
        .way = POSITION(-1400, 600, -8000)};
    struct carom_ray_hit hit;
    int met = carom_cast_ray(world, &ray, NULL, &hit);
    int all = carom_cast_ray_all(world, &ray, NULL, NULL, 0);

    if (met == 1) {
        *digest = play_fold(*digest, (uint64_t)hit.body << 16 | hit.face);
        *digest = play_fold(*digest, (uint64_t)hit.t_q30 << 32 | hit.t_rest);
        *digest = play_fold(*digest, (uint64_t)hit.point.c[2]);
        *digest = play_fold(*digest, (uint64_t)(int64_t)hit.normal.c[2]);
    }
    *digest = play_fold(*digest, (uint64_t)(int64_t)all);
    return met < 0 ? met : CAROM_OK;
}

static struct carom_cast_workspace workspace;

/* Sweep a body's mesh down while it turns, and ask for the hit and for overlaps at the start. */
static int ask_way(struct carom_world *world, int body, const struct carom_body_state *state,
                   uint64_t *digest)
{
    const struct carom_query_filter others = {.wants = is_not, .context = &body};
    const struct carom_mesh_way go = {.way = POSITION(90, -70, -900),
                                      .turn = {{0, CAROM_ANGLE_MRAD(60), CAROM_ANGLE_MRAD(90)}}};
    struct carom_query_mesh mesh = {carom_body_mesh(world, body), state->position, state->rotation};
    struct carom_mesh_hit hit;
    uint16_t bodies[2];
    int met = carom_cast_mesh(world, &mesh, &go, &others, &workspace, &hit);

    if (met == 1) {
        *digest =
            play_fold(*digest, (uint64_t)hit.body << 32 | (uint64_t)hit.face << 16 | hit.own_face);
        *digest = play_fold(*digest, (uint64_t)(int64_t)hit.t_q30);
        *digest = play_fold(*digest, (uint64_t)hit.point.c[0]);
        *digest = play_fold(*digest, (uint64_t)(int64_t)hit.normal.c[2]);
    }
    mesh.position.c[2] -= CAROM_POSITION_MM(200);
    *digest =
        play_fold(*digest, (uint64_t)(int64_t)carom_overlap_mesh(world, &mesh, &others, bodies, 2));
    return met < 0 && met != CAROM_ERR_OVERLAP ? met : CAROM_OK;
}

/* The points of two bodies that are closest to each other. */
static int ask_closest(struct carom_world *world, int a, int b, uint64_t *digest)
{
    struct carom_closest closest;
    int result = carom_closest_points(world, a, b, &closest);

    if (result == CAROM_OK) {
        *digest = play_fold(*digest, (uint64_t)closest.distance_q32);
        *digest = play_fold(*digest, (uint64_t)closest.face[0] << 16 | closest.face[1]);
    }
    return result < 0 && result != CAROM_ERR_OVERLAP ? result : CAROM_OK;
}

/*
 * Ask about one body after the other, from time to time; a body that was picked up is not there any
 * more.
 */
static int ask_queries(struct carom_world *world, const struct scene *scene, int frame,
                       uint64_t *digest)
{
    const int body = SCENE_BODY + frame / 20 % (1 + scene->other_count);
    struct carom_body_state state;
    int result;

    if (frame % 20 != 0 || carom_body_get(world, body, &state) < 0 || state.out) {
        return CAROM_OK;
    }
    result = ask_ray(world, &state.position, digest);
    result = result < 0 ? result : ask_way(world, body, &state, digest);
    if (result >= 0 && frame % 100 == 0) {
        result = ask_closest(world, body, body == SCENE_BODY ? SCENE_GROUND : SCENE_BODY, digest);
    }
    return result;
}

enum { WIDTH = 80, HEIGHT = 60 };

static uint64_t fold_picture(const struct carom_picture *picture, uint64_t digest)
{
    const uint8_t *bytes = picture->pixels;
    const uint16_t *halves = picture->pixels;
    const uint32_t *words = picture->pixels;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        digest = play_fold(digest, picture->format == CAROM_PALETTE8 ? bytes[i]
                                   : picture->format == CAROM_RGB565 ? halves[i]
                                                                     : words[i]);
    }
    return digest;
}

/* Draw small pictures, in every format and style in turn. */
static int ask_picture(struct carom_world *world, const struct scene *scene, int frame,
                       uint64_t *digest)
{
    /* m68k would place it at any even address */
    static _Alignas(4) uint32_t pixels[WIDTH * HEIGHT];
    static _Alignas(8) uint8_t workspace[CAROM_DRAW_BYTES_LEAST(
        SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES, SCENE_HEAD_FACES + SCENE_FIELD_FACES)];
    const int number = frame / 25;
    struct carom_picture picture = {.pixels = pixels,
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .stride = WIDTH << number % 3,
                                    .format = (uint8_t)(number % 3),
                                    .workspace = workspace,
                                    .workspace_bytes = sizeof workspace};
    int result;

    if (frame % 25 != 0) {
        return CAROM_OK;
    }
    result =
        carom_draw(world, scene->camera, &picture, number % 2 ? CAROM_DRAW_FLAT : CAROM_DRAW_WIRE);
    if (result >= 0) {
        *digest = fold_picture(&picture, *digest);
    }
    return result;
}

/* Throw the ball at the door again from time to time, from either side. */
static int throw_ball(struct carom_world *world, int bodies, int frame)
{
    const int64_t side = frame % 600 == 0 ? -1 : 1;
    struct carom_body_state state = {.position = POSITION(650, -2000, 1300),
                                     .velocity = VELOCITY(0, 5000, 1000)};

    (void)bodies;
    state.position.c[1] *= side;
    state.velocity.c[1] *= side;
    return frame % 300 == 0 ? carom_body_set(world, DOOR_BALL, &state) : CAROM_OK;
}

/* A game follows its script for a while, then gets no keys until it is at rest. */
static int play_car(struct carom_world *world, int bodies, int frame)
{
    (void)bodies;
    return scene_game_before(&scene_car, world, frame, frame % 1000 < 160 ? SCENE_NOBODY : 0);
}

static int play_walker(struct carom_world *world, int bodies, int frame)
{
    (void)bodies;
    return scene_game_before(&scene_walker, world, frame, SCENE_NOBODY);
}
#define DRAWN "box"
#else
#define ask_queries NULL
#define ask_picture NULL
#define throw_ball  NULL
#define play_car    NULL
#define play_walker NULL
#define DRAWN       "none" /* no scene */
#endif

/* ------------------------------------------------------------------- arrangements */

static void set_surface(struct scene *scene, int32_t e_q30, uint32_t mu_q16)
{
    scene->ground.restitution_q30 = scene->body.restitution_q30 = e_q30;
    scene->ground.friction_q16 = scene->body.friction_q16 = mu_q16;
}

/* Without losses: a box that bounces for ever. */
static void bounce(struct scene *scene)
{
    set_surface(scene, CAROM_ONE_Q30, 0);
    for (int k = 0; k < 2; k++) {
        scene->body.position.c[k] = scene->body.velocity.c[k] = 0;
    }
}

/* Without friction, flat on the plane. */
static void slide(struct scene *scene)
{
    set_surface(scene, CAROM_ONE_Q30 / 4, 1 << 14);
    scene->body.position = (carom_v3_q32){{0, 0, CAROM_POSITION_MM(260)}};
    scene->body.velocity = scene->body.spin = (carom_v3_q40){{0, 0, 0}};
}

const struct play plays[PLAYS] = {
    {"box", "box", 0, NULL, throw_often, NULL},
    {"bounce", "brick", 0, bounce, NULL, NULL},
    {"slide", "brick", 0, slide, lean, NULL},
    {"pictures", DRAWN, 0, NULL, throw_often, ask_picture},
    {"pair", "pair", 0, NULL, throw_often, ask_pairs},
    {"meet", "pair", 0, NULL, draw_together, ask_pairs},
    {"boxes3", "boxes3", 0, NULL, lift_one, NULL},
    {"pile", "pile", 6, NULL, throw_sometimes, ask_pairs},
    {"sheet", "sheet", 0, NULL, NULL, NULL},
    {"head100", "head100", 0, NULL, throw_often, NULL},
    {"head450", "head450", 0, NULL, throw_sometimes, NULL},
    {"head", "head", 0, NULL, throw_sometimes, NULL},
    {"door", "door", 2, NULL, throw_ball, ask_queries},
    {"car", "car", 0, NULL, play_car, ask_queries},
    {"walker", "walker", 0, NULL, play_walker, ask_queries},
};

/* SPDX-License-Identifier: MIT */
/*
 * Someone walks: a kinematic body whose way is asked for before each frame by three sweeps of its mesh. Up
 * by a step's height, on along what it meets, and down onto what is there; what it stands on takes it along.
 */
#include "carom_body.h"
#include "carom_query.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 15)

enum { MESH_WALKER, MESH_STEPS, MESH_RAMP, MESH_DOOR, MESH_BOX };

#define WALK_MM_S 1500
#define STEP_MM   200 /* higher than a step of the stairs */
#define SLIDES    3   /* changes of direction in a frame */

/* The platform goes between the stairs and the ramp, and waits at both. */
#define PLATFORM_FROM_MM (-2200)
#define PLATFORM_WAY_MM  3700
#define PLATFORM_START   150 /* frames */
#define PLATFORM_FRAMES  150
/* The door opens by a quarter of a turn. */
#define DOOR_AT_MM   5000
#define DOOR_START   330
#define DOOR_FRAMES  60
#define DOOR_HALF_MM 450

/* ---------------------------------------------------------------- platform, door */

static int lead_platform(struct carom_world *world, int frame)
{
    struct carom_body_state state;
    int result;

    if (frame != PLATFORM_START && frame != PLATFORM_START + PLATFORM_FRAMES) {
        return CAROM_OK;
    }
    result = carom_body_get(world, WALKER_PLATFORM, &state);
    state.velocity.c[0] =
        frame == PLATFORM_START ? CAROM_RATIO(PLATFORM_WAY_MM, 1000, 40) / PLATFORM_FRAMES : 0;
    return result < 0 ? result : carom_body_set(world, WALKER_PLATFORM, &state);
}

/* Shut it stands across the way, from its hinge at y = -DOOR_HALF_MM to the other side. */
static const struct carom_body_def door_def = {
    .kinematic = true,
    .position = POSITION(DOOR_AT_MM, -DOOR_HALF_MM, 10),
    .rotation = {{759250125, 0, 0, 759250125}},
    .friction_q16 = FRICTION_Q16,
};

/* Turn it about its hinge by a part of a quarter, from where it is: then it is led to where it belongs. */
static int lead_door(struct carom_world *world, int frame)
{
    /* cosine and sine of half of a turn of 90 degrees / DOOR_FRAMES */
    const int64_t cosine_q30 = 1073649836, sine_q30 = 14054848;
    struct carom_pose pose = {.position = door_def.position};
    struct carom_body_state state;
    int64_t c, s, reach_q22;
    int result = carom_body_get(world, WALKER_DOOR, &state);

    if (result < 0 || frame < DOOR_START || frame >= DOOR_START + DOOR_FRAMES) {
        return result;
    }
    c = (state.rotation.c[0] * cosine_q30 - state.rotation.c[3] * sine_q30) / CAROM_ONE_Q30;
    s = (state.rotation.c[3] * cosine_q30 + state.rotation.c[0] * sine_q30) / CAROM_ONE_Q30;
    pose.rotation.c[0] = (int32_t)c;
    pose.rotation.c[3] = (int32_t)s;
    reach_q22 = carom_body_mesh(world, WALKER_DOOR)->mass.centre.c[0];
    pose.position.c[0] += (c * c - s * s) / CAROM_ONE_Q30 * reach_q22 / (1 << 20);
    pose.position.c[1] += 2 * c * s / CAROM_ONE_Q30 * reach_q22 / (1 << 20);
    pose.position.c[2] = state.position.c[2];
    return carom_body_move_to(world, WALKER_DOOR, &pose);
}

/* ------------------------------------------------------------------------- walk */

/* Everything but the walker. */
static bool is_other(void *context, int body)
{
    (void)context;
    return body != WALKER;
}

struct walk {
    struct carom_world *world;
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit; /* of the last sweep that met something */
};

/* Go along a way until something is met. Returns whether something was, or an error. */
static int sweep(struct walk *walk, const carom_v3_q32 *way)
{
    static const struct carom_query_filter others = {.wants = is_other};
    const struct carom_mesh_way go = {.way = *way};
    int met = carom_cast_mesh(walk->world, &walk->mesh, &go, &others, &walk->hit);

    for (int k = 0; k < 3 && met == 0; k++) {
        walk->mesh.position.c[k] += way->c[k];
    }
    if (met == 1) {
        walk->mesh.position = walk->hit.position;
    }
    return met;
}

/* Go along a way, and along what is met in the plane of it. Returns >= 0 or an error. */
static int slide(struct walk *walk, carom_v3_q32 way)
{
    int met = 1;

    for (int i = 0; i < SLIDES && met == 1; i++) {
        met = sweep(walk, &way);
        if (met == 1) {
            int64_t left_q30 = CAROM_ONE_Q30 - walk->hit.t_q30, into = 0;

            for (int k = 0; k < 3; k++) {
                way.c[k] = (way.c[k] >> 10) * left_q30 / (1 << 20);
                into += (way.c[k] >> 8) * walk->hit.normal.c[k] / (1 << 22);
            }
            for (int k = 0; k < 3 && into < 0; k++) {
                way.c[k] -= (into >> 8) * walk->hit.normal.c[k] / (1 << 22);
            }
            if (way.c[0] / 4096 == 0 && way.c[1] / 4096 == 0) {
                return 0;
            }
        }
    }
    return met;
}

/* What is below the feet takes along: its velocity there. None in the air. */
static int carried(struct walk *walk, carom_v3_q32 *way, int *ground)
{
    static const struct carom_query_filter others = {.wants = is_other};
    const struct carom_mesh_way down = {.way = POSITION(0, 0, -20)};
    carom_v3_q40 velocity;
    int met = carom_cast_mesh(walk->world, &walk->mesh, &down, &others, &walk->hit);

    *ground = -1;
    if (met != 1) {
        return met;
    }
    *ground = walk->hit.body;
    met = carom_body_velocity_at(walk->world, *ground, &walk->hit.point, &velocity);
    for (int k = 0; k < 2 && met >= 0; k++) {
        way->c[k] += velocity.c[k] >> 8;
    }
    return met;
}

/* Walk on, but not while the platform does the way. */
static int walk_on(struct carom_world *world, int frame)
{
    const carom_v3_q32 up = POSITION(0, 0, STEP_MM), down = POSITION(0, 0, -STEP_MM - 60);
    struct walk walk = {.world = world, .mesh = {.mesh = carom_body_mesh(world, WALKER)}};
    struct carom_pose pose = {{{0, 0, 0}}, {{0, 0, 0, 0}}};
    struct carom_body_state state;
    carom_v3_q32 way = {{0, 0, 0}};
    int ground, result = carom_body_get(world, WALKER, &state);

    if (result >= 0) {
        walk.mesh.position = state.position;
        result = carried(&walk, &way, &ground);
    }
    if (result >= 0 && (ground != WALKER_PLATFORM || frame > PLATFORM_START + PLATFORM_FRAMES + 1 ||
                        state.position.c[0] < CAROM_POSITION_MM(PLATFORM_FROM_MM))) {
        way.c[0] += CAROM_VELOCITY_MM_S(WALK_MM_S, FPS) >> 8;
    }
    result = result >= 0 ? sweep(&walk, &up) : result;
    result = result >= 0 ? slide(&walk, way) : result;
    result = result >= 0 ? sweep(&walk, &down) : result;
    pose.position = walk.mesh.position;
    return result >= 0 ? carom_body_move_to(world, WALKER, &pose) : result;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    int result = lead_platform(world, frame);

    (void)keys;
    result = result >= 0 ? lead_door(world, frame) : result;
    return result >= 0 ? walk_on(world, frame) : result;
}

static void look(const struct carom_world *world, struct carom_camera *camera)
{
    struct carom_body_state state;

    if (carom_body_get(world, WALKER, &state) >= 0) {
        camera->target.c[0] = state.position.c[0];
        camera->eye.c[0] = state.position.c[0] - CAROM_POSITION_M(2);
    }
}

/* ------------------------------------------------------------------------- parts */

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def walker = {
        .kinematic = true, .position = POSITION(-5500, 0, 880), .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def steps = {
        .stationary = true, .position = POSITION(-4000, 0, 0), .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def platform = {.kinematic = true,
                                                   .position = POSITION(PLATFORM_FROM_MM, 0, 300),
                                                   .friction_q16 = FRICTION_Q16};
    /* it leads down: half a turn */
    static const struct carom_body_def ramp = {.stationary = true,
                                               .position = POSITION(4050, 0, 0),
                                               .rotation = {{0, 0, 0, CAROM_ONE_Q30}},
                                               .friction_q16 = FRICTION_Q16};
    struct carom_body_def door = door_def;
    struct carom_body_def crate = {.position = POSITION(2600, 1800, 260),
                                   .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, MESH_WALKER, &walker);
    scene_part(&parts, MESH_STEPS, &steps);
    scene_part(&parts, MESH_BOX, &platform);
    scene_part(&parts, MESH_RAMP, &ramp);
    scene_part(&parts, MESH_DOOR, &door);
    scene_part(&parts, MESH_BOX, &crate);
    return parts.result;
}

const struct scene_game scene_walker = {
    .caps = CAROM_CAPS(8, 32, 64, 256, 0, 1024, 0, 4),
    .camera = {POSITION(-7500, -6000, 3200), POSITION(-5500, 0, 900), 1 << 16},
    .fill = fill,
    .before = before,
    .look = look,
};

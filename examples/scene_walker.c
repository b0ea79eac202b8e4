/* SPDX-License-Identifier: MIT */
/*
 * Scene walker: someone walks. The walker is a kinematic body; before each frame, sweeps of its
 * mesh find its way.
 *
 * A walker that stands goes up by the height of a step, then forwards along the faces that it
 * meets, then down onto the ground there, and moves with that ground. A walker that does not stand
 * falls. It pushes free bodies. It remembers nothing but the velocity of the body. The scene has
 * steps, a platform that goes to and fro, a ramp, a mat that opens a door, a block to jump over and
 * a crate.
 */
#include "carom_body.h"
#include "carom_query.h"
#include "port.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 15)
#define CATEGORY_MAT 2
#define ROOT_HALF    759250125 /* root of 1/2, q30 */

enum { MESH_WALKER, MESH_STEPS, MESH_RAMP, MESH_DOOR, MESH_BOX, MESH_MAT };

#define WALK_MM_S  1500
#define BACK_MM_S  (-800)
#define JUMP_MM_S  3600
#define TURN_DEG_S 120
#define TURN_Q30   18742189 /* tangent of half the turn of a frame */
#define STEP_MM    200      /* higher than a step of the stairs */
#define FEEL_MM    20       /* ground at most this far below the feet carries the walker */
#define STEEP_Q30  (CAROM_ONE_Q30 / 5 * 4) /* cosine: nobody stands where the normal is steeper */
#define PUSH_MN_S  150
#define SLIDES     4 /* changes of direction in a frame */

/* The platform goes between the stairs and the ramp, and waits at both. */
#define PLATFORM_LEFT_MM  (-2200)
#define PLATFORM_RIGHT_MM 1500
#define PLATFORM_MM_S     1500
#define PLATFORM_FRAMES   600
#define PLATFORM_LEAVES   240 /* frames of a round in which it is at the stairs; then at the ramp */
#define PLATFORM_RETURNS  450
/* The door opens by a quarter of a turn. */
#define DOOR_AT_MM   5000
#define DOOR_UP_MM   40
#define DOOR_HALF_MM 450
#define BLOCK_Y_MM   (-3500)

static bool is_walker(void *context, int body)
{
    (void)context;
    return body == WALKER;
}

static bool is_other(void *context, int body)
{
    (void)context;
    return body != WALKER;
}

static struct carom_cast_workspace workspace;
static const struct carom_query_filter only_walker = {.wants = is_walker};
static const struct carom_query_filter others = {.wants = is_other};

/* The mesh of a body, where the body is. */
static struct carom_query_mesh mesh_of(const struct carom_world *world, int body,
                                       const struct carom_body_state *state)
{
    return (struct carom_query_mesh){carom_body_mesh(world, body), state->position,
                                     state->rotation};
}

/* ---------------------------------------------------------------- platform, door */

/*
 * Lead the platform to the end where it belongs at this time, unless the walker is in the way.
 * Returns >= 0 or an error.
 */
static int lead_platform(struct carom_world *world, int frame)
{
    const int time = frame % PLATFORM_FRAMES;
    const int64_t end_q32 = time >= PLATFORM_LEAVES && time < PLATFORM_RETURNS
                                ? CAROM_POSITION_MM(PLATFORM_RIGHT_MM)
                                : CAROM_POSITION_MM(PLATFORM_LEFT_MM);
    const int64_t most_q32 = CAROM_VELOCITY_MM_S(PLATFORM_MM_S, FPS) >> 8;
    struct carom_mesh_way go = {.way = {{0, 0, 0}}};
    struct carom_body_state state;
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    int64_t *way_q32 = &go.way.c[0];
    int result = carom_body_get(world, WALKER_PLATFORM, &state);

    if (result < 0) {
        return result;
    }
    *way_q32 = end_q32 - state.position.c[0];
    *way_q32 = *way_q32 > most_q32 ? most_q32 : *way_q32 < -most_q32 ? -most_q32 : *way_q32;
    mesh = mesh_of(world, WALKER_PLATFORM, &state);
    if (*way_q32 / 4096 != 0 &&
        carom_cast_mesh(world, &mesh, &go, &only_walker, &workspace, &hit) != 0) {
        *way_q32 = 0;
    }
    state.velocity.c[0] = *way_q32 * 256;
    return carom_body_set(world, WALKER_PLATFORM, &state);
}

/* A shut door stands across the way, from its hinge at y = -DOOR_HALF_MM to the other side. */
static const carom_v3_q32 door_position = POSITION(DOOR_AT_MM, -DOOR_HALF_MM, DOOR_UP_MM);

/* Check whether the walker stands on the mat. Returns 1, 0 or an error. */
static int on_the_mat(struct carom_world *world)
{
    static const struct carom_query_filter mats = {.mask = CATEGORY_MAT,
                                                   .flags = CAROM_QUERY_SENSORS};
    struct carom_body_state state;
    struct carom_query_mesh mesh;
    uint16_t found[1];
    int result = carom_body_get(world, WALKER, &state);

    mesh = mesh_of(world, WALKER, &state);
    return result < 0 ? result : carom_overlap_mesh(world, &mesh, &mats, found, 1);
}

/* The door turned by 1.5 degrees, to the right if it opens, but not past open or shut. */
static struct carom_pose door_after(const struct carom_world *world,
                                    const struct carom_body_state *state, bool opens)
{
    const int64_t cosine_q30 = 1073649836, sine_q30 = opens ? -14054848 : 14054848;
    const int64_t reach_q22 = carom_body_mesh(world, WALKER_DOOR)->mass.centre.c[0];
    struct carom_pose pose = {.position = door_position};
    int64_t c = (state->rotation.c[0] * cosine_q30 - state->rotation.c[3] * sine_q30) >> 30;
    int64_t s = (state->rotation.c[3] * cosine_q30 + state->rotation.c[0] * sine_q30) >> 30;

    if (s <= 0 || s >= ROOT_HALF) {
        c = s <= 0 ? CAROM_ONE_Q30 : ROOT_HALF;
        s = s <= 0 ? 0 : ROOT_HALF;
    }
    pose.rotation.c[0] = (int32_t)c;
    pose.rotation.c[3] = (int32_t)s;
    pose.position.c[0] += ((c * c - s * s) >> 30) * reach_q22 / (1 << 20);
    pose.position.c[1] += (2 * c * s >> 30) * reach_q22 / (1 << 20);
    pose.position.c[2] = state->position.c[2];
    return pose;
}

/*
 * The door opens while someone stands on the mat, and shuts afterwards, unless the walker is in its
 * way.
 */
static int lead_door(struct carom_world *world)
{
    const int opens = on_the_mat(world);
    struct carom_mesh_way go = {.turn = {{0, 0, opens > 0 ? -14056052 : 14056052}}};
    struct carom_body_state state;
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    struct carom_pose pose;
    int result = carom_body_get(world, WALKER_DOOR, &state);

    if (opens < 0 || result < 0) {
        return opens < 0 ? opens : result;
    }
    pose = door_after(world, &state, opens > 0);
    if (pose.rotation.c[3] == state.rotation.c[3]) {
        return CAROM_OK;
    }
    for (int k = 0; k < 3; k++) {
        go.way.c[k] = pose.position.c[k] - state.position.c[k];
    }
    mesh = mesh_of(world, WALKER_DOOR, &state);
    if (carom_cast_mesh(world, &mesh, &go, &only_walker, &workspace, &hit) != 0) {
        return CAROM_OK;
    }
    return carom_body_move_to(world, WALKER_DOOR, &pose);
}

/* ------------------------------------------------------------------------- walk */

struct walk {
    struct carom_world *world;
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit; /* the last sweep that hit a body */
};

/* Go along a way up to the first hit. Returns 1 for a hit, 0 for none, or an error. */
static int sweep(struct walk *walk, const carom_v3_q32 *way)
{
    const struct carom_mesh_way go = {.way = *way};
    int met = carom_cast_mesh(walk->world, &walk->mesh, &go, &others, &workspace, &walk->hit);

    for (int k = 0; k < 3 && met == 0; k++) {
        walk->mesh.position.c[k] += way->c[k];
    }
    if (met == 1) {
        walk->mesh.position = walk->hit.position;
    }
    return met;
}

/* Turn the rest of a way along the face that was hit. True if enough of it is left. */
static bool go_along(const struct walk *walk, carom_v3_q32 *way)
{
    const carom_v3_q30 *n = &walk->hit.normal;
    int64_t left_q30 = CAROM_ONE_Q30 - walk->hit.t_q30, into_q32 = 0;
    bool far = false;

    for (int k = 0; k < 3; k++) {
        way->c[k] = (way->c[k] >> 10) * left_q30 / (1 << 20);
        into_q32 += (way->c[k] >> 8) * n->c[k] / (1 << 22);
    }
    for (int k = 0; k < 3; k++) {
        way->c[k] -= into_q32 < 0 ? (into_q32 >> 8) * n->c[k] / (1 << 22) : 0;
        far |= way->c[k] / 4096 != 0;
    }
    return far;
}

/* Push the body that was hit, if it moves freely and is beside the walker, not below or above. */
static int push(const struct walk *walk)
{
    struct carom_body_look look;
    carom_v3_q40 impulse;
    int result = carom_body_look(walk->world, walk->hit.body, &look);

    if (result < 0 || !look.moving || walk->hit.body == WALKER_PLATFORM ||
        walk->hit.body == WALKER_DOOR || walk->hit.normal.c[2] > CAROM_ONE_Q30 / 2) {
        return result;
    }
    for (int k = 0; k < 3; k++) {
        impulse.c[k] = -(CAROM_IMPULSE_MN_S(PUSH_MN_S, FPS) >> 16) * walk->hit.normal.c[k] >> 14;
    }
    impulse.c[2] = 0;
    return carom_body_push(walk->world, walk->hit.body, &impulse, &walk->hit.point);
}

/*
 * Go along a way, sliding along the faces that are hit, within the plane of the way. Returns >= 0
 * or an error.
 */
static int slide(struct walk *walk, carom_v3_q32 way)
{
    int met = 1;

    for (int i = 0; i < SLIDES && met == 1; i++) {
        met = sweep(walk, &way);
        if (met == 1) {
            int result = push(walk);

            if (result < 0 || !go_along(walk, &way)) {
                return result;
            }
        }
    }
    return met;
}

/* True if nobody can stand on the face that was hit. */
static bool is_steep(const struct walk *walk)
{
    return walk->hit.normal.c[2] < STEEP_Q30;
}

/* Check whether the walker stands, and how far the ground moves it. Returns 1, 0 or an error. */
static int stands(struct walk *walk, carom_v3_q32 *way)
{
    const struct carom_mesh_way down = {.way = POSITION(0, 0, -FEEL_MM)};
    carom_v3_q40 velocity;
    int met = carom_cast_mesh(walk->world, &walk->mesh, &down, &others, &workspace, &walk->hit);

    if (met != 1 || is_steep(walk)) {
        return met < 0 ? met : 0;
    }
    met = carom_body_velocity_at(walk->world, walk->hit.body, &walk->hit.point, &velocity);
    for (int k = 0; k < 2 && met >= 0; k++) {
        way->c[k] += velocity.c[k] >> 8;
    }
    return met < 0 ? met : 1;
}

/*
 * Go up by a step as far as there is room, then forwards, then down onto the ground there. If there
 * is no ground to stand on, go straight on, and a fall begins.
 */
static int walk_on(struct walk *walk, carom_v3_q32 way, int64_t fall_q32)
{
    const carom_v3_q32 up = POSITION(0, 0, STEP_MM), from = walk->mesh.position;
    carom_v3_q32 down = POSITION(0, 0, -STEP_MM);
    int result = sweep(walk, &up);

    result = result < 0 ? result : slide(walk, way);
    if (result < 0) {
        return result;
    }
    down.c[2] += from.c[2] - walk->mesh.position.c[2];
    result = sweep(walk, &down);
    if (result == 0 || (result == 1 && is_steep(walk))) {
        walk->mesh.position = from;
        way.c[2] = fall_q32;
        result = slide(walk, way);
    }
    return result;
}

/* Turn on the spot by the turn of a frame, unless a body is in the way. Returns the spin or 0. */
static int64_t turn(struct walk *walk, uint32_t keys)
{
    const int side = !!(keys & PORT_PAD_LEFT) - !!(keys & PORT_PAD_RIGHT);
    const struct carom_mesh_way go = {.turn = {{0, 0, side * TURN_Q30}}};

    if (side == 0 ||
        carom_cast_mesh(walk->world, &walk->mesh, &go, &others, &workspace, &walk->hit) != 0) {
        return 0;
    }
    return side * CAROM_SPIN_DEG_S(TURN_DEG_S, FPS);
}

/* The way of a frame from the keys, along the x axis of the body. */
static int step_of(const struct carom_world *world, uint32_t keys, carom_v3_q32 *way)
{
    const int64_t pace[3] = {(keys & PORT_PAD_UP     ? CAROM_VELOCITY_MM_S(WALK_MM_S, FPS)
                              : keys & PORT_PAD_DOWN ? CAROM_VELOCITY_MM_S(BACK_MM_S, FPS)
                                                     : 0) >>
                                 8,
                             0, 0};

    return carom_body_world_vector(world, WALKER, pace, way->c);
}

/*
 * Set the velocity of the walker for this frame in `state`, which holds its pose at the start.
 * Returns >= 0 or an error.
 */
static int go(struct walk *walk, uint32_t keys, struct carom_body_state *state)
{
    const carom_v3_q32 from = state->position;
    const int64_t gravity_q32 = CAROM_GRAVITY_MM_S2(-9810, FPS) >> 8;
    carom_v3_q32 way;
    int result = step_of(walk->world, keys, &way);
    int standing = result < 0 ? result : stands(walk, &way);

    if (standing < 0) {
        return standing;
    }
    state->spin = (carom_v3_q40){{0, 0, turn(walk, keys)}};
    if (standing && !(keys & PORT_PAD_A)) {
        result = walk_on(walk, way, gravity_q32);
    } else {
        if (!standing && !(keys & (PORT_PAD_UP | PORT_PAD_DOWN))) { /* in the air: as before */
            way.c[0] = state->velocity.c[0] >> 8;
            way.c[1] = state->velocity.c[1] >> 8;
        }
        way.c[2] = standing ? CAROM_VELOCITY_MM_S(JUMP_MM_S, FPS) >> 8
                            : (state->velocity.c[2] >> 8) + gravity_q32;
        result = slide(walk, way);
    }
    for (int k = 0; k < 3; k++) {
        state->velocity.c[k] = (walk->mesh.position.c[k] - from.c[k]) * 256;
    }
    return result;
}

static int lead_walker(struct carom_world *world, uint32_t keys)
{
    struct walk walk = {.world = world};
    struct carom_body_state state;
    int result = carom_body_get(world, WALKER, &state);

    if (result < 0) {
        return result;
    }
    walk.mesh = mesh_of(world, WALKER, &state);
    result = go(&walk, keys, &state);
    if (result == CAROM_ERR_OVERLAP) { /* something moved into the walker */
        state.position.c[2] += CAROM_POSITION_MM(5);
        state.velocity = state.spin = (carom_v3_q40){{0, 0, 0}};
        state.overlap = CAROM_OVERLAP_PUSH_OUT;
        result = CAROM_OK;
    }
    return result < 0 ? result : carom_body_set(world, WALKER, &state);
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    int result = lead_platform(world, frame);

    result = result >= 0 ? lead_door(world) : result;
    return result >= 0 ? lead_walker(world, keys) : result;
}

/* ------------------------------------------------------------------------ script */

/* Goals of the walk and the frames until which they hold, as part of a round of the platform. */
#define ROUND_FRAMES (3 * PLATFORM_FRAMES)
static const struct {
    int16_t until, x_mm, y_mm;
    bool rides;
} round_way[] = {
    {PLATFORM_LEAVES, PLATFORM_LEFT_MM, 0, false},
    {PLATFORM_LEAVES + 160, 0, 0, true},
    {740, 7500, 0, false},
    {940, 7500, BLOCK_Y_MM, false},
    {1540, -5500, BLOCK_Y_MM, false},
    {1740, -5500, 0, false},
    {ROUND_FRAMES, -4500, 0, false},
};

static uint32_t script(const struct carom_world *world, int frame)
{
    static const int64_t ahead_q30[3] = {CAROM_ONE_Q30, 0, 0};
    struct carom_body_state state;
    int64_t x_q30[3], at_mm[2], way_mm[2], along, aside;
    uint32_t keys = 0;
    int i = 0;

    while (frame % ROUND_FRAMES >= round_way[i].until) {
        i++;
    }
    if (round_way[i].rides || carom_body_get(world, WALKER, &state) < 0 ||
        carom_body_world_vector(world, WALKER, ahead_q30, x_q30) < 0) {
        return 0;
    }
    at_mm[0] = CAROM_TO_MM(state.position.c[0]);
    at_mm[1] = CAROM_TO_MM(state.position.c[1]);
    way_mm[0] = round_way[i].x_mm - at_mm[0];
    way_mm[1] = round_way[i].y_mm - at_mm[1];
    if (way_mm[0] * way_mm[0] + way_mm[1] * way_mm[1] < 50 * 50) {
        return 0;
    }
    along = x_q30[0] * way_mm[0] + x_q30[1] * way_mm[1];
    aside = x_q30[0] * way_mm[1] - x_q30[1] * way_mm[0];
    /* turn if off by more than 2 degrees, walk if off by less than 27 */
    keys |= 32 * aside > along ? PORT_PAD_LEFT : -32 * aside > along ? PORT_PAD_RIGHT : 0;
    keys |= along > 2 * aside && along > -2 * aside ? PORT_PAD_UP : 0;
    /* jump before the block */
    keys |= at_mm[1] < BLOCK_Y_MM + 300 && at_mm[0] > 500 && at_mm[0] < 1000 ? PORT_PAD_A : 0;
    return keys;
}

/* ------------------------------------------------------------------------- parts */

/*
 * A camera beside the walker and a little behind. It moves in steps and stands still between them, so that a frame has
 * little to draw.
 */
static void look(const struct carom_world *world, struct carom_camera *camera)
{
    const carom_v3_q32 away = POSITION(-2600, -5200, 2200);
    const int64_t step_q32 = CAROM_POSITION_M(3);
    struct carom_body_state state;

    if (carom_body_get(world, WALKER, &state) < 0) {
        return;
    }
    camera->target.c[2] = CAROM_POSITION_MM(1000);
    for (int k = 0; k < 2; k++) {
        const int64_t from_q32 = state.position.c[k] + step_q32 / 2 + 64 * step_q32;

        camera->target.c[k] = (from_q32 / step_q32 - 64) * step_q32;
    }
    for (int k = 0; k < 3; k++) {
        camera->eye.c[k] = camera->target.c[k] + away.c[k];
    }
}

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct {
        int mesh;
        struct carom_body_def def;
    } bodies[] = {
        {MESH_WALKER, {.kinematic = true, .position = POSITION(-5500, 0, 880)}},
        {MESH_STEPS, {.stationary = true, .position = POSITION(-4000, 0, 0)}},
        {MESH_BOX, {.kinematic = true, .position = POSITION(PLATFORM_LEFT_MM, 0, 300)}},
        /* a ramp that leads down: turned by half a turn */
        {MESH_RAMP,
         {.stationary = true,
          .position = POSITION(4050, 0, 0),
          .rotation = {{0, 0, 0, CAROM_ONE_Q30}}}},
        {MESH_DOOR,
         {.kinematic = true,
          .position = POSITION(DOOR_AT_MM, -DOOR_HALF_MM, DOOR_UP_MM),
          .rotation = {{ROOT_HALF, 0, 0, ROOT_HALF}}}},
        {MESH_MAT,
         {.stationary = true,
          .sensor = true,
          .filter = {CATEGORY_MAT, 0xffff, 0},
          .position = POSITION(DOOR_AT_MM, 0, 0)}},
        /* walls on both sides of the door */
        {MESH_DOOR,
         {.stationary = true,
          .position = POSITION(DOOR_AT_MM, DOOR_HALF_MM + 30, DOOR_UP_MM),
          .rotation = {{ROOT_HALF, 0, 0, ROOT_HALF}}}},
        {MESH_DOOR,
         {.stationary = true,
          .position = POSITION(DOOR_AT_MM, -3 * DOOR_HALF_MM - 30, DOOR_UP_MM),
          .rotation = {{ROOT_HALF, 0, 0, ROOT_HALF}}}},
        {MESH_BOX,
         {.stationary = true,
          .position = POSITION(0, BLOCK_Y_MM, 250),
          .rotation = {{ROOT_HALF, 0, 0, ROOT_HALF}}}},
        {MESH_BOX, {.position = POSITION(2600, 1800, 260)}},
    };
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        struct carom_body_def def = bodies[i].def;

        def.friction_q16 = FRICTION_Q16;
        scene_part(&parts, bodies[i].mesh, &def);
    }
    return parts.result;
}

/* From the head to the feet, for each eighth of a turn. */
#define SIDE(face)                                                                                 \
    SCENE_DARK, face, face, face, face, SCENE_RED, SCENE_RED, SCENE_DARK, SCENE_DARK, SCENE_DARK,  \
        SCENE_DARK, SCENE_DARK
#define BACK SIDE(SCENE_DARK)
static const uint8_t walker_faces[96] = {SIDE(SCENE_YELLOW), BACK, BACK, BACK, BACK, BACK, BACK,
                                         SIDE(SCENE_YELLOW)};
static const struct carom_body_paint paints[] = {
    [SCENE_GROUND] = {scene_yard_faces, 0}, [WALKER] = {walker_faces, 0},
    [WALKER_STEPS] = {NULL, SCENE_DARK},    [WALKER_PLATFORM] = {NULL, SCENE_YELLOW},
    [WALKER_RAMP] = {NULL, SCENE_DARK},     [WALKER_DOOR] = {NULL, SCENE_WOOD},
    [WALKER_MAT] = {NULL, SCENE_RED},       [WALKER_WALL] = {NULL, SCENE_DARK},
    [WALKER_WALL + 1] = {NULL, SCENE_DARK}, [WALKER_BLOCK] = {NULL, SCENE_DARK},
    [WALKER_CRATE] = {NULL, SCENE_WOOD},
};

const struct scene_game scene_walker = {
    .caps = CAROM_CAPS(WALKER_CRATE + 1, 32, 64, 256, 0, 1024, 0, 4),
    .camera = {POSITION(-7500, -6000, 3200), POSITION(-5500, 0, 900), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .look = look,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};

/* SPDX-License-Identifier: MIT */
/*
 * Scene lockstep: two players on two machines push a ball and boxes in a rink. Each machine has its own world
 * (scene_net.h), and the picture shows both: the red player's on the left, the yellow one's on the right. The balls in the
 * air are packets between the machines, and many are lost. The line of text says up to which frame both hashes agree.
 */
#include <string.h>

#include "carom_body.h"
#include "port.h"
#include "scene_games.h"
#include "scene_net.h"

enum { MESH_RINK, MESH_PUCK, MESH_BALL, MESH_BOX };

/* ------------------------------------------------------------------ the rink */

#define PUCK_KG   2
#define FASTEST   CAROM_VELOCITY_MM_S(3500, FPS)
#define PUSH      CAROM_IMPULSE_N_S(PUCK_KG, FPS) / 5 /* a frame: 12 m/s^2 */
#define RINK_WALL (CAROM_ONE_Q30 / 2)

static const struct carom_body_def rink_bodies[RINK_BODIES] = {
    [RINK_FLOOR] = {.stationary = true, .restitution_q30 = RINK_WALL, .friction_q16 = 1 << 15},
    [RINK_PUCK] = {.position = POSITION(-3000, -300, 2),
                   .restitution_q30 = RINK_WALL,
                   .friction_q16 = 1 << 13,
                   .mass_q20 = CAROM_MASS_KG(PUCK_KG)},
    [RINK_PUCK + 1] = {.position = POSITION(3000, 300, 2),
                       .restitution_q30 = RINK_WALL,
                       .friction_q16 = 1 << 13,
                       .mass_q20 = CAROM_MASS_KG(PUCK_KG)},
    [RINK_BALL] = {.position = POSITION(0, 0, 400),
                   .restitution_q30 = RINK_WALL,
                   .friction_q16 = 1 << 14,
                   .mass_q20 = CAROM_MASS_G(300)},
    [RINK_BOX] = {.position = POSITION(-1200, 1500, 252), .friction_q16 = 1 << 14},
    [RINK_BOX + 1] = {.position = POSITION(1300, 1400, 252), .friction_q16 = 1 << 14},
    [RINK_BOX + 2] = {.position = POSITION(100, -1700, 252), .friction_q16 = 1 << 14},
};

static int mesh_of(int body)
{
    return body == RINK_FLOOR  ? MESH_RINK
           : body < RINK_BALL  ? MESH_PUCK
           : body == RINK_BALL ? MESH_BALL
                               : MESH_BOX;
}

int rink_world(const struct scene *scene, void *block, size_t bytes, struct carom_world **world)
{
    const struct carom_config config = {.caps = CAROM_CAPS(RINK_CAPS),
                                        .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, FPS)}},
                                        .sleep = true};
    struct scene_parts parts = {scene, NULL, carom_world_init(block, bytes, &config, world)};

    parts.world = *world;
    for (int i = 0; i < RINK_BODIES; i++) {
        scene_part(&parts, mesh_of(i), &rink_bodies[i]);
    }
    return parts.result;
}

/* Push along an axis, unless the puck is fast enough. */
static int64_t push(int side, int64_t speed_q40)
{
    return side * speed_q40 < FASTEST ? side * PUSH : 0;
}

/* A puck that left over the walls falls in again above its start, as soon as there is room. */
static int put_back(struct carom_world *world, int body)
{
    struct carom_body_state state;
    int result = carom_body_get(world, body, &state);

    if (result < 0 || state.position.c[2] > CAROM_POSITION_MM(-1000)) {
        return result;
    }
    state = (struct carom_body_state){.position = rink_bodies[body].position};
    state.position.c[2] = CAROM_POSITION_MM(1500);
    state.rotation.c[0] = CAROM_ONE_Q30;
    result = carom_body_set(world, body, &state);
    return result == CAROM_ERR_OVERLAP ? CAROM_OK : result;
}

int rink_act(struct carom_world *world, const uint8_t keys[NET_PLAYERS])
{
    int result = CAROM_OK;

    for (int body = RINK_PUCK; body < RINK_BODIES && result >= 0; body++) {
        result = put_back(world, body);
    }

    for (int i = 0; i < NET_PLAYERS && result >= 0; i++) {
        const int x = !!(keys[i] & PORT_PAD_RIGHT) - !!(keys[i] & PORT_PAD_LEFT);
        const int y = !!(keys[i] & PORT_PAD_UP) - !!(keys[i] & PORT_PAD_DOWN);
        struct carom_body_state puck;
        carom_v3_q40 impulse;

        result = carom_body_get(world, RINK_PUCK + i, &puck);
        impulse = (carom_v3_q40){{push(x, puck.velocity.c[0]), push(y, puck.velocity.c[1]), 0}};
        if (result >= 0 && !puck.out && (impulse.c[0] != 0 || impulse.c[1] != 0)) {
            result = carom_body_push_centre(world, RINK_PUCK + i, &impulse);
        }
    }
    return result;
}

/* --------------------------------------------------------------- both machines */

#define LOSS       90 /* parts of 256 */
#define SEED       7
#define ASIDE_MM   4700 /* distance of the middle of a rink */
#define HIDDEN_MM  (-200000)
#define PACKETS    (1 + NET_PLAYERS * RINK_BODIES)
#define CHASE_MM   250
#define TURN_TICKS 150

static struct net_side sides[NET_PLAYERS];
static struct net_link links[NET_PLAYERS]; /* links from a player to the other one */
static _Alignas(8) uint8_t blocks[NET_PLAYERS][CAROM_WORLD_BYTES(RINK_CAPS)];
static uint8_t saved[NET_PLAYERS][RINK_SNAPSHOT_BYTES];

/* A body of the picture touches nothing. */
static void add_pictures(struct scene_parts *parts)
{
    struct carom_body_def def = {.stationary = true, .filter = {1, 0, 0}};

    for (int i = 0; i < NET_PLAYERS; i++) {
        for (int body = 0; body < RINK_BODIES; body++) {
            def.position = rink_bodies[body].position;
            def.position.c[0] += CAROM_POSITION_MM(i == 0 ? -ASIDE_MM : ASIDE_MM);
            def.position.c[2] += CAROM_POSITION_MM(200);
            scene_part(parts, mesh_of(body), &def);
        }
    }
    def.position = (carom_v3_q32)POSITION(0, 0, HIDDEN_MM / 100);
    for (int i = 0; i < NET_PLAYERS * LOCKSTEP_DELAY; i++) {
        scene_part(parts, MESH_BALL, &def);
    }
}

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct scene_parts parts = {scene, world, CAROM_OK};

    add_pictures(&parts);
    for (int i = 0; i < NET_PLAYERS && parts.result >= 0; i++) {
        struct carom_world *own;

        links[i] = (struct net_link){.state = SEED + (uint64_t)i,
                                     .loss = LOSS,
                                     .delay_least = 2,
                                     .delay_most = LOCKSTEP_DELAY};
        parts.result = rink_world(scene, blocks[i], sizeof blocks[i], &own);
        if (parts.result >= 0) {
            parts.result = net_begin(&sides[i], i, own, rink_act, saved[i], sizeof saved[i]);
        }
    }
    return parts.result;
}

/* The body of the picture for a body of a side. */
static int show_body(struct carom_world *world, int i, int body)
{
    struct carom_body_state state;
    int result = carom_body_get(sides[i].world, body, &state);

    state.position.c[0] += CAROM_POSITION_MM(i == 0 ? -ASIDE_MM : ASIDE_MM);
    state.position.c[2] += CAROM_POSITION_MM(200);
    state.velocity = state.spin = (carom_v3_q40){{0, 0, 0}};
    state.overlap = CAROM_OVERLAP_PASS;
    return result < 0 ? result : carom_body_set(world, 1 + i * RINK_BODIES + body, &state);
}

/* A packet flies in an arc behind the rinks; a lost one falls from the middle of the arc. */
static int show_packet(struct carom_world *world, int i, int n, const struct net_packet *packet,
                       int32_t tick)
{
    struct carom_body_state state = {.position = POSITION(0, 0, HIDDEN_MM / 100),
                                     .rotation = {{CAROM_ONE_Q30, 0, 0, 0}},
                                     .overlap = CAROM_OVERLAP_PASS};

    if (packet) {
        /* thousandths of the way */
        const int32_t part = 1000 * (tick - packet->sent) / (packet->due - packet->sent);
        const int32_t way = packet->lost && part > 500 ? 500 : part;
        int32_t up_mm = 800 + 8 * way * (1000 - way) / 1000;

        up_mm = packet->lost && part > 500 ? up_mm - 4 * (part - 500) : up_mm;
        state.position.c[0] = CAROM_POSITION_MM(1) * (ASIDE_MM * (2 * way - 1000) / 1000);
        state.position.c[0] *= i == 0 ? 1 : -1;
        state.position.c[1] = CAROM_POSITION_MM(i == 0 ? 4100 : 5300);
        state.position.c[2] = CAROM_POSITION_MM(1) * up_mm;
    }
    return carom_body_set(world, PACKETS + i * LOCKSTEP_DELAY + n, &state);
}

static int show(struct carom_world *world, int32_t tick)
{
    int result = CAROM_OK;

    for (int i = 0; i < NET_PLAYERS; i++) {
        int n = 0;

        for (int body = RINK_PUCK; body < RINK_BODIES && result >= 0; body++) {
            result = show_body(world, i, body);
        }
        for (int k = 0; k < NET_FLYING && result >= 0 && n < LOCKSTEP_DELAY; k++) {
            if (links[i].flying[k].there) {
                result = show_packet(world, i, n++, &links[i].flying[k], tick);
            }
        }
        while (result >= 0 && n < LOCKSTEP_DELAY) {
            result = show_packet(world, i, n++, NULL, tick);
        }
    }
    return result;
}

/* ------------------------------------------------------------------ the game */

/*
 * The script of a player: it follows the ball and each box in turn, as its own machine shows them.
 */
static uint8_t chase(int i, int32_t tick)
{
    const int goal = RINK_BALL + (tick / TURN_TICKS + i) % (RINK_BODIES - RINK_BALL);
    struct carom_body_state own, other;
    int64_t way_mm[2];

    if (carom_body_get(sides[i].world, RINK_PUCK + i, &own) < 0 ||
        carom_body_get(sides[i].world, goal, &other) < 0) {
        return 0;
    }
    for (int k = 0; k < 2; k++) {
        way_mm[k] = CAROM_TO_MM(other.position.c[k] - own.position.c[k]);
    }
    return (uint8_t)((way_mm[0] > CHASE_MM    ? PORT_PAD_RIGHT
                      : way_mm[0] < -CHASE_MM ? PORT_PAD_LEFT
                                              : 0) |
                     (way_mm[1] > CHASE_MM    ? PORT_PAD_UP
                      : way_mm[1] < -CHASE_MM ? PORT_PAD_DOWN
                                              : 0));
}

/* Until a key is pressed, the red player follows its script; the yellow player always does. */
#define BY_ITSELF SCENE_NOBODY

static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    (void)frame;
    return BY_ITSELF;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    int result = CAROM_OK;

    for (int i = 0; i < NET_PLAYERS && result >= 0; i++) {
        const bool played = i == 0 && keys != BY_ITSELF;

        net_take(&sides[i], &links[!i], frame);
        result = net_frame(&sides[i], played ? (uint8_t)keys : chase(i, frame));
        net_send(&sides[i], &links[i], frame);
    }
    return result < 0 ? result : show(world, frame);
}

/* Six digits of a hash. */
static char *say_hash(char *text, uint64_t hash)
{
    for (int digit = 15; digit >= 10; digit--) {
        *text++ = "0123456789abcdef"[hash >> 4 * digit & 15];
    }
    *text = 0;
    return text;
}

/* Print the last frame on which both agree, and the hashes after it. */
static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    const int32_t agreed = sides[0].agreed < sides[1].agreed ? sides[0].agreed : sides[1].agreed;
    const uint64_t left = net_hash(&sides[0], agreed), right = net_hash(&sides[1], agreed);

    (void)world;
    text = scene_say_number(text, sides[0].frame % 100000, " agreed ");
    text = scene_say_number(text, agreed % 100000, ": ");
    text = say_hash(text, left);
    memcpy(text, left == right ? " = " : " # ", 3);
    say_hash(text + 3, right);
}

#define TWO(ramp)  ramp, ramp
#define FOUR(ramp) TWO(ramp), TWO(ramp)
#define WALL       FOUR(SCENE_DARK), FOUR(SCENE_DARK)
/* below, outside, rim, inside, floor */
static const uint8_t rink_faces[RINK_FACES] = {TWO(SCENE_DARK), WALL, WALL, WALL,
                                               TWO(SCENE_MEADOW)};
#define RINK_PAINTS                                                                                \
    {rink_faces, 0}, {NULL, SCENE_RED}, {NULL, SCENE_YELLOW}, {NULL, SCENE_DARK},                  \
        {NULL, SCENE_WOOD}, {NULL, SCENE_WOOD},                                                    \
    {                                                                                              \
        NULL, SCENE_WOOD                                                                           \
    }
#define THREE(ramp)                                                                                \
    {NULL, ramp}, {NULL, ramp},                                                                    \
    {                                                                                              \
        NULL, ramp                                                                                 \
    }
#define NINE(ramp) THREE(ramp), THREE(ramp), THREE(ramp)
static const struct carom_body_paint paints[LOCKSTEP_BODIES] = {
    {NULL, SCENE_GREEN}, RINK_PAINTS, RINK_PAINTS, NINE(SCENE_RED), NINE(SCENE_YELLOW)};

const struct scene_game scene_lockstep = {
    .caps = CAROM_CAPS(LOCKSTEP_BODIES, 1, 1, 1, 0, 64),
    .camera = {POSITION(0, -14500, 14500), POSITION(0, 1000, 0), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = LOCKSTEP_BODIES,
};

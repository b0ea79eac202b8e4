/* SPDX-License-Identifier: MIT */
/* Small worlds of boxes, for the tests of contacts between bodies. */
#include <string.h>

#include "box.h"
#include "boxes.h"

struct carom_config boxes_config;
struct carom_mesh boxes_mesh[BOXES_MESHES];

static _Alignas(8) uint8_t mesh_block[BOXES_MESHES][CAROM_MESH_BYTES(8, 12)];
static int16_t vertices[BOXES_MESHES][8][3];
static _Alignas(8) uint8_t block[BOXES_WORLDS][CAROM_WORLD_BYTES(BOXES_CAPS, 0, BOXES_EXTRAS)];

void boxes_make(int number, int x, int y, int z)
{
    const int low[3] = {-x, -y, -z}, high[3] = {x, y, z};
    struct carom_mesh_raw raw = {
        (const int16_t(*)[3])vertices[number], box_faces, 8, 12, 10, CAROM_SOLID};

    box_corners(vertices[number], low, high);
    CHECK_EQ(
        carom_mesh_build(&boxes_mesh[number], &raw, mesh_block[number], sizeof mesh_block[number]),
        CAROM_OK);
}

void boxes_begin(void)
{
    boxes_config = (struct carom_config){.caps = CAROM_CAPS(BOXES_CAPS),
                                         .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}},
                                         .sleep = true};
}

struct carom_world *boxes_world(int number)
{
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block[number], sizeof block[number], &boxes_config, &world),
             CAROM_OK);
    return world;
}

struct carom_body_def boxes_def(int mesh, int x, int y, int z)
{
    return (struct carom_body_def){.mesh = &boxes_mesh[mesh],
                                   .position = {{BOXES_Q32(x), BOXES_Q32(y), BOXES_Q32(z)}},
                                   .friction_q16 = 1 << 15};
}

int boxes_add(struct carom_world *world, const struct carom_body_def *def)
{
    int body = carom_body_add(world, def);

    CHECK_AT_LEAST(body, 0);
    return body;
}

struct carom_body_state boxes_state(const struct carom_world *world, int body)
{
    struct carom_body_state state;

    memset(&state, 0, sizeof state);
    CHECK_EQ(carom_body_get(world, body, &state), CAROM_OK);
    return state;
}

int boxes_set(struct carom_world *world, int body, int x, int y, int z, int overlap)
{
    struct carom_body_state state = boxes_state(world, body);

    state.position = (carom_v3_q32){{BOXES_Q32(x), BOXES_Q32(y), BOXES_Q32(z)}};
    state.overlap = (uint8_t)overlap;
    return carom_body_set(world, body, &state);
}

void boxes_step(struct carom_world *world, int frames)
{
    for (int i = 0; i < frames; i++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
}

int boxes_events(const struct carom_world *world, int kind, int a, int b)
{
    const struct carom_event *events;
    int count = carom_events(world, &events), found = 0;

    for (int i = 0; i < count; i++) {
        found += events[i].kind == kind && events[i].a == a && events[i].b == b;
    }
    return found;
}

bool boxes_overlap(struct carom_world *world, int a, int b)
{
    return carom_query_faces(world, a, b, NULL, 0) != 0 || carom_query_inside(world, a, b) == 1 ||
           carom_query_inside(world, b, a) == 1;
}

bool boxes_same(const struct carom_body_state *a, const struct carom_body_state *b)
{
    return memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
           memcmp(&a->rotation, &b->rotation, sizeof a->rotation) == 0 &&
           memcmp(&a->velocity, &b->velocity, sizeof a->velocity) == 0 &&
           memcmp(&a->spin, &b->spin, sizeof a->spin) == 0 && a->asleep == b->asleep;
}

void boxes_step_alike(struct carom_world *world, int body, struct carom_world *alone, int other)
{
    struct carom_body_state one, two;

    boxes_step(world, 1);
    boxes_step(alone, 1);
    one = boxes_state(world, body);
    two = boxes_state(alone, other);
    CHECK(boxes_same(&one, &two));
}

void boxes_held_down(struct carom_world *world, int speed)
{
    struct carom_body_state state = boxes_state(world, 1);

    state.velocity = (carom_v3_q40){{0, 0, BOXES_Q40(speed)}};
    CHECK_EQ(carom_body_set(world, 1, &state), CAROM_OK);
    boxes_step(world, 30);
    CHECK_LESS(boxes_state(world, 1).position.c[2], BOXES_Q32(-128));
}

uint32_t boxes_pairs(const struct carom_world *world)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    return usage[CAROM_POOL_pairs].used;
}

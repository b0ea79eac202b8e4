/* SPDX-License-Identifier: MIT */
/*
 * Scene cards: a house of cards of three storeys. Pairs lean on each other, cards lie across their tops, and the next storey
 * stands on these. Only friction holds it. It stands until A throws a ball at it.
 */
#include <string.h>

#include "port.h"
#include "scene_games.h"

enum { MESH_CARD, MESH_COVER, MESH_BALL };

#define FRICTION_Q16 52429 /* 0.8 */

/* Micrometres. GAP is the distance between cards at rest. Cards are 1000000 x 19531 and lean by 20 degrees. */
#define UM(um)    (CAROM_POSITION_MM(um) / 1000)
#define GAP       300
#define THICK     19531
#define HALF_SINE 171010                /* half a card */
#define MIDDLE    (GAP + 469846 + 3340) /* height of the middle of a leaning card above its floor */
#define ASIDE     (GAP / 2 + HALF_SINE + 9177) /* from the pair's top edge to a card's middle */
#define TOP       (GAP + 939693 + 6680)
#define STOREY    (TOP + GAP + THICK)
#define PITCH     (2 * (2 * HALF_SINE + 18353) + 40000) /* from pair to pair */
#define COVER     404297                                /* half the length of a lying card */
#define APART     3000 /* half the distance between two lying cards */

static const struct carom_body_def ball = {.position = POSITION(-2600, 0, 270),
                                           .friction_q16 = FRICTION_Q16,
                                           .restitution_q30 = CAROM_ONE_Q30 / 4};
static const carom_v3_q40 ball_velocity = VELOCITY(4500, 0, 4800);

static void put(struct scene_parts *parts, int mesh, int64_t x_um, int64_t z_um, int lean)
{
    const int32_t sine_q30 = 186453311, cosine_q30 = 1057429273; /* of 10 degrees */
    struct carom_body_def def = {.position = {{UM(x_um), 0, UM(z_um)}},
                                 .friction_q16 = FRICTION_Q16};

    if (lean != 0) {
        def.rotation = (carom_quat_q30){{cosine_q30, 0, lean * sine_q30, 0}};
    }
    scene_part(parts, mesh, &def);
}

/* Storeys from below; the two leaning cards at the top come last. */
static int fill(const struct scene *scene, struct carom_world *world)
{
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (int storey = 0; storey < CARDS_STOREYS; storey++) {
        const int pairs = CARDS_STOREYS - storey;
        const int64_t base = (int64_t)storey * STOREY, first = -(pairs - 1) * (int64_t)PITCH / 2;

        for (int i = 0; i < pairs; i++) {
            put(&parts, MESH_CARD, first + i * PITCH - ASIDE, base + MIDDLE, 1);
            put(&parts, MESH_CARD, first + i * PITCH + ASIDE, base + MIDDLE, -1);
        }
        for (int i = 0; i < pairs - 1; i++) {
            /* one card lies in the middle; the ends of two meet over a top */
            const int64_t x = pairs == 2 ? 0 : (i == 0 ? -1 : 1) * (int64_t)(APART + COVER);

            put(&parts, MESH_COVER, x, base + TOP + GAP + THICK / 2, 0);
        }
    }
    return scene_part(&parts, MESH_BALL, &ball);
}

static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    return frame == CARDS_START ? PORT_PAD_A : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    (void)frame;
    return keys & PORT_PAD_A ? scene_throw(world, CARDS_BALL, &ball.position, &ball_velocity)
                             : CAROM_OK;
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    struct carom_body_state top = {.asleep = false};
    const int64_t high_q32 = UM(2 * STOREY + MIDDLE) - CAROM_POSITION_MM(10);

    carom_body_get(world, CARDS_TOP, &top);
    strcpy(text,
           top.position.c[2] > high_q32 ? "no glue: it stands. A throws the ball" : "it is down");
}

#define PAIR                                                                                       \
    {NULL, SCENE_YELLOW},                                                                          \
    {                                                                                              \
        NULL, SCENE_RED                                                                            \
    }
static const struct carom_body_paint paints[] = {{NULL, SCENE_GREEN},
                                                 PAIR,
                                                 PAIR,
                                                 PAIR,
                                                 {NULL, SCENE_WOOD},
                                                 {NULL, SCENE_WOOD},
                                                 PAIR,
                                                 PAIR,
                                                 {NULL, SCENE_WOOD},
                                                 PAIR,
                                                 {NULL, SCENE_DARK}};

const struct scene_game scene_cards = {
    .caps = CAROM_CAPS(CARDS_BALL + 1, 80, 192, 384, 0, 768),
    .camera = {POSITION(-1100, -5000, 2500), POSITION(-500, 0, 1200), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};

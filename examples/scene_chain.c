/* SPDX-License-Identifier: MIT */
/* Scene chain: links on ball joints. The chain hangs from its first link and swings. */
#include "scene_games.h"

#define FRICTION_Q16 (1u << 15)

#define LINK_MM  320 /* from a link to the next: a ring hangs in the other */
#define CHAIN_MM 7500

/* Every other link is turned by a quarter about the chain. Links of a chain go through each other. */
static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def link = {.position = POSITION(0, 0, CHAIN_MM),
                                  .friction_q16 = FRICTION_Q16,
                                  .filter = {1, 0xffff, -1}};
    struct carom_joint_def joint = {
        .kind = CAROM_JOINT_BALL, .b = CAROM_WORLD, .anchor = POSITION(-LINK_MM / 2, 0, CHAIN_MM)};
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (int i = 0; i < CHAIN_LINKS; i++) {
        link.rotation = i % 2 ? (carom_quat_q30){{759250125, 759250125, 0, 0}}
                              : (carom_quat_q30){{CAROM_ONE_Q30, 0, 0, 0}};
        scene_part(&parts, 0, &link);
        link.position.c[0] += CAROM_POSITION_MM(LINK_MM);
    }
    for (int i = 0; i < CHAIN_LINKS; i++) {
        joint.a = SCENE_BODY + i;
        joint.b = i > 0 ? SCENE_BODY + i - 1 : CAROM_WORLD;
        scene_joint(&parts, &joint);
        joint.anchor.c[0] += CAROM_POSITION_MM(LINK_MM);
    }
    return parts.result;
}

#define FOUR_LINKS                                                                                 \
    {NULL, SCENE_YELLOW}, {NULL, SCENE_DARK}, {NULL, SCENE_YELLOW},                                \
    {                                                                                              \
        NULL, SCENE_DARK                                                                           \
    }
static const struct carom_body_paint paints[] = {{NULL, SCENE_GREEN}, FOUR_LINKS, FOUR_LINKS,
                                                 FOUR_LINKS,          FOUR_LINKS, FOUR_LINKS};

const struct scene_game scene_chain = {
    .caps = CAROM_CAPS(CHAIN_LINKS + 1, 64, 64, 256, 0, 1024, CHAIN_LINKS, 0),
    .camera = {POSITION(1500, -13000, 5600), POSITION(0, 0, 5000), 1 << 16},
    .fill = fill,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};

/* SPDX-License-Identifier: MIT */
/*
 * Scene screw: a nut on a bolt that stands on its head. No joint holds the nut: thread lies on
 * thread. Its weight turns it down; up and down turn it like a hand.
 */
#include "carom_body.h"
#include "port.h"
#include "scene_games.h"

#define FRICTION_Q16 1300 /* 1/50: a bolt in oil */
#define HEAD_MM      350
#define LOW_MM       100                           /* end of the bolt, within its head */
#define START_MM     (LOW_MM + 5 * SCREW_PITCH_MM) /* height of the nut at which both threads fit */
_Static_assert(START_MM == HEAD_MM + SCREW_WAY_MM, "what scene_games.h says");
#define MIDDLE_MM ((HEAD_MM + START_MM) / 2)

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def nut = {
        .position = POSITION(0, 0, START_MM), .mass_q20 = 1 << 20, .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def bolt = {
        .stationary = true, .position = POSITION(0, 0, LOW_MM), .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def head = {.stationary = true, .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, 0, &nut);
    scene_part(&parts, 1, &bolt);
    return scene_part(&parts, 2, &head);
}

/* Height of the lower end of the nut. */
static int64_t height_mm(const struct carom_body_state *nut, const struct carom_world *world)
{
    return CAROM_TO_MM(nut->position.c[2] -
                       carom_body_mesh(world, SCREW_NUT)->mass.centre.c[2] * 1024ll);
}

/*
 * The script presses nothing on the way down; at the head it turns the nut up for half of the way,
 * and lets go.
 */
static uint32_t script(const struct carom_world *world, int frame)
{
    struct carom_body_state nut;

    (void)frame;
    return carom_body_get(world, SCREW_NUT, &nut) >= 0 && height_mm(&nut, world) < MIDDLE_MM &&
                   nut.velocity.c[2] > -CAROM_VELOCITY_MM_S(5, FPS)
               ? PORT_PAD_UP
               : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    const int way = !!(keys & PORT_PAD_UP) - !!(keys & PORT_PAD_DOWN);
    /* for 1 kg the weight amounts to 9.81 N x 0.4 m / 2 pi = 0.62 N m */
    const carom_v3_q40 torque = {{0, 0, way * CAROM_TORQUE_MN_M(1400, FPS)}};

    (void)frame;
    return carom_body_set_torque(world, SCREW_NUT, &torque);
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    struct carom_body_state nut;

    if (carom_body_get(world, SCREW_NUT, &nut) >= 0) {
        text = scene_say_number(text, (int)(height_mm(&nut, world) - HEAD_MM), " mm to go");
    }
}

static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, {NULL, SCENE_YELLOW}, {NULL, SCENE_RED}, {NULL, SCENE_RED}};

const struct scene_game scene_screw = {
    .caps = CAROM_CAPS(4, 8, 512, 2048, 0, 8192, 0, 2),
    .camera = {POSITION(1100, -3500, 3000), POSITION(0, 0, 1400), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};

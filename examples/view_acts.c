/* SPDX-License-Identifier: MIT */
/*
 * Acts: the changes that the viewer makes to the world. Each act has a frame; it is done before the
 * step of that frame, so that it can be repeated.
 */
#include "carom_body.h"
#include "scene.h"
#include "view_parts.h"

#define TO_ACT        (32 - VIEW_ACT_BITS)
#define KEYS_ALL      255
#define BODIES_ALL    4096
#define LENGTH_LIMIT  ((int32_t)4000 << VIEW_ACT_BITS)
#define KEPT_FOR_DROP 1 /* places of the list */

struct view_acts view_acts;
const uint8_t view_act_numbers[VIEW_ACT_KINDS] = {
    [VIEW_KEYS] = 1, [VIEW_GRAB] = 4, [VIEW_HAND] = 3, [VIEW_DROP] = 0};

static uint32_t keys_held = SCENE_NOBODY;
static uint32_t keys_wanted;
static bool hand_wanted; /* the noted acts leave the hand closed */

bool view_act_is_sound(const struct view_act *act)
{
    const int lengths = act->kind == VIEW_GRAB;

    if (act->kind == VIEW_KEYS) {
        return act->n[0] >= 0 && act->n[0] <= KEYS_ALL;
    }
    if (act->kind == VIEW_GRAB && (act->n[0] < 0 || act->n[0] >= BODIES_ALL)) {
        return false;
    }
    for (int i = lengths; i < view_act_numbers[act->kind]; i++) {
        if (act->n[i] < -LENGTH_LIMIT || act->n[i] > LENGTH_LIMIT) {
            return false;
        }
    }
    return true;
}

void view_acts_clear(void)
{
    view_acts.count = view_acts.done = 0;
    view_acts.given = 0;
    keys_held = SCENE_NOBODY;
    keys_wanted = 0;
    hand_wanted = false;
}

bool view_acts_follow(void)
{
    return view_step_count() < view_acts.given;
}

uint32_t view_acts_keys(void)
{
    return keys_held;
}

/* ------------------------------------------------------------------- noting */

/* Note an act. Two acts of the same kind before one frame count as one. True if there is room. */
static bool note(struct view_act act)
{
    struct view_act *last =
        view_acts.count > view_acts.done ? &view_acts.list[view_acts.count - 1] : NULL;
    uint32_t room = VIEW_ACTS_MAX - (act.kind == VIEW_DROP ? 0 : KEPT_FOR_DROP);

    act.frame = view_step_count() + 1;
    if (last && last->kind == act.kind && (act.kind == VIEW_KEYS || act.kind == VIEW_HAND)) {
        *last = act;
        return true;
    }
    if (view_acts.count >= room || act.frame > VIEW_FRAME_MAX) {
        return false;
    }
    view_acts.list[view_acts.count++] = act;
    return true;
}

static void to_act(int32_t n[3], const carom_v3_q32 *at)
{
    for (int k = 0; k < 3; k++) {
        int64_t c = carom_round(at->c[k], TO_ACT);

        n[k] = (int32_t)(c < -LENGTH_LIMIT ? -LENGTH_LIMIT : c > LENGTH_LIMIT ? LENGTH_LIMIT : c);
    }
}

static carom_v3_q32 from_act(const int32_t n[3])
{
    return (carom_v3_q32){
        {carom_shl(n[0], TO_ACT), carom_shl(n[1], TO_ACT), carom_shl(n[2], TO_ACT)}};
}

void view_keys(uint32_t keys)
{
    keys &= KEYS_ALL;
    if (view_acts_follow() || keys == keys_wanted ||
        !note((struct view_act){.kind = VIEW_KEYS, .n = {(int32_t)keys}})) {
        return;
    }
    keys_wanted = keys;
}

bool view_grab(int32_t x, int32_t y)
{
    const struct carom_world *world = view_world();
    struct view_act act = {.kind = VIEW_GRAB};
    struct carom_ray_hit hit;
    carom_v3_q32 local;
    uint32_t mass_q20;

    view_drop();
    if (!world || view_acts_follow() ||
        carom_draw_pick(world, view_camera(), view_picture(), x, y, NULL, &hit) != 1 ||
        carom_body_mass(world, hit.body, &mass_q20) < 0 || mass_q20 == 0 ||
        carom_body_local_point(world, hit.body, &hit.point, &local) < 0) {
        return false;
    }
    act.n[0] = hit.body;
    to_act(&act.n[1], &local);
    hand_wanted = note(act);
    if (hand_wanted) {
        act.kind = VIEW_HAND;
        to_act(act.n, &hit.point);
        view_hand_at = from_act(act.n);
        note(act);
    }
    return hand_wanted;
}

void view_drag(int32_t x, int32_t y)
{
    struct view_act act = {.kind = VIEW_HAND};

    if (!hand_wanted || view_acts_follow() || !view_hand_reach(x, y)) {
        return;
    }
    to_act(act.n, &view_hand_at);
    note(act);
}

void view_drop(void)
{
    if (hand_wanted && !view_acts_follow() && note((struct view_act){.kind = VIEW_DROP})) {
        hand_wanted = false;
    }
}

/* -------------------------------------------------------------------- doing */

static void do_act(struct carom_world *world, const struct view_act *act)
{
    carom_v3_q32 at;

    switch (act->kind) {
    case VIEW_KEYS:
        keys_held = keys_wanted = (uint32_t)act->n[0];
        break;
    case VIEW_GRAB:
        at = from_act(&act->n[1]);
        view_hand_grab(world, act->n[0], &at);
        hand_wanted = true;
        break;
    case VIEW_HAND:
        view_hand_at = from_act(act->n);
        view_hand.at = view_hand_at;
        break;
    default:
        view_hand.holds = hand_wanted = false;
        break;
    }
}

void view_acts_before(struct carom_world *world, int32_t frame)
{
    while (view_acts.done < view_acts.count && view_acts.list[view_acts.done].frame <= frame) {
        do_act(world, &view_acts.list[view_acts.done++]);
    }
}

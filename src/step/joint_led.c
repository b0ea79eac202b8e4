/* SPDX-License-Identifier: MIT */
/* The energy of joints over a frame, and kinematic bodies that lead others by joints. */
#include "connect.h"

/* ------------------------------------------------------------------------- energy */

/* True if no impulse moves a side of a joint; a body that left the world stays where it did. */
static bool stands_fast(const struct step *s, uint16_t i)
{
    return i == JOINT_WORLD || !s->w->bodies[i].def.moving || s->next->bodies[i].out;
}

/* The island of a joint: that of the side which moves, or of either. */
static uint32_t island_of(const struct step *s, const struct joint *j)
{
    uint16_t side = stands_fast(s, j->a) && j->b != JOINT_WORLD ? j->b : j->a;

    return s->w->bodies[side].island.lowest;
}

/*
 * Add twice the energy that a spring stores: k x^2, q80. The pull of a weak spring keeps up to 80
 * fractional bits: 40 would be off by more than the bodies may gain.
 */
static void add_spring2(struct fix_wide *sum, const struct joint *j,
                        const struct joint_state *state, const struct body_state *bodies)
{
    struct joint_pose pose[2] = {world_joint_pose(bodies, j->a), world_joint_pose(bodies, j->b)};
    struct joint_error error;
    struct fix_wide pull, energy;
    int64_t x_q40;
    int down;

    joint_measure(j, pose, &error);
    x_q40 = error.coordinate_q40 - carom_shl(state->drive.rest_q32, 8);
    pull = fix_wide_mul(state->drive.stiffness_q40, x_q40);
    down = fix_wide_bits(&pull) - 62;
    down = fix_smaller(fix_larger(down, 0), 40);
    energy = fix_wide_mul(fix_wide_shift(&pull, down), x_q40);
    energy = fix_wide_down(&energy, 40 - down);
    fix_wide_add(sum, &energy);
}

/*
 * Add the energy that the springs of an island took up in the frame to `gained`, what they had at
 * its start to `kept`, and what its limits and damping took to `taken`. They may not give any.
 */
void connect_add_joints2(const struct step *s, uint32_t first, struct fix_wide *gained,
                         struct fix_wide *taken, struct fix_wide *kept)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!joint_holds(list, i) || island_of(s, j) != first) {
            continue;
        }
        if (s->next->joints[i].drive.spring) {
            struct fix_wide before = {0, 0};

            add_spring2(&before, j, &list->states[i], world_now(s->w)->bodies);
            add_spring2(gained, j, &list->states[i], s->next->bodies);
            fix_wide_subtract(gained, &before);
            fix_wide_add(kept, &before);
        }
        if (fix_wide_sign(&j->work.given2) < 0) {
            fix_wide_subtract(taken, &j->work.given2);
        }
    }
}

/* Energy owed by the joints of an island. The first joint keeps the whole debt. */
struct fix_wide *connect_owed2(const struct step *s, uint32_t first)
{
    const struct joint_list *list = &s->w->rest.joints;
    struct joint_state *keeper = NULL;

    for (uint32_t i = 0; i < list->count; i++) {
        if (joint_holds(list, i) && island_of(s, &list->joints[i]) == first) {
            struct joint_state *state = &list->states[i];

            if (!keeper) {
                keeper = state;
            } else {
                fix_wide_add(&keeper->owed2, &state->owed2);
                state->owed2 = (struct fix_wide){0, 0};
            }
        }
    }
    return keeper ? &keeper->owed2 : NULL;
}

/* ------------------------------------------------------------------ led by joints */

/* True if a joint holds a body to a kinematic one that moves. */
static bool is_led(const struct step *s, uint32_t i)
{
    const struct joint_list *list = &s->w->rest.joints;
    const struct joint *j = &list->joints[i];

    return joint_holds(list, i) && j->b != JOINT_WORLD && body_travels(&s->w->bodies[j->b]);
}

uint32_t connect_find_led(const struct step *s, uint32_t first, uint32_t led)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (is_led(s, i) && s->w->bodies[j->a].island.lowest == first &&
            (led == ISLAND_END || j->b == led)) {
            return j->a;
        }
    }
    return ISLAND_END;
}

/* Stop the kinematic bodies that lead members. */
void connect_block_leaders(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        if (is_led(s, i) && connect_is_member(s, list->joints[i].a)) {
            step_block(s, list->joints[i].b, list->joints[i].a);
        }
    }
}

/* Stop the kinematic bodies that lead a group. True if any did. */
static bool block_group(struct step *s, uint16_t group)
{
    const struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (s->w->bodies[j->a].def.joined == group && joint_holds(list, i) &&
            connect_led_by(s, j)) {
            step_block(s, j->b, j->a);
            any = true;
        }
    }
    return any;
}

/*
 * Stop the kinematic bodies that lead others where these cannot go: after a solve, a joint of
 * theirs is off by more than some skins. True if any stopped.
 */
bool connect_yield(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!j->work.idle && j->work.torn) {
            any = block_group(s, s->w->bodies[j->a].def.joined) || any;
        }
    }
    return any;
}

/*
 * Mark bodies that hang on a stationary or kinematic body, or on the world, as grounded. Bodies
 * that hang on a moving kinematic body count as touched as well: its motion gives them energy, and
 * conserving theirs would hold it back.
 */
void connect_ground(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (joint_holds(list, i) && stands_fast(s, j->b)) {
            s->w->bodies[j->a].clock.grounded = true;
            s->w->bodies[j->a].clock.touched |= is_led(s, i);
        } else if (joint_holds(list, i) && stands_fast(s, j->a)) {
            s->w->bodies[j->b].clock.grounded = true;
        }
    }
}

/* Reset the quiet time of bodies that a kinematic one leads. */
void connect_keep_awake(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        if (is_led(s, i)) {
            s->next->bodies[list->joints[i].a].quiet = 0;
        }
    }
}

void connect_wake_led(struct carom_world *w, uint16_t body)
{
    for (uint32_t i = 0; i < w->rest.joints.count; i++) {
        if (joint_holds(&w->rest.joints, i) && w->rest.joints.joints[i].b == body) {
            world_wake_joint(w, &w->rest.joints.joints[i]);
        }
    }
}

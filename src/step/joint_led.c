/* SPDX-License-Identifier: MIT */
/* Kinematic bodies that lead others by joints, and bodies that hang on what stands. */
#include "connect.h"

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

        if (joint_holds(list, i) && connect_stands_fast(s, j->b)) {
            s->w->bodies[j->a].clock.grounded = true;
            s->w->bodies[j->a].clock.touched |= is_led(s, i);
        } else if (joint_holds(list, i) && connect_stands_fast(s, j->a)) {
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

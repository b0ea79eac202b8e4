/* SPDX-License-Identifier: MIT */
/*
 * connect - declarations shared by the files that step joints: connect.c chooses the joints and
 * ends a frame for them, joint_measure.c computes where they will be, joint_energy.c accounts for
 * their energy, joint_led.c for kinematic bodies that lead others by joints.
 */
#ifndef CAROM_SRC_STEP_CONNECT_H
#define CAROM_SRC_STEP_CONNECT_H

#include "../world/joints.h"
#include "parts.h"

/* True if a body of a joint moves and is awake. The world and kinematic bodies do not answer. */
static inline bool connect_answers(const struct step *s, uint16_t body)
{
    return body != JOINT_WORLD && s->w->bodies[body].def.moving && step_active(s, body);
}

/* The kinematic body of a joint while it moves; NULL: there is none. */
static inline const struct body *connect_led_by(const struct step *s, const struct joint *j)
{
    const struct body *b = j->b == JOINT_WORLD ? NULL : &s->w->bodies[j->b];

    return b && body_travels(b) && !b->clock.stands ? b : NULL;
}

/* True if a body of a joint is a member. */
static inline bool connect_is_member(const struct step *s, uint16_t body)
{
    return body != JOINT_WORLD && s->w->bodies[body].clock.member;
}

/* True if no impulse moves a side of a joint; a body that left the world stays where it did. */
static inline bool connect_stands_fast(const struct step *s, uint16_t i)
{
    return i == JOINT_WORLD || !s->w->bodies[i].def.moving || s->next->bodies[i].out;
}

/*
 * True if no contact held the bodies of a group or pressed them when the frame began, and all of them
 * are awake and moved on their paths. The end of the frame makes velocities agree with joints alone,
 * so it would press bodies that a contact holds into it.
 */
bool connect_group_is_free(const struct step *s, uint16_t group);
/* See struct step_joint_calls. */
int32_t connect_slice(const struct step *s, uint32_t i, int32_t left_q30);
bool connect_measure(struct step *s, enum joint_solve solve);
void connect_add_joints2(const struct step *s, uint32_t first, struct fix_wide *gained,
                         struct fix_wide *taken, struct fix_wide *kept);
struct fix_wide *connect_owed2(const struct step *s, uint32_t first);
void connect_conserve(struct step *s, uint32_t first, struct fix_wide *owed2);
uint32_t connect_find_led(const struct step *s, uint32_t first, uint32_t led);
void connect_block_leaders(struct step *s);
bool connect_yield(struct step *s);
void connect_ground(struct step *s);
void connect_keep_awake(struct step *s);
void connect_wake_led(struct carom_world *w, uint16_t body);

#endif

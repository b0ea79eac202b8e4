/* SPDX-License-Identifier: MIT */
/* joints - what the calls about joints and the step share of them. */
#ifndef CAROM_SRC_WORLD_JOINTS_H
#define CAROM_SRC_WORLD_JOINTS_H

#include "world.h"

struct joint_pose world_joint_pose(const struct body_state *states, uint16_t body);
/* CAROM_OK, or what is wrong with a drive. */
int world_check_drive(uint8_t kind, const struct carom_joint_drive *d);
/* Find which bodies joints connect, and which pairs ignore each other, after a joint came, went or broke. */
void world_group_joints(struct carom_world *w);
/*
 * The bodies of a joint that is about to hold nothing: where they ignored each other and overlap they pass each other
 * until they are apart. CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
int world_part_joint(struct carom_world *w, struct world_state *state, const struct joint *j);
/*
 * A joint is about to hold nothing. What its group is owed of energy was that of all of it, and would come back in the motion
 * of a part: it is gone with the joint.
 */
void world_write_off(const struct carom_world *w, struct joint_state *states,
                     const struct joint *j);
/* Take a joint away; groups are to be found anew. */
void world_drop_joint(struct carom_world *w, uint32_t joint);
/* Whether a state that was read could be what a step has left. */
bool world_joint_plausible(const struct joint *j, const struct joint_state *state);
void world_wake_joint(struct carom_world *w, const struct joint *j);

/*
 * Add a joint as one that was in another world, behind the last one; its state comes with a snapshot. One that is not used
 * is a free place. CAROM_OK; CAROM_ERR_FORMAT; CAROM_ERR_JOINTS_FULL. In src/step/joint_add.c.
 */
int step_restore_joint(struct carom_world *w, const struct joint *made);

#endif

/* SPDX-License-Identifier: MIT */
/* joints - what the calls about joints and the step share. */
#ifndef CAROM_SRC_WORLD_JOINTS_H
#define CAROM_SRC_WORLD_JOINTS_H

#include "world.h"

struct joint_pose world_joint_pose(const struct body_state *states, uint16_t body);
/* Check a drive. Returns CAROM_OK or the error. */
int world_check_drive(uint8_t kind, const struct carom_joint_drive *d);
/*
 * After a joint was added, removed or broken: find which bodies joints connect, and which pairs
 * ignore each other.
 */
void world_group_joints(struct carom_world *w);
/*
 * A joint is about to hold nothing. If its bodies ignored each other and overlap, let them pass
 * each other until they are apart. Returns CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
int world_part_joint(struct carom_world *w, struct world_state *state, const struct joint *j);
/*
 * A joint is about to hold nothing. Energy that its group is owed belonged to all of the group, and
 * would come back in the motion of a part: forget it.
 */
void world_write_off(const struct carom_world *w, struct joint_state *states,
                     const struct joint *j);
/* Remove a joint. Groups must be found anew. */
void world_drop_joint(struct carom_world *w, uint32_t joint);
/* True if a state that was read could be what a step has left. */
bool world_joint_plausible(const struct joint *j, const struct joint_state *state);
void world_wake_joint(struct carom_world *w, const struct joint *j);

/*
 * Add a joint as it was in another world, behind the last one; its state comes with a snapshot. A
 * joint that is not used is a free place. Returns CAROM_OK, CAROM_ERR_FORMAT or
 * CAROM_ERR_JOINTS_FULL. In src/step/joint_add.c.
 */
int step_restore_joint(struct carom_world *w, const struct joint *made);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * energy - the account of an island over a frame: energy.c keeps the rule of contact with it,
 * joint_energy.c that of joints.
 */
#ifndef CAROM_SRC_STEP_ENERGY_H
#define CAROM_SRC_STEP_ENERGY_H

#include "../solve/rigid.h"
#include "parts.h"

/* Twice the energies of an island, 80 fractional bits. */
struct step_account {
    struct fix_wide before, kinetic; /* of motion, at the start and the end of the frame */
    struct fix_wide left;  /* of bodies that left the world in the frame; not in kinetic */
    struct fix_wide taken; /* by limits and damping of joints */
    struct fix_wide kept;  /* by springs, at the start */
    /* gain over the energy at the start, less what was taken, and over what contact may lift */
    struct fix_wide excess;
};

/* Sum up what an island gained, with the bodies that left the world in this frame. */
struct step_account step_audit(const struct step *s, uint32_t first);
/* Sum up an island after the bodies that left it gave what it gained, as far as they have it. */
struct step_account step_settle_left(struct step *s, uint32_t first);
/*
 * Let a gain not count as far as limits and damping took it again: within the frame they also take
 * what solves gave. An island that nothing touched would owe energy that it never had; one in contact
 * would be put back in frame after frame, though it has no more energy than before.
 */
void step_forgive_taken(struct step_account *sum);
/* Twice the kinetic energy of an island beyond that of its motion as one rigid body. */
struct fix_wide step_beside2(const struct step *s, const struct rest_rigid *rigid,
                             const struct fix_wide *all);
/* Factor for momenta that takes `excess` out of a kinetic energy; 0 if that is not enough. */
int32_t step_factor_q30(const struct fix_wide *kinetic, const struct fix_wide *excess);
/* Undo the frame of an island, or slow it down where that cannot be. */
void step_undo(struct step *s, uint32_t first);

#endif

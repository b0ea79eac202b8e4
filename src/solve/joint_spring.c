/* SPDX-License-Identifier: MIT */
/*
 * A joint's spring over a part of the frame. Its impulse is the pull in the middle of this time, as
 * the velocity after the solve has it there, so a spring of any stiffness is stable where the paths
 * are straight. A stiff one swings far in a frame, and its bodies turn on the way: it pulls for a
 * shorter time, and the slices of its group end with it.
 */
#include "joint_parts.h"

/* An impulse by velocity as one of the lightest body's mass, in the row's units, 40 + bits. */
static int64_t by_mass(const struct joint_work *work, int64_t stiff_q40, int bits)
{
    int64_t k_q40 = fix_mul_scaled(stiff_q40, work->lightest->def.inverse_mass);

    return fix_bits((uint64_t)k_q40) + bits > 60 ? INT64_MAX >> 2 : fix_round_shift(k_q40, bits);
}

/*
 * part / (all + M), M being the joint's own impulse for a unit of velocity: 1 at most, and 0 where the
 * part rounds to none, though M may be 0 as well.
 */
static int32_t share_q30(const struct joint_work *work, int64_t part_q40, int64_t all_q40)
{
    int last = work->rows - 1, bits = -2 * joint_row_shift(work, last);
    int64_t own_q40 = carom_shl(work->inverse[last][last], 10);
    int64_t part = by_mass(work, part_q40, bits), all = by_mass(work, all_q40, bits);

    own_q40 = fix_round_shift(own_q40, 30 - work->inverse_bits);
    if (part == 0) {
        return 0;
    }
    return own_q40 == 0 ? CAROM_ONE_Q30
                        : (int32_t)fix_mul_scaled(CAROM_ONE_Q30, fix_ratio(part, all + own_q40));
}

/* Set the impulses by velocity of a spring over the time of its pull, without and with damping. */
static void stiffen(struct joint_work *work, const struct carom_joint_drive *d)
{
    int64_t own_q40 = fix_mul_q30(d->stiffness_q40, work->pull_q30);

    work->half_stiff_q40 =
        fix_mul_q30(own_q40, work->ahead_q30) + fix_mul_q30(own_q40, work->pull_q30) / 2;
    work->stiff_q40 = work->half_stiff_q40 + fix_mul_q30(d->damping_q40, work->pull_q30);
}

/*
 * The velocity that leads to no pull is off / t, which is out of proportion for a short time t. So a
 * pull that is short and soft does not depend on the velocity after the solve: soft is 0.
 */
void joint_prepare_spring(struct joint_work *work, const struct carom_joint_drive *d)
{
    struct fix_wide pull;
    struct fix_scaled loose; /* velocity that leads to no pull: q80 over q40 */
    int64_t speed_q40 = work->speed_q40[work->held], stiffness_q40;

    if (work->by_speed) {
        work->rate_q40 = speed_q40;
    }
    stiffen(work, d);
    while (work->pull_q30 >= 2 * JOINT_PULL_LEAST_Q30 &&
           share_q30(work, work->half_stiff_q40, work->stiff_q40) > JOINT_SWING_Q30) {
        work->pull_q30 /= 2;
        work->pull_most_q30 = work->pull_q30;
        /* weight changes a rate evenly, and half the time has half of that */
        work->rate_q40 = speed_q40 + (work->rate_q40 - speed_q40) / 2;
        stiffen(work, d);
    }
    work->halved = work->halved &&
                   share_q30(work, work->half_stiff_q40, work->stiff_q40) <= JOINT_SWING_MOST_Q30;
    stiffness_q40 = fix_mul_q30(d->stiffness_q40, work->pull_q30);
    if (work->halved) {
        stiffness_q40 /= 2;
        work->stiff_q40 -= work->half_stiff_q40 / 2;
        work->half_stiff_q40 -= work->half_stiff_q40 / 2;
    }
    work->elastic_q40 = joint_product_q40(stiffness_q40, work->off_q40) +
                        joint_product_q40(work->half_stiff_q40, work->rate_q40);
    work->law.soft_q30 = share_q30(work, work->stiff_q40, work->stiff_q40);
    work->spring_q40 = 0;
    if (work->pull_q30 < JOINT_PULL_LEAST_Q30 / 2 && work->law.soft_q30 <= JOINT_SWING_Q30) {
        work->stiff_q40 -= work->half_stiff_q40;
        work->half_stiff_q40 = 0;
        work->law.soft_q30 = 0;
    }
    if (work->law.soft_q30 > 0) {
        pull = fix_wide_mul(stiffness_q40, work->off_q40);
        loose = fix_wide_over(&pull, work->stiff_q40);
        work->spring_q40 = -work->rate_q40 - fix_mul_scaled(1, loose);
    }
}

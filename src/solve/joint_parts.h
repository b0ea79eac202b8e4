/* SPDX-License-Identifier: MIT */
/*
 * joint_parts - what the files that solve joints share. Each function is about one joint unless it
 * takes the island; parts.h says what is called when.
 */
#ifndef CAROM_SRC_JOINT_PARTS_H
#define CAROM_SRC_JOINT_PARTS_H

#include "parts.h"

/* Set levers and K^-1; `lightest` gives the unit of mass. */
bool joint_prepare(struct joint *j, const struct carom_joint_drive *drive,
                   const struct body *lightest);
/* Set the law of a spring, and how long it pulls. */
void joint_prepare_spring(struct joint_work *work, const struct carom_joint_drive *d);
/*
 * The change of V of row i of a by an impulse of 1 along row k of b, in the format q: an entry of K
 * if a and b are the same joint. In q60, for rows that are scaled, it is exact but for two units,
 * so that a row that repeats others leaves a pivot of next to nothing.
 */
int64_t joint_entry(const struct joint_work *a, int i, const struct joint_work *b, int k, int q);
/*
 * Factor the matrix of all held rows of the island; false if the room is too small. Solve with the
 * factors; returns how much a velocity moved.
 */
bool joint_factor(struct rest *r);
int64_t joint_solve_held(struct rest *r, int32_t quiet);
/* V - wanted V of a row now, or V of the last row. joint_push applies changes of impulses. */
int32_t joint_present(const struct joint_work *work, int row);
void joint_push(struct joint_work *work, const int64_t change[JOINT_ROWS]);
/*
 * Parts of joint_push. Effects on a body are summed modulo 2^64: a light body between heavy ones is
 * pushed hard from both sides, and the sum is short though the pushes are long.
 */
struct joint_sum {
    uint64_t way[3], turn[3];
};
void joint_note(struct joint_work *work, const int64_t change[JOINT_ROWS]);
void joint_add_effect(const struct joint_work *work, int side, const int64_t change[JOINT_ROWS],
                      struct joint_sum *sum);
/* Round a sum to units of dv and du; add it to the body's velocity. */
void joint_round_sum(const struct body *b, const struct joint_sum *sum, int64_t dv[3],
                     int64_t du[3]);
void joint_move(struct body *b, const struct joint_sum *sum);
/* V of a row, q40; the part of it that a kinematic body contributes. */
int64_t joint_speed_q40(const struct joint_work *work, int row);
int64_t joint_led_speed_q40(const struct joint_work *work, int row);
int64_t joint_largest_q40(const struct joint *j);
void joint_begin(struct joint *j, const struct joint_state *state, const struct rest_sweep *sw);
void joint_load(struct joint *j, const struct joint_state *state, const struct rest_sweep *sw);
void joint_sum_up(struct rest *r);
int64_t joint_sweep(struct joint *j, int32_t quiet);
void joint_end(struct joint *j, const struct rest_sweep *sw);
void joint_apply(struct rest *r, const struct joint *j);

/* Bits by which a row's velocities are scaled. */
static inline int joint_row_shift(const struct joint_work *work, int row)
{
    return joint_is_angular(work, row) ? work->length_bits - 22 : -work->down;
}

/* v, clamped to +-2^bits: keeps numbers that no world in range reaches from wrapping. */
static inline int64_t joint_limited(int64_t v, int bits)
{
    const int64_t most = (int64_t)1 << bits;

    return v > most ? most : v < -most ? -most : v;
}

#endif

/* SPDX-License-Identifier: MIT */
/* The energy of joints over a frame, and the rule that they conserve it. */
#include "connect.h"
#include "energy.h"

/* Joints may keep a gain of 2^-11 of the energy, the accuracy of their solve over a frame. */
#define JOINT_SLACK_BITS 11

/* The island of a joint: that of the side which moves, or of either. */
static uint32_t island_of(const struct step *s, const struct joint *j)
{
    uint16_t side = connect_stands_fast(s, j->a) && j->b != JOINT_WORLD ? j->b : j->a;

    return s->w->bodies[side].island.lowest;
}

/*
 * How far a spring is from the place where it is loose, q40, for its energy. Beyond a limit it counts no less than at the
 * limit. Else a spring that drew its joint past the limit would give energy, and no motion that is
 * left could bring the joint back.
 */
static int64_t stretch_q40(const struct carom_joint_drive *d, int64_t coordinate_q40)
{
    const int64_t lower_q40 = carom_shl(d->lower_q32, 8), upper_q40 = carom_shl(d->upper_q32, 8);
    const int64_t loose_q40 = carom_shl(d->rest_q32, 8);
    int64_t held_q40 = coordinate_q40;

    if (d->limited && coordinate_q40 < lower_q40) {
        held_q40 = lower_q40;
    } else if (d->limited && coordinate_q40 > upper_q40) {
        held_q40 = upper_q40;
    }
    coordinate_q40 -= loose_q40;
    held_q40 -= loose_q40;
    return carom_abs(coordinate_q40) < carom_abs(held_q40) ? held_q40 : coordinate_q40;
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
    x_q40 = stretch_q40(&state->drive, error.coordinate_q40);
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

/* True if an energy must grow by more than STEP_CONSERVE_MOST_Q30 gives: (9 / 8)^2 - 1 of it. */
static bool lacks_much(const struct fix_wide *energy, const struct fix_wide *owed2)
{
    struct fix_wide sum = fix_wide_down(energy, 2), more = fix_wide_down(energy, 6);

    fix_wide_add(&sum, &more);
    fix_wide_add(&sum, owed2);
    return fix_wide_sign(&sum) < 0;
}

/*
 * True if a frame lost more than a quarter of the energy that moved in it: bodies set out against
 * their joints, or what they hung on stopped. That is an impact, and nothing to be given back.
 */
static bool is_snatched(const struct step_account *sum)
{
    struct fix_wide moved = sum->before, most;

    fix_wide_subtract(&moved, &sum->kinetic);
    fix_wide_add(&moved, &sum->excess); /* what height and springs took up */
    if (fix_wide_sign(&moved) < 0) {
        most = (struct fix_wide){0, 0};
        fix_wide_subtract(&most, &moved);
        moved = most;
    }
    fix_wide_add(&moved, &sum->before);
    most = fix_wide_down(&moved, 2);
    fix_wide_add(&most, &sum->excess);
    return fix_wide_sign(&most) < 0;
}

/*
 * True if an island owes more than the accuracy of joints explains: half of the height that contact
 * may lift, and a part of its energy.
 */
static bool owes_much(const struct step *s, uint32_t first, const struct step_account *sum,
                      const struct fix_wide *owed2)
{
    struct fix_wide energy = sum->before, over = *owed2, slack;

    fix_wide_add(&energy, &sum->kept);
    slack = fix_wide_down(&energy, JOINT_SLACK_BITS);
    fix_wide_subtract(&over, &slack);
    fix_wide_shift_up(&over, 1);
    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        body_add_lift2(&over, &s->w->bodies[i], -1);
    }
    return fix_wide_sign(&over) > 0;
}

/*
 * Take what an island owes out of its motion, or give back what it lacks, as far as the motion
 * allows; `sum` has what the frame added.
 */
static void pay(struct step *s, uint32_t first, const struct step_account *sum,
                struct fix_wide *owed2)
{
    bool grounded = s->w->bodies[first].clock.grounded;
    struct fix_wide energy = sum->kinetic;
    struct step_account now;
    struct rest_rigid rigid;
    int32_t factor_q30, least_q30;

    if (!grounded) {
        if (rest_is_alone(&s->w->rest, first) || !rest_rigid_motion(&s->w->rest, first, &rigid)) {
            return;
        }
        energy = step_beside2(s, &rigid, &sum->kinetic);
    }
    if (fix_wide_sign(&energy) <= 0 || fix_wide_sign(owed2) == 0) {
        return;
    }
    factor_q30 =
        lacks_much(&energy, owed2) ? STEP_CONSERVE_MOST_Q30 : step_factor_q30(&energy, owed2);
    /* the gain of this frame goes at once, whatever is left: a limit may have given it */
    least_q30 =
        fix_wide_sign(&sum->excess) > 0 ? step_factor_q30(&energy, &sum->excess) : CAROM_ONE_Q30;
    factor_q30 = fix_larger(factor_q30, fix_smaller(least_q30, STEP_CONSERVE_LEAST_Q30));
    if (grounded) {
        rest_scale_grounded(&s->w->rest, first, factor_q30);
    } else {
        rest_scale_free(&s->w->rest, &rigid, factor_q30);
    }
    now = step_audit(s, first);
    fix_wide_add(owed2, &now.kinetic);
    fix_wide_subtract(owed2, &sum->kinetic);
}

/*
 * Conserve the energy of an island that nothing touched: joints do no work, only motors do (audit
 * counts what springs store), and limits and damping may take some. What the motion cannot pay is
 * owed: a pendulum that turns back has hardly any. True if the frame left so large a debt that it
 * must be undone.
 */
static FIX_OWN_FRAME bool conserve_island(struct step *s, uint32_t first, struct fix_wide *owed2)
{
    struct step_account sum = step_settle_left(s, first);
    struct fix_wide grown = *owed2;

    step_forgive_taken(&sum);
    if (!is_snatched(&sum)) {
        fix_wide_add(owed2, &sum.excess);
    }
    pay(s, first, &sum, owed2);
    fix_wide_subtract(&grown, owed2);
    return fix_wide_sign(&grown) < 0 && owes_much(s, first, &sum, owed2);
}

/*
 * Set the debt of an island that nothing touched after its frame was undone; `owed2` is that before
 * the frame.
 */
static FIX_OWN_FRAME void settle_undone(const struct step *s, uint32_t first,
                                        struct fix_wide *owed2)
{
    struct step_account sum = step_audit(s, first);

    fix_wide_add(owed2, &sum.excess);
    fix_wide_subtract(owed2, &sum.taken); /* in the frame that is undone */
    if (fix_wide_sign(owed2) < 0) {
        *owed2 = (struct fix_wide){0, 0};
    }
}

/* Conserve the energy of an island that nothing touched; `owed2` is what it owes. */
void connect_conserve(struct step *s, uint32_t first, struct fix_wide *owed2)
{
    struct fix_wide before = *owed2;

    if (conserve_island(s, first, owed2)) {
        *owed2 = before;
        step_undo(s, first);
        settle_undone(s, first, owed2);
    }
}

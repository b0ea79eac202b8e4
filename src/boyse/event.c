/* SPDX-License-Identifier: MIT */
/* From a root back to its event: the last time at which the gap is still the event gap. */
#include "event.h"

/* An event's time is found when the gap is within this of the wanted one. */
#define EVENT_SLACK_Q22 4
/* More than any value of P. */
#define BEYOND ((int32_t)1 << 30)

/* A time, and the opening less the wanted one there. */
struct sample {
    int32_t t_q30, excess;
};

static int32_t open_at(const struct opening *o, int32_t t_q30)
{
    int32_t p = curve_at(o->curve, t_q30);

    return o->sign < 0 ? -p : p;
}

/* N(t) of a path less 1. Products of both norms are left out where only one body turns. */
static int32_t growth_q30(const struct body_path *path, int32_t t_q30, int32_t t2_q30)
{
    return path->turns
               ? carom_mul_q30(body_norm2_q30(path), t2_q30) + 2 * carom_mul_q30(path->c_q30, t_q30)
               : 0;
}

/* scale N_a(t) N_b(t), q30: below 1.7 */
static int32_t factor_q30(const struct boyse_pair *pair, int32_t t_q30, int32_t scale_q30)
{
    int32_t t2_q30 = carom_mul_q30(t_q30, t_q30);

    scale_q30 += carom_mul_q30(scale_q30, growth_q30(body_path(pair->a), t_q30, t2_q30));
    return scale_q30 + carom_mul_q30(scale_q30, growth_q30(body_path(pair->b), t_q30, t2_q30));
}

static int32_t limited(int64_t v)
{
    return v < BEYOND ? v > -BEYOND ? (int32_t)v : -BEYOND : BEYOND;
}

/* Set wanted and slack: the event gap in P, for edges at an angle of sine `scale`. */
static void set_wanted(struct opening *o, int32_t t_q30, int32_t scale_q30)
{
    int32_t factor = factor_q30(o->pair, t_q30, scale_q30);
    int64_t gap_q40 = (int64_t)factor * (o->pair->skin_q22 / 2) >> 12;

    o->wanted = limited(curve_units(o->curve, gap_q40) - o->shift);
    o->slack = limited(curve_units(o->curve, factor >> (12 - 2)) + 1);
}

static struct sample sample_at(struct opening *o, int32_t t_q30)
{
    if (o->by_time) {
        set_wanted(o, t_q30, o->edges ? boyse_scale(o->pair, t_q30) : CAROM_ONE_Q30);
    }
    return (struct sample){t_q30, open_at(o, t_q30) - o->wanted};
}

/*
 * Find a time between `far` (opening above wanted) and `near` (below) whose opening is above wanted
 * by at most the slack: secants, bisection when they gain little.
 */
static int32_t narrow_down(struct opening *o, struct sample far, struct sample near)
{
    for (int round = 0; near.t_q30 - far.t_q30 > 1 && far.excess > o->slack; round++) {
        int32_t width = near.t_q30 - far.t_q30, step = width / 2;
        struct sample s;

        if (round % 3 != 2) {
            /* aim at the middle of the slack, so that the next sample is still far but close */
            uint32_t part_q30 = curve_quotient_q30((uint32_t)(far.excess - o->slack / 2),
                                                   (uint32_t)far.excess - (uint32_t)near.excess);

            /* below the width: the part is below 1, since near's excess is below 0 */
            step = (int32_t)((uint64_t)part_q30 * (uint32_t)width >> 30);
            step = step < 1 ? 1 : step;
        }
        s = sample_at(o, far.t_q30 + step);
        if (s.excess >= 0) {
            far = s;
        } else {
            near = s;
        }
    }
    return far.t_q30;
}

/* The time of the widest opening, of 33 samples between two roots. */
static int32_t widest(const struct opening *o, int32_t from, int32_t root, int32_t *open)
{
    int32_t best = from;

    *open = open_at(o, from);
    for (int k = 0; k < 32; k++) {
        int32_t t_q30 = from + (int32_t)((int64_t)(root - from) * (2 * k + 1) >> 6);
        int32_t there = open_at(o, t_q30);

        if (there > *open) {
            *open = there;
            best = t_q30;
        }
    }
    return best;
}

/*
 * The time of half the largest opening, which is at `far`, for features that never open by the
 * event gap; no less than their opening at the start. 0 if they never open.
 */
static int32_t half_open(struct opening *o, int32_t from, int32_t far, int32_t open, int32_t root)
{
    int32_t start = from == 0 ? open_at(o, 0) : 0;

    if (open <= 0) {
        return 0;
    }
    o->wanted = open > o->shift ? limited((open - o->shift) / 2) : 0;
    o->wanted = o->wanted < start ? start : o->wanted;
    o->by_time = false;
    return narrow_down(o, (struct sample){far, open - o->wanted},
                       (struct sample){root, o->wanted > 0 ? -o->wanted : -1});
}

/* Search for the event, first `back` before the root. */
static int32_t search(struct opening *o, int32_t from, struct sample root, uint32_t back)
{
    struct sample far, near = root;

    for (;;) {
        far =
            sample_at(o, back < (uint32_t)(root.t_q30 - from) ? root.t_q30 - (int32_t)back : from);
        if (far.excess >= 0 || far.t_q30 == from) {
            break;
        }
        near = far;
        back *= 2;
    }
    if (far.excess < 0) {
        int32_t open, time = widest(o, from, root.t_q30, &open);

        /* wanted at that time decides whether they open far enough, not wanted at the root */
        o->by_time = true;
        far = sample_at(o, time);
        near = root;
        if (far.excess < 0) {
            return half_open(o, from, time, open, root.t_q30);
        }
    }
    return narrow_down(o, far, near);
}

/*
 * True if wanted, dt before the root, differs so much from wanted at the root that the event gap is
 * off by half the slack. The norm factors change by up to 2 (c + c^2 + s^2) dt of themselves, c and
 * s of both bodies; |w| changes by up to 2 (s_a + s_b) dt. For edges both have the factor |w|.
 */
static bool time_matters(const struct opening *o, int32_t scale_q30, int32_t dt_q30)
{
    const struct body_path *a = body_path(o->pair->a), *b = body_path(o->pair->b);
    int32_t squares_q30 = body_norm2_q30(a) + body_norm2_q30(b) + a->c_q30 + b->c_q30;
    int32_t change_q30 = carom_mul_q30(2 * squares_q30, dt_q30);

    if (o->edges) {
        change_q30 =
            carom_mul_q30(change_q30, scale_q30) + carom_mul_q30(o->pair->turn_q30, dt_q30);
    }
    return (int64_t)change_q30 * (o->pair->skin_q22 / 2) >
           (int64_t)scale_q30 * (EVENT_SLACK_Q22 / 2);
}

int32_t boyse_event_q30(struct opening *o, int32_t from, const struct walk *root, int32_t scale_q30)
{
    int32_t steep8 = fix_abs32(root->slope8), missing, t_q30;
    struct sample met = {root->t_q30, 0};
    uint32_t back;

    o->by_time = false;
    set_wanted(o, root->t_q30, scale_q30);
    missing = o->wanted - (o->sign < 0 ? -root->p : root->p);
    missing = missing > 0 ? missing : 1;
    met.excess = -missing;
    /* first guess: the missing opening at the closing speed of the root, and a little more */
    back =
        curve_quotient_q30((uint32_t)missing + (uint32_t)o->slack / 2, (uint32_t)steep8 + 1) >> 3;
    t_q30 = search(o, from, met, back < 64 ? 64 : back);
    if (!o->by_time && time_matters(o, scale_q30, root->t_q30 - t_q30)) {
        o->by_time = true;
        t_q30 = search(o, from, met, (uint32_t)(root->t_q30 - t_q30) + 64);
    }
    return t_q30;
}

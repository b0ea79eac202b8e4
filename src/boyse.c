/* SPDX-License-Identifier: MIT */
/* Roots of P(t), and the time to stop at before the first that is a hit. */
#include "boyse.h"

/*
 * A pair that starts clear of contact is followed to a surface this much nearer (see boyse_first).
 */
#define ROOT_LEVEL_Q22  3
#define ROOT_BITS       27 /* of the largest coefficient */
#define ROOT_NOISE      4  /* Horner's rounding, in the units of the coefficients */
#define ROOT_STRIDE_Q30 16
#define ROOT_ROUNDS     300 /* never reached: strides grow twofold */

struct quartic {
    int32_t a[5];
    int64_t bend; /* a bound of |P''| on [0, 1] */
    int shift;    /* a = a_q40 / 2^shift */
};

static void quartic_at(const struct quartic *q, int32_t t_q30, int64_t *p, int64_t *slope)
{
    int64_t v = q->a[4], d = 4 * (int64_t)q->a[4];

    for (int k = 3; k >= 0; k--) {
        v = (v * t_q30 >> 30) + q->a[k];
    }
    for (int k = 3; k >= 1; k--) {
        d = (d * t_q30 >> 30) + k * (int64_t)q->a[k];
    }
    *p = v;
    *slope = d;
}

/*
 * Scale the coefficients to ROOT_BITS. False when P keeps its sign on [0, 1] because its constant
 * term outweighs all others: nearly every candidate ends here.
 */
static bool quartic_init(struct quartic *q, int64_t a[5])
{
    uint64_t all = 0;
    int64_t reach = 0;

    for (int k = 1; k < 5; k++) {
        reach += carom_abs(a[k]);
    }
    if (carom_abs(a[0]) > reach + (reach >> 20) + ((int64_t)1 << 16)) {
        return false;
    }
    for (int k = 0; k < 5; k++) {
        all |= (uint64_t)carom_abs(a[k]);
    }
    q->shift = fix_bits(all) - ROOT_BITS;
    if (all == 0) {
        return false;
    }
    for (int k = 0; k < 5; k++) {
        q->a[k] = q->shift > 0 ? (int32_t)carom_round(a[k], q->shift)
                               : (int32_t)carom_shl(a[k], -q->shift);
    }
    q->bend = 2 * carom_abs(q->a[2]) + 6 * carom_abs(q->a[3]) + 12 * carom_abs(q->a[4]) + 1;
    return true;
}

/*
 * The farthest step from t that cannot pass a root: |P| + slope s - bend s^2 / 2 = 0, slope being
 * that of |P|. Terms: |P| < 2^30, |slope| < 2^31, bend < 2^32, so the discriminant is below 2^64.
 */
static int64_t safe_step_q30(int64_t p, int64_t slope, int64_t bend)
{
    int64_t size = carom_abs(p), d = p >= 0 ? slope : -slope;
    int64_t root = (int64_t)fix_sqrt((uint64_t)(d * d) + 2 * (uint64_t)(bend * size)) + 1;
    int64_t step;

    if (d >= 0) {
        step = (d + root - 1) * CAROM_ONE_Q30 / bend;
    } else {
        step = 2 * size * CAROM_ONE_Q30 / (root - d);
    }
    return step;
}

/* A walk over the roots of P in order of time. */
struct walk {
    int32_t t_q30;
    int32_t side;   /* sign of P before, 0 when it is not known */
    int64_t stride; /* least step over a root that is not a hit, q30 */
    int64_t p_step; /* the safe step from where the walk stands */
    int64_t slope;  /* of P there */
    int rounds;
};

static void advance(struct walk *w, int64_t step_q30)
{
    w->t_q30 = step_q30 < CAROM_ONE_Q30 - w->t_q30 ? w->t_q30 + (int32_t)step_q30 : CAROM_ONE_Q30;
}

/* Go on to the next root, or to within the rounding of one; false when there is none up to 1. */
static bool next_root(struct walk *w, const struct quartic *q)
{
    while (w->t_q30 < CAROM_ONE_Q30 && w->rounds++ < ROOT_ROUNDS) {
        int32_t side;
        int64_t p;
        bool crossed;

        quartic_at(q, w->t_q30, &p, &w->slope);
        w->p_step = safe_step_q30(p, w->slope, q->bend);
        side = carom_abs(p) <= ROOT_NOISE ? 0 : p > 0 ? 1 : -1;
        /* rounding may carry t across a root: a change of sign is one as well */
        crossed = side != 0 && side == -w->side;
        if (side != 0) {
            w->side = side;
        }
        if (side == 0 || w->p_step <= 1 || crossed) {
            return true;
        }
        advance(w, w->p_step);
        w->stride = ROOT_STRIDE_Q30;
    }
    return false;
}

/*
 * Step over a root that is not a hit, in growing strides while P stays in the noise. The sign
 * beyond it is a new one, not a root passed by.
 */
static void step_over(struct walk *w)
{
    w->side = 0;
    if (w->p_step < w->stride) {
        advance(w, w->stride);
        w->stride *= 2;
    } else {
        advance(w, w->p_step);
        w->stride = ROOT_STRIDE_Q30;
    }
}

/* ---------------------------------------------------------------- event time */

/*
 * The last time before the root at which the gap equals the event gap (half the skin), searched
 * back no further than `from`, the root before. A pair that never opens that far in between gets
 * half of its largest opening; one that is never open gets 0.
 *
 * The search is on the gap of the true, rounded poses, so that what is committed is what was
 * tested.
 */
static int32_t event_time(const struct boyse_pair *pair, const struct candidate *c, int32_t from,
                          int32_t root, int64_t slope_q40, int sign)
{
    int32_t wanted = pair->skin_q22 / 2, open = from, closed = root, best = 0;
    int64_t back;

    /* first guess: twice the way at the closing speed of the root */
    slope_q40 = carom_abs(slope_q40) + 1;
    back = ((int64_t)wanted << 19) / ((slope_q40 >> 30) + 1);
    if (back < 64) {
        back = 64;
    }
    for (;;) {
        int32_t t = back < root - from ? root - (int32_t)back : from;

        best = boyse_gap(pair, c, t, sign);
        open = t;
        if (best > wanted || t == from) {
            break;
        }
        closed = t;
        back *= 2;
    }
    if (best <= wanted) {
        closed = root;
        for (int k = 0; k < 32 && best <= wanted; k++) {
            int32_t t = from + (int32_t)((int64_t)(root - from) * (2 * k + 1) >> 6);
            int32_t gap = boyse_gap(pair, c, t, sign);

            if (gap > best) {
                best = gap;
                open = t;
            }
        }
        if (best <= 0) {
            return 0;
        }
        if (best <= wanted) {
            wanted = best / 2;
        }
    }
    while (closed - open > 1) {
        int32_t t = open + (closed - open) / 2;

        if (boyse_gap(pair, c, t, sign) > wanted) {
            open = t;
        } else {
            closed = t;
        }
    }
    return open;
}

/* A pair that already touches or overlaps at the start and still approaches. */
static bool touches_at_start(const struct boyse_pair *pair, const struct candidate *c,
                             int64_t slope, struct boyse_hit *hit)
{
    int32_t gap = boyse_gap(pair, c, 0, 1);

    if (carom_abs(gap) >= pair->skin_q22 / 2) {
        return false;
    }
    boyse_touch(pair, c, 0, &hit->touch);
    hit->t_q30 = 0;
    return hit->touch.valid && hit->touch.sign * slope < 0 && hit->touch.gap_q22 <= 0;
}

bool boyse_first(const struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots)
{
    const int64_t level = (int64_t)ROOT_LEVEL_Q22 << 18;
    struct walk walk = {0, 0, ROOT_STRIDE_Q30, 0, 0, 0};
    struct quartic q;
    int64_t a[5];
    int32_t last_root = 0;

    boyse_polynomial(pair, c, a);
    /*
     * A frame may end with a gap so small that there is no root on [0, 1], and rounding would then
     * commit an overlap: look for the root of a surface a little nearer.
     */
    if (a[0] > 2 * level) {
        a[0] -= level;
    } else if (a[0] < -2 * level && c->kind == CANDIDATE_EDGE_EDGE) {
        a[0] += level;
    }
    if (!quartic_init(&q, a)) {
        return false;
    }
    ++*roots;
    if (touches_at_start(pair, c, a[1], hit)) {
        return true;
    }
    while (next_root(&walk, &q)) {
        boyse_touch(pair, c, walk.t_q30, &hit->touch);
        if (hit->touch.valid && hit->touch.sign * walk.slope < 0) {
            int64_t slope_q40 =
                q.shift > 0 ? carom_shl(walk.slope, q.shift) : walk.slope >> -q.shift;

            hit->t_q30 = event_time(pair, c, last_root, walk.t_q30, slope_q40, hit->touch.sign);
            return true;
        }
        last_root = walk.t_q30;
        step_over(&walk);
    }
    return false;
}

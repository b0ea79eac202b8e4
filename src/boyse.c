/* SPDX-License-Identifier: MIT */
/* Roots of P(t), and the time to stop at before the first that is a hit. */
#include "boyse_place.h"

/*
 * A pair that starts clear of contact is followed to a surface this much nearer (see boyse_first).
 */
#define ROOT_LEVEL_Q22  3
#define ROOT_BITS       29 /* of the largest coefficient */
#define ROOT_NOISE      12 /* Horner's rounding, in the units of the coefficients */
#define ROOT_STRIDE_Q30 16
#define ROOT_ROUNDS     300 /* never reached: strides grow twofold */
/* The time of an event is found when the gap is within this of the wanted one. */
#define EVENT_SLACK_Q22 4

/* P with its coefficients in 32 bits. */
struct curve {
    int32_t a[BOYSE_DEGREE + 1];
    int degree;
    int shift;    /* a = a_q40 / 2^shift */
    int64_t bend; /* a bound of |P''| / 2 on [0, 1] */
};

static void curve_at(const struct curve *q, int32_t t_q30, int64_t *p, int64_t *slope)
{
    int64_t v = q->a[q->degree], d = 0;

    for (int k = q->degree - 1; k >= 0; k--) {
        d = (d * t_q30 >> 30) + v;
        v = (v * t_q30 >> 30) + q->a[k];
    }
    *p = v;
    *slope = d;
}

/* A number of q40 in the units of a curve. */
static int64_t to_units(const struct curve *q, int64_t v_q40)
{
    return q->shift > 0 ? carom_round(v_q40, q->shift) : carom_shl(v_q40, -q->shift);
}

/*
 * Scale the coefficients to ROOT_BITS. False when P keeps its sign on [0, 1] because its constant
 * term outweighs all others.
 */
static bool curve_init(struct curve *q, const int64_t a[BOYSE_DEGREE + 1], int degree)
{
    uint64_t all = (uint64_t)carom_abs(a[0]);
    int64_t reach = 0;

    for (int k = 1; k <= degree; k++) {
        reach += carom_abs(a[k]);
        all |= (uint64_t)carom_abs(a[k]);
    }
    if (all == 0 || carom_abs(a[0]) > reach + (reach >> 20) + ((int64_t)1 << 16)) {
        return false;
    }
    q->shift = fix_bits(all) - ROOT_BITS;
    q->degree = degree;
    q->bend = 1;
    for (int k = 0; k <= degree; k++) {
        q->a[k] = (int32_t)to_units(q, a[k]);
        q->bend += k * (k - 1) / 2 * carom_abs(q->a[k]);
    }
    return true;
}

/*
 * The farthest step that cannot pass a root when |P| is at least size + d s + c s^2 from here on:
 * to the first root of that, q30. Never: more than 1.
 * Terms: with seven coefficients up to 2^29, size < 2^32, |d| < 2^34 and |c| < 2^35; less four bits,
 * rounded to the safe side, the discriminant is below 2^60 + 2^62.
 */
#define NEVER_Q30 ((int64_t)2 * CAROM_ONE_Q30)

static int64_t safe_step_q30(int64_t size, int64_t d, int64_t c)
{
    int64_t square, rest, root;

    size >>= 4;
    d >>= 4;
    c >>= 4;
    square = d * d;
    rest = 4 * carom_abs(c) * size;
    if (c >= 0 && (d >= 0 || rest > square)) {
        return NEVER_Q30;
    }
    root = fix_sqrt_above((uint64_t)(c >= 0 ? square - rest : square + rest));
    /* as 2 size / (root - d) where that does not cancel: a root too large makes it short */
    if (d < 0 || root - d > root / 2) {
        return 2 * size * CAROM_ONE_Q30 / (root - d);
    }
    root -= root >> 13;
    return (d + root) * (CAROM_ONE_Q30 / 2) / -c;
}

/* A walk over the roots of P in order of time. */
struct walk {
    int32_t t_q30;
    int32_t side;     /* sign of P before, 0 when it is not known */
    int64_t stride;   /* least step over a root that is not a hit, q30 */
    int64_t p, slope; /* P and its slope where the walk stands */
    int rounds;
};

static void advance(struct walk *w, int64_t step_q30)
{
    w->t_q30 = step_q30 < CAROM_ONE_Q30 - w->t_q30 ? w->t_q30 + (int32_t)step_q30 : CAROM_ONE_Q30;
}

/*
 * From the start all of P is known: |P| >= |a0| + d t + (a2 - rest) t^2, rest being the sum of the
 * higher coefficients.
 */
static void begin_walk(struct walk *w, const struct curve *q)
{
    int64_t rest = 0;
    int sign = q->a[0] < 0 ? -1 : 1;

    *w = (struct walk){.stride = ROOT_STRIDE_Q30};
    if (carom_abs(q->a[0]) > ROOT_NOISE) {
        for (int k = 3; k <= q->degree; k++) {
            rest += carom_abs(q->a[k]);
        }
        w->side = sign;
        advance(w, safe_step_q30(sign * q->a[0] - ROOT_NOISE / 2, sign * q->a[1],
                                 sign * q->a[2] - rest));
    }
}

static int64_t walk_step_q30(const struct walk *w, const struct curve *q)
{
    return w->p < 0 ? safe_step_q30(-w->p, -w->slope, -q->bend)
                    : safe_step_q30(w->p, w->slope, -q->bend);
}

/*
 * The end of the way to a root: where P's slope alone leads to it and its bend changes nothing that
 * is above the noise, q30. 0: not yet.
 */
static int64_t last_step_q30(const struct walk *w, const struct curve *q)
{
    int64_t size = carom_abs(w->p), fall = w->p < 0 ? w->slope : -w->slope, step;

    if (fall <= 0 || size > fall >> 8) {
        return 0;
    }
    step = size * CAROM_ONE_Q30 / fall;
    return (q->bend * step >> 30) * step >> 30 < ROOT_NOISE / 2 ? step : 0;
}

/* Go on to the next root, or to within the rounding of one; false when there is none up to 1. */
static bool next_root(struct walk *w, const struct curve *q)
{
    while (w->t_q30 < CAROM_ONE_Q30 && w->rounds++ < ROOT_ROUNDS) {
        int32_t side;
        int64_t step;
        bool crossed;

        curve_at(q, w->t_q30, &w->p, &w->slope);
        side = carom_abs(w->p) <= ROOT_NOISE ? 0 : w->p > 0 ? 1 : -1;
        /* rounding may carry t across a root: a change of sign is one as well */
        crossed = side != 0 && side == -w->side;
        if (side != 0) {
            w->side = side;
        }
        if (side == 0 || crossed) {
            return true;
        }
        step = last_step_q30(w, q);
        if (step > 0) {
            advance(w, step);
            w->p = 0;
            return w->t_q30 < CAROM_ONE_Q30;
        }
        step = walk_step_q30(w, q);
        if (step <= 1) {
            return true;
        }
        advance(w, step);
        w->stride = ROOT_STRIDE_Q30;
    }
    return false;
}

/*
 * Step over a root that is not a hit. Where P is steep, |P| >= |slope| s - bend s^2 less the noise
 * holds beyond it, which at half of slope / bend is above the noise and was since the root. Else in
 * growing strides while P stays in the noise. The sign beyond is a new one, not a root passed by.
 */
static void step_over(struct walk *w, const struct curve *q)
{
    int64_t steep = carom_abs(w->slope) >> 4, step;

    w->side = 0;
    if (steep * steep > (ROOT_NOISE * q->bend) >> 4) {
        step = steep * CAROM_ONE_Q30 * 8 / q->bend;
    } else {
        step = walk_step_q30(w, q);
    }
    if (step < w->stride) {
        advance(w, w->stride);
        w->stride *= 2;
    } else {
        advance(w, step);
        w->stride = ROOT_STRIDE_Q30;
    }
}

/* ---------------------------------------------------------------- event time */

/*
 * How far features are open: P, with the sign that it has while they are, in the units of the
 * curve. Wanted is what the event gap comes to in it, and shift by how much it is less than it
 * should be.
 */
struct opening {
    const struct curve *curve;
    int sign;
    int64_t wanted, slack, shift;
};

/* A time and how far the features are open at it. */
struct sample {
    int32_t t_q30;
    int64_t open;
};

static struct sample sample_at(const struct opening *o, int32_t t_q30)
{
    int64_t p, slope;

    curve_at(o->curve, t_q30, &p, &slope);
    return (struct sample){t_q30, o->sign * p};
}

/*
 * Between a time at which the features are farther apart than wanted and a later one at which they
 * are not, find one at which they are as wanted, or farther by no more than the slack: by secants,
 * halving when they gain little.
 */
static int32_t narrow_down(const struct opening *o, struct sample far, struct sample near)
{
    for (int round = 0; near.t_q30 - far.t_q30 > 1 && far.open - o->wanted > o->slack; round++) {
        int64_t width = near.t_q30 - far.t_q30, step = width / 2;
        struct sample s;

        if (round % 3 != 2) {
            /* aim at the middle of the slack, so that the next time is far and close */
            step = width * (far.open - o->wanted - o->slack / 2) / (far.open - near.open);
            step = step < 1 ? 1 : step >= width ? width - 1 : step;
        }
        s = sample_at(o, far.t_q30 + (int32_t)step);
        if (s.open >= o->wanted) {
            far = s;
        } else {
            near = s;
        }
    }
    return far.t_q30;
}

/* The widest opening of 33 samples between two roots. */
static struct sample widest(const struct opening *o, int32_t from, int32_t root)
{
    struct sample best = sample_at(o, from);

    for (int k = 0; k < 32; k++) {
        struct sample s = sample_at(o, from + (int32_t)((int64_t)(root - from) * (2 * k + 1) >> 6));

        best = s.open > best.open ? s : best;
    }
    return best;
}

/* (1 + s_a^2 t^2) (1 + s_b^2 t^2), q30. */
static int64_t factor_q30(const struct boyse_pair *pair, int32_t t_q30)
{
    int32_t t2_q30 = carom_mul_q30(t_q30, t_q30);
    int32_t a_q30 = carom_mul_q30(pair->a->path.u2_q30, t2_q30);
    int32_t b_q30 = carom_mul_q30(pair->b->path.u2_q30, t2_q30);

    return CAROM_ONE_Q30 + (int64_t)a_q30 + b_q30 + carom_mul_q30(a_q30, b_q30);
}

/* What the event gap comes to in P where edges are at an angle of the sine `scale`. */
static void set_wanted(struct opening *o, const struct boyse_pair *pair, int32_t t_q30,
                       int32_t scale_q30)
{
    int64_t scale = fix_mul(factor_q30(pair, t_q30), scale_q30, 30);

    o->wanted = to_units(o->curve, scale * (pair->skin_q22 / 2) >> 12) - o->shift;
    o->slack = to_units(o->curve, scale * EVENT_SLACK_Q22 >> 12) + 1;
}

/*
 * Of features that never open by the event gap: the time of half their largest opening, `far`, but no
 * nearer than they start; 0 when they are never open.
 */
static int32_t half_open(struct opening *o, int32_t from, struct sample far, struct sample root)
{
    int64_t start = from == 0 ? sample_at(o, 0).open : 0;

    if (far.open <= 0) {
        return 0;
    }
    o->wanted = far.open > o->shift ? (far.open - o->shift) / 2 : 0;
    o->wanted = o->wanted < start ? start : o->wanted;
    root.open = root.open < o->wanted ? root.open : o->wanted - 1;
    return narrow_down(o, far, root);
}

/*
 * The last time before the root at which the gap equals the event gap (half the skin), searched
 * back no further than `from`, the root before. A pair that never opens that far in between gets
 * half of its largest opening; one that is never open gets 0.
 */
static int32_t event_time(struct opening *o, const struct boyse_pair *pair,
                          const struct candidate *c, int32_t from, struct sample root,
                          int64_t slope)
{
    struct sample far, near = root;
    int64_t back;

    /* first guess: the way at the closing speed of the root, and a little more */
    slope = carom_abs(slope) + 1;
    back = (o->wanted + o->slack / 2 - root.open) * CAROM_ONE_Q30 / slope;
    if (back < 64) {
        back = 64;
    }
    for (;;) {
        far = sample_at(o, back < root.t_q30 - from ? root.t_q30 - (int32_t)back : from);
        if (far.open >= o->wanted || far.t_q30 == from) {
            break;
        }
        near = far;
        back *= 2;
    }
    if (far.open < o->wanted) {
        far = widest(o, from, root.t_q30);
        near = root;
        if (c->kind == CANDIDATE_EDGE_EDGE) {
            /* whether they open far enough goes by their angle there, not at the root */
            set_wanted(o, pair, far.t_q30, boyse_scale(pair, c, far.t_q30));
        }
        if (far.open < o->wanted) {
            return half_open(o, from, far, root);
        }
    }
    near.open = near.open < o->wanted ? near.open : o->wanted - 1;
    return narrow_down(o, far, near);
}

/* --------------------------------------------------------------------- first */

/*
 * The sign of a pair that touches at the start, as near as the surface that roots are looked for of,
 * or overlaps; 0 for one that does not.
 */
static int touches_at_start(const struct boyse_pair *pair, const struct candidate *c,
                            int64_t gap_q40)
{
    struct boyse_touch touch;
    int32_t limit_q22 = pair->skin_q22 / 2;

    /* of edges this is |w| times the gap, which is no wider than it */
    if (carom_abs(gap_q40) >> 18 >= limit_q22) {
        return 0;
    }
    boyse_test(pair, c, 0, &touch);
    return touch.valid && touch.gap_q22 <= ROOT_LEVEL_Q22 && touch.gap_q22 > -limit_q22 ? touch.sign
                                                                                        : 0;
}

/*
 * Whether the turn in a time dt changes |w| so much that the event gap is off by half the slack: by more than 2 (s_a + s_b) dt / |w| of itself.
 */
static bool angle_matters(const struct boyse_pair *pair, int32_t scale_q30, int32_t dt_q30)
{
    int64_t change_q30 = carom_abs(carom_mul_q30(pair->turn_q30, dt_q30));

    return change_q30 * (pair->skin_q22 / 2) > (int64_t)scale_q30 * (EVENT_SLACK_Q22 / 2);
}

/* Whether edges are open by the event gap, going by the angle that they have at t. */
static bool is_open_at(struct opening *o, const struct boyse_pair *pair, const struct candidate *c,
                       int32_t t_q30, int64_t *excess)
{
    set_wanted(o, pair, t_q30, boyse_scale(pair, c, t_q30));
    *excess = sample_at(o, t_q30).open - o->wanted;
    return *excess >= 0;
}

/*
 * The event of edges whose angle changes on the way: from the first answer back until they are open,
 * then by halves.
 */
static int32_t event_by_angle(struct opening *o, const struct boyse_pair *pair,
                              const struct candidate *c, int32_t from, struct sample root,
                              int32_t far)
{
    int32_t near = root.t_q30;
    int64_t back = near - far + 64, excess;

    while (!is_open_at(o, pair, c, far, &excess)) {
        if (far == from) {
            struct sample best = widest(o, from, root.t_q30);

            if (!is_open_at(o, pair, c, best.t_q30, &excess)) {
                return half_open(o, from, best, root);
            }
            far = best.t_q30;
            near = root.t_q30;
            break;
        }
        near = far;
        back *= 2;
        far = back < root.t_q30 - from ? root.t_q30 - (int32_t)back : from;
    }
    while (near - far > 1 && excess > o->slack) {
        int32_t middle = far + (near - far) / 2;
        int64_t there;

        if (is_open_at(o, pair, c, middle, &there)) {
            far = middle;
            excess = there;
        } else {
            near = middle;
        }
    }
    return far;
}

/* Go through the roots until one is a hit. `shift`: what P is less than its true value, q40. */
static bool first_hit(const struct boyse_pair *pair, const struct candidate *c,
                      const struct curve *curve, int64_t shift_q40, struct boyse_hit *hit)
{
    struct walk walk;
    int32_t last_root = 0;

    begin_walk(&walk, curve);
    while (next_root(&walk, curve)) {
        struct boyse_touch touch = {.valid = false};
        int32_t scale_q30 = 0;

        /* a vertex that comes out through the back of a face is no hit, wherever it does */
        if (c->kind == CANDIDATE_EDGE_EDGE || walk.slope < 0) {
            scale_q30 = boyse_test(pair, c, walk.t_q30, &touch);
        }
        if (touch.valid && touch.sign * walk.slope < 0) {
            struct opening o = {.curve = curve,
                                .sign = touch.sign,
                                .shift = to_units(curve, touch.sign * shift_q40)};
            const struct sample root = {walk.t_q30, touch.sign * walk.p};

            set_wanted(&o, pair, walk.t_q30, scale_q30);
            hit->root_q30 = walk.t_q30;
            hit->t_q30 = event_time(&o, pair, c, last_root, root, walk.slope);
            if (c->kind == CANDIDATE_EDGE_EDGE &&
                angle_matters(pair, scale_q30, walk.t_q30 - hit->t_q30)) {
                hit->t_q30 = event_by_angle(&o, pair, c, last_root, root, hit->t_q30);
            }
            return true;
        }
        last_root = walk.t_q30;
        step_over(&walk, curve);
    }
    return false;
}

/*
 * How much nearer the surface is that roots are looked for of, in P: not by more than half of the
 * event gap, however small the angle between edges is.
 */
static int64_t level_q40(const struct boyse_pair *pair, const struct candidate *c,
                         const struct boyse_places *start)
{
    int64_t level = (int64_t)ROOT_LEVEL_Q22 << 18, most, largest = 0;

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        return level;
    }
    for (int k = 0; k < 3; k++) {
        int64_t part = carom_abs(start->w[k]);

        largest = part > largest ? part : largest;
    }
    most = largest * (pair->skin_q22 / 4) >> 12;
    return level < most ? level : most;
}

/*
 * A frame may end with a gap so small that there is no root on [0, 1], and rounding would then commit
 * an overlap: look for the root of a surface a little nearer. What touches already must not get
 * deeper. Returns what P is lowered by.
 */
static int64_t lower(int64_t gap_q40, int touching, int64_t level)
{
    int64_t size = carom_abs(gap_q40), shift;

    if (touching != 0) {
        return gap_q40 - touching * level;
    }
    shift = size > 2 * level ? level : size > level ? size - level : 0;
    return gap_q40 > 0 ? shift : -shift;
}

bool boyse_first(const struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots)
{
    struct boyse_places start;
    struct curve curve;
    int64_t a[BOYSE_DEGREE + 1], shift_q40 = 0;
    int degree, touching;

    if (!boyse_may_meet(pair, c)) {
        return false;
    }
    boyse_place_start(pair, c, &start);
    degree = boyse_polynomial(pair, c, &start, a);
    touching = touches_at_start(pair, c, a[0]);
    if (touching * a[1] < 0) {
        ++*roots;
        hit->t_q30 = hit->root_q30 = 0;
        return true;
    }
    if (c->kind == CANDIDATE_EDGE_EDGE || a[0] > 0 || touching != 0) {
        shift_q40 = lower(a[0], touching, level_q40(pair, c, &start));
    }
    a[0] -= shift_q40;
    if (!curve_init(&curve, a, degree)) {
        return false;
    }
    ++*roots;
    return first_hit(pair, c, &curve, shift_q40, hit);
}

/* SPDX-License-Identifier: MIT */
/* Find the first root of P(t) that is a hit, and its event: boyse_first. */
#include "event.h"
#include "place.h"

/* Edges in turning bodies below this sine, 1/64: P is too coarse, w lacks NEARLY_PARALLEL bits. */
#define PARALLEL_Q30    (1 << 24)
#define NEARLY_PARALLEL 6

/*
 * Sign of a pair that touches at the start: as near as BOYSE_ROOT_LEVEL_Q22, or overlapping. 0 if the
 * pair does not touch.
 */
static int touches_at_start(struct boyse_pair *pair, const struct candidate *c, int64_t gap_q40)
{
    struct boyse_touch touch;
    int32_t limit_q22 = pair->skin_q22 / 2;

    /* for edges this is |w| times the gap, which is at most the gap */
    if (carom_abs(gap_q40) >> 18 >= limit_q22) {
        return 0;
    }
    boyse_test(pair, c, 0, &touch);
    return touch.valid && touch.gap_q22 <= BOYSE_ROOT_LEVEL_Q22 && touch.gap_q22 > -limit_q22
               ? touch.sign
               : 0;
}

/*
 * Distance of the edges at a time, or of their lines if those do not face each other: the normal of
 * the lines may flip during the path.
 */
static int64_t apart_at(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30)
{
    struct boyse_touch touch;

    boyse_test(pair, c, t_q30, &touch);
    return touch.valid ? touch.gap_q22 : carom_abs(touch.gap_q22);
}

/*
 * The last time before `root` at which the features are farther apart than `gap`, to 1/4096 of its
 * distance from the root. Uses the exact test alone: back in growing steps, then bisection.
 */
static int32_t last_apart(struct boyse_pair *pair, const struct candidate *c, int32_t gap_q22,
                          int32_t root_q30)
{
    int32_t far = root_q30, near = root_q30, back = BOYSE_BACK_Q30, slack;

    do {
        near = far;
        far = root_q30 > back ? root_q30 - back : 0;
        back = back < CAROM_ONE_Q30 / 2 ? 2 * back : CAROM_ONE_Q30;
    } while (far > 0 && apart_at(pair, c, far) <= gap_q22);
    slack = 1 + ((root_q30 - far) >> 12);
    while (near - far > slack) {
        int32_t middle = far + (near - far) / 2;

        *(apart_at(pair, c, middle) > gap_q22 ? &far : &near) = middle;
    }
    return far;
}

/*
 * True if the exact test confirms a gap near 0 at a root. For nearly parallel edges P may be small
 * because |w| is, and its rounding is a gap of rounding / |w|.
 */
static bool is_there(struct boyse_pair *pair, const struct candidate *c,
                     const struct boyse_touch *touch)
{
    return c->kind != CANDIDATE_EDGE_EDGE || carom_abs(touch->gap_q22) <= pair->skin_q22 / 2;
}

/*
 * Go through the roots until one is a hit. shift_q40 is what was subtracted from P. Sets `far` if a
 * root failed only by its gap.
 */
static bool first_hit(struct boyse_pair *pair, const struct candidate *c, const struct curve *curve,
                      int64_t shift_q40, int touching, struct boyse_hit *hit, bool *far)
{
    struct walk walk;
    int32_t last_root = 0;

    *far = false;
    walk_begin(&walk, curve);
    while (walk_next(&walk, curve)) {
        struct boyse_touch touch;
        int32_t scale_q30 = 0;

        touch.valid = false;
        /* a vertex that moves away from the face on the side of the shifted one is no hit */
        if (touching != 0 || shift_q40 == 0 || c->kind == CANDIDATE_EDGE_EDGE ||
            (walk.slope8 < 0) != (shift_q40 < 0)) {
            scale_q30 = boyse_test(pair, c, walk.t_q30, &touch);
        }
        touch.valid = touch.valid && touch.sign * walk.slope8 < 0;
        *far = *far || (touch.valid && !is_there(pair, c, &touch));
        if (touch.valid && is_there(pair, c, &touch)) {
            bool edges = c->kind == CANDIDATE_EDGE_EDGE;
            struct opening o = {pair,  edges, curve, touch.sign,
                                false, 0,     0,     curve_units(curve, touch.sign * shift_q40)};

            hit->root_q30 = walk.t_q30;
            /* edges of steady pairs that touch have a scale of 1/16 or more: it has the digits of up */
            hit->t_q30 = edges && scale_q30 < PARALLEL_Q30
                             ? last_apart(pair, c, pair->skin_q22 / 2, walk.t_q30)
                             : boyse_event_q30(&o, last_root, &walk, scale_q30);
            return true;
        }
        last_root = walk.t_q30;
        walk_over(&walk, curve);
    }
    return false;
}

/*
 * The amount by which the sought surface is nearer than the true one, as a value of P: at most half
 * of the event gap, however small the edges' angle.
 */
static int64_t level_q40(struct boyse_pair *pair, const struct candidate *c)
{
    int64_t level = (int64_t)BOYSE_ROOT_LEVEL_Q22 << 18, most;
    int32_t largest;

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        return level;
    }
    largest = fix_largest(pair->start.w) >> (boyse_steady(pair) ? 0 : pair->start.up);
    most = (int64_t)largest * (pair->skin_q22 / 4) >> 12;
    return level < most ? level : most;
}

/*
 * The offset to subtract from P; 0 for a point behind the face of a solid. A frame may end with a gap
 * so small that P has no root on [0, 1], and rounding would then commit an overlap: so seek the root
 * of a surface a little nearer. A pair that touches already must not get deeper.
 *
 * For a pair that starts close subtract at most half of its gap. Edges that are parallel just when
 * they meet change the sign of w together with that of the gap: P only comes near 0, and that must
 * be found.
 */
static FIX_APART int64_t lower(struct boyse_pair *pair, const struct candidate *c, int64_t gap_q40,
                               int touching)
{
    int64_t size = carom_abs(gap_q40), level, shift;

    if (touching == 0 && gap_q40 <= 0 && c->kind != CANDIDATE_EDGE_EDGE &&
        !boyse_either_side(pair, c)) {
        return 0;
    }
    level = level_q40(pair, c);
    if (touching != 0) {
        return gap_q40 - touching * (level / BOYSE_TOUCHING_DIVISOR);
    }
    shift = size > 2 * level ? level : size / 2;
    return gap_q40 > 0 ? shift : -shift;
}

/*
 * Test nearly parallel edges of turning bodies by the exact test alone: true if they have met by
 * the end of the path, earlier than `before`. P's rounding over their sine exceeds the way of slow
 * bodies.
 */
static FIX_OWN_FRAME bool have_met(struct boyse_pair *pair, const struct candidate *c,
                                   int32_t before_q30, struct boyse_hit *hit)
{
    struct boyse_touch from, to;
    int32_t event_q22 = pair->skin_q22 / 2, t_q30,
            root = CAROM_ONE_Q30; /* a time at which they have met */

    boyse_test(pair, c, CAROM_ONE_Q30, &to);
    if (!to.valid || to.gap_q22 > BOYSE_ROOT_LEVEL_Q22) {
        return false;
    }
    boyse_test(pair, c, 0, &from);
    if (from.valid && (from.gap_q22 <= to.gap_q22 || from.gap_q22 <= -event_q22)) {
        return false;
    }
    for (int32_t step = CAROM_ONE_Q30 / 2; step >= CAROM_ONE_Q30 >> 12; step /= 2) {
        boyse_test(pair, c, root - step, &to);
        root -= to.valid && to.gap_q22 <= BOYSE_ROOT_LEVEL_Q22 ? step : 0;
    }
    boyse_test(pair, c, root, &to);
    if (to.gap_q22 < -event_q22) {
        return false; /* they came to face each other there, deep in overlap */
    }
    t_q30 = last_apart(pair, c, event_q22, root);
    if (t_q30 >= before_q30) {
        return false;
    }
    hit->root_q30 = root;
    hit->t_q30 = t_q30;
    return true;
}

static FIX_OWN_FRAME bool first_by_roots(struct boyse_pair *pair, const struct candidate *c,
                                         struct boyse_hit *hit, uint32_t *roots)
{
    struct curve curve;
    int64_t a[BOYSE_DEGREE + 1], shift_q40;
    int degree = boyse_polynomial(pair, c, a);
    int touching = touches_at_start(pair, c, a[0]);

    if (touching * a[1] < 0) {
        ++*roots;
        hit->t_q30 = hit->root_q30 = 0;
        return true;
    }
    shift_q40 = lower(pair, c, a[0], touching);
    /*
     * Across a convex edge or vertex a point is over no face until it is at the surface. So a root
     * that is no hit is sought again with the surface itself; with levels between if |w| made the
     * gap small.
     */
    for (int tries = 0;; tries++) {
        bool far = false, found;

        a[0] -= shift_q40;
        found = curve_init(&curve, a, degree);
        *roots += found && tries == 0;
        if (found && first_hit(pair, c, &curve, shift_q40, touching, hit, &far)) {
            return true;
        }
        a[0] += shift_q40;
        if (touching != 0 && c->kind != CANDIDATE_EDGE_EDGE && touching * a[0] < 0) {
            /* touches from behind, beside the face: it may come out and go in again */
            shift_q40 = touching * level_q40(pair, c);
            touching = 0;
            continue;
        }
        if (shift_q40 == 0 || touching != 0) {
            return false;
        }
        shift_q40 = far && tries < BOYSE_LEVELS ? shift_q40 / 4 : 0;
    }
}

bool boyse_first(struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots)
{
    bool found;

    if (!boyse_may_meet(pair, c)) {
        return false;
    }
    boyse_place_start(pair, c);
    found = first_by_roots(pair, c, hit, roots);
    if (c->kind == CANDIDATE_EDGE_EDGE && pair->start.up >= NEARLY_PARALLEL &&
        !boyse_steady(pair)) {
        found |= have_met(pair, c, found ? hit->t_q30 : INT32_MAX, hit);
    }
    return found;
}

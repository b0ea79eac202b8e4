/* SPDX-License-Identifier: MIT */
/*
 * The paper's static check of a candidate: do its features touch in the given poses, and how far
 * are they from touching?
 */
#include "place.h"

/* Allowance for the rounding of places at a root and for the nearer surface sought there. */
#define CLEAR_NOISE_Q22 96
/* Edges whose w needs more bits than this may meet far from both lines' nearest points. */
#define CLEAR_UP_MAX 5

/* True if the features may touch; the gap is that of either side if a vertex may be on both. */
static bool is_near(const struct boyse_view *view, const struct candidate *c,
                    const struct boyse_places *p, int32_t deepest_q22, int32_t margin_q22)
{
    int64_t gap_q22;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        /* |w|_1 >= |w| */
        int64_t size = carom_abs(p->w[0]) + carom_abs(p->w[1]) + carom_abs(p->w[2]);

        return carom_abs(carom_dot(p->w, p->d)) <= size * (margin_q22 + 1);
    }
    gap_q22 = boyse_plane_gap_q52(view, c, p) >> 30;
    if (gap_q22 < 0 && c->kind == CANDIDATE_VERTEX_FACE && mesh_two_sided(view->to->def.mesh)) {
        return -gap_q22 <= fix_larger(margin_q22, -deepest_q22);
    }
    return gap_q22 <= margin_q22 && gap_q22 >= deepest_q22;
}

/*
 * A bound on the distance that the features still have. Where they meet two of their points
 * coincide, and at the start these were no nearer to each other than the plane or the lines. Edges
 * that do not overlap count by their lines' distance. A vertex below a face counts from half a skin
 * below it, since from there on it may touch.
 */
static int32_t left_between(const struct boyse_pair *pair, const struct candidate *c,
                            const struct boyse_touch *touch)
{
    int32_t gap_q22 = touch->gap_q22;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        return touch->valid ? gap_q22 : fix_abs32(gap_q22);
    }
    return gap_q22 < 0 ? -gap_q22 - pair->skin_q22 / 2 : gap_q22;
}

/* left_q22 less noise; for edges the noise is divided by their sine. */
static int32_t clear_of(const struct candidate *c, const struct boyse_places *p, int32_t left_q22)
{
    int up = c->kind == CANDIDATE_EDGE_EDGE ? p->up : 0;

    if (up > CLEAR_UP_MAX) {
        return 0;
    }
    return left_q22 - (up > 0 ? CLEAR_NOISE_Q22 << (up - 2) : CLEAR_NOISE_Q22);
}

bool boyse_static(struct boyse_pair *pair, const struct candidate *c, int32_t deepest_q22,
                  int32_t margin_q22, struct boyse_touch *touch, int32_t *clear_q22)
{
    int32_t left_q22 = fix_smaller(margin_q22, -deepest_q22 - pair->skin_q22 / 2);
    bool near;

    boyse_place_start(pair, c);
    near = is_near(boyse_view(pair, c), c, &pair->start, deepest_q22, margin_q22);
    if (near) {
        boyse_touch_start(pair, c, touch);
        left_q22 = left_between(pair, c, touch);
    }
    *clear_q22 = fix_smaller(*clear_q22, clear_of(c, &pair->start, left_q22));
    return near;
}

/* SPDX-License-Identifier: MIT */
/*
 * The relative motion of a pair's bodies over the span, as b sees it: mean axes, shift, and a
 * tolerance for all that is not straight.
 */
#include "narrow.h"

/* Tolerance for the collision test, which places features with other roundings, q22. */
#define PATH_NOISE_Q22 16

void interfere_relate(carom_m3_q30 *out, const carom_m3_q30 *b, const carom_m3_q30 *a)
{
    FIX_UNROLL
    for (int i = 0; i < 3; i++) {
        const int32_t column[3] = {b->c[0][i], b->c[1][i], b->c[2][i]};

        carom_rotate_back(out->c[i], a, column);
    }
}

/*
 * Bound on a point's distance from the straight line between its start and its end, as seen from b:
 * an eighth of the second derivative of its motion.
 *
 * A turn with Cayley vector u moves a point at distance r by at most 2 |u| r and bends that motion
 * by at most 4 |u|^2 (1 + |u|) r. In axes that turn so themselves twice the turn times the motion
 * comes on top. A point that meets b or comes within the margin is then within b's radius plus the
 * margin of b's centre; its motion before and after bounds its distance at other times.
 */
static int64_t sag_q22(const struct interfere *in, const struct body_sweep *a,
                       const struct body_sweep *b, int64_t distance_q22, int64_t margin_q22)
{
    int64_t bend = 2 * ((int64_t)a->bend_q22 + b->bend_q22);
    int64_t way = (int64_t)a->length_q22 + b->length_q22;
    int32_t twice_q30 = 2 * a->u_q30;

    way += fix_mul(in->a->def.radius_q22, twice_q30, 30);
    bend += fix_mul(fix_mul(in->a->def.radius_q22, twice_q30, 30), twice_q30 + a->whole_u_q30, 30);
    if (b->u_q30 > 0) {
        int64_t from_a = distance_q22 + in->a->def.radius_q22,
                from_b = in->b->def.radius_q22 + margin_q22;

        twice_q30 = 2 * b->u_q30;
        bend += 2 * fix_mul(way, twice_q30, 30);
        bend += fix_mul(fix_mul((from_a < from_b ? from_a : from_b) + way, twice_q30, 30),
                        twice_q30 + b->whole_u_q30, 30);
    }
    return bend / 8 + 2;
}

/*
 * Set the sweep of a body over the span. Returns the tolerance that its motion needs beyond the
 * sweep.
 */
FIX_APART static int32_t sweep_body(const struct interfere *in, const struct body *b,
                                    int64_t from_q30, struct body_sweep *sweep)
{
    if (in->by_paths) {
        body_path_sweep(b, sweep);
        return mesh_drift_most(b->def.mesh) + PATH_NOISE_Q22;
    }
    body_region_sweep(&b->search.region, from_q30, in->span.time_q30, sweep);
    return b->search.region.room_q22;
}

/* True if the body's axes are the world's throughout the sweep. */
static bool is_upright(const struct interfere *in, const struct body *b,
                       const struct body_sweep *sweep)
{
    const carom_quat_q30 *q = in->by_paths ? &body_path(b)->q : &b->search.region.q;

    return (q->c[1] | q->c[2] | q->c[3]) == 0 && sweep->u_q30 == 0;
}

bool interfere_set_motion(struct interfere *in)
{
    struct interfere_leaf *l = in->leaf;
    struct body_sweep sweep[2], *a = &sweep[0], *b = &sweep[1];
    const struct body *skin = in->a->def.skin_q22 > in->b->def.skin_q22 ? in->a : in->b;
    int64_t start[3], end[3], distance = 0, margin_q22;

    margin_q22 = BODY_MARGIN_SKINS * (int64_t)skin->def.skin_q22;
    margin_q22 += sweep_body(in, in->a, in->span.from_a_q30, a);
    margin_q22 += sweep_body(in, in->b, in->span.from_b_q30, b);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        start[k] = a->at.c[k] - b->at.c[k];
        end[k] = start[k] + ((a->way.c[k] - b->way.c[k]) >> 8);
    }
    if (!is_upright(in, in->b, b)) { /* skipped for most ground */
        fix_rotate_back(start, &b->start, start);
        fix_rotate_back(end, &b->end, end);
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        if (carom_abs(start[k]) > (int64_t)400 << 32) {
            return false;
        }
        l->moves.c[k] = (int32_t)((end[k] - start[k]) >> 12);
        l->at.c[k] = (int32_t)(start[k] >> 12) + l->moves.c[k] / 2;
        distance += carom_abs(start[k]) >> 10;
    }
    interfere_relate(&l->to_b, &b->start, &a->start);
    memset(&l->change, 0, sizeof l->change);
    if (a->u_q30 > 0 || b->u_q30 > 0) {
        interfere_relate(&l->change, &b->end, &a->end);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                l->change.c[i][j] -= l->to_b.c[i][j];
                l->to_b.c[i][j] += l->change.c[i][j] / 2;
            }
        }
    }
    l->angle_q30 = 2 * (a->u_q30 + b->u_q30);
    /* 1 - cos^2 of half the angle, at most a quarter of the angle's square */
    l->skew_q30 = carom_mul_q30(l->angle_q30, l->angle_q30) / 4 + 1;
    l->near_q22 = margin_q22 + sag_q22(in, a, b, distance, margin_q22);
    return true;
}

/* SPDX-License-Identifier: MIT */
/* A pair of bodies on their paths: how each sees the other one's motion, and bounds on that. */
#include "boyse.h"

static int64_t length_q22(const int32_t v_q24[3])
{
    const int64_t v[3] = {v_q24[0], v_q24[1], v_q24[2]};

    return (v[0] | v[1] | v[2]) != 0 ? (fix_length(v) >> 2) + 1 : 1;
}

static int32_t clamp(int64_t v)
{
    return v < INT32_MAX ? (int32_t)v : INT32_MAX;
}

/*
 * Bounds of the path, of which this is the part s^2 + c s. A point at r moves by at most 2 s |r|,
 * and is at most (2 s^2 + 2 s^3 + 2 c s) |r| t^2 < 3 (s^2 + c s) |r| t^2 from r + 2t u x r, as s <
 * 0.31 (body.h). If `to` turns as well, while the point moves by D from within X of to's centre, it
 * sees another 2 s (X + D) of way and 2 s D + 3 (s^2 + c s) (X + D) of bend.
 */
static int32_t bend_q30(const struct body_path *path, int64_t s_q30)
{
    return path->u2_q30 + 1 + carom_mul_q30(path->c_q30, (int32_t)s_q30);
}

static void set_bounds(struct boyse_view *view)
{
    const struct body *from = view->from, *to = view->to;
    int64_t bend = length_q22(view->g.c), way = length_q22(view->v.c) + bend, reach;

    if (from->path.turns) {
        int64_t s_q30 = fix_sqrt((uint64_t)(body_path(from)->u2_q30 + 1) << 30) + 1;

        way += fix_mul_q30(2 * s_q30, from->def.radius_q22) + 1;
        bend +=
            fix_mul_q30(3 * (int64_t)from->def.radius_q22, bend_q30(body_path(from), s_q30)) + 1;
    }
    view->fixed = view->seen = (struct boyse_bound){clamp(way), clamp(bend)};
    if (to->path.turns) {
        const int64_t centre[3] = {view->centre.c[0], view->centre.c[1], view->centre.c[2]};
        int64_t s_q30 = fix_sqrt((uint64_t)(body_path(to)->u2_q30 + 1) << 30) + 1;

        reach = fix_length(centre) + from->def.radius_q22 + way;
        view->seen.way_q22 = clamp(way + fix_mul_q30(2 * reach, (int32_t)s_q30) + 1);
        view->seen.bend_q22 = clamp(bend + fix_mul_q30(2 * way, (int32_t)s_q30) +
                                    fix_mul_q30(3 * reach, bend_q30(body_path(to), s_q30)) + 2);
        view->fixed.way_q22 = clamp(way + fix_mul_q30(2 * s_q30, to->def.radius_q22) + 1);
        view->fixed.bend_q22 =
            clamp(bend +
                  fix_mul_q30(3 * (int64_t)to->def.radius_q22, bend_q30(body_path(to), s_q30)) + 1);
    }
}

/*
 * Set how many bits beyond q22 the lengths in P can have. Features that meet on the path start
 * within its way of each other, and within the radius of a body that turns. A body that does not
 * turn is referred to the feature itself; an edge of `from` then has its start up to a diameter
 * away. No length in P exceeds the sum of these.
 */
static void set_fine(struct boyse_view *view)
{
    int64_t reach = view->fixed.way_q22 + (view->to->path.turns ? view->to->def.radius_q22 : 0) +
                    8 + (view->from->path.turns ? 1 : 2) * (int64_t)view->from->def.radius_q22;

    view->fine = 30 - fix_bits((uint64_t)reach);
    view->fine = view->fine < 0 ? 0 : view->fine > 7 ? 7 : view->fine;
}

/*
 * Turn v into a body's axes. Skipped if v is 0 (gravity's difference often is) or the body is not
 * turned.
 */
static void into_axes(int64_t v[3], const struct body *b)
{
    const int32_t *q = body_path(b)->q.c;

    if ((v[0] | v[1] | v[2]) != 0 && (q[1] | q[2] | q[3]) != 0) {
        fix_rotate_back(v, &b->path.start.r, v);
    }
}

/* Set how `to` sees `from`; view->r is given. */
static void set_view(struct boyse_view *view, struct body *from, struct body *to)
{
    int64_t centre_q32[3], v[3], g[3];
    int32_t turning[3] = {0, 0, 0};

    view->from = from;
    view->to = to;
    for (int k = 0; k < 3; k++) {
        centre_q32[k] =
            carom_shl(body_path(from)->origin_q22[k] - body_path(to)->origin_q22[k], 10) +
            from->path.start_x_q32[k] - to->path.start_x_q32[k];
        v[k] = body_path(from)->v.c[k] - body_path(to)->v.c[k];
        g[k] = body_path(from)->g.c[k] - body_path(to)->g.c[k];
        view->u.c[k] = 0;
    }
    into_axes(centre_q32, to);
    into_axes(v, to);
    into_axes(g, to);
    for (int k = 0; k < 3; k++) {
        view->centre.c[k] = (int32_t)carom_round(centre_q32[k], 10);
        view->v.c[k] = (int32_t)carom_round(v[k], 16);
        view->g.c[k] = (int32_t)carom_round(g[k], 16);
    }
    if (from->path.turns) {
        carom_rotate(view->u.c, &view->r, body_path(from)->u.c);
        carom_cross(turning, view->u.c, view->centre.c, 29);
    }
    for (int k = 0; k < 3; k++) {
        view->u_relative.c[k] = view->u.c[k] - body_path(to)->u.c[k];
        view->field.c[k] = (int32_t)carom_round(v[k], 18) - turning[k];
    }
    set_bounds(view);
    set_fine(view);
}

/* Set both views' matrices: a's mesh axes to b's, and back. */
static void set_axes(struct boyse_pair *pair)
{
    const carom_m3_q30 *a = &pair->a->path.start.r, *b = &pair->b->path.start.r;

    for (int k = 0; k < 3; k++) {
        FIX_UNROLL
        for (int i = 0; i < 3; i++) {
            int64_t sum = (int64_t)b->c[0][k] * a->c[0][i] + (int64_t)b->c[1][k] * a->c[1][i] +
                          (int64_t)b->c[2][k] * a->c[2][i];

            pair->view[0].r.c[k][i] = pair->view[1].r.c[i][k] = (int32_t)carom_round(sum, 30);
        }
    }
}

void boyse_pair_begin(struct boyse_pair *pair, struct body *a, struct body *b)
{
    pair->a = a;
    pair->b = b;
    pair->skin_q22 = a->def.skin_q22 > b->def.skin_q22 ? a->def.skin_q22 : b->def.skin_q22;
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        pair->offset_q22[k] = (int32_t)(body_path(b)->origin_q22[k] - body_path(a)->origin_q22[k]);
    }
    pair->turn_q30 = 2 * (int32_t)(fix_sqrt((uint64_t)body_path(a)->u2_q30 << 30) +
                                   fix_sqrt((uint64_t)body_path(b)->u2_q30 << 30));
    set_axes(pair);
    set_view(&pair->view[0], a, b);
    pair->view[1].to = NULL;
}

void boyse_pair_turn(struct boyse_pair *pair)
{
    set_view(&pair->view[1], pair->b, pair->a);
}

void boyse_pair_init(struct boyse_pair *pair, struct body *a, struct body *b)
{
    boyse_pair_begin(pair, a, b);
    boyse_pair_turn(pair);
}

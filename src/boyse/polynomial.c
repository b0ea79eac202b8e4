/* SPDX-License-Identifier: MIT */
/* The features at the start of the path, and the coefficients of P(t). */
#include "place.h"

/*
 * Set w and d of two edges. If they are nearly parallel w is small and its rounding would turn N.
 * Its products are exact, so it gets `up` more bits. The rest of the error does little harm if d is
 * short: so d is taken from the point of b's line nearest to a's start, not from b's start.
 */
void boyse_complete_edges(struct boyse_places *p)
{
    int32_t largest;

    carom_cross(p->w, p->e, p->f, 30);
    for (int k = 0; k < 3; k++) {
        p->d[k] = p->vertex.c[k] - p->start_b.c[k];
    }
    p->up = p->on_b_q22 = 0;
    largest = fix_largest(p->w);
    if (largest < BOYSE_FINE_Q30) {
        p->up = 29 - fix_bits32((uint32_t)largest); /* below 2^29 */
        carom_cross(p->w, p->e, p->f, 30 - p->up);
        p->on_b_q22 = (int32_t)carom_round(carom_dot(p->d, p->f), 30);
        for (int k = 0; k < 3; k++) {
            p->d[k] -= carom_mul_q30(p->on_b_q22, p->f[k]);
        }
    }
}

void boyse_place_start(struct boyse_pair *pair, const struct candidate *c)
{
    struct boyse_places *p = &pair->start;
    const struct boyse_view *view = boyse_view(pair, c);
    const struct carom_mesh *from = view->from->def.mesh, *to = view->to->def.mesh;
    uint32_t v = c->i;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        p->edge_a = &from->edges[c->i];
        p->edge_b = &to->edges[c->j];
        v = p->edge_a->vertex[0];
    }
    p->vertex = mesh_vertex(from, v);
    carom_rotate(p->vertex.c, &view->r, p->vertex.c);
    for (int k = 0; k < 3; k++) {
        p->vertex.c[k] += view->centre.c[k];
    }
    if (c->kind != CANDIDATE_EDGE_EDGE) {
        p->n = to->faces[c->j].normal.c;
        return;
    }
    p->start_b = mesh_vertex(to, p->edge_b->vertex[0]);
    p->f = p->edge_b->direction.c;
    carom_rotate(p->e, &view->r, p->edge_a->direction.c);
    boyse_complete_edges(p);
}

/* --------------------------------------------------------------- coefficients */

/*
 * Directions are q30. Lengths have view->fine bits beyond q22, so that they just fit 30 bits: the
 * error of w.d is divided by |w|, so nearly parallel edges need them. Products for one power of t
 * are summed whole and rounded once: below 2^62, since all lengths of a pair together are below
 * 2^30 and the coefficients of a direction below 1, 0.7 and 0.3. Coefficients are q40.
 */
static int64_t sum_q40(int64_t sum, int fine)
{
    return carom_round(sum, 12 + fine);
}

static int64_t dot_q40(const int32_t direction[3], const int32_t length[3], int fine)
{
    return sum_q40(carom_dot(direction, length), fine);
}

static void refine(int32_t out[3], const int32_t v_q22[3], int fine)
{
    for (int k = 0; k < 3; k++) {
        out[k] = v_q22[k] * (1 << fine);
    }
}

/*
 * A vector r that turns with a body, times the norm N(t) = (1 + c t)^2 + s^2 t^2 (body.h): c[0] +
 * c[1] t + c[2] t^2. Cayley's formula gives r + 2t (c r + u x r) + t^2 (2 u (u.r) + 2 c u x r +
 * (c^2 - s^2) r).
 */
struct quadratic {
    int32_t c[3][3];
};

static void turning(struct quadratic *q, const int32_t r[3], const struct body_path *path,
                    const carom_v3_q30 *u)
{
    int32_t along;

    q->c[0][0] = r[0];
    q->c[0][1] = r[1];
    q->c[0][2] = r[2];
    if (!path->turns) {
        return; /* c[1] and c[2] stay unset; nobody reads them */
    }
    carom_cross(q->c[1], u->c, r, 29);
    along = (int32_t)carom_round(carom_dot(u->c, r), 29);
    for (int k = 0; k < 3; k++) {
        q->c[2][k] =
            (int32_t)carom_round((int64_t)u->c[k] * along - (int64_t)path->u2_q30 * r[k], 30);
    }
    for (int k = 0; path->c_q30 != 0 && k < 3; k++) {
        int32_t part = carom_mul_q30(r[k], path->c_q30);

        q->c[2][k] += carom_mul_q30(q->c[1][k] + part, path->c_q30);
        q->c[1][k] += 2 * part;
    }
}

/* sum += x.y for a direction x and a length y that both turn, by powers of t up to 4. */
static void add_product(int64_t sum[5], const struct quadratic *x, const struct quadratic *y)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            sum[i + j] += carom_dot(x->c[i], y->c[j]);
        }
    }
}

/* sum = x.y, but for sum[0], which the caller has exactly. */
static void set_product(int64_t sum[5], const struct quadratic *x, const struct quadratic *y)
{
    sum[1] = carom_dot(x->c[0], y->c[1]) + carom_dot(x->c[1], y->c[0]);
    sum[2] =
        carom_dot(x->c[0], y->c[2]) + carom_dot(x->c[1], y->c[1]) + carom_dot(x->c[2], y->c[0]);
    sum[3] = carom_dot(x->c[1], y->c[2]) + carom_dot(x->c[2], y->c[1]);
    sum[4] = carom_dot(x->c[2], y->c[2]);
}

/* fix_mul_q30 without the call: too frequent here. |v| < 2^52. */
static inline int64_t times_q30(int64_t v, int32_t x_q30)
{
    int64_t high = (v >> 32) * x_q30, low = (int64_t)(uint32_t)v * x_q30;

    return high * 4 + carom_round(low, 30);
}

/* Multiply a polynomial by a path's norm: two more coefficients. */
static void times_norm(int64_t *a, int degree, const struct body_path *path)
{
    int32_t once_q30 = 2 * path->c_q30, twice_q30 = body_norm2_q30(path);

    a[degree + 1] = a[degree + 2] = 0;
    /* from the top, so that lower coefficients are still without the factor */
    for (int k = degree + 2; k >= 1; k--) {
        a[k] += k >= 2 ? times_q30(a[k - 2], twice_q30) : 0;
        a[k] += once_q30 != 0 ? times_q30(a[k - 1], once_q30) : 0;
    }
}

/*
 * The way of from's centre, starting `at` from to's centre. A point that does not turn is its own
 * centre: that keeps numbers small for large meshes. Returns false if it is farther away than
 * features of the pair can be that meet.
 */
static bool centre_way(struct quadratic *q, const struct boyse_view *view, const int32_t at_q22[3])
{
    const int32_t limit = (int32_t)1 << (30 - view->fine);
    int up = view->fine - 2, down = up < 0 ? -up : 0;

    for (int k = 0; k < 3; k++) {
        if (at_q22[k] > limit || at_q22[k] < -limit) {
            return false;
        }
        q->c[0][k] = at_q22[k] * (1 << view->fine);
        q->c[1][k] = up < 0 ? (view->v.c[k] + down) >> down : view->v.c[k] * (1 << up);
        q->c[2][k] = up < 0 ? (view->g.c[k] + down) >> down : view->g.c[k] * (1 << up);
    }
    return true;
}

/* Set coefficients without a root. */
static int never(int64_t *a)
{
    a[0] = (int64_t)1 << 40;
    a[1] = a[2] = 0;
    return 2;
}

/* Where from's feature starts, relative to from's centre of mass. */
static void arm_of(int32_t arm_q22[3], const struct boyse_view *view,
                   const struct boyse_places *start)
{
    for (int k = 0; k < 3; k++) {
        arm_q22[k] = start->vertex.c[k] - view->centre.c[k];
    }
}

/* P of a vertex against a face that does not turn; returns the degree. */
static int moving_vertex(const struct boyse_view *view, const struct boyse_places *start,
                         int64_t *a)
{
    const struct body_path *path = body_path(view->from);
    int32_t arm[3], once[3], twice[3];

    a[1] = carom_round(carom_dot(start->n, view->v.c), 14);
    a[2] = carom_round(carom_dot(start->n, view->g.c), 14);
    if (!path->turns) {
        return 2;
    }
    times_norm(a, 2, path);
    /* (r(t) - r) N = 2t u x r + t^2 (2 u x (u x r) + 2 c u x r) */
    arm_of(arm, view, start);
    refine(arm, arm, view->fine);
    carom_cross(once, view->u.c, arm, 29);
    carom_cross(twice, view->u.c, once, 30);
    for (int k = 0; path->c_q30 != 0 && k < 3; k++) {
        twice[k] += carom_mul_q30(once[k], path->c_q30);
    }
    a[1] += dot_q40(start->n, once, view->fine);
    a[2] += dot_q40(start->n, twice, view->fine);
    return 4;
}

/*
 * P of a vertex against a turning face: n(t).(c(t) + r(t)) - offset, c the way of the vertex's
 * centre, r the vertex about it. Only a body that turns contributes its norm. Returns the degree.
 */
static int turning_face(const struct boyse_view *view, const struct boyse_places *start,
                        int32_t offset_q22, int64_t *a)
{
    const struct body_path *from = body_path(view->from), *to = body_path(view->to);
    struct quadratic n, centre, arm;
    int64_t sum[5], plane = carom_shl(offset_q22, 18), gap = a[0];
    int32_t r[3], at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = from->turns ? view->centre.c[k] : start->vertex.c[k];
    }
    if (!centre_way(&centre, view, at)) {
        return never(a);
    }
    turning(&n, start->n, to, &to->u);
    set_product(sum, &n, &centre);
    for (int k = 1; k < 5; k++) {
        a[k] = sum_q40(sum[k], view->fine);
    }
    a[1] -= to->c_q30 != 0 ? times_q30(plane, 2 * to->c_q30) : 0;
    a[2] -= times_q30(plane, body_norm2_q30(to));
    if (!from->turns) {
        return 4; /* a[0] is the exact one */
    }
    a[0] = sum_q40(carom_dot(n.c[0], centre.c[0]), view->fine) - plane;
    times_norm(a, 4, from);
    a[0] = gap;
    arm_of(r, view, start);
    refine(r, r, view->fine);
    turning(&arm, r, from, &view->u);
    set_product(sum, &n, &arm);
    for (int k = 1; k < 5; k++) {
        a[k] += sum_q40(sum[k], view->fine);
    }
    return 6;
}

/* out = x x y for a direction x and a length y that both turn, by powers of t: degree 4. */
static void cross_product(int32_t out[5][3], const struct quadratic *x, const struct quadratic *y)
{
    for (int k = 0; k < 3; k++) {
        out[3][k] = out[4][k] = 0;
    }
    for (int j = 0; j < 3; j++) {
        carom_cross(out[j], x->c[0], y->c[j], 30);
    }
    for (int i = 1; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int32_t part[3];

            carom_cross(part, x->c[i], y->c[j], 30);
            for (int k = 0; k < 3; k++) {
                out[i + j][k] += part[k];
            }
        }
    }
}

/* Where c starts, see edge_polynomial. */
static void place_centres(int32_t at[3], const struct boyse_pair *pair,
                          const struct boyse_places *start)
{
    bool a_turns = pair->a->path.turns, b_turns = pair->b->path.turns;

    for (int i = 0; i < 3; i++) {
        at[i] = a_turns ? pair->view[0].centre.c[i] : start->vertex.c[i];
        at[i] -= b_turns ? 0 : start->start_b.c[i];
    }
    if (!b_turns) {
        /* refer b's line to its point nearest to a: keeps long edges in range */
        int32_t along_q22 = (int32_t)carom_round(carom_dot(start->f, at), 30);

        for (int i = 0; i < 3; i++) {
            at[i] -= carom_mul_q30(along_q22, start->f[i]);
        }
    }
}

/*
 * The moment of a line about its body's centre, turning with the body: r_a x e of a, or r_b x f of
 * b.
 */
static void set_moment_of(struct quadratic *k, const struct boyse_pair *pair,
                          const struct boyse_places *start, bool of_a)
{
    const struct boyse_view *view = &pair->view[0];
    int32_t moment[3];

    if (of_a) {
        arm_of(moment, view, start);
        carom_cross(moment, moment, start->e, 30 - view->fine);
        turning(k, moment, body_path(pair->a), &view->u);
    } else {
        carom_cross(moment, start->start_b.c, start->f, 30 - view->fine);
        turning(k, moment, body_path(pair->b), &body_path(pair->b)->u);
    }
}

/* P of two edges if both bodies turn: degree 6. */
static void both_turn(int64_t sum[BOYSE_DEGREE + 1], const struct boyse_pair *pair,
                      const struct boyse_places *start, const struct quadratic *centre)
{
    struct quadratic e, f, k;
    int32_t way[5][3];

    turning(&e, start->e, body_path(pair->a), &pair->view[0].u);
    turning(&f, start->f, body_path(pair->b), &body_path(pair->b)->u);
    cross_product(way, &f, centre);
    for (int i = 0; i <= BOYSE_DEGREE; i++) {
        sum[i] = 0;
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 5; j++) {
            sum[i + j] += carom_dot(e.c[i], way[j]);
        }
    }
    set_moment_of(&k, pair, start, true);
    add_product(sum, &f, &k);
    set_moment_of(&k, pair, start, false);
    add_product(sum, &e, &k);
}

/*
 * P of two edges if one body turns, with its edge x, or none. P = x.(y x c) + y.k, k the moment of
 * x, y the other edge, which does not turn. Swapping the edges' roles flips the sign of the triple
 * product. Returns the degree.
 */
static int one_turns(int64_t sum[BOYSE_DEGREE + 1], const struct boyse_pair *pair,
                     const struct boyse_places *start, const struct quadratic *centre)
{
    bool of_a = !pair->b->path.turns;
    const struct body_path *path = of_a ? body_path(pair->a) : body_path(pair->b);
    const int32_t *y = of_a ? start->f : start->e;
    struct quadratic x, way, k;

    for (int j = 0; j < 3; j++) {
        const int32_t *c = centre->c[j];

        carom_cross(way.c[j], of_a ? y : c, of_a ? c : y, 30);
    }
    turning(&x, of_a ? start->e : start->f, path, of_a ? &pair->view[0].u : &path->u);
    if (!path->turns) {
        sum[1] = carom_dot(x.c[0], way.c[1]);
        sum[2] = carom_dot(x.c[0], way.c[2]);
        return 2;
    }
    set_product(sum, &x, &way);
    set_moment_of(&k, pair, start, of_a);
    sum[1] += carom_dot(y, k.c[1]);
    sum[2] += carom_dot(y, k.c[2]);
    return 4;
}

/*
 * P of two edges. With e through r_a from a's centre, f through r_b from b's, c from b's centre to
 * a's:
 *
 *   w.d = (e x f).(c + r_a - r_b) = e.(f x c) + f.(r_a x e) + e.(r_b x f)
 *
 * r_a x e turns with a, r_b x f with b. A line that does not turn is referred to a point on it,
 * which makes its r zero.
 */
static int edge_polynomial(const struct boyse_pair *pair, const struct boyse_places *start,
                           int64_t *a)
{
    struct quadratic centre;
    int64_t sum[BOYSE_DEGREE + 1];
    int32_t at[3];
    int degree = BOYSE_DEGREE;

    if (boyse_steady(pair) && start->up > 0) {
        const struct boyse_view *view = &pair->view[0];

        a[0] = carom_round(carom_dot(start->w, start->d), 12);
        a[1] = carom_round(carom_dot(start->w, view->v.c), 14);
        a[2] = carom_round(carom_dot(start->w, view->g.c), 14);
        return 2;
    }
    place_centres(at, pair, start);
    if (!centre_way(&centre, &pair->view[0], at)) {
        return never(a);
    }
    if (pair->a->path.turns && pair->b->path.turns) {
        both_turn(sum, pair, start, &centre);
    } else {
        degree = one_turns(sum, pair, start, &centre);
    }
    a[0] = carom_round(carom_dot(start->w, start->d), 12 + start->up);
    for (int i = 1; i <= degree; i++) {
        a[i] = sum_q40(sum[i], pair->view[0].fine);
    }
    return degree;
}

int boyse_polynomial(const struct boyse_pair *pair, const struct candidate *c,
                     int64_t a_q40[BOYSE_DEGREE + 1])
{
    const struct boyse_places *start = &pair->start;
    const struct boyse_view *view = boyse_view(pair, c);

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        return edge_polynomial(pair, start, a_q40);
    }
    a_q40[0] = carom_round(boyse_plane_gap_q52(view, c, start), 12);
    return view->to->path.turns
               ? turning_face(view, start, view->to->def.mesh->faces[c->j].offset_q22, a_q40)
               : moving_vertex(view, start, a_q40);
}

/* SPDX-License-Identifier: MIT */
/* A candidate's features at a given time: their places, their distance, and the exact test. */
#include "place.h"

/* ------------------------------------------------------------------ places at t */

/*
 * 2^59 / d for 2^29 <= d <= 2^30, within 2 units: 15 bits by division, the rest by a Newton step y
 * + y (2^45 - d y) / 2^45. The bracket fits 32 bits, being less than 2 d.
 */
static int32_t inverse_q59(uint32_t d)
{
    uint32_t y = UINT32_MAX / (d >> 13);
    int32_t rest = (int32_t)(0 - d * y);

    return (int32_t)(y << 14) + (int32_t)((int64_t)rest * (int32_t)y >> 31);
}

/*
 * Cayley rotation at one time, 1 + k t (1 + c t) [u] + k t^2 (u u^T - s^2), k = 2 / N(t), N(t) = (1
 * + c t)^2 + s^2 t^2 (body.h). r is unset if the body does not turn.
 */
struct turn {
    bool turns;
    carom_m3_q30 r;
};

static void turn_at(struct turn *turn, const struct body_path *path, const carom_v3_q30 *u,
                    int32_t t_q30, int32_t t2_q30)
{
    int32_t k_q29, once[3], twice[3], xx, yy, zz, xy, yz, zx, norm_q30, w_q30;

    turn->turns = path->turns;
    if (!path->turns) {
        return;
    }
    /* s t < 0.31 and c <= s^2: N is 1 to 1.3 */
    w_q30 = carom_mul_q30(path->c_q30, t_q30);
    norm_q30 = carom_mul_q30(body_norm2_q30(path), t2_q30) + 2 * w_q30;
    k_q29 = inverse_q59(((uint32_t)CAROM_ONE_Q30 + (uint32_t)norm_q30) >> 1);
    t_q30 = carom_mul_q30(k_q29, t_q30);
    t_q30 += carom_mul_q30(t_q30, w_q30);
    t2_q30 = carom_mul_q30(k_q29, t2_q30);
    FIX_UNROLL
    for (int i = 0; i < 3; i++) {
        once[i] = (int32_t)carom_round((int64_t)t_q30 * u->c[i], 29);
        twice[i] = (int32_t)carom_round((int64_t)t2_q30 * u->c[i], 29);
    }
    xx = carom_mul_q30(twice[0], u->c[0]);
    yy = carom_mul_q30(twice[1], u->c[1]);
    zz = carom_mul_q30(twice[2], u->c[2]);
    xy = carom_mul_q30(twice[0], u->c[1]);
    yz = carom_mul_q30(twice[1], u->c[2]);
    zx = carom_mul_q30(twice[2], u->c[0]);
    turn->r = (carom_m3_q30){{{CAROM_ONE_Q30 - yy - zz, xy - once[2], zx + once[1]},
                              {xy + once[2], CAROM_ONE_Q30 - zz - xx, yz - once[0]},
                              {zx - once[1], yz + once[0], CAROM_ONE_Q30 - xx - yy}}};
}

/* Turn v, in any format, in place; its length keeps it within int32. */
static void apply(const struct turn *turn, int32_t v[3])
{
    if (turn->turns) {
        carom_rotate(v, &turn->r, v);
    }
}

static void apply_back(const struct turn *turn, int32_t v[3])
{
    if (turn->turns) {
        carom_rotate_back(v, &turn->r, v);
    }
}

/* A view at one time. */
struct moment {
    const struct boyse_view *view;
    struct turn from, to;
    carom_v3_q22 centre; /* of from, in axes that do not turn with `to` */
};

static int32_t set_turns(struct moment *m, const struct boyse_view *view, int32_t t_q30)
{
    int32_t t2_q30 = carom_mul_q30(t_q30, t_q30);

    m->view = view;
    turn_at(&m->from, body_path(view->from), &view->u, t_q30, t2_q30);
    turn_at(&m->to, body_path(view->to), &body_path(view->to)->u, t_q30, t2_q30);
    return t2_q30;
}

static void set_moment(struct moment *m, const struct boyse_view *view, int32_t t_q30)
{
    int32_t t2_q30 = set_turns(m, view, t_q30);

    for (int k = 0; k < 3; k++) {
        /* q24 x q30 = q54: |v t + g t^2| < 2^8 units */
        int64_t way_q54 = (int64_t)view->v.c[k] * t_q30 + (int64_t)view->g.c[k] * t2_q30;

        m->centre.c[k] = view->centre.c[k] + (int32_t)carom_round(way_q54, 32);
    }
}

/*
 * A direction of `from`: from its start, in view axes, to to's mesh axes at this time; and back to
 * from's mesh axes.
 */
static void direction_to(const struct moment *m, const int32_t start[3], int32_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = start[k];
    }
    apply(&m->from, out);
    apply_back(&m->to, out);
}

static void direction_back(const struct moment *m, const int32_t n[3], int32_t out[3])
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        out[k] = n[k];
    }
    apply(&m->to, out);
    apply_back(&m->from, out);
    carom_rotate_back(out, &m->view->r, out);
}

/* A point of `from`, given at the start: in to's mesh axes at this time, from to's centre. */
static carom_v3_q22 point_to(const struct moment *m, const carom_v3_q22 *start)
{
    carom_v3_q22 p;

    for (int k = 0; k < 3; k++) {
        p.c[k] = start->c[k] - m->view->centre.c[k];
    }
    apply(&m->from, p.c);
    for (int k = 0; k < 3; k++) {
        p.c[k] += m->centre.c[k];
    }
    apply_back(&m->to, p.c);
    return p;
}

/* Turn a direction from to's mesh axes to the world's. */
static void to_world(const struct moment *m, int32_t v[3])
{
    apply(&m->to, v);
    carom_rotate(v, &m->view->to->path.start.r, v);
}

/* The features of a candidate at one time. */
static void place(const struct moment *m, const struct candidate *c,
                  const struct boyse_places *start, struct boyse_places *p)
{
    p->vertex = point_to(m, &start->vertex);
    if (c->kind != CANDIDATE_EDGE_EDGE) {
        p->n = start->n;
        return;
    }
    p->edge_a = start->edge_a;
    p->edge_b = start->edge_b;
    p->start_b = start->start_b;
    p->f = start->f;
    direction_to(m, start->e, p->e);
    boyse_complete_edges(p);
}

/*
 * Two-sided meshes. The other body's features tell which side a touch is on: N enters them. The far
 * side of a body thinner than the skin would touch, too, as deep as the body is thick. So a touch
 * that is deep counts only on the front, and not of a body whose centre is under the surface.
 */

/*
 * True if a touch of a two-sided mesh counts; n_z: the z of N in its axes, or its sign; centre: of the
 * other body, in its axes.
 */
static inline bool counts(const struct boyse_touch *touch, int32_t n_z,
                          const struct carom_mesh *surface, const carom_v3_q22 *centre)
{
    return touch->gap_q22 >= BOYSE_BEHIND_Q22 || (n_z > 0 && !mesh_under(surface, centre));
}

/* The centre of `to` in the mesh axes of `from`, which does not turn. */
static carom_v3_q22 centre_back(const struct moment *m)
{
    carom_v3_q22 centre = {{0, 0, 0}};

    carom_rotate_back(centre.c, &m->view->r, m->centre.c);
    for (int k = 0; k < 3; k++) {
        centre.c[k] = -centre.c[k];
    }
    return centre;
}

/* --------------------------------------------------------- a vertex and a face */

/* Judge a vertex over a two-sided face with normal n, in the vertex's mesh axes. */
static FIX_OWN_FRAME void test_either_side(const struct moment *m, const struct candidate *c,
                                           const int32_t n[3], struct boyse_touch *touch)
{
    /* a vertex in a plane of its body may be on either side */
    if (mesh_vertex_below(m->view->from->def.mesh, c->i, n, INTERFERE_CONE_Q30) &&
        (!touch->valid || mesh_under(m->view->to->def.mesh, &m->centre))) {
        touch->valid = true;
        touch->sign = -1;
        touch->gap_q22 = -touch->gap_q22;
    }
    touch->valid = touch->valid && counts(touch, touch->sign, m->view->to->def.mesh, &m->centre);
}

/* True if a touch of a vertex of a two-sided mesh counts. n: the face's normal in the vertex's axes. */
static FIX_OWN_FRAME bool vertex_counts(const struct moment *m, const struct candidate *c,
                                        const int32_t n[3], const struct boyse_touch *touch)
{
    const struct carom_mesh *surface = m->view->from->def.mesh;
    const carom_v3_q22 centre = centre_back(m);

    return counts(touch, -n[2], surface, &centre) &&
           (n[2] > 0 || !mesh_vertex_behind(surface, c->i));
}

static void test_vertex_face(const struct moment *m, const struct candidate *c,
                             const struct boyse_places *p, struct boyse_touch *touch)
{
    int32_t n[3];

    touch->gap_q22 = (int32_t)(boyse_plane_gap_q52(m->view, c, p) >> 30);
    touch->sign = 1;
    touch->valid = false;
    if (mesh_over_face(m->view->to->def.mesh, c->j, &p->vertex, BOYSE_POINT_NOISE_Q22)) {
        direction_back(m, p->n, n);
        touch->valid = mesh_vertex_cone(m->view->from->def.mesh, c->i, n, INTERFERE_CONE_Q30);
        if (mesh_two_sided(m->view->to->def.mesh)) {
            test_either_side(m, c, n, touch);
        } else if (touch->valid && mesh_two_sided(m->view->from->def.mesh)) {
            touch->valid = vertex_counts(m, c, n, touch);
        }
    }
}

/* ------------------------------------------------------------------ two edges */

/* 1 / |w| as m 2^-(29 - up), |w| in its extended digits. */
struct inverse {
    int32_t m; /* 2^29 .. 2^30 */
    int up;    /* 0 .. 9 */
};

static struct inverse inverse_of(int32_t sine_q30)
{
    uint32_t d = sine_q30 > BOYSE_FINE_Q30 ? (uint32_t)sine_q30 : BOYSE_FINE_Q30;
    int up = 30 - fix_bits32(d);

    /* the sine is 1, or a little more by rounding */
    return up < 0 ? (struct inverse){1 << 29, 0} : (struct inverse){inverse_q59(d << up), up};
}

/* v times the inverse, rounded down; |v| < 2^51. */
static int64_t over_sine(int64_t v, struct inverse sine)
{
    uint64_t wide = (uint64_t)v << (3 + sine.up);
    uint32_t low = (uint32_t)((wide & 0xffffffffu) * (uint32_t)sine.m >> 32);

    return (int64_t)(int32_t)(uint32_t)(wide >> 32) * sine.m + low;
}

/* w.d keeps q32 until the division by |w|, so nearly parallel edges lose no digits. */
static int32_t edge_gap(int64_t wd_q52, struct inverse sine, int sign)
{
    int64_t gap = over_sine(sign * wd_q52 >> 20, sine) >> 10;

    if (gap > INT32_MAX || gap < -INT32_MAX) {
        return gap > 0 ? INT32_MAX : -INT32_MAX; /* nearly parallel and far apart */
    }
    return (int32_t)gap;
}

/* The unit normal w / |w| of two edges, in both bodies' mesh axes. */
struct edge_normal {
    int32_t on_a[3], on_b[3];
};

static void set_normal(int32_t n_q30[3], const struct boyse_places *p, struct inverse sine)
{
    for (int k = 0; k < 3; k++) {
        n_q30[k] = (int32_t)carom_round((int64_t)p->w[k] * sine.m, 29 - sine.up);
    }
}

/*
 * -(d x f).N, N = w / |w|: |w| times the place on a's edge where b's line comes nearest, measured
 * from a's start. The tolerance applies to this number, since rounding is in it, as for a vertex
 * over a face.
 */
static int32_t aside_q22(const int32_t d[3], const int32_t along_q30[3], const int32_t n_q30[3])
{
    int32_t across[3];

    carom_cross(across, d, along_q30, 30);
    return -(int32_t)carom_round(carom_dot(across, n_q30), 30);
}

static bool within(int64_t aside_q22, int64_t end_q22)
{
    return aside_q22 >= -BOYSE_POINT_NOISE_Q22 && aside_q22 <= end_q22 + BOYSE_POINT_NOISE_Q22;
}

/*
 * Place on b's line of the nearest approach; if that is beyond an end of a's edge, the place
 * nearest to that end. Nearly parallel edges may follow each other along nearly one line and have
 * no place in common.
 */
static int64_t place_on_b_q22(const struct boyse_places *p, int64_t aside_q22, int64_t length_q22,
                              int32_t sine_q30)
{
    int32_t cosine_q30 = (int32_t)carom_round(carom_dot(p->e, p->f), 30);
    int64_t s_q22 = 0;

    if (aside_q22 >= length_q22) {
        s_q22 = p->edge_a->length_q22;
    } else if (aside_q22 > 0) {
        /* below edge length times sine before the shift, hence below 2^61 */
        s_q22 = (aside_q22 << (30 + p->up)) / sine_q30;
    }
    return p->on_b_q22 + ((s_q22 * cosine_q30) >> 30);
}

/* True if the places of nearest approach on both lines are on the edges. */
static bool meet_on_edges(const struct boyse_places *p, const int32_t n_q30[3], int32_t sine_q30)
{
    int64_t length_a = (int64_t)p->edge_a->length_q22 * sine_q30 >> (30 + p->up);
    int64_t length_b = (int64_t)p->edge_b->length_q22 * sine_q30 >> 30;
    int32_t on_a = aside_q22(p->d, p->f, n_q30);

    if (!within(on_a, length_a)) {
        return false;
    }
    return p->up > 0 ? within(place_on_b_q22(p, on_a, length_a, sine_q30), p->edge_b->length_q22)
                     : within(aside_q22(p->d, p->e, n_q30), length_b);
}

/*
 * The direction N = w / |w| relative to the faces of both edges, as cosines. out: the largest
 * component of the faces along N, b's outwards and a's against it. N leaves b's edge outwards and
 * enters a's, into no face on either side, if most <= 0; -N does if least >= 0.
 */
struct cones {
    int32_t out, most, least;
    bool border; /* one edge has a face on one side only: N may look away from it */
};

static inline int32_t cosine_q30(const int32_t a[3], const int32_t b[3])
{
    return (int32_t)(carom_dot(a, b) >> 30);
}

/*
 * Add an edge's faces. At an edge of direction d the inward direction in a face with normal f is f
 * x d, and N.(f x d) = f.(d x N); the other side has the opposite sign.
 */
static void add_cones(struct cones *cones, const struct carom_mesh *mesh,
                      const struct carom_edge *edge, const int32_t n[3], bool outwards)
{
    int32_t across[3];

    carom_cross(across, edge->direction.c, n, 30);
    for (int side = 0; side < 2; side++) {
        if (edge->face[side] != CAROM_NO_FACE) {
            const int32_t *face = mesh->faces[edge->face[side]].normal.c;
            int32_t along = cosine_q30(face, n) >> 2, inward = cosine_q30(face, across);

            inward = (side == 0) == outwards ? inward : -inward;
            cones->out += outwards ? along : -along;
            cones->most = inward > cones->most ? inward : cones->most;
            cones->least = inward < cones->least ? inward : cones->least;
        } else {
            cones->border = true;
        }
    }
}

/*
 * Sign of N, by the way that the faces of both edges look. Nearly flat edges have both signs within
 * the tolerance of their cones. Taken together the two faces of a convex edge look along any N
 * between them, so a sign that only the tolerance allows is rejected. Those of a two-sided mesh may
 * look either way, but at an edge that bends inwards N leads behind it. 0: neither sign is possible.
 */
static int sign_of(const struct moment *m, const struct boyse_places *p,
                   const struct edge_normal *n)
{
    const struct carom_mesh *of_b = m->view->to->def.mesh;
    struct cones cones = {0, 0, 0, false};
    int sign, only = 0;

    add_cones(&cones, of_b, p->edge_b, n->on_b, true);
    if (mesh_two_sided(of_b)) {
        if (mesh_edge_behind(of_b, (uint32_t)(p->edge_b - of_b->edges))) {
            only = cones.out > 0 ? -1 : 1;
        }
        cones.out = 0;
        cones.border = false;
    }
    add_cones(&cones, m->view->from->def.mesh, p->edge_a, n->on_a, false);
    sign = cones.out >= 0 ? 1 : -1;
    for (int turn = 0; turn < 2; turn++, sign = -sign) {
        if (sign != -only && (sign > 0 ? cones.most : -cones.least) <= INTERFERE_CONE_Q30 &&
            (cones.border || sign * cones.out >= -INTERFERE_CONE_Q30)) {
            return sign;
        }
    }
    return 0;
}

/* Exact test of two edges. Returns |w| as it is in P; sets n if the touch is valid. */
static int32_t test_edges(const struct moment *m, const struct boyse_places *p,
                          struct boyse_touch *touch, struct edge_normal *n)
{
    int32_t sine_q30 = (int32_t)fix_sqrt((uint64_t)carom_dot(p->w, p->w));
    const struct inverse sine = inverse_of(sine_q30);
    const int64_t wd_q52 = carom_dot(p->w, p->d);
    bool turns = m->from.turns || m->to.turns;

    touch->valid = false;
    touch->sign = 1;
    if (sine_q30 >> p->up >= BOYSE_PARALLEL_Q30) {
        set_normal(n->on_b, p, sine);
        if (meet_on_edges(p, n->on_b, sine_q30)) {
            int sign;

            direction_back(m, n->on_b, n->on_a);
            sign = sign_of(m, p, n);
            touch->valid = sign != 0;
            touch->sign = (int8_t)(sign < 0 ? -1 : 1);
        }
    }
    touch->gap_q22 = edge_gap(wd_q52, sine, touch->sign);
    if (touch->valid && touch->gap_q22 < BOYSE_BEHIND_Q22 &&
        mesh_two_sided(m->view->to->def.mesh)) {
        touch->valid = counts(touch, touch->sign * n->on_b[2], m->view->to->def.mesh, &m->centre);
    }
    return turns ? sine_q30 >> p->up : sine_q30;
}

/* -------------------------------------------------------------- the exact test */

int32_t boyse_scale(const struct boyse_pair *pair, int32_t t_q30)
{
    const struct boyse_places *start = &pair->start;
    struct moment m;
    int32_t e[3], w[3];

    if (boyse_steady(pair)) {
        return (int32_t)fix_sqrt((uint64_t)carom_dot(start->w, start->w));
    }
    set_turns(&m, &pair->view[0], t_q30);
    direction_to(&m, start->e, e);
    carom_cross(w, e, start->f, 30);
    return (int32_t)fix_sqrt((uint64_t)carom_dot(w, w));
}

int32_t boyse_test(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                   struct boyse_touch *touch)
{
    struct moment m;
    struct edge_normal n;

    set_moment(&m, boyse_view(pair, c), t_q30);
    place(&m, c, &pair->start, &pair->now);
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        return test_edges(&m, &pair->now, touch, &n);
    }
    test_vertex_face(&m, c, &pair->now, touch);
    return CAROM_ONE_Q30;
}

/* boyse_test with the normal in world axes. */
static void touch_at(const struct moment *m, const struct candidate *c,
                     const struct boyse_places *p, struct boyse_touch *touch)
{
    struct edge_normal n;
    const int32_t *normal = n.on_b;
    int sign;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        (void)test_edges(m, p, touch, &n);
        sign = touch->sign;
    } else {
        test_vertex_face(m, c, p, touch);
        normal = p->n; /* the face's */
        sign = c->kind == CANDIDATE_VERTEX_FACE ? touch->sign : -1;
    }
    if (!touch->valid) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        touch->normal.c[k] = sign * normal[k];
    }
    to_world(m, touch->normal.c);
}

void boyse_touch(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                 struct boyse_touch *touch)
{
    struct moment m;

    boyse_place_start(pair, c);
    set_moment(&m, boyse_view(pair, c), t_q30);
    place(&m, c, &pair->start, &pair->now);
    touch_at(&m, c, &pair->now, touch);
}

void boyse_touch_start(const struct boyse_pair *pair, const struct candidate *c,
                       struct boyse_touch *touch)
{
    struct moment m;

    m.view = boyse_view(pair, c);
    m.from.turns = m.to.turns = false;
    m.centre = m.view->centre;
    touch_at(&m, c, &pair->start, touch);
}

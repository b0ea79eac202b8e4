/* SPDX-License-Identifier: MIT */
/* An exact oracle: the faces of two posed meshes that have a common point. */
#include "crossing.h"
#include "real.h"

/* ------------------------------------------------------------------ triangles */

static int sign(int64_t v)
{
    return (v > 0) - (v < 0);
}

/* The sign of n . w, exactly: |n| < 2^60, |w| < 2^29 in each component. */
static int sign_of_dot(const int64_t n[3], const int64_t w[3])
{
    int64_t high = 0, low = 0;

    for (int k = 0; k < 3; k++) {
        int64_t part = n[k] / ((int64_t)1 << 30);

        high += part * w[k];
        low += (n[k] - part * ((int64_t)1 << 30)) * w[k];
    }
    high += low / ((int64_t)1 << 30);
    low %= (int64_t)1 << 30;
    return high != 0 ? sign(high) : sign(low);
}

static void minus(int64_t out[3], const int32_t a[3], const int32_t b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = (int64_t)a[k] - b[k];
    }
}

static void normal_of(int64_t n[3], const int32_t a[3], const int32_t b[3], const int32_t c[3])
{
    int64_t u[3], v[3];

    minus(u, b, a);
    minus(v, c, a);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        n[k] = u[i] * v[j] - u[j] * v[i];
    }
}

/* The side of the plane a b c on which a point is: 1 where the corners run counter-clockwise. */
static int side(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t p[3])
{
    int64_t n[3], w[3];

    normal_of(n, a, b, c);
    minus(w, p, a);
    return sign_of_dot(n, w);
}

/* The same for the line a b in a plane, by coordinates i and j. */
static int side_2d(const int32_t a[3], const int32_t b[3], const int32_t p[3], int i, int j)
{
    return sign(((int64_t)b[i] - a[i]) * ((int64_t)p[j] - a[j]) -
                ((int64_t)b[j] - a[j]) * ((int64_t)p[i] - a[i]));
}

/* Whether three signs agree; a zero agrees with both signs. */
static bool agree(int a, int b, int c)
{
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/* Whether the extents of a b and c d along a coordinate overlap. */
static bool spans_meet(const int32_t a[3], const int32_t b[3], const int32_t c[3],
                       const int32_t d[3], int k)
{
    return !((a[k] < c[k] && a[k] < d[k] && b[k] < c[k] && b[k] < d[k]) ||
             (a[k] > c[k] && a[k] > d[k] && b[k] > c[k] && b[k] > d[k]));
}

/* Whether two segments in one plane meet. */
static bool segments_meet(const int32_t a[3], const int32_t b[3], const int32_t c[3],
                          const int32_t d[3], int i, int j)
{
    return side_2d(a, b, c, i, j) * side_2d(a, b, d, i, j) <= 0 &&
           side_2d(c, d, a, i, j) * side_2d(c, d, b, i, j) <= 0 && spans_meet(a, b, c, d, i) &&
           spans_meet(a, b, c, d, j);
}

/* Whether a segment in the plane of a triangle with normal n meets the triangle. */
static bool meets_in_plane(const int32_t a[3], const int32_t b[3], const int32_t t[3][3],
                           const int64_t n[3])
{
    int i = n[0] != 0 ? 1 : n[1] != 0 ? 2 : 0, j = (i + 1) % 3;

    for (int k = 0; k < 3; k++) {
        if (segments_meet(a, b, t[k], t[(k + 1) % 3], i, j)) {
            return true;
        }
    }
    return agree(side_2d(t[0], t[1], a, i, j), side_2d(t[1], t[2], a, i, j),
                 side_2d(t[2], t[0], a, i, j));
}

/* Whether an edge of p meets q; the sides of q's plane on which p's corners are are given. */
static bool edges_meet(const int32_t p[3][3], const int32_t q[3][3], const int sides[3],
                       const int64_t n[3])
{
    for (int k = 0; k < 3; k++) {
        const int32_t *a = p[k], *b = p[(k + 1) % 3];
        int on_a = sides[k], on_b = sides[(k + 1) % 3];

        if (on_a == 0 && on_b == 0) {
            if (meets_in_plane(a, b, q, n)) {
                return true;
            }
        } else if (on_a * on_b <= 0 &&
                   agree(side(a, b, q[0], q[1]), side(a, b, q[1], q[2]), side(a, b, q[2], q[0]))) {
            return true;
        }
    }
    return false;
}

bool crossing_triangles(const int32_t p[3][3], const int32_t q[3][3])
{
    int64_t n_p[3], n_q[3];
    int of_p[3], of_q[3];

    normal_of(n_p, p[0], p[1], p[2]);
    normal_of(n_q, q[0], q[1], q[2]);
    if (!(n_p[0] | n_p[1] | n_p[2]) || !(n_q[0] | n_q[1] | n_q[2])) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        of_p[k] = side(q[0], q[1], q[2], p[k]);
        of_q[k] = side(p[0], p[1], p[2], q[k]);
    }
    if (of_p[0] * of_p[1] * of_p[2] != 0 && of_p[0] == of_p[1] && of_p[1] == of_p[2]) {
        return false;
    }
    return edges_meet(p, q, of_p, n_q) || edges_meet(q, p, of_q, n_p);
}

/* --------------------------------------------------------------------- meshes */

void crossing_place(struct crossing_body *body, const carom_v3_q32 *position,
                    const carom_quat_q30 *rotation, const carom_v3_q32 *origin)
{
    const struct carom_mesh *mesh = body->mesh;
    double q[4], m[3][3];

    for (int k = 0; k < 4; k++) {
        q[k] = rotation->c[k];
    }
    real_matrix(m, q);
    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        double local[3], p[3];

        for (int k = 0; k < 3; k++) {
            local[k] = real(mesh->raw.vertices[v][k], mesh->raw.quantum_bits) -
                       real(mesh->mass.centre.c[k], 22);
        }
        real_rotate(p, m, local);
        for (int k = 0; k < 3; k++) {
            p[k] += real(position->c[k] - origin->c[k], 32);
            body->p_q22[v][k] = (int32_t)real_round(p[k] * real_power2(22));
        }
    }
}

/* The box of a face, or of a whole mesh. */
static void begin_box(struct crossing_face *box)
{
    for (int k = 0; k < 3; k++) {
        box->low_q22[k] = INT32_MAX;
        box->high_q22[k] = INT32_MIN;
    }
}

static void widen(struct crossing_face *box, const int32_t p[3])
{
    for (int k = 0; k < 3; k++) {
        box->low_q22[k] = p[k] < box->low_q22[k] ? p[k] : box->low_q22[k];
        box->high_q22[k] = p[k] > box->high_q22[k] ? p[k] : box->high_q22[k];
    }
}

static bool boxes_meet(const struct crossing_face *a, const struct crossing_face *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low_q22[k] > b->high_q22[k] || a->high_q22[k] < b->low_q22[k]) {
            return false;
        }
    }
    return true;
}

static struct crossing_face bounds(const struct crossing_body *body)
{
    struct crossing_face box;

    begin_box(&box);
    for (uint32_t v = 0; v < body->mesh->raw.vertex_count; v++) {
        widen(&box, body->p_q22[v]);
    }
    return box;
}

/* List the faces whose boxes overlap a box; returns how many. */
static uint32_t list_near(struct crossing_body *body, const struct crossing_face *box)
{
    uint32_t count = 0;

    for (uint32_t f = 0; f < body->mesh->raw.face_count; f++) {
        struct crossing_face *face = &body->near[count];

        begin_box(face);
        for (int k = 0; k < 3; k++) {
            memcpy(face->p_q22[k], body->p_q22[body->mesh->raw.faces[f][k]], sizeof face->p_q22[k]);
            widen(face, face->p_q22[k]);
        }
        face->number = f;
        count += boxes_meet(face, box);
    }
    return count;
}

void crossing_compare(struct crossing_body *a, struct crossing_body *b,
                      const struct carom_face_pair *found, uint32_t count, uint8_t *bits,
                      struct crossing_tally *tally)
{
    struct crossing_face box_a = bounds(a), box_b = bounds(b);
    uint32_t near_a = list_near(a, &box_b), near_b = list_near(b, &box_a), crossing = 0;
    size_t row = b->mesh->raw.face_count;

    for (uint32_t i = 0; i < count; i++) {
        size_t place = found[i].a * row + found[i].b;

        tally->repeated += bits[place / 8] >> place % 8 & 1;
        bits[place / 8] |= (uint8_t)(1 << place % 8);
    }
    for (const struct crossing_face *p = a->near; p < a->near + near_a; p++) {
        for (const struct crossing_face *q = b->near; q < b->near + near_b; q++) {
            size_t place = p->number * row + q->number;

            if (boxes_meet(p, q) &&
                crossing_triangles((const int32_t(*)[3])p->p_q22, (const int32_t(*)[3])q->p_q22)) {
                crossing++;
                tally->missed += !(bits[place / 8] >> place % 8 & 1);
            }
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        bits[(found[i].a * row + found[i].b) / 8] = 0;
    }
    tally->poses++;
    tally->touching += crossing > 0;
    tally->crossing += crossing;
    tally->found += count;
}

/* --------------------------------------------------------------- convex bodies */

static void apart(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

void crossing_place_hull(struct crossing_hull *hull, const struct carom_mesh *mesh,
                         const double position[3], const double rotation[4])
{
    double q[4], m[3][3];

    memcpy(q, rotation, sizeof q);
    real_matrix(m, q);
    hull->corners = mesh->raw.vertex_count;
    hull->faces = mesh->raw.face_count;
    hull->edges = 0;
    for (uint32_t v = 0; v < hull->corners; v++) {
        double local[3];

        for (int k = 0; k < 3; k++) {
            local[k] = real(mesh->raw.vertices[v][k], mesh->raw.quantum_bits) -
                       real(mesh->mass.centre.c[k], 22);
        }
        real_rotate(hull->p[v], m, local);
        for (int k = 0; k < 3; k++) {
            hull->p[v][k] += position[k];
        }
    }
    for (uint32_t f = 0; f < hull->faces; f++) {
        const uint16_t *corner = mesh->raw.faces[f];
        double u[3], v[3];

        apart(u, hull->p[corner[1]], hull->p[corner[0]]);
        apart(v, hull->p[corner[2]], hull->p[corner[0]]);
        real_cross(hull->normal[f], u, v);
        for (int k = 0; k < 3; k++) {
            int from = corner[k], to = corner[(k + 1) % 3];

            if (from < to) {
                apart(hull->edge[hull->edges++], hull->p[to], hull->p[from]);
            }
        }
    }
}

/* The gap along a direction, in either order; a direction of no length shows none. */
static double apart_along(const struct crossing_hull *a, const struct crossing_hull *b,
                          const double n[3], double least_length)
{
    double low[2], high[2], length = real_length(n), one, other;

    if (length <= least_length) {
        return -1e30;
    }
    for (int i = 0; i < 2; i++) {
        const struct crossing_hull *h = i == 0 ? a : b;

        low[i] = high[i] = real_dot(n, h->p[0]);
        for (uint32_t v = 1; v < h->corners; v++) {
            double at = real_dot(n, h->p[v]);

            low[i] = at < low[i] ? at : low[i];
            high[i] = at > high[i] ? at : high[i];
        }
    }
    one = low[0] - high[1];
    other = low[1] - high[0];
    return (one > other ? one : other) / length;
}

double crossing_apart(const struct crossing_hull *a, const struct crossing_hull *b)
{
    double most = -1e30, found;

    for (uint32_t i = 0; i < a->faces; i++) {
        found = apart_along(a, b, a->normal[i], 0);
        most = found > most ? found : most;
    }
    for (uint32_t i = 0; i < b->faces; i++) {
        found = apart_along(a, b, b->normal[i], 0);
        most = found > most ? found : most;
    }
    for (uint32_t i = 0; i < a->edges; i++) {
        for (uint32_t j = 0; j < b->edges; j++) {
            double n[3], size = real_length(a->edge[i]) * real_length(b->edge[j]);

            real_cross(n, a->edge[i], b->edge[j]);
            found = apart_along(a, b, n, 1e-10 * size);
            most = found > most ? found : most;
        }
    }
    return most;
}

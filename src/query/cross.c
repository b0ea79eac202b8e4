/* SPDX-License-Identifier: MIT */
/*
 * Do two bodies have a common point at their poses? a's vertices are carried into b's axes and
 * rounded once, to integers as fine as 30 bits allow; b's vertices are integers there. From then on
 * everything is exact: signs of volumes and areas decide, and touching counts.
 */
#include "../num/plane.h"
#include "cross.h"

typedef struct interfere_vec place;

/* Coordinates are below 2^29. */
#define PLACE_BITS 29

static inline place minus(const place *a, const place *b)
{
    return (place){{a->c[0] - b->c[0], a->c[1] - b->c[1], a->c[2] - b->c[2]}};
}

static inline int sign_of(int64_t v)
{
    return (v > 0) - (v < 0);
}

/*
 * The side of the plane through a, b, c on which p lies: 1 if a, b, c run counter-clockwise seen
 * from p. Bounds: differences are below 2^30, the cross product below 2^61, the sum below 2^93.
 */
static int side_of_plane(const place *a, const place *b, const place *c, const place *p)
{
    const place e = minus(b, a), f = minus(c, a), d = minus(p, a);
    int64_t n[3];
    struct fix_wide volume;

    fix_cross(n, e.c, f.c);
    volume = fix_wide_mul(n[0], d.c[0]);
    fix_wide_add_product(&volume, n[1], d.c[1]);
    fix_wide_add_product(&volume, n[2], d.c[2]);
    return fix_wide_sign(&volume);
}

/* ------------------------------------------------------------------- in a plane */

/* The two axes along which places in a plane are compared. */
struct plane_axes {
    int i, j;
};

/* The side of the line from a to b on which p lies. Bounds: below 2^61. */
static int side_of_line(struct plane_axes s, const place *a, const place *b, const place *p)
{
    return sign_of((int64_t)(b->c[s.i] - a->c[s.i]) * (p->c[s.j] - a->c[s.j]) -
                   (int64_t)(b->c[s.j] - a->c[s.j]) * (p->c[s.i] - a->c[s.i]));
}

/* True if the intervals a-b and c-d overlap along axis k. */
static bool intervals_meet(int k, const place *a, const place *b, const place *c, const place *d)
{
    return fix_smaller(a->c[k], b->c[k]) <= fix_larger(c->c[k], d->c[k]) &&
           fix_smaller(c->c[k], d->c[k]) <= fix_larger(a->c[k], b->c[k]);
}

static bool segments_meet(struct plane_axes s, const place *a, const place *b, const place *c,
                          const place *d)
{
    return side_of_line(s, a, b, c) * side_of_line(s, a, b, d) <= 0 &&
           side_of_line(s, c, d, a) * side_of_line(s, c, d, b) <= 0 &&
           intervals_meet(s.i, a, b, c, d) && intervals_meet(s.j, a, b, c, d);
}

/* True if no two of three signs are opposite. */
static bool agree(int x, int y, int z)
{
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

/* True if an edge in the plane of a triangle meets it. */
static bool edge_meets_in_plane(const place t[3], const place *a, const place *b)
{
    const place e = minus(&t[1], &t[0]), f = minus(&t[2], &t[0]);
    struct plane_axes s;
    int64_t n[3];
    int most;

    fix_cross(n, e.c, f.c);
    most = carom_abs(n[1]) > carom_abs(n[0]) ? 1 : 0;
    most = carom_abs(n[2]) > carom_abs(n[most]) ? 2 : most;
    if (n[most] == 0) {
        return false; /* rounded to a line: its edges belong to other faces, too */
    }
    s.i = fix_next(most);
    s.j = fix_next(s.i);
    return segments_meet(s, a, b, &t[0], &t[1]) || segments_meet(s, a, b, &t[1], &t[2]) ||
           segments_meet(s, a, b, &t[2], &t[0]) ||
           agree(side_of_line(s, &t[0], &t[1], a), side_of_line(s, &t[1], &t[2], a),
                 side_of_line(s, &t[2], &t[0], a));
}

/* -------------------------------------------------------------------- triangles */

/* True if an edge meets a triangle, given the sides of its ends to the triangle's plane. */
static bool edge_meets(const place t[3], const place *a, const place *b, int side_a, int side_b)
{
    if (side_a * side_b > 0) {
        return false;
    }
    if (side_a == 0 && side_b == 0) {
        return edge_meets_in_plane(t, a, b);
    }
    return agree(side_of_plane(a, &t[0], &t[1], b), side_of_plane(a, &t[1], &t[2], b),
                 side_of_plane(a, &t[2], &t[0], b));
}

/* True if an edge of p meets q, given the sides of p's corners to q's plane. */
static bool edges_meet(const place p[3], const place q[3], const int side[3])
{
    return edge_meets(q, &p[0], &p[1], side[0], side[1]) ||
           edge_meets(q, &p[1], &p[2], side[1], side[2]) ||
           edge_meets(q, &p[2], &p[0], side[2], side[0]);
}

bool cross_triangles(const struct interfere_vec p[3], const struct interfere_vec q[3])
{
    int of_p[3], of_q[3];

    for (int k = 0; k < 3; k++) {
        of_p[k] = side_of_plane(&q[0], &q[1], &q[2], &p[k]);
    }
    if (of_p[0] != 0 && of_p[1] == of_p[0] && of_p[2] == of_p[0]) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        of_q[k] = side_of_plane(&p[0], &p[1], &p[2], &q[k]);
    }
    if (of_q[0] != 0 && of_q[1] == of_q[0] && of_q[2] == of_q[0]) {
        return false;
    }
    /* if two triangles meet an edge of one meets the other */
    return edges_meet(p, q, of_p) || edges_meet(q, p, of_q);
}

/* ----------------------------------------------------------------------- places */

/*
 * A vertex of a in b's axes, from b's origin. Bounds: faces are only tested if their boxes meet;
 * farther places are clamped.
 */
static place carried(const struct cross *c, uint32_t vertex)
{
    carom_v3_q22 v = mesh_vertex(c->a.body->def.mesh, vertex);
    place p;

    for (int k = 0; k < 3; k++) {
        int64_t x = carom_round(carom_dot(c->to_b.c[k], v.c) + c->at_q52[k], 52 - c->bits);
        int64_t most = (int64_t)1 << PLACE_BITS;

        p.c[k] = (int32_t)(x > most ? most : x < -most ? -most : x);
    }
    return p;
}

static place of_b(const struct cross *c, uint32_t vertex)
{
    const struct carom_mesh *mesh = c->b.body->def.mesh;
    const int16_t *v = mesh->raw.vertices[vertex];
    const int32_t one = (int32_t)1 << (c->bits - mesh->raw.quantum_bits);

    return (place){{v[0] * one, v[1] * one, v[2] * one}};
}

static void set_triangle(const struct cross *c, bool of_a, uint16_t face, place t[3])
{
    const struct carom_mesh *mesh = of_a ? c->a.body->def.mesh : c->b.body->def.mesh;

    for (int k = 0; k < 3; k++) {
        t[k] = of_a ? carried(c, mesh->raw.faces[face][k]) : of_b(c, mesh->raw.faces[face][k]);
    }
}

static bool sure_cross(struct interfere_sure *self, uint16_t face_a, uint16_t face_b)
{
    const struct cross *c = (const struct cross *)self;
    place p[3], q[3];

    set_triangle(c, true, face_a, p);
    set_triangle(c, false, face_b, q);
    return cross_triangles(p, q);
}

/* Fractional bits of places, such that b and all that a can reach of it fit. */
static int bits_for(const struct cross *c)
{
    const struct carom_mesh *mesh = c->b.body->def.mesh;
    int64_t most = 0;

    for (int k = 0; k < 3; k++) {
        most = fix_larger((int32_t)most, fix_larger(-mesh->box[0][k], mesh->box[1][k]));
    }
    most = (most << (22 - mesh->raw.quantum_bits)) + 2 * (int64_t)c->a.body->def.radius_q22 + 1024;
    return 22 + PLACE_BITS - fix_bits((uint64_t)most);
}

void cross_begin(struct cross *c, struct interfere_placed a, struct interfere_placed b)
{
    carom_m3_q30 r_a, r_b;
    int64_t at_q32[3];

    c->base.cross = sure_cross;
    c->a = a;
    c->b = b;
    c->bits = bits_for(c);
    fix_matrix(&r_a, &a.state->rotation);
    fix_matrix(&r_b, &b.state->rotation);
    interfere_relate(&c->to_b, &r_b, &r_a);
    for (int k = 0; k < 3; k++) {
        at_q32[k] = a.state->position.c[k] - b.state->position.c[k];
    }
    fix_rotate_back(at_q32, &r_b, at_q32);
    for (int k = 0; k < 3; k++) {
        /* bodies farther apart do not meet */
        int64_t far = (int64_t)1 << 41,
                x = at_q32[k] + carom_shl(b.body->def.mesh->mass.centre.c[k], 10);

        c->at_q52[k] = carom_shl(x > far ? far : x < -far ? -far : x, 20);
    }
}

/* ------------------------------------------------------------------ containment */

/* For a triangle above p: 1 if it looks up, -1 if it looks down. 0 for any other. */
static int is_over(const place t[3], const place *p)
{
    int side = plane_over(t[0].c, t[1].c, t[2].c, p->c);

    return side != 0 && side_of_plane(&t[0], &t[1], &t[2], p) == -side ? side : 0;
}

/* Winding number: upward minus downward faces above p, over all faces of a or b. */
static int winding(const struct cross *c, bool of_a, const place *p)
{
    const uint32_t faces = (of_a ? c->a : c->b).body->def.mesh->raw.face_count;
    int sum = 0;

    for (uint32_t face = 0; face < faces; face++) {
        place t[3];

        set_triangle(c, of_a, (uint16_t)face, t);
        sum += is_over(t, p);
    }
    return sum;
}

/* winding of b, by the z-list of a cell. */
static int winding_in_cell(const struct cross *c, const place *p)
{
    const struct carom_mesh *mesh = c->b.body->def.mesh;
    const int shift = c->bits - mesh->raw.quantum_bits;
    const int32_t at[3] = {p->c[0] >> shift, p->c[1] >> shift, p->c[2] >> shift};
    const struct interfere_cells cells = interfere_cells_under(mesh, at, at);
    const uint32_t *start = &mesh->cell_start[cells.row[0] * mesh->grid_nx + cells.col[0]];
    int sum = 0;

    for (uint32_t i = start[0]; i < start[1] && mesh->zrefs[i].z1 >= at[2]; i++) {
        place t[3];

        set_triangle(c, false, mesh->zrefs[i].face, t);
        sum += is_over(t, p);
    }
    return sum;
}

bool cross_inside(const struct cross *c)
{
    const struct carom_mesh *mesh = c->b.body->def.mesh;
    const place p = carried(c, 0);
    const int32_t one = (int32_t)1 << (c->bits - mesh->raw.quantum_bits);

    for (int k = 0; k < 3; k++) {
        /* under a surface counts as inside, however deep */
        bool deep = k == 2 && mesh->raw.kind == CAROM_SURFACE;

        if (p.c[k] > mesh->box[1][k] * one || (!deep && p.c[k] < mesh->box[0][k] * one)) {
            return false;
        }
    }
    return (mesh_lists_in_step(mesh) ? winding(c, false, &p) : winding_in_cell(c, &p)) > 0;
}

bool cross_around(const struct cross *c)
{
    const place p = of_b(c, 0);
    const int64_t radius = ((int64_t)c->a.body->def.radius_q22 << 30 >> (52 - c->bits)) + 1;

    for (int k = 0; k < 3; k++) {
        if (carom_abs(p.c[k] - (c->at_q52[k] >> (52 - c->bits))) > radius) {
            return false;
        }
    }
    return winding(c, true, &p) > 0;
}

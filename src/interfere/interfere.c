/* SPDX-License-Identifier: MIT */
/*
 * Find the faces of b that a's leaves come near during the span: sweep each leaf's sphere, cull it
 * by box and height, walk the cells under it.
 *
 * Notation: seen from b, a point of a moves within `near` of the straight line from x - shift / 2
 * to x + shift / 2, x being its place at mid-span. If it meets a point y of b during the span, then
 * |k.(x - y)| <= |k| near + |k.shift| / 2 for every vector k. Each cull in this folder uses that
 * bound. A leaf has one shift, its centre's; other points' shifts differ by the turn from the
 * middle to either end, which near_q20 includes.
 */
#include "narrow.h"

/* Bound on truncation when points are carried into b's frame, q20. */
#define PLACE_NOISE_Q20 8

/* ------------------------------------------------------------------- leaves */

/* Highest z of b in the cells that a passes over during the span, quanta. */
static int32_t highest_of_b(const struct interfere *in)
{
    int64_t around_q22 =
        in->a->def.radius_q22 + in->leaf->near_q22 +
        fix_mul(in->a->def.radius_q22, in->leaf->angle_q30 / 2 + in->leaf->skew_q30, 30);
    int32_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};

    for (int k = 0; k < 2; k++) {
        int32_t reach = (int32_t)(around_q22 >> 2) + (int32_t)carom_abs(in->leaf->moves.c[k]) / 2 +
                        2 * PLACE_NOISE_Q20;

        low[k] = interfere_quanta(in->b->def.mesh, in->leaf->at.c[k] - reach, k);
        high[k] = interfere_quanta(in->b->def.mesh, in->leaf->at.c[k] + reach, k) + 1;
    }
    return interfere_highest(in, low, high, INT32_MAX);
}

/* Set shift, reach and box along axis k from the leaf's sphere. */
static inline void sweep_sphere(struct interfere *in, int k)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    struct interfere_leaf *l = in->leaf;
    int32_t radius = (l->leaf->radius_q22 >> 2) + 1;
    int32_t x = interfere_dot(in->leaf->to_b.c[k], l->leaf->centre.c) + in->leaf->at.c[k];
    int32_t shift = interfere_dot(in->leaf->change.c[k], l->leaf->centre.c) + in->leaf->moves.c[k];
    int32_t reach = l->near_q20 + (int32_t)carom_abs(shift) / 2 + 1;

    l->shift.c[k] = shift;
    l->reach.c[k] = reach;
    l->quanta_low[k] = interfere_quanta(mb, x - radius - reach, k);
    l->quanta_high[k] = interfere_quanta(mb, x + radius + reach, k) + 1;
}

/* Sweep the leaf's sphere. Returns true if it meets b's box and is not above all of b under it. */
static bool leaf_near(struct interfere *in, const struct carom_leaf *leaf)
{
    const int16_t(*box)[3] = in->b->def.mesh->box;
    struct interfere_leaf *l = in->leaf;
    int32_t around_q22 =
        carom_mul_q30(leaf->radius_q22, in->leaf->angle_q30 / 2 + in->leaf->skew_q30);

    l->leaf = leaf;
    l->near_q20 = (int32_t)((in->leaf->near_q22 + around_q22) >> 2) + 2 * PLACE_NOISE_Q20;
    sweep_sphere(in, 2);
    if (l->quanta_low[2] > in->leaf->top || l->quanta_high[2] < box[0][2]) {
        return false;
    }
    for (int k = 0; k < 2; k++) {
        sweep_sphere(in, k);
        if (l->quanta_low[k] > box[1][k] || l->quanta_high[k] < box[0][k]) {
            return false;
        }
    }
    return interfere_reaches_leaf(in);
}

static inline int32_t along_slab_q15(const struct interfere_leaf *l, const int16_t p[3])
{
    return l->axis_q15[0] * p[0] + l->axis_q15[1] * p[1] + l->axis_q15[2] * p[2];
}

/* True if three coordinates all lie on the same side of an interval. */
static inline bool is_beside(int32_t p, int32_t q, int32_t r, int32_t low, int32_t high)
{
    return (p < low && q < low && r < low) || (p > high && q > high && r > high);
}

/*
 * True if a face of b meets the leaf's box in x and y, and the leaf's slab. The caller has compared
 * z in the cell.
 */
static inline bool face_near(const struct interfere *in, uint16_t face)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    const struct interfere_leaf *l = in->leaf;
    const uint16_t *corner = mb->raw.faces[face];
    const int16_t *p = mb->raw.vertices[corner[0]], *q = mb->raw.vertices[corner[1]],
                  *r = mb->raw.vertices[corner[2]];

    return !is_beside(p[0], q[0], r[0], l->quanta_low[0], l->quanta_high[0]) &&
           !is_beside(p[1], q[1], r[1], l->quanta_low[1], l->quanta_high[1]) &&
           !is_beside(along_slab_q15(l, p), along_slab_q15(l, q), along_slab_q15(l, r),
                      l->slab_low_q15, l->slab_high_q15);
}

/* True if the face is not remembered as tested against this leaf; remembers it. */
static inline bool is_new(struct interfere *in, uint16_t face)
{
    uint16_t *seen = &in->leaf->seen[face % INTERFERE_SEEN];

    if (*seen == face) {
        return false;
    }
    *seen = face;
    return true;
}

static inline void visit_face(struct interfere *in, uint16_t face)
{
    if (is_new(in, face) && face_near(in, face)) {
        interfere_narrow(in, face);
    }
}

/* Visit b's faces in a cell, highest z1 first, down to the bottom of the leaf's box. */
static void visit_cell(struct interfere *in, uint32_t cell)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    int32_t low = in->leaf->quanta_low[2], high = in->leaf->quanta_high[2];
    const struct carom_zref *r = &mb->zrefs[mb->cell_start[cell]];
    const struct carom_zref *end = &mb->zrefs[mb->cell_start[cell + 1]];

    for (; r < end && r->z1 >= low; r++) {
        if (r->z0 <= high) {
            visit_face(in, r->face);
        }
    }
}

/* visit_cell, for z-lists made within the step. */
static void visit_made(struct interfere *in, uint32_t cell)
{
    const struct zentry *entry = in->lists.entry;
    int32_t low = in->leaf->quanta_low[2], high = in->leaf->quanta_high[2];

    for (uint16_t i = in->lists.head[cell]; i != ZLIST_NONE && entry[i].z1 >= low;
         i = entry[i].next) {
        if (entry[i].z0 <= high) {
            visit_face(in, entry[i].face);
        }
    }
}

static void visit_leaf(struct interfere *in)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    struct interfere_cells cells;

    if (!interfere_place_leaf(in)) {
        return;
    }
    memset(in->leaf->seen, 0xff, sizeof in->leaf->seen); /* = CAROM_NO_FACE */
    cells = interfere_cells_under(mb, in->leaf->quanta_low, in->leaf->quanta_high);
    for (int32_t row = cells.row[0]; row <= cells.row[1]; row++) {
        for (int32_t col = cells.col[0]; col <= cells.col[1]; col++) {
            uint32_t cell = (uint32_t)(row * mb->grid_nx + col);

            if (in->pooled) {
                visit_made(in, cell);
            } else {
                visit_cell(in, cell);
            }
        }
    }
}

/* -------------------------------------------------------------------- pair */

/*
 * Upper bound on centre.z - radius (q20, a's axes turned to b's); leaves above it cannot reach b
 * below `top`. Each leaf's sphere lies within twice a's radius of a's centre, which bounds the
 * effect of turns.
 */
static int64_t highest_leaf(const struct interfere *in, int32_t top)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    const struct interfere_leaf *l = in->leaf;
    int64_t turns_q30 = l->angle_q30 / 2 + l->skew_q30, reach_q20;

    for (int k = 0; k < 3; k++) {
        turns_q30 += carom_abs(l->change.c[2][k]) / 2;
    }
    reach_q20 = ((l->near_q22 + fix_mul(2 * turns_q30, in->a->def.radius_q22, 30)) >> 2) +
                carom_abs(l->moves.c[2]) / 2 + 2 * PLACE_NOISE_Q20 + 6;
    reach_q20 += (int64_t)(top + 1) * (1 << (20 - mb->raw.quantum_bits)) -
                 (mb->mass.centre.c[2] >> 2) - l->at.c[2];
    return reach_q20 < INT32_MAX / 2 ? reach_q20 : INT32_MAX / 2;
}

/* Skip leaves whose centre.z - radius exceeds the bound. Most leaves end here. */
static const struct carom_leaf *next_leaf(const struct interfere *in, const struct carom_leaf *leaf,
                                          int64_t highest_q20)
{
    const struct carom_leaf *end = in->a->def.mesh->leaves + in->a->def.mesh->leaf_count;
    const int32_t *up = in->leaf->to_b.c[2];
    const int32_t x = up[0], y = up[1], z = up[2];
    const int64_t highest_q52 = highest_q20 * ((int64_t)1 << 32);

    while (leaf < end && (int64_t)x * leaf->centre.c[0] + (int64_t)y * leaf->centre.c[1] +
                                 (int64_t)z * leaf->centre.c[2] -
                                 (int64_t)leaf->radius_q22 * CAROM_ONE_Q30 >
                             highest_q52) {
        leaf++;
    }
    return leaf;
}

void interfere_leaves(struct interfere *in)
{
    const struct carom_leaf *leaf = in->a->def.mesh->leaves,
                            *end = leaf + in->a->def.mesh->leaf_count;
    int64_t highest_q20;

    leaf = next_leaf(in, leaf, highest_leaf(in, in->b->def.mesh->box[1][2]));
    if (leaf == end) {
        return;
    }
    in->leaf->top = highest_of_b(in);
    highest_q20 = highest_leaf(in, in->leaf->top);
    for (; (leaf = next_leaf(in, leaf, highest_q20)) < end && !in->error; leaf++) {
        if (leaf_near(in, leaf)) {
            visit_leaf(in);
        }
    }
}

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
static int32_t highest_of_b(const struct interfere *w)
{
    int64_t around_q22 =
        w->a->def.radius_q22 + w->leaf->near_q22 +
        fix_mul(w->a->def.radius_q22, w->leaf->angle_q30 / 2 + w->leaf->skew_q30, 30);
    int32_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};

    for (int k = 0; k < 2; k++) {
        int32_t reach = (int32_t)(around_q22 >> 2) + (int32_t)carom_abs(w->leaf->moves.c[k]) / 2 +
                        2 * PLACE_NOISE_Q20;

        low[k] = interfere_quanta(w->b->def.mesh, w->leaf->at.c[k] - reach, k);
        high[k] = interfere_quanta(w->b->def.mesh, w->leaf->at.c[k] + reach, k) + 1;
    }
    return interfere_highest(w, low, high, INT32_MAX);
}

/* Set shift, reach and box along axis k from the leaf's sphere. */
static inline void sweep_sphere(struct interfere *w, int k)
{
    const struct carom_mesh *mb = w->b->def.mesh;
    struct interfere_leaf *l = w->leaf;
    int32_t radius = (l->leaf->radius_q22 >> 2) + 1;
    int32_t x = interfere_dot(w->leaf->to_b.c[k], l->leaf->centre.c) + w->leaf->at.c[k];
    int32_t shift = interfere_dot(w->leaf->change.c[k], l->leaf->centre.c) + w->leaf->moves.c[k];
    int32_t reach = l->near_q20 + (int32_t)carom_abs(shift) / 2 + 1;

    l->shift.c[k] = shift;
    l->reach.c[k] = reach;
    l->quanta_low[k] = interfere_quanta(mb, x - radius - reach, k);
    l->quanta_high[k] = interfere_quanta(mb, x + radius + reach, k) + 1;
}

/* Sweep the leaf's sphere. Returns true if it meets b's box and is not above all of b under it. */
static bool leaf_near(struct interfere *w, const struct carom_leaf *leaf)
{
    const int16_t(*box)[3] = w->b->def.mesh->box;
    struct interfere_leaf *l = w->leaf;
    int32_t around_q22 =
        carom_mul_q30(leaf->radius_q22, w->leaf->angle_q30 / 2 + w->leaf->skew_q30);

    l->leaf = leaf;
    l->near_q20 = (int32_t)((w->leaf->near_q22 + around_q22) >> 2) + 2 * PLACE_NOISE_Q20;
    sweep_sphere(w, 2);
    if (l->quanta_low[2] > w->leaf->top || l->quanta_high[2] < box[0][2]) {
        return false;
    }
    for (int k = 0; k < 2; k++) {
        sweep_sphere(w, k);
        if (l->quanta_low[k] > box[1][k] || l->quanta_high[k] < box[0][k]) {
            return false;
        }
    }
    return interfere_reaches_leaf(w);
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
static inline bool face_near(const struct interfere *w, uint16_t face)
{
    const struct carom_mesh *mb = w->b->def.mesh;
    const struct interfere_leaf *l = w->leaf;
    const uint16_t *corner = mb->raw.faces[face];
    const int16_t *p = mb->raw.vertices[corner[0]], *q = mb->raw.vertices[corner[1]],
                  *r = mb->raw.vertices[corner[2]];

    return !is_beside(p[0], q[0], r[0], l->quanta_low[0], l->quanta_high[0]) &&
           !is_beside(p[1], q[1], r[1], l->quanta_low[1], l->quanta_high[1]) &&
           !is_beside(along_slab_q15(l, p), along_slab_q15(l, q), along_slab_q15(l, r),
                      l->slab_low_q15, l->slab_high_q15);
}

/* True if the face is not remembered as tested against this leaf; remembers it. */
static inline bool is_new(struct interfere *w, uint16_t face)
{
    uint16_t *seen = &w->leaf->seen[face % INTERFERE_SEEN];

    if (*seen == face) {
        return false;
    }
    *seen = face;
    return true;
}

static inline void visit_face(struct interfere *w, uint16_t face)
{
    if (is_new(w, face) && face_near(w, face)) {
        interfere_narrow(w, face);
    }
}

/* Visit b's faces in a cell, highest z1 first, down to the bottom of the leaf's box. */
static void visit_cell(struct interfere *w, uint32_t cell)
{
    const struct carom_mesh *mb = w->b->def.mesh;
    int32_t low = w->leaf->quanta_low[2], high = w->leaf->quanta_high[2];
    const struct carom_zref *r = &mb->zrefs[mb->cell_start[cell]];
    const struct carom_zref *end = &mb->zrefs[mb->cell_start[cell + 1]];

    for (; r < end && r->z1 >= low; r++) {
        if (r->z0 <= high) {
            visit_face(w, r->face);
        }
    }
}

/* visit_cell, for z-lists made within the step. */
static void visit_made(struct interfere *w, uint32_t cell)
{
    const struct zentry *entry = w->lists.entry;
    int32_t low = w->leaf->quanta_low[2], high = w->leaf->quanta_high[2];

    for (uint16_t i = w->lists.head[cell]; i != ZLIST_NONE && entry[i].z1 >= low;
         i = entry[i].next) {
        if (entry[i].z0 <= high) {
            visit_face(w, entry[i].face);
        }
    }
}

static void visit_leaf(struct interfere *w)
{
    const struct carom_mesh *mb = w->b->def.mesh;
    struct interfere_cells cells;

    if (!interfere_place_leaf(w)) {
        return;
    }
    memset(w->leaf->seen, 0xff, sizeof w->leaf->seen); /* = CAROM_NO_FACE */
    cells = interfere_cells_under(mb, w->leaf->quanta_low, w->leaf->quanta_high);
    for (int32_t row = cells.row[0]; row <= cells.row[1]; row++) {
        for (int32_t col = cells.col[0]; col <= cells.col[1]; col++) {
            uint32_t cell = (uint32_t)(row * mb->grid_nx + col);

            if (w->pooled) {
                visit_made(w, cell);
            } else {
                visit_cell(w, cell);
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
static int64_t highest_leaf(const struct interfere *w, int32_t top)
{
    const struct carom_mesh *mb = w->b->def.mesh;
    const struct interfere_leaf *l = w->leaf;
    int64_t turns_q30 = l->angle_q30 / 2 + l->skew_q30, reach_q20;

    for (int k = 0; k < 3; k++) {
        turns_q30 += carom_abs(l->change.c[2][k]) / 2;
    }
    reach_q20 = ((l->near_q22 + fix_mul(2 * turns_q30, w->a->def.radius_q22, 30)) >> 2) +
                carom_abs(l->moves.c[2]) / 2 + 2 * PLACE_NOISE_Q20 + 6;
    reach_q20 += (int64_t)(top + 1) * (1 << (20 - mb->raw.quantum_bits)) -
                 (mb->mass.centre.c[2] >> 2) - l->at.c[2];
    return reach_q20 < INT32_MAX / 2 ? reach_q20 : INT32_MAX / 2;
}

/* Skip leaves whose centre.z - radius exceeds the bound. Most leaves end here. */
static const struct carom_leaf *next_leaf(const struct interfere *w, const struct carom_leaf *leaf,
                                          int64_t highest_q20)
{
    const struct carom_leaf *end = w->a->def.mesh->leaves + w->a->def.mesh->leaf_count;
    const int32_t *up = w->leaf->to_b.c[2];
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

void interfere_leaves(struct interfere *w)
{
    const struct carom_leaf *leaf = w->a->def.mesh->leaves,
                            *end = leaf + w->a->def.mesh->leaf_count;
    int64_t highest_q20;

    leaf = next_leaf(w, leaf, highest_leaf(w, w->b->def.mesh->box[1][2]));
    if (leaf == end) {
        return;
    }
    w->leaf->top = highest_of_b(w);
    highest_q20 = highest_leaf(w, w->leaf->top);
    for (; (leaf = next_leaf(w, leaf, highest_q20)) < end && !w->error; leaf++) {
        if (leaf_near(w, leaf)) {
            visit_leaf(w);
        }
    }
}

/* SPDX-License-Identifier: MIT */
/*
 * Which faces of two bodies are near each other: leaves, scan conversion, and the merge of lists.
 */
#include "interfere_narrow.h"

/* ------------------------------------------------------------------- lists */

static void forget(struct interfere *w)
{
    for (uint32_t i = 0; i < INTERFERE_SEEN; i++) {
        w->seen[i].leaf_faces = 0;
    }
}

/* Whether a pair comes up for the first time, as far as is remembered. */
static bool is_new(struct interfere *w, uint16_t leaf_face, uint16_t face_b)
{
    struct interfere_seen *seen = &w->seen[face_b % INTERFERE_SEEN];
    uint16_t bit = (uint16_t)(1u << leaf_face);

    if (seen->face_b != face_b) {
        seen->face_b = face_b;
        seen->leaf_faces = 0;
    }
    if (seen->leaf_faces & bit) {
        return false;
    }
    seen->leaf_faces |= bit;
    return true;
}

/* Merge the two z-lists of one cell: both run from the highest z1 down. */
static void merge_cell(struct interfere *w, uint32_t cell)
{
    const struct carom_mesh *mb = w->b->mesh;
    const struct carom_zref *first = &mb->zrefs[mb->cell_start[cell]];
    const struct carom_zref *end = &mb->zrefs[mb->cell_start[cell + 1]];

    for (uint32_t e = w->lists.head[cell]; e != ZLIST_NONE; e = w->lists.entry[e].next) {
        const struct zentry *entry = &w->lists.entry[e];

        for (const struct carom_zref *r = first; r < end && r->z1 >= entry->z0; r++) {
            if (r->z0 <= entry->z1 && is_new(w, entry->face, r->face)) {
                interfere_narrow(w, entry->face, r->face);
            }
        }
    }
    w->lists.head[cell] = ZLIST_NONE;
}

static void merge_lists(struct interfere *w)
{
    for (int32_t row = w->cells[0][1]; row <= w->cells[1][1]; row++) {
        for (int32_t col = w->cells[0][0]; col <= w->cells[1][0]; col++) {
            merge_cell(w, (uint32_t)(row * w->b->mesh->grid_nx + col));
        }
    }
    pool_clear(w->lists.pool);
    w->cells[0][0] = w->cells[0][1] = INT32_MAX;
    w->cells[1][0] = w->cells[1][1] = -1;
}

/* Enter a face in one cell; `lowest` is the least z of the grown face. */
static void enter_cell(struct interfere *w, const struct zface *f, const struct scan_grid *grid,
                       int32_t col, int32_t row, int32_t lowest, uint16_t face)
{
    const struct carom_mesh *mb = w->b->mesh;
    uint32_t cell = (uint32_t)(row * grid->nx + col);
    const struct carom_zref *top = &mb->zrefs[mb->cell_start[cell]];
    int16_t z0, z1;

    /* above all of b in this cell: by the whole face first, which costs nothing */
    if (mb->cell_start[cell] == mb->cell_start[cell + 1] || top->z1 < lowest) {
        return;
    }
    zface_interval(f, grid, col, row, &z0, &z1);
    if (top->z1 < z0) {
        return;
    }
    if (!zlist_enter(&w->lists, cell, z0, z1, face)) {
        merge_lists(w); /* a chunk */
        zlist_enter(&w->lists, cell, z0, z1, face);
    }
    w->cells[0][0] = col < w->cells[0][0] ? col : w->cells[0][0];
    w->cells[1][0] = col > w->cells[1][0] ? col : w->cells[1][0];
    w->cells[0][1] = row < w->cells[0][1] ? row : w->cells[0][1];
    w->cells[1][1] = row > w->cells[1][1] ? row : w->cells[1][1];
}

/* Carry the faces of a leaf into b's frame. */
static void place_leaf(struct interfere *w)
{
    const struct carom_mesh *ma = w->a->mesh;
    const struct carom_leaf *leaf = w->leaf;
    carom_v3_q22 vertices[CAROM_LEAF_VERTICES];

    for (uint32_t i = 0; i < leaf->vertex_count; i++) {
        carom_v3_q22 v = mesh_vertex(ma, ma->leaf_vertices[leaf->first_vertex + i]);

        carom_rotate(v.c, &w->to_b, v.c);
        for (int k = 0; k < 3; k++) {
            vertices[i].c[k] = v.c[k] + w->offset_q22[k];
        }
    }
    for (uint32_t i = 0; i < leaf->face_count; i++) {
        const uint8_t *corner = ma->leaf_corners[leaf->first_face + i];
        struct interfere_face *f = &w->leaf_faces[i];

        f->number = ma->leaf_faces[leaf->first_face + i];
        f->face = &ma->faces[f->number];
        f->low = f->high = vertices[corner[0]];
        for (int n = 0; n < 3; n++) {
            f->p[n] = vertices[corner[n]];
            for (int k = 0; k < 3; k++) {
                f->low.c[k] = f->p[n].c[k] < f->low.c[k] ? f->p[n].c[k] : f->low.c[k];
                f->high.c[k] = f->p[n].c[k] > f->high.c[k] ? f->p[n].c[k] : f->high.c[k];
            }
        }
        for (int k = 0; k < 3; k++) {
            f->low.c[k] -= w->reach_q22;
            f->high.c[k] += w->reach_q22;
        }
    }
}

/*
 * Scan-convert one of the leaf's faces onto b's cells, with the reach and the rounding in `grow`.
 */
static void scan_face(struct interfere *w, const struct scan_grid *grid, uint16_t leaf_face)
{
    const struct carom_mesh *mb = w->b->mesh;
    const struct interfere_face *lf = &w->leaf_faces[leaf_face];
    int shift = 22 - mb->raw.quantum_bits;
    int32_t lowest = INT32_MAX, xy[3][2];
    struct zface f;
    struct scan_cells cells;
    struct scan_run run;

    f.grow = (w->reach_q22 >> shift) + 2;
    for (int n = 0; n < 3; n++) {
        for (int k = 0; k < 3; k++) {
            f.p[n][k] = (lf->p[n].c[k] + mb->mass.centre.c[k]) >> shift;
        }
        xy[n][0] = f.p[n][0];
        xy[n][1] = f.p[n][1];
        lowest = f.p[n][2] - f.grow < lowest ? f.p[n][2] - f.grow : lowest;
    }
    if (lowest > w->leaf_top) {
        return;
    }
    scan_cells_begin(&cells, grid, (const int32_t(*)[2])xy, 3, f.grow);
    while (scan_cells_next(&cells, &run)) {
        for (int32_t col = run.x0; col < run.x1; col++) {
            enter_cell(w, &f, grid, col, run.y, lowest, leaf_face);
        }
    }
}

static void scan_leaf(struct interfere *w)
{
    struct scan_grid grid = mesh_grid(w->b->mesh);

    place_leaf(w);
    for (uint16_t i = 0; i < w->leaf->face_count; i++) {
        scan_face(w, &grid, i);
    }
    merge_lists(w);
}

/* Cell of a coordinate in quanta along one axis of a grid, clamped to it. */
static int32_t clamp_cell(int64_t x, int32_t x0, int shift, int32_t n)
{
    int64_t cell = (x - x0) >> shift;

    return cell < 0 ? 0 : cell >= n ? n - 1 : (int32_t)cell;
}

/* The highest z of b in the cells under a square, quanta. */
static int32_t highest_under(const struct carom_mesh *mb, const int64_t low[3],
                             const int64_t high[3])
{
    struct scan_grid grid = mesh_grid(mb);
    int32_t col0 = clamp_cell(low[0], grid.x0, grid.shift, grid.nx);
    int32_t col1 = clamp_cell(high[0], grid.x0, grid.shift, grid.nx);
    int32_t row0 = clamp_cell(low[1], grid.y0, grid.shift, grid.ny);
    int32_t row1 = clamp_cell(high[1], grid.y0, grid.shift, grid.ny);
    int32_t top = INT16_MIN;

    for (int32_t row = row0; row <= row1; row++) {
        for (int32_t col = col0; col <= col1; col++) {
            uint32_t first = mb->cell_start[row * grid.nx + col];

            if (first < mb->cell_start[row * grid.nx + col + 1] && mb->zrefs[first].z1 > top) {
                top = mb->zrefs[first].z1;
            }
        }
    }
    return top;
}

/*
 * Whether the sphere around a leaf, grown by the reach, meets the box of b and what lies under it.
 */
static bool leaf_near(struct interfere *w, const struct carom_leaf *leaf)
{
    const struct carom_mesh *mb = w->b->mesh;
    int shift = 22 - mb->raw.quantum_bits;
    int64_t radius = (int64_t)leaf->radius_q22 + w->reach_q22 + 4;
    int64_t low[3], high[3];
    carom_v3_q22 c;

    carom_rotate(c.c, &w->to_b, leaf->centre.c);
    for (int k = 0; k < 3; k++) {
        int64_t x = (int64_t)c.c[k] + w->offset_q22[k] + mb->mass.centre.c[k];

        low[k] = (x - radius) >> shift;
        high[k] = (x + radius) >> shift;
        if (high[k] < mb->box[0][k] || low[k] > mb->box[1][k]) {
            return false;
        }
    }
    w->leaf_top = highest_under(mb, low, high);
    return low[2] <= w->leaf_top;
}

/* -------------------------------------------------------------------- pair */

/* a's axes and centre in b's mesh frame; false when the bodies are too far apart to matter. */
static bool relate(struct interfere *w)
{
    int64_t d[3];

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int64_t sum = 0;

            for (int k = 0; k < 3; k++) {
                sum += (int64_t)w->b->gathered_r.c[k][i] * w->a->gathered_r.c[k][j];
            }
            w->to_b.c[i][j] = (int32_t)carom_round(sum, 30);
        }
        d[i] = carom_round(w->a->gathered_at.c[i] - w->b->gathered_at.c[i], 10);
    }
    fix_rotate_back(d, &w->b->gathered_r, d);
    for (int k = 0; k < 3; k++) {
        if (carom_abs(d[k]) > (int64_t)400 << 22) {
            return false;
        }
        w->offset_q22[k] = (int32_t)d[k];
    }
    return true;
}

/*
 * Whether all of b, seen from any point that a may reach, fits q22: only the largest meshes with
 * the fastest bodies do not.
 */
static bool in_range(const struct interfere *w, int64_t reach_q22)
{
    return 2 * (w->b->radius_q22 + w->a->radius_q22 + reach_q22) < INT32_MAX;
}

static void gather_pair(struct interfere *w)
{
    const struct carom_mesh *ma = w->a->mesh;
    int64_t reach_q22, turn_q30;

    if (!relate(w)) {
        return;
    }
    reach_q22 = (int64_t)w->a->reach_q22 + w->b->reach_q22;
    turn_q30 = (int64_t)w->a->turn_q30 + w->b->turn_q30;
    if (!in_range(w, reach_q22)) {
        w->error = CAROM_ERR_RANGE;
        return;
    }
    w->reach_q22 = (int32_t)reach_q22;
    w->turn_q30 = turn_q30 < INT32_MAX / 2 ? (int32_t)turn_q30 : INT32_MAX / 2;
    for (uint32_t i = 0; i < ma->leaf_count && !w->error; i++) {
        if (leaf_near(w, &ma->leaves[i])) {
            w->leaf = &ma->leaves[i];
            forget(w);
            scan_leaf(w);
        }
    }
}

void interfere_begin(struct interfere *w)
{
    w->whole = false;
    w->error = CAROM_OK;
}

int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor)
{
    if (!w->whole) {
        w->whole = true;
        w->visitor = visitor;
        w->gathers++;
        pool_clear(w->candidate_pool);
        zlist_clear(&w->lists);
        w->cells[0][0] = w->cells[0][1] = INT32_MAX;
        w->cells[1][0] = w->cells[1][1] = -1;
        for (uint32_t i = 0; i < pair_count && !w->error; i++) {
            w->pair = (uint16_t)i;
            w->body_a = pairs[i].a;
            w->body_b = pairs[i].b;
            w->a = &bodies[pairs[i].a];
            w->b = &bodies[pairs[i].b];
            gather_pair(w);
        }
        if (w->error) {
            w->whole = false;
            return w->error;
        }
    }
    visitor->visit(visitor, w->candidates, w->candidate_pool->used);
    return CAROM_OK;
}

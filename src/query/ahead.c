/* SPDX-License-Identifier: MIT */
/*
 * For each face near a one-leaf mesh that moves straight: from when until when may they touch?
 * Features are then tested in windows of the stretch, only where faces are, and not beyond the
 * first hit.
 *
 * Along any axis the mesh covers an interval that moves steadily, and a face covers a fixed one, so
 * the times at which they overlap come from a division. The axes are normals of the mesh, and the
 * normal of the face.
 */
#include "ahead.h"

/* Truncation here, beyond what a gather allows for. */
#define NOISE_Q20 32
/*
 * Bound on any place of a mesh in quanta q14, which is below 2^14 sqrt 3 2^15. With near_q14, below
 * a 32nd of this, differences are below 2^31.
 */
#define FAR_Q14 ((int32_t)1 << 30)
/* Axes with a larger cosine between them count as one. */
#define SAME_AXIS_Q30 (CAROM_ONE_Q30 - (1 << 20))
/* A list of this many faces is long enough, once it reaches LIST_LEAST. */
#define LIST_FACES 10
#define LIST_LEAST 512

/* ----------------------------------------------------------------------- mesh */

/* A length in b's quanta, q14, saturated to +-FAR_Q14. */
static int32_t to_q14(const struct carom_mesh *mesh, int64_t x_q20)
{
    int64_t x = x_q20 * ((int64_t)1 << mesh->raw.quantum_bits) >> 6;

    return x > FAR_Q14 ? FAR_Q14 : x < -FAR_Q14 ? -FAR_Q14 : (int32_t)x;
}

/* Set up the pair as a gather does for a path that does not turn. */
static void set_pair(struct ahead *h)
{
    const struct body *a = h->work.a, *b = h->work.b;
    struct interfere_leaf *l = h->work.leaf;
    int32_t skins_q22 = fix_larger(a->def.skin_q22, b->def.skin_q22) * BODY_MARGIN_SKINS;

    interfere_relate(&l->to_b, &b->path.start.r, &a->path.start.r);
    memset(&l->change, 0, sizeof l->change);
    l->leaf = a->def.mesh->leaves;
    l->angle_q30 = 0;
    l->skew_q30 = 1;
    l->cone_q30 = INTERFERE_CONE_Q30 + INTERFERE_CONE_NOISE_Q30;
    h->near_q20 = (skins_q22 + mesh_drift_most(b->def.mesh)) / 4 + NOISE_Q20;
}

/* Set a's vertices in b's axes, and the box around them. */
static void set_vertices(struct ahead *h)
{
    const struct interfere_leaf *l = h->work.leaf;
    const struct carom_mesh *mesh = h->work.a->def.mesh;

    for (int k = 0; k < 3; k++) {
        h->low_q20[k] = INT32_MAX;
        h->high_q20[k] = INT32_MIN;
    }
    for (uint32_t i = 0; i < l->leaf->vertex_count; i++) {
        carom_v3_q22 v = mesh_vertex(mesh, mesh->leaf_vertices[l->leaf->first_vertex + i]);

        for (int k = 0; k < 3; k++) {
            int32_t x = interfere_dot(l->to_b.c[k], v.c);

            h->p[i].c[k] = x;
            h->low_q20[k] = x < h->low_q20[k] ? x : h->low_q20[k];
            h->high_q20[k] = x > h->high_q20[k] ? x : h->high_q20[k];
        }
    }
}

/* The interval that a's vertices cover along a direction, q18. */
static void reach_q18(const struct ahead *h, const int32_t n_q30[3], int32_t *low, int32_t *high)
{
    *low = INT32_MAX;
    *high = INT32_MIN;
    for (uint32_t i = 0; i < h->work.leaf->leaf->vertex_count; i++) {
        int32_t x = interfere_dot(n_q30, h->p[i].c);

        *low = x < *low ? x : *low;
        *high = x > *high ? x : *high;
    }
}

/* True if a has that axis, or its opposite, already. */
static bool has_axis(const struct ahead *h, const int32_t n_q30[3])
{
    for (uint32_t i = 0; i < h->axes; i++) {
        if (carom_abs(carom_dot(h->axis[i].n_q30, n_q30) >> 30) > SAME_AXIS_Q30) {
            return true;
        }
    }
    return false;
}

/* Add an axis, signed so that a moves up it. Axes along which a moves farther come first. */
static void add_axis(struct ahead *h, const int32_t n_q30[3])
{
    struct ahead_axis axis;
    int64_t way_q32 = fix_dot_q30(h->way_q32, n_q30);
    uint32_t place = h->axes++;

    axis.goes_q32 = carom_abs(way_q32);
    for (int k = 0; k < 3; k++) {
        axis.n_q30[k] = way_q32 < 0 ? -n_q30[k] : n_q30[k];
        axis.n_q14[k] = (int32_t)carom_round(axis.n_q30[k], 16);
    }
    reach_q18(h, axis.n_q30, &axis.low_q18, &axis.high_q18);
    for (; place > 0 && h->axis[place - 1].goes_q32 < axis.goes_q32; place--) {
        h->axis[place] = h->axis[place - 1];
    }
    h->axis[place] = axis;
}

static void set_axes(struct ahead *h)
{
    const struct interfere_leaf *l = h->work.leaf;
    const struct carom_mesh *mesh = h->work.a->def.mesh;

    h->axes = 0;
    for (uint32_t i = 0; i < l->leaf->face_count && h->axes < AHEAD_AXES; i++) {
        uint16_t face = mesh->leaf_faces[l->leaf->first_face + i];
        int32_t n_q30[3];

        carom_rotate(n_q30, &l->to_b, mesh->faces[face].normal.c);
        if (!has_axis(h, n_q30)) {
            add_axis(h, n_q30);
        }
    }
}

/*
 * The tolerance along an axis: the axis times a vertex of b is off by half a unit for each quantum
 * of the vertex.
 */
static int32_t near_of(const struct ahead *h)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    int32_t near_q14 = to_q14(mb, h->near_q20) + 2;

    for (int k = 0; k < 3; k++) {
        near_q14 += fix_larger(-mb->box[0][k], mb->box[1][k]) / 2 + 1;
    }
    return near_q14;
}

static bool is_upright(const struct body *b)
{
    const int32_t *q = b->path.q.c;

    return (q[1] | q[2] | q[3]) == 0;
}

bool ahead_begin(struct ahead *h, const struct interfere *work, const struct body *a,
                 const struct body *b, const carom_v3_q32 *way, int32_t part_q30)
{
    int64_t longest = 0;

    for (int k = 0; k < 3; k++) {
        h->start_q32[k] = carom_shl(body_path(a)->origin_q22[k] - body_path(b)->origin_q22[k], 10);
        h->way_q32[k] = way->c[k];
        longest += carom_abs(way->c[k]);
    }
    if (a->def.mesh->leaf_count > 1 || mesh_lists_in_step(b->def.mesh) ||
        to_q14(b->def.mesh, fix_mul_q30(longest, part_q30) >> 12) >= FAR_Q14 / 4) {
        return false;
    }
    h->work = *work;
    h->work.a = a;
    h->work.b = b;
    h->work.candidates = h->candidates;
    h->work.candidate_pool = &h->pool;
    h->work.meetings = NULL;
    h->work.own_first = 0;
    h->work.span.most = UINT32_MAX;
    h->work.pair = 0;
    h->work.swapped = h->work.pooled = false;
    h->work.meet = interfere_features;
    h->pool = (struct pool){AHEAD_CANDIDATES, 0, 0, 0};
    if (!is_upright(b)) { /* skipped for most ground */
        fix_rotate_back(h->start_q32, &b->path.start.r, h->start_q32);
        fix_rotate_back(h->way_q32, &b->path.start.r, h->way_q32);
    }
    set_pair(h);
    set_vertices(h);
    set_axes(h);
    h->near_q14 = near_of(h);
    return h->near_q14 < FAR_Q14 / 32;
}

/* -------------------------------------------------------------------- stretch */

/* True if a's box, swept over the stretch, meets b's box and is not above all of b under it. */
static bool passes(struct ahead *h)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;

    for (int k = 2; k >= 0; k--) {
        int32_t x = h->at_q20[k] + h->low_q20[k] - h->near_q20;
        int32_t y = h->at_q20[k] + h->high_q20[k] + h->near_q20, goes = h->moves_q20[k];

        h->low_quanta[k] = interfere_quanta(mb, goes < 0 ? x + goes : x, k);
        h->high_quanta[k] = interfere_quanta(mb, goes < 0 ? y : y + goes, k) + 1;
        if (h->low_quanta[k] > mb->box[1][k] || h->high_quanta[k] < mb->box[0][k]) {
            return false;
        }
    }
    return interfere_highest(&h->work, h->low_quanta, h->high_quanta, h->low_quanta[2]) >=
           h->low_quanta[2];
}

bool ahead_stretch(struct ahead *h, int32_t from_q30, int32_t to_q30)
{
    /* beyond it the spheres do not meet; within it places are within a few radii and fit q20 */
    int64_t reach_q22 =
        2 * ((int64_t)h->work.a->def.radius_q22 + h->work.b->def.radius_q22 + h->near_q20);

    for (int k = 0; k < 3; k++) {
        int64_t from = h->start_q32[k] + fix_mul_q30(h->way_q32[k], from_q30);
        int64_t moves = fix_mul_q30(h->way_q32[k], to_q30 - from_q30);

        if (carom_abs(from) > (reach_q22 << 10) + carom_abs(moves)) {
            return false;
        }
        h->at_q20[k] = (int32_t)(from >> 12);
        h->moves_q20[k] = (int32_t)(moves >> 12);
    }
    return passes(h);
}

/* Set a's intervals along its axes at the start of the stretch. */
static void place_axes(struct ahead *h)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    int32_t at_q20[3];

    for (int k = 0; k < 3; k++) {
        at_q20[k] = h->at_q20[k] + (mb->mass.centre.c[k] >> 2);
    }
    for (uint32_t i = 0; i < h->axes; i++) {
        struct ahead_axis *axis = &h->axis[i];
        int64_t x_q20 = carom_dot(axis->n_q30, at_q20) >> 30;

        axis->way = fix_larger(to_q14(mb, carom_dot(axis->n_q30, h->moves_q20) >> 30), 0);
        axis->shift = times_shift(axis->way);
        axis->low = to_q14(mb, x_q20 + 4 * (int64_t)axis->low_q18 - 8);
        axis->high = to_q14(mb, x_q20 + 4 * (int64_t)axis->high_q18 + 8);
    }
}

/* ---------------------------------------------------------------------- faces */

static inline int32_t least_of(int32_t p, int32_t q, int32_t r)
{
    p = p < q ? p : q;
    return p < r ? p : r;
}

static inline int32_t most_of(int32_t p, int32_t q, int32_t r)
{
    p = p > q ? p : q;
    return p > r ? p : r;
}

static inline int32_t along(const int32_t n_q14[3], const int16_t p[3])
{
    return n_q14[0] * p[0] + n_q14[1] * p[1] + n_q14[2] * p[2];
}

/* Narrow the times by the plane of a face. */
static bool plane_times(struct times *times, const struct ahead *h, const struct carom_face *face)
{
    const int32_t *n = face->normal.c;
    int32_t low, high, height = interfere_dot(n, h->at_q20) - (face->offset_q22 >> 4);
    int32_t way = interfere_dot(n, h->moves_q20), near = h->near_q20 / 4 + 8;

    reach_q18(h, n, &low, &high);
    low += height;
    high += height;
    return way < 0 ? times_narrow(times, -high, -low, -way, times_shift(-way), 0, 0, near)
                   : times_narrow(times, low, high, way, times_shift(way), 0, 0, near);
}

/* Narrow the times at which a may touch a face of b; false if never. */
static bool face_times(struct times *times, const struct ahead *h, uint16_t face)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    const uint16_t *corner = mb->raw.faces[face];
    const int16_t *p = mb->raw.vertices[corner[0]], *q = mb->raw.vertices[corner[1]],
                  *r = mb->raw.vertices[corner[2]];

    for (uint32_t i = 0; i < h->axes; i++) {
        const struct ahead_axis *axis = &h->axis[i];
        int32_t x = along(axis->n_q14, p), y = along(axis->n_q14, q), z = along(axis->n_q14, r);

        if (!times_narrow(times, axis->low, axis->high, axis->way, axis->shift, least_of(x, y, z),
                          most_of(x, y, z), h->near_q14)) {
            return false;
        }
    }
    return plane_times(times, h, &mb->faces[face]);
}

/*
 * Once the list has enough faces drop those that are touched last: the list then ends at their
 * time. While there is room it reaches at least LIST_LEAST.
 */
static void leave_out_last(struct ahead *h)
{
    uint32_t last = 0, kept = 0;

    for (uint32_t i = 1; i < h->count; i++) {
        last = h->list[i].enter > h->list[last].enter ? i : last;
    }
    if (h->list[last].enter < LIST_LEAST && h->count < AHEAD_FACES) {
        return;
    }
    h->end = h->list[last].enter;
    for (uint32_t i = 0; i < h->count; i++) {
        if (h->list[i].enter < h->end) {
            h->list[kept++] = h->list[i];
        }
    }
    h->count = kept;
    if (h->moves_q20[2] < 0) { /* the shorter stretch does not reach as low */
        int32_t goes = (int32_t)((int64_t)h->moves_q20[2] * h->end >> TIMES_BITS);

        h->low_quanta[2] = interfere_quanta(h->work.b->def.mesh,
                                            h->at_q20[2] + h->low_q20[2] - h->near_q20 + goes, 2);
    }
}

static void note_face(struct ahead *h, uint16_t face)
{
    struct times times = {0, h->end};

    if (face_times(&times, h, face) && times.enter < h->end) {
        h->list[h->count++] = (struct ahead_face){face, (int16_t)times.enter, (int16_t)times.leave};
        if (h->count >= LIST_FACES) {
            leave_out_last(h);
        }
    }
}

/*
 * True if a may touch a face in a cell, by the cell's column from a's lowest place to its highest
 * face. A face that lies in several cells is found by its part in each.
 */
static bool cell_near(const struct ahead *h, int32_t col, int32_t row, int32_t top)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    const int32_t side = 1 << mb->grid_shift;
    const int32_t x = mb->grid_x0 + col * side, y = mb->grid_y0 + row * side;
    const int32_t low[3] = {x, y, fix_larger(h->low_quanta[2], mb->box[0][2])};
    const int32_t high[3] = {fix_smaller(x + side, mb->box[1][0]),
                             fix_smaller(y + side, mb->box[1][1]), top};
    struct times times = {0, h->end};

    for (uint32_t i = 0; i < h->axes; i++) {
        const struct ahead_axis *axis = &h->axis[i];
        int32_t from = 0, to = 0;

        for (int k = 0; k < 3; k++) {
            const int32_t n = axis->n_q14[k];

            from += n * (n < 0 ? high[k] : low[k]);
            to += n * (n < 0 ? low[k] : high[k]);
        }
        if (!times_narrow(&times, axis->low, axis->high, axis->way, axis->shift, from, to,
                          h->near_q14)) {
            return false;
        }
    }
    return true;
}

/* Note b's faces in a cell, highest first, down to a. */
static void note_cell(struct ahead *h, int32_t col, int32_t row)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    const uint32_t *start = &mb->cell_start[row * mb->grid_nx + col];
    const struct carom_zref *r = &mb->zrefs[start[0]], *end = &mb->zrefs[start[1]];
    uint16_t *seen = h->work.leaf->seen;

    if (r == end || r->z1 < h->low_quanta[2] || !cell_near(h, col, row, r->z1)) {
        return;
    }
    for (; r < end && r->z1 >= h->low_quanta[2]; r++) {
        if (r->z0 <= h->high_quanta[2] && seen[r->face % INTERFERE_SEEN] != r->face) {
            seen[r->face % INTERFERE_SEEN] = r->face;
            note_face(h, r->face);
        }
    }
}

/* Note b's faces in the cells under a. */
static void note_faces(struct ahead *h)
{
    const struct carom_mesh *mb = h->work.b->def.mesh;
    const struct interfere_cells cells = interfere_cells_under(mb, h->low_quanta, h->high_quanta);

    memset(h->work.leaf->seen, 0xff, sizeof h->work.leaf->seen); /* = CAROM_NO_FACE */
    for (int32_t row = cells.row[0]; row <= cells.row[1]; row++) {
        for (int32_t col = cells.col[0]; col <= cells.col[1]; col++) {
            note_cell(h, col, row);
        }
    }
}

bool ahead_list(struct ahead *h)
{
    h->count = 0;
    h->end = AHEAD_WHOLE;
    place_axes(h);
    note_faces(h);
    return h->end >= LIST_LEAST;
}

/* -------------------------------------------------------------------- windows */

/* Place the leaf in the middle of a window, as a gather does at mid-span. */
static void place_leaf(struct ahead *h, int32_t from, int32_t to)
{
    struct interfere_leaf *l = h->work.leaf;

    l->near_q20 = h->near_q20;
    l->listed = false;
    for (int k = 0; k < 3; k++) {
        int32_t at =
            h->at_q20[k] + (int32_t)((int64_t)h->moves_q20[k] * (from + to) >> (TIMES_BITS + 1));

        l->shift.c[k] = (int32_t)((int64_t)h->moves_q20[k] * (to - from) >> TIMES_BITS);
        l->reach.c[k] = l->near_q20 + fix_abs32(l->shift.c[k]) / 2 + 1;
        for (uint32_t i = 0; i < l->leaf->vertex_count; i++) {
            l->p[i].c[k] = h->p[i].c[k] + at;
        }
    }
}

int32_t ahead_first(const struct ahead *h, int32_t from)
{
    int32_t first = AHEAD_NEVER;

    for (uint32_t i = 0; i < h->count; i++) {
        int32_t enter = h->list[i].enter > from ? h->list[i].enter : from;

        if (h->list[i].leave >= from && enter < first) {
            first = enter;
        }
    }
    return first;
}

void ahead_visit(struct ahead *h, int32_t from, int32_t to, struct candidate_visitor *visitor)
{
    struct interfere *in = &h->work;

    in->visitor = visitor;
    place_leaf(h, from, to);
    for (uint32_t i = 0; i < h->count; i++) {
        if (h->list[i].enter <= to && h->list[i].leave >= from) {
            interfere_narrow(in, h->list[i].face);
        }
    }
    visitor->visit(visitor, h->candidates, h->pool.used);
    h->pool.used = 0;
}

/* SPDX-License-Identifier: MIT */
/*
 * March along a ray through the cells of a mesh's grid, column by column along x or y, whichever
 * the ray goes farther along, in the ray's order. Each face that a cell's z-list names gets the
 * exact test (strike.c), so the march must only miss none. Places on the ray are off by less than
 * half a quantum here; a quantum is added on all sides.
 */
#include "query.h"

/* Places in quanta have 12 fractional bits: below 2^29. */
#define PLACE_BITS 12
#define MARGIN     (1 << PLACE_BITS)

/* The part of the ray in the mesh's box: start and displacement, 2^-12 quanta. */
struct part {
    int32_t at[3], way[3];
};

/* The ray's place along axis i at the height z along its main axis, both in 2^-12 quanta. */
static int32_t beside(const struct query_ray *ray, int i, int32_t z)
{
    return (int32_t)((ray->at_q30[i] + ((int64_t)ray->slope_q30[i] * z >> PLACE_BITS)) >>
                     (30 - PLACE_BITS));
}

/* From units along the main axis to 2^-12 quanta, clamped to what a box can hold. */
static int32_t place_on_axis(const struct query_ray *ray, int64_t z_q32)
{
    const int shift = 32 - ray->mesh->raw.quantum_bits - PLACE_BITS; /* 0 .. 13 */
    const int64_t limit = (int64_t)1 << (17 + PLACE_BITS);
    int64_t z = z_q32 >> shift;

    return (int32_t)(z > limit ? limit : z < -limit ? -limit : z);
}

/*
 * Narrow [*low, *high] to where the ray is inside the box along axis i. Returns false if nowhere.
 * Bounds: `at` is below 2^51 if the ray passes the mesh's sphere, so the dividend is below 2^63.
 */
static bool clip(const struct query_ray *ray, int i, int32_t *low, int32_t *high)
{
    const int16_t(*box)[3] = ray->mesh->box;
    const int32_t slope = ray->slope_q30[i];
    int axis = ray->axis[i];

    for (int side = 0; side < 2; side++) {
        int32_t edge = (box[side][axis] + (side ? 2 : -2)) * (1 << PLACE_BITS);
        bool low_out = side ? beside(ray, i, *low) > edge : beside(ray, i, *low) < edge;
        bool high_out = side ? beside(ray, i, *high) > edge : beside(ray, i, *high) < edge;

        if (low_out && high_out) {
            return false;
        }
        if (low_out || high_out) {
            int64_t from = edge * ((int64_t)1 << (30 - PLACE_BITS)) - ray->at_q30[i];
            /* the ray is not square to the axis, or both ends would be out */
            int64_t z = from * (1 << PLACE_BITS) / slope;

            if (z > *low && z < *high) {
                *(low_out ? low : high) = (int32_t)z;
            }
        }
    }
    return true;
}

/*
 * Set the part of the ray in the box, with a margin, in the ray's direction. Returns false if there
 * is none.
 */
static bool cut_to_box(const struct query_ray *ray, struct part *part)
{
    const int16_t(*box)[3] = ray->mesh->box;
    const int z = ray->axis[2];
    int64_t end = ray->start_q32 + (ray->up ? ray->end_q32 : -ray->end_q32);
    int32_t low = place_on_axis(ray, ray->up ? ray->start_q32 : end);
    int32_t high = place_on_axis(ray, ray->up ? end : ray->start_q32) + 1;

    low = fix_larger(low, (box[0][z] - 1) * (1 << PLACE_BITS));
    high = fix_smaller(high, (box[1][z] + 1) * (1 << PLACE_BITS));
    if (low > high || !clip(ray, 0, &low, &high) || !clip(ray, 1, &low, &high)) {
        return false;
    }
    part->at[z] = ray->up ? low : high;
    part->way[z] = ray->up ? high - low : low - high;
    for (int i = 0; i < 2; i++) {
        int32_t from = beside(ray, i, low), to = beside(ray, i, high);

        part->at[ray->axis[i]] = ray->up ? from : to;
        part->way[ray->axis[i]] = ray->up ? to - from : from - to;
    }
    return true;
}

/* -------------------------------------------------------------------- columns */

struct march {
    struct query_ray *ray;
    struct query_struck *visitor;
    struct part part;
    int along, across; /* axes: the columns follow each other along x or y; the other one */
    int32_t origin[2], count[2];
    int shift;
};

/* An interval in quanta. */
struct interval {
    int32_t low, high;
};

/* A coordinate's interval between two parts of the way, with a quantum more on both sides. */
static inline struct interval between(const struct part *part, int k, int32_t u0_q30,
                                      int32_t u1_q30)
{
    int32_t a = part->at[k] + (int32_t)((int64_t)part->way[k] * u0_q30 >> 30);
    int32_t b = part->at[k] + (int32_t)((int64_t)part->way[k] * u1_q30 >> 30);

    return (struct interval){((a < b ? a : b) - MARGIN) >> PLACE_BITS,
                             ((a < b ? b : a) + MARGIN) >> PLACE_BITS};
}

static inline int32_t cell_of(const struct march *m, int k, int32_t quanta)
{
    int32_t cell = (quanta - m->origin[k]) >> m->shift;

    return cell < 0 ? 0 : cell >= m->count[k] ? m->count[k] - 1 : cell;
}

static void ask(struct march *m, uint16_t face)
{
    struct query_strike strike;

    if (query_strike(m->ray, face, &strike)) {
        m->visitor->struck(m->visitor, m->ray, &strike);
    }
}

/* Visit the faces of a cell within an interval of z. */
static inline void visit_cell(struct march *m, int32_t cell, struct interval z)
{
    const struct carom_mesh *mesh = m->ray->mesh;
    const struct carom_zref *r = &mesh->zrefs[mesh->cell_start[cell]];
    const struct carom_zref *end = &mesh->zrefs[mesh->cell_start[cell + 1]];

    for (; r < end && r->z1 >= z.low; r++) {
        if (r->z0 <= z.high) {
            ask(m, r->face);
        }
    }
}

/* Visit the cells of a column that the ray passes between two parts of its way. */
static void visit_column(struct march *m, int32_t column, int32_t u0_q30, int32_t u1_q30)
{
    struct interval over = between(&m->part, m->across, u0_q30, u1_q30);
    struct interval z = between(&m->part, 2, u0_q30, u1_q30);
    int32_t from = cell_of(m, m->across, over.low), to = cell_of(m, m->across, over.high);
    int32_t step = m->along == 0 ? m->count[0] : 1;
    int32_t cell = m->along == 0 ? from * step + column : column * m->count[0] + from;

    for (; from <= to; from++, cell += step) {
        visit_cell(m, cell, z);
    }
}

/* Clamp a part of the way to 0 .. 1. */
static inline int32_t cut_q30(int64_t u_q30)
{
    return u_q30 < 0 ? 0 : u_q30 > CAROM_ONE_Q30 ? CAROM_ONE_Q30 : (int32_t)u_q30;
}

/*
 * The last column of a ray that a hit has shortened; the present column if the rest of the ray is
 * outside the box.
 */
static int32_t shorter_last(const struct march *m, int32_t column, int sign)
{
    struct part rest;
    int32_t last;

    if (!cut_to_box(m->ray, &rest)) {
        return column;
    }
    last = cell_of(m, m->along,
                   (rest.at[m->along] + rest.way[m->along] + sign * MARGIN) >> PLACE_BITS);
    return (last - column) * sign > 0 ? last : column;
}

/*
 * Visit the columns from one end of the part to the other. The ray passes the border of two columns
 * at the part `border` of its way, and each further border `step` later. A steep ray may pass a
 * border a quantum sooner or later: `slack`. A ray that a hit has shortened ends in the column of
 * its new end.
 *
 * Bounds: places and sides are below 2^29, so dividends are below 2^60. There are steps only if the
 * way is longer than a quantum, so they are below 2^47.
 */
static void visit_columns(struct march *m)
{
    const int k = m->along;
    const int32_t way = m->part.way[k], from = m->part.at[k];
    const int sign = way < 0 ? -1 : 1;
    int32_t column = cell_of(m, k, (from - sign * MARGIN) >> PLACE_BITS);
    int32_t last = cell_of(m, k, (from + way + sign * MARGIN) >> PLACE_BITS);
    int64_t border_q30 = CAROM_ONE_Q30, step_q30 = 0, end_q32 = m->ray->end_q32;
    int32_t u_q30 = 0, slack_q30 = CAROM_ONE_Q30;

    if (column != last && fix_abs32(way) > MARGIN) {
        int32_t at = m->origin[k] + (column + (sign > 0)) * ((int32_t)1 << m->shift);

        border_q30 = ((int64_t)at * MARGIN - from) * CAROM_ONE_Q30 / way;
        step_q30 = ((int64_t)MARGIN << m->shift) * CAROM_ONE_Q30 / fix_abs32(way);
        slack_q30 = (int32_t)((int64_t)MARGIN * CAROM_ONE_Q30 / fix_abs32(way)) + 1;
    }
    for (;; column += sign) {
        visit_column(m, column, cut_q30((int64_t)u_q30 - slack_q30),
                     cut_q30(border_q30 + slack_q30));
        if (column == last) {
            break;
        }
        if (m->ray->end_q32 < end_q32) {
            end_q32 = m->ray->end_q32;
            last = shorter_last(m, column, sign);
            if (column == last) {
                break;
            }
        }
        u_q30 = cut_q30(border_q30);
        border_q30 += step_q30;
    }
}

void query_march(struct query_ray *ray, struct query_struck *visitor)
{
    const struct carom_mesh *mesh = ray->mesh;
    struct march m = {.ray = ray, .visitor = visitor};

    if (!cut_to_box(ray, &m.part)) {
        return;
    }
    if (mesh_lists_in_step(mesh)) { /* its own z-lists are out of date */
        for (uint32_t face = 0; face < mesh->raw.face_count; face++) {
            ask(&m, (uint16_t)face);
        }
        return;
    }
    m.along = fix_abs32(m.part.way[1]) > fix_abs32(m.part.way[0]) ? 1 : 0;
    m.across = 1 - m.along;
    m.origin[0] = mesh->grid_x0;
    m.origin[1] = mesh->grid_y0;
    m.count[0] = mesh->grid_nx;
    m.count[1] = mesh->grid_ny;
    m.shift = mesh->grid_shift;
    visit_columns(&m);
}

/* SPDX-License-Identifier: MIT */
/*
 * query - questions about a world between its steps (no counterpart in the paper).
 *
 * In: a world, and a ray, a mesh in a pose, a mesh on a way, or two bodies. Out: hits, overlaps,
 * closest points. No question changes a bit of the world.
 *
 * Rays, in order:
 *   carry    a ray in the axes of a body's mesh
 *   march    the faces near the ray, by the cells of the mesh's grid
 *   strike   does the ray meet a face, and where: exact
 *   cast     the first hit of a ray in a world, or all hits
 *
 * Meshes:
 *   put      a mesh in a pose, and the bodies it overlaps
 *   cross    do two bodies have a common point: exact
 *   swept    the first hit of a mesh on a way, by the collision test of a step
 *   ahead    for straight ways: the faces ahead, in the order in which they are reached
 *   times    from when until when two intervals touch
 *   nearest  the closest points of two bodies
 */
#ifndef CAROM_SRC_QUERY_H
#define CAROM_SRC_QUERY_H

#include "carom_query.h"
#include "../world/world.h"

/* True if the filter admits a body to a question. */
bool query_wants(const struct carom_world *w, const struct carom_query_filter *filter,
                 uint32_t body);

/* ---------------------------------------------------------------------- rays */

/*
 * A quantum is 2^30 units of the numbers that decide crossings, and 2^13 of those in early tests.
 */
#define QUERY_EARLY_SHIFT 17

/*
 * A ray in the frame of a mesh. At the height z along its main axis, in quanta from the mesh's
 * origin, the ray is at
 *
 *   x_i = (at_q30[i] + slope_q30[i] z) / 2^30
 *
 * along both other axes i. These integers are the ray; what it meets is exact for them.
 */
struct query_ray {
    const struct carom_mesh *mesh;
    int axis[3];          /* both other axes in right-handed order, then the main axis */
    int64_t at_q30[2];    /* quanta */
    int32_t slope_q30[2]; /* within +-1 */
    /* along the main axis, in units: start, and length of the way */
    int64_t start_q32, length_q32;
    bool up;   /* the ray goes up the main axis, not down */
    bool back; /* faces are met from behind, too */

    /* the way that still matters: a hit may shorten it */
    int64_t end_q32;
};

/* Where a ray meets a face: a place along the main axis. */
struct query_strike {
    uint16_t face;
    int64_t way_q32; /* from start_q32, 0 .. length_q32, rounded down */
};

/*
 * Carry a ray into the frame of a body's mesh. Returns false if the ray stays outside the body's
 * sphere. Range: from and way as in carom_ray.
 */
bool query_carry(struct query_ray *out, const struct carom_ray *ray, const struct body *body,
                 const struct body_state *state);

/* Receives the faces that a ray meets, some more than once. It may shorten ray->end_q32. */
struct query_struck {
    void (*struck)(struct query_struck *self, struct query_ray *ray,
                   const struct query_strike *strike);
};

/* Visit the faces that a ray meets before its end. */
void query_march(struct query_ray *ray, struct query_struck *visitor);

/* True if the ray meets a face before its end; sets `out`. */
bool query_strike(const struct query_ray *ray, uint16_t face, struct query_strike *out);

/* -------------------------------------------------------------------- meshes */

/*
 * Make a moving body of a mesh in a pose; it belongs to no world. Returns CAROM_OK,
 * CAROM_ERR_ARGUMENT for a SURFACE or an invalid rotation, CAROM_ERR_RANGE.
 */
int query_put(const struct carom_query_mesh *mesh, struct body *body, struct body_state *state);

/* True if such a body overlaps a body of the world. */
bool query_overlaps(struct carom_world *w, const struct body *body, const struct body_state *state,
                    uint32_t other);

#endif

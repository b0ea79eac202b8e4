/* SPDX-License-Identifier: MIT */
/*
 * query - questions about a world between its steps.
 *
 *   carry   a ray in the axes of a mesh
 *   march   the faces of a mesh that lie near a ray, by the cells of its grid
 *   strike  whether a ray meets a face, and where: exact
 *   cast    the first hit of a ray, or all of them, in a world
 *   put     a mesh that is in no world: what it overlaps
 *   cross   whether two bodies have a point in common: exact
 *   swept   its first hit on a way
 *   ahead   the faces ahead of one that goes straight, in the order in which it comes there
 *   nearest the closest points of two bodies
 */
#ifndef CAROM_SRC_QUERY_H
#define CAROM_SRC_QUERY_H

#include "carom_query.h"
#include "../world/world.h"

/* Whether a question is about a body. */
bool query_wants(const struct carom_world *w, const struct carom_query_filter *filter,
                 uint32_t body);

/* ---------------------------------------------------------------------- rays */

/* Whole quanta are 2^30 of what crossings count in, those of early tests 2^13. */
#define QUERY_EARLY_SHIFT 17

/*
 * A ray carried into the frame of a mesh. Along its main axis z, in quanta from the mesh's origin, it is at
 *
 *   x_i = (at_q30[i] + slope_q30[i] z) / 2^30
 *
 * for the two other axes i. These whole numbers are the ray: what it meets is exact for them.
 */
struct query_ray {
    const struct carom_mesh *mesh;
    int axis[3];          /* the two others, in a right-handed order, and the main axis */
    int64_t at_q30[2];    /* quanta */
    int32_t slope_q30[2]; /* within +-1 */
    /* along the main axis, units: where it begins and how far it goes, in the sense of `up` */
    int64_t start_q32, length_q32;
    bool up;   /* along the axis, not against it */
    bool back; /* faces are met from behind as well */

    /* the part of the way that is still of interest */
    int64_t end_q32;
};

/* Where a ray meets a face: a place along the main axis. */
struct query_strike {
    uint16_t face;
    int64_t way_q32; /* from the start, 0 .. length_q32, rounded down */
};

/*
 * Carry a ray into the frame of a body's mesh: false when it stays out of the body's sphere.
 * Range: from and way as carom_ray has them
 */
bool query_carry(struct query_ray *out, const struct carom_ray *ray, const struct body *body,
                 const struct body_state *state);

/* Told of the faces that a ray meets; some more than once. It may shorten ray->end_q32. */
struct query_struck {
    void (*struck)(struct query_struck *self, struct query_ray *ray,
                   const struct query_strike *strike);
};

/* Find the faces that a ray meets before its end. */
void query_march(struct query_ray *ray, struct query_struck *visitor);

/* Whether the ray meets a face before its end. */
bool query_strike(const struct query_ray *ray, uint16_t face, struct query_strike *out);

/* -------------------------------------------------------------------- meshes */

/*
 * A moving body of a mesh in a pose, which is in no world. Returns CAROM_OK, CAROM_ERR_ARGUMENT for a
 * SURFACE or a rotation, CAROM_ERR_RANGE.
 */
int query_put(const struct carom_query_mesh *mesh, struct body *body, struct body_state *state);

/* Whether a body that was put somewhere overlaps one of a world. */
bool query_overlaps(struct carom_world *w, const struct body *body, const struct body_state *state,
                    uint32_t other);

#endif

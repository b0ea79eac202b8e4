/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Questions about a world between its steps: rays, meshes that are swept or placed, closest points. @ref rules hold.
 *
 * This is a library of its own over carom.h: a program that asks nothing links nothing of it.
 */
#ifndef CAROM_QUERY_H
#define CAROM_QUERY_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup queries Questions
 * Rays, swept and placed meshes, closest points.
 *
 * No question wakes a body or changes what a step computes. Bodies that are asleep are found; bodies that left the
 * world are not.
 * @{
 */

/** Options of a #carom_query_filter. */
enum carom_query_flags {
    CAROM_QUERY_BACK = 1,   /**< rays also hit faces from behind */
    CAROM_QUERY_SENSORS = 2 /**< sensors are found, too */
};

/** Which bodies a question is about. NULL in place of a filter, or all zero: all bodies except sensors. */
struct carom_query_filter {
    uint16_t mask;  /**< bodies with a category in it; 0: all */
    uint16_t flags; /**< a sum of #carom_query_flags */
    /** true for a body to be found; NULL: all. It must not ask or change anything of the world */
    bool (*wants)(void *context, int body);
    void *context; /**< first argument of `wants`; may be NULL */
};

/** A ray: the places from + t way, with t in 0 to 1. */
struct carom_ray {
    carom_v3_q32 from; /**< place in the world, each component within +-32768 units */
    carom_v3_q32 way;  /**< each component within +-32768 units, one of them at least 2^-20 units */
};

/** A face that a ray meets. */
struct carom_ray_hit {
    uint16_t body;   /**< body number */
    uint16_t face;   /**< face number in its mesh */
    int32_t t_q30;   /**< part of the way, rounded down, 0 to 1 */
    uint32_t t_rest; /**< the next 18 bits of it, which order hits that are close to each other */
    carom_v3_q32 point;  /**< place in the world */
    carom_v3_q30 normal; /**< unit normal of the face, outwards */
};

/**
 * Find the first face that a ray meets: the least t, then the lowest body, then the lowest face.
 *
 * A ray meets faces from outside only, unless #CAROM_QUERY_BACK is set: a ray that begins inside a body does not meet
 * that body. A face that the ray begins on is met at 0.
 *
 * A ray through an edge or a vertex meets the faces that it would meet if it were moved aside by an infinitely small
 * distance, the same for all faces. So it never slips between two faces, and never meets two at one edge.
 *
 * @param ray       the ray
 * @param filter    which bodies; may be NULL
 * @param[out] hit  written if there is one
 * @return 1 or 0; CAROM_ERR_RANGE for a ray out of range; CAROM_ERR_ARGUMENT for one too short
 *
 * @error The ray is carried into the axes of each body once, off by less than 2^-25 units if its way and the radius
 * of the body are 8 units together, and in proportion if they are more. Which faces the carried ray meets, and in
 * which order, is decided in whole numbers without error.
 */
int carom_cast_ray(const struct carom_world *world, const struct carom_ray *ray,
                   const struct carom_query_filter *filter, struct carom_ray_hit *hit);

/**
 * Find all faces that a ray meets, by t, then body, then face.
 *
 * @param ray        the ray
 * @param filter     which bodies; may be NULL
 * @param[out] hits  may be NULL if `room` is 0
 * @param room       how many hits `hits` can hold
 * @return how many there are; CAROM_ERR_FACES_FULL if there are more than `room`: `hits` then holds the first ones;
 *         errors as carom_cast_ray()
 */
int carom_cast_ray_all(const struct carom_world *world, const struct carom_ray *ray,
                       const struct carom_query_filter *filter, struct carom_ray_hit *hits,
                       uint32_t room);

/** A SOLID in a pose, which is in no world. */
struct carom_query_mesh {
    const struct carom_mesh *mesh; /**< of a radius that a moving body may have */
    carom_v3_q32 position;         /**< its centre of mass, units, within +-4096 */
    carom_quat_q30 rotation;       /**< of length 1 within 2^-10; all zero: none */
};

/**
 * Find the bodies that a mesh overlaps: a common point, or one inside the other.
 *
 * @param world        the world; its state does not change
 * @param mesh         the mesh, where it is
 * @param filter       which bodies; may be NULL
 * @param[out] bodies  body numbers in rising order; may be NULL if `room` is 0
 * @param room         how many numbers `bodies` can hold
 * @return how many there are; CAROM_ERR_BODIES_FULL if there are more than `room`: `bodies` then holds the first ones;
 *         CAROM_ERR_ARGUMENT for a SURFACE or a rotation; CAROM_ERR_RANGE for a position or a radius
 *
 * @error The vertices of the mesh are carried into the axes of a body once and rounded: each coordinate is off by less
 * than 2^-26 of the sum of the largest coordinate of the body's mesh and twice the radius of this mesh. From there on
 * all is decided in whole numbers without error: what touches overlaps, and what does not touch is free.
 */
int carom_overlap_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                       const struct carom_query_filter *filter, uint16_t *bodies, uint32_t room);

/**
 * The motion of a swept mesh: its centre moves straight along `way`, and the mesh turns about its centre.
 *
 * It turns as a body does in a step, by the Cayley map of t `turn`: at the part t of the way by twice the angle whose
 * tangent is t |turn|.
 */
struct carom_mesh_way {
    carom_v3_q32 way; /**< units, each component within +-4096, the length at most 512 radii */
    /** Cayley vector, in the mesh's axes, of length at most 1/4 (half a radian); 0: none */
    carom_v3_q30 turn;
};

/** The first hit of a swept mesh. */
struct carom_mesh_hit {
    uint16_t body;           /**< body number */
    uint16_t face;           /**< face number in its mesh */
    uint16_t own_face;       /**< face number in the swept mesh */
    int32_t t_q30;           /**< part of the way that the mesh may go, 0 to 1 */
    carom_v3_q32 position;   /**< centre of the mesh there, units */
    carom_quat_q30 rotation; /**< rotation of the mesh there */
    carom_v3_q32 point;      /**< place in the world where they meet */
    carom_v3_q30 normal;     /**< unit normal, from the body into the mesh */
};

/** Bytes of a #carom_cast_workspace. */
#define CAROM_CAST_BYTES CAROM_BYTES_(3080, 3168)

/**
 * Room for carom_cast_mesh(), so that it takes less stack than a step.
 *
 * Its content means nothing before and after a call: one serves all calls that do not run at the same time.
 */
struct carom_cast_workspace {
    uint64_t words[CAROM_CAST_BYTES / 8]; /**< the call's own */
};

/**
 * Find the first body that a mesh meets on its way, by the collision test of a step, with all bodies where they are.
 *
 * The mesh stops an event gap short of the body: half a skin, 2^-12 of the larger radius of those that move. It stops
 * at 0 if it is nearer than that and comes nearer. A body that it moves away from, or along, does not stop it.
 *
 * @param world      the world; its state does not change
 * @param mesh       the mesh, where it begins
 * @param way        its motion
 * @param filter     which bodies; may be NULL
 * @param workspace  room to work in
 * @param[out] hit   written if there is one
 * @return 1 or 0; CAROM_ERR_OVERLAP if carom_overlap_mesh() finds a body where the mesh begins; CAROM_ERR_RANGE for a
 *         `way` or `turn` out of range; errors for the mesh as carom_overlap_mesh()
 *
 * @source paper, the collision test after Boyse
 */
int carom_cast_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                    const struct carom_mesh_way *way, const struct carom_query_filter *filter,
                    struct carom_cast_workspace *workspace, struct carom_mesh_hit *hit);

/** The closest points of two bodies. */
struct carom_closest {
    int64_t distance_q32;  /**< distance of the points, units */
    carom_v3_q32 point[2]; /**< places in the world: on a, on b */
    carom_v3_q30 normal;   /**< unit vector from the point of b to that of a */
    uint16_t face[2];      /**< faces on which the points lie: of a, of b */
};

/**
 * Find the points of two bodies that are closest to each other.
 *
 * Every leaf of a is compared with every leaf of b, so this costs more than the other questions.
 *
 * @param world     the world; its state does not change
 * @param a         a body
 * @param b         another body
 * @param[out] out  the points
 * @return CAROM_OK; CAROM_ERR_OVERLAP if carom_query_faces() finds pairs of theirs, or one is inside the other;
 *         CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself; CAROM_ERR_RANGE if the centres are more than 500
 *         units apart along an axis of b
 *
 * @error No two points are closer by more than 2^-18 units and 2^-20 of the distance.
 */
int carom_closest_points(struct carom_world *world, int a, int b, struct carom_closest *out);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

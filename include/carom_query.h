/* SPDX-License-Identifier: MIT */
/*
 * carom_query.h - questions about a world between its steps: rays, meshes that are swept or put
 * somewhere, closest points. A library of its own over carom.h, whose rules hold here too. A program
 * that asks nothing of this links nothing of it.
 *
 * No question wakes a body or changes what a step computes. Bodies that are asleep are found; those
 * that left the world are not.
 */
#ifndef CAROM_QUERY_H
#define CAROM_QUERY_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

enum carom_query_flags {
    CAROM_QUERY_BACK = 1,   /* rays also hit faces from behind */
    CAROM_QUERY_SENSORS = 2 /* bodies that only sense are found, too */
};

/* Which bodies a question is about. NULL in place of one, or all zero, means all that are no sensors. */
struct carom_query_filter {
    uint16_t mask;  /* bodies that have a bit of it in their category; 0: all */
    uint16_t flags; /* a sum of enum carom_query_flags */
    bool (*wants)(void *context, int body); /* NULL: all; must ask or change nothing of the world */
    void *context;
};

/* ---------------------------------------------------------------------- rays */

struct carom_ray {
    carom_v3_q32 from; /* each component within +-32768 units */
    carom_v3_q32 way;  /* the same range; one component of 2^-20 units or more */
};

struct carom_ray_hit {
    uint16_t body, face;
    int32_t t_q30;       /* the part of the way, rounded down, 0 .. 1 */
    uint32_t t_rest;     /* and its next 18 bits, which order hits that are close to each other */
    carom_v3_q32 point;  /* of the world */
    carom_v3_q30 normal; /* of the face, outwards */
};

/*
 * The first face that a ray meets: the one of the least t, of equal ones the lowest body and face.
 *
 * Faces are met from outside only, unless CAROM_QUERY_BACK is set: a ray that begins inside a body
 * does not see it. A face that the ray begins on is met at 0.
 *
 * Each body's mesh is asked exactly: the ray is carried into its axes once, off by less than 2^-25 of a unit
 * where its way and the body's radius are 8 units together, in proportion where they are more. What the carried
 * ray meets, and in which order, is decided in whole numbers without error. One that goes through an edge or
 * a vertex meets those faces that it would meet moved aside by less than any number, the same for all
 * faces: none slips through between two, and no two are met at one edge.
 *
 *   filter  may be NULL
 *   hit     out; written when there is one
 *
 * Returns 1 or 0; CAROM_ERR_RANGE for a place or way out of range, CAROM_ERR_ARGUMENT for one too short.
 */
int carom_cast_ray(const struct carom_world *world, const struct carom_ray *ray,
                   const struct carom_query_filter *filter, struct carom_ray_hit *hit);

/*
 * All faces that a ray meets, by t, then body, then face.
 *
 *   hits  out; may be NULL when room is 0
 *
 * Returns how many; CAROM_ERR_FACES_FULL when there are more than `room`: `hits` then holds the first
 *         ones; else as carom_cast_ray.
 */
int carom_cast_ray_all(const struct carom_world *world, const struct carom_ray *ray,
                       const struct carom_query_filter *filter, struct carom_ray_hit *hits,
                       uint32_t room);

/* -------------------------------------------------------------------- meshes */

/* A SOLID that is in no world, in a pose. */
struct carom_query_mesh {
    const struct carom_mesh *mesh; /* of a radius that a moving body may have */
    carom_v3_q32 position;         /* of its centre of mass, within +-4096 */
    carom_quat_q30 rotation;       /* of length 1 within 2^-10; all zero means none */
};

/*
 * The bodies that a mesh has a point in common with where it is, that it is inside of or that are inside of it: in
 * rising order.
 *
 * How near is contact: the mesh's vertices are carried into the axes of a body once and rounded there, each
 * coordinate off by less than 2^-26 of the largest coordinate of the body's mesh and twice the mesh's radius together.
 * From then on all is decided in whole numbers without error: what touches overlaps, and what does not is free,
 * however near.
 *
 *   bodies  out; may be NULL when room is 0
 *
 * Returns how many; CAROM_ERR_BODIES_FULL when there are more than `room`: `bodies` then holds the first ones;
 *         CAROM_ERR_ARGUMENT for a SURFACE or a rotation, CAROM_ERR_RANGE for a place or a radius.
 */
int carom_overlap_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                       const struct carom_query_filter *filter, uint16_t *bodies, uint32_t room);

/*
 * How a mesh is to go: the centre straight along `way`, and the mesh turns about it by the Cayley map of t `turn`,
 * as a body does in a step: at part t of the way by twice the angle whose tangent is t |turn|.
 */
struct carom_mesh_way {
    carom_v3_q32 way;  /* each component within +-4096 units, the length up to 512 radii */
    carom_v3_q30 turn; /* in the mesh's axes; of length up to 1/4, half a radian; 0: none */
};

struct carom_mesh_hit {
    uint16_t body, face;   /* what is met */
    uint16_t own_face;     /* of the mesh */
    int32_t t_q30;         /* the mesh may go so far: a part of the way */
    carom_v3_q32 position; /* and is there then */
    carom_quat_q30 rotation;
    carom_v3_q32 point;  /* where they meet */
    carom_v3_q30 normal; /* from the body into the mesh */
};

/*
 * The first body that a mesh meets on its way, by the collision test of a step (Boyse's) against all bodies where
 * they are. The mesh stops short of it by half of a skin, 2^-12 of the larger radius of those of both that move,
 * as bodies of a step do; at 0 where it is nearer than that already and goes nearer. What it moves away
 * from or along does not stop it.
 *
 *   filter  may be NULL
 *   hit     out; written when there is one
 *
 * Returns 1 or 0; CAROM_ERR_OVERLAP when carom_overlap_mesh finds a body where it begins; as that for the mesh,
 *         CAROM_ERR_RANGE for a way or turn out of range.
 */
int carom_cast_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                    const struct carom_mesh_way *way, const struct carom_query_filter *filter,
                    struct carom_mesh_hit *hit);

/* ------------------------------------------------------------ closest points */

struct carom_closest {
    int64_t distance_q32;  /* of both points */
    carom_v3_q32 point[2]; /* of the world: on a, on b */
    carom_v3_q30 normal;   /* from b's point to a's */
    uint16_t face[2];      /* of a and b, on which they are */
};

/*
 * The points of two bodies that are closest to each other. No two points are closer by more than 2^-18 of a
 * unit and 2^-20 of the distance. Every leaf of a is held against every leaf of b, so this
 * costs more than the other questions.
 *
 * Returns  CAROM_OK; CAROM_ERR_OVERLAP when carom_query_faces has pairs of theirs, or one is inside the other;
 *          CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself; CAROM_ERR_RANGE for bodies whose centres are
 *          more than 500 units apart along an axis of b.
 */
int carom_closest_points(struct carom_world *world, int a, int b, struct carom_closest *out);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Boxes, spheres, capsules, cylinders and cones as meshes, made at run time in the caller's arrays. @ref rules hold.
 */
#ifndef CAROM_SHAPES_H
#define CAROM_SHAPES_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup shapes Shapes
 * Meshes of simple solids, for carom_mesh_build(). The macros size their arrays; they are constant expressions.
 *
 * Lengths are whole quanta, 1 to 32767; carom_shape_room.quantum_bits says what a quantum is. A shape stands along z
 * around the origin. It is closed, convex and oriented outwards. `sides` is the number of vertices around z. Vertices
 * lie on the exact shape, off by the rounding of a coordinate: at most half a quantum and 2^-12 of one. The same calls
 * give the same vertices on every processor.
 *
 * A shape of n sides has about 1 - 6.6 / n^2 (cylinder, cone) or 1 - 16.5 / n^2 (sphere) times the volume of the round
 * one, apart from that rounding.
 *
 * All functions write `raw` only if they return CAROM_OK, and then with the counts of the macros. carom_mesh_build()
 * checks if the engine takes the size in units. Errors of all: CAROM_ERR_ARGUMENT for a length, `sides` or
 * `quantum_bits` out of range; CAROM_ERR_RANGE for a capsule above 32767 quanta, and for more sides than so few quanta
 * can tell apart (rounded vertices that would not be convex); CAROM_ERR_MEMORY for arrays that are too small.
 * @{
 */

#define CAROM_BOX_VERTICES         8                         /**< Vertices of a box. */
#define CAROM_BOX_FACES            12                        /**< Faces of a box. */
#define CAROM_SPHERE_VERTICES(n)   ((n) * ((n) / 2 - 1) + 2) /**< Vertices of a sphere of n sides. */
#define CAROM_SPHERE_FACES(n)      (2 * (n) * ((n) / 2 - 1)) /**< Faces of a sphere of n sides. */
#define CAROM_CAPSULE_VERTICES(n)  ((n) * ((n) / 2) + 2) /**< Vertices of a capsule of n sides. */
#define CAROM_CAPSULE_FACES(n)     ((n) * (n))           /**< Faces of a capsule of n sides. */
#define CAROM_CYLINDER_VERTICES(n) (2 * (n))             /**< Vertices of a cylinder of n sides. */
#define CAROM_CYLINDER_FACES(n)    (4 * (n)-4)           /**< Faces of a cylinder of n sides. */
#define CAROM_CONE_VERTICES(n)     ((n) + 1)             /**< Vertices of a cone of n sides. */
#define CAROM_CONE_FACES(n)        (2 * (n)-2)           /**< Faces of a cone of n sides. */

/** Largest number of sides of any shape. */
#define CAROM_SHAPE_SIDES 128

/** The caller's arrays, and their size. They outlive the mesh. */
struct carom_shape_room {
    int16_t (*vertices)[3]; /**< room for vertices */
    uint16_t (*faces)[3];   /**< room for faces */
    uint32_t vertex_count;  /**< how many vertices fit */
    uint32_t face_count;    /**< how many faces fit */
    uint8_t quantum_bits; /**< a quantum is 2^-quantum_bits units, 7 to 20, as in #carom_mesh_raw */
};

/**
 * Make a box.
 *
 * @param[out] raw  a SOLID over the arrays of `room`, for carom_mesh_build()
 * @param room      at least #CAROM_BOX_VERTICES and #CAROM_BOX_FACES
 * @param half      half the length of the side along each axis, quanta
 * @return CAROM_OK; errors as of all shapes
 */
int carom_shape_box(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                    const int32_t half[3]);

/**
 * Make a sphere.
 *
 * @param[out] raw  a SOLID over the arrays of `room`, for carom_mesh_build()
 * @param room      at least #CAROM_SPHERE_VERTICES and #CAROM_SPHERE_FACES of `sides`
 * @param radius    quanta
 * @param sides     a multiple of 4, 4 to 128
 * @return CAROM_OK; errors as of all shapes
 */
int carom_shape_sphere(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                       int32_t radius, uint32_t sides);

/**
 * Make a capsule: a cylinder with a hemisphere at each end.
 *
 * @param[out] raw     a SOLID over the arrays of `room`, for carom_mesh_build()
 * @param room         at least #CAROM_CAPSULE_VERTICES and #CAROM_CAPSULE_FACES of `sides`
 * @param radius       quanta
 * @param half_length  half the length of the cylinder, quanta; the hemispheres lie beyond it
 * @param sides        a multiple of 4, 4 to 128
 * @return CAROM_OK; errors as of all shapes
 */
int carom_shape_capsule(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                        int32_t radius, int32_t half_length, uint32_t sides);

/**
 * Make a cylinder.
 *
 * @param[out] raw     a SOLID over the arrays of `room`, for carom_mesh_build()
 * @param room         at least #CAROM_CYLINDER_VERTICES and #CAROM_CYLINDER_FACES of `sides`
 * @param radius       quanta
 * @param half_height  quanta
 * @param sides        3 to 128
 * @return CAROM_OK; errors as of all shapes
 */
int carom_shape_cylinder(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                         int32_t radius, int32_t half_height, uint32_t sides);

/**
 * Make a cone, with its base at -half_height and its tip at half_height.
 *
 * @param[out] raw     a SOLID over the arrays of `room`, for carom_mesh_build()
 * @param room         at least #CAROM_CONE_VERTICES and #CAROM_CONE_FACES of `sides`
 * @param radius       of the base, quanta
 * @param half_height  quanta
 * @param sides        3 to 128
 * @return CAROM_OK; errors as of all shapes
 */
int carom_shape_cone(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                     int32_t radius, int32_t half_height, uint32_t sides);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

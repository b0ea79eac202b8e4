/* SPDX-License-Identifier: MIT */
/*
 * carom_shapes.h - boxes, spheres, capsules, cylinders and cones as meshes, made at run time into the caller's
 * arrays. The same calls give the same vertices on every processor.
 *
 * All lengths are whole quanta; the caller's quantum_bits say what a quantum is. A shape stands along z around the
 * origin, is closed, convex and oriented outwards. Its vertices are on the shape that it stands for, but for the
 * rounding of a coordinate, which is at most half a quantum and 2^-12 of one. `sides` is the fineness: the number
 * of vertices around z.
 *
 * A shape of n sides has the volume of the round one times, about, 1 - 6.6 / n^2 (cylinder, cone) or
 * 1 - 16.5 / n^2 (sphere), but for the rounding of its vertices.
 */
#ifndef CAROM_SHAPES_H
#define CAROM_SHAPES_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many vertices and faces a shape has: constant expressions, for the sizes of arrays. */
#define CAROM_BOX_VERTICES         8
#define CAROM_BOX_FACES            12
#define CAROM_SPHERE_VERTICES(n)   ((n) * ((n) / 2 - 1) + 2)
#define CAROM_SPHERE_FACES(n)      (2 * (n) * ((n) / 2 - 1))
#define CAROM_CAPSULE_VERTICES(n)  ((n) * ((n) / 2) + 2)
#define CAROM_CAPSULE_FACES(n)     ((n) * (n))
#define CAROM_CYLINDER_VERTICES(n) (2 * (n))
#define CAROM_CYLINDER_FACES(n)    (4 * (n)-4)
#define CAROM_CONE_VERTICES(n)     ((n) + 1)
#define CAROM_CONE_FACES(n)        (2 * (n)-2)

/* The most sides of any shape. */
#define CAROM_SHAPE_SIDES 128

/* Arrays of the caller's, and how many vertices and faces they have room for. */
struct carom_shape_room {
    int16_t (*vertices)[3];
    uint16_t (*faces)[3];
    uint32_t vertex_count, face_count;
    uint8_t quantum_bits; /* 7 .. 20, as in carom_mesh_raw */
};

/*
 * Fill the arrays of a room with a shape.
 *
 *   raw    out  a SOLID over the room's arrays, ready for carom_mesh_build; its counts are those of the macros
 *   room   in   arrays that outlive the mesh
 *   half, radius, half_height, half_length  quanta, 1 .. 32767
 *
 *   box       half[k] quanta to each side along axis k
 *   sphere    sides: a multiple of 4 from 4 to 128
 *   capsule   a sphere that is drawn out by half_length up and down, the hemispheres beyond that; sides as a sphere
 *   cylinder  sides: 3 .. 128
 *   cone      its base at -half_height, its tip at half_height; sides as a cylinder
 *
 * Returns  CAROM_OK; CAROM_ERR_NULL; CAROM_ERR_ARGUMENT for a length, sides or quantum_bits out of its range;
 *          CAROM_ERR_RANGE for a capsule above 32767 quanta, or for more sides than so few quanta can tell apart:
 *          a shape whose vertices, rounded, would not be convex; CAROM_ERR_MEMORY for arrays that are too small.
 *          raw is written only for CAROM_OK. Whether the size in units is one that the engine takes is for
 *          carom_mesh_build to say.
 */
int carom_shape_box(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                    const int32_t half[3]);
int carom_shape_sphere(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                       int32_t radius, uint32_t sides);
int carom_shape_capsule(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                        int32_t radius, int32_t half_length, uint32_t sides);
int carom_shape_cylinder(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                         int32_t radius, int32_t half_height, uint32_t sides);
int carom_shape_cone(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                     int32_t radius, int32_t half_height, uint32_t sides);

#ifdef __cplusplus
}
#endif

#endif

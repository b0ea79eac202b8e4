/* SPDX-License-Identifier: MIT */
/*
 * oracle - an independent judge of committed frames, in double precision: the crossing faces of
 * two meshes, their depth, and the energy of a body. It shares no code with the engine. Host only.
 *
 * An edge pierces a face when its ends lie strictly on both sides of the face's plane and it meets
 * the plane strictly inside the face. The depth is the shortest shift that would end the piercing:
 * along the face's normal until one end of the edge is back on the plane, or along the plane until
 * the point is on the face's border. A piercing counts when it is deeper than the tolerance, so
 * faces that touch or lie in one plane do not cross.
 */
#ifndef CAROM_TESTS_ORACLE_H
#define CAROM_TESTS_ORACLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct oracle_mesh {
    size_t vertex_count, face_count;
    double (*vertices)[3]; /* units */
    uint32_t (*faces)[3];
};

/* A mesh from whole quanta of 2^-quantum_bits units; ends the program when memory runs out. */
struct oracle_mesh oracle_mesh_make(const int16_t (*vertices)[3], size_t vertex_count,
                                    const uint16_t (*faces)[3], size_t face_count,
                                    int quantum_bits);
void oracle_mesh_free(struct oracle_mesh *mesh);

struct oracle_matrix {
    double row[3][3];
};

/* Pose of a mesh: world = rotation local + position. */
struct oracle_pose {
    struct oracle_matrix rotation;
    double position[3];
};

/*
 * The pose of a mesh whose point `centre` (of mass; 0, 0, 0 for a height field) is at `position`.
 *   quaternion  w, x, y, z; of any length but 0
 */
struct oracle_pose oracle_pose_make(const double position[3], const double quaternion[4],
                                    const double centre[3]);

struct oracle_crossings {
    size_t pairs;            /* face pairs in which an edge of one face pierces the other */
    size_t by_a, by_b;       /* pairs where an edge of a's face pierces b's face, and the reverse */
    double depth;            /* depth of the deepest piercing; 0: none */
    uint32_t face_a, face_b; /* the pair of the deepest piercing */
};

/*
 * Every crossing face pair of two meshes.
 *   tolerance  units; above 0, e.g. 1e-9: well above the rounding of the coordinates
 */
struct oracle_crossings oracle_crossings(const struct oracle_mesh *a,
                                         const struct oracle_pose *pose_a,
                                         const struct oracle_mesh *b,
                                         const struct oracle_pose *pose_b, double tolerance);

/* Depth by which the edge p q pierces the face a b c; 0 or below when it does not. */
double oracle_piercing(const double p[3], const double q[3], const double a[3], const double b[3],
                       const double c[3]);

/* Whether any two points of the meshes are within a distance above 0 of each other. */
bool oracle_near(const struct oracle_mesh *a, const struct oracle_pose *pose_a,
                 const struct oracle_mesh *b, const struct oracle_pose *pose_b, double distance);

/* Whether a point, in the mesh's own axes, is inside a closed mesh; or below a surface. */
bool oracle_inside(const struct oracle_mesh *mesh, const double point[3]);
bool oracle_under(const struct oracle_mesh *mesh, const double point[3]);

/* A moving body, in units and frames. */
struct oracle_body {
    double mass;
    double
        inertia[6]; /* xx, yy, zz, xy, yz, zx, divided by the mass, about the centre, local axes */
    double position[3];          /* position of the centre of mass */
    double quaternion[4];        /* w, x, y, z */
    double velocity[3], spin[3]; /* world axes */
};

/* Energy of translation, of rotation, and of height above the origin against gravity. */
double oracle_energy(const struct oracle_body *body, const double gravity[3]);

#endif

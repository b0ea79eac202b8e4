/* SPDX-License-Identifier: MIT */
/*
 * carom_body.h - what can be asked of a body and done to it beyond carom.h: who it is, where its points
 * are, what it is made of, and what acts on it.
 *
 * The rules at the top of carom.h hold. A body is named by its number or by its id. A property that few bodies have
 * takes one of the world's extras, the first time that it is set: CAROM_ERR_EXTRAS_FULL when there is none left. The
 * extra is the body's until carom_body_remove.
 */
#ifndef CAROM_BODY_H
#define CAROM_BODY_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- identity */

/*
 * The id of a body: its number, and above that how many bodies have had this number. Every function
 * that takes the number of a body takes its id as well, and returns CAROM_ERR_BODY for the id of a body that
 * was removed, whoever has its number by now. The 65536th body of a number has the id of the first.
 * Returns  the id, above 4095; CAROM_ERR_BODY
 */
int carom_body_id(const struct carom_world *world, int body);
/* The number in an id, or the number itself: where arrays of yours have the body. Negative stays. */
int carom_body_number(int id);

/* A pointer that Carom keeps for you and never follows; not a part of a snapshot. NULL: no such body. */
int carom_body_set_user(struct carom_world *world, int body, void *user);
void *carom_body_user(const struct carom_world *world, int body);

/* ------------------------------------------------------------------- places */

/*
 * From the mesh's axes to those of the world: a place p of the mesh is at r p + origin. To have numbers
 * of type `float` for a renderer: CAROM_AS(float, m.r.c[i][k], 30), CAROM_AS(float, m.origin.c[i], 32).
 */
struct carom_matrix {
    carom_m3_q30 r;
    carom_v3_q32 origin; /* of the mesh's coordinates */
};
/* CAROM_OK, CAROM_ERR_NULL or CAROM_ERR_BODY. */
int carom_body_matrix(const struct carom_world *world, int body, struct carom_matrix *matrix);

/*
 * A place of the mesh, in the coordinates of its vertices, as one of the world; and back.
 * CAROM_ERR_RANGE for a component beyond +-8192.
 */
int carom_body_world_point(const struct carom_world *world, int body, const carom_v3_q32 *local,
                           carom_v3_q32 *point);
int carom_body_local_point(const struct carom_world *world, int body, const carom_v3_q32 *point,
                           carom_v3_q32 *local);
/*
 * A direction or a velocity along the mesh's axes as one along the world's, and back. In any format: that
 * of what goes in. CAROM_ERR_RANGE for a component of 2^60 or more. out may be the vector itself.
 */
int carom_body_world_vector(const struct carom_world *world, int body, const int64_t vector[3],
                            int64_t out[3]);
int carom_body_local_vector(const struct carom_world *world, int body, const int64_t vector[3],
                            int64_t out[3]);
/*
 * v + w x (point - centre), units / frame; surfaces that move by themselves apart.
 *   point  of the world, each component within +-4096
 */
int carom_body_velocity_at(const struct carom_world *world, int body, const carom_v3_q32 *point,
                           carom_v3_q40 *velocity);

/* ---------------------------------------------------------------- materials */

#define CAROM_ROLLING_Q16 (1 << 10) /* 1/64: a body's that is not told */

/* The material of a surface. */
struct carom_material {
    int32_t restitution_q30; /* e, 0 .. 1 */
    uint32_t friction_q16;   /* mu, 0 .. 4 */
    /*
     * Rolling friction, 0 .. 1: the normal force acts so much of the radius off. A pair has
     * 64 times the product of both, so that CAROM_ROLLING_Q16 leaves the other as it is; at most 1.
     */
    uint32_t rolling_q16;
    /*
     * The surface moves along itself by this while the body stays where it is, as a conveyor does:
     * units / frame in the mesh's axes, each component within +-16. The part that points out of a face does nothing.
     */
    carom_v3_q40 surface_velocity;
};

/*
 * Make a body of another material; wakes it and what touches it, if it is another one. A body with another
 * rolling friction than CAROM_ROLLING_Q16 or with a surface velocity takes an extra.
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a value out of its range
 */
int carom_body_set_material(struct carom_world *world, int body,
                            const struct carom_material *material);
int carom_body_material(const struct carom_world *world, int body, struct carom_material *material);

/*
 * Let the faces of a body be of several materials, in place of the body's own; takes an extra. Edges and
 * vertices are of the face at them that looks most towards what touches them.
 *
 *   materials  `count` of them, 1 .. 256; NULL: all faces are of the body's own again
 *   of_face    the place of each face's material in that array, one for each face of the mesh
 *
 * Both arrays are yours, and stay where and as they are while the body has them. Their rolling friction is
 * not looked at: the body has one.
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a value out of its range
 */
int carom_body_set_face_materials(struct carom_world *world, int body,
                                  const struct carom_material *materials, uint32_t count,
                                  const uint8_t *of_face);

/* How e, or mu, of a pair comes from that of both. */
enum carom_combine {
    CAROM_SMALLER = 0, /* at first */
    CAROM_LARGER = 1,
    CAROM_PRODUCT = 2, /* mu: at most 4 */
    CAROM_MEAN = 3     /* e: (a + b) / 2; mu: the root of a b */
};
/* Choose for a world, at any time: what rests stays at rest until something wakes it. */
int carom_world_set_combine(struct carom_world *world, enum carom_combine restitution,
                            enum carom_combine friction);

/*
 * Give a moving body another mass, and keep how it moves; wakes it and what is connected with it by touching,
 * if it is another.
 *   mass_q20  2^-10 .. 2^10; 0: the mesh's volume, density 1
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a stationary body or a mass out of range;
 *          CAROM_ERR_RANGE when its force or torque is too much for that mass
 */
int carom_body_set_mass(struct carom_world *world, int body, uint32_t mass_q20);
/* Its mass, to nearest; 0 of a stationary body. */
int carom_body_mass(const struct carom_world *world, int body, uint32_t *mass_q20);

/* ---------------------------------------------------------- forces, impulses */

/* Everything that acts on a body until it is changed: a part of the state, hashed and saved. */
struct carom_forces {
    carom_v3_q40 force;          /* through the centre of mass; carom_body_set_force */
    carom_v3_q40 torque;         /* about it, world axes: mass x units^2 / frame^2 */
    int32_t gravity_scale_q16;   /* gravity acts so many times, -16 .. 16; 1 at first */
    int32_t linear_damping_q30;  /* the part of its momentum that a frame takes, 0 .. 1 */
    int32_t angular_damping_q30; /* and of its angular momentum */
};
/* Everything that acts on a body now. */
int carom_body_forces(const struct carom_world *world, int body, struct carom_forces *forces);

/*
 * Set one of them; wakes the body and what is connected with it by touching, if it is another. All but the
 * first take an extra, unless the value is the one that a body has at first.
 *
 * Torque adds to the angular momentum once, where a frame begins, as much as a frame of it does; so a body
 * turns through the frame at the spin that it will end with. Damping comes before that, at the same
 * place: p - p d, each component rounded to nearest, and gravity and force act over the frame. A body that
 * sleeps or is out takes neither.
 *
 *   set_force_at       the force, and the torque that it has about the centre from a point of the world, where the
 *                      body is now; it does not go with the body
 *   set_torque         each component at most what stops the fastest spin in a frame: 64 mass x radius
 *   set_gravity_scale  within +-16
 *   set_damping        each 0 .. CAROM_ONE_Q30
 *
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a stationary body, a scale or a damping out of
 *          range; CAROM_ERR_RANGE for a torque out of range, or when a component of
 *          scale x gravity + force / mass is beyond +-1
 */
int carom_body_set_force_at(struct carom_world *world, int body, const carom_v3_q40 *force,
                            const carom_v3_q32 *point);
int carom_body_set_torque(struct carom_world *world, int body, const carom_v3_q40 *torque);
int carom_body_set_gravity_scale(struct carom_world *world, int body, int32_t scale_q16);
int carom_body_set_damping(struct carom_world *world, int body, int32_t linear_q30,
                           int32_t angular_q30);

/* carom_body_push through the centre of mass: the spin stays. */
int carom_body_push_centre(struct carom_world *world, int body, const carom_v3_q40 *impulse);
/*
 * Give a moving body an angular impulse at once: mass x units^2 / frame, world axes. Returns as
 * carom_body_push.
 */
int carom_body_twist(struct carom_world *world, int body, const carom_v3_q40 *angular);

#ifdef __cplusplus
}
#endif

#endif

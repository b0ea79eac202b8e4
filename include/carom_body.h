/* SPDX-License-Identifier: MIT */
/**
 * @file
 * More about bodies: who a body is, where its points are, its materials, and the forces on it.
 *
 * A property that few bodies have takes one of the world's extras (carom_caps.extras) when it is first set:
 * CAROM_ERR_EXTRAS_FULL if none is left. The body keeps the extra until carom_body_remove(). @ref rules hold.
 */
#ifndef CAROM_BODY_H
#define CAROM_BODY_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup identity Identity of a body
 * Ids that never name another body, and a pointer of the caller's.
 * @{
 */

/**
 * Returns the id of a body: its number, and above that the count of bodies that have had this number.
 *
 * Every function that takes a body's number takes its id as well. It answers the id of a removed body with
 * CAROM_ERR_BODY, whoever has the number by then. The 65536th body of a number has the id of the first.
 *
 * @return the id, above 4095; CAROM_ERR_BODY
 */
int carom_body_id(const struct carom_world *world, int body);

/** Returns the number in an id, or the number itself: an index for arrays of yours. A negative id stays. */
int carom_body_number(int id);

/**
 * Keep a pointer for the caller. Carom never follows it, and it is not part of a snapshot.
 *
 * @param user   may be NULL
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_set_user(struct carom_world *world, int body, void *user);

/** Returns the pointer of carom_body_set_user() or carom_body_def.user; NULL if there is no such body. */
void *carom_body_user(const struct carom_world *world, int body);

/** @} */
/**
 * @defgroup places Places and directions
 * Convert between the coordinates of a mesh and those of the world.
 * @{
 */

/**
 * A body's transform: the place p of its mesh is at r p + origin in the world.
 *
 * As `float` for a renderer: CAROM_AS(float, m.r.c[i][k], 30), CAROM_AS(float, m.origin.c[i], 32).
 */
struct carom_matrix {
    carom_m3_q30 r;      /**< from the mesh's axes to the world's */
    carom_v3_q32 origin; /**< place of the mesh's origin, units */
};

/**
 * Read the transform of a body.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_matrix(const struct carom_world *world, int body, struct carom_matrix *matrix);

/**
 * Convert a place of the mesh to a place in the world.
 *
 * @param local       coordinates of the mesh, units, each component within +-8192
 * @param[out] point  place in the world; may be `local` itself
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_RANGE
 */
int carom_body_world_point(const struct carom_world *world, int body, const carom_v3_q32 *local,
                           carom_v3_q32 *point);

/**
 * Convert a place in the world to a place of the mesh.
 *
 * @param point       place in the world, units, each component within +-8192
 * @param[out] local  coordinates of the mesh; may be `point` itself
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_RANGE
 */
int carom_body_local_point(const struct carom_world *world, int body, const carom_v3_q32 *point,
                           carom_v3_q32 *local);

/**
 * Turn a direction or a velocity from the mesh's axes to the world's.
 *
 * @param vector    in any format, each component below 2^60
 * @param[out] out  in the same format; may be `vector` itself
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_RANGE
 */
int carom_body_world_vector(const struct carom_world *world, int body, const int64_t vector[3],
                            int64_t out[3]);

/**
 * Turn a direction or a velocity from the world's axes to the mesh's. As carom_body_world_vector().
 *
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_RANGE
 */
int carom_body_local_vector(const struct carom_world *world, int body, const int64_t vector[3],
                            int64_t out[3]);

/**
 * Read the velocity of a body at a place: v + w x (point - centre). The motion of a surface's own vertices is not in it.
 *
 * @param point          place in the world, units, each component within +-4096
 * @param[out] velocity  units / frame
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_RANGE
 */
int carom_body_velocity_at(const struct carom_world *world, int body, const carom_v3_q32 *point,
                           carom_v3_q40 *velocity);

/** @} */
/**
 * @defgroup materials Materials and mass
 * Restitution, friction, rolling friction and conveyors, by body or by face.
 * @{
 */

/** Rolling friction of a body that nobody set: 1/64. */
#define CAROM_ROLLING_Q16 (1 << 10)

/** The material of a surface. */
struct carom_material {
    int32_t restitution_q30; /**< restitution e, 0 to 1 */
    uint32_t friction_q16;   /**< coefficient of friction mu, 0 to 4 */
    /**
     * rolling friction, 0 to 1: the arm of the normal force, in radii. A pair has 64 times the product of both, at
     * most 1, so #CAROM_ROLLING_Q16 leaves the other as it is
     */
    uint32_t rolling_q16;
    /**
     * velocity of the surface along itself while the body stays in place, as of a conveyor belt: units / frame, mesh
     * axes, each component within +-16. The part along a face's normal has no effect
     */
    carom_v3_q40 surface_velocity;
};

/**
 * Change the material of a body. A different one wakes the body and whatever touches it.
 *
 * A rolling friction other than #CAROM_ROLLING_Q16 and a surface velocity take an extra.
 *
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a value out of range; CAROM_ERR_EXTRAS_FULL
 */
int carom_body_set_material(struct carom_world *world, int body,
                            const struct carom_material *material);

/**
 * Read the material of a body.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_material(const struct carom_world *world, int body, struct carom_material *material);

/**
 * Give the faces of a body materials of their own. Takes an extra.
 *
 * An edge or a vertex has the material of its face that looks most at what touches it. Rolling friction stays that
 * of the body.
 *
 * @param materials  `count` materials; NULL: all faces have the body's own again. The array stays the caller's, and
 *                   stays as it is while the body uses it
 * @param count      1 to 256
 * @param of_face    for each face of the mesh, the index of its material; kept like `materials`
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a value out of range; CAROM_ERR_EXTRAS_FULL
 */
int carom_body_set_face_materials(struct carom_world *world, int body,
                                  const struct carom_material *materials, uint32_t count,
                                  const uint8_t *of_face);

/** How the e, or the mu, of a pair follows from those of its two bodies. */
enum carom_combine {
    CAROM_SMALLER = 0, /**< the smaller one; the default */
    CAROM_LARGER = 1,  /**< the larger one */
    CAROM_PRODUCT = 2, /**< the product; mu: at most 4 */
    CAROM_MEAN = 3     /**< e: (a + b) / 2; mu: the root of a b */
};

/**
 * Choose how materials combine in this world. A change wakes all bodies.
 *
 * @return CAROM_OK; CAROM_ERR_ARGUMENT
 */
int carom_world_set_combine(struct carom_world *world, enum carom_combine restitution,
                            enum carom_combine friction);

/**
 * Change the mass of a moving body, and keep its velocity and spin.
 *
 * A different mass wakes the body and all that is connected with it by touching.
 *
 * @param body      a moving body
 * @param mass_q20  2^-10 to 2^10; 0: the volume of the mesh, at density 1
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that does not move freely or a mass out of range;
 *         CAROM_ERR_RANGE if its force or torque is too much for this mass, or the volume is outside 2^-10 to 2^10
 */
int carom_body_set_mass(struct carom_world *world, int body, uint32_t mass_q20);

/**
 * Read the mass of a body, to nearest; 0 for a body that does not move freely.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_mass(const struct carom_world *world, int body, uint32_t *mass_q20);

/** @} */
/**
 * @defgroup forces Forces and impulses
 * Torque, damping and gravity that act until they are changed, and impulses that act at once. See also carom_body_set_force() and
 * carom_body_push().
 *
 * Damping acts first, where a frame begins: p - p d, each component rounded to nearest. Then torque adds to the
 * angular momentum as much as a frame of it does, so the body turns through the frame at the spin that it ends with.
 * Gravity and force act over the frame. Neither torque nor damping acts on a body that sleeps or is out.
 *
 * A different value wakes the body and all that is connected with it by touching. A torque, a gravity scale other
 * than 1, and damping take an extra.
 * @{
 */

/** Torque, damping and gravity scale of a body. They act until changed, and are part of the state: hashed and saved. */
struct carom_forces {
    carom_v3_q40 force;  /**< through the centre of mass, mass x units / frame^2 */
    carom_v3_q40 torque; /**< about the centre of mass, world axes, mass x units^2 / frame^2 */
    int32_t gravity_scale_q16;   /**< factor on gravity, -16 to 16; 1 at first */
    int32_t linear_damping_q30;  /**< part of the momentum lost in a frame, 0 to 1 */
    int32_t angular_damping_q30; /**< part of the angular momentum lost in a frame, 0 to 1 */
};

/**
 * Read what acts on a body.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_forces(const struct carom_world *world, int body, struct carom_forces *forces);

/**
 * Set the force, and the torque that it has about the centre of mass when it acts at a place.
 *
 * The place is used once, with the body where it is now; it does not move with the body.
 *
 * @param body   a moving body
 * @param force  mass x units / frame^2
 * @param point  place in the world, units, each component within +-4096
 * @return as carom_body_set_torque()
 */
int carom_body_set_force_at(struct carom_world *world, int body, const carom_v3_q40 *force,
                            const carom_v3_q32 *point);

/**
 * Set the torque on a moving body.
 *
 * @param body    a moving body
 * @param torque  world axes, mass x units^2 / frame^2; each component at most what stops the fastest spin in a frame,
 *                64 mass x radius
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that does not move freely; CAROM_ERR_RANGE for a
 *         torque out of range, or a component of scale x gravity + force / mass beyond +-1; CAROM_ERR_EXTRAS_FULL
 */
int carom_body_set_torque(struct carom_world *world, int body, const carom_v3_q40 *torque);

/**
 * Set how strongly gravity acts on a moving body.
 *
 * @param body       a moving body
 * @param scale_q16  factor on gravity, within +-16
 * @return as carom_body_set_torque(), and CAROM_ERR_ARGUMENT for a scale out of range
 */
int carom_body_set_gravity_scale(struct carom_world *world, int body, int32_t scale_q16);

/**
 * Set the damping of a moving body.
 *
 * @param body         a moving body
 * @param linear_q30   part of the momentum lost in a frame, 0 to CAROM_ONE_Q30
 * @param angular_q30  part of the angular momentum lost in a frame, 0 to CAROM_ONE_Q30
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that does not move freely or a damping out of range;
 *         CAROM_ERR_EXTRAS_FULL
 */
int carom_body_set_damping(struct carom_world *world, int body, int32_t linear_q30,
                           int32_t angular_q30);

/**
 * Give a moving body an impulse through its centre of mass at once: the spin stays.
 *
 * @param body     a moving body
 * @param impulse  mass x units / frame
 * @return as carom_body_push()
 */
int carom_body_push_centre(struct carom_world *world, int body, const carom_v3_q40 *impulse);

/**
 * Give a moving body an angular impulse at once: the velocity stays.
 *
 * @param body     a moving body
 * @param angular  world axes, mass x units^2 / frame
 * @return as carom_body_push()
 */
int carom_body_twist(struct carom_world *world, int body, const carom_v3_q40 *angular);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Joints between two bodies, or a body and the world: ball, hinge, slider, distance, fixed. @ref rules hold.
 */
#ifndef CAROM_JOINT_H
#define CAROM_JOINT_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup joints Joints
 * Hold two bodies together, with limits, motors and springs.
 *
 * A world has room for carom_caps.joints. The sweeps that solve contacts solve joints too, with impulses kept from
 * frame to frame. A frame ends with the anchors within a skin or two of each other, and within some skins while many
 * bodies fall on others at once; docs/soak.md counts the random worlds in which they were farther apart. The impulses
 * of the last frame, the settings of #carom_joint_drive, and the energy that a group of joints still owes are part of
 * the state: hashed and saved.
 *
 * **Energy.** While nothing touches a group of jointed bodies, the group ends each frame with the energy that it had,
 * plus the work of gravity, forces, motors and springs. When something touches it, it gains none.
 * @{
 */

/** In place of body b: the world itself. */
#define CAROM_WORLD (-1)

/** Kinds of joints, by the motion that they allow. */
enum carom_joint_kind {
    CAROM_JOINT_BALL,   /**< the anchors stay together */
    CAROM_JOINT_HINGE,  /**< the anchors and the axes stay together: a turns about the axis */
    CAROM_JOINT_SLIDER, /**< a moves along the axis, and does not turn */
    CAROM_JOINT_DISTANCE, /**< the limits bound the distance of the anchors: a rope, a rod, a spring */
    CAROM_JOINT_FIXED     /**< a moves with b */
};

/**
 * Limits, motor and spring of a joint. carom_joint_set() changes them.
 *
 * They act on the joint's coordinate. A hinge: the angle by which a has turned about the axis against b since the
 * joint was added, radians, within +-pi. A slider: the distance that a has moved along the axis since then, units. A
 * distance joint: the distance of the anchors, units. A ball and a fixed joint have no coordinate.
 */
struct carom_joint_drive {
    bool limited;      /**< the limits hold */
    int64_t lower_q32; /**< least coordinate; of a hinge within +-3.1 */
    int64_t upper_q32; /**< largest coordinate, at least `lower_q32`; of a hinge within +-3.1 */
    bool motor;        /**< the motor runs; hinge and slider only */
    int64_t motor_speed_q40; /**< wanted change of the coordinate in a frame; below 64 */
    /** largest torque (mass x units^2 / frame^2) or force (mass x units / frame^2) of the motor; 0 to 2^20 */
    int64_t motor_most_q40;
    bool spring;           /**< the spring acts; not together with a motor */
    int64_t rest_q32;      /**< coordinate at which the spring is loose */
    int64_t stiffness_q40; /**< torque per radian, or force per unit; 0 to 2^20 */
    int64_t damping_q40; /**< torque or force per change of the coordinate in a frame; 0 to 2^20 */
};

/** The definition of a new joint. */
struct carom_joint_def {
    uint8_t kind; /**< #carom_joint_kind */
    bool touch;   /**< its bodies may touch each other; otherwise they ignore each other */
    int a;        /**< a body that moves freely */
    int b;        /**< another body, which may be kinematic and lead a; or #CAROM_WORLD */
    /** place in the world, with the bodies where they are now, within +-4096 */
    carom_v3_q32 anchor;
    carom_v3_q32 anchor_b; /**< distance joint: the anchor on b, likewise */
    carom_v3_q30 axis;     /**< hinge and slider: axis in the world, of length 1 within 2^-10 */
    struct carom_joint_drive drive; /**< limits, motor and spring at first */
    /** the joint breaks when a frame takes more, mass x units / frame; 0: never */
    int64_t most_impulse_q40;
};

/**
 * Add a joint. Its bodies wake.
 *
 * @param def    copied
 * @return the number of the joint (>= 0); CAROM_ERR_BODY;
 *         CAROM_ERR_ARGUMENT for a kind, an axis, a body a that does not move freely, or a drive that its kind lacks;
 *         CAROM_ERR_RANGE for an anchor more than 64 radii of a body from its centre, or a number out of range;
 *         CAROM_ERR_JOINTS_FULL
 */
int carom_joint_add(struct carom_world *world, const struct carom_joint_def *def);

/**
 * Remove a joint. carom_body_remove() removes the joints of a body.
 *
 * Two bodies that ignored each other and overlap go through each other until they are apart, also when a joint breaks.
 *
 * @return CAROM_OK; CAROM_ERR_JOINT; CAROM_ERR_PAIRS_FULL if there is no room to let them pass: the joint stays
 */
int carom_joint_remove(struct carom_world *world, int joint);

/**
 * Change limits, motor and spring. Different ones wake what is connected.
 *
 * @return CAROM_OK; CAROM_ERR_JOINT; CAROM_ERR_ARGUMENT, CAROM_ERR_RANGE as carom_joint_add()
 */
int carom_joint_set(struct carom_world *world, int joint, const struct carom_joint_drive *drive);

/** Where a joint is, and what it gave in the last frame. */
struct carom_joint_state {
    uint8_t kind;           /**< #carom_joint_kind */
    bool broken;            /**< it took too much, and holds nothing any more */
    int a;                  /**< body number */
    int b;                  /**< body number or #CAROM_WORLD */
    carom_v3_q32 anchor[2]; /**< places of the anchor on a, and on b, in the world */
    carom_v3_q30 axis;      /**< the axis on b, in the world */
    int64_t coordinate_q32; /**< coordinate, radians or units */
    int64_t speed_q40;      /**< its change in a frame, as the bodies move now */
    carom_v3_q40 impulse;   /**< impulse on a in the last frame, mass x units / frame */
    carom_v3_q40 moment;    /**< angular impulse on a in the last frame, mass x units^2 / frame */
    int64_t drive_q40; /**< the part of these along the axis that limits, motor or spring gave */
    struct carom_joint_drive drive; /**< limits, motor and spring */
};

/**
 * Read where a joint is, and what it gave in the last frame.
 *
 * @return CAROM_OK; CAROM_ERR_JOINT
 */
int carom_joint_get(const struct carom_world *world, int joint, struct carom_joint_state *state);

/** Returns an upper bound: the numbers of all joints are below it. */
int carom_joint_count(const struct carom_world *world);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

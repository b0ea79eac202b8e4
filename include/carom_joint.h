/* SPDX-License-Identifier: MIT */
/*
 * carom_joint.h - joints: ball, hinge, slider, distance, fixed; between two bodies, or a body and the world.
 *
 * A world has room for `joints` of its capacities. Joints are solved in the sweeps that solve contacts, with
 * impulses kept from frame to frame. A frame ends with the anchors within a skin or two of each other, and within
 * some skins while many bodies fall on others at once; README says how far apart they were seen. The impulses of the last frame, what may be
 * set here, and what of the energy a group of joints owes are part of the state: hashed and saved.
 *
 * Energy: while nothing touches a group of jointed bodies it has at the end of each frame the energy that it
 * had, what gravity, forces, motors and springs did included. Where something touches it gains none.
 */
#ifndef CAROM_JOINT_H
#define CAROM_JOINT_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CAROM_WORLD (-1) /* in the place of body b */

enum carom_joint_kind {
    CAROM_JOINT_BALL,     /* anchors together */
    CAROM_JOINT_HINGE,    /* and axes: a turns about the axis */
    CAROM_JOINT_SLIDER,   /* a goes along the axis and does not turn */
    CAROM_JOINT_DISTANCE, /* anchors as far apart as the limits say: a rope, a rod, a spring */
    CAROM_JOINT_FIXED     /* a goes with b */
};

/*
 * Settings that may be changed while the joint is there. The coordinate of a hinge is the angle in radians by which a is
 * turned about the axis against b since it was added, within +-pi; of a slider the way of a along the axis
 * since then; of a distance joint the distance of its anchors; both in units. A ball and a fixed joint have none.
 */
struct carom_joint_drive {
    bool limited;
    int64_t lower_q32, upper_q32; /* of the coordinate, lower <= upper; a hinge's within +-3.1 */
    bool motor;                   /* a hinge's or a slider's */
    int64_t motor_speed_q40;      /* wanted change of the coordinate in a frame; below 64 */
    int64_t
        motor_most_q40; /* torque or force at most, mass x units^2 or units / frame^2; 0 .. 2^20 */
    bool spring;        /* not together with a motor */
    int64_t rest_q32;   /* the coordinate at which it is loose */
    int64_t stiffness_q40; /* torque a radian, or force a unit; 0 .. 2^20 */
    int64_t damping_q40;   /* torque or force by change of the coordinate in a frame; 0 .. 2^20 */
};

struct carom_joint_def {
    uint8_t kind; /* enum carom_joint_kind */
    bool touch;   /* whether its bodies may touch each other; else they ignore each other */
    int a,
        b; /* a moves; b is another body, a kinematic one that leads a along too, or CAROM_WORLD */
    carom_v3_q32 anchor;   /* in the world as its bodies are now; within +-4096 */
    carom_v3_q32 anchor_b; /* the anchor on b of a distance joint */
    carom_v3_q30 axis;     /* of a hinge or a slider, in the world; its length is 1 within 2^-10 */
    struct carom_joint_drive drive;
    int64_t most_impulse_q40; /* breaks when a frame takes more, mass x units / frame; 0: never */
};

/*
 * Add a joint. Its bodies wake. Returns its number (>= 0); CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a kind, an axis,
 * a body that does not move as a, or a drive that is none of its kind's; CAROM_ERR_RANGE for an anchor farther
 * than 64 radii of a body from its centre or numbers out of the ranges above; CAROM_ERR_JOINTS_FULL.
 */
int carom_joint_add(struct carom_world *world, const struct carom_joint_def *def);
/*
 * Take a joint away. carom_body_remove takes those of a body along. Two bodies that ignored each other and
 * overlap pass through each other until they are apart; so they do when the joint breaks. CAROM_ERR_JOINT for a
 * number that is free; CAROM_ERR_PAIRS_FULL when there is no room to let them pass: the joint stays.
 */
int carom_joint_remove(struct carom_world *world, int joint);

/* Change limits, motor and spring. What is connected wakes if they are others. Errors as of carom_joint_add. */
int carom_joint_set(struct carom_world *world, int joint, const struct carom_joint_drive *drive);

struct carom_joint_state {
    uint8_t kind;
    bool broken; /* holds nothing any more */
    int a, b;
    carom_v3_q32 anchor[2];            /* on a, and on b */
    carom_v3_q30 axis;                 /* on b */
    int64_t coordinate_q32, speed_q40; /* and its change in a frame as the bodies move now */
    carom_v3_q40 impulse;              /* on a in the last frame, mass x units / frame */
    carom_v3_q40 moment;               /* and the moment, mass x units^2 / frame */
    int64_t drive_q40; /* of these, what limits, motor or spring gave along the axis */
    struct carom_joint_drive drive;
};
/* Where a joint is, and what it gave in the last frame. Returns CAROM_OK, CAROM_ERR_NULL or CAROM_ERR_JOINT. */
int carom_joint_get(const struct carom_world *world, int joint, struct carom_joint_state *state);
/* The numbers of all joints are below this. */
int carom_joint_count(const struct carom_world *world);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/*
 * soak_machine - turns a random world into a machine: joints, kinematic bodies, filters, sensors,
 * bodies that are solid from one side, a callback, belts, damping; and the checks of these.
 */
#ifndef CAROM_TESTS_SOAK_MACHINE_H
#define CAROM_TESTS_SOAK_MACHINE_H

#include "carom_body.h"
#include "carom_joint.h"
#include "crowd.h"
#include "soak_shapes.h"
#include "test.h"

struct soak_world;
struct soak_result;

/* ------------------------------------------------------------- bodies that are led */

/* The motion of a kinematic body: to and fro along a wave, or by jumps, around its first place. */
struct soak_leader {
    bool smooth, turns;
    double at[3], way[3], axis[3], rate, wave;
    carom_quat_q30 start;
};

/* `size` is the approximate size of its motion. */
void soak_leader_begin(struct soak_leader *leader, const struct carom_body_def *def, double size,
                       struct test_random *r);
/* Move a kinematic body to its place in a frame; a move too far for one frame is left out. */
void soak_lead(struct carom_world *world, int body, const struct soak_leader *leader, long frame,
               struct test_random *r);

/* -------------------------------------------------------------------------- joints */

#define SOAK_JOINTS 40
#define SOAK_FRAMES 300

/*
 * A joint, with the poses of its bodies when it was added, in double: the checks use nothing else.
 */
struct soak_joint {
    struct carom_joint_def def;
    bool removed, gone;           /* removed: by a call; gone: removed or broken */
    double arm[2][3], axis[2][3]; /* its anchors and its axis in the axes of its bodies */
    double turn[2][4];            /* rotations of its bodies */
};

/* The largest errors of joints. */
struct soak_off {
    double apart;  /* anchors, in skins of the smaller body; for a slider, across its axis */
    double axes;   /* axes, or turns that a joint forbids: radians */
    double beyond; /* limits of lengths: skins */
    double bent;   /* limits of angles: radians */
    long frame;    /* frame of the largest `apart` */
    int joint;
};

/* Store a joint's anchors and axes from the present poses of its bodies. */
void soak_joint_note(const struct crowd *crowd, struct soak_joint *joint);
/* The energy of its spring, and the error of that energy by the rounding of poses. */
double soak_joint_energy(const struct crowd *crowd, const struct soak_joint *joint, double *noise);
/* Keep the joint's present errors where they are the largest so far. */
void soak_joint_look(const struct crowd *crowd, const struct soak_joint *joint, int number,
                     long frame, struct soak_off *off);

/* ------------------------------------------------------------------------ machines */

struct soak_machine {
    struct test_random r; /* decides what happens while the machine runs */
    bool wild, led, driven, filtered, asks, belts, damped;
    struct soak_joint joints[SOAK_JOINTS];
    int joint_count;
    struct soak_leader leaders[CROWD_BODIES];
    struct carom_filter filters[CROWD_BODIES]; /* the present filters */
    int first;                                 /* the first body that is no ground */
    uint64_t seed;
    struct carom_material materials[4]; /* materials of faces */
    uint8_t of_face[SOAK_FACES];
};

/* The observations of a machine. */
struct soak_seen {
    bool within[CROWD_BODIES][CROWD_BODIES]; /* by sensor and visitor, as events report */
    struct crowd_link links[SOAK_JOINTS];
    struct soak_off free; /* joints of untouched islands */
    struct soak_off any;
    long breaks, blocked, sensed; /* events */
    long sensor_asked,
        sensor_frame; /* queries; the first frame in which a sensor was wrong, 0: none */
    int sensor, visitor;
    /* halfway: a snapshot, its hash, and the machine's state then; and its state at the start */
    void *snapshot;
    int snapshot_bytes;
    struct soak_machine half, start;
    uint64_t hashes[SOAK_FRAMES + 1]; /* hash after each frame */
    /* the first frame after which a second run had another hash, 0: none; it loads the snapshot
     * halfway */
    long other_frame;
    bool refused; /* the snapshot was refused */
};

/*
 * Turn a world of soak_make into a machine, before it starts. In a wild one jointed bodies move as
 * fast as they were drawn, up to hundreds of turns a frame; otherwise by half of their radius at
 * most.
 */
void soak_machine_make(struct soak_world *world, bool wild);
/* Set the world's callback, if it has one. */
void soak_machine_ask(struct soak_world *world);
/* Add joints, materials and filters, after the bodies. Returns CAROM_OK or an error. */
int soak_machine_start(struct soak_world *world);
/* Make the calls before a frame. Returns CAROM_OK or an error. */
int soak_machine_act(struct soak_world *world, long frame);
/* Call after each step: before the crowd is watched, and after that. */
void soak_machine_see(struct soak_world *world);
void soak_machine_watch(struct soak_world *world, long frame);
/* Note the joints that broke in the last step; they hold nothing any more. */
void soak_machine_note_breaks(struct soak_world *world);
/* Note the energy of springs before a step. */
void soak_machine_before(struct soak_world *world);
/* Whether filters let two bodies meet. */
bool soak_machine_may_meet(const struct soak_world *world, int a, int b);
/*
 * Tell the checker which bodies pass each other, because of filters, sensors, one-way sides, the
 * callback and joints.
 */
void soak_machine_let_pass(struct soak_world *world);

/*
 * Halfway: store what a second run must reproduce. After the last frame, the second run: over the
 * first half from the start, over the second half from the snapshot in a new world. The world is
 * then that of the second run.
 */
void soak_machine_half(struct soak_world *world);
void soak_machine_again(struct soak_world *world);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * soak_machine - turns a random world into a machine: joints, kinematic bodies, filters, sensors, bodies that are solid
 * from one side, a callback, belts, damping; and the checks of these.
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

/* The motion of a kinematic body: to and fro by a wave, or by jumps, about its first place. */
struct soak_leader {
    bool smooth, turns;
    double at[3], way[3], axis[3], rate, wave;
    carom_quat_q30 start;
};

/* `size`: about the size of its ways. */
void soak_leader_begin(struct soak_leader *leader, const struct carom_body_def *def, double size,
                       struct test_random *r);
/* Move a kinematic body to its place in a frame; a move too far for one frame is left out. */
void soak_lead(struct carom_world *world, int body, const struct soak_leader *leader, long frame,
               struct test_random *r);

/* -------------------------------------------------------------------------- joints */

#define SOAK_JOINTS 40
#define SOAK_FRAMES 300

/* A joint, with the poses of its bodies when it was added in double: the checks know no more of it. */
struct soak_joint {
    struct carom_joint_def def;
    bool removed, gone;           /* taken away; taken away or broken */
    double arm[2][3], axis[2][3]; /* its anchors and its axis in the axes of its bodies */
    double turn[2][4];            /* rotations of its bodies */
};

/* The largest errors of joints. */
struct soak_off {
    double apart;  /* anchors; a slider's across its axis: skins of the smaller body */
    double axes;   /* axes, or turns that a joint forbids: radians */
    double beyond; /* limits of lengths: skins */
    double bent;   /* limits of angles: radians */
    long frame;    /* frame of the largest `apart` */
    int joint;
};

/* Note a joint's anchors and axes from the present poses of its bodies. */
void soak_joint_note(const struct crowd *crowd, struct soak_joint *joint);
/* The energy in its spring, and the error of it by the rounding of poses. */
double soak_joint_energy(const struct crowd *crowd, const struct soak_joint *joint, double *noise);
/* Take over the joint's present errors where they are the largest so far. */
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
    int first;                                 /* first of the bodies that are no ground */
    uint64_t seed;
    struct carom_material materials[4]; /* materials of faces */
    uint8_t of_face[SOAK_FACES];
};

/* The observations of a machine. */
struct soak_seen {
    bool within[CROWD_BODIES][CROWD_BODIES]; /* sensor, visitor: as events say */
    struct crowd_link links[SOAK_JOINTS];
    struct soak_off free; /* joints of islands that nothing touched */
    struct soak_off any;
    long breaks, blocked, sensed; /* events */
    long sensor_asked,
        sensor_frame; /* questions; the first frame in which a sensor was wrong, 0: none */
    int sensor, visitor;
    /* half-way: a snapshot, its hash, and what the machine was then; and what it was at the start */
    void *snapshot;
    int snapshot_bytes;
    struct soak_machine half, start;
    uint64_t hashes[SOAK_FRAMES + 1]; /* after each frame */
    /* the first frame after which a second run had another hash, 0: none; it takes the snapshot half-way */
    long other_frame;
    bool refused; /* it was not taken */
};

/*
 * Make a world of soak_make a machine, before it starts. In a wild one what is joined moves as fast as it was drawn, up to
 * hundreds of turns in a frame; else by half of its radius at most.
 */
void soak_machine_make(struct soak_world *world, bool wild);
/* Have the world ask its callback, if it has one. */
void soak_machine_ask(struct soak_world *world);
/* Add joints, materials and filters, after the bodies. Returns CAROM_OK or an error. */
int soak_machine_start(struct soak_world *world);
/* Make the calls before a frame. Returns CAROM_OK or an error. */
int soak_machine_act(struct soak_world *world, long frame);
/* After each step, before the crowd is watched; and after that. */
void soak_machine_see(struct soak_world *world);
void soak_machine_watch(struct soak_world *world, long frame);
/* Note the joints that broke in the last step; they hold nothing more. */
void soak_machine_note_breaks(struct soak_world *world);
/* Note how much springs hold before a step. */
void soak_machine_before(struct soak_world *world);
/* Whether filters let two bodies meet. */
bool soak_machine_may_meet(const struct soak_world *world, int a, int b);
/* Tell the checker which bodies pass each other by filters, sensors, sides, the callback and joints. */
void soak_machine_let_pass(struct soak_world *world);

/*
 * Half-way: note what a second run is to come by. And that run, after the last frame: over the first half from the
 * start, over the second one from the snapshot in a world made anew. The world is then that of the second run.
 */
void soak_machine_half(struct soak_world *world);
void soak_machine_again(struct soak_world *world);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * joint - what holds two bodies together: up to six rows of velocities that a solve makes what they must be.
 *
 * A row is a direction d at the joint's point or an axis d, in the world. V of a linear row is d.(v_a + w_a x
 * r_a - v_b - w_b x r_b), of an angular one d.(w_a - w_b). The rows that always hold come first; the last one may be that
 * of the coordinate, which limits, a motor or a spring drive. All rows of a joint are solved at once: K, n x n, is
 * inverted before the sweeps, and where the last row is limited the others follow it. Rows that always hold are solved for the
 * whole island at once (joint_direct.c).
 *
 * Units. A linear row counts velocities over 2^down, an angular one at an arm of 2^length_bits of q22, so that K is
 * near 1. Impulses of a row are counted in the unit of velocity times the mass of the island's lightest body, over
 * 2^JOINT_FINE_BITS.
 */
#ifndef CAROM_SRC_JOINT_H
#define CAROM_SRC_JOINT_H

#include "carom_joint.h"
#include "../pairs/island.h"

#define JOINT_ROWS      6
#define JOINT_FINE_BITS 5
#define JOINT_WORLD     0xffffu

/* The effect of a row impulse on one of the two bodies. */
struct joint_lever {
    struct body *body; /* NULL: does not answer */
    int32_t share_q30; /* the lightest body's mass over this one's */
    /* from the centre of mass to the joint's point, in units of 2^-arm_bits */
    int32_t arm[3];
    int32_t arm_bits;
    int32_t turn[JOINT_ROWS][3]; /* V of each row by du, see contact_lever */
};

/* The law of the last row; velocities and impulses in the solver's units. */
struct joint_law {
    bool lower, upper, motor, spring;
    int32_t low_v, high_v; /* that the limits ask for at least and at most */
    int32_t motor_v;
    int32_t spring_v; /* with which the spring has no impulse */
    int32_t soft_q30; /* of the impulse that leads to spring_v, what the spring gives */
    int64_t most;     /* of the motor */
};

/* A row of the factors for all held rows of an island; its numbers are in the room from `start` on. */
struct joint_row {
    uint32_t start;
    uint16_t first;            /* row that it meets */
    struct fix_scaled inverse; /* of its diagonal entry; 0: it has no impulse of its own */
    int64_t x;
};

/* Numbers of factors for each joint that a world has room for. */
#define JOINT_ROOM 128

/* A joint in a solve. */
struct joint_work {
    struct joint_lever lever[2];
    const struct body *led;      /* b, where it is a kinematic body on its way; else NULL */
    const struct body *lightest; /* of the island's bodies that answer: the unit of mass */
    uint8_t rows, held;          /* of these so many always hold: all, or all but the last */
    uint8_t angular;             /* a bit for each row */
    uint16_t row_at;             /* its first one among the island's */
    bool idle;                   /* solved, or not to be solved now */
    bool by_speed;               /* the slice is too short to measure: V of a row is its change */
    bool torn;                   /* apart by some skins at the end of the slice */
    int8_t down, length_bits;
    int8_t inverse_bits;                     /* fractional bits of the inverse */
    int32_t direction[JOINT_ROWS][3];        /* q30 */
    int32_t inverse[JOINT_ROWS][JOINT_ROWS]; /* of K */
    int32_t ratio_q28[JOINT_ROWS];           /* column of the last row over its own entry */
    struct joint_law law;
    /* before the solve: what V of a row must change by on the present paths, less V itself where it is by_speed */
    int64_t wanted_q40[JOINT_ROWS];
    int64_t change_q40[JOINT_ROWS]; /* that change */
    int64_t speed_q40[JOINT_ROWS];  /* V before the solve */
    /* what V of the last row must change by for the limits and the spring; the motor's impulse, the spring's by V; the
     * largest of these changes */
    int64_t low_q40, high_q40, most_q40, spring_q40, stiff_q40, least_q40;
    int64_t elastic_q40,
        half_stiff_q40; /* the spring's impulse without damping: -elastic - half_stiff (V' - V) */
    /* in the sweeps */
    int32_t before[JOINT_ROWS]; /* V - wanted V; of the last row V */
    int32_t gain[JOINT_ROWS], way[JOINT_ROWS];
    int64_t impulse[JOINT_ROWS];
    /* after them: on a */
    carom_v3_q40 push, moment;
    int64_t row_q40[JOINT_ROWS];
};

static inline bool joint_is_angular(const struct joint_work *w, int row)
{
    return (w->angular >> row & 1) != 0;
}

/* The part of a joint that a step changes: two of them. All of it is hashed and saved. */
struct joint_state {
    struct carom_joint_drive drive;
    int64_t impulse_q40[JOINT_ROWS]; /* of the last frame, along the rows */
    carom_v3_q40 push, moment;       /* the sum of the last frame, on a */
    int64_t axial_q40;
    struct fix_wide
        owed2; /* twice the energy that its group has too much, q80; at one joint of a group */
    uint8_t broken;
};

struct joint {
    bool used;
    uint8_t kind;
    bool touch;
    uint16_t a, b; /* b may be JOINT_WORLD */
    carom_v3_q40 arm
        [2]; /* the anchors from the centres of mass, in the meshes' axes; in the world of the world */
    carom_quat_q30 frame[2]; /* the joint's axes in those of each body; z is the axis */
    int64_t most_impulse_q40;
    bool chosen; /* step: to be solved, when it holds */

    uint16_t next; /* one more than the next joint of the island at hand; 0 ends */
    struct joint_work work;
};

/* The purpose of a solve. */
enum joint_solve {
    JOINT_FRAME,  /* the start of a frame: motors and springs as well */
    JOINT_MORE,   /* once more, for what paths bend by */
    JOINT_HIT,    /* in a frame */
    JOINT_PROJECT /* its end: velocities alone */
};

struct joint_calls;

/* The joints of a world. */
struct joint_list {
    const struct joint_calls *calls; /* NULL while there was none yet */
    enum joint_solve solve;
    struct joint *joints;
    struct joint_state *states; /* those of the step at hand */
    uint32_t count;
    uint16_t first; /* one more than the first of the island at hand; 0: it has none */
    bool factored;  /* its factors are in the room */
    struct joint_row *rows;
    int32_t *room;
    uint32_t room_size;
};

inline bool joint_holds(const struct joint_list *list, uint32_t i)
{
    return list->joints[i].used && !list->states[i].broken;
}

/* A body where a joint looks at it: for the world it does not turn and is at 0. */
struct joint_pose {
    carom_v3_q32 position;
    carom_quat_q30 rotation;
};

/* How far a joint is from where it belongs, by row; the last row is the coordinate, where it has one. */
struct joint_error {
    int64_t row_q40[JOINT_ROWS]; /* units or radians */
    int64_t coordinate_q40;
};

/* Whether a kind has a coordinate. */
bool joint_has_coordinate(uint8_t kind);
bool joint_is_driven(const struct joint *j, const struct joint_state *s);

/* a b of two numbers in q40, at most 2^60. */
int64_t joint_product_q40(int64_t a_q40, int64_t b_q40);

/* The way from one angle of a hinge to another: within half a turn. */
int64_t joint_turned_q40(int64_t from_q40, int64_t to_q40);

void joint_measure(const struct joint *j, const struct joint_pose pose[2], struct joint_error *out);

/* The directions of the rows, and the joint's point or the anchors from both centres. */
void joint_set_rows(struct joint *j, const struct joint_state *s, const struct joint_pose pose[2]);

/* The point on a body where the joint is anchored, in the world. */
carom_v3_q32 joint_anchor(const struct joint *j, int side, const struct joint_pose *pose);
carom_v3_q30 joint_axis(const struct joint *j, const struct joint_pose *pose_b);

#endif

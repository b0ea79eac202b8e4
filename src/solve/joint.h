/* SPDX-License-Identifier: MIT */
/*
 * joint - what holds two bodies together: up to six rows, each a velocity that a solve makes what
 * it must be.
 *
 * A row is a direction d at the joint's point, or an axis d, in world axes. V of a linear row is
 * d.(v_a + w_a x r_a - v_b - w_b x r_b), of an angular row d.(w_a - w_b). Held rows come first. The
 * last row may be that of the coordinate, which limits, a motor or a spring drive. All rows of a
 * joint are solved at once: K, n x n, is inverted before the sweeps, and where the last row is
 * limited the others follow it. Held rows are solved for the whole island at once (joint_direct.c).
 *
 * Units. A linear row counts velocities over 2^down, an angular row at an arm of 2^length_bits of
 * q22, so that K is near 1. Impulses of a row are counted in the unit of velocity times the mass of
 * the island's lightest body, over 2^JOINT_FINE_BITS.
 */
#ifndef CAROM_SRC_JOINT_H
#define CAROM_SRC_JOINT_H

#include "carom_joint.h"
#include "../pairs/island.h"

#define JOINT_ROWS      6
#define JOINT_FINE_BITS 5
#define JOINT_WORLD     0xffffu

/* The effect of row impulses on one of both bodies. */
struct joint_lever {
    struct body *body; /* NULL: it does not answer to impulses */
    int32_t share_q30; /* the lightest body's mass over this one's */
    /* from the centre of mass to the joint's point, 2^-arm_bits units */
    int32_t arm[3];
    int32_t arm_bits;
    int32_t turn[JOINT_ROWS][3]; /* change of V of each row by du, see contact_lever */
};

/* The law of the last row; velocities and impulses in the solver's units. */
struct joint_law {
    bool lower, upper, motor, spring;
    int32_t low_v, high_v; /* least and most V that the limits ask for */
    int32_t motor_v;
    int32_t spring_v; /* V at which the spring has no impulse */
    int32_t soft_q30; /* the spring's impulse over the one that leads to spring_v */
    int64_t push;     /* whatever V: the second half of an earlier pull, and a short pull */
    int64_t most;     /* of the motor's impulse */
};

/* A row of the factors for all held rows of an island; its numbers begin at `start` in the room. */
struct joint_row {
    uint32_t start;
    uint16_t first;            /* first row that it is coupled to */
    struct fix_scaled inverse; /* of its diagonal entry; 0: the row has no impulse of its own */
    int64_t x;                 /* the solution; before it, y of the row that is factored */
};

/* Room for factors, numbers for each joint of the capacity. */
#define JOINT_ROOM 128

/* A joint in a solve. */
struct joint_work {
    struct joint_lever lever[2];
    const struct body *led;      /* b, if it is a kinematic body on its route; else NULL */
    const struct body *lightest; /* of the island's bodies that answer; its mass is the unit */
    uint8_t rows, held;          /* number of rows; of held ones: all, or all but the last */
    uint8_t angular;             /* a bit for each row */
    uint16_t row_at;             /* place of its first row among the island's */
    bool idle;                   /* solved already, or not to be solved now */
    bool by_speed;               /* the slice is too short to measure positions: use V itself */
    bool torn;                   /* apart by some skins at the end of the slice */
    bool stops;                  /* the limits ask for V of 0 at least or at most */
    bool halved;                 /* a spring gives half of its impulse now, and half afterwards */
    int8_t down, length_bits;
    int8_t inverse_bits;                     /* fractional bits of the inverse */
    int32_t direction[JOINT_ROWS][3];        /* q30 */
    int32_t inverse[JOINT_ROWS][JOINT_ROWS]; /* of K */
    int32_t ratio_q28[JOINT_ROWS];           /* column of the last row over its diagonal entry */
    struct joint_law law;
    /* before the solve: required change of V on the present paths; if by_speed, less V itself */
    int64_t wanted_q40[JOINT_ROWS];
    int64_t change_q40[JOINT_ROWS]; /* the required change of V */
    int64_t speed_q40[JOINT_ROWS];  /* V before the solve */
    /*
     * changes of V of the last row that the limits ask for (low, high); the largest impulse of the
     * motor, or at the end of a frame of what holds at a limit (most); a bound on these changes and
     * the motor's velocity (least)
     */
    int64_t low_q40, high_q40, most_q40, least_q40;
    /*
     * a spring: by how much it is off its rest, and the rate of that on the present paths; a solve
     * lets it pull for a part of the frame that begins `ahead` from now. The step measures these for
     * the whole slice, and joint_prepare_spring shortens them
     */
    int64_t off_q40, rate_q40;
    int32_t ahead_q30, pull_q30;
    int64_t second_q40, push_q40; /* the other half; the one that this solve gives */
    /* the time up to which its pull is in the velocities; the longest pull, by its stiffness */
    int32_t pulled_q30, pull_most_q30;
    /* the last pull: its impulse and its time, and how much of that a later round takes back */
    int64_t given_q40;
    int32_t given_q30, back_q30;
    int64_t spring_q40, stiff_q40; /* its change of V, and its impulse by V */
    /* its impulse without damping: -elastic - half_stiff (V' - V) */
    int64_t elastic_q40, half_stiff_q40;
    /* in the sweeps */
    int32_t before[JOINT_ROWS]; /* V - wanted V; V of the last row */
    int32_t gain[JOINT_ROWS], way[JOINT_ROWS];
    int64_t impulse[JOINT_ROWS];
    /* after them: totals on a */
    carom_v3_q40 push, moment;
    int64_t row_q40[JOINT_ROWS];
    /* twice the energy that limits and damping gave in the frame; negative: took */
    struct fix_wide given2;
};

static inline bool joint_is_angular(const struct joint_work *work, int row)
{
    return (work->angular >> row & 1) != 0;
}

/* The part of a joint that a step changes; there are two, and all of it is hashed and saved. */
struct joint_state {
    struct carom_joint_drive drive;
    int64_t impulse_q40[JOINT_ROWS]; /* of the last frame, along the rows */
    carom_v3_q40 push, moment;       /* the sum of the last frame, on a */
    int64_t axial_q40;
    /* twice the excess energy that the joint's group owes, q80; kept at one joint of a group */
    struct fix_wide owed2;
    uint8_t broken;
};

struct joint {
    bool used;
    uint8_t kind;
    bool touch;
    uint16_t a, b; /* b may be JOINT_WORLD */
    /* the anchors from the centres of mass, in the meshes' axes; JOINT_WORLD's in world axes */
    carom_v3_q40 arm[2];
    carom_quat_q30 frame[2]; /* the joint's axes in each body's axes; z is the axis */
    int64_t most_impulse_q40;
    bool chosen; /* by step: to be solved, if it holds */

    uint16_t next; /* 1 + the next joint of the island at hand; 0 ends */
    struct joint_work work;
};

/* The purpose of a solve. */
enum joint_solve {
    JOINT_FRAME,    /* start of a frame: motors and springs act, too */
    JOINT_MORE,     /* again, for what paths bend by */
    JOINT_HIT,      /* at a hit or a slice's end within the frame: springs act */
    JOINT_HIT_MORE, /* again */
    JOINT_PROJECT   /* end of the frame: velocities alone */
};

struct joint_calls;

/* The joints of a world. */
struct joint_list {
    const struct joint_calls *calls; /* NULL until a joint is added */
    enum joint_solve solve;
    struct joint *joints;
    struct joint_state *states; /* of the step at hand */
    uint32_t count;
    uint16_t first; /* 1 + the first joint of the island at hand; 0: none */
    bool factored;  /* the island's factors are in the room */
    struct joint_row *rows;
    int32_t *room;
    uint32_t room_size;
};

inline bool joint_holds(const struct joint_list *list, uint32_t i)
{
    return list->joints[i].used && !list->states[i].broken;
}

/* The pose of a body as a joint sees it; the world is at 0 and not turned. */
struct joint_pose {
    carom_v3_q32 position;
    carom_quat_q30 rotation;
};

/* The error of a joint by row, and its coordinate, if it has one. */
struct joint_error {
    int64_t row_q40[JOINT_ROWS]; /* units or radians */
    int64_t coordinate_q40;
};

/* True if a kind has a coordinate; true if a motor, spring or limit drives it. */
bool joint_has_coordinate(uint8_t kind);
bool joint_is_driven(const struct joint *j, const struct joint_state *s);

/* a b in q40, clamped to +-2^60. */
int64_t joint_product_q40(int64_t a_q40, int64_t b_q40);

/* The difference of two angles of a hinge, within half a turn. */
int64_t joint_turned_q40(int64_t from_q40, int64_t to_q40);

void joint_measure(const struct joint *j, const struct joint_pose pose[2], struct joint_error *out);

/* Set the directions of the rows, and the arms to the joint's point or anchors. */
void joint_set_rows(struct joint *j, const struct joint_state *s, const struct joint_pose pose[2]);

/* The anchor on a body, in world axes. */
carom_v3_q32 joint_anchor(const struct joint *j, int side, const struct joint_pose *pose);
carom_v3_q30 joint_axis(const struct joint *j, const struct joint_pose *pose_b);

#endif

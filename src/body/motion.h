/* SPDX-License-Identifier: MIT */
/*
 * motion - how a body moves: its path over a slice of a frame, the region that candidates are
 * gathered for, a part of a region, and where the caller leads a kinematic body. body.h has the
 * functions.
 *
 * A slice runs over a common t in [0, 1]. With u the Cayley vector of the whole slice,
 *
 *   x(t) = x + v t + g t^2
 *   R(t) = R Cayley(t u), Cayley(u) = the quaternion (1, u) normalised
 *
 * A part of a path is a path again: with its own t in [0, 1] the quaternion is (1 + c t, u t),
 * whose norm is N(t) = (1 + c t)^2 + |u|^2 t^2. c is 0 for a path that body_predict makes.
 */
#ifndef CAROM_SRC_BODY_MOTION_H
#define CAROM_SRC_BODY_MOTION_H

#include "../num/phase.h"
#include "carom_fix.h"

/* Holders of a path's shared memory. BODY_ORIGIN: only the path's origin. */
enum body_path_phase { BODY_NO_PATH, BODY_PATH, BODY_SOLVE, BODY_ORIGIN };

struct body_path {
    union { /* by PHASE_TAG phase; body_path, body_solve */
        struct {
            int64_t origin_q22[3];
            carom_v3_q40 v, g; /* displacement over the slice: linear and quadratic in t */
            carom_quat_q30 q;  /* rotation at the start */
            carom_v3_q30 u;    /* Cayley vector, in the body's axes */
            int32_t u2_q30;    /* |u|^2 */
        };
        /* a solve's; after it the body has no path until one is set */
        struct {
            carom_v3_q40 saved_angular; /* before the solve, for the energy rule */
            /* changes of velocities in solver units: v by dv, the spin by R H du */
            union {
                struct {
                    int32_t dv[3], du[3];
                    int32_t last_dv[3], last_du[3]; /* after the last sweep but one */
                };
                struct {
                    int64_t wide_dv[3], wide_du[3]; /* while a solve's first impulses are summed */
                };
            };
            uint32_t used;         /* bits in use by dv and du */
            int32_t columns[3][3]; /* of R H, see carom_spread */
        };
    };
    struct {
        carom_m3_q30 r;
    } start;
    int16_t start_x_q32[3]; /* position less origin */
    bool turns;
    PHASE_TAG(phase)
    int32_t c_q30; /* c of a part of a path, see above: 0 .. |u|^2 */
};

/* c^2 + |u|^2, the last coefficient of N(t). */
static inline int32_t body_norm2_q30(const struct body_path *path)
{
    return path->c_q30 == 0 ? path->u2_q30 : path->u2_q30 + carom_mul_q30(path->c_q30, path->c_q30);
}

/*
 * The motion that candidates are gathered for: along a path, and near it. Every point of the body
 * must be within `room` of its place on that path at the same time.
 */
struct body_region {
    carom_v3_q32 at;        /* with q: the pose at the start */
    carom_v3_q40 way, bend; /* of the centre over the region's time: way t + bend t^2 */
    carom_quat_q30 q;
    carom_v3_q30 u;     /* Cayley vector of the region's turn, in the body's axes, if it turns */
    carom_v3_q30 turn;  /* 2 u, in world axes */
    int32_t u_q30;      /* |u|, rounded up */
    int32_t length_q22; /* of the centre's path, rounded up */
    int32_t room_q22;
    /* progress */
    int32_t turned_off_q30; /* bound on the angle between the body and the region's path */
    int64_t elapsed_q30;    /* time at which the present path starts */
    /* length in frames, at most BODY_REGION_FRAMES */
    int64_t time_q30;
    int64_t until_q30; /* end of the part that candidates are gathered for */
};

/* A part of a region's time: its start and end, and bounds of the motion between. */
struct body_sweep {
    carom_v3_q32 at;              /* the centre at the start */
    carom_v3_q40 way;             /* displacement of the centre */
    carom_m3_q30 start, end;      /* axes at both ends */
    int32_t length_q22, bend_q22; /* of the centre's path, rounded up */
    int32_t u_q30, whole_u_q30;   /* |u| of the part; of the region; rounded up */
};

/*
 * Where the caller leads a kinematic body: nowhere, on until told otherwise, or to a pose within a
 * frame.
 */
enum body_drive_kind { BODY_DRIVE_NONE, BODY_DRIVE_ON, BODY_DRIVE_TO };

struct body_drive {
    uint8_t kind;
    union {
        struct {
            carom_v3_q40 velocity, spin;
        };
        struct {
            carom_v3_q32 position;
            carom_quat_q30 rotation;
        };
    };
};

/*
 * The motion of a kinematic body over a frame: 2^slice_bits equal slices of one straight way and
 * one turn.
 */
struct body_route {
    carom_v3_q40 velocity, spin; /* units and radians a frame, world axes */
    carom_v3_q30 u;              /* Cayley vector of a slice, in the body's axes; |u| <= 1/8 */
    uint8_t slice_bits;
};

#endif

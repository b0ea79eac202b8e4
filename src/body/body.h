/* SPDX-License-Identifier: MIT */
/*
 * body - poses, momenta and the motion of one body over a slice of a frame: an exact parabola of
 * the centre of mass together with a Cayley rotation about it (in place of the paper's translation
 * followed by a rotation).
 *
 * In: a body's definition, state, acceleration. Out: its path over a slice, the region that
 * candidates are gathered for, the state at the path's end.
 *
 * Files: body.c mass, velocity, energy; spin.c spins that fit; path.c paths; region.c regions;
 * route.c routes of kinematic bodies.
 *
 * motion.h says what a path is.
 *
 * There are two frames of reference. World coordinates are int64. Everything near a body is int32
 * relative to the body's origin: its position at the start of the slice, rounded to q22.
 */
#ifndef CAROM_SRC_BODY_H
#define CAROM_SRC_BODY_H

#include "../mesh/mesh.h"
#include "carom_body.h"
#include "../num/tuning.h"
#include "motion.h"

#define BODY_WORLD_LIMIT    4096       /* units: a body whose centre leaves +-this is frozen */
#define BODY_SPEED_LIMIT    64         /* units a frame, of any point of a body; radians a frame */
#define BODY_SPIN_BITS      15         /* a body that turns by 2^15 radians a frame is frozen */
#define BODY_RADIUS_MAX_Q22 (32 << 22) /* for moving bodies */
#define BODY_RADIUS_MIN_Q22 (1 << 10)  /* a few skins */
#define BODY_ALONE          0

/* The part of a body that a step changes: all of it is hashed and saved. */
struct body_state {
    carom_v3_q32 position;
    carom_v3_q40 momentum; /* m v */
    carom_v3_q40 angular;  /* I w about the centre of mass, world axes */
    carom_quat_q30 rotation;
    uint8_t asleep, out;
    uint8_t quiet; /* frames in a row in which the body was slow in contact */
    uint8_t woken; /* woken since the last step */
};

/* Properties that few bodies have, from the pool of extras. */
struct body_extra {
    uint16_t body; /* the body that has it */
    bool used;
    /* material, beside e and mu, which all bodies have */
    uint32_t rolling_q16;          /* arm of rolling friction over the radius */
    carom_v3_q40 surface_velocity; /* in the mesh's axes */
    const struct carom_material
        /* the caller's materials by face; NULL: all faces have the body's */
        *materials;
    const uint8_t *face_material; /* number of each face's material */
    int32_t most_restitution_q30; /* the largest of these materials' */
    uint32_t most_friction_q16;
    /* what acts on it beside its force; hashed and saved */
    carom_v3_q40 torque;
    int32_t gravity_scale_q16;
    int32_t linear_damping_q30, angular_damping_q30;
    /* a kinematic body */
    bool kinematic;
    bool blocked;            /* by step: it stopped within this frame */
    struct body_drive drive; /* saved */
    struct body_route route; /* by step: of this frame; standing still once blocked */
};

/* Values for a body without an extra; all else is 0. */
#define BODY_ROLLING_Q16       CAROM_ROLLING_Q16 /* 1/64 of the radius, see solve/roll.c */
#define BODY_GRAVITY_SCALE_Q16 (1 << 16)

/*
 * A body has five parts, one for each lifetime, and a link to its island: 600 bytes where a pointer
 * has 32 bits.
 *
 *   def     what the caller set, and what follows; world writes it, a step only reads it
 *   clock   the present frame: the part of it that the path takes, and the body's course in it
 *   path    the motion over that part; and the room of a solve while there is no path
 *   search  what pairs and candidates are gathered for; outlives steps, but no result depends on it
 *   solve   what a solve works in
 *
 * tools/check_writers has the folders that may write each part.
 *
 * Flags that are read most have bytes of their own.
 */

/* The definition. World writes it between steps; valid until the body is removed. */
struct body_def {
    const struct carom_mesh *mesh; /* NULL: the place is free */
    struct body_extra *extra;      /* NULL: none */
    void *user;                    /* the caller's */
    uint16_t generation;           /* counts the bodies that had this place, from 1; 0: none has */
    uint16_t category, mask;       /* filter: which bodies it may touch */
    int16_t group;
    uint16_t joined; /* 1 + the lowest body that joints connect it with; BODY_ALONE: none */
    bool moving;
    bool goes;        /* has paths: it moves, or is kinematic and led somewhere */
    int8_t unit_bits; /* the solver's unit of length, 2^unit_bits of q22, at least the radius */
    bool sensor : 1;
    uint8_t one_way : 3; /* enum carom_one_way */
    int32_t restitution_q30;
    uint32_t friction_q16;
    int32_t radius_q22;
    int32_t skin_q22; /* EPS: a resting contact keeps half of this gap */
    /* follows from mesh, mass and force */
    uint64_t calm_momentum_q40, calm_angular_q40; /* see body_calm */
    struct fix_scaled mass, inverse_mass;
    carom_v3_q40 acceleration; /* by gravity and force */
    int64_t acceleration_q40;  /* its length */
    carom_v3_q40 force;        /* through the centre of mass, until changed; hashed and saved */
};

/*
 * The way in which a body takes the frame's gravity: along its path; or, once it lies on others,
 * all at once, and then its path is straight. BODY_ENTERS: since the last rest_enter_contact.
 */
enum body_contact { BODY_FLIES, BODY_ENTERS, BODY_LIES };

/*
 * The present frame. The step writes it, except `contact`, which solve writes, too; valid from
 * begin_clock until the next frame.
 */
struct body_clock {
    int32_t from_q30, to_q30; /* part of the frame that the present path takes */
    uint16_t events;          /* hits that it took part in */
    uint8_t cuts;             /* how often the present path was set again for an earlier end */
    uint8_t shorter; /* slices are shorter by this many factors of 4; one less after each slice */
    uint8_t contact; /* enum body_contact */
    bool stands;     /* stands for the rest of the frame */
    bool placed;     /* its path is only that of a place where it is looked at */
    bool strained;   /* left a turning path before its end */
    /* of the event at hand */
    bool member;   /* its path is new; or it belongs to the island of the hit */
    bool woke : 1; /* woken by the static check */
    /* for the energy rule */
    bool touched;      /* was in contact in the last frame; at the end: its island may not gain */
    bool grounded : 1; /* touches a body that stands still; an island's lowest: any of it does */
    bool rewound : 1;  /* was put back to where the frame found it */
    bool pressed : 1;  /* a contact pressed it when the frame began */
};

/* The motion that a body's region was set for. */
enum body_region_state {
    BODY_REGION_NONE,
    BODY_REGION_STANDING, /* at rest, with path, region and box those of its place */
    BODY_REGION_MOVING,   /* a motion */
    BODY_REGION_FREE      /* a motion, and the body had no candidates then */
};

/*
 * The region that pairs and candidates are gathered for. Regions (step) and broad write it; valid
 * until the body is given another state.
 */
struct body_search {
    struct body_region region;
    int32_t reach_q22;     /* bound on any point's displacement in the region, plus the margin */
    int32_t box_q18[2][3]; /* in world axes, around the region, grown by the reach */
    uint8_t state;         /* enum body_region_state */
    bool boxed;            /* the box is around the mesh's box; else around the sphere */
};

/* Forces and filters that a snapshot brings. They wait here until the whole snapshot is read. */
struct body_loaded {
    struct carom_forces forces;
    struct carom_filter filter;
};

/* Holders of the shared memory of a body's solve: a step, world/moving.c, a snapshot. */
enum body_work_phase { BODY_WORK, BODY_LIFT, BODY_LOADED };

/*
 * A solve. Solve writes it; valid from rest_load_contacts until the solve ends, `work` until the
 * step ends.
 */
struct body_solve {
    union { /* by PHASE_TAG work_phase */
        struct {
            carom_v3_q40 saved_momentum; /* before the solve, for the energy rule */
            carom_v3_q40 velocity, spin; /* before the solve */
        };
        struct body_loaded loaded; /* carom_snapshot_load writes it, between steps */
    };
    union {                    /* by PHASE_TAG work_phase */
        struct fix_wide work2; /* twice the work of surfaces on it in this step, q80 */
        int64_t
            lift_q32; /* between steps, in world/moving.c: lift of the island, at its lowest body */
    };
    uint16_t contacts; /* first of the island's contacts in the list */
    bool solving;      /* has a contact or a joint in the solve at hand */
    bool unsettled;    /* its island's last solve left places that approach */
    int8_t turn_bits;  /* no place of a present contact moves by 2^(turn_bits - 1) du */
    PHASE_TAG(work_phase)
};

/* The island of a body. island_* write it; valid until islands are found anew. */
struct body_island {
    uint16_t lowest, next; /* the island's lowest body; its next higher one */
};

struct body {
    struct body_def def;
    struct body_clock clock;
    struct body_island island;
    struct body_path path;
    struct body_search search;
    struct body_solve solve;
};

/* True if a kinematic body is led somewhere. */
static inline bool body_travels(const struct body *b)
{
    return b->def.goes && !b->def.moving;
}

/* True if the body has a region that was set for a motion. */
static inline bool body_region_moves(const struct body *b)
{
    return b->search.state >= BODY_REGION_MOVING;
}

/* Forget what only makes steps faster. */
static inline void body_forget(struct body *b)
{
    b->search.state = BODY_REGION_NONE;
    b->search.boxed = false;
    b->clock.contact = BODY_FLIES;
}

/* The path, region and box of a body that stands still must be set again. */
static inline void body_not_standing(struct body *b)
{
    if (b->search.state == BODY_REGION_STANDING) {
        b->search.state = BODY_REGION_NONE;
    }
}

/* The path of a body that has one. `start`, `start_x_q32` and `turns` may be read at any time. */
static inline const struct body_path *body_path(const struct body *b)
{
    PHASE_ASSERT(b->path.phase, BODY_PATH);
    return &b->path;
}

/* The origin of a path; it is there after a solve, too. */
static inline const int64_t *body_origin_q22(const struct body *b)
{
    CAROM_ASSERT(b->path.phase == BODY_PATH || b->path.phase == BODY_ORIGIN);
    return b->path.origin_q22;
}

/* The room of a solve in a body: to write; to read. */
static inline struct body_path *body_solve(struct body *b)
{
    PHASE_ASSERT(b->path.phase, BODY_SOLVE);
    return &b->path;
}

static inline const struct body_path *body_solved(const struct body *b)
{
    PHASE_ASSERT(b->path.phase, BODY_SOLVE);
    return &b->path;
}

/*
 * Twice the work of moving surfaces on a body in a step: to write, to read. The lift of its island
 * between steps.
 */
static inline struct fix_wide *body_work2(struct body *b)
{
    PHASE_ASSERT(b->solve.work_phase, BODY_WORK);
    return &b->solve.work2;
}

static inline const struct fix_wide *body_worked2(const struct body *b)
{
    PHASE_ASSERT(b->solve.work_phase, BODY_WORK);
    return &b->solve.work2;
}

static inline int64_t *body_lift_q32(struct body *b)
{
    PHASE_ASSERT(b->solve.work_phase, BODY_LIFT);
    return &b->solve.lift_q32;
}

static inline struct body_loaded *body_loaded(struct body *b)
{
    PHASE_ASSERT(b->solve.work_phase, BODY_LOADED);
    return &b->solve.loaded;
}

/* Set mass and its inverse, mass > 0, and what follows from them and the inverse inertia. */
void body_set_mass(struct body *b, struct fix_scaled mass);

/*
 * v = p / m, w = R J^-1 R^T L / m with r the rotation matrix. A spin that does not fit becomes the
 * largest one, along L; such a body is frozen before it moves on.
 */
void body_velocity(const struct body *b, const struct body_state *s, carom_v3_q40 *v);
void body_spin(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
               carom_v3_q40 *spin);
/* R^T L / m: the angular momentum in the body's axes, divided by the mass. */
void body_angular(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
                  int64_t out[3]);
/*
 * True if L / m is below 2^20 and each component of the spin, in mesh axes, below 2^BODY_SPIN_BITS.
 * (About the axis of a thin body a small angular momentum is a spin that no format holds.)
 */
bool body_spin_fits(const struct body *b, const struct body_state *s, const carom_m3_q30 *r);
/* The largest spin, along L. */
void body_spin_most(const struct body_state *s, carom_v3_q40 *spin);
/* Set the momenta that give v and w. */
void body_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                     const carom_v3_q40 *spin);
/* Add p.v + L.w, twice the kinetic energy, 80 fractional bits. */
void body_add_kinetic2(struct fix_wide *sum, const struct body *b, const struct body_state *s,
                       const carom_m3_q30 *r);
/* The same with the axes worked out from the state. */
void body_add_kinetic2_of(struct fix_wide *sum, const struct body *b, const struct body_state *s);

/* An upper bound of that, computed faster: for bodies that hardly move. */
void body_add_kinetic2_most(struct fix_wide *sum, const struct body *b, const struct body_state *s);

/*
 * Add sign times a bound on what closing an overlap of skins adds to twice the kinetic energy in a
 * frame: 0.3 m |g| skin. A body lifted by a part of its skin gains that much; a larger gain is not
 * lifting.
 */
void body_add_lift2(struct fix_wide *sum, const struct body *b, int sign);

/* out = m v for a symmetric m within 2^30; |v| < 2^62; out may be v. */
void body_sym3_mul(int64_t out[3], const struct carom_sym3 *m, const int64_t v[3]);

/* R J R^T: inertia by mass in world axes. */
void body_world_inertia(const struct body *b, const carom_m3_q30 *r, struct carom_sym3 *out);

/* Three Newton steps towards length 1: to the last place for any |q| in 0.95 .. 1.05. */
void body_normalise(carom_quat_q30 *q);

/* Set where a path at the body's pose begins, and leave the rest of the path. */
void body_place_origin(struct body *b, const struct body_state *s);
/* Set a path without motion at the body's pose. */
void body_place(struct body *b, const struct body_state *s);
/*
 * Set the path over tau_q30 of a frame, 0 < tau <= 1, at a turn of at most BODY_TURN_MAX_Q30.
 * gravity: units / frame^2, or NULL for a straight path.
 */
void body_predict(struct body *b, const struct body_state *s, int32_t tau_q30,
                  const carom_v3_q40 *gravity);
/*
 * Replace the path that body_predict set by its part from `from` to `to` in [0, 1]; s is the pose
 * at its start. body_predict sets the whole again.
 */
void body_cut_path(struct body *b, const struct body_state *s, int32_t from_q30, int32_t to_q30);
/*
 * Set the route of a kinematic body: to another pose in a frame, by the shorter turn; or with a
 * velocity and a spin of at most 3.2 radians a frame. The centre goes less than 2^7 units.
 */
typedef void body_route_maker(const struct body *b, const struct body_state *s,
                              const carom_v3_q32 *position, const carom_quat_q30 *rotation,
                              struct body_route *route);
extern body_route_maker body_route_to;
void body_route_on(const struct body *b, const struct body_state *s, const carom_v3_q40 *velocity,
                   const carom_v3_q40 *spin, struct body_route *route);
/* Set the path of the next slice of a body's route. */
void body_follow(struct body *b, const struct body_state *s);
/* The velocity of a place of a body on its route; `arm` from its centre, world axes. */
void body_route_velocity(const struct body *b, const carom_v3_q40 *arm, carom_v3_q40 *v);

/*
 * True if a body's momenta are so small that it is slower than the limit and turns by less than
 * BODY_TURN_MAX_Q30 in a frame. Quick, and true of nearly all bodies.
 */
static inline bool body_calm(const struct body *b, const struct body_state *s)
{
    return fix_sum(s->momentum.c) < b->def.calm_momentum_q40 &&
           fix_sum(s->angular.c) < b->def.calm_angular_q40;
}
/* The longest slice, at most tau_q30, that turns by BODY_TURN_MAX_Q30 at the present spin. */
int32_t body_slice(const struct body *b, const struct body_state *s, int32_t tau_q30);

/* Displacement of the centre, and rotation, at t of the path. */
carom_v3_q32 body_way_at(const struct body *b, int32_t t_q30);
carom_quat_q30 body_rotation_at(const struct body *b, int32_t t_q30);
/* out = q (1, u), normalised: q turned by Cayley(u) in the body's axes, |u| <= 0.31. */
void body_turn(carom_quat_q30 *out, const carom_quat_q30 *q, const int32_t u[3]);
/* The axes of a rotation turned on by a Cayley vector in them, |u| <= 0.31. */
void body_turned(const carom_quat_q30 *q, const carom_v3_q30 *u, carom_m3_q30 *r);
/* Make the pose at t the new state, with the momentum that gravity gave until then. */
void body_advance(const struct body *b, struct body_state *s, int32_t t_q30, int32_t tau_q30,
                  const carom_v3_q40 *gravity);

/* Add the momentum that the body's acceleration gives it in a part of a frame. */
void body_accelerate(const struct body *b, struct body_state *s, int32_t tau_q30);

/* Bounds on the displacement of any point, and on the turn, from 0 to t of the path. */
void body_path_length(const struct body *b, int32_t t_q30, int64_t *way_q22, int64_t *turn_q30);

/*
 * Make the region: the path, which takes slice_q30 of a frame, continued until time_q30; sets
 * reach_q22, too. Other motions of the body must stay within room_q22 of it. If time is longer than
 * the slice |u| time / slice must be at most BODY_TURN_MAX_Q30 / 2.
 */
void body_region_begin(struct body *b, const struct body_state *s, int32_t slice_q30,
                       int64_t time_q30, int32_t room_q22);
/*
 * Bound on the angle between the body and the region's own turn, radians; both together count as 1
 * at most.
 */
int32_t body_region_turn_off_q30(const struct body *b);
/*
 * Set the sweep of the part of a region that begins at `from` and takes `time`, both in frames
 * within its time.
 */
void body_region_sweep(const struct body_region *region, int64_t from_q30, int64_t time_q30,
                       struct body_sweep *sweep);
/* Set the sweep of the present path, which may be a part of a path. */
void body_path_sweep(const struct body *b, struct body_sweep *sweep);
/* True if the present path, which takes time_q30, stays within the region. */
bool body_region_holds(const struct body *b, int32_t time_q30);
/* Advance the region by a part of the present path, which takes time_q30. */
void body_region_advance(struct body *b, int32_t part_q30, int32_t time_q30);

#endif

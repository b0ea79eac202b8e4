/* SPDX-License-Identifier: MIT */
/*
 * crowd - the base of scenes with many bodies: a world with any number of them, watched in double
 * precision through the public interface, as lab.h watches one body. Host only.
 *
 *   struct crowd *crowd = crowd_new();
 *   int box = crowd_box(crowd, 1, 1, 1);
 *   crowd_body(crowd, box)->position.c[2] = ...
 *   crowd_start(crowd);
 *   crowd_step(crowd, &tally);                   frame by frame
 *   crowd_free(crowd);
 *
 * Energy and momentum are watched by islands: bodies that touched in the frame, directly or
 * through other moving bodies. Each island is judged alone, so that a loss in one cannot hide a
 * gain in another.
 */
#ifndef CAROM_TESTS_CROWD_H
#define CAROM_TESTS_CROWD_H

#include "lab.h"

#define CROWD_MESHES 36
#define CROWD_BODIES 40

struct crowd_mesh {
    struct carom_mesh mesh;
    struct oracle_mesh solid;
    struct oracle_body weight; /* mass and inertia at density 1 */
    double radius, skin;       /* units */
    int16_t (*vertices)[3];    /* NULL: the caller's arrays */
    void *block;
};

/* A body as it was after a frame. */
struct crowd_seen {
    struct carom_body_state state;
    struct oracle_body body;
    double kinetic, potential, momentum[3], angular[3]; /* angular: about the world's origin */
    double sway;                                        /* length of w x L, L about its centre */
    double low[3], high[3];                             /* its box */
};

struct crowd_body {
    struct carom_body_def def;
    int mesh;
    double mass;
    struct crowd_seen before, now;
    int island;    /* the lowest body of its island in the last frame */
    bool touching; /* it touched anything in that frame */
    bool grounded; /* it touched something stationary */
    bool driven;   /* it touched something that does work: a kinematic body, a belt, a link */
    bool linked;   /* it has a link */
    bool drives;   /* it does work on bodies that touch it, but is no kinematic body */
};

/* A joint: connects a body with another one, or with the world (b is -1), without contact. */
struct crowd_link {
    int a, b;
    bool there, works; /* works: a motor, which does work */
    double stored[2];  /* energy that a spring holds, before the frame and after it */
    double noise[2];   /* what rounding of the spring's ends may add to each, or take from it */
};

/*
 * Joints give back later the energy that they cannot keep in a frame. So the bodies that links
 * connect are watched as a group: by the energy that they gain over all frames in which nothing
 * touches or drives them.
 */
struct crowd_group {
    double gained,
        most; /* energy gained so far; the most kinetic and spring energy that the group had */
};

/* The faults that are looked for between two bodies. */
enum crowd_pass {
    CROWD_MEET,      /* crossings */
    CROWD_PASS_ONCE, /* none until they are apart */
    CROWD_PASS       /* none */
};

/* The side of a surface that a body's first corner is on. */
enum crowd_where { CROWD_OVER, CROWD_UNDER, CROWD_BESIDE };

struct crowd {
    struct carom_config config;
    struct carom_world *world;
    void *block;
    struct crowd_mesh meshes[CROWD_MESHES];
    int mesh_count;
    struct crowd_body bodies[CROWD_BODIES];
    int body_count;
    bool touching[CROWD_BODIES][CROWD_BODIES]; /* pairs that began to touch and have not ended */
    uint8_t where[CROWD_BODIES]; /* enum crowd_where: which side of the surfaces a body is on */
    bool beside[CROWD_BODIES];   /* bodies that were once beside a surface */
    double substeps;             /* sub-steps of the last frame */
    long look_every; /* frames from one check of crossings to the next; 0: every frame */
    uint8_t pass[CROWD_BODIES][CROWD_BODIES]; /* enum crowd_pass; set by crowd_let_pass */
    struct crowd_link *links;                 /* the caller's; the caller notes the energy that they
                                               * hold */
    int link_count;
    struct crowd_group groups[CROWD_BODIES]; /* indexed by the lowest body */
    int group_of[CROWD_BODIES];
};

/* An empty crowd: gravity of 9.81 units / s^2 at 60 frames, sleep on. */
struct crowd *crowd_new(void);
void crowd_free(struct crowd *crowd);

/*
 * Add a mesh; returns its number. A solid of lab.h, scaled; a box with three sides; a ball of 96
 * faces with a flat facet at each end of the x axis; any mesh, whose arrays stay the caller's.
 */
int crowd_solid(struct crowd *crowd, const struct carom_mesh_raw *raw, const double scale[3]);
int crowd_box(struct crowd *crowd, double x, double y, double z);
int crowd_ball(struct crowd *crowd, double radius);
int crowd_mesh(struct crowd *crowd, const struct carom_mesh_raw *raw);

/* Add a body at the origin, with e = mu = 1/2 and density 1; a SURFACE is stationary. */
struct carom_body_def *crowd_body(struct crowd *crowd, int mesh);
/* Remove all bodies; the meshes stay. */
void crowd_clear(struct crowd *crowd);
void crowd_place(struct carom_body_def *def, double x, double y, double z);
/* Set e and mu of all bodies. */
void crowd_surface(struct crowd *crowd, double e, double mu);
/* Set all vectors of a definition from doubles. */
void crowd_move(struct carom_body_def *def, const double velocity[3], const double spin[3]);

/* ---------------------------------------------------------------------- meetings */

/* A corner of one on a face of the other, an edge across an edge, a face flat on a face. */
enum crowd_how { CROWD_CORNER, CROWD_EDGE, CROWD_FLAT, CROWD_HOWS };

/*
 * Turn and place body a so that it is about to meet b; b stays as it is.
 *   gap     between the two features along N
 *   slant   a will move along -N + slant times a tangent, at random
 *   normal  out  N, from b into a
 *   along   out  -N + slant tangent: the direction of a's velocity relative to b's
 *   point   out  the meeting point, if b does not move
 * Returns false when no such place was found in a few thousand tries.
 */
bool crowd_meet(struct crowd *crowd, int a, int b, enum crowd_how how, double gap, double slant,
                uint64_t *random, double normal[3], double along[3], double point[3]);

/* -------------------------------------------------------------------------- runs */

/*
 * Make the world anew from the bodies. Returns CAROM_OK, or the error with which a body was
 * refused.
 */
int crowd_start(struct crowd *crowd);

/* The observations of crowd_step over a run. Start with {0}. */
struct crowd_tally {
    long frames, capped, hits;
    long crossed;        /* frames with faces that cross */
    long crossed_first;  /* the first of them, 0: none */
    int crossed_pair[2]; /* the bodies of the first crossing, and the faces */
    uint32_t crossed_face[2];
    double crossed_depth; /* the deepest crossing, units */
    double crossed_skins; /* depth in skins of the pair */
    /*
     * Frames with bodies wholly inside others, or with a body that got from one side of a surface
     * to the other and was not beside it; the first of these frames.
     */
    long inside, inside_first;
    int inside_pair[2]; /* the first of these bodies, and the body around each */
    long out;           /* bodies that left the range */
    long asleep, slow;  /* moving bodies that sleep now; those that sleep or are slower than the
                         * limit */
    /*
     * The largest rise of an island's energy in a frame, over the allowed rise: a fifth of m g skin
     * for each of its bodies that touches, 2^-24 of the kinetic energy, and rounding.
     */
    double rise;
    long rise_frame;
    int rise_body;
    double lift;   /* the largest rise without rounding, in m g skin of the bodies that touch */
    double gained; /* the largest gain of a group of links, over the largest energy that the group
                 * had */
    int gained_body;
    long gained_frame;
    double momentum; /* the largest relative change of an ungrounded island's momentum beyond that
                      * of gravity */
    double angular;  /* the same about the origin; without gravity only */
};

/* One frame, watched; returns the result of carom_world_step. After an error nothing is checked. */
int crowd_step(struct crowd *crowd, struct crowd_tally *tally);
/* The checks after a step; `status` is the step's result, and no error. */
void crowd_watch(struct crowd *crowd, int status, struct crowd_tally *tally);

/* Look for crossing faces and for bodies inside others, in the frames that look_every chooses. */
void crowd_watch_crossings(struct crowd *crowd, struct crowd_tally *tally);

/* Make the groups again from the present links. */
void crowd_group_links(struct crowd *crowd);

/* Choose the faults that are looked for between two bodies; at first, crossings between all. */
void crowd_let_pass(struct crowd *crowd, int a, int b, enum crowd_pass pass);

/*
 * Whether two bodies overlap in these poses, by crossing faces or one inside the other: 1 or 0; -1
 * when they are within `near` units of each other, or cross by less.
 */
int crowd_overlap(const struct crowd *crowd, int a, int b, const struct oracle_pose *pose_a,
                  const struct oracle_pose *pose_b, double near);
/* The same for their present poses. */
int crowd_overlap_now(const struct crowd *crowd, int a, int b, double near);
/* The gap between the boxes of two bodies' meshes, each turned with its body, units; below 0 if they overlap. */
double crowd_box_gap(const struct crowd *crowd, int a, int b);

/* A lower bound of the least moment of inertia by mass: the determinant over the largest two. */
double crowd_least_inertia(const double inertia[6]);
/* Read the bodies without a step; for the first frame and after carom_body_set. */
void crowd_look(struct crowd *crowd);

#endif

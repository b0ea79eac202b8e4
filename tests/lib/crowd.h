/* SPDX-License-Identifier: MIT */
/*
 * crowd - what the scenes of many bodies share: a world of any number of them, watched in double
 * precision through the public interface, as lab.h watches one. Host only.
 *
 *   struct crowd *crowd = crowd_new();
 *   int box = crowd_box(crowd, 1, 1, 1);
 *   crowd_body(crowd, box)->position.c[2] = ...
 *   crowd_start(crowd);
 *   crowd_step(crowd, &tally);                   frame by frame
 *   crowd_free(crowd);
 *
 * Energy and momentum are watched by islands: bodies that touched in the frame, directly or through
 * others that move. Each island answers for itself, so that a loss in one hides no gain in another.
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
    int16_t (*vertices)[3];    /* NULL: the caller's */
    void *block;
};

/* A body as seen after a frame. */
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
    int island;    /* the lowest body of its island, in the frame last seen */
    bool touching; /* touched anything in that frame */
    bool grounded; /* touched something stationary */
    bool driven;   /* touched something that does work: a kinematic body, a belt, a link */
    bool linked;   /* has a link */
    bool drives;   /* does work on bodies that touch it, though it is no kinematic body */
};

/* A joint: connects a body with another one, or with the world (b is -1), without contact. */
struct crowd_link {
    int a, b;
    bool there, works; /* works: a motor, which does work */
    double stored[2];  /* energy that a spring holds, before the frame and after it */
    double noise;      /* part of that energy that is rounding of the spring's ends */
};

/*
 * Joints give back later the energy that they cannot keep in a frame. So the bodies that links unite are watched as a
 * group, by the energy that they gain over all frames in which nothing touches or drives them.
 */
struct crowd_group {
    double gained,
        most; /* energy gained so far; the most kinetic and spring energy that the group had */
};

/* The faults that are looked for between two bodies. */
enum crowd_pass {
    CROWD_MEET,      /* crossings */
    CROWD_PASS_ONCE, /* none until they are seen apart */
    CROWD_PASS       /* none */
};

struct crowd {
    struct carom_config config;
    struct carom_world *world;
    void *block;
    struct crowd_mesh meshes[CROWD_MESHES];
    int mesh_count;
    struct crowd_body bodies[CROWD_BODIES];
    int body_count;
    bool touching[CROWD_BODIES][CROWD_BODIES]; /* pairs that began to touch and have not ended */
    bool beside[CROWD_BODIES];                 /* bodies that have been beside a surface */
    double substeps;                           /* of the last frame */
    long look_every; /* frames from one look for crossings to the next; 0: each */
    uint8_t pass[CROWD_BODIES][CROWD_BODIES]; /* enum crowd_pass, see crowd_let_pass */
    struct crowd_link *links;                 /* the caller's, who says what they hold */
    int link_count;
    struct crowd_group groups[CROWD_BODIES]; /* by the lowest body */
    int group_of[CROWD_BODIES];
};

/* An empty crowd: gravity of 9.81 units / s^2 at 60 frames, sleep on. */
struct crowd *crowd_new(void);
void crowd_free(struct crowd *crowd);

/*
 * Meshes; each returns its number. Solids of lab.h can be scaled; a box of three sides; a ball of
 * 96 faces with a flat facet at each end of the x axis; a mesh as it is, its arrays the caller's.
 */
int crowd_solid(struct crowd *crowd, const struct carom_mesh_raw *raw, const double scale[3]);
int crowd_box(struct crowd *crowd, double x, double y, double z);
int crowd_ball(struct crowd *crowd, double radius);
int crowd_mesh(struct crowd *crowd, const struct carom_mesh_raw *raw);

/* One more body, at the origin, of e = mu = 1/2 and density 1; a SURFACE is stationary. */
struct carom_body_def *crowd_body(struct crowd *crowd, int mesh);
/* No bodies; the meshes stay. */
void crowd_clear(struct crowd *crowd);
void crowd_place(struct carom_body_def *def, double x, double y, double z);
/* e and mu of all bodies. */
void crowd_surface(struct crowd *crowd, double e, double mu);
/* All vectors of a definition from doubles. */
void crowd_move(struct carom_body_def *def, const double velocity[3], const double spin[3]);

/* ---------------------------------------------------------------------- meetings */

/* A corner of one on a face of the other, an edge across an edge, a face flat on a face. */
enum crowd_how { CROWD_CORNER, CROWD_EDGE, CROWD_FLAT, CROWD_HOWS };

/*
 * Turn and place body a so that it is about to meet b, which stays as it is.
 *   gap     between the two features along N
 *   slant   a is going to come along -N + slant times a tangent, at random
 *   normal  out  N, from b into a
 *   along   out  -N + slant tangent: the direction of a's velocity relative to b's
 *   point   out  where they are going to meet, if b does not move
 * Returns false when no such place was found in a few thousand tries.
 */
bool crowd_meet(struct crowd *crowd, int a, int b, enum crowd_how how, double gap, double slant,
                uint64_t *random, double normal[3], double along[3], double point[3]);

/* -------------------------------------------------------------------------- runs */

/* Make the world anew from the bodies. Returns CAROM_OK, or what a body was refused with. */
int crowd_start(struct crowd *crowd);

/* The observations of crowd_step over a run. Start with {0}. */
struct crowd_tally {
    long frames, capped, hits;
    long crossed;        /* frames with faces that cross */
    long crossed_first;  /* the first of them, 0: none */
    int crossed_pair[2]; /* its bodies, and the faces */
    uint32_t crossed_face[2];
    double crossed_depth; /* the deepest, units */
    double crossed_skins; /* depth in skins of the pair */
    /*
     * Bodies seen wholly inside others, frame by frame, or with a corner under a surface beside which
     * they have never been.
     */
    long inside, inside_first;
    int inside_pair[2]; /* the first such bodies, and the body around each */
    long out;           /* bodies that left the range */
    long asleep, slow;  /* moving bodies that sleep, that sleep or are slower than the limit, now */
    /*
     * The largest rise of an island's energy in a frame, by what is allowed: a fifth of m g skin
     * for each of its bodies that touches, 2^-24 of the kinetic energy, and rounding.
     */
    double rise;
    long rise_frame;
    int rise_body;
    double lift; /* the largest rise, rounding apart, in m g skin of the bodies that touch */
    double
        gained; /* the most that a group of links gained, of the most that moved in it or was held */
    int gained_body;
    long gained_frame;
    double momentum; /* the largest change of an ungrounded island's but by gravity, relative */
    double angular;  /* the same about the origin; without gravity only */
};

/* One frame, watched; returns what carom_world_step did. After an error nothing is seen. */
int crowd_step(struct crowd *crowd, struct crowd_tally *tally);
/* The part of it that follows a step: status is what that returned, not an error. */
void crowd_watch(struct crowd *crowd, int status, struct crowd_tally *tally);

/* Look for faces that cross and for bodies inside others, when it is time to. Once a frame. */
void crowd_watch_crossings(struct crowd *crowd, struct crowd_tally *tally);

/* Set groups anew by the links that are there. */
void crowd_group_links(struct crowd *crowd);

/* Say what is to be looked for between two bodies; at first crossings, between all. */
void crowd_let_pass(struct crowd *crowd, int a, int b, enum crowd_pass pass);

/*
 * Whether two bodies overlap in such poses, faces that cross or one inside the other: 1 or 0; -1 when they
 * are within `near` units of each other, or cross by less.
 */
int crowd_overlap(const struct crowd *crowd, int a, int b, const struct oracle_pose *pose_a,
                  const struct oracle_pose *pose_b, double near);
/* The same where they are now. */
int crowd_overlap_now(const struct crowd *crowd, int a, int b, double near);

/* The bodies as they are now, without a step; for the first frame and after carom_body_set. */
void crowd_look(struct crowd *crowd);

#endif

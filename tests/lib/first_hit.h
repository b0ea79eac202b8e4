/* SPDX-License-Identifier: MIT */
/*
 * first_hit - the first hit of two bodies that move freely, found in three ways: by the pipeline of
 * a step, by testing every feature pair in the collision kernel, and by looking for crossing faces
 * in poses along the true motion. Host only.
 */
#ifndef CAROM_TESTS_FIRST_HIT_H
#define CAROM_TESTS_FIRST_HIT_H

#include "oracle.h"
#include "step/parts.h"

/* A mesh in the engine's format and in the oracle's, and the features that are tested. */
struct first_hit_mesh {
    const char *name;
    struct carom_mesh mesh;
    struct oracle_mesh doubles;
    double centre[3];    /* centre of mass, units */
    double radius, thin; /* radius of the whole mesh and of its thinnest part, units */
    uint32_t *vertices, *edges;
    uint32_t vertex_count, edge_count;
};

/* The meshes; the last two are a SURFACE and the head of the scenes. */
enum {
    FIRST_HIT_HEAD,
    FIRST_HIT_BOX,
    FIRST_HIT_NEEDLE,
    FIRST_HIT_PLATE,
    FIRST_HIT_TORUS,
    FIRST_HIT_L,
    FIRST_HIT_SOLIDS,
    FIRST_HIT_FIELD = FIRST_HIT_SOLIDS,
    FIRST_HIT_HEAD1876,
    FIRST_HIT_MESHES
};
/* Sizes: about a unit, an eighth of it, eight times as large, a 128th, 32 times as large. */
#define FIRST_HIT_SIZES 5
extern struct first_hit_mesh first_hit_meshes[FIRST_HIT_SIZES][FIRST_HIT_MESHES];
/* Build them all; ends the program when one does not build. */
void first_hit_make_meshes(void);
/* Complete a mesh whose `mesh` is built and whose other fields are zero. */
void first_hit_make_mesh(struct first_hit_mesh *m, const char *name, double thin);
void first_hit_free_mesh(struct first_hit_mesh *m);

/* Start and motion of two bodies; body 1 always moves. */
struct first_hit_motion {
    const struct first_hit_mesh *mesh[2];
    struct carom_body_def def[2];
    carom_v3_q40 gravity;
    bool in_contact; /* begin like a step: the other body supports this one */
};

/*
 * Motion number n of two of the meshes, the same on every call. Its kind is, in turn: aimed,
 * close, tangled, spinning, grazing, aligned, after some frames, fast, and so on.
 *   movers  1: b stands still; 2
 */
void first_hit_make_motion(struct first_hit_motion *motion, int mesh_a, int mesh_b, int movers,
                           int n);

struct first_hit_verdict {
    bool hit;
    bool different; /* the pipeline's hit is not the first of all feature pairs */
    bool missed;    /* faces cross before the hit, or without a hit */
    bool early;     /* at the hit the features are not the event gap apart, or never meet */
    bool late;      /* the features are nearer, although they were farther apart */
    bool crossed;   /* faces cross where the step goes to */
    bool aside; /* at the hit the features are the event gap apart along N, but not yet opposite */
    int32_t t_q30; /* time of the hit */
    struct candidate candidate;
    double gap, event_gap; /* units, at the hit */
    double meet;           /* the distance of the features at the root */
    double left;           /* the gap in the step's end pose */
    double crossing;       /* time at which faces cross, in slices */
};

/* Judge the first slice of a frame. Ends the program when the world cannot be made. */
void first_hit_judge(const struct first_hit_motion *motion, struct first_hit_verdict *verdict);

/* Whether the meshes cross, or one lies inside the other, at the beginning. */
bool first_hit_overlap(const struct first_hit_motion *motion);

/* Begin with the bodies' poses so many frames later, or before they spin too fast for a start. */
void first_hit_later(struct first_hit_motion *motion, int frames);

#endif

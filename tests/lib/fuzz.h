/* SPDX-License-Identifier: MIT */
/*
 * fuzz - calls of a small world, by random numbers or by a fuzzer's bytes; half of their arguments are hostile. See host_fuzz.c
 * and target.h.
 */
#ifndef CAROM_TESTS_FUZZ_H
#define CAROM_TESTS_FUZZ_H

#include "carom_body.h"
#include "carom_debug.h"
#include "carom_joint.h"
#include "carom_query.h"
#include "chance.h"
#include "lab.h"

/* bodies, pairs, contacts, faces, entries, candidates, joints, extras, hits */
#define FUZZ_CAPS     14, 60, 300, 2000, 256, 500, 8, 8, 4
#define FUZZ_MESHES   6
#define FUZZ_VERTICES 1000 /* most vertices of a mesh, and most faces */
#define FUZZ_PIXELS   24
#define FUZZ_LINES    2
#define FUZZ_BODIES   14
#define FUZZ_WORKSPACE                                                                             \
    (CAROM_DRAW_BYTES(FUZZ_VERTICES, FUZZ_VERTICES) +                                              \
     CAROM_SMOOTH_BYTES(FUZZ_VERTICES, FUZZ_VERTICES))
/* Result of a call whose promise was broken: no error of carom.h. */
#define FUZZ_DIFFERS (-1000)

struct fuzz {
    struct chance chance;
    int searches; /* bodies that may still be pushed out: a search takes as long as many steps */
    struct carom_world *world;
    struct carom_mesh meshes[FUZZ_MESHES]; /* the last one is a surface that moves */
    struct carom_material materials[4];
    uint8_t of_face[FUZZ_VERTICES];
    uint32_t *pixels, *others;
    int16_t vertices[4][3]; /* vertices of the surface */
    struct carom_paint_line lines[FUZZ_LINES];
    struct carom_body_paint body_paint[2];
    struct carom_drawn_body drawn[FUZZ_BODIES];
    int last; /* the last call (fuzz_calls.c) */
    void *block, *mesh_block[FUZZ_MESHES], *workspace;
};

/* Begin a world by random numbers, with the surface and as many bodies in it. */
void fuzz_begin(struct fuzz *f, uint64_t seed, int bodies);
/* The same by bytes, with few bodies; none is pushed out, unless a target then sets `searches`. */
void fuzz_begin_bytes(struct fuzz *f, const uint8_t *bytes, size_t count);
void fuzz_end(struct fuzz *f);
/* Make a call; returns its result. */
int fuzz_call(struct fuzz *f);
/* A call, or a step, and the fault in it: an error that changed the world, or no error of carom.h. NULL: there is none. */
const char *fuzz_try(struct fuzz *f, int (*call)(struct fuzz *f), int *result);
const char *fuzz_try_step(struct carom_world *world, int *result);

/* A number of 0 .. count - 1. */
int fuzz_pick(struct fuzz *f, int count);
/* A number: now and then an extreme one, otherwise within +- 2^bits. */
int64_t fuzz_number(struct fuzz *f, int bits);
/* A number or id of a body, which may not exist. */
int fuzz_body(struct fuzz *f);
/* Definitions, valid more often than not. */
void fuzz_body_def(struct fuzz *f, struct carom_body_def *def);
void fuzz_joint_def(struct fuzz *f, struct carom_joint_def *def);
void fuzz_drive(struct fuzz *f, struct carom_joint_drive *drive);
void fuzz_vector(struct fuzz *f, int64_t v[3], int bits);
void fuzz_rotation(struct fuzz *f, carom_quat_q30 *q);
/* Calls of carom_query.h, carom_draw.h and carom_debug.h. */
int fuzz_ask(struct fuzz *f);
int fuzz_draw(struct fuzz *f);

#endif

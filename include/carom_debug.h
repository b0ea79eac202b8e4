/* SPDX-License-Identifier: MIT */
/*
 * carom_debug.h - a world as triangles and lines, for a renderer of the program's own; the lines may go into
 * Carom's pictures. A part of the library that draws, over carom.h, whose rules hold here too.
 */
#ifndef CAROM_DEBUG_H
#define CAROM_DEBUG_H

#include "carom_draw.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds of things that are handed over, in this order; a sum of these. */
enum carom_debug_flag {
    CAROM_DEBUG_FACES = 1, /* triangles: the faces of the bodies */
    CAROM_DEBUG_INTERFERING =
        2,                 /* those that interfere have their colour; without FACES, only those */
    CAROM_DEBUG_EDGES = 4, /* lines: each edge of the meshes once */
    CAROM_DEBUG_BOXES = 8, /* the box of each mesh along the mesh's axes, 12 lines */
    CAROM_DEBUG_AXES =
        16, /* x, y and z of each body in red, green and blue, from its centre of mass */
    CAROM_DEBUG_VELOCITIES = 32, /* from there to where the body would be 16 frames later: cyan */
    CAROM_DEBUG_CONTACTS = 64,   /* the contacts: a point, and a line along the normal: yellow */
    CAROM_DEBUG_JOINTS = 128     /* kept for joints */
};

/*
 * Where things go. A function that is NULL is not called. Colours are entries of the palette: it has each as
 * 0x00RRGGBB. Places are of the world.
 */
struct carom_debug {
    /* Corners are counter-clockwise from outside; the normal is that of the mesh's face. */
    void (*triangle)(void *context, const carom_v3_q32 corner[3], const carom_v3_q30 *normal,
                     uint32_t colour);
    void (*line)(void *context, const carom_v3_q32 *from, const carom_v3_q32 *to, uint32_t colour);
    void (*point)(void *context, const carom_v3_q32 *at, uint32_t colour);
    void *context; /* the functions' first argument */

    const struct carom_paint *paint; /* the colours of bodies; NULL: the usual ones */
    int64_t size_q32; /* length of axes and normals, 0 .. 256 units; 0: as the bodies are large */

    struct carom_contact *contacts; /* room for CONTACTS; what finds none is not handed over */
    int contact_room;
};

/*
 * Hand a world over as it is after its last step. Nothing changes.
 *
 * Returns  CAROM_OK; CAROM_ERR_NULL, for contacts, too, when there is room for some; CAROM_ERR_ARGUMENT for
 *          unknown flags, a size or room out of range, or a number of ramps that a paint must not have
 */
int carom_debug_draw(const struct carom_world *world, uint32_t flags,
                     const struct carom_debug *debug);

/* Lines that are kept, for the paint of a picture: bodies hide them there. */
struct carom_debug_lines {
    struct carom_paint_line *lines; /* the caller's */
    uint32_t room;                  /* so many */
    uint32_t count;                 /* so many are there */
    uint32_t lost; /* and so many found no room, or were out of the world's range */
};

/* A `line` of carom_debug: its context is a struct carom_debug_lines, which it adds the line to. */
void carom_debug_keep_line(void *lines, const carom_v3_q32 *from, const carom_v3_q32 *to,
                           uint32_t colour);

#ifdef __cplusplus
}
#endif

#endif

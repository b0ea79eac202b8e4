/* SPDX-License-Identifier: MIT */
/**
 * @file
 * A world as triangles and lines, for a renderer of the program's own, or for the lines of Carom's pictures. @ref rules
 * hold.
 *
 * It is part of the library that draws.
 */
#ifndef CAROM_DEBUG_H
#define CAROM_DEBUG_H

#include "carom_draw.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup debug Debug geometry
 * Hand the bodies of a world, and what the engine found, to a renderer.
 * @{
 */

/** Kinds of geometry that carom_debug_draw() hands over, in this order. Flags are a sum of these. */
enum carom_debug_flag {
    CAROM_DEBUG_FACES = 1, /**< triangles: the faces of the bodies */
    /** interfering faces have their own colour; without FACES, only those */
    CAROM_DEBUG_INTERFERING = 2,
    CAROM_DEBUG_EDGES = 4, /**< lines: each edge of the meshes once */
    CAROM_DEBUG_BOXES = 8, /**< 12 lines: the box of each mesh, along the mesh's axes */
    /** lines: x, y, z of each body in red, green, blue, from its centre of mass */
    CAROM_DEBUG_AXES = 16,
    /** cyan lines: from the centre of mass to where the body would be in 16 frames */
    CAROM_DEBUG_VELOCITIES = 32,
    CAROM_DEBUG_CONTACTS = 64, /**< yellow: a point for each contact, and a line along its normal */
    CAROM_DEBUG_JOINTS = 128   /**< reserved for joints */
};

/**
 * Where the geometry goes. A function that is NULL is not called.
 *
 * Places are of the world. A colour is an entry of the palette, which has it as 0x00RRGGBB.
 */
struct carom_debug {
    /** Takes a triangle: corners counter-clockwise from outside, and the normal of the mesh's face. */
    void (*triangle)(void *context, const carom_v3_q32 corner[3], const carom_v3_q30 *normal,
                     uint32_t colour);
    /** Takes a line. */
    void (*line)(void *context, const carom_v3_q32 *from, const carom_v3_q32 *to, uint32_t colour);
    /** Takes a point. */
    void (*point)(void *context, const carom_v3_q32 *at, uint32_t colour);
    void *context;                   /**< first argument of these functions; may be NULL */
    const struct carom_paint *paint; /**< colours of the bodies; NULL: the usual ones */
    /** length of axes and normals, 0 to 256 units; 0: by the size of the bodies */
    int64_t size_q32;
    /** room that CONTACTS works in; contacts beyond it are left out */
    struct carom_contact *contacts;
    int contact_room; /**< how many contacts fit */
};

/**
 * Hand a world over as it is after its last step. Nothing changes.
 *
 * @param flags  a sum of #carom_debug_flag
 * @param debug  where the geometry goes
 * @return CAROM_OK; CAROM_ERR_NULL, also for `contacts` if `contact_room` is not 0; CAROM_ERR_ARGUMENT for unknown
 *         flags, a size or room out of range, or a #carom_paint that carom_draw() would refuse
 */
int carom_debug_draw(const struct carom_world *world, uint32_t flags,
                     const struct carom_debug *debug);

/** Lines that are kept for a #carom_paint, so that bodies in a picture hide them. */
struct carom_debug_lines {
    struct carom_paint_line *lines; /**< the caller's array */
    uint32_t room;                  /**< how many lines fit */
    uint32_t count;                 /**< how many lines it holds */
    uint32_t lost; /**< lines for which there was no room, or that were out of the world's range */
};

/**
 * Keep a line: a function for carom_debug.line, with a #carom_debug_lines as its context.
 *
 * @param lines   a struct carom_debug_lines, which the line is added to
 * @param from    start
 * @param to      end
 * @param colour  an entry of the palette
 */
void carom_debug_keep_line(void *lines, const carom_v3_q32 *from, const carom_v3_q32 *to,
                           uint32_t colour);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/*
 * carom_draw.h - pictures of a world, in integers: a library of its own over carom.h, whose rules hold
 * here too. A program that draws nothing needs neither this header nor src/draw.
 */
#ifndef CAROM_DRAW_H
#define CAROM_DRAW_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Faces are seen from outside only. FLAT shades them with one light from the left and hides what is
 * behind. WIRE draws each edge of the faces that look at the eye once, hidden or not.
 * Interfering faces have colours of their own in both.
 */
enum carom_draw_style { CAROM_DRAW_FLAT, CAROM_DRAW_WIRE };

/* z points up the page; x points right when the camera looks straight up or down. */
struct carom_camera {
    carom_v3_q32 eye;    /* each component within +-16384; nothing closer than 1/32 is drawn */
    carom_v3_q32 target; /* the same range; the middle of the picture looks here; not the eye */
    int32_t focal_q16;   /* focal length in picture heights, 1/16 .. 16: 1 << 16 sees 53 degrees */
};

enum carom_pixel_format {
    CAROM_PALETTE8, /* indices into carom_draw_palette */
    CAROM_RGB565,
    CAROM_XRGB8888,
    CAROM_GREY4, /* two pixels a byte, the left one in its upper half; 0 is black */
    CAROM_BGR555 /* 16 bits, red in the lowest; as RGB565, written by 2 and 4 bytes at a time only */
};

/* 256 colours as 0x00RRGGBB, in ramps of 32; 160 to 254 are not used, 255 is white. */
extern const uint32_t carom_draw_palette[256];

struct carom_picture {
    void *pixels;           /* the top left one; aligned to the size of a pixel */
    int32_t width, height;  /* pixels, 1 .. 2048 */
    int32_t stride;         /* bytes from one row to the next, a multiple of the size of a pixel */
    uint8_t format;         /* enum carom_pixel_format */
    void *workspace;        /* aligned to 8; WIRE needs none, and it may be NULL */
    size_t workspace_bytes; /* at least CAROM_DRAW_BYTES_LEAST; few cost time, not results */

    /*
     * For a display that is sent rows and keeps them, so that no memory holds a whole picture; else
     * NULL. It is called before a row is drawn and returns memory in which pixel 0 of row y lies,
     * aligned to the size of a pixel. Pixels x0 <= x < x1 are written there, and no others. The row
     * that it was called for before is complete by then, the last one when the picture is. Within a
     * rectangle that changes rows come from the top down; a row may come more than once, and the
     * last time counts. `pixels` and `stride` are not used. FLAT only, and not CAROM_GREY4.
     */
    void *(*row)(void *context, int32_t x0, int32_t x1, int32_t y);
    void *context; /* the row function's */
};

/*
 * Workspace to draw bodies of so many vertices and faces, all together, at once; and what the
 * largest mesh needs. With less than the former the picture is drawn in parts when it has to be.
 */
#define CAROM_DRAW_BYTES(vertices, faces)                                                          \
    ((size_t)12288 + (size_t)10 * (size_t)(vertices) + (size_t)11 * (size_t)(faces))
#define CAROM_DRAW_BYTES_LEAST(vertices, faces)                                                    \
    ((size_t)12288 + (size_t)2 * (size_t)(vertices) + (size_t)(faces) / 8)

/*
 * Draw the bodies of a world over a background, with the interfering faces of its last step
 * coloured. Every pixel of the picture is written, none outside of it.
 *
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT for a width, height, stride, format, style or focal length
 *          out of range, a style or format that cannot be sent by rows, or an eye at its target; CAROM_ERR_RANGE for a camera too far away;
 *          CAROM_ERR_MEMORY for a workspace that is too small, or memory that is not aligned.
 *          Unless CAROM_OK, nothing is drawn.
 */
int carom_draw(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style);

/* Pixels of a picture; x1 and y1 are outside. */
struct carom_rect {
    int16_t x0, y0, x1, y1;
};

/* What pixels show of a body. Carom's own. */
struct carom_drawn_body {
    struct carom_body_look look;
    uint32_t moves;        /* of its surface */
    struct carom_rect all; /* what shows of it is in here, and of its interfering faces in there */
    struct carom_rect hot;
};

/*
 * What pixels show of a world, so that the next picture need not be drawn from nothing: one for each
 * buffer that is shown in turn. Zero it, but for the first two members, before the first picture
 * and whenever something else has written to the pixels or built a mesh anew.
 */
#define CAROM_DRAWN_RECTS 8
struct carom_drawn {
    struct carom_drawn_body *bodies; /* the caller's: one for each body that the world may hold */
    uint32_t room;                   /* so many */

    struct carom_rect changed[CAROM_DRAWN_RECTS]; /* out: what was drawn last; may overlap */
    int changed_count;

    /* Carom's own */
    bool shows; /* a whole picture, with what follows */
    uint8_t style;
    uint32_t count; /* of bodies */
    struct carom_camera camera;
    struct carom_picture picture;
};

/*
 * As carom_draw, with the same pixels in the end, but only what may differ from the picture that
 * `drawn` tells of is drawn: where bodies that moved, came or went are and were, and faces that
 * interfere or did. All is drawn when camera, picture or style are others. A world that stands
 * still costs hardly anything.
 *
 * Returns  what carom_draw does; CAROM_ERR_MEMORY too when the world has more bodies than `room`
 */
int carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                       const struct carom_picture *picture, enum carom_draw_style style,
                       struct carom_drawn *drawn);

#ifdef __cplusplus
}
#endif

#endif

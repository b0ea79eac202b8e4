/* SPDX-License-Identifier: MIT */
/* scanline - pixels row by row: faces, the spans of a row, runs of pixels. */
#ifndef CAROM_SRC_DRAW_SCANLINE_H
#define CAROM_SRC_DRAW_SCANLINE_H

#include "view.h"

/* ---- scanline.c: pixels, row by row */

/* A triangle on the picture: its top corner first, then counter-clockwise. */
struct draw_face {
    uint16_t corner[3]; /* places in the list's vertices */
    uint16_t next;      /* next face in the same row's list: 1 + its place, 0 at the end */
    uint16_t colour;    /* palette entry, DRAW_DECAL, DRAW_TINT */
};

/*
 * DRAW_DECAL: the face lies on another face, which is listed after it and is in no row's list, and
 * takes that face's depth. So both depths agree to the last bit, whatever their corners are rounded
 * to.
 */
#define DRAW_DECAL  0x8000u
#define DRAW_TINT   0x4000u /* it has a shade at each pixel: draw_tint */
#define DRAW_COLOUR 0x1fffu /* palettes have at most 256 ramps of 32 */

/* The face whose plane gives a face its depth. Faces are listed downward in memory. */
static inline const struct draw_face *draw_plane(const struct draw_face *face)
{
    return face->colour & DRAW_DECAL ? face - 1 : face;
}

/*
 * A linear shade over the picture, listed after the face and its plane in the place of a further
 * face: the shade at the plane's top corner, and its growth a pixel to the right and a pixel down.
 * A shade is 256 units, from 0 to one less than the number of all.
 */
struct draw_tint {
    uint16_t at_q8, right_q16[2], below_q16[2]; /* growths as upper and lower half */
};
_Static_assert(sizeof(struct draw_tint) == sizeof(struct draw_face),
               "it takes the place of a face");

static inline const struct draw_tint *draw_tint(const struct draw_face *face)
{
    return (const struct draw_tint *)(const void *)(draw_plane(face) - 1);
}

/*
 * The faces that show in a part of the picture: vertices from one end of the workspace, faces downward from
 * the other end. The rows use the room between them.
 */
struct draw_list {
    uint16_t *rows; /* heads of the lists of faces, by first row in the part */
    struct draw_vertex *vertices;
    struct draw_face *faces; /* face i is faces[-i]; place 0 of faces and vertices is unused */
    uint32_t vertex_count, face_count; /* including the unused place 0 */
    size_t room;                       /* bytes between both */
};

/* Room that rows need beside their spans: the ends of two lists of spans. */
#define DRAW_ROWS_ROOM (4 * sizeof(void *))

/*
 * Draw the part. Returns false if the room is too small for one of its rows; with `must` draws what
 * fits.
 */
bool draw_rows(const struct draw_view *view, const struct draw_list *list,
               const struct carom_picture *picture, bool must);

/* ---- depth.c: where faces cover each other */

/* A face in the present row. */
struct draw_span {
    int32_t x_q15[2], step_q15[2]; /* left and right edge (x >> 15: first pixel); growth a row */
    int32_t until;                 /* the row in which an edge ends */
    int32_t rest;   /* rows after that: > 0 with a new left edge, < 0 with a new right one */
    uint32_t pixel; /* its colour, repeated over a whole word */
    const struct draw_face *face;
    uint32_t w_low, w_high; /* bounds of its corners' depth; 0 until needed */
    struct draw_span *next; /* in the list of spans that begin, or of free ones */
    /* depth at the middle of pixel 0 of a row; growth a pixel to the right and a row down */
    int32_t row; /* DRAW_NO_ROW until needed */
    int64_t w_q30, right_q26, below_q26;
};

#define DRAW_NO_ROW    INT32_MIN
#define DRAW_UNDER_MAX 64

/* A row whose pixels before x are done. */
struct draw_sweep {
    const struct draw_view *view;
    const struct draw_vertex *vertices;
    uint8_t *row; /* address of pixel 0 */
    int32_t safe; /* a run that ends at or before this may overwrite 3 pixels more */
    int pixel_shift;
    const struct carom_smooth *smooth; /* or NULL */
    const uint32_t *palette;
    uint8_t format;
    int32_t y, x;
    uint32_t ground;       /* background pixel */
    struct draw_span *top; /* the face that shows from x on; NULL: unknown, or none */
    int32_t end;           /* where the top span ends */
    int32_t clear;         /* up to here the top span is in front of all spans in `under` ... */
    int next;              /* ... and there, before its end, this one of them comes in front */
    int32_t gate;          /* a span that begins at or after this meets no other */
    uint32_t under_high;   /* bound on the depth of the spans in `under`, w_q26 */
    int under_count;
    struct draw_span *under[DRAW_UNDER_MAX]; /* spans behind the top one that may show later */
};

/* Set the bounds of a span's depth; done when first needed. */
void draw_depths(const struct draw_sweep *s, struct draw_span *span);

/* True if the top span is in front of all of another span, which is then put under it. */
static inline bool draw_hides(struct draw_sweep *s, struct draw_span *top, struct draw_span *span)
{
    if (top->w_high == 0) {
        draw_depths(s, top);
    }
    if (top->w_low > span->w_high && s->under_count < DRAW_UNDER_MAX) {
        s->under[s->under_count++] = span;
        if (s->under_high < span->w_high) {
            s->under_high = span->w_high;
        }
        return true;
    }
    return false;
}

/* True if a span is surely in front of all spans in `under`. */
static inline bool draw_shows(const struct draw_sweep *s, const struct draw_span *span)
{
    return span->w_low > s->under_high;
}

/* Draw up to pixel `to`. */
void draw_advance(struct draw_sweep *s, int32_t to);
/* Take in a span whose first pixel is not before x. */
void draw_overlap(struct draw_sweep *s, struct draw_span *span);

/* ---- pixels.c: runs of pixels in memory */

/*
 * Stores of 2 and 4 bytes into memory of any type. Where the processor can store words at odd
 * addresses the types may lie there. Elsewhere a compiler would make four byte stores of one, so
 * runs are written as their ends allow. Pixels of two or four bytes are never written by single
 * bytes: some machines' video memory does not take that. DRAW_ALIGN asks for the second way where
 * the first would do, so that a test on any processor can run it.
 */
#if !defined DRAW_ALIGN &&                                                                         \
    (defined __ARM_FEATURE_UNALIGNED || defined __i386__ || defined __x86_64__)
#define DRAW_ANYWHERE 1
#define DRAW_ALIGNED  aligned(1)
#else
#define DRAW_ANYWHERE 0
#define DRAW_ALIGNED
#endif
#if defined __GNUC__
typedef uint16_t draw_half __attribute__((may_alias, DRAW_ALIGNED));
typedef uint32_t draw_word __attribute__((may_alias, DRAW_ALIGNED));
typedef uint32_t draw_pixel4 __attribute__((may_alias)); /* a pixel of 4 bytes, aligned */
typedef struct {
    uint32_t word[4];
} __attribute__((may_alias)) draw_four;
#else
typedef uint16_t draw_half;
typedef uint32_t draw_word;
typedef uint32_t draw_pixel4;
typedef struct {
    uint32_t word[4];
} draw_four;
#endif

/* A pixel takes 2^shift bytes; -1: half a byte, the left pixel in the upper half. */
int draw_pixel_shift(uint8_t format);

/* Address of pixel x of a row, or of the byte that holds it. */
static inline uint8_t *draw_pixel(uint8_t *row, int pixel_shift, int32_t x)
{
    return row + (pixel_shift < 0 ? x >> 1 : x * (1 << pixel_shift));
}

/*
 * Address of pixel 0 of row y, both counted from the view's middle. Called once for each row of the
 * view's part, after the row before is complete: a display that is sent rows is told of them here.
 */
uint8_t *draw_pixels(const struct draw_view *view, const struct carom_picture *picture, int32_t y);

/* Draw pixels from <= x < to of a row in one colour, and no others. */
void draw_run(uint8_t *row, int pixel_shift, int32_t from, int32_t to, uint32_t pixel);

/* The background pixel of row y of the view's part. */
uint32_t draw_ground(const struct draw_view *view, const struct carom_picture *picture, int32_t y);

#endif

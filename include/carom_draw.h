/* SPDX-License-Identifier: MIT */
/*
 * carom_draw.h - pictures of a world, in integers: a library of its own over carom.h, whose rules hold
 * here too. A program that draws nothing needs neither this header nor src/draw.
 */
#ifndef CAROM_DRAW_H
#define CAROM_DRAW_H

#include "carom_query.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Faces are seen from outside only. FLAT shades them with one light from the left and hides what is
 * behind. WIRE draws each edge of the faces that look at the eye once, hidden or not.
 * Interfering faces have colours of their own in both. A carom_paint may change all of these.
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
    CAROM_GREY4, /* two pixels a byte, the left one in its upper half; 0 is black. Ramps 0 to 4 of
                    carom_draw_palette have greys of their own, other colours that of their light */
    CAROM_BGR555 /* 16 bits, red in the lowest; as RGB565, written by 2 and 4 bytes at a time only */
};

/*
 * A palette is colours as 0x00RRGGBB, in ramps of 32 shades from shadow to light. A colour is the number of
 * an entry, so that it means the same in every format.
 *
 *   0     the background, from the top of the picture to the bottom
 *   1, 2  bodies that are stationary, that move
 *   3, 4  the interfering faces of these
 *   5, 6  blue, violet: for the program
 *   7     the first 24 entries are black, for the program; the last 8 are enum carom_colour
 */
enum carom_ramp {
    CAROM_RAMP_BACKGROUND,
    CAROM_RAMP_STATIONARY,
    CAROM_RAMP_MOVING,
    CAROM_RAMP_STATIONARY_HOT,
    CAROM_RAMP_MOVING_HOT,
    CAROM_RAMP_BLUE,
    CAROM_RAMP_VIOLET
};
enum carom_colour {
    CAROM_COLOUR_BLACK = 248,
    CAROM_COLOUR_RED,
    CAROM_COLOUR_GREEN,
    CAROM_COLOUR_BLUE,
    CAROM_COLOUR_YELLOW,
    CAROM_COLOUR_MAGENTA,
    CAROM_COLOUR_CYAN,
    CAROM_COLOUR_WHITE
};
#define CAROM_RAMP_SHADES 32
extern const uint32_t carom_draw_palette[256];

/*
 * Make a ramp of one colour, 0x00RRGGBB: from a quarter of it to half way to white. Returns CAROM_OK or
 * CAROM_ERR_NULL.
 */
int carom_draw_ramp(uint32_t ramp[CAROM_RAMP_SHADES], uint32_t rgb);

/* How one body looks. */
struct carom_body_paint {
    const uint8_t *faces; /* the ramp of each face of its mesh, 0: the body's; or NULL */
    uint8_t ramp;         /* of the body; 0: the usual one */
};

/*
 * A line of the world that the bodies in front of it hide, one pixel wide: a part of the picture, by rows,
 * too, and of what carom_draw_changes finds changed. One that lies on a face shows. WIRE hides nothing.
 */
struct carom_paint_line {
    carom_v3_q32 from, to; /* each component within +-16384 */
    uint16_t colour;       /* an entry of the palette */
};

/* What draws shadows: a program that does not name it does not hold it. */
struct carom_shadows;
extern const struct carom_shadows carom_shadows;

/* What shades from corner to corner, likewise. */
struct carom_smooth;
extern const struct carom_smooth carom_smooth;

/*
 * The things that a picture shows otherwise than usual; all zero changes nothing. It and all that it points to are the
 * caller's, and only read.
 */
struct carom_paint {
    /* NULL: carom_draw_palette; ramps 0 to 4 and the last 8 of 256 entries have the same uses in each */
    const uint32_t *palette;
    uint32_t ramps; /* in the palette: 8 .. 256, CAROM_PALETTE8 has 8; without one, not used */

    const struct carom_body_paint *bodies; /* by the number of the body */
    uint32_t body_count;                   /* so many; those after them look as usual */

    bool hide_interfering;    /* interfering faces look as others do */
    uint8_t interfering_ramp; /* else, of all of them; 0: the usual two */

    carom_v3_q30 light;  /* the direction towards the light, of any length; 0: the usual one */
    int32_t ambient_q30; /* of the light, what comes from everywhere: 0 .. 1 */
    bool horizon; /* ramp 0 is the sky down to the horizon, 16 shades, and the ground below it */

    /*
     * &carom_shadows, or NULL for none. FLAT: solids keep the light from other bodies, though not from themselves. The
     * edge of a shadow is exact to a part of a pixel. Shadows take room in the workspace, about 64 KiB for a head over a
     * landscape; a solid of which the outline does not fit into a third of what is left has none.
     */
    const struct carom_shadows *shadows;

    /*
     * &carom_smooth, or NULL for faces of one shade each. FLAT: shades go evenly from corner to corner, and the sky from row
     * to row. At a vertex faces share one shade, the mean of theirs, up to an edge at which the normals of two differ by
     * more than an angle: there the edge stays sharp. XRGB8888 has all colours between two shades; the other formats
     * mix pixels of both in a pattern. CAROM_SMOOTH_BYTES more of the workspace are used.
     */
    const struct carom_smooth *smooth;
    int32_t crease_q30; /* the cosine of that angle, -1 .. 1; 0: the usual one, of 50 degrees */

    const struct carom_paint_line *lines;
    uint32_t line_count; /* up to 4096; each takes 52 bytes of the workspace */
};

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

    const struct carom_paint *paint; /* NULL: as usual */
};

/*
 * Workspace to draw bodies of so many vertices and faces, all together, at once; and what the
 * largest mesh needs. With less than the former the picture is drawn in parts when it has to be.
 */
#define CAROM_DRAW_BYTES(vertices, faces)                                                          \
    ((size_t)12288 + (size_t)10 * (size_t)(vertices) + (size_t)11 * (size_t)(faces))
#define CAROM_DRAW_BYTES_LEAST(vertices, faces)                                                    \
    ((size_t)12288 + (size_t)2 * (size_t)(vertices) + (size_t)(faces) / 8)
/* With carom_paint.smooth, besides; at least for the vertices of the largest mesh and no faces. */
#define CAROM_SMOOTH_BYTES(vertices, faces)                                                        \
    ((size_t)2 * (size_t)(vertices) + (size_t)10 * (size_t)(faces))

/*
 * Draw the bodies of a world over a background, with the interfering faces of its last step
 * coloured. Every pixel of the picture is written, none outside of it.
 *
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT for a width, height, stride, format, style or focal length
 *          out of range, a style or format that cannot be sent by rows, an eye at its target, or a
 *          number of ramps or lines, a colour, an ambient light or a crease out of range; CAROM_ERR_RANGE for a
 *          camera or a line too far away; CAROM_ERR_NULL; CAROM_ERR_MEMORY for a
 *          workspace that is too small, or memory that is not aligned.
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
    uint8_t ramp; /* of its paint */
};

/*
 * What pixels show of a world, so that the next picture need not be drawn from nothing: one for each
 * buffer that is shown in turn. Zero it, but for the first two members, before the first picture
 * and whenever something else has written to the pixels, built a mesh anew, or changed what a paint refers
 * to but for the ramps of bodies and the lines.
 */
#define CAROM_DRAWN_RECTS 8
struct carom_drawn {
    struct carom_drawn_body *bodies; /* the caller's: one for each body that the world may hold */
    uint32_t room;                   /* so many */

    /* in: pixels that something else has written to, as carom_draw_text notes them; made empty then */
    struct carom_rect touched;

    struct carom_rect changed[CAROM_DRAWN_RECTS]; /* out: what was drawn last; may overlap */
    int changed_count;

    /* Carom's own */
    bool shows; /* a whole picture, with what follows */
    uint8_t style;
    uint32_t count; /* of bodies */
    struct carom_camera camera;
    struct carom_picture picture;
    struct carom_paint paint;
    struct carom_rect lines; /* they are in here */
    uint64_t lines_hash;
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

/* ------------------------------------------------------- what a pixel shows */

/*
 * The ray from a camera through a place of a picture, from where the nearest things are drawn on; far enough
 * for any world.
 *   width, height  of the picture, pixels, 1 .. 2048
 *   x_q8, y_q8     1/256 pixels from its top left corner, within the picture: the middle of pixel (x, y) is at
 *                  (256 x + 128, 256 y + 128)
 *   ray            out
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT, CAROM_ERR_RANGE as carom_draw
 */
int carom_view_ray(const struct carom_camera *camera, int32_t width, int32_t height, int32_t x_q8,
                   int32_t y_q8, struct carom_ray *ray);

/*
 * The face that the middle of pixel (x, y) of a picture shows: carom_cast_ray along carom_view_ray. Of
 * `picture` only width and height are used; of one that was drawn FLAT the pixel has this face's colour, but
 * for those at an edge, whose corners were rounded to a part of a pixel.
 * Returns  1 or 0; errors of both
 */
int carom_draw_pick(const struct carom_world *world, const struct carom_camera *camera,
                    const struct carom_picture *picture, int32_t x, int32_t y,
                    const struct carom_query_filter *filter, struct carom_ray_hit *hit);

/*
 * Draw a line of the world over a picture that is drawn, in front of everything, as WIRE draws edges: one
 * pixel a column, or a row where it is steep. One that bodies hide is a carom_paint_line.
 *
 *   from, to  each component within +-16384; what is nearer than 1/32 in front of the eye is cut off
 *   colour    an entry of the palette
 *   touched   grows to hold the pixels that may have been written, carom_drawn.touched say; or NULL
 *
 * Returns  what carom_draw does, but that no workspace is needed; CAROM_ERR_ARGUMENT for a picture by
 *          rows, too: a line crosses rows that have been sent
 */
int carom_draw_line(const struct carom_camera *camera, const struct carom_picture *picture,
                    const carom_v3_q32 *from, const carom_v3_q32 *to, uint32_t colour,
                    struct carom_rect *touched);

/* Letters are 5 pixels wide and 7 high, in cells of 6 x 9. */
#define CAROM_TEXT_WIDTH  6
#define CAROM_TEXT_HEIGHT 9
struct carom_text {
    int32_t x, y;  /* the left top pixel of the first cell, in the picture or not; within +-16384 */
    uint8_t scale; /* pixels to each of a letter's, 1 .. 64; 0: 1 */
    bool opaque;   /* the rest of the cells has the colour `paper`; else it stays as it is */
    uint16_t colour; /* entries of the palette */
    uint16_t paper;
};

/*
 * Write over a picture that is drawn. Characters are ASCII from 32 to 126; 10 begins a new line under the first
 * cell; any other is a box. Pixels outside of the picture are cut off.
 *
 *   touched  grows to hold the pixels that may have been written; or NULL
 *
 * By rows a text must be opaque, since what was sent is not there to be written over: its rows are asked
 * for from the top down, each line of text by itself.
 *
 * Returns  the cells of the longest line; else what carom_draw does, but that no workspace is needed;
 *          CAROM_ERR_ARGUMENT for a place, scale or colour out of range, or text by rows that is not opaque
 */
int carom_draw_text(const struct carom_picture *picture, const struct carom_text *where,
                    const char *text, struct carom_rect *touched);

#ifdef __cplusplus
}
#endif

#endif

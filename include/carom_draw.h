/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Pictures of a world, in integers. @ref rules hold.
 *
 * This is a library of its own over carom.h: a program that draws nothing needs neither this header nor src/draw.
 */
#ifndef CAROM_DRAW_H
#define CAROM_DRAW_H

#include "carom_query.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup draw Pictures
 * Draw a world into pixels of the caller's.
 *
 * carom_draw() draws a whole picture; carom_draw_changes() draws what changed since the last one. A #carom_paint
 * changes colours, light and shading. Faces are visible from outside only.
 * @{
 */

/** How faces are drawn. */
enum carom_draw_style {
    CAROM_DRAW_FLAT, /**< faces shaded by one light from the left; what is behind is hidden */
    CAROM_DRAW_WIRE  /**< each edge of the faces that look at the eye once, hidden or not */
};

/** A camera. z points up the picture; if the camera looks straight up or down, x points right. */
struct carom_camera {
    /** units, each component within +-16384; nothing nearer than 1/32 is drawn */
    carom_v3_q32 eye;
    carom_v3_q32 target; /**< the point in the middle of the picture; the same range; not the eye */
    int32_t focal_q16; /**< focal length in picture heights, 1/16 to 16; 1 << 16 sees 53 degrees */
};

/** Formats of pixels. */
enum carom_pixel_format {
    CAROM_PALETTE8, /**< 8 bits: indices into #carom_draw_palette */
    CAROM_RGB565,   /**< 16 bits */
    CAROM_XRGB8888, /**< 32 bits */
    /**
     * 4 bits, the left one of two pixels in the upper half of a byte; 0 is black. Ramps 0 to 4 of #carom_draw_palette
     * have greys of their own, other colours that of their light
     */
    CAROM_GREY4,
    CAROM_BGR555 /**< 16 bits, red in the lowest; written by 2 and 4 bytes at a time only */
};

/**
 * The ramps of a palette.
 *
 * A palette holds colours as 0x00RRGGBB, in ramps of #CAROM_RAMP_SHADES shades from shadow to light. A colour is the
 * number of an entry, so it means the same in every format. Ramp 7 has 24 black entries for the program, and then
 * those of #carom_colour.
 */
enum carom_ramp {
    CAROM_RAMP_BACKGROUND,     /**< the background, from the top of the picture to the bottom */
    CAROM_RAMP_STATIONARY,     /**< stationary bodies */
    CAROM_RAMP_MOVING,         /**< moving bodies */
    CAROM_RAMP_STATIONARY_HOT, /**< interfering faces of stationary bodies */
    CAROM_RAMP_MOVING_HOT,     /**< interfering faces of moving bodies */
    CAROM_RAMP_BLUE,           /**< for the program */
    CAROM_RAMP_VIOLET          /**< for the program */
};
/** Colours with a name, which are entries of every palette. */
enum carom_colour {
    CAROM_COLOUR_BLACK = 248, /**< black */
    CAROM_COLOUR_RED,         /**< red */
    CAROM_COLOUR_GREEN,       /**< green */
    CAROM_COLOUR_BLUE,        /**< blue */
    CAROM_COLOUR_YELLOW,      /**< yellow */
    CAROM_COLOUR_MAGENTA,     /**< magenta */
    CAROM_COLOUR_CYAN,        /**< cyan */
    CAROM_COLOUR_WHITE        /**< white */
};
/** Shades of a ramp. */
#define CAROM_RAMP_SHADES 32
/** The palette of a picture without one of its own: 8 ramps. */
extern const uint32_t carom_draw_palette[256];

/**
 * Make a ramp of one colour, from a quarter of its light to half way to white.
 *
 * @param[out] ramp  entries of a palette
 * @param rgb        0x00RRGGBB
 * @return CAROM_OK
 */
int carom_draw_ramp(uint32_t ramp[CAROM_RAMP_SHADES], uint32_t rgb);

/** How one body looks. */
struct carom_body_paint {
    /** the ramp of each face of its mesh, 0: that of the body; NULL: all of the body's */
    const uint8_t *faces;
    uint8_t ramp; /**< the ramp of the body; 0: the usual one */
};

/**
 * A line in the world, one pixel wide, that bodies in front of it hide.
 *
 * It is part of the picture, also by rows, and of what carom_draw_changes() finds changed. A line on a face is
 * visible. WIRE hides nothing.
 */
struct carom_paint_line {
    carom_v3_q32 from; /**< start, units, each component within +-16384 */
    carom_v3_q32 to;   /**< end, the same range */
    uint16_t colour;   /**< an entry of the palette */
};

/** The code that draws shadows. A program that does not name #carom_shadows does not link it. */
struct carom_shadows;
/** For carom_paint.shadows. */
extern const struct carom_shadows carom_shadows;

/** The code that shades faces smoothly. A program that does not name #carom_smooth does not link it. */
struct carom_smooth;
/** For carom_paint.smooth. */
extern const struct carom_smooth carom_smooth;

/** How a picture differs from the usual one; all zero: it does not. It and its arrays are the caller's, and only read. */
struct carom_paint {
    /**
     * the palette; NULL: #carom_draw_palette. Ramps 0 to 4 and the last 8 of the first 256 entries have the same uses
     * in each
     */
    const uint32_t *palette;
    /** ramps of `palette`: 8 to 256; CAROM_PALETTE8 needs 8; not used without `palette` */
    uint32_t ramps;

    const struct carom_body_paint *bodies; /**< how bodies look, by body number */
    uint32_t body_count;                   /**< entries of `bodies`; later bodies look as usual */

    bool hide_interfering;    /**< interfering faces look as others do */
    uint8_t interfering_ramp; /**< otherwise: their ramp; 0: the two usual ones */

    carom_v3_q30 light;  /**< direction towards the light, of any length; 0: the usual one */
    int32_t ambient_q30; /**< part of the light that comes from everywhere, 0 to 1 */
    /** ramp 0 has 16 shades for the sky above the horizon, and 16 for the ground below */
    bool horizon;

    /**
     * &#carom_shadows; NULL: no shadows.
     *
     * For FLAT. SOLIDs keep the light from other bodies, but not from themselves. The edge of a shadow is exact to a
     * part of a pixel. Shadows take room in the workspace, about 64 KiB for a head over a landscape. A SOLID whose
     * outline does not fit into a third of the rest of the workspace casts none.
     */
    const struct carom_shadows *shadows;

    /**
     * &#carom_smooth; NULL: one shade for each face.
     *
     * For FLAT. Shades change evenly from corner to corner, and the sky's from row to row. The faces at a vertex share
     * one shade, the mean of theirs, up to an edge at which two normals differ by more than an angle (`crease_q30`):
     * that edge stays sharp. XRGB8888 shows all colours between two shades; the other formats mix pixels of both in a
     * pattern. It takes #CAROM_SMOOTH_BYTES more of the workspace.
     */
    const struct carom_smooth *smooth;
    int32_t crease_q30; /**< cosine of that angle, -1 to 1; 0: the usual one, of 50 degrees */

    const struct carom_paint_line *lines; /**< lines in the world */
    uint32_t line_count;                  /**< up to 4096; each takes 52 bytes of the workspace */
};

/** Where a picture goes. */
struct carom_picture {
    void *pixels;    /**< the top left pixel; aligned to the size of a pixel */
    int32_t width;   /**< pixels, 1 to 2048 */
    int32_t height;  /**< pixels, 1 to 2048 */
    int32_t stride;  /**< bytes from a row to the next, a multiple of the size of a pixel */
    uint8_t format;  /**< #carom_pixel_format */
    void *workspace; /**< aligned to 8; may be NULL for WIRE, which needs none */
    /** at least #CAROM_DRAW_BYTES_LEAST; fewer than #CAROM_DRAW_BYTES cost time, not results */
    size_t workspace_bytes;

    /**
     * For a display that is sent rows and keeps them, so that no memory holds a whole picture; otherwise NULL.
     *
     * It is called before a row is drawn. It returns memory for pixel 0 of row y, aligned to the size of a pixel; only
     * pixels x0 <= x < x1 are written there. The previous row is complete by then, and the last row is complete when
     * the picture is. Within a rectangle that changes, rows come from the top down. A row may come more than once; the
     * last time counts. `pixels` and `stride` are not used. FLAT only, and not CAROM_GREY4.
     */
    void *(*row)(void *context, int32_t x0, int32_t x1, int32_t y);
    void *context; /**< first argument of `row`; may be NULL */

    /** how it differs from the usual picture; NULL: it does not */
    const struct carom_paint *paint;
};

/** Workspace that draws bodies of so many vertices and faces, all together, in one go. */
#define CAROM_DRAW_BYTES(vertices, faces)                                                          \
    ((size_t)12288 + (size_t)10 * (size_t)(vertices) + (size_t)11 * (size_t)(faces))
/** Least workspace, for the largest mesh of the world. The picture is then drawn in parts where it must be. */
#define CAROM_DRAW_BYTES_LEAST(vertices, faces)                                                    \
    ((size_t)12288 + (size_t)2 * (size_t)(vertices) + (size_t)(faces) / 8)
/** Further workspace for carom_paint.smooth; at least that of the largest mesh's vertices and no faces. */
#define CAROM_SMOOTH_BYTES(vertices, faces)                                                        \
    ((size_t)2 * (size_t)(vertices) + (size_t)10 * (size_t)(faces))

/**
 * Draw the bodies of a world over a background, with the interfering faces of its last step coloured.
 *
 * Writes every pixel of the picture, and none outside.
 *
 * @param camera   where from
 * @param picture  where to
 * @param style    FLAT or WIRE
 * @return CAROM_OK; CAROM_ERR_ARGUMENT for a width, height, stride, format, style or focal length out of range, a style
 *         or format that cannot be sent by rows, an eye at its target, or a number of ramps or lines, a colour, an
 *         ambient light or a crease out of range; CAROM_ERR_RANGE for a camera or a line too far away; CAROM_ERR_NULL;
 *         CAROM_ERR_MEMORY for a workspace that is too small, or memory that is not aligned.
 *         Unless CAROM_OK, nothing is drawn.
 */
int carom_draw(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style);

/** A rectangle of pixels. */
struct carom_rect {
    int16_t x0; /**< first column */
    int16_t y0; /**< first row */
    int16_t x1; /**< column after the last one */
    int16_t y1; /**< row after the last one */
};

/** A body as the pixels show it. Carom's own. */
struct carom_drawn_body {
    struct carom_body_look look; /**< the body as it was drawn */
    uint32_t moves;              /**< how often its surface had moved */
    struct carom_rect all;       /**< rectangle around all that shows of it */
    struct carom_rect hot;       /**< rectangle around its interfering faces */
    uint8_t ramp;                /**< ramp of its paint */
};

/** Most rectangles that carom_draw_changes() reports. */
#define CAROM_DRAWN_RECTS 8
/**
 * A world as the pixels show it, so that the next picture need not be drawn from nothing.
 *
 * Keep one for each buffer that is shown in turn. Zero all of it but `bodies` and `room` before the first picture, and
 * whenever something else has written to the pixels, built a mesh anew, or changed what a paint refers to (other than
 * the ramps of bodies, and the lines).
 */
struct carom_drawn {
    /** the caller's array: one for each body that the world may hold */
    struct carom_drawn_body *bodies;
    uint32_t room; /**< entries of `bodies` */

    /** in: pixels that something else has written to, as carom_draw_text() notes them; made empty by the call */
    struct carom_rect touched;
    struct carom_rect changed[CAROM_DRAWN_RECTS]; /**< out: what was drawn last; may overlap */
    int changed_count;                            /**< out: how many of `changed` */

    bool shows;     /**< Carom's own: the pixels show a whole picture, with what follows */
    uint8_t style;  /**< Carom's own: style */
    uint32_t count; /**< Carom's own: bodies that were drawn */
    struct carom_camera camera;   /**< Carom's own: camera */
    struct carom_picture picture; /**< Carom's own: picture */
    struct carom_paint paint;     /**< Carom's own: paint */
    struct carom_rect lines;      /**< Carom's own: rectangle around the lines */
    uint64_t lines_hash;          /**< Carom's own: hash of the lines */
};

/**
 * Draw what may differ from the picture that `drawn` describes. The pixels end as those of carom_draw().
 *
 * It draws where bodies that moved, came or went are and were, and faces that interfere or did. It draws all if camera,
 * picture or style differ. A world that stands still costs hardly anything.
 *
 * @param camera   where from
 * @param picture  where to
 * @param style    FLAT or WIRE
 * @param drawn    in/out: what the pixels show
 * @return as carom_draw(); CAROM_ERR_MEMORY also if the world has more bodies than carom_drawn.room
 */
int carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                       const struct carom_picture *picture, enum carom_draw_style style,
                       struct carom_drawn *drawn);

/** @} */
/**
 * @defgroup pick What a pixel shows
 * From a place of a picture to a ray, and to the face that it shows.
 * @{
 */

/**
 * Make the ray from a camera through a place of a picture. It starts where the nearest things are drawn, and is long
 * enough for any world.
 *
 * @param camera    the camera
 * @param width     of the picture, pixels, 1 to 2048
 * @param height    of the picture, pixels, 1 to 2048
 * @param x_q8      1/256 pixels from the left, within the picture; the middle of pixel x is at 256 x + 128
 * @param y_q8      1/256 pixels from the top, likewise
 * @param[out] ray  for carom_cast_ray()
 * @return CAROM_OK; CAROM_ERR_ARGUMENT, CAROM_ERR_RANGE as carom_draw()
 */
int carom_view_ray(const struct carom_camera *camera, int32_t width, int32_t height, int32_t x_q8,
                   int32_t y_q8, struct carom_ray *ray);

/**
 * Find the face that the middle of a pixel shows: carom_cast_ray() along carom_view_ray().
 *
 * In a picture that was drawn FLAT the pixel has the colour of this face, except at an edge, whose corners were rounded
 * to a part of a pixel.
 *
 * @param camera    the camera
 * @param picture   only width and height are used
 * @param x         column
 * @param y         row
 * @param filter    which bodies; may be NULL
 * @param[out] hit  written if there is one
 * @return 1 or 0; errors of both calls
 */
int carom_draw_pick(const struct carom_world *world, const struct carom_camera *camera,
                    const struct carom_picture *picture, int32_t x, int32_t y,
                    const struct carom_query_filter *filter, struct carom_ray_hit *hit);

/** @} */
/**
 * @defgroup overlay Lines and text over a picture
 * Write over a picture that is drawn.
 * @{
 */

/**
 * Draw a line of the world in front of everything, as WIRE draws edges: one pixel a column, or a row where it is steep.
 *
 * Use #carom_paint_line for a line that bodies hide.
 *
 * @param camera   the camera of the picture
 * @param picture  the picture; no workspace is needed
 * @param from     start, units, each component within +-16384; what is less than 1/32 in front of the eye is cut off
 * @param to       end, the same range
 * @param colour   an entry of the palette
 * @param touched  in/out: grows to hold the pixels that may have been written, for carom_drawn.touched; may be NULL
 * @return as carom_draw(); CAROM_ERR_ARGUMENT also for a picture by rows: the line crosses rows that have been sent
 */
int carom_draw_line(const struct carom_camera *camera, const struct carom_picture *picture,
                    const carom_v3_q32 *from, const carom_v3_q32 *to, uint32_t colour,
                    struct carom_rect *touched);

/** Width of a cell of text, pixels; a letter is 5 wide. */
#define CAROM_TEXT_WIDTH 6
/** Height of a cell of text, pixels; a letter is 7 high. */
#define CAROM_TEXT_HEIGHT 9
/** Where text is written, and how it looks. */
struct carom_text {
    int32_t x;     /**< left pixel of the first cell, in the picture or not; within +-16384 */
    int32_t y;     /**< top pixel of the first cell; likewise */
    uint8_t scale; /**< pixels to each of a letter's, 1 to 64; 0: 1 */
    bool opaque; /**< the rest of the cells gets the colour `paper`; otherwise it stays as it is */
    uint16_t colour; /**< of the letters, an entry of the palette */
    uint16_t paper;  /**< of the cells, an entry of the palette */
};

/**
 * Write text over a picture.
 *
 * Characters are ASCII from 32 to 126. 10 begins a new line under the first cell. Any other is a box. Pixels outside
 * the picture are cut off. By rows, text must be opaque, since what was sent is not there to be written over; its rows
 * are asked for from the top down, for each line of text by itself.
 *
 * @param picture  the picture; no workspace is needed
 * @param where    place and colours
 * @param text     ends with a zero
 * @param touched  in/out: grows to hold the pixels that may have been written; may be NULL
 * @return the number of cells of the longest line; errors as carom_draw(); CAROM_ERR_ARGUMENT for a place, scale or
 *         colour out of range, or text by rows that is not opaque
 */
int carom_draw_text(const struct carom_picture *picture, const struct carom_text *where,
                    const char *text, struct carom_rect *touched);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

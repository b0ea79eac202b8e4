/* SPDX-License-Identifier: MIT */
/*
 * draw - a picture of a world: camera, clipping, flat or smooth shading row by row, wireframe,
 * lines, text. (The paper drew by graphics hardware.)
 *
 * In: a world, a camera, a picture with its paint and workspace. Out: pixels. Like any program,
 * draw asks the world only through carom.h (source.c).
 *
 * Steps of CAROM_DRAW_FLAT, and the files that hold them:
 *   draw.c       check arguments, choose the style
 *   changes.c    only what changed since the last picture
 *   source.c     what is drawn; paint.c: how it is painted
 *   view.c       camera; a body's pose seen from it; vertices to the picture
 *   cover.c      what the largest body surely hides
 *   flat.c       list the faces that show in a part of the picture
 *   clip.c       faces that reach out of the guard band
 *   smooth.c     shades from corner to corner
 *   shadow.c     parts of faces in shadow, listed over them
 *   outline.c    a solid's outline as the light sees it; prism.c: the volumes that it shades
 *   segment.c    lines of the world, as thin faces
 *   scanline.c   pixels row by row; depth.c: where faces cover each other
 *   pixels.c     runs of pixels; palette.c: their colours
 *
 * Beside it: wire.c (wireframe), line.c, text.c and font.c (over a picture), pick.c (the body at a
 * pixel), debug.c (triangles and lines for other renderers), rect.c (rectangles), divide.c.
 *
 * Four frames of reference:
 *
 *   world   q32
 *   mesh    relative to the eye along the mesh's axes, q22 shifted right by the body's `shift`, so
 *           that nothing of the body is longer than 2^29
 *   view    x right, y down, z forward, scaled so that the guard band is |x| <= z, |y| <= z
 *   picture pixels in q4 from the middle of the picture, y down; exactly, x from the left side of
 *           the pixel `middle`, y from 7/16 above its top side: a corner at y is above the middle
 *           of row y >> 4, counted from that pixel, and of no row before
 *
 * The guard band is a square of DRAW_GUARD pixels either way of the middle of the picture. It holds
 * the largest picture. So faces are clipped exactly only against it and the near plane; rows cut
 * the rest at the edges of the picture.
 *
 * Depth is w_q26 = 1 / z: linear over the picture, larger is nearer, 2^31 on the near plane, 1/32
 * unit in front of the eye.
 *
 * FLAT works on a rectangular part of the picture at a time: all of it if the workspace holds all
 * faces that show in it. Faces are listed by their first row. Each row then knows its faces from
 * left to right. Where one face alone covers a pixel no depth is compared, and every pixel is
 * written about once.
 */
#ifndef CAROM_SRC_DRAW_H
#define CAROM_SRC_DRAW_H

#include "scanline.h"

/* ---- flat.c: the faces that show, part by part */

/* Returns CAROM_OK or CAROM_ERR_MEMORY for a workspace that is too small. */
int draw_flat(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, const struct draw_rect *rect);

/* ---- smooth.c: shades from corner to corner */

/* The body whose shades are being computed. */
struct draw_shades {
    const struct draw_body *body;
    uint16_t *at; /* shade at each vertex, q8 plus 1; 0: unknown. NULL: each face has one shade */
    int32_t crease_q30; /* faces share a shade if their normals' product is no less */
    uint32_t shade_q24; /* the view's */
};
#define DRAW_SHADES_MANY 0xffffu /* the vertex has several shades */

struct carom_smooth {
    /* List a face whose corners have these places in the list. Room for two faces must be free. */
    void (*list)(const struct draw_shades *shades, uint32_t face, const struct draw_rect *rect,
                 struct draw_list *list, const uint32_t place[3], uint32_t colour, bool inside);
    /* List what the guard band leaves of a face. */
    void (*list_clipped)(const struct draw_shades *shades, uint32_t face,
                         const struct draw_rect *rect, struct draw_list *list, uint32_t colour);
    /* The shades of a face's corners; those of points on the face, in view coordinates. */
    void (*corners)(const struct draw_shades *shades, uint32_t face, int32_t shade_q8[3]);
    void (*between)(const struct draw_shades *shades, uint32_t face, int32_t (*at)[3], int n,
                    int32_t *shade_q8);
    /*
     * Give the last listed face (or, with its plane, the one before) the shades of the plane's
     * corners. Lists a tint if the shades differ.
     */
    void (*tint)(struct draw_list *list, struct draw_face *face, const int32_t shade_q8[3]);
    /* Draw a row's pixels up to x1; draw a run of a span that has a tint. */
    void (*row)(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1);
    void (*run)(const struct draw_sweep *s, const struct draw_span *span, int32_t from, int32_t to);
    /* A pixel row of the background in a given shade. */
    uint32_t (*ground)(const struct carom_picture *picture, int32_t y, int32_t shade_q8);
};

static inline const struct carom_smooth *draw_smooth(const struct carom_paint *paint)
{
    return paint ? paint->smooth : NULL;
}

/* ---- shadow.c: the parts of faces that solids keep from the light */

struct carom_shadows {
    /* Call before the bodies of a picture are placed: gives all of them one scale. */
    void (*init)(const struct draw_source *source, struct draw_view *view);
    /* The largest distance behind a body's centre at which its shadow may fall, q16; 0 for no
     * shadow. */
    int64_t (*reach)(const struct draw_source *source, const struct draw_view *view,
                     uint32_t number, const struct carom_body_look *look);
    /*
     * List the shadows of all solids on a body. A solid whose outline does not fit into the scratch
     * memory casts none. Returns false if the list is full.
     */
    bool (*list)(const struct draw_source *source, const struct draw_view *view,
                 const struct draw_shades *shades, const struct draw_body *body, uint32_t number,
                 struct draw_list *list, void *scratch, size_t bytes);
};

/* The shadow functions of a paint; NULL without shadows. */
static inline const struct carom_shadows *draw_shadows(const struct draw_source *source)
{
    return source->paint ? source->paint->shadows : NULL;
}

/* ---- wire.c */

void draw_wire(const struct draw_source *source, struct draw_view *view,
               const struct carom_picture *picture, const struct draw_rect *part);
/* Draw a line between two places in the guard band, within the view's part. */
void draw_line(const struct draw_view *view, const struct carom_picture *picture,
               const struct draw_vertex *a, const struct draw_vertex *b, uint32_t colour);

/* ---- segment.c: lines of the world */

/* Project a line. Returns false if nothing of it is in the guard band. */
bool draw_segment(const struct draw_view *view, const carom_v3_q32 *from, const carom_v3_q32 *to,
                  struct draw_vertex ends[2]);
/* True if a point is in range as an end. */
bool draw_point_in_range(const carom_v3_q32 *point);
/* The corners of a line one pixel wide, counter-clockwise, a little nearer than the line. */
void draw_ribbon(const struct draw_vertex ends[2], struct draw_vertex corner[4]);
/* The pixels that a line may take, within the view's part; all zero if none. */
struct draw_rect draw_segment_rect(const struct draw_view *view, const struct draw_vertex ends[2]);

/* ---- rect.c: rectangles of a picture */

/*
 * From pixels counted from the view's middle to the picture's; the rectangle around two; true if a
 * rectangle is empty.
 */
struct carom_rect draw_on_picture(const struct draw_view *view, struct draw_rect r);
struct carom_rect draw_around(const struct carom_rect *a, const struct carom_rect *b);
bool draw_is_empty(const struct carom_rect *r);
/* Grow `touched`, which may be NULL, to hold a rectangle. */
void draw_touch(struct carom_rect *touched, struct carom_rect r);

/* ---- paint.c: what a paint changes */

/* Check a picture's paint. Returns CAROM_OK or the error that carom_draw returns. */
int draw_check_paint(const struct carom_picture *picture);
/* Set the view's light from the paint. */
void draw_paint_light(struct draw_view *view, const struct carom_paint *paint);
/* The ramp that a paint gives a body; 0: none. */
uint8_t draw_paint_ramp(const struct carom_paint *paint, uint32_t number);
/* Apply a paint, which may be NULL, to a body's ramps. */
void draw_paint_body(struct draw_coat *coat, const struct carom_paint *paint, uint32_t number);
/* Least product of two faces' normals, q30, at which they share shades. */
int32_t draw_crease(const struct carom_paint *paint);
/* The ramp of a face. */
uint32_t draw_face_ramp(const struct draw_coat *coat, const struct carom_paint *paint,
                        uint32_t face);
/* The number of ramps in a paint's palette. */
static inline uint32_t draw_ramps(const struct carom_paint *paint)
{
    return paint && paint->palette ? paint->ramps : DRAW_RAMPS;
}

/* ---- font.c */

#define DRAW_GLYPH_WIDTH 5
/* Indexed by character - 32; the last glyph is a box. */
extern const uint8_t draw_font[96][DRAW_GLYPH_WIDTH];

/* ---- palette.c */

static inline const uint32_t *draw_palette(const struct carom_picture *picture)
{
    return picture->paint && picture->paint->palette ? picture->paint->palette : carom_draw_palette;
}

/* A palette entry as a pixel of the picture, repeated over a whole word. */
uint32_t draw_colour(const struct carom_picture *picture, uint32_t index);
/* draw_colour with a format and a palette. */
uint32_t draw_entry(uint8_t format, const uint32_t *palette, uint32_t index);

/* ---- draw.c: a picture and its parts */

/* Check that a picture's size, pixels and paint can be drawn on. */
int draw_check_picture(const struct carom_picture *picture, enum carom_draw_style style);
/* Check everything but the camera. Returns what carom_draw returns. */
int draw_check(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style);

/* Draw a part of the picture, and nothing outside of it. */
int draw_part(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, enum carom_draw_style style,
              const struct draw_rect *part);

#endif

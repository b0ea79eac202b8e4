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

#include "../mesh/mesh.h"
#include "carom_draw.h"

#define DRAW_GUARD 1024

/*
 * DRAW_INLINE: some compilers would rather keep one copy for two callers. DRAW_OUT_OF_LINE: a copy
 * for pixel formats that a program does not use stays out of others' fast memory.
 */
#if defined __GNUC__
#define DRAW_INLINE      __attribute__((always_inline)) static inline
#define DRAW_OUT_OF_LINE __attribute__((noinline)) static
#else
#define DRAW_INLINE      static inline
#define DRAW_OUT_OF_LINE static
#endif

/* Ramps of a palette. HOT ramps are for interfering faces. */
#define DRAW_BACKGROUND     CAROM_RAMP_BACKGROUND
#define DRAW_STATIONARY     CAROM_RAMP_STATIONARY
#define DRAW_MOVING         CAROM_RAMP_MOVING
#define DRAW_STATIONARY_HOT CAROM_RAMP_STATIONARY_HOT
#define DRAW_MOVING_HOT     CAROM_RAMP_MOVING_HOT
#define DRAW_SHADES         CAROM_RAMP_SHADES
#define DRAW_RAMPS          8 /* of carom_draw_palette */

/* A rectangle of pixels; x1 and y1 are excluded. */
struct draw_rect {
    int32_t x0, y0, x1, y1;
};

/* ---- source.c: what is drawn */

struct draw_source {
    const struct carom_world *world;
    uint32_t count;                   /* bodies are numbered below this */
    const struct carom_face_ref *hot; /* interfering faces to show, ordered by body */
    int hot_count;
    const struct carom_paint *paint; /* or NULL */
};

void draw_source_init(struct draw_source *source, const struct carom_world *world,
                      const struct carom_paint *paint);

/* The mesh of a body; NULL if there is no such body. */
static inline const struct carom_mesh *draw_mesh(const struct draw_source *source, uint32_t number)
{
    return carom_body_mesh(source->world, (int)number);
}

/* Look up a body's present pose. Returns false if there is no such body. */
static inline bool draw_look(const struct draw_source *source, uint32_t number,
                             struct carom_body_look *look)
{
    return carom_body_look(source->world, (int)number, look) == CAROM_OK;
}

/* ---- view.c: from the world to the picture */

#define DRAW_SIDES 5

/* Pixels that the largest body surely covers: what is deeper than w there is hidden. */
struct draw_cover {
    uint32_t body;
    uint32_t radius2_q8; /* of a circle on the picture; 0: there is no cover */
    int32_t x_q4, y_q4;
    uint32_t w_q26;
    carom_v3_q30 axis; /* from the eye through the circle's middle, world axes */
    int32_t slope_q16; /* opening of the covered cone along the axis */
};

/* The camera, and the part of the picture being drawn. */
struct draw_view {
    carom_v3_q32 eye;
    carom_m3_q30 axes; /* rows: right, down and forward in the world */
    int64_t focal_q16; /* pixels */
    int32_t scale_q30; /* scale of view x and y; view z is shifted right by z_shift */
    int z_shift;
    int32_t horizon;       /* first row below the horizon, or one far outside the picture */
    int32_t middle[2];     /* the pixel from which pixels are counted; its column is even */
    int32_t round_q29[2];  /* offset from view to picture coordinates; 2^29 is the guard band */
    struct draw_rect rect; /* the part, counted from `middle` */
    carom_v3_q30 side[DRAW_SIDES]; /* planes through the eye around it: inward normals, world */
    struct draw_cover cover;
    carom_v3_q30 light; /* towards the light, world axes; as long as half the range of shades */
    uint32_t shade_q24; /* shade of a face across the light */
    int shift_least;    /* lower bound on bodies' `shift` */
    carom_v3_q30 sun;   /* towards the light, world axes, length 1 */
};

/* A body's ramps, with its paint if it has one. */
struct draw_coat {
    const uint8_t *faces; /* one for each face, 0: the body's own; or NULL */
    uint8_t own, hot;
};

/* The ramps of a body without paint. */
static inline struct draw_coat draw_usual_coat(bool moving)
{
    return (struct draw_coat){NULL, (uint8_t)(DRAW_STATIONARY + moving),
                              (uint8_t)(DRAW_STATIONARY_HOT + moving)};
}

/* A body as the camera sees it. */
struct draw_body {
    const struct carom_mesh *mesh;
    bool moving;
    int sees; /* 2 if all of the body lies inside the part, else 1 */
    int shift;
    int32_t near;                  /* view z of the near plane */
    int32_t eye[3];                /* from the mesh's centre of mass, mesh axes, q(22 - shift) */
    carom_v3_q30 side[DRAW_SIDES]; /* the view's planes, mesh axes */
    carom_v3_q30 cover;            /* the cover's axis, mesh axes */
    /* first palette entry of a body without paint, plus the view's shade; q24 */
    uint32_t ramp;
    carom_v3_q30 light; /* the view's light, mesh axes */
    struct draw_coat coat;
    const uint32_t *hot; /* set by flat.c: a bit a face, interfering; NULL: none, and no paint */
    /* view = (to_view (vertex << up) + origin) / 2^30 */
    carom_m3_q30 to_view;
    int64_t origin[3];
    int up, w_shift;
    int32_t round_q29[2]; /* the view's */
};

/*
 * A corner on the picture: y in the upper half, so that corners compare by height, and the row is
 * the upper 12 bits.
 */
struct draw_vertex {
    int32_t yx_q4;
    uint32_t w_q26;
};

static inline int32_t draw_x(int32_t yx_q4)
{
    return (int16_t)(yx_q4 & 0xffff);
}

static inline int32_t draw_y(int32_t yx_q4)
{
    return yx_q4 >> 16;
}

static inline int32_t draw_row(int32_t yx_q4)
{
    return yx_q4 >> 20;
}

/* Returns CAROM_OK, CAROM_ERR_ARGUMENT or CAROM_ERR_RANGE. */
int draw_view_init(struct draw_view *view, const struct carom_camera *camera, int32_t width,
                   int32_t height);
/* Choose the part of the picture to draw. */
void draw_view_rect(struct draw_view *view, struct draw_rect rect);

/* All of the picture, as a part. */
static inline struct draw_rect draw_whole(const struct draw_view *view,
                                          const struct carom_picture *picture)
{
    int32_t x0 = -view->middle[0], y0 = -view->middle[1];

    return (struct draw_rect){x0, y0, x0 + picture->width, y0 + picture->height};
}

/* Prepare a body for the view's part. Returns false if nothing of it can show there. */
bool draw_body_init(struct draw_body *body, const struct draw_view *view,
                    const struct carom_body_look *look);
/* draw_body_init for a body that need not show; leaves `sees` unset. */
void draw_body_place(struct draw_body *body, const struct draw_view *view,
                     const struct carom_body_look *look);
/*
 * Can a sphere, given from the centre of mass, show inside the part? 0: no. 1: perhaps. 2: all of
 * it does.
 */
int draw_sees_sphere(const struct draw_body *body, const carom_v3_q22 *centre, int32_t radius_q22);

/* Project a vertex of the mesh. Returns false if it is outside the guard band or too near. */
bool draw_vertex(const struct draw_body *body, uint32_t number, struct draw_vertex *vertex);

/* A vertex of the mesh in view coordinates: right, down, forward; each below 2^30 in size. */
void draw_place(const struct draw_body *body, uint32_t number, int32_t at[3]);

/*
 * Project a point in view coordinates; it must be inside the guard band and beyond the near plane.
 */
struct draw_vertex draw_project(const struct draw_body *body, const int32_t at[3]);

/* The extent of some vertices on the picture. */
struct draw_extent {
    int32_t low[2][2], high[2][2]; /* bounds of view x / z and y / z, each as two numbers */
    bool near;                     /* some vertex is too near: no bound */
};

void draw_extent_begin(struct draw_extent *extent);
void draw_extent_add(struct draw_extent *extent, const struct draw_body *body, uint32_t number);
/*
 * The extent with a pixel more on each side, within the view's part; empty if there are no
 * vertices.
 */
struct draw_rect draw_extent_end(const struct draw_extent *extent, const struct draw_view *view);

/* A body for points of the world that belong to no body; `shift` must be set. */
void draw_body_of_points(struct draw_body *body, const struct draw_view *view, int shift);

/* ---- clip.c: what the guard band leaves of faces and edges */

/*
 * Clip a face, or an edge as a polygon of two corners, given by its vertices.
 *   out  the remaining corners, on the picture; for an edge the first two count
 * Returns their number: a convex polygon gains at most one corner a plane.
 */
#define DRAW_CLIP_MAX 8
int draw_clip(const struct draw_body *body, const uint16_t *numbers, int n,
              struct draw_vertex out[DRAW_CLIP_MAX]);
/* draw_clip of corners in view coordinates; overwrites them with the remaining corners. */
int draw_clip_placed(const struct draw_body *body, int32_t polygon[DRAW_CLIP_MAX][3], int n,
                     struct draw_vertex out[DRAW_CLIP_MAX]);

/* Project a corner that clipping made, clamped to the guard band and near plane. */
struct draw_vertex draw_clipped_vertex(const struct draw_body *body, int32_t at[3]);

/*
 * A step of Sutherland and Hodgman: cut a convex polygon at one plane.
 *   inside  how far each corner is inside, up to a common factor; within +-2^32
 * Returns the number of remaining corners.
 */
int draw_cut(int32_t polygon[DRAW_CLIP_MAX][3], const int64_t inside[DRAW_CLIP_MAX], int n);

/* ---- divide.c: quotients for processors that cannot divide */

/* n / d by a table of inverses and products; n < 2^31, 0 < d < 2^16. */
uint32_t draw_quotient(uint32_t n, uint32_t d);

/* n / d for a signed n, by the quicker way. */
static inline int32_t draw_divide(int32_t n, int32_t d)
{
#if defined __arm__ && !defined __ARM_FEATURE_IDIV
    uint32_t size = (uint32_t)(n < 0 ? -n : n);
    int32_t quotient = (int32_t)draw_quotient(size, (uint32_t)d);

    return n < 0 ? -quotient : quotient;
#else
    return n / d;
#endif
}

/* ---- cover.c: what the largest body surely hides */

/* Set the view's cover to the ball inside a body, if there is such a body. */
void draw_cover_init(struct draw_view *view, const struct draw_source *source, uint32_t body);

/* True if some of a leaf may be covered. */
bool draw_may_cover(const struct draw_view *view, const struct draw_body *body,
                    const struct carom_leaf *leaf);

static inline bool draw_covers(const struct draw_cover *cover, const struct draw_vertex *vertex)
{
    /* both are within 1026 pixels of the middle: a sum below 2^32 */
    int32_t dx = draw_x(vertex->yx_q4) - cover->x_q4, dy = draw_y(vertex->yx_q4) - cover->y_q4;

    return (uint32_t)(dx * dx) + (uint32_t)(dy * dy) < cover->radius2_q8 &&
           vertex->w_q26 < cover->w_q26;
}

/* ---- flat.c: the faces that show, part by part */

/* Returns CAROM_OK or CAROM_ERR_MEMORY for a workspace that is too small. */
int draw_flat(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, struct draw_rect rect);

/* ---- smooth.c: shades from corner to corner */

struct draw_face;
struct draw_span;
struct draw_sweep;
struct draw_list;

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

/* ---- outline.c: a solid's outline, as the light sees it */

/* An edge of the outline. q: height along across[1]. p: place along across[0]. */
struct draw_outline_edge {
    int32_t at[2][3]; /* lower and upper end, view coordinates */
    int32_t p[2], q[2];
    int16_t up;         /* 1 if the lit side is on the left, -1 if on the right */
    uint16_t trapezoid; /* the last one with this edge on its left */
};

/* The area between two edges and two heights. */
struct draw_trapezoid {
    uint16_t left, right;
    int32_t low, high;
};

struct draw_outline {
    carom_v3_q30 across[2]; /* right and up as seen from the light; view coordinates */
    struct draw_outline_edge *edges;
    uint32_t edge_count;
    struct draw_trapezoid *trapezoids;
    uint32_t trapezoid_count;
    uint64_t *keys;   /* ends of edges, sorted by height */
    uint16_t *active; /* edges at the present height, and the place of each */
    int64_t *place;
};

/*
 * Find the outline of a placed solid and its trapezoids, in scratch memory aligned to 8.
 *   sun  towards the light, view coordinates
 * Returns false if there was not enough room.
 */
bool draw_outline_find(struct draw_outline *outline, const struct draw_body *body,
                       const int32_t sun[3], void *scratch, size_t bytes);
/* The point of an edge at a height. */
void draw_outline_point(const struct draw_outline *outline, uint32_t edge, int32_t q,
                        int32_t at[3]);
/* The place and height of a point across the light. */
void draw_outline_across(const struct draw_outline *outline, const int32_t at[3], int32_t pq[2]);

/* ---- shadow.c: the parts of faces that solids keep from the light */

struct draw_list;

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
};

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
 * bytes: some machines' video memory does not take that.
 */
#if defined __ARM_FEATURE_UNALIGNED || defined __i386__ || defined __x86_64__
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

/* ---- wire.c */

void draw_wire(const struct draw_source *source, struct draw_view *view,
               const struct carom_picture *picture, struct draw_rect part);
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
              struct draw_rect part);

#endif

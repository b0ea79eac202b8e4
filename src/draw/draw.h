/* SPDX-License-Identifier: MIT */
/*
 * draw - a picture of a world: camera, clipping, flat shading row by row, wireframe. What it sees of
 * the world source.c asks, as any program may.
 *
 * Four frames of reference:
 *
 *   world   q32
 *   mesh    relative to the eye along the mesh's axes, q22 shifted right by the body's `shift`, so
 *           that nothing that belongs to the body is longer than 2^29
 *   view    x right, y down, z forward, scaled so that the guard band is |x| <= z, |y| <= z
 *   picture pixels in q4 from the middle of the picture, y down; more exactly, x from the left side
 *           and y from 7/16 above the top side of the pixel `middle`, so that a
 *           corner at y is above the middle of row y >> 4, counted from that pixel, and of no
 *           row before
 *
 * The guard band is a square of DRAW_GUARD pixels either way of the middle of the picture. It holds
 * the largest picture, so that faces are clipped exactly only against it and the near plane; the
 * rows cut the rest at the edges of the picture.
 *
 * Depth is w_q26 = 1 / z: it is linear over the picture, larger is nearer, and it is 2^31 on the
 * near plane, 1/32 unit in front of the eye.
 *
 * FLAT works on a part of the picture, a rectangle, at a time: all of it when the workspace holds
 * all faces that show in it. They are listed by the row in which they begin. Then each row knows
 * its faces from left to right; where one alone covers a pixel no depth is looked at, and every
 * pixel is written about once.
 */
#ifndef CAROM_SRC_DRAW_H
#define CAROM_SRC_DRAW_H

#include "../mesh/mesh.h"
#include "carom_draw.h"

#define DRAW_GUARD 1024

/*
 * Some compilers would rather have one copy of what two callers share; and the copy that a program's pixels
 * do not need is to stay out of what others have in fast memory.
 */
#if defined __GNUC__
#define DRAW_INLINE      __attribute__((always_inline)) static inline
#define DRAW_OUT_OF_LINE __attribute__((noinline)) static
#else
#define DRAW_INLINE      static inline
#define DRAW_OUT_OF_LINE static
#endif

/* Ramps of a palette. Interfering faces are HOT. */
#define DRAW_BACKGROUND     CAROM_RAMP_BACKGROUND
#define DRAW_STATIONARY     CAROM_RAMP_STATIONARY
#define DRAW_MOVING         CAROM_RAMP_MOVING
#define DRAW_STATIONARY_HOT CAROM_RAMP_STATIONARY_HOT
#define DRAW_MOVING_HOT     CAROM_RAMP_MOVING_HOT
#define DRAW_SHADES         CAROM_RAMP_SHADES
#define DRAW_RAMPS          8 /* of carom_draw_palette */

/* A rectangle of pixels; x1 and y1 are outside. */
struct draw_rect {
    int32_t x0, y0, x1, y1;
};

/* ---- source.c: what is drawn */

struct draw_source {
    const struct carom_world *world;
    uint32_t count;                   /* numbers of bodies are below */
    const struct carom_face_ref *hot; /* interfering faces, by body; those that are to show */
    int hot_count;
    const struct carom_paint *paint; /* or NULL */
};

void draw_source_init(struct draw_source *source, const struct carom_world *world,
                      const struct carom_paint *paint);

/* The mesh of a body; NULL when there is none of this number. */
static inline const struct carom_mesh *draw_mesh(const struct draw_source *source, uint32_t number)
{
    return carom_body_mesh(source->world, (int)number);
}

/* A body as it is now; false when there is none of this number. */
static inline bool draw_look(const struct draw_source *source, uint32_t number,
                             struct carom_body_look *look)
{
    return carom_body_look(source->world, (int)number, look) == CAROM_OK;
}

/* ---- view.c: from the world to the picture */

#define DRAW_SIDES 5

/* Pixels that the largest body covers: what is further away than w there is hidden. */
struct draw_cover {
    uint32_t body;
    uint32_t radius2_q8; /* of a circle on the picture; 0: none */
    int32_t x_q4, y_q4;
    uint32_t w_q26;
    carom_v3_q30 axis; /* from the eye through its middle, in the world */
    int32_t slope_q16; /* how fast what is covered opens along that */
};

/* The camera, and the part of the picture that is being drawn. */
struct draw_view {
    carom_v3_q32 eye;
    carom_m3_q30 axes; /* rows: right, down and forward in the world */
    int64_t focal_q16; /* pixels */
    int32_t scale_q30; /* of view x and y; view z is shifted right by z_shift */
    int z_shift;
    int32_t horizon;       /* the first row that looks down, or one far outside of the picture */
    int32_t middle[2];     /* the pixel from which pixels are counted; in an even column */
    int32_t round_q29[2];  /* what makes picture coordinates of view ones; 2^29 the guard band */
    struct draw_rect rect; /* the part, counted from there */
    carom_v3_q30 side[DRAW_SIDES]; /* the planes through the eye around it; normals inward, world */
    struct draw_cover cover;
    carom_v3_q30 light; /* towards it, in the world; its length is half of what shades differ by */
    uint32_t shade_q24; /* of what is across it */
    int shift_least;    /* of bodies */
    carom_v3_q30 sun;   /* towards the light, of length 1 */
};

/* Ramps of a body, with its paint if it has one. */
struct draw_coat {
    const uint8_t *faces; /* of each face, 0: its own; or NULL */
    uint8_t own, hot;
};

/* The usual ones. */
static inline struct draw_coat draw_usual_coat(bool moving)
{
    return (struct draw_coat){NULL, (uint8_t)(DRAW_STATIONARY + moving),
                              (uint8_t)(DRAW_STATIONARY_HOT + moving)};
}

/* A body as the camera sees it. */
struct draw_body {
    const struct carom_mesh *mesh;
    bool moving;
    int sees; /* 2 when all of it lies inside of the part, else 1 */
    int shift;
    int32_t near;                  /* view z of the near plane */
    int32_t eye[3];                /* from the mesh's centre of mass; mesh axes, q(22 - shift) */
    carom_v3_q30 side[DRAW_SIDES]; /* the view's, in mesh axes */
    carom_v3_q30 cover;            /* its axis, in the same */
    uint32_t ramp;                 /* the first palette entry if it has no paint, and the view's
                                      shade; in q24 */
    carom_v3_q30 light;            /* the view's, in mesh axes */
    struct draw_coat coat;
    const uint32_t *
        hot; /* flat.c: a bit for each face, whether it interferes; there if there is a paint; or NULL */
    /* view = (to_view (vertex << up) + origin) / 2^30 */
    carom_m3_q30 to_view;
    int64_t origin[3];
    int up, w_shift;
    int32_t round_q29[2]; /* the view's */
};

/*
 * A corner on the picture. With y in the upper half, corners compare by height, and the row is the
 * upper 12 bits.
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

/* All of a picture. */
static inline struct draw_rect draw_whole(const struct draw_view *view,
                                          const struct carom_picture *picture)
{
    int32_t x0 = -view->middle[0], y0 = -view->middle[1];

    return (struct draw_rect){x0, y0, x0 + picture->width, y0 + picture->height};
}

/* Prepare a body for the view's part; false when nothing of it can show there. */
bool draw_body_init(struct draw_body *body, const struct draw_view *view,
                    const struct carom_body_look *look);
/* The same of a body that need not show there; without `sees`. */
void draw_body_place(struct draw_body *body, const struct draw_view *view,
                     const struct carom_body_look *look);
/*
 * Whether a sphere around a point, given about the centre of mass, may show inside the rect: 0, or
 * 1, or 2 when all of it does.
 */
int draw_sees_sphere(const struct draw_body *body, const carom_v3_q22 *centre, int32_t radius_q22);

/* A vertex of the mesh on the picture; false when it is outside of the guard band or too near. */
bool draw_vertex(const struct draw_body *body, uint32_t number, struct draw_vertex *vertex);

/* A vertex of the mesh in view coordinates: right, down, forward; each below 2^30 in size. */
void draw_place(const struct draw_body *body, uint32_t number, int32_t at[3]);

/* A point in view coordinates, inside of the guard band and beyond the near plane, on the picture. */
struct draw_vertex draw_project(const struct draw_body *body, const int32_t at[3]);

/* How far some vertices reach on the picture. */
struct draw_extent {
    int32_t low[2][2], high[2][2]; /* of view x / z and y / z, as two numbers */
    bool near;                     /* one of them is too near to say */
};

void draw_extent_begin(struct draw_extent *extent);
void draw_extent_add(struct draw_extent *extent, const struct draw_body *body, uint32_t number);
/* A pixel more on each side, within the view's part; nothing of no vertices. */
struct draw_rect draw_extent_end(const struct draw_extent *extent, const struct draw_view *view);

/* A body for points of the world that belong to none, with `shift` set. */
void draw_body_of_points(struct draw_body *body, const struct draw_view *view, int shift);

/* ---- clip.c: what is left of faces and edges in the guard band */

/*
 * Clip a face, or an edge as a polygon of two corners, given by its vertices.
 *   out  what is left, on the picture; of an edge, the first two
 * Returns their number: a triangle gains at most one corner a plane.
 */
#define DRAW_CLIP_MAX 8
int draw_clip(const struct draw_body *body, const uint16_t *numbers, int n,
              struct draw_vertex out[DRAW_CLIP_MAX]);
/* The same of corners in view coordinates; these are overwritten, with those of what is left. */
int draw_clip_placed(const struct draw_body *body, int32_t polygon[DRAW_CLIP_MAX][3], int n,
                     struct draw_vertex out[DRAW_CLIP_MAX]);

/* A corner of what is left, cut again perhaps, on the picture. */
struct draw_vertex draw_clipped_vertex(const struct draw_body *body, int32_t at[3]);

/*
 * Sutherland and Hodgman's step: the part of a convex polygon inside one plane.
 *   inside  how far each corner is inside of it, up to a factor; within +-2^32
 * Returns the number of corners that are left.
 */
int draw_cut(int32_t polygon[DRAW_CLIP_MAX][3], const int64_t inside[DRAW_CLIP_MAX], int n);

/* ---- divide.c: quotients for processors that cannot divide */

/* n / d by a table of inverses and products; n < 2^31, 0 < d < 2^16. */
uint32_t draw_quotient(uint32_t n, uint32_t d);

/* The same, of a signed n, by what is quicker. */
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

/* ---- cover.c: what a body surely hides */

/* Set the view's cover, which is in a body, if there is one of this number. */
void draw_cover_init(struct draw_view *view, const struct draw_source *source, uint32_t body);

/* Whether some of a leaf may be covered. */
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

/* Where a pass over the bodies is. */
struct draw_shades {
    const struct draw_body *body;
    uint16_t *at; /* at its vertices, q8 and 1 more; 0: not known yet. NULL: faces have one shade */
    int32_t crease_q30; /* faces share a shade if their normals' product is no less */
    uint32_t shade_q24; /* the view's */
};
#define DRAW_SHADES_MANY 0xffffu /* a vertex has more than one */

struct carom_smooth {
    /* List a face of which the corners are in these places of the list. There must be room for two faces. */
    void (*list)(const struct draw_shades *shades, uint32_t face, const struct draw_rect *rect,
                 struct draw_list *list, const uint32_t place[3], uint32_t colour, bool inside);
    /* List what the guard band leaves of a face. */
    void (*list_clipped)(const struct draw_shades *shades, uint32_t face,
                         const struct draw_rect *rect, struct draw_list *list, uint32_t colour);
    /* The shades of a face's corners; and those of places on the face, in view coordinates. */
    void (*corners)(const struct draw_shades *shades, uint32_t face, int32_t shade_q8[3]);
    void (*between)(const struct draw_shades *shades, uint32_t face, int32_t (*at)[3], int n,
                    int32_t *shade_q8);
    /*
     * Give the face that was listed last, or the one before with its plane, the shades of the plane's corners; a tint is
     * listed where there is more than one.
     */
    void (*tint)(struct draw_list *list, struct draw_face *face, const int32_t shade_q8[3]);
    /* The pixels of a row up to x1, and those of a run of a span with a tint. */
    void (*row)(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1);
    void (*run)(const struct draw_sweep *s, const struct draw_span *span, int32_t from, int32_t to);
    /* A shade of the background as the pixels of a row. */
    uint32_t (*ground)(const struct carom_picture *picture, int32_t y, int32_t shade_q8);
};

static inline const struct carom_smooth *draw_smooth(const struct carom_paint *paint)
{
    return paint ? paint->smooth : NULL;
}

/* ---- outline.c: what the light sees of a solid */

/* An edge of the outline. Heights are along across[1], q, and p along across[0] is how far right it is. */
struct draw_outline_edge {
    int32_t at[2][3]; /* its lower and its upper end, view coordinates */
    int32_t p[2], q[2];
    int32_t up; /* 1; -1 when what is lit is on its right */
};

/* Between two edges and two heights. */
struct draw_trapezoid {
    uint16_t left, right;
    int32_t low, high;
};

struct draw_outline {
    carom_v3_q30 across[2]; /* seen from the light, right and up; view coordinates */
    struct draw_outline_edge *edges;
    uint32_t edge_count;
    struct draw_trapezoid *trapezoids;
    uint32_t trapezoid_count;
    uint64_t *keys;   /* ends of edges, by height */
    uint16_t *active; /* edges at the height at hand, and how far right each of them is */
    int64_t *place;
};

/*
 * The outline of a placed solid and the trapezoids that it holds, in scratch memory that is aligned to 8.
 *   sun  towards the light, view coordinates
 * Returns whether there was room.
 */
bool draw_outline_find(struct draw_outline *outline, const struct draw_body *body,
                       const int32_t sun[3], void *scratch, size_t bytes);
/* A point of an edge at a height. */
void draw_outline_point(const struct draw_outline *outline, uint32_t edge, int32_t q,
                        int32_t at[3]);
/* How far right and up a point is. */
void draw_outline_across(const struct draw_outline *outline, const int32_t at[3], int32_t pq[2]);

/* ---- shadow.c: the parts of faces that solids keep the light from */

struct draw_list;

struct carom_shadows {
    /* Before bodies of a picture are placed: all have one scale then. */
    void (*init)(const struct draw_source *source, struct draw_view *view);
    /* How far behind the centre of a body its shadow may fall on others: q16; 0 for none. */
    int64_t (*reach)(const struct draw_source *source, const struct draw_view *view,
                     uint32_t number, const struct carom_body_look *look);
    /*
     * List the shadows of all solids on a body. One of which the outline does not fit into the scratch memory has
     * none. False when there is no room in the list.
     */
    bool (*list)(const struct draw_source *source, const struct draw_view *view,
                 const struct draw_shades *shades, const struct draw_body *body, uint32_t number,
                 struct draw_list *list, void *scratch, size_t bytes);
};

/* NULL without shadows. */
static inline const struct carom_shadows *draw_shadows(const struct draw_source *source)
{
    return source->paint ? source->paint->shadows : NULL;
}

/* ---- scanline.c: their pixels, row by row */

/* A triangle on the picture. It begins with its top corner and runs counter-clockwise. */
struct draw_face {
    uint16_t corner[3]; /* into the vertices */
    uint16_t next;      /* in its row's list: 1 + where it is, 0 at the end */
    uint16_t colour;    /* palette entry, and DRAW_DECAL */
};

/*
 * A decal lies on another face: its depth is that of the face listed after it, which is in no row. So both agree on
 * their depth to the last bit, whatever their corners are rounded to.
 */
#define DRAW_DECAL  0x8000u
#define DRAW_TINT   0x4000u /* it has a shade of its own at each pixel: draw_tint */
#define DRAW_COLOUR 0x1fffu /* palettes have at most 256 ramps of 32 */

/* The face that gives a face its depth. Faces are listed downward. */
static inline const struct draw_face *draw_plane(const struct draw_face *face)
{
    return face->colour & DRAW_DECAL ? face - 1 : face;
}

/*
 * The shades of a face over the picture, listed after the face and its plane in the place of another one: at the plane's
 * top corner, and what a pixel to the right and one below add. A shade is 256, from 0 to one less than all are.
 */
struct draw_tint {
    uint16_t at_q8, right_q16[2], below_q16[2]; /* upper and lower half */
};
_Static_assert(sizeof(struct draw_tint) == sizeof(struct draw_face),
               "it takes the place of a face");

static inline const struct draw_tint *draw_tint(const struct draw_face *face)
{
    return (const struct draw_tint *)(const void *)(draw_plane(face) - 1);
}

/*
 * What shows in a part of the picture: vertices from one end of the workspace, faces from the
 * other, the last one first. What is between them is for the rows.
 */
struct draw_list {
    uint16_t *rows; /* heads of lists of faces, by the row of the part in which they begin */
    struct draw_vertex *vertices;
    struct draw_face *faces;           /* face i is faces[-i]; there is no face 0 or vertex 0 */
    uint32_t vertex_count, face_count; /* with these two */
    size_t room;                       /* bytes between */
};

/* Draw the part. False when there is too little room for one of its rows, unless it must be. */
bool draw_rows(const struct draw_view *view, const struct draw_list *list,
               const struct carom_picture *picture, bool must);

/* ---- depth.c: where faces cover each other */

/* A face in the row at hand. */
struct draw_span {
    int32_t x_q15[2], step_q15[2]; /* left and right, so that x >> 15 is the first pixel; a row */
    int32_t until;                 /* the row in which an edge has ended */
    int32_t rest;   /* rows after that: > 0 with a new left edge, < 0 with a new right one */
    uint32_t pixel; /* its colour, over a whole word */
    const struct draw_face *face;
    uint32_t w_low, w_high; /* of its corners; 0 until they are needed */
    struct draw_span *next; /* of those that begin, or of those that are free */
};

#define DRAW_UNDER_MAX 64

/* A row of which the pixels before x are done. */
struct draw_sweep {
    const struct draw_view *view;
    const struct draw_vertex *vertices;
    uint8_t *row; /* its pixel 0 */
    int32_t safe; /* a run that ends here may write 3 pixels more */
    int pixel_shift;
    const struct carom_smooth *smooth; /* or NULL */
    const uint32_t *palette;
    uint8_t format;
    int32_t y, x;
    uint32_t ground;       /* the background */
    struct draw_span *top; /* what shows from x on; NULL: not known, or nothing */
    int32_t end;           /* where it ends */
    int32_t gate;          /* a span that begins here or later meets no other */
    uint32_t under_high;   /* the least depth of the others, w_q26 */
    int under_count;
    struct draw_span *under[DRAW_UNDER_MAX]; /* others that may show later */
};

/* The least and the most of a face's depth, when they are needed first. */
void draw_depths(const struct draw_sweep *s, struct draw_span *span);

/* Whether the top span is in front of all of another one, which can wait until it ends. */
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

/* Whether a span is in front of all others, as far as is known. */
static inline bool draw_shows(const struct draw_sweep *s, const struct draw_span *span)
{
    return span->w_low > s->under_high;
}

/* Go on to pixel `to`. */
void draw_advance(struct draw_sweep *s, int32_t to);
/* Take in a span of which the first pixel is not before x. */
void draw_overlap(struct draw_sweep *s, struct draw_span *span);

/* ---- pixels.c: runs of pixels in memory */

/*
 * Stores of 2 and 4 bytes into memory of any type. Where the processor takes words at odd places they
 * may lie there; where it does not, a compiler would make four byte stores of one, so that runs are
 * written by what their ends allow. Pixels of two bytes or four are never written by the byte: the
 * video memory of some machines does not take that.
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
typedef uint32_t draw_pixel4 __attribute__((may_alias)); /* a pixel of 4 bytes, in its place */
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

/* A pixel is 2^shift bytes; half a byte, the left one in its upper half, when that is -1. */
int draw_pixel_shift(uint8_t format);

/* Where pixel x of a row is, or the byte that it is in. */
static inline uint8_t *draw_pixel(uint8_t *row, int pixel_shift, int32_t x)
{
    return row + (pixel_shift < 0 ? x >> 1 : x * (1 << pixel_shift));
}

/*
 * Pixel 0 of row y, both counted from the middle of the picture. Called once for each row of the view's
 * part, when the row before it is complete: a display that is sent rows hears of them here.
 */
uint8_t *draw_pixels(const struct draw_view *view, const struct carom_picture *picture, int32_t y);

/* Pixels from <= x < to of a row in one colour, and no others. */
void draw_run(uint8_t *row, int pixel_shift, int32_t from, int32_t to, uint32_t pixel);

/* The background of row y of the view's part. */
uint32_t draw_ground(const struct draw_view *view, const struct carom_picture *picture, int32_t y);

/* ---- wire.c */

void draw_wire(const struct draw_source *source, struct draw_view *view,
               const struct carom_picture *picture, struct draw_rect part);
/* A line between two places in the guard band, within the view's part. */
void draw_line(const struct draw_view *view, const struct carom_picture *picture,
               const struct draw_vertex *a, const struct draw_vertex *b, uint32_t colour);

/* ---- segment.c: lines of the world */

/* A line on the picture. Returns whether anything of it is in the guard band. */
bool draw_segment(const struct draw_view *view, const carom_v3_q32 *from, const carom_v3_q32 *to,
                  struct draw_vertex ends[2]);
/* Whether a point may be an end. */
bool draw_point_in_range(const carom_v3_q32 *point);
/* The corners of a line that is one pixel wide, counter-clockwise, a little nearer than it is. */
void draw_ribbon(const struct draw_vertex ends[2], struct draw_vertex corner[4]);
/* The pixels that a line may take, within the view's part; none: all zero. */
struct draw_rect draw_segment_rect(const struct draw_view *view, const struct draw_vertex ends[2]);

/* ---- rect.c: rectangles of a picture */

/* Pixels of a picture from those counted from the middle; around two; whether there are none. */
struct carom_rect draw_on_picture(const struct draw_view *view, struct draw_rect r);
struct carom_rect draw_around(const struct carom_rect *a, const struct carom_rect *b);
bool draw_is_empty(const struct carom_rect *r);
/* Let what is touched, which may be NULL, hold those of a rectangle, too. */
void draw_touch(struct carom_rect *touched, struct carom_rect r);

/* ---- paint.c: what is drawn otherwise than usual */

/* Whether the paint of a picture can be used: CAROM_OK, or what carom_draw returns. */
int draw_check_paint(const struct carom_picture *picture);
/* The light of the paint. */
void draw_paint_light(struct draw_view *view, const struct carom_paint *paint);
/* The ramp that paint gives a body; 0: none. */
uint8_t draw_paint_ramp(const struct carom_paint *paint, uint32_t number);
/* Put paint, which may be NULL, over the usual ramps of a body. */
void draw_paint_body(struct draw_coat *coat, const struct carom_paint *paint, uint32_t number);
/* Faces whose normals have at least this product share shades: q30. */
int32_t draw_crease(const struct carom_paint *paint);
/* The ramp of a face. */
uint32_t draw_face_ramp(const struct draw_coat *coat, const struct carom_paint *paint,
                        uint32_t face);
/* Ramps of a paint's palette. */
static inline uint32_t draw_ramps(const struct carom_paint *paint)
{
    return paint && paint->palette ? paint->ramps : DRAW_RAMPS;
}

/* ---- font.c */

#define DRAW_GLYPH_WIDTH 5
/* By character from 32 on; the last is a box. */
extern const uint8_t draw_font[96][DRAW_GLYPH_WIDTH];

/* ---- palette.c */

static inline const uint32_t *draw_palette(const struct carom_picture *picture)
{
    return picture->paint && picture->paint->palette ? picture->paint->palette : carom_draw_palette;
}

/* A palette entry as a pixel of the picture, over a whole word as often as it fits. */
uint32_t draw_colour(const struct carom_picture *picture, uint32_t index);
/* The same of a format and a palette that are at hand. */
uint32_t draw_entry(uint8_t format, const uint32_t *palette, uint32_t index);

/* ---- draw.c: a picture and its parts */

/* Whether a picture's size, pixels and paint are such that it can be drawn on. */
int draw_check_picture(const struct carom_picture *picture, enum carom_draw_style style);
/* Whether a picture can be drawn, but for the camera. Returns what carom_draw does. */
int draw_check(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style);

/* Draw a part of the picture; nothing outside of it changes. */
int draw_part(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, enum carom_draw_style style,
              struct draw_rect part);

#endif

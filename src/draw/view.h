/* SPDX-License-Identifier: MIT */
/* view - what is drawn, and how it is seen: source, camera, clipping, cover. draw.h says more. */
#ifndef CAROM_SRC_DRAW_VIEW_H
#define CAROM_SRC_DRAW_VIEW_H

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

/* Project a corner that clipping made. */
struct draw_vertex draw_clipped_vertex(const struct draw_body *body, const int32_t at[3]);

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

#endif

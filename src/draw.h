/* SPDX-License-Identifier: MIT */
/*
 * draw - a picture of a world: camera, clipping, flat shading with a depth buffer, wireframe.
 *
 * Four frames of reference:
 *
 *   world   q32
 *   mesh    relative to the eye along the mesh's axes, q22 shifted right by the body's `shift`, so
 *           that nothing that belongs to the body is longer than 2^29
 *   view    x right, y down, z forward, scaled so that the guard band is |x| <= z, |y| <= z
 *   picture pixels in q4, y down
 *
 * The guard band is a square of DRAW_GUARD pixels either way of the middle of the picture. It holds
 * the largest picture, so that faces are clipped exactly only against it and the near plane; the
 * scan cuts the rest at the edges of the picture.
 *
 * Depth is w_q26 = 1 / z: it is linear over the picture, larger is nearer, and it is 2^31 on the
 * near plane, 1/32 unit in front of the eye.
 */
#ifndef CAROM_SRC_DRAW_H
#define CAROM_SRC_DRAW_H

#include "carom.h"
#include "scan.h"

#define DRAW_GUARD 1024

/* Ramps of carom_draw_palette, in its order. Interfering faces are HOT. */
enum draw_ramp {
    DRAW_BACKGROUND, /* from the top of the picture to the bottom */
    DRAW_STATIONARY, /* from shadow to light */
    DRAW_MOVING,
    DRAW_STATIONARY_HOT,
    DRAW_MOVING_HOT,
    DRAW_RAMPS
};
#define DRAW_SHADES 32

/* ---- draw_view.c: from the world to the picture */

#define DRAW_SIDES 5

/* The camera, and the part of the picture that is being drawn. */
struct draw_view {
    carom_v3_q32 eye;
    carom_m3_q30 axes; /* rows: right, down and forward in the world */
    int64_t focal_q16; /* pixels */
    int32_t scale_q30; /* of view x and y; view z is shifted right by z_shift */
    int z_shift;
    int32_t middle_q4[2];          /* of the picture */
    struct scan_rect rect;         /* the band of rows being drawn */
    carom_v3_q30 side[DRAW_SIDES]; /* the planes through the eye around it; normals inward, world */
};

/* A body as the camera sees it. */
struct draw_body {
    const struct draw_view *view;
    const struct carom_mesh *mesh;
    bool moving;
    int shift;
    int32_t near;                  /* view z of the near plane */
    int32_t eye[3];                /* from the mesh's centre of mass; mesh axes, q(22 - shift) */
    carom_m3_q30 to_view;          /* from mesh to view coordinates */
    carom_v3_q30 side[DRAW_SIDES]; /* the view's, in mesh axes */
    carom_v3_q30 light;            /* towards the light, in mesh axes */
};

/* A corner of a face on its way to the picture. */
struct draw_corner {
    int32_t at[3];    /* mesh coordinates, then view coordinates */
    uint32_t out;     /* bits: what it is outside of */
    int32_t xy_q4[2]; /* valid when no bit of DRAW_OUT_CLIP is set */
    uint32_t w_q26;   /* the same */
};

#define DRAW_OUT_CLIP                                                                              \
    0x1fu /* near plane and guard band; the bits above are the sides of the rect */

/* Returns CAROM_OK, CAROM_ERR_ARGUMENT or CAROM_ERR_RANGE. */
int draw_view_init(struct draw_view *view, const struct carom_camera *camera, int32_t width,
                   int32_t height);
/* Choose the part of the picture to draw. */
void draw_view_rect(struct draw_view *view, struct scan_rect rect);

void draw_body_init(struct draw_body *body, const struct draw_view *view,
                    const struct carom_mesh *mesh, const struct carom_body_state *state);
/* Whether a sphere around a point, given about the centre of mass, may show inside the rect. */
bool draw_sees_sphere(const struct draw_body *body, const carom_v3_q22 *centre, int32_t radius_q22);

/* A vertex in mesh coordinates, and from there to the view and the picture. */
void draw_corner_place(const struct draw_body *body, uint32_t vertex, struct draw_corner *corner);
void draw_corner_project(const struct draw_body *body, struct draw_corner *corner);

/*
 * Clip a face or an edge that has a corner with a bit of DRAW_OUT_CLIP, and project what is new.
 *   polygon  in: 3 corners; out: up to SCAN_MAX, none of them with such a bit
 * Returns the number of corners; for a line, whether anything is left.
 */
int draw_clip_face(const struct draw_body *body, struct draw_corner polygon[SCAN_MAX]);
bool draw_clip_line(const struct draw_body *body, struct draw_corner line[2]);

/* ---- draw_raster.c: pixels */

struct draw_canvas {
    const struct carom_picture *picture;
    struct scan_rect rect; /* the band of rows being drawn, over the full width */
    uint32_t *depth;       /* w_q26 of the band's pixels, row by row; NULL for wireframe */
};

/* The background, and depth at infinity. */
void draw_clear(const struct draw_canvas *canvas);
/* Both take projected corners. A triangle that does not run counter-clockwise draws nothing. */
void draw_triangle(const struct draw_canvas *canvas, const struct draw_corner *a,
                   const struct draw_corner *b, const struct draw_corner *c, uint32_t colour);
void draw_line(const struct draw_canvas *canvas, const struct draw_corner *a,
               const struct draw_corner *b, uint32_t colour);

/* ---- draw_palette.c */

/* A palette entry as a pixel of the format. */
uint32_t draw_colour(uint8_t format, uint32_t index);

#endif

/* SPDX-License-Identifier: MIT */
#include "draw.h"
#include "body.h"
#include "mesh.h"

#define CAMERA_LIMIT_Q32 ((int64_t)1 << (14 + 32))
#define FOCAL_MIN_Q16    (1 << 12)
#define FOCAL_MAX_Q16    (1 << 20)
#define NEAR_BITS        5 /* the near plane is 2^-5 units in front of the eye */

/* Towards the light: (-6, -2, 3) / 7, low from the left, so that a landscape shows its relief. */
static const carom_v3_q30 light = {{-920350135, -306783378, 460175067}};

/* Bits of draw_corner.out. */
enum {
    OUT_NEAR = 1,
    OUT_GUARD_LEFT = 2,
    OUT_GUARD_RIGHT = 4,
    OUT_GUARD_TOP = 8,
    OUT_GUARD_BOTTOM = 16,
    OUT_LEFT = 32,
    OUT_RIGHT = 64,
    OUT_TOP = 128,
    OUT_BOTTOM = 256
};

/* Right, down and forward, unit vectors. Looking straight up or down, right is the world's x. */
static bool camera_axes(carom_m3_q30 *axes, const struct carom_camera *camera)
{
    carom_v3_q30 right = {{CAROM_ONE_Q30, 0, 0}}, forward;
    int64_t ahead[3], level[3];

    for (int k = 0; k < 3; k++) {
        ahead[k] = camera->target.c[k] - camera->eye.c[k];
    }
    if (!fix_normalise(&forward, ahead)) {
        return false;
    }
    level[0] = ahead[1];
    level[1] = -ahead[0];
    level[2] = 0;
    fix_normalise(&right, level);
    memcpy(axes->c[0], right.c, sizeof right.c);
    carom_cross(axes->c[1], forward.c, right.c, 30);
    memcpy(axes->c[2], forward.c, sizeof forward.c);
    return true;
}

int draw_view_init(struct draw_view *view, const struct carom_camera *camera, int32_t width,
                   int32_t height)
{
    for (int k = 0; k < 3; k++) {
        if (camera->eye.c[k] < -CAMERA_LIMIT_Q32 || camera->eye.c[k] > CAMERA_LIMIT_Q32 ||
            camera->target.c[k] < -CAMERA_LIMIT_Q32 || camera->target.c[k] > CAMERA_LIMIT_Q32) {
            return CAROM_ERR_RANGE;
        }
    }
    if (camera->focal_q16 < FOCAL_MIN_Q16 || camera->focal_q16 > FOCAL_MAX_Q16 ||
        !camera_axes(&view->axes, camera)) {
        return CAROM_ERR_ARGUMENT;
    }
    view->eye = camera->eye;
    view->middle_q4[0] = width * 8;
    view->middle_q4[1] = height * 8;
    /*
     * x : z must become (focal / DRAW_GUARD) x : z. A power of two taken off z keeps the factor of
     * x at most 1, so that no coordinate grows. focal <= 2^15 pixels, so z_shift <= 5.
     */
    view->focal_q16 = (int64_t)camera->focal_q16 * height;
    view->z_shift = 0;
    while (view->focal_q16 >> view->z_shift > (int64_t)DRAW_GUARD << 16) {
        view->z_shift++;
    }
    view->scale_q30 = (int32_t)(view->focal_q16 * ((int64_t)1 << 14) / DRAW_GUARD >> view->z_shift);
    return CAROM_OK;
}

void draw_view_rect(struct draw_view *view, struct scan_rect rect)
{
    const int32_t edge_q4[2][2] = {
        {rect.x0 * 16 - view->middle_q4[0], rect.x1 * 16 - view->middle_q4[0]},
        {rect.y0 * 16 - view->middle_q4[1], rect.y1 * 16 - view->middle_q4[1]}};

    view->rect = rect;
    memcpy(view->side[4].c, view->axes.c[2], sizeof view->side[4].c);
    for (int s = 0; s < 4; s++) {
        /* Inside of a low edge e is focal x - e z >= 0; of a high edge the negative. */
        int64_t sign = s & 1 ? -1 : 1;
        int64_t v[3] = {0, 0, -sign * edge_q4[s >> 1][s & 1] * (1 << 12)};
        carom_v3_q30 plane;

        v[s >> 1] = sign * view->focal_q16;
        fix_normalise(&plane, v);
        carom_rotate_back(view->side[s].c, &view->axes, plane.c);
    }
}

/* The eye in mesh axes, and how far q22 must be shifted so that the body stays below 2^29. */
static void place_eye(struct draw_body *body, const carom_m3_q30 *r, const carom_v3_q32 *position)
{
    int64_t eye[3];
    uint64_t reach = (uint64_t)body->mesh->radius_q22;

    for (int k = 0; k < 3; k++) {
        eye[k] = body->view->eye.c[k] - position->c[k];
    }
    fix_rotate_back(eye, r, eye);
    for (int k = 0; k < 3; k++) {
        eye[k] = carom_round(eye[k], 32 - 22);
        reach += (uint64_t)carom_abs(eye[k]);
    }
    body->shift = 0;
    while (reach >> body->shift >> 29) {
        body->shift++;
    }
    /* |eye| <= 2^14 and |position| <= 2^12 units, so reach < 2^16 units: 38 bits. */
    CAROM_ASSERT(body->shift <= 9);
    for (int k = 0; k < 3; k++) {
        body->eye[k] = (int32_t)(eye[k] >> body->shift);
    }
}

void draw_body_init(struct draw_body *body, const struct draw_view *view,
                    const struct carom_mesh *mesh, const struct carom_body_state *state)
{
    carom_m3_q30 r;

    body->view = view;
    body->mesh = mesh;
    body_matrix(&r, &state->rotation);
    place_eye(body, &r, &state->position);
    /* shift <= 9 and z_shift <= 5, so this is at least 2^3 */
    body->near = 1 << (22 - NEAR_BITS - body->shift - view->z_shift);
    for (int k = 0; k < 3; k++) {
        carom_rotate_back(body->to_view.c[k], &r, view->axes.c[k]);
    }
    for (int k = 0; k < 3; k++) {
        body->to_view.c[0][k] = carom_mul_q30(body->to_view.c[0][k], view->scale_q30);
        body->to_view.c[1][k] = carom_mul_q30(body->to_view.c[1][k], view->scale_q30);
        body->to_view.c[2][k] >>= view->z_shift;
    }
    for (int s = 0; s < DRAW_SIDES; s++) {
        carom_rotate_back(body->side[s].c, &r, view->side[s].c);
    }
    carom_rotate_back(body->light.c, &r, light.c);
}

bool draw_sees_sphere(const struct draw_body *body, const carom_v3_q22 *centre, int32_t radius_q22)
{
    int64_t radius = (radius_q22 >> body->shift) + 2; /* rounded up, with room for both roundings */
    int32_t at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = (centre->c[k] >> body->shift) - body->eye[k];
    }
    for (int s = 0; s < DRAW_SIDES; s++) {
        if (carom_dot(body->side[s].c, at) < -radius * CAROM_ONE_Q30) {
            return false;
        }
    }
    return true;
}

void draw_corner_place(const struct draw_body *body, uint32_t vertex, struct draw_corner *corner)
{
    carom_v3_q22 p = mesh_vertex(body->mesh, vertex);

    for (int k = 0; k < 3; k++) {
        corner->at[k] = (p.c[k] >> body->shift) - body->eye[k];
    }
}

/*
 * How far inside of a plane of DRAW_OUT_CLIP, given by its bit, up to a factor; |result| <= 2^30.
 */
static int32_t clip_distance(const struct draw_body *body, const int32_t at[3], uint32_t plane)
{
    switch (plane) {
    case OUT_NEAR:
        return at[2] - body->near;
    case OUT_GUARD_LEFT:
        return at[2] + at[0];
    case OUT_GUARD_RIGHT:
        return at[2] - at[0];
    case OUT_GUARD_TOP:
        return at[2] + at[1];
    default:
        return at[2] - at[1];
    }
}

/*
 * To the picture, from inside the guard band and beyond the near plane.
 *
 * 2^3 <= z < 2^29, so 2^33 < 2^62 / z <= 2^59; |x|, |y| <= z, so the products are at most 2^62 and
 * the quotients 2^14 sixteenths of a pixel, DRAW_GUARD. On the near plane z is
 * 2^(22 - NEAR_BITS - shift - z_shift), which makes w_q26 2^31.
 */
static void project_inside(const struct draw_body *body, struct draw_corner *corner)
{
    const struct draw_view *view = body->view;
    const struct scan_rect *rect = &view->rect;
    int64_t inverse_q62 = ((int64_t)1 << 62) / corner->at[2];
    int32_t x_q4 = view->middle_q4[0] + (int32_t)carom_round(corner->at[0] * inverse_q62, 48);
    int32_t y_q4 = view->middle_q4[1] + (int32_t)carom_round(corner->at[1] * inverse_q62, 48);

    corner->xy_q4[0] = x_q4;
    corner->xy_q4[1] = y_q4;
    corner->w_q26 = (uint32_t)(inverse_q62 >> (14 + body->shift + view->z_shift));
    corner->out = (x_q4 < rect->x0 * 16 ? OUT_LEFT : 0u) | (x_q4 > rect->x1 * 16 ? OUT_RIGHT : 0u) |
                  (y_q4 < rect->y0 * 16 ? OUT_TOP : 0u) | (y_q4 > rect->y1 * 16 ? OUT_BOTTOM : 0u);
}

void draw_corner_project(const struct draw_body *body, struct draw_corner *corner)
{
    int32_t x, y, z;

    carom_rotate(corner->at, &body->to_view, corner->at);
    x = corner->at[0];
    y = corner->at[1];
    z = corner->at[2];
    corner->out = (z < body->near ? OUT_NEAR : 0u) | (x < -z ? OUT_GUARD_LEFT : 0u) |
                  (x > z ? OUT_GUARD_RIGHT : 0u) | (y < -z ? OUT_GUARD_TOP : 0u) |
                  (y > z ? OUT_GUARD_BOTTOM : 0u);
    if (corner->out == 0) {
        project_inside(body, corner);
    }
}

/*
 * Where an edge crosses a plane. Always computed from the inner end, so that two faces get the same
 * point of the edge that they share.
 */
static void cross_plane(int32_t out[3], const int32_t inner[3], const int32_t outer[3],
                        int32_t d_inner, int32_t d_outer)
{
    /*
     * d_inner >= 0 > d_outer, both at most 2^30: the fraction is below 1 and the product below 2^61
     */
    int64_t t_q30 = (int64_t)d_inner * CAROM_ONE_Q30 / ((int64_t)d_inner - d_outer);

    for (int k = 0; k < 3; k++) {
        out[k] = inner[k] + (int32_t)carom_round(((int64_t)outer[k] - inner[k]) * t_q30, 30);
    }
}

/* Project a corner that clipping made: rounding may have left it a hair outside. */
static void project_clipped(const struct draw_body *body, struct draw_corner *corner)
{
    int32_t *at = corner->at;
    int32_t short_of = clip_distance(body, at, OUT_NEAR);

    if (short_of < 0) {
        at[2] -= short_of;
    }
    for (int k = 0; k < 2; k++) {
        if (at[k] > at[2]) {
            at[k] = at[2];
        } else if (at[k] < -at[2]) {
            at[k] = -at[2];
        }
    }
    project_inside(body, corner);
}

/* Sutherland and Hodgman's step: the part of a convex polygon inside one plane. */
static int clip_plane(const struct draw_body *body, struct draw_corner polygon[SCAN_MAX], int n,
                      uint32_t plane)
{
    struct draw_corner kept[SCAN_MAX];
    int m = 0;

    for (int i = 0; i < n; i++) {
        const int32_t *a = polygon[i].at;
        const int32_t *b = polygon[i + 1 < n ? i + 1 : 0].at;
        int32_t da = clip_distance(body, a, plane), db = clip_distance(body, b, plane);

        /* A triangle gains at most one corner a plane: 3 + 5 = SCAN_MAX. */
        CAROM_ASSERT(m + (da >= 0) + ((da >= 0) != (db >= 0)) <= SCAN_MAX);
        if (da >= 0) {
            kept[m++] = polygon[i];
        }
        if (da >= 0 && db < 0) {
            cross_plane(kept[m++].at, a, b, da, db);
        } else if (da < 0 && db >= 0) {
            cross_plane(kept[m++].at, b, a, db, da);
        }
    }
    memcpy(polygon, kept, sizeof kept[0] * (size_t)m);
    return m;
}

int draw_clip_face(const struct draw_body *body, struct draw_corner polygon[SCAN_MAX])
{
    uint32_t out = polygon[0].out | polygon[1].out | polygon[2].out;
    int n = 3;

    for (uint32_t plane = OUT_NEAR; plane <= OUT_GUARD_BOTTOM && n > 0; plane <<= 1) {
        if (out & plane) {
            n = clip_plane(body, polygon, n, plane);
        }
    }
    for (int i = 0; i < n; i++) {
        project_clipped(body, &polygon[i]);
    }
    return n;
}

bool draw_clip_line(const struct draw_body *body, struct draw_corner line[2])
{
    for (uint32_t plane = OUT_NEAR; plane <= OUT_GUARD_BOTTOM; plane <<= 1) {
        int32_t d0 = clip_distance(body, line[0].at, plane);
        int32_t d1 = clip_distance(body, line[1].at, plane);

        if (d0 < 0 && d1 < 0) {
            return false;
        }
        if (d0 < 0) {
            cross_plane(line[0].at, line[1].at, line[0].at, d1, d0);
        } else if (d1 < 0) {
            cross_plane(line[1].at, line[0].at, line[1].at, d0, d1);
        }
    }
    project_clipped(body, &line[0]);
    project_clipped(body, &line[1]);
    return true;
}

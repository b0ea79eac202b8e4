/* SPDX-License-Identifier: MIT */
/* The camera: a body's pose as seen from it, vertices to the picture, extents on the picture. */
#include "draw.h"

#define CAMERA_LIMIT_Q32 ((int64_t)1 << (14 + 32))
#define FOCAL_MIN_Q16    (1 << 12)
#define FOCAL_MAX_Q16    (1 << 20)
#define NEAR_BITS        5 /* the near plane is 2^-5 units in front of the eye */

/*
 * Towards the light: (-6, -2, 3) / 7, low from the left, so that a landscape shows its relief.
 * Shorter than 1 by one part in 2^20.
 */
static const carom_v3_q30 usual_light = {{-920349257, -306783086, 460174628}};

/*
 * Set right, down and forward, unit vectors. If the camera looks straight up or down, right is the
 * world's x. Returns false if eye and target coincide.
 */
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

/* The row of the horizon. The camera does not roll, so the horizon is a row. */
static int32_t find_horizon(const struct draw_view *view, int32_t height)
{
    const int32_t far = 1 << 14, ahead = view->axes.c[2][2], down = -view->axes.c[1][2];
    int64_t row;

    if (down <= 1 << 16) { /* straight up or down */
        return ahead < 0 ? -far : far;
    }
    /*
     * a row's middle is half a pixel below the pixel that rows are counted from; for an odd height,
     * on it
     */
    row = (view->focal_q16 * ahead / down + (height & 1 ? 1 << 16 : 1 << 15)) >> 16;
    return row < -far ? -far : row > far ? far : (int32_t)row;
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
    view->cover = (struct draw_cover){.radius2_q8 = 0};
    view->light = view->sun = usual_light;
    view->shift_least = 0;
    view->shade_q24 = 1u << 28;
    view->middle[0] = width / 4 * 2;
    view->middle[1] = height / 2;
    view->round_q29[0] = (1 << 14) + (width - 2 * view->middle[0]) * (8 << 15);
    view->round_q29[1] = (1 << 14) + (height & 1) * (8 << 15) + (7 << 15);
    /*
     * x : z must become (focal / DRAW_GUARD) x : z. Dividing z by a power of two keeps the factor
     * of x at most 1, so that no coordinate grows. focal <= 2^15 pixels, so z_shift <= 5.
     */
    view->focal_q16 = (int64_t)camera->focal_q16 * height;
    view->horizon = find_horizon(view, height);
    view->z_shift = 0;
    while (view->focal_q16 >> view->z_shift > (int64_t)DRAW_GUARD << 16) {
        view->z_shift++;
    }
    view->scale_q30 = (int32_t)(view->focal_q16 * ((int64_t)1 << 14) / DRAW_GUARD >> view->z_shift);
    return CAROM_OK;
}

/* The middle of the picture, from the corner of pixel `middle` that pixels are counted from. */
static void find_halves(const struct draw_view *view, int32_t half_q4[2])
{
    half_q4[0] = view->round_q29[0] >> 15 & 24;
    half_q4[1] = view->round_q29[1] >> 15 & 8;
}

void draw_view_rect(struct draw_view *view, struct draw_rect rect)
{
    const int32_t edges[2][2] = {{rect.x0, rect.x1}, {rect.y0, rect.y1}};
    int32_t half_q4[2];

    find_halves(view, half_q4);
    view->rect = rect;
    memcpy(view->side[4].c, view->axes.c[2], sizeof view->side[4].c);
    for (int s = 0; s < 4; s++) {
        /* inside of a low edge e: focal x - e z >= 0; of a high edge: the negative */
        int64_t sign = s & 1 ? -1 : 1, edge_q4 = edges[s >> 1][s & 1] * 16 - half_q4[s >> 1];
        int64_t v[3] = {0, 0, -sign * edge_q4 * (1 << 12)};
        carom_v3_q30 plane;

        v[s >> 1] = sign * view->focal_q16;
        fix_normalise(&plane, v);
        carom_rotate_back(view->side[s].c, &view->axes, plane.c);
    }
}

/*
 * Is a sphere inside all planes? 0: outside some plane. 2: wholly inside all. 1: neither. Normals
 * have length 1.
 */
static int within(const carom_v3_q30 side[DRAW_SIDES], const int32_t at[3], int64_t radius)
{
    int64_t radius_q30 = radius * CAROM_ONE_Q30;
    int result = 2;

    for (int s = 0; s < DRAW_SIDES; s++) {
        int64_t inside = carom_dot(side[s].c, at);

        if (inside < -radius_q30) {
            return 0;
        }
        if (inside < radius_q30) {
            result = 1;
        }
    }
    return result;
}

/*
 * `within` for a body's sphere, in q16: the body is less than 2^15 units away in each direction.
 * The radius allows for truncation.
 */
static int sees_body(const struct draw_view *view, const carom_v3_q32 *position, int32_t radius_q22)
{
    int32_t at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = (int32_t)((position->c[k] - view->eye.c[k]) >> 16);
    }
    return within(view->side, at, (radius_q22 >> 6) + 4);
}

/* Set the eye in mesh axes, and the shift from q22 that keeps the body below 2^29. */
static void place_eye(struct draw_body *body, const struct draw_view *view, const carom_m3_q30 *r,
                      const carom_v3_q32 *position)
{
    int64_t eye[3];
    uint64_t reach = (uint64_t)body->mesh->radius_q22;

    for (int k = 0; k < 3; k++) {
        eye[k] = view->eye.c[k] - position->c[k];
    }
    fix_rotate_back(eye, r, eye);
    for (int k = 0; k < 3; k++) {
        eye[k] = carom_round(eye[k], 32 - 22);
        reach += (uint64_t)carom_abs(eye[k]);
    }
    body->shift = view->shift_least;
    while (reach >> body->shift >> 29) {
        body->shift++;
    }
    /* |eye| <= 2^14 and |position| <= 2^12 units, so reach < 2^16 units: 38 bits */
    CAROM_ASSERT(body->shift <= 9);
    for (int k = 0; k < 3; k++) {
        body->eye[k] = (int32_t)(eye[k] >> body->shift);
    }
}

/*
 * Combine the steps from vertices in quanta to view coordinates into one. A vertex is below 2^30 in
 * q22, and so is the centre of mass; with the eye t < 2^31, and all products add up to less than
 * 2^63.
 */
static void place_vertices(struct draw_body *body)
{
    int up = 22 - body->mesh->raw.quantum_bits - body->shift;
    int32_t t[3];

    body->up = up > 0 ? up : 0;
    for (int k = 0; k < 3; k++) {
        t[k] = (body->mesh->mass.centre.c[k] >> body->shift) + body->eye[k];
    }
    for (int k = 0; k < 3; k++) {
        body->origin[k] = ((int64_t)1 << 29) - carom_dot(body->to_view.c[k], t);
        for (int i = 0; up < 0 && i < 3; i++) {
            body->to_view.c[k][i] >>= -up;
        }
    }
}

/* Set what depends on the body's shift. shift <= 9 and z_shift <= 5, so near is at least 2^3. */
static void place_depth(struct draw_body *body, const struct draw_view *view)
{
    body->near = 1 << (22 - NEAR_BITS - body->shift - view->z_shift);
    body->w_shift = 14 + body->shift + view->z_shift;
    memcpy(body->round_q29, view->round_q29, sizeof body->round_q29);
}

/* Scale to_view from the view's axes to view coordinates. */
static void scale_to_view(struct draw_body *body, const struct draw_view *view)
{
    for (int k = 0; k < 3; k++) {
        body->to_view.c[0][k] = carom_mul_q30(body->to_view.c[0][k], view->scale_q30);
        body->to_view.c[1][k] = carom_mul_q30(body->to_view.c[1][k], view->scale_q30);
        body->to_view.c[2][k] >>= view->z_shift;
    }
}

void draw_body_of_points(struct draw_body *body, const struct draw_view *view, int shift)
{
    CAROM_ASSERT(shift <= 9);
    body->shift = shift;
    place_depth(body, view);
    body->to_view = view->axes;
    scale_to_view(body, view);
}

void draw_body_place(struct draw_body *body, const struct draw_view *view,
                     const struct carom_body_look *look)
{
    carom_m3_q30 r;

    body->mesh = look->mesh;
    body->moving = look->moving;
    body->coat = draw_usual_coat(look->moving);
    body->ramp = ((uint32_t)body->coat.own * DRAW_SHADES << 24) + view->shade_q24;
    fix_matrix(&r, &look->rotation);
    place_eye(body, view, &r, &look->position);
    place_depth(body, view);
    for (int k = 0; k < 3; k++) {
        carom_rotate_back(body->to_view.c[k], &r, view->axes.c[k]);
    }
    scale_to_view(body, view);
    place_vertices(body);
    for (int s = 0; s < DRAW_SIDES; s++) {
        carom_rotate_back(body->side[s].c, &r, view->side[s].c);
    }
    carom_rotate_back(body->light.c, &r, view->light.c);
    carom_rotate_back(body->cover.c, &r, view->cover.axis.c);
}

bool draw_body_init(struct draw_body *body, const struct draw_view *view,
                    const struct carom_body_look *look)
{
    body->sees = sees_body(view, &look->position, look->mesh->radius_q22);
    if (body->sees == 0) {
        return false;
    }
    draw_body_place(body, view, look);
    return true;
}

int draw_sees_sphere(const struct draw_body *body, const carom_v3_q22 *centre, int32_t radius_q22)
{
    int32_t at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = (centre->c[k] >> body->shift) - body->eye[k];
    }
    /* rounded up, with room for both roundings */
    return within(body->side, at, (radius_q22 >> body->shift) + 2);
}

static inline int32_t view_coordinate(const int32_t row[3], int64_t origin, int32_t x, int32_t y,
                                      int32_t z)
{
    return (int32_t)((origin + (int64_t)row[0] * x + (int64_t)row[1] * y + (int64_t)row[2] * z) >>
                     30);
}

static inline void place(const struct draw_body *body, uint32_t number, int32_t at[3])
{
    const int16_t *quanta = body->mesh->raw.vertices[number];
    const int32_t one = (int32_t)1 << body->up, (*m)[3] = body->to_view.c;
    int32_t x = quanta[0] * one, y = quanta[1] * one, z = quanta[2] * one;

    at[0] = view_coordinate(m[0], body->origin[0], x, y, z);
    at[1] = view_coordinate(m[1], body->origin[1], x, y, z);
    at[2] = view_coordinate(m[2], body->origin[2], x, y, z);
}

void draw_place(const struct draw_body *body, uint32_t number, int32_t at[3])
{
    place(body, number, at);
}

/* A view coordinate x, |x| <= z, in q4 pixels: 2^14 x / z; inverse is 2^62 / (z << up). */
static inline int32_t pixels_q4(int32_t x, int up, int32_t inverse, int32_t round_q29)
{
    /* x << (up - 1) is below 2^30: the product below 2^61, x / z in q29 its upper half */
    int32_t x_q29 = (int32_t)(((int32_t)((uint32_t)x << (up - 1)) * (int64_t)inverse) >> 32);

    return (x_q29 + round_q29) >> 15;
}

/*
 * Project a place inside the guard band and beyond the near plane.
 *
 * z < 2^29 is scaled to 2^31 <= s < 2^32. r = 2^31 / (s / 2^16), both rounded down, is right to one
 * part in 2^15, so 2^30 - s r / 2^17 is at most 2^15 in size; with that a Newton step makes the
 * inverse right to 2^-28. It is below 2^62 / s, hence below 2^31.
 *
 * z >= 2^(31 - w_shift), so the last shift is not negative, and w_q26 is below 2^31.
 */
static inline struct draw_vertex project(const struct draw_body *body, const int32_t at[3])
{
    uint32_t z = (uint32_t)at[2];
    int up = 32 - fix_bits32(z);
    uint32_t s = z << up;
    int32_t r = draw_divide(0x7fffffff, (int32_t)(s >> 16));
    int32_t rest = (1 << 30) - (int32_t)((s * (uint64_t)((uint32_t)r << 15)) >> 32);
    int32_t inverse = r * (1 << 15) + ((r * (rest >> 1)) >> 14);
    int32_t x_q4 = pixels_q4(at[0], up, inverse, body->round_q29[0]);
    int32_t y_q4 = pixels_q4(at[1], up, inverse, body->round_q29[1]);
    struct draw_vertex vertex = {(int32_t)((uint32_t)y_q4 << 16 | ((uint32_t)x_q4 & 0xffff)),
                                 (uint32_t)inverse >> (body->w_shift - up)};

    CAROM_ASSERT(body->w_shift >= up);
    return vertex;
}

struct draw_vertex draw_project(const struct draw_body *body, const int32_t at[3])
{
    return project(body, at);
}

bool draw_vertex(const struct draw_body *body, uint32_t number, struct draw_vertex *vertex)
{
    int32_t at[3];
    uint32_t z;

    place(body, number, at);
    z = (uint32_t)at[2];
    if (at[2] < body->near || (uint32_t)at[0] + z > 2 * z || (uint32_t)at[1] + z > 2 * z) {
        return false;
    }
    *vertex = project(body, at);
    return true;
}

/* ------------------------------------------------------------------ extents */

void draw_extent_begin(struct draw_extent *extent)
{
    /* plus infinity for the low bounds, minus infinity for the high ones */
    *extent = (struct draw_extent){.low = {{1, 0}, {1, 0}}, .high = {{-1, 0}, {-1, 0}}};
}

void draw_extent_add(struct draw_extent *extent, const struct draw_body *body, uint32_t number)
{
    int32_t at[3];

    place(body, number, at);
    if (at[2] < body->near) {
        extent->near = true;
        return;
    }
    /* coordinates are below 2^31, and a product below 2^62 */
    for (int k = 0; k < 2; k++) {
        int32_t *low = extent->low[k], *high = extent->high[k];

        if ((int64_t)at[k] * low[1] < (int64_t)low[0] * at[2]) {
            low[0] = at[k], low[1] = at[2];
        }
        if ((int64_t)at[k] * high[1] > (int64_t)high[0] * at[2]) {
            high[0] = at[k], high[1] = at[2];
        }
    }
}

/* The pixel, counted from the view's middle, at x / z of the guard band; clamped to low .. high. */
static int32_t pixel_at(const int32_t x[2], int32_t half_q4, int32_t low, int32_t high)
{
    int64_t pixel = ((int64_t)x[0] * (DRAW_GUARD * 16) / x[1] + half_q4) >> 4;

    return pixel < low ? low : pixel > high ? high : (int32_t)pixel;
}

struct draw_rect draw_extent_end(const struct draw_extent *extent, const struct draw_view *view)
{
    const struct draw_rect *rect = &view->rect;
    int32_t half_q4[2];

    if (extent->near) {
        return *rect;
    }
    if (extent->low[0][1] == 0) {
        return (struct draw_rect){0, 0, 0, 0};
    }
    find_halves(view, half_q4);
    return (struct draw_rect){
        pixel_at(extent->low[0], half_q4[0], rect->x0 + 1, rect->x1) - 1,
        pixel_at(extent->low[1], half_q4[1], rect->y0 + 1, rect->y1) - 1,
        pixel_at(extent->high[0], half_q4[0], rect->x0 - 2, rect->x1 - 2) + 2,
        pixel_at(extent->high[1], half_q4[1], rect->y0 - 2, rect->y1 - 2) + 2,
    };
}

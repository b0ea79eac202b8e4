/* SPDX-License-Identifier: MIT */
/*
 * The camera: the scene's own until a user turns it. From then on an arm holds it, with two angles
 * and a length from the scene's target, so it follows a game's player. Panning moves the target.
 */
#include "view_parts.h"

#define PIXELS_A_RADIAN 160
#define RISE_MAX_Q30    1069446856 /* sine of 85 degrees */
#define LENGTH_LEAST    ((int64_t)1 << 29)
#define LENGTH_MOST     ((int64_t)2000 << 32)
#define SHIFT_LIMIT     ((int64_t)2000 << 32)

/* An angle as cosine and sine. */
struct angle {
    int64_t cosine_q30, sine_q30;
};

static struct {
    bool own;
    struct angle turn, rise; /* direction of the arm: about the upright from x, and up */
    int64_t length_q32;
    carom_v3_q32 shift; /* shift of the target */
} arm;

/* ------------------------------------------------------------------- numbers */

static int64_t root(uint64_t v)
{
    uint64_t found = 0;

    for (uint64_t bit = (uint64_t)1 << 31; bit; bit >>= 1) {
        if ((found + bit) * (found + bit) <= v) {
            found += bit;
        }
    }
    return (int64_t)found;
}

/* Length of two sides, and the angle between their sum and the first one. |x|, |y| < 2^50. */
static int64_t measure(int64_t x, int64_t y, struct angle *angle)
{
    int shift = 0;
    int64_t length, most = carom_abs(x) > carom_abs(y) ? carom_abs(x) : carom_abs(y);

    while (most >> shift >> 31) {
        shift++;
    }
    while (shift <= 0 && most > 0 &&
           most << -shift < 1 << 29) { /* keep all digits of small sides */
        shift--;
    }
    x = shift < 0 ? carom_shl(x, -shift) : x >> shift;
    y = shift < 0 ? carom_shl(y, -shift) : y >> shift;
    length = root((uint64_t)(x * x) + (uint64_t)(y * y));
    *angle = length > 0 ? (struct angle){x * CAROM_ONE_Q30 / length, y * CAROM_ONE_Q30 / length}
                        : (struct angle){CAROM_ONE_Q30, 0};
    return shift < 0 ? length >> -shift : length << shift;
}

/* Turn by pixels; `half` is the tangent of half the angle: (1 - t t) / (1 + t t), 2 t / (1 + t t). */
static struct angle turned(struct angle a, int32_t pixels)
{
    const int64_t limit = PIXELS_A_RADIAN;
    const int64_t by = pixels < -limit ? -limit : pixels > limit ? limit : pixels;
    const int64_t half = by * CAROM_ONE_Q30 / (2 * PIXELS_A_RADIAN);
    const int64_t square = half * half >> 30, under = CAROM_ONE_Q30 + square;
    const int64_t cosine = (CAROM_ONE_Q30 - square) * CAROM_ONE_Q30 / under;
    const int64_t sine = 2 * half * CAROM_ONE_Q30 / under;

    /* normalise, because rounding changes the length */
    measure((a.cosine_q30 * cosine - a.sine_q30 * sine) >> 30,
            (a.sine_q30 * cosine + a.cosine_q30 * sine) >> 30, &a);
    return a;
}

/* -------------------------------------------------------------------- moving */

void view_camera_reset(void)
{
    arm.own = false;
    arm.shift = (carom_v3_q32){{0, 0, 0}};
}

void view_home(void)
{
    view_camera_reset();
}

/* Take the scene's camera as the arm. */
static void take(void)
{
    const struct carom_camera *scene = view_scene_camera();
    int64_t way[3], level;

    if (arm.own) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        way[k] = scene->eye.c[k] - scene->target.c[k];
    }
    level = measure(way[0], way[1], &arm.turn);
    arm.length_q32 = measure(level, way[2], &arm.rise);
    arm.own = true;
}

void view_orbit(int32_t x, int32_t y)
{
    struct angle rise;

    take();
    arm.turn = turned(arm.turn, -x);
    rise = turned(arm.rise, y);
    if (rise.cosine_q30 > 0 && rise.sine_q30 < RISE_MAX_Q30 && rise.sine_q30 > -RISE_MAX_Q30) {
        arm.rise = rise;
    }
}

void view_zoom(int32_t steps)
{
    take();
    for (; steps > 0 && arm.length_q32 > LENGTH_LEAST; steps--) {
        arm.length_q32 -= arm.length_q32 / 8;
    }
    for (; steps < 0 && arm.length_q32 < LENGTH_MOST; steps++) {
        arm.length_q32 += arm.length_q32 / 7;
    }
}

/* Right in the picture is perpendicular to the arm and level; up is perpendicular to both. */
void view_pan(int32_t x, int32_t y)
{
    const int32_t focal_q16 = view_scene_camera()->focal_q16, height = view_picture()->height;
    int64_t pixel_q32, right, up, move[3];
    struct angle turn, rise;

    take();
    if (height < 1) {
        return;
    }
    turn = arm.turn;
    rise = arm.rise;
    /* a pixel at the target: its distance over the focal length in pixels; in q16, moves are below 2^31 */
    pixel_q32 = arm.length_q32 / focal_q16 * (1 << 16) / height;
    right = -(int64_t)x * pixel_q32 >> 16;
    up = (int64_t)y * pixel_q32 >> 16;
    move[0] = -turn.sine_q30 * right - (turn.cosine_q30 * rise.sine_q30 >> 30) * up;
    move[1] = turn.cosine_q30 * right - (turn.sine_q30 * rise.sine_q30 >> 30) * up;
    move[2] = rise.cosine_q30 * up;
    for (int k = 0; k < 3; k++) {
        int64_t at = arm.shift.c[k] + (move[k] >> 14);

        arm.shift.c[k] = at < -SHIFT_LIMIT ? -SHIFT_LIMIT : at > SHIFT_LIMIT ? SHIFT_LIMIT : at;
    }
}

const struct carom_camera *view_camera(void)
{
    static struct carom_camera camera;

    camera = *view_scene_camera();
    if (arm.own) {
        const int64_t length = arm.length_q32 >> 12;
        const int64_t level = arm.rise.cosine_q30 * length >> 30;

        for (int k = 0; k < 3; k++) {
            camera.target.c[k] += arm.shift.c[k];
        }
        camera.eye.c[0] = camera.target.c[0] + (arm.turn.cosine_q30 * level >> 30) * 4096;
        camera.eye.c[1] = camera.target.c[1] + (arm.turn.sine_q30 * level >> 30) * 4096;
        camera.eye.c[2] = camera.target.c[2] + (arm.rise.sine_q30 * length >> 30) * 4096;
    }
    return &camera;
}

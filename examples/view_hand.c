/* SPDX-License-Identifier: MIT */
/*
 * The hand: a critically damped spring between a place of a body and a place of the world.
 *
 * Before each step an impulse changes the velocity v of the place to v + d / 16 - 7 v / 16, where d
 * is the way to the hand. So the place approaches the hand by a quarter of d a frame, and does not
 * swing: 1 - 7/16 is the square of 3/4, and 1/16 the square of 1/4. The hand also carries the
 * weight, and removes a part of the spin; otherwise a hanging body would swing on.
 */
#include "carom_body.h"
#include "view_parts.h"

#define PULL_SHIFT 4 /* 1/16 */
#define DAMP_16    7
#define SPIN_SHIFT 4                  /* 1/16 of the spin */
#define WAY_LIMIT  ((int64_t)2 << 40) /* bounds the speed at 2/7 units a frame, 17 a second */
#define GAIN_LIMIT ((int64_t)2 << 40) /* units a frame */
#define SUM_LIMIT  ((int64_t)1 << 33)

struct view_hand view_hand;
carom_v3_q32 view_hand_at;

void view_hand_grab(const struct carom_world *world, int body, const carom_v3_q32 *local)
{
    uint32_t mass_q20;

    view_hand = (struct view_hand){.body = carom_body_id(world, body), .local = *local};
    view_hand.holds = view_hand.body >= 0 && carom_body_mass(world, body, &mass_q20) >= 0 &&
                      mass_q20 > 0 &&
                      carom_body_world_point(world, body, local, &view_hand.at) >= 0;
}

/* ------------------------------------------------------------------- reach */

/* Shift all three to the right until the largest is below 2^bits. */
static void shorten(int64_t v[3], int bits)
{
    int64_t most = 0;
    int shift = 0;

    for (int k = 0; k < 3; k++) {
        most = carom_abs(v[k]) > most ? carom_abs(v[k]) : most;
    }
    while (most >> shift >> bits) {
        shift++;
    }
    for (int k = 0; k < 3; k++) {
        v[k] >>= shift;
    }
}

bool view_hand_reach(int32_t x, int32_t y)
{
    const struct carom_camera *camera = view_camera();
    const struct carom_picture *picture = view_picture();
    int64_t ahead[3], way[3], over = 0, under = 0, part_q30;
    struct carom_ray ray;

    x = x < 0 ? 0 : x >= picture->width ? picture->width - 1 : x;
    y = y < 0 ? 0 : y >= picture->height ? picture->height - 1 : y;
    if (carom_view_ray(camera, picture->width, picture->height, 256 * x + 128, 256 * y + 128,
                       &ray) < 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        ahead[k] = camera->target.c[k] - camera->eye.c[k];
        way[k] = ray.way.c[k];
    }
    shorten(ahead, 20);
    shorten(way, 30);
    for (int k = 0; k < 3;
         k++) { /* places are within 2^15 units, 2^31 in q16: sums are below 2^54 */
        over += ahead[k] * ((view_hand_at.c[k] - ray.from.c[k]) >> 16);
        under += ahead[k] * way[k];
    }
    /* a part of the way, below 2^30: the product is below 2^61 */
    if (over <= 0 || under >> 21 == 0 || over >> 52) {
        return false;
    }
    part_q30 = (over << 9) / (under >> 21);
    if (part_q30 >> 31) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        view_hand_at.c[k] = ray.from.c[k] + (way[k] * part_q30 >> 30) * (1 << 16);
    }
    return true;
}

/* -------------------------------------------------------------------- pull */

static int64_t limited(int64_t v, int64_t limit)
{
    return v < -limit ? -limit : v > limit ? limit : v;
}

/* out = m v, cut to SUM_LIMIT. |v| < 2^30, and entries of m are below 2^30. */
static void sym3_mul(int64_t out[3], const struct carom_sym3 *m, const int64_t v[3])
{
    static const uint8_t at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;

        for (int k = 0; k < 3; k++) {
            sum += m->m[at[i][k]] * v[k];
        }
        out[i] = limited(m->e >= 0 && m->e < 63 ? sum >> m->e : 0, SUM_LIMIT);
    }
}

/* The velocity that the place must gain. */
static void wanted(const carom_v3_q32 *point, const carom_v3_q40 *velocity, int64_t gain_q40[3])
{
    const struct carom_config config = scene_config();
    int64_t way[3], most = WAY_LIMIT;

    for (int k = 0; k < 3; k++) {
        way[k] = (view_hand.at.c[k] - point->c[k]) * 256;
        most = carom_abs(way[k]) > most ? carom_abs(way[k]) : most;
    }
    for (int k = 0; k < 3; k++) {
        way[k] = (way[k] >> 24) * (WAY_LIMIT >> 12) / (most >> 12) * (1 << 24);
        gain_q40[k] =
            limited((way[k] >> PULL_SHIFT) - velocity->c[k] * DAMP_16 / 16 - config.gravity.c[k],
                    GAIN_LIMIT);
    }
}

/*
 * The ratio of a body's mobility at a place to that at its centre, for an impulse: 1 + (r x u) J^-1
 * (r x u), in q20. r leads from the centre to the place, the unit vector u along the impulse, and J
 * is the inertia over the mass.
 */
static int64_t lightness_q20(const struct carom_mesh *mesh, const int64_t local_q32[3],
                             const int64_t along[3])
{
    int64_t r_q20[3], u[3], turn[3], spin[3], sum = 0, length2 = 0;

    for (int k = 0; k < 3; k++) {
        r_q20[k] = (local_q32[k] >> 12) - (mesh->mass.centre.c[k] >> 2);
        u[k] = along[k];
    }
    shorten(r_q20, 26); /* no effect for a place on a body */
    shorten(u, 20);
    for (int k = 0; k < 3; k++) { /* r x u below 2^27 */
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        turn[k] = (r_q20[i] * u[j] - r_q20[j] * u[i]) >> 20;
        length2 += u[k] * u[k];
    }
    sym3_mul(spin, &mesh->inverse, turn);
    for (int k = 0; k < 3; k++) { /* below 2^60 each */
        sum += turn[k] * spin[k];
    }
    return (1 << 20) + (length2 >> 20 ? sum / (length2 >> 20) : 0);
}

/* Push the place so that it gains that velocity, along the velocity's own direction. */
static void pull(struct carom_world *world, const carom_v3_q32 *point, const int64_t gain_q40[3],
                 uint32_t mass_q20)
{
    const struct carom_mesh *mesh = carom_body_mesh(world, view_hand.body);
    carom_v3_q40 impulse;
    int64_t along[3], light_q20;

    carom_body_local_vector(world, view_hand.body, gain_q40, along);
    light_q20 = lightness_q20(mesh, view_hand.local.c, along);
    for (int k = 0; k < 3; k++) { /* a gain is up to 2^41, a mass up to 2^30 */
        impulse.c[k] = ((gain_q40[k] * (1 << 20) / light_q20) >> 12) * (int64_t)mass_q20 >> 8;
    }
    carom_body_push(world, view_hand.body, &impulse,
                    point); /* a body that would become too fast stays as it is */
}

/* Remove 1/16 of the angular momentum. */
static void calm_spin(struct carom_world *world, const carom_v3_q40 *spin, uint32_t mass_q20)
{
    const struct carom_mesh *mesh = carom_body_mesh(world, view_hand.body);
    int64_t local[3];
    carom_v3_q40 twist;

    carom_body_local_vector(world, view_hand.body, spin->c, local);
    for (int k = 0; k < 3; k++) {
        local[k] = limited(local[k] >> 20, (1 << 30) - 1);
    }
    sym3_mul(twist.c, &mesh->mass.inertia, local);
    for (int k = 0; k < 3; k++) { /* from q20: 2^29 times a mass */
        twist.c[k] = -(twist.c[k] >> SPIN_SHIFT) * (int64_t)mass_q20;
    }
    carom_body_world_vector(world, view_hand.body, twist.c, twist.c);
    carom_body_twist(world, view_hand.body, &twist);
}

void view_hand_pull(struct carom_world *world)
{
    struct carom_body_state state;
    carom_v3_q40 velocity;
    carom_v3_q32 point;
    int64_t gain_q40[3];
    uint32_t mass_q20;

    if (!view_hand.holds) {
        return;
    }
    if (carom_body_get(world, view_hand.body, &state) < 0 || state.out ||
        carom_body_mass(world, view_hand.body, &mass_q20) < 0 || mass_q20 == 0 ||
        carom_body_world_point(world, view_hand.body, &view_hand.local, &point) < 0 ||
        carom_body_velocity_at(world, view_hand.body, &point, &velocity) < 0) {
        view_hand.holds = false;
        return;
    }
    wanted(&point, &velocity, gain_q40);
    pull(world, &point, gain_q40, mass_q20);
    calm_spin(world, &state.spin, mass_q20);
}

void view_hand_draw(const struct carom_world *world, const struct carom_picture *picture,
                    struct carom_rect *touched)
{
    carom_v3_q32 point;

    if (view_hand.holds &&
        carom_body_world_point(world, view_hand.body, &view_hand.local, &point) >= 0) {
        carom_draw_line(view_camera(), picture, &point, &view_hand_at, CAROM_COLOUR_WHITE, touched);
    }
}

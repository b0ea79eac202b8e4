/* SPDX-License-Identifier: MIT */
/*
 * The route of a kinematic body over a frame: its centre goes straight, and it turns about one
 * axis, in 2^n equal slices of one Cayley rotation each.
 */
#include "body.h"

/* A slice turns by less than 2 atan 1/8: 31/256 is below atan 1/8. */
#define HALF_TURN_MAX_Q40 ((int64_t)31 << 32)

/* The least n such that the centre goes no farther than BODY_SLICE_RADII radii in a slice. */
static int bits_of_way(const struct body *b, const carom_v3_q40 *velocity)
{
    int64_t way_q22 = fix_length(velocity->c) >> 18,
            most_q22 = (int64_t)b->def.radius_q22 * BODY_SLICE_RADII;
    int bits = 0;

    while (way_q22 >> bits > most_q22) {
        bits++;
    }
    return bits;
}

/*
 * The turn from one rotation to another: of both quaternions that stand for it the one whose first
 * component is not negative.
 */
static void shorter_turn(const carom_quat_q30 *from, const carom_quat_q30 *to, int64_t out[4])
{
    carom_quat_q30 turn;

    fix_turn_between(&turn, from, to);
    for (int k = 0; k < 4; k++) {
        out[k] = turn.c[0] < 0 ? -(int64_t)turn.c[k] : turn.c[k];
    }
}

/* Halve a turn: (1 + w, v) over its length, 2 sqrt((1 + w) / 2). */
static void halve(int64_t q_q30[4])
{
    int64_t cosine_q30 = fix_sqrt((uint64_t)(CAROM_ONE_Q30 + q_q30[0]) << 29);

    CAROM_ASSERT(q_q30[0] >= 0 && cosine_q30 >= CAROM_ONE_Q30 / 2);
    for (int k = 1; k <= 3; k++) {
        q_q30[k] = q_q30[k] * (CAROM_ONE_Q30 / 2) / cosine_q30;
    }
    q_q30[0] = cosine_q30;
}

/*
 * Set the spin of a body that turns by 2 atan |u| in each slice about the same axis: 2^n 2 u (1 -
 * |u|^2 / 3 + |u|^4 / 5). The next term is below 2^-20 at |u| = 1/8.
 */
static void set_spin(struct body_route *route, const carom_m3_q30 *r)
{
    int64_t u2_q30 = carom_dot(route->u.c, route->u.c) >> 30;
    int32_t by_q30 = (int32_t)(CAROM_ONE_Q30 - u2_q30 / 3 + ((u2_q30 * u2_q30) >> 30) / 5);

    for (int k = 0; k < 3; k++) {
        route->spin.c[k] =
            carom_shl(fix_mul_q30(carom_shl(route->u.c[k], 11), by_q30), route->slice_bits);
    }
    fix_rotate(route->spin.c, r, route->spin.c);
}

void body_route_to(const struct body *b, const struct body_state *s, const carom_v3_q32 *position,
                   const carom_quat_q30 *rotation, struct body_route *route)
{
    carom_m3_q30 r;
    int64_t turn_q30[4];
    int bits;

    for (int k = 0; k < 3; k++) {
        route->velocity.c[k] = carom_shl(position->c[k] - s->position.c[k], 8);
    }
    shorter_turn(&s->rotation, rotation, turn_q30);
    bits = bits_of_way(b, &route->velocity);
    for (int k = 0; k < bits; k++) {
        halve(turn_q30);
    }
    while (fix_length(&turn_q30[1]) > turn_q30[0] >> 3) {
        halve(turn_q30);
        bits++;
    }
    route->slice_bits = (uint8_t)bits;
    for (int k = 0; k < 3; k++) {
        route->u.c[k] = (int32_t)(turn_q30[1 + k] * CAROM_ONE_Q30 / turn_q30[0]);
    }
    fix_matrix(&r, &s->rotation);
    set_spin(route, &r);
}

/* tan x is x (1 + x^2 / 3 + 2 x^4 / 15), too small by at most 2^-22 at x = 1/8 */
void body_route_on(const struct body *b, const struct body_state *s, const carom_v3_q40 *velocity,
                   const carom_v3_q40 *spin, struct body_route *route)
{
    int64_t half_q40 = fix_length(spin->c) / 2, square_q30, u[3];
    int32_t by_q30;
    carom_m3_q30 r;
    int bits = bits_of_way(b, velocity);

    CAROM_ASSERT(half_q40 < (int64_t)2 << 40);
    while (half_q40 >> bits > HALF_TURN_MAX_Q40) {
        bits++;
    }
    half_q40 >>= bits + 10;
    square_q30 = (half_q40 * half_q40) >> 30;
    by_q30 = (int32_t)(CAROM_ONE_Q30 + square_q30 / 3 + ((square_q30 * square_q30) >> 30) * 2 / 15);
    route->velocity = *velocity;
    route->spin = *spin;
    route->slice_bits = (uint8_t)bits;
    fix_matrix(&r, &s->rotation);
    fix_rotate_back(u, &r, spin->c);
    for (int k = 0; k < 3; k++) {
        route->u.c[k] = (int32_t)carom_round(fix_mul_q30(u[k], by_q30), bits + 11);
    }
}

void body_follow(struct body *b, const struct body_state *s)
{
    const struct body_route *route = &b->def.extra->route;
    struct body_path *path = &b->path;

    body_place(b, s);
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = fix_round_shift(route->velocity.c[k], -route->slice_bits);
    }
    path->u = route->u;
    path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
    path->turns = (path->u.c[0] | path->u.c[1] | path->u.c[2]) != 0;
}

/*
 * A spin is below 4, so it has 31 bits in q29; with an arm of some 2^13 units the product is below
 * 2^56.
 */
void body_route_velocity(const struct body *b, const carom_v3_q40 *arm, carom_v3_q40 *v)
{
    const struct body_route *route = &b->def.extra->route;
    int32_t w_q29[3];

    for (int k = 0; k < 3; k++) {
        w_q29[k] = (int32_t)carom_round(route->spin.c[k], 11);
    }
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        v->c[k] = route->velocity.c[k] + fix_mul(arm->c[j], w_q29[i], 29) -
                  fix_mul(arm->c[i], w_q29[j], 29);
    }
}

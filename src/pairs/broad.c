/* SPDX-License-Identifier: MIT */
#include "broad.h"

/* One side of a box, rounded outwards. The world, a mesh and a reach are within 2^13 units. */
static void set_side(int32_t box_q18[2][3], int k, int64_t middle_q22, int64_t half_q22)
{
    box_q18[0][k] = (int32_t)((middle_q22 - half_q22) >> 4);
    box_q18[1][k] = (int32_t)((middle_q22 + half_q22) >> 4) + 1;
}

/* The box of a body in world axes, grown by its reach. */
static void bounds(const struct body *b, const struct body_state *s, int32_t reach_q22,
                   int32_t box_q18[2][3])
{
    const struct carom_mesh *mesh = b->mesh;
    int shift = 22 - mesh->raw.quantum_bits;
    int64_t middle[3], half[3];
    carom_m3_q30 r;

    body_matrix(&r, &s->rotation);
    for (int k = 0; k < 3; k++) {
        int64_t low = mesh->box[0][k], high = mesh->box[1][k];

        middle[k] = carom_shl(low + high, shift) / 2 - mesh->mass.centre.c[k];
        half[k] = carom_shl(high - low, shift) / 2 + 1;
    }
    for (int k = 0; k < 3; k++) {
        int64_t m = carom_round(s->position.c[k], 10);
        int64_t h = reach_q22 + 8; /* 8: the roundings of this function */

        for (int j = 0; j < 3; j++) {
            m += fix_mul_q30(middle[j], r.c[k][j]);
            h += fix_mul_q30(half[j], (int32_t)carom_abs(r.c[k][j]));
        }
        set_side(box_q18, k, m, h);
    }
}

/* A larger box that costs little: that of the sphere around the body. */
static void bounds_of_sphere(const struct body *b, const struct body_state *s,
                             int32_t box_q18[2][3])
{
    int64_t h = (int64_t)b->radius_q22 + b->reach_q22 + 1;

    for (int k = 0; k < 3; k++) {
        set_side(box_q18, k, carom_round(s->position.c[k], 10), h);
    }
}

static bool overlap(int32_t a[2][3], int32_t b[2][3])
{
    for (int k = 0; k < 3; k++) {
        if (a[1][k] < b[0][k] || b[1][k] < a[0][k]) {
            return false;
        }
    }
    return true;
}

bool broad_near(const struct body *a, const struct body_state *state_a, const struct body *b,
                const struct body_state *state_b, int32_t margin_q22)
{
    int32_t box_a[2][3], box_b[2][3];

    bounds(a, state_a, margin_q22, box_a);
    bounds(b, state_b, margin_q22, box_b);
    return overlap(box_a, box_b);
}

/* Whether two boxes overlap; those of spheres are only trusted when they do not. */
static bool boxes_overlap(struct body *bodies, const struct body_state *states, uint32_t a,
                          uint32_t b)
{
    const uint32_t both[2] = {a, b};

    if (!overlap(body_box_q18(&bodies[a]), body_box_q18(&bodies[b]))) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        struct body *body = &bodies[both[i]];

        if (!body->boxed) {
            bounds(body, &states[both[i]], body->reach_q22, body_box_q18(body));
            body->boxed = true;
        }
    }
    return overlap(body_box_q18(&bodies[a]), body_box_q18(&bodies[b]));
}

int broad_pairs(struct pair *pairs, struct pool *pool, struct body *bodies,
                const struct body_state *states, uint32_t body_count)
{
    pool_clear(pool);
    for (uint32_t i = 0; i < body_count; i++) {
        struct body *b = &bodies[i];

        /* the box of what stands still is worked out once */
        if (b->mesh && !b->standing) {
            PHASE_BEGIN(b->box_phase, BODY_BOX);
            b->boxed = !broad_active(b, &states[i]);
            if (b->boxed) {
                bounds(b, &states[i], b->reach_q22, b->box_q18);
            } else {
                bounds_of_sphere(b, &states[i], b->box_q18);
            }
        }
    }
    for (uint32_t a = 0; a < body_count; a++) {
        bool active = broad_active(&bodies[a], &states[a]);

        if (!bodies[a].mesh || !bodies[a].moving || states[a].out) {
            continue;
        }
        for (uint32_t b = 0; b < body_count; b++) {
            int32_t place;

            if (!bodies[b].mesh || (bodies[b].moving && b >= a) || states[b].out ||
                !(active || broad_active(&bodies[b], &states[b])) ||
                !boxes_overlap(bodies, states, a, b)) {
                continue;
            }
            place = pool_take(pool);
            if (place < 0) {
                return CAROM_ERR_PAIRS_FULL;
            }
            pairs[place].a = (uint16_t)a;
            pairs[place].b = (uint16_t)b;
        }
    }
    return CAROM_OK;
}

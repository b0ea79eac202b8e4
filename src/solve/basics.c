/* SPDX-License-Identifier: MIT */
/* Velocities and impulses at a contact, and vectors cut to a length: every solver uses them. */
#include "parts.h"

int32_t rest_clamp(int64_t v)
{
    const int64_t most = INT32_MAX;

    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

int32_t rest_restitution(const struct body *a, const struct body *b)
{
    return a->restitution_q30 < b->restitution_q30 ? a->restitution_q30 : b->restitution_q30;
}

uint32_t rest_friction(const struct body *a, const struct body *b)
{
    return a->friction_q16 < b->friction_q16 ? a->friction_q16 : b->friction_q16;
}

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b), less the drift of a surface */
void rest_relative_velocity(const struct contact *c, carom_v3_q40 *v)
{
    for (int k = 0; k < 3; k++) {
        v->c[k] = -c->drift.c[k];
    }
    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;
        const int32_t *arm = c->side[s].arm_q30;

        for (int k = 0; b && k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3, bits = contact_arm_bits(b);
            int64_t at = b->velocity.c[k] + fix_mul(b->spin.c[i], arm[j], bits) -
                         fix_mul(b->spin.c[j], arm[i], bits);

            v->c[k] += s == 0 ? at : -at;
        }
    }
}

int64_t rest_speed_q40(const struct contact *c)
{
    carom_v3_q40 v;

    rest_relative_velocity(c, &v);
    return rest_along_q40(&v, &c->normal);
}

void rest_want(struct contact *c)
{
    PHASE_BEGIN(c->work->phase, CONTACT_WANTED);
    c->work->wanted_q40 = *contact_impulse(c);
    PHASE_BEGIN(c->phase, CONTACT_VELOCITY);
    rest_relative_velocity(c, &c->velocity_q40);
}

void rest_apply_at(struct rest *r, const struct contact *c, const int64_t p[3],
                   const int64_t moment_q40[3])
{
    for (int s = 0; s < 2; s++) {
        struct body_state *state = rest_state(r, c, s);
        const struct body *b = c->side[s].body;
        const int32_t *arm = c->side[s].arm_q30;

        for (int k = 0; b && k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3, bits = contact_arm_bits(b);
            int64_t moment =
                fix_mul(p[n], arm[m], bits) - fix_mul(p[m], arm[n], bits) + moment_q40[k];

            state->momentum.c[k] += s == 0 ? p[k] : -p[k];
            state->angular.c[k] += s == 0 ? moment : -moment;
        }
    }
}

static void push_side(struct body *b, const struct contact_lever *lever, const int32_t impulse[3])
{
    int down = lever->turn_bits - REST_FINER_BITS;

    for (int k = 0; k < 3; k++) {
        body_solve(b)->dv[k] += ((int64_t)impulse[k] * lever->share_q30) >> (30 - REST_FINER_BITS);
        body_solve(b)->dw[k] += carom_dot(lever->turn[k], impulse) >> down;
    }
}

void rest_push(struct contact *c, const int32_t impulse[3])
{
    const int32_t opposite[3] = {-impulse[0], -impulse[1], -impulse[2]};

    if (c->side[0].body) {
        push_side(c->side[0].body, &c->work->lever[0], impulse);
    }
    if (c->side[1].body) {
        push_side(c->side[1].body, &c->work->lever[1], opposite);
    }
}

int rest_shrink(int64_t v[4], int bits)
{
    uint64_t all = 0;
    int down;

    for (int k = 0; k < 4; k++) {
        all |= (uint64_t)(v[k] ^ (v[k] >> 63));
    }
    down = fix_bits(all) - bits;
    if (down <= 0) {
        return 0;
    }
    for (int k = 0; k < 4; k++) {
        v[k] >>= down;
    }
    return down;
}

bool rest_cut(int64_t v[3], int64_t limit)
{
    int64_t part[4] = {v[0], v[1], v[2], limit};
    int down = rest_shrink(part, 31);
    const int32_t v32[3] = {(int32_t)part[0], (int32_t)part[1], (int32_t)part[2]};
    uint64_t most = (uint64_t)part[3], square = rest_square32(v32);
    int32_t ratio_q30;

    if (square <= most * most) {
        return false;
    }
    ratio_q30 = (int32_t)((most << 30) / fix_sqrt(square));
    for (int k = 0; k < 3; k++) {
        v[k] = carom_shl(((int64_t)v32[k] * ratio_q30) >> 30, down);
    }
    return true;
}

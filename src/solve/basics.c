/* SPDX-License-Identifier: MIT */
/* Velocities and impulses at a contact, and vectors cut to a length, for every solver here. */
#include "sweep.h"

extern inline struct contact *rest_contact(const struct rest *r, uint32_t i);
extern inline struct body *rest_body(const struct rest *r, const struct contact *c, int side);
extern inline int32_t rest_plain_restitution(const struct body *a, const struct body *b);
extern inline uint32_t rest_plain_friction(const struct body *a, const struct body *b);
extern inline int32_t rest_restitution_at(const struct rest *r, const struct contact *c);
extern inline uint32_t rest_friction_at(const struct rest *r, const struct contact *c);
extern inline uint64_t rest_used(const int64_t v[4]);
extern inline int rest_shrink(int64_t v[4], int bits);

int32_t rest_clamp(int64_t v)
{
    return rest_within(v, INT32_MAX);
}

int32_t rest_within(int64_t v, int32_t most)
{
    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/* The largest e of a body's faces, which may be of several materials. */
static int32_t most_restitution(const struct body *b)
{
    return b->def.extra && b->def.extra->materials ? b->def.extra->most_restitution_q30
                                                   : b->def.restitution_q30;
}

int32_t rest_restitution(const struct rest *r, const struct body *a, const struct body *b)
{
    return contact_mix_restitution(&r->list, most_restitution(a), most_restitution(b));
}

int32_t rest_mixed_restitution(const struct rest *r, const struct contact *c)
{
    const struct contact_mixed *mixed = contact_mixed(&r->list, c);

    return mixed ? mixed->restitution_q30
                 : rest_restitution(r, rest_body(r, c, 0), rest_body(r, c, 1));
}

uint32_t rest_mixed_friction(const struct rest *r, const struct contact *c)
{
    const struct contact_mixed *mixed = contact_mixed(&r->list, c);

    /* a contact of materials by face has mixed ones */
    return mixed ? mixed->friction_q16
                 : contact_mix_friction(&r->list, rest_body(r, c, 0)->def.friction_q16,
                                        rest_body(r, c, 1)->def.friction_q16);
}

/* v times an arm, to nearest, if the product is below 2^62. */
static inline int64_t short_product(int64_t v, int32_t arm, int bits)
{
    return carom_round(v * arm, bits);
}

/*
 * v x arm, each product to nearest. If v is below 2^31, as at rest nearly always, products fit 62
 * bits.
 */
static void cross_arm(int64_t out[3], const int64_t v[3], const struct contact_side *side)
{
    const int32_t *arm = side->arm_q30;
    int64_t all = (v[0] ^ (v[0] >> 63)) | (v[1] ^ (v[1] >> 63)) | (v[2] ^ (v[2] >> 63));
    int bits = contact_arm_bits(side->body);

    if (all >> 31 == 0) {
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int i = fix_next(k), j = fix_next(i);

            out[k] = short_product(v[i], arm[j], bits) - short_product(v[j], arm[i], bits);
        }
        return;
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        out[k] = fix_mul(v[i], arm[j], bits) - fix_mul(v[j], arm[i], bits);
    }
}

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b), less the drift of a surface */
void rest_relative_velocity(const struct contact *c, carom_v3_q40 *v)
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        v->c[k] = c->drift ? -c->drift->c[k] : 0;
    }
    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;
        int64_t turn[3];

        if (!b) {
            continue;
        }
        cross_arm(turn, b->solve.spin.c, &c->side[s]);
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int64_t at = b->solve.velocity.c[k] + turn[k];

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
        int64_t back[3];

        if (!c->side[s].body) {
            continue;
        }
        cross_arm(back, p, &c->side[s]);
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int64_t moment = moment_q40[k] - back[k];

            state->momentum.c[k] += s == 0 ? p[k] : -p[k];
            state->angular.c[k] += s == 0 ? moment : -moment;
        }
    }
}

void rest_push(struct contact *c, const int32_t impulse[3])
{
    const int32_t opposite[3] = {-impulse[0], -impulse[1], -impulse[2]};

    rest_push_side(c->side[0].body, &c->work->lever[0], impulse, c->work->fine_bits);
    if (c->side[1].body) {
        rest_push_side(c->side[1].body, &c->work->lever[1], opposite, c->work->fine_bits);
    }
}

int32_t rest_gain(struct contact *c, const struct rest_change *g)
{
    int32_t *gain = contact_gain(c)->gain, most;

    rest_accumulate(c->work, g);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        /* wraps for a lone contact, whose gain nobody reads */
        gain[k] = (int32_t)((uint32_t)gain[k] + (uint32_t)g->whole[k]);
    }
    rest_push(c, g->whole);
    most = fix_largest(g->whole);
    return most > 1 ? most : 0;
}

int rest_shift_down(int64_t v[4], int down)
{
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
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        v[k] = carom_shl(((int64_t)v32[k] * ratio_q30) >> 30, down);
    }
    return true;
}

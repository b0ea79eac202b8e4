/* SPDX-License-Identifier: MIT */
/* Impulses kept from frame to frame, from which the next solve starts. */
#include "../num/sort.h"
#include "parts.h"

/* The part of an impulse across its normal. */
static inline void find_tangent(const struct rest_warm *warm, int64_t normal_q40,
                                int64_t tangent[3])
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        tangent[k] = warm->impulse.c[k] - fix_mul_q30(normal_q40, warm->normal.c[k]);
    }
}

struct rest_warm_parts rest_warm_parts(const struct rest_warm *warm)
{
    struct rest_warm_parts parts;

    parts.normal_q40 = rest_along_q40(&warm->impulse, &warm->normal);
    find_tangent(warm, parts.normal_q40, parts.tangent.c);
    return parts;
}

/* Bounds: with a normal's components up to 2^30.1 and parts up to 2^60 an impulse is below 2^61.1. */
bool rest_warm_join(struct rest_warm *warm, const struct rest_warm_parts *parts)
{
    const int64_t most = (int64_t)1 << 60, *across = parts->tangent.c;
    const int32_t longest = CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> 10);

    for (int k = 0; k < 3; k++) {
        int32_t n = warm->normal.c[k];

        if (n > longest || n < -longest || across[k] > most || across[k] < -most ||
            parts->normal_q40 > most || parts->normal_q40 < -most) {
            return false;
        }
        warm->impulse.c[k] = across[k] + fix_mul_q30(parts->normal_q40, n);
    }
    return rest_warm_parts(warm).normal_q40 == parts->normal_q40;
}

static bool before(const void *record, const void *key)
{
    const struct rest_warm *warm = (const struct rest_warm *)record;
    const struct pair *p = (const struct pair *)key;

    return warm->a < p->a || (warm->a == p->a && warm->b < p->b);
}

/* The first kept impulse of a pair; they are in the order of pairs. */
static uint32_t first_warm(const struct rest *r, const struct pair *p)
{
    return sort_lower_bound(r->warm, r->warm_count, sizeof *r->warm, p, before);
}

/* The largest difference of two places along an axis, or `enough` if one is that large. */
static int32_t distance_below(const carom_v3_q22 *a, const carom_v3_q22 *b, int32_t enough)
{
    int32_t distance = 0;

    for (int k = 0; k < 3; k++) {
        int32_t d = fix_abs32(a->c[k] - b->c[k]);

        if (d >= enough) {
            return enough;
        }
        distance = fix_larger(distance, d);
    }
    return distance;
}

/*
 * The last frame's contact that this one continues: same bodies, similar normal, nearest place
 * within a part of a's radius. The pair's impulses begin at `first`; one that is used already is 0.
 *   normal_q40  out  its part along its normal
 */
static struct rest_warm *find_warm(struct rest *r, const struct contact *c, uint32_t first,
                                   int32_t divisor, int64_t *normal_q40)
{
    const struct pair *p = &r->pairs[c->key.pair];
    const struct body *a = rest_body(r, c, 0);
    int32_t nearest = a->def.radius_q22 / divisor;
    struct rest_warm *best = NULL;
    carom_v3_q22 arm = contact_arm(c);

    carom_rotate_back(arm.c, &a->path.start.r, arm.c);
    for (struct rest_warm *warm = &r->warm[first], *end = &r->warm[r->warm_count];
         warm < end && warm->a == p->a && warm->b == p->b; warm++) {
        int32_t distance = distance_below(&warm->arm, &arm, nearest);

        if (distance < nearest &&
            (warm->impulse.c[0] | warm->impulse.c[1] | warm->impulse.c[2]) != 0 &&
            carom_dot(warm->normal.c, c->normal.c) >> 30 >= CAROM_ONE_Q30 / 10 * 9) {
            int64_t along_q40 = rest_along_q40(&warm->impulse, &warm->normal);

            if (along_q40 != 0) {
                nearest = distance;
                best = warm;
                *normal_q40 = along_q40;
            }
        }
    }
    return best;
}

/*
 * A kept impulse in solver units. The unit may be far smaller than a frame ago, and sums need room:
 * an impulse above 2^40 units is scaled down to it whole, since parts that are cut one by one
 * would leave the friction cone.
 */
static void to_units(int64_t v[4], struct fix_scaled inverse)
{
    const int over = fix_bits(rest_used(v)) - (10 + inverse.e);

    inverse.e += over > 0 ? over : 0;
    fix_mul_scaled3(v, v, inverse);
    v[3] = fix_mul_scaled(v[3], inverse);
}

static void load(struct rest *r, struct contact *c, const struct rest_sweep *sw, uint32_t first,
                 int32_t divisor)
{
    carom_v3_q40 tangent;
    int64_t along, impulse[4];
    struct rest_warm *warm = find_warm(r, c, first, divisor, &impulse[3]);
    struct fix_scaled inverse;

    if (!warm) {
        return;
    }
    inverse = contact_lighter(c)->def.inverse_mass;
    inverse.e += sw->unit - c->work->fine_bits;
    find_tangent(warm, impulse[3], tangent.c);
    along = rest_along_q40(&tangent, &c->normal);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        impulse[k] = tangent.c[k] - fix_mul_q30(along, c->normal.c[k]);
    }
    to_units(impulse, inverse);
    memcpy(c->work->tangent_impulse, impulse, sizeof c->work->tangent_impulse);
    c->work->normal_impulse = impulse[3];
    warm->impulse = (carom_v3_q40){{0, 0, 0}}; /* used */
}

/* Load contacts that have no impulse yet, from places within a part of a radius. */
static void load_all(struct rest *r, const struct rest_sweep *sw, int32_t divisor)
{
    uint32_t pair = UINT32_MAX, first = 0;

    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        if (c->work->normal_impulse != 0) {
            continue;
        }
        if (c->key.pair != pair) {
            pair = c->key.pair;
            first = first_warm(r, &r->pairs[pair]);
        }
        load(r, c, sw, first, divisor);
    }
}

/* Contacts that stayed where they were come first: on small faces others are near them. */
void rest_load_warm(struct rest *r, const struct rest_sweep *sw)
{
    load_all(r, sw, REST_STAYED_DIVISOR);
    load_all(r, sw, REST_MOVED_DIVISOR);
}

void rest_store_warm(struct rest *r)
{
    r->warm_count = 0;
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        const struct contact *c = &r->list.contacts[i];
        struct rest_warm *warm = &r->warm[r->warm_count];
        carom_v3_q22 arm;

        if (!c->resting) {
            continue;
        }
        r->warm_count++;
        warm->a = r->pairs[c->key.pair].a;
        warm->b = r->pairs[c->key.pair].b;
        warm->normal = c->normal;
        arm = contact_arm(c);
        carom_rotate_back(warm->arm.c, &rest_body(r, c, 0)->path.start.r, arm.c);
        warm->impulse = *contact_impulse(c);
    }
}

/* SPDX-License-Identifier: MIT */
/* Boxes of bodies, and the pairs whose boxes overlap. */
#include "broad.h"
#include "../num/sort.h"

extern inline bool broad_active(const struct body *b, const struct body_state *s);

static bool before(const void *record, const void *key)
{
    const struct pair *p = (const struct pair *)record, *q = (const struct pair *)key;

    return p->a < q->a || (p->a == q->a && p->b < q->b);
}

bool broad_find(const struct pair *list, uint32_t count, uint32_t a, uint32_t b, uint32_t *place)
{
    const struct pair key = {(uint16_t)a, (uint16_t)b};

    *place = sort_lower_bound(list, count, sizeof *list, &key, before);
    return *place < count && list[*place].a == a && list[*place].b == b;
}

/*
 * Set one side of a box, rounded outwards. Bounds: the world, a mesh and a reach are within 2^13
 * units.
 */
static void set_side(int32_t box_q18[2][3], int k, int64_t middle_q22, int64_t half_q22)
{
    box_q18[0][k] = (int32_t)((middle_q22 - half_q22) >> 4);
    box_q18[1][k] = (int32_t)((middle_q22 + half_q22) >> 4) + 1;
}

/*
 * Set the box of a body's mesh in world axes, grown by its reach. The box comes by a pointer, since
 * GCC 12 with sanitizers at -O3 takes a parameter [2][3] for an overflow.
 */
static void bounds(const struct body *b, const carom_v3_q32 *at, const carom_quat_q30 *q,
                   int32_t reach_q22, int32_t (*box_q18)[3])
{
    const struct carom_mesh *mesh = b->def.mesh;
    int shift = 22 - mesh->raw.quantum_bits;
    int64_t middle[3], half[3];
    carom_m3_q30 r;

    fix_matrix(&r, q);
    for (int k = 0; k < 3; k++) {
        int64_t low = mesh->box[0][k], high = mesh->box[1][k];

        middle[k] = carom_shl(low + high, shift) / 2 - mesh->mass.centre.c[k];
        half[k] = carom_shl(high - low, shift) / 2 + 1;
    }
    for (int k = 0; k < 3; k++) {
        int64_t m = carom_round(at->c[k], 10);
        int64_t h = reach_q22 + 8; /* 8: roundings of this function */

        for (int j = 0; j < 3; j++) {
            m += fix_mul_q30(middle[j], r.c[k][j]);
            h += fix_mul_q30(half[j], (int32_t)carom_abs(r.c[k][j]));
        }
        set_side(box_q18, k, m, h);
    }
}

static bool overlap(const int32_t a[2][3], const int32_t b[2][3])
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

    bounds(a, &state_a->position, &state_a->rotation, margin_q22, box_a);
    bounds(b, &state_b->position, &state_b->rotation, margin_q22, box_b);
    return overlap((const int32_t(*)[3])box_a, (const int32_t(*)[3])box_b);
}

static void set_mesh_box(struct body *b)
{
    bounds(b, &b->search.region.at, &b->search.region.q, b->search.reach_q22, b->search.box_q18);
    b->search.boxed = true;
}

void broad_set_box(struct body *b)
{
    int64_t half_q22 = (int64_t)b->def.radius_q22 + b->search.reach_q22 + 1;

    if (b->search.state == BODY_REGION_STANDING) {
        set_mesh_box(b);
        return;
    }
    for (int k = 0; k < 3; k++) {
        set_side(b->search.box_q18, k, carom_round(b->search.region.at.c[k], 10), half_q22);
    }
    b->search.boxed = false;
}

bool broad_boxes_meet(struct body *a, struct body *b)
{
    if (broad_apart(a, b)) {
        return false;
    }
    if (a->search.boxed && b->search.boxed) {
        return true;
    }
    if (!a->search.boxed) {
        set_mesh_box(a);
    }
    if (!b->search.boxed) {
        set_mesh_box(b);
    }
    return !broad_apart(a, b);
}

bool broad_may_meet(const struct body *a, const struct body *b)
{
    if (a->def.sensor && b->def.sensor) {
        return false;
    }
    if (a->def.group == b->def.group && a->def.group != 0) {
        return a->def.group > 0;
    }
    return (a->def.category & b->def.mask) != 0 && (b->def.category & a->def.mask) != 0;
}

bool broad_is_pair(const struct body *bodies, const struct body_state *states, uint32_t a,
                   uint32_t b)
{
    return bodies[a].def.mesh && bodies[a].def.moving && !states[a].out && bodies[b].def.mesh &&
           !states[b].out && (bodies[b].def.moving ? b < a : true) &&
           (broad_active(&bodies[a], &states[a]) || broad_active(&bodies[b], &states[b])) &&
           broad_may_meet(&bodies[a], &bodies[b]);
}

int broad_pairs(struct pair *pairs, struct pool *pool, struct body *bodies,
                const struct body_state *states, uint32_t body_count)
{
    pool_clear(pool);
    for (uint32_t a = 0; a < body_count; a++) {
        for (uint32_t b = 0; b < body_count; b++) {
            int32_t place;

            if (!broad_is_pair(bodies, states, a, b) || !broad_boxes_meet(&bodies[a], &bodies[b])) {
                continue;
            }
            place = pool_take(pool);
            if (place < 0) {
                return CAROM_ERR_PAIRS_FULL;
            }
            pairs[place] = (struct pair){(uint16_t)a, (uint16_t)b};
        }
    }
    return CAROM_OK;
}

/* SPDX-License-Identifier: MIT */
/* Sleep: a body that has been quiet for a while is no longer computed; whole islands at a time. */
#include "parts.h"

static bool is_quiet(const struct body *b, const struct body_state *s)
{
    int64_t limit_q40;
    carom_m3_q30 m;
    carom_v3_q40 v, spin;

    if (b->clock.contact == BODY_FLIES && b->def.joined == BODY_ALONE) {
        return false;
    }
    /* a falling body is never that slow for long */
    limit_q40 = b->def.acceleration_q40 / REST_QUIET_DIVISOR;
    fix_matrix(&m, &s->rotation);
    body_velocity(b, s, &v);
    body_spin(b, s, &m, &spin);
    return fix_length(v.c) + fix_mul(fix_length(spin.c), b->def.radius_q22, 22) < limit_q40;
}

/* True if every active body of an island is quiet: one that is not keeps the others awake. */
static bool island_quiet(const struct body *bodies, const struct body_state *states, uint32_t first)
{
    for (uint32_t i = first; i != ISLAND_END; i = bodies[i].island.next) {
        if (broad_active(&bodies[i], &states[i]) && states[i].quiet < REST_QUIET_FRAMES) {
            return false;
        }
    }
    return true;
}

static void put_to_sleep(const struct body *bodies, struct body_state *states, uint32_t first)
{
    for (uint32_t i = first; i != ISLAND_END; i = bodies[i].island.next) {
        if (broad_active(&bodies[i], &states[i])) {
            states[i].asleep = 1;
            memset(&states[i].momentum, 0, sizeof states[i].momentum);
            memset(&states[i].angular, 0, sizeof states[i].angular);
        }
    }
}

void rest_find_islands(struct rest *r, struct body *bodies, uint32_t body_count,
                       const struct pair *touching, uint32_t touching_count)
{
    island_begin(bodies, body_count);
    for (uint32_t i = 0; i < touching_count; i++) {
        island_join(bodies, &touching[i]);
    }
    if (r->joints.calls) {
        r->bodies = bodies;
        r->joints.calls->join(r, NULL);
    }
    island_end(bodies, body_count);
}

void rest_sleep(struct rest *r, const struct pair *touching, uint32_t touching_count)
{
    struct body *bodies = r->bodies;
    struct body_state *states = r->states;
    uint32_t body_count = r->body_count;
    bool any = false;

    for (uint32_t i = 0; i < body_count; i++) {
        if (!broad_active(&bodies[i], &states[i])) {
            continue;
        }
        if (!is_quiet(&bodies[i], &states[i])) {
            states[i].quiet = 0;
        } else if (states[i].quiet < REST_QUIET_FRAMES) {
            states[i].quiet++;
        }
        any = any || states[i].quiet == REST_QUIET_FRAMES;
    }
    if (!any) {
        return;
    }
    rest_find_islands(r, bodies, body_count, touching, touching_count);
    for (uint32_t i = 0; i < body_count; i++) {
        if (bodies[i].island.lowest == i && island_quiet(bodies, states, i)) {
            put_to_sleep(bodies, states, i);
        }
    }
}

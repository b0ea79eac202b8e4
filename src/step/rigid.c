/* SPDX-License-Identifier: MIT */
/*
 * The motion that an island has as one rigid body: all of its momentum and angular momentum are in
 * it, so it stays when energy is taken out of the rest.
 *
 * Sums are in units of the island: masses over a power of two above the heaviest, lengths over one
 * above the longest, in q30. A body then adds at most 2^32, and 2^16 bodies fit in 64 bits. Only
 * 30 bits of the motion are right: whoever uses it makes up for what that leaves of the momenta.
 */
#include "../solve/rows.h"
#include "parts.h"

uint32_t step_island_next(const struct step *s, uint32_t i)
{
    do {
        i = s->w->bodies[i].next_in_island;
    } while (i != ISLAND_END && !broad_active(&s->w->bodies[i], &s->next->bodies[i]));
    return i;
}

uint32_t step_island_first(const struct step *s, uint32_t island)
{
    return broad_active(&s->w->bodies[island], &s->next->bodies[island])
               ? island
               : step_island_next(s, island);
}

/* From the island's centre to a body's, in the unit of length. */
static void arm_q30(const struct step *s, const struct step_rigid *rigid, uint32_t i,
                    int32_t out[3])
{
    for (int k = 0; k < 3; k++) {
        int64_t way_q32 = s->next->bodies[i].position.c[k] - rigid->centre.c[k];

        out[k] = (int32_t)fix_round_shift(way_q32, 30 - rigid->length_bits);
    }
}

/* A body's mass in the unit of mass, 2^(30 - mass_e). */
static int32_t share_q30(const struct step *s, const struct step_rigid *rigid, uint32_t i)
{
    const struct fix_scaled *mass = &s->w->bodies[i].mass;

    return (int32_t)fix_round_shift(mass->m, rigid->mass_e - mass->e);
}

/* The centre is within the extent of the others as seen from the first: one bit more will do. */
static void choose_units(const struct step *s, struct step_rigid *rigid)
{
    uint64_t length_q32 = 0;

    rigid->mass_e = INT32_MAX;
    for (uint32_t i = rigid->first; i != ISLAND_END; i = step_island_next(s, i)) {
        const struct body *b = &s->w->bodies[i];

        if (b->mass.e < rigid->mass_e) {
            rigid->mass_e = b->mass.e;
            rigid->heavy = i;
        }
        length_q32 |= (uint64_t)b->radius_q22 << 10;
        for (int k = 0; k < 3; k++) {
            int64_t way_q32 = s->next->bodies[i].position.c[k] - rigid->centre.c[k];

            length_q32 |= (uint64_t)carom_abs(way_q32);
        }
    }
    rigid->length_bits = fix_bits(length_q32) + 1;
}

/* The centre of mass and its velocity; before, the centre is the first body's. */
static void find_centre(const struct step *s, struct step_rigid *rigid)
{
    struct fix_wide momentum[3] = {{0, 0}, {0, 0}, {0, 0}};
    int64_t mass_q30 = 0, moment_q30[3] = {0, 0, 0};
    struct fix_wide total;

    for (uint32_t i = rigid->first; i != ISLAND_END; i = step_island_next(s, i)) {
        int32_t arm[3], share = share_q30(s, rigid, i);

        arm_q30(s, rigid, i, arm);
        mass_q30 += share;
        for (int k = 0; k < 3; k++) {
            const int64_t *p = s->next->bodies[i].momentum.c;

            moment_q30[k] += carom_mul_q30(share, arm[k]);
            momentum[k] = fix_wide_add(momentum[k], fix_wide_mul(p[k], 1));
        }
    }
    total = fix_wide_mul(mass_q30, 1);
    for (int k = 0; k < 3; k++) {
        struct fix_scaled way = fix_wide_ratio(fix_wide_mul(moment_q30[k], 1), total);
        struct fix_scaled v = fix_wide_ratio(momentum[k], total);

        way.e -= rigid->length_bits;
        v.e -= rigid->mass_e;
        rigid->centre.c[k] += fix_mul_scaled(1, way);
        rigid->velocity.c[k] = fix_mul_scaled(1, v);
    }
}

void step_add_angular(const struct step *s, const carom_v3_q32 *about, uint32_t i,
                      struct fix_wide sum_q72[3])
{
    const struct body_state *state = &s->next->bodies[i];
    const int64_t *p = state->momentum.c;
    int64_t x[3];

    for (int k = 0; k < 3; k++) {
        x[k] = state->position.c[k] - about->c[k];
    }
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;

        sum_q72[k] = fix_wide_add(sum_q72[k], fix_wide_mul(x[m], p[n]));
        sum_q72[k] = fix_wide_add(sum_q72[k], fix_wide_mul(-x[n], p[m]));
        sum_q72[k] = fix_wide_add(sum_q72[k], fix_wide_mul(state->angular.c[k], (int64_t)1 << 32));
    }
}

/* Add m (R J R^T + |r|^2 - r r^T) of a body. */
static void add_inertia(const struct step *s, const struct step_rigid *rigid, uint32_t i,
                        int64_t sum_q30[6])
{
    int32_t arm[3], share = share_q30(s, rigid, i);
    struct carom_sym3 own;
    carom_m3_q30 r;
    int64_t square_q30;

    arm_q30(s, rigid, i, arm);
    square_q30 = carom_dot(arm, arm) >> 30;
    body_matrix(&r, &s->next->bodies[i].rotation);
    body_world_inertia(&s->w->bodies[i], &r, &own);
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n <= m; n++) {
            int at = fix_sym3_at[m][n];
            int64_t part = fix_round_shift(own.m[at], 30 + 2 * (32 - rigid->length_bits) - own.e) -
                           carom_mul_q30(arm[m], arm[n]);

            part += m == n ? square_q30 : 0;
            sum_q30[at] += fix_mul(part, share, 30);
        }
    }
}

/* Inertia times spin is the angular momentum about the centre. */
static bool find_spin(const struct step *s, struct step_rigid *rigid)
{
    struct fix_wide angular_q72[3] = {{0, 0}, {0, 0}, {0, 0}};
    struct gauss *w = s->w->rest.gauss;
    int32_t rows[3][GAUSS_MAX + 1];
    int64_t inertia_q30[6] = {0};
    uint64_t all = 0;
    int down, up, bits = 0;

    for (uint32_t i = rigid->first; i != ISLAND_END; i = step_island_next(s, i)) {
        step_add_angular(s, &rigid->centre, i, angular_q72);
        add_inertia(s, rigid, i, inertia_q30);
    }
    for (int n = 0; n < 6; n++) {
        all |= (uint64_t)carom_abs(inertia_q30[n]);
    }
    for (int k = 0; k < 3; k++) {
        int b = fix_wide_bits(angular_q72[k]);

        bits = b > bits ? b : bits;
    }
    down = fix_bits(all) - 30;
    bits = bits > 30 ? bits - 30 : 0;
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n < 3; n++) {
            w->a[m][n] = (int32_t)fix_round_shift(inertia_q30[fix_sym3_at[m][n]], -down);
        }
        w->a[m][3] = (int32_t)fix_wide_shift(angular_q72[m], bits);
    }
    memcpy(rows, w->a, sizeof rows);
    if (gauss_solve(w, 3, (const int32_t(*)[GAUSS_MAX + 1]) rows) != 0) {
        return false;
    }
    /* q72 over q30, in units of mass and of length squared */
    up = bits - 72 - (down - 30) - (30 - rigid->mass_e) - 2 * (rigid->length_bits - 32);
    for (int k = 0; k < 3; k++) {
        rigid->spin.c[k] = fix_round_shift(w->x_q40[k], up);
    }
    return true;
}

bool step_rigid_motion(const struct step *s, uint32_t island, struct step_rigid *rigid)
{
    memset(rigid, 0, sizeof *rigid);
    rigid->first = step_island_first(s, island);
    if (rigid->first == ISLAND_END || step_island_next(s, rigid->first) == ISLAND_END) {
        return false;
    }
    rigid->centre = s->next->bodies[rigid->first].position;
    choose_units(s, rigid);
    find_centre(s, rigid);
    return find_spin(s, rigid);
}

struct body_state step_rigid_state(const struct step *s, const struct step_rigid *rigid, uint32_t i)
{
    struct body_state state = s->next->bodies[i];
    carom_v3_q40 v = rigid->velocity;
    const int64_t *w = rigid->spin.c;
    int32_t arm[3];

    arm_q30(s, rigid, i, arm);
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3, bits = 62 - rigid->length_bits;

        v.c[k] += fix_mul(w[m], arm[n], bits) - fix_mul(w[n], arm[m], bits);
    }
    body_set_motion(&s->w->bodies[i], &state, &v, &rigid->spin);
    return state;
}

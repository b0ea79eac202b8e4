/* SPDX-License-Identifier: MIT */
/*
 * The motion of an island as one rigid body: it has all of the island's momentum and angular
 * momentum, so it stays when energy is taken out of the rest.
 *
 * Sums are in units of the island: masses over a power of two above the heaviest, lengths over one
 * above the longest, in q30. So a body adds at most 2^32, and 2^16 bodies fit in 64 bits. The
 * motion is right to 30 bits; whoever uses it makes up for the difference in momenta.
 */
#include "rigid.h"
#include "rows.h"

/* Rounds of the midpoint rule, each of which gains two bits or more. */
#define RIGID_ROUNDS 20

uint32_t rest_island_next(const struct rest *r, uint32_t i)
{
    do {
        i = r->bodies[i].island.next;
    } while (i != ISLAND_END && !broad_active(&r->bodies[i], &r->states[i]));
    return i;
}

uint32_t rest_island_first(const struct rest *r, uint32_t island)
{
    return broad_active(&r->bodies[island], &r->states[island]) ? island
                                                                : rest_island_next(r, island);
}

/* From the island's centre to a body's centre, in the unit of length. */
static void arm_q30(const struct rest *r, const struct rest_rigid *rigid, uint32_t i,
                    int32_t out[3])
{
    for (int k = 0; k < 3; k++) {
        int64_t way_q32 = r->states[i].position.c[k] - rigid->centre.c[k];

        out[k] = (int32_t)fix_round_shift(way_q32, 30 - rigid->length_bits);
    }
}

/* A body's mass in the unit of mass, 2^(30 - mass_e). */
static int32_t share_q30(const struct rest *r, const struct rest_rigid *rigid, uint32_t i)
{
    const struct fix_scaled *mass = &r->bodies[i].def.mass;

    return (int32_t)fix_round_shift(mass->m, rigid->mass_e - mass->e);
}

/*
 * Set the units. The centre is within the extent of the bodies as seen from the first: one bit more
 * suffices.
 */
static void choose_units(const struct rest *r, struct rest_rigid *rigid)
{
    uint64_t length_q32 = 0;

    rigid->mass_e = INT32_MAX;
    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        const struct body *b = &r->bodies[i];

        if (b->def.mass.e < rigid->mass_e) {
            rigid->mass_e = b->def.mass.e;
            rigid->heavy = i;
        }
        length_q32 |= (uint64_t)b->def.radius_q22 << 10;
        for (int k = 0; k < 3; k++) {
            int64_t way_q32 = r->states[i].position.c[k] - rigid->centre.c[k];

            length_q32 |= (uint64_t)carom_abs(way_q32);
        }
    }
    rigid->length_bits = fix_bits(length_q32) + 1;
}

/* Find the centre of mass; until then the centre is the first body's. */
static void find_centre(const struct rest *r, struct rest_rigid *rigid)
{
    int64_t moment_q30[3] = {0, 0, 0};

    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        int32_t arm[3], share = share_q30(r, rigid, i);

        arm_q30(r, rigid, i, arm);
        rigid->mass_q30 += share;
        for (int k = 0; k < 3; k++) {
            moment_q30[k] += carom_mul_q30(share, arm[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        struct fix_scaled way = fix_ratio(moment_q30[k], rigid->mass_q30);

        way.e -= rigid->length_bits;
        rigid->centre.c[k] += fix_mul_scaled(1, way);
    }
}

static void add_angular(const struct rest *r, const carom_v3_q32 *about, uint32_t i,
                        struct fix_wide sum_q72[3])
{
    const struct body_state *state = &r->states[i];
    const int64_t *p = state->momentum.c;
    int64_t x[3];

    for (int k = 0; k < 3; k++) {
        x[k] = state->position.c[k] - about->c[k];
    }
    for (int k = 0; k < 3; k++) {
        int m = fix_next(k), n = fix_next(m);

        fix_wide_add_product(&sum_q72[k], x[m], p[n]);
        fix_wide_add_product(&sum_q72[k], -x[n], p[m]);
        fix_wide_add_product(&sum_q72[k], state->angular.c[k], (int64_t)1 << 32);
    }
}

/* An island's momentum, and its angular momentum about its centre. */
struct momenta {
    struct fix_wide linear_q40[3], angular_q72[3];
};

static struct momenta sum_momenta(const struct rest *r, const struct rest_rigid *rigid)
{
    struct momenta sum;

    memset(&sum, 0, sizeof sum);
    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        for (int k = 0; k < 3; k++) {
            fix_wide_add_product(&sum.linear_q40[k], r->states[i].momentum.c[k], 1);
        }
        add_angular(r, &rigid->centre, i, sum.angular_q72);
    }
    return sum;
}

/* The momenta that an island has lost since `before`. */
static struct momenta lost(const struct rest *r, const struct rest_rigid *rigid,
                           const struct momenta *before)
{
    struct momenta now = sum_momenta(r, rigid), lost = *before;

    for (int k = 0; k < 3; k++) {
        fix_wide_subtract(&lost.linear_q40[k], &now.linear_q40[k]);
        fix_wide_subtract(&lost.angular_q72[k], &now.angular_q72[k]);
    }
    return lost;
}

/* Add m (R J R^T + |r|^2 - r r^T) of a body. */
static void add_inertia(const struct rest *r, const struct rest_rigid *rigid, uint32_t i,
                        int64_t sum_q30[6])
{
    int32_t arm[3], share = share_q30(r, rigid, i);
    struct carom_sym3 own;
    carom_m3_q30 axes;
    int64_t square_q30;

    arm_q30(r, rigid, i, arm);
    square_q30 = carom_dot(arm, arm) >> 30;
    fix_matrix(&axes, &r->states[i].rotation);
    body_world_inertia(&r->bodies[i], &axes, &own);
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n <= m; n++) {
            int at = fix_sym3_at[m][n];
            int64_t part = fix_round_shift(own.m[at], 30 + 2 * (32 - rigid->length_bits) - own.e) -
                           carom_mul_q30(arm[m], arm[n]);

            part += m == n ? square_q30 : 0;
            sum_q30[at] += fix_mul_q30(part, share);
        }
    }
}

/*
 * The island's inertia about its centre as rows of up to 30 bits, and how far it was shifted down.
 */
struct inertia {
    int32_t m[6];
    int down;
};

static struct inertia sum_inertia(const struct rest *r, const struct rest_rigid *rigid)
{
    struct inertia inertia;
    int64_t sum_q30[6] = {0};
    uint64_t all = 0;

    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        add_inertia(r, rigid, i, sum_q30);
    }
    for (int n = 0; n < 6; n++) {
        all |= (uint64_t)carom_abs(sum_q30[n]);
    }
    inertia.down = fix_bits(all) - 30;
    for (int n = 0; n < 6; n++) {
        inertia.m[n] = (int32_t)fix_round_shift(sum_q30[n], -inertia.down);
    }
    return inertia;
}

/* Find the spin: inertia times spin is the angular momentum about the centre. */
static bool find_spin(const struct rest *r, struct rest_rigid *rigid, const struct inertia *inertia,
                      const struct fix_wide angular_q72[3])
{
    struct gauss *g = r->gauss;
    int32_t rows[3][GAUSS_MAX + 1];
    int up, bits = fix_wide_bits3(angular_q72);

    bits = bits > 30 ? bits - 30 : 0;
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n < 3; n++) {
            g->a[m][n] = inertia->m[fix_sym3_at[m][n]];
        }
        g->a[m][3] = (int32_t)fix_wide_shift(&angular_q72[m], bits);
    }
    memcpy(rows, g->a, sizeof rows);
    if (gauss_solve(g, 3, (const int32_t(*)[GAUSS_MAX + 1]) rows) != 0) {
        return false;
    }
    /* q72 over q30, in units of mass and squared length */
    up = bits - 72 - (inertia->down - 30) - (30 - rigid->mass_e) - 2 * (rigid->length_bits - 32);
    for (int k = 0; k < 3; k++) {
        rigid->spin.c[k] = fix_round_shift(g->x_q40[k], up);
    }
    return true;
}

/* Find the rigid motion that has these momenta. */
static bool find_motion(const struct rest *r, struct rest_rigid *rigid, const struct momenta *of)
{
    struct inertia inertia = sum_inertia(r, rigid);

    for (int k = 0; k < 3; k++) {
        struct fix_scaled v = fix_wide_over(&of->linear_q40[k], rigid->mass_q30);

        v.e -= rigid->mass_e;
        rigid->velocity.c[k] = fix_mul_scaled(1, v);
    }
    return find_spin(r, rigid, &inertia, of->angular_q72);
}

bool rest_is_alone(const struct rest *r, uint32_t island)
{
    uint32_t first = rest_island_first(r, island);

    return first == ISLAND_END || rest_island_next(r, first) == ISLAND_END;
}

bool rest_rigid_motion(const struct rest *r, uint32_t island, struct rest_rigid *rigid)
{
    struct momenta all;

    memset(rigid, 0, sizeof *rigid);
    rigid->first = rest_island_first(r, island);
    if (rigid->first == ISLAND_END) {
        return false;
    }
    rigid->centre = r->states[rigid->first].position;
    choose_units(r, rigid);
    find_centre(r, rigid);
    all = sum_momenta(r, rigid);
    return find_motion(r, rigid, &all);
}

struct body_state rest_rigid_state(const struct rest *r, const struct rest_rigid *rigid, uint32_t i)
{
    struct body_state state = r->states[i];
    carom_v3_q40 v = rigid->velocity;
    const int64_t *spin = rigid->spin.c;
    int32_t arm[3];

    arm_q30(r, rigid, i, arm);
    for (int k = 0; k < 3; k++) {
        int m = fix_next(k), n = fix_next(m), bits = 62 - rigid->length_bits;

        v.c[k] += fix_mul(spin[m], arm[n], bits) - fix_mul(spin[n], arm[m], bits);
    }
    body_set_motion(&r->bodies[i], &state, &v, &rigid->spin);
    return state;
}

/* from + factor (to - from) in both momenta */
static void scale_about(struct body_state *to, const struct body_state *from, int32_t factor_q30)
{
    for (int k = 0; k < 3; k++) {
        int64_t p = from->momentum.c[k], l = from->angular.c[k];

        to->momentum.c[k] = p + fix_mul_q30(to->momentum.c[k] - p, factor_q30);
        to->angular.c[k] = l + fix_mul_q30(to->angular.c[k] - l, factor_q30);
    }
}

/* Give a heavy body what rounding took of the momentum. */
static void make_up_momentum(struct rest *r, const struct rest_rigid *rigid,
                             const struct momenta *before)
{
    struct momenta rest = lost(r, rigid, before);

    for (int k = 0; k < 3; k++) {
        r->states[rigid->heavy].momentum.c[k] += fix_wide_shift(&rest.linear_q40[k], 0);
    }
}

/* The same of both momenta. */
static void make_up(struct rest *r, const struct rest_rigid *rigid, const struct momenta *before)
{
    struct momenta rest;

    make_up_momentum(r, rigid, before);
    rest = lost(r, rigid, before);
    for (int k = 0; k < 3; k++) {
        r->states[rigid->heavy].angular.c[k] +=
            carom_round(fix_wide_shift(&rest.angular_q72[k], 31), 1);
    }
}

/* Scale an island's motion relative to a rigid one. */
static void scale_relative(struct rest *r, const struct rest_rigid *rigid, int32_t factor_q30)
{
    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        struct body_state state = rest_rigid_state(r, rigid, i);

        scale_about(&r->states[i], &state, factor_q30);
    }
}

void rest_scale_free(struct rest *r, const struct rest_rigid *rigid, int32_t factor_q30)
{
    struct momenta before = sum_momenta(r, rigid);

    scale_relative(r, rigid, factor_q30);
    make_up(r, rigid, &before);
}

void rest_scale_turn(struct rest *r, const struct rest_rigid *common, int32_t factor_q30)
{
    struct momenta before = sum_momenta(r, common);

    scale_relative(r, common, factor_q30);
    make_up_momentum(r, common, &before);
}

void rest_scale_grounded(struct rest *r, uint32_t island, int32_t factor_q30)
{
    const struct body_state none = {.momentum = {{0, 0, 0}}};

    for (uint32_t i = rest_island_first(r, island); i != ISLAND_END; i = rest_island_next(r, i)) {
        scale_about(&r->states[i], &none, factor_q30);
    }
}

/* Add to each body its momenta in a rigid motion. */
static void add_motion(struct rest *r, const struct rest_rigid *rigid)
{
    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        struct body_state more = rest_rigid_state(r, rigid, i);

        for (int k = 0; k < 3; k++) {
            r->states[i].momentum.c[k] += more.momentum.c[k];
            r->states[i].angular.c[k] += more.angular.c[k];
        }
    }
}

/* Give an island the rigid motion that has these momenta. */
static void set_momenta(struct rest *r, struct rest_rigid *rigid, const struct momenta *all)
{
    struct momenta rest;

    rest_scale_grounded(r, rigid->first, 0);
    /* the motion has 30 bits, and so has each correction of it */
    for (int round = 0; round < 3; round++) {
        rest = lost(r, rigid, all);
        if (find_motion(r, rigid, &rest)) {
            add_motion(r, rigid);
        }
    }
    make_up(r, rigid, all);
}

void rest_unite(struct rest *r, uint32_t island, bool grounded)
{
    struct rest_rigid rigid;

    if (grounded) {
        rest_scale_grounded(r, island, 0);
    } else if (!rest_is_alone(r, island) && rest_rigid_motion(r, island, &rigid)) {
        struct momenta all = sum_momenta(r, &rigid);

        set_momenta(r, &rigid, &all);
    }
}

/* ----------------------------------------------------------------- a whole frame */

/* One round of cayley: M = L + M x u. */
static void add_turn(int64_t m[3], const int64_t l[3], const int32_t u_q30[3])
{
    int64_t next[3];

    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        next[k] = l[k] + fix_mul_q30(m[i], u_q30[j]) - fix_mul_q30(m[j], u_q30[i]);
    }
    memcpy(m, next, sizeof next);
}

/*
 * The Cayley vector of a turn over tau in the world's axes, by the implicit midpoint rule of
 * body/path.c: u is half of tau times the spin that M has, and M = L + M x u. It keeps the energy.
 * A spin that cannot be found stays.
 */
static FIX_OWN_FRAME void cayley(const struct rest *r, struct rest_rigid *rigid,
                                 const struct inertia *inertia, const struct momenta *all,
                                 int32_t tau_q30, int32_t u_q30[3])
{
    int bits = fix_wide_bits3(all->angular_q72), change = 1;
    int64_t l[3], m[3];

    bits = bits > 60 ? bits - 60 : 0;
    for (int k = 0; k < 3; k++) {
        l[k] = m[k] = fix_wide_shift(&all->angular_q72[k], bits);
        u_q30[k] = 0;
    }
    for (int round = 0; round < RIGID_ROUNDS && change != 0; round++) {
        struct fix_wide of_m[3] = {{0, 0}, {0, 0}, {0, 0}};

        for (int k = 0; k < 3; k++) {
            fix_wide_add_product(&of_m[k], m[k], 1);
            fix_wide_shift_up(&of_m[k], bits);
        }
        (void)find_spin(r, rigid, inertia, of_m);
        change = 0;
        for (int k = 0; k < 3; k++) {
            int32_t next_q30 = (int32_t)fix_mul(rigid->spin.c[k], tau_q30, 41);

            change |= next_q30 ^ u_q30[k];
            u_q30[k] = next_q30;
        }
        add_turn(m, l, u_q30);
    }
}

/* Turn the island about its centre. */
static FIX_OWN_FRAME void turn(struct rest *r, const struct rest_rigid *rigid,
                               const int32_t u_q30[3])
{
    const carom_quat_q30 none = {{CAROM_ONE_Q30, 0, 0, 0}};
    carom_quat_q30 by;
    carom_m3_q30 axes;

    body_turn(&by, &none, u_q30);
    fix_matrix(&axes, &by);
    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
        struct body_state *state = &r->states[i];
        carom_quat_q30 before = state->rotation;
        carom_m3_q30 own;
        int64_t arm[3];
        int32_t u[3];

        for (int k = 0; k < 3; k++) {
            arm[k] = state->position.c[k] - rigid->centre.c[k];
        }
        fix_rotate(arm, &axes, arm);
        for (int k = 0; k < 3; k++) {
            state->position.c[k] = rigid->centre.c[k] + arm[k];
        }
        fix_matrix(&own, &before);
        carom_rotate_back(u, &own, u_q30);
        body_turn(&state->rotation, &before, u);
    }
}

/* The part of a frame, at most left_q30, in which the spin turns by BODY_TURN_MAX_Q30. */
static int32_t slice_of(const struct rest_rigid *rigid, int32_t left_q30)
{
    int64_t rate_q40 = fix_length(rigid->spin.c);

    return fix_mul_q30(rate_q40, left_q30) <= (int64_t)BODY_TURN_MAX_Q30 << 10
               ? left_q30
               : (int32_t)(((int64_t)BODY_TURN_MAX_Q30 << 30) / (rate_q40 >> 10));
}

void rest_go_rigid(struct rest *r, struct rest_rigid *rigid, const carom_v3_q40 *pull)
{
    struct momenta all = sum_momenta(r, rigid);
    int32_t left_q30 = CAROM_ONE_Q30;

    while (left_q30 > 0) {
        struct inertia inertia = sum_inertia(r, rigid);
        int32_t slice_q30, u_q30[3];

        (void)find_spin(r, rigid, &inertia, all.angular_q72);
        slice_q30 = slice_of(rigid, left_q30);
        cayley(r, rigid, &inertia, &all, slice_q30, u_q30);
        turn(r, rigid, u_q30);
        left_q30 -= slice_q30;
    }
    for (int k = 0; k < 3; k++) {
        int64_t way_q32 = carom_round(rigid->velocity.c[k] + pull->c[k] / 2, 8);

        rigid->centre.c[k] += way_q32;
        for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(r, i)) {
            r->states[i].position.c[k] += way_q32;
            fix_wide_add_product(&all.linear_q40[k],
                                 fix_mul_scaled(pull->c[k], r->bodies[i].def.mass), 1);
        }
    }
    set_momenta(r, rigid, &all);
}

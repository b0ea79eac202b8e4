/* SPDX-License-Identifier: MIT */
/*
 * accuracy_energy - the kinetic energy of the bodies of an impact, before and after. A row of
 * out/accuracy.csv has the relative rise of the energy, 0 where the energy falls:
 *
 *   energy       one body moves or two do, any e, mu up to 4; half of the states have no more energy
 *                than the velocity at the contact takes; impulses from 2^-15, 2^25 units of their
 *                last place: below that the rounding of momenta is all there is to see
 *   energy_firm  the same with impulses from 2^-6, where it hardly shows
 *
 * The state is the engine's: momenta in q40, changed by the rounded impulse as the engine changes
 * them. The change of twice the energy is formed as the sum of dp (2p + dp) / m and dL J^-1 (2L + dL)
 * / m, over 113 bits: some hundred operations on numbers that are exact to begin with, each off by
 * 2^-113 of terms that are no larger than the energy times 50, the ratio of the moments of inertia.
 * So what is found is right to 2^-95 of the energy.
 */
#include "lib/accuracy.h"

#include <stdio.h>

#include "lib/impact_real.h"

__extension__ typedef __float128 wide;

struct wide3 {
    wide c[3];
};

static struct gauss workspace;

/* a 2^-e */
static wide wide_fixed(int64_t a, int e)
{
    wide w = (wide)a;

    for (; e > 0; e--) {
        w /= 2;
    }
    for (; e < 0; e++) {
        w *= 2;
    }
    return w;
}

static wide wide_dot(struct wide3 a, struct wide3 b)
{
    return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}

static struct wide3 wide_cross(struct wide3 a, struct wide3 b)
{
    return (struct wide3){{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
                           a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}

/* ---------------------------------------------------------------------- body */

struct momenta {
    int64_t p_q40[3], l_q40[3];
};

/* The terms of a body's energy: 1 / m, the inverse of J, the arm. */
struct rigid {
    wide inverse_mass;
    struct wide3 inverse[3]; /* rows of the inverse of J; J is symmetric */
    struct wide3 arm;
};

static struct rigid rigid_of(const struct impact_side *side)
{
    static const int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    struct wide3 row[3];
    struct rigid r;
    wide det;

    r.inverse_mass = wide_fixed(side->inverse_mass.m, side->inverse_mass.e);
    for (int i = 0; i < 3; i++) {
        r.arm.c[i] = wide_fixed(side->arm.c[i], side->arm.e);
        for (int j = 0; j < 3; j++) {
            row[i].c[j] = wide_fixed(side->inertia.m[at[i][j]], side->inertia.e);
        }
    }
    for (int i = 0; i < 3; i++) {
        r.inverse[i] = wide_cross(row[(i + 1) % 3], row[(i + 2) % 3]);
    }
    det = wide_dot(row[0], r.inverse[0]);
    for (int i = 0; i < 9; i++) {
        r.inverse[i / 3].c[i % 3] /= det;
    }
    return r;
}

static struct wide3 wide_q40(const int64_t v[3])
{
    return (struct wide3){{wide_fixed(v[0], 40), wide_fixed(v[1], 40), wide_fixed(v[2], 40)}};
}

/* a.b / m + c.J^-1 d / m. It is twice the energy when a = b = p and c = d = L. */
static wide work2(const struct rigid *r, struct wide3 a, struct wide3 b, struct wide3 c,
                  struct wide3 d)
{
    wide turn = 0;

    for (int i = 0; i < 3; i++) {
        turn += c.c[i] * wide_dot(r->inverse[i], d);
    }
    return (wide_dot(a, b) + turn) * r->inverse_mass;
}

/* The velocity of the point at the arm. */
static struct wide3 velocity_at(const struct rigid *r, const struct momenta *m)
{
    struct wide3 l = wide_q40(m->l_q40), v = wide_q40(m->p_q40), spin, turn;

    for (int i = 0; i < 3; i++) {
        spin.c[i] = wide_dot(r->inverse[i], l);
    }
    turn = wide_cross(spin, r->arm);
    for (int k = 0; k < 3; k++) {
        v.c[k] = (v.c[k] + turn.c[k]) * r->inverse_mass;
    }
    return v;
}

/* p += s P, L += s r x P. Each product of the moment is rounded as the engine rounds it. */
static void push(struct momenta *m, const struct impact_side *side, const int64_t p_q40[3],
                 int sign)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        int64_t moment = fix_mul(p_q40[j], side->arm.c[i], side->arm.e) -
                         fix_mul(p_q40[i], side->arm.c[j], side->arm.e);

        m->p_q40[k] += sign * p_q40[k];
        m->l_q40[k] += sign * moment;
    }
}

/* -------------------------------------------------------------------- random */

static void set_q40(int64_t out[3], struct vector v)
{
    for (int k = 0; k < 3; k++) {
        out[k] = rounded(v.c[k], 40);
    }
}

/*
 * Random momenta. Either the momenta with the least energy that give the velocity of the impact (an
 * impulse of K^-1 V at the contact), or any momenta of translation and rotation.
 */
static void random_momenta(uint64_t *random, const struct real_impact *real,
                           struct momenta momenta[2])
{
    bool least = real_random(random) % 2;
    struct real_contact contact;
    struct vector impulse;

    real_prepare(real, &contact);
    impulse = matrix_times(&contact.inverse_k, real->velocity);
    for (int b = 0; b < 2; b++) {
        const struct real_body *body = &real->body[b];
        struct vector p = times(b ? -1 : 1, impulse), l = cross(body->arm, p);

        if (!least) {
            scalar speed = real_spread(random, -2, 3);
            struct vector spin = times(speed / length(body->arm), real_direction(random));

            p = times(body->mass * speed, real_direction(random));
            l = times(body->mass, matrix_times(&body->inertia, spin));
        }
        memset(&momenta[b], 0, sizeof momenta[b]);
        if (body->moving) {
            set_q40(momenta[b].p_q40, p);
            set_q40(momenta[b].l_q40, l);
        }
    }
}

/* -------------------------------------------------------------------- one hit */

struct hit {
    struct impact in;
    const struct impact_side *side[2];
    struct rigid rigid[2];
    struct momenta before[2], after[2];
};

/*
 * Set the velocity at the contact from the momenta, with a normal N for which the bodies approach.
 */
static void set_velocity(struct hit *h, scalar restitution)
{
    struct wide3 v = {{0, 0, 0}};
    scalar speed;

    for (int b = 0; b < 2; b++) {
        struct wide3 at;

        if (h->side[b]->moving) {
            at = velocity_at(&h->rigid[b], &h->before[b]);
            for (int k = 0; k < 3; k++) {
                v.c[k] += b ? -at.c[k] : at.c[k];
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        h->in.velocity.c[k] = rounded((scalar)v.c[k], 40);
    }
    speed = dot(vector_q40(h->in.velocity.c), vector_q30(h->in.normal.c));
    for (int k = 0; k < 3 && speed > 0; k++) {
        h->in.normal.c[k] = -h->in.normal.c[k];
    }
    h->in.target_q40 = rounded(magnitude(speed) * fixed(rounded(restitution, 30), 30), 40);
}

static void random_hit(uint64_t *random, int movers, struct hit *h)
{
    struct real_impact real;

    real_random_impact(random, movers, 10, &real);
    if (real_random(random) % 4 == 0) { /* as rough as the engine accepts */
        real.friction = fixed((int64_t)(real_random(random) % (CAROM_MU_MAX_Q16 + 1)), 16);
    }
    h->in = real_to_engine(&real, real_random(random) % 2 ? 22 : 30);
    h->side[0] = &h->in.a;
    h->side[1] = &h->in.b;
    for (int b = 0; b < 2; b++) {
        if (h->side[b]->moving) {
            h->rigid[b] = rigid_of(h->side[b]);
        }
    }
    random_momenta(random, &real, h->before);
    set_velocity(h, real.restitution);
}

/* The relative change of the energy. */
static double energy_change(const struct hit *h)
{
    wide change = 0, before = 0;

    for (int b = 0; b < 2; b++) {
        struct wide3 p = wide_q40(h->before[b].p_q40), dp = wide_q40(h->after[b].p_q40);
        struct wide3 l = wide_q40(h->before[b].l_q40), dl = wide_q40(h->after[b].l_q40);
        struct wide3 p2, l2;

        if (!h->side[b]->moving) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            dp.c[k] -= p.c[k];
            dl.c[k] -= l.c[k];
            p2.c[k] = 2 * p.c[k] + dp.c[k];
            l2.c[k] = 2 * l.c[k] + dl.c[k];
        }
        before += work2(&h->rigid[b], p, p, l, l);
        change += work2(&h->rigid[b], dp, p2, dl, l2);
    }
    return (double)(change / before);
}

/* least: smaller impulses are left out */
static void rises(const char *kernel, size_t cases, scalar least, const struct accuracy_bar *bar)
{
    struct accuracy a = accuracy_begin(kernel, cases);
    uint64_t random = 3;

    while (a.count + a.failures < a.wanted) {
        struct hit h;
        struct impact_result result;
        double change;

        random_hit(&random, 1 + (int)(a.count % 2), &h);
        if (impact_solve(&workspace, &h.in, &result) != CAROM_OK) {
            accuracy_fail(&a);
            continue;
        }
        if (length(vector_q40(result.impulse.c)) < least) {
            continue;
        }
        for (int b = 0; b < 2; b++) {
            h.after[b] = h.before[b];
            if (h.side[b]->moving) {
                push(&h.after[b], h.side[b], result.impulse.c, b ? -1 : 1);
            }
        }
        change = energy_change(&h);
        accuracy_add(&a, change > 0 ? change : 0);
    }
    accuracy_end(&a, bar);
}

int main(int argc, char **argv)
{
    rises("energy", accuracy_cases(argc, argv, 400000), 0x1p-15L,
          &(struct accuracy_bar){.max = 6e-8});
    rises("energy_firm", accuracy_cases(argc, argv, 200000), 0x1p-6L,
          &(struct accuracy_bar){.max = 1e-9});
    return accuracy_finish();
}

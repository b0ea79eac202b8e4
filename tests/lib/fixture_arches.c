/* SPDX-License-Identifier: MIT */
/*
 * Arches of stones without mortar. An arch is only asked to stand if a line of thrust exists that
 * stays inside of the stones with a margin, at angles to the joints that friction holds with a
 * margin.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture.h"

#define STONES 128
#define DEPTH  0.8

struct joint {
    double middle[2], out[2]; /* x, z; out: a unit vector, outwards along the joint */
};

struct arch {
    int stones;
    double thick, mu;
    struct joint joints[STONES + 1];  /* from right to left */
    double weight[STONES], x[STONES]; /* weight and place of each stone */
    double margin, friction;          /* results: part of half the thickness; the largest tangent */
};

/* --------------------------------------------------------------------- shapes */

/* A half circle on its two feet. */
static void round_arch(struct arch *arch, double radius)
{
    for (int i = 0; i <= arch->stones; i++) {
        struct joint *j = &arch->joints[i];
        double angle = acos(-1) * i / arch->stones;

        j->out[0] = cos(angle);
        j->out[1] = sin(angle);
        j->middle[0] = radius * j->out[0];
        j->middle[1] = radius * j->out[1];
    }
}

/* An inverted chain: z = rise - a (cosh(x / a) - 1), in equal lengths. */
static void catenary_arch(struct arch *arch, double a, double span)
{
    double length = 2 * a * sinh(span / 2 / a);
    double rise = a * (cosh(span / 2 / a) - 1);

    for (int i = 0; i <= arch->stones; i++) {
        struct joint *j = &arch->joints[i];
        double s = length / 2 - length * i / arch->stones, h = hypot(a, s);

        j->middle[0] = a * asinh(s / a);
        j->middle[1] = rise - (h - a);
        /* the normal of the tangent (a, -s) / h */
        j->out[0] = s / h;
        j->out[1] = a / h;
    }
}

/* The corners of a stone, with its joints moved in by half a gap. */
static void stone(const struct arch *arch, int i, double gap, double corner[4][2])
{
    for (int side = 0; side < 2; side++) {
        const struct joint *j = &arch->joints[i + side];
        /* the joint's normal, to the left; into the stone from its right joint */
        double in = (side ? -gap : gap) / 2;

        for (int end = 0; end < 2; end++) {
            double along = (end ? 0.5 : -0.5) * arch->thick;
            double *to = corner[side ? 3 - end : end];

            to[0] = j->middle[0] + along * j->out[0] - in * j->out[1];
            to[1] = j->middle[1] + along * j->out[1] + in * j->out[0];
        }
    }
}

/* -------------------------------------------------------------------- statics */

static void weigh(struct arch *arch)
{
    for (int i = 0; i < arch->stones; i++) {
        double corner[4][2], area = 0, first = 0;

        stone(arch, i, 0, corner);
        for (int k = 0; k < 4; k++) {
            const double *p = corner[k], *q = corner[(k + 1) % 4];
            double part = p[0] * q[1] - p[1] * q[0];

            area += part / 2;
            first += part * (p[0] + q[0]) / 6;
        }
        arch->weight[i] = fabs(area);
        arch->x[i] = first / area;
    }
}

/*
 * The largest distance of the line of thrust from the joints' middles, in halves of the thickness.
 * The line begins at the right foot, at `off` from its middle, with a push to the left and half the
 * weight. Equilibrium gives its place at each later joint. Torque is x F_z - z F_x.
 */
static double eccentricity(const struct arch *arch, double push, double off, double *tangent)
{
    const struct joint *j = arch->joints;
    double lift = 0, x = j->middle[0] + off * j->out[0], z = j->middle[1] + off * j->out[1];
    double torque, worst = 0;

    *tangent = 0;
    for (int i = 0; i < arch->stones; i++) {
        lift += arch->weight[i] / 2;
    }
    torque = x * lift + z * push;
    for (int i = 0; i <= arch->stones; i++, j++) {
        double across = -push * -j->out[1] + lift * j->out[0];
        double along = -push * j->out[0] + lift * j->out[1];
        double at = (torque - (j->middle[0] * lift + j->middle[1] * push)) /
                    (j->out[0] * lift + j->out[1] * push);

        worst = fmax(worst, fabs(at) / (arch->thick / 2));
        *tangent = fmax(*tangent, fabs(along / across));
        if (i < arch->stones) {
            lift -= arch->weight[i];
            torque -= arch->weight[i] * arch->x[i];
        }
    }
    return worst;
}

/* Find the best line of thrust, by a search that narrows. */
static void find_thrust(struct arch *arch)
{
    double total = 0, push, off = 0, width, best = HUGE_VAL, tangent = 0;

    for (int i = 0; i < arch->stones; i++) {
        total += arch->weight[i];
    }
    push = width = total;
    for (int round = 0; round < 40; round++, width *= 0.7) {
        double middle_push = push, middle_off = off;

        for (int n = 0; n < 41 * 41; n++) {
            double p = middle_push + width * (n % 41 - 20) / 20;
            double o = middle_off + width / total * arch->thick / 2 * (n / 41 - 20) / 20;
            double found = p > 0 ? eccentricity(arch, p, o, &tangent) : HUGE_VAL;

            if (found < best) {
                best = found;
                push = p;
                off = o;
                arch->friction = tangent;
            }
        }
    }
    arch->margin = 1 - best;
}

/* ---------------------------------------------------------------------- worlds */

/* Add a stone: its mesh is made about its middle, and its body stands where the stone was. */
static void put(struct fixture *f, const double corner[4][2], bool fixed)
{
    double middle[2] = {0}, about[4][2];

    for (int k = 0; k < 8; k++) {
        middle[k % 2] += corner[k / 2][k % 2] / 4;
    }
    for (int k = 0; k < 8; k++) {
        about[k / 2][k % 2] = corner[k / 2][k % 2] - middle[k % 2];
    }
    fixture_shape_prism(&f->shape, (const double(*)[2])about, 4, fixed ? -DEPTH : -DEPTH / 2,
                        fixed ? DEPTH : DEPTH / 2);
    (fixed ? fixture_fixed : fixture_body)(f, fixture_mesh(f), middle[0], 0, middle[1],
                                           fixture_upright);
}

/* The foot below an end of the arch: half a unit thick, larger than the joint. */
static void put_foot(struct fixture *f, const struct arch *arch, const struct joint *j, double side)
{
    double corner[4][2];

    for (int k = 0; k < 4; k++) {
        double along = (k == 1 || k == 2 ? 0.9 : -0.9) * arch->thick,
               back = k < 2 ? 0 : -0.5 * side;

        corner[k][0] = j->middle[0] + along * j->out[0] - back * j->out[1];
        corner[k][1] = j->middle[1] + along * j->out[1] + back * j->out[0];
    }
    put(f, (const double(*)[2])corner, true);
}

/* Feet and stones, whether the arch can stand or not. */
static void build(struct fixture *f, const struct arch *arch)
{
    const struct joint *first = arch->joints;
    double corner[4][2], gap;

    /* the skin of a stone with the length between its neighbours' middles */
    gap = hypot(hypot(first[0].middle[0] - first[1].middle[0],
                      first[0].middle[1] - first[1].middle[1]),
                hypot(arch->thick, DEPTH)) /
          2 / 2048;
    put_foot(f, arch, &first[0], 1);
    put_foot(f, arch, &first[arch->stones], -1);
    for (int i = 0; i < arch->stones; i++) {
        stone(arch, i, gap, corner);
        put(f, (const double(*)[2])corner, false);
    }
}

static void make(struct fixture *f, struct arch *arch)
{
    weigh(arch);
    find_thrust(arch);
    fixture_say(f, "thrust margin %.2f, tangent %.2f", arch->margin, arch->friction);
    if (arch->margin < 0.2 || arch->friction > 0.7 * f->scene->mu) {
        printf("Bail out! %s would fall: %s\n", f->scene->name, f->said);
        exit(1);
    }
    build(f, arch);
    f->mark[0] = arch->thick;
}

double fixture_arch_margin(int stones, double radius, double thick)
{
    struct arch arch = {.stones = stones, .thick = thick};

    round_arch(&arch, radius);
    weigh(&arch);
    find_thrust(&arch);
    return arch.margin;
}

void fixture_arch(struct fixture *f, int stones, double radius, double thick)
{
    struct arch arch = {.stones = stones, .thick = thick};

    round_arch(&arch, radius);
    build(f, &arch);
}

static void make_round(struct fixture *f)
{
    struct arch arch = {.stones = f->scene->n, .thick = f->scene->value};

    round_arch(&arch, 5);
    make(f, &arch);
}

static void make_catenary(struct fixture *f)
{
    struct arch arch = {.stones = f->scene->n, .thick = f->scene->value};

    catenary_arch(&arch, 3, 10);
    make(f, &arch);
}

/* No stone may move by more than a tenth of the thickness. */
static bool judge(struct fixture *f)
{
    return fixture_farthest(f) < f->mark[0] / 10;
}

const struct fixture_scene fixture_arches[] = {
    {"arch25", "stands", 1000, 40, make_catenary, NULL, judge, 25, 0.6, 0.5},
    {"arch25-round", "stands", 1000, 30, make_round, NULL, judge, 25, 1.25, 0.8},
    {"arch101", "stands", 1000, 0, make_catenary, NULL, judge, 101, 0.5, 0.5},
    {0}};

/* SPDX-License-Identifier: MIT */
/*
 * Houses of cards: pairs that lean on each other, cards flat across their tops, the next level on
 * these. A house is only asked to stand when 6/10 of its friction can hold it, by statics.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture.h"
#include "fixture_statics.h"

#define LONG   1.0
#define THICK  0.02
#define WIDE   0.7
#define SLOPE  (20 * 3.14159265358979 / 180) /* off upright */
#define PITCH  0.76                          /* from top to top */
#define APART  0.006                         /* between flat cards of a level */
#define BEYOND 0.05 /* the ends of a level's flat cards, over the last top */
#define BLOCK  0.25

struct house {
    struct fixture *f;
    struct statics statics;
    double gap;
    int card[2]; /* meshes of cards that stand */
};

static void bear(struct house *h, int a, int b, double x, double z, double nx, double nz)
{
    struct statics_contact *c = &h->statics.contacts[h->statics.contact_count++];

    *c = (struct statics_contact){a, b, {x, z}, {nx, nz}};
}

/* A card in the house and in its statics; returns its number there. */
static int lay(struct house *h, int mesh, double length, double x, double z, double slope)
{
    int number = h->statics.body_count++;

    fixture_body(h->f, mesh, x, 0, z, lab_turn(0, 1, 0, slope));
    h->statics.middle[number][0] = x;
    h->statics.middle[number][1] = z;
    h->statics.weight[number] = length * THICK * WIDE;
    return number;
}

/* Two cards under a top; `on`: what they stand on. Returns the left one's number, the other is next. */
static int lean(struct house *h, double top, double base, int on)
{
    const double s = sin(SLOPE), c = cos(SLOPE);
    double z = base + h->gap + LONG / 2 * c + THICK / 2 * s;
    double off = h->gap / 2 + LONG / 2 * s + THICK / 2 * c;
    int left = lay(h, h->card[0], LONG, top - off, z, SLOPE);
    int right = lay(h, h->card[0], LONG, top + off, z, -SLOPE);

    bear(h, left, right, top, z + LONG / 2 * c - THICK / 2 * s, -1, 0);
    bear(h, left, on, top - off - LONG / 2 * s + THICK / 2 * c, base, 0, 1);
    bear(h, right, on, top + off + LONG / 2 * s - THICK / 2 * c, base, 0, 1);
    return left;
}

/* A flat card over tops `i` and i + 1 of a level of n, whose left cards are `under`. */
static int span(struct house *h, int i, int n, double first, double height, const int *under)
{
    double from = first + i * PITCH + (i == 0 ? -BEYOND : APART / 2);
    double to = first + (i + 1) * PITCH + (i == n - 2 ? BEYOND : -APART / 2);
    double support = h->gap / 2 + THICK * cos(SLOPE);
    int card;

    fixture_shape_box(&h->f->shape, to - from, WIDE, THICK);
    card = lay(h, fixture_mesh(h->f), to - from, (from + to) / 2, height + h->gap + THICK / 2, 0);
    for (int k = 0; k < 4; k++) {
        double x = first + (i + k / 2) * PITCH + (k % 2 ? support : -support);

        if (x > from && x < to) {
            bear(h, card, under[k / 2] + k % 2, x, height, 0, 1);
        }
    }
    return card;
}

static void build(struct fixture *f, int levels)
{
    static struct house house;
    struct house *h = &house;
    double base = 0, rest;
    int flat[8] = {-1, -1, -1, -1, -1, -1, -1, -1};

    house = (struct house){.f = f};
    fixture_plane(f);
    fixture_shape_box(&f->shape, THICK, WIDE, LONG);
    h->card[0] = fixture_mesh(f);
    h->gap = fixture_skin(f, h->card[0]);
    for (int level = 0; level < levels; level++) {
        int n = levels - level, under[8];
        double first = -(n - 1) * PITCH / 2;

        for (int i = 0; i < n; i++) {
            under[i] = lean(h, first + i * PITCH, base, flat[i]);
        }
        f->mark[0] = base;
        base += h->gap + LONG * cos(SLOPE) + THICK * sin(SLOPE);
        f->mark[1] = base;
        for (int i = 0; i < n - 1; i++) {
            flat[i] = span(h, i, n, first, base, &under[i]);
        }
        base += h->gap + THICK;
    }
    rest = statics_rest(&h->statics, 0.6 * f->scene->mu);
    if (rest > 1e-5) {
        printf("Bail out! %s would fall: %g of its weight is not held\n", f->scene->name, rest);
        exit(1);
    }
}

static void make_house(struct fixture *f)
{
    build(f, f->scene->n);
}

/* A block that falls on the house, beside its topmost edge: the slope there cannot hold it. */
static void make_dropped(struct fixture *f)
{
    int block;

    build(f, f->scene->n);
    fixture_shape_box(&f->shape, BLOCK, BLOCK * 1.2, BLOCK * 0.8);
    block = fixture_body(f, fixture_mesh(f), f->scene->value, 0.04, f->mark[1] + 1,
                         lab_turn(0.3, 1, 0.2, 0.5));
    fixture_weigh(f, block, 0.15);
    f->mark[2] = block;
}

static bool judge_house(struct fixture *f)
{
    double tilt = 0;

    for (int i = 1; i < f->body_count; i++) {
        tilt = fmax(tilt, fixture_tilt(f, i, 2));
    }
    fixture_say(f, "tilt %.5f rad", tilt);
    return tilt < 0.03 && fixture_farthest(f) < THICK;
}

/* The block ends on a card of the level below or deeper, and at rest. */
static bool judge_dropped(struct fixture *f)
{
    int block = (int)f->mark[2];
    double height = f->bodies[block].now.position[2], fastest = fixture_fastest(f);

    fixture_say(f, "block at %.2f of %.2f, fastest %.3f/s", height, f->mark[1], fastest);
    return height < f->mark[0] + 0.35 && fastest < 0.1;
}

const struct fixture_scene fixture_cards[] = {
    {"cards2", "stands", 1000, 60, make_house, NULL, judge_house, 2, 0, 0.8},
    {"cards3", "stands", 1000, 0, make_house, NULL, judge_house, 3, 0, 0.8},
    {"cards4", "stands", 1000, 0, make_house, NULL, judge_house, 4, 0, 0.8},
    {"cards2-block", "the block falls through", 1000, 0, make_dropped, NULL, judge_dropped, 2, 0.2,
     0.8},
    {"cards3-block", "the block falls through", 1000, 0, make_dropped, NULL, judge_dropped, 3, 0.2,
     0.8},
    {0}};

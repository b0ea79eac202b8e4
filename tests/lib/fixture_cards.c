/* SPDX-License-Identifier: MIT */
/*
 * Houses of cards: pairs of cards lean on each other, flat cards lie across their tops, and the
 * next level stands on these. A house is only asked to stand if statics says that 6/10 of its
 * friction can hold it.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture.h"
#include "fixture_statics.h"

#define LONG   1.0
#define WIDE   0.7
#define BEYOND 0.05 /* overhang of a level's flat cards at the ends, beyond the last top */
#define BLOCK  0.25
#define THIN   10 /* added to a scene's levels: thinner cards that lean more */

struct house {
    struct fixture *f;
    struct statics statics;
    double gap, thick, slope; /* slope: angle from upright */
    double pitch, apart;      /* from top to top; between flat cards of a level */
    int card;                 /* the mesh of the standing cards */
};

static void bear(struct house *h, int a, int b, double x, double z, double nx, double nz)
{
    struct statics_contact *c = &h->statics.contacts[h->statics.contact_count++];

    *c = (struct statics_contact){a, b, {x, z}, {nx, nz}};
}

/* Add a card to the house and to its statics; returns its number there. */
static int lay(struct house *h, int mesh, double length, double x, double z, double slope)
{
    int number = h->statics.body_count++;

    fixture_body(h->f, mesh, x, 0, z, lab_turn(0, 1, 0, slope));
    h->statics.middle[number][0] = x;
    h->statics.middle[number][1] = z;
    h->statics.weight[number] = length * h->thick * WIDE;
    return number;
}

/*
 * Two cards below a top; `on`: the cards that support them. Returns the left one's number; the
 * other follows it.
 */
static int lean(struct house *h, double top, double base, int on)
{
    const double s = sin(h->slope), c = cos(h->slope);
    double z = base + h->gap + LONG / 2 * c + h->thick / 2 * s;
    double off = h->gap / 2 + LONG / 2 * s + h->thick / 2 * c;
    int left = lay(h, h->card, LONG, top - off, z, h->slope);
    int right = lay(h, h->card, LONG, top + off, z, -h->slope);

    bear(h, left, right, top, z + LONG / 2 * c - h->thick / 2 * s, -1, 0);
    bear(h, left, on, top - off - LONG / 2 * s + h->thick / 2 * c, base, 0, 1);
    bear(h, right, on, top + off + LONG / 2 * s - h->thick / 2 * c, base, 0, 1);
    return left;
}

/* A flat card over tops `i` and i + 1 of a level of n, with left cards `under`. */
static int span(struct house *h, int i, int n, double first, double height, const int *under)
{
    double from = first + i * h->pitch + (i == 0 ? -BEYOND : h->apart / 2);
    double to = first + (i + 1) * h->pitch + (i == n - 2 ? BEYOND : -h->apart / 2);
    double support = h->gap / 2 + h->thick * cos(h->slope);
    int card;

    fixture_shape_box(&h->f->shape, to - from, WIDE, h->thick);
    card =
        lay(h, fixture_mesh(h->f), to - from, (from + to) / 2, height + h->gap + h->thick / 2, 0);
    for (int k = 0; k < 4; k++) {
        double x = first + (i + k / 2) * h->pitch + (k % 2 ? support : -support);

        if (x > from && x < to) {
            bear(h, card, under[k / 2] + k % 2, x, height, 0, 1);
        }
    }
    return card;
}

static void build(struct fixture *f)
{
    static struct house house;
    struct house *h = &house;
    bool thin = f->scene->n >= THIN;
    int levels = f->scene->n % THIN;
    double base = 0, rest;
    int flat[8] = {-1, -1, -1, -1, -1, -1, -1, -1};

    house = (struct house){.f = f, .thick = thin ? 0.008 : 0.02};
    h->slope = (thin ? 27 : 20) * acos(-1) / 180;
    h->pitch = 2 * (LONG * sin(h->slope) + h->thick * cos(h->slope)) + 0.04;
    h->apart = 0.3 * h->thick;
    f->mark[3] = h->thick;
    fixture_plane(f);
    fixture_shape_box(&f->shape, h->thick, WIDE, LONG);
    h->card = fixture_mesh(f);
    h->gap = fixture_skin(f, h->card);
    for (int level = 0; level < levels; level++) {
        int n = levels - level, under[8];
        double first = -(n - 1) * h->pitch / 2;

        for (int i = 0; i < n; i++) {
            under[i] = lean(h, first + i * h->pitch, base, flat[i]);
        }
        f->mark[0] = base;
        base += h->gap + LONG * cos(h->slope) + h->thick * sin(h->slope);
        f->mark[1] = base;
        for (int i = 0; i < n - 1; i++) {
            flat[i] = span(h, i, n, first, base, &under[i]);
        }
        base += h->gap + h->thick;
    }
    rest = statics_rest(&h->statics, 0.6 * f->scene->mu);
    if (rest > 1e-5) {
        printf("Bail out! %s would fall: %g of its weight is not held\n", f->scene->name, rest);
        exit(1);
    }
}

static void make_house(struct fixture *f)
{
    build(f);
}

static int block(struct fixture *f, double x, double z, carom_quat_q30 turn, double mass)
{
    int body;

    build(f);
    fixture_shape_box(&f->shape, BLOCK, BLOCK * 1.2, BLOCK * 0.8);
    body = fixture_body(f, fixture_mesh(f), x, 0.04, f->mark[1] + z, turn);
    fixture_weigh(f, body, mass);
    f->mark[2] = body;
    return body;
}

/*
 * A block falls on the house from a unit above its topmost edge, with an offset to the side. Beside
 * the edge no card can hold it; on the edge the house may stand or fall. It weighs as much as ten
 * cards, or as seventy.
 */
static void make_dropped(struct fixture *f)
{
    if (f->scene->value == 0) {
        block(f, 0, 1, fixture_upright, 1);
    } else {
        block(f, f->scene->value, 1, lab_turn(0.3, 1, 0.2, 0.5), 0.15);
    }
}

/* A block is thrown at the topmost pair from the side. */
static void make_thrown(struct fixture *f)
{
    const double velocity[3] = {-f->scene->value, 0, 1}, spin[3] = {3, 2, 1};

    fixture_throw(f, block(f, 2, -0.3, fixture_upright, 0.3), velocity, spin);
}

static bool judge_house(struct fixture *f)
{
    double tilt = 0;

    for (int i = 1; i < f->body_count; i++) {
        tilt = fmax(tilt, fixture_tilt(f, i, 2));
    }
    fixture_say(f, "tilt %.5f rad", tilt);
    return tilt < 0.03 && fixture_farthest(f) < f->mark[3];
}

/* The block ends on a card of the level below or deeper, and all is at rest. */
static bool judge_dropped(struct fixture *f)
{
    int block = (int)f->mark[2];
    double height = f->bodies[block].now.position[2], fastest = fixture_fastest(f);

    fixture_say(f, "block at %.2f of %.2f, fastest %.3f/s", height, f->mark[1], fastest);
    return (f->scene->value == 0 || height < f->mark[0] + 0.35) && fastest < 0.1;
}

/* The topmost pair, the last two cards before the block, has left its place, and all is at rest. */
static bool judge_thrown(struct fixture *f)
{
    int last = (int)f->mark[2] - 1;
    double moved = fmin(fixture_drift(f, last), fixture_drift(f, last - 1));
    double fastest = fixture_fastest(f);

    fixture_say(f, "topmost cards moved %.2f, fastest %.3f/s", moved, fastest);
    return moved > 0.1 && fastest < 0.1;
}

#define HOUSE(name, brief, n, mu)                                                                  \
    {                                                                                              \
        name, "stands", 1000, brief, make_house, NULL, judge_house, n, 0, mu                       \
    }
#define DROP(name, brief, n, aside, mu)                                                            \
    {                                                                                              \
        name, (aside) == 0 ? "comes to rest" : "comes to rest with the block below", 1000, brief,  \
            make_dropped, NULL, judge_dropped, n, aside, mu                                        \
    }
#define THROW(name, brief, n, speed, mu)                                                           \
    {                                                                                              \
        name, "loses its top and comes to rest", 1000, brief, make_thrown, NULL, judge_thrown, n,  \
            speed, mu                                                                              \
    }
const struct fixture_scene fixture_cards[] = {HOUSE("cards2", 120, 2, 0.8),
                                              HOUSE("cards3", 120, 3, 0.8),
                                              HOUSE("cards4", 120, 4, 0.8),
                                              HOUSE("cards3-thin", 120, 3 + THIN, 1),
                                              HOUSE("cards4-thin", 120, 4 + THIN, 1),
                                              HOUSE("cards2-slick", 300, 2, 0.5),
                                              HOUSE("cards3-slick", 0, 3, 0.55),
                                              DROP("cards2-block", 400, 2, 0.2, 0.8),
                                              DROP("cards3-block", 1000, 3, 0.2, 0.8),
                                              DROP("cards4-block", 0, 4, 0.2, 0.8),
                                              DROP("cards3-block-left", 0, 3, -0.15, 0.8),
                                              DROP("cards3-block-near", 0, 3, 0.07, 0.8),
                                              DROP("cards3-block-far", 0, 3, 0.33, 0.8),
                                              DROP("cards3-thin-block", 0, 3 + THIN, 0.2, 1),
                                              DROP("cards4-thin-block", 0, 4 + THIN, -0.25, 1),
                                              DROP("cards2-block-upon", 0, 2, 0, 0.8),
                                              DROP("cards3-block-upon", 0, 3, 0, 0.8),
                                              DROP("cards4-block-upon", 0, 4, 0, 0.8),
                                              DROP("cards4-thin-block-upon", 0, 4 + THIN, 0, 1),
                                              THROW("cards3-thrown", 0, 3, 6, 0.8),
                                              THROW("cards4-thrown", 0, 4, 8, 0.8),
                                              THROW("cards3-thin-thrown", 500, 3 + THIN, 8, 1),
                                              {0}};

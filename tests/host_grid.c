/* SPDX-License-Identifier: MIT */
/*
 * host_grid - two bodies meet, at low and at high energy. The grid has speeds from one unit of the
 * last place to the limit, mass ratios, sizes, e and mu, with one mover or two; without gravity,
 * and with gravity above a tilted sheet. Each case has 300 frames. There may be no error, no
 * crossing and no gain of energy, and no body that is slow enough to stay may be lost.
 *
 *   host_grid         every 23rd case
 *   host_grid long    every case
 *   host_grid CASE [FROM [TO]]    one case, frame by frame
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/crowd.h"
#include "lib/open_cases.h"

#define FRAMES 300
#define STRIDE 23 /* shares no factor with the lengths of the axes */
#define SHAPES 4

static const double speeds[] = {0x1p-40, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5,
                                1e-4,    1e-3,  1e-2,  1e-1, 1,    10,   63.9};
static const double mass_ratios[] = {1e-3, 1.0 / 30, 1, 30, 1e3};
/* Approximate half sides of a and of b. */
static const double scales[] = {1.0 / 16, 1, 6.25};
static const int sizes[][2] = {{0, 0}, {0, 2}, {2, 0}, {1, 1}, {2, 2}};
static const double restitutions[] = {0, 0.5, 1}, frictions[] = {0, 0.5, 1.5};

#define COUNT(axis) ((int)(sizeof(axis) / sizeof *(axis)))
#define CASES                                                                                      \
    (COUNT(speeds) * COUNT(mass_ratios) * COUNT(sizes) * COUNT(restitutions) * COUNT(frictions) *  \
     2 * 2)

struct grid_case {
    int number, speed, size;
    double mass_ratio, e, mu;
    bool gravity, both;
};

static struct grid_case case_of(int number)
{
    struct grid_case c = {.number = number};
    int left = number;

    c.speed = left % COUNT(speeds);
    left /= COUNT(speeds);
    c.mass_ratio = mass_ratios[left % COUNT(mass_ratios)];
    left /= COUNT(mass_ratios);
    c.size = left % COUNT(sizes);
    left /= COUNT(sizes);
    c.e = restitutions[left % COUNT(restitutions)];
    left /= COUNT(restitutions);
    c.mu = frictions[left % COUNT(frictions)];
    left /= COUNT(frictions);
    c.gravity = left % 2;
    c.both = left / 2 % 2;
    return c;
}

/* The meshes: for each scale a box, a tetrahedron, an L and a ball; last the sheet. */
static struct crowd *load(void)
{
    struct crowd *crowd = crowd_new();

    for (int i = 0; i < COUNT(scales); i++) {
        const double s = scales[i], scale[3] = {2 * s, 2 * s, 2 * s};

        crowd_box(crowd, 2 * s, 1.4 * s, s);
        crowd_solid(crowd, &lab_tetrahedron, scale);
        crowd_solid(crowd, &lab_l, scale);
        crowd_ball(crowd, s);
    }
    crowd_mesh(crowd, &lab_sheet);
    crowd->config.sleep = false;
    return crowd;
}

/* Divide a speed between motion along a direction and spin about any axis. */
static void throw(struct crowd * crowd, int body, double speed, const double along[3],
                  uint64_t *random)
{
    double turning = lab_random(random, 0, 0.5), velocity[3], spin[3], axis = 0, way = 0;
    double radius = crowd->meshes[crowd->bodies[body].mesh].radius;

    for (int k = 0; k < 3; k++) {
        spin[k] = lab_random(random, -1, 1);
        axis += spin[k] * spin[k];
        way += along[k] * along[k];
    }
    for (int k = 0; k < 3; k++) {
        spin[k] *= fmin(speed * turning / radius, 60) / sqrt(axis);
        velocity[k] = along[k] * speed * (1 - turning) / sqrt(way);
    }
    crowd_move(&crowd->bodies[body].def, velocity, spin);
}

/* A tilted sheet that touches neither body; gravity points straight down. */
static void add_sheet(struct crowd *crowd)
{
    struct carom_body_def *sheet = crowd_body(crowd, SHAPES * COUNT(scales));
    const double up[3] = {0, 0, 1};
    double normal[3], depth = 0;

    sheet->rotation = lab_turn(1, 0.4, 0, 0.2);
    lab_rotate(normal, &sheet->rotation, up);
    for (int i = 0; i < 2; i++) {
        double height = 0;

        for (int k = 0; k < 3; k++) {
            height += normal[k] * lab_double(crowd->bodies[i].def.position.c[k] -
                                                 crowd->bodies[0].def.position.c[k],
                                             32);
        }
        depth = fmax(depth, 1.01 * crowd->meshes[crowd->bodies[i].mesh].radius - height);
    }
    for (int k = 0; k < 3; k++) {
        sheet->position.c[k] =
            crowd->bodies[0].def.position.c[k] - lab_fixed(depth * normal[k], 32);
    }
}

/* Body 0 is b, 1 is a, 2 the sheet. */
static void prepare(struct crowd *crowd, const struct grid_case *c)
{
    uint64_t random = 0x9e3779b97f4a7c15u * (uint64_t)(c->number + 1);
    double speed = speeds[c->speed], back[3], normal[3], along[3], point[3], gap;
    struct carom_body_def *a, *b;
    enum crowd_how how;

    crowd_clear(crowd);
    for (int i = 1; i >= 0; i--) {
        crowd_body(crowd, sizes[c->size][i] * SHAPES + (int)lab_random(&random, 0, SHAPES));
    }
    b = &crowd->bodies[0].def;
    a = &crowd->bodies[1].def;
    b->stationary = !c->both;
    b->mass_q20 = (uint32_t)lab_fixed(sqrt(1 / c->mass_ratio), 20);
    a->mass_q20 = (uint32_t)lab_fixed(sqrt(c->mass_ratio), 20);
    b->rotation = lab_random_turn(&random);
    crowd_place(b, lab_random(&random, -1000, 1000), lab_random(&random, -1000, 1000),
                lab_random(&random, -1000, 1000));
    how = (enum crowd_how)(int)lab_random(&random, 0, CROWD_HOWS);
    gap = speed * lab_random(&random, 0.2, 3) +
          crowd->meshes[crowd->bodies[1].mesh].skin * lab_random(&random, 0.5, 8);
    if (!crowd_meet(crowd, 1, 0, how, gap, lab_random(&random, 0, 1.5), &random, normal, along,
                    point)) {
        lab_expect(CAROM_ERR_ARGUMENT, "no way to meet");
    }
    throw(crowd, 1, speed, along, &random);
    if (c->both) {
        for (int k = 0; k < 3; k++) {
            back[k] = -along[k];
        }
        throw(crowd, 0, speed * lab_random(&random, 0, 1), back, &random);
    }
    crowd->config.gravity = c->gravity ? scene_config().gravity : (carom_v3_q40){{0}};
    if (c->gravity) {
        add_sheet(crowd);
    }
    crowd_surface(crowd, c->e, c->mu);
}

/* Whether a body may leave the range: it is fast enough, or far enough out. */
static bool may_leave(const struct crowd *crowd)
{
    double energy = 0;

    for (int i = 0; i < 2; i++) {
        energy += crowd->bodies[i].now.kinetic;
    }
    for (int i = 0; i < 2; i++) {
        const struct crowd_body *body = &crowd->bodies[i];

        if (body->def.stationary) {
            continue;
        }
        if (sqrt(2 * energy / body->mass) >= 63) {
            return true;
        }
        for (int k = 0; k < 3; k++) {
            if (fabs(body->now.body.position[k]) > 4096 - 64) {
                return true;
            }
        }
    }
    return false;
}

struct grid_sum {
    long runs, frames, errors, crossed, capped, hits, out, lost;
    double rise, lift, momentum;
    int worst, failed; /* case of the largest rise, first case that fails; -1: none */
};

static void show(const struct crowd *crowd, const struct crowd_tally *t, int status)
{
    struct carom_contact contacts[16];
    struct carom_stats stats = {0};
    int n = carom_contacts(crowd->world, contacts, 16);

    carom_stats(crowd->world, &stats);
    printf("# frame %ld: status %d, %u sub-steps, crossed %ld (%.1e), rise %.3g, lift %.3g\n",
           t->frames, status, stats.substeps, t->crossed, t->crossed_depth, t->rise, t->lift);
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_seen *now = &crowd->bodies[i].now;
        const struct oracle_body *b = &now->body;

        printf("#   %d: x %.9f %.9f %.9f v %.4g %.4g %.4g w %.4g %.4g %.4g, kinetic %.9g, energy "
               "%+.3g\n",
               i, b->position[0], b->position[1], b->position[2], b->velocity[0], b->velocity[1],
               b->velocity[2], b->spin[0], b->spin[1], b->spin[2], now->kinetic,
               now->kinetic + now->potential - crowd->bodies[i].before.kinetic -
                   crowd->bodies[i].before.potential);
    }
    for (int i = 0; i < n && i < 16; i++) {
        const struct carom_contact *c = &contacts[i];

        printf("#   %d on %d: gap %.3g skins of %d, impulse %.4g, normal %.6f %.6f %.6f\n", c->a,
               c->b, lab_double(c->gap_q22, 22) / crowd->meshes[crowd->bodies[c->a].mesh].skin,
               c->a, lab_double(c->impulse_q40, 40), lab_double(c->normal.c[0], 30),
               lab_double(c->normal.c[1], 30), lab_double(c->normal.c[2], 30));
    }
}

/* from .. to: the frames to print */
static void run(struct crowd *crowd, int number, struct grid_sum *sum, long from, long to)
{
    const struct grid_case c = case_of(number);
    struct crowd_tally tally = {0};
    int status;
    bool bad;

    prepare(crowd, &c);
    status = crowd_start(crowd);
    if (to > 0) {
        printf("# case %d: speed %g, mass ratio %g, size %d, e %g, mu %g, %s, %s\n", number,
               speeds[c.speed], c.mass_ratio, c.size, c.e, c.mu,
               c.gravity ? "gravity" : "no gravity", c.both ? "both move" : "one moves");
    }
    while (status >= 0 && tally.frames < FRAMES) {
        bool by_rights = may_leave(crowd);
        long out = tally.out;

        status = crowd_step(crowd, &tally);
        sum->lost += tally.out > out && !by_rights;
        if (status >= 0 && tally.frames >= from && tally.frames <= to) {
            show(crowd, &tally, status);
        }
    }
    bad = status < 0 || tally.crossed != 0 || tally.rise > 1;
    sum->runs++;
    sum->frames += tally.frames;
    sum->errors += status < 0;
    sum->crossed += tally.crossed;
    sum->capped += tally.capped;
    sum->hits += tally.hits;
    sum->out += tally.out;
    sum->lift = fmax(sum->lift, tally.lift);
    sum->momentum = fmax(sum->momentum, tally.momentum);
    if (tally.rise > sum->rise) {
        sum->rise = tally.rise;
        sum->worst = number;
    }
    if (bad && sum->failed < 0) {
        sum->failed = number;
    }
    if (bad) {
        printf(
            "# case %d fails: %s, %ld of %ld frames cross from %ld on (%.1e), rise %.3g at %ld\n",
            number, carom_result_text(status), tally.crossed, tally.frames, tally.crossed_first,
            tally.crossed_depth, tally.rise, tally.rise_frame);
    }
}

int main(int argc, char **argv)
{
    const bool whole = argc > 1 && strcmp(argv[1], "long") == 0;
    struct grid_sum sums[COUNT(speeds)] = {0};
    struct crowd *crowd = load();

    if (argc > 1 && !whole) {
        run(crowd, atoi(argv[1]), &sums[0], argc > 2 ? atol(argv[2]) : 1,
            argc > 3 ? atol(argv[3]) : FRAMES);
        return 0;
    }
    for (int i = 0; i < COUNT(speeds); i++) {
        sums[i].failed = sums[i].worst = -1;
    }
    for (int number = 0; number < CASES; number += whole ? 1 : STRIDE) {
        if (!whole && open_case("grid", number)) {
            continue;
        }
        run(crowd, number, &sums[number % COUNT(speeds)], 0, 0);
    }
    for (int i = 0; i < COUNT(speeds); i++) {
        const struct grid_sum *s = &sums[i];
        char name[32];

        snprintf(name, sizeof name, "grid/speed_%.0e", speeds[i]);
        lab_report(s->errors == 0 && s->crossed == 0 && s->rise <= 1 && s->lost == 0 && s->runs > 0,
                   name,
                   "%ld runs, %ld frames, %ld hits, %ld errors, %ld frames cross, %ld capped, %ld "
                   "out, %ld of them lost, energy rises by %.2g of the bound in case %d, %.2g m g "
                   "skin, momentum within %.1e",
                   s->runs, s->frames, s->hits, s->errors, s->crossed, s->capped, s->out, s->lost,
                   s->rise, s->worst, s->lift, s->momentum);
    }
    crowd_free(crowd);
    return lab_finish();
}

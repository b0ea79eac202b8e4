/* SPDX-License-Identifier: MIT */
/*
 * host_encounter - two bodies meet without gravity: hulls of 12 random points in free space, and a
 * box with a static box. After a meeting they part or stay together. Time goes on: no body stops
 * in its motion, and no run of frames is cut short.
 *
 *   host_encounter                 a short form
 *   host_encounter long            20 hulls x 500 meetings and 500 of boxes, for each e
 *   host_encounter hulls NUMBER    one of them frame by frame; boxes NUMBER
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/open_cases.h"
#include "lib/real.h"
#include "lib/soak.h"

#define SHAPES      20
#define EACH        500 /* meetings of a shape */
#define CUT_ALLOWED 3   /* frames in a row */
#define FRAMES      160

static const double restitutions[] = {0, 0.01, 0.5, 1};
#define RESTITUTIONS (int)(sizeof restitutions / sizeof *restitutions)

static struct soak_shape shapes[SHAPES + 2];

struct outcome {
    struct crowd_tally tally;
    struct soak_still still;
    long cut_longest, cut_run;
    int error;
};

/* Meshes 0 to SHAPES - 1 are hulls; two boxes follow. */
static struct crowd *load(void)
{
    struct crowd *crowd = crowd_new();
    struct test_random r = {12};

    crowd->config.caps = (struct carom_caps)CAROM_CAPS(2, 1, 512, 2048, 16, 2048);
    crowd->config.gravity = (carom_v3_q40){{0}};
    crowd->look_every = 4;
    for (int i = 0; i < SHAPES; i++) {
        soak_hull_of(&shapes[i], 12, 1, &r);
        crowd_mesh(crowd, &shapes[i].raw);
    }
    soak_box(&shapes[SHAPES], 1, 0.6, 0.3);
    soak_box(&shapes[SHAPES + 1], 1.4, 1.1, 0.8);
    crowd_mesh(crowd, &shapes[SHAPES].raw);
    crowd_mesh(crowd, &shapes[SHAPES + 1].raw);
    return crowd;
}

static void turn_at_random(struct carom_body_def *def, struct test_random *r)
{
    double q[4];

    soak_any_turn(r, q);
    for (int k = 0; k < 4; k++) {
        def->rotation.c[k] = (int32_t)real_round(q[k] * CAROM_ONE_Q30);
    }
}

static double radius_of(const struct crowd *crowd, int body)
{
    return crowd->meshes[crowd->bodies[body].mesh].radius;
}

/* Body 1 starts beside body 0's sphere and flies roughly at its middle; both may turn. */
static double aim(struct crowd *crowd, struct test_random *r)
{
    const double still[3] = {0};
    double from[3], beside[3], across[3], velocity[3], spin[2][3], offset;
    double speed = soak_powers(r, 0.02, 1),
           turning = soak_pick(r, 4) ? soak_powers(r, 0.001, 0.4) : 0;
    double both = radius_of(crowd, 0) + radius_of(crowd, 1);

    soak_direction(r, from);
    soak_direction(r, across);
    real_cross(beside, from, across);
    offset = soak_uniform(r, 0, 0.7) * both;
    for (int k = 0; k < 3; k++) {
        velocity[k] = -speed * from[k];
        across[k] = 1.01 * both * from[k] + offset * beside[k];
    }
    crowd_place(&crowd->bodies[1].def, across[0], across[1], across[2]);
    for (int i = 0; i < 2; i++) {
        soak_direction(r, spin[i]);
        for (int k = 0; k < 3; k++) {
            spin[i][k] *= turning;
        }
    }
    crowd_move(&crowd->bodies[1].def, velocity, spin[1]);
    if (!crowd->bodies[0].def.stationary) {
        crowd_move(&crowd->bodies[0].def, still, spin[0]);
    }
    return speed;
}

/* Prepare meeting `number` of hulls or boxes; returns the number of its frames. */
static long prepare(struct crowd *crowd, bool hulls, int number)
{
    struct test_random r = {(uint64_t)(2 * number + hulls) * 0xd1342543de82ef95u};
    int shape = number / EACH % SHAPES, e = number / EACH / (hulls ? SHAPES : 1);
    double speed, way;

    crowd_clear(crowd);
    crowd_body(crowd, hulls ? shape : SHAPES);
    crowd_body(crowd, hulls ? (shape + 1 + number % (SHAPES - 1)) % SHAPES : SHAPES + 1);
    crowd->bodies[0].def.stationary = !hulls;
    for (int i = 0; i < 2; i++) {
        crowd->bodies[i].def.mass_q20 = (uint32_t)real_round(soak_powers(&r, 1, 30) * 0x1p20);
        turn_at_random(&crowd->bodies[i].def, &r);
    }
    crowd_place(&crowd->bodies[0].def, 0, 0, 0);
    speed = aim(crowd, &r);
    crowd_surface(crowd, restitutions[e % RESTITUTIONS], soak_uniform(&r, 0, 1));
    way = 2 * (radius_of(crowd, 0) + radius_of(crowd, 1));
    return (long)fmin(FRAMES, way / speed + 30);
}

static void show_frame(const struct crowd *crowd, const struct outcome *o, int status)
{
    struct carom_contact contacts[16];
    struct carom_stats stats;
    int n = carom_contacts(crowd->world, contacts, 16);

    lab_expect(carom_stats(crowd->world, &stats), "stats");
    printf("frame %ld: %s, %u sub-steps, %u hits, still %d and %d, crossed %ld (%.3g skins)\n",
           o->tally.frames, status > 0 ? "cut short" : "whole", stats.substeps, stats.hits,
           o->still.run[0], o->still.run[1], o->tally.crossed, o->tally.crossed_skins);
    for (int i = 0; i < 2; i++) {
        const struct oracle_body *b = &crowd->bodies[i].now.body;

        printf("#   %d: x %.9f %.9f %.9f v %.6g %.6g %.6g w %.6g %.6g %.6g\n", i, b->position[0],
               b->position[1], b->position[2], b->velocity[0], b->velocity[1], b->velocity[2],
               b->spin[0], b->spin[1], b->spin[2]);
    }
    for (int i = 0; i < n && i < 16; i++) {
        printf("#   gap %.4g skins, impulse %.4g\n",
               real(contacts[i].gap_q22, 22) / crowd->meshes[crowd->bodies[1].mesh].skin,
               real(contacts[i].impulse_q40, 40));
    }
}

static void meet(struct crowd *crowd, bool hulls, int number, bool shown, struct outcome *o)
{
    long frames = prepare(crowd, hulls, number);

    memset(o, 0, sizeof *o);
    o->error = crowd_start(crowd);
    while (o->error >= 0 && o->tally.frames < frames) {
        int status = crowd_step(crowd, &o->tally);

        if (status < 0) {
            o->error = status;
            break;
        }
        soak_watch_still(crowd, &o->still, o->tally.frames);
        o->cut_run = status & CAROM_SUBSTEP_CAP ? o->cut_run + 1 : 0;
        o->cut_longest = o->cut_run > o->cut_longest ? o->cut_run : o->cut_longest;
        if (shown) {
            show_frame(crowd, o, status);
        }
    }
}

static void test(struct crowd *crowd, bool hulls, int e, int stride)
{
    const int count = (hulls ? SHAPES : 1) * EACH;
    long runs = 0, met = 0, still = 0, cut = 0, crossed = 0, errors = 0, cut_frames = 0, frames = 0;
    double rise = 0;
    int first = -1;
    char name[64], again[80] = "";

    for (int number = e * count; number < (e + 1) * count; number += stride) {
        struct outcome o;
        bool bad;

        if (stride > 1 && open_case(hulls ? "encounter hulls" : "encounter boxes", number)) {
            continue;
        }
        meet(crowd, hulls, number, false, &o);
        runs++;
        frames += o.tally.frames;
        met += o.tally.hits > 0;
        still += o.still.longest > SOAK_STILL_ALLOWED;
        cut += o.cut_longest > CUT_ALLOWED;
        cut_frames += o.tally.capped;
        crossed += o.tally.crossed + o.tally.inside > 0;
        errors += o.error < 0;
        rise = fmax(rise, o.tally.rise);
        bad = o.still.longest > SOAK_STILL_ALLOWED || o.cut_longest > CUT_ALLOWED ||
              o.tally.crossed + o.tally.inside > 0 || o.error < 0 || o.tally.rise > 1;
        first = bad && first < 0 ? number : first;
    }
    if (first >= 0) {
        snprintf(again, sizeof again, "; run host_encounter.elf %s %d", hulls ? "hulls" : "boxes",
                 first);
    }
    snprintf(name, sizeof name, "encounter/%s_e_%g", hulls ? "hulls" : "boxes", restitutions[e]);
    lab_report(first < 0 && 2 * met > runs, name,
               "%ld meetings, %ld meet, %ld stand still, %ld cut short again and again, %ld cross, "
               "%ld errors, energy %.2g of the bound, %ld of %ld frames cut short%s",
               runs, met, still, cut, crossed, errors, rise, cut_frames, frames, again);
}

int main(int argc, char **argv)
{
    const bool whole = argc > 1 && strcmp(argv[1], "long") == 0;
    struct crowd *crowd = load();

    if (argc > 2) {
        struct outcome o;

        meet(crowd, strcmp(argv[1], "hulls") == 0, atoi(argv[2]), true, &o);
        return 0;
    }
    for (int e = 0; e < RESTITUTIONS; e++) {
        test(crowd, true, e, whole ? 1 : 83);
        test(crowd, false, e, whole ? 1 : 7);
    }
    crowd_free(crowd);
    return lab_finish();
}

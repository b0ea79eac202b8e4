/* SPDX-License-Identifier: MIT */
/*
 * host_special - pairs of convex bodies in special positions (special.h): their features meet over
 * each other to within 0 .. 1/1000 unit. The test watches some frames around the meeting. No faces
 * may cross. It looks for overlaps in double precision after every frame, and within each frame up
 * to the first hit, because that motion is known. After a hit it only asks that the straight way
 * between two frames does not lead deep through the other body.
 *
 *   host_special               every STRIDE-th case
 *   host_special long          100,000 cases
 *   host_special FROM COUNT    COUNT cases beginning with FROM; a single one frame by frame
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/lab.h"
#include "lib/open_cases.h"
#include "lib/special.h"

#define CASES  100000
#define STRIDE 5 /* shares no factor with the number of classes */
#define FRAMES 8
/* Well above the rounding of doubles, and far below a unit of the last place of a position. */
#define TOLERANCE 1e-10

/*
 * Largest overlap on the straight way between two frames, as a part of the smaller body's size; for
 * bodies that do not spin fast.
 */
#define THROUGH 0.1
#define SPIN    0.3

struct tally {
    long cases, begun, hits, errors, crossed, through, frozen, capped, first;
    double deepest; /* skins */
};

/* bodies, pairs, contacts, faces, entries, candidates */
#define CAPS 2, 1, 256, 64, 0, 1024
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];

struct run {
    struct special s;
    struct carom_world *world;
    struct carom_body_state before[2], now[2]; /* lower, upper */
    bool hit;                                  /* a hit or a contact in the frame */
    double deepest;                            /* overlap, units */
    bool through, frozen, capped;
};

static int number_of(const struct run *r, int which)
{
    return r->s.upper_first ? 1 - which : which;
}

/* The gap between the bodies at a part of the way between two states. */
static double apart_between(const struct run *r, double part)
{
    struct crossing_hull hull[2];

    for (int i = 0; i < 2; i++) {
        const struct carom_body_state *from = &r->before[i], *to = &r->now[i];
        double x[3], q[4];

        for (int k = 0; k < 3; k++) {
            double start = lab_double(from->position.c[k] - r->s.def[0].position.c[k], 32);
            double end = lab_double(to->position.c[k] - r->s.def[0].position.c[k], 32);

            x[k] = start + part * (end - start);
        }
        for (int k = 0; k < 4; k++) {
            q[k] = (1 - part) * from->rotation.c[k] + part * to->rotation.c[k];
        }
        crossing_place_hull(&hull[i], &r->s.shape[i].mesh, x, q);
    }
    return crossing_apart(&hull[0], &hull[1]);
}

/* Whether a body that moves has stayed where it was. */
static bool stands(const struct run *r)
{
    bool moves = false, same = true;

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            moves |= carom_abs(r->now[i].velocity.c[k]) > (int64_t)1 << 20;
        }
        same &=
            memcmp(&r->now[i].position, &r->before[i].position, sizeof r->now[i].position) == 0 &&
            memcmp(&r->now[i].rotation, &r->before[i].rotation, sizeof r->now[i].rotation) == 0;
    }
    return moves && same;
}

static bool spins(const struct run *r)
{
    double most = 0;

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fabs(lab_double(r->now[i].spin.c[k], 40)));
        }
    }
    return most > SPIN;
}

/* Samples of a frame, so dense that no body passes a thin part between two of them. */
static int samples_of(const struct run *r)
{
    double way = 0, thin = fmin(r->s.size[0], r->s.size[1]) * 0.02;

    for (int k = 0; k < 3; k++) {
        double d = lab_double(r->now[0].position.c[k] - r->before[0].position.c[k] -
                                  r->now[1].position.c[k] + r->before[1].position.c[k],
                              32);

        way += d * d;
    }
    return (int)fmin(64, ceil(sqrt(way) / thin));
}

static void look(struct run *r, int status)
{
    const struct carom_event *events;
    int n = carom_events(r->world, &events), samples = 1;

    for (int i = 0; i < n; i++) {
        r->hit |= events[i].kind == CAROM_EVENT_HIT || events[i].kind == CAROM_EVENT_BEGIN;
    }
    for (int i = 0; i < 2; i++) {
        r->before[i] = r->now[i];
        r->now[i] = lab_state(r->world, number_of(r, i));
    }
    samples = samples_of(r);
    for (int i = 1; i <= samples; i++) {
        double deep = -apart_between(r, (double)i / samples);

        /* after a hit the way is not straight, but the straight way must not lead through */
        if (!r->hit || i == samples) {
            r->deepest = fmax(r->deepest, deep);
        } else if (!spins(r)) {
            r->through |= deep > THROUGH * fmin(r->s.size[0], r->s.size[1]);
        }
    }
    r->frozen |= stands(r);
    r->capped |= (status & CAROM_SUBSTEP_CAP) != 0;
}

static void tell(const struct run *r, int frame, int status)
{
    struct carom_contact contacts[16];
    int n = carom_contacts(r->world, contacts, 16);

    printf("# frame %d: status %d, apart %.4g skins\n", frame, status,
           apart_between(r, 1) / r->s.skin);
    for (int i = 0; i < 2; i++) {
        printf("#   %s: v %.4g %.4g %.4g w %.4g %.4g %.4g\n", i == 0 ? "lower" : "upper",
               lab_double(r->now[i].velocity.c[0], 40), lab_double(r->now[i].velocity.c[1], 40),
               lab_double(r->now[i].velocity.c[2], 40), lab_double(r->now[i].spin.c[0], 40),
               lab_double(r->now[i].spin.c[1], 40), lab_double(r->now[i].spin.c[2], 40));
    }
    for (int i = 0; i < n && i < 16; i++) {
        const struct carom_contact *c = &contacts[i];

        printf("#   gap %.4g skins, impulse %.4g, normal %.6f %.6f %.6f\n",
               lab_double(c->gap_q22, 22) / r->s.skin, lab_double(c->impulse_q40, 40),
               lab_double(c->normal.c[0], 30), lab_double(c->normal.c[1], 30),
               lab_double(c->normal.c[2], 30));
    }
}

static void introduce(const struct run *r)
{
    const struct special *s = &r->s;

    printf(
        "# case %ld %s: sizes %.3g %.3g, slopes %.0f %.0f on %.0f %.0f, offset %.2g, yaw %.3g, "
        "speed %.3g (%.3g skins), slant %.3g, spin %.2g, time %.2f, %s %s, e %.1f, weight %.2g\n",
        s->number, special_names[s->class], s->size[0], s->size[1], s->slope[0][0] * 57.3,
        s->slope[0][1] * 57.3, s->slope[1][0] * 57.3, s->slope[1][1] * 57.3, s->offset, s->yaw,
        s->speed, s->speed / s->skin, s->slant, s->spin, s->time,
        s->def[0].stationary   ? "upper"
        : s->def[1].stationary ? "lower"
                               : "both",
        s->upper_first ? "as b" : "as a", lab_double(s->def[0].restitution_q30, 30), s->weight);
}

static void run(struct tally *t, long number, bool told)
{
    static struct run r;
    struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    int status = CAROM_OK;
    double skins;

    memset(&r, 0, sizeof r);
    special_make(&r.s, number);
    t->cases++;
    config.gravity = r.s.gravity;
    lab_expect(carom_world_init(block, sizeof block, &config, &r.world), "world");
    for (int i = 0; i < 2 && status >= 0; i++) {
        status = carom_body_add(r.world, &r.s.def[number_of(&r, i)]);
    }
    for (int i = 0; i < 2 && status >= 0; i++) {
        r.before[i] = r.now[i] = lab_state(r.world, number_of(&r, i));
    }
    if (status >= 0 && apart_between(&r, 1) <= 0) {
        return;
    }
    t->begun++;
    if (told) {
        introduce(&r);
        tell(&r, 0, 0);
    }
    for (int frame = 1; frame <= FRAMES && status >= 0; frame++) {
        status = carom_world_step(r.world);
        if (status >= 0) {
            look(&r, status);
        }
        if (told && status >= 0) {
            tell(&r, frame, status);
        }
    }
    skins = r.deepest / r.s.skin;
    t->hits += r.hit;
    t->errors += status < 0;
    t->crossed += r.deepest > TOLERANCE;
    t->through += r.through && r.deepest <= TOLERANCE;
    t->frozen += r.frozen;
    t->capped += r.capped;
    t->deepest = fmax(t->deepest, skins);
    if (status < 0 || r.deepest > TOLERANCE || r.through) {
        if (t->first < 0) {
            t->first = number;
        }
        if (!told) {
            introduce(&r);
            printf("#   %s, %.3g skins deep%s\n",
                   status < 0 ? carom_result_text(status) : "crosses", skins,
                   r.through ? ", through" : "");
        }
    }
}

int main(int argc, char **argv)
{
    const bool whole = argc == 2 && strcmp(argv[1], "long") == 0;
    struct tally tallies[SPECIAL_CLASSES];
    long from = argc > 2 ? atol(argv[1]) : 0, count = argc > 2 ? atol(argv[2]) : CASES;
    long step = argc > 2 || whole ? 1 : STRIDE;

    memset(tallies, 0, sizeof tallies);
    for (int i = 0; i < SPECIAL_CLASSES; i++) {
        tallies[i].first = -1;
    }
    for (long number = from; number < from + count; number += step) {
        if (step > 1 && open_case("special", number)) {
            continue;
        }
        run(&tallies[number % SPECIAL_CLASSES], number, count == 1);
    }
    for (int i = 0; i < SPECIAL_CLASSES; i++) {
        const struct tally *t = &tallies[i];
        char name[40];

        if (count == 1 && t->cases == 0) {
            continue;
        }
        snprintf(name, sizeof name, "special/%s", special_names[i]);
        lab_report(
            t->errors == 0 && t->crossed == 0 && t->through == 0 && t->hits > 0, name,
            "%ld cases, %ld begin apart, %ld meet, %ld errors, %ld cross, %.3g skins deep, %ld "
            "go through, %ld stand still, %ld cut short",
            t->cases, t->begun, t->hits, t->errors, t->crossed, t->deepest, t->through, t->frozen,
            t->capped);
    }
    return lab_finish();
}

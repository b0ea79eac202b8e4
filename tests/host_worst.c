/* SPDX-License-Identifier: MIT */
/*
 * A search for the dearest step. Worlds of a few bodies of hostile meshes (needles, plates, threads, rings, spikes) at any
 * place and speed are changed a little at a time, and what makes a count of carom_stats larger is kept. Every step on the way
 * is held against the bounds of SPEC.md, section 6.1.
 *
 *   host_worst           a short search
 *   host_worst TRIES     so many worlds for each count
 *   host_worst TRIES csv the largest of each count, and its part of the bound
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/fixture.h"
#include "lib/lab.h"

#define BODIES 4 /* that move */
#define FRAMES 4
#define TRIES  80
#define STALE  60 /* tries without a gain before the search begins anew */
#define CAPS   BODIES + 1, 16, 512, 8192, 0, 4096

/* The counts that are climbed, and their bounds. */
enum { HITS, SUBSTEPS, REFINEMENTS, GATHERS, CANDIDATES, SWEEPS, COUNTS };
static const char *const names[COUNTS] = {"hits",    "sub-steps",  "refinements",
                                          "gathers", "candidates", "sweeps"};

struct thrown {
    int mesh;
    double place[3], velocity[3], spin[3];
    carom_quat_q30 turn;
};
struct world {
    struct thrown bodies[BODIES];
    int count;
    double e, mu;
};

static struct fixture *meshes;
static int ground, solids; /* the mesh of the ground, the number of those that move */
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct {
    double most[COUNTS], part[COUNTS],
        faces; /* the largest; of its bound; candidates a face of the world */
    long steps, exceeded, refused;
} found;

/* --------------------------------------------------------------------- meshes */

static void make_meshes(void)
{
    static const struct fixture_scene scene = {.name = "worst"};
    static const struct fixture_thread thread = {
        0.3, {0, 0.1, 0.15, 0.25}, {0.3, 0.4, 0.4, 0.3}, 12, 12};
    struct fixture_shape *s;

    meshes = fixture_begin(&scene);
    s = &meshes->shape;
    fixture_shape_box(s, 1, 0.6, 0.3);
    fixture_mesh(meshes);
    fixture_shape_box(s, 2, 0.02, 0.02);
    fixture_mesh(meshes);
    fixture_shape_box(s, 1.5, 1.5, 0.01);
    fixture_mesh(meshes);
    fixture_shape_torus(s, 0.6, 0.2, 20, 10);
    fixture_mesh(meshes);
    fixture_shape_bolt(s, &thread);
    fixture_mesh(meshes);
    fixture_shape_spike(s, 0.5, 2);
    fixture_mesh(meshes);
    fixture_shape_hole(s, 1, 0.8, 0.5, 0.7);
    solids = fixture_mesh(meshes) + 1;
    fixture_shape_plane(s, 24, 12);
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        s->p[v][2] = v % 2 ? 0.6 : 0; /* rows of spikes */
    }
    ground = fixture_mesh(meshes);
}

/* --------------------------------------------------------------------- bounds */

static double faces_of(int mesh)
{
    return meshes->meshes[mesh].mesh.raw.face_count;
}

/* The bounds of SPEC.md for a step with these counts: each is of capacities and meshes, or of counts that are bounded before. */
static void bound(const struct world *world, const struct carom_stats *stats, double pairs,
                  double out[COUNTS])
{
    double n = world->count + 1, k = 32, product = 0;
    double paths = n * (1 + n * k + ldexp(1, 20) + n * k);

    for (int i = 0; i < world->count; i++) {
        double own = faces_of(world->bodies[i].mesh);

        product = fmax(product, own * faces_of(ground));
        for (int j = 0; j < i; j++) {
            product = fmax(product, own * faces_of(world->bodies[j].mesh));
        }
    }
    out[HITS] = n * k;
    out[SUBSTEPS] = 1 + n * k + paths;
    out[REFINEMENTS] = 8 * n * stats->substeps;
    out[GATHERS] = 2 * (2 * 64 + n) * pairs * (stats->substeps + stats->refinements + n);
    out[CANDIDATES] = stats->gathers * 120.0 * product;
    out[SWEEPS] = n * (1 + 2 * stats->hits) * 10 * (3 * 120 + 60 + 16);
}

static void hold(const struct world *world, struct carom_world *w, double score[COUNTS])
{
    struct carom_usage usage[CAROM_POOL_COUNT];
    struct carom_stats stats;
    double most[COUNTS], faces = faces_of(ground);

    lab_expect(carom_stats(w, &stats), "stats");
    lab_expect(carom_usage(w, usage), "usage");
    bound(world, &stats, usage[CAROM_POOL_pairs].size, most);
    const double counts[COUNTS] = {stats.hits,    stats.substeps,   stats.refinements,
                                   stats.gathers, stats.candidates, stats.sweeps};

    for (int i = 0; i < world->count; i++) {
        faces += faces_of(world->bodies[i].mesh);
    }
    for (int c = 0; c < COUNTS; c++) {
        score[c] = fmax(score[c], counts[c]);
        found.most[c] = fmax(found.most[c], counts[c]);
        found.part[c] = fmax(found.part[c], most[c] > 0 ? counts[c] / most[c] : 0);
        if (counts[c] > most[c]) {
            found.exceeded++;
            printf("# %s %g above its bound %g\n", names[c], counts[c], most[c]);
        }
    }
    found.faces = fmax(found.faces, stats.candidates / faces);
    found.steps++;
}

/* ---------------------------------------------------------------------- worlds */

static bool add(struct carom_world *w, const struct world *world, const struct thrown *b)
{
    struct carom_body_def def = {.mesh = &meshes->meshes[b->mesh].mesh,
                                 .rotation = b->turn,
                                 .mass_q20 = 1 << 20,
                                 .restitution_q30 = (int32_t)lab_fixed(world->e, 30),
                                 .friction_q16 = (uint32_t)lab_fixed(world->mu, 16),
                                 .overlap = CAROM_OVERLAP_PUSH_OUT};

    for (int k = 0; k < 3; k++) {
        def.position.c[k] = lab_fixed(b->place[k], 32);
        def.velocity.c[k] = lab_fixed(b->velocity[k], 40);
        def.spin.c[k] = lab_fixed(b->spin[k], 40);
    }
    return carom_body_add(w, &def) >= 0;
}

/* Play a world; returns whether it could be made. Scores are the largest counts of a step. */
static bool play(const struct world *world, double score[COUNTS])
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_body_def still = {.mesh = &meshes->meshes[ground].mesh, .stationary = true};
    struct carom_world *w;

    memset(score, 0, COUNTS * sizeof *score);
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    still.restitution_q30 = (int32_t)lab_fixed(world->e, 30);
    still.friction_q16 = (uint32_t)lab_fixed(world->mu, 16);
    lab_expect(carom_world_init(block, sizeof block, &config, &w), "world");
    lab_expect(carom_body_add(w, &still), "ground");
    for (int i = 0; i < world->count; i++) {
        if (!add(w, world, &world->bodies[i])) {
            return false;
        }
    }
    for (int frame = 0; frame < FRAMES; frame++) {
        if (carom_world_step(w) < 0) {
            found.refused++;
            return false;
        }
        hold(world, w, score);
    }
    return true;
}

/* A length from 0 to `most`, as often small as large. */
static double any_size(uint64_t *random, double most)
{
    return most * pow(10, -lab_random(random, 0, 4));
}

static void any_vector(uint64_t *random, double most, double out[3])
{
    double size = any_size(random, most);

    for (int k = 0; k < 3; k++) {
        out[k] = size * lab_random(random, -1, 1) / sqrt(3);
    }
}

static void any_body(uint64_t *random, struct thrown *b)
{
    b->mesh = (int)lab_random(random, 0, solids - 0.001);
    b->turn = lab_random_turn(random);
    any_vector(random, 3, b->place);
    b->place[2] = 2 + fabs(b->place[2]);
    any_vector(random, 40, b->velocity);
    any_vector(random, 8, b->spin);
}

static void any_world(uint64_t *random, struct world *world)
{
    world->count = 1 + (int)lab_random(random, 0, BODIES - 0.001);
    world->e = lab_random(random, 0, 1);
    world->mu = lab_random(random, 0, 1);
    for (int i = 0; i < BODIES; i++) {
        any_body(random, &world->bodies[i]);
    }
}

/* Change one thing a little, or altogether. */
static void change(uint64_t *random, struct world *world)
{
    struct thrown *b = &world->bodies[(int)lab_random(random, 0, world->count - 0.001)];
    double *vectors[3] = {b->place, b->velocity, b->spin}, by[3];
    int what = (int)lab_random(random, 0, 6.999);

    if (what < 3) {
        any_vector(random, what == 0 ? 1 : 4, by);
        for (int k = 0; k < 3; k++) {
            vectors[what][k] += by[k];
        }
    } else if (what == 3) {
        b->turn = lab_random_turn(random);
    } else if (what == 4) {
        any_body(random, b);
    } else if (what == 5) {
        world->e = lab_random(random, 0, 1) < 0.3 ? 1 : lab_random(random, 0, 1);
        world->mu = lab_random(random, 0, 2);
    } else {
        world->count = 1 + (int)lab_random(random, 0, BODIES - 0.001);
    }
}

/* Climb one count. */
static void climb(int count, long tries)
{
    uint64_t random = 1000 + (uint64_t)count;
    struct world best, next;
    double best_score = -1, score[COUNTS];
    long stale = STALE;

    for (long i = 0; i < tries; i++) {
        if (stale >= STALE) {
            any_world(&random, &next);
            best_score = -1;
        } else {
            next = best;
            change(&random, &next);
        }
        stale++;
        if (play(&next, score) && score[count] >= best_score) {
            stale = score[count] > best_score ? 0 : stale;
            best_score = score[count];
            best = next;
        } else if (best_score < 0) {
            stale = STALE;
        }
    }
}

int main(int argc, char **argv)
{
    long tries = argc > 1 ? atol(argv[1]) : TRIES;
    bool csv = argc > 2 && strcmp(argv[2], "csv") == 0;

    make_meshes();
    for (int c = 0; c < COUNTS; c++) {
        climb(c, tries);
    }
    for (int c = 0; c < COUNTS && csv; c++) {
        printf("%s,%.0f,%.2g\n", names[c], found.most[c], found.part[c]);
    }
    if (csv) {
        printf("steps,%ld,\nabove their bound,%ld,\ncandidates a face,%.1f,\n", found.steps,
               found.exceeded, found.faces);
        return found.exceeded > 0;
    }
    lab_report(
        found.exceeded == 0 && found.steps > tries, "worst/bounds",
        "%ld steps, %ld counts above their bound; most hits %.0f, sub-steps %.0f, gathers %.0f, "
        "candidates %.0f, sweeps %.0f",
        found.steps, found.exceeded, found.most[HITS], found.most[SUBSTEPS], found.most[GATHERS],
        found.most[CANDIDATES], found.most[SWEEPS]);
    lab_report(found.faces < 1024, "worst/faces", "%.1f candidates for each face of the world",
               found.faces);
    return lab_finish();
}

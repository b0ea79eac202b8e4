/* SPDX-License-Identifier: MIT */
/*
 * host_local - trouble stays local. A stack that stands and a ball that rolls have the same state,
 * bit for bit and frame by frame, with and without a body far away that spins, flies, hits or is
 * jammed. A frame with both takes no more than the two alone. Times are printed, not asserted.
 *
 *   host_local                  every trouble
 *   host_local NAME             one of them frame by frame
 *   host_local only WHAT NAME   run `alone`, `trouble` or `both` of one, to count its instructions:
 *       valgrind --tool=callgrind --toggle-collect=carom_world_step host_local.elf only both NAME
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/real.h"
#include "lib/soak.h"

#define FRAMES 200
#define STACK  5
#define WATCH  (STACK + 2) /* ground, stack and ball come first */

enum { SHEET, BOX, BALL, NEEDLE, CUBE, PLATE, SLAB };

/* A disturbance far away, at 30, 30. */
struct trouble {
    const char *name;
    void (*add)(struct crowd *crowd, double size);
    double size;
};

/* -------------------------------------------------------------------- troubles */

static struct carom_body_def *put(struct crowd *crowd, int mesh, double x, double y, double z)
{
    struct carom_body_def *def = crowd_body(crowd, mesh);

    crowd_place(def, 30 + x, 30 + y, z);
    return def;
}

/* A needle high up that turns mostly about an axis across it. */
static void add_spinner(struct crowd *crowd, double spin)
{
    const double none[3] = {0}, w[3] = {0.96 * spin, 0.28 * spin, 0};

    crowd_move(put(crowd, NEEDLE, 0, 0, 300), none, w);
}

/* The same needle, soon lying on the ground: it hits all the time. */
static void add_spinner_low(struct crowd *crowd, double spin)
{
    const double none[3] = {0}, w[3] = {0.96 * spin, 0.28 * spin, 0};

    crowd_move(put(crowd, NEEDLE, 0, 0, 1.5), none, w);
}

/* A needle that grazes a post: friction makes it turn faster than a caller may set. */
static void add_struck(struct crowd *crowd, double speed)
{
    const double none[3] = {0}, v[3] = {0, speed, -0.5 * speed};
    struct carom_body_def *post = put(crowd, SLAB, 0, 0, 300), *needle;

    post->stationary = true;
    post->friction_q16 = 1u << 16;
    needle = put(crowd, NEEDLE, 0.3, -0.27 - 1.5 * speed, 300 + 0.75 * speed);
    needle->friction_q16 = 1u << 16;
    needle->rotation = lab_turn(1, 0, 0, 0.6);
    crowd_move(needle, v, none);
}

static void add_flyer(struct crowd *crowd, double speed)
{
    const double none[3] = {0}, v[3] = {speed, 0, 0};

    crowd_move(put(crowd, CUBE, -3500, 1000, 1000), v, none);
}

/* A body flies to and fro between walls 12 units apart, without loss. */
static void add_bouncer(struct crowd *crowd, double speed)
{
    const double v[3] = {speed, 0.3 * speed, 0.1 * speed}, w[3] = {0.1, 0.2, 0.3};
    struct carom_body_def *cube;

    for (int i = 0; i < 6; i++) {
        double away = i % 2 ? 6.5 : -6.5;
        struct carom_body_def *wall = put(crowd, PLATE, i / 2 == 0 ? away : 0,
                                          i / 2 == 1 ? away : 0, 300 + (i / 2 == 2 ? away : 0));

        wall->stationary = true;
        wall->restitution_q30 = CAROM_ONE_Q30;
        wall->friction_q16 = 0;
        wall->rotation = i / 2 == 0   ? lab_turn(0, 1, 0, acos(0))
                         : i / 2 == 1 ? lab_turn(1, 0, 0, acos(0))
                                      : lab_turn(0, 0, 1, 0);
    }
    cube = put(crowd, CUBE, 0, 0, 300);
    cube->restitution_q30 = CAROM_ONE_Q30;
    cube->friction_q16 = 0;
    crowd_move(cube, v, w);
}

/* A light cube under a heavy block that comes down at an angle, without friction. */
static void add_jammed(struct crowd *crowd, double ratio)
{
    const double down[3] = {0, 0, -0.1}, none[3] = {0};
    struct carom_body_def *cube = put(crowd, CUBE, 0, 0, 0.51), *block;

    cube->mass_q20 = (uint32_t)lab_fixed(0x1p-10, 20);
    cube->friction_q16 = 0;
    block = put(crowd, BOX, 0.1, 0, 1.8);
    block->mass_q20 = (uint32_t)lab_fixed(ratio * 0x1p-10, 20);
    block->rotation = lab_turn(1, 0.3, 0, 0.2);
    crowd_move(block, down, none);
}

/* A light body between two heavy ones that approach each other, and a wall behind each. */
static void add_pressed(struct crowd *crowd, double speed)
{
    const double none[3] = {0};

    for (int i = 0; i < 2; i++) {
        const double v[3] = {i ? -speed : speed, 0, 0};
        struct carom_body_def *block = put(crowd, BOX, i ? 1.5 : -1.5, 0, 300);

        block->mass_q20 = 1000u << 20;
        block->restitution_q30 = 0;
        crowd_move(block, v, none);
    }
    put(crowd, NEEDLE, 0, 0.03, 300.02)->mass_q20 = 1u << 10;
}

static const struct trouble troubles[] = {
    {"nothing", NULL, 0},
    {"spinner_1", add_spinner, 1},
    {"spinner_8", add_spinner, 8},
    {"spinner_60", add_spinner, 60},
    {"spinner_60_that_hits", add_spinner_low, 60},
    {"struck_at_5", add_struck, 5},
    {"struck_at_26", add_struck, 26},
    {"struck_at_50", add_struck, 50},
    {"flyer_at_60", add_flyer, 60},
    {"bouncer_at_5", add_bouncer, 5},
    {"bouncer_at_50", add_bouncer, 50},
    {"jammed_by_64", add_jammed, 64},
    {"jammed_by_1000", add_jammed, 1000},
    {"pressed_at_0.1", add_pressed, 0.1},
    {"pressed_at_10", add_pressed, 10},
};
#define TROUBLES (int)(sizeof troubles / sizeof *troubles)

/* ---------------------------------------------------------------------- worlds */

static struct crowd *load(void)
{
    struct crowd *crowd = crowd_new();

    crowd->config.caps = (struct carom_caps)CAROM_CAPS(20, 100, 1024, 8192, 16, 4096);
    crowd->look_every = 10;
    crowd_mesh(crowd, &lab_sheet);
    crowd_box(crowd, 1, 0.9, 0.8);
    crowd_ball(crowd, 0.5);
    crowd_box(crowd, 2, 0.04, 0.02);
    crowd_box(crowd, 1, 1, 1);
    crowd_box(crowd, 14, 14, 1);
    crowd_box(crowd, 1, 0.5, 6);
    return crowd;
}

/* The stack and the ball, on the sheet that all worlds have. */
static void add_watched(struct crowd *crowd)
{
    const double v[3] = {0.05, 0.01, 0}, w[3] = {-0.02, 0.1, 0};

    for (int i = 0; i < STACK; i++) {
        struct carom_body_def *box = crowd_body(crowd, BOX);

        box->rotation = lab_turn(0, 0, 1, 0.1 + 0.05 * i);
        crowd_place(box, 0.01 * (i % 3), -0.01 * (i % 2), 0.802 * i + 0.402);
    }
    crowd_place(crowd_body(crowd, BALL), -10, -4, 0.51);
    crowd_move(&crowd->bodies[crowd->body_count - 1].def, v, w);
}

enum what { ALONE, TROUBLE, BOTH };

static void prepare(struct crowd *crowd, const struct trouble *trouble, enum what what)
{
    crowd_clear(crowd);
    crowd_body(crowd, SHEET);
    if (what != TROUBLE) {
        add_watched(crowd);
    }
    if (what != ALONE && trouble->add) {
        trouble->add(crowd, trouble->size);
    }
    lab_expect(crowd_start(crowd), trouble->name);
}

/* A run: the states of the watched bodies in each frame, and the statistics of the world. */
struct run {
    struct carom_body_state states[FRAMES][WATCH]; /* states of the first bodies */
    double seconds;
    double spin; /* the largest spin */
    long frames, cut;
};

static void go(struct crowd *crowd, const struct trouble *trouble, enum what what, struct run *run)
{
    prepare(crowd, trouble, what);
    run->seconds = run->spin = 0;
    run->cut = 0;
    for (run->frames = 0; run->frames < FRAMES; run->frames++) {
        double start = soak_seconds();
        int status = lab_expect(carom_world_step(crowd->world), trouble->name);

        run->seconds += soak_seconds() - start;
        run->cut += (status & CAROM_SUBSTEP_CAP) != 0;
        for (int i = 0; i < crowd->body_count; i++) {
            struct carom_body_state state = lab_state(crowd->world, i);
            double w[3];

            for (int k = 0; k < 3; k++) {
                w[k] = real(state.spin.c[k], 40);
            }
            run->spin = fmax(run->spin, real_length(w));
            if (i < WATCH) {
                run->states[run->frames][i] = state;
            }
        }
    }
}

static bool same(const struct carom_body_state *a, const struct carom_body_state *b)
{
    return memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
           memcmp(&a->rotation, &b->rotation, sizeof a->rotation) == 0 &&
           memcmp(&a->velocity, &b->velocity, sizeof a->velocity) == 0 &&
           memcmp(&a->spin, &b->spin, sizeof a->spin) == 0 && a->asleep == b->asleep &&
           a->out == b->out;
}

/* The first frame in which a watched body differs from the run without trouble; 0: none. */
static long first_difference(const struct run *alone, const struct run *both, int *body)
{
    for (long frame = 0; frame < FRAMES; frame++) {
        for (*body = 0; *body < WATCH; ++*body) {
            if (!same(&alone->states[frame][*body], &both->states[frame][*body])) {
                return frame + 1;
            }
        }
    }
    return 0;
}

/* ----------------------------------------------------------------------- tests */

static struct run alone, both, trouble_alone;

static void test(struct crowd *crowd, const struct trouble *trouble, double seconds)
{
    char name[64];
    int body;
    long frame;

    go(crowd, trouble, TROUBLE, &trouble_alone);
    go(crowd, trouble, BOTH, &both);
    frame = first_difference(&alone, &both, &body);
    snprintf(name, sizeof name, "local/%s", trouble->name);
    lab_report(
        frame == 0, name,
        "first difference in frame %ld, body %d; %ld of %d frames cut short, %ld without stack "
        "and ball; spins up to %.0f rad a frame; %.2f times the time of both alone",
        frame, frame ? body : 0, both.cut, FRAMES, trouble_alone.cut, both.spin,
        both.seconds / (seconds + trouble_alone.seconds));
}

static void show(struct crowd *crowd, const struct trouble *trouble)
{
    struct crowd_tally tally = {0};

    go(crowd, trouble, ALONE, &alone);
    prepare(crowd, trouble, BOTH);
    while (tally.frames < FRAMES) {
        int status = lab_expect(crowd_step(crowd, &tally), trouble->name);
        struct carom_stats stats;

        lab_expect(carom_stats(crowd->world, &stats), "stats");
        printf(
            "frame %ld: %s, %u sub-steps, %u hits, %u candidates, other than alone:", tally.frames,
            status > 0 ? "cut short" : "whole", stats.substeps, stats.hits, stats.candidates);
        for (int i = 0; i < WATCH; i++) {
            struct carom_body_state state = lab_state(crowd->world, i);

            if (!same(&state, &alone.states[tally.frames - 1][i])) {
                printf(" %d", i);
            }
        }
        puts("");
    }
}

int main(int argc, char **argv)
{
    static const char *const whats[] = {"alone", "trouble", "both"};
    const bool only = argc == 4 && strcmp(argv[1], "only") == 0;
    struct crowd *crowd = load();
    double seconds;

    for (int i = 0; i < TROUBLES && argc > 1; i++) {
        for (int what = 0; what < 3 && only; what++) {
            if (strcmp(argv[2], whats[what]) == 0 && strcmp(argv[3], troubles[i].name) == 0) {
                go(crowd, &troubles[i], (enum what)what, &both);
            }
        }
        if (!only && strcmp(argv[1], troubles[i].name) == 0) {
            show(crowd, &troubles[i]);
        }
    }
    if (argc == 1) {
        go(crowd, &troubles[0], ALONE, &alone);
        seconds = alone.seconds;
        for (int i = 0; i < TROUBLES; i++) {
            test(crowd, &troubles[i], seconds);
        }
    }
    crowd_free(crowd);
    return argc == 1 ? lab_finish() : 0;
}

/* SPDX-License-Identifier: MIT */
/*
 * host_kinematic - kinematic bodies in worlds that are too large for small boards: a door that
 * closes on a box, on a stack and on a head; a platform that carries a stack; a crusher; a piston;
 * and random worlds in which some bodies are led, smoothly and by jerks. The independent checker
 * counts crossing faces in every frame.
 *
 *   host_kinematic.elf [long | WORLD]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/real.h"
#include "lib/soak.h"

#define FRAMES      1000
#define FRAMES_LONG 10000
#define WORLDS      60
#define WORLDS_LONG 1000

static const double pi = 3.14159265358979;

static struct crowd *begin(void)
{
    struct crowd *crowd = crowd_new();
    int ground = crowd_mesh(crowd, &lab_sheet);

    crowd_body(crowd, ground);
    return crowd;
}

static void lead(struct crowd *crowd, int body, const double at[3], const carom_quat_q30 *q)
{
    struct carom_pose pose = {.rotation = *q};

    for (int k = 0; k < 3; k++) {
        pose.position.c[k] = lab_fixed(at[k], 32);
    }
    lab_expect(carom_body_move_to(crowd->world, body, &pose), "move_to");
}

/* The number of events of a kind in the last step. */
static int events_of(const struct crowd *crowd, int kind)
{
    const struct carom_event *events;
    int found = 0;

    for (int i = carom_events(crowd->world, &events); i > 0; i--) {
        found += events[i - 1].kind == kind;
    }
    return found;
}

static void report(struct crowd *crowd, const struct crowd_tally *t, const char *name, long blocked)
{
    lab_report(t->crossed == 0 && t->inside == 0 && t->out == 0, name,
               "%ld of %ld frames cross, first %ld of %d and %d, %.1e deep; %ld inside, %ld out; "
               "blocked in %ld, capped in %ld",
               t->crossed, t->frames, t->crossed_first, t->crossed_pair[0], t->crossed_pair[1],
               t->crossed_depth, t->inside, t->out, blocked, t->capped);
    crowd_free(crowd);
}

/* ---------------------------------------------------------------------- a door */

/*
 * A door of 2 x 0.1 x 2 turns about its edge at the origin, to and fro by 0 .. 2 radians. Walls
 * around it hold the bodies that it sweeps.
 */
static void door_at(struct crowd *crowd, int body, double angle)
{
    const double at[3] = {cos(angle) * 1.05, sin(angle) * 1.05, 1.02};
    carom_quat_q30 q = lab_turn(0, 0, 1, angle);

    lead(crowd, body, at, &q);
}

static void run_door(struct crowd *crowd, int door, const char *name, long frames, double rate)
{
    struct crowd_tally t = {0};
    long blocked = 0;
    double angle = 0, way = rate;
    int stopped = 0;

    lab_expect(crowd_start(crowd), name);
    for (long frame = 1; frame <= frames; frame++) {
        struct carom_body_state now;

        angle += way;
        if (angle < 0 || angle > 2) {
            way = -way;
            angle += 2 * way;
        }
        door_at(crowd, door, angle);
        lab_expect(crowd_step(crowd, &t), "step");
        blocked += events_of(crowd, CAROM_EVENT_BLOCKED) > 0;
        lab_expect(carom_body_get(crowd->world, door, &now), "get");
        /* continue from where it is, so that no step asks for more than one frame's turn */
        angle = 2 * atan2(now.rotation.c[3], now.rotation.c[0]);
        stopped = events_of(crowd, CAROM_EVENT_BLOCKED) > 0 ? stopped + 1 : 0;
        if (stopped > 20) {
            way = -way;
            stopped = 0;
        }
    }
    report(crowd, &t, name, blocked);
}

static struct crowd *with_door(int *door)
{
    static const double walls[4][2] = {{-1.3, 1}, {3, 1}, {1, -1.1}, {1, 3}};
    struct crowd *crowd = begin();
    struct carom_body_def *def;
    int mesh[2] = {crowd_box(crowd, 1, 6, 6), crowd_box(crowd, 6, 1, 6)};

    def = crowd_body(crowd, crowd_box(crowd, 2, 0.1, 2));
    def->kinematic = true;
    crowd_place(def, 1.05, 0, 1.02);
    *door = 1;
    for (int i = 0; i < 4; i++) {
        def = crowd_body(crowd, mesh[i / 2]);
        def->stationary = true;
        crowd_place(def, walls[i][0], walls[i][1], 2.99);
    }
    return crowd;
}

static void test_doors(long frames)
{
    struct lab *head = lab_load_scene("head");
    struct crowd *crowd;
    int door, box;

    crowd = with_door(&door);
    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.8, 0.6, 0.7)), 1, 1.4, 0.36);
    run_door(crowd, door, "kinematic/door_box", frames, 0.02);
    crowd = with_door(&door);
    box = crowd_box(crowd, 0.6, 0.6, 0.4);
    for (int i = 0; i < 4; i++) {
        crowd_place(crowd_body(crowd, box), 0.9, 1.2, 0.21 + 0.401 * i);
    }
    run_door(crowd, door, "kinematic/door_stack", frames, 0.02);
    crowd = with_door(&door);
    crowd_place(crowd_body(crowd, crowd_mesh(crowd, &head->scene.mesh[0]->raw)), 0.8, 1.3, 1.2);
    run_door(crowd, door, "kinematic/door_head", frames, 0.05);
    lab_free(head);
}

/* ------------------------------------------------------------------- a platform */

static void test_platform(long frames)
{
    struct crowd *crowd = begin();
    struct crowd_tally t = {0};
    struct carom_body_def *def = crowd_body(crowd, crowd_box(crowd, 2, 2, 0.2));
    int box = crowd_box(crowd, 0.5, 0.4, 0.3), rises = 0;
    double start[5][3], creep = 0;
    long blocked = 0;
    carom_quat_q30 none = {{CAROM_ONE_Q30, 0, 0, 0}};

    def->kinematic = true;
    crowd_place(def, 0, 0, 3);
    for (int i = 0; i < 5; i++) {
        crowd_place(crowd_body(crowd, box), 0.1, 0.05, 3.2503 + 0.3003 * i);
    }
    lab_expect(crowd_start(crowd), "platform");
    for (long frame = 1; frame <= frames; frame++) {
        /* each way begins and ends at rest: 1.5 units to and fro, 1 up and down */
        double phase = 2 * pi * (double)(frame > 100 ? frame - 100 : 0) / 240;
        const double at[3] = {0.75 * (1 - cos(phase)), 0.3 * (1 - cos(phase / 2)),
                              3 + 0.5 * (1 - cos(phase * 0.75))};

        lead(crowd, 1, at, &none);
        lab_expect(crowd_step(crowd, &t), "step");
        blocked += events_of(crowd, CAROM_EVENT_BLOCKED) > 0;
        for (int i = 0; i < 5 && frame >= 100; i++) {
            for (int k = 0; k < 3; k++) {
                double d = crowd->bodies[2 + i].now.body.position[k] - at[k];

                if (frame == 100) {
                    start[i][k] = d;
                }
                creep = fmax(creep, fabs(d - start[i][k]));
            }
        }
        rises += crowd->bodies[2].now.state.asleep && frame > 200;
    }
    lab_report(creep < 1e-3 && rises == 0, "kinematic/platform_carries",
               "five boxes creep by %.1e in %ld frames", creep, frames);
    report(crowd, &t, "kinematic/platform", blocked);
}

/* --------------------------------------------------------------------- a crusher */

/* A plate moves down on a box as far as the ground, and up again, over and over. */
static void test_crusher(long frames, double tilt, const char *name)
{
    struct crowd *crowd = begin();
    struct crowd_tally t = {0};
    struct carom_body_def *def = crowd_body(crowd, crowd_box(crowd, 2, 2, 0.2));
    carom_quat_q30 q = lab_turn(1, 0.3, 0, tilt);
    long blocked = 0, reached = 0;
    double lowest = 10;

    def->kinematic = true;
    def->rotation = q;
    crowd_place(def, 0, 0, 2);
    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.6, 0.5, 0.4)), 0.1, 0.05, 0.22);
    lab_expect(crowd_start(crowd), name);
    for (long frame = 1; frame <= frames; frame++) {
        struct carom_body_state now = lab_state(crowd->world, 1);
        double z = real(now.position.c[2], 32), to = frame % 400 < 200 ? z - 0.02 : z + 0.02;
        const double at[3] = {0, 0, fmin(2, to)};

        lead(crowd, 1, at, &q);
        lab_expect(crowd_step(crowd, &t), "step");
        blocked += events_of(crowd, CAROM_EVENT_BLOCKED) > 0;
        z = real(lab_state(crowd->world, 1).position.c[2], 32);
        reached += z <= 0.4 + 0.1;
        lowest = fmin(lowest, z);
    }
    lab_report(blocked > frames / 10 && reached == 0 && lowest < (tilt > 0 ? 1.2 : 0.51), name,
               "blocked in %ld of %ld frames, %.4f the lowest", blocked, frames, lowest);
    report(crowd, &t, "kinematic/crusher_crosses", blocked);
}

/* A piston pushes a row of boxes to and fro against a wall. */
static void test_piston(long frames)
{
    struct crowd *crowd = begin();
    struct crowd_tally t = {0};
    struct carom_body_def *def = crowd_body(crowd, crowd_box(crowd, 0.4, 1, 1));
    int box = crowd_box(crowd, 0.5, 0.4, 0.3);
    long blocked = 0;
    double pushed = 0;
    carom_quat_q30 none = {{CAROM_ONE_Q30, 0, 0, 0}};

    def->kinematic = true;
    crowd_place(def, -1, 0, 0.52);
    for (int i = 0; i < 6; i++) {
        crowd_place(crowd_body(crowd, box), -0.5 + 0.52 * i, 0.02 * i, 0.1503);
    }
    lab_expect(crowd_start(crowd), "piston");
    for (long frame = 1; frame <= frames; frame++) {
        const double at[3] = {-1 + 1.5 * (1 - cos(2 * pi * (double)frame / 300)), 0, 0.52};

        lead(crowd, 1, at, &none);
        lab_expect(crowd_step(crowd, &t), "step");
        blocked += events_of(crowd, CAROM_EVENT_BLOCKED) > 0;
        pushed = fmax(pushed, crowd->bodies[7].now.body.position[0]);
    }
    lab_report(pushed > 4 && blocked < frames / 50, "kinematic/piston_pushes",
               "the last of six boxes to %.2f, blocked in %ld frames", pushed, blocked);
    report(crowd, &t, "kinematic/piston", blocked);
}

/* ------------------------------------------------------------------ random worlds */

/* Events of touching with a kinematic body. */
static int hits_of_led(const struct crowd *crowd)
{
    const struct carom_event *e;
    int found = 0;

    for (int i = carom_events(crowd->world, &e); i > 0; i--) {
        found += e[i - 1].kind <= CAROM_EVENT_HIT && crowd->bodies[e[i - 1].b].def.kinematic;
    }
    return found;
}

/*
 * A pen of 2 x 2 units with bodies in it. Some of them are kinematic, and the others cannot get
 * away.
 */
static void make_pen(struct soak_world *w, uint64_t number, struct test_random *r)
{
    static const double walls[4][2] = {{-1.6, 0}, {1.6, 0}, {0, -1.6}, {0, 1.6}};
    struct crowd *crowd = w->crowd = crowd_new();
    int ground = crowd_mesh(crowd, &lab_sheet), long_x = crowd_box(crowd, 4, 1, 6),
        long_y = crowd_box(crowd, 1, 4, 6), count = 4 + soak_pick(r, 9);

    w->seed = number;
    w->moving = count;
    crowd_body(crowd, ground);
    for (int i = 0; i < 4; i++) {
        struct carom_body_def *def = crowd_body(crowd, walls[i][0] == 0 ? long_x : long_y);

        def->stationary = true;
        crowd_place(def, walls[i][0], walls[i][1], 2.99);
    }
    for (int i = 0; i < count; i++) {
        struct soak_shape *shape = &w->shapes[i];
        struct carom_body_def *def;
        double q[4], length = 0;

        soak_solid(shape, (enum soak_kind)soak_pick(r, SOAK_KINDS), soak_uniform(r, 0.1, 0.45), r);
        def = crowd_body(crowd, crowd_mesh(crowd, &shape->raw));
        crowd_place(def, i % 2 ? 0.5 : -0.5, i / 2 % 2 ? 0.5 : -0.5, 0.55 + i / 4);
        def->mass_q20 = (uint32_t)lab_fixed(soak_powers(r, 0.01, 10), 20);
        for (int k = 0; k < 4; k++) {
            q[k] = soak_uniform(r, -1, 1);
            length += q[k] * q[k];
        }
        for (int k = 0; k < 4; k++) {
            def->rotation.c[k] = (int32_t)lab_fixed(q[k] / sqrt(length), 30);
        }
        def->restitution_q30 = (int32_t)lab_fixed(soak_uniform(r, 0, 1), 30);
        def->friction_q16 = (uint32_t)lab_fixed(soak_uniform(r, 0, 1.5), 16);
    }
}

static bool play(uint64_t number, bool pen, struct crowd_tally *sum, long *blocked, bool loud)
{
    static struct soak_world w;
    static struct soak_leader leaders[CROWD_BODIES];
    struct test_random r = {number * 0x9e3779b97f4a7c15u};
    struct soak_result result;
    bool good;

    if (pen) {
        make_pen(&w, number, &r);
    } else {
        soak_make(&w, number);
    }
    w.crowd->look_every = 1;
    for (int i = w.crowd->body_count - w.moving; i < w.crowd->body_count; i++) {
        struct carom_body_def *def = &w.crowd->bodies[i].def;

        if (soak_pick(&r, 3) == 0) {
            def->kinematic = true;
            memset(&def->velocity, 0, sizeof def->velocity);
            memset(&def->spin, 0, sizeof def->spin);
            soak_leader_begin(&leaders[i], def, w.crowd->meshes[w.crowd->bodies[i].mesh].radius,
                              &r);
        }
    }
    good = soak_start(&w, &result);
    if (!good) {
        printf("# world %llu: error %d\n", (unsigned long long)number, result.error);
    }
    for (int i = 0; loud && i < w.crowd->body_count; i++) {
        const struct carom_body_def *def = &w.crowd->bodies[i].def;

        printf("# body %d: %s, %u faces, radius %.3f, mesh kind %d, at %.3f %.3f %.3f\n", i,
               def->kinematic    ? "kinematic"
               : def->stationary ? "stationary"
                                 : "moves",
               def->mesh->raw.face_count, w.crowd->meshes[w.crowd->bodies[i].mesh].radius,
               def->mesh->raw.kind, real(def->position.c[0], 32), real(def->position.c[1], 32),
               real(def->position.c[2], 32));
    }
    for (long frame = 1; frame <= 300 && good; frame++) {
        int status;

        for (int i = 0; i < w.crowd->body_count; i++) {
            if (w.crowd->bodies[i].def.kinematic) {
                soak_lead(w.crowd->world, i, &leaders[i], frame, &r);
            }
        }
        status = crowd_step(w.crowd, &result.tally);
        *blocked += events_of(w.crowd, CAROM_EVENT_BLOCKED);
        sum->hits += hits_of_led(w.crowd);
        if (status < 0 || (loud && result.tally.crossed == 1)) {
            printf("# world %llu frame %ld: status %d\n", (unsigned long long)number, frame,
                   status);
            good = status >= 0;
            break;
        }
    }
    if (result.tally.crossed + result.tally.inside > 0) {
        printf(
            "# world %llu: crosses from frame %ld on, %d and %d, %.2e deep, %.2e skins; %ld inside "
            "from %ld on, %d in %d\n",
            (unsigned long long)number, result.tally.crossed_first, result.tally.crossed_pair[0],
            result.tally.crossed_pair[1], result.tally.crossed_depth, result.tally.crossed_skins,
            result.tally.inside, result.tally.inside_first, result.tally.inside_pair[0],
            result.tally.inside_pair[1]);
    }
    sum->frames += result.tally.frames;
    sum->crossed += result.tally.crossed;
    sum->inside += result.tally.inside;
    sum->capped += result.tally.capped;
    soak_free(&w);
    return good;
}

static void test_random(bool pen, uint64_t from, uint64_t count)
{
    struct crowd_tally sum = {0};
    long blocked = 0;
    bool good = true;

    for (uint64_t n = from; n < from + count; n++) {
        good = play(n, pen, &sum, &blocked, count == 1) && good;
    }
    lab_report(
        good && sum.crossed == 0 && sum.inside == 0, pen ? "kinematic/pens" : "kinematic/random",
        "%ld crossed and %ld inside of %ld frames in %llu worlds; %ld met, %ld blocked, %ld capped",
        sum.crossed, sum.inside, sum.frames, (unsigned long long)count, sum.hits, blocked,
        sum.capped);
}

int main(int argc, char **argv)
{
    const bool whole = argc > 1 && strcmp(argv[1], "long") == 0;
    const long frames = whole ? FRAMES_LONG : FRAMES;

    if (argc > 1 && !whole) {
        test_random(argc > 3, strtoull(argv[1], NULL, 10),
                    argc > 2 ? strtoull(argv[2], NULL, 10) : 1);
        return lab_finish();
    }
    test_doors(frames);
    test_platform(frames);
    test_crusher(frames, 0, "kinematic/crusher");
    test_crusher(frames, 0.3, "kinematic/crusher_tilted");
    test_piston(frames);
    test_random(false, 1, whole ? WORLDS_LONG : WORLDS);
    test_random(true, 1, whole ? WORLDS_LONG : WORLDS);
    return lab_finish();
}

/* SPDX-License-Identifier: MIT */
/*
 * host_rules - random worlds of filters, sensors and bodies that pass, against double precision.
 *
 *   sensors  what overlaps a sensor at the end of a frame, by all pairs of faces; what went through within a frame,
 *            where paths are known: bodies that meet nobody and do not turn
 *   unseen   a heap with and without sensors, bit for bit
 *   pushed   bodies put into others at random, pushed out: nothing crosses, then or later
 *   freed    bodies that a filter lets touch while they overlap: no energy out of nothing
 */
#include <math.h>
#include <string.h>

#include "lib/crowd.h"
#include "lib/real.h"

#define NEAR 3e-5 /* an overlap that small may be missing in the query's answer, units */

static const struct oracle_mesh *mesh_of(const struct crowd *crowd, int body)
{
    return &crowd->meshes[crowd->bodies[body].mesh].solid;
}

static struct oracle_pose pose_of(const struct crowd *crowd, int body)
{
    return lab_pose_of(crowd->world, body, crowd->bodies[body].def.mesh);
}

static int random_shape(struct crowd *crowd, uint64_t *random)
{
    const struct carom_mesh_raw *const raws[] = {&lab_box, &lab_tetrahedron, &lab_l, &lab_plate};
    const double size = lab_random(random, 0.4, 2);
    const double scale[3] = {size * lab_random(random, 0.5, 1.5), size, size};

    return crowd_solid(crowd, raws[(int)lab_random(random, 0, 3.999)], scale);
}

static struct carom_body_def *random_body(struct crowd *crowd, int mesh, double spread,
                                          uint64_t *random)
{
    struct carom_body_def *def = crowd_body(crowd, mesh);

    crowd_place(def, lab_random(random, -spread, spread), lab_random(random, -spread, spread),
                lab_random(random, -spread, spread));
    def->rotation = lab_random_turn(random);
    def->mass_q20 = 1 << 20;
    def->overlap = CAROM_OVERLAP_PUSH_OUT;
    return def;
}

static struct crowd *begin(void)
{
    struct crowd *crowd = crowd_new();

    crowd->config.caps = (struct carom_caps)CAROM_CAPS(40, 600, 2048, 16384, 0, 8192);
    return crowd;
}

/* ------------------------------------------------------------------- sensors */

struct tally {
    long asked, overlaps, near, wrong;     /* pairs at the ends of frames */
    long flown, through, missed, invented; /* within frames */
};

static int count_events(const struct crowd *crowd, int kind, int sensor, int visitor)
{
    const struct carom_event *events;
    int count = carom_events(crowd->world, &events), found = 0;

    for (int i = 0; i < count; i++) {
        found += events[i].kind == kind && events[i].a == sensor && events[i].b == visitor;
    }
    return found;
}

/*
 * Whether a body that flies straight and does not turn overlaps a sensor on its way; the answers
 * are those of `overlap`.
 */
static int overlaps_on_way(const struct crowd *crowd, int sensor, int body,
                           const struct oracle_pose before[2], const struct oracle_pose after[2])
{
    int most = 0;

    for (int step = 1; step < 128 && most < 1; step++) {
        struct oracle_pose at[2] = {before[0], before[1]};
        int found;

        for (int k = 0; k < 3; k++) {
            for (int i = 0; i < 2; i++) {
                at[i].position[k] += (after[i].position[k] - before[i].position[k]) * step / 128.0;
            }
        }
        found = crowd_overlap(crowd, sensor, body, &at[0], &at[1], NEAR);
        most = found == 1 ? 1 : found == -1 && most == 0 ? -1 : most;
    }
    return most;
}

/* Straight flight: a filter lets bodies pass each other; sensors are static or fly. */
static void watch_sensors(uint64_t seed, bool turn, struct tally *tally)
{
    enum { SENSORS = 3, BODIES = 9, FRAMES = 12 };
    uint64_t random = seed;
    struct crowd *crowd = begin();
    bool in[SENSORS][BODIES] = {{false}};

    crowd->config.gravity = (carom_v3_q40){{0, 0, 0}};
    for (int i = 0; i < BODIES; i++) {
        struct carom_body_def *def = random_body(crowd, random_shape(crowd, &random), 2, &random);
        double v[3], w[3];

        for (int k = 0; k < 3; k++) {
            v[k] = lab_random(&random, -1, 1) * (i % 3 == 0 ? 4 : 0.2);
            w[k] = turn ? lab_random(&random, -0.3, 0.3) : 0;
        }
        def->sensor = i < SENSORS;
        def->stationary = i == 0;
        def->filter = (struct carom_filter){1, 0xffff, 0};
        if (i >= SENSORS) { /* they meet sensors only */
            def->filter = (struct carom_filter){2, 1, 0};
        }
        crowd_move(def, v, w);
    }
    lab_expect(crowd_start(crowd), "start");
    for (int frame = 0; frame < FRAMES; frame++) {
        struct oracle_pose before[BODIES], after[BODIES];

        for (int i = 0; i < BODIES; i++) {
            before[i] = pose_of(crowd, i);
        }
        lab_expect(carom_world_step(crowd->world), "step");
        for (int i = 0; i < BODIES; i++) {
            after[i] = pose_of(crowd, i);
        }
        for (int s = 0; s < SENSORS; s++) {
            for (int b = SENSORS; b < BODIES; b++) {
                int begins = count_events(crowd, CAROM_EVENT_SENSOR_BEGIN, s, b);
                int ends = count_events(crowd, CAROM_EVENT_SENSOR_END, s, b);
                int is = crowd_overlap(crowd, s, b, &after[s], &after[b], NEAR);
                bool was = in[s][b];

                in[s][b] = (was || begins > 0) && ends == 0;
                tally->asked++;
                tally->near += is == -1;
                tally->overlaps += is == 1;
                tally->wrong += (is >= 0 && in[s][b] != (is == 1)) || begins > 1 || ends > 1;
                if (!was && !in[s][b] && !turn) {
                    const struct oracle_pose from[2] = {before[s], before[b]};
                    const struct oracle_pose to[2] = {after[s], after[b]};
                    int met = overlaps_on_way(crowd, s, b, from, to);

                    tally->flown++;
                    tally->through += begins > 0;
                    tally->missed += met == 1 && begins == 0;
                    /* between two samples the body may have touched a little: nearness is enough */
                    tally->invented += met == 0 && begins > 0;
                }
            }
        }
    }
    crowd_free(crowd);
}

static void test_sensors(long worlds)
{
    struct tally tally = {0}, turning = {0};

    for (long i = 0; i < worlds; i++) {
        watch_sensors(1000 + (uint64_t)i, false, &tally);
        watch_sensors(5000 + (uint64_t)i, true, &turning);
    }
    lab_report(tally.wrong == 0 && turning.wrong == 0 && turning.overlaps + tally.overlaps > 300,
               "rules/sensors",
               "%ld pairs at the ends of frames, %ld overlap, %ld too near to say; %ld wrong",
               tally.asked + turning.asked, tally.overlaps + turning.overlaps,
               tally.near + turning.near, tally.wrong + turning.wrong);
    lab_report(tally.missed == 0 && tally.through > 5, "rules/through",
               "%ld ways within frames, %ld went through; %ld missed, %ld seen of which no "
               "sample overlaps",
               tally.flown, tally.through, tally.missed, tally.invented);
}

/* -------------------------------------------------------------------- unseen */

/* A heap falls onto a floor; the last bodies are sensors, or there are none. */
static void pour(struct crowd *crowd, uint64_t seed, bool sensors)
{
    uint64_t random = seed;

    crowd_clear(crowd);
    crowd_place(crowd_body(crowd, 0), 0, 0, -6);
    for (int i = 0; i < 10; i++) {
        random_body(crowd, 1 + i % 4, 3, &random);
    }
    for (int i = 0; i < 4; i++) {
        struct carom_body_def *def = random_body(crowd, 1 + i, 4, &random);
        const double v[3] = {0.05 * i, 0.02, 0.2}, w[3] = {0.5 * i, 0.1, 2};

        crowd_move(def, v, w);
        def->sensor = true;
        def->stationary = i % 2;
    }
    crowd->body_count -= sensors ? 0 : 4;
    lab_expect(crowd_start(crowd), "start");
}

static void test_unseen(long worlds)
{
    enum { FRAMES = 150 };
    struct crowd *with = begin(), *without = begin();
    struct crowd *both[2] = {with, without};
    long different = 0, compared = 0, sensed = 0;

    for (int n = 0; n < 2; n++) {
        uint64_t random = 77;

        crowd_mesh(both[n], &lab_sheet);
        for (int i = 0; i < 4; i++) {
            random_shape(both[n], &random);
        }
    }
    for (long world = 0; world < worlds; world++) {
        pour(with, 100 + (uint64_t)world, true);
        pour(without, 100 + (uint64_t)world, false);
        for (int frame = 0; frame < FRAMES; frame++) {
            const struct carom_event *events;
            int count;

            for (int n = 0; n < 2; n++) {
                lab_expect(carom_world_step(both[n]->world), "step");
            }
            for (int i = 0; i < without->body_count; i++) {
                struct carom_body_state a = lab_state(with->world, i);
                struct carom_body_state b = lab_state(without->world, i);

                compared++;
                different += memcmp(&a.position, &b.position, sizeof a.position) != 0 ||
                             memcmp(&a.rotation, &b.rotation, sizeof a.rotation) != 0 ||
                             memcmp(&a.velocity, &b.velocity, sizeof a.velocity) != 0 ||
                             memcmp(&a.spin, &b.spin, sizeof a.spin) != 0 || a.asleep != b.asleep;
            }
            count = carom_events(with->world, &events);
            for (int i = 0; i < count; i++) {
                sensed += events[i].kind == CAROM_EVENT_SENSOR_BEGIN;
            }
        }
    }
    lab_report(different == 0 && sensed > worlds, "rules/unseen",
               "%ld states compared, %ld differ; %ld times something came into a sensor", compared,
               different, sensed);
    crowd_free(with);
    crowd_free(without);
}

/* -------------------------------------------------------------------- pushed */

/*
 * The number of crossing pairs, and the depth of the deepest in skins. Overlaps of about a skin may
 * stay.
 */
static long crossing_pairs(const struct crowd *crowd, double *deepest)
{
    long pairs = 0;

    for (int a = 0; a < crowd->body_count; a++) {
        for (int b = 0; b < a; b++) {
            struct oracle_pose at_a = pose_of(crowd, a), at_b = pose_of(crowd, b);
            struct oracle_crossings found =
                oracle_crossings(mesh_of(crowd, a), &at_a, mesh_of(crowd, b), &at_b, 1e-9);
            double skin = fmax(crowd->meshes[crowd->bodies[a].mesh].skin,
                               crowd->meshes[crowd->bodies[b].mesh].skin);

            if (found.pairs > 0) {
                *deepest = fmax(*deepest, found.depth / skin);
            }
            pairs += crowd_overlap(crowd, a, b, &at_a, &at_b, NEAR) == 1;
        }
    }
    return pairs;
}

/*
 * Bodies are put at random into a small room. The step pushes them apart, and then they go on as
 * usual.
 */
static void test_pushed(long worlds)
{
    long crossed = 0, later = 0, moved = 0, refused = 0;
    double rise = 0, deepest = 0;

    for (long world = 0; world < worlds; world++) {
        uint64_t random = 300 + (uint64_t)world;
        struct crowd *crowd = begin();
        struct crowd_tally tally = {0};

        crowd->config.gravity = (carom_v3_q40){{0, 0, 0}};
        for (int i = 0; i < 10; i++) {
            random_body(crowd, random_shape(crowd, &random), 1, &random);
        }
        if (crowd_start(crowd) < 0) {
            refused++;
        } else {
            for (int i = 0; i < crowd->body_count; i++) {
                struct carom_body_state state = lab_state(crowd->world, i);

                moved += memcmp(&state.position, &crowd->bodies[i].def.position,
                                sizeof state.position) != 0;
            }
            crossed += crossing_pairs(crowd, &deepest);
            for (int frame = 0; frame < 30; frame++) {
                lab_expect(crowd_step(crowd, &tally), "step");
            }
            later += tally.crossed;
            rise = fmax(rise, tally.rise);
        }
        crowd_free(crowd);
    }
    lab_report(deepest < 3.5 && later <= 30 * crossed && moved > worlds && refused == 0 &&
                   rise <= 1,
               "rules/pushed",
               "%ld worlds, %ld of %ld bodies pushed out, %ld refused; %ld pairs cross at the "
               "start, the deepest by %.2g skins, %ld frames later; energy %.2g of the bound",
               worlds, moved, 10 * worlds, refused, crossed, deepest, later, rise);
}

/* --------------------------------------------------------------------- freed */

/*
 * Pairs of bodies that overlap and are freed: each leaves the other as if it were alone, and has no
 * contact inside.
 */
static void test_freed(long worlds)
{
    const struct carom_filter off = {2, 1, 0}, on = {0};
    long apart = 0, hits = 0, again = 0, overlapped = 0;
    double change = 0;

    for (long world = 0; world < worlds; world++) {
        uint64_t random = 900 + (uint64_t)world;
        struct crowd *crowd = begin();
        struct crowd_tally tally = {0};
        bool out = false;
        double first = 0;

        crowd->config.gravity = (carom_v3_q40){{0, 0, 0}};
        for (int i = 0; i < 2; i++) {
            struct carom_body_def *def =
                random_body(crowd, random_shape(crowd, &random), 0.3, &random);
            double v[3], w[3];

            for (int k = 0; k < 3; k++) {
                v[k] = lab_random(&random, -0.05, 0.05);
                w[k] = lab_random(&random, -0.1, 0.1);
            }
            def->filter = off;
            crowd_move(def, v, w);
        }
        lab_expect(crowd_start(crowd), "start");
        for (int frame = 0; frame < 120; frame++) {
            struct oracle_pose at[2] = {pose_of(crowd, 0), pose_of(crowd, 1)};
            int is = crowd_overlap(crowd, 0, 1, &at[0], &at[1], NEAR);
            double energy;

            if (frame == 2) {
                lab_expect(carom_body_set_filter(crowd->world, 0, &on), "filter");
                lab_expect(carom_body_set_filter(crowd->world, 1, &on), "filter");
                overlapped += is == 1;
                out = is == 0;
            }
            if (frame > 2 && is == 0) {
                out = true;
            }
            again += frame > 2 && out && is == 1;
            lab_expect(crowd_step(crowd, &tally), "step");
            energy = crowd->bodies[0].now.kinetic + crowd->bodies[1].now.kinetic;
            first = frame == 0 ? energy : first;
            change = fmax(change, energy / first - 1);
        }
        apart += out;
        hits += tally.hits;
        crowd_free(crowd);
    }
    lab_report(overlapped > worlds / 2 && again == 0 && change < 1e-6 && apart > worlds / 2,
               "rules/freed",
               "%ld pairs, %ld overlap when they are freed, %ld come apart, %ld frames in which "
               "they cross again; %ld hits later; energy rises by %.2g at most",
               worlds, overlapped, apart, again, hits, change);
}

int main(int argc, char **argv)
{
    long scale = argc > 1 && strcmp(argv[1], "long") == 0 ? 10 : 1;

    test_sensors(60 * scale);
    test_unseen(6 * scale);
    test_pushed(20 * scale);
    test_freed(60 * scale);
    return lab_finish();
}

/* SPDX-License-Identifier: MIT */
/*
 * accuracy_momentum - linear and angular momentum of a crowd without gravity and without ground.
 *
 * Runs of 32 bodies that fly at a common centre, collide there over and over, and fly apart: boxes,
 * tetrahedra, Ls, plates and balls of half a unit to two, masses of 1/8 to 8, e from 0 to 1 and mu
 * from 0 to 1.5. Sums are exact, in whole numbers of 128 bits.
 *
 *   linear_momentum   a case is a frame; the error is the largest component of the change of the sum
 *                     of all momenta over it, in units of the last place, 2^-40. It must be 0.
 *   angular_momentum  a case is a frame with a hit; the error is the length of the change of the sum
 *                     of x x p + L over all bodies, about the world's origin, over the moment of what
 *                     was exchanged: half the sum of |change of p| |x| over all bodies. (For one hit
 *                     that is the impulse times the distance of the two centres from the origin.)
 *                     Left out are frames that exchange less than 2^-14 of the sum of |p| |x|, times
 *                     the root of the number of sub-steps: there the rounding of places shows, in
 *                     each 2^-33 units of every body that flies.
 */
#include <math.h>

#include "lib/accuracy.h"
#include "lib/crowd.h"
#include "world/world.h"

#define BODIES 32
#define FRAMES 80 /* frames of a run */
#define SHAPES 6

__extension__ typedef __int128 whole;

static uint64_t random_state = 3;

static double any(double low, double high)
{
    return lab_random(&random_state, low, high);
}

/* -------------------------------------------------------------------- the crowd */

static void add_shapes(struct crowd *crowd, int shape[SHAPES])
{
    const double same[3] = {1, 1, 1}, large[3] = {1.7, 1.5, 1.9};

    shape[0] = crowd_solid(crowd, &lab_box, same);
    shape[1] = crowd_solid(crowd, &lab_tetrahedron, same);
    shape[2] = crowd_solid(crowd, &lab_l, same);
    shape[3] = crowd_solid(crowd, &lab_plate, same);
    shape[4] = crowd_solid(crowd, &lab_box, large);
    shape[5] = crowd_ball(crowd, 0.4);
}

/* Place the bodies on a wide grid; each flies roughly towards the centre and turns. */
static void add_bodies(struct crowd *crowd, const int shape[SHAPES])
{
    double time = any(15, 40); /* frames until it reaches the centre */

    crowd_clear(crowd);
    for (int i = 0; i < BODIES; i++) {
        struct carom_body_def *def = crowd_body(crowd, shape[i % SHAPES]);
        const double place[3] = {2.2 * (i % 4 - 1.5), 2.2 * (i / 4 % 4 - 1.5),
                                 2.2 * (i / 16 - 0.5)};
        double velocity[3], spin[3];

        for (int k = 0; k < 3; k++) {
            velocity[k] = -place[k] / time + any(-0.3, 0.3) / time;
            spin[k] = any(-0.03, 0.03);
        }
        crowd_place(def, place[0], place[1], place[2]);
        crowd_move(def, velocity, spin);
        def->rotation = lab_random_turn(&random_state);
        def->mass_q20 = (uint32_t)lab_fixed(exp2(any(-3, 3)), 20);
        def->restitution_q30 = (int32_t)lab_fixed(any(0, 1), 30);
        def->friction_q16 = (uint32_t)lab_fixed(any(0, 1.5), 16);
    }
    lab_expect(crowd_start(crowd), "crowd");
}

/* ---------------------------------------------------------------------- momenta */

struct sums {
    whole linear[3];  /* q40 */
    whole angular[3]; /* q72 */
};

static struct sums sums_of(const struct body_state *bodies)
{
    struct sums sums = {0};

    for (int i = 0; i < BODIES; i++) {
        const int64_t *x = bodies[i].position.c, *p = bodies[i].momentum.c;

        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;

            sums.linear[k] += p[k];
            sums.angular[k] +=
                (whole)x[m] * p[n] - (whole)x[n] * p[m] + ((whole)bodies[i].angular.c[k] << 32);
        }
    }
    return sums;
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/*
 * Half the sum of |change of p| |x|. 0 when that sum is too small beside the sum of |p| |x| for the
 * number of sub-steps: each sub-step rounds every place, and these errors add up like the root of
 * their number.
 */
static double exchanged(const struct body_state *before, const struct body_state *after,
                        double substeps)
{
    double sum = 0, all = 0;

    for (int i = 0; i < BODIES; i++) {
        double change[3], x[3], p[3];

        for (int k = 0; k < 3; k++) {
            p[k] = lab_double(after[i].momentum.c[k], 40);
            change[k] = lab_double(after[i].momentum.c[k] - before[i].momentum.c[k], 40);
            x[k] = lab_double(after[i].position.c[k], 32);
        }
        sum += length(change) * length(x) / 2;
        all += length(p) * length(x);
    }
    return sum > all * sqrt(substeps) * 0x1p-14 ? sum : 0;
}

static void watch(const struct body_state *before, const struct body_state *after,
                  const struct carom_stats *stats, struct accuracy *linear,
                  struct accuracy *angular)
{
    struct sums from = sums_of(before), to = sums_of(after);
    double most = 0, change[3], scale = exchanged(before, after, stats->substeps);

    for (int k = 0; k < 3; k++) {
        most = fmax(most, fabs((double)(to.linear[k] - from.linear[k])));
        change[k] = (double)(to.angular[k] - from.angular[k]) * 0x1p-72;
    }
    accuracy_add(linear, most);
    if (stats->hits > 0 && scale > 0) {
        accuracy_add(angular, length(change) / scale);
    }
}

int main(int argc, char **argv)
{
    struct accuracy linear = accuracy_begin("linear_momentum", accuracy_cases(argc, argv, 10000));
    struct accuracy angular = accuracy_begin("angular_momentum", linear.wanted);
    struct crowd *crowd = crowd_new();
    const size_t frames = linear.wanted;
    int shape[SHAPES];

    crowd->config.gravity = (carom_v3_q40){{0, 0, 0}};
    crowd->config.sleep = false;
    crowd->config.caps.candidates = 65535; /* gather for the whole frame at once; that only saves
                                            * time */
    add_shapes(crowd, shape);
    for (size_t frame = 0; frame < frames; frame++) {
        struct body_state before[BODIES];
        struct carom_stats stats;

        if (frame % FRAMES == 0) {
            add_bodies(crowd, shape);
        }
        memcpy(before, world_now(crowd->world)->bodies, sizeof before);
        lab_expect(carom_world_step(crowd->world), "step");
        carom_stats(crowd->world, &stats);
        watch(before, world_now(crowd->world)->bodies, &stats, &linear, &angular);
    }
    /* a crowd that hardly ever meets would prove nothing */
    if (angular.count < frames / 3) {
        accuracy_fail(&angular);
    }
    crowd_free(crowd);
    accuracy_end(&linear, &(struct accuracy_bar){.max_is_zero = true});
    accuracy_end(&angular, &(struct accuracy_bar){.max = 1e-6});
    return accuracy_finish();
}

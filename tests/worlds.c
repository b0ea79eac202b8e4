/* SPDX-License-Identifier: MIT */
/*
 * worlds - a line for each of the random worlds of soak.h, unwatched, for tools/plays.py: nobody designed them, and they
 * end as committed.
 *
 *   worlds          the list below
 *   worlds NAME...  these: 12, m12 or w12, as host_soak names them
 *
 * A line is "scene NAME FRAMES AWAKE HASH" and the sums of what all its steps counted: sub-steps,
 * hits, candidates, roots, sweeps. FRAMES are those before an error, AWAKE those that end with a
 * body awake. HASH covers state, status and events of every frame. The counts show a change of the
 * engine that alters its cost alone.
 */
#include <stdio.h>
#include <stdlib.h>

#include "lib/plays.h"
#include "lib/soak.h"

#define FRAMES 120
/* How many worlds of bodies alone, machines and wild machines there are. */
static const struct {
    const char *prefix;
    int count;
} kinds[] = {{"", 60}, {"m", 60}, {"w", 20}};

static struct soak_world world;

static void make(const char *name)
{
    const bool wild = *name == 'w', machine = wild || *name == 'm';

    soak_make(&world, strtoull(name + machine, NULL, 10));
    if (machine) {
        soak_machine_make(&world, wild);
    }
}

static bool is_awake(const struct crowd *crowd)
{
    struct carom_body_state state;

    for (int i = 0; i < crowd->body_count; i++) {
        if (!crowd->bodies[i].def.stationary && carom_body_get(crowd->world, i, &state) >= 0 &&
            !state.asleep && !state.out) {
            return true;
        }
    }
    return false;
}

static void add_up(struct carom_stats *sum)
{
    struct carom_stats stats;

    lab_expect(carom_stats(world.crowd->world, &stats), "stats");
    sum->substeps += stats.substeps;
    sum->hits += stats.hits;
    sum->candidates += stats.candidates;
    sum->roots += stats.roots;
    sum->sweeps += stats.sweeps;
}

static int step(int frame)
{
    int status = world.machine ? soak_machine_act(&world, frame) : CAROM_OK;

    if (status >= 0) {
        status = carom_world_step(world.crowd->world);
    }
    if (status >= 0 && world.machine) {
        soak_machine_note_breaks(&world);
    }
    return status;
}

static void play(const char *name)
{
    struct soak_result result;
    struct carom_stats sum = {0};
    uint64_t hash = PLAY_DIGEST;
    int frame = 0, awake = 0, status;

    make(name);
    status = soak_start(&world, &result) ? CAROM_OK : result.error;
    while (frame < FRAMES && status >= 0) {
        status = step(frame + 1);
        hash = play_fold_step(world.crowd->world, status, hash);
        if (status >= 0) {
            awake += is_awake(world.crowd);
            add_up(&sum);
            frame++;
        }
    }
    printf("scene %s %d %d %016llx %u %u %u %u %u\n", name, frame, awake, (unsigned long long)hash,
           sum.substeps, sum.hits, sum.candidates, sum.roots, sum.sweeps);
    fflush(stdout);
    soak_free(&world);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        play(argv[i]);
    }
    for (size_t kind = 0; argc == 1 && kind < sizeof kinds / sizeof *kinds; kind++) {
        for (int number = 1; number <= kinds[kind].count; number++) {
            char name[16];

            snprintf(name, sizeof name, "%s%d", kinds[kind].prefix, number);
            play(name);
        }
    }
    return 0;
}

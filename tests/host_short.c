/* SPDX-License-Identifier: MIT */
/*
 * Random worlds and machines with one pool too short, from one place less than they take down to a single one. Whatever the frame
 * and whatever its step is doing then, it ends in the error of that pool and the world is as before. A snapshot of it goes on in a
 * world with room as if nothing had happened. Short working pools change nothing at all.
 */
#include "lib/soak.h"

enum { WORLDS = 4, FRAMES = 60, SIZES = 4 };

static struct soak_world world;
static struct carom_caps ample;
static uint64_t wanted[FRAMES + 1]; /* states of the run with room */
static uint32_t peak[CAROM_POOL_COUNT];
static long runs, errors, frames, wrong, changed, lost;

/* Make the world anew: what a machine did is in the definitions of its parts, too. */
static void make(uint64_t seed, bool machine)
{
    soak_make(&world, seed);
    if (machine) {
        soak_machine_make(&world, true);
    }
}

static int begin(const struct carom_caps *caps)
{
    const bool machine = world.machine != NULL;
    const uint64_t seed = world.seed;
    int result;

    soak_free(&world);
    make(seed, machine);
    world.crowd->config.caps = *caps;
    result = crowd_start(world.crowd);
    return result >= 0 && machine ? soak_machine_start(&world) : result;
}

static int step(int frame)
{
    int result = world.machine ? soak_machine_act(&world, frame) : CAROM_OK;

    return result < 0 ? result : carom_world_step(world.crowd->world);
}

/* The run with room; false if a call fails in it. */
static bool run_ample(void)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    if (begin(&ample) < 0) {
        return false;
    }
    for (int frame = 0; frame < FRAMES; frame++) {
        wanted[frame] = carom_world_hash(world.crowd->world);
        if (step(frame + 1) < 0) {
            return false;
        }
    }
    wanted[FRAMES] = carom_world_hash(world.crowd->world);
    lab_expect(carom_usage(world.crowd->world, usage), "usage");
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        peak[i] = usage[i].peak;
    }
    return true;
}

/* Go on in a world with room from where a short one stopped. */
static void go_on(int frame)
{
    static uint8_t snapshot[1 << 18];
    const int bytes = carom_snapshot_save(world.crowd->world, snapshot, sizeof snapshot);
    bool same = bytes > 0 && begin(&ample) >= 0 &&
                carom_snapshot_load(world.crowd->world, snapshot, (size_t)bytes) == CAROM_OK;

    for (; same && frame < FRAMES; frame++) {
        same = carom_world_hash(world.crowd->world) == wanted[frame] && step(frame + 1) >= 0;
    }
    lost += !same;
}

/* A run with other capacities. error: the one that is allowed, or CAROM_OK. */
static void run_short(const struct carom_caps *caps, int error)
{
    int result = begin(caps), frame = 0;

    runs++;
    if (result < 0) {
        wrong += result != error; /* a body that is added where it overlaps takes a pair */
        errors++;
        return;
    }
    for (; frame < FRAMES; frame++) {
        uint64_t before;

        changed += carom_world_hash(world.crowd->world) != wanted[frame];
        result = world.machine ? soak_machine_act(&world, frame + 1) : CAROM_OK;
        before = carom_world_hash(world.crowd->world);
        result = result < 0 ? result : carom_world_step(world.crowd->world);
        frames++;
        if (result < 0) {
            wrong += result != error;
            changed += carom_world_hash(world.crowd->world) != before;
            errors++;
            if (!world.machine) { /* which may have lost or got a part by now */
                go_on(frame);
            }
            return;
        }
    }
}

static void try_pool(enum carom_pool pool, uint32_t *size, struct carom_caps *caps, int error)
{
    for (uint32_t part = SIZES; part > 0; part--) {
        const uint32_t most = peak[pool] > 1 ? peak[pool] - 1 : 1;

        *size = most * part / SIZES > 0 ? most * part / SIZES : 1;
        run_short(caps, error);
    }
    *caps = ample;
}

static void try_all(void)
{
    struct carom_caps caps = ample;

    try_pool(CAROM_POOL_pairs, &caps.pairs, &caps, CAROM_ERR_PAIRS_FULL);
    try_pool(CAROM_POOL_contacts, &caps.contacts, &caps, CAROM_ERR_CONTACTS_FULL);
    try_pool(CAROM_POOL_faces, &caps.faces, &caps, CAROM_ERR_FACES_FULL);
    caps.candidates = 1;
    run_short(&caps, CAROM_OK);
    caps = ample;
    caps.hits = 0;
    run_short(&caps, CAROM_OK);
}

static void test(const char *name, bool machines)
{
    int made = 0;

    runs = errors = frames = wrong = changed = lost = 0;
    for (uint64_t seed = 1; made < WORLDS; seed++) {
        make(seed, machines);
        ample = world.crowd->config.caps;
        if (run_ample()) {
            made++;
            try_all();
        }
        soak_free(&world);
    }
    lab_report(
        wrong + changed + lost == 0 && errors > runs / 4, name,
        "%ld runs, %ld of them end in an error, %ld frames; %ld other errors, %ld states that "
        "changed, %ld that did not go on",
        runs, errors, frames, wrong, changed, lost);
}

int main(void)
{
    test("short/worlds", false);
    test("short/machines", true);
    return lab_finish();
}

/* SPDX-License-Identifier: MIT */
/*
 * host_fuzz - random calls of the whole interface. Half of the arguments are hostile: numbers at
 * the ends of their types, bodies and joints that do not exist, NULL. No call may have undefined
 * behaviour (the debug build has sanitizers). A call that fails leaves the world as it was, and
 * the same calls give the same hash. Snapshots are damaged byte by byte, with their check sum
 * corrected: carom_snapshot_load refuses them, or the world steps on.
 *
 *   host_fuzz            a few
 *   host_fuzz FROM TO    those numbers, each printed before it runs
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/bytes.h"
#include "lib/edits.h"
#include "lib/fuzz.h"
#include "lib/open_cases.h"

#define WORLDS    40
#define CALLS     250
#define MUTATIONS 60
#define SIZE      65536 /* largest snapshot, bytes */

static struct fuzz fuzz;
static long calls, refused, steps, loaded, mutated, taken, wrong;

static void complain(uint64_t seed, int call, const char *what, int result)
{
    wrong++;
    printf("# %llu, call %d (of kind %d): %s: %s\n", (unsigned long long)seed, call, fuzz.last,
           what, carom_result_text(result));
}

/* Make one call. An error must be one of the interface's, and must leave everything as it was. */
static void call_once(uint64_t seed, int call)
{
    int result;
    const char *fault = fuzz_try(&fuzz, fuzz_call, &result);

    calls++;
    refused += result < 0;
    if (fault) {
        complain(seed, call, fault, result);
    }
}

static void step(uint64_t seed, int call)
{
    int result;
    const char *fault = fuzz_try_step(fuzz.world, &result);

    steps++;
    if (fault) {
        complain(seed, call, fault, result);
    }
}

/* ---------------------------------------------------------------------- snapshots */

/* A world takes its own snapshot back and then has the same hash. */
static int save(uint64_t seed, int call, uint8_t *bytes)
{
    uint64_t hash = carom_world_hash(fuzz.world);
    int size = carom_snapshot_save(fuzz.world, bytes, SIZE);
    int result = size < 0 ? size : carom_snapshot_load(fuzz.world, bytes, (size_t)size);

    loaded++;
    if (result < 0 || carom_world_hash(fuzz.world) != hash) {
        complain(seed, call, "a snapshot of its own", result);
    }
    return size;
}

static void load_changed(uint64_t seed, int call)
{
    static uint8_t good[SIZE], bad[SIZE];
    int size = save(seed, call, good);

    for (int i = 0; i < MUTATIONS && size > 0; i++) {
        uint64_t before = carom_world_hash(fuzz.world);
        int result;

        memcpy(bad, good, (size_t)size);
        edit_bytes(&fuzz.chance, bad, (size_t)size - 8);
        bytes_mend(bad, (size_t)size);
        result = carom_snapshot_load(fuzz.world, bad, (size_t)size);
        mutated++;
        if (result < 0) {
            if (carom_world_hash(fuzz.world) != before) {
                complain(seed, call, "a snapshot that was refused changed the world", result);
            }
            continue;
        }
        taken++;
        for (int k = 0; k < 3; k++) {
            step(seed, call);
        }
        (void)carom_snapshot_load(fuzz.world, good, (size_t)size);
    }
}

/* ---------------------------------------------------------------------------- runs */

static uint64_t run(uint64_t seed)
{
    fuzz_begin(&fuzz, seed, 6);
    for (int call = 0; call < CALLS; call++) {
        call_once(seed, call);
        if (fuzz_pick(&fuzz, 4) == 0) {
            step(seed, call);
        }
        if (fuzz_pick(&fuzz, CALLS / 3) == 0) {
            load_changed(seed, call);
        }
    }
    return carom_world_hash(fuzz.world);
}

int main(int argc, char **argv)
{
    uint64_t from = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    uint64_t to = argc > 2 ? strtoull(argv[2], NULL, 10) : argc > 1 ? from : WORLDS;
    long others = 0;

    for (uint64_t seed = from; seed <= to; seed++) {
        uint64_t hash;

        if (argc == 1 && open_case("fuzz", (long)seed)) {
            continue;
        }
        if (argc > 1) {
            printf("# %llu\n", (unsigned long long)seed);
            fflush(stdout);
        }
        hash = run(seed);
        others += run(seed) != hash;
    }
    fuzz_end(&fuzz);
    lab_report(wrong == 0 && refused > 0 && refused < calls && steps > 0, "fuzz/calls",
               "%ld calls, %ld refused, %ld steps, %ld wrong", calls, refused, steps, wrong);
    lab_report(taken < mutated && loaded > 0, "fuzz/snapshots",
               "%ld taken back, %ld changed, of which %ld were taken", loaded, mutated, taken);
    lab_report(others == 0, "fuzz/same_hash", "%ld of %llu", others,
               (unsigned long long)(to - from + 1));
    return lab_finish();
}

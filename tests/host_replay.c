/* SPDX-License-Identifier: MIT */
/*
 * host_replay - recordings of random worlds; half of their calls are hostile (tests/lib/fuzz.h). A
 * recording gives the same states when it is played, whether it began with the world or later.
 * Then the files are damaged: each byte, each length, and random bytes with the check sum at the
 * end corrected. A damaged file is refused or played on a valid world; the debug build has
 * sanitizers.
 *
 *   host_replay         a few
 *   host_replay long    every byte, every length, 100,000 random files
 */
#include <stdio.h>
#include <string.h>

#include "lib/edits.h"
#include "lib/recording.h"

#define WORLDS 40
#define CALLS  80
#define BODIES 6 /* at the beginning */

static struct fuzz fuzz;
static struct recording original;
static struct carom_replay player;
static uint8_t changed[RECORDING_BYTES];
static long played, refused, differed, wrong_files;

static void judge(const uint8_t *bytes, size_t count)
{
    int result;
    const char *fault = recording_try(&player, bytes, count, &result);

    played += result == CAROM_REPLAY_END;
    refused += result < 0;
    differed += result == CAROM_REPLAY_DIFFERS || result == CAROM_REPLAY_CUT;
    if (fault) {
        wrong_files++;
        printf("# %s\n", fault);
    }
}

/* --------------------------------------------------------------------------- tests */

static void test_worlds(uint64_t count)
{
    long wrong = 0, begun = 0, longest = 0;

    for (uint64_t seed = 1; seed <= count; seed++) {
        const uint64_t alone = recording_make(&original, &fuzz, seed, BODIES, CALLS + 1, CALLS);

        for (int from = 0; from <= CALLS; from += CALLS / 4) {
            const uint64_t hash = recording_make(&original, &fuzz, seed, BODIES, from, CALLS);
            const int result = original.bytes > sizeof original.file
                                   ? CAROM_REPLAY_CUT
                                   : recording_play(&player, original.file, original.bytes);

            begun++;
            longest = (long)original.bytes > longest ? (long)original.bytes : longest;
            if (hash != alone || result != CAROM_REPLAY_END ||
                carom_world_hash(player.world) != hash) {
                wrong++;
                printf("# %llu from %d: %s, ended with %d in frame %u, %s, difference %d, part %d: "
                       "wanted %llx, found %llx\n",
                       (unsigned long long)seed, from, hash == alone ? "as alone" : "not as alone",
                       result, (unsigned)player.frames, carom_replay_call_name(player.call),
                       player.difference, player.part, (unsigned long long)player.wanted,
                       (unsigned long long)player.found);
            }
        }
    }
    lab_report(wrong == 0, "replay/worlds", "%ld recordings, at most %ld bytes, %ld wrong", begun,
               longest, wrong);
}

static void test_bytes(size_t stride)
{
    for (size_t at = 0; at < original.bytes; at += stride) {
        memcpy(changed, original.file, original.bytes);
        for (int value = 0; value < 256; value += stride == 1 ? 1 : 37) {
            changed[at] = (uint8_t)(original.file[at] ^ value);
            judge(changed, original.bytes);
        }
    }
    for (size_t count = 0; count < original.bytes; count += stride) {
        judge(original.file, count);
    }
}

static void test_chance(long count)
{
    for (long n = 0; n < count; n++) {
        memcpy(changed, original.file, original.bytes);
        edit_bytes(&fuzz.chance, changed, original.bytes);
        edit_mend32(changed, original.bytes);
        judge(changed, original.bytes);
    }
}

int main(int argc, char **argv)
{
    const bool all = argc > 1 && strcmp(argv[1], "long") == 0;

    test_worlds(all ? 400 : WORLDS);
    for (int k = 0; k < 4; k++) { /* two from the beginning, two from the middle */
        (void)recording_make(&original, &fuzz, (uint64_t)k + 1, BODIES, k / 2 * 20, all ? 24 : 30);
        if (!all || k == 1 || k == 2) {
            test_bytes(all ? 1 : 41);
        }
        test_chance(all ? 25000 : 250);
    }
    fuzz_end(&fuzz);
    lab_report(wrong_files == 0 && refused > 0 && differed > 0, "replay/hostile",
               "%ld files played, %ld refused, %ld differ, %ld wrong", played, refused, differed,
               wrong_files);
    return lab_finish();
}

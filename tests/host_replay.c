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

#include "lib/fuzz.h"
#include "lib/recorded.h"
#include "num/fnv.h"
#include "world/world.h"

#define WORLDS     40
#define CALLS      80
#define FILE_BYTES (1 << 20)
#define ROOM       (4 << 20)
#define SNAPSHOT   65536

struct carom_record recorder;

static struct fuzz fuzz;
static struct carom_replay player;
static _Alignas(8) uint8_t room[ROOM], snapshot[SNAPSHOT];
static uint8_t file[FILE_BYTES], changed[FILE_BYTES];
static size_t file_bytes;
static long played, refused, differed, invalid, hung;

static void write_file(void *user, const void *bytes, size_t count)
{
    (void)user;
    if (file_bytes + count <= sizeof file) {
        memcpy(file + file_bytes, bytes, count);
    }
    file_bytes += count;
}

/*
 * A world of random calls, recorded from call `from` on. 0: from its beginning; beyond the last
 * call: not at all. Returns the hash of its last state.
 */
static uint64_t record(uint64_t seed, int from, int calls)
{
    uint64_t hash;

    file_bytes = 0;
    memset(&recorder, 0, sizeof recorder);
    if (from == 0) {
        carom_record_begin(&recorder, write_file, NULL, seed % 2 != 0, "fuzz");
    }
    fuzz_begin(&fuzz, seed);
    for (int call = 1; call <= calls; call++) {
        if (call == from) {
            carom_record_begin(&recorder, write_file, NULL, seed % 2 != 0, "fuzz");
            invalid += carom_record_world(&recorder, fuzz.world, snapshot, sizeof snapshot) < 0;
        }
        (void)fuzz_call(&fuzz);
        if (fuzz_pick(&fuzz, 3) == 0) {
            (void)carom_world_step(fuzz.world);
        }
    }
    hash = carom_world_hash(fuzz.world);
    carom_record_end(&recorder);
    return hash;
}

/*
 * Play to the end. A world that stops at an error or a difference can still be stepped and asked.
 */
static int play(const uint8_t *bytes, size_t count)
{
    int result = carom_replay_begin(&player, bytes, count, room, sizeof room);
    size_t frames = 0;

    if (result < 0) {
        return result;
    }
    do {
        result = carom_replay_frame(&player);
    } while (result == CAROM_REPLAY_FRAME && ++frames <= count);
    hung += frames > count;
    return result;
}

static void judge(const uint8_t *bytes, size_t count)
{
    static _Alignas(8) uint8_t copy[SNAPSHOT];
    const int result = play(bytes, count);
    int size;

    played += result == CAROM_REPLAY_END;
    refused += result < 0;
    differed += result == CAROM_REPLAY_DIFFERS || result == CAROM_REPLAY_CUT;
    if (player.world) {
        player.world->config.contact = NULL;
    }
    if (player.world && (size = carom_snapshot_save(player.world, copy, sizeof copy)) > 0) {
        invalid += carom_snapshot_load(player.world, copy, (size_t)size) < 0;
        (void)carom_world_step(player.world);
    }
}

/* --------------------------------------------------------------------------- tests */

static void test_worlds(uint64_t count)
{
    long wrong = 0, begun = 0, longest = 0;

    for (uint64_t seed = 1; seed <= count; seed++) {
        const uint64_t alone = record(seed, CALLS + 1, CALLS);

        for (int from = 0; from <= CALLS; from += CALLS / 4) {
            const uint64_t hash = record(seed, from, CALLS);
            const int result = file_bytes > sizeof file ? CAROM_REPLAY_CUT : play(file, file_bytes);

            begun++;
            longest = (long)file_bytes > longest ? (long)file_bytes : longest;
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
    lab_report(wrong == 0 && invalid == 0, "replay/worlds",
               "%ld recordings, at most %ld bytes, %ld wrong", begun, longest, wrong);
}

static void mend(uint8_t *bytes, size_t count)
{
    uint32_t sum = FNV32_START;

    for (size_t i = 0; i + 4 < count; i++) {
        sum = fnv32_add(sum, bytes[i]);
    }
    for (int i = 0; i < 4; i++) {
        bytes[count - 4 + (size_t)i] = (uint8_t)(sum >> 8 * i);
    }
}

static void test_bytes(size_t stride)
{
    for (size_t at = 0; at < file_bytes; at += stride) {
        memcpy(changed, file, file_bytes);
        for (int value = 0; value < 256; value += stride == 1 ? 1 : 37) {
            changed[at] = (uint8_t)(file[at] ^ value);
            judge(changed, file_bytes);
        }
    }
    for (size_t count = 0; count < file_bytes; count += stride) {
        judge(file, count);
    }
}

static void test_chance(long count)
{
    for (long n = 0; n < count; n++) {
        memcpy(changed, file, file_bytes);
        for (int k = fuzz_pick(&fuzz, 4); k >= 0; k--) {
            const size_t at = (size_t)fuzz_pick(&fuzz, (int)file_bytes);
            const size_t from = (size_t)fuzz_pick(&fuzz, (int)file_bytes);
            const size_t length = (size_t)fuzz_pick(&fuzz, 32);

            switch (fuzz_pick(&fuzz, 4)) {
            case 0:
                changed[at] = (uint8_t)fuzz_pick(&fuzz, 256);
                break;
            case 1:
                changed[at] ^= (uint8_t)(1 << fuzz_pick(&fuzz, 8));
                break;
            case 2:
                changed[at] = fuzz_pick(&fuzz, 2) ? 0xff : 0x80;
                break;
            default: /* a piece from another place */
                if (at + length <= file_bytes && from + length <= file_bytes) {
                    memmove(changed + at, file + from, length);
                }
                break;
            }
        }
        mend(changed, file_bytes);
        judge(changed, file_bytes);
    }
}

int main(int argc, char **argv)
{
    const bool all = argc > 1 && strcmp(argv[1], "long") == 0;

    test_worlds(all ? 400 : WORLDS);
    for (int k = 0; k < 4; k++) { /* two from the beginning, two from the middle */
        (void)record((uint64_t)k + 1, k / 2 * 20, all ? 24 : 30);
        if (!all || k == 1 || k == 2) {
            test_bytes(all ? 1 : 41);
        }
        test_chance(all ? 25000 : 250);
    }
    fuzz_end(&fuzz);
    lab_report(invalid == 0 && hung == 0 && refused > 0 && differed > 0, "replay/hostile",
               "%ld files played, %ld refused, %ld differ, %ld left a world that is none, %ld hung",
               played, refused, differed, invalid, hung);
    return lab_finish();
}

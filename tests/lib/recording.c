/* SPDX-License-Identifier: MIT */
/* Recordings of random calls, and what a player makes of a file. */
#include "recorded.h" /* first: it decides what carom_replay.h defines */

#include <string.h>

#include "recording.h"
#include "world/world.h"

#define ROOM     (4 << 20)
#define SNAPSHOT 65536
/* Frames of a file that no byte tells: calls of a slot and of a run make more than there are bytes. */
#define FRAMES 128

struct carom_record recorder;

static _Alignas(8) uint8_t room[ROOM], snapshot[SNAPSHOT];

static void write_file(void *user, const void *bytes, size_t count)
{
    struct recording *r = (struct recording *)user;

    if (r->bytes + count <= sizeof r->file) {
        memcpy(r->file + r->bytes, bytes, count);
    }
    r->bytes += count;
}

uint64_t recording_make(struct recording *r, struct fuzz *f, uint64_t seed, int bodies, int from,
                        int calls)
{
    uint64_t hash;

    r->bytes = 0;
    memset(&recorder, 0, sizeof recorder);
    if (from == 0) {
        carom_record_begin(&recorder, write_file, r, seed % 2 != 0, "fuzz");
    }
    fuzz_begin(f, seed, bodies);
    for (int call = 1; call <= calls; call++) {
        if (call == from) {
            carom_record_begin(&recorder, write_file, r, seed % 2 != 0, "fuzz");
            lab_expect(carom_record_world(&recorder, f->world, snapshot, sizeof snapshot),
                       "recording of a world");
        }
        (void)fuzz_call(f);
        if (fuzz_pick(f, 3) == 0) {
            (void)carom_world_step(f->world);
        }
    }
    hash = carom_world_hash(f->world);
    carom_record_end(&recorder);
    return hash;
}

/* A byte makes at most 128 calls, so a file that goes on longer does not end. */
static int play(struct carom_replay *player, const uint8_t *bytes, size_t count, bool *hung)
{
    int result = carom_replay_begin(player, bytes, count, room, sizeof room);
    size_t frames = 0;

    *hung = false;
    if (result < 0) {
        return result;
    }
    do {
        result = carom_replay_frame(player);
        *hung = ++frames > FRAMES * count;
    } while (result == CAROM_REPLAY_FRAME && !*hung);
    return result;
}

int recording_play(struct carom_replay *player, const uint8_t *bytes, size_t count)
{
    bool hung;

    return play(player, bytes, count, &hung);
}

const char *recording_try(struct carom_replay *player, const uint8_t *bytes, size_t count,
                          int *result)
{
    bool hung;
    int size;

    *result = play(player, bytes, count, &hung);
    if (hung) {
        return "a file that does not end";
    }
    if (!player->world) {
        return NULL;
    }
    player->world->config.contact = NULL; /* the player is over */
    size = carom_snapshot_save(player->world, snapshot, sizeof snapshot);
    if (size > 0 && carom_snapshot_load(player->world, snapshot, (size_t)size) < 0) {
        return "a world that is none";
    }
    return fuzz_try_step(player->world, &size);
}

/* SPDX-License-Identifier: MIT */
/*
 * host_bytes - snapshots whose bytes were changed. Each change of one byte and each length is
 * refused, for the check sum. Then the check sum is corrected: each byte is changed, and random
 * numbers in random places. Such a snapshot is refused and the world is as it was, or it is taken
 * and is a world: its next steps fail only for lack of room, do no more work than SPEC.md, 6.1
 * allows, and what they leave is taken back. In a pile that crowd.h watches no faces cross that did
 * not cross at first. No energy comes from nothing, if no point is faster than a call may make it.
 *
 * Each byte and each length of mesh blobs is changed likewise: they are refused, or read, and a mesh is built of
 * them or refused.
 *
 *   host_bytes                     a few
 *   host_bytes FROM TO COUNT       each byte of worlds FROM to TO - 1, and COUNT random changes of each
 *   host_bytes FROM TO COUNT SEED  random changes only
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "lib/bytes.h"
#include "lib/crowd.h"
#include "lib/edits.h"
#include "lib/real.h"
#include "lib/saved.h"

#define WORLDS     (SAVED_WORLDS + 1) /* the last one is the pile of a crowd */
#define CANDIDATES 1024 /* of a step, at most, for each face of the world; docs/soak.md */
#define SECONDS    20   /* of a step, at most */

/* Bytes of a snapshot: gravity, and the force of a body. */
enum { AT_GRAVITY = 4, AT_BODY = 32, BODY_BYTES = 117, AT_FORCE = 73 };

static struct {
    struct saved saved;
    struct crowd *crowd;   /* NULL: one of saved.h */
    struct crowd as_saved; /* the crowd when the snapshot was taken */
    uint32_t faces;
} now;

static struct {
    long changed, refused, taken, steps, failed, wrong, loose;
    long dear; /* steps that hand over more candidates than any of a random world may */
    long fast; /* worlds that gained energy, faster at first than a call may make a body */
    double candidates, seconds; /* most of a step: for each face; of time */
} tally;

static uint8_t changed[SAVED_BYTES + 1];

/* ------------------------------------------------------------------------- worlds */

/* Boxes and a tetrahedron that lie on a sheet and on each other, and a ball that falls on them. */
static void make_pile(void)
{
    const double sides[3] = {1, 1, 1}, falls[3] = {0.02, 0, -0.1}, spin[3] = {0.05, 0, 0.1};
    struct crowd *crowd = crowd_new();
    const int sheet = crowd_mesh(crowd, &lab_sheet), box = crowd_box(crowd, 1, 0.8, 0.5);
    struct crowd_tally watched = {0};

    crowd_body(crowd, sheet)->stationary = true;
    crowd_place(crowd_body(crowd, box), 0, 0, 0.27);
    crowd_place(crowd_body(crowd, box), 0.2, 0.1, 0.8);
    crowd_place(crowd_body(crowd, crowd_solid(crowd, &lab_tetrahedron, sides)), 0.1, 0, 2);
    crowd_place(crowd_body(crowd, crowd_ball(crowd, 0.3)), 3, 0, 4);
    crowd_move(&crowd->bodies[4].def, falls, spin);
    lab_expect(crowd_start(crowd), "pile");
    for (int frame = 0; frame < 45; frame++) {
        lab_expect(crowd_step(crowd, &watched), "pile");
    }
    now.crowd = crowd;
    now.as_saved = *crowd;
    now.saved.world = crowd->world;
    now.saved.size = (size_t)lab_expect(
        carom_snapshot_save(crowd->world, now.saved.good, sizeof now.saved.good), "save");
    now.saved.hash = carom_world_hash(crowd->world);
}

static void make(int number)
{
    now.crowd = NULL;
    now.faces = 0;
    if (number == SAVED_WORLDS) {
        make_pile();
    } else {
        saved_make(&now.saved, number);
    }
    for (int body = 0; body < carom_body_count(now.saved.world); body++) {
        const struct carom_mesh *mesh = carom_body_mesh(now.saved.world, body);

        now.faces += mesh ? mesh->raw.face_count : 0;
    }
}

static void unmake(void)
{
    if (now.crowd) {
        crowd_free(now.crowd);
    } else {
        fuzz_end(&now.saved.fuzz);
    }
    memset(&now, 0, sizeof now);
}

/* -------------------------------------------------------------------------- steps */

static void complain(const char *what, long at)
{
    tally.wrong++;
    if (tally.wrong <= 20) {
        printf("# %s: change %ld\n", what, at);
        for (size_t i = 0; i < now.saved.size; i++) {
            if (changed[i] != now.saved.good[i] && i < now.saved.size - 8) {
                printf("#   byte %zu: %02x, was %02x\n", i, changed[i], now.saved.good[i]);
            }
        }
    }
}

/* Seconds of processor time. */
static double seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* A step of either kind of world, and the fault in it. */
static const char *step(struct crowd_tally *watched, int *result)
{
    const double begun = seconds();
    const char *fault = fuzz_try_step(now.saved.world, result);
    struct carom_stats stats;
    double took = seconds() - begun, candidates;

    tally.steps++;
    tally.failed += *result < 0;
    if (fault || *result < 0) {
        return fault;
    }
    carom_stats(now.saved.world, &stats);
    candidates = (double)stats.candidates / now.faces;
    tally.candidates = fmax(tally.candidates, candidates);
    tally.seconds = fmax(tally.seconds, took);
    if (now.crowd) {
        crowd_watch(now.crowd, *result, watched);
    }
    tally.dear += candidates > CANDIDATES;
    return took > SECONDS ? "a step that takes too long" : NULL;
}

/* The crowd takes over what was loaded. Pairs that cross, or nearly, may do so. */
static void look_at_crowd(void)
{
    struct crowd *crowd = now.crowd;

    *crowd = now.as_saved;
    for (int k = 0; k < 3; k++) {
        uint64_t v = 0;

        for (int i = 7; i >= 0; i--) {
            v = v << 8 | changed[AT_GRAVITY + 8 * k + i];
        }
        crowd->config.gravity.c[k] = (int64_t)v;
    }
    crowd_look(crowd);
    for (int a = 1; a < crowd->body_count; a++) {
        for (int b = 0; b < a; b++) {
            const bool crosses = crowd_overlap_now(crowd, a, b, 1e-9) != 0;

            crowd_let_pass(crowd, a, b, crosses ? CROWD_PASS : CROWD_MEET);
            tally.loose += crosses;
        }
    }
}

/* True if the snapshot has a force, of which the crowd knows nothing. */
static bool has_force(void)
{
    for (int body = 0; body < now.crowd->body_count; body++) {
        for (int i = 0; i < 24; i++) {
            if (changed[AT_BODY + BODY_BYTES * body + AT_FORCE + i]) {
                return true;
            }
        }
    }
    return false;
}

/* True if each point of each body is slower than 64 units a frame, as the calls ask. */
static bool is_slow(void)
{
    double fastest = 0;

    for (int i = 0; i < now.crowd->body_count; i++) {
        const struct crowd_body *body = &now.crowd->bodies[i];

        fastest = fmax(fastest,
                       real_length(body->now.body.velocity) +
                           now.crowd->meshes[body->mesh].radius * real_length(body->now.body.spin));
    }
    return fastest < 64;
}

static const char *judge_crowd(const struct crowd_tally *watched, bool slow)
{
    const bool gains = watched->rise > 1 && !has_force();

    tally.fast += gains && !slow;
    return watched->crossed > 0  ? "faces cross"
           : watched->inside > 0 ? "a body inside another"
           : gains && slow       ? "energy from nothing"
                                 : NULL;
}

/* ------------------------------------------------------------------------ changes */

/* A snapshot that was taken steps, and its own snapshot is taken back. */
static const char *go_on(int steps)
{
    static uint8_t after[SAVED_BYTES];
    struct crowd_tally watched = {0};
    int result = CAROM_OK, size;
    bool slow = true;

    if (now.crowd) {
        look_at_crowd();
        slow = is_slow();
    }
    for (int i = 0; i < steps && result >= 0; i++) {
        const char *fault = step(&watched, &result);

        if (fault) {
            return fault;
        }
    }
    size = carom_snapshot_save(now.saved.world, after, sizeof after);
    if (size < 0 || carom_snapshot_load(now.saved.world, after, (size_t)size) < 0) {
        return "a state that is not taken back";
    }
    return now.crowd ? judge_crowd(&watched, slow) : NULL;
}

static void try_changed(size_t size, int steps, long at)
{
    const char *fault;
    int result;

    bytes_mend(changed, size);
    fault = saved_try_load(&now.saved, changed, size, &result);
    tally.changed++;
    tally.refused += result < 0;
    tally.taken += result >= 0;
    if (!fault && result >= 0) {
        fault = go_on(steps);
    }
    if (fault) {
        complain(fault, at);
    }
    if (result >= 0 && (fault = saved_back(&now.saved)) != NULL) {
        complain(fault, at);
    }
}

/* Each byte becomes `values` others; without a correct sum each is refused, with one it may be taken. */
static void each_byte(int stride, int values, int steps)
{
    for (size_t at = 0; at < now.saved.size; at += (size_t)stride) {
        for (int k = 1; k <= values; k++) {
            int result;

            memcpy(changed, now.saved.good, now.saved.size);
            changed[at] ^=
                (uint8_t)(values == 255 ? k : 1 << (at / (size_t)stride + 3 * (size_t)k) % 8);
            tally.changed++;
            if (saved_try_load(&now.saved, changed, now.saved.size, &result) || result >= 0) {
                complain("taken with a wrong sum", (long)at);
            }
            if (at + 8 < now.saved.size) {
                try_changed(now.saved.size, steps, (long)at);
            }
        }
    }
}

/*
 * Each length but its own, up to one byte more. With a correct sum a length may be that of a world without the last
 * sections.
 */
static void each_length(int steps)
{
    const size_t whole = now.saved.size;

    for (size_t size = 0; size <= whole + 1; size++) {
        int result;

        if (size == whole) {
            continue;
        }
        memcpy(changed, now.saved.good, whole);
        changed[whole] = 0;
        tally.changed++;
        if (saved_try_load(&now.saved, changed, size, &result) || result >= 0) {
            complain("taken with another length", (long)size);
        }
        try_changed(size, steps, (long)size);
    }
}

static void at_random(long count, uint64_t seed, int steps)
{
    for (long i = 0; i < count; i++) {
        struct chance c = {.r.state = (seed << 32) + (uint64_t)i};

        memcpy(changed, now.saved.good, now.saved.size);
        edit_bytes(&c, changed, now.saved.size - 8);
        try_changed(now.saved.size, steps, i);
    }
}

/* -------------------------------------------------------------------------- blobs */

enum { VERTICES = 12, FACES = 20 };

static struct {
    long changed, read, built, wrong;
} blobs;

/* A blob is refused and nothing is written, or it is read, and a mesh is built of it or refused. */
static void try_blob(const uint8_t *blob, size_t size, bool right_sum)
{
    static _Alignas(8) uint8_t room[CAROM_BLOB_BYTES(VERTICES, FACES)];
    static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(VERTICES, FACES)];
    struct carom_mesh_raw raw = {.face_count = 1234};
    struct carom_mesh mesh;
    const int result = carom_mesh_read(&raw, blob, size, room, sizeof room);

    blobs.changed++;
    blobs.read += result >= 0;
    blobs.wrong += result < 0 ? raw.face_count != 1234 : !right_sum;
    if (result >= 0) {
        blobs.built += carom_mesh_build(&mesh, &raw, block, sizeof block) >= 0;
    }
}

/* Each byte of a blob to each other value, and each length, both with a wrong sum and a right one. */
static void each_blob(const struct carom_mesh_raw *raw)
{
    static uint8_t good[EDIT_BLOB_BYTES(VERTICES, FACES)], blob[sizeof good];
    const size_t size = edit_write_blob(raw, good);

    for (size_t at = 0; at < size; at++) {
        for (int value = 1; value < 256; value++) {
            memcpy(blob, good, size);
            blob[at] ^= (uint8_t)value;
            try_blob(blob, size, false);
            bytes_mend(blob, size);
            try_blob(blob, size, true);
        }
        memcpy(blob, good, size);
        try_blob(blob, at, false);
        bytes_mend(blob, at);
        try_blob(blob, at, true);
    }
}

static void test_blobs(void)
{
    each_blob(&lab_tetrahedron);
    each_blob(&lab_box);
    each_blob(&lab_l);
    each_blob(&lab_sheet);
    lab_report(blobs.wrong == 0 && blobs.built > 0, "bytes/blobs",
               "%ld changed, %ld read, %ld built, %ld wrong", blobs.changed, blobs.read,
               blobs.built, blobs.wrong);
}

int main(int argc, char **argv)
{
    const bool few = argc<4, more = argc> 4;
    const int from = few ? 0 : atoi(argv[1]), to = few ? WORLDS : atoi(argv[2]);

    for (int number = from; number < to && number < WORLDS; number++) {
        const long before = tally.changed, taken = tally.taken, wrong = tally.wrong;

        make(number);
        if (!more) {
            each_byte(few ? 5 : 1, few ? 1 : 255, few ? 10 : 1);
            each_length(few ? 10 : 100);
        }
        at_random(few ? 120 : atol(argv[3]), more ? strtoull(argv[4], NULL, 10) : 1,
                  few ? 20 : 100);
        printf("# world %d, %zu bytes: %ld changed, %ld taken, %ld wrong\n", number, now.saved.size,
               tally.changed - before, tally.taken - taken, tally.wrong - wrong);
        fflush(stdout);
        unmake();
    }
    lab_report(
        tally.wrong == 0 && tally.refused > 0 && tally.taken > 0, "bytes/snapshots",
        "%ld changed, %ld taken, %ld steps of which %ld failed, at most %.0f candidates a face "
        "and %.3f s a step, %ld pairs crossed at first, %ld dear steps, %ld gained energy at "
        "speeds beyond the "
        "calls', %ld wrong",
        tally.changed, tally.taken, tally.steps, tally.failed, tally.candidates, tally.seconds,
        tally.loose, tally.dear, tally.fast, tally.wrong);
    test_blobs();
    return lab_finish();
}

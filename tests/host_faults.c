/* SPDX-License-Identifier: MIT */
/*
 * Pools that are full. Scenes, and a play that makes every call which can meet a full pool, run with each pool at sizes from 0
 * to the peak that they need. Each call that meets a full pool must say so and leave all that a caller can see as it was; the
 * same call fails in the same way again, or now fits; a snapshot of that world, taken into one with room, goes on as one that had room from
 * the start. Pools that only cost time when they are short change nothing.
 *
 *   host_faults              the play at every size, some scenes at some sizes
 *   host_faults long         the play at every size, every scene at more of them
 *   host_faults long NAME    one scene, or `play`
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/faults.h"
#include "lib/lab.h"
#include "scene.h"

#define FRAMES      60
#define FRAMES_LONG 150
#define SNAPSHOT    (1 << 20)

static bool whole;          /* the long form */
static long sizes, unequal; /* sizes tried; results or hashes that are not those of the good run */

static const uint32_t lowest[CAROM_POOL_COUNT] = {
#define LOWEST(name, bytes, low, high) low,
    CAROM_POOLS(LOWEST)
#undef LOWEST
};

static uint32_t *capacity(struct carom_caps *caps, int pool)
{
    uint32_t *const of[CAROM_POOL_COUNT] = {
#define CAPACITY(name, bytes, low, high) &caps->name,
        CAROM_POOLS(CAPACITY)
#undef CAPACITY
    };

    return of[pool];
}

static const char *pool_name(int pool)
{
    static const char *const names[CAROM_POOL_COUNT] = {
#define NAME(name, bytes, low, high) #name,
        CAROM_POOLS(NAME)
#undef NAME
    };

    return names[pool];
}

/* Note a result that is not what it has to be. */
static void expect_same(bool same, const char *what, int pool, uint32_t size, int frame)
{
    if (!same) {
        unequal++;
        printf("# %s: %s %u, at %d\n", what, pool_name(pool), size, frame);
    }
}

/* A working pool, which is never an error, or one whose shortage no result shows. */
static bool only_costs(int pool)
{
    return pool == CAROM_POOL_candidates || pool == CAROM_POOL_hits;
}

/* ---------------------------------------------------------------------- sizes */

/* Each size that is tried: all up to so many, then steps that grow, then the last four. */
static uint32_t next_size(uint32_t size, uint32_t peak, uint32_t all)
{
    uint32_t step = size < all ? 1 : 1 + size / 4;

    return size + step < peak || size >= peak ? size + step : peak - size > 4 ? peak - 4 : size + 1;
}

/* ----------------------------------------------------------------------- play */

#define PLAY_CALLS 128
#define BODIES     14 /* of the play */
static struct {
    int result[PLAY_CALLS];
    uint64_t digest[PLAY_CALLS];
    struct carom_usage usage[CAROM_POOL_COUNT];
    uint8_t settled[1 << 16]; /* a snapshot before the first step */
    int settled_bytes;
} good;

static void play_good(const struct carom_caps *caps)
{
    struct faults_play *play = faults_play_new(caps);

    for (int i = 0; i < faults_play_length(); i++) {
        good.result[i] = lab_expect(faults_play_call(play, i), "play");
        good.digest[i] = carom_world_hash(faults_play_world(play));
        if (i == faults_play_settled() - 1) {
            good.settled_bytes =
                carom_snapshot_save(faults_play_world(play), good.settled, sizeof good.settled);
        }
    }
    carom_usage(faults_play_world(play), good.usage);
    faults_play_free(play);
}

/* Take a play that failed at call i into a world with room that has made the calls before, and go on there. */
static void play_on(const struct carom_caps *ample, struct faults_play *from, int i, int pool,
                    uint32_t size)
{
    static uint8_t snapshot[SNAPSHOT];
    struct faults_play *play = faults_play_new(ample);
    int bytes = carom_snapshot_save(faults_play_world(from), snapshot, sizeof snapshot);

    for (int n = 0; n < i; n++) {
        faults_play_call(play, n);
    }
    expect_same(bytes > 0 && carom_snapshot_load(faults_play_world(play), snapshot,
                                                 (size_t)bytes) == CAROM_OK,
                "a snapshot was refused", pool, size, i);
    for (int n = i; n < faults_play_length(); n++) {
        int result = faults_play_call(play, n);

        if (result != good.result[n] ||
            carom_world_hash(faults_play_world(play)) != good.digest[n]) {
            expect_same(false, "another result after a move", pool, size, n);
            break;
        }
    }
    faults_play_free(play);
}

static void play_size(const struct carom_caps *ample, int pool, uint32_t size)
{
    struct carom_caps caps = *ample;
    struct faults_play *play;

    sizes++;
    *capacity(&caps, pool) = size;
    play = faults_play_new(&caps);
    expect_same((play != NULL) == (size >= lowest[pool]), "a world was made", pool, size, 0);
    for (int i = 0; play && i < faults_play_length(); i++) {
        int result = faults_play_call(play, i);

        if (faults_full(result)) {
            expect_same(!only_costs(pool), "an error", pool, size, i);
            expect_same(faults_play_call(play, i) == result, "another error", pool, size, i);
            /* bodies are there, extras are not: a snapshot of those that have them */
            if (pool == CAROM_POOL_extras && carom_body_count(faults_play_world(play)) == BODIES) {
                expect_same(carom_snapshot_load(faults_play_world(play), good.settled,
                                                (size_t)good.settled_bytes) == result,
                            "a snapshot was taken", pool, size, i);
            }
            play_on(ample, play, i, pool, size);
            break;
        }
        if (result != good.result[i] ||
            carom_world_hash(faults_play_world(play)) != good.digest[i]) {
            expect_same(false, "another result", pool, size, i);
            break;
        }
    }
    if (play) {
        faults_play_free(play);
    }
}

static void report(const char *name, long failures_before, long sizes_before)
{
    long failed = faults_total() - failures_before;

    lab_report(faults.changed == 0 && faults.listed == 0 && unequal == 0 && failed > 0, name,
               "%ld sizes, %ld calls met a full pool, %ld left a change, %ld a list; %ld unequal",
               sizes - sizes_before, failed, faults.changed, faults.listed, unequal);
}

static void play_all(void)
{
    const struct carom_caps ample = CAROM_CAPS(20, 64, 256, 1024, 4096, 4096, 8, 20, 16);
    long failures = faults_total(), before = sizes;
    int met = 0;

    play_good(&ample);
    for (int pool = 0; pool < CAROM_POOL_COUNT; pool++) {
        for (uint32_t size = 0; size <= good.usage[pool].peak;
             size = next_size(size, good.usage[pool].peak, 64)) {
            play_size(&ample, pool, size);
        }
    }
    report("faults/play", failures, before);
    for (int i = 0; i < FAULTS_CALLS; i++) {
        met += faults.failures[i] > 0;
        printf("# %s met %ld full pools\n", faults_names[i], faults.failures[i]);
    }
    lab_report(met == FAULTS_CALLS, "faults/calls", "%d of %d calls met a full pool", met,
               FAULTS_CALLS);
}

/* --------------------------------------------------------------------- scenes */

/* A scene and its world. */
struct stage {
    const char *name;
    struct scene scene;
    void *mesh_block, *world_block;
    struct carom_world *world;
};
static struct stage small_stage, ample_stage;

static struct {
    struct carom_caps caps; /* capacities of the worlds with room */
    int frames;
    uint64_t hash[FRAMES_LONG + 1];
    int status[FRAMES_LONG + 1];
    struct carom_usage usage[CAROM_POOL_COUNT];
} run;

/* A surface that moves is built anew: a world leaves it where it went. */
static int set_up(struct stage *stage, const struct carom_caps *caps)
{
    struct carom_config config = scene_config();

    if (stage->scene.sheet) {
        lab_expect(
            scene_load(&stage->scene, stage->name, NULL, stage->mesh_block, SCENE_MESH_BYTES),
            stage->name);
    }
    stage->scene.caps = config.caps = *caps;
    free(stage->world_block);
    stage->world_block = lab_need(carom_world_bytes(caps) + 8);
    faults.calls = 0;
    return scene_make(&stage->scene, &config, stage->world_block, carom_world_bytes(caps),
                      &stage->world);
}

static void load(struct stage *stage, const char *name)
{
    stage->name = name;
    stage->mesh_block = stage->mesh_block ? stage->mesh_block : lab_need(SCENE_MESH_BYTES);
    lab_expect(scene_load(&stage->scene, name, NULL, stage->mesh_block, SCENE_MESH_BYTES), name);
}

/* One frame: the calls of the scene, then the step. */
static int frame_of(struct stage *stage, int frame)
{
    int result = scene_before(&stage->scene, stage->world, frame);

    return result < 0 ? result : carom_world_step(stage->world);
}

static void run_good(const char *name)
{
    load(&small_stage, name);
    load(&ample_stage, name);
    run.frames = whole ? FRAMES_LONG : FRAMES;
    run.caps = small_stage.scene.caps.bodies ? small_stage.scene.caps : scene_config().caps;
    run.caps.hits = 16;
    lab_expect(set_up(&ample_stage, &run.caps), name);
    run.hash[0] = carom_world_hash(ample_stage.world);
    for (int frame = 1; frame <= run.frames; frame++) {
        run.status[frame] = lab_expect(frame_of(&ample_stage, frame), name);
        run.hash[frame] = carom_world_hash(ample_stage.world);
    }
    carom_usage(ample_stage.world, run.usage);
}

/* The scene failed while it was made: a world with room that is stopped at the same call is the same. */
static void made_short(int result, int pool, uint32_t size)
{
    uint64_t hash = carom_world_hash(small_stage.world);

    expect_same(faults_full(result), "another error", pool, size, 0);
    faults.stop = faults.failed;
    set_up(&ample_stage, &run.caps);
    faults.stop = 0;
    expect_same(hash == carom_world_hash(ample_stage.world), "another world", pool, size, 0);
}

/*
 * The frame failed: a world with room takes the snapshot and goes on. It has made that frame, so that it has the bodies that
 * the scene has left, and a load that did nothing would be noticed. The calls before the step have been made, so only the step
 * is left of this frame.
 */
static void go_on(int frame, int pool, uint32_t size)
{
    static uint8_t snapshot[SNAPSHOT];
    int bytes = carom_snapshot_save(small_stage.world, snapshot, sizeof snapshot), last;

    lab_expect(set_up(&ample_stage, &run.caps), "room");
    for (int made = 1; made <= frame; made++) {
        lab_expect(frame_of(&ample_stage, made), "room");
    }
    if (ample_stage.scene.sheet) {
        scene_sheet_shape(ample_stage.scene.sheet->vertices, frame - 1);
        lab_expect(carom_surface_set(ample_stage.world, SCENE_GROUND,
                                     (const int16_t(*)[3])ample_stage.scene.sheet->vertices),
                   "surface");
        lab_expect(scene_before(&ample_stage.scene, ample_stage.world, frame), "surface");
    }
    expect_same(bytes > 0 && carom_snapshot_load(ample_stage.world, snapshot, (size_t)bytes) == 0,
                "a snapshot was refused", pool, size, frame);
    last = whole || frame + 10 > run.frames ? run.frames : frame + 10;
    expect_same(carom_world_step(ample_stage.world) == run.status[frame] &&
                    carom_world_hash(ample_stage.world) == run.hash[frame],
                "another frame after a move", pool, size, frame);
    for (int next = frame + 1; next <= last; next++) {
        if (frame_of(&ample_stage, next) != run.status[next] ||
            carom_world_hash(ample_stage.world) != run.hash[next]) {
            expect_same(false, "another frame after a move", pool, size, next);
            break;
        }
    }
}

/* Returns whether all frames fit. */
static bool try_size(int pool, uint32_t size)
{
    struct carom_caps caps = run.caps;
    int result, frame;

    sizes++;
    *capacity(&caps, pool) = size;
    result = set_up(&small_stage, &caps);
    if (size < lowest[pool]) {
        expect_same(result == CAROM_ERR_ARGUMENT, "a world was made", pool, size, 0);
        return false;
    }
    if (result < 0) {
        made_short(result, pool, size);
        return false;
    }
    for (frame = 1; frame <= run.frames; frame++) {
        result = frame_of(&small_stage, frame);
        if (result < 0 || carom_world_hash(small_stage.world) != run.hash[frame]) {
            break;
        }
    }
    if (frame <= run.frames) {
        expect_same(faults_full(result) && !only_costs(pool), "another frame", pool, size, frame);
    }
    if (faults_full(result)) {
        int again;

        go_on(frame, pool, size);
        /* regions are set anew after an error, so fewer pairs may be enough; then the frame is right */
        again = carom_world_step(small_stage.world);
        expect_same(again == result || (again == run.status[frame] &&
                                        carom_world_hash(small_stage.world) == run.hash[frame]),
                    "another error", pool, size, frame);
    }
    return result >= 0;
}

/* Sizes until three in a row suffice, one by one; from there on in growing steps. */
static void try_scene(const char *name)
{
    long failures = faults_total(), before = sizes;
    char title[64];

    run_good(name);
    for (int pool = 0; pool < CAROM_POOL_COUNT; pool++) {
        uint32_t peak = run.usage[pool].peak, all = whole ? UINT32_MAX : 3, enough = 0, size = 0;

        while (size <= peak) {
            enough = try_size(pool, size) ? enough + 1 : 0;
            if (enough == 3) {
                all = 0;
            }
            size = next_size(size, peak, all);
        }
    }
    snprintf(title, sizeof title, "faults/%s", name);
    report(title, failures, before);
}

static bool is_brief(const char *name)
{
    static const char *const brief[] = {"pair",    "boxes3",   "sheet", "door",
                                        "crusher", "conveyor", "head48"};

    for (size_t i = 0; i < sizeof brief / sizeof *brief; i++) {
        if (strcmp(name, brief[i]) == 0) {
            return true;
        }
    }
    return false;
}

/* The user's scene needs a mesh; a world of the game over a link goes back in time. */
static bool plays(const char *name)
{
    return strcmp(name, "user") != 0 && strcmp(name, "lockstep") != 0 &&
           strncmp(name, "growth", 6) != 0;
}

int main(int argc, char **argv)
{
    const char *only = argc > 2 ? argv[2] : NULL;

    whole = argc > 1 && strcmp(argv[1], "long") == 0;
    if (argc > 1 && strcmp(argv[1], "list") == 0) {
        puts("play");
    } else if (!only || strcmp(only, "play") == 0) {
        play_all();
    }
    for (int n = 0; scene_name(n); n++) {
        const char *name = scene_name(n);

        if (argc > 1 && strcmp(argv[1], "list") == 0 && plays(name)) {
            puts(name);
        } else if (plays(name) && (only ? strcmp(only, name) == 0 : whole || is_brief(name))) {
            try_scene(name);
        }
    }
    return argc > 1 && strcmp(argv[1], "list") == 0 ? 0 : lab_finish();
}

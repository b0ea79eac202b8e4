/* SPDX-License-Identifier: MIT */
/*
 * host_pools - the head scene with short pools. Short working pools cost time only: the hash is the
 * same. Short output pools give a named error, and the world is as before the step: a snapshot of
 * it, loaded into a world with room, goes on as if nothing had happened.
 */
#include <stdio.h>
#include <stdlib.h>

#include "lib/lab.h"

/* Enough frames for every bounce, the slide and sleep. */
#define FRAMES 480

/* The hashes of the run with long pools, frame by frame. */
static uint64_t wanted[FRAMES + 1];
static struct carom_usage good[CAROM_POOL_COUNT];

/* The same field once more, below the first. Two pairs are near each other, one touches. */
static int add_second_field(const struct lab *lab)
{
    struct carom_body_def second = lab->scene.ground;

    second.position.c[2] = lab_fixed(-0.5, 32);
    return carom_body_add(lab->world, &second);
}

static struct lab *load(const struct carom_caps *caps)
{
    struct lab *lab = lab_load_scene("head");

    lab->config.caps = *caps;
    lab_start(lab);
    return lab;
}

static const struct carom_caps large = CAROM_CAPS(3, 2, 256, 2048, 65535, 65535);

static struct lab *load_two_fields(const struct carom_caps *caps)
{
    struct lab *lab = load(caps);

    if (add_second_field(lab) != 2) {
        puts("Bail out! no second field");
        exit(1);
    }
    return lab;
}

static void run_good(void)
{
    struct lab *lab = load_two_fields(&large);

    for (int frame = 0; frame < FRAMES; frame++) {
        wanted[frame] = carom_world_hash(lab->world);
        lab_step(lab, NULL);
    }
    wanted[FRAMES] = carom_world_hash(lab->world);
    carom_usage(lab->world, good);
    lab_report(good[CAROM_POOL_pairs].peak == 2 && good[CAROM_POOL_contacts].peak > 3 &&
                   good[CAROM_POOL_faces].peak > 20 && good[CAROM_POOL_candidates].peak > 20,
               "pools/peaks", "pairs %u, contacts %u, faces %u, candidates %u",
               good[CAROM_POOL_pairs].peak, good[CAROM_POOL_contacts].peak,
               good[CAROM_POOL_faces].peak, good[CAROM_POOL_candidates].peak);
    lab_free(lab);
}

/* ------------------------------------------------------------- working pools */

static void test_working(uint32_t candidates, uint32_t entries)
{
    struct carom_caps caps = large;
    struct carom_usage usage[CAROM_POOL_COUNT];
    struct lab *lab;
    int frame = 0;
    char name[64];

    caps.candidates = candidates;
    caps.entries = entries;
    lab = load_two_fields(&caps);
    while (frame < FRAMES && wanted[frame] == carom_world_hash(lab->world)) {
        lab_step(lab, NULL);
        frame++;
    }
    carom_usage(lab->world, usage);
    snprintf(name, sizeof name, "pools/candidates_%u_entries_%u", candidates, entries);
    lab_report(wanted[frame] == carom_world_hash(lab->world) && frame == FRAMES &&
                   usage[CAROM_POOL_candidates].peak <= candidates,
               name, "the same hash for %d of %d frames, refused %u", frame, FRAMES,
               usage[CAROM_POOL_candidates].refused);
    lab_free(lab);
}

/* -------------------------------------------------------------- output pools */

/*
 * Play the rest of the good run from the frame at which a world stopped; returns how many frames
 * agree with it.
 */
static int go_on(const struct lab *from, int frame)
{
    struct lab *lab = load_two_fields(&large);
    static uint8_t snapshot[1 << 16];
    int bytes = carom_snapshot_save(from->world, snapshot, sizeof snapshot);

    if (bytes < 0 || carom_snapshot_load(lab->world, snapshot, (size_t)bytes) < 0) {
        puts("# snapshot failed");
        frame = -1;
    }
    while (frame >= 0 && frame < FRAMES && wanted[frame] == carom_world_hash(lab->world)) {
        lab_step(lab, NULL);
        frame++;
    }
    lab_free(lab);
    return frame;
}

/* After an error the world reports no events, contacts or faces. */
static bool nothing_found(const struct lab *lab)
{
    const struct carom_event *events;
    const struct carom_face_ref *faces;

    return carom_events(lab->world, &events) == 0 &&
           carom_interfering_faces(lab->world, &faces) == 0 &&
           carom_contacts(lab->world, NULL, 0) == 0;
}

/*
 * One pool has fewer places than the good run needed. The world gives the good run's hashes, then
 * the named error, twice, and is unchanged.
 */
static void test_output(const struct carom_caps *caps, enum carom_pool pool, uint32_t size,
                        int error)
{
    struct lab *lab = load_two_fields(caps);
    struct carom_usage usage[CAROM_POOL_COUNT];
    int frame = 0, result = CAROM_OK, again;
    bool same = true, empty;
    char name[64];

    while (frame < FRAMES && result >= 0 && same) {
        same = wanted[frame] == carom_world_hash(lab->world);
        result = carom_world_step(lab->world);
        frame += result >= 0;
    }
    empty = nothing_found(lab);
    again = carom_world_step(lab->world);
    same = same && wanted[frame] == carom_world_hash(lab->world);
    carom_usage(lab->world, usage);
    snprintf(name, sizeof name, "pools/%s_%u", usage[pool].name, size);
    lab_report(result == error && again == error && same && empty && usage[pool].refused > 0 &&
                   usage[pool].peak <= size && go_on(lab, frame) == FRAMES,
               name, "frame %d: %s; the world %s", frame, carom_result_text(result),
               same ? "is as it was" : "has changed");
    lab_free(lab);
}

static void test_outputs(void)
{
    const uint32_t contacts = good[CAROM_POOL_contacts].peak, faces = good[CAROM_POOL_faces].peak;
    struct carom_caps caps = large;

    caps.pairs = 1;
    test_output(&caps, CAROM_POOL_pairs, 1, CAROM_ERR_PAIRS_FULL);
    caps = large;
    for (uint32_t size = 1; size < contacts; size++) {
        caps.contacts = size;
        test_output(&caps, CAROM_POOL_contacts, size, CAROM_ERR_CONTACTS_FULL);
    }
    caps = large;
    /* a world that is short of faces asks for those of one frame, which are fewer */
    for (uint32_t size = faces / 4; size > 0; size /= 4) {
        caps.faces = size;
        test_output(&caps, CAROM_POOL_faces, size, CAROM_ERR_FACES_FULL);
    }
}

/* A pool that is exactly as large as its peak is enough. */
static void test_exact(void)
{
    struct carom_caps caps = CAROM_CAPS(good[CAROM_POOL_bodies].peak, good[CAROM_POOL_pairs].peak,
                                        good[CAROM_POOL_contacts].peak, good[CAROM_POOL_faces].peak,
                                        large.entries, good[CAROM_POOL_candidates].peak);
    struct lab *lab = load_two_fields(&caps);
    int frame = 0, result = CAROM_OK;

    while (frame < FRAMES && result >= 0) {
        result = carom_world_step(lab->world);
        frame += result >= 0;
    }
    lab_report(carom_world_hash(lab->world) == wanted[FRAMES], "pools/exact",
               "room for the peaks alone: %d of %d frames, %s", frame, FRAMES,
               carom_result_text(result));
    lab_free(lab);
}

static void test_bodies(void)
{
    struct carom_caps caps = large;
    struct lab *lab;
    uint64_t before;
    int result;

    caps.bodies = 2;
    lab = load(&caps);
    before = carom_world_hash(lab->world);
    result = add_second_field(lab);
    lab_report(result == CAROM_ERR_BODIES_FULL && before == carom_world_hash(lab->world),
               "pools/bodies_2", "a third body: %s", carom_result_text(result));
    lab_free(lab);
}

/* ------------------------------------------------------------- little memory */

/* The frames in which a heap falls together and sleeps; the hash is taken after them. */
#define FRAMES_PLAYED 500

static uint64_t play(const char *name, const struct carom_caps *caps)
{
    static _Alignas(8) uint8_t meshes[SCENE_MESH_BYTES], block[SCENE_WORLD_BYTES];
    const struct carom_config config = scene_config();
    struct carom_world *world;
    struct scene scene;
    int frame = 0;

    lab_expect(scene_load(&scene, name, NULL, meshes, sizeof meshes), name);
    if (caps) {
        scene.caps = *caps;
    }
    lab_expect(scene_make(&scene, &config, block, sizeof block, &world), name);
    while (frame < FRAMES_PLAYED && carom_world_step(world) >= 0) {
        frame++;
    }
    return frame == FRAMES_PLAYED ? carom_world_hash(world) : 0;
}

/*
 * A scene gives the same in little memory as in much: poured heaps in little more than they need
 * (tests/blocks.csv has the bytes), and a thrown head with room for one candidate. The head's world
 * gathers for parts of a window, and never keeps what it gathered.
 */
static void test_little(const char *name, struct carom_caps caps)
{
    uint64_t ample = play(name, NULL), hash = play(name, &caps);
    char title[64];

    snprintf(title, sizeof title, "pools/%s", name);
    lab_report(hash == ample && hash != 0, title, "%u contacts, %u pairs, %u candidates",
               caps.contacts, caps.pairs, caps.candidates);
}

int main(void)
{
    const uint32_t sizes[] = {1, 2, 3, 16, 64};

    run_good();
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        test_working(sizes[i], large.entries);
    }
    test_working(large.candidates, 1);
    test_working(1, 1);
    test_outputs();
    test_exact();
    test_bodies();
    test_little("pile", (struct carom_caps)CAROM_CAPS(17, 88, 48, 136, 0, 128));
    test_little("pile32", (struct carom_caps)CAROM_CAPS(33, 136, 72, 208, 0, 256));
    test_little("head-spin2", (struct carom_caps)CAROM_CAPS(2, 1, 64, 1024, 0, 1));
    return lab_finish();
}

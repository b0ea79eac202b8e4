/* SPDX-License-Identifier: MIT */
/*
 * Print the cost of the frames of a scene, by stage, on a board that counts instructions: a row a frame to
 * the console. tools/bench.py runs it, and says what the rows mean.
 *
 * Options: scene=NAME  frames=600  first=1 (the first frame that has a row)  awake=1 (no sleep)
 *          throw=N (the N-th way to throw the scene's first body; 0: the scene's own)
 *          draw=N (every N-th of those frames is drawn as well, in both sizes), shadows=1 (with shadows)
 *          caps=B,P,C,F,E,N (capacities of the world)
 */
#include <stdlib.h>

#include "carom_draw.h"
#include "num/fix.h"
#include "port.h"
#include "scene.h"
#include "lib/test.h"

#ifndef BENCH_MESH_BYTES
#define BENCH_MESH_BYTES SCENE_LARGE_MESH_BYTES
#endif

enum { SIZES = 2 };
static const int32_t sizes[SIZES][2] = {{320, 240}, {512, 512}};

static _Alignas(8) uint8_t mesh_block[BENCH_MESH_BYTES];
static _Alignas(8) uint8_t world_block[SCENE_WORLD_BYTES];
/*
 * Enough to draw any scene in one part. The paper's z-buffer leaves less, and the picture is drawn
 * in parts.
 */
#ifndef BENCH_DRAW_BYTES
#define BENCH_DRAW_BYTES                                                                           \
    CAROM_DRAW_BYTES(SCENE_HEAD_VERTICES + SCENE_LARGE_VERTICES,                                   \
                     SCENE_HEAD_FACES + SCENE_LARGE_FACES)
#endif
/* Shadows need memory for their own faces. */
#define SHADOW_BYTES 65536
static _Alignas(8) uint8_t draw_block[SHADOW_BYTES + BENCH_DRAW_BYTES];
static uint32_t pixels[512 * 512];

static int expect(int result, const char *what)
{
    if (result < 0) {
        port_print("%s: %s\n", what, carom_result_text(result));
        port_exit(1);
    }
    return result;
}

/* Set the capacities that the options ask for; returns the bytes of the world. */
static size_t world_bytes(struct carom_caps *caps)
{
    uint32_t *const all[] = {&caps->bodies, &caps->pairs,   &caps->contacts,
                             &caps->faces,  &caps->entries, &caps->candidates};
    const char *at = port_option("caps");

    for (int i = 0; at && i < 6; i++) {
        char *end;

        *all[i] = (uint32_t)strtoul(at, &end, 10);
        at = end + (*end == ',');
    }
    return carom_world_bytes(caps);
}

static int64_t about_zero(struct test_random *random, int64_t most)
{
    return test_random_range(random, -most, most);
}

static int64_t largest(const carom_v3_q40 *v)
{
    int64_t most = 0;

    for (int k = 0; k < 3; k++) {
        most = v->c[k] > most ? v->c[k] : -v->c[k] > most ? -v->c[k] : most;
    }
    return most;
}

static carom_quat_q30 any_rotation(struct test_random *random)
{
    carom_quat_q30 q;
    int64_t c[4], sum = 0;

    for (int k = 0; k < 4; k++) {
        c[k] = about_zero(random, 30000);
        sum += c[k] * c[k];
    }
    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)(c[k] * CAROM_ONE_Q30 / fix_sqrt((uint64_t)sum));
    }
    return q;
}

/*
 * Throw a body in another way: random rotation, up to two units aside, and towards the middle. No
 * component of its velocity or spin exceeds the largest one that it had.
 */
static void throw_body(struct carom_body_def *def, uint64_t number)
{
    struct test_random random = {.state = number};
    int64_t speed = largest(&def->velocity), turn = largest(&def->spin);

    def->rotation = any_rotation(&random);
    for (int k = 0; k < 3; k++) {
        def->velocity.c[k] = about_zero(&random, speed);
        def->spin.c[k] = about_zero(&random, turn);
    }
    for (int k = 0; k < 2; k++) {
        def->position.c[k] = about_zero(&random, CAROM_POSITION_MM(2000));
        if ((def->position.c[k] > 0) == (def->velocity.c[k] > 0)) {
            def->velocity.c[k] = -def->velocity.c[k];
        }
    }
}

static bool all_asleep(const struct carom_world *world, int bodies)
{
    for (int body = 0; body < bodies; body++) {
        struct carom_body_state state;

        expect(carom_body_get(world, body, &state), "state");
        if (body != SCENE_GROUND && !state.asleep) {
            return false;
        }
    }
    return true;
}

/*
 * The phase of the last step: all bodies slept, bodies touched, boxes of two bodies met, or none
 * did.
 */
static const char *phase(const struct carom_world *world, bool slept,
                         const struct carom_stats *stats)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    expect(carom_usage(world, usage), "usage");
    return slept                                    ? "asleep"
           : stats->contacts > 0 || stats->hits > 0 ? "contact"
           : usage[CAROM_POOL_pairs].used > 0       ? "near"
                                                    : "apart";
}

static void print_columns(void)
{
    port_print("columns phase,candidates");
    for (int stage = 0; stage < CAROM_STAGE_COUNT; stage++) {
        port_print(",%s", carom_stage_name(stage));
    }
    port_print(",total");
    for (int i = 0; i < SIZES; i++) {
        port_print(",draw-%dx%d", (int)sizes[i][0], (int)sizes[i][1]);
    }
    port_print("\n");
}

static void print_ticks(uint32_t ticks)
{
    port_print(",%lu", (unsigned long)port_instructions(ticks));
}

static const struct carom_paint shaded = {.shadows = &carom_shadows};

static void print_draw(const struct carom_world *world, const struct carom_camera *camera,
                       const int32_t size[2])
{
    const bool shadows = port_option("shadows") != NULL;
    const struct carom_picture picture = {.pixels = pixels,
                                          .width = size[0],
                                          .height = size[1],
                                          .stride = size[0] * 4,
                                          .format = CAROM_XRGB8888,
                                          .workspace = draw_block,
                                          .workspace_bytes =
                                              sizeof draw_block - (shadows ? 0 : SHADOW_BYTES),
                                          .paint = shadows ? &shaded : NULL};
    uint32_t start = port_ticks();

    expect(carom_draw(world, camera, &picture, CAROM_DRAW_FLAT), "draw");
    print_ticks(port_ticks() - start);
}

static void print_frame(const struct carom_world *world, const struct carom_camera *camera,
                        bool slept, bool drawn)
{
    struct carom_stats stats;

    expect(carom_stats(world, &stats), "stats");
    port_print("frame %s,%lu", phase(world, slept, &stats), (unsigned long)stats.candidates);
    for (int stage = 0; stage < CAROM_STAGE_COUNT; stage++) {
        print_ticks(stats.ticks[stage]);
    }
    print_ticks(stats.total_ticks);
    for (int i = 0; drawn && i < SIZES; i++) {
        print_draw(world, camera, sizes[i]);
    }
    port_print("\n");
}

int main(void)
{
    static struct scene scene;
    const char *name = port_option("scene") ? port_option("scene") : "head";
    struct carom_config config = scene_config();
    struct carom_world *world;
    uint64_t hash;
    size_t bytes;
    int frames, first, draw;

    port_init();
    frames = (int)port_number("frames", 600);
    first = (int)port_number("first", 1);
    draw = (int)port_number("draw", 0);
    config.ticks = port_ticks;
    config.sleep = port_number("awake", 0) == 0;
    expect(scene_load(&scene, name, NULL, mesh_block, sizeof mesh_block), name);
    if (port_number("throw", 0) > 0) {
        throw_body(&scene.body, (uint64_t)port_number("throw", 0));
    }
    bytes = world_bytes(&scene.caps);
    config.caps = scene.caps;
    expect(scene_make(&scene, &config, world_block, bytes, &world), "world");

    port_print("world %lu\n", (unsigned long)bytes);
    print_columns();
    for (int frame = 1; frame <= frames; frame++) {
        bool slept = all_asleep(world, 2 + scene.other_count);

        expect(scene_before(&scene, world, frame), "scene");
        expect(carom_world_step(world), "step");
        if (frame >= first) {
            print_frame(world, scene.camera, slept, draw > 0 && frame % draw == 0);
        }
    }
    hash = carom_world_hash(world);
    /* in two halves: the small printf of newlib has no 64-bit formats */
    port_print("hash %08lx%08lx\n", (unsigned long)(hash >> 32),
               (unsigned long)(hash & 0xffffffff));
    port_exit(0);
}

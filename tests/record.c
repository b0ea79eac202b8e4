/* SPDX-License-Identifier: MIT */
/*
 * record - record a scene that plays by itself: record.elf scene=car frames=10000 to=FILE. stages=1
 * adds digests of stages; from=FRAME begins with the world before that frame; caps=2,1,16,64,0,64
 * uses a world of these capacities, so that a small board has room to play it. The scenes are
 * compiled unchanged, with tests/lib/recorded.h before them.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port.h"
#include "lib/recorded.h"
#include "scene_games.h"

struct carom_record recorder;

static _Alignas(8) uint8_t snapshot[1 << 20];
static _Alignas(8) uint8_t mesh_block[SCENE_MESH_BYTES], world_block[SCENE_WORLD_BYTES];

static void write_file(void *user, const void *bytes, size_t count)
{
    if (fwrite(bytes, 1, count, user) != count) {
        perror("record");
        exit(2);
    }
}

static int expect(int result, const char *what)
{
    if (result < 0) {
        fprintf(stderr, "%s: %s\n", what, carom_result_text(result));
        exit(2);
    }
    return result;
}

static void begin(FILE *file, const char *name)
{
    expect(carom_record_begin(&recorder, write_file, file, port_number("stages", 0) != 0, name),
           "begin");
}

/* Capacities, in the order of CAROM_POOLS; missing ones are 0. */
static void read_caps(struct carom_caps *caps, const char *text)
{
    memset(caps, 0, sizeof *caps);
#define READ_CAP(name, bytes, low, high)                                                           \
    caps->name = (uint32_t)strtoul(text, (char **)&text, 10);                                      \
    text += *text == ',';
    CAROM_POOLS(READ_CAP)
#undef READ_CAP
}

int main(void)
{
    const char *name, *path;
    static struct scene scene;
    struct carom_config config = scene_config();
    struct carom_world *world;
    FILE *file;

    port_init();
    name = port_option("scene") ? port_option("scene") : "car";
    path = port_option("to") ? port_option("to") : "out/car.replay";
    file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(2);
    }
    if (port_number("from", 0) == 0) {
        begin(file, name);
    }
    expect(scene_load(&scene, name, NULL, mesh_block, sizeof mesh_block), name);
    if (port_option("caps")) {
        read_caps(&scene.caps, port_option("caps"));
        config.caps = scene.caps;
    }
    expect(scene_make(&scene, &config, world_block, sizeof world_block, &world), name);
    for (uint32_t frame = 1; frame <= port_number("frames", 10000); frame++) {
        if (frame == port_number("from", 0)) {
            begin(file, name);
            expect(carom_record_world(&recorder, world, snapshot, sizeof snapshot), "from");
        }
        expect(scene_before(&scene, world, (int)frame), "before");
        expect(carom_world_step(world), "step");
    }
    carom_record_end(&recorder);
    printf("%ld bytes\n", ftell(file));
    fclose(file);
    port_exit(0);
}

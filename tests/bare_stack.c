/* SPDX-License-Identifier: MIT */
/*
 * bare_stack - the stack of steps alone, by painting, on a bare Cortex-M. Before each step the program paints the free part of
 * the stack, and after it looks how far down the paint is gone. Prints a line a scene: its name and the most bytes that a step
 * took. There is no tick function.
 *
 * Options: scene=NAME (else all)  frames=600
 */
#include <string.h>

#include "port.h"
#include "scene.h"

enum { PAINT = 0xa5 };

extern char stack_bottom[];

static _Alignas(8) uint8_t mesh_block[SCENE_LARGE_MESH_BYTES], world_block[SCENE_WORLD_BYTES];

/* Returns the bytes that one step took, or an error. */
static __attribute__((noinline)) int step(struct carom_world *world)
{
    volatile char *low;
    char *here;
    int result;

    /* the stack pointer, from which the step goes on */
    __asm__ volatile("mov %0, sp" : "=r"(here));
    for (low = stack_bottom; low < here; low++) {
        *low = (char)PAINT;
    }
    result = carom_world_step(world);
    for (low = stack_bottom; low < here && *low == (char)PAINT; low++) {
    }
    return result < 0 ? result : (int)(here - low);
}

/* Play a scene. Returns the most bytes of a step, or an error. */
static int play(const char *name, int frames)
{
    static struct scene scene;
    const struct carom_config config = scene_config();
    struct carom_world *world;
    int most = 0, result = scene_load(&scene, name, NULL, mesh_block, sizeof mesh_block);

    if (result >= 0) {
        result = scene_make(&scene, &config, world_block, sizeof world_block, &world);
    }
    for (int frame = 1; frame <= frames && result >= 0; frame++) {
        result = scene_before(&scene, world, frame);
        if (result >= 0) {
            result = step(world);
            most = result > most ? result : most;
        }
    }
    return result < 0 ? result : most;
}

int main(void)
{
    const char *only = port_option("scene"), *name;
    const int frames = (int)port_number("frames", 600);

    port_init();
    for (int i = 0; (name = scene_name(i)) != NULL; i++) {
        if (strcmp(only ? only : name, name) == 0 && strcmp(name, "user") != 0) {
            int bytes = play(name, frames);

            if (bytes < 0) {
                port_print("%s: %s\n", name, carom_result_text(bytes));
                return 1;
            }
            port_print("%s %d\n", name, bytes);
        }
    }
    return 0;
}

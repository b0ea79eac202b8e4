/* SPDX-License-Identifier: MIT */
/* A picture, a scene, frames and random numbers, for the tests of the viewer. */
#include "viewed.h"

#include "lab.h"
#include "test.h"
#include "view.h"

uint32_t viewed_pixels[HEIGHT + 2 * SPARE_Y][STRIDE];

int viewed_range(int low, int high)
{
    static struct test_random chance = {.state = 20251};

    return (int)test_random_range(&chance, low, high);
}

void viewed_show(int width, int height)
{
    const struct carom_picture picture = {.pixels = viewed_pixels[SPARE_Y],
                                          .width = width,
                                          .height = height,
                                          .stride = sizeof viewed_pixels[0],
                                          .format = CAROM_XRGB8888};

    for (int y = 0; y < HEIGHT + 2 * SPARE_Y; y++) {
        for (int x = 0; x < STRIDE; x++) {
            viewed_pixels[y][x] = UNTOLD;
        }
    }
    lab_expect(view_size(&picture), "size");
}

void viewed_open(const char *scene)
{
    lab_expect(view_open(scene, NULL), scene);
    view_pause(false);
    view_slow(1);
    view_toggles(view_usual());
}

void viewed_run(int frames)
{
    for (int i = 0; i < frames; i++) {
        lab_expect(view_frame(), view_scene());
    }
}

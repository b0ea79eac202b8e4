/* SPDX-License-Identifier: MIT */
/* viewed.h - a picture, a scene, frames and chance, for tests of the viewer (examples/view.h). */
#ifndef CAROM_TESTS_VIEWED_H
#define CAROM_TESTS_VIEWED_H

#include <stdint.h>

#define WIDTH   320
#define HEIGHT  240
#define STRIDE  (WIDTH + 8)
#define SPARE_Y 2           /* rows above and below the picture */
#define UNTOLD  0x00abcdefu /* of pixels that nothing may write to */

extern uint32_t viewed_pixels[HEIGHT + 2 * SPARE_Y][STRIDE];

/* A number of low .. high, the same ones in each run. */
int viewed_range(int low, int high);
/* Let the view have a picture of up to WIDTH x HEIGHT. */
void viewed_show(int width, int height);
/* Open a scene that goes on, as it usually looks. */
void viewed_open(const char *scene);
/* So many frames; an error ends the program. */
void viewed_run(int frames);

#endif

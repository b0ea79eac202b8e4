/* SPDX-License-Identifier: MIT */
/* viewed - a picture, a scene, frames and random numbers, for tests of the viewer (examples/view.h). */
#ifndef CAROM_TESTS_VIEWED_H
#define CAROM_TESTS_VIEWED_H

#include <stdint.h>

#define WIDTH   320
#define HEIGHT  240
#define STRIDE  (WIDTH + 8)
#define SPARE_Y 2           /* rows above and below the picture */
#define UNTOLD  0x00abcdefu /* colour of pixels that nothing may overwrite */

extern uint32_t viewed_pixels[HEIGHT + 2 * SPARE_Y][STRIDE];

/* A random number of low .. high, the same in each run. */
int viewed_range(int low, int high);
/* Give the view a picture of up to WIDTH x HEIGHT. */
void viewed_show(int width, int height);
/* Open an unpaused scene with the usual toggles. */
void viewed_open(const char *scene);
/* Run frames; an error ends the program. */
void viewed_run(int frames);

#endif

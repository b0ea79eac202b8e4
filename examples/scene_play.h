/* SPDX-License-Identifier: MIT */
/*
 * scene_play.h - the pad of a board plays with a scene, at 60 frames a second if the board keeps up.
 *
 *   A       throws the body up
 *   arrows  tilt gravity while they are held
 *   B       shows or hides the figures
 *   SELECT  faces or lines, which a display that is sent rows cannot show
 *   START   starts again; so does a body that fell off the ground
 *
 * In a game of scene_games.h A and the arrows are the game's: the car is steered by left and right, driven by
 * up and down and lifted by A; who walks turns by left and right, walks by up and down and jumps by A. Until the first key is pressed
 * they go by themselves.
 */
#ifndef CAROM_SCENE_PLAY_H
#define CAROM_SCENE_PLAY_H

#include "carom.h"
#include "port.h"
#include "scene.h"

struct scene_play {
    bool lines, plain; /* lines, not faces; no figures */
    uint32_t held;     /* keys of the frame before */
    uint32_t due;      /* ticks at which the frame ends */
    int undrawn;       /* frames since the last that was drawn */
};

/* Do what the keys ask of the world before a frame; false when the scene is to start again. */
bool scene_play_keys(struct scene_play *play, const struct scene *scene, struct carom_world *world,
                     uint32_t keys);

/*
 * Whether a frame is to be drawn: not when it is late, but for one in four. Waits for the end of a
 * frame that is early.
 */
bool scene_play_draws(struct scene_play *play);

/* Rows at the bottom of a framebuffer for figures, and two of them there, in ticks of the port. */
#define SCENE_PLAY_ROWS 8
void scene_play_figures(const struct port_fb *fb, uint32_t step, uint32_t draw);

#endif

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
 * In a game of scene_games.h, A and the arrows belong to the game. Car: left and right steer, up and down drive, A
 * lifts it. Walker: left and right turn, up and down walk, A jumps. Until the first key goes down a script plays.
 */
#ifndef CAROM_SCENE_PLAY_H
#define CAROM_SCENE_PLAY_H

#include "carom.h"
#include "port.h"
#include "scene.h"

struct scene_play {
    bool lines, plain; /* lines instead of faces; no figures */
    uint32_t held;     /* keys of the previous frame */
    uint32_t due;      /* tick at which the frame ends */
    int undrawn;       /* frames since the last one drawn */
};

/* Apply the keys to the world before a frame. False if the scene is to start again. */
bool scene_play_keys(struct scene_play *play, const struct scene *scene, struct carom_world *world,
                     uint32_t keys);

/*
 * True if a frame must be drawn: a late frame is skipped, but never more than three in a row. Waits
 * for the end of a frame that is early.
 */
bool scene_play_draws(struct scene_play *play);

/*
 * Rows at the bottom of a framebuffer for figures; draws two figures there, in ticks of the port.
 */
#define SCENE_PLAY_ROWS 8
void scene_play_figures(const struct port_fb *fb, uint32_t step, uint32_t draw);

#endif

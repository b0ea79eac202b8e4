/* SPDX-License-Identifier: MIT */
/*
 * show.h - the parts of a scene that its frames need: the calls before a step, its camera, and its
 * look. A small board has no room for the rest while it steps.
 */
#ifndef CAROM_SHOW_H
#define CAROM_SHOW_H

#include "scene.h"

struct show {
    const struct carom_camera *camera;
    struct scene_sheet *sheet;
    const struct scene_game *game;
};

struct show show_of(const struct scene *scene);

/* Prepare a frame, 1 being the first, with these keys held, or SCENE_NOBODY. Returns >= 0 or an error. */
int show_before(const struct show *show, struct carom_world *world, int frame, uint32_t keys);

/* The scene's camera; a game's camera may follow its player. Valid until the next call. */
const struct carom_camera *show_camera(const struct show *show, const struct carom_world *world);

/* The scene's look. Valid until the next call. */
const struct carom_paint *show_paint(const struct show *show);

/* A game's line of text; empty if it has none. */
void show_say(const struct show *show, const struct carom_world *world, char text[SCENE_TEXT]);

#endif

/* SPDX-License-Identifier: MIT */
/* host_scenes - a scene that plays without input and is watched frame by frame. */
#ifndef CAROM_TESTS_HOST_SCENES_H
#define CAROM_TESTS_HOST_SCENES_H

#include "lab.h"
#include "scene_games.h"

#define PLAY_BODIES 64

struct play {
    struct scene scene;
    struct carom_world *world;
    void *mesh_block, *world_block;
    int bodies, frame;
    struct oracle_mesh mesh[PLAY_BODIES];
    struct carom_body_state first[PLAY_BODIES], now[PLAY_BODIES];
    long crossings, looked;   /* pairs of crossing faces, and checked pairs of bodies */
    double mark[PLAY_BODIES]; /* a watcher's memory; 0 at first */
    char said[120];           /* a judge's remarks */
};

struct play_scene {
    const char *name;
    int frames, look_every;           /* frames from one check of crossings to the next */
    void (*watch)(struct play *play); /* called after each frame; or NULL */
    bool (*judge)(struct play *play); /* called at the end */
};

/* The scenes of scenes_show.c, ended by one without a name. */
extern const struct play_scene play_shows[];

/* Position of a body along an axis, units. */
double play_at(const struct carom_body_state *state, int axis);
/* The angle of a body that turns about one axis of the world, within a full turn. */
double play_turn(const struct play *play, int body, int axis);
/* Add the change of an angle to a total, across full turns; returns the total. */
double play_turned(double *total, double turn);

#endif

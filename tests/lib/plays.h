/* SPDX-License-Identifier: MIT */
/*
 * plays - endless scenes: bodies are pushed, pulled and tilted so that they move for thousands of frames. The calls
 * before a frame follow from its number and from the state of the world, so a play can continue from a snapshot.
 */
#ifndef CAROM_TESTS_PLAYS_H
#define CAROM_TESTS_PLAYS_H

#include "scene.h"

struct play {
    const char *name, *scene;
    int bodies; /* moving bodies; 0: as many as the scene has */
    void (*arrange)(struct scene *);
    /* Make the calls before a frame; the first is 1. Returns CAROM_OK or an error. */
    int (*act)(struct carom_world *world, int bodies, int frame);
    /* Fold the answers to queries after a frame into a digest. Returns CAROM_OK or an error. */
    int (*ask)(struct carom_world *world, const struct scene *scene, int frame, uint64_t *digest);
};

#define PLAYS 15
extern const struct play plays[PLAYS];

/* 64-bit FNV-1a of a number's bytes, lowest first, continued from the last digest. */
#define PLAY_DIGEST 0xcbf29ce484222325u
uint64_t play_fold(uint64_t digest, uint64_t number);
/* Fold the state after a step, its status and its events. */
uint64_t play_fold_step(const struct carom_world *world, int status, uint64_t digest);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * faults - pools that are full: every public call that can meet one is watched. A program that is linked with FAULTS_WRAP
 * (Makefile) calls the functions of this file in place of those of the library: each takes everything that a caller can see
 * of the world, makes the call, and looks again when the pool was full. Host only.
 */
#ifndef CAROM_TESTS_FAULTS_H
#define CAROM_TESTS_FAULTS_H

#include "carom.h"

/* Counts of a run. Each call has a place in `failures`, by faults_names. */
enum { FAULTS_CALLS = 15 };
extern const char *const faults_names[FAULTS_CALLS];
struct faults {
    long failures[FAULTS_CALLS]; /* calls that met a full pool */
    long changed;                /* of these, calls after which something was not as before */
    long
        listed; /* failed steps and moves of a surface that left something in the lists they forget */
    long calls, failed; /* calls so far; the last of them that met a full pool */
    long stop;          /* the call that is to be refused without being made; 0: none */
};
extern struct faults faults;

/* True if a result says that a pool is full. */
bool faults_full(int result);
/* A digest of all that the interface shows of a world, but for usage. `lists`: what the last step found, too. */
uint64_t faults_look(struct carom_world *world, bool lists);
/* All failures together. */
long faults_total(void);

/* A small world that makes every call of those, in order. */
struct faults_play;
struct faults_play *faults_play_new(const struct carom_caps *caps);
void faults_play_free(struct faults_play *play);
struct carom_world *faults_play_world(const struct faults_play *play);
int faults_play_length(void);
/* The number of calls before the first step. */
int faults_play_settled(void);
/* Make call i, from 0 on; an error is what the call said. */
int faults_play_call(struct faults_play *play, int i);

#endif

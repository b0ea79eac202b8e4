/* SPDX-License-Identifier: MIT */
/* play - what reads the bytes of a recording for who plays it. */
#ifndef CAROM_SRC_PLAY_H
#define CAROM_SRC_PLAY_H

#include "call.h"

/* The bytes that were not read yet; and how much was: true if all of it was there and meant something. */
struct replay_coder play_rest(const struct carom_replay *p);
bool play_done(struct carom_replay *p, const struct replay_coder *c);
/* A block of the player's memory that the next call may have again; NULL when there is no room. */
void *play_take_again(struct carom_replay *p, uint8_t **block, size_t *had, size_t bytes);

/* What comes next, after its first byte: CAROM_OK, CAROM_ERR_FORMAT or CAROM_ERR_MEMORY. */
int play_mesh(struct carom_replay *p);
int play_joint(struct carom_replay *p);
/* What follows a call, to which pointers to it are given. */
int play_data(struct carom_replay *p, struct replay_call *call);

#endif

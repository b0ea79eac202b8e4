/* SPDX-License-Identifier: MIT */
/* Reading the bytes of a recording, for the player. */
#ifndef CAROM_SRC_PLAY_H
#define CAROM_SRC_PLAY_H

#include "call.h"

/* The bytes not read yet. After reading: true if all bytes were there and meant something. */
struct replay_coder play_rest(const struct carom_replay *p);
bool play_done(struct carom_replay *p, const struct replay_coder *c);
/* A block of the player's memory that the next call may use again; NULL if there is no room. */
void *play_take_again(struct carom_replay *p, uint8_t **block, size_t *had, size_t bytes);

/* Read what comes next, after its first byte. Returns CAROM_OK, CAROM_ERR_FORMAT or CAROM_ERR_MEMORY. */
int play_mesh(struct carom_replay *p);
int play_joint(struct carom_replay *p);
/* Read the data behind a call, and point the call at it. */
int play_data(struct carom_replay *p, struct replay_call *call);

#endif

/* SPDX-License-Identifier: MIT */
/* replay - what the functions that record share. */
#ifndef CAROM_SRC_RECORD_H
#define CAROM_SRC_RECORD_H

#include "call.h"

/* Whether calls on this world are to be written. */
bool record_is_open(const struct carom_record *r, const struct carom_world *world);
/* Write a call, before it is made; and what came of it. */
void record_call(struct carom_record *r, const struct replay_call *call);
void record_result(struct carom_record *r, uint8_t op, int result);
/* Write a call that nobody made, of bodies that only the recording has. */
void record_made(struct carom_record *r, const struct replay_call *call, int result);
/* Make a call between both. */
int record_do(struct carom_record *r, struct carom_world *world, const struct replay_call *call);

/* A byte that begins what is no call. */
void record_token(struct carom_record *r, uint8_t token);
/* Contacts of the recorder's world are asked about through it, or by the program itself again. */
void record_ask(struct carom_record *r, struct carom_config *config);
void record_ask_no_more(struct carom_record *r);

/* What follows a call. */
void record_vertices(struct carom_record *r, const int16_t (*vertices)[3], uint32_t count);
void record_bytes(struct carom_record *r, const void *bytes, uint32_t count);
void record_material(struct carom_record *r, const struct carom_material *material);
/* The number of a mesh, which is written if it is a new one. */
uint32_t record_mesh(struct carom_record *r, const struct carom_mesh *mesh);

#endif

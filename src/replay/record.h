/* SPDX-License-Identifier: MIT */
/* Declarations shared by the functions that record. */
#ifndef CAROM_SRC_RECORD_H
#define CAROM_SRC_RECORD_H

#include "call.h"

/* True if calls on this world are recorded. */
bool record_is_open(const struct carom_record *r, const struct carom_world *world);
/* Write a call before it is made, and its result after. */
void record_call(struct carom_record *r, const struct replay_call *call);
void record_result(struct carom_record *r, uint8_t op, int result);
/* Write a call that nobody made, about bodies that only the recording has. */
void record_made(struct carom_record *r, const struct replay_call *call, int result);

/* Write a byte that begins something other than a call. */
void record_token(struct carom_record *r, uint8_t token);
/* Route contact questions of the recorder's world through the recorder, or to the program again. */
void record_ask(struct carom_record *r, struct carom_config *config);
void record_ask_no_more(struct carom_record *r);

/* Write the data behind a call. */
void record_vertices(struct carom_record *r, const int16_t (*vertices)[3], uint32_t count);
void record_bytes(struct carom_record *r, const void *bytes, uint32_t count);
void record_material(struct carom_record *r, const struct carom_material *material);
/* The number of a mesh; a new mesh is written. */
uint32_t record_mesh(struct carom_record *r, const struct carom_mesh *mesh);

#endif

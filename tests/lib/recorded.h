/* SPDX-License-Identifier: MIT */
/* Macros that record each call on a world: make compiles a source with -include. tests/record.c has the recorder. */
#ifndef RECORDED_H
#define RECORDED_H

struct carom_record;
extern struct carom_record recorder;
#define CAROM_RECORDER (&recorder)
#include "carom_replay.h"

#endif

/* SPDX-License-Identifier: MIT */
/* What a source is compiled with (-include) to have its calls on a world recorded; tests/record.c has the recorder. */
#ifndef RECORDED_H
#define RECORDED_H

struct carom_record;
extern struct carom_record recorder;
#define CAROM_RECORDER (&recorder)
#include "carom_replay.h"

#endif

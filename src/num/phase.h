/* SPDX-License-Identifier: MIT */
/*
 * phase - memory that stages use in turn. In debug builds a tag beside it says whose it is at the
 * moment: who takes it over sets the tag, who uses it asserts the tag. Release builds have neither.
 *
 * A tag is one byte and stands where the structure has padding, so that sizes are the same.
 */
#ifndef CAROM_SRC_PHASE_H
#define CAROM_SRC_PHASE_H

#include "fix.h"

#ifdef CAROM_DEBUG
#define PHASE_TAG(tag)           uint8_t tag;
#define PHASE_BEGIN(tag, phase)  ((void)((tag) = (phase)))
#define PHASE_ASSERT(tag, phase) CAROM_ASSERT((tag) == (phase))
#else
#define PHASE_TAG(tag)
#define PHASE_BEGIN(tag, phase)  ((void)0)
#define PHASE_ASSERT(tag, phase) ((void)0)
#endif

#endif

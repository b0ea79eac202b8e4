/* SPDX-License-Identifier: MIT */
#ifndef CAROM_SRC_INTERFERE_NARROW_H
#define CAROM_SRC_INTERFERE_NARROW_H

#include "interfere.h"

/*
 * A face of the leaf at hand and a face of b whose intervals overlap in some cell: emit the
 * vertex/face and edge/edge pairs that can touch; if there are any, both faces interfere.
 */
void interfere_narrow(struct interfere *w, uint16_t leaf_face, uint16_t face_b);

#endif

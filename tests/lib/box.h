/* SPDX-License-Identifier: MIT */
/*
 * box - the vertices and faces of a box; the tests build boxes here only. Bit k of a corner's
 * number is set if the corner is on the high side of axis k.
 */
#ifndef CAROM_TEST_BOX_H
#define CAROM_TEST_BOX_H

#include <stdint.h>

/* The initializer of int16_t vertices[8][3] for a box about the origin with these half sides. */
#define BOX_CORNERS(x, y, z)                                                                       \
    {                                                                                              \
        {-(x), -(y), -(z)}, {(x), -(y), -(z)}, {-(x), (y), -(z)}, {(x), (y), -(z)},                \
            {-(x), -(y), (z)}, {(x), -(y), (z)}, {-(x), (y), (z)}, {(x), (y), (z)},                \
    }

static const uint16_t box_faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                          {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                          {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

/* The corners of a box between two opposite ones. */
static inline void box_corners(int16_t vertices[8][3], const int low[3], const int high[3])
{
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            vertices[i][k] = (int16_t)(i >> k & 1 ? high[k] : low[k]);
        }
    }
}

#endif

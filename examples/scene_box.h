/* SPDX-License-Identifier: MIT */
/*
 * The vertices and faces of a box, for the scenes and for the comparison with other engines. Corners run around the
 * bottom, then around the top. Hashes of scenes depend on that order.
 */
#ifndef CAROM_EXAMPLES_SCENE_BOX_H
#define CAROM_EXAMPLES_SCENE_BOX_H

#include <stdint.h>

/* The initializer of int16_t vertices[8][3] for a box about the origin with these half sides. */
#define SCENE_BOX_CORNERS(x, y, z)                                                                 \
    {                                                                                              \
        {-(x), -(y), -(z)}, {(x), -(y), -(z)}, {(x), (y), -(z)}, {-(x), (y), -(z)},                \
            {-(x), -(y), (z)}, {(x), -(y), (z)}, {(x), (y), (z)}, {-(x), (y), (z)},                \
    }

static const uint16_t scene_box_faces[12][3] = {
    {0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7},
};

#endif

/* SPDX-License-Identifier: MIT */
/* The meshes of a heap for Carom: a box of side 1 and a plane of 64 x 64, in C and in C++. */
#ifndef CAROM_TOOLS_HEAPS_BOX_H
#define CAROM_TOOLS_HEAPS_BOX_H

#include "carom.h"

enum { HALF = 2048, FAR = 32 * 256 }; /* quanta */
static const int16_t box_vertices[8][3] = {
    {-HALF, -HALF, -HALF}, {HALF, -HALF, -HALF}, {HALF, HALF, -HALF}, {-HALF, HALF, -HALF},
    {-HALF, -HALF, HALF},  {HALF, -HALF, HALF},  {HALF, HALF, HALF},  {-HALF, HALF, HALF}};
static const uint16_t box_faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                          {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                          {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const int16_t plane_vertices[4][3] = {
    {-FAR, -FAR, 0}, {FAR, -FAR, 0}, {FAR, FAR, 0}, {-FAR, FAR, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw box_raw = {box_vertices, box_faces, 8, 12, 12, CAROM_SOLID};
static const struct carom_mesh_raw plane_raw = {plane_vertices, plane_faces, 4, 2, 8,
                                                CAROM_SURFACE};

#endif

/* SPDX-License-Identifier: MIT */
/* The meshes of a heap for Carom: a box of side 1 and a plane of 64 x 64, in C and in C++. */
#ifndef CAROM_TOOLS_HEAPS_BOX_H
#define CAROM_TOOLS_HEAPS_BOX_H

#include "carom.h"
#include "../examples/scene_box.h"

enum { HALF = 2048, FAR = 32 * 256 }; /* quanta */
static const int16_t box_vertices[8][3] = SCENE_BOX_CORNERS(HALF, HALF, HALF);
static const int16_t plane_vertices[4][3] = {
    {-FAR, -FAR, 0}, {FAR, -FAR, 0}, {FAR, FAR, 0}, {-FAR, FAR, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw box_raw = {box_vertices, scene_box_faces, 8, 12,
                                              12,           CAROM_SOLID};
static const struct carom_mesh_raw plane_raw = {plane_vertices, plane_faces, 4, 2, 8,
                                                CAROM_SURFACE};

#endif

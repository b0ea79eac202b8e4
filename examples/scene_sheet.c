/* SPDX-License-Identifier: MIT */
/* The sheet: a shallow bowl with two waves, one along x, one along y. */
#include "scene.h"

/* Half its side, and the heights of rim and waves; a quantum is 1/4096 unit. */
#define HALF   16384
#define RIM    3072
#define WAVE_X 640
#define WAVE_Y 420
/* 256ths of a period, from one vertex to the next and from one frame to the next. */
#define STEP_X  26
#define STEP_Y  19
#define SPEED_X 3
#define SPEED_Y 2

/* 32767 sin of 64ths of a right angle. */
static const int16_t quarter[65] = {
    0,     804,   1608,  2410,  3212,  4011,  4808,  5602,  6393,  7179,  7962,  8739,  9512,
    10278, 11039, 11793, 12539, 13279, 14010, 14732, 15446, 16151, 16846, 17530, 18204, 18868,
    19519, 20159, 20787, 21403, 22005, 22594, 23170, 23731, 24279, 24811, 25329, 25832, 26319,
    26790, 27245, 27683, 28105, 28510, 28898, 29268, 29621, 29956, 30273, 30571, 30852, 31113,
    31356, 31580, 31785, 31971, 32137, 32285, 32412, 32521, 32609, 32678, 32728, 32757, 32767,
};

/* 32767 sin of 256ths of a full turn. */
static int32_t sine(int32_t phase)
{
    int32_t within = phase & 63;

    switch (phase >> 6 & 3) {
    case 0:
        return quarter[within];
    case 1:
        return quarter[64 - within];
    case 2:
        return -quarter[within];
    default:
        return -quarter[64 - within];
    }
}

void scene_sheet_shape(int16_t (*vertices)[3], int32_t frame)
{
    for (int32_t v = 0; v < SCENE_SHEET_VERTICES; v++) {
        int32_t col = v % (SCENE_SHEET_SIDE + 1), row = v / (SCENE_SHEET_SIDE + 1);
        int32_t x = 2 * HALF / SCENE_SHEET_SIDE * col - HALF;
        int32_t y = 2 * HALF / SCENE_SHEET_SIDE * row - HALF;
        int32_t rim = (x * (x / 64) + y * (y / 64)) / (HALF / 64) * (RIM / 64) / (HALF / 64);
        int32_t wave_x = WAVE_X * sine(STEP_X * col + SPEED_X * frame) / 32767;
        int32_t wave_y = WAVE_Y * sine(STEP_Y * row - SPEED_Y * frame) / 32767;

        vertices[v][0] = (int16_t)x;
        vertices[v][1] = (int16_t)y;
        vertices[v][2] = (int16_t)(rim + wave_x + wave_y);
    }
}

struct carom_mesh_raw scene_sheet_raw(struct scene_sheet *sheet)
{
    struct carom_mesh_raw raw = {
        (const int16_t(*)[3])sheet->vertices,
        (const uint16_t(*)[3])sheet->faces,
        SCENE_SHEET_VERTICES,
        SCENE_SHEET_FACES,
        12,
        CAROM_SURFACE,
    };

    scene_sheet_shape(sheet->vertices, 0);
    for (uint32_t q = 0; q < SCENE_SHEET_FACES / 2; q++) {
        uint16_t a = (uint16_t)(q + q / SCENE_SHEET_SIDE), b = (uint16_t)(a + 1);
        uint16_t c = (uint16_t)(b + SCENE_SHEET_SIDE + 1), d = (uint16_t)(c - 1);
        uint16_t *face = sheet->faces[2 * q], *other = sheet->faces[2 * q + 1];
        bool turned = (q + q / SCENE_SHEET_SIDE) % 2 == 1;

        face[0] = a;
        face[1] = b;
        face[2] = turned ? d : c;
        other[0] = turned ? b : a;
        other[1] = c;
        other[2] = d;
    }
    return raw;
}

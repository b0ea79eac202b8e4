/* SPDX-License-Identifier: MIT */
/* A body that is nearly a ball. */
#include <math.h>
#include <string.h>

#include "ball.h"
#include "real.h"

int16_t ball_vertices[BALL_FACES(BALL_CUTS) / 2 + 2][3];
static uint16_t ball_faces[BALL_FACES(BALL_CUTS)][3];
struct carom_mesh_raw ball_raw = {
    (const int16_t (*)[3])ball_vertices, (const uint16_t (*)[3])ball_faces, 0, 0, 12, CAROM_SOLID};

/* The vertex of the ball in a direction, made if it is not there yet. */
static uint16_t vertex_along(const double direction[3])
{
    double length = sqrt(real_dot(direction, direction));
    int16_t v[3];

    for (int k = 0; k < 3; k++) {
        v[k] = (int16_t)lrint(BALL_QUANTA * direction[k] / length);
    }
    for (uint16_t i = 0; i < ball_raw.vertex_count; i++) {
        if (memcmp(ball_vertices[i], v, sizeof v) == 0) {
            return i;
        }
    }
    memcpy(ball_vertices[ball_raw.vertex_count], v, sizeof v);
    return (uint16_t)ball_raw.vertex_count++;
}

static uint16_t vertex_between(uint16_t a, uint16_t b)
{
    double middle[3];

    for (int k = 0; k < 3; k++) {
        middle[k] = ball_vertices[a][k] + ball_vertices[b][k];
    }
    return vertex_along(middle);
}

/* Cut every face of the ball in four. */
void ball_cut(void)
{
    for (uint32_t f = 0, n = ball_raw.face_count; f < n; f++) {
        uint16_t corner[3], middle[3];

        memcpy(corner, ball_faces[f], sizeof corner);
        for (int k = 0; k < 3; k++) {
            middle[k] = vertex_between(corner[k], corner[(k + 1) % 3]);
        }
        for (int k = 0; k < 3; k++) {
            const uint16_t face[3] = {corner[k], middle[k], middle[(k + 2) % 3]};

            memcpy(ball_faces[ball_raw.face_count++], face, sizeof face);
        }
        memcpy(ball_faces[f], middle, sizeof middle);
    }
}

/*
 * An icosahedron, cut. Its corners are (0, +-1, +-golden ratio) and the turns of that; its faces are
 * the triples of corners at the least distance, 2, from each other.
 */
void ball_make(int cuts)
{
    const double golden = (1 + sqrt(5)) / 2;
    double corner[12][3] = {{0}};

    ball_raw.vertex_count = ball_raw.face_count = 0;
    for (int i = 0; i < 12; i++) {
        corner[i][(i / 4 + 1) % 3] = i & 1 ? 1 : -1;
        corner[i][(i / 4 + 2) % 3] = i & 2 ? golden : -golden;
        vertex_along(corner[i]);
    }
    for (uint16_t a = 0; a < 12; a++) {
        for (uint16_t b = 0; b < 12; b++) {
            for (uint16_t c = 0; c < 12; c++) {
                const double *p = corner[a], *q = corner[b], *r = corner[c];
                double volume = p[0] * (q[1] * r[2] - q[2] * r[1]) +
                                p[1] * (q[2] * r[0] - q[0] * r[2]) +
                                p[2] * (q[0] * r[1] - q[1] * r[0]);
                const uint16_t face[3] = {a, b, c};

                /* a.b is the golden ratio for neighbours and below 0 for others; each face once */
                if (a < b && a < c && real_dot(p, q) > 1 && real_dot(q, r) > 1 &&
                    real_dot(r, p) > 1 && volume > 0.1) {
                    memcpy(ball_faces[ball_raw.face_count++], face, sizeof face);
                }
            }
        }
    }
    for (int i = 0; i < cuts; i++) {
        ball_cut();
    }
}

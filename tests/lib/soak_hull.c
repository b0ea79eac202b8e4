/* SPDX-License-Identifier: MIT */
/* The hull of points, exactly: adds one point after the other. */
#include <string.h>

#include "soak_shapes.h"

/* Six times the volume over face a b c, positive on its outer side: differences below 2^16. */
static int64_t over(const int16_t (*p)[3], const uint16_t f[3], int q)
{
    int64_t u[3], v[3], w[3];

    for (int k = 0; k < 3; k++) {
        u[k] = p[f[1]][k] - p[f[0]][k];
        v[k] = p[f[2]][k] - p[f[0]][k];
        w[k] = p[q][k] - p[f[0]][k];
    }
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
           w[2] * (u[0] * v[1] - u[1] * v[0]);
}

/* The face to the left of the edge from one point to another: its number plus 1. */
static uint16_t left_of[SOAK_POINTS][SOAK_POINTS];

static void put_face(struct soak_shape *s, uint32_t at, int a, int b, int c)
{
    const uint16_t f[3] = {(uint16_t)a, (uint16_t)b, (uint16_t)c};

    memcpy(s->faces[at], f, sizeof f);
    for (int k = 0; k < 3; k++) {
        left_of[f[k]][f[(k + 1) % 3]] = (uint16_t)(at + 1);
    }
}

/* Remove the faces that a point sees, and connect their border with the point. */
static void add_point(struct soak_shape *s, int q)
{
    static bool seen[SOAK_FACES];
    static uint16_t border[SOAK_FACES][2];
    uint32_t free_at[SOAK_FACES], free_count = 0, border_count = 0;

    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        seen[f] = over((const int16_t(*)[3])s->vertices, s->faces[f], q) > 0;
        if (seen[f]) {
            free_at[free_count++] = f;
        }
    }
    for (uint32_t i = 0; i < free_count; i++) {
        const uint16_t *f = s->faces[free_at[i]];

        for (int k = 0; k < 3; k++) {
            uint16_t a = f[k], b = f[(k + 1) % 3];

            if (!seen[left_of[b][a] - 1]) {
                border[border_count][0] = a;
                border[border_count++][1] = b;
            }
        }
    }
    /* a border has at most two edges more than the number of faces that it encloses */
    for (uint32_t i = 0; i < border_count; i++) {
        uint32_t at = i < free_count ? free_at[i] : s->raw.face_count++;

        put_face(s, at, border[i][0], border[i][1], q);
    }
    for (uint32_t i = free_count; i > border_count; i--) {
        uint32_t last = --s->raw.face_count, hole = free_at[i - 1];

        if (hole != last) {
            put_face(s, hole, s->faces[last][0], s->faces[last][1], s->faces[last][2]);
        }
    }
}

/* Remove the points that belong to no face. */
static void drop_unused(struct soak_shape *s)
{
    uint16_t place[SOAK_POINTS];
    bool used[SOAK_POINTS] = {false};
    uint32_t kept = 0;

    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            used[s->faces[f][k]] = true;
        }
    }
    for (uint32_t v = 0; v < s->raw.vertex_count; v++) {
        place[v] = (uint16_t)kept;
        if (used[v]) {
            memmove(s->vertices[kept++], s->vertices[v], sizeof s->vertices[v]);
        }
    }
    s->raw.vertex_count = kept;
    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            s->faces[f][k] = place[s->faces[f][k]];
        }
    }
}

void soak_wrap(struct soak_shape *s)
{
    const uint16_t base[3] = {0, 1, 2};
    int64_t volume = over((const int16_t(*)[3])s->vertices, base, 3);
    int b = volume < 0 ? 1 : 2, c = volume < 0 ? 2 : 1;

    if (volume == 0) {
        return;
    }
    put_face(s, 0, 0, b, c);
    put_face(s, 1, 0, c, 3);
    put_face(s, 2, c, b, 3);
    put_face(s, 3, b, 0, 3);
    s->raw.face_count = 4;
    for (int q = 4; q < (int)s->raw.vertex_count; q++) {
        add_point(s, q);
    }
    drop_unused(s);
}

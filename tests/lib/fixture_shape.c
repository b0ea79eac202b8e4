/* SPDX-License-Identifier: MIT */
/* Meshes of the fixtures, face by face: planes, boxes, prisms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture_shape.h"

#define PRISM_CORNERS 128

void fixture_shape_begin(struct fixture_shape *s)
{
    s->vertex_count = s->face_count = 0;
    s->surface = false;
}

static void require(bool fits)
{
    if (!fits) {
        puts("Bail out! a shape is too large, or no simple polygon");
        exit(1);
    }
}

int fixture_shape_vertex(struct fixture_shape *s, double x, double y, double z)
{
    require(s->vertex_count < FIXTURE_VERTICES);
    s->p[s->vertex_count][0] = x;
    s->p[s->vertex_count][1] = y;
    s->p[s->vertex_count][2] = z;
    return (int)s->vertex_count++;
}

void fixture_shape_face(struct fixture_shape *s, int a, int b, int c)
{
    require(s->face_count < FIXTURE_FACES);
    s->faces[s->face_count][0] = (uint16_t)a;
    s->faces[s->face_count][1] = (uint16_t)b;
    s->faces[s->face_count][2] = (uint16_t)c;
    s->face_count++;
}

void fixture_shape_quad(struct fixture_shape *s, int a, int b, int c, int d)
{
    fixture_shape_face(s, a, b, c);
    fixture_shape_face(s, a, c, d);
}

void fixture_shape_plane(struct fixture_shape *s, int n, double side)
{
    fixture_shape_begin(s);
    s->surface = true;
    for (int v = 0; v < (n + 1) * (n + 1); v++) {
        fixture_shape_vertex(s, side * (v % (n + 1)) / n - side / 2,
                             side * (v / (n + 1)) / n - side / 2, 0);
    }
    for (int f = 0; f < n * n; f++) {
        int low = f / n * (n + 1) + f % n, high = low + n + 1;

        fixture_shape_quad(s, low, low + 1, high + 1, high);
    }
}

/* --------------------------------------------------------------------- prisms */

void fixture_shape_box(struct fixture_shape *s, double x, double y, double z)
{
    const double corner[4][2] = {
        {-x / 2, -z / 2}, {x / 2, -z / 2}, {x / 2, z / 2}, {-x / 2, z / 2}};

    fixture_shape_prism(s, corner, 4, -y / 2, y / 2);
}

/* Twice the area of a triangle over x, z; positive when it runs from x to z. */
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool is_ear(const double (*corner)[2], const int *ring, int n, int i)
{
    int a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];

    if (turn(corner[a], corner[b], corner[c]) <= 1e-12) {
        return false;
    }
    for (int j = 0; j < n; j++) {
        const double *p = corner[ring[j]];

        if (ring[j] != a && ring[j] != b && ring[j] != c && turn(corner[a], corner[b], p) >= 0 &&
            turn(corner[b], corner[c], p) >= 0 && turn(corner[c], corner[a], p) >= 0) {
            return false;
        }
    }
    return true;
}

/*
 * Cut both ends of a prism into triangles, ear by ear. Vertex i is at the lower end, n + i at the
 * upper one. Seen from -y, the outside of the lower end, corners run counter-clockwise from x to z.
 */
static void close_ends(struct fixture_shape *s, const double (*corner)[2], int n, int *ring)
{
    int left = n;

    while (left > 2) {
        int ear = 0;

        while (ear < left && !is_ear(corner, ring, left, ear)) {
            ear++;
        }
        require(ear < left);
        fixture_shape_face(s, ring[(ear + left - 1) % left], ring[ear], ring[(ear + 1) % left]);
        fixture_shape_face(s, n + ring[(ear + left - 1) % left], n + ring[(ear + 1) % left],
                           n + ring[ear]);
        for (int j = ear; j < left - 1; j++) {
            ring[j] = ring[j + 1];
        }
        left--;
    }
}

void fixture_shape_prism(struct fixture_shape *s, const double (*corner)[2], int n, double low,
                         double high)
{
    double area = 0;
    int ring[PRISM_CORNERS], order[PRISM_CORNERS];

    require(n <= PRISM_CORNERS);
    fixture_shape_begin(s);
    for (int i = 0; i < n; i++) {
        area += corner[i][0] * corner[(i + 1) % n][1] - corner[i][1] * corner[(i + 1) % n][0];
    }
    for (int i = 0; i < 2 * n; i++) {
        fixture_shape_vertex(s, corner[i % n][0], i < n ? low : high, corner[i % n][1]);
    }
    for (int i = 0; i < n; i++) {
        order[i] = ring[i] = area > 0 ? i : n - 1 - i;
    }
    close_ends(s, corner, n, ring);
    for (int i = 0; i < n; i++) {
        int a = order[i], b = order[(i + 1) % n];

        fixture_shape_quad(s, a, n + a, n + b, b);
    }
}

/* --------------------------------------------------------------- round, pointed */

void fixture_shape_torus(struct fixture_shape *s, double radius, double tube, int segments,
                         int sides)
{
    const double pi = acos(-1);

    fixture_shape_begin(s);
    for (int i = 0; i < segments; i++) {
        double around = 2 * pi * i / segments;

        for (int j = 0; j < sides; j++) {
            double in = 2 * pi * (j + 0.5) / sides, r = radius + tube * cos(in);

            fixture_shape_vertex(s, r * cos(around), r * sin(around), tube * sin(in));
        }
    }
    for (int i = 0; i < segments; i++) {
        int row = i * sides, next = (i + 1) % segments * sides;

        for (int j = 0; j < sides; j++) {
            int k = (j + 1) % sides;

            fixture_shape_quad(s, row + j, next + j, next + k, row + k);
        }
    }
}

static const double square[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

void fixture_shape_spike(struct fixture_shape *s, double half, double height)
{
    fixture_shape_begin(s);
    for (int i = 0; i < 4; i++) {
        /* counter-clockwise seen from the tip */
        const double *corner = square[height > 0 ? i : 3 - i];

        fixture_shape_vertex(s, half * corner[0], half * corner[1], 0);
    }
    fixture_shape_vertex(s, 0, 0, height);
    fixture_shape_quad(s, 3, 2, 1, 0);
    for (int i = 0; i < 4; i++) {
        fixture_shape_face(s, i, (i + 1) % 4, 4);
    }
}

void fixture_shape_hole(struct fixture_shape *s, double half, double thick, double mouth,
                        double deep)
{
    fixture_shape_begin(s);
    for (int i = 0; i < 12; i++) {
        double r = i < 8 ? half : mouth, z = i < 4 ? -thick : 0;

        fixture_shape_vertex(s, r * square[i % 4][0], r * square[i % 4][1], z);
    }
    fixture_shape_vertex(s, 0, 0, -deep);
    fixture_shape_quad(s, 3, 2, 1, 0);
    for (int i = 0; i < 4; i++) {
        int j = (i + 1) % 4;

        fixture_shape_quad(s, i, j, 4 + j, 4 + i);
        fixture_shape_quad(s, 4 + i, 4 + j, 8 + j, 8 + i);
        fixture_shape_face(s, 8 + i, 8 + j, 12);
    }
}

/*
 * The right half of the section, from the ridge down; returns the number of corners. Seen from the
 * origin, each side's foot lies beyond its lower corner by margin sin(its angle from above). Sides
 * after the first are `growth` times as long as that needs; when growth is 0, all take the same
 * step.
 */
static int spiral(double (*corner)[2], int most, double step, double margin, double growth)
{
    const double pi = acos(-1);
    double at = 0, r = 1;
    int n = 1;

    corner[0][0] = 0;
    corner[0][1] = 1;
    while (n < most) {
        double normal, beyond, foot;

        for (int i = 0; i < 40 && n > 1 && growth > 0; i++) {
            step = asin((1 + growth) * margin * sin(at + step) / r);
        }
        normal = at + step;
        foot = r * cos(step);
        beyond = margin * sin(normal);
        at = normal - atan2(beyond, foot);
        r = hypot(foot, beyond);
        if (growth > 0 ? normal >= pi - 0.06 : at >= pi - 0.05) {
            break;
        }
        corner[n][0] = r * sin(at);
        corner[n][1] = r * cos(at);
        n++;
    }
    return n;
}

void fixture_shape_monostable(struct fixture_shape *s, bool fine)
{
    double corner[PRISM_CORNERS][2];
    double slope = fine ? 2.5143 : 2.2, length = (fine ? 1.1655 : 1.2) * slope;
    int n = fine ? spiral(corner, 58, 0.27525, 0.1184, 1.0442) : spiral(corner, 28, 0.314, 0.18, 0);
    int half = n - 1;

    for (int i = 0; i < half; i++) {
        corner[n + i][0] = -corner[half - i][0];
        corner[n + i][1] = corner[half - i][1];
    }
    n += half;
    fixture_shape_prism(s, (const double(*)[2])corner, n, -1, 1);
    for (int v = 0; v < 2 * n; v++) {
        s->p[v][1] *= length - slope * s->p[v][2];
    }
}

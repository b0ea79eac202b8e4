/* SPDX-License-Identifier: MIT */
/*
 * accuracy_mass - volume, centre of mass and inertia of closed meshes against exact sums.
 *
 * The oracle fills a mesh with columns over z = 0: a face adds what lies between it and that plane,
 * and each moment is a polynomial over its shadow. (The engine adds tetrahedra.) Vertices are whole
 * quanta, so six times the volume, 24 times the first moments and 120 times the second are whole
 * numbers, summed in 128 bits; only the quotients are rounded, to 113 bits.
 *
 * The error of a mesh is the largest of
 *   volume   relative; of a mesh below 2^-10 cubic units, the least mass of a body, relative to that
 *   centre   the distance from the exact centre over the diagonal of the mesh's box
 *   inertia  the largest error of an entry over the largest entry; by mass, about the exact centre
 *
 * Centres are stored in q22, so the meshes are not much smaller than half a unit.
 */
#include <math.h>
#include <string.h>

#include "lib/accuracy.h"
#include "lib/lab.h"
#include "mesh/mass.h"

#define ROWS         24 /* rows of a surface of revolution */
#define VERTICES_MAX (ROWS * ROWS)
#define FACES_MAX    (2 * ROWS * ROWS)

__extension__ typedef __int128 whole;
typedef __float128 real;

/* -------------------------------------------------------------------- meshes */

struct mesh {
    double point[VERTICES_MAX][3];
    int16_t vertices[VERTICES_MAX][3];
    uint16_t faces[FACES_MAX][3];
    uint32_t vertex_count, face_count;
    int quantum_bits;
};

static uint64_t random_state = 5;

static double any(double low, double high)
{
    return lab_random(&random_state, low, high);
}

static int any_of(int count)
{
    return (int)any(0, count);
}

static void add_face(struct mesh *m, int a, int b, int c)
{
    uint16_t *face = m->faces[m->face_count++];

    face[0] = (uint16_t)a;
    face[1] = (uint16_t)b;
    face[2] = (uint16_t)c;
}

/*
 * A prism over an outline in x, y, from z = -1 to 1. Every corner of the outline must be visible
 * from its first corner. A box, a needle and a plate have outlines of 4 corners.
 */
static void prism(struct mesh *m, const double (*outline)[2], int corners)
{
    m->vertex_count = (uint32_t)(2 * corners);
    for (int i = 0; i < 2 * corners; i++) {
        m->point[i][0] = outline[i % corners][0];
        m->point[i][1] = outline[i % corners][1];
        m->point[i][2] = i < corners ? -1 : 1;
    }
    for (int i = 0; i < corners; i++) {
        int next = (i + 1) % corners;

        add_face(m, i, next, corners + next);
        add_face(m, i, corners + next, corners + i);
        if (i > 0 && i < corners - 1) {
            add_face(m, 0, i + 1, i);
            add_face(m, corners, corners + i, corners + i + 1);
        }
    }
}

static void box(struct mesh *m)
{
    static const double outline[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

    prism(m, outline, 4);
}

/* The inner corner comes first, because every other corner is visible from it. */
static void l_shape(struct mesh *m)
{
    double x = any(0.1, 1.9), y = any(0.1, 1.9);
    const double outline[6][2] = {{x, y}, {x, 2}, {0, 2}, {0, 0}, {2, 0}, {2, y}};

    prism(m, outline, 6);
}

static void tetrahedron(struct mesh *m)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            m->point[i][k] = any(-1, 1);
        }
    }
    m->vertex_count = 4;
    add_face(m, 0, 2, 1);
    add_face(m, 0, 1, 3);
    add_face(m, 1, 2, 3);
    add_face(m, 2, 0, 3);
}

/* A grid of rows and columns that closes in both directions; its normals point outwards. */
static void torus(struct mesh *m)
{
    int rows = 3 + any_of(ROWS - 3), columns = 3 + any_of(ROWS - 3);
    double thickness = any(0.05, 0.9);

    m->vertex_count = (uint32_t)(rows * columns);
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            double along = 2 * acos(-1) * i / rows, around = 2 * acos(-1) * j / columns;
            double *p = m->point[i * columns + j], r = 1 + thickness * cos(around);
            int i1 = (i + 1) % rows, j1 = (j + 1) % columns;

            p[0] = r * cos(along);
            p[1] = r * sin(along);
            p[2] = thickness * sin(around);
            add_face(m, i * columns + j, i1 * columns + j, i1 * columns + j1);
            add_face(m, i * columns + j, i1 * columns + j1, i * columns + j1);
        }
    }
}

/* Rings between two poles, with bumps of up to `rough` times the radius. */
static void ball(struct mesh *m, double rough)
{
    int rings = 3 + any_of(ROWS - 4), columns = 3 + any_of(ROWS - 3), south = rings * columns;

    m->vertex_count = (uint32_t)(south + 2);
    for (int v = 0; v < south + 2; v++) {
        double down = acos(-1) * (v / columns + 1) / (rings + 1),
               round = 2 * acos(-1) / columns * v;
        double r = 1 - any(0, rough);

        down = v == south ? acos(-1) : v > south ? 0 : down;
        m->point[v][0] = r * sin(down) * cos(round);
        m->point[v][1] = r * sin(down) * sin(round);
        m->point[v][2] = r * cos(down);
    }
    for (int j = 0; j < columns; j++) {
        int j1 = (j + 1) % columns, last = south - columns;

        add_face(m, south + 1, j, j1);
        add_face(m, south, last + j1, last + j);
        for (int v = 0; v < last; v += columns) {
            add_face(m, v + j, v + columns + j, v + columns + j1);
            add_face(m, v + j, v + columns + j1, v + j1);
        }
    }
}

/* Scale the mesh along its axes, turn it, and move it to any place in the range of quanta. */
static void place(struct mesh *m, const double scale[3], bool turned)
{
    carom_quat_q30 q = lab_random_turn(&random_state);
    double size, reach = 0, offset[3];

    for (uint32_t v = 0; v < m->vertex_count; v++) {
        double *p = m->point[v];

        for (int k = 0; k < 3; k++) {
            p[k] *= scale[k];
        }
        if (turned) {
            double from[3] = {p[0], p[1], p[2]};

            lab_rotate(p, &q, from);
        }
        for (int k = 0; k < 3; k++) {
            reach = fmax(reach, fabs(p[k]));
        }
    }
    /* half the extent in quanta, then a quantum that makes the half extent 1/4 to 60 units */
    size = exp2(any(7, 14.9));
    m->quantum_bits = (int)fmax(7, floor(log2(size)) + 2 - any_of(8));
    for (int k = 0; k < 3; k++) {
        offset[k] = any(-1, 1) * (32767 - size);
    }
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            m->vertices[v][k] = (int16_t)lrint(m->point[v][k] / reach * size + offset[k]);
        }
    }
}

/* Make a mesh of one of eight kinds. */
static void make(struct mesh *m, size_t kind)
{
    double scale[3] = {any(0.2, 1), any(0.2, 1), any(0.2, 1)};
    double thin = exp2(-any(2, 9));

    m->vertex_count = m->face_count = 0;
    switch (kind) {
    case 0:
        box(m);
        break;
    case 1:
        tetrahedron(m);
        break;
    case 2:
        l_shape(m);
        break;
    case 3:
        torus(m);
        break;
    case 4:
        ball(m, 0);
        break;
    case 5:
        ball(m, 0.5);
        break;
    case 6: /* a needle */
        box(m);
        scale[0] = thin * any(0.5, 1);
        scale[1] = thin;
        scale[2] = 1;
        break;
    default: /* a plate */
        box(m);
        scale[1] = thin;
        break;
    }
    place(m, scale, any(0, 1) < 0.7);
}

/* -------------------------------------------------------------------- oracle */

/* 6 V, 24 times the first moments, 120 times the second: xx, yy, zz, xy, yz, zx. */
struct moments {
    whole volume, first[3], second[6];
};

/*
 * The sum over all i, j, k of f_i g_j h_k, times 3!, 2! or 1! when three, two or none of i, j, k
 * are equal. That is 60 times the integral of f g h over a triangle, divided by its area.
 */
static whole product3(const whole f[3], const whole g[3], const whole h[3])
{
    whole sum = 0;

    for (int n = 0; n < 27; n++) {
        int i = n % 3, j = n / 3 % 3, k = n / 9;
        int weight = i == j && j == k ? 6 : i == j || j == k || k == i ? 2 : 1;

        sum += weight * f[i] * g[j] * h[k];
    }
    return sum;
}

/* The same for two functions: 12 times the integral, divided by the area. */
static whole product2(const whole f[3], const whole g[3])
{
    whole sum = 0;

    for (int n = 0; n < 9; n++) {
        sum += (n / 3 == n % 3 ? 2 : 1) * f[n / 3] * g[n % 3];
    }
    return sum;
}

/* Add the moments of the column between a face and z = 0. */
static void add_column(struct moments *sum, const struct mesh *m, const uint16_t face[3])
{
    whole x[3], y[3], z[3], area2;

    for (int i = 0; i < 3; i++) {
        x[i] = m->vertices[face[i]][0];
        y[i] = m->vertices[face[i]][1];
        z[i] = m->vertices[face[i]][2];
    }
    area2 = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    sum->volume += area2 * (z[0] + z[1] + z[2]);
    sum->first[0] += area2 * product2(x, z);
    sum->first[1] += area2 * product2(y, z);
    sum->second[0] += area2 * product3(x, x, z);
    sum->second[1] += area2 * product3(y, y, z);
    sum->second[3] += area2 * product3(x, y, z);
    /* the integral of z up to the face is z^2 / 2, that of z^2 is z^3 / 3; the quotients are formed
     * last */
    sum->first[2] += area2 * product2(z, z);
    sum->second[2] += area2 * product3(z, z, z);
    sum->second[4] += area2 * product3(y, z, z);
    sum->second[5] += area2 * product3(z, x, z);
}

static struct moments exact_moments(const struct mesh *m)
{
    struct moments sum = {0};

    for (uint32_t f = 0; f < m->face_count; f++) {
        add_column(&sum, m, m->faces[f]);
    }
    return sum;
}

/* Volume, centre, and inertia by mass, in quanta. */
struct exact {
    real volume, centre[3], inertia[6];
};

static struct exact exact_mass(const struct moments *sum)
{
    static const int divisor[6] = {1, 1, 3, 1, 2, 2};
    const real v = (real)sum->volume;
    struct exact e = {.volume = v / 6};
    real central[6];

    for (int k = 0; k < 3; k++) {
        e.centre[k] = (real)sum->first[k] / (v * (k == 2 ? 8 : 4));
    }
    for (int n = 0; n < 6; n++) {
        int i = n % 3, j = n < 3 ? i : (i + 1) % 3;

        central[n] = (real)sum->second[n] / (20 * divisor[n] * v) - e.centre[i] * e.centre[j];
    }
    for (int k = 0; k < 3; k++) {
        e.inertia[k] = central[(k + 1) % 3] + central[(k + 2) % 3];
        e.inertia[3 + k] = -central[3 + k];
    }
    return e;
}

/* --------------------------------------------------------------------- errors */

static double diagonal(const struct mesh *m)
{
    double square = 0;

    for (int k = 0; k < 3; k++) {
        int low = INT16_MAX, high = INT16_MIN;

        for (uint32_t v = 0; v < m->vertex_count; v++) {
            low = m->vertices[v][k] < low ? m->vertices[v][k] : low;
            high = m->vertices[v][k] > high ? m->vertices[v][k] : high;
        }
        square += (double)(high - low) * (high - low);
    }
    return sqrt(square);
}

static double size_of(real v)
{
    return fabs((double)v);
}

static double error(const struct mesh *m, const struct exact *e, const struct carom_mass *mass)
{
    const double quantum = exp2(-m->quantum_bits), cube = quantum * quantum * quantum;
    double volume, centre = 0, inertia = 0, largest = 0;

    volume = size_of((real)mass->volume_q32 * exp2(-32) - e->volume * cube) /
             fmax((double)e->volume * cube, exp2(-10));
    for (int k = 0; k < 3; k++) {
        double off = size_of((real)mass->centre.c[k] * exp2(-22) - e->centre[k] * quantum);

        centre += off * off;
    }
    for (int n = 0; n < 6; n++) {
        real wanted = e->inertia[n] * quantum * quantum;

        inertia =
            fmax(inertia, size_of((real)mass->inertia.m[n] * exp2(-mass->inertia.e) - wanted));
        largest = fmax(largest, size_of(wanted));
    }
    return fmax(volume, fmax(sqrt(centre) / (diagonal(m) * quantum), inertia / largest));
}

int main(int argc, char **argv)
{
    struct accuracy a = accuracy_begin("mass", accuracy_cases(argc, argv, 1000));
    static struct mesh m;

    for (size_t i = 0; i < a.wanted; i++) {
        struct carom_mass mass;
        struct moments sum;

        do { /* rounding to quanta may leave no volume, and a random tetrahedron has either
              * orientation */
            make(&m, i % 8);
            sum = exact_moments(&m);
        } while (sum.volume <= 0);
        struct carom_mesh_raw raw = {(const int16_t(*)[3])m.vertices,
                                     (const uint16_t(*)[3])m.faces,
                                     m.vertex_count,
                                     m.face_count,
                                     (uint8_t)m.quantum_bits,
                                     CAROM_SOLID};

        if (mass_of_mesh(&raw, &mass) == CAROM_OK) {
            struct exact e = exact_mass(&sum);

            accuracy_add(&a, error(&m, &e, &mass));
        } else {
            accuracy_fail(&a);
        }
    }
    accuracy_end(&a, &(struct accuracy_bar){.max = 1e-6});
    return accuracy_finish();
}

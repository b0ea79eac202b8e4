/* SPDX-License-Identifier: MIT */
/*
 * Threads. Rows wind up: column i of row m is at angle i of `segments` and lies i / segments of a
 * pitch above row m's place in column 0, so that column `segments` of row m is column 0 of row
 * m + 4. Column 0 has four rows more than the others, and each end has a step there.
 */
#include <math.h>

#include "fixture_shape.h"

static int at(const struct fixture_thread *t, int i, int m)
{
    if (i == t->segments) {
        return m + 4;
    }
    return i == 0 ? m : t->rows + 4 + (i - 1) * t->rows + m;
}

static void put(struct fixture_shape *s, const struct fixture_thread *t, int i, double r, double z)
{
    const double angle = 2 * acos(-1) * i / t->segments;

    fixture_shape_vertex(s, r * cos(angle), r * sin(angle), z + t->pitch * i / t->segments);
}

static void thread(struct fixture_shape *s, const struct fixture_thread *t, bool inside)
{
    fixture_shape_begin(s);
    for (int i = 0; i < t->segments; i++) {
        for (int m = 0; m < t->rows + (i == 0 ? 4 : 0); m++) {
            put(s, t, i, t->radius[m % 4], t->row[m % 4] + t->pitch * (m / 4));
        }
    }
    for (int i = 0; i < t->segments; i++) {
        for (int m = 0; m < t->rows - 1; m++) {
            int a = at(t, i, m), b = at(t, i + 1, m), c = at(t, i + 1, m + 1), d = at(t, i, m + 1);

            /* the diagonal has the same direction in both, because the surfaces lie on each
             * other */
            if (inside) {
                fixture_shape_quad(s, a, d, c, b);
            } else {
                fixture_shape_quad(s, a, b, c, d);
            }
        }
    }
}

void fixture_shape_bolt(struct fixture_shape *s, const struct fixture_thread *t)
{
    int low, high, last = t->rows - 1;

    thread(s, t, false);
    low = fixture_shape_vertex(s, 0, 0, t->pitch / 2);
    high = fixture_shape_vertex(s, 0, 0, t->row[last % 4] + t->pitch * (last / 4) + t->pitch / 2);
    for (int i = 0; i < t->segments; i++) {
        fixture_shape_face(s, low, at(t, i + 1, 0), at(t, i, 0));
        fixture_shape_face(s, high, at(t, i, last), at(t, i + 1, last));
    }
    for (int m = 0; m < 4; m++) {
        fixture_shape_face(s, low, m, m + 1);
        fixture_shape_face(s, high, last + m + 1, last + m);
    }
}

void fixture_shape_nut(struct fixture_shape *s, const struct fixture_thread *t, double outer)
{
    int n = t->segments, last = t->rows - 1, first;
    double low = t->row[0], high = t->row[last % 4] + t->pitch * (last / 4);

    thread(s, t, true);
    first = (int)s->vertex_count;
    for (int i = 0; i < n; i++) {
        put(s, t, i, outer, low);
        put(s, t, i, outer, high);
    }
    put(s, t, 0, outer, low + t->pitch);
    put(s, t, 0, outer, high + t->pitch);
    for (int i = 0; i < n; i++) {
        int a = first + 2 * i, b = first + 2 * (i + 1), d = a + 1, c = b + 1;

        /* the step's upper vertices follow the last column */
        fixture_shape_quad(s, b, a, at(t, i, 0), at(t, i + 1, 0));
        fixture_shape_quad(s, d, c, at(t, i + 1, last), at(t, i, last));
        if (i == 0) {
            fixture_shape_face(s, b, c, d);
            fixture_shape_face(s, b, d, first + 2 * n);
            fixture_shape_face(s, b, first + 2 * n, a);
        } else if (i == n - 1) {
            fixture_shape_face(s, a, b, first + 1);
            fixture_shape_face(s, a, first + 1, c);
            fixture_shape_face(s, a, c, d);
        } else {
            fixture_shape_quad(s, a, b, c, d);
        }
    }
    fixture_shape_face(s, first, first + 2 * n, 4);
    fixture_shape_face(s, first + 2 * n + 1, first + 1, last);
    for (int m = 0; m < 4; m++) {
        fixture_shape_face(s, first, m + 1, m);
        fixture_shape_face(s, first + 2 * n + 1, last + m, last + m + 1);
    }
}

/* SPDX-License-Identifier: MIT */
/* An oracle for statics: can contact forces within their friction cones hold the weights? */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "fixture_statics.h"

#define ROWS    (3 * STATICS_BODIES)
#define COLUMNS (2 * STATICS_CONTACTS)

/* Two columns for each contact: a unit of force along either edge of its cone. */
static struct {
    int rows, columns;
    double a[COLUMNS][ROWS];
    double b[ROWS], left[ROWS], x[COLUMNS], z[COLUMNS];
    double normal[COLUMNS][COLUMNS + 1];
    bool active[COLUMNS];
} q;

static void push(double *column, const struct statics *s, int body, double sign,
                 const double point[2], const double force[2])
{
    if (body < 0) {
        return;
    }
    column[3 * body] += sign * force[0];
    column[3 * body + 1] += sign * force[1];
    column[3 * body + 2] += sign * ((point[0] - s->middle[body][0]) * force[1] -
                                    (point[1] - s->middle[body][1]) * force[0]);
}

static void set_up(const struct statics *s, double mu)
{
    memset(&q, 0, sizeof q);
    q.rows = 3 * s->body_count;
    q.columns = 2 * s->contact_count;
    for (int j = 0; j < q.columns; j++) {
        const struct statics_contact *c = &s->contacts[j / 2];
        double edge = j % 2 ? mu : -mu;
        const double force[2] = {c->normal[0] - edge * c->normal[1],
                                 c->normal[1] + edge * c->normal[0]};

        push(q.a[j], s, c->a, 1, c->point, force);
        push(q.a[j], s, c->b, -1, c->point, force);
    }
    for (int i = 0; i < s->body_count; i++) {
        q.b[3 * i + 1] = s->weight[i];
    }
}

static double product(const double *a, const double *b)
{
    double sum = 0;

    for (int i = 0; i < q.rows; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* left = b - A x; returns its length. */
static double remain(void)
{
    memcpy(q.left, q.b, sizeof q.left);
    for (int j = 0; j < q.columns; j++) {
        for (int i = 0; i < q.rows && q.x[j] != 0; i++) {
            q.left[i] -= q.a[j][i] * q.x[j];
        }
    }
    return sqrt(product(q.left, q.left));
}

/* Least squares over the active columns by their normal equations, slightly damped. */
static void solve(void)
{
    int place[COLUMNS], n = 0;

    for (int j = 0; j < q.columns; j++) {
        q.z[j] = 0;
        if (q.active[j]) {
            place[n++] = j;
        }
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            q.normal[i][j] = product(q.a[place[i]], q.a[place[j]]) + (i == j ? 1e-10 : 0);
        }
        q.normal[i][n] = product(q.a[place[i]], q.b);
    }
    for (int k = 0; k < n; k++) {
        for (int i = k + 1; i < n; i++) {
            double part = q.normal[i][k] / q.normal[k][k];

            for (int j = k; j <= n; j++) {
                q.normal[i][j] -= part * q.normal[k][j];
            }
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        double sum = q.normal[k][n];

        for (int j = k + 1; j < n; j++) {
            sum -= q.normal[k][j] * q.z[place[j]];
        }
        q.z[place[k]] = sum / q.normal[k][k];
    }
}

/* Go from x towards z until a number would become negative; returns whether z was reached. */
static bool walk(void)
{
    double part = 1;

    for (int j = 0; j < q.columns; j++) {
        if (q.active[j] && q.z[j] <= 0) {
            part = fmin(part, q.x[j] / (q.x[j] - q.z[j]));
        }
    }
    for (int j = 0; j < q.columns; j++) {
        q.x[j] += part * (q.z[j] - q.x[j]);
        if (q.active[j] && part < 1 && q.x[j] <= 1e-14) {
            q.x[j] = 0;
            q.active[j] = false;
        }
    }
    return part >= 1;
}

/* The method of Lawson and Hanson. */
double statics_rest(const struct statics *s, double mu)
{
    double weight = 0, rest;

    set_up(s, mu);
    for (int i = 0; i < s->body_count; i++) {
        weight += s->weight[i];
    }
    rest = remain();
    for (int round = 0; round < 3 * q.columns && rest > 1e-7 * weight; round++) {
        double steepest = 1e-13 * weight;
        int enter = -1;

        for (int j = 0; j < q.columns; j++) {
            double slope = product(q.a[j], q.left);

            if (!q.active[j] && slope > steepest) {
                steepest = slope;
                enter = j;
            }
        }
        if (enter < 0) {
            break;
        }
        q.active[enter] = true;
        do {
            solve();
        } while (!walk());
        rest = remain();
    }
    return rest / weight;
}

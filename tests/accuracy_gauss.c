/* SPDX-License-Identifier: MIT */
/*
 * accuracy_gauss - gauss_solve alone, against elimination with complete pivoting of the same
 * integers in long double. Rows of out/accuracy.csv: solve9 and solve15, the error relative to the
 * largest unknown.
 *
 * Three systems in four come from random impacts: the rows are those that impact_solve makes, the
 * right sides are random and keep the largest unknown at about 1. The fourth system has random
 * entries of 30 bits. A system that is so close to singular that gauss_solve refuses it counts as a
 * failure.
 */
#include "lib/accuracy.h"
#include "lib/gauss_rows.h"

#include "lib/impact_real.h"

static struct gauss workspace;
static int32_t rows[GAUSS_MAX][GAUSS_MAX + 1];

static void exchange(scalar *a, scalar *b)
{
    scalar t = *a;

    *a = *b;
    *b = t;
}

/* Solve rows for their right sides. */
static void eliminate(int n, scalar x[GAUSS_MAX])
{
    static scalar a[GAUSS_MAX][GAUSS_MAX + 1];
    int column[GAUSS_MAX];

    for (int i = 0; i < n; i++) {
        column[i] = i;
        for (int j = 0; j <= n; j++) {
            a[i][j] = rows[i][j];
        }
    }
    for (int k = 0; k < n; k++) {
        int p = k, q = k, c;

        for (int i = k; i < n; i++) {
            for (int j = k; j < n; j++) {
                if (magnitude(a[i][j]) > magnitude(a[p][q])) {
                    p = i;
                    q = j;
                }
            }
        }
        for (int j = 0; j <= n; j++) {
            exchange(&a[k][j], &a[p][j]);
        }
        for (int i = 0; i < n; i++) {
            exchange(&a[i][k], &a[i][q]);
        }
        c = column[k];
        column[k] = column[q];
        column[q] = c;
        for (int i = k + 1; i < n; i++) {
            scalar f = a[i][k] / a[k][k];

            for (int j = k; j <= n; j++) {
                a[i][j] -= f * a[k][j];
            }
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        scalar sum = a[k][n];

        for (int j = k + 1; j < n; j++) {
            sum -= a[k][j] * x[column[j]];
        }
        x[column[k]] = sum / a[k][k];
    }
}

static scalar largest(const scalar *x, int n)
{
    scalar most = 0;

    for (int j = 0; j < n; j++) {
        most = magnitude(x[j]) > most ? magnitude(x[j]) : most;
    }
    return most;
}

/* Random right sides, halved until the largest unknown is at most 1. */
static void set_right_sides(uint64_t *random, int n)
{
    scalar x[GAUSS_MAX];

    for (int i = 0; i < n; i++) {
        rows[i][n] = (int32_t)rounded(real_uniform(random, -1, 1), 30);
    }
    eliminate(n, x);
    for (scalar most = largest(x, n); most > 1; most /= 2) {
        for (int i = 0; i < n; i++) {
            rows[i][n] /= 2;
        }
    }
}

/* The system of a random impact. */
static bool impact_rows(uint64_t *random, int n)
{
    struct real_impact real;
    struct impact in;

    real_random_impact(random, n == 9 ? 1 : 2, 7, &real);
    in = real_to_engine(&real, 30);
    return gauss_rows_of(&workspace, &in, rows) == CAROM_OK;
}

static void dense_rows(uint64_t *random, int n)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            rows[i][j] = (int32_t)rounded(real_uniform(random, -1, 1), 30);
        }
    }
}

static void solve(const char *kernel, int n, size_t cases)
{
    struct accuracy a = accuracy_begin(kernel, cases);
    uint64_t random = (uint64_t)n;

    for (size_t i = 0; i < a.wanted; i++) {
        scalar x[GAUSS_MAX], error[GAUSS_MAX];

        if (i % 4 == 3) {
            dense_rows(&random, n);
        } else if (!impact_rows(&random, n)) {
            accuracy_fail(&a);
            continue;
        }
        set_right_sides(&random, n);
        eliminate(n, x);
        memcpy(workspace.a, rows, sizeof rows);
        if (gauss_rows_solve(&workspace, n)) {
            accuracy_fail(&a);
            continue;
        }
        for (int j = 0; j < n; j++) {
            error[j] = fixed(workspace.x_q40[j], 40) - x[j];
        }
        accuracy_add(&a, (double)(largest(error, n) / largest(x, n)));
    }
    accuracy_end(&a, &(struct accuracy_bar){.p9999 = 1e-9});
}

int main(int argc, char **argv)
{
    size_t cases = accuracy_cases(argc, argv, 200000);

    solve("solve9", 9, cases);
    solve("solve15", 15, cases);
    return accuracy_finish();
}

/* SPDX-License-Identifier: MIT */
/* Gauss-Jordan elimination against Cramer's rule and double precision. */
#include "lib/gauss_rows.h"
#include "lib/test.h"

#ifdef TEST_LONG
enum { EXACT_CASES = 20000, DOUBLE_CASES = 20000, WILD_CASES = 60000, ALIKE_CASES = 4000 };
#else
enum { EXACT_CASES = 20, DOUBLE_CASES = 3, WILD_CASES = 30, ALIKE_CASES = 200 };
#endif

static struct gauss w;
static int32_t system_in[GAUSS_MAX][GAUSS_MAX + 1];

static int solve(int n)
{
    memcpy(w.a, system_in, sizeof w.a);
    return gauss_rows_solve(&w, n);
}

static int64_t whole_q40(int64_t x)
{
    return x * ((int64_t)1 << 40);
}

/* The right-hand side for a solution in whole numbers: b = A x, exact. */
static void set_right_side(int n, const int32_t *x)
{
    for (int i = 0; i < n; i++) {
        int64_t b = 0;

        for (int j = 0; j < n; j++) {
            b += (int64_t)system_in[i][j] * x[j];
        }
        system_in[i][n] = (int32_t)b;
    }
}

static void check_whole(int n, const int32_t *x)
{
    CHECK_EQ(solve(n), 0);
    for (int j = 0; j < n; j++) {
        CHECK_NEAR(w.x_q40[j], whole_q40(x[j]), 64); /* units of 2^-40 */
    }
}

static void hand_cases(void)
{
    static const int32_t rows[3][4] = {{2, 1, -1, 8}, {-3, -1, 2, -11}, {-2, 1, 2, -3}};

    memset(system_in, 0, sizeof system_in);
    for (int i = 0; i < 3; i++) {
        memcpy(system_in[i], rows[i], sizeof rows[i]);
    }
    CHECK_EQ(solve(3), 0);
    CHECK_NEAR(w.x_q40[0], whole_q40(2), 16);
    CHECK_NEAR(w.x_q40[1], whole_q40(3), 16);
    CHECK_NEAR(w.x_q40[2], whole_q40(-1), 16);

    /* 3 x = 1: a third is 0x5555555555.5 in q40. */
    memset(system_in, 0, sizeof system_in);
    system_in[0][0] = 3;
    system_in[0][1] = 1;
    CHECK_EQ(solve(1), 0);
    CHECK_NEAR(w.x_q40[0], 0x5555555555, 1);

    /* 2^58 = (2^29 - 1) (2^29 + 1) + 1: the first solution is off by 2^-87, which x_q40 does not have. */
    system_in[0][0] = (1 << 29) + 1;
    CHECK_EQ(solve(1), 0);
    CHECK_EQ(w.x_q40[0], 1 << 11);

    /* A right-hand side of zero. */
    system_in[0][1] = 0;
    CHECK_EQ(solve(1), 0);
    CHECK_EQ(w.x_q40[0], 0);
}

/* The diagonals are permuted away: every step must search for its pivot. */
static void permuted_rows(void)
{
    static const int sizes[3] = {3, 9, 15};

    for (int s = 0; s < 3; s++) {
        int n = sizes[s];
        int32_t x[GAUSS_MAX];

        memset(system_in, 0, sizeof system_in);
        for (int j = 0; j < n; j++) {
            x[j] = j - 4;
            system_in[(j + 1) % n][j] = 5 + j;
            system_in[(j + 2) % n][j] = 1;
        }
        set_right_side(n, x);
        check_whole(n, x);
    }
}

/* Rows of very different sizes, up to the full range. */
static void row_scale(void)
{
    struct test_random r = {3};
    static const int32_t x[9] = {1, -2, 3, 0, 5, -1, 2, 7, -3};

    memset(system_in, 0, sizeof system_in);
    for (int i = 0; i < 9; i++) {
        for (int j = 0; j < 9; j++) {
            system_in[i][j] = (int32_t)test_random_range(&r, -1000, 1000);
        }
    }
    set_right_side(9, x);
    for (int i = 0; i < 9; i++) {
        for (int j = 0; j <= 9; j++) {
            system_in[i][j] *= (int32_t)1 << (2 * i);
        }
    }
    check_whole(9, x);
    /* Entries of 2^30 itself. */
    memset(system_in, 0, sizeof system_in);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            system_in[i][j] = i == j ? -(1 << 30) : 1 << 30;
        }
        system_in[i][3] = 1 << 30; /* x = y = z = 1 */
    }
    CHECK_EQ(solve(3), 0);
    for (int j = 0; j < 3; j++) {
        CHECK_NEAR(w.x_q40[j], whole_q40(1), 4);
    }
}

static void whole_solutions(void)
{
    static const int sizes[3] = {3, 9, 15};
    struct test_random r = {1};

    for (int s = 0; s < 3; s++) {
        int n = sizes[s];

        for (int c = 0; c < EXACT_CASES; c++) {
            int32_t x[GAUSS_MAX];

            memset(system_in, 0, sizeof system_in);
            for (int i = 0; i < n; i++) {
                x[i] = (int32_t)test_random_range(&r, -50, 50);
                for (int j = 0; j < n; j++) {
                    /* sparse like the impact equations, with large diagonals: not singular */
                    bool zero = test_random_range(&r, 0, 1) == 0;

                    system_in[i][j] = zero ? 0 : (int32_t)test_random_range(&r, -1000, 1000);
                }
                system_in[i][i] += system_in[i][i] < 0 ? -7000 : 7000;
            }
            set_right_side(n, x);
            check_whole(n, x);
        }
    }
}

static int64_t det2(int32_t a[3][3], int i, int j, int k, int l)
{
    return (int64_t)a[i][k] * a[j][l] - (int64_t)a[i][l] * a[j][k];
}

static int64_t det3(int32_t a[3][3])
{
    return a[0][0] * det2(a, 1, 2, 1, 2) - a[0][1] * det2(a, 1, 2, 0, 2) +
           a[0][2] * det2(a, 1, 2, 0, 1);
}

/* floor(n 2^40 / d) by long division; |n| < 2^60. */
static int64_t quotient_q40(int64_t n, int64_t d)
{
    bool negative = (n < 0) != (d < 0);
    uint64_t un = (uint64_t)(n < 0 ? -n : n), ud = (uint64_t)(d < 0 ? -d : d);
    uint64_t q = un / ud, rest = un % ud;

    for (int bit = 0; bit < 40; bit++) {
        rest <<= 1;
        q = q << 1 | (rest >= ud);
        rest -= rest >= ud ? ud : 0;
    }
    return negative ? -(int64_t)q : (int64_t)q;
}

/* n = 3 against Cramer's rule in exact integers, including nearly singular systems. */
static void cramer(void)
{
    struct test_random r = {2};

    for (int c = 0; c < EXACT_CASES; c++) {
        int32_t a[3][3], b[3];
        int64_t x[3], det, largest = 0;

        memset(system_in, 0, sizeof system_in);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                a[i][j] = (int32_t)test_random_range(&r, -30000, 30000);
            }
            b[i] = (int32_t)test_random_range(&r, -30000, 30000);
        }
        if (c % 4 == 0) { /* the last row a few units off the sum of the others */
            for (int j = 0; j < 3; j++) {
                a[2][j] = a[0][j] + a[1][j] + (int32_t)test_random_range(&r, -9, 9);
            }
        }
        for (int i = 0; i < 3; i++) {
            memcpy(system_in[i], a[i], sizeof a[i]);
            system_in[i][3] = b[i];
        }
        det = det3(a);
        if (carom_abs(det) < 50000000) {
            continue;
        }
        for (int j = 0; j < 3; j++) {
            int32_t m[3][3];

            memcpy(m, a, sizeof m);
            for (int i = 0; i < 3; i++) {
                m[i][j] = b[i];
            }
            x[j] = quotient_q40(det3(m), det);
            largest = carom_abs(x[j]) > largest ? carom_abs(x[j]) : largest;
        }
        CHECK_EQ(solve(3), 0);
        for (int j = 0; j < 3; j++) {
            CHECK_NEAR(w.x_q40[j], x[j], largest / 1000000000 + 2);
        }
    }
}

static double magnitude(double v)
{
    return v < 0 ? -v : v;
}

/* Elimination with complete pivoting and back substitution, in double. */
static void oracle(int n, double *x)
{
    static double a[GAUSS_MAX][GAUSS_MAX + 1];
    int column[GAUSS_MAX];

    for (int i = 0; i < n; i++) {
        column[i] = i;
        for (int j = 0; j <= n; j++) {
            a[i][j] = system_in[i][j];
        }
    }
    for (int k = 0; k < n; k++) {
        int p = k, q = k;

        for (int i = k; i < n; i++) {
            for (int j = k; j < n; j++) {
                if (magnitude(a[i][j]) > magnitude(a[p][q])) {
                    p = i;
                    q = j;
                }
            }
        }
        for (int j = 0; j <= n; j++) {
            double t = a[k][j];

            a[k][j] = a[p][j];
            a[p][j] = t;
        }
        for (int i = 0; i < n; i++) {
            double t = a[i][k];

            a[i][k] = a[i][q];
            a[i][q] = t;
        }
        p = column[k];
        column[k] = column[q];
        column[q] = p;
        for (int i = k + 1; i < n; i++) {
            double f = a[i][k] / a[k][k];

            for (int j = k; j <= n; j++) {
                a[i][j] -= f * a[k][j];
            }
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        double sum = a[k][n];

        for (int j = k + 1; j < n; j++) {
            sum -= a[k][j] * x[column[j]];
        }
        x[column[k]] = sum / a[k][k];
    }
}

/*
 * Full 30-bit entries, and rows of random scale. A condition of 10^5 would still leave double
 * 1e-11.
 */
static void against_double(void)
{
    static const int sizes[3] = {3, 9, 15};
    struct test_random r = {4};

    for (int s = 0; s < 3; s++) {
        int n = sizes[s];
        unsigned inexact = 0, refused = 0;

        for (int c = 0; c < DOUBLE_CASES; c++) {
            double x[GAUSS_MAX], largest = 0, error = 0;

            for (int i = 0; i < n; i++) {
                int64_t limit = (int64_t)1 << test_random_range(&r, 20, 30);

                for (int j = 0; j <= n; j++) {
                    system_in[i][j] = (int32_t)test_random_range(&r, -limit, limit);
                }
            }
            oracle(n, x);
            if (solve(n)) {
                refused++;
                continue;
            }
            for (int j = 0; j < n; j++) {
                double d = magnitude((double)w.x_q40[j] / 0x1p40 - x[j]);

                error = d > error ? d : error;
                largest = magnitude(x[j]) > largest ? magnitude(x[j]) : largest;
            }
            inexact += error > 1e-9 * largest + 0x1p-40;
        }
        CHECK_EQ(refused, 0);
        CHECK_AT_MOST(inexact, DOUBLE_CASES / 10000);
    }
}

static void singular(void)
{
    struct test_random r = {5};
    static const int sizes[3] = {3, 9, 15};

    for (int s = 0; s < 3; s++) {
        int n = sizes[s];

        for (int way = 0; way < 4; way++) {
            int odd = n / 2;

            for (int i = 0; i < n; i++) {
                for (int j = 0; j <= n; j++) {
                    system_in[i][j] = (int32_t)test_random_range(&r, -100000, 100000);
                }
            }
            for (int j = 0; j < n; j++) {
                int32_t *entry = &system_in[odd][j];

                if (way == 0) {
                    *entry = 0;
                } else if (way == 1) {
                    system_in[j][odd] = 0;
                } else if (way == 2) {
                    *entry = -3 * system_in[0][j];
                } else {
                    *entry = system_in[0][j] + 2 * system_in[n - 1][j];
                }
            }
            CHECK_EQ(solve(n), -1);
        }
    }
    memset(system_in, 0, sizeof system_in);
    CHECK_EQ(solve(9), -1);
}

static void range(void)
{
    memset(system_in, 0, sizeof system_in);
    system_in[0][0] = 1 << 10;
    system_in[0][1] = 1 << 29;
    CHECK_EQ(solve(1), 0);
    CHECK_EQ(w.x_q40[0], whole_q40(1 << 19));
    system_in[0][0] = 1 << 8;
    system_in[0][1] = -(1 << 29);
    CHECK_EQ(solve(1), -1); /* -2^21 */
}

/* Solve for another right-hand side of the same rows, added to the first. */
static void add(void)
{
    static const int32_t x[3] = {3, -4, 1};
    static const int64_t more[3] = {5, 7, -2};
    int64_t b_q10[3];

    memset(system_in, 0, sizeof system_in);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            system_in[i][j] = i == j ? 40 : 3 * i - 5 * j;
        }
    }
    set_right_side(3, x);
    check_whole(3, x);
    for (int i = 0; i < 3; i++) {
        b_q10[i] = 0;
        for (int j = 0; j < 3; j++) {
            b_q10[i] += 1024 * system_in[i][j] * more[j];
        }
    }
    CHECK_EQ(gauss_add(&w, 3, b_q10), 0);
    for (int j = 0; j < 3; j++) {
        /* one pass without refinement: right to the 24 bits of a first solution */
        CHECK_NEAR(w.x_q40[j], whole_q40(x[j] + more[j]), 1 << 16);
    }
    memset(b_q10, 0, sizeof b_q10);
    CHECK_EQ(gauss_add(&w, 3, b_q10), 0);
    b_q10[1] = (int64_t)1 << 40;
    CHECK_EQ(gauss_add(&w, 3, b_q10), -1);
}

/* What a row lacks of its right side, against the largest term in it. */
static void check_row(int n, int row)
{
    double lacks = -(double)system_in[row][n], most = 0;

    for (int j = 0; j < n; j++) {
        const double term = (double)system_in[row][j] * ((double)w.x_q40[j] / ((int64_t)1 << 40));

        lacks += term;
        most = term > most ? term : -term > most ? -term : most;
    }
    /* one entry in the last place of each unknown besides: 2^30 * 2^-40 */
    CHECK_LESS(lacks < 0 ? -lacks : lacks, most / (1 << 12) + n / 512.0 + 1);
}

/*
 * Rows that differ by a few units in 2^29, with small entries in the first column, so that little is left after its elimination:
 * either no solution is found, or the right one.
 */
static void nearly_alike(void)
{
    struct test_random r = {3};
    int solved = 0, refused = 0;

    for (int i = 0; i < ALIKE_CASES; i++) {
        int n = 2 + i % 3, result;
        int32_t x[GAUSS_MAX];

        memset(system_in, 0, sizeof system_in);
        for (int j = 0; j < n; j++) {
            int32_t entry = j == 0 ? (int32_t)test_random_range(&r, 60, 2000)
                                   : (int32_t)test_random_range(&r, 1 << 27, 1 << 28);

            x[j] = (int32_t)test_random_range(&r, -2, 2);
            for (int k = 0; k < n; k++) {
                system_in[k][j] = entry + (int32_t)test_random_range(&r, 0, i % 40);
            }
        }
        set_right_side(n, x);
        result = solve(n);
        solved += result == 0;
        refused += result != 0;
        for (int j = 0; j < n && result == 0; j++) {
            CHECK_NEAR(w.x_q40[j], whole_q40(x[j]), 1 << 20);
        }
    }
    CHECK_MORE(solved, 0);
    CHECK_MORE(refused, 0);
}

/* Entries of any size, so that many a system is hopeless: it is refused, or its answer fits the rows. */
static void wild(void)
{
    struct test_random r = {17};
    int64_t b_q10[GAUSS_MAX];
    int solved = 0, refused = 0, added = 0;

    for (int n = 0; n < WILD_CASES; n++) {
        const int size = n % 3 == 0 ? 3 : n % 3 == 1 ? 9 : 15, least = n / 3 % 30;

        for (int i = 0; i < size; i++) {
            for (int j = 0; j <= size; j++) {
                const int64_t most = (int64_t)1 << test_random_range(&r, least, 29);

                system_in[i][j] = (int32_t)test_random_range(&r, -most, most);
            }
            b_q10[i] = test_random_range(&r, -((int64_t)1 << (n % 32)), (int64_t)1 << (n % 32));
        }
        if (solve(size) != 0) {
            refused++;
            continue;
        }
        solved++;
        for (int i = 0; i < size; i++) {
            check_row(size, i);
        }
        added += gauss_add(&w, size, b_q10) == 0;
    }
    CHECK_MORE(solved, WILD_CASES / 4);
    CHECK_MORE(added, WILD_CASES / 8);
    CHECK_AT_LEAST(refused, WILD_CASES / 50000); /* 30 cases may have none */
}

const struct test tests_num_gauss[] = {{"num_gauss/hand_cases", hand_cases},
                                       {"num_gauss/permuted_rows", permuted_rows},
                                       {"num_gauss/row_scale", row_scale},
                                       {"num_gauss/whole_solutions", whole_solutions},
                                       {"num_gauss/cramer", cramer},
                                       {"num_gauss/against_double", against_double},
                                       {"num_gauss/singular", singular},
                                       {"num_gauss/range", range},
                                       {"num_gauss/add", add},
                                       {"num_gauss/nearly_alike", nearly_alike},
                                       {"num_gauss/wild", wild},
                                       {0}};

/* SPDX-License-Identifier: MIT */
/*
 * The cost of gauss_solve with refinement, in instructions of a Cortex-M3 that counts them, over
 * the systems of random impacts. Other boards check the solutions only.
 */
#include "lib/gauss_rows.h"
#include "lib/impact_real.h"
#include "port.h"
#include "lib/test.h"

enum { CASES = 400, WORST_9 = 23000, WORST_15 = 56000 };

static struct gauss w;
static int32_t rows[GAUSS_MAX][GAUSS_MAX + 1];

/* The system of a random impact. The rows that have a right side get random ones. */
static void draw(uint64_t *random, int n)
{
    struct real_impact real;
    struct impact in;

    real_random_impact(random, n == 9 ? 1 : 2, 7, &real);
    in = real_to_engine(&real, 30);
    CHECK_EQ(gauss_rows_of(&w, &in, rows), CAROM_OK);
    for (int i = 0; i < n; i++) {
        rows[i][n] = i < n - 3 ? 0 : (int32_t)rounded(real_uniform(random, -1, 1), 26);
    }
}

static uint32_t cost(int n)
{
    uint32_t start, ticks;

    memcpy(w.a, rows, sizeof rows);
    start = port_ticks();
    CHECK_EQ(gauss_rows_solve(&w, n), 0);
    ticks = port_ticks() - start;
    return port_instructions(ticks);
}

static void worst(int n, uint32_t bar)
{
    uint64_t random = (uint64_t)n;
    uint32_t most = 0, sum = 0;

    for (int c = 0; c < CASES; c++) {
        uint32_t spent;

        draw(&random, n);
        spent = cost(n);
        sum += spent;
        most = spent > most ? spent : most;
    }
    if (most > 0) {
        port_print("# elimination of %d unknowns: %lu instructions on average, %lu at most\n", n,
                   (unsigned long)(sum / CASES), (unsigned long)most);
    }
    CHECK_BAR(most, bar);
}

static void nine(void)
{
    worst(9, WORST_9);
}

static void fifteen(void)
{
    worst(15, WORST_15);
}

const struct test tests_num_gauss_cost[] = {
    {"num_gauss_cost/nine", nine}, {"num_gauss_cost/fifteen", fifteen}, {0}};

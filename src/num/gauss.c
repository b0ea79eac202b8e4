/* SPDX-License-Identifier: MIT */
/* Gauss-Jordan elimination with iterative refinement, in 32-bit rows. */
#include "gauss.h"

/*
 * Bounds. Entries of rows stay within FULL = 2^30. An elimination forms pivot r + f s from two such
 * entries, with |pivot|, |f| <= 2^31: at most 2^62, and its upper word, the new entry, is at most
 * 2^30 again. So a step cannot overflow. It can only leave a row small, and normalising repairs
 * that.
 */
#define FULL           ((int32_t)1 << 30)
#define NORMAL         ((int32_t)1 << 29) /* a normalised row's largest entry is at least this */
#define SMALLEST_PIVOT ((int32_t)1 << 6)  /* of a normalised row; below, it is rounding noise */
#define DIGITS_BITS    29
#define ROUNDS_MAX     5
#define RESIDUAL_BITS  61

/* |v|, or |v| - 1 for a negative v: exact enough to count bits, and without a branch. */
static uint32_t magnitude(int32_t v)
{
    return (uint32_t)(v ^ (v >> 31));
}

/* The number of bits by which v > 0 can be shifted up until it reaches `full`, a power of two. */
static int headroom(uint32_t v, uint32_t full)
{
    int z = 0;

    /* mostly 0 to 3 turns: faster than a general count of bits */
    while (v < full) {
        v <<= 1;
        z++;
    }
    return z;
}

/* Shift every row up until it is normal; its right-hand side follows in 64 bits. */
static int normalise_rows(struct gauss *g, int n)
{
    for (int i = 0; i < n; i++) {
        uint32_t largest = 0;
        int z;

        for (int j = 0; j < n; j++) {
            largest |= (uint32_t)carom_abs(g->a[i][j]);
        }
        if (largest == 0) {
            return -1;
        }
        z = headroom(largest, NORMAL);
        g->up[i] = (uint8_t)z;
        CAROM_ASSERT(largest < 2 * (uint32_t)FULL && z <= 29);
        for (int j = 0; j < n; j++) {
            g->a[i][j] = (int32_t)carom_shl(g->a[i][j], z);
        }
        g->residual[i] = carom_shl(g->a[i][n], z); /* <= 2^59 */
    }
    return 0;
}

/* The unused row with the largest entry in column k; -1 if all are noise. */
static int choose_pivot(const struct gauss *g, int n, int k)
{
    uint32_t largest = SMALLEST_PIVOT - 1;
    int best = -1;

    for (int i = 0; i < n; i++) {
        uint32_t entry = magnitude(g->a[i][k]);

        if (g->step[i] < 0 && entry > largest) {
            largest = entry;
            best = i;
        }
    }
    return best;
}

/* row = (scale row + factor other) / 2^32 in columns from .. n - 1; returns the bits used. */
static uint32_t combine(int32_t *row, const int32_t *other, int32_t scale, int32_t factor, int from,
                        int n)
{
    uint32_t used = 0;

    for (int j = from; j < n; j++) {
        int64_t t = ((int64_t)1 << 31) + (int64_t)scale * row[j] + (int64_t)factor * other[j];

        row[j] = (int32_t)(t >> 32);
        used |= magnitude(row[j]);
    }
    return used;
}

/*
 * Eliminate column k from row i. The entry a_ik is not cleared: nobody reads it as a coefficient
 * any more, and later right-hand sides need it as the multiplier.
 */
FIX_APART static void eliminate(struct gauss *g, int n, int k, int i)
{
    int32_t *row = g->a[i];
    int32_t pivot = g->pivot[k], f = -row[k];
    int own =
        g->step[i]; /* the row's own column, if it has been the pivot: its diagonal scales along */
    int z = headroom(magnitude(pivot) | magnitude(f), (uint32_t)FULL);
    int up = 0;
    uint32_t used;

    pivot = (int32_t)carom_shl(pivot, z);
    f = (int32_t)carom_shl(f, z);
    used = combine(row, g->a[g->row[k]], pivot, f, k + 1, n);
    if (own >= 0) {
        row[own] = (int32_t)carom_round((int64_t)pivot * row[own], 32);
        used |= magnitude(row[own]);
    }
    if (used > 0 && used < (uint32_t)NORMAL) {
        up = headroom(used, NORMAL);
        if (up > 31 - z) {
            up = 31 - z; /* keeps the shift positive; only a hopeless system gets here */
        }
        for (int j = k + 1; j < n; j++) {
            row[j] = (int32_t)carom_shl(row[j], up);
        }
        if (own >= 0) {
            row[own] = (int32_t)carom_shl(row[own], up);
        }
    }
    g->shift[i][k] = (uint8_t)(32 - z - up);
}

/* Reduce the rows to a diagonal, column by column, keeping the multipliers. */
static int factor(struct gauss *g, int n)
{
    for (int i = 0; i < n; i++) {
        g->step[i] = -1;
    }
    for (int k = 0; k < n; k++) {
        int p = choose_pivot(g, n, k);

        if (p < 0) {
            return -1;
        }
        g->row[k] = (uint8_t)p;
        g->pivot[k] = g->a[p][k];
        for (int i = 0; i < n; i++) {
            if (i != p && g->a[i][k] != 0) {
                eliminate(g, n, k, i);
            }
        }
        g->step[p] = (int8_t)k;
    }
    return 0;
}

/* Invert the diagonal: one division a row, however many right-hand sides follow. */
static int invert_diagonal(struct gauss *g, int n)
{
    for (int k = 0; k < n; k++) {
        int32_t *d = &g->a[g->row[k]][k];
        int z;

        if (*d == 0) {
            return -1;
        }
        z = headroom((uint32_t)carom_abs(*d), NORMAL);
        /* 2^59 over at least 2^29: at most 2^30 */
        *d = (int32_t)(((int64_t)1 << 59) / carom_shl(*d, z));
        g->inverse_shift[k] = (uint8_t)z;
    }
    return 0;
}

/* Largest number of bits among the magnitudes of v[0..n-1]. */
static int block_bits(const int64_t *v, int n)
{
    uint64_t used = 0;

    for (int i = 0; i < n; i++) {
        used |= (uint64_t)(v[i] ^ (v[i] >> 63)); /* |v|, less 1 for negative v */
    }
    return fix_bits(used);
}

/* v / 2^s to nearest, or v 2^-s for negative s. */
static int64_t scale_down(int64_t v, int s)
{
    return s > 0 ? carom_round(v, s) : carom_shl(v, -s);
}

/*
 * Carry g->y through a step. |y| <= 2^30 before it, so products are within 2^61. If it lets y grow
 * past that all of y is scaled down. Returns by how many bits.
 */
static int carry(struct gauss *g, int n, int k)
{
    int p = g->row[k], s;
    int32_t pivot = g->pivot[k], yp = (int32_t)g->y[p];
    uint64_t used = 0;

    for (int i = 0; i < n; i++) {
        int32_t f = g->a[i][k];

        if (i != p && f != 0) {
            int64_t t = (int64_t)pivot * (int32_t)g->y[i] - (int64_t)f * yp;

            g->y[i] = carom_round(t, g->shift[i][k]);
            used |= (uint64_t)carom_abs(g->y[i]);
        }
    }
    if (used < (uint64_t)FULL) {
        return 0;
    }
    s = fix_bits(used) - 30;
    for (int i = 0; i < n; i++) {
        g->y[i] = scale_down(g->y[i], s);
    }
    return s;
}

/*
 * x_k = y / d = (y inverse) 2^(z - 59), z being the shift of the inverse; this is y inverse, 60
 * bits.
 */
static inline int64_t quotient(const struct gauss *g, int k)
{
    return (int64_t)(int32_t)g->y[g->row[k]] * g->a[g->row[k]][k];
}

/* Divide g->y by the diagonal. The answer, in 29 bits, is digits 2^(top - 59); returns top. */
static int divide_diagonal(struct gauss *g, int n)
{
    int most = 0, top;
    uint64_t used = 0;

    for (int k = 0; k < n; k++) {
        most = g->inverse_shift[k] > most ? g->inverse_shift[k] : most;
    }
    for (int k = 0; k < n; k++) {
        used |= (uint64_t)carom_abs(quotient(g, k)) >> (most - g->inverse_shift[k]);
    }
    top = fix_bits(used) + most - DIGITS_BITS;
    for (int k = 0; k < n; k++) {
        g->a[k][GAUSS_MAX] = (int32_t)scale_down(quotient(g, k), top - g->inverse_shift[k]);
    }
    return top;
}

/*
 * Solve for the residual, which has `bits` bits, times 2^-q. The answer is digits 2^-h; returns h.
 */
static int correction(struct gauss *g, int n, int bits, int q)
{
    int s = bits - 30;

    for (int i = 0; i < n; i++) {
        g->y[i] = scale_down(g->residual[i], s);
    }
    q -= s;
    for (int k = 0; k < n; k++) {
        q -= carry(g, n, k);
    }
    return q + 59 - divide_diagonal(g, n);
}

/*
 * residual = (residual 2^(h - q)) - row digits, in the scale 2^-h. The terms nearly cancel; only the
 * difference needs to fit, so the sum is formed modulo 2^64.
 */
void gauss_take_out(struct gauss *g, int n, int i, const int32_t *row)
{
    uint64_t sum = 0;

    for (int j = 0; j < n; j++) {
        sum += (uint64_t)((int64_t)row[j] * g->a[j][GAUSS_MAX]);
    }
    g->residual[i] = (int64_t)((uint64_t)g->residual[i] - (sum << g->up[i]));
}

/* x += digits 2^-h */
static void add_digits(struct gauss *g, int n, int h)
{
    for (int k = 0; k < n; k++) {
        g->x_q40[k] += h - 40 > 62 ? 0 : scale_down(g->a[k][GAUSS_MAX], h - 40);
    }
}

int gauss_begin(struct gauss *g, int n)
{
    CAROM_ASSERT(n >= 1 && n <= GAUSS_MAX);
    if (normalise_rows(g, n) || factor(g, n) || invert_diagonal(g, n)) {
        return -1;
    }
    memset(g->x_q40, 0, sizeof g->x_q40);
    g->round = g->first = g->last = 0;
    return block_bits(g->residual, n) > 0;
}

/* Go on: bring the residual to the scale of the correction to be taken out of it. Returns 1. */
static int go_on(struct gauss *g, int n, int h)
{
    for (int i = 0; i < n; i++) {
        int up = h - g->last;

        g->residual[i] = up < 64 ? (int64_t)((uint64_t)g->residual[i] << up) : 0;
    }
    g->last = h;
    return 1;
}

int gauss_correct(struct gauss *g, int n)
{
    int bits = block_bits(g->residual, n), h, gained;

    if (bits > RESIDUAL_BITS || g->round == ROUNDS_MAX) {
        return -1;
    }
    if (bits == 0) {
        return 0;
    }
    h = correction(g, n, bits, g->last);
    if (h < DIGITS_BITS - 20 || h < g->last + 4) {
        return -1; /* out of range, or the corrections hardly shrink */
    }
    add_digits(g, n, h);
    g->first = g->round == 0 ? h : g->first;
    /* each correction is as good, relative to itself, as the first solution was */
    gained = (h - g->first) + (h - g->last);
    return g->round++ > 0 && gained >= 34 ? 0 : go_on(g, n, h);
}

int gauss_solve(struct gauss *g, int n, const int32_t (*rows)[GAUSS_MAX + 1])
{
    int more = gauss_begin(g, n);

    while (more > 0) {
        more = gauss_correct(g, n);
        for (int i = 0; i < n && more > 0; i++) {
            gauss_take_out(g, n, i, rows[i]);
        }
    }
    return more;
}

int gauss_add(struct gauss *g, int n, const int64_t *b_q10)
{
    int bits, h;

    bits = block_bits(b_q10, n);
    if (bits == 0) {
        return 0;
    }
    if (bits > GAUSS_ADD_BITS) {
        return -1;
    }
    for (int i = 0; i < n; i++) {
        g->residual[i] = carom_shl(b_q10[i], g->up[i]); /* < 2^(32 + 29) */
    }
    h = correction(g, n, block_bits(g->residual, n), 10);
    if (h < DIGITS_BITS - 20) {
        return -1;
    }
    add_digits(g, n, h);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Fixed-point arithmetic against exact integers and double precision. */
#include "num/fix.h"
#include "lib/real.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 200000
#else
#define CASES 300
#endif

#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 int128; /* used as an oracle where the compiler has it */
#endif

/* A random number; every bit length is equally likely. */
static int64_t random_size(struct test_random *r, int bits)
{
    int64_t v = (int64_t)(test_random_next(r) >> (64 - test_random_range(r, 1, bits)));

    return test_random_next(r) & 1 ? -v : v;
}

static struct fix_wide wide_sum(struct fix_wide a, struct fix_wide b)
{
    fix_wide_add(&a, &b);
    return a;
}

static int64_t wide_part(struct fix_wide a, int s)
{
    return fix_wide_shift(&a, s);
}

static int wide_sign(struct fix_wide a)
{
    return fix_wide_sign(&a);
}

static struct fix_scaled wide_ratio(struct fix_wide a, struct fix_wide b)
{
    return fix_wide_ratio(&a, &b);
}

static struct fix_wide wide_opposite(struct fix_wide a)
{
    struct fix_wide opposite = {0, 0};

    fix_wide_subtract(&opposite, &a);
    return opposite;
}

static void check_wide_equal(struct fix_wide a, struct fix_wide b)
{
    CHECK_EQ(a.hi, b.hi);
    CHECK_EQ(a.lo, b.lo);
}

/* a b modulo 2^64 from digits of 16 bits, with 32-bit products only. */
static uint64_t product_by_digits(uint64_t a, uint64_t b)
{
    uint32_t sums[5] = {0, 0, 0, 0, 0};
    uint64_t product = 0;

    for (int i = 0; i < 4; i++) {
        for (int j = 0; i + j < 4; j++) {
            uint32_t p = (uint32_t)(a >> 16 * i & 0xffff) * (uint32_t)(b >> 16 * j & 0xffff);

            sums[i + j] += p & 0xffff;
            sums[i + j + 1] += p >> 16;
        }
    }
    for (int k = 0; k < 4; k++) {
        product |= (uint64_t)(sums[k] & 0xffff) << 16 * k;
        sums[k + 1] += sums[k] >> 16;
    }
    return product;
}

/* Edge cases in all pairs, then numbers of all sizes. */
static const int64_t edges[] = {
    0,          1,           -1,          2,         -2,        0x7fff,        0x8000,
    0xffff,     0x10000,     -0x8000,     -0x10000,  0x10001,   INT32_MAX,     INT32_MIN,
    UINT32_MAX, 0x100000000, 0x1ffff0001, INT64_MAX, INT64_MIN, -0xffffffffLL,
};
enum { EDGES = sizeof edges / sizeof edges[0], PAIRS = EDGES * EDGES + CASES };

static uint64_t number_of_pair(struct test_random *r, int i, int edge)
{
    return (uint64_t)(i < EDGES * EDGES ? edges[edge] : random_size(r, 64));
}

/*
 * The product of which everything here is made; on a small processor the board has a function for
 * it.
 */
static void test_product(void)
{
    struct test_random r = {64};

    for (int i = 0; i < PAIRS; i++) {
        volatile uint64_t a = number_of_pair(&r, i, i / EDGES);
        volatile uint64_t b = number_of_pair(&r, i, i % EDGES);
        volatile int32_t low_a = (int32_t)(uint32_t)a, low_b = (int32_t)(uint32_t)b;

        CHECK_EQ(a * b, product_by_digits(a, b));
        CHECK_EQ((int64_t)low_a * low_b,
                 product_by_digits((uint64_t)(int64_t)low_a, (uint64_t)(int64_t)low_b));
    }
}

/* A quotient holds q d + r = n; r is smaller than d and has n's sign. */
static void check_quotient(uint64_t n, uint64_t d)
{
    uint64_t q = n / d, r = n % d;
    int64_t signed_n = (int64_t)n, signed_d = (int64_t)d, signed_r;

    CHECK_EQ(r < d, true); /* both may be above INT64_MAX */
    CHECK_EQ(q * d + r, n);
    if (signed_n == INT64_MIN && signed_d == -1) {
        return;
    }
    signed_r = signed_n % signed_d;
    CHECK_EQ((uint64_t)(signed_n / signed_d) * d + (uint64_t)signed_r, n);
    CHECK(signed_r == 0 || (signed_r < 0) == (signed_n < 0));
    r = signed_r < 0 ? 0 - (uint64_t)signed_r : (uint64_t)signed_r;
    CHECK_EQ(r < (signed_d < 0 ? 0 - d : d), true);
}

static void check_small_quotient(uint32_t n, uint32_t d)
{
    int32_t signed_n = (int32_t)n, signed_d = (int32_t)d;

    CHECK_LESS(n % d, d);
    CHECK_EQ((uint32_t)(n / d * d + n % d), n);
    if (signed_n != INT32_MIN || signed_d != -1) {
        CHECK_EQ(signed_n / signed_d, (int64_t)signed_n / signed_d);
        CHECK_EQ(signed_n % signed_d, (int64_t)signed_n % signed_d);
    }
}

/* On a small processor the board has functions for this, too. */
static void test_quotient(void)
{
    struct test_random r = {65};

    for (int i = 0; i < PAIRS; i++) {
        volatile uint64_t n = number_of_pair(&r, i, i / EDGES);
        volatile uint64_t d = number_of_pair(&r, i, i % EDGES);

        if (d != 0) {
            check_quotient(n, d);
            check_quotient(n | 1, d | (uint64_t)1 << 63); /* shifted by at most that */
        }
        if ((uint32_t)d != 0) {
            check_quotient(n, (uint32_t)d);
            check_small_quotient((uint32_t)n, (uint32_t)d);
        }
    }
}

/* ------------------------------------------------------------- carom_fix.h */

static void test_rounding(void)
{
    for (int s = 1; s <= 62; s++) {
        int64_t one = (int64_t)1 << s, half = one / 2;

        CHECK_EQ(carom_round(0, s), 0);
        CHECK_EQ(carom_round(half, s), 1); /* ties upward */
        CHECK_EQ(carom_round(half - 1, s), 0);
        CHECK_EQ(carom_round(-half, s), 0);
        CHECK_EQ(carom_round(-half - 1, s), -1);
        if (s < 61) {
            CHECK_EQ(carom_round(one + half, s), 2);
            CHECK_EQ(carom_round(-one - half, s), -1);
        }
    }
    CHECK_EQ(carom_round(((int64_t)1 << 62) - 1, 1), (int64_t)1 << 61);
    CHECK_EQ(carom_shl(-3, 4), -48);
    CHECK_EQ(carom_shl(-1, 63), INT64_MIN);
    CHECK_EQ(carom_abs(-INT64_MAX), INT64_MAX);
    CHECK_EQ(carom_abs(7), 7);
}

static void test_constants(void)
{
    CHECK_EQ(CAROM_RATIO(1, 3, 32), 0x55555555);
    CHECK_EQ(CAROM_RATIO(-1, 3, 32), -0x55555555);
    CHECK_EQ(CAROM_POSITION_MM(1500), (int64_t)3 << 31);
    CHECK_EQ(CAROM_VELOCITY_MM_S(-60000, 60), -((int64_t)1 << 40));
    CHECK_EQ(CAROM_SPIN_MRAD_S(500, 1), (int64_t)1 << 39);
    CHECK_EQ(CAROM_GRAVITY_MM_S2(3600 * 1000, 60), (int64_t)1 << 40);
    /* 9.81 / 3600 2^40 = 2996169185.69 */
    CHECK_EQ(CAROM_GRAVITY_MM_S2(9810, 60), 2996169185);
}

static void test_vectors(void)
{
    const int32_t one = 1 << 20;
    const int32_t a[3] = {2 * one, -3 * one, 5 * one}, b[3] = {7 * one, 11 * one, -13 * one};
    static const carom_m3_q30 quarter = {
        {{0, -CAROM_ONE_Q30, 0}, {CAROM_ONE_Q30, 0, 0}, {0, 0, CAROM_ONE_Q30}}};
    int32_t v[3];

    CHECK_EQ(carom_mul_q30(12345, CAROM_ONE_Q30), 12345);
    CHECK_EQ(carom_mul_q30(3, CAROM_ONE_Q30 / 2), 2); /* ties upward */
    CHECK_EQ(carom_mul_q30(-3, CAROM_ONE_Q30 / 2), -1);
    CHECK_EQ(carom_dot(a, b), (14 - 33 - 65) * ((int64_t)1 << 40));
    carom_cross(v, a, b, 20);
    CHECK_EQ(v[0], (39 - 55) * one);
    CHECK_EQ(v[1], (35 + 26) * one);
    CHECK_EQ(v[2], (22 + 21) * one);
    memcpy(v, a, sizeof v);
    carom_rotate(v, &quarter, v); /* x to y, y to -x; in place */
    CHECK_EQ(v[0], 3 * one);
    CHECK_EQ(v[1], 2 * one);
    CHECK_EQ(v[2], 5 * one);
    carom_rotate_back(v, &quarter, v);
    CHECK_EQ(memcmp(v, a, sizeof v), 0);
    carom_cross(v, a, a, 1);
    CHECK_EQ((v[0] | v[1] | v[2]), 0);
}

/* ------------------------------------------------------------------- whole */

static void test_bits(void)
{
    CHECK_EQ(fix_bits(0), 0);
    for (int k = 0; k < 64; k++) {
        CHECK_EQ(fix_bits((uint64_t)1 << k), k + 1);
        CHECK_EQ(fix_bits(((uint64_t)2 << k) - 1), k + 1);
    }
}

static void test_sqrt(void)
{
    struct test_random r = {1};

    CHECK_EQ(fix_sqrt(0), 0);
    CHECK_EQ(fix_sqrt(1), 1);
    CHECK_EQ(fix_sqrt(UINT64_MAX), UINT32_MAX);
    for (int n = 0; n < CASES; n++) {
        uint64_t k = (uint64_t)carom_abs(random_size(&r, 32)) | 1;
        uint64_t v = test_random_next(&r) >> (n % 64), root = fix_sqrt(v);

        CHECK_EQ(fix_sqrt(k * k), k);
        CHECK_EQ(fix_sqrt(k * k - 1), k - 1);
        CHECK_EQ(fix_sqrt(k * k + 1), k);
        CHECK_EQ(fix_sqrt(k * k + 2 * k), k); /* the last number below (k + 1)^2 */
        CHECK_AT_MOST(root * root, v);
        CHECK_AT_MOST(v - root * root, 2 * root);
    }
}

/* --------------------------------------------------------------------- mul */

/* Products whose exact value is known without a wide product: a = m 2^k, or b a power of two. */
static void test_mul_exact(void)
{
    struct test_random r = {2};

    for (int n = 0; n < CASES; n++) {
        int s = (int)test_random_range(&r, 1, 62);
        int64_t m = random_size(&r, 62 - s < 31 ? 62 - s + 1 : 31);
        int32_t b = (int32_t)random_size(&r, 31);
        int64_t a = random_size(&r, 62), half = (int64_t)1 << (s - 1);
        int k = (int)test_random_range(&r, 0, s - 1 < 30 ? s - 1 : 30);

        CHECK_EQ(fix_mul(carom_shl(m, s), b, s), m * b);
        CHECK_EQ(fix_mul(a, (int32_t)1 << k, s), carom_round(a, s - k));
        if (s < 62) {
            CHECK_EQ(fix_mul(carom_shl(m, s) + half, 1, s), m + 1); /* ties upward */
            CHECK_EQ(fix_mul(carom_shl(m, s) + half - 1, 1, s), m);
            CHECK_EQ(fix_mul(carom_shl(m, s) + half, -1, s), -m);
            CHECK_EQ(fix_mul(carom_shl(m, s) + half + 1, -1, s), -m - 1);
        }
    }
    /* the largest that fit */
    CHECK_EQ(fix_mul(INT64_MAX, 2, 1), INT64_MAX);
    CHECK_EQ(fix_mul(INT64_MIN, 2, 1), INT64_MIN);
    CHECK_EQ(fix_mul(INT64_MAX, 1 << 30, 30), INT64_MAX);
    CHECK_EQ(fix_mul(INT64_MIN, INT32_MAX, 62), -((int64_t)INT32_MAX << 1));
    /* the part above 32 bits alone does not fit: 3 (-1431655766 2^32 + 2^32 - 1) / 2 */
    CHECK_EQ(fix_mul(-1431655766 * ((int64_t)1 << 32) + 0xffffffff, 3, 1),
             INT64_MIN + ((int64_t)1 << 31) - 1);
}

static void test_mul_wide(void)
{
    struct test_random r = {3};

    for (int n = 0; n < CASES; n++) {
        int64_t a = random_size(&r, 63);
        int32_t b = (int32_t)random_size(&r, 31);
        int s = (int)test_random_range(&r, 1, 62);
        struct fix_wide p = fix_wide_mul(a, b), half = {0, (uint64_t)1 << (s - 1)};

        if (fix_wide_bits(&p) - s < 63) {
            CHECK_EQ(fix_mul(a, b, s), wide_part(wide_sum(p, half), s));
#ifdef __SIZEOF_INT128__
            CHECK_EQ(fix_mul(a, b, s), (int64_t)(((int128)a * b + ((int128)1 << (s - 1))) >> s));
#endif
        }
    }
}

/* -------------------------------------------------------------------- wide */

static void test_wide(void)
{
    struct test_random r = {4};
    const struct fix_wide zero = {0, 0}, minus_one = {-1, UINT64_MAX};

    CHECK_EQ(fix_wide_sign(&zero), 0);
    CHECK_EQ(fix_wide_bits(&zero), 0);
    CHECK_EQ(fix_wide_sign(&minus_one), -1);
    CHECK_EQ(fix_wide_bits(&minus_one), 1);
    for (int s = 0; s <= 127; s++) {
        CHECK_EQ(fix_wide_shift(&minus_one, s), -1);
    }
    for (int s = 0; s <= 63; s++) {
        struct fix_wide sum = {0, 1};

        fix_wide_shift_up(&sum, s);
        check_wide_equal(sum, (struct fix_wide){0, (uint64_t)1 << s});
        fix_wide_shift_up(&sum, 63 - s);
        fix_wide_shift_up(&sum, 1);
        check_wide_equal(sum, (struct fix_wide){1, 0});
    }
    check_wide_equal(fix_wide_mul(INT64_MIN, INT64_MIN), (struct fix_wide){(int64_t)1 << 62, 0});
    for (int i = 0; i < 63; i++) {
        for (int j = 0; j < 63; j++) {
            struct fix_wide p = fix_wide_mul((int64_t)1 << i, -((int64_t)1 << j));

            CHECK_EQ(fix_wide_bits(&p), i + j + 1);
            CHECK_EQ(fix_wide_sign(&p), -1);
            CHECK_EQ(fix_wide_shift(&p, i + j), -1);
            CHECK_EQ(wide_part(wide_opposite(p), i + j), 1);
        }
    }
    for (int n = 0; n < CASES; n++) {
        int64_t a = random_size(&r, 62), b = random_size(&r, 62), c = random_size(&r, 62);
        int s = (int)test_random_range(&r, 0, 62);
        struct fix_wide ab = fix_wide_mul(a, b), sum = wide_sum(ab, fix_wide_mul(a, c));

        check_wide_equal(fix_wide_mul(b, a), ab);
        check_wide_equal(fix_wide_mul(a, -b), wide_opposite(ab));
        check_wide_equal(fix_wide_mul(a, b + c), sum);
        check_wide_equal(wide_opposite(wide_opposite(ab)), ab);
        check_wide_equal(wide_sum(ab, wide_opposite(ab)), zero);
        /* (a + b)(a - b) = a^2 - b^2 */
        check_wide_equal(fix_wide_mul(a + b, a - b),
                         wide_sum(fix_wide_mul(a, a), wide_opposite(fix_wide_mul(b, b))));
        CHECK_EQ(fix_wide_sign(&ab), ((a > 0) - (a < 0)) * ((b > 0) - (b < 0)));
        CHECK_EQ(wide_part(fix_wide_mul(a, (int64_t)1 << s), s), a);
        CHECK_EQ(wide_part(fix_wide_mul(a, 1), s), a >> s);
#ifdef __SIZEOF_INT128__
        CHECK_EQ(ab.hi, (int64_t)(((int128)a * b) >> 64));
        CHECK_EQ(ab.lo, (uint64_t)((int128)a * b));
        for (int k = 0; k < 128; k += 13) {
            CHECK_EQ(fix_wide_shift(&ab, k), (int64_t)(uint64_t)(((int128)a * b) >> k));
        }
#endif
    }
}

/* ------------------------------------------------------------------ scaled */

static double wide_real(struct fix_wide a)
{
    int sign = fix_wide_sign(&a);

    if (sign < 0) { /* a huge negative and a huge positive part would cancel, and the rest would be
                     * lost */
        a = wide_opposite(a);
    }
    return sign * (real(a.hi, -64) + (double)a.lo);
}

static bool scaled_whole(struct fix_scaled s)
{
    return carom_abs(s.m) >= 1 << 29 && carom_abs(s.m) < 1 << 30;
}

static void test_ratio(void)
{
    struct test_random r = {5};
    const struct fix_wide zero = {0, 0}, one = {0, 1};
    struct fix_scaled q = wide_ratio(zero, one);

    CHECK_EQ(q.m, 0);
    q = wide_ratio(fix_wide_mul(INT64_MIN, INT64_MIN), one);
    CHECK_EQ(q.m, 1 << 29);
    CHECK_EQ(q.e, 29 - 126);
    for (int n = 0; n < CASES; n++) {
        struct fix_wide a = fix_wide_mul(random_size(&r, 63) | 1, random_size(&r, 63) | 1);
        struct fix_wide b = fix_wide_mul(random_size(&r, 63) | 1, random_size(&r, 63) | 1);
        double quotient = wide_real(a) / wide_real(b);

        q = wide_ratio(a, b);
        CHECK(scaled_whole(q));
        CHECK_AT_MOST(real_abs(real(q.m, q.e) / quotient - 1), real_power2(-29));
    }
}

static void test_scale(void)
{
    struct test_random r = {6};
    struct fix_scaled s = fix_scale(0, 12);

    CHECK_EQ(s.m, 0);
    s = fix_scale(1, 0);
    CHECK_EQ(s.m, 1 << 29);
    CHECK_EQ(s.e, 29);
    s = fix_scale(INT64_MAX, 10); /* rounds up to 2^63 */
    CHECK_EQ(s.m, 1 << 29);
    CHECK_EQ(s.e, 10 + 29 - 63);
    s = fix_scale(INT64_MIN, 10);
    CHECK_EQ(s.m, -(1 << 29));
    CHECK_EQ(s.e, 10 + 29 - 63);
    s = fix_scale(((int64_t)1 << 30) + 1, 0); /* a tie */
    CHECK_EQ(s.m, (1 << 29) + 1);
    CHECK_EQ(s.e, -1);
    for (int n = 0; n < CASES; n++) {
        int64_t v = random_size(&r, 62) | 1;
        int q = (int)test_random_range(&r, -40, 40), shift;

        s = fix_scale(v, q);
        shift = q - s.e; /* v = m 2^shift */
        CHECK(scaled_whole(s));
        if (shift <= 0) {
            CHECK_EQ(carom_shl(v, -shift), s.m);
        } else {
            CHECK_AT_MOST(carom_abs(v - carom_shl(s.m, shift)), (int64_t)1 << (shift - 1));
        }
    }
}

static void test_inverse(void)
{
    struct test_random r = {7};

    for (int n = 0; n < CASES; n++) {
        struct fix_scaled s = {(int32_t)test_random_range(&r, 1 << 29, (1 << 30) - 1),
                               (int)test_random_range(&r, -30, 60)};
        struct fix_scaled inverse;

        s.m = n == 0 ? 1 << 29 : n == 1 ? (1 << 30) - 1 : s.m;
        inverse = fix_scaled_inverse(s);
        CHECK(scaled_whole(inverse));
        /* m m' = 2^(e + e') within one unit of m' */
        CHECK_NEAR((int64_t)s.m * inverse.m, (int64_t)1 << (s.e + inverse.e), s.m);
    }
}

static void test_mul_scaled(void)
{
    struct test_random r = {8};

    for (int n = 0; n < CASES; n++) {
        struct fix_scaled s =
            fix_scale(random_size(&r, 40) | 1, (int)test_random_range(&r, 0, 120));
        int64_t v = random_size(&r, 62), result, three[3];
        struct fix_wide p = fix_wide_mul(v, s.m), error;
        int more = s.e > 62 ? s.e - 62 : 0;

        if (fix_wide_bits(&p) - s.e > 62) {
            continue;
        }
        result = fix_mul_scaled(v, s);
        fix_mul_scaled3(three, (const int64_t[3]){v, 0, v}, s);
        CHECK_EQ(three[0], result);
        CHECK_EQ(three[1], 0);
        CHECK_EQ(three[2], result);
        if (s.e < 1) {
            CHECK_EQ(carom_shl(v * s.m, -s.e), result);
        } else if (s.e > 124) {
            CHECK_EQ(result, 0);
        } else {
            /* v m - result 2^e is at most half of 2^e; beyond 62 the result is rounded twice */
            error = fix_wide_mul(carom_shl(result, more), (int64_t)1 << (s.e - more));
            error = wide_sum(p, wide_opposite(error));
            CHECK_AT_MOST(real_abs(wide_real(error)),
                          real_power2(s.e - 1) + (more ? real_power2(61) : 0));
        }
    }
}

/* ----------------------------------------------------------------- vectors */

static struct fix_wide square_sum(const int64_t v[3])
{
    return wide_sum(fix_wide_mul(v[0], v[0]),
                    wide_sum(fix_wide_mul(v[1], v[1]), fix_wide_mul(v[2], v[2])));
}

static int compare_square(int64_t a, struct fix_wide b)
{
    return wide_sign(wide_sum(fix_wide_mul(a, a), wide_opposite(b)));
}

static void random_vector(struct test_random *r, int bits, int64_t v[3])
{
    int size = (int)test_random_range(r, 1, bits);

    for (int k = 0; k < 3; k++) {
        v[k] = test_random_next(r) % 8 == 0 ? 0 : random_size(r, size);
    }
}

/*
 * A length is never too short. It is too long by at most one part in 2^26; a small one is the next
 * whole number exactly.
 */
static void test_length(void)
{
    struct test_random r = {9};
    const int64_t zero[3] = {0, 0, 0}, small[3] = {2, -3, 6}, odd[3] = {1, 1, 0};

    CHECK_EQ(fix_length(zero), 0);
    CHECK_EQ(fix_length(small), 7);
    CHECK_EQ(fix_length(odd), 2);
    for (int n = 0; n < CASES; n++) {
        int64_t v[3], length;
        struct fix_wide sum;

        random_vector(&r, 61, v);
        length = fix_length(v);
        sum = square_sum(v);
        CHECK_AT_LEAST(compare_square(length, sum), 0);
        if (length > 0) {
            CHECK_LESS(compare_square(length - 1 - (length >> 26), sum), 0);
        }
    }
}

static void test_normalise(void)
{
    struct test_random r = {10};
    const int64_t zero[3] = {0, 0, 0}, tiny[3] = {0, -1, 0}, cube[3] = {1, 1, -1};
    carom_v3_q30 n = {{1, 2, 3}};

    CHECK(!fix_normalise(&n, zero));
    CHECK_EQ(n.c[0], 1);
    CHECK_EQ(n.c[1], 2);
    CHECK_EQ(n.c[2], 3);
    CHECK(fix_normalise(&n, tiny));
    CHECK_EQ(n.c[0], 0);
    CHECK_EQ(n.c[1], -CAROM_ONE_Q30);
    CHECK_EQ(n.c[2], 0);
    CHECK(fix_normalise(&n, cube));
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(n.c[k] * cube[k], 619925131, 1); /* 2^30 / sqrt 3 = 619925131.2 */
    }
    for (int i = 0; i < CASES; i++) {
        int64_t v[3];
        double d[3], length;

        random_vector(&r, 63, v);
        if ((v[0] | v[1] | v[2]) == 0) {
            continue;
        }
        CHECK(fix_normalise(&n, v));
        for (int k = 0; k < 3; k++) {
            d[k] = (double)v[k];
        }
        length = real_length(d);
        for (int k = 0; k < 3; k++) {
            CHECK_AT_MOST(real_abs(n.c[k] - d[k] / length * CAROM_ONE_Q30), 2 + 1e-6);
        }
    }
}

/* A rotation, by rounding a matrix that was computed in double. */
static void random_rotation(struct test_random *r, carom_m3_q30 *m, double exact[3][3])
{
    double q[4];

    for (int k = 0; k < 4; k++) {
        q[k] = real(test_random_range(r, -1000, 1000), 0) + 0.5;
    }
    real_matrix(exact, q);
    for (int k = 0; k < 9; k++) {
        m->c[k / 3][k % 3] = (int32_t)real_round(exact[k / 3][k % 3] * CAROM_ONE_Q30);
    }
}

static void test_rotate(void)
{
    struct test_random r = {11};

    for (int n = 0; n < CASES; n++) {
        int64_t v[3], out[3];
        int32_t near[3], there[3];
        double exact[3][3], d[3], turned[3], length;
        carom_m3_q30 m;

        random_rotation(&r, &m, exact);
        random_vector(&r, 60, v);
        for (int k = 0; k < 3; k++) {
            d[k] = (double)v[k];
            near[k] = (int32_t)(v[k] >> 31);
        }
        length = real_length(d);
        real_rotate(turned, exact, d);
        fix_rotate(out, &m, v);
        for (int k = 0; k < 3; k++) {
            /* half a unit for each product, and half a unit of each entry of the matrix */
            CHECK_AT_MOST(real_abs((double)out[k] - turned[k]), 1.5 + length * real_power2(-30));
        }
        fix_rotate_back(out, &m, out); /* in place */
        for (int k = 0; k < 3; k++) {
            CHECK_AT_MOST(real_abs((double)(out[k] - v[k])), 5 + length * real_power2(-28));
        }
        carom_rotate(there, &m, near);
        for (int k = 0; k < 3; k++) {
            d[k] = near[k];
        }
        real_rotate(turned, exact, d);
        for (int k = 0; k < 3; k++) {
            CHECK_AT_MOST(real_abs(there[k] - turned[k]), 1.0);
        }
        carom_rotate_back(there, &m, there);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(there[k], near[k], 3);
        }
    }
}

const struct test tests_num_fix[] = {
    {"num_fix/product", test_product},   {"num_fix/quotient", test_quotient},
    {"num_fix/rounding", test_rounding}, {"num_fix/constants", test_constants},
    {"num_fix/vectors", test_vectors},   {"num_fix/bits", test_bits},
    {"num_fix/sqrt", test_sqrt},         {"num_fix/mul_exact", test_mul_exact},
    {"num_fix/mul_wide", test_mul_wide}, {"num_fix/wide", test_wide},
    {"num_fix/ratio", test_ratio},       {"num_fix/scale", test_scale},
    {"num_fix/inverse", test_inverse},   {"num_fix/mul_scaled", test_mul_scaled},
    {"num_fix/length", test_length},     {"num_fix/normalise", test_normalise},
    {"num_fix/rotate", test_rotate},     {0},
};

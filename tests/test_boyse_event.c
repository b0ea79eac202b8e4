/* SPDX-License-Identifier: MIT */
/*
 * The walk over the roots of P and the way back from a root to its event, on curves made by hand: what a path of bodies hardly ever
 * brings about. P is compared with what it is at whole numbers of t's last place.
 */
#include "boyse/event.h"
#include "lib/duo.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 4000
#else
#define CASES 100
#endif

static struct curve curve;

/* P = a0 + a1 t + a2 t^2 in units of 2^shift. */
static void set_curve(int32_t a0, int32_t a1, int32_t a2, int shift)
{
    memset(&curve, 0, sizeof curve);
    curve.a[0] = a0;
    curve.a[1] = a1;
    curve.a[2] = a2;
    curve.degree = 2;
    curve.shift = shift;
    curve.bend8 = fix_abs32(a2) / 8 + 2;
}

/* ----------------------------------------------------------------------- walks */

/* A walk that finds P on the other side than before has passed a root: it stops there. */
static void test_crossed(void)
{
    for (int side = -1; side <= 1; side += 2) {
        struct walk walk;

        set_curve(side * 1000000, -side * 3000000, 0, 0);
        walk_begin(&walk, &curve);
        CHECK_EQ(walk.side, side);
        walk.t_q30 = CAROM_ONE_Q30 / 2; /* the root is at 1/3 */
        CHECK(walk_next(&walk, &curve));
        CHECK_EQ(walk.t_q30, CAROM_ONE_Q30 / 2);
        CHECK_EQ(walk.p, -side * 500000);
        CHECK_EQ(walk.side, -side);
        walk_over(&walk, &curve);
        CHECK(!walk_next(&walk, &curve));
    }
}

/* A walk has a number of rounds, far more than any needs. */
static void test_rounds(void)
{
    struct walk walk;

    set_curve(1000000, -3000000, 0, 0);
    walk_begin(&walk, &curve);
    CHECK(walk_next(&walk, &curve));
    CHECK_NEAR(walk.t_q30, CAROM_ONE_Q30 / 3, CAROM_ONE_Q30 / 3000000 * 12);
    CHECK_LESS(walk.rounds, 50);
    walk_begin(&walk, &curve);
    walk.rounds = 300;
    CHECK(!walk_next(&walk, &curve));
}

/* ---------------------------------------------------------------------- events */

static struct opening opening;

/* The opening of two bodies that do not turn, along `sign` P. */
static void begin(int sign, int64_t shift, int32_t skin_q22)
{
    shape_box(&duo.shape[0], 12, 4096, 4096, 4096);
    shape_box(&duo.shape[1], 12, 4096, 4096, 4096);
    duo_begin(false);
    duo_set_paths((double[3]){0, 0, 0}, (double[3]){0, 0, 0}, NULL);
    duo.pair.skin_q22 = skin_q22;
    opening = (struct opening){&duo.pair, false, &curve, sign, false, 0, 0, shift};
}

/* The event of the root at a time, no earlier than `from`. */
static int32_t event_of(int32_t from, int32_t root_q30)
{
    struct walk walk = {.t_q30 = root_q30};
    int32_t p = curve_at(&curve, root_q30);

    walk.p = p;
    walk.slope8 = curve.a[1] / 8 + (int32_t)((int64_t)curve.a[2] * root_q30 >> 32);
    return boyse_event_q30(&opening, from, &walk, CAROM_ONE_Q30);
}

static int32_t open_at(int32_t t_q30)
{
    return opening.sign * curve_at(&curve, t_q30);
}

/*
 * The event gap is 2 units of P, a skin of 2^20 q22 with a unit of 2^36 q40, and P falls by a unit in 4 units of time: the event is 8
 * units of time before the root, or as much earlier as one unit of P allows.
 */
static void test_steep(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        int32_t t_q30;

        set_curve(sign * (1 << 27), -sign * (1 << 28), 0, 36);
        begin(sign, 0, 1 << 20);
        t_q30 = event_of(0, CAROM_ONE_Q30 / 2);
        CHECK_EQ(opening.wanted, 2);
        CHECK_AT_MOST(t_q30, CAROM_ONE_Q30 / 2 - 8);
        CHECK_AT_LEAST(t_q30, CAROM_ONE_Q30 / 2 - 8 - 4 * (opening.slack + 1));
        /* a root within the noise, where P is above the event gap: the event is no later */
        t_q30 = event_of(0, CAROM_ONE_Q30 / 2 - 40);
        CHECK_EQ(open_at(CAROM_ONE_Q30 / 2 - 40), 10);
        CHECK_AT_MOST(t_q30, CAROM_ONE_Q30 / 2 - 40);
        CHECK_AT_LEAST(open_at(t_q30), 2);
    }
}

/* Features that never open have their event at 0. */
static void test_never_open(void)
{
    set_curve(-3, -1000, 0, 20);
    begin(1, 0, 1 << 14);
    CHECK_EQ(event_of(0, 0), 0);
    set_curve(3, 1000, 0, 20);
    begin(-1, 0, 1 << 14);
    CHECK_EQ(event_of(0, 0), 0);
}

/*
 * The surface that is sought is nearer by 100 units than the true one, and P opens by 60 of them between its roots at 1/4 and 3/4: half
 * of the largest true opening, 160, is below P's roots. The event is at the second one, and P is still open there.
 */
static void test_hardly_open(void)
{
    int32_t t_q30, before;

    /* 960 (t - 1/4) (3/4 - t) */
    set_curve(-180, 960, -960, 20);
    begin(1, 100, 1 << 14);
    t_q30 = event_of(CAROM_ONE_Q30 / 4, CAROM_ONE_Q30 / 4 * 3);
    CHECK_EQ(opening.wanted, 0);
    CHECK_LESS(t_q30, CAROM_ONE_Q30 / 4 * 3);
    CHECK_AT_LEAST(open_at(t_q30), 0);
    before = open_at(t_q30);
    CHECK_AT_MOST(before, opening.slack);
    CHECK_MORE(t_q30, CAROM_ONE_Q30 / 2);
}

/* An offset beyond all values of P counts as one: the event is right before the root. */
static void test_far_offset(void)
{
    int32_t t_q30;

    set_curve(1 << 27, -(1 << 28), 0, 20);
    begin(1, (int64_t)1 << 40, 1 << 14);
    t_q30 = event_of(0, CAROM_ONE_Q30 / 2);
    CHECK_EQ(opening.wanted, -(1 << 30));
    CHECK_AT_LEAST(t_q30, CAROM_ONE_Q30 / 2 - 64);
    CHECK_LESS(t_q30, CAROM_ONE_Q30 / 2);
}

/*
 * Curves so steep that P falls by more than the slack in the last place of t: the event is where the gap is above the wanted one by no
 * more than the slack, or the very last time before it is below.
 */
static void test_last_place(void)
{
    struct test_random r = {7};
    int last = 0;

    for (int n = 0; n < CASES; n++) {
        const int32_t size = (1 << 28) - (int32_t)test_random_range(&r, 0, 1 << 20);
        int32_t t_q30, root_q30 = CAROM_ONE_Q30 - (int32_t)test_random_range(&r, 0, 1000);

        /* size (1 - t^6): it falls by 1.5 in the last place of t at 1, and each value is rounded down six times */
        memset(&curve, 0, sizeof curve);
        curve.degree = 6;
        curve.a[0] = size;
        curve.a[6] = -size;
        curve.shift = 36;
        curve.a[1] = (int32_t)test_random_range(&r, -1000, 0);
        while (curve_at(&curve, root_q30) > 0) {
            root_q30++;
        }
        begin(1, 0, 1 << 20);
        t_q30 = boyse_event_q30(&opening, 0,
                                &(struct walk){.t_q30 = root_q30,
                                               .p = curve_at(&curve, root_q30),
                                               .slope8 = -(size / 8 * 6)},
                                CAROM_ONE_Q30);
        CHECK_EQ(opening.wanted, 2);
        CHECK_LESS(t_q30, root_q30);
        CHECK_AT_LEAST(open_at(t_q30), 2);
        if (open_at(t_q30) > opening.wanted + opening.slack) {
            CHECK_LESS(open_at(t_q30 + 1), 2);
            last++;
        }
    }
    CHECK_MORE(last, 0);
}

const struct test tests_boyse_event[] = {
    {"boyse_event/crossed", test_crossed},
    {"boyse_event/rounds", test_rounds},
    {"boyse_event/steep", test_steep},
    {"boyse_event/never_open", test_never_open},
    {"boyse_event/hardly_open", test_hardly_open},
    {"boyse_event/far_offset", test_far_offset},
    {"boyse_event/last_place", test_last_place},
    {0},
};

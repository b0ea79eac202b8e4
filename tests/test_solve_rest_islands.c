/* SPDX-License-Identifier: MIT */
/* Islands: the bodies that sleep together, and the ones that are solved apart. */
#include "lib/hand.h"

static void frame_of_sleep(const struct pair *touching, uint32_t count)
{
    rest_sleep(&hand.rest, touching, count);
}

static void test_sleep(void)
{
    const carom_v3_q40 zero = {{0, 0, 0}};
    int frames = 0;

    hand_make_cube();
    hand_begin(1, 1 / 367.0);
    hand.bodies[1].clock.contact = BODY_LIES;
    hand_set_motion(1, (double[3]){1e-5, 0, 0}, (double[3]){0, 1e-5, 0});
    while (!hand.states[1].asleep && frames < 100) {
        frame_of_sleep(hand_pairs, 1);
        frames++;
    }
    CHECK_EQ(frames, 20);
    CHECK_EQ(memcmp(&hand.states[1].momentum, &zero, sizeof zero), 0);
    CHECK_EQ(memcmp(&hand.states[1].angular, &zero, sizeof zero), 0);
    CHECK(!hand.states[0].asleep); /* a body that does not move need not sleep */

    /* one frame that is too fast, or without a contact, restarts the count */
    for (int n = 0; n < 3; n++) {
        hand.states[1].asleep = hand.states[1].quiet = 0;
        for (int frame = 0; frame < 19; frame++) {
            frame_of_sleep(hand_pairs, 1);
        }
        CHECK_EQ(hand.states[1].quiet, 19);
        hand.bodies[1].clock.contact = n != 2 ? BODY_LIES : BODY_FLIES;
        hand_set_motion(1, (double[3]){n == 0 ? 1. / 367 / 7 : 0, 0, 0},
                        (double[3]){0, 0, n == 1 ? 1. / 367 / 6 : 0});
        frame_of_sleep(hand_pairs, 1);
        CHECK_EQ(hand.states[1].quiet, 0);
        CHECK(!hand.states[1].asleep);
        hand_set_motion(1, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        hand.bodies[1].clock.contact = BODY_LIES;
    }
}

/*
 * Bodies that touch fall asleep together, however long the chain; the others fall asleep one by
 * one.
 */
static void test_islands(void)
{
    static const struct pair chain[3] = {{1, 0}, {2, 1}, {3, 2}},
                             apart[3] = {{1, 0}, {2, 0}, {3, 0}};

    hand_make_cube();
    for (int touching = 0; touching < 2; touching++) {
        const struct pair *island = touching ? chain : apart;

        hand_begin(3, 1 / 367.0);
        hand.bodies[1].clock.contact = hand.bodies[2].clock.contact = hand.bodies[3].clock.contact =
            BODY_LIES;
        hand_set_motion(3, (double[3]){0.1, 0, 0}, (double[3]){0, 0, 0});
        for (int frame = 0; frame < 30; frame++) {
            rest_sleep(&hand.rest, island, 3);
        }
        CHECK_EQ(hand.states[1].asleep, !touching);
        CHECK_EQ(hand.states[2].asleep, !touching);
        CHECK(!hand.states[3].asleep);
        hand_set_motion(3, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        for (int frame = 0; frame < 19; frame++) {
            rest_sleep(&hand.rest, island, 3);
            CHECK(!hand.states[3].asleep);
        }
        for (int frame = 0; frame < 2; frame++) {
            rest_sleep(&hand.rest, island, 3);
        }
        CHECK(hand.states[1].asleep);
        CHECK(hand.states[2].asleep);
        CHECK(hand.states[3].asleep);
    }
}

/*
 * Two islands: bodies 1 and 2, which touch each other and the ground; and body 3, whose pairs stand
 * between the pairs of the first. Each bit says that an island has contacts.
 */
enum { TWO = 1, ONE = 2 };

static void begin_apart(int islands)
{
    const double fall = 1 / 367.0;
    static const int32_t on_top[3] = {1 << 18, 1 << 17, -(1 << 21)};

    hand_begin(3, fall);
    hand_set_surface(0.5, 0.5);
    hand_set_motion(1, (double[3]){0.001, 0, -fall}, (double[3]){0, 0, 0.002});
    hand_set_motion(2, (double[3]){0, -0.003, -fall}, (double[3]){0.001, 0, 0});
    hand_set_motion(3, (double[3]){3, 1, -8}, (double[3]){0.5, -0.3, 0.1});
    if (islands & TWO) {
        hand_touch_corners_of(0, hand.bodies[1].def.skin_q22);
        hand_touch(1, 9, on_top, hand_up, hand.bodies[1].def.skin_q22);
        hand_touch_corners_of(3, hand.bodies[2].def.skin_q22);
    }
    if (islands & ONE) {
        hand_touch_corners_of(2, hand.bodies[3].def.skin_q22);
    }
}

static bool same_state(int body, const struct body_state *as)
{
    return memcmp(&hand.states[body], as, sizeof *as) == 0;
}

/* A fast impact of one island changes no bit of another island's result. */
static void test_apart(void)
{
    struct body_state alone[HAND_BODIES], at_first[HAND_BODIES];

    hand_make_box();
    begin_apart(TWO);
    CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
    memcpy(alone, hand.states, sizeof alone);
    begin_apart(ONE);
    memcpy(at_first, hand.states, sizeof at_first);
    CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
    CHECK(!same_state(3, &at_first[3]));
    CHECK(!same_state(1, &alone[1]));
    CHECK(!same_state(2, &alone[2]));
    alone[3] = hand.states[3];
    begin_apart(TWO | ONE);
    CHECK_EQ(hand.pool.used, 13);
    CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
    CHECK(same_state(1, &alone[1]));
    CHECK(same_state(2, &alone[2]));
    CHECK(same_state(3, &alone[3]));
}

/* Only the islands of bodies that newly took gravity are solved. */
static void test_enter_apart(void)
{
    struct body_state before[HAND_BODIES];

    hand_make_box();
    begin_apart(TWO | ONE);
    hand_set_motion(3, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
    hand.bodies[3].clock.contact = BODY_LIES;
    memcpy(before, hand.states, sizeof before);
    CHECK(hand_enter_contact(CAROM_ONE_Q30));
    CHECK_EQ(hand.bodies[1].clock.contact, BODY_ENTERS);
    CHECK_EQ(hand.bodies[2].clock.contact, BODY_ENTERS);
    CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, true), CAROM_OK);
    CHECK(!same_state(1, &before[1]));
    CHECK(!same_state(2, &before[2]));
    CHECK(same_state(3, &before[3]));
    CHECK_EQ(hand.rest.warm_count, 9); /* impulses of what was solved */
}

#define MANY 60

/* Islands of random pairs, against colours that spread until nothing changes. */
static void test_island_numbers(void)
{
    static struct body many[MANY];
    static struct pair joined[MANY];
    struct test_random r = {1};

    for (int n = 0; n < 20; n++) {
        int colour[MANY], count = (int)test_random_range(&r, 0, MANY);
        bool again = true;

        for (int i = 0; i < MANY; i++) {
            many[i].def.moving = test_random_range(&r, 0, 9) > 0;
            colour[i] = i;
        }
        island_begin(many, MANY);
        for (int i = 0; i < count; i++) {
            joined[i].a = (uint16_t)test_random_range(&r, 1, MANY - 1);
            joined[i].b = (uint16_t)test_random_range(&r, 0, joined[i].a - 1);
            island_join(many, &joined[i]);
        }
        island_end(many, MANY);
        while (again) {
            again = false;
            for (int i = 0; i < count; i++) {
                int a = joined[i].a, b = joined[i].b;

                if (many[a].def.moving && many[b].def.moving && colour[a] != colour[b]) {
                    colour[a] = colour[b] = colour[a] < colour[b] ? colour[a] : colour[b];
                    again = true;
                }
            }
        }
        for (int i = 0; i < MANY; i++) {
            int next = i + 1;

            CHECK_EQ(many[i].island.lowest, colour[i]);
            while (next < MANY && colour[next] != colour[i]) {
                next++;
            }
            CHECK_EQ(many[i].island.next, next < MANY ? next : (int)ISLAND_END);
        }
    }
}

const struct test tests_solve_rest_islands[] = {
    {"solve_rest_islands/sleep", test_sleep},
    {"solve_rest_islands/islands", test_islands},
    {"solve_rest_islands/apart", test_apart},
    {"solve_rest_islands/enter_apart", test_enter_apart},
    {"solve_rest_islands/island_numbers", test_island_numbers},
    {0},
};

/* SPDX-License-Identifier: MIT */
/*
 * The scenes whose outcome everybody knows: a cradle, dominoes, a house of cards, an arch, a bowl.
 */
#include <math.h>
#include <stdio.h>

#include "host_scenes.h"
#include "real.h"

/* The angle between a body's z axis now and at first, degrees. */
static double tilt(const struct play *play, int body)
{
    const double z[3] = {0, 0, 1};
    double was[3], is[3], across[3];

    lab_rotate(was, &play->first[body].rotation, z);
    lab_rotate(is, &play->now[body].rotation, z);
    real_cross(across, was, is);
    return atan2(real_length(across), real_dot(was, is)) * 180 / REAL_PI;
}

static int awake(const struct play *play, int first, int count)
{
    int found = 0;

    for (int i = first; i < first + count; i++) {
        found += !play->now[i].asleep;
    }
    return found;
}

/* ------------------------------------------------------------------------- newton */

/*
 * mark: the largest height of each ball between the first hit and the second, for each number of
 * lifted balls.
 */
enum { NEWTON_ROUNDS = 3, NEWTON_HIT = NEWTON_FRAMES / 8, NEWTON_AGAIN = 3 * NEWTON_FRAMES / 8 };

/* A ball's height, over the height from which the first one falls. */
static double rise(const struct play *play, int ball)
{
    const double low = play_at(&play->first[NEWTON_BALL + 1], 2);

    return (play_at(&play->now[NEWTON_BALL + ball], 2) - low) /
           (play_at(&play->first[NEWTON_BALL], 2) - low);
}

/*
 * A period is half of the frames of a round: the first hit is after an eighth of them, the second
 * after three eighths.
 */
static void watch_newton(struct play *play)
{
    const int round = play->frame / NEWTON_FRAMES, at = play->frame % NEWTON_FRAMES;

    for (int i = 0; i < NEWTON_BALLS && at > NEWTON_HIT + 4 && at < NEWTON_AGAIN - 4; i++) {
        double *high = &play->mark[round * NEWTON_BALLS + i];

        *high = fmax(*high, rise(play, i));
    }
}

/*
 * As many balls as were lifted rise on the other side, nearly as high, and the others stay low:
 * height is energy. A real cradle loses some energy by rolling, air and sound; this one does not.
 */
static bool judge_newton(struct play *play)
{
    double least = HUGE_VAL, most = 0, others = 0;

    for (int i = 0; i < NEWTON_ROUNDS * NEWTON_BALLS; i++) {
        if (i % NEWTON_BALLS >= NEWTON_BALLS - 1 - i / NEWTON_BALLS) {
            least = fmin(least, play->mark[i]);
            most = fmax(most, play->mark[i]);
        } else {
            others = fmax(others, play->mark[i]);
        }
    }
    snprintf(play->said, sizeof play->said, "out rise %.4f to %.4f of the height, others %.4f",
             least, most, others);
    return least > 0.99 && most < 1.001 && others < 0.01;
}

/* ----------------------------------------------------------------------- dominoes */

/* mark: how many fell; how many fell before one in front of them, or leant before the ball came. */
static void watch_dominoes(struct play *play)
{
    for (int i = (int)play->mark[0]; i < DOMINOES; i++) {
        const bool falls = tilt(play, DOMINOES_FIRST + i) > 45;

        play->mark[1] += falls && i > (int)play->mark[0];
        play->mark[1] += play->frame <= DOMINOES_START && tilt(play, DOMINOES_FIRST + i) > 1;
        play->mark[0] += falls && i == (int)play->mark[0];
    }
}

static bool judge_dominoes(struct play *play)
{
    const int moving = awake(play, DOMINOES_FIRST, DOMINOES + 1);

    snprintf(play->said, sizeof play->said, "%.0f of %d fell, %.0f out of turn, %d awake",
             play->mark[0], DOMINOES, play->mark[1], moving);
    return play->mark[0] == DOMINOES && play->mark[1] == 0 && moving == 0;
}

/* ---------------------------------------------------------- what stands, and is hit */

/*
 * mark: the largest offset of some bodies from their places, and their largest lean, before the
 * ball is thrown.
 */
static void watch_standing(struct play *play, int first, int count, int start)
{
    for (int i = first; i < first + count && play->frame < start; i++) {
        double off[3];

        for (int k = 0; k < 3; k++) {
            off[k] = play_at(&play->now[i], k) - play_at(&play->first[i], k);
        }
        play->mark[0] = fmax(play->mark[0], real_length(off));
        play->mark[1] = fmax(play->mark[1], tilt(play, i));
    }
}

static void watch_cards(struct play *play)
{
    watch_standing(play, CARDS_FIRST, CARDS, CARDS_START);
}

static void watch_arch(struct play *play)
{
    watch_standing(play, ARCH_KEYSTONE, ARCH_STONES, ARCH_START);
}

static void say_standing(struct play *play, double height, int moving)
{
    snprintf(play->said, sizeof play->said,
             "stood within %.4f and %.2f degrees, then the top fell to %.2f, %d awake",
             play->mark[0], play->mark[1], height, moving);
}

/*
 * Before the throw no card moves by a tenth of its thickness of 0.02; after it the top cards lie
 * below their storey.
 */
static bool judge_cards(struct play *play)
{
    const double height =
        fmax(play_at(&play->now[CARDS_TOP], 2), play_at(&play->now[CARDS_TOP + 1], 2));
    const int moving = awake(play, CARDS_FIRST, CARDS + 1);

    say_standing(play, height, moving);
    return play->mark[0] < 0.002 && play->mark[1] < 0.5 && height < 1.9 && moving == 0;
}

/* Stones are 0.6 thick; the keystone was 2.8 high. */
static bool judge_arch(struct play *play)
{
    const double height = play_at(&play->now[ARCH_KEYSTONE], 2);
    const int moving = awake(play, ARCH_KEYSTONE, ARCH_STONES);

    say_standing(play, height, moving);
    return play->mark[0] < 0.006 && play->mark[1] < 0.5 && height < 1.4 && moving == 0;
}

/* --------------------------------------------------------------------------- bowl */

/* mark: the number of bodies at rest in the bowl before the toss. */
static void watch_bowl(struct play *play)
{
    for (int i = BOWL_PIECE; i < BOWL_PIECE + BOWL_PIECES && play->frame == BOWL_TOSS - 1; i++) {
        const struct carom_body_state *now = &play->now[i];

        play->mark[0] +=
            now->asleep && hypot(play_at(now, 0), play_at(now, 1)) < 1.4 && play_at(now, 2) > 0.1;
    }
}

/*
 * All bodies lie in the bowl. After the toss all come to rest again above the ground, in the bowl
 * or beside it.
 */
static bool judge_bowl(struct play *play)
{
    const int moving = awake(play, BOWL_PIECE, BOWL_PIECES);
    double least = HUGE_VAL;

    for (int i = BOWL_PIECE; i < BOWL_PIECE + BOWL_PIECES; i++) {
        least = fmin(least, play_at(&play->now[i], 2));
    }
    snprintf(play->said, sizeof play->said, "%.0f of %d lay in the bowl, then %d awake",
             play->mark[0], BOWL_PIECES, moving);
    return play->mark[0] == BOWL_PIECES && moving == 0 && least > 0.1;
}

const struct play_scene play_shows[] = {
    {"newton", NEWTON_ROUNDS *NEWTON_FRAMES - 1, 2, watch_newton, judge_newton},
    {"dominoes", 10 * FPS, 2, watch_dominoes, judge_dominoes},
    {"cards", 12 * FPS, 2, watch_cards, judge_cards},
    {"arch", 12 * FPS, 2, watch_arch, judge_arch},
    {"bowl", 15 * FPS, 2, watch_bowl, judge_bowl},
    {0},
};

/* SPDX-License-Identifier: MIT */
/* The scenes of which everybody knows what must come: a cradle, a row of dominoes. */
#include <math.h>
#include <stdio.h>

#include "host_scenes.h"
#include "real.h"

/* The angle between the way that a body's z axis points now and pointed at first, degrees. */
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

/* mark: the highest that each ball is between the first hit and the second, for each count of balls lifted. */
enum { NEWTON_ROUNDS = 3, NEWTON_HIT = NEWTON_FRAMES / 8, NEWTON_AGAIN = 3 * NEWTON_FRAMES / 8 };

/* How high a ball is, of the height from which the first one falls. */
static double rise(const struct play *play, int ball)
{
    const double low = play_at(&play->first[NEWTON_BALL + 1], 2);

    return (play_at(&play->now[NEWTON_BALL + ball], 2) - low) /
           (play_at(&play->first[NEWTON_BALL], 2) - low);
}

/* A period is half of the frames of a round: the first hit is after an eighth, the second after three. */
static void watch_newton(struct play *play)
{
    const int round = play->frame / NEWTON_FRAMES, at = play->frame % NEWTON_FRAMES;

    for (int i = 0; i < NEWTON_BALLS && at > NEWTON_HIT + 4 && at < NEWTON_AGAIN - 4; i++) {
        double *high = &play->mark[round * NEWTON_BALLS + i];

        *high = fmax(*high, rise(play, i));
    }
}

/*
 * As many balls as were lifted rise on the other side to as high as that, nearly, and the others keep out of it: height is
 * energy. Rolling, air and sound, which take some from a real cradle, are not there.
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

/* mark: how many fell; those that fell before one in front of them, or leant before the ball came. */
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

const struct play_scene play_shows[] = {
    {"newton", NEWTON_ROUNDS *NEWTON_FRAMES - 1, 2, watch_newton, judge_newton},
    {"dominoes", 10 * FPS, 2, watch_dominoes, judge_dominoes},
    {0},
};

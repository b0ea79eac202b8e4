/* SPDX-License-Identifier: MIT */
/*
 * host_scenes - the scenes of scene_games.h that show one thing each. Each scene plays by itself
 * and is judged in double precision, from what the public interface reports: faces never cross,
 * and the thing that the scene shows happens. The expected amounts follow from the numbers of the
 * scene.
 *
 *   host_scenes.elf [scene]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/host_scenes.h"
#include "lib/real.h"

#define CROSSING_TOLERANCE 1e-9

static void begin(struct play *play, const char *name)
{
    struct carom_config config = scene_config();
    size_t bytes;

    memset(play, 0, sizeof *play);
    play->mesh_block = lab_need(SCENE_MESH_BYTES);
    lab_expect(scene_load(&play->scene, name, NULL, play->mesh_block, SCENE_MESH_BYTES), name);
    bytes = carom_world_bytes(&play->scene.caps);
    play->world_block = lab_need(bytes);
    lab_expect(scene_make(&play->scene, &config, play->world_block, bytes, &play->world), name);
    play->bodies = carom_body_count(play->world);
    lab_expect(play->bodies <= PLAY_BODIES ? CAROM_OK : CAROM_ERR_BODIES_FULL, name);
    for (int i = 0; i < play->bodies; i++) {
        play->mesh[i] = lab_doubles(&carom_body_mesh(play->world, i)->raw);
        play->first[i] = play->now[i] = lab_state(play->world, i);
    }
}

static void end(struct play *play)
{
    for (int i = 0; i < play->bodies; i++) {
        oracle_mesh_free(&play->mesh[i]);
    }
    free(play->world_block);
    free(play->mesh_block);
}

double play_at(const struct carom_body_state *state, int axis)
{
    return lab_double(state->position.c[axis], 32);
}

double play_turn(const struct play *play, int body, int axis)
{
    double q[4];

    lab_quaternion(q, &play->now[body].rotation);
    return 2 * atan2(q[1 + axis], q[0]);
}

double play_turned(double *total, double turn)
{
    *total += remainder(turn - *total, 2 * REAL_PI);
    return *total;
}

/* Whether two bodies can touch at all: their spheres overlap. A surface has no sphere. */
static bool are_near(const struct play *play, int a, int b)
{
    const struct carom_mesh *of_a = carom_body_mesh(play->world, a);
    const struct carom_mesh *of_b = carom_body_mesh(play->world, b);
    double apart[3];

    if (of_a->raw.kind == CAROM_SURFACE || of_b->raw.kind == CAROM_SURFACE) {
        return true;
    }
    for (int k = 0; k < 3; k++) {
        apart[k] = play_at(&play->now[a], k) - play_at(&play->now[b], k);
    }
    return real_length(apart) < lab_double(of_a->radius_q22 + (int64_t)of_b->radius_q22, 22);
}

/* The crossing pairs of faces of all bodies, one of which moves. */
static void look_for_crossings(struct play *play)
{
    struct oracle_pose pose[PLAY_BODIES];

    for (int i = 0; i < play->bodies; i++) {
        pose[i] = lab_pose_of(play->world, i, carom_body_mesh(play->world, i));
    }
    for (int b = 1; b < play->bodies; b++) {
        for (int a = 0; a < b; a++) {
            struct carom_body_look look[2];

            lab_expect(carom_body_look(play->world, a, &look[0]), "look");
            lab_expect(carom_body_look(play->world, b, &look[1]), "look");
            if ((look[0].moving || look[1].moving) && are_near(play, a, b)) {
                play->crossings += (long)oracle_crossings(&play->mesh[a], &pose[a], &play->mesh[b],
                                                          &pose[b], CROSSING_TOLERANCE)
                                       .pairs;
                play->looked++;
            }
        }
    }
}

static void run(const struct play_scene *scene)
{
    static struct play play;
    bool good;

    begin(&play, scene->name);
    while (play.frame < scene->frames) {
        play.frame++;
        lab_expect(scene_before(&play.scene, play.world, play.frame), scene->name);
        lab_expect(carom_world_step(play.world), scene->name);
        for (int i = 0; i < play.bodies; i++) {
            play.now[i] = lab_state(play.world, i);
        }
        if (scene->watch) {
            scene->watch(&play);
        }
        if (play.frame % scene->look_every == 0) {
            look_for_crossings(&play);
        }
    }
    good = scene->judge(&play) && play.crossings == 0 && play.looked > 0;
    lab_report(good, scene->name, "%s; %ld faces cross in %ld pairs of bodies", play.said,
               play.crossings, play.looked);
    end(&play);
}

/* -------------------------------------------------------------------- gears */

#define GEARS_MODULE 0.1 /* diameter per tooth */
/*
 * The play of the teeth along the rolling circles (tools/machines.py). The teeth of both wheels are
 * narrower by 0.006. A chord of 0.085 replaces a flank bent with a radius of 0.21, or 0.51 on the
 * large wheel, so up to 0.0043 + 0.0018 is missing on either side.
 */
#define GEARS_LEAST 0.012
#define GEARS_MOST  (GEARS_LEAST + 2 * (0.0043 + 0.0018) / 0.906)

/*
 * The arc along the rolling circles that each wheel has turned, compared with the next wheel's: the
 * difference is the play of the teeth. mark: the turn of each wheel, and the least and the largest
 * of these differences.
 */
static void watch_gears(struct play *play)
{
    static const int teeth[GEARS] = GEARS_TEETH;

    for (int i = 0; i < GEARS; i++) {
        play_turned(&play->mark[i], play_turn(play, GEARS_FIRST + i, 1));
    }
    for (int i = 0; i + 1 < GEARS; i++) {
        double *range = &play->mark[GEARS + 2 * i];
        double apart =
            GEARS_MODULE / 2 * (play->mark[i] * teeth[i] + play->mark[i + 1] * teeth[i + 1]);

        range[0] = fmin(range[0], apart);
        range[1] = fmax(range[1], apart);
    }
    if (play->frame == 6 * FPS) {
        play->mark[GEARS * 3] = play->mark[0];
    }
}

/*
 * The motor makes its turns in six seconds, less the time to start. The wheels use the play, and
 * nothing beyond it.
 */
static bool judge_gears(struct play *play)
{
    const double turns = play->mark[GEARS * 3] / (2 * REAL_PI),
                 wanted = GEARS_TURNS_A_MINUTE / 10.0;
    double most = 0, least = HUGE_VAL;

    for (int i = 0; i + 1 < GEARS; i++) {
        const double *range = &play->mark[GEARS + 2 * i];

        most = fmax(most, range[1] - range[0]);
        least = fmin(least, range[1] - range[0]);
    }
    snprintf(play->said, sizeof play->said, "%.2f turns of %.1f, teeth loose by %.4f to %.4f",
             turns, wanted, least, most);
    return turns > 0.95 * wanted && turns < 1.001 * wanted && least > GEARS_LEAST &&
           most < GEARS_MOST;
}

/* -------------------------------------------------------------------- screw */

/*
 * mark: the turn, the largest difference between way and turn, the lowest place of the nut, the
 * highest place after that.
 */
static void watch_screw(struct play *play)
{
    double way = play_at(&play->now[SCREW_NUT], 2) - play_at(&play->first[SCREW_NUT], 2);
    double turns = play_turned(&play->mark[0], play_turn(play, SCREW_NUT, 2)) / (2 * REAL_PI);

    play->mark[1] = fmax(play->mark[1], fabs(way - turns * SCREW_PITCH_MM / 1000));
    if (way < play->mark[2]) {
        play->mark[2] = play->mark[3] = way;
    }
    play->mark[3] = fmax(play->mark[3], way);
}

/*
 * The nut moves a pitch a turn, within the play to either side and as much again for its leaning.
 * It goes down to the head, which is 1.75 below, and up again by most of that.
 */
static bool judge_screw(struct play *play)
{
    const double down = -play->mark[2], up = play->mark[3] - play->mark[2];

    snprintf(play->said, sizeof play->said, "down by %.3f, up by %.3f, off a pitch a turn by %.4f",
             down, up, play->mark[1]);
    return fabs(down - SCREW_WAY_MM / 1000.0) < 2 * SCREW_PLAY_MM / 1000.0 && up > 0.7 * down &&
           play->mark[1] < 4 * SCREW_PLAY_MM / 1000.0;
}

/* --------------------------------------------------------------------- pour */

#define POUR_FULL 60 /* frames until the bucket tips */

/* Count the things inside a box about (x, 0), +- (half_x, half_y), up to z. */
static int count_in(const struct play *play, double x, double half_x, double half_y, double z)
{
    int count = 0;

    for (int i = POUR_THING; i < POUR_THING + POUR_THINGS; i++) {
        count += fabs(play_at(&play->now[i], 0) - x) < half_x &&
                 fabs(play_at(&play->now[i], 1)) < half_y && play_at(&play->now[i], 2) > 0.08 &&
                 play_at(&play->now[i], 2) < z;
    }
    return count;
}

/* mark: the number of things in the bucket before it tips. */
static void watch_pour(struct play *play)
{
    if (play->frame == POUR_FULL) {
        play->mark[0] = count_in(play, -0.74, 0.68, 0.68, 2.1);
    }
}

/*
 * All things are in the bucket, then all are in the tray and at rest, none of them higher than a
 * stack of five.
 */
static bool judge_pour(struct play *play)
{
    int in = count_in(play, 1.23, 1.2, 0.95, 0.08 + 5 * 0.2), asleep = 0;

    for (int i = POUR_THING; i < POUR_THING + POUR_THINGS; i++) {
        asleep += play->now[i].asleep;
    }
    snprintf(play->said, sizeof play->said, "%.0f in the bucket, %d in the tray, %d asleep",
             play->mark[0], in, asleep);
    return play->mark[0] == POUR_THINGS && in == POUR_THINGS && asleep == POUR_THINGS;
}

/* ----------------------------------------------------------------- espresso */

/* Watch how far the machine's sphere reaches from the middle of the field. */
static void watch_espresso(struct play *play)
{
    double radius = lab_double(carom_body_mesh(play->world, SCENE_BODY)->radius_q22, 22);

    for (int axis = 0; axis < 2; axis++) {
        double reach = fabs(play_at(&play->now[SCENE_BODY], axis)) + radius;

        play->mark[0] = fmax(play->mark[0], reach);
    }
}

/*
 * All impacts take place within the field, whose half side is 4. The machine comes to rest on the
 * floor, not on the rim, which is 1.1 higher.
 */
static bool judge_espresso(struct play *play)
{
    const struct carom_body_state *machine = &play->now[SCENE_BODY];
    double height = play_at(machine, 2);

    snprintf(play->said, sizeof play->said, "reaches %.2f from the middle, rests at %.2f%s",
             play->mark[0], height, machine->asleep ? ", asleep" : "");
    return play->mark[0] < 4 && machine->asleep && height > 0 && height < 1.1;
}

static const struct play_scene scenes[] = {
    {"espresso", 8 * FPS, 1, watch_espresso, judge_espresso},
    {"espresso-fine", 8 * FPS, 1, watch_espresso, judge_espresso},
    {"pour", POUR_FRAMES, 10, watch_pour, judge_pour},
    {"screw", 15 * FPS, 10, watch_screw, judge_screw},
    {"gears", 14 * FPS, 4, watch_gears, judge_gears},
};

int main(int count, char **arguments)
{
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        if (count < 2 || strcmp(arguments[1], scenes[i].name) == 0) {
            run(&scenes[i]);
        }
    }
    for (const struct play_scene *show = play_shows; show->name; show++) {
        if (count < 2 || strcmp(arguments[1], show->name) == 0) {
            run(show);
        }
    }
    return lab_finish();
}

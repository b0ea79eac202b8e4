/* SPDX-License-Identifier: MIT */
/*
 * host_roll - sliding and rolling. A box that slides stops where friction has used up its energy. A
 * body of 5120 faces that is nearly a ball rolls down a ramp without slip up to a slope of 3.5 mu,
 * and slides on steeper ones. A ball of 20480 faces, 3 % flatter along one axis, comes to rest on a
 * face. The box on a ramp, and the one that slides over many triangles, are in host_motion.c.
 */
#include <math.h>
#include <stdio.h>

#include "lib/ball.h"
#include "lib/lab.h"
#include "lib/real.h"

#define FPS     60.0
#define GRAVITY (9.81 / FPS / FPS)

static void set_q32(carom_v3_q32 *out, const double v[3])
{
    for (int k = 0; k < 3; k++) {
        out->c[k] = lab_fixed(v[k], 32);
    }
}

static void set_q40(carom_v3_q40 *out, const double v[3])
{
    for (int k = 0; k < 3; k++) {
        out->c[k] = lab_fixed(v[k], 40);
    }
}

/* Tilt the ground, gravity and the body alike, so that no axis is special. */
static void tilt_all(struct lab *lab, const carom_quat_q30 *tilt)
{
    const double down[3] = {0, 0, -GRAVITY};
    double gravity[3];

    lab_rotate(gravity, tilt, down);
    set_q40(&lab->config.gravity, gravity);
    lab->scene.ground.rotation = lab->scene.body.rotation = *tilt;
}

/* ---------------------------------------------------------------------- stop */

/*
 * A sliding box stops after v^2 / (2 mu g), more than 200 frames later. Speeds are per frame and a
 * frame brakes before it moves, so the way of half a frame at v is missing, 0.2 %.
 */
static void stop(double mu, double speed)
{
    struct lab *lab = lab_load(&lab_sheet, &lab_box);
    carom_quat_q30 tilt = lab_turn(3, -2, 1, 0.4);
    const double wanted = speed * speed / (2 * mu * 9.81);
    const double start[3] = {-25, 1, 0.1501 + lab->skin}, along[3] = {speed / FPS, 0, 0};
    double from[3], velocity[3], way[3];
    long last = 0;
    struct lab_tally tally = {0};
    struct oracle_body now;

    tilt_all(lab, &tilt);
    lab_rotate(from, &tilt, start);
    lab_rotate(velocity, &tilt, along);
    set_q32(&lab->scene.body.position, from);
    set_q40(&lab->scene.body.velocity, velocity);
    lab_surface(lab, 0.4, mu);
    lab_start(lab);
    while (tally.frames < 400) {
        lab_step(lab, &tally);
        now = lab_body(lab);
        if (real_dot(now.velocity, velocity) > 1e-3 * real_dot(velocity, velocity)) {
            last = tally.frames;
        }
    }
    for (int k = 0; k < 3; k++) {
        way[k] = now.position[k] - from[k];
    }
    lab_report(fabs(sqrt(real_dot(way, way)) / wanted - 1) <= 0.01 && last >= 200 &&
                   tally.crossed == 0 && tally.capped == 0,
               "roll/box_stops_and_sleeps", "%.4f units, analytic %.4f, after %ld frames",
               sqrt(real_dot(way, way)), wanted, last);
    lab_free(lab);
}

/* ---------------------------------------------------------------------- ball */

#define CUTS   4   /* and one more of the body that is to right itself */
#define RADIUS 4.0 /* in units of 2^-12, the ball's quanta */

/* ---------------------------------------------------------------------- roll */

#define POSES  10
#define FRAMES 30

/* The mean of some runs; accelerations in g cos(slope). */
struct mean {
    double acceleration;      /* acceleration of the ball, downhill */
    double slip_acceleration; /* acceleration of its lowest point */
    double slip;              /* speed of that point at the end, as a part of the ball's speed */
    long bad;                 /* frames that cross or are cut short */
};

/* The speed downhill of the ball's lowest point. */
static double slip_of(const struct oracle_body *b, const double downhill[3], const double normal[3])
{
    double slip = real_dot(b->velocity, downhill);

    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        slip -= RADIUS * downhill[k] * (b->spin[i] * normal[j] - b->spin[j] * normal[i]);
    }
    return slip;
}

/* Lay the ball on the ramp, with its lowest vertex a skin above the ramp. */
static void lay(struct lab *lab, const carom_quat_q30 *tilt, const double normal[3])
{
    double start[3] = {-30, 0.3, RADIUS}, place[3];

    for (int i = 0; i < 2; i++) {
        lab_rotate(place, tilt, start);
        set_q32(&lab->scene.body.position, place);
        lab_start(lab);
        start[2] -= lab_lowest(lab, normal) - lab->skin;
    }
}

/* Let the ball go from rest in several poses. */
static struct mean roll(double slope, double mu)
{
    const double along[3] = {1, 0, 0}, up[3] = {0, 0, 1}, angle = atan(slope);
    const double unit = POSES * FRAMES * GRAVITY * cos(angle);
    struct lab *lab = lab_load(&lab_sheet, &ball_raw);
    carom_quat_q30 tilt = lab_turn(0, 1, 0, angle);
    double downhill[3], normal[3];
    struct mean mean = {0};
    uint64_t random = 5;

    lab_rotate(downhill, &tilt, along);
    lab_rotate(normal, &tilt, up);
    lab->scene.ground.rotation = tilt;
    lab->config.sleep = false;
    lab_surface(lab, 0.4, mu);
    for (int i = 0; i < POSES; i++) {
        struct lab_tally tally = {0};
        struct oracle_body now;
        double speed, slip;

        lab->scene.body.rotation = lab_random_turn(&random);
        lay(lab, &tilt, normal);
        while (tally.frames < FRAMES) {
            lab_step(lab, &tally);
        }
        now = lab_body(lab);
        speed = real_dot(now.velocity, downhill);
        slip = slip_of(&now, downhill, normal);
        mean.acceleration += speed / unit;
        mean.slip_acceleration += slip / unit;
        mean.slip += slip / speed / POSES;
        mean.bad += tally.crossed + tally.capped;
    }
    lab_free(lab);
    return mean;
}

/*
 * Rolling friction is a moment of r / 64 times the pressure at speed (src/solve/roll.c). A solid
 * ball has a moment of inertia of 2/5 m r^2. On a slope it rolls at 5/7 (tan - 1/64) g cos as long
 * as friction can turn it. On a steeper slope it slides at (tan - mu) g cos, and its lowest point
 * at (tan - 7/2 mu + 5/2 / 64) g cos.
 */
static void test_below(double mu)
{
    for (int part = 8; part <= 9; part++) {
        double slope = 3.5 * mu * part / 10, wanted = 5.0 / 7 * (slope - 1.0 / 64);
        struct mean found = roll(slope, mu);
        char name[64];

        snprintf(name, sizeof name, "roll/rolls_mu_%.2f_at_%d_percent", mu, part * 10);
        /* the small slip comes from passing over the edges: it is twice as large with 1280 faces */
        lab_report(fabs(found.acceleration / wanted - 1) <= 0.01 && fabs(found.slip) <= 0.05 &&
                       found.bad == 0,
                   name, "%.4f g cos, analytic %.4f, slip %.3f of the speed", found.acceleration,
                   wanted, found.slip);
    }
}

/*
 * Steeper slopes. A line through the results gives the slope at which the lowest point would not
 * slip.
 */
static void test_above(double mu)
{
    double least = 0, most = 0, threshold;

    for (int part = 11; part <= 13; part++) {
        double slope = 3.5 * mu * part / 10, wanted = slope - mu;
        struct mean found = roll(slope, mu);
        char name[64];

        least = part == 11 ? found.slip_acceleration : least;
        most = found.slip_acceleration;
        snprintf(name, sizeof name, "roll/slides_mu_%.2f_at_%d_percent", mu, part * 10);
        lab_report(fabs(found.acceleration / wanted - 1) <= 0.01 && found.slip > 0.1 &&
                       found.bad == 0,
                   name, "%.4f g cos, analytic %.4f, slip %.3f of the speed", found.acceleration,
                   wanted, found.slip);
    }
    threshold = 1.1 - 0.2 * least / (most - least);
    lab_report(fabs(threshold - 1) <= 0.1, mu < 0.3 ? "roll/threshold" : "roll/threshold_rough",
               "slides above a slope of %.3f times 7/2 mu, analytic %.3f", threshold,
               1 - 2.5 / 64 / (3.5 * mu));
}

/* -------------------------------------------------------------------- stand */

#define FLATNESS 0.97
#define TOUCHING 64

/* The vector from the centre of mass to a vertex, in a turned body. */
static void seen_from_centre(const struct lab *lab, const carom_quat_q30 *turn, size_t vertex,
                             double out[3])
{
    double local[3];

    for (int k = 0; k < 3; k++) {
        local[k] = lab->body.vertices[vertex][k] - lab->centre[k];
    }
    lab_rotate(out, turn, local);
}

/*
 * The distance of the foot of the centre of mass outside of the hull of the vertices within 0.7
 * skin of the lowest one: only rolling friction can hold this. The hull is taken as its farthest
 * vertex in each of 720 directions.
 */
static double overhang(const struct lab *lab)
{
    const carom_quat_q30 turn = lab_state(lab->world, SCENE_BODY).rotation;
    double low = HUGE_VAL, out = -HUGE_VAL, at[3], foot[TOUCHING][2];
    int feet = 0;

    for (size_t v = 0; v < lab->body.vertex_count; v++) {
        seen_from_centre(lab, &turn, v, at);
        low = fmin(low, at[2]);
    }
    for (size_t v = 0; v < lab->body.vertex_count; v++) {
        seen_from_centre(lab, &turn, v, at);
        if (at[2] < low + 0.7 * lab->skin && feet < TOUCHING) {
            foot[feet][0] = at[0];
            foot[feet++][1] = at[1];
        }
    }
    for (int i = 0; i < 720; i++) {
        double x = cos(i * REAL_PI / 360), y = sin(i * REAL_PI / 360), most = -HUGE_VAL;

        for (int n = 0; n < feet; n++) {
            most = fmax(most, foot[n][0] * x + foot[n][1] * y);
        }
        out = fmax(out, -most);
    }
    return out;
}

/*
 * A ball of 20480 faces, 3 % flatter along one axis, is laid down leaning. Its foot is out of the
 * middle by up to 0.03 of its radius; faces are half as wide. Wherever it comes to rest, it stands
 * on a face: rolling friction holds up to 1/1024 of its radius at rest, and 1/64 while it rolls.
 */
static void test_stands(void)
{
    static const double lean[] = {13, 20, 45, 60, 75};
    const double up[3] = {0, 0, 1};
    const carom_quat_q30 level = lab_turn(0, 0, 1, 0);
    double worst = 0;
    long bad = 0, last = 0;
    struct lab *lab;

    ball_cut();
    for (uint32_t v = 0; v < ball_raw.vertex_count; v++) {
        ball_vertices[v][2] = (int16_t)lrint(FLATNESS * ball_vertices[v][2]);
    }
    lab = lab_load(&lab_sheet, &ball_raw);
    lab_surface(lab, 0.4, 0.5);
    for (size_t i = 0; i < 3 * sizeof lean / sizeof *lean; i++) {
        struct lab_tally tally = {0};
        long frame = 0;

        lab->scene.body.rotation = lab_turn(1, 0.3 * (double)i, 0, lean[i / 3] * REAL_PI / 180);
        lay(lab, &level, up);
        for (; frame < 2400 && !lab_asleep(lab); frame++) {
            lab_step(lab, frame % 50 == 0 ? &tally : NULL);
        }
        last = frame > last ? frame : last;
        worst = fmax(worst, overhang(lab) / RADIUS);
        bad += tally.crossed + tally.capped;
    }
    lab_free(lab);
    lab_report(worst < 1.0 / 512 && last < 2400 && bad == 0, "roll/stands_on_a_face",
               "the foot is out by %.5f radii, asleep after %ld frames, %ld bad ones", worst, last,
               bad);
}

int main(void)
{
    stop(0.3, 12);
    ball_make(CUTS);
    lab_report(ball_raw.face_count == BALL_FACES(CUTS) &&
                   ball_raw.vertex_count == BALL_FACES(CUTS) / 2 + 2,
               "roll/ball", "%u vertices, %u faces", (unsigned)ball_raw.vertex_count,
               (unsigned)ball_raw.face_count);
    for (int i = 0; i < 2; i++) {
        test_below(i ? 0.4 : 0.25);
        test_above(i ? 0.4 : 0.25);
    }
    test_stands();
    return lab_finish();
}

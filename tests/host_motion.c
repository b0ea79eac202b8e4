/* SPDX-License-Identifier: MIT */
/*
 * host_motion - scenes with a known outcome: a ramp that holds, a slide over many triangles, bodies thrown at
 * a thin plate, drops onto a tilted plane. The planes are tilted, because axis-aligned planes hide
 * errors of normals.
 */
#include <math.h>
#include <stdio.h>

#include "lib/box.h"
#include "lib/lab.h"

#define FPS     60.0
#define GRAVITY (9.81 / FPS / FPS)
#define DEGREES (acos(-1) / 180)

static void set_position(struct carom_body_def *def, const double place[3])
{
    for (int k = 0; k < 3; k++) {
        def->position.c[k] = lab_fixed(place[k], 32);
    }
}

static void set_velocity(struct carom_body_def *def, const double velocity[3])
{
    for (int k = 0; k < 3; k++) {
        def->velocity.c[k] = lab_fixed(velocity[k], 40);
    }
}

/* ---------------------------------------------------------------------- ramp */

/*
 * A box lies on a plane of 20 degrees that falls towards +x, turned about the vertical as well.
 */
static struct lab *load_ramp(double mu)
{
    struct lab *lab = lab_load(&lab_sheet, &lab_box);
    carom_quat_q30 tilt = lab_turn(0, 1, 0, 20 * DEGREES);
    double place[3], above[3] = {-20, 0.3, 0.1501 + lab->skin};

    lab->scene.ground.rotation = lab->scene.body.rotation = tilt;
    lab_rotate(place, &tilt, above);
    set_position(&lab->scene.body, place);
    lab->config.sleep = false;
    lab_surface(lab, 0.5, mu);
    lab_start(lab);
    return lab;
}

static void test_ramp_sticks(void)
{
    struct lab *lab = load_ramp(0.5);
    double way;
    struct oracle_body from, to;
    struct lab_tally tally = {0};

    while (tally.frames < 60) {
        lab_step(lab, &tally);
    }
    from = lab_body(lab);
    while (tally.frames < 360) {
        lab_step(lab, &tally);
    }
    to = lab_body(lab);
    way = hypot(hypot(to.position[0] - from.position[0], to.position[1] - from.position[1]),
                to.position[2] - from.position[2]);
    /* the bound on creep, 2e-4 in 120 frames, for 300 frames */
    lab_report(way <= 5e-4 && tally.crossed == 0, "motion/ramp_sticks", "moves %.1e in 300 frames",
               way);
    lab_free(lab);
}

/* --------------------------------------------------------------------- slide */

static double speed_along(const struct lab *lab, const double direction[3])
{
    struct oracle_body body = lab_body(lab);

    return body.velocity[0] * direction[0] + body.velocity[1] * direction[1] +
           body.velocity[2] * direction[2];
}

/*
 * A box slides without friction at 10 units/s over a plane of 4608 triangles, in 240 frames across
 * some 35 of its edges. There is no event, and the speed stays the same. Gravity is tilted with the
 * plane.
 */
static void slide(const carom_quat_q30 *tilt, const char *name)
{
    struct lab *lab = lab_load(lab_grid(), &lab_box);
    double above[3] = {-20.3, -0.4, 0}, along[3] = {10 / FPS, 0.7 / FPS, 0};
    double down[3] = {0, 0, -GRAVITY}, place[3], velocity[3], gravity[3];
    double speed, change = 0, first;
    struct lab_tally tally = {0}, settled;

    above[2] = 0.15 + lab->skin;
    lab_rotate(place, tilt, above);
    lab_rotate(velocity, tilt, along);
    lab_rotate(gravity, tilt, down);
    lab->scene.ground.rotation = lab->scene.body.rotation = *tilt;
    set_position(&lab->scene.body, place);
    set_velocity(&lab->scene.body, velocity);
    for (int k = 0; k < 3; k++) {
        lab->config.gravity.c[k] = lab_fixed(gravity[k], 40);
    }
    lab->config.sleep = false;
    lab_surface(lab, 0.5, 0);
    lab_start(lab);
    while (tally.frames < 5) {
        lab_step(lab, &tally);
    }
    settled = tally;
    for (int k = 0; k < 3; k++) {
        along[k] = velocity[k] / hypot(10 / FPS, 0.7 / FPS);
    }
    first = speed_along(lab, along);
    while (tally.frames < 245) {
        lab_step(lab, &tally);
        speed = speed_along(lab, along);
        change = fmax(change, fabs(speed / first - 1));
    }
    lab_report(tally.hits == 0 && tally.begins == 1 && tally.ends == 0 &&
                   tally.touching - settled.touching == 240 && change <= 1e-7 && tally.crossed == 0,
               name, "%ld hits, %ld begins, %ld ends, speed within %.1e, sub-steps at most %u",
               tally.hits, tally.begins, tally.ends, change, lab_substeps(&tally, 1));
    lab_free(lab);
}

static void test_slide(void)
{
    carom_quat_q30 flat = {{CAROM_ONE_Q30, 0, 0, 0}}, tilted = lab_turn(3, -2, 1, 0.4);

    slide(&flat, "motion/slide_flat");
    slide(&tilted, "motion/slide_tilted");
}

/* --------------------------------------------------------------------- plate */

/*
 * Plates of 100 x 100 and 40 x 40 units, 1/32 thick. The bodies are 30 times as large as the plates
 * are thick.
 */
static const int16_t wide_vertices[8][3] = BOX_CORNERS(6400, 6400, 2);
static const int16_t narrow_vertices[8][3] = BOX_CORNERS(2560, 2560, 2);

static struct carom_mesh_raw thin_plate(bool moves)
{
    struct carom_mesh_raw plate = lab_plate;

    plate.vertices = moves ? narrow_vertices : wide_vertices;
    plate.quantum_bits = 7;
    return plate;
}

/* Whether the body has a vertex below the middle of the plate and is not beside the plate. */
static bool is_through(const struct lab *lab, double half)
{
    struct oracle_pose plate = lab_pose(lab, SCENE_GROUND);
    struct oracle_body body = lab_body(lab);
    double up[3], height = 0, place[3] = {0};

    for (int k = 0; k < 3; k++) {
        up[k] = plate.rotation.row[k][2];
        height += up[k] * plate.position[k];
        for (int i = 0; i < 3; i++) {
            place[i] += plate.rotation.row[k][i] * (body.position[k] - plate.position[k]);
        }
    }
    return lab_lowest(lab, up) < height && fabs(place[0]) < half - 2 && fabs(place[1]) < half - 2;
}

/*
 * A spinning body above a plate comes down at 50 units a frame and reaches the plate after `fall`
 * of the first frame. The plate lies flat, or flies and turns.
 */
static void throw_at(struct lab *lab, bool moves, double fall, uint64_t *random)
{
    struct carom_body_def *plate = &lab->scene.ground, *body = &lab->scene.body;
    double down[3] = {lab_random(random, -8, 8), lab_random(random, -8, 8), -50};
    double velocity[3], place[3], drift[3] = {0, 0, 0};

    plate->stationary = !moves;
    if (moves) {
        plate->rotation = lab_random_turn(random);
    }
    lab_rotate(velocity, &plate->rotation, down);
    for (int k = 0; k < 3; k++) {
        place[k] = -velocity[k] * fall;
        if (moves) {
            drift[k] = lab_random(random, -4, 4);
            plate->spin.c[k] = lab_fixed(lab_random(random, -0.02, 0.02), 40);
        }
        velocity[k] += drift[k];
        body->spin.c[k] = lab_fixed(lab_random(random, -2, 2), 40);
    }
    set_velocity(plate, drift);
    set_position(body, place);
    set_velocity(body, velocity);
    body->rotation = lab_random_turn(random);
    lab_start(lab);
}

/* A body that is thrown at a thin plate stops at it or bounces off. */
static void test_plate(bool moves, const char *name)
{
    const struct carom_mesh_raw plate = thin_plate(moves);
    const struct carom_mesh_raw *bodies[3] = {&lab_box, &lab_tetrahedron, &lab_l};
    uint64_t random = 7;
    long through = 0, crossed = 0, hits = 0, capped = 0, throws = 0;

    for (int shape = 0; shape < 3; shape++) {
        struct lab *lab = lab_load(&plate, bodies[shape]);

        lab->config.gravity = (carom_v3_q40){{0, 0, 0}};
        for (int i = 0; i < 67; i++, throws++) {
            struct lab_tally tally = {0};

            throw_at(lab, moves, lab_random(&random, 0.1, 0.9), &random);
            for (int frame = 0; frame < 3; frame++) {
                lab_step(lab, &tally);
                through += is_through(lab, moves ? 20 : 50);
            }
            hits += tally.hits > 0;
            crossed += tally.crossed;
            capped += tally.capped;
        }
        lab_free(lab);
    }
    lab_report(through == 0 && crossed == 0 && hits == throws, name,
               "%ld throws, %ld hit, %ld through, %ld frames cross, %ld capped", throws, hits,
               through, crossed, capped);
}

/* --------------------------------------------------------------------- drops */

/* Twenty drops with random turns and spins onto a plane tilted by 10 degrees: all come to rest. */
static void drop(const struct carom_mesh_raw *mesh, const char *name)
{
    struct lab *lab = lab_load(&lab_sheet, mesh);
    uint64_t random = 11;
    long resting = 0, latest = 0, crossed = 0, capped = 0;
    double rise = 0;

    lab->scene.ground.rotation = lab_turn(1, 0.4, 0, 10 * DEGREES);
    for (int i = 0; i < 20; i++) {
        struct lab_tally tally = {0};

        lab->scene.body.rotation = lab_random_turn(&random);
        lab->scene.body.position.c[2] = lab_fixed(2, 32);
        for (int k = 0; k < 3; k++) {
            lab->scene.body.spin.c[k] = lab_fixed(lab_random(&random, -3, 3) / FPS, 40);
            lab->scene.body.velocity.c[k] = lab_fixed(lab_random(&random, -1, 1) / FPS, 40);
        }
        lab_start(lab);
        while (tally.frames < 900 && !lab_asleep(lab)) {
            lab_step(lab, &tally);
        }
        resting += lab_asleep(lab);
        latest = tally.frames > latest ? tally.frames : latest;
        crossed += tally.crossed;
        capped += tally.capped;
        rise = fmax(rise, tally.contact_rise);
    }
    lab_report(resting == 20 && crossed == 0 && capped == 0 && rise <= 0.2, name,
               "%ld of 20 at rest, the last after %ld frames; %ld frames cross, %ld capped, energy "
               "rises by %.1e m g skin",
               resting, latest, crossed, capped, rise);
    lab_free(lab);
}

int main(void)
{
    test_ramp_sticks();
    test_slide();
    test_plate(false, "motion/thin_plate");
    test_plate(true, "motion/thin_plate_moves");
    drop(&lab_box, "motion/drops_box");
    drop(&lab_tetrahedron, "motion/drops_tetrahedron");
    drop(&lab_l, "motion/drops_l");
    drop(&lab_plate, "motion/drops_plate");
    return lab_finish();
}

/* SPDX-License-Identifier: MIT */
/*
 * host_car - the car of the scenes drives in circles by its script, and in any way by random keys.
 * In each frame the test judges its hinges, its sliders and crossing faces in double precision,
 * from what the public interface reports.
 *
 *   host_car.elf [long]
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "carom_joint.h"
#include "lib/lab.h"
#include "port.h"
#include "lib/real.h"
#include "scene_games.h"

#define FRAMES             2000
#define FRAMES_LONG        100000
#define CROSSING_TOLERANCE 1e-9
#define HALF_YARD          24.0
#define PARTS              (1 + 2 * CAR_WHEELS)
#define STILL              (1 + CAR_RAMPS + CAR_TOWERS) /* the ground and all that stands on it */

/* The largest errors of a run. */
struct seen {
    double apart;     /* anchors, in skins of the smaller body; for sliders, across their axis */
    double axes;      /* for hinges; for sliders, all axes of one body against the other; radians */
    long apart_frame; /* frame of the worst gap */
    long crossed, under, capped;
    double round; /* radians that the car went about the middle of the yard */
    double way;   /* length of its way */
    double far;   /* its largest distance from the middle along x or y */
    long again;   /* how often it began again */
    double up;    /* smallest z component of the car's z axis */
};

struct car {
    struct scene scene;
    struct carom_world *world;
    void *mesh_block, *world_block;
    struct oracle_mesh part[PARTS], still[STILL];
};

/* The body of the i-th static thing. */
static int still_body(int i)
{
    return i == 0 ? SCENE_GROUND : CAR_RAMP + i - 1;
}

static void start(struct car *car)
{
    struct carom_config config = scene_config();

    lab_expect(scene_make(&car->scene, &config, car->world_block,
                          carom_world_bytes(&car->scene.caps), &car->world),
               "make");
}

static struct car *begin(void)
{
    struct car *car = lab_need(sizeof *car);
    size_t bytes;

    car->mesh_block = lab_need(SCENE_MESH_BYTES);
    lab_expect(scene_load(&car->scene, "car", NULL, car->mesh_block, SCENE_MESH_BYTES), "load");
    bytes = carom_world_bytes(&car->scene.caps);
    car->world_block = lab_need(bytes);
    start(car);
    for (int i = 0; i < PARTS; i++) {
        car->part[i] = lab_doubles(&carom_body_mesh(car->world, CAR_CHASSIS + i)->raw);
    }
    for (int i = 0; i < STILL; i++) {
        car->still[i] = lab_doubles(&carom_body_mesh(car->world, still_body(i))->raw);
    }
    return car;
}

static void end(struct car *car)
{
    for (int i = 0; i < PARTS; i++) {
        oracle_mesh_free(&car->part[i]);
    }
    for (int i = 0; i < STILL; i++) {
        oracle_mesh_free(&car->still[i]);
    }
    free(car->mesh_block);
    free(car->world_block);
    free(car);
}

/* -------------------------------------------------------------------------- joints */

static double skin_of(const struct car *car, int body)
{
    return lab_double(carom_body_mesh(car->world, body)->radius_q22, 22) / 2048;
}

/* The angle between directions of two bodies that were equal when the scene began. */
static double angle(const struct car *car, int a, int b, const double was[3])
{
    const struct carom_body_state sa = lab_state(car->world, a), sb = lab_state(car->world, b);
    double own[3], other[3], across[3];

    lab_rotate(own, &sa.rotation, was);
    lab_rotate(other, &sb.rotation, was);
    real_cross(across, own, other);
    return atan2(sqrt(real_dot(across, across)), real_dot(own, other));
}

static void look_at_joint(const struct car *car, int joint, struct seen *seen, long frame)
{
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    struct carom_joint_state s;
    double off[3], along = 0, square, skins;

    lab_expect(carom_joint_get(car->world, joint, &s), "joint");
    for (int k = 0; k < 3; k++) {
        off[k] = lab_double(s.anchor[0].c[k] - s.anchor[1].c[k], 32);
    }
    square = real_dot(off, off);
    if (s.kind == CAROM_JOINT_SLIDER) {
        const struct carom_body_state b = lab_state(car->world, s.b);
        double axis[3];

        lab_rotate(axis, &b.rotation, z);
        along = real_dot(off, axis);
        seen->axes = fmax(seen->axes, fmax(angle(car, s.a, s.b, x), angle(car, s.a, s.b, z)));
    } else {
        seen->axes = fmax(seen->axes, angle(car, s.a, s.b, joint < CAR_AXLE ? z : y));
    }
    skins = sqrt(fmax(0, square - along * along)) / fmin(skin_of(car, s.a), skin_of(car, s.b));
    if (skins > seen->apart) {
        seen->apart = skins;
        seen->apart_frame = frame;
    }
}

/* ---------------------------------------------------------------------- crossings */

static struct oracle_pose pose(const struct car *car, int body)
{
    return lab_pose_of(car->world, body, carom_body_mesh(car->world, body));
}

static bool is_far(const struct car *car, int a, int b)
{
    const struct carom_body_state sa = lab_state(car->world, a), sb = lab_state(car->world, b);
    double square = 0;

    for (int k = 0; k < 3; k++) {
        square += pow(lab_double(sa.position.c[k] - sb.position.c[k], 32), 2);
    }
    return sqrt(square) > lab_double(carom_body_mesh(car->world, a)->radius_q22, 22) +
                              lab_double(carom_body_mesh(car->world, b)->radius_q22, 22);
}

/*
 * Count faces of the car that cross those of static bodies, and parts of the car below the ground.
 */
static void look_at_part(const struct car *car, int part, struct seen *seen)
{
    const struct oracle_pose at = pose(car, CAR_CHASSIS + part);
    double corner[3];

    for (int i = 0; i < STILL; i++) {
        const struct oracle_pose other = pose(car, still_body(i));

        if (i > 0 && is_far(car, CAR_CHASSIS + part, still_body(i))) {
            continue;
        }
        seen->crossed +=
            oracle_crossings(&car->part[part], &at, &car->still[i], &other, CROSSING_TOLERANCE)
                .pairs != 0;
    }
    for (int k = 0; k < 3; k++) {
        corner[k] = real_dot(at.rotation.row[k], car->part[part].vertices[0]) + at.position[k];
    }
    corner[2] += CROSSING_TOLERANCE;
    seen->under += oracle_under(&car->still[0], corner);
}

/* --------------------------------------------------------------------------- runs */

static void place(const struct car *car, double at[2])
{
    const struct carom_body_state s = lab_state(car->world, CAR_CHASSIS);

    for (int k = 0; k < 2; k++) {
        at[k] = lab_double(s.position.c[k], 32);
    }
}

/* Look at the car's place, and at the angle that it went about the middle since the last frame. */
static void look_at_way(const struct car *car, double last[2], struct seen *seen)
{
    const struct carom_body_state s = lab_state(car->world, CAR_CHASSIS);
    const double z[3] = {0, 0, 1};
    double at[2], up[3];

    place(car, at);
    seen->far = fmax(seen->far, fmax(fabs(at[0]), fabs(at[1])));
    seen->round += atan2(last[0] * at[1] - last[1] * at[0], last[0] * at[0] + last[1] * at[1]);
    seen->way += hypot(at[0] - last[0], at[1] - last[1]);
    memcpy(last, at, sizeof at);
    lab_rotate(up, &s.rotation, z);
    seen->up = fmin(seen->up, up[2]);
}

/*
 * The keys of the script, or random ones, each held for half a second: left or right, forwards or
 * back, now and then lifted.
 */
static uint32_t keys_of(bool hands, long frame, uint32_t held, uint64_t *random)
{
    static const uint32_t sides[] = {0, PORT_PAD_LEFT, PORT_PAD_RIGHT};
    static const uint32_t ways[] = {0, PORT_PAD_UP, PORT_PAD_UP, PORT_PAD_UP, PORT_PAD_DOWN};

    if (!hands) {
        return SCENE_NOBODY;
    }
    if (frame % 30 != 1) {
        return held;
    }
    held = sides[(int)lab_random(random, 0, 3)] | ways[(int)lab_random(random, 0, 5)];
    return held | (lab_random(random, 0, 1) < 0.1 ? PORT_PAD_A : 0);
}

static void run(const char *name, bool hands, long frames)
{
    struct car *car = begin();
    struct seen seen = {.up = 1};
    double last[2];
    uint64_t random = 20;
    uint32_t keys = 0;
    /* at 4 m/s of the 5.6 m/s that the motors can give, on a way of 76 m; random keys brake and
     * reverse */
    double rounds = (double)frames / 60 * 4 / 76, way = (double)frames / 120;

    place(car, last);
    for (long frame = 1; frame <= frames; frame++) {
        keys = keys_of(hands, frame, keys, &random);
        lab_expect(scene_game_before(car->scene.game, car->world, (int)frame, keys), "before");
        seen.capped += lab_expect(carom_world_step(car->world), "step") != CAROM_OK;
        for (int joint = 0; joint < carom_joint_count(car->world); joint++) {
            look_at_joint(car, joint, &seen, frame);
        }
        for (int part = 0; part < PARTS; part++) {
            look_at_part(car, part, &seen);
        }
        look_at_way(car, last, &seen);
        if (hands && seen.far > HALF_YARD - 2) { /* over the rim: it begins again */
            start(car);
            place(car, last);
            seen.again++;
            seen.far = 0;
        }
    }
    seen.round /= 2 * 3.14159265358979;
    lab_report(
        seen.crossed == 0 && seen.under == 0 && seen.apart <= 4 && seen.axes <= 1e-3 &&
            seen.far < HALF_YARD && seen.way > way &&
            (hands || (seen.round >= rounds && seen.up > 0.9)),
        name,
        "%ld frames, %.0f m, %.1f rounds: %ld cross, %ld under the ground, %ld capped; anchors "
        "%.2f "
        "skins apart at most (frame %ld), bound 4; axes %.1e, bound 1e-3; within %.1f of %.0f, "
        "its z axis %.2f up at least; it began again %ld times",
        frames, seen.way, seen.round, seen.crossed, seen.under, seen.capped, seen.apart,
        seen.apart_frame, seen.axes, seen.far, HALF_YARD, seen.up, seen.again);
    end(car);
}

int main(int argc, char **argv)
{
    const long frames = argc > 1 && strcmp(argv[1], "long") == 0 ? FRAMES_LONG : FRAMES;

    run("car/rounds", false, frames);
    run("car/hands", true, frames);
    return lab_finish();
}

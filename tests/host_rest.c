/* SPDX-License-Identifier: MIT */
/*
 * host_rest - a box, a tetrahedron, an L and the head are dropped from random poses onto a plane
 * and onto the field. All come to rest. Then a body that may not sleep hardly moves, and one that
 * sleeps does not move at all. The ramp is in host_motion.c.
 *
 *   host_rest        20 drops of each onto the plane and 5 onto the field
 *   host_rest long   200 drops of each onto either
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/lab.h"

#define FPS     60.0
#define GRAVITY (9.81 / FPS / FPS)

/* Frames until a drop must be at rest. */
#define REST_FRAMES 900
/* Largest distance of a vertex from its place at rest, units, over this many frames. */
#define CREEP        2e-4
#define CREEP_FRAMES 120

struct place {
    const char *name;
    const struct carom_mesh_raw *ground;
    carom_quat_q30 tilt; /* turns ground and gravity, so that no axis is special */
    double height;       /* height of the body's centre at the start; units */
    long drops;
};

/* The results of the drops of one body. */
struct found {
    long resting, latest;
    long off; /* bodies that rolled over the border of the ground and fell */
    long crossed, capped;
    long restless; /* frames in which the world changed though its body slept */
    long high;     /* bodies whose lowest vertex is not within the skin of a plane */
    double creep;  /* largest distance of a vertex from its place at rest; units */
    double jitter; /* largest distance in a frame */
    double rise;   /* largest rise of the energy in a frame, in m g skin */
};

/* ----------------------------------------------------------------- movement */

#define VERTICES SCENE_HEAD_VERTICES

static void place_vertices(double out[VERTICES][3], const struct lab *lab)
{
    struct oracle_pose pose = lab_pose(lab, SCENE_BODY);

    for (size_t v = 0; v < lab->body.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            out[v][k] = pose.position[k];
            for (int i = 0; i < 3; i++) {
                out[v][k] += pose.rotation.row[k][i] * lab->body.vertices[v][i];
            }
        }
    }
}

/* The largest distance of a vertex from its former place. */
static double farthest(double from[VERTICES][3], double to[VERTICES][3], size_t count)
{
    double most = 0;

    for (size_t v = 0; v < count; v++) {
        double x = to[v][0] - from[v][0], y = to[v][1] - from[v][1], z = to[v][2] - from[v][2];

        most = fmax(most, x * x + y * y + z * z);
    }
    return sqrt(most);
}

/* -------------------------------------------------------------------- drops */

/* Any pose above the middle of the ground, and any motion of half a unit and 3 radians a second. */
static void start_anywhere(struct lab *lab, const struct place *place, uint64_t *random)
{
    struct carom_body_def *body = &lab->scene.body;
    double above[3] = {0, 0, place->height}, at[3];

    lab_rotate(at, &place->tilt, above);
    for (int k = 0; k < 3; k++) {
        body->position.c[k] = lab_fixed(at[k], 32);
        body->velocity.c[k] = lab_fixed(lab_random(random, -0.5, 0.5) / FPS, 40);
        body->spin.c[k] = lab_fixed(lab_random(random, -3, 3) / FPS, 40);
    }
    body->rotation = lab_random_turn(random);
}

/*
 * With sleep: play until the body sleeps, and then on; nothing may change after that. Returns the
 * frame, 0: never. A body that falls off the ground is counted apart.
 */
static long drop_asleep(struct lab *lab, const struct place *place, struct found *found)
{
    const double up[3] = {0, 0, 1};
    struct lab_tally tally = {0};
    double normal[3], gap;
    uint64_t hash;

    lab->config.sleep = true;
    lab_start(lab);
    while (tally.frames < REST_FRAMES && !lab_asleep(lab)) {
        lab_step(lab, &tally);
    }
    found->crossed += tally.crossed;
    found->capped += tally.capped;
    found->rise = fmax(found->rise, tally.contact_rise);
    lab_rotate(normal, &place->tilt, up);
    gap = lab_lowest(lab, normal);
    if (!lab_asleep(lab)) {
        found->off += gap < -2;
        return 0;
    }
    found->high += place->ground == &lab_sheet && (gap <= 0 || gap > 1.5 * lab->skin);
    hash = carom_world_hash(lab->world);
    for (long frame = 0; frame < CREEP_FRAMES; frame++) {
        lab_step(lab, NULL);
        found->restless += carom_world_hash(lab->world) != hash;
    }
    return tally.frames;
}

/* Without sleep: the same drop until the frame in which the body would have slept, and then on. */
static void drop_awake(struct lab *lab, long rest, struct found *found)
{
    static double first[VERTICES][3], seen[2][VERTICES][3];
    struct lab_tally tally = {0};

    lab->config.sleep = false;
    lab_start(lab);
    for (long frame = 0; frame < rest; frame++) {
        lab_step(lab, NULL);
    }
    place_vertices(first, lab);
    memcpy(seen[0], first, sizeof first);
    while (tally.frames < CREEP_FRAMES) {
        lab_step(lab, &tally);
        place_vertices(seen[tally.frames & 1], lab);
        found->creep =
            fmax(found->creep, farthest(first, seen[tally.frames & 1], lab->body.vertex_count));
        found->jitter = fmax(found->jitter, farthest(seen[0], seen[1], lab->body.vertex_count));
    }
    found->crossed += tally.crossed;
    found->capped += tally.capped;
    found->rise = fmax(found->rise, tally.contact_rise);
}

static struct lab *load(const struct place *place, const struct carom_mesh_raw *body)
{
    const double down[3] = {0, 0, -GRAVITY};
    struct lab *lab = lab_load(place->ground, body);
    double gravity[3];

    lab_rotate(gravity, &place->tilt, down);
    for (int k = 0; k < 3; k++) {
        lab->config.gravity.c[k] = lab_fixed(gravity[k], 40);
    }
    lab->scene.ground.rotation = place->tilt;
    lab_surface(lab, 0.4, 0.5);
    return lab;
}

static void report(const struct found *f, const struct place *place, const char *body)
{
    char name[64];
#define NAME(what) (snprintf(name, sizeof name, "rest/%s_on_%s_" what, body, place->name), name)

    lab_report(f->resting + f->off == place->drops && f->off * 20 <= place->drops && f->high == 0,
               NAME("rests"),
               "%ld of %ld at rest, the last after %ld frames, %ld fell off; %ld not in the skin",
               f->resting, place->drops, f->latest, f->off, f->high);
    lab_report(f->resting > 0 && f->crossed == 0 && f->capped == 0 && f->rise <= 0.2, NAME("holds"),
               "%ld frames cross, %ld capped, energy rises by %.1e m g skin", f->crossed, f->capped,
               f->rise);
    lab_report(f->resting > 0 && f->creep <= CREEP, NAME("awake"),
               "creeps %.1e in %d frames, at most %.1e in one", f->creep, CREEP_FRAMES, f->jitter);
    lab_report(f->resting > 0 && f->restless == 0, NAME("asleep"), "%ld frames changed the world",
               f->restless);
#undef NAME
}

static void drop(const struct place *place, const struct carom_mesh_raw *mesh, const char *name)
{
    struct lab *lab = load(place, mesh);
    struct found found = {0};
    uint64_t random = 29;

    for (long i = 0; i < place->drops; i++) {
        long rest;

        start_anywhere(lab, place, &random);
        rest = drop_asleep(lab, place, &found);
        if (rest > 0) {
            found.resting++;
            found.latest = rest > found.latest ? rest : found.latest;
            drop_awake(lab, rest, &found);
        }
    }
    report(&found, place, name);
    lab_free(lab);
}

int main(int argc, char **argv)
{
    const bool all = argc > 1 && strcmp(argv[1], "long") == 0;
    const struct place places[2] = {
        {"plane", &lab_sheet, lab_turn(3, -2, 1, 0.4), 2.5, all ? 200 : 20},
        {"field", &field_mesh, lab_turn(0, 0, 1, 0), 3.5, all ? 200 : 5},
    };

    for (int i = 0; i < 2; i++) {
        drop(&places[i], &lab_box, "box");
        drop(&places[i], &lab_tetrahedron, "tetrahedron");
        drop(&places[i], &lab_l, "l");
        drop(&places[i], &head_mesh, "head");
    }
    return lab_finish();
}

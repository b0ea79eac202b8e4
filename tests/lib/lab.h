/* SPDX-License-Identifier: MIT */
/*
 * lab - the base of the scene tests: a world with one moving body above a stationary one, watched
 * in double precision through the public interface. Host only.
 *
 *   struct lab *lab = lab_load(&ground, &body);  or lab_load_scene("head")
 *   lab->scene.body.position.c[2] = ...          change how things start
 *   lab_start(lab);
 *   lab_step(lab, &tally);                       frame by frame
 *   lab_free(lab);
 *
 * Every function ends the program when something that it needs fails, for example the build of a
 * mesh.
 */
#ifndef CAROM_TESTS_LAB_H
#define CAROM_TESTS_LAB_H

#include "carom.h"
#include "oracle.h"
#include "scene.h"

/* ---------------------------------------------------------------------- TAP */

/* Print one line of TAP; the format adds the figures that were found. */
void lab_report(bool ok, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Print the plan; returns the exit status. */
int lab_finish(void);
/* True if a program was given a word as one of its arguments. */
bool lab_given(const char *word, int count, char **words);

/* Return the result, or end the program when it is an error. */
int lab_expect(int result, const char *what);
/* Memory, all zero. */
void *lab_need(size_t bytes);

/* ------------------------------------------------------------------- numbers */

/* A fixed-point number as a double, and back to nearest. */
double lab_double(int64_t fixed, int bits);
int64_t lab_fixed(double value, int bits);
/* The rotation by `angle` radians about an axis of any length. */
carom_quat_q30 lab_turn(double x, double y, double z, double angle);
/* out = v turned by q. */
void lab_rotate(double out[3], const carom_quat_q30 *q, const double v[3]);
/* Uniform in [low, high], the same numbers on every run. */
double lab_random(uint64_t *state, double low, double high);
carom_quat_q30 lab_random_turn(uint64_t *state);
/* w, x, y, z in double; all zero means none. */
void lab_quaternion(double out[4], const carom_quat_q30 *q);

/* -------------------------------------------------------------------- meshes */

/*
 * Small solids of 2^-12 units a quantum, sides about 1, and planes at z = 0:
 * a box of 1 x 0.6 x 0.3, a tetrahedron, an L, a plate of 1 x 0.8 x 1/64;
 * a sheet of 80 x 80 units in 2 triangles, and one of 60 x 60 in 2 x 48 x 48.
 */
extern const struct carom_mesh_raw lab_box, lab_tetrahedron, lab_l, lab_plate, lab_sheet;
const struct carom_mesh_raw *lab_grid(void);

/* A mesh in double; and the mass, inertia and centre of a solid at density 1. */
struct oracle_mesh lab_doubles(const struct carom_mesh_raw *raw);
struct oracle_body lab_weigh(const struct oracle_mesh *mesh, double centre[3]);

/* --------------------------------------------------------------------- worlds */

/* A body of any world: its state; its state in double, without mass and inertia; its mesh. */
struct carom_body_state lab_state(const struct carom_world *world, int body);
void lab_read(struct oracle_body *body, const struct carom_world *world, int number);
struct oracle_pose lab_pose_of(const struct carom_world *world, int body,
                               const struct carom_mesh *mesh);

struct lab {
    struct scene scene; /* the meshes, and the bodies' start */
    struct carom_config config;
    struct carom_world *world;
    void *mesh_block, *world_block;
    struct oracle_mesh ground, body;
    double mass,
        inertia
            [6]; /* mass and inertia of the body at density 1, computed in double (oracle_body) */
    double centre[3];
    double skin; /* units: the gap that a resting contact keeps */
};

/*
 * Load two meshes, with the ground at the origin; the caller places the body. Uses scene_config and
 * e = mu = 1/2.
 */
struct lab *lab_load(const struct carom_mesh_raw *ground, const struct carom_mesh_raw *body);
/* A scene of scene.h. */
struct lab *lab_load_scene(const char *name);
/* Make the world anew, from lab->scene and lab->config. */
void lab_start(struct lab *lab);
void lab_free(struct lab *lab);

/* e and mu of both bodies. */
void lab_surface(struct lab *lab, double e, double mu);

/* The moving body as the public interface reports it. */
struct oracle_body lab_body(const struct lab *lab);
/* Kinetic energy and potential energy above the origin, from the body's state in double. */
double lab_energy(const struct lab *lab);
/* Poses of the bodies, and their pairs of crossing faces. */
struct oracle_pose lab_pose(const struct lab *lab, int body);
struct oracle_crossings lab_crossings(const struct lab *lab);
/* The lowest vertex of the body along the unit vector `up`. */
double lab_lowest(const struct lab *lab, const double up[3]);
bool lab_asleep(const struct lab *lab);

/* The observations of lab_step over a run. Start with {0}. */
struct lab_tally {
    long frames, capped;
    long crossed; /* frames with crossing faces */
    long hits;    /* hit events */
    long begins, ends;
    long touching; /* frames with contacts */
    long sliding;  /* touching frames in which a pressed contact slips by 1/20 unit a second */
    uint32_t substeps[65]; /* frames by the number of sub-steps */
    double energy_first, energy;
    double energy_change; /* the largest relative change from one frame to the next without
                           * contacts */
    double flight_change; /* the largest from one frame to the next without contacts, relative */
    double contact_rise;  /* the largest rise in any other frame, in m g skin */
};

/*
 * One frame, watched. A step that returns an error ends the program.
 *   tally  NULL: only step
 */
int lab_step(struct lab *lab, struct lab_tally *tally);

/* The smallest number of sub-steps that `share` of the frames do not exceed. */
uint32_t lab_substeps(const struct lab_tally *tally, double share);

#endif

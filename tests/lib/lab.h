/* SPDX-License-Identifier: MIT */
/*
 * lab - what the scene tests share: a world with one body that moves over one that does not,
 * watched in double precision through the public interface. Host only.
 *
 *   struct lab *lab = lab_load(&ground, &body);  or lab_load_scene("head")
 *   lab->scene.body.position.c[2] = ...          change how things start
 *   lab_start(lab);
 *   lab_step(lab, &tally);                       frame by frame
 *   lab_free(lab);
 *
 * Every function ends the program when what it needs fails, e.g. a mesh that does not build.
 */
#ifndef CAROM_TESTS_LAB_H
#define CAROM_TESTS_LAB_H

#include "carom.h"
#include "oracle.h"
#include "scene.h"

/* ---------------------------------------------------------------------- TAP */

/* One line of TAP; the format adds the figures that were found. */
void lab_report(bool ok, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Print the plan; returns the exit status. */
int lab_finish(void);

/* The result, or the end of the program when it is an error. */
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

/* A mesh in double, and what a solid weighs at density 1: mass and inertia, and its centre. */
struct oracle_mesh lab_doubles(const struct carom_mesh_raw *raw);
struct oracle_body lab_weigh(const struct oracle_mesh *mesh, double centre[3]);

/* --------------------------------------------------------------------- worlds */

/* A body of any world: its state; the same in double, mass and inertia left alone; its mesh. */
struct carom_body_state lab_state(const struct carom_world *world, int body);
void lab_read(struct oracle_body *body, const struct carom_world *world, int number);
struct oracle_pose lab_pose_of(const struct carom_world *world, int body,
                               const struct carom_mesh *mesh);

struct lab {
    struct scene scene; /* the meshes, and how the bodies start */
    struct carom_config config;
    struct carom_world *world;
    void *mesh_block, *world_block;
    struct oracle_mesh ground, body;
    double mass,
        inertia
            [6]; /* mass and inertia of the body at density 1, computed in double; see oracle_body */
    double centre[3];
    double skin; /* units: the gap that a resting contact keeps */
};

/* Two meshes, the ground at the origin, the body's place to be said; scene_config; e = mu = 1/2. */
struct lab *lab_load(const struct carom_mesh_raw *ground, const struct carom_mesh_raw *body);
/* A scene of scene.h. */
struct lab *lab_load_scene(const char *name);
/* Make the world anew, from lab->scene and lab->config. */
void lab_start(struct lab *lab);
void lab_free(struct lab *lab);

/* e and mu of both bodies. */
void lab_surface(struct lab *lab, double e, double mu);

/* The moving body as the public interface tells it. */
struct oracle_body lab_body(const struct lab *lab);
/* Kinetic energy and potential energy above the origin, from the body's state in double. */
double lab_energy(const struct lab *lab);
/* Poses of the bodies, and the pairs of faces that cross. */
struct oracle_pose lab_pose(const struct lab *lab, int body);
struct oracle_crossings lab_crossings(const struct lab *lab);
/* The lowest vertex of the body along the unit vector `up`. */
double lab_lowest(const struct lab *lab, const double up[3]);
bool lab_asleep(const struct lab *lab);

/* The observations of lab_step over a run. Start with {0}. */
struct lab_tally {
    long frames, capped;
    long crossed; /* frames with faces that cross */
    long hits;    /* hit events */
    long begins, ends;
    long touching; /* frames with contacts */
    long sliding;  /* of those, frames in which a pressed contact slips by 1/20 unit a second */
    uint32_t substeps[65]; /* frames by the number of sub-steps */
    double energy_first, energy;
    double energy_change; /* the largest distance from the first frame's, relative */
    double flight_change; /* the largest from one frame to the next without contacts, relative */
    double contact_rise;  /* the largest rise over any other frame, in m g skin */
};

/*
 * One frame, watched. A step that returns an error ends the program.
 *   tally  NULL: only step
 */
int lab_step(struct lab *lab, struct lab_tally *tally);

/* The least number of sub-steps that `share` of the frames stay within. */
uint32_t lab_substeps(const struct lab_tally *tally, double share);

#endif

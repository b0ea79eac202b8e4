/* SPDX-License-Identifier: MIT */
/*
 * fixture - scenes that others have published, or that are hard in a known way. Each has its own
 * rule, and an independent checker of crossings judges it as well. A scene is a world of up to 160
 * bodies with generated meshes, watched in double precision through the public interface. Host
 * only.
 *
 * A scene makes its bodies, may look at each frame, and judges the end:
 *
 *   struct fixture *f = fixture_new(scene);
 *   fixture_run(f, scene->frames, seconds, false);
 *   f->passed, f->tally, f->said
 *   fixture_free(f);
 *
 * A unit is a metre, a frame 1/60 s.
 */
#ifndef CAROM_TESTS_FIXTURE_H
#define CAROM_TESTS_FIXTURE_H

#include "fixture_shape.h"
#include "lab.h"

#define FIXTURE_BODIES 160
#define FIXTURE_G      (9.81 / 3600) /* units / frame^2 */

struct fixture;

struct fixture_scene {
    const char *name, *should;
    int frames;                       /* frames of the long form */
    int brief;                        /* frames of the short form; 0: left out there */
    void (*make)(struct fixture *f);  /* e = 0 and scene->mu are set after this */
    void (*watch)(struct fixture *f); /* after each frame; may be NULL */
    bool (*judge)(struct fixture *f); /* judges the last frame; may be NULL; adds to f->said */
    int n;                            /* a number that the scene's functions interpret */
    double value;                     /* the same */
    double mu;
};

/* Each array ends with a scene without a name. */
extern const struct fixture_scene fixture_stacks[], fixture_links[], fixture_arches[],
    fixture_cards[], fixture_movers[], fixture_contacts[];

struct fixture_mesh {
    struct carom_mesh mesh;
    struct oracle_mesh solid;
    struct oracle_body weight; /* mass and inertia at density 1 */
    double centre[3];          /* centre of mass in the mesh's coordinates */
    double radius, skin;
    int16_t (*vertices)[3];
    uint16_t (*faces)[3];
    void *block;
};

struct fixture_body {
    struct carom_body_def def;
    int mesh;
    double mass; /* 0: stationary */
    struct oracle_body first, before, now;
    struct oracle_pose pose;
    double low[3], high[3]; /* its present box */
    long still;             /* frames in a row in which it has stood still */
};

struct fixture_tally {
    long frames;
    long cut;          /* frames that the engine cut short */
    long cut_first;    /* the first of them */
    long crossed;      /* frames with faces that cross */
    int crossed_first; /* the first of these frames */
    int crossed_pair[2];
    double depth;     /* the deepest crossing, in skins of the smaller body */
    long still;       /* the longest run of frames in which a body stood still though it had to
                       * move */
    long still_first; /* frame in which that run begins */
    int still_body;
    double energy_first, rise; /* rise: above the energy at the start, in m g skin of all bodies */
    double worst_ms, total_ms; /* processor time of the slowest step and of all */
};

struct fixture {
    const struct fixture_scene *scene;
    struct carom_config config;
    struct carom_world *world;
    void *block;
    struct fixture_mesh meshes[FIXTURE_BODIES];
    int mesh_count;
    struct fixture_body bodies[FIXTURE_BODIES];
    int body_count;
    struct fixture_shape shape; /* for making meshes */
    double mark[8];             /* for the scene's own use */
    struct fixture_tally tally;
    int error; /* error of a step; 0: none */
    bool late; /* stopped because it took too long */
    bool passed;
    char said[400];
};

struct fixture *fixture_new(const struct fixture_scene *scene);
/* The same in parts, for who makes the bodies: a fixture without any; its world. */
struct fixture *fixture_begin(const struct fixture_scene *scene);
void fixture_start(struct fixture *f);
void fixture_free(struct fixture *f);
/* Step and judge. `talk` prints a line for each frame. 0 seconds: no limit of time. */
void fixture_run(struct fixture *f, int frames, double seconds, bool talk);
/* Add to the remarks about the scene. */
void fixture_say(struct fixture *f, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* ---------------------------------------------------------------- for scenes */

/* A mesh of f->shape, rounded to the finest quanta that hold it. */
int fixture_mesh(struct fixture *f);
/* The gap at which a body of this mesh rests on something stationary. */
double fixture_skin(const struct fixture *f, int mesh);
/* Add a body whose mesh's origin is at a point, turned about that point. Returns its number. */
int fixture_body(struct fixture *f, int mesh, double x, double y, double z, carom_quat_q30 turn);
int fixture_fixed(struct fixture *f, int mesh, double x, double y, double z, carom_quat_q30 turn);
/* A plane at z = 0. */
int fixture_plane(struct fixture *f);
extern const carom_quat_q30 fixture_upright;
/*
 * A half circle of stones on its feet, the radius to the middle of its thickness. The margin of the best line of thrust, a part
 * of half the thickness; below 0 it cannot stand.
 */
void fixture_arch(struct fixture *f, int stones, double radius, double thick);
double fixture_arch_margin(int stones, double radius, double thick);
/* The rotation by `first`, then by `second`. */
carom_quat_q30 fixture_compose(carom_quat_q30 second, carom_quat_q30 first);
void fixture_weigh(struct fixture *f, int body, double mass);
/* Set a body's motion in units a second and radians a second. */
void fixture_throw(struct fixture *f, int body, const double velocity[3], const double spin[3]);

/* ----------------------------------------------------------------- for judges */

/* A point of a mesh in the world, now. */
void fixture_point(const struct fixture *f, int body, const double local[3], double out[3]);
/* Distance of a body's centre from its first place; the largest of all bodies. */
double fixture_drift(const struct fixture *f, int body);
double fixture_farthest(const struct fixture *f);
/* The angle between an axis of a body now and at first, radians. */
double fixture_tilt(const struct fixture *f, int body, int axis);
/* The speed of a body's fastest point, units a second; the greatest of all. */
double fixture_speed(const struct fixture *f, int body);
double fixture_fastest(const struct fixture *f);

#endif

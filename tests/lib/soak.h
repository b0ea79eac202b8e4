/* SPDX-License-Identifier: MIT */
/*
 * soak - random worlds by number, and the rules that must hold in each of their frames, seen
 * through the public interface. The same number gives the same world on every machine.
 */
#ifndef CAROM_TESTS_SOAK_H
#define CAROM_TESTS_SOAK_H

#include "crowd.h"
#include "soak_machine.h"
#include "soak_shapes.h"

/* --------------------------------------------------------------------- worlds */

#define SOAK_BODIES   24 /* most moving bodies */
#define SOAK_OBSTACLE 8  /* most stationary bodies */

enum soak_ground { SOAK_NONE, SOAK_PLANE, SOAK_FIELD, SOAK_OBSTACLES, SOAK_ROOM, SOAK_GROUNDS };
extern const char *const soak_ground_names[SOAK_GROUNDS];
enum soak_pace { SOAK_AT_REST, SOAK_SLOW, SOAK_ANY_SPEED, SOAK_FAST, SOAK_PACES };
extern const char *const soak_pace_names[SOAK_PACES];

struct soak_world {
    uint64_t seed;
    struct crowd *crowd;
    struct soak_shape shapes[SOAK_BODIES + SOAK_OBSTACLE];
    enum soak_kind kinds[CROWD_BODIES]; /* kinds of the bodies' shapes */
    enum soak_ground ground;
    enum soak_pace pace;
    int moving;       /* moving bodies, which are the last ones */
    double gravity;   /* magnitude of gravity */
    double centre[3]; /* middle of the place of bodies */
    bool under;       /* made by soak_make_under */
    /* rotation of a room; distance from its middle to its walls; largest error of a wall */
    double room[4], room_half, room_slack;
    /* mass is 2^-halvings, when all masses are powers of two; then momentum_of is exact */
    int halvings[CROWD_BODIES];
    bool left[CROWD_BODIES];      /* bodies that may have left their room */
    bool exact;                   /* no gravity, no ground, and all masses powers of two */
    int drawn_again;              /* meshes that carom_mesh_check refused and others replaced */
    struct soak_machine *machine; /* NULL: bodies alone; and the observations of the machine */
    struct soak_seen *seen;
};

/*
 * Make a random world; soak_machine_make turns it into a machine. Its bodies are apart by more than
 * two skins, and none is inside another. soak_make_under makes one in which all bodies begin around a
 * surface and move to the space under it.
 */
void soak_make(struct soak_world *world, uint64_t seed);
void soak_make_under(struct soak_world *world, uint64_t seed);
/*
 * Whether a body that has not started yet is clear of all others and within its room. `but`: of all
 * except this one, or the body itself.
 */
bool soak_is_clear(const struct soak_world *world, int body, int but);
void soak_free(struct soak_world *world);

/* ---------------------------------------------------------------------- watch */

/*
 * A body stands still in time if it is awake, has a speed well above a solve's remainder, and stays
 * in its place. `run` counts such frames in a row, by body.
 */
struct soak_still {
    int run[CROWD_BODIES];
    int longest, body; /* the longest run, and its body */
    long frame;        /* the frame at the end of that run */
};
#define SOAK_STILL_ALLOWED 3
/* Call after each frame of the crowd; `frame` is its number. */
void soak_watch_still(const struct crowd *crowd, struct soak_still *still, long frame);

/* Processor time of this process, seconds. */
double soak_seconds(void);

/* The results of a world. */
struct soak_result {
    struct crowd_tally tally;
    struct soak_still still;
    int status; /* result of the last step */
    int error;  /* the first error that a call returned, or CAROM_OK */
    long error_frame;
    bool unfinished;           /* it took too long and was stopped */
    long cut_run, cut_longest; /* frames in a row that were cut short */
    long escaped_frame;        /* the first frame in which a body was outside of its room, 0:
                                * none */
    int escaped;
    int64_t momentum[3]; /* momentum of all bodies in range, if it is watched */
    long momentum_frame; /* the first frame that changed the sum of all momenta, 0: none */
    double step_seconds; /* time of the slowest step */
    long step_frame;
    double seconds;                /* time of all steps */
    uint32_t candidates, substeps; /* the largest numbers of a frame */
    uint32_t faces;                /* faces of all bodies */
    uint32_t fullest;              /* percent of the pool that was most full */
    const struct soak_seen *seen;  /* observations of a machine, until soak_free; otherwise NULL */
};

enum soak_fault {
    SOAK_CROSSES,
    SOAK_ERROR,
    SOAK_STANDS_STILL,
    SOAK_CUT, /* more than 1 % of all worlds' frames were cut short: not a fault of one world */
    SOAK_ENERGY,
    SOAK_MOMENTUM,
    SOAK_SLOW_STEP,
    SOAK_MUCH_WORK,
    /* faults of machines */
    SOAK_JOINT,  /* a joint of an untouched group was off by more than allowed */
    SOAK_SENSOR, /* events and an overlap disagree */
    SOAK_OTHER,  /* a second run had another hash */
    SOAK_FAULTS
};
extern const char *const soak_fault_names[SOAK_FAULTS];
#define SOAK_STEP_SECONDS 0.2
#define SOAK_APART        8    /* skins, for untouched joints */
#define SOAK_GAINED       1e-3 /* part of a group's energy */
#define SOAK_AXES         0.01 /* radians */
#define SOAK_CANDIDATES   1024 /* candidates of a step for each face of the world */
bool soak_has(const struct soak_result *result, enum soak_fault fault);

/* Start the world, and look at it before the first frame; false on an error. */
bool soak_start(struct soak_world *world, struct soak_result *result);
/* One frame, watched; false when the world has ended. */
bool soak_step(struct soak_world *world, struct soak_result *result);

#endif

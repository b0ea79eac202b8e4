/* SPDX-License-Identifier: MIT */
/* The checks of every frame of a random world. */
#include <math.h>
#include <string.h>
#include <time.h>

#include "real.h"
#include "soak.h"

#define WORLD_SECONDS 60 /* a world whose steps take longer is stopped */

const char *const soak_fault_names[SOAK_FAULTS] = {
    "crosses",   "error",     "stands still", "cut short", "energy",    "momentum",
    "slow step", "much work", "joint",        "sensor",    "other hash"};

double soak_seconds(void)
{
    return (double)clock() / (double)CLOCKS_PER_SEC;
}

/* --------------------------------------------------------------- standing still */

static int64_t larger(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/*
 * A bound on the motion of any point of a body in the frame; also returns the largest change of a
 * number of its pose.
 */
static double way_of(const struct crowd *crowd, const struct crowd_body *body, int64_t *places)
{
    const struct carom_body_state *from = &body->before.state, *to = &body->now.state;
    double away[3], turn[2] = {0, 0};
    int64_t last[2] = {0, 0};

    *places = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = to->position.c[k] - from->position.c[k];

        away[k] = real(d, 32);
        *places = larger(*places, d < 0 ? -d : d);
    }
    /* q and -q are one rotation */
    for (int sign = 0; sign < 2; sign++) {
        for (int k = 0; k < 4; k++) {
            int64_t d = (int64_t)to->rotation.c[k] - (sign ? -1 : 1) * (int64_t)from->rotation.c[k];

            turn[sign] += real(d, 30) * real(d, 30);
            last[sign] = larger(last[sign], d < 0 ? -d : d);
        }
    }
    *places = larger(*places, last[turn[1] < turn[0]]);
    return real_length(away) +
           2 * real_sqrt(fmin(turn[0], turn[1])) * crowd->meshes[body->mesh].radius;
}

static double speed_of(const struct crowd *crowd, const struct crowd_body *body,
                       const struct crowd_seen *seen)
{
    return real_length(seen->body.velocity) +
           crowd->meshes[body->mesh].radius * real_length(seen->body.spin);
}

/*
 * A body at rest is slower than an eighth of what gravity gives in a frame, and so is the state
 * after a frame of a body that has stopped. A body that is faster at both ends of a frame has not
 * moved when no number of its pose changed by more than 2. If it is also faster than a skin in 16
 * frames, it has not moved when it went less than a thousandth of its speed and of a skin.
 */
static bool stands_still(const struct crowd *crowd, int i)
{
    const struct crowd_body *body = &crowd->bodies[i];
    double gravity[3], slow, speed, way, skin = crowd->meshes[body->mesh].skin;
    int64_t places;

    if (body->def.stationary || body->def.kinematic || body->now.state.asleep ||
        body->now.state.out || body->before.state.asleep) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        gravity[k] = real(crowd->config.gravity.c[k], 40);
    }
    /* a body at a joint's limit keeps the speed that gravity gives in half of a frame */
    slow = real_length(gravity) / (body->linked ? 1 : 8) + 0x1p-22;
    /* the last places of its angular momentum spin a needle about its axis */
    slow += 2 * 0x1p-40 * crowd->meshes[body->mesh].radius /
            (body->mass * crowd_least_inertia(body->now.body.inertia));
    speed = fmin(speed_of(crowd, body, &body->before), speed_of(crowd, body, &body->now));
    way = way_of(crowd, body, &places);
    return (speed > slow && places <= 2) ||
           (speed > slow + skin / 16 && way < speed / 1024 && way < skin / 1024);
}

void soak_watch_still(const struct crowd *crowd, struct soak_still *still, long frame)
{
    for (int i = 0; i < crowd->body_count; i++) {
        still->run[i] = stands_still(crowd, i) ? still->run[i] + 1 : 0;
        if (still->run[i] > still->longest) {
            still->longest = still->run[i];
            still->body = i;
            still->frame = frame;
        }
    }
}

/* -------------------------------------------------------------------- momentum */

/*
 * The sum of all momenta, in units of the last place. The interface reports velocities: p / m is
 * exact for a mass of 2^-n, so p is the velocity shifted back, without a remainder. False when
 * there is one.
 */
static bool momentum_of(const struct soak_world *w, int64_t sum[3])
{
    bool exact = true;

    memset(sum, 0, 3 * sizeof *sum);
    for (int i = 0; i < w->crowd->body_count; i++) {
        const struct carom_body_state *state = &w->crowd->bodies[i].now.state;

        for (int k = 0; k < 3 && !state->out; k++) {
            int64_t unit = (int64_t)1 << w->halvings[i];

            exact = exact && state->velocity.c[k] % unit == 0;
            sum[k] += state->velocity.c[k] / unit;
        }
    }
    return exact;
}

static void watch_momentum(struct soak_world *w, struct soak_result *r, long out_before)
{
    int64_t sum[3];
    bool kept = momentum_of(w, sum);

    if (r->tally.out == out_before) {
        kept = kept && memcmp(sum, r->momentum, sizeof sum) == 0;
        if (!kept && r->momentum_frame == 0) {
            r->momentum_frame = r->tally.frames;
        }
    }
    memcpy(r->momentum, sum, sizeof sum);
}

/* ------------------------------------------------------------------------ rooms */

/* Whether a body is led, or goes through walls: these are the bodies before the others. */
static bool may_leave(const struct soak_world *w, int body)
{
    const struct carom_body_def *def = &w->crowd->bodies[body].def;
    bool leaves = def->stationary || def->kinematic;

    for (int wall = 0; wall < w->crowd->body_count - w->moving; wall++) {
        leaves |= w->crowd->pass[body][wall] != CROWD_MEET;
    }
    return leaves || w->left[body];
}

/* The centre of mass of all bodies in a room must be in the room as well. */
static void watch_room(struct soak_world *w, struct soak_result *r)
{
    double m[3][3];

    real_matrix(m, w->room);
    for (int i = 0; i < w->crowd->body_count; i++) {
        const struct crowd_body *body = &w->crowd->bodies[i];
        double away[3], seen[3];

        w->left[i] = may_leave(w, i);
        for (int k = 0; k < 3; k++) {
            away[k] = body->now.body.position[k] - w->centre[k];
        }
        real_rotate_back(seen, m, away);
        for (int k = 0; k < 3; k++) {
            if (!w->left[i] && !body->now.state.out &&
                fabs(seen[k]) > w->room_half + w->room_slack && r->escaped_frame == 0) {
                r->escaped_frame = r->tally.frames;
                r->escaped = i;
            }
        }
    }
}

/* ------------------------------------------------------------------------ steps */

bool soak_start(struct soak_world *w, struct soak_result *r)
{
    memset(r, 0, sizeof *r);
    r->seen = w->seen;
    r->error = crowd_start(w->crowd);
    if (r->error >= 0 && w->machine) {
        r->error = soak_machine_start(w);
    }
    if (r->error < 0) {
        return false;
    }
    for (int i = 0; i < w->crowd->body_count; i++) {
        r->faces += w->crowd->bodies[i].def.mesh->raw.face_count;
    }
    crowd_watch_crossings(w->crowd, &r->tally);
    momentum_of(w, r->momentum);
    return true;
}

static void watch_costs(struct soak_world *w, struct soak_result *r, double seconds)
{
    struct carom_stats stats;
    struct carom_usage usage[CAROM_POOL_COUNT];

    r->seconds += seconds;
    if (seconds > r->step_seconds) {
        r->step_seconds = seconds;
        r->step_frame = r->tally.frames + 1;
    }
    lab_expect(carom_stats(w->crowd->world, &stats), "stats");
    lab_expect(carom_usage(w->crowd->world, usage), "usage");
    r->candidates = stats.candidates > r->candidates ? stats.candidates : r->candidates;
    r->substeps = stats.substeps > r->substeps ? stats.substeps : r->substeps;
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        if (i != CAROM_POOL_bodies && i != CAROM_POOL_candidates && usage[i].size > 0) {
            uint32_t full = (uint32_t)(100ull * usage[i].peak / usage[i].size);

            r->fullest = full > r->fullest ? full : r->fullest;
        }
    }
}

/* A step, with the calls before it. */
static int act_and_step(struct soak_world *w, struct soak_result *r)
{
    double start;
    int status = CAROM_OK;

    if (w->machine) {
        status = soak_machine_act(w, r->tally.frames + 1);
        soak_machine_before(w);
    }
    start = soak_seconds();
    if (status >= 0) {
        status = carom_world_step(w->crowd->world);
    }
    watch_costs(w, r, soak_seconds() - start);
    return status;
}

/* Check a machine after the crowd was watched. */
static void watch_machine(struct soak_world *w, struct soak_result *r)
{
    soak_machine_watch(w, r->tally.frames);
    w->seen->hashes[r->tally.frames] = carom_world_hash(w->crowd->world);
    if (r->tally.frames == SOAK_FRAMES / 2) {
        soak_machine_half(w);
    }
    if (r->tally.frames == SOAK_FRAMES) {
        soak_machine_again(w);
    }
}

bool soak_step(struct soak_world *w, struct soak_result *r)
{
    long out = r->tally.out;
    int status = act_and_step(w, r);

    r->status = status;
    if (status < 0) {
        r->error = status;
        r->error_frame = r->tally.frames + 1;
        return false;
    }
    if (w->machine) {
        soak_machine_see(w);
    }
    crowd_watch(w->crowd, status, &r->tally);
    soak_watch_still(w->crowd, &r->still, r->tally.frames);
    r->cut_run = status & CAROM_SUBSTEP_CAP ? r->cut_run + 1 : 0;
    r->cut_longest = r->cut_run > r->cut_longest ? r->cut_run : r->cut_longest;
    if (w->exact) {
        watch_momentum(w, r, out);
    }
    if (w->ground == SOAK_ROOM) {
        watch_room(w, r);
    }
    if (w->machine) {
        watch_machine(w, r);
    }
    r->unfinished = r->tally.frames < SOAK_FRAMES && r->seconds > WORLD_SECONDS;
    return r->tally.frames < SOAK_FRAMES && !r->unfinished;
}

bool soak_has(const struct soak_result *r, enum soak_fault fault)
{
    switch (fault) {
    case SOAK_CROSSES:
        return r->tally.crossed > 0 || r->tally.inside > 0 || r->escaped_frame > 0;
    case SOAK_ERROR:
        return r->error < 0;
    case SOAK_STANDS_STILL:
        return r->still.longest > SOAK_STILL_ALLOWED;
    case SOAK_CUT:
        return 100 * r->tally.capped > r->tally.frames;
    case SOAK_ENERGY:
        return r->tally.rise > 1 || r->tally.gained > SOAK_GAINED;
    case SOAK_MOMENTUM:
        return r->momentum_frame > 0;
    case SOAK_MUCH_WORK:
        return r->candidates > SOAK_CANDIDATES * r->faces;
    case SOAK_JOINT:
        return r->seen && (fmax(r->seen->free.apart, r->seen->free.beyond) > SOAK_APART ||
                           fmax(r->seen->free.axes, r->seen->free.bent) > SOAK_AXES);
    case SOAK_SENSOR:
        return r->seen && r->seen->sensor_frame > 0;
    case SOAK_OTHER:
        return r->seen && r->seen->other_frame > 0;
    default:
        return r->step_seconds > SOAK_STEP_SECONDS || r->unfinished;
    }
}

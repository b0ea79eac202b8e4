/* SPDX-License-Identifier: MIT */
/*
 * host_wake - waking and falling asleep again. A floor carries two stacks, one of them on a shelf,
 * and two single bodies, all asleep. Then something happens to one body. The bodies that it touches
 * wake, as a whole island and in the same step; bodies elsewhere do not, and in the end everything
 * sleeps.
 */
#include <stdlib.h>
#include <string.h>

#include "lib/crowd.h"

#define SETTLE    400 /* frames */
#define SNAPSHOT  65536
#define G         (9.81 / 3600)
#define ALL       (STACK | ON_SHELF | BIT(SINGLE) | BIT(BALL))
#define STACK     (BIT(LOW) | BIT(MIDDLE) | BIT(TOP))
#define ON_SHELF  (BIT(SHELF_LOW) | BIT(SHELF_TOP))
#define BIT(body) (1u << (body))

/* The bodies, in the order in which they are added. */
enum { FLOOR, SHELF, LOW, MIDDLE, TOP, SHELF_LOW, SHELF_TOP, SINGLE, BALL, BODIES };

static uint8_t settled[SNAPSHOT];
static size_t settled_bytes;

/* The events of one step; bodies as bits. */
struct told {
    uint32_t woke, rested;
    bool hit, repeated; /* a HIT event; an event of waking or rest for one body came twice */
};

/* --------------------------------------------------------------------- scene */

static void put(struct crowd *crowd, int mesh, double x, double z)
{
    crowd_place(crowd_body(crowd, mesh), x, 0, z);
}

/*
 * Boxes of 1 x 0.8 x 0.4, each a thousandth of a unit above the other; SINGLE and BALL slide
 * without friction.
 */
static struct crowd *make(void)
{
    struct crowd *crowd = crowd_new();
    int box = crowd_box(crowd, 1, 0.8, 0.4), ball = crowd_ball(crowd, 0.25);

    put(crowd, crowd_mesh(crowd, &lab_sheet), 0, 0);
    crowd_body(crowd, crowd_box(crowd, 2, 2, 0.5))->stationary = true;
    crowd_place(&crowd->bodies[SHELF].def, 6, 0, 2);
    for (int i = 0; i < 3; i++) {
        put(crowd, box, 0.01 * i, 0.201 + 0.401 * i);
    }
    for (int i = 0; i < 2; i++) {
        put(crowd, box, 6, 2.451 + 0.401 * i);
    }
    put(crowd, box, -6, 0.201);
    put(crowd, ball, -12, 0.3);
    crowd->bodies[SINGLE].def.friction_q16 = crowd->bodies[BALL].def.friction_q16 = 0;
    lab_expect(crowd_start(crowd), "start");
    return crowd;
}

/* The same crowd, asleep; it is loaded from a snapshot. */
static struct crowd *asleep(void)
{
    struct crowd *crowd = make();

    lab_expect(carom_snapshot_load(crowd->world, settled, settled_bytes), "load");
    crowd_look(crowd);
    return crowd;
}

/* Which bodies sleep. */
static uint32_t sleepers(const struct carom_world *world, int bodies)
{
    uint32_t set = 0;

    for (int i = 0; i < bodies; i++) {
        struct carom_body_state state;

        if (carom_body_get(world, i, &state) == CAROM_OK && state.asleep) {
            set |= BIT(i);
        }
    }
    return set;
}

static struct told listen(const struct carom_world *world)
{
    const struct carom_event *events;
    struct told told = {0};
    int n = carom_events(world, &events);

    for (int i = 0; i < n; i++) {
        uint32_t bit = BIT(events[i].a);
        uint32_t *set = events[i].kind == CAROM_EVENT_WAKE   ? &told.woke
                        : events[i].kind == CAROM_EVENT_REST ? &told.rested
                                                             : NULL;

        told.hit = told.hit || events[i].kind == CAROM_EVENT_HIT;
        if (set) {
            told.repeated = told.repeated || (*set & bit);
            *set |= bit;
        }
    }
    return told;
}

/* One frame. A crowd that lost a body cannot be watched. */
static struct told step(struct crowd *crowd, struct crowd_tally *tally)
{
    lab_expect(tally ? crowd_step(crowd, tally) : carom_world_step(crowd->world), "step");
    return listen(crowd->world);
}

/* The events of a run until all of `bodies` sleep. frames is 0 when they never did. */
struct run {
    int frames;
    uint32_t woke, rested;
    bool repeated, constant; /* the state stays as it is once all sleep */
};

static struct run run_to_sleep(struct crowd *crowd, uint32_t bodies, struct crowd_tally *tally)
{
    struct run run = {0};

    for (int frame = 1; frame <= SETTLE; frame++) {
        struct told told = step(crowd, tally);

        run.repeated = run.repeated || told.repeated || (run.woke & told.woke & ~run.rested);
        run.woke |= told.woke;
        run.rested |= told.rested;
        if ((sleepers(crowd->world, BODIES + 1) & bodies) == bodies) {
            uint64_t hash = carom_world_hash(crowd->world);

            run.frames = frame;
            step(crowd, tally);
            run.constant = carom_world_hash(crowd->world) == hash;
            break;
        }
    }
    return run;
}

/* Whether a run ended well: all asleep, after 20 frames, each reported once, nothing crossed. */
static bool ended(const struct run *run, uint32_t rested, const struct crowd_tally *tally)
{
    return run->frames >= 20 && run->rested == rested && !run->repeated && run->constant &&
           (!tally || tally->crossed == 0);
}

static void test_settle(void)
{
    struct crowd *crowd = make();
    struct crowd_tally tally = {0};
    struct run run = run_to_sleep(crowd, ALL, &tally);

    settled_bytes =
        (size_t)lab_expect(carom_snapshot_save(crowd->world, settled, sizeof settled), "save");
    lab_report(ended(&run, ALL, &tally) && run.woke == 0, "wake/settle",
               "all asleep after %d frames, %ld frames cross, %ld capped", run.frames,
               tally.crossed, tally.capped);
    crowd_free(crowd);
}

/* ---------------------------------------------------------------------- hits */

static double along_x(const struct crowd *crowd)
{
    return crowd->bodies[SINGLE].now.momentum[0] + crowd->bodies[BALL].now.momentum[0];
}

static void launch(struct crowd *crowd, double x, double z, double vx, double vz)
{
    struct carom_body_state state = lab_state(crowd->world, BALL);

    state.position.c[0] = lab_fixed(x, 32);
    state.position.c[1] = 0;
    state.position.c[2] = lab_fixed(z, 32);
    state.rotation = (carom_quat_q30){{0, 0, 0, 0}};
    memset(&state.spin, 0, sizeof state.spin);
    memset(&state.velocity, 0, sizeof state.velocity);
    state.velocity.c[0] = lab_fixed(vx, 40);
    state.velocity.c[2] = lab_fixed(vz, 40);
    state.overlap =
        CAROM_OVERLAP_PASS; /* the ball is lower in the ground than the middle of a box */
    lab_expect(carom_body_set(crowd->world, BALL, &state), "launch");
    crowd_look(crowd);
}

/*
 * A ball flies level into the middle of a sleeping box. In the step of the hit the box wakes and
 * gets its share: momentum along x stays, and the speeds part as e says, v_box = (1 + e) v m_ball /
 * (m_ball + m_box). The facet of the ball at the end of its x axis and the box's side are
 * perpendicular to the motion, so only the fall of the ball makes anything turn.
 */
static void test_hit(void)
{
    const double v = 0.25;
    struct crowd *crowd = asleep();
    struct crowd_tally tally = {0};
    double before, ratio, speed = 0, change = 1;
    struct told told = {0};
    struct run run;
    bool alone;

    launch(crowd, -9, 0.205, v, 0);
    alone = sleepers(crowd->world, BODIES) == (ALL & ~BIT(BALL));
    before = along_x(crowd);
    for (int frame = 0; frame < 30 && !told.hit; frame++) {
        alone = alone && (sleepers(crowd->world, BODIES) & BIT(SINGLE));
        told = step(crowd, &tally);
        if (told.hit) {
            speed = crowd->bodies[SINGLE].now.body.velocity[0];
            change = along_x(crowd) / before - 1;
        }
    }
    ratio = speed * (crowd->bodies[BALL].mass + crowd->bodies[SINGLE].mass) /
            (1.5 * v * crowd->bodies[BALL].mass);
    alone =
        alone && told.woke == BIT(SINGLE) && sleepers(crowd->world, BODIES) == (STACK | ON_SHELF);
    lab_report(alone && change < 1e-9 && change > -1e-9 && ratio > 0.99 && ratio < 1.01, "wake/hit",
               "momentum within %.1e, speed of the box %.4f of the formula", change, ratio);
    crowd_free(crowd);

    /* from above onto a stack: the whole stack wakes */
    crowd = asleep();
    tally = (struct crowd_tally){0};
    launch(crowd, 0.1, 3, 0, -0.1);
    told = (struct told){0};
    for (int frame = 0; frame < 60 && !told.hit; frame++) {
        told = step(crowd, &tally);
    }
    alone = told.woke == STACK && sleepers(crowd->world, BODIES) == (ON_SHELF | BIT(SINGLE));
    run = run_to_sleep(crowd, ALL & ~BIT(BALL), &tally);
    lab_report(alone && run.frames >= 19 && tally.crossed == 0, "wake/hit_stack",
               "asleep again after %d frames, %ld frames cross", run.frames, tally.crossed);
    crowd_free(crowd);
}

/* Five boxes in a row with gaps: each wakes when the one before reaches it. */
static void test_row(void)
{
    struct crowd *crowd = crowd_new();
    struct crowd_tally tally = {0};
    int box = crowd_box(crowd, 0.5, 0.8, 0.4), woke_at[5] = {0};
    struct carom_body_state state;
    bool ordered = true;

    put(crowd, crowd_mesh(crowd, &lab_sheet), 0, 0);
    for (int i = 0; i < 5; i++) {
        put(crowd, box, i, 0.201);
    }
    crowd_surface(crowd, 1, 0);
    /* bodies that bounce for ever on the floor would not fall asleep on it */
    crowd->bodies[0].def.restitution_q30 = 0;
    lab_expect(crowd_start(crowd), "start");
    for (int frame = 0; frame < SETTLE && sleepers(crowd->world, 6) != 0x3e; frame++) {
        step(crowd, &tally);
    }
    state = lab_state(crowd->world, 1);
    state.velocity.c[0] = lab_fixed(0.1, 40);
    lab_expect(carom_body_set(crowd->world, 1, &state), "push");
    crowd_look(crowd);
    for (int frame = 1; frame <= 60; frame++) {
        struct told told = step(crowd, &tally);

        for (int i = 0; i < 5; i++) {
            if (told.woke & BIT(i + 1)) {
                ordered = ordered && woke_at[i] == 0;
                woke_at[i] = frame;
            }
        }
    }
    /* half a unit of gap at a tenth a frame, for each box in turn */
    for (int i = 0; i < 5; i++) {
        ordered = ordered && woke_at[i] >= 1 + 5 * i - 1 && woke_at[i] <= 1 + 5 * i + 1;
    }
    lab_report(ordered && tally.crossed == 0, "wake/row",
               "woke in frames %d %d %d %d %d, %ld frames cross", woke_at[0], woke_at[1],
               woke_at[2], woke_at[3], woke_at[4], tally.crossed);
    crowd_free(crowd);
}

/* ------------------------------------------------------------------- supports */

static double height(const struct crowd *crowd, int body)
{
    return lab_double(lab_state(crowd->world, body).position.c[2], 32);
}

/* A shelf moves down by one unit, or is removed, and the bodies on it follow. */
static void test_support(void)
{
    for (int removed = 0; removed < 2; removed++) {
        struct crowd *crowd = asleep();
        struct crowd_tally tally = {0};
        double low = height(crowd, SHELF_LOW), top = height(crowd, SHELF_TOP);
        double down = removed ? 2.25 : 1;
        uint32_t left;
        struct run run;

        if (removed) {
            lab_expect(carom_body_remove(crowd->world, SHELF), "remove");
        } else {
            struct carom_body_state state = lab_state(crowd->world, SHELF);

            state.position.c[2] -= (int64_t)1 << 32;
            lab_expect(carom_body_set(crowd->world, SHELF, &state), "set");
            crowd_look(crowd);
        }
        left = sleepers(crowd->world, BODIES);
        run = run_to_sleep(crowd, ALL, removed ? NULL : &tally);
        low -= height(crowd, SHELF_LOW) + down;
        top -= height(crowd, SHELF_TOP) + down;
        lab_report(left == (ALL & ~ON_SHELF) && run.woke == ON_SHELF &&
                       ended(&run, ON_SHELF, &tally) && low * low < 1e-6 && top * top < 1e-6,
                   removed ? "wake/support_removed" : "wake/support_moved",
                   "asleep again after %d frames, off by %.1e and %.1e", run.frames, low, top);
        crowd_free(crowd);
    }
}

/* The box in the middle of a stack is removed, or moved to another place. */
static void test_member(void)
{
    for (int removed = 0; removed < 2; removed++) {
        struct crowd *crowd = asleep();
        struct crowd_tally tally = {0};
        double top = height(crowd, TOP);
        const uint32_t moves = removed ? BIT(LOW) | BIT(TOP) : STACK;
        uint32_t left;
        struct run run;

        if (removed) {
            lab_expect(carom_body_remove(crowd->world, MIDDLE), "remove");
        } else {
            struct carom_body_state state = lab_state(crowd->world, MIDDLE);

            state.position.c[0] = lab_fixed(-3, 32);
            state.position.c[2] = lab_fixed(0.201, 32);
            lab_expect(carom_body_set(crowd->world, MIDDLE, &state), "set");
            crowd_look(crowd);
        }
        left = sleepers(crowd->world, BODIES);
        run = run_to_sleep(crowd, removed ? ALL & ~BIT(MIDDLE) : ALL, removed ? NULL : &tally);
        top -= height(crowd, TOP) + 0.4;
        lab_report(left == (ALL & ~STACK) && run.woke == moves && ended(&run, moves, &tally) &&
                       top * top < 1e-6,
                   removed ? "wake/member_removed" : "wake/member_set",
                   "asleep again after %d frames, off by %.1e", run.frames, top);
        crowd_free(crowd);
    }
}

/*
 * A body that is added wakes the bodies that it is put against, and none when it is put elsewhere.
 */
static void test_added(void)
{
    struct crowd *crowd = asleep();
    struct carom_body_def def = crowd->bodies[LOW].def;
    bool ok;

    crowd_place(&def, 3, 0, 5);
    lab_expect(carom_body_add(crowd->world, &def), "add");
    ok = sleepers(crowd->world, BODIES) == ALL;
    ok = ok && step(crowd, NULL).woke == 0;
    crowd_place(&def, 1.0005, 0, 0.2);
    def.stationary = true;
    lab_expect(carom_body_add(crowd->world, &def), "add");
    ok = ok && sleepers(crowd->world, BODIES) == (ALL & ~STACK);
    ok = ok && step(crowd, NULL).woke == STACK;
    lab_report(ok, "wake/added", "sleepers %x of %x", sleepers(crowd->world, BODIES), ALL);
    crowd_free(crowd);
}

/* -------------------------------------------------------------------- forces */

static void test_force(void)
{
    struct crowd *crowd = asleep();
    struct crowd_tally tally = {0};
    const double weight = crowd->bodies[TOP].mass * G;
    carom_v3_q40 force = {{0, 0, lab_fixed(weight / 2, 40)}};
    struct run run;
    bool ok;

    /* a force takes half of the weight off the top box: the stack wakes, and sleeps again */
    lab_expect(carom_body_set_force(crowd->world, TOP, &force), "force");
    ok = sleepers(crowd->world, BODIES) == (ALL & ~STACK);
    run = run_to_sleep(crowd, ALL, &tally);
    ok = ok && run.woke == STACK && ended(&run, STACK, &tally);
    /* setting the same force again is no change */
    lab_expect(carom_body_set_force(crowd->world, TOP, &force), "force");
    ok = ok && sleepers(crowd->world, BODIES) == ALL && step(crowd, &tally).woke == 0;
    /* twice its weight lifts the box: up by g n^2 / 2 in n frames */
    force.c[2] = lab_fixed(weight * 2, 40);
    lab_expect(carom_body_set_force(crowd->world, TOP, &force), "force");
    crowd_look(crowd);
    {
        double from = height(crowd, TOP), way;

        for (int frame = 0; frame < 30; frame++) {
            step(crowd, &tally);
        }
        way = (height(crowd, TOP) - from) / (G * 30 * 30 / 2);
        /* the margin of the contact holds it for a frame at most */
        lab_report(ok && way > 0.9 && way < 1.1 && tally.crossed == 0, "wake/force",
                   "asleep again after %d frames, way up %.4f of g n^2 / 2", run.frames, way);
    }
    crowd_free(crowd);
}

static void test_gravity(void)
{
    struct crowd *crowd = asleep();
    struct crowd_tally tally = {0};
    carom_v3_q40 gravity = crowd->config.gravity;
    struct run run;
    bool ok;

    lab_expect(carom_world_set_gravity(crowd->world, &gravity), "gravity");
    ok = sleepers(crowd->world, BODIES) == ALL && step(crowd, &tally).woke == 0;
    gravity.c[2] /= 2;
    lab_expect(carom_world_set_gravity(crowd->world, &gravity), "gravity");
    ok = ok && sleepers(crowd->world, BODIES) == 0;
    run = run_to_sleep(crowd, ALL, &tally);
    ok = ok && run.woke == ALL && ended(&run, ALL, &tally);
    /* without gravity nothing rests: a push moves a body for ever */
    memset(&gravity, 0, sizeof gravity);
    lab_expect(carom_world_set_gravity(crowd->world, &gravity), "gravity");
    for (int frame = 0; frame < 100; frame++) {
        step(crowd, NULL);
    }
    lab_report(ok && sleepers(crowd->world, BODIES) == 0, "wake/gravity",
               "asleep again after %d frames", run.frames);
    crowd_free(crowd);
}

static void test_push(void)
{
    struct crowd *crowd = asleep();
    struct crowd_tally tally = {0};
    struct carom_body_state state = lab_state(crowd->world, MIDDLE);
    const carom_v3_q40 impulse = {{lab_fixed(0.01, 40), 0, 0}};
    struct run run;
    double v;
    bool ok;

    lab_expect(carom_body_push(crowd->world, MIDDLE, &impulse, &state.position), "push");
    crowd_look(crowd);
    v = crowd->bodies[MIDDLE].now.body.velocity[0] * crowd->bodies[MIDDLE].mass / 0.01 - 1;
    ok = sleepers(crowd->world, BODIES) == (ALL & ~STACK) && v * v < 1e-12;
    run = run_to_sleep(crowd, ALL, &tally);
    ok = ok && run.woke == STACK && ended(&run, STACK, &tally);
    lab_report(ok, "wake/push", "asleep again after %d frames, %ld frames cross", run.frames,
               tally.crossed);
    crowd_free(crowd);
}

/* ------------------------------------------------------------------- snapshot */

/* A world saved asleep wakes in another block as it does here, also with other working pools. */
static void test_snapshot(void)
{
    struct crowd *one = asleep(), *other = make();
    struct crowd_tally tally = {0};
    uint64_t differ = 0;

    other->config.caps.entries = other->config.caps.candidates = 50;
    lab_expect(crowd_start(other), "start");
    for (int frame = 0; frame < 20; frame++) {
        step(other, NULL); /* a different history */
    }
    lab_expect(carom_snapshot_load(other->world, settled, settled_bytes), "load");
    launch(one, 0.1, 3, 0, -0.1);
    launch(other, 0.1, 3, 0, -0.1);
    for (int frame = 0; frame < 200; frame++) {
        step(one, &tally);
        step(other, NULL);
        differ += carom_world_hash(one->world) != carom_world_hash(other->world);
    }
    lab_report(differ == 0 && tally.hits > 0, "wake/snapshot", "%d of 200 frames differ, %ld hits",
               (int)differ, tally.hits);
    crowd_free(one);
    crowd_free(other);
}

int main(void)
{
    test_settle();
    test_hit();
    test_row();
    test_support();
    test_member();
    test_added();
    test_force();
    test_gravity();
    test_push();
    test_snapshot();
    return lab_finish();
}

/* SPDX-License-Identifier: MIT */
/* Machines: the checks of joints and sensors, and a second run. */
#include <stdlib.h>
#include <string.h>

#include "real.h"
#include "soak.h"

#define NEAR 3e-5 /* units: closer bodies may overlap or not */

/* ------------------------------------------------------------------------ events */

void soak_machine_note_breaks(struct soak_world *w)
{
    const struct carom_event *events;
    int n = carom_events(w->crowd->world, &events);

    for (int i = 0; i < n; i++) {
        if (events[i].kind == CAROM_EVENT_BREAK) {
            w->machine->joints[events[i].a].gone = true;
        }
    }
}

static void note_events(struct soak_world *w)
{
    const struct carom_event *events;
    int n = carom_events(w->crowd->world, &events);

    for (int i = 0; i < n; i++) {
        const struct carom_event *e = &events[i];

        w->seen->breaks += e->kind == CAROM_EVENT_BREAK;
        w->seen->blocked += e->kind == CAROM_EVENT_BLOCKED;
        if (e->kind == CAROM_EVENT_SENSOR_BEGIN || e->kind == CAROM_EVENT_SENSOR_END) {
            w->seen->sensed++;
            w->seen->within[e->a][e->b] = e->kind == CAROM_EVENT_SENSOR_BEGIN;
        }
    }
}

/* ------------------------------------------------------------------------ joints */

void soak_machine_before(struct soak_world *w)
{
    bool changed = false;

    for (int i = 0; i < w->machine->joint_count; i++) {
        struct crowd_link *link = &w->seen->links[i];

        changed |= link->there == w->machine->joints[i].gone;
        link->there = !w->machine->joints[i].gone;
        link->stored[0] = soak_joint_energy(w->crowd, &w->machine->joints[i], &link->noise[0]);
    }
    if (changed) {
        crowd_group_links(w->crowd);
    }
}

void soak_machine_see(struct soak_world *w)
{
    note_events(w);
    soak_machine_note_breaks(w);
    soak_machine_let_pass(w);
    for (int i = 0; i < w->machine->joint_count; i++) {
        struct crowd_link *link = &w->seen->links[i];

        link->stored[1] = soak_joint_energy(w->crowd, &w->machine->joints[i], &link->noise[1]);
    }
}

/* Whether anything touched or led the island of a body. */
static bool touched(const struct crowd *crowd, int body)
{
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_body *b = &crowd->bodies[i];

        if (b->island == crowd->bodies[body].island && (b->touching || b->driven)) {
            return true;
        }
    }
    return false;
}

static void watch_joints(struct soak_world *w, long frame)
{
    for (int i = 0; i < w->machine->joint_count; i++) {
        const struct soak_joint *joint = &w->machine->joints[i];
        const struct crowd_body *a = &w->crowd->bodies[joint->def.a];

        if (joint->gone || a->now.state.out ||
            (joint->def.b >= 0 && w->crowd->bodies[joint->def.b].now.state.out)) {
            continue;
        }
        soak_joint_look(w->crowd, joint, i, frame, &w->seen->any);
        if (!touched(w->crowd, joint->def.a)) {
            soak_joint_look(w->crowd, joint, i, frame, &w->seen->free);
        }
    }
}

/* ----------------------------------------------------------------------- sensors */

/*
 * Whether a sensor sees a body: filters allow it, one of the two moves, neither is out, and the
 * body is no sensor.
 */
static bool is_asked(const struct soak_world *w, int sensor, int other)
{
    const struct crowd_body *a = &w->crowd->bodies[sensor], *b = &w->crowd->bodies[other];
    bool moves =
        (!a->def.stationary && !a->def.kinematic) || (!b->def.stationary && !b->def.kinematic);

    return sensor != other && a->def.sensor && !b->def.sensor && moves && !a->now.state.out &&
           !b->now.state.out && soak_machine_may_meet(w, sensor, other);
}

static void watch_sensor(struct soak_world *w, int sensor, int other, long frame)
{
    /* under a surface counts as inside while the boxes meet (SPEC.md, 10) */
    const double gap = crowd_box_gap(w->crowd, sensor, other);
    int is = gap > NEAR ? 0 : gap > -NEAR ? -1 : crowd_overlap_now(w->crowd, sensor, other, NEAR);

    w->seen->sensor_asked++;
    if (is >= 0 && is != w->seen->within[sensor][other] && w->seen->sensor_frame == 0) {
        w->seen->sensor_frame = frame;
        w->seen->sensor = sensor;
        w->seen->visitor = other;
    }
}

void soak_machine_watch(struct soak_world *w, long frame)
{
    watch_joints(w, frame);
    for (int a = 0; a < w->crowd->body_count; a++) {
        for (int b = 0; b < w->crowd->body_count && frame % w->crowd->look_every == 0; b++) {
            if (is_asked(w, a, b)) {
                watch_sensor(w, a, b, frame);
            }
        }
    }
}

/* ------------------------------------------------------------------- a second run */

void soak_machine_half(struct soak_world *w)
{
    struct soak_seen *seen = w->seen;

    seen->snapshot_bytes = carom_snapshot_size(w->crowd->world);
    seen->snapshot = lab_need((size_t)seen->snapshot_bytes);
    carom_snapshot_save(w->crowd->world, seen->snapshot, (size_t)seen->snapshot_bytes);
    seen->half = *w->machine;
}

/* The world again, as it was at the start. */
static bool begin_again(struct soak_world *w)
{
    *w->machine = w->seen->start;
    return crowd_start(w->crowd) >= 0 && soak_machine_start(w) >= 0;
}

/* Play the same frames, unwatched, up to the first after which the hash differs; false then. */
static bool run(struct soak_world *w, long from, long to)
{
    for (long frame = from; frame <= to; frame++) {
        if (soak_machine_act(w, frame) < 0 || carom_world_step(w->crowd->world) < 0 ||
            carom_world_hash(w->crowd->world) != w->seen->hashes[frame]) {
            w->seen->other_frame = frame;
            return false;
        }
        soak_machine_note_breaks(w);
    }
    return true;
}

/*
 * Joints that were removed before halfway are removed before the snapshot is loaded; broken ones
 * stay.
 */
static void take_joints_away(struct soak_world *w)
{
    for (int i = 0; i < w->machine->joint_count; i++) {
        if (w->seen->half.joints[i].removed) {
            (void)carom_joint_remove(w->crowd->world, i);
        }
    }
    *w->machine = w->seen->half;
}

void soak_machine_again(struct soak_world *w)
{
    const long half = SOAK_FRAMES / 2;
    struct soak_seen *seen = w->seen;

    seen->other_frame = 1;
    if (!begin_again(w) || !run(w, 1, half) || !begin_again(w)) {
        return;
    }
    take_joints_away(w);
    seen->other_frame = half;
    seen->refused =
        carom_snapshot_load(w->crowd->world, seen->snapshot, (size_t)seen->snapshot_bytes) < 0;
    if (!seen->refused && carom_world_hash(w->crowd->world) == seen->hashes[half] &&
        run(w, half + 1, SOAK_FRAMES)) {
        seen->other_frame = 0;
    }
}

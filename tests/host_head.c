/* SPDX-License-Identifier: MIT */
/*
 * host_head - the paper's scene, a head of 1876 faces on a field of 3034, for 900 frames, with
 * sleep and without. No faces ever cross, energy never rises, sub-steps stay few, and the head
 * bounces, slides and rests.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/lab.h"

#define FRAMES       900
#define CREEP_FRAMES 120

/* The largest distance that a vertex can have moved between two states of the body. */
static double moved(const struct lab *lab, const struct oracle_body *from,
                    const struct oracle_body *to)
{
    double way = 0, turn = 0;

    for (int k = 0; k < 3; k++) {
        way += pow(to->position[k] - from->position[k], 2);
    }
    for (int k = 0; k < 4; k++) {
        turn += pow(to->quaternion[k] - from->quaternion[k], 2);
    }
    /* a turn by an angle changes the quaternion by half of that angle */
    return sqrt(way) + 2 * sqrt(turn) * lab_double(lab->scene.body.mesh->radius_q22, 22);
}

/* The engine's mass properties against those of lab.c, from which the test computes energies. */
static void test_mass(const struct lab *lab)
{
    const struct carom_mass *mass = &lab->scene.body.mesh->mass;
    double worst = fabs(lab_double(mass->volume_q32, 32) / lab->mass - 1);
    double largest = fmax(lab->inertia[0], fmax(lab->inertia[1], lab->inertia[2]));

    for (int k = 0; k < 3; k++) {
        worst = fmax(worst, fabs(lab_double(mass->centre.c[k], 22) - lab->centre[k]));
    }
    for (int k = 0; k < 6; k++) {
        double engine = ldexp(mass->inertia.m[k], -mass->inertia.e);

        worst = fmax(worst, fabs(engine - lab->inertia[k]) / largest);
    }
    lab_report(worst <= ldexp(1, -21), "head/mass", "off by %.1e at most", worst);
}

static void report(const struct lab_tally *t, const char *run)
{
    char name[64];
#define NAME(what) (snprintf(name, sizeof name, "head/%s_%s", run, what), name)

    lab_report(t->crossed == 0, NAME("no_crossing"), "%ld of %ld frames cross", t->crossed,
               t->frames);
    /*
     * A component of the quaternion is rounded by 2^-31. So four components turn the body by up to
     * 2^-29: once when it turns, and once when the quaternion gets length 1. The largest moment of
     * inertia is 1.9 times the smallest, so with a fixed angular momentum a turn by an angle
     * changes the energy by less than 0.9 times the angle.
     */
    lab_report(t->flight_change <= ldexp(1, -28), NAME("energy_in_flight"),
               "changes by %.1e a frame", t->flight_change);
    lab_report(t->contact_rise <= 0.2, NAME("energy_in_contact"), "rises by %.1e m g skin a frame",
               t->contact_rise);
    lab_report(t->capped == 0 && lab_substeps(t, 0.99) <= 2, NAME("substeps"),
               "p99 %u, most %u, %ld capped", lab_substeps(t, 0.99), lab_substeps(t, 1), t->capped);
    lab_report(t->hits >= 3 && t->begins >= 3 && t->ends >= 2, NAME("bounces"),
               "%ld hits, %ld begins, %ld ends", t->hits, t->begins, t->ends);
    lab_report(t->sliding >= 5, NAME("slides"), "%ld of %ld frames in contact", t->sliding,
               t->touching);
#undef NAME
}

static void test_asleep(void)
{
    struct lab *lab = lab_load_scene("head");
    struct lab_tally tally = {0};
    long slept = 0;
    uint64_t hash = 0;
    bool still = true;

    lab_start(lab);
    test_mass(lab);
    for (long frame = 1; frame <= FRAMES; frame++) {
        lab_step(lab, &tally);
        if (!slept && lab_asleep(lab)) {
            slept = frame;
            hash = carom_world_hash(lab->world);
        }
        still = still && (!slept || hash == carom_world_hash(lab->world));
    }
    report(&tally, "sleep");
    lab_report(slept > 0, "head/sleep_rests", "asleep after %ld frames", slept);
    lab_report(slept > 0 && still, "head/sleep_stays", "the hash stays as it fell asleep");
    lab_free(lab);
}

static void test_awake(void)
{
    struct lab *lab = lab_load_scene("head");
    struct lab_tally tally = {0};
    struct oracle_body before;
    double creep = 0;

    lab->config.sleep = false;
    lab_start(lab);
    for (long frame = 1; frame <= FRAMES; frame++) {
        lab_step(lab, &tally);
        if (frame == FRAMES - CREEP_FRAMES) {
            before = lab_body(lab);
        } else if (frame > FRAMES - CREEP_FRAMES) {
            struct oracle_body now = lab_body(lab);

            creep = fmax(creep, moved(lab, &before, &now));
        }
    }
    report(&tally, "awake");
    lab_report(creep <= 2e-4 && tally.touching > CREEP_FRAMES && !lab_asleep(lab),
               "head/awake_rests", "creeps %.1e in %d frames", creep, CREEP_FRAMES);
    lab_free(lab);
}

int main(void)
{
    test_asleep();
    test_awake();
    return lab_finish();
}

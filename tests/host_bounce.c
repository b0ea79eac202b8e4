/* SPDX-License-Identifier: MIT */
/*
 * host_bounce - boxes on a plane. A body that bounces for ever keeps its energy: a box with three
 * different sides (a cube would hide errors), a tetrahedron and an L. Restitution is Newton's, and
 * an impulse is the change of momentum.
 *
 *   host_bounce.elf        a million frames of the box, 100,000 of the others
 *   host_bounce.elf long   a million frames of all three
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/lab.h"

#define FRAMES      100000
#define FRAMES_LONG 1000000

static const double up[3] = {0, 0, 1};

/* Half the height of the box when it lies flat. */
static double half_height(const struct lab *lab)
{
    double highest = 0;

    for (size_t v = 0; v < lab->body.vertex_count; v++) {
        highest = fmax(highest, lab->body.vertices[v][2]);
    }
    return highest;
}

/* A box above the sheet, with its lowest point `height` above the sheet. */
static struct lab *load_box(double height, double e, double mu)
{
    struct lab *lab = lab_load(&lab_sheet, &lab_box);

    lab->scene.body.position.c[2] = lab_fixed(height + half_height(lab), 32);
    lab->config.sleep = false;
    lab_surface(lab, e, mu);
    return lab;
}

static void tumble(struct lab *lab)
{
    lab->scene.body.rotation = lab_turn(5, 1, 0.3, 1.3);
    lab->scene.body.position.c[2] = lab_fixed(3, 32);
    for (int k = 0; k < 3; k++) {
        const int mrad[3] = {1300, -700, 1100};

        lab->scene.body.spin.c[k] = CAROM_SPIN_MRAD_S(mrad[k], 60);
    }
}

/*
 * Energy over a long bounce stays within 1e-5 of the first frame's in FRAMES frames, and does not
 * drift upwards, however long the run. A hit is off by some 5e-9 either way, which adds up to 1e-6
 * over 30,000 hits. Four times that is chance; a rise of 2e-10 a hit would show.
 */
static void test_energy(const struct carom_mesh_raw *body, long frames, const char *name)
{
    struct lab *lab = lab_load(&lab_sheet, body);
    struct lab_tally tally = {0};
    double within = 0, rise = 0;
    char line[64];

    lab->config.sleep = false;
    lab_surface(lab, 1, 0);
    tumble(lab);
    lab_start(lab);
    while (tally.frames < frames) {
        lab_step(lab, &tally);
        within = tally.frames <= FRAMES ? tally.energy_change : within;
        rise = fmax(rise, tally.energy / tally.energy_first - 1);
    }
    snprintf(line, sizeof line, "bounce/%s_energy", name);
    lab_report(within <= 1e-5 && tally.hits > frames / 100, line,
               "%ld frames, %ld hits; within %.1e in %d", tally.frames, tally.hits, within, FRAMES);
    snprintf(line, sizeof line, "bounce/%s_drift", name);
    lab_report(rise <= 1e-5, line, "rises by %.1e at most, ends at %+.1e", rise,
               tally.energy / tally.energy_first - 1);
    snprintf(line, sizeof line, "bounce/%s_substeps", name);
    lab_report(tally.crossed == 0 && tally.capped == 0, line,
               "%ld frames cross, %ld capped, sub-steps p99 %u, most %u", tally.crossed,
               tally.capped, lab_substeps(&tally, 0.99), lab_substeps(&tally, 1));
    lab_free(lab);
}

/* Without friction, a frame with a hit changes the momentum by the impulse and the weight. */
static void test_impulse(void)
{
    struct lab *lab = load_box(0, 0.7, 0);
    double gravity = lab_double(lab->config.gravity.c[2], 40), worst = 0, sideways = 0;
    struct oracle_body before;
    long hits = 0;

    tumble(lab);
    lab_start(lab);
    before = lab_body(lab);
    for (int frame = 0; frame < 200; frame++) {
        const struct carom_event *events;
        struct oracle_body now;
        struct carom_stats stats;
        int n;

        lab_step(lab, NULL);
        now = lab_body(lab);
        n = carom_events(lab->world, &events);
        carom_stats(lab->world, &stats);
        for (int i = 0; i < n; i++) {
            /* the event has the largest impulse of the frame, so take frames with one hit that do
             * not end in contact */
            if (events[i].kind == CAROM_EVENT_HIT && stats.hits == 1 && stats.contacts == 1 &&
                lab_double(events[i].speed_q40, 40) > -10 * gravity) {
                double impulse = lab_double(events[i].impulse_q40, 40) / lab->mass;

                hits++;
                worst = fmax(worst, fabs(now.velocity[2] - before.velocity[2] - gravity - impulse) /
                                        impulse);
            }
        }
        sideways = fmax(sideways, hypot(now.velocity[0], now.velocity[1]));
        before = now;
    }
    lab_report(hits >= 3 && worst <= 1e-6, "bounce/impulse", "%ld hits, off by %.1e at most", hits,
               worst);
    lab_report(sideways <= 1e-9, "bounce/frictionless", "%.1e units a frame sideways", sideways);
    lab_free(lab);
}

/*
 * A body dropped flat from 2 units rises to e^2 of its fall. Both heights count from where the
 * surfaces meet, the event gap (half a skin). The top is computed from place and speed in flight,
 * so that no frame has to fall on it. The solver stops at 2^-26 of the largest closing speed and
 * speeds are kept to 2^-40, so 1e-6 is a wide bar; a wrong threshold or a wrongly rounded time of
 * the hit would give 1e-4.
 */
static void test_restitution(double e)
{
    struct lab *lab = load_box(2, e, 0.5);
    double gravity = -lab_double(lab->config.gravity.c[2], 40);
    double meet = half_height(lab) + lab->skin / 2, top = 0, wanted;
    bool hit = false;
    char name[64];

    wanted = meet + e * e * (2 + half_height(lab) - meet);
    lab_start(lab);
    for (int frame = 0; frame < 100 && !hit; frame++) {
        struct lab_tally tally = {0};
        struct oracle_body body;

        lab_step(lab, &tally);
        hit = tally.hits != 0;
        body = lab_body(lab);
        top = body.position[2] + body.velocity[2] * body.velocity[2] / (2 * gravity);
    }
    snprintf(name, sizeof name, "bounce/restitution_%d_percent", (int)(100 * e));
    lab_report(hit && fabs(top - wanted) <= 1e-6, name, "top %.7f, by Newton's rule %.7f", top,
               wanted);
    lab_free(lab);
}

/* e = 0: once down, the body never rises above the skin. The impact is still an event. */
static void test_dead(void)
{
    struct lab *lab = load_box(2, 0, 0.5);
    struct lab_tally tally = {0};
    double highest = 0, lowest = 1;

    lab_start(lab);
    while (tally.frames < 300) {
        lab_step(lab, &tally);
        if (tally.begins) {
            highest = fmax(highest, lab_lowest(lab, up));
            lowest = fmin(lowest, lab_lowest(lab, up));
        }
    }
    lab_report(tally.begins == 1 && highest <= 1.01 * lab->skin && lowest > 0, "bounce/dead",
               "stays %.2f to %.2f skins above the plane", lowest / lab->skin, highest / lab->skin);
    lab_report(tally.hits == 1, "bounce/dead_hit", "%ld hit events", tally.hits);
    lab_free(lab);
}

/*
 * A box dropped flat with e = 1 stays upright and loses no height. Four contacts share each impact,
 * and the sweeps end at 2^-26 of the closing speed, 0.07 units a frame. That turns the box by some
 * 1e-7 from one hit to the next, which adds up to a few 1e-5 over 370 hits.
 */
static void test_flat(void)
{
    struct lab *lab = load_box(1, 1, 0);
    struct lab_tally tally = {0};
    double tilt = 0;

    lab_start(lab);
    while (tally.frames < 20000) {
        struct oracle_body body;

        lab_step(lab, &tally);
        body = lab_body(lab);
        for (int k = 1; k < 4; k++) {
            tilt = fmax(tilt, fabs(body.quaternion[k]));
        }
    }
    lab_report(tilt <= 1e-4 && tally.hits > 200, "bounce/flat_upright", "%ld hits, tilt %.1e",
               tally.hits, tilt);
    lab_report(tally.energy_change <= 1e-5 && tally.crossed == 0, "bounce/flat_energy",
               "within %.1e, %ld frames cross", tally.energy_change, tally.crossed);
    lab_free(lab);
}

int main(int argc, char **argv)
{
    const long others = argc > 1 && strcmp(argv[1], "long") == 0 ? FRAMES_LONG : FRAMES;

    test_energy(&lab_box, FRAMES_LONG, "box");
    test_energy(&lab_tetrahedron, others, "tetrahedron");
    test_energy(&lab_l, others, "l");
    test_impulse();
    for (int quarters = 1; quarters <= 4; quarters++) {
        test_restitution(quarters / 4.0);
    }
    test_dead();
    test_flat();
    return lab_finish();
}

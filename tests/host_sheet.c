/* SPDX-License-Identifier: MIT */
/*
 * host_sheet - the scene `sheet`, a box on a bowl over which waves run, in double precision. No
 * faces ever cross, neither after the sheet moved nor after the step. The box stays on the sheet,
 * its energy grows by no more than the sheet's work, and it sleeps when the sheet stops. Then a
 * heap of bodies on a sheet.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/crowd.h"

#define FRAMES 600
#define HEAP   12

struct sheet_tally {
    struct lab_tally lab;
    long crossed_before; /* frames in which faces cross before the step */
    double far;          /* largest distance of the box from the middle */
    double lift;         /* largest lift of the box */
    double over;         /* energy above the sheet's work in a frame, in m g skin */
};

/* Read the vertices in double; returns the largest distance that one moved. */
static double follow(const struct carom_mesh *mesh, struct oracle_mesh *to)
{
    double most = 0;

    for (size_t v = 0; v < mesh->raw.vertex_count; v++) {
        double way = 0;

        for (int k = 0; k < 3; k++) {
            double at = ldexp(mesh->raw.vertices[v][k], -mesh->raw.quantum_bits);

            way += pow(at - to->vertices[v][k], 2);
            to->vertices[v][k] = at;
        }
        most = fmax(most, sqrt(way));
    }
    return most;
}

/*
 * One frame, with the waves where they are at `time`. The sheet's work is at most the length of all
 * impulses times the speed of its fastest vertex. Contacts hardly pull against each other, so the
 * length of the sum of the impulses, the change of momentum, is taken instead.
 */
static void step(struct lab *lab, int time, struct sheet_tally *t)
{
    const double weight = lab->mass * lab_double(-lab->config.gravity.c[2], 40);
    struct oracle_body before = lab_body(lab), lifted, after;
    double fastest, energy, impulse = 0;

    lab_expect(scene_before(&lab->scene, lab->world, time), "move");
    fastest = follow(lab->scene.ground.mesh, &lab->ground);
    lifted = lab_body(lab);
    energy = lab_energy(lab);
    t->crossed_before += lab_crossings(lab).pairs != 0;
    t->lift = fmax(t->lift, lifted.position[2] - before.position[2]);
    lab_step(lab, &t->lab);
    after = lab_body(lab);
    for (int k = 0; k < 3; k++) {
        double change = lab->mass * (after.velocity[k] - before.velocity[k]);

        impulse += pow(change + (k == 2 ? weight : 0), 2);
        t->far = fmax(t->far, k < 2 ? fabs(after.position[k]) : 0);
    }
    energy = lab_energy(lab) - energy - sqrt(impulse) * fastest;
    t->over = fmax(t->over, energy / (weight * lab->skin));
}

static struct lab *load(bool sleep)
{
    struct lab *lab = lab_load_scene("sheet");

    lab->config.caps = lab->scene.caps;
    lab->config.sleep = sleep;
    lab_start(lab);
    return lab;
}

/* Waves run `speed` times as fast as in the scene: 2 throws the box up. */
static void test_box(int speed, bool stays)
{
    struct lab *lab = load(true);
    struct sheet_tally t = {.over = -1e9};
    long slept = 0;
    char name[64];
#define NAME(what) (snprintf(name, sizeof name, "sheet/%d_%s", speed, what), name)

    for (int frame = 1; frame <= FRAMES; frame++) {
        step(lab, speed * frame, &t);
    }
    lab_report(t.lab.crossed == 0 && t.crossed_before == 0, NAME("no_crossing"),
               "%ld and %ld of %ld frames cross", t.crossed_before, t.lab.crossed, t.lab.frames);
    lab_report(t.lab.capped == 0 && lab_substeps(&t.lab, 0.99) <= 3, NAME("substeps"),
               "p99 %u, most %u, %ld capped", lab_substeps(&t.lab, 0.99), lab_substeps(&t.lab, 1),
               t.lab.capped);
    lab_report(t.over <= 0.2, NAME("energy"), "%.1e m g skin beyond the work of the sheet", t.over);
    lab_report(t.far < 3.5 && t.lab.touching > (stays ? FRAMES * 4 / 5 : 50), NAME("stays"),
               "within %.2f units, in contact in %ld frames, lifted by %.4f at most", t.far,
               t.lab.touching, t.lift);
    for (int frame = 1; frame <= 300 && !slept; frame++) {
        step(lab, speed * FRAMES, &t);
        slept = lab_asleep(lab) ? frame : 0;
    }
    lab_report(slept > 0 && t.lab.crossed + t.crossed_before == 0, NAME("sleeps"),
               "%ld frames after the sheet stopped", slept);
    step(lab, speed * FRAMES + 1, &t);
    lab_report(!lab_asleep(lab), NAME("wakes"), "when it moves again");
#undef NAME
    lab_free(lab);
}

/* Boxes, tetrahedra and Ls poured onto the sheet. */
static void test_heap(void)
{
    static struct scene_sheet sheet;
    struct carom_mesh_raw raw = scene_sheet_raw(&sheet);
    const size_t bytes = CAROM_SURFACE_BYTES(SCENE_SHEET_VERTICES, SCENE_SHEET_FACES);
    const double scale[3] = {0.6, 0.6, 0.6};
    struct crowd *crowd = crowd_new();
    struct crowd_tally tally = {0};
    void *block = lab_need(bytes);
    int mesh[4] = {crowd_mesh(crowd, &raw), crowd_solid(crowd, &lab_box, scale),
                   crowd_solid(crowd, &lab_tetrahedron, scale), crowd_solid(crowd, &lab_l, scale)};
    struct crowd_mesh *ground = &crowd->meshes[mesh[0]];
    double farthest = 0;

    lab_expect(carom_surface_build(&ground->mesh, &raw, block, bytes), "sheet");
    crowd_body(crowd, mesh[0]);
    for (int i = 0; i < HEAP; i++) {
        crowd_place(crowd_body(crowd, mesh[1 + i % 3]), -0.8 + 0.7 * (i % 3),
                    -0.5 + 0.8 * (i / 3 % 2), 0.8 + 0.55 * (i / 3));
    }
    lab_expect(crowd_start(crowd), "heap");
    for (int frame = 1; frame <= FRAMES; frame++) {
        scene_sheet_shape(sheet.vertices, frame);
        lab_expect(carom_surface_move(crowd->world, 0, (const int16_t(*)[3])sheet.vertices),
                   "move");
        follow(&ground->mesh, &ground->solid);
        lab_expect(crowd_step(crowd, &tally), "step");
    }
    for (int i = 1; i <= HEAP; i++) {
        const double *p = crowd->bodies[i].now.body.position;

        farthest = fmax(farthest, fmax(fabs(p[0]), fabs(p[1])));
    }
    lab_report(tally.crossed == 0, "sheet/heap_no_crossing",
               "%ld of %ld frames, first %ld, depth %.1e", tally.crossed, tally.frames,
               tally.crossed_first, tally.crossed_depth);
    lab_report(tally.capped <= tally.frames / 100, "sheet/heap_substeps", "%ld frames capped",
               tally.capped);
    lab_report(farthest < 4, "sheet/heap_stays", "within %.2f units", farthest);
    free(block);
    crowd_free(crowd);
}

int main(void)
{
    test_box(1, true);
    test_box(2, false);
    test_heap();
    return lab_finish();
}

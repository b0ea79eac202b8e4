/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lab.h"

static void follow(struct lab *lab)
{
    const struct carom_mesh_raw *raw = &lab->scene.ground_mesh.raw;

    for (size_t v = 0; v < raw->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            lab->ground.vertices[v][k] = ldexp(raw->vertices[v][k], -raw->quantum_bits);
        }
    }
}

int main(int argc, char **argv)
{
    struct lab *lab = lab_load_scene("sheet");
    struct lab_tally tally = {0};
    double lift = 0, worst = -1e9; int lifts = 0, wf = 0; double far = 0, fast = 0;

    lab->config.caps = lab->scene.caps;
    lab_start(lab);
    int fr = argc > 1 ? atoi(argv[1]) : 600;
    int mul = argc > 2 ? atoi(argv[2]) : 1;
    for (int frame = 1; frame <= fr; frame++) {
        struct oracle_body bm = lab_body(lab);
        static int16_t old[SCENE_SHEET_VERTICES][3];
        memcpy(old, lab->scene.ground_mesh.raw.vertices, sizeof old);
        lab_expect(scene_before(&lab->scene, lab->world, frame * mul), "move");
        follow(lab);
        long crossed = tally.crossed, capped = tally.capped;
        struct oracle_body b0 = lab_body(lab);
        double dmax = 0;
        for (int v = 0; v < SCENE_SHEET_VERTICES; v++) dmax = fmax(dmax, fabs((lab->scene.ground_mesh.raw.vertices[v][2] - old[v][2]) / 4096.));
        double e0 = lab_energy(lab);
        lift = fmax(lift, b0.position[2] - bm.position[2]); if (b0.position[2] > bm.position[2]) lifts++;
        struct oracle_crossings c0 = lab_crossings(lab);
        lab_step(lab, &tally);
        struct oracle_body b = lab_body(lab);
        struct carom_stats st;
        carom_stats(lab->world, &st);
        double g = 9.81 / 3600, J = 0, m = lab->mass;
        for (int k = 0; k < 3; k++) { double j = b.velocity[k] - b0.velocity[k] + (k == 2 ? g : 0); J += j * j; }
        J = sqrt(J) * m;
        double rise = lab_energy(lab) - e0;
        double over = (rise - J * dmax) / (m * g * lab->skin);
        if (over > worst) { worst = over; wf = frame; }
        double v = hypot(hypot(b.velocity[0], b.velocity[1]), b.velocity[2]);
        far = fmax(far, fmax(fabs(b.position[0]), fabs(b.position[1])));
        if (frame > 100) fast = fmax(fast, v);
        if (tally.crossed > crossed || c0.pairs || tally.capped > capped || getenv("ALL"))
            printf("%d cross %d before %zu %.5f capped %d at %.3f %.3f %.3f (from z %.3f) v %.4f sub %u hits %u cont %u sweeps %u rule %u\n", frame,
                   (int)(tally.crossed - crossed), c0.pairs, c0.depth, (int)(tally.capped-capped), b.position[0], b.position[1], b.position[2], b0.position[2], v, st.substeps, st.hits, st.contacts, st.sweeps, st.energy_rule);
    }
    printf("crossed %ld capped %ld hits %ld touching %ld far %.3f fast %.4f substeps p99 %u max %u\n", tally.crossed,
           tally.capped, tally.hits, tally.touching, far, fast, lab_substeps(&tally, 0.99), lab_substeps(&tally, 1));
    printf("lifts %d most %.5f (skin %.5f) energy over %.3f m g skin at %d\n", lifts, lift, lab->skin, worst, wf);
    lab_free(lab);
    return 0;
}

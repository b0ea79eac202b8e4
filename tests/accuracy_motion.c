/* SPDX-License-Identifier: MIT */
/*
 * accuracy_motion - bodies that turn freely for a million frames.
 *
 * A case is a body that turns by about 0.1 radians a frame; the first two close to their middle axes,
 * where they tumble.
 * Its error is the larger of
 *   energy         the largest distance from the first frame's, relative: from the spin that the
 *                  engine tells and the inertia that the tests work out in double
 *   orthonormality the largest entry of R R^T - 1, R the rotation matrix that the engine turns by
 * over all frames.
 */
#include <math.h>

#include "lib/accuracy.h"
#include "body/body.h"
#include "lib/lab.h"

#define FRAMES 1000000

static double orthonormality(const carom_quat_q30 *q)
{
    carom_m3_q30 m;
    double worst = 0;

    fix_matrix(&m, q);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = i == j ? -1 : 0;

            for (int k = 0; k < 3; k++) {
                sum += lab_double(m.c[i][k], 30) * lab_double(m.c[j][k], 30);
            }
            worst = fmax(worst, fabs(sum));
        }
    }
    return worst;
}

/* A body turning with its spin, in units of 1/1000 radian, far above the ground. */
static struct lab *load(const struct carom_mesh_raw *mesh, const double mrad[3])
{
    struct lab *lab = lab_load(&lab_sheet, mesh);

    lab->config.gravity = (carom_v3_q40){{0, 0, 0}};
    lab->config.sleep = false;
    lab->scene.body.position.c[2] = lab_fixed(100, 32);
    for (int k = 0; k < 3; k++) {
        lab->scene.body.spin.c[k] = lab_fixed(mrad[k] / 1000, 40);
    }
    lab_start(lab);
    return lab;
}

static double error(const struct carom_mesh_raw *mesh, const double mrad[3])
{
    struct lab *lab = load(mesh, mrad);
    double first = lab_energy(lab), worst = 0;

    for (long frame = 0; frame < FRAMES; frame++) {
        struct carom_body_state state;

        lab_step(lab, NULL);
        carom_body_get(lab->world, SCENE_BODY, &state);
        worst = fmax(worst, fabs(lab_energy(lab) / first - 1));
        worst = fmax(worst, orthonormality(&state.rotation));
    }
    lab_free(lab);
    return worst;
}

int main(int argc, char **argv)
{
    /* a box, a thin plate, and an L that does not lie along its principal axes */
    static const struct carom_mesh_raw *const meshes[3] = {&lab_box, &lab_plate, &lab_l};
    static const double mrad[3][3] = {{10, 100, 0}, {10, 100, -5}, {40, 90, 10}};
    struct accuracy a = accuracy_begin("tumble", accuracy_cases(argc, argv, 3));

    for (size_t i = 0; i < a.wanted; i++) {
        accuracy_add(&a, error(meshes[i], mrad[i]));
    }
    accuracy_end(&a, &(struct accuracy_bar){.max = 5e-6});
    return accuracy_finish();
}

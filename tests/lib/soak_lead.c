/* SPDX-License-Identifier: MIT */
/* Kinematic bodies of random worlds. */
#include <string.h>

#include "real.h"
#include "soak.h"

void soak_leader_begin(struct soak_leader *l, const struct carom_body_def *def, double size,
                       struct test_random *r)
{
    memset(l, 0, sizeof *l);
    l->smooth = soak_pick(r, 3) > 0;
    l->turns = soak_pick(r, 3) > 0;
    soak_direction(r, l->way);
    soak_direction(r, l->axis);
    l->wave = soak_powers(r, 0.005, 0.3);
    l->rate = soak_powers(r, 0.01, 2);
    for (int k = 0; k < 3; k++) {
        l->at[k] = real(def->position.c[k], 32);
        l->way[k] *= size * soak_uniform(r, 0.1, 3);
    }
    l->start = def->rotation;
}

/* Not a library's sine, because a world must be the same on every machine. */
static double sine(double angle, double *cosine)
{
    double s;

    angle -= 2 * REAL_PI * (double)real_round(angle / (2 * REAL_PI));
    real_sine_cosine(angle, &s, cosine);
    return s;
}

static carom_quat_q30 turn_by(const double axis[3], double angle)
{
    double c, s = sine(angle / 2, &c);
    carom_quat_q30 q = {{(int32_t)real_round(c * CAROM_ONE_Q30), 0, 0, 0}};

    for (int k = 0; k < 3; k++) {
        q.c[k + 1] = (int32_t)real_round(s * axis[k] * CAROM_ONE_Q30);
    }
    return q;
}

static carom_quat_q30 times(const carom_quat_q30 *p, const carom_quat_q30 *q)
{
    double a[4], b[4];
    carom_quat_q30 out;

    lab_quaternion(a, p);
    lab_quaternion(b, q);
    out.c[0] = (int32_t)lab_fixed(a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], 30);
    out.c[1] = (int32_t)lab_fixed(a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2], 30);
    out.c[2] = (int32_t)lab_fixed(a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], 30);
    out.c[3] = (int32_t)lab_fixed(a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0], 30);
    return out;
}

void soak_lead(struct carom_world *world, int body, const struct soak_leader *l, long frame,
               struct test_random *r)
{
    struct carom_body_state now = lab_state(world, body);
    struct carom_pose pose = {now.position, now.rotation};
    double c, by = l->smooth ? sine(l->wave * (double)frame, &c) : soak_uniform(r, -1, 1);
    carom_quat_q30 turn = turn_by(l->axis, l->rate * by);

    if (!l->smooth && soak_pick(r, 4) != 0) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        pose.position.c[k] = lab_fixed(l->at[k] + l->way[k] * by, 32);
    }
    if (l->turns) {
        pose.rotation = times(&turn, &l->start);
    }
    (void)carom_body_move_to(world, body, &pose);
}

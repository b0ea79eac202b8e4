/* SPDX-License-Identifier: MIT */
/* Measurements for the judges of fixtures: points, turns, spins. */
#include <math.h>

#include "fixture.h"
#include "real.h"

void fixture_point(const struct fixture *f, int body, const double local[3], double out[3])
{
    const struct oracle_pose *pose = &f->bodies[body].pose;

    for (int k = 0; k < 3; k++) {
        out[k] = real_dot(pose->rotation.row[k], local) + pose->position[k];
    }
}

double fixture_drift(const struct fixture *f, int body)
{
    double change[3];

    for (int k = 0; k < 3; k++) {
        change[k] = f->bodies[body].now.position[k] - f->bodies[body].first.position[k];
    }
    return real_length(change);
}

double fixture_farthest(const struct fixture *f)
{
    double farthest = 0;

    for (int i = 0; i < f->body_count; i++) {
        farthest = fmax(farthest, f->bodies[i].mass > 0 ? fixture_drift(f, i) : 0);
    }
    return farthest;
}

double fixture_tilt(const struct fixture *f, int body, int axis)
{
    const double nowhere[3] = {0};
    struct oracle_pose first = oracle_pose_make(nowhere, f->bodies[body].first.quaternion, nowhere);
    const struct oracle_pose *now = &f->bodies[body].pose;
    double cosine = 0;

    for (int k = 0; k < 3; k++) {
        cosine += first.rotation.row[k][axis] * now->rotation.row[k][axis];
    }
    return acos(fmax(-1, fmin(1, cosine)));
}

double fixture_speed(const struct fixture *f, int body)
{
    const struct oracle_body *now = &f->bodies[body].now;

    return 60 * (real_length(now->velocity) +
                 f->meshes[f->bodies[body].mesh].radius * real_length(now->spin));
}

double fixture_fastest(const struct fixture *f)
{
    double fastest = 0;

    for (int i = 0; i < f->body_count; i++) {
        fastest = fmax(fastest, f->bodies[i].mass > 0 ? fixture_speed(f, i) : 0);
    }
    return fastest;
}

/* SPDX-License-Identifier: MIT */
/* Boxes on a plane, heavier towards the top: they stand, awake. */
#include <math.h>

#include "fixture.h"

static void make(struct fixture *f, int count, double ratio, bool askew)
{
    double skin, z = 0.5;
    int mesh;

    fixture_plane(f);
    fixture_shape_box(&f->shape, 1, 1, 1);
    mesh = fixture_mesh(f);
    skin = fixture_skin(f, mesh);
    for (int i = 0; i < count; i++, z += 1) {
        bool upper = askew && i % 2;
        int body = fixture_body(f, mesh, upper ? 0.1 : 0, upper ? 0.06 : 0, z + (i + 1) * skin,
                                lab_turn(0, 0, 1, upper ? 0.2 : 0));

        /* 2^10 is the largest mass */
        fixture_weigh(f, body, pow(ratio, (double)i / (count - 1)));
    }
}

static void make_straight(struct fixture *f)
{
    make(f, f->scene->n, f->scene->value, false);
}

static void make_askew(struct fixture *f)
{
    make(f, f->scene->n, f->scene->value, true);
}

static bool judge(struct fixture *f)
{
    double tilt = 0;

    for (int i = 1; i < f->body_count; i++) {
        tilt = fmax(tilt, fixture_tilt(f, i, 2));
    }
    fixture_say(f, "tilt %.5f rad", tilt);
    return tilt < 0.01 && fixture_farthest(f) < 0.05;
}

#define STACK(name, brief, make, n, ratio, mu)                                                     \
    {                                                                                              \
        name, "stands", 1000, brief, make, NULL, judge, n, ratio, mu                               \
    }
const struct fixture_scene fixture_stacks[] = {
    STACK("stack8", 150, make_straight, 2, 8, 0.5),
    STACK("stack64", 150, make_straight, 2, 64, 0.5),
    STACK("stack1000", 150, make_straight, 2, 1000, 0.5),
    STACK("stack8-smooth", 150, make_straight, 2, 8, 0),
    STACK("stack64-smooth", 150, make_straight, 2, 64, 0),
    STACK("stack1000-smooth", 150, make_straight, 2, 1000, 0),
    STACK("askew8", 150, make_askew, 2, 8, 0.5),
    STACK("askew64", 150, make_askew, 2, 64, 0.5),
    STACK("askew1000", 150, make_askew, 2, 1000, 0.5),
    STACK("askew8-smooth", 150, make_askew, 2, 8, 0),
    STACK("askew64-smooth", 150, make_askew, 2, 64, 0),
    STACK("askew1000-smooth", 150, make_askew, 2, 1000, 0),
    STACK("tower10", 150, make_straight, 10, 1000, 0.5),
    STACK("tower10-smooth", 150, make_straight, 10, 1000, 0),
    {0}};

/* SPDX-License-Identifier: MIT */
/*
 * Contacts that are hard for meshes, after Erleben (2018): spikes, ridges, cracks, holes, cliffs
 * and edges inside of a floor.
 */
#include <math.h>

#include "fixture.h"
#include "real.h"

#define SECTION(n) ((const double(*)[2])(n))

static carom_quat_q30 yaw(double radians)
{
    return lab_turn(0, 0, 1, radians);
}

/* --------------------------------------------------------- something on a point */

/* A ridge along y, with its edge at z = 1; n: the slope of its sides, degrees. */
static void fix_ridge(struct fixture *f)
{
    double half = 1 / tan(f->scene->n * REAL_PI / 180);
    const double corner[3][2] = {{-half, 0}, {half, 0}, {0, 1}};

    fixture_shape_prism(&f->shape, SECTION(corner), 3, -2, 2);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
}

static void fix_spike(struct fixture *f)
{
    fixture_shape_spike(&f->shape, 0.5, 1);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
}

/* A body `gap` above the tip or the edge, off it by the scene's value, and turned by `turn`. */
static void drop(struct fixture *f, double turn)
{
    f->mark[0] =
        fixture_body(f, fixture_mesh(f), f->scene->value, f->scene->value / 3, 1.2, yaw(turn));
}

static void drop_spike(struct fixture *f)
{
    fixture_shape_spike(&f->shape, 0.5, -1);
    for (uint32_t v = 0; v < f->shape.vertex_count; v++) {
        f->shape.p[v][2] += 1;
    }
    drop(f, f->scene->value == 0 ? 0 : 0.3);
}

static void make_spike_on_spike(struct fixture *f)
{
    fixture_plane(f);
    fix_spike(f);
    drop_spike(f);
}

static void make_spike_on_ridge(struct fixture *f)
{
    fixture_plane(f);
    fix_ridge(f);
    drop_spike(f);
}

static void drop_wedge(struct fixture *f, double turn)
{
    const double corner[3][2] = {{0, 0}, {0.4, 0.8}, {-0.4, 0.8}};

    fixture_shape_prism(&f->shape, SECTION(corner), 3, -0.5, 0.5);
    drop(f, turn);
}

static void make_wedge_along(struct fixture *f)
{
    fixture_plane(f);
    fix_ridge(f);
    drop_wedge(f, 0);
}

static void make_wedge_askew(struct fixture *f)
{
    fixture_plane(f);
    fix_ridge(f);
    drop_wedge(f, 1e-3);
}

static void make_wedge_across(struct fixture *f)
{
    fixture_plane(f);
    fix_ridge(f);
    drop_wedge(f, REAL_PI / 2);
}

static void make_box_on_ridge(struct fixture *f)
{
    fixture_plane(f);
    fix_ridge(f);
    fixture_shape_box(&f->shape, 1, 0.8, 0.6);
    for (uint32_t v = 0; v < f->shape.vertex_count; v++) {
        f->shape.p[v][2] += 0.3;
    }
    drop(f, 0);
}

/*
 * A body that is put exactly over the tip or edge may stay there; put beside, it falls to the
 * floor.
 */
static bool judge_fall(struct fixture *f)
{
    const struct fixture_body *body = &f->bodies[(int)f->mark[0]];

    fixture_say(f, "lowest at %.3f", body->low[2]);
    return f->scene->value == 0 || body->low[2] < 0.1;
}

/* --------------------------------------------------------------- cracks, holes */

/* A crack with the wedge's own angle; value: the tangent of its half. */
static void make_crack(struct fixture *f)
{
    double deep = 0.8, mouth = deep * f->scene->value, tip = 0.75 * mouth;
    const double crack[7][2] = {{-2, -1},   {2, -1},     {2, 0}, {mouth, 0},
                                {0, -deep}, {-mouth, 0}, {-2, 0}};
    const double wedge[3][2] = {{0, 0}, {tip, 0.75 * deep}, {-tip, 0.75 * deep}};

    fixture_shape_prism(&f->shape, SECTION(crack), 7, -1, 1);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
    fixture_shape_prism(&f->shape, SECTION(wedge), 3, -0.5, 0.5);
    f->mark[0] =
        fixture_body(f, fixture_mesh(f), 0.03 * f->scene->n, 0, -0.3, yaw(0.01 * f->scene->n));
    f->mark[1] = -deep;
    f->mark[2] = f->scene->value;
}

static void make_hole(struct fixture *f)
{
    double deep = 0.8, mouth = deep * f->scene->value;

    fixture_shape_hole(&f->shape, 1, 1.2, mouth, deep);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
    fixture_shape_spike(&f->shape, 0.75 * mouth, -0.75 * deep);
    for (uint32_t v = 0; v < f->shape.vertex_count; v++) {
        f->shape.p[v][2] += 0.75 * deep;
    }
    f->mark[0] =
        fixture_body(f, fixture_mesh(f), 0.03 * f->scene->n, 0, -0.3, yaw(0.01 * f->scene->n));
    f->mark[1] = -deep;
    f->mark[2] = f->scene->value;
}

/*
 * The wedge settles with its sides on the crack's sides. Its tip is above the bottom by the skin
 * along the axis, plus a few skins that friction holds.
 */
static bool judge_settled(struct fixture *f)
{
    const double origin[3] = {0};
    int body = (int)f->mark[0];
    double tip[3], sine = f->mark[2] / hypot(1, f->mark[2]), speed = fixture_speed(f, body);

    fixture_point(f, body, origin, tip);
    tip[2] -= f->mark[1] + fixture_skin(f, f->bodies[body].mesh) / sine;
    fixture_say(f, "tip %.4f aside, %.4f above its place, %.4f/s", hypot(tip[0], 0), tip[2], speed);
    return fabs(tip[0]) < 0.01 && tip[2] > -0.001 && tip[2] < 0.01 && speed < 0.01;
}

/* ---------------------------------------------------------------------- cliffs */

/* Half of a cube over a cliff's edge, with its middle inside by the scene's value. */
static void make_cliff(struct fixture *f)
{
    int mesh;

    fixture_plane(f);
    fixture_shape_box(&f->shape, 4, 4, 2);
    fixture_fixed(f, fixture_mesh(f), -2, 0, 1, fixture_upright);
    fixture_shape_box(&f->shape, 1, 1, 1);
    mesh = fixture_mesh(f);
    f->mark[0] = fixture_body(f, mesh, -f->scene->value, 0, 2.5 + fixture_skin(f, mesh), yaw(0));
}

/* The same at the corner, inside of both edges. */
static void make_corner(struct fixture *f)
{
    make_cliff(f);
    f->bodies[(int)f->mark[0]].def.position.c[1] = lab_fixed(2 - f->scene->value, 32);
    f->bodies[(int)f->mark[0]].def.rotation = yaw(0.4);
}

static bool judge_cliff(struct fixture *f)
{
    int body = (int)f->mark[0];
    double tilt = fixture_tilt(f, body, 2);

    fixture_say(f, "tilt %.4f, lowest at %.3f", tilt, f->bodies[body].low[2]);
    return f->scene->value > 0 ? tilt < 0.01 && fixture_drift(f, body) < 0.01
                               : f->bodies[body].low[2] < 0.1;
}

/* ------------------------------------------------------- edges inside of a floor */

static void slide(struct fixture *f, double height)
{
    const double velocity[3] = {5, 0, 0}, none[3] = {0};
    int mesh;

    fixture_shape_box(&f->shape, 0.8, 0.6, 0.5);
    mesh = fixture_mesh(f);
    f->mark[0] = fixture_body(f, mesh, -10, 0.1, height + 0.25 + fixture_skin(f, mesh), yaw(0.3));
    fixture_throw(f, (int)f->mark[0], velocity, none);
}

static void make_slide(struct fixture *f)
{
    fixture_shape_plane(&f->shape, 24, 24);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
    slide(f, 0);
}

static void make_tiles(struct fixture *f)
{
    int mesh;

    fixture_shape_box(&f->shape, 1, 4, 1);
    mesh = fixture_mesh(f);
    for (int i = 0; i < 24; i++) {
        fixture_fixed(f, mesh, i - 11.5, 0, -0.5, fixture_upright);
    }
    slide(f, 0);
}

/* Nothing stops the body. */
static bool judge_slide(struct fixture *f)
{
    const struct fixture_body *body = &f->bodies[(int)f->mark[0]];
    double n = (double)f->tally.frames, way = body->now.position[0] - body->first.position[0];
    double aside = body->now.position[1] - body->first.position[1];
    double up = body->now.position[2] - body->first.position[2];
    double tilt = fixture_tilt(f, (int)f->mark[0], 2);

    fixture_say(f, "slides %.4f of %.4f, %.5f aside, %.5f up", way, n * 5 / 60, aside, up);
    return fabs(way - n * 5 / 60) < 0.002 * way && fabs(aside) < 0.01 && fabs(up) < 0.002 &&
           tilt < 0.005;
}

#define FALL   "falls to the floor"
#define ANY    "falls or balances"
#define SETTLE "settles"
#define STAY   "stays"
#define SLIDE  "slides on"
#define DROP(name, brief, make, slope, aside)                                                      \
    {                                                                                              \
        name, (aside) == 0 ? ANY : FALL, 600, brief, make, NULL, judge_fall, slope, aside, 0.2     \
    }
const struct fixture_scene fixture_contacts[] = {
    DROP("spike-spike", 400, make_spike_on_spike, 0, 0),
    DROP("spike-spike-off", 400, make_spike_on_spike, 0, 0.003),
    DROP("spike-ridge30", 400, make_spike_on_ridge, 30, 0),
    DROP("spike-ridge45", 400, make_spike_on_ridge, 45, 0),
    DROP("spike-ridge75", 400, make_spike_on_ridge, 75, 0),
    DROP("spike-ridge75-off", 400, make_spike_on_ridge, 75, 0.003),
    DROP("wedge-ridge", 400, make_wedge_along, 60, 0),
    DROP("wedge-ridge-askew", 400, make_wedge_askew, 60, 0),
    DROP("wedge-ridge-off", 400, make_wedge_along, 60, 0.003),
    DROP("wedge-across", 400, make_wedge_across, 60, 0),
    DROP("wedge-across-off", 400, make_wedge_across, 60, 0.05),
    DROP("box-ridge", 400, make_box_on_ridge, 60, 0),
    DROP("box-ridge-off", 400, make_box_on_ridge, 60, 0.1),
    {"wedge-crack", SETTLE, 600, 300, make_crack, NULL, judge_settled, 0, 0.6, 0.1},
    {"wedge-crack-off", SETTLE, 600, 300, make_crack, NULL, judge_settled, 1, 0.6, 0.1},
    {"wedge-crack-steep", SETTLE, 600, 300, make_crack, NULL, judge_settled, 1, 0.25, 0.05},
    {"spike-hole", SETTLE, 600, 300, make_hole, NULL, judge_settled, 0, 0.6, 0.1},
    {"spike-hole-off", SETTLE, 600, 300, make_hole, NULL, judge_settled, 1, 0.6, 0.1},
    {"cliff-inside", STAY, 600, 300, make_cliff, NULL, judge_cliff, 0, 0.05, 0.5},
    {"cliff-outside", FALL, 600, 300, make_cliff, NULL, judge_cliff, 0, -0.05, 0.5},
    {"cliff-corner", STAY, 600, 300, make_corner, NULL, judge_cliff, 0, 0.1, 0.5},
    {"slide-faces", SLIDE, 240, 240, make_slide, NULL, judge_slide, 0, 0, 0},
    {"slide-tiles", SLIDE, 240, 240, make_tiles, NULL, judge_slide, 0, 0, 0},
    {0}};

/* SPDX-License-Identifier: MIT */
/*
 * Closed links: chains that swing from a fixed link, and a net like chain mail that hangs by two
 * corners. They hold: the linking numbers of all pairs stay the same.
 */
#include <math.h>

#include "fixture.h"
#include "real.h"

#define RING     0.5
#define SEGMENTS 16
#define SIDES    8

/* ------------------------------------------------------------------ linking */

/*
 * The linking number of two rings: how often the middle line of ring a goes through the disc of
 * ring b, by sign. The middle line of b is the border of that disc.
 */
static int linking(const struct fixture *f, int a, int b)
{
    enum { CORNERS = 64 };
    const struct oracle_pose *disc = &f->bodies[b].pose;
    double p[CORNERS + 1][3], height[CORNERS + 1];
    int number = 0;

    for (int i = 0; i <= CORNERS; i++) {
        double angle = 2 * REAL_PI * (i % CORNERS + 0.37) / CORNERS;
        const double local[3] = {RING * cos(angle), RING * sin(angle), 0};

        fixture_point(f, a, local, p[i]);
        height[i] = 0;
        for (int k = 0; k < 3; k++) {
            height[i] += (p[i][k] - disc->position[k]) * disc->rotation.row[k][2];
        }
    }
    for (int i = 0; i < CORNERS; i++) {
        double part, square = 0;

        if ((height[i] > 0) == (height[i + 1] > 0)) {
            continue;
        }
        part = height[i] / (height[i] - height[i + 1]);
        for (int k = 0; k < 3; k++) {
            double from = p[i][k] + part * (p[i + 1][k] - p[i][k]) - disc->position[k];

            square += from * from;
        }
        number += square < RING * RING ? (height[i + 1] > 0 ? 1 : -1) : 0;
    }
    return number;
}

/*
 * Count the linked pairs; `expected` pairs were made linked, and `kept` of these still are, once.
 * `made` tells whether a later body was linked with an earlier one.
 */
static int count_links(const struct fixture *f, bool (*made)(int later, int earlier), int *expected,
                       int *kept)
{
    int linked = 0;

    *expected = *kept = 0;
    for (int a = 0; a < f->body_count; a++) {
        for (int b = 0; b < a; b++) {
            int number = linking(f, a, b);

            linked += number != 0;
            *expected += made(a, b);
            *kept += made(a, b) && (number == 1 || number == -1);
        }
    }
    return linked;
}

static bool judge_links(struct fixture *f, bool (*made)(int later, int earlier))
{
    int expected, kept, linked = count_links(f, made, &expected, &kept);

    fixture_say(f, "%d of %d links hold, %d others", kept, expected, linked - kept);
    return kept == expected && linked == expected;
}

/* -------------------------------------------------------------------- chains */

/*
 * A straight chain, turned from the vertical by `value` degrees; a negative value means square
 * sections.
 */
static void make_chain(struct fixture *f)
{
    double slope = fabs(f->scene->value) * REAL_PI / 180, pitch = 2 * 0.3998 - 0.03;
    carom_quat_q30 lean = lab_turn(0, 1, 0, REAL_PI / 2 - slope);
    int mesh;

    fixture_shape_torus(&f->shape, RING, 0.1, SEGMENTS, f->scene->value > 0 ? SIDES : 4);
    mesh = fixture_mesh(f);
    for (int i = 0; i <= f->scene->n; i++) {
        carom_quat_q30 roll = lab_turn(1, 0, 0, 0.2 + (i % 2 ? REAL_PI / 2 : 0));
        double along = i * pitch;

        (i == 0 ? fixture_fixed : fixture_body)(f, mesh, along * sin(slope), 0, -along * cos(slope),
                                                fixture_compose(lean, roll));
    }
}

/* Watch the swing of the last link to the other side, as a part of its first distance. */
static void watch_chain(struct fixture *f)
{
    double x = f->bodies[f->body_count - 1].now.position[0];

    f->mark[0] = fmin(f->mark[0], x / f->bodies[f->body_count - 1].first.position[0]);
}

static bool is_next(int later, int earlier)
{
    return later == earlier + 1;
}

static bool judge_chain(struct fixture *f)
{
    fixture_say(f, "swings to %.2f of its start", f->mark[0]);
    return judge_links(f, is_next) && f->mark[0] < -0.3;
}

/* ----------------------------------------------------------------------- net */

#define ROWS 4
#define ROW  0.3113
#define LINK 1.2627

/*
 * Rows tilt one way and the other. Each link holds two of the row before and two of the next. The
 * links' sections have n sides.
 */
static void make_net(struct fixture *f)
{
    int mesh;

    fixture_shape_torus(&f->shape, RING, 0.08, SEGMENTS, f->scene->n);
    mesh = fixture_mesh(f);
    for (int i = 0; i < ROWS * ROWS; i++) {
        int row = i / ROWS, column = i % ROWS;
        bool corner = row == 0 && (column == 0 || column == ROWS - 1);

        (corner ? fixture_fixed : fixture_body)(f, mesh, (column + row % 2 * 0.5) * LINK, row * ROW,
                                                0, lab_turn(1, 0, 0, row % 2 ? -0.6362 : 0.6362));
    }
}

static void watch_net(struct fixture *f)
{
    f->mark[0] = fmin(f->mark[0], f->bodies[f->body_count - 1].now.position[2]);
}

/* True if two links of neighbouring rows lie half a link to either side of each other. */
static bool is_woven(int later, int earlier)
{
    int aside = (later % ROWS - earlier % ROWS) * 2 + later / ROWS % 2 - earlier / ROWS % 2;

    return later / ROWS == earlier / ROWS + 1 && (aside == 1 || aside == -1);
}

static bool judge_net(struct fixture *f)
{
    fixture_say(f, "falls to %.2f", f->mark[0]);
    return judge_links(f, is_woven) && f->mark[0] < -0.3;
}

#define CHAIN(name, brief, n, slope)                                                               \
    {                                                                                              \
        name, "holds and swings", 1000, brief, make_chain, watch_chain, judge_chain, n, slope, 0.3 \
    }
const struct fixture_scene fixture_links[] = {
    CHAIN("chain3", 250, 3, 60),
    CHAIN("chain5", 250, 5, 60),
    CHAIN("chain10", 250, 10, 60),
    CHAIN("chain3-level", 250, 3, 90),
    CHAIN("chain5-level", 250, 5, 90),
    CHAIN("chain10-level", 250, 10, 90),
    CHAIN("chain3-square", 250, 3, -60),
    CHAIN("chain5-square", 250, 5, -75),
    CHAIN("chain10-square", 250, 10, -75),
    {"net4x4", "holds and falls", 1000, 250, make_net, watch_net, judge_net, SIDES, 0, 0.3},
    {"net4x4-square", "holds and falls", 1000, 0, make_net, watch_net, judge_net, 4, 0, 0.3},
    {0}};

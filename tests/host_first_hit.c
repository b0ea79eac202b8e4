/* SPDX-License-Identifier: MIT */
/*
 * The first hit of random motions, judged from outside. Without gravity and with one sub-step a
 * frame, a step that hits ends where the surfaces meet, and one that does not ends where the motion
 * does. In between the body goes straight and turns by Cayley(s u) about its centre: 300 poses on
 * the way are checked for crossing faces, and at a hit the meshes must be the event gap apart.
 *
 * Not exactly: the way to a hit is set up again for the time it takes, and a turn set up for a
 * shorter time is not a part of the longer one. With a the angle of the frame, one step of the
 * midpoint rule differs from many by terms of second order, at most a^2 / 12, and a part of that is
 * left at a hit on the way.
 */
#include <math.h>
#include <stdio.h>

#include "lab.h"

#define MOTIONS 50
#define SAMPLES 300

/* ------------------------------------------------------------------ distances */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void between(double out[3], const double from[3], const double to[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = to[k] - from[k];
    }
}

static double length_along(const double offset[3], const double a[3], double s, const double b[3],
                           double t)
{
    double square = 0;

    for (int k = 0; k < 3; k++) {
        double d = offset[k] + s * a[k] - t * b[k];

        square += d * d;
    }
    return sqrt(square);
}

static double clamp(double t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

/* Of two segments: the least over the inner solution and the ends of each against the other. */
static double segment_distance(const double p[3], const double q[3], const double u[3],
                               const double v[3])
{
    double a[3], b[3], offset[3], aa, bb, ab, ao, bo, determinant, least = HUGE_VAL;

    between(a, p, q);
    between(b, u, v);
    between(offset, u, p);
    aa = dot(a, a);
    bb = dot(b, b);
    ab = dot(a, b);
    ao = dot(a, offset);
    bo = dot(b, offset);
    determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * aa * bb) {
        double s = (ab * bo - bb * ao) / determinant, t = (aa * bo - ab * ao) / determinant;

        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            least = length_along(offset, a, s, b, t);
        }
    }
    for (int end = 0; end < 2; end++) {
        least = fmin(least, length_along(offset, a, end, b, clamp((bo + end * ab) / bb)));
        least = fmin(least, length_along(offset, a, clamp((end * ab - ao) / aa), b, end));
    }
    return least;
}

/* From a point to the inside of a triangle; HUGE_VAL when its foot is outside. */
static double height_over(const double p[3], const double (*t)[3])
{
    double side[2][3], to[3], normal[3], square, along[2];

    between(side[0], t[0], t[1]);
    between(side[1], t[0], t[2]);
    between(to, t[0], p);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        normal[k] = side[0][i] * side[1][j] - side[0][j] * side[1][i];
    }
    square = dot(normal, normal);
    /* barycentric coordinates: (to x side1).n / n.n and (side0 x to).n / n.n */
    for (int which = 0; which < 2; which++) {
        const double *left = which == 0 ? to : side[0], *right = which == 0 ? side[1] : to;

        along[which] = 0;
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;

            along[which] += (left[i] * right[j] - left[j] * right[i]) * normal[k] / square;
        }
    }
    if (along[0] < 0 || along[1] < 0 || along[0] + along[1] > 1) {
        return HUGE_VAL;
    }
    return fabs(dot(to, normal)) / sqrt(square);
}

static void corners(double out[3][3], const struct oracle_mesh *mesh,
                    const struct oracle_pose *pose, size_t face)
{
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++) {
            out[c][k] = pose->position[k] +
                        dot(pose->rotation.row[k], mesh->vertices[mesh->faces[face][c]]);
        }
    }
}

/* The distance of two meshes that do not cross. */
static double distance(const struct oracle_mesh *a, const struct oracle_pose *pose_a,
                       const struct oracle_mesh *b, const struct oracle_pose *pose_b)
{
    double least = HUGE_VAL;

    for (size_t i = 0; i < a->face_count; i++) {
        double from[3][3];

        corners(from, a, pose_a, i);
        for (size_t j = 0; j < b->face_count; j++) {
            double to[3][3];

            corners(to, b, pose_b, j);
            for (int c = 0; c < 3; c++) {
                least = fmin(least, height_over(from[c], (const double(*)[3])to));
                least = fmin(least, height_over(to[c], (const double(*)[3])from));
                for (int d = 0; d < 3; d++) {
                    least = fmin(least, segment_distance(from[c], from[(c + 1) % 3], to[d],
                                                         to[(d + 1) % 3]));
                }
            }
        }
    }
    return least;
}

/* ------------------------------------------------------------------- motions */

/* How far a mesh reaches along a direction, from the point its position stands for. */
static double reach(const struct carom_mesh *mesh, const struct oracle_mesh *doubles,
                    const carom_quat_q30 *turned, const double direction[3])
{
    double most = -HUGE_VAL;

    for (size_t v = 0; v < doubles->vertex_count; v++) {
        double about[3], place[3];

        for (int k = 0; k < 3; k++) {
            about[k] = doubles->vertices[v][k] - lab_double(mesh->mass.centre.c[k], 22);
        }
        lab_rotate(place, turned, about);
        most = fmax(most, dot(place, direction));
    }
    return most;
}

/*
 * Both bodies turned at random, with a plane between them; the moving one heads for a point near
 * the other's centre, and turns by up to 0.4 radians, so that the frame is one slice.
 */
static void start(struct lab *lab, uint64_t *random)
{
    struct carom_body_def *body = &lab->scene.body, *ground = &lab->scene.ground;
    const double x[3] = {1, 0, 0};
    double away[3], facing[3], apart, speed = lab_random(random, 0.2, 1.5);
    carom_quat_q30 direction = lab_random_turn(random);

    body->rotation = lab_random_turn(random);
    ground->rotation = lab_random_turn(random);
    lab_rotate(away, &direction, x);
    for (int k = 0; k < 3; k++) {
        facing[k] = -away[k];
    }
    apart = reach(&lab->scene.ground_mesh, &lab->ground, &ground->rotation, away) +
            reach(&lab->scene.body_mesh, &lab->body, &body->rotation, facing) +
            lab_random(random, 0.005, 0.3);
    for (int k = 0; k < 3; k++) {
        double aim = lab_random(random, -0.4, 0.4);

        body->position.c[k] = lab_fixed(away[k] * apart, 32);
        body->velocity.c[k] = lab_fixed((aim - away[k] * apart) * speed, 40);
        body->spin.c[k] = lab_fixed(lab_random(random, -0.23, 0.23), 40);
    }
    lab_start(lab);
}

/* Pose number `sample` of the way from one state to another. */
static struct oracle_pose on_the_way(const struct lab *lab, const struct oracle_body *from,
                                     const struct oracle_body *to, int sample)
{
    const double *p = from->quaternion, *q = to->quaternion;
    double s = (double)sample / SAMPLES, cayley[4], turned[4], position[3], centre[3];

    /* conjugate(p) q is along (1, u); scale u by s */
    cayley[0] = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    for (int k = 0; k < 3; k++) {
        int i = 1 + (k + 1) % 3, j = 1 + (k + 2) % 3;

        cayley[1 + k] = s * (p[0] * q[1 + k] - q[0] * p[1 + k] - (p[i] * q[j] - p[j] * q[i]));
    }
    turned[0] = p[0] * cayley[0] - p[1] * cayley[1] - p[2] * cayley[2] - p[3] * cayley[3];
    for (int k = 0; k < 3; k++) {
        int i = 1 + (k + 1) % 3, j = 1 + (k + 2) % 3;

        turned[1 + k] =
            p[0] * cayley[1 + k] + cayley[0] * p[1 + k] + p[i] * cayley[j] - p[j] * cayley[i];
        position[k] = from->position[k] + s * (to->position[k] - from->position[k]);
        centre[k] = lab_double(lab->scene.body_mesh.mass.centre.c[k], 22);
    }
    return oracle_pose_make(position, turned, centre);
}

/* How far apart meshes may be at a hit. */
static double gap_allowed(const struct lab *lab, const struct oracle_body *body)
{
    double angle2 = dot(body->spin, body->spin);

    return 1.01 * lab->skin / 2 + angle2 / 12 * lab_double(lab->scene.body_mesh.radius_q22, 22);
}

struct verdict {
    long hits, crossed, early;
    double gap; /* the largest at a hit, of what is allowed */
};

static void judge(struct lab *lab, struct verdict *verdict)
{
    struct oracle_pose ground = lab_pose(lab, SCENE_GROUND), pose;
    struct oracle_body from = lab_body(lab), to;
    struct lab_tally tally = {0};
    bool crossed = false;

    lab_step(lab, &tally);
    to = lab_body(lab);
    for (int sample = 0; sample <= SAMPLES && !crossed; sample++) {
        pose = on_the_way(lab, &from, &to, sample);
        crossed = oracle_crossings(&lab->body, &pose, &lab->ground, &ground, 1e-9).pairs != 0;
    }
    verdict->crossed += crossed;
    if (tally.hits) {
        double gap = distance(&lab->body, &pose, &lab->ground, &ground) / gap_allowed(lab, &from);

        verdict->hits++;
        verdict->gap = fmax(verdict->gap, gap);
        verdict->early += gap > 1;
    }
}

static void test_pair(const struct carom_mesh_raw *ground, const struct carom_mesh_raw *body,
                      struct verdict *verdict, uint64_t *random)
{
    struct lab *lab = lab_load(ground, body);

    lab->config.gravity = (carom_v3_q40){{0, 0, 0}};
    lab->config.sleep = false;
    lab->config.substep_cap = 1;
    lab_surface(lab, 1, 0);
    for (int i = 0; i < MOTIONS; i++) {
        start(lab, random);
        judge(lab, verdict);
    }
    lab_free(lab);
}

int main(void)
{
    const struct carom_mesh_raw *meshes[4] = {&lab_box, &lab_l, &lab_tetrahedron, &lab_plate};
    const char *names[4] = {"first_hit/box", "first_hit/l", "first_hit/tetrahedron",
                            "first_hit/plate"};
    uint64_t random = 3;

    for (int i = 0; i < 4; i++) {
        struct verdict verdict = {0};

        for (int j = 0; j < 4; j++) {
            test_pair(meshes[j], meshes[i], &verdict, &random);
        }
        lab_report(
            verdict.hits > 2 * MOTIONS && verdict.crossed == 0 && verdict.early == 0, names[i],
            "%d motions, %ld hits, %ld crossed before, %ld early, gap at most %.2f of the bound",
            4 * MOTIONS, verdict.hits, verdict.crossed, verdict.early, verdict.gap);
    }
    return lab_finish();
}

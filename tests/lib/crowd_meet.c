/* SPDX-License-Identifier: MIT */
/* Meetings of two bodies of a crowd: places from which they soon touch in a known way. */
#include <limits.h>
#include <math.h>

#include "crowd.h"
#include "real.h"

#define TRIES 4000
/* Smallest distance of all other features behind the meeting one, in radii: many skins. */
#define CLEAR 0.02

/* A mesh about its centre of mass, turned. */
struct placed {
    const struct oracle_mesh *mesh;
    struct oracle_pose pose; /* its position leads from the centre to the mesh's origin */
    double radius;
};

/* The features that meet, about the centres of their bodies. */
struct feature {
    double on_a[3], on_b[3], normal[3]; /* N from b into a */
};

static double normalise(double v[3])
{
    double length = sqrt(real_dot(v, v));

    for (int k = 0; k < 3 && length > 0; k++) {
        v[k] /= length;
    }
    return length;
}

static struct placed placed(const struct crowd *crowd, int body)
{
    const struct crowd_mesh *mesh = &crowd->meshes[crowd->bodies[body].mesh];
    const double nowhere[3] = {0};
    struct placed out = {&mesh->solid, {{{{0}}}, {0}}, mesh->radius};
    double centre[3], wxyz[4];

    lab_quaternion(wxyz, &crowd->bodies[body].def.rotation);
    for (int k = 0; k < 3; k++) {
        centre[k] = lab_double(mesh->mesh.mass.centre.c[k], 22);
    }
    out.pose = oracle_pose_make(nowhere, wxyz, centre);
    return out;
}

static void vertex(double out[3], const struct placed *p, size_t v)
{
    for (int k = 0; k < 3; k++) {
        out[k] = real_dot(p->pose.rotation.row[k], p->mesh->vertices[v]) + p->pose.position[k];
    }
}

static size_t pick(size_t count, uint64_t *random)
{
    size_t i = (size_t)lab_random(random, 0, (double)count);

    return i < count ? i : count - 1;
}

static void face_of(const struct placed *p, size_t face, double corner[3][3], double normal[3])
{
    double side[2][3];

    for (int i = 0; i < 3; i++) {
        vertex(corner[i], p, p->mesh->faces[face][i]);
    }
    for (int k = 0; k < 3; k++) {
        side[0][k] = corner[1][k] - corner[0][k];
        side[1][k] = corner[2][k] - corner[0][k];
    }
    real_cross(normal, side[0], side[1]);
    normalise(normal);
}

/*
 * The number of vertices within `slack` of the farthest along `direction`, which is `best`. -1 when
 * another vertex is behind that, but not clear of it.
 */
static int farthest(const struct placed *p, const double direction[3], double *best, size_t *which)
{
    int count = 0;

    *best = -HUGE_VAL;
    *which = 0;
    for (size_t v = 0; v < p->mesh->vertex_count; v++) {
        double at[3];

        vertex(at, p, v);
        if (real_dot(at, direction) > *best) {
            *best = real_dot(at, direction);
            *which = v;
        }
    }
    for (size_t v = 0; v < p->mesh->vertex_count; v++) {
        double at[3], behind;

        vertex(at, p, v);
        behind = *best - real_dot(at, direction);
        count += behind < 1e-6 * p->radius;
        if (behind >= 1e-6 * p->radius && behind < CLEAR * p->radius) {
            return -1;
        }
    }
    return count;
}

/*
 * Whether no vertex of the body lies beyond a point along `direction`, and only so many are level
 * with it.
 */
static bool ends_at(const struct placed *p, const double point[3], const double direction[3],
                    int least, int most)
{
    double reach;
    size_t which;
    int count = farthest(p, direction, &reach, &which);

    return count >= least && count <= most &&
           reach <= real_dot(point, direction) + 1e-6 * p->radius;
}

static void opposite(double out[3], const double v[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = -v[k];
    }
}

/* A corner of a, the first that comes, above the inside of a face of b. */
static bool meet_corner(struct feature *out, const struct placed *a, const struct placed *b,
                        uint64_t *random)
{
    double corner[3][3], weight[3], down[3], reach;
    size_t which;

    face_of(b, pick(b->mesh->face_count, random), corner, out->normal);
    weight[0] = lab_random(random, 0.15, 0.6);
    weight[1] = lab_random(random, 0.15, 0.75 - weight[0]);
    weight[2] = 1 - weight[0] - weight[1];
    for (int k = 0; k < 3; k++) {
        out->on_b[k] =
            weight[0] * corner[0][k] + weight[1] * corner[1][k] + weight[2] * corner[2][k];
    }
    opposite(down, out->normal);
    if (farthest(a, down, &reach, &which) != 1) {
        return false;
    }
    vertex(out->on_a, a, which);
    return ends_at(b, out->on_b, out->normal, 3, INT_MAX);
}

/* A random edge and its direction. */
static void edge_of(const struct placed *p, double ends[2][3], double along[3], uint64_t *random)
{
    size_t face = pick(p->mesh->face_count, random), k = pick(3, random);

    vertex(ends[0], p, p->mesh->faces[face][k]);
    vertex(ends[1], p, p->mesh->faces[face][(k + 1) % 3]);
    for (int i = 0; i < 3; i++) {
        along[i] = ends[1][i] - ends[0][i];
    }
    normalise(along);
}

/* Edges that cross well inside both, with nothing of either body beyond them. */
static bool meet_edge(struct feature *out, const struct placed *a, const struct placed *b,
                      uint64_t *random)
{
    double ends[2][2][3], along[2][3], down[3];
    double share[2] = {lab_random(random, 0.25, 0.75), lab_random(random, 0.25, 0.75)};

    edge_of(a, ends[0], along[0], random);
    edge_of(b, ends[1], along[1], random);
    real_cross(out->normal, along[0], along[1]);
    if (normalise(out->normal) < 0.3) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        out->on_a[k] = ends[0][0][k] + share[0] * (ends[0][1][k] - ends[0][0][k]);
        out->on_b[k] = ends[1][0][k] + share[1] * (ends[1][1][k] - ends[1][0][k]);
    }
    if (real_dot(out->on_b, out->normal) < 0) {
        opposite(out->normal, out->normal);
    }
    opposite(down, out->normal);
    return ends_at(a, out->on_a, down, 2, 2) && ends_at(b, out->on_b, out->normal, 2, 2);
}

/* The rotation that takes the unit vector `from` to `to`. */
static carom_quat_q30 turn_between(const double from[3], const double to[3])
{
    double axis[3], angle = acos(fmax(-1, fmin(1, real_dot(from, to))));

    real_cross(axis, from, to);
    if (real_dot(axis, axis) < 1e-12) { /* any axis across it */
        axis[0] = from[1] - from[2];
        axis[1] = from[2] - from[0];
        axis[2] = from[0] - from[1];
    }
    return lab_turn(axis[0], axis[1], axis[2], angle);
}

/* A face of a flat on a face of b, middle on middle. Turns a, whose mesh is not turned before. */
static bool meet_flat(struct feature *out, struct crowd *crowd, int a, struct placed *at,
                      const struct placed *b, uint64_t *random)
{
    double corner[3][3], normal[3], down[3];
    size_t face = pick(at->mesh->face_count, random);

    face_of(b, pick(b->mesh->face_count, random), corner, out->normal);
    for (int k = 0; k < 3; k++) {
        out->on_b[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3;
    }
    opposite(down, out->normal);
    face_of(at, face, corner, normal);
    crowd->bodies[a].def.rotation = turn_between(normal, down);
    *at = placed(crowd, a);
    face_of(at, face, corner, normal);
    for (int k = 0; k < 3; k++) {
        out->on_a[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3;
    }
    return ends_at(at, out->on_a, down, 3, INT_MAX) &&
           ends_at(b, out->on_b, out->normal, 3, INT_MAX);
}

static bool overlap(const struct crowd *crowd, int a, int b, const struct placed *at_a,
                    const struct placed *at_b)
{
    const struct carom_body_def *def[2] = {&crowd->bodies[a].def, &crowd->bodies[b].def};
    struct oracle_pose pose[2] = {at_a->pose, at_b->pose};

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            pose[i].position[k] += lab_double(def[i]->position.c[k], 32);
        }
    }
    return oracle_crossings(at_a->mesh, &pose[0], at_b->mesh, &pose[1], 1e-9).pairs != 0;
}

static void any_across(double out[3], const double normal[3], uint64_t *random)
{
    double other[3];

    do {
        for (int k = 0; k < 3; k++) {
            other[k] = lab_random(random, -1, 1);
        }
        real_cross(out, normal, other);
    } while (normalise(out) < 0.1);
}

bool crowd_meet(struct crowd *crowd, int a, int b, enum crowd_how how, double gap, double slant,
                uint64_t *random, double normal[3], double along[3], double point[3])
{
    struct carom_body_def *def = &crowd->bodies[a].def;
    struct placed at_b = placed(crowd, b), at_a;
    struct feature met;

    for (int i = 0; i < TRIES; i++) {
        bool found;
        double across[3];

        def->rotation = how == CROWD_FLAT ? (carom_quat_q30){{0}} : lab_random_turn(random);
        at_a = placed(crowd, a);
        found = how == CROWD_CORNER ? meet_corner(&met, &at_a, &at_b, random)
                : how == CROWD_EDGE ? meet_edge(&met, &at_a, &at_b, random)
                                    : meet_flat(&met, crowd, a, &at_a, &at_b, random);
        if (!found) {
            continue;
        }
        any_across(across, met.normal, random);
        for (int k = 0; k < 3; k++) {
            normal[k] = met.normal[k];
            along[k] = slant * across[k] - met.normal[k];
            point[k] = lab_double(crowd->bodies[b].def.position.c[k], 32) + met.on_b[k];
            def->position.c[k] = crowd->bodies[b].def.position.c[k] +
                                 lab_fixed(met.on_b[k] - met.on_a[k] - gap * along[k], 32);
        }
        if (!overlap(crowd, a, b, &at_a, &at_b)) {
            return true;
        }
    }
    return false;
}

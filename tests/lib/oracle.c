/* SPDX-License-Identifier: MIT */
/* An independent judge of frames in double precision: crossings, their depth, energy. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle.h"
#include "real.h"

/* ------------------------------------------------------------------- vectors */

static void subtract(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

static bool normalise(double v[3])
{
    double length = sqrt(real_dot(v, v));

    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return length > 0;
}

static void rotate(double out[3], const struct oracle_matrix *m, const double v[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = real_dot(m->row[k], v);
    }
}

/* fmin and fmax are calls, these functions are not. */
static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static void *need(size_t count, size_t bytes)
{
    void *memory = calloc(count ? count : 1, bytes);

    if (!memory) {
        fputs("oracle: no memory\n", stderr);
        exit(1);
    }
    return memory;
}

/* -------------------------------------------------------------- meshes, poses */

struct oracle_mesh oracle_mesh_make(const int16_t (*vertices)[3], size_t vertex_count,
                                    const uint16_t (*faces)[3], size_t face_count, int quantum_bits)
{
    struct oracle_mesh mesh = {vertex_count, face_count, NULL, NULL};

    mesh.vertices = need(vertex_count, sizeof *mesh.vertices);
    mesh.faces = need(face_count, sizeof *mesh.faces);
    for (size_t v = 0; v < vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            mesh.vertices[v][k] = ldexp(vertices[v][k], -quantum_bits);
        }
    }
    for (size_t f = 0; f < face_count; f++) {
        for (int k = 0; k < 3; k++) {
            mesh.faces[f][k] = faces[f][k];
        }
    }
    return mesh;
}

void oracle_mesh_free(struct oracle_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->faces);
    *mesh = (struct oracle_mesh){0};
}

/* Column k of the matrix is q e_k q*, by Rodrigues: e + 2 w (u x e) + 2 u x (u x e). */
static struct oracle_matrix matrix_of(const double quaternion[4])
{
    struct oracle_matrix m;
    double length = 0, w, u[3];

    for (int k = 0; k < 4; k++) {
        length += quaternion[k] * quaternion[k];
    }
    length = sqrt(length);
    w = quaternion[0] / length;
    for (int k = 0; k < 3; k++) {
        u[k] = quaternion[k + 1] / length;
    }
    for (int k = 0; k < 3; k++) {
        double axis[3] = {k == 0, k == 1, k == 2}, once[3], twice[3];

        real_cross(once, u, axis);
        real_cross(twice, u, once);
        for (int i = 0; i < 3; i++) {
            m.row[i][k] = axis[i] + 2 * w * once[i] + 2 * twice[i];
        }
    }
    return m;
}

struct oracle_pose oracle_pose_make(const double position[3], const double quaternion[4],
                                    const double centre[3])
{
    struct oracle_pose pose;
    double turned[3];

    pose.rotation = matrix_of(quaternion);
    rotate(turned, &pose.rotation, centre);
    subtract(pose.position, position, turned);
    return pose;
}

/* ------------------------------------------------------------------ piercing */

double oracle_piercing(const double p[3], const double q[3], const double a[3], const double b[3],
                       const double c[3])
{
    const double *corner[3] = {a, b, c};
    double side[3][3], normal[3], to_p[3], to_q[3], point[3], above_p, above_q, depth;

    for (int k = 0; k < 3; k++) {
        subtract(side[k], corner[(k + 1) % 3], corner[k]);
    }
    real_cross(normal, side[0], side[1]);
    if (!normalise(normal)) {
        return 0;
    }
    subtract(to_p, p, a);
    subtract(to_q, q, a);
    above_p = real_dot(normal, to_p);
    above_q = real_dot(normal, to_q);
    if ((above_p > 0) == (above_q > 0)) {
        return 0;
    }
    depth = smaller(fabs(above_p), fabs(above_q));
    for (int k = 0; k < 3; k++) {
        point[k] = p[k] + (q[k] - p[k]) * (above_p / (above_p - above_q));
    }
    for (int k = 0; k < 3; k++) {
        double inwards[3], from[3];

        real_cross(inwards, normal, side[k]);
        if (!normalise(inwards)) {
            return 0;
        }
        subtract(from, point, corner[k]);
        depth = smaller(depth, real_dot(inwards, from));
    }
    return depth;
}

/* ------------------------------------------------------------------ crossings */

/* A face in the world, with its box. */
struct placed {
    double corner[3][3];
    double low[3], high[3];
    uint32_t face;
};

struct set {
    struct placed *items;
    size_t count;
    double low[3], high[3]; /* box of all */
};

static void place(struct placed *out, const struct oracle_mesh *mesh, uint32_t face,
                  double (*world)[3])
{
    out->face = face;
    for (int i = 0; i < 3; i++) {
        memcpy(out->corner[i], world[mesh->faces[face][i]], sizeof out->corner[i]);
    }
    for (int k = 0; k < 3; k++) {
        out->low[k] = smaller(out->corner[0][k], smaller(out->corner[1][k], out->corner[2][k]));
        out->high[k] = larger(out->corner[0][k], larger(out->corner[1][k], out->corner[2][k]));
    }
}

/* All faces of a mesh in the world. */
static struct set place_all(const struct oracle_mesh *mesh, const struct oracle_pose *pose)
{
    struct set set = {need(mesh->face_count, sizeof *set.items), mesh->face_count, {0}, {0}};
    double(*world)[3] = need(mesh->vertex_count, sizeof *world);

    for (int k = 0; k < 3; k++) {
        set.low[k] = HUGE_VAL;
        set.high[k] = -HUGE_VAL;
    }
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        rotate(world[v], &pose->rotation, mesh->vertices[v]);
        for (int k = 0; k < 3; k++) {
            world[v][k] += pose->position[k];
            set.low[k] = smaller(set.low[k], world[v][k]);
            set.high[k] = larger(set.high[k], world[v][k]);
        }
    }
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        place(&set.items[f], mesh, f, world);
    }
    free(world);
    return set;
}

static bool boxes_meet(const double low_a[3], const double high_a[3], const double low_b[3],
                       const double high_b[3])
{
    for (int k = 0; k < 3; k++) {
        if (low_a[k] > high_b[k] || low_b[k] > high_a[k]) {
            return false;
        }
    }
    return true;
}

/* Keep only the faces that overlap a box. */
static void keep_in(struct set *set, const double low[3], const double high[3])
{
    size_t kept = 0;

    for (size_t i = 0; i < set->count; i++) {
        if (boxes_meet(set->items[i].low, set->items[i].high, low, high)) {
            set->items[kept++] = set->items[i];
        }
    }
    set->count = kept;
}

static int by_low_x(const void *a, const void *b)
{
    double x = ((const struct placed *)a)->low[0], y = ((const struct placed *)b)->low[0];

    return (x > y) - (x < y);
}

/* The depth of the deepest of the three edges of one face through the other. */
static double deepest_edge(const struct placed *edges, const struct placed *face)
{
    double depth = 0;

    for (int k = 0; k < 3; k++) {
        depth = larger(depth, oracle_piercing(edges->corner[k], edges->corner[(k + 1) % 3],
                                              face->corner[0], face->corner[1], face->corner[2]));
    }
    return depth;
}

/*
 * Whether one face lies wholly on one side of the other's plane: then no edge of either can pierce.
 */
static bool on_one_side(const struct placed *one, const struct placed *other)
{
    double side[2][3], normal[3], from[3];
    int above = 0, below = 0;

    subtract(side[0], other->corner[1], other->corner[0]);
    subtract(side[1], other->corner[2], other->corner[0]);
    real_cross(normal, side[0], side[1]);
    for (int i = 0; i < 3; i++) {
        double height;

        subtract(from, one->corner[i], other->corner[0]);
        height = real_dot(normal, from);
        above += height > 0;
        below += height < 0;
    }
    return above == 3 || below == 3;
}

static void test_pair(struct oracle_crossings *out, const struct placed *a, const struct placed *b,
                      double tolerance)
{
    double depth_a, depth_b, depth;

    if (on_one_side(a, b) || on_one_side(b, a)) {
        return;
    }
    depth_a = deepest_edge(a, b);
    depth_b = deepest_edge(b, a);
    depth = larger(depth_a, depth_b);
    if (depth <= tolerance) {
        return;
    }
    out->pairs++;
    out->by_a += depth_a > tolerance;
    out->by_b += depth_b > tolerance;
    if (depth > out->depth) {
        out->depth = depth;
        out->face_a = a->face;
        out->face_b = b->face;
    }
}

/* Sweep along x: each face against the faces of the other mesh that begin within its extent. */
static void sweep(struct oracle_crossings *out, const struct set *a, const struct set *b,
                  double tolerance)
{
    size_t i = 0, j = 0;

    while (i < a->count && j < b->count) {
        bool first_is_a = a->items[i].low[0] <= b->items[j].low[0];
        const struct placed *first = first_is_a ? &a->items[i] : &b->items[j];
        const struct set *others = first_is_a ? b : a;

        for (size_t k = first_is_a ? j : i;
             k < others->count && others->items[k].low[0] <= first->high[0]; k++) {
            const struct placed *other = &others->items[k];

            if (boxes_meet(first->low, first->high, other->low, other->high)) {
                test_pair(out, first_is_a ? first : other, first_is_a ? other : first, tolerance);
            }
        }
        *(first_is_a ? &i : &j) += 1;
    }
}

struct oracle_crossings oracle_crossings(const struct oracle_mesh *a,
                                         const struct oracle_pose *pose_a,
                                         const struct oracle_mesh *b,
                                         const struct oracle_pose *pose_b, double tolerance)
{
    struct oracle_crossings out = {0};
    struct set set_a = place_all(a, pose_a), set_b = place_all(b, pose_b);

    keep_in(&set_a, set_b.low, set_b.high);
    keep_in(&set_b, set_a.low, set_a.high);
    qsort(set_a.items, set_a.count, sizeof *set_a.items, by_low_x);
    qsort(set_b.items, set_b.count, sizeof *set_b.items, by_low_x);
    sweep(&out, &set_a, &set_b, tolerance);
    free(set_a.items);
    free(set_b.items);
    return out;
}

/* ------------------------------------------------------------ distances, inside */

static double clamp(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

/*
 * The squared distance of the segments p p1 and q q1: find the nearest point of one, then of the
 * other.
 */
static double between_segments(const double p[3], const double p1[3], const double q[3],
                               const double q1[3])
{
    double e[3], f[3], d[3], ee, ff, ef, de, df, s = 0, t, away[3];

    subtract(e, p1, p);
    subtract(f, q1, q);
    subtract(d, p, q);
    ee = real_dot(e, e);
    ff = real_dot(f, f);
    ef = real_dot(e, f);
    de = real_dot(d, e);
    df = real_dot(d, f);
    if (ee * ff - ef * ef > 1e-12 * ee * ff) {
        s = clamp((ef * df - de * ff) / (ee * ff - ef * ef));
    }
    t = clamp((df + s * ef) / ff);
    s = clamp((t * ef - de) / ee);
    t = clamp((df + s * ef) / ff);
    for (int k = 0; k < 3; k++) {
        away[k] = d[k] + s * e[k] - t * f[k];
    }
    return real_dot(away, away);
}

/* Whether a point is within a distance of a face, and above it. */
static bool over_face(const double p[3], const struct placed *face, double distance)
{
    double side[3][3], normal[3], from[3];

    for (int k = 0; k < 3; k++) {
        subtract(side[k], face->corner[(k + 1) % 3], face->corner[k]);
    }
    real_cross(normal, side[0], side[1]);
    for (int k = 0; k < 3; k++) {
        double inwards[3];

        real_cross(inwards, normal, side[k]);
        subtract(from, p, face->corner[k]);
        if (real_dot(inwards, from) < 0) {
            return false;
        }
    }
    return normalise(normal) && fabs(real_dot(normal, from)) <= distance;
}

static bool faces_near(const struct placed *a, const struct placed *b, double distance)
{
    for (int i = 0; i < 3; i++) {
        if (over_face(a->corner[i], b, distance) || over_face(b->corner[i], a, distance)) {
            return true;
        }
        for (int j = 0; j < 3; j++) {
            if (between_segments(a->corner[i], a->corner[(i + 1) % 3], b->corner[j],
                                 b->corner[(j + 1) % 3]) <= distance * distance) {
                return true;
            }
        }
    }
    return !on_one_side(a, b) && !on_one_side(b, a) &&
           larger(deepest_edge(a, b), deepest_edge(b, a)) > 0;
}

static void grow(double low[3], double high[3], double by)
{
    for (int k = 0; k < 3; k++) {
        low[k] -= by;
        high[k] += by;
    }
}

bool oracle_near(const struct oracle_mesh *a, const struct oracle_pose *pose_a,
                 const struct oracle_mesh *b, const struct oracle_pose *pose_b, double distance)
{
    struct set set_a = place_all(a, pose_a), set_b = place_all(b, pose_b);
    bool near = false;

    grow(set_a.low, set_a.high, distance);
    grow(set_b.low, set_b.high, distance);
    keep_in(&set_a, set_b.low, set_b.high);
    keep_in(&set_b, set_a.low, set_a.high);
    for (size_t i = 0; i < set_a.count && !near; i++) {
        struct placed *one = &set_a.items[i];

        grow(one->low, one->high, distance);
        for (size_t j = 0; j < set_b.count && !near; j++) {
            const struct placed *other = &set_b.items[j];

            near = boxes_meet(one->low, one->high, other->low, other->high) &&
                   faces_near(one, other, distance);
        }
    }
    free(set_a.items);
    free(set_b.items);
    return near;
}

/* Half the solid angle of a triangle seen from the origin: Van Oosterom and Strackee. */
static double half_angle(const double a[3], const double b[3], const double c[3])
{
    double across[3], la = real_length(a), lb = real_length(b), lc = real_length(c);

    real_cross(across, b, c);
    return atan2(real_dot(a, across),
                 la * lb * lc + real_dot(a, b) * lc + real_dot(b, c) * la + real_dot(c, a) * lb);
}

bool oracle_inside(const struct oracle_mesh *mesh, const double point[3])
{
    double sum = 0;

    for (size_t f = 0; f < mesh->face_count; f++) {
        double corner[3][3];

        for (int k = 0; k < 3; k++) {
            subtract(corner[k], mesh->vertices[mesh->faces[f][k]], point);
        }
        sum += half_angle(corner[0], corner[1], corner[2]);
    }
    return sum > acos(-1); /* 2 pi inside, 0 outside */
}

bool oracle_under(const struct oracle_mesh *mesh, const double point[3])
{
    for (size_t f = 0; f < mesh->face_count; f++) {
        double corner[3][3], share[3], sum = 0, height = 0;

        for (int k = 0; k < 3; k++) {
            subtract(corner[k], mesh->vertices[mesh->faces[f][k]], point);
        }
        for (int k = 0; k < 3; k++) {
            const double *p = corner[(k + 1) % 3], *q = corner[(k + 2) % 3];

            share[k] = p[0] * q[1] - p[1] * q[0];
            sum += share[k];
            height += share[k] * corner[k][2];
        }
        if (share[0] >= 0 && share[1] >= 0 && share[2] >= 0 && sum > 0) {
            return height > 0;
        }
    }
    return false;
}

/* --------------------------------------------------------------------- energy */

double oracle_energy(const struct oracle_body *body, const double gravity[3])
{
    const double *i = body->inertia;
    const struct oracle_matrix tensor = {
        {{i[0], i[3], i[5]}, {i[3], i[1], i[4]}, {i[5], i[4], i[2]}}};
    const struct oracle_matrix m = matrix_of(body->quaternion);
    double spin[3] = {0, 0, 0}, momentum[3]; /* in the body's axes */

    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            spin[k] += m.row[j][k] * body->spin[j];
        }
    }
    rotate(momentum, &tensor, spin);
    return body->mass * (real_dot(body->velocity, body->velocity) / 2 +
                         real_dot(spin, momentum) / 2 - real_dot(gravity, body->position));
}

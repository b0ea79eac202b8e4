/* SPDX-License-Identifier: MIT */
/* Two convex bodies that meet in special positions: exactly, or off by a unit of the last place. */
#include <math.h>
#include <string.h>

#include "lab.h"
#include "real.h"
#include "special.h"

const char *const special_names[SPECIAL_CLASSES] = {"peak_peak",   "peak_ridge",   "peak_face",
                                                    "peak_border", "ridge_across", "ridge_along",
                                                    "ridge_end",   "ridge_border", "face_face"};

/* -------------------------------------------------------------------- shapes */

/* Vertices in doubles, until the quantum is known. */
struct outline {
    double p[SPECIAL_VERTICES][3];
    int count, faces;
};

static void add_point(struct outline *o, double x, double y, double z)
{
    const double p[3] = {x, y, z};

    memcpy(o->p[o->count++], p, sizeof p);
}

static void add_face(struct special_shape *s, struct outline *o, int a, int b, int c)
{
    const int corner[3] = {a, b, c};

    for (int k = 0; k < 3; k++) {
        s->faces[o->faces][k] = (uint16_t)corner[k];
    }
    o->faces++;
}

/* Scale to the finest quantum that holds the outline, and build. */
static void build(struct special_shape *s, const struct outline *o)
{
    double largest = 0;
    int bits = 20;

    for (int v = 0; v < o->count; v++) {
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(o->p[v][k]));
        }
    }
    while (bits > 7 && largest * real_power2(bits) > 32000) {
        bits--;
    }
    for (int v = 0; v < o->count; v++) {
        for (int k = 0; k < 3; k++) {
            s->vertices[v][k] = (int16_t)lab_fixed(o->p[v][k], bits);
        }
    }
    s->raw = (struct carom_mesh_raw){(const int16_t(*)[3])s->vertices,
                                     (const uint16_t(*)[3])s->faces,
                                     (uint32_t)o->count,
                                     (uint32_t)o->faces,
                                     (uint8_t)bits,
                                     CAROM_SOLID};
    lab_expect(carom_mesh_build(&s->mesh, &s->raw, s->block, sizeof s->block), "mesh");
}

/* A pyramid with its tip at the origin. */
static void make_peak(struct special_shape *s, double size, double slope, uint64_t *random)
{
    struct outline o = {.count = 0};
    double steep = tan(slope), wide = steep > 1 ? size / steep : size, from;
    int sides = (int)lab_random(random, 3, 7);

    from = lab_random(random, 0, 1) < 0.5 ? 0 : lab_random(random, 0, 1);
    add_point(&o, 0, 0, 0);
    for (int k = 0; k < sides; k++) {
        double angle = 2 * REAL_PI * (k + from) / sides;

        add_point(&o, wide * cos(angle), wide * sin(angle), -wide * steep);
    }
    for (int k = 0; k < sides; k++) {
        add_face(s, &o, 0, 1 + k, 1 + (k + 1) % sides);
        if (k > 1) {
            add_face(s, &o, 1, 1 + k, k);
        }
    }
    memset(s->top, 0, sizeof s->top);
    build(s, &o);
}

/*
 * A frustum: its top is a rectangle of half sides x, y at z = 0, and its sides along y have the
 * given slopes; a ridge when y is 0.
 */
static void make_frustum(struct special_shape *s, double x, double y, double size,
                         const double slope[2], double overhang)
{
    struct outline o = {.count = 0};
    double steep[2] = {tan(slope[0]), tan(slope[1])}, least = fmin(steep[0], steep[1]);
    double high = least > 1 ? size : size * least, end = x + overhang * high;
    int n = y > 0 ? 4 : 2;

    add_point(&o, -x, -y, 0);
    add_point(&o, x, -y, 0);
    if (y > 0) {
        add_point(&o, x, y, 0);
        add_point(&o, -x, y, 0);
        add_face(s, &o, 0, 1, 2);
        add_face(s, &o, 0, 2, 3);
    }
    add_point(&o, -end, -y - high / steep[0], -high);
    add_point(&o, end, -y - high / steep[0], -high);
    add_point(&o, end, y + high / steep[1], -high);
    add_point(&o, -end, y + high / steep[1], -high);
    add_face(s, &o, n, n + 2, n + 1);
    add_face(s, &o, n, n + 3, n + 2);
    for (int k = 0; k < 4; k++) {
        int next = (k + 1) % 4, top = y > 0 ? k : k == 0 || k == 3 ? 0 : 1;
        int top_next = y > 0 ? next : next == 0 || next == 3 ? 0 : 1;

        add_face(s, &o, n + k, n + next, top_next);
        if (top != top_next) {
            add_face(s, &o, n + k, top_next, top);
        }
    }
    memset(s->top, 0, sizeof s->top);
    build(s, &o);
}

static double random_slope(uint64_t *random)
{
    return lab_random(random, 5, 85) * REAL_PI / 180;
}

/* Log-uniform. */
static double random_scale(uint64_t *random, double low, double high)
{
    return low * pow(high / low, lab_random(random, 0, 1));
}

enum feature { PEAK, RIDGE, TOP };

static void make_shape(struct special *c, int which, enum feature feature, double length,
                       uint64_t *random)
{
    struct special_shape *s = &c->shape[which];
    double size = c->size[which], *slope = c->slope[which];

    slope[0] = random_slope(random);
    slope[1] = lab_random(random, 0, 1) < 0.5 ? slope[0] : random_slope(random);
    if (feature == PEAK) {
        make_peak(s, size, slope[0], random);
    } else {
        double y = feature == RIDGE ? 0 : size * lab_random(random, 0.3, 1);
        double overhang = lab_random(random, 0, 1) < 0.5 ? 0 : lab_random(random, 0, 1.5);

        make_frustum(s, length, y, size, slope, overhang);
    }
}

/* ------------------------------------------------------------------ alignment */

static void choose_sizes(struct special *c, uint64_t *random)
{
    double kind = lab_random(random, 0, 1);
    int small = lab_random(random, 0, 1) < 0.5;

    c->size[0] = random_scale(random, 0.1, 10);
    c->size[1] = kind < 0.3 ? c->size[0] : random_scale(random, 0.1, 10);
    if (kind > 0.8) {
        c->size[small] = random_scale(random, 0.1, 0.15);
        c->size[1 - small] = 100 * c->size[small];
    }
}

static double random_offset(uint64_t *random)
{
    static const double offsets[] = {0, 0, 0x1p-32, 0x1p-22, 1e-6, 1e-5, 1e-4, 1e-3};

    return offsets[(int)lab_random(random, 0, 8)];
}

/* Radians, up to 0.2 degrees: 0, uniform, or log-uniform. */
static double random_yaw(uint64_t *random)
{
    const double most = 0.2 * REAL_PI / 180;
    double kind = lab_random(random, 0, 1), yaw = lab_random(random, -most, most);

    return kind < 0.25  ? 0
           : kind < 0.6 ? yaw
                        : (yaw < 0 ? -1 : 1) * random_scale(random, 1e-9, most);
}

/* Choose the place of meeting along a body's feature. */
static void choose_top(struct special *c, int which, enum feature feature, uint64_t *random)
{
    struct special_shape *s = &c->shape[which];
    double end[3];

    if (feature == PEAK) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        end[k] = fabs(real(s->vertices[0][k], s->raw.quantum_bits));
    }
    s->top[0] = end[0] * (c->class == SPECIAL_RIDGE_END ? which == 0 ? 1 : 1
                                                        : lab_random(random, -0.95, 0.95));
    s->top[1] = 0;
    if (feature == TOP && c->class == SPECIAL_PEAK_FACE) {
        /* on the diagonal, or anywhere */
        s->top[1] = lab_random(random, 0, 1) < 0.5 ? end[1] * s->top[0] / end[0]
                                                   : end[1] * lab_random(random, -0.95, 0.95);
    } else if (feature == TOP) {
        s->top[1] = end[1];
        if (lab_random(random, 0, 1) < (c->class == SPECIAL_PEAK_BORDER ? 0.3 : 0.5)) {
            s->top[0] = end[0];
        }
    }
}

static void choose_shapes(struct special *c, uint64_t *random)
{
    static const enum feature features[SPECIAL_CLASSES][2] = {
        {PEAK, PEAK},   {RIDGE, PEAK},  {TOP, PEAK},  {TOP, PEAK}, {RIDGE, RIDGE},
        {RIDGE, RIDGE}, {RIDGE, RIDGE}, {TOP, RIDGE}, {TOP, TOP}};
    int swap = lab_random(random, 0, 1) < 0.3;
    double length[2];

    for (int i = 0; i < 2; i++) {
        length[i] = c->size[i] * lab_random(random, 0.3, 2);
    }
    /* and sometimes very long ground */
    if (c->size[1] < 1 && lab_random(random, 0, 1) < 0.1) {
        length[0] = lab_random(random, 30, 100);
    }
    /* equal tops, whose edges all lie over each other */
    if (c->class == SPECIAL_FACE_FACE && c->size[0] == c->size[1] && length[0] < 20) {
        length[1] = length[0];
    }
    for (int i = 0; i < 2; i++) {
        enum feature feature = features[c->class][i ^ swap];

        make_shape(c, i, feature, length[i], random);
        choose_top(c, i, feature, random);
    }
}

/* ---------------------------------------------------------------------- motion */

static carom_quat_q30 product(const carom_quat_q30 *a, const carom_quat_q30 *b)
{
    double p[4], q[4];

    lab_quaternion(p, a);
    lab_quaternion(q, b);
    return (carom_quat_q30){
        {(int32_t)lab_fixed(p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], 30),
         (int32_t)lab_fixed(p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2], 30),
         (int32_t)lab_fixed(p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], 30),
         (int32_t)lab_fixed(p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0], 30)}};
}

struct motion {
    double velocity[2][3], spin[2][3];
};

static void choose_motion(struct special *c, struct motion *m, uint64_t *random)
{
    double least = fmin(c->size[0], c->size[1]), kind = lab_random(random, 0, 1);
    double angle = lab_random(random, 0, 2 * REAL_PI), way[3], share, moves;

    c->speed = least * random_scale(random, 1e-6, 1);
    c->slant = kind < 0.4   ? 0
               : kind < 0.8 ? lab_random(random, 0, 1.5)
                            : random_scale(random, 2, 100);
    c->slant = fmin(c->slant, 15 / c->speed);
    c->time = lab_random(random, 0.2, 2.8);
    way[0] = c->speed * c->slant * cos(angle);
    way[1] = c->speed * c->slant * sin(angle);
    way[2] = -c->speed;
    moves = lab_random(random, 0, 1);
    share = moves < 0.4 ? 1 : moves < 0.6 ? 0 : lab_random(random, 0, 1);
    /* a moving body has a radius of up to 32 units */
    for (int i = 0; i < 2; i++) {
        if (c->shape[i].mesh.radius_q22 > 31 << 22) {
            share = i == 0 ? 1 : 0;
        }
    }
    c->def[0].stationary = share == 1;
    c->def[1].stationary = share == 0;
    c->spin = lab_random(random, 0, 1) < 0.5 ? 0 : random_scale(random, 1e-4, 0.4);
    for (int i = 0; i < 2; i++) {
        double axis[3] = {0, 0, 0}, size, radius = real(c->shape[i].mesh.radius_q22, 22);
        double rate = fmin(c->spin * lab_random(random, 0, 1), 20 / radius);
        int along = (int)lab_random(random, 0, 5);

        for (int k = 0; k < 3; k++) {
            m->velocity[i][k] = way[k] * (i == 1 ? share : share - 1);
            axis[k] = along < 3 ? k == along : lab_random(random, -1, 1);
        }
        size = real_length(axis);
        for (int k = 0; k < 3; k++) {
            m->spin[i][k] = c->def[i].stationary ? 0 : axis[k] / size * rate;
        }
    }
    if (c->def[0].stationary && lab_random(random, 0, 1) < 0.5) {
        c->weight = 9.81 / 3600;
    }
}

/*
 * Pose body `which` at the time of the meeting, with its feature at `at`; then go back some frames.
 */
static void place(struct special *c, int which, const carom_quat_q30 *turned, const double at[3],
                  const struct motion *m, double lift)
{
    const struct special_shape *s = &c->shape[which];
    struct carom_body_def *def = &c->def[which];
    double rate = real_length(m->spin[which]), arm[3], centre[3];
    carom_quat_q30 back;

    def->mesh = &s->mesh;
    def->rotation = *turned;
    for (int k = 0; k < 3; k++) {
        arm[k] = real(s->mesh.mass.centre.c[k], 22) - s->top[k];
    }
    lab_rotate(centre, turned, arm);
    if (rate > 0) {
        const double *w = m->spin[which];

        back = lab_turn(w[0], w[1], w[2], -rate * c->time);
        def->rotation = product(&back, turned);
    }
    for (int k = 0; k < 3; k++) {
        double x = at[k] + centre[k] - m->velocity[which][k] * c->time + (k == 2 ? lift : 0);

        def->position.c[k] = lab_fixed(x, 32);
        def->velocity.c[k] = lab_fixed(m->velocity[which][k], 40);
        def->spin.c[k] = lab_fixed(m->spin[which][k], 40);
    }
}

/* Turn a whole case about the origin. */
static void turn_all(struct special *c, const carom_quat_q30 *turn, const double away[3])
{
    const double up[3] = {0, 0, 1};

    lab_rotate(c->up, turn, up);
    for (int i = 0; i < 2; i++) {
        struct carom_body_def *def = &c->def[i];
        double v[3], out[3];

        def->rotation = product(turn, &def->rotation);
        for (int k = 0; k < 3; k++) {
            v[k] = lab_double(def->position.c[k], 32);
        }
        lab_rotate(out, turn, v);
        for (int k = 0; k < 3; k++) {
            def->position.c[k] = lab_fixed(out[k] + away[k], 32);
            v[k] = lab_double(def->velocity.c[k], 40);
        }
        lab_rotate(out, turn, v);
        for (int k = 0; k < 3; k++) {
            def->velocity.c[k] = lab_fixed(out[k], 40);
            v[k] = lab_double(def->spin.c[k], 40);
        }
        lab_rotate(out, turn, v);
        for (int k = 0; k < 3; k++) {
            def->spin.c[k] = lab_fixed(out[k], 40);
        }
    }
    for (int k = 0; k < 3; k++) {
        c->gravity.c[k] = -lab_fixed(c->up[k] * c->weight, 40);
    }
}

static void align(struct special *c, const struct motion *m, uint64_t *random)
{
    const carom_quat_q30 upright = {{CAROM_ONE_Q30, 0, 0, 0}}, over = {{0, CAROM_ONE_Q30, 0, 0}};
    double angle = lab_random(random, 0, 1) < 0.5 ? (int)lab_random(random, 0, 4) * REAL_PI / 2
                                                  : lab_random(random, 0, 2 * REAL_PI);
    double origin[3] = {0, 0, 0}, at[3], away[3] = {0, 0, 0}, lift = 0x1p-18;
    carom_quat_q30 turn = lab_turn(0, 0, 1, 0), all;

    c->offset = random_offset(random);
    c->yaw = random_yaw(random);
    if (c->class == SPECIAL_RIDGE_ACROSS || c->class < SPECIAL_PEAK_FACE) {
        c->yaw = lab_random(random, 0, 1) < 0.3 ? c->yaw : lab_random(random, -3, 3);
    }
    if (c->class == SPECIAL_RIDGE_END) {
        c->yaw += REAL_PI; /* ends face each other */
    }
    turn = lab_turn(0, 0, 1, c->yaw);
    turn = product(&turn, &over);
    at[0] = c->offset * cos(angle);
    at[1] = c->offset * sin(angle);
    at[2] = 0;
    place(c, 0, &upright, origin, m, 0);
    place(c, 1, &turn, at, m, lift);
    if (lab_random(random, 0, 1) < 0.6) {
        all = lab_random_turn(random);
        for (int k = 0; k < 3; k++) {
            away[k] = lab_random(random, -100, 100);
        }
    } else {
        all = lab_turn(0, 0, 1, 0);
    }
    turn_all(c, &all, away);
}

void special_place(struct crossing_hull *hull, const struct special *s, int which,
                   const carom_v3_q32 *position, const carom_quat_q30 *rotation)
{
    double x[3], q[4];

    /* relative to one place, so that doubles keep digits for small differences */
    for (int k = 0; k < 3; k++) {
        x[k] = lab_double(position->c[k] - s->def[0].position.c[k], 32);
    }
    lab_quaternion(q, rotation);
    crossing_place_hull(hull, &s->shape[which].mesh, x, q);
}

static double apart_at_start(const struct special *c)
{
    struct crossing_hull hull[2];

    for (int i = 0; i < 2; i++) {
        special_place(&hull[i], c, i, &c->def[i].position, &c->def[i].rotation);
    }
    return crossing_apart(&hull[0], &hull[1]);
}

/* Come from a smaller offset, and turn less. */
static void straighten(struct special *c, struct motion *m)
{
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            m->velocity[i][k] *= k == 2 ? 1 : 0.5;
            m->spin[i][k] *= 0.5;
        }
    }
    c->slant *= 0.5;
    c->spin *= 0.5;
}

void special_make(struct special *c, long number)
{
    uint64_t random = 0x9e3779b97f4a7c15u * (uint64_t)(number + 1);
    static const double restitutions[] = {0, 0, 0.5, 1}, frictions[] = {0, 0.5};
    struct motion m;
    double e, mu;

    memset(c, 0, sizeof *c);
    c->number = number;
    c->class = (enum special_class)(number % SPECIAL_CLASSES);
    (void)lab_random(&random, 0, 1);
    choose_sizes(c, &random);
    choose_shapes(c, &random);
    choose_motion(c, &m, &random);
    for (int tries = 0; tries < 12; tries++) {
        uint64_t same = random;

        align(c, &m, &same);
        if (apart_at_start(c) > 0x1p-21) {
            break;
        }
        straighten(c, &m);
    }
    (void)lab_random(&random, 0, 1);
    c->upper_first = lab_random(&random, 0, 1) < 0.5;
    e = restitutions[(int)lab_random(&random, 0, 4)];
    mu = frictions[(int)lab_random(&random, 0, 2)];
    for (int i = 0; i < 2; i++) {
        c->def[i].mass_q20 = (uint32_t)lab_fixed(random_scale(&random, 0.5, 2), 20);
        c->def[i].restitution_q30 = (int32_t)lab_fixed(e, 30);
        c->def[i].friction_q16 = (uint32_t)lab_fixed(mu, 16);
        if (!c->def[i].stationary) {
            c->skin = fmax(c->skin, fmax(0x1p-14, real(c->shape[i].mesh.radius_q22, 22) / 2048));
        }
    }
}

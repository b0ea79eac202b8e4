/* SPDX-License-Identifier: MIT */
/* One impact in real numbers, solved in contact space: the oracle of impact_solve. */
#include "impact_real.h"

/* Index of a symmetric matrix's entry among xx, yy, zz, xy, yz, zx. */
static const int symmetric[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* ---------------------------------------------------------------- arithmetic */

scalar scaled(scalar a, int e)
{
    for (; e >= 16; e -= 16) {
        a *= 65536;
    }
    for (; e <= -16; e += 16) {
        a /= 65536;
    }
    return e > 0 ? a * (1 << e) : a / (1 << -e);
}

scalar square_root(scalar a)
{
    scalar x = 1, last = 0;
    int e = 0;

    if (a <= 0) {
        return 0;
    }
    for (; a >= 4; e++) {
        a /= 4;
    }
    for (; a < 1; e--) {
        a *= 4;
    }
    for (int round = 0; round < 10 && x != last; round++) {
        last = x;
        x = (x + a / x) / 2;
    }
    return scaled(x, e);
}

int64_t rounded(scalar v, int bits)
{
    v = scaled(v, bits);
    return (int64_t)(v < 0 ? v - 0.5L : v + 0.5L);
}

scalar fixed(int64_t v, int bits)
{
    return scaled((scalar)v, -bits);
}

scalar length(struct vector a)
{
    return square_root(dot(a, a));
}

struct vector cross(struct vector a, struct vector b)
{
    return (struct vector){{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
                            a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}

struct vector times(scalar s, struct vector a)
{
    return (struct vector){{s * a.c[0], s * a.c[1], s * a.c[2]}};
}

struct vector plus(struct vector a, scalar s, struct vector b)
{
    return (struct vector){{a.c[0] + s * b.c[0], a.c[1] + s * b.c[1], a.c[2] + s * b.c[2]}};
}

struct vector difference(struct vector a, struct vector b)
{
    return plus(a, -1, b);
}

struct vector matrix_times(const struct matrix *m, struct vector v)
{
    struct vector out;

    for (int i = 0; i < 3; i++) {
        out.c[i] = m->c[i][0] * v.c[0] + m->c[i][1] * v.c[1] + m->c[i][2] * v.c[2];
    }
    return out;
}

struct matrix matrix_inverse(const struct matrix *m)
{
    struct vector row[3], column[3];
    struct matrix out;
    scalar det;

    for (int i = 0; i < 3; i++) {
        row[i] = (struct vector){{m->c[i][0], m->c[i][1], m->c[i][2]}};
    }
    for (int i = 0; i < 3; i++) {
        column[i] = cross(row[(i + 1) % 3], row[(i + 2) % 3]);
    }
    det = dot(row[0], column[0]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out.c[i][j] = column[j].c[i] / det;
        }
    }
    return out;
}

struct vector vector_q40(const int64_t v[3])
{
    return (struct vector){{fixed(v[0], 40), fixed(v[1], 40), fixed(v[2], 40)}};
}

struct vector vector_q30(const int32_t v[3])
{
    return (struct vector){{fixed(v[0], 30), fixed(v[1], 30), fixed(v[2], 30)}};
}

/* --------------------------------------------------------- to the engine, back */

static struct impact_side engine_side(const struct real_body *body, int arm_bits)
{
    struct impact_side side = {.moving = body->moving};
    scalar trace, arm;

    if (!body->moving) {
        return side;
    }
    side.inverse_mass = fix_scale(rounded(1 / body->mass, 48), 48);
    /* no entry is larger than the trace */
    trace = body->inertia.c[0][0] + body->inertia.c[1][1] + body->inertia.c[2][2];
    while (scaled(trace, side.inertia.e) < 0x1p29L) {
        side.inertia.e++;
    }
    arm = length(body->arm);
    while (side.arm.e < arm_bits && scaled(arm, side.arm.e) < 0x1p29L) {
        side.arm.e++;
    }
    for (int i = 0; i < 3; i++) {
        side.arm.c[i] = (int32_t)rounded(body->arm.c[i], side.arm.e);
        for (int j = i; j < 3; j++) {
            side.inertia.m[symmetric[i][j]] =
                (int32_t)rounded(body->inertia.c[i][j], side.inertia.e);
        }
    }
    return side;
}

struct impact real_to_engine(const struct real_impact *real, int arm_bits)
{
    struct impact in = {.a = engine_side(&real->body[0], arm_bits),
                        .b = engine_side(&real->body[1], arm_bits)};
    scalar speed;

    for (int k = 0; k < 3; k++) {
        in.normal.c[k] = (int32_t)rounded(real->normal.c[k], 30);
        in.velocity.c[k] = rounded(real->velocity.c[k], 40);
    }
    /* the caller makes the target from the rounded numbers */
    speed = dot(vector_q40(in.velocity.c), vector_q30(in.normal.c));
    in.target_q40 = rounded(-speed * fixed(rounded(real->restitution, 30), 30), 40);
    in.friction_q16 = (uint32_t)rounded(real->friction, 16);
    return in;
}

static void body_from_engine(const struct impact_side *side, struct real_body *body)
{
    body->moving = side->moving;
    if (!side->moving) {
        return;
    }
    body->mass = 1 / fixed(side->inverse_mass.m, side->inverse_mass.e);
    for (int i = 0; i < 3; i++) {
        body->arm.c[i] = fixed(side->arm.c[i], side->arm.e);
        for (int j = 0; j < 3; j++) {
            body->inertia.c[i][j] = fixed(side->inertia.m[symmetric[i][j]], side->inertia.e);
        }
    }
}

struct real_impact real_from_engine(const struct impact *in)
{
    struct real_impact real = {.friction = fixed(in->friction_q16, 16)};

    body_from_engine(&in->a, &real.body[0]);
    body_from_engine(&in->b, &real.body[1]);
    real.normal = vector_q30(in->normal.c);
    real.velocity = vector_q40(in->velocity.c);
    real.target = fixed(in->target_q40, 40);
    return real;
}

/* ------------------------------------------------------------------- oracle */

/* K += the change of the velocity of the body's point by an impulse there. */
static void add_mobility(const struct real_body *body, struct matrix *k)
{
    struct matrix inverse = matrix_inverse(&body->inertia);

    for (int j = 0; j < 3; j++) {
        struct vector axis = {{j == 0, j == 1, j == 2}};
        struct vector spin = matrix_times(&inverse, cross(body->arm, axis));
        struct vector dv = plus(axis, 1, cross(spin, body->arm));

        for (int i = 0; i < 3; i++) {
            k->c[i][j] += dv.c[i] / body->mass;
        }
    }
}

/* The part of t across N. A rounded N has not quite the length 1. */
static struct vector across(const struct real_impact *in, struct vector t)
{
    return plus(t, -dot(t, in->normal) / dot(in->normal, in->normal), in->normal);
}

void real_prepare(const struct real_impact *in, struct real_contact *c)
{
    struct vector n = in->normal, t = across(in, in->velocity), change;
    scalar normal_k, size, along, limit;

    memset(&c->k, 0, sizeof c->k);
    for (int b = 0; b < 2; b++) {
        if (in->body[b].moving) {
            add_mobility(&in->body[b], &c->k);
        }
    }
    c->inverse_k = matrix_inverse(&c->k);
    c->speed = dot(in->velocity, n);
    normal_k = dot(n, matrix_times(&c->k, n));
    c->frictionless = times((in->target - c->speed) / normal_k, n);
    /* V' must be along N, and V'.N the target */
    change = difference(times(in->target / dot(n, n), n), in->velocity);
    c->stick = matrix_times(&c->inverse_k, change);
    along = length(across(in, c->stick));
    limit = in->friction * dot(c->stick, n);
    c->stick_excess = (along - limit) / (along + magnitude(limit));
    size = length(t);
    c->slips = size > 1e-8L * length(in->velocity);
    if (!c->slips) {
        t = across(in, plus(in->velocity, 1, matrix_times(&c->k, c->frictionless)));
        size = length(t);
    }
    c->along = size > 0 ? times(1 / size, t) : t;
    t = plus(n, -in->friction, c->along);
    c->wedge_measure = dot(n, matrix_times(&c->k, t)) / normal_k;
}

enum real_way real_choose(const struct real_impact *in, const struct real_contact *c)
{
    if (in->friction > 0 && c->stick_excess <= 0) {
        return REAL_STICKS;
    }
    return c->wedge_measure > 0 ? REAL_SLIDES : REAL_WEDGES;
}

/* The largest k in [0, 1] for which P0 + k (P* - P0) adds no energy. */
static void limit_energy(const struct real_impact *in, const struct real_contact *c,
                         struct real_answer *x)
{
    struct vector d = difference(x->impulse, c->frictionless);
    struct vector both = plus(times(2, in->velocity), 1, matrix_times(&c->k, x->impulse));
    scalar square = dot(d, matrix_times(&c->k, d)), half = dot(d, in->velocity), root, k;
    scalar free = dot(c->frictionless, in->normal) * (c->speed + in->target);

    x->energy_rule = dot(x->impulse, both) > 0;
    if (!x->energy_rule) {
        return;
    }
    free = free > 0 ? 0 : free;
    root = square_root(half * half - square * free);
    k = half > 0 ? -free / (half + root) : (root - half) / square;
    x->impulse = plus(c->frictionless, k < 0 ? 0 : k > 1 ? 1 : k, d);
}

void real_solve(const struct real_impact *in, const struct real_contact *c, enum real_way way,
                struct real_answer *out)
{
    struct vector n = in->normal, d = difference(c->stick, c->frictionless);
    scalar normal = dot(c->frictionless, n);

    out->energy_rule = false;
    out->impulse = c->frictionless;
    if (in->friction <= 0) {
        return;
    }
    if (way == REAL_STICKS) {
        out->impulse = c->stick;
    } else if (way == REAL_SLIDES) {
        out->impulse =
            times(normal / (c->wedge_measure * dot(n, n)), plus(n, -in->friction, c->along));
    } else { /* from the frictionless impulse towards the sticking one, up to the cone */
        scalar beyond = length(across(in, d)) - in->friction * dot(d, n);

        out->impulse = plus(c->frictionless, in->friction * normal / beyond, d);
    }
    limit_energy(in, c, out);
}

/* ------------------------------------------------------------ random impacts */

uint64_t real_random(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

scalar real_uniform(uint64_t *state, scalar low, scalar high)
{
    return low + (high - low) * scaled((scalar)real_random(state), -64);
}

scalar real_spread(uint64_t *state, int low, int high)
{
    scalar v = real_uniform(state, 1, 2);

    return scaled(v, low + (int)(real_random(state) % (uint64_t)(high - low)));
}

struct vector real_direction(uint64_t *state)
{
    for (;;) {
        struct vector v;
        scalar l;

        for (int k = 0; k < 3; k++) { /* an initializer would leave the order open */
            v.c[k] = real_uniform(state, -1, 1);
        }
        l = length(v);
        if (l > 0.1L && l < 1) {
            return times(1 / l, v);
        }
    }
}

/* Half the sides of a box, and its moments of inertia; none is over 50 times another. */
static void random_sides(uint64_t *state, scalar half[3], scalar moment[3])
{
    scalar radius = real_spread(state, -2, 1), low, high;
    bool rod = real_random(state) % 16 == 0;

    do {
        scalar size = 0;

        for (int k = 0; k < 3; k++) {
            half[k] = !rod ? real_spread(state, -4, 0) : k ? real_uniform(state, 0.1L, 0.11L) : 1;
            size += half[k] * half[k];
        }
        for (int k = 0; k < 3; k++) {
            half[k] *= radius / square_root(size);
        }
        low = high = (half[0] * half[0] + half[1] * half[1]) / 3;
        for (int k = 0; k < 3; k++) {
            scalar y = half[(k + 1) % 3], z = half[(k + 2) % 3];

            moment[k] = (y * y + z * z) / 3;
            low = moment[k] < low ? moment[k] : low;
            high = moment[k] > high ? moment[k] : high;
        }
    } while (high > 50 * low);
}

static void random_box(uint64_t *state, struct real_body *body)
{
    scalar half[3], moment[3];
    struct vector axis[3];
    int free = (int)(real_random(state) % 3); /* 0: a corner, 1: on an edge, 2: on a face */

    random_sides(state, half, moment);
    axis[0] = real_direction(state);
    axis[1] = cross(axis[0], real_direction(state));
    axis[1] = times(1 / length(axis[1]), axis[1]);
    axis[2] = cross(axis[0], axis[1]);
    memset(body, 0, sizeof *body);
    body->mass = real_spread(state, -5, 5);
    for (int a = 0; a < 3; a++) {
        scalar sign = real_random(state) % 2 ? 1 : -1;
        scalar part = a < free ? real_uniform(state, 0, 1) : 1;

        body->arm = plus(body->arm, half[a] * sign * part, axis[a]);
        for (int k = 0; k < 9; k++) {
            body->inertia.c[k / 3][k % 3] += moment[a] * axis[a].c[k / 3] * axis[a].c[k % 3];
        }
    }
}

void real_random_impact(uint64_t *state, int movers, int graze, struct real_impact *out)
{
    int still = movers == 2 ? 2 : (int)(real_random(state) % 2);
    int kind = (int)(real_random(state) % 8);
    struct vector v;
    scalar speed;

    for (int b = 0; b < 2; b++) {
        random_box(state, &out->body[b]);
        out->body[b].moving = b != still;
    }
    out->normal = real_direction(state);
    do {
        v = real_direction(state);
        speed = dot(v, out->normal);
    } while (speed > -scaled(1, -graze));
    if (kind < 2) { /* grazing */
        v = plus(v, -speed - real_spread(state, -graze, -3), out->normal);
    } else if (kind == 2) { /* straight on */
        v = times(speed, out->normal);
    }
    out->velocity = times(real_spread(state, -2, 3), v);
    kind = (int)(real_random(state) % 4);
    out->restitution = kind == 0 ? 0 : kind == 1 ? 1 : real_uniform(state, 0, 1);
    out->target = -out->restitution * dot(out->velocity, out->normal);
    out->friction = real_random(state) % 8 ? fixed((int64_t)(real_random(state) % 98305), 16) : 0;
}

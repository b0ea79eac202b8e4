/* SPDX-License-Identifier: MIT */
/* Random motions on which two bodies of the first-hit test approach each other. */
#include <math.h>
#include <string.h>

#include "first_hit.h"
#include "lab.h"
#include "real.h"

/* --------------------------------------------------------------------- vectors */

static void random_direction(uint64_t *random, double out[3])
{
    const double x[3] = {1, 0, 0};
    carom_quat_q30 turn = lab_random_turn(random);

    lab_rotate(out, &turn, x);
}

/* A unit vector perpendicular to n. */
static void random_across(uint64_t *random, const double n[3], double out[3])
{
    double v[3], length;

    do {
        random_direction(random, v);
        real_cross(out, n, v);
        length = real_length(out);
    } while (length < 0.1);
    for (int k = 0; k < 3; k++) {
        out[k] /= length;
    }
}

/* Uniform in the exponent. */
static double random_size(uint64_t *random, double low, double high)
{
    return low * pow(high / low, lab_random(random, 0, 1));
}

/* The rotation by q, then by p. */
static carom_quat_q30 both_turns(const carom_quat_q30 *p, const carom_quat_q30 *q)
{
    double a[4], b[4], c[4], length = 0;
    carom_quat_q30 out;

    for (int k = 0; k < 4; k++) {
        a[k] = lab_double(p->c[k], 30);
        b[k] = lab_double(q->c[k], 30);
    }
    c[0] = a[0] * b[0] - real_dot(a + 1, b + 1);
    real_cross(c + 1, a + 1, b + 1);
    for (int k = 1; k < 4; k++) {
        c[k] += a[0] * b[k] + b[0] * a[k];
    }
    for (int k = 0; k < 4; k++) {
        length += c[k] * c[k];
    }
    for (int k = 0; k < 4; k++) {
        out.c[k] = (int32_t)lab_fixed(c[k] / sqrt(length), 30);
    }
    return out;
}

/* ------------------------------------------------------------------- motions */

/* The kinds of motion by which two bodies meet. */
enum manner {
    AIMED,    /* at a point near the other's centre, turning slowly */
    CLOSE,    /* the same, from a very small gap, and slowly */
    TANGLED,  /* from any place where they do not overlap: through holes, into notches */
    SPINNING, /* the same, at up to 30 radians a frame */
    GRAZING,  /* a face of one along the other, a few skins apart */
    ALIGNED,  /* both turned alike: faces and edges parallel, or nearly */
    LATER,    /* two close bodies, after a few frames with gravity */
    FAST,     /* up to 50 units a frame */
    MANNERS
};

struct start {
    struct first_hit_motion *motion;
    uint64_t random;
    int movers;
    double small, large; /* radii of the smaller and of the larger body, at most 1 and at least 1 */
    double away[3];      /* from b to a */
    double place[3];     /* direction from b's centre to a's */
    double velocity[3];  /* velocity of a relative to b */
    double common;       /* largest velocity of both */
    double spin;         /* largest spin of both */
    double
        pace; /* factor of all speeds; at full speed every face of a large head is near every other
               * one */
};

/* The largest distance of a vertex from the centre of mass along a direction. */
static double reach(const struct first_hit_mesh *mesh, const carom_quat_q30 *turned,
                    const double direction[3], double sign)
{
    double most = -HUGE_VAL;

    for (size_t v = 0; v < mesh->doubles.vertex_count; v++) {
        double about[3], place[3];

        for (int k = 0; k < 3; k++) {
            about[k] = mesh->doubles.vertices[v][k] - mesh->centre[k];
        }
        lab_rotate(place, turned, about);
        most = fmax(most, sign * real_dot(place, direction));
    }
    return most;
}

/* A direction from b to a; from above if b is a SURFACE. */
static void choose_away(struct start *s)
{
    struct carom_body_def *b = &s->motion->def[0];

    do {
        random_direction(&s->random, s->away);
    } while (b->mesh->raw.kind == CAROM_SURFACE && s->away[2] < 0.3);
    if (b->mesh->raw.kind == CAROM_SURFACE) {
        double up[3] = {s->away[0], s->away[1], s->away[2]};

        lab_rotate(s->away, &b->rotation, up);
    }
}

/* Place the bodies on two sides of a plane, with a gap. */
static void place_apart(struct start *s, double gap)
{
    const struct first_hit_motion *m = s->motion;
    double apart = reach(m->mesh[0], &m->def[0].rotation, s->away, 1) +
                   reach(m->mesh[1], &m->def[1].rotation, s->away, -1) + gap;

    for (int k = 0; k < 3; k++) {
        s->place[k] = apart * s->away[k];
    }
}

/* Whether they overlap when a is so much nearer to b. */
static bool overlap_at(struct start *s, double nearer)
{
    carom_v3_q32 *place = &s->motion->def[1].position;

    for (int k = 0; k < 3; k++) {
        place->c[k] = lab_fixed(s->place[k] - nearer * s->away[k], 32);
    }
    return first_hit_overlap(s->motion);
}

/* Nearly touching: moved together until they overlap, then apart again by the gap. */
static void place_close(struct start *s, double gap)
{
    double nearer = 0, step = s->small / 4, most;

    place_apart(s, 0);
    for (int k = 0; k < 3; k++) {
        s->place[k] += 0.3 * s->small * lab_random(&s->random, -1, 1) * (1 - fabs(s->away[k]));
    }
    most = real_dot(s->place, s->away);
    while (nearer < most && !overlap_at(s, nearer)) {
        nearer += step;
    }
    for (int i = 0; i < 40; i++) {
        step /= 2;
        nearer += overlap_at(s, nearer) ? -step : step;
    }
    for (int k = 0; k < 3; k++) {
        s->place[k] += s->away[k] * (gap - nearer);
    }
    if (overlap_at(s, 0)) { /* the search stepped over a thin part */
        place_apart(s, gap);
    }
}

static void aim(struct start *s, double speed)
{
    double length;

    for (int k = 0; k < 3; k++) {
        s->velocity[k] = speed * (lab_random(&s->random, -0.4, 0.4) * s->large - s->place[k]);
    }
    length = real_length(s->velocity);
    for (int k = 0; k < 3 && length > 40; k++) {
        s->velocity[k] *= 40 / length;
    }
}

/* Fill in the definitions: b moves by itself, or not at all. */
static void define(struct start *s)
{
    struct carom_body_def *b = &s->motion->def[0], *a = &s->motion->def[1];
    double share = s->movers == 2 ? lab_random(&s->random, 0, 1) : 0;
    double spin = s->pace * s->spin / sqrt(3);

    for (int k = 0; k < 3; k++) {
        double common = s->movers == 2 ? s->pace * s->common * lab_random(&s->random, -1, 1) : 0;

        b->position.c[k] = lab_fixed(lab_random(&s->random, -3000, 3000), 32);
        a->position.c[k] = b->position.c[k] + lab_fixed(s->place[k], 32);
        b->velocity.c[k] = lab_fixed(common - share * s->pace * s->velocity[k], 40);
        a->velocity.c[k] = lab_fixed(common + (1 - share) * s->pace * s->velocity[k], 40);
        a->spin.c[k] = lab_fixed(lab_random(&s->random, -1, 1) * spin, 40);
        b->spin.c[k] = lab_fixed(lab_random(&s->random, -1, 1) * spin, 40);
        if (s->movers == 1) {
            b->spin.c[k] = 0;
        }
    }
}

static void start_aimed(struct start *s)
{
    place_apart(s, s->small * lab_random(&s->random, 0.005, 0.3));
    aim(s, lab_random(&s->random, 0.2, 1.5));
    define(s);
}

static void start_close(struct start *s)
{
    double gap = s->small * random_size(&s->random, 1e-5, 1e-1);

    s->spin = gap / s->large * lab_random(&s->random, 0, 2);
    s->common *= gap;
    place_close(s, gap);
    aim(s, gap / s->large * random_size(&s->random, 0.1, 10));
    define(s);
}

static void start_fast(struct start *s)
{
    double length, speed = random_size(&s->random, 2, 50);

    place_apart(s, s->small * lab_random(&s->random, 0.1, 5));
    aim(s, 1);
    length = real_length(s->velocity);
    for (int k = 0; k < 3; k++) {
        s->velocity[k] *= speed / length;
    }
    define(s);
}

static void start_tangled(struct start *s)
{
    double sphere = s->motion->mesh[0]->radius + s->motion->mesh[1]->radius;
    double speed = s->small * random_size(&s->random, 0.02, 2);
    int tries = 0;

    if (s->motion->mesh[0]->mesh.raw.kind == CAROM_SURFACE) {
        start_aimed(s);
        return;
    }
    do {
        double toward[3];

        random_direction(&s->random, s->away);
        random_direction(&s->random, toward);
        for (int k = 0; k < 3; k++) {
            s->place[k] = s->away[k] * sphere * lab_random(&s->random, 0.05, 0.6);
            s->velocity[k] = speed * toward[k];
        }
        define(s);
    } while (first_hit_overlap(s->motion) && tries++ < 100);
    if (tries > 100) {
        start_aimed(s);
    }
}

static void start_spinning(struct start *s)
{
    s->spin = fmin(random_size(&s->random, 0.4, 30), 40 / s->large);
    start_tangled(s);
}

/* A rotation that takes a direction of the body to one of the world, with any angle about it. */
static carom_quat_q30 turn_to(struct start *s, const double from[3], const double to[3])
{
    double axis[3], angle = atan2(0, 1);
    carom_quat_q30 first, second;

    real_cross(axis, from, to);
    angle = atan2(real_length(axis), real_dot(from, to));
    if (real_dot(axis, axis) < 1e-12) {
        random_across(&s->random, from, axis);
    }
    first = lab_turn(axis[0], axis[1], axis[2], angle);
    second = lab_turn(to[0], to[1], to[2], lab_random(&s->random, 0, 6.28));
    return both_turns(&second, &first);
}

static void turn_face(struct start *s, int body, double sign)
{
    const struct carom_mesh *mesh = &s->motion->mesh[body]->mesh;
    uint32_t face = (uint32_t)lab_random(&s->random, 0, mesh->raw.face_count);
    double from[3], to[3];

    for (int k = 0; k < 3; k++) {
        from[k] = lab_double(mesh->faces[face].normal.c[k], 30);
        to[k] = sign * s->away[k];
    }
    s->motion->def[body].rotation = turn_to(s, from, to);
}

static void start_grazing(struct start *s)
{
    double skin = s->motion->mesh[1]->radius / 2048, along[3], aside[3], rise, back, off;
    double speed = s->small * random_size(&s->random, 0.02, 2);

    turn_face(s, 0, 1);
    if (lab_random(&s->random, 0, 1) < 0.5) {
        turn_face(s, 1, -1);
    }
    s->spin = lab_random(&s->random, 0, 1) < 0.5 ? 0 : random_size(&s->random, 1e-4, 0.1);
    random_across(&s->random, s->away, along);
    real_cross(aside, s->away, along);
    place_apart(s, skin * random_size(&s->random, 0.02, 6));
    rise = skin * lab_random(&s->random, -12, 3);
    back = speed * lab_random(&s->random, 0, 1);
    off = s->small * lab_random(&s->random, -0.3, 0.3);
    for (int k = 0; k < 3; k++) {
        s->place[k] += off * aside[k] - back * along[k];
        s->velocity[k] = speed * along[k] + rise * s->away[k];
    }
    define(s);
}

/* A quarter of them are aligned exactly, as far as rotations can be. */
static void start_aligned(struct start *s)
{
    carom_quat_q30 turn = lab_random_turn(&s->random);
    double angle = random_size(&s->random, 1e-6, 0.1), axis[3];

    random_direction(&s->random, axis);
    turn = lab_turn(axis[0], axis[1], axis[2], angle);
    s->motion->def[1].rotation = s->motion->def[0].rotation;
    if (lab_random(&s->random, 0, 1) < 0.75) {
        s->motion->def[1].rotation = both_turns(&turn, &s->motion->def[0].rotation);
    }
    s->spin = lab_random(&s->random, 0, 1) < 0.5 ? 0 : random_size(&s->random, 1e-4, 0.1);
    if (lab_random(&s->random, 0, 1) < 0.5) {
        place_close(s, s->small * random_size(&s->random, 1e-5, 1e-1));
        aim(s, random_size(&s->random, 1e-3, 0.5));
        define(s);
    } else {
        start_aimed(s);
    }
}

/* Gravity pulls a to b, or only a moves much: in both cases they touch for some frames. */
static void start_later(struct start *s)
{
    bool held = lab_random(&s->random, 0, 1) < 0.5;
    double pull = random_size(&s->random, 1e-4, 1e-2);

    s->spin = lab_random(&s->random, 0, 0.1);
    s->common = 0;
    place_close(s, s->small * random_size(&s->random, 1e-4, 1e-1));
    aim(s, random_size(&s->random, 1e-3, 0.1));
    for (int k = 0; k < 3; k++) {
        s->motion->gravity.c[k] = lab_fixed(-pull * s->away[k], 40);
        s->motion->def[0].restitution_q30 = s->motion->def[1].restitution_q30 = CAROM_ONE_Q30 / 4;
        s->motion->def[0].friction_q16 = s->motion->def[1].friction_q16 = 1 << 14;
    }
    define(s);
    first_hit_later(s->motion, (int)random_size(&s->random, 1, 40));
    s->motion->in_contact = held;
}

static void choose_bodies(struct start *s, int mesh_a, int mesh_b)
{
    struct first_hit_motion *m = s->motion;
    /* two in three have the usual size; the large heads always do */
    int size[2] = {(int)lab_random(&s->random, 0, 12), (int)lab_random(&s->random, 0, 12)};

    for (int i = 0; i < 2; i++) {
        bool usual = mesh_a == FIRST_HIT_HEAD1876 || size[i] >= FIRST_HIT_SIZES;

        m->mesh[i] = &first_hit_meshes[usual ? 0 : size[i]][i == 0 ? mesh_b : mesh_a];
        m->def[i].mesh = &m->mesh[i]->mesh;
        m->def[i].rotation = lab_random_turn(&s->random);
        m->def[i].stationary = i == 0 && s->movers == 1;
        m->def[i].mass_q20 = 1 << 20;
    }
    s->small = fmin(1, fmin(m->mesh[0]->radius, m->mesh[1]->radius));
    s->large = fmax(1, fmax(m->mesh[0]->radius, m->mesh[1]->radius));
    s->common = 1;
    s->spin = 0.4;
    s->pace = mesh_a == FIRST_HIT_HEAD1876 ? 0.1 : 1;
}

void first_hit_make_motion(struct first_hit_motion *m, int mesh_a, int mesh_b, int movers, int n)
{
    static void (*const starts[MANNERS])(struct start *) = {
        start_aimed,   start_close,   start_tangled, start_spinning,
        start_grazing, start_aligned, start_later,   start_fast};
    struct start s = {.motion = m, .movers = movers};

    memset(m, 0, sizeof *m);
    s.random = 0x9e3779b97f4a7c15u * (uint64_t)(1 + mesh_a + 16 * mesh_b + 256 * movers + 4096 * n);
    for (int i = 0; i < 8; i++) {
        lab_random(&s.random, 0, 1);
    }
    choose_bodies(&s, mesh_a, mesh_b);
    for (int k = 0; k < 3 && n / MANNERS % 2 == 1; k++) {
        m->gravity.c[k] = lab_fixed(lab_random(&s.random, -0.02, 0.02), 40);
    }
    choose_away(&s);
    starts[n % MANNERS](&s);
}

/* SPDX-License-Identifier: MIT */
/* Random worlds: their bodies, with sizes and weights, places, and first motions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "real.h"
#include "soak.h"

const char *const soak_ground_names[SOAK_GROUNDS] = {"none", "plane", "field", "obstacles", "room"};
const char *const soak_pace_names[SOAK_PACES] = {"at rest", "slow", "any speed", "fast"};

#define LARGEST_HALF                                                                               \
    55 /* half side of a ground: in range, together with a body of 64 units a frame */
#define FASTEST 63.5

/* The plan of a random world: the properties that its bodies share. */
struct plan {
    struct test_random r;
    double size[2];  /* smallest and largest size of bodies */
    double light;    /* the lightest mass; others are up to 1000 times as heavy */
    int masses;      /* 0: any; 1: by volume; 2: all the same */
    double e, mu;    /* below 0: each body has its own */
    double lean;     /* largest lean of bodies from the axes, radians; below 0: any rotation */
    double half;     /* half side of the cube into which bodies are put */
    double start[3]; /* its middle */
    double ring; /* distance from that middle at which bodies begin, instead of in the cube; or 0 */
};

/* --------------------------------------------------------------------- bodies */

static struct soak_shape *next_shape(struct soak_world *w)
{
    return &w->shapes[w->crowd->mesh_count];
}

/* Add a body of the last shape. */
static int add_body(struct soak_world *w, enum soak_kind kind)
{
    struct crowd *crowd = w->crowd;
    int body = crowd->body_count, mesh = crowd_mesh(crowd, &next_shape(w)->raw);

    crowd_body(crowd, mesh);
    w->kinds[body] = kind;
    return body;
}

static void set_turn(struct carom_body_def *def, const double q[4])
{
    for (int k = 0; k < 4; k++) {
        def->rotation.c[k] = (int32_t)real_round(q[k] * CAROM_ONE_Q30);
    }
}

static struct oracle_pose pose_of(const struct carom_body_def *def)
{
    double at[3], q[4], centre[3];

    lab_quaternion(q, &def->rotation);
    for (int k = 0; k < 3; k++) {
        at[k] = real(def->position.c[k], 32);
        centre[k] = real(def->mesh->mass.centre.c[k], 22);
    }
    return oracle_pose_make(at, q, centre);
}

/* A corner of one body in the axes of another one's mesh. */
static void corner_in(double out[3], const struct oracle_mesh *a, const struct oracle_pose *pose_a,
                      const struct oracle_pose *pose_b)
{
    double at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = real_dot(pose_a->rotation.row[k], a->vertices[0]) + pose_a->position[k] -
                pose_b->position[k];
    }
    for (int k = 0; k < 3; k++) {
        out[k] = pose_b->rotation.row[0][k] * at[0] + pose_b->rotation.row[1][k] * at[1] +
                 pose_b->rotation.row[2][k] * at[2];
    }
}

/* Whether two bodies are apart by more than two skins. */
static bool apart(const struct crowd *crowd, int a, int b)
{
    const struct crowd_body *body[2] = {&crowd->bodies[a], &crowd->bodies[b]};
    const struct crowd_mesh *mesh[2] = {&crowd->meshes[body[0]->mesh],
                                        &crowd->meshes[body[1]->mesh]};
    const double gap = 2 * fmax(mesh[0]->skin, mesh[1]->skin);
    struct oracle_pose pose[2] = {pose_of(&body[0]->def), pose_of(&body[1]->def)};
    double away[3], at[3];

    for (int k = 0; k < 3; k++) {
        away[k] = real(body[0]->def.position.c[k] - body[1]->def.position.c[k], 32);
    }
    if (real_length(away) <= mesh[0]->radius + mesh[1]->radius + gap &&
        oracle_near(&mesh[0]->solid, &pose[0], &mesh[1]->solid, &pose[1], gap)) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        bool surface = body[1 - i]->def.mesh->raw.kind == CAROM_SURFACE;

        if (body[i]->def.mesh->raw.kind == CAROM_SURFACE) {
            continue;
        }
        corner_in(at, &mesh[i]->solid, &pose[i], &pose[1 - i]);
        if (surface ? oracle_under(&mesh[1 - i]->solid, at)
                    : oracle_inside(&mesh[1 - i]->solid, at)) {
            return false;
        }
    }
    return true;
}

static bool inside_room(const struct soak_world *w, const struct carom_body_def *def)
{
    double away[3], radius = real(def->mesh->radius_q22, 22), m[3][3], seen[3];

    for (int k = 0; k < 3; k++) {
        away[k] = real(def->position.c[k], 32) - w->centre[k];
    }
    real_matrix(m, w->room);
    real_rotate_back(seen, m, away);
    for (int k = 0; k < 3; k++) {
        if (fabs(seen[k]) + radius > w->room_half) {
            return false;
        }
    }
    return true;
}

/* The same for the bodies below `count`; grounds may overlap each other. */
static bool is_clear(const struct soak_world *w, int body, int but, int count)
{
    const struct crowd_body *bodies = w->crowd->bodies;
    const struct carom_body_def *def = &bodies[body].def;
    bool clear = w->ground != SOAK_ROOM || def->stationary || inside_room(w, def);

    for (int i = 0; i < count && clear; i++) {
        bool both_stand = bodies[i].def.stationary && def->stationary;

        clear = i == body || i == but || both_stand || apart(w->crowd, body, i);
    }
    return clear;
}

bool soak_is_clear(const struct soak_world *w, int body, int but)
{
    return is_clear(w, body, but, w->crowd->body_count);
}

static void any_turn(struct plan *p, double q[4])
{
    double axis[3], length;

    if (p->lean < 0) {
        soak_any_turn(&p->r, q);
        return;
    }
    soak_direction(&p->r, axis);
    length = real_sqrt(1 + p->lean * p->lean / 4);
    q[0] = 1 / length;
    for (int k = 0; k < 3; k++) {
        q[k + 1] = p->lean / 2 * axis[k] / length;
    }
}

/* Put a body where it is clear of all others; the cube grows until there is such a place. */
static void find_place(struct soak_world *w, struct plan *p, int body)
{
    struct crowd *crowd = w->crowd;
    struct carom_body_def *def = &crowd->bodies[body].def;
    double q[4];
    bool clear;
    int tries = 0;

    do {
        double at[3], way[3] = {0, 0, 0};

        if (p->ring > 0) {
            soak_direction(&p->r, way);
        }
        for (int k = 0; k < 3; k++) {
            at[k] = p->start[k] + p->ring * way[k] + p->half * soak_uniform(&p->r, -1, 1);
        }
        any_turn(p, q);
        set_turn(def, q);
        crowd_place(def, at[0], at[1], at[2]);
        clear = is_clear(w, body, body, body);
        if (++tries % 50 == 0 && w->ground != SOAK_ROOM) {
            p->half *= 1.15;
            p->ring *= 1.15;
        }
    } while (!clear && tries < 2000);
    if (!clear) {
        crowd->body_count--; /* the room is full */
    }
}

/* -------------------------------------------------------------------- grounds */

static void tilt(struct carom_body_def *def, struct test_random *r)
{
    double x = soak_uniform(r, -0.2, 0.2), y = soak_uniform(r, -0.2, 0.2);
    double q[4] = {1, x, y, 0}, length;

    length = real_sqrt(1 + q[1] * q[1] + q[2] * q[2]);
    for (int k = 0; k < 4; k++) {
        q[k] /= length;
    }
    set_turn(def, q);
}

static void stand_still(struct soak_world *w, int body)
{
    w->crowd->bodies[body].def.stationary = true;
}

/* A plane of two triangles, or a field of hills. Returns the height of its hills. */
static double lay_surface(struct soak_world *w, struct plan *p, double half)
{
    double rough = 0;
    int n = 1, body;

    if (w->ground == SOAK_FIELD) {
        n = 2 + soak_pick(&p->r, 23);
        rough = 2 * half / n * soak_powers(&p->r, 0.05, 2);
        rough = rough > 20 ? 20 : rough;
    }
    soak_surface(next_shape(w), n, 2 * half / n, rough, &p->r);
    body = add_body(w, SOAK_KINDS);
    stand_still(w, body);
    crowd_place(&w->crowd->bodies[body].def, w->centre[0], w->centre[1], w->centre[2]);
    if (soak_pick(&p->r, 2) == 0) {
        tilt(&w->crowd->bodies[body].def, &p->r);
    }
    return rough;
}

static void add_surface(struct soak_world *w, struct plan *p)
{
    double half = p->half * soak_powers(&p->r, 1.5, 8);

    half = soak_pick(&p->r, 4) == 0 || half > LARGEST_HALF ? LARGEST_HALF : half;
    p->start[2] += 1.2 * p->half + lay_surface(w, p, half);
}

/* Solids that stand below the falling bodies. */
static void add_obstacles(struct soak_world *w, struct plan *p)
{
    int count = 3 + soak_pick(&p->r, SOAK_OBSTACLE - 2);

    for (int i = 0; i < count; i++) {
        enum soak_kind kind =
            soak_pick(&p->r, 2) ? SOAK_BOX : (enum soak_kind)soak_pick(&p->r, SOAK_KINDS);
        double size = fmin(p->half * soak_powers(&p->r, 0.2, 2), 20);
        int body;

        w->drawn_again += soak_solid(next_shape(w), kind, size, &p->r);
        body = add_body(w, kind);
        stand_still(w, body);
        find_place(w, p, body);
    }
    p->start[2] += p->half;
}

/* Six slabs around the cube. */
static void add_room(struct soak_world *w, struct plan *p)
{
    double half = fmin(1.3 * p->half + 1.4 * p->size[1], LARGEST_HALF / 2);
    double thick = half * soak_powers(&p->r, 0.01, 0.5), m[3][3];

    w->room_half = half;
    w->room_slack = 0;
    soak_any_turn(&p->r, w->room);
    if (soak_pick(&p->r, 2) == 0) {
        w->room[0] = 1;
        w->room[1] = w->room[2] = w->room[3] = 0;
    }
    real_matrix(m, w->room);
    for (int i = 0; i < 6; i++) {
        double away = (i % 2 ? 1 : -1) * (half + thick / 2), wide = 2 * half;
        double sides[3] = {wide + 2 * thick, wide + 2 * thick, wide + 2 * thick};
        struct carom_body_def *def;
        int body;

        sides[i / 2] = thick;
        soak_box(next_shape(w), sides[0], sides[1], sides[2]);
        body = add_body(w, SOAK_BOX);
        stand_still(w, body);
        def = &w->crowd->bodies[body].def;
        set_turn(def, w->room);
        crowd_place(def, w->centre[0] + away * m[0][i / 2], w->centre[1] + away * m[1][i / 2],
                    w->centre[2] + away * m[2][i / 2]);
        /* a wall's vertices are off by half a quantum, and so is its centre of mass */
        w->room_slack = fmax(w->room_slack, ldexp(1, -def->mesh->raw.quantum_bits));
    }
}

static void add_ground(struct soak_world *w, struct plan *p)
{
    switch (w->ground) {
    case SOAK_PLANE:
    case SOAK_FIELD:
        add_surface(w, p);
        break;
    case SOAK_OBSTACLES:
        add_obstacles(w, p);
        break;
    case SOAK_ROOM:
        add_room(w, p);
        break;
    default:
        break;
    }
}

/* --------------------------------------------------------------------- motion */

/* |v| + r |w|, divided between both. */
static void set_motion(struct soak_world *w, struct plan *p, int body)
{
    struct carom_body_def *def = &w->crowd->bodies[body].def;
    double radius = real(def->mesh->radius_q22, 22), speed = 0, share, along[3], axis[3];
    double velocity[3], spin[3];
    int how = soak_pick(&p->r, 4);

    switch (w->pace) {
    case SOAK_SLOW:
        speed = soak_powers(&p->r, 1e-4, 0.3);
        break;
    case SOAK_ANY_SPEED:
        speed = soak_powers(&p->r, 1e-9, FASTEST);
        break;
    case SOAK_FAST:
        speed = soak_uniform(&p->r, 0.3, 1);
        speed *= soak_uniform(&p->r, 0.3, FASTEST);
        break;
    default:
        break;
    }
    share = how == 0 ? 0 : how == 1 ? 1 : soak_uniform(&p->r, 0, 1);
    soak_direction(&p->r, along);
    soak_direction(&p->r, axis);
    if (soak_pick(&p->r, 2) == 0 || p->ring > 0) {
        double away[3];

        for (int k = 0; k < 3; k++) {
            away[k] = p->start[k] - real(def->position.c[k], 32);
        }
        for (int k = 0; k < 3; k++) {
            along[k] = real_length(away) > 1e-3 ? away[k] / real_length(away) : along[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        velocity[k] = speed * (1 - share) * along[k];
        spin[k] = fmin(speed * share / radius, FASTEST) * axis[k];
    }
    crowd_move(def, velocity, spin);
}

static double mass_of(struct soak_world *w, struct plan *p, int body)
{
    const struct crowd_mesh *mesh = &w->crowd->meshes[w->crowd->bodies[body].mesh];
    double mass;

    if (w->exact) {
        w->halvings[body] = p->masses == 2 ? 0 : soak_pick(&p->r, 11);
        return real_power2(-w->halvings[body]);
    }
    if (p->masses == 2) {
        return p->light;
    }
    mass = soak_powers(&p->r, p->light, 1000 * p->light);
    if (p->masses == 1) {
        double large = p->size[1] * p->size[1] * p->size[1];

        mass = 1000 * p->light * mesh->weight.mass / large;
        mass = mass < p->light ? p->light : mass > 1000 * p->light ? 1000 * p->light : mass;
    }
    return mass;
}

/* ---------------------------------------------------------------------- worlds */

static void set_gravity(struct soak_world *w, struct test_random *r)
{
    bool none = soak_pick(r, 8) < (w->ground == SOAK_NONE ? 6 : 1), usual = soak_pick(r, 2) == 0;
    double size = soak_powers(r, 1e-4, 0.05), down[3], lean = soak_pick(r, 4) == 0 ? 0.5 : 0;

    size = none ? 0 : usual ? 9.81 / 3600 : size;
    soak_direction(r, down);
    for (int k = 0; k < 3; k++) {
        down[k] = lean * down[k] - (k == 2);
    }
    for (int k = 0; k < 3; k++) {
        w->crowd->config.gravity.c[k] =
            real_round(size * down[k] / real_length(down) * real_power2(40));
    }
    w->gravity = size;
}

static void draw_plan(struct soak_world *w, struct plan *p)
{
    static const double leans[] = {-1, -1, -1, 0, 0.002};
    static const double es[] = {0, 0, 0.5, 1, -1, -1}, mus[] = {0, 0.5, 1, -1, -1, -1};
    bool alike = soak_pick(&p->r, 2) == 0, far_off = soak_pick(&p->r, 4) == 0;

    w->ground = (enum soak_ground)soak_pick(&p->r, SOAK_GROUNDS);
    w->pace = (enum soak_pace)soak_pick(&p->r, SOAK_PACES);
    w->moving = 1 + (soak_pick(&p->r, 2) ? soak_pick(&p->r, SOAK_BODIES)
                                         : (int)soak_powers(&p->r, 1, SOAK_BODIES) - 1);
    p->size[0] = alike ? soak_powers(&p->r, 0.05, 3.5) : 0.05;
    p->size[1] = alike ? 1.4 * p->size[0] : 5;
    p->light = soak_powers(&p->r, 0x1p-10, 1.02);
    p->masses = soak_pick(&p->r, 3);
    p->e = es[soak_pick(&p->r, 6)];
    p->mu = mus[soak_pick(&p->r, 6)];
    p->lean = leans[soak_pick(&p->r, 5)];
    set_gravity(w, &p->r);
    if (w->pace == SOAK_AT_REST && w->gravity == 0) {
        w->pace = SOAK_SLOW;
    }
    w->exact = w->ground == SOAK_NONE && w->gravity == 0;
    w->crowd->config.sleep = soak_pick(&p->r, 2);
    for (int k = 0; k < 3; k++) {
        w->centre[k] = far_off ? soak_uniform(&p->r, -3000, 3000) : 0;
        p->start[k] = w->centre[k];
    }
}

static void add_moving(struct soak_world *w, struct plan *p, const double *sizes)
{
    for (int i = 0; i < w->moving; i++) {
        enum soak_kind kind = (enum soak_kind)soak_pick(&p->r, SOAK_KINDS);
        int before = w->crowd->body_count, body;
        struct carom_body_def *def;

        w->drawn_again += soak_solid(next_shape(w), kind, sizes[i], &p->r);
        body = add_body(w, kind);
        find_place(w, p, body);
        if (w->crowd->body_count == before) {
            w->moving = i;
            return;
        }
        def = &w->crowd->bodies[body].def;
        def->mass_q20 = (uint32_t)real_round(mass_of(w, p, body) * real_power2(20));
        set_motion(w, p, body);
    }
}

static void set_surfaces(struct soak_world *w, struct plan *p)
{
    for (int i = 0; i < w->crowd->body_count; i++) {
        struct carom_body_def *def = &w->crowd->bodies[i].def;
        double e = soak_uniform(&p->r, 0, 1), mu = soak_uniform(&p->r, 0, 1.5);

        def->restitution_q30 = (int32_t)real_round((p->e < 0 ? e : p->e) * CAROM_ONE_Q30);
        def->friction_q16 = (uint32_t)real_round((p->mu < 0 ? mu : p->mu) * 65536);
    }
}

/* Cube root by Newton's rule, from above. */
static double cube_root(double v)
{
    double root = v > 1 ? v : 1;

    for (int i = 0; i < 100; i++) {
        root -= (root - v / (root * root)) / 3;
    }
    return root;
}

/* A surface of about the bodies' size, and the middle of the space under it. */
static void add_roof(struct soak_world *w, struct plan *p)
{
    double half = fmin(p->half * soak_powers(&p->r, 0.3, 3), LARGEST_HALF / 3);

    w->ground = soak_pick(&p->r, 2) ? SOAK_PLANE : SOAK_FIELD;
    w->exact = false;
    (void)lay_surface(w, p, half);
    p->ring = 1.5 * half + p->half; /* beyond the surface's corners */
    p->start[2] -= p->half * soak_uniform(&p->r, 0.2, 1);
    /* gravity pulls towards the surface from below in most worlds */
    if (soak_pick(&p->r, 3) > 0) {
        w->crowd->config.gravity.c[2] *= -1;
    }
}

static void make(struct soak_world *w, uint64_t seed, bool under)
{
    struct plan p = {.r = {seed * 0xd1342543de82ef95u}};
    double sizes[SOAK_BODIES], volume = 0;

    memset(w, 0, sizeof *w);
    w->seed = seed;
    w->crowd = crowd_new();
    w->crowd->look_every = 10;
    draw_plan(w, &p);
    for (int i = 0; i < w->moving; i++) {
        sizes[i] = soak_powers(&p.r, p.size[0], p.size[1]);
        volume += sizes[i] * sizes[i] * sizes[i];
    }
    p.half = soak_uniform(&p.r, 0.8, 2.5) * cube_root(volume);
    if (under) {
        add_roof(w, &p);
    } else {
        add_ground(w, &p);
    }
    add_moving(w, &p, sizes);
    set_surfaces(w, &p);
}

void soak_make(struct soak_world *w, uint64_t seed)
{
    make(w, seed, false);
}

void soak_make_under(struct soak_world *w, uint64_t seed)
{
    make(w, seed, true);
    w->under = true;
}

void soak_free(struct soak_world *w)
{
    crowd_free(w->crowd);
    free(w->machine);
    free(w->seen ? w->seen->snapshot : NULL);
    free(w->seen);
}

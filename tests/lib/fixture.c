/* SPDX-License-Identifier: MIT */
/* Fixtures: published and special scenes, judged through the public interface. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fixture.h"
#include "real.h"

/* Well above the rounding of coordinates, far below the skin. */
#define CROSSING_TOLERANCE 1e-9
/* A body stands still when it moves less than this part of the way that its velocity gives. */
#define STILL_PART 0.02
/*
 * The largest rise of all bodies' energy: far more than the lifts of a frame, far less than a fall.
 */
#define RISE_ALLOWED 4.0

/* bodies, pairs, contacts, faces, entries, candidates */
#define CAPS FIXTURE_BODIES, 4000, 4096, 65535, 0, 65535

const carom_quat_q30 fixture_upright = {{CAROM_ONE_Q30, 0, 0, 0}};

void fixture_say(struct fixture *f, const char *format, ...)
{
    size_t used = strlen(f->said);
    va_list arguments;

    if (used > 0 && used < sizeof f->said - 2) {
        strcpy(f->said + used, "; ");
        used += 2;
    }
    va_start(arguments, format);
    vsnprintf(f->said + used, sizeof f->said - used, format, arguments);
    va_end(arguments);
}

/* --------------------------------------------------------------------- making */

int fixture_mesh(struct fixture *f)
{
    struct fixture_mesh *mesh = &f->meshes[f->mesh_count];
    const struct fixture_shape *shape = &f->shape;
    size_t bytes = CAROM_MESH_BYTES(shape->vertex_count, shape->face_count);
    struct carom_mesh_raw raw = {.vertex_count = shape->vertex_count,
                                 .face_count = shape->face_count,
                                 .quantum_bits = 7,
                                 .kind = shape->surface ? CAROM_SURFACE : CAROM_SOLID};
    double largest = 0, centre[3];

    lab_expect(f->mesh_count < FIXTURE_BODIES ? CAROM_OK : CAROM_ERR_MESH_SIZE, "meshes");
    mesh->vertices = lab_need(shape->vertex_count * sizeof *mesh->vertices);
    mesh->faces = lab_need(shape->face_count * sizeof *mesh->faces);
    for (uint32_t v = 0; v < shape->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(shape->p[v][k]));
        }
    }
    while (raw.quantum_bits < 20 && ldexp(largest, raw.quantum_bits + 1) <= 32000) {
        raw.quantum_bits++;
    }
    for (uint32_t v = 0; v < shape->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            mesh->vertices[v][k] = (int16_t)lrint(ldexp(shape->p[v][k], raw.quantum_bits));
        }
    }
    memcpy(mesh->faces, shape->faces, shape->face_count * sizeof *mesh->faces);
    raw.vertices = (const int16_t(*)[3])mesh->vertices;
    raw.faces = (const uint16_t(*)[3])mesh->faces;
    mesh->block = lab_need(bytes);
    lab_expect(carom_mesh_build(&mesh->mesh, &raw, mesh->block, bytes), f->scene->name);
    mesh->solid = lab_doubles(&raw);
    if (!shape->surface) {
        mesh->weight = lab_weigh(&mesh->solid, centre);
    }
    for (int k = 0; k < 3; k++) {
        mesh->centre[k] = lab_double(mesh->mesh.mass.centre.c[k], 22);
    }
    mesh->radius = lab_double(mesh->mesh.radius_q22, 22);
    mesh->skin = fmax(0x1p-14, mesh->radius / 2048);
    return f->mesh_count++;
}

double fixture_skin(const struct fixture *f, int mesh)
{
    return f->meshes[mesh].skin;
}

static int add(struct fixture *f, int mesh, const double at[3], carom_quat_q30 turn, bool moves)
{
    struct fixture_body *body = &f->bodies[f->body_count];
    double centre[3];

    lab_expect(f->body_count < FIXTURE_BODIES ? CAROM_OK : CAROM_ERR_BODIES_FULL, "bodies");
    lab_rotate(centre, &turn, f->meshes[mesh].centre);
    body->mesh = mesh;
    body->def.mesh = &f->meshes[mesh].mesh;
    body->def.stationary = !moves;
    body->def.rotation = turn;
    for (int k = 0; k < 3; k++) {
        body->def.position.c[k] = lab_fixed(at[k] + centre[k], 32);
    }
    body->mass = moves ? f->meshes[mesh].weight.mass : 0;
    return f->body_count++;
}

int fixture_body(struct fixture *f, int mesh, double x, double y, double z, carom_quat_q30 turn)
{
    const double at[3] = {x, y, z};

    return add(f, mesh, at, turn, true);
}

int fixture_fixed(struct fixture *f, int mesh, double x, double y, double z, carom_quat_q30 turn)
{
    const double at[3] = {x, y, z};

    return add(f, mesh, at, turn, false);
}

int fixture_plane(struct fixture *f)
{
    fixture_shape_plane(&f->shape, 1, 60);
    return fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
}

void fixture_weigh(struct fixture *f, int body, double mass)
{
    f->bodies[body].def.mass_q20 = (uint32_t)lab_fixed(mass, 20);
    f->bodies[body].mass = mass;
}

void fixture_throw(struct fixture *f, int body, const double velocity[3], const double spin[3])
{
    for (int k = 0; k < 3; k++) {
        f->bodies[body].def.velocity.c[k] = lab_fixed(velocity[k] / 60, 40);
        f->bodies[body].def.spin.c[k] = lab_fixed(spin[k] / 60, 40);
    }
}

carom_quat_q30 fixture_compose(carom_quat_q30 second, carom_quat_q30 first)
{
    double a[4], b[4];
    carom_quat_q30 q;

    lab_quaternion(a, &second);
    lab_quaternion(b, &first);
    for (int k = 0; k < 4; k++) {
        static const int other[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
        static const double sign[4][4] = {
            {1, -1, -1, -1}, {1, 1, -1, 1}, {1, 1, 1, -1}, {1, -1, 1, 1}};
        double sum = 0;

        for (int i = 0; i < 4; i++) {
            sum += sign[k][i] * a[other[k][i]] * b[i];
        }
        q.c[k] = (int32_t)lab_fixed(sum, 30);
    }
    return q;
}

/* -------------------------------------------------------------------- looking */

static void look(struct fixture *f, int number)
{
    struct fixture_body *body = &f->bodies[number];
    const struct fixture_mesh *mesh = &f->meshes[body->mesh];

    body->before = body->now;
    body->now = mesh->weight;
    body->now.mass = body->mass;
    lab_read(&body->now, f->world, number);
    body->pose = lab_pose_of(f->world, number, &mesh->mesh);
    for (int k = 0; k < 3; k++) {
        body->low[k] = HUGE_VAL;
        body->high[k] = -HUGE_VAL;
        for (size_t v = 0; v < mesh->solid.vertex_count; v++) {
            double at = real_dot(body->pose.rotation.row[k], mesh->solid.vertices[v]) +
                        body->pose.position[k];

            body->low[k] = fmin(body->low[k], at);
            body->high[k] = fmax(body->high[k], at);
        }
    }
}

static double energy(const struct fixture *f)
{
    const double gravity[3] = {0, 0, lab_double(f->config.gravity.c[2], 40)};
    double sum = 0;

    for (int i = 0; i < f->body_count; i++) {
        sum += f->bodies[i].mass > 0 ? oracle_energy(&f->bodies[i].now, gravity) : 0;
    }
    return sum;
}

void fixture_start(struct fixture *f)
{
    size_t bytes = carom_world_bytes(&f->config.caps);

    for (int i = 0; i < f->body_count; i++) {
        f->bodies[i].def.friction_q16 = (uint32_t)lab_fixed(f->scene->mu, 16);
    }
    f->block = lab_need(bytes);
    lab_expect(carom_world_init(f->block, bytes, &f->config, &f->world), "world");
    for (int i = 0; i < f->body_count; i++) {
        lab_expect(carom_body_add(f->world, &f->bodies[i].def), f->scene->name);
        look(f, i);
        f->bodies[i].first = f->bodies[i].before = f->bodies[i].now;
    }
    f->tally.energy_first = energy(f);
}

struct fixture *fixture_begin(const struct fixture_scene *scene)
{
    struct fixture *f = lab_need(sizeof *f);

    f->scene = scene;
    f->config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    f->config.gravity.c[2] = -lab_fixed(FIXTURE_G, 40);
    return f;
}

struct fixture *fixture_new(const struct fixture_scene *scene)
{
    struct fixture *f = fixture_begin(scene);

    scene->make(f);
    fixture_start(f);
    return f;
}

void fixture_free(struct fixture *f)
{
    for (int i = 0; i < f->mesh_count; i++) {
        oracle_mesh_free(&f->meshes[i].solid);
        free(f->meshes[i].vertices);
        free(f->meshes[i].faces);
        free(f->meshes[i].block);
    }
    free(f->block);
    free(f);
}

/* ---------------------------------------------------------------------- watch */

static bool boxes_meet(const struct fixture_body *a, const struct fixture_body *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) {
            return false;
        }
    }
    return true;
}

static bool crosses(struct fixture *f, int i, int j, double *deepest)
{
    const struct fixture_body *a = &f->bodies[i], *b = &f->bodies[j];
    const struct fixture_mesh *of_a = &f->meshes[a->mesh], *of_b = &f->meshes[b->mesh];
    double skin = a->mass > 0 && b->mass > 0 ? fmin(of_a->skin, of_b->skin)
                  : a->mass > 0              ? of_a->skin
                                             : of_b->skin;
    struct oracle_crossings found =
        oracle_crossings(&of_a->solid, &a->pose, &of_b->solid, &b->pose, CROSSING_TOLERANCE);

    *deepest = fmax(*deepest, found.depth / skin);
    return found.pairs != 0;
}

/* Check every pair with a moving body; returns the depth of the deepest crossing, in skins. */
static double watch_crossings(struct fixture *f)
{
    bool crossed = false;
    double deepest = 0;

    for (int i = 0; i < f->body_count; i++) {
        for (int j = 0; j < i; j++) {
            const struct fixture_body *a = &f->bodies[i], *b = &f->bodies[j];

            if ((a->mass > 0 || b->mass > 0) && boxes_meet(a, b) && crosses(f, i, j, &deepest)) {
                if (f->tally.crossed == 0 && !crossed) {
                    f->tally.crossed_first = (int)f->tally.frames;
                    f->tally.crossed_pair[0] = j;
                    f->tally.crossed_pair[1] = i;
                }
                crossed = true;
            }
        }
    }
    f->tally.crossed += crossed;
    f->tally.depth = fmax(f->tally.depth, deepest);
    return deepest;
}

/* Bound on the motion of a body's points in the frame; below, on their speed. */
static double gone(const struct fixture_body *body, double radius)
{
    double change[3], turned = 0;

    for (int k = 0; k < 3; k++) {
        change[k] = body->now.position[k] - body->before.position[k];
    }
    for (int k = 0; k < 4; k++) {
        double part = body->now.quaternion[k] - body->before.quaternion[k];

        turned += part * part;
    }
    return real_length(change) + 2 * radius * sqrt(turned);
}

static double speed(const struct oracle_body *body, double radius)
{
    return real_length(body->velocity) + radius * real_length(body->spin);
}

/*
 * A body stands still if it has a velocity before and after the frame and hardly moves; or if its
 * pose did not change by a bit while the frame was cut short.
 */
static int watch_still(struct fixture *f, bool cut)
{
    int count = 0;

    for (int i = 0; i < f->body_count; i++) {
        struct fixture_body *body = &f->bodies[i];
        double radius = f->meshes[body->mesh].radius, way = gone(body, radius);
        double least = fmin(speed(&body->before, radius), speed(&body->now, radius));
        bool stands = (least > FIXTURE_G / 4 && way < STILL_PART * least) || (cut && way == 0);

        if (body->mass == 0) {
            continue;
        }
        body->still = stands ? body->still + 1 : 0;
        count += stands;
        if (body->still > f->tally.still) {
            f->tally.still = body->still;
            f->tally.still_body = i;
            f->tally.still_first = f->tally.frames - body->still + 1;
        }
    }
    return count;
}

static void watch_energy(struct fixture *f)
{
    double weight = 0;

    for (int i = 0; i < f->body_count; i++) {
        weight += f->bodies[i].mass * FIXTURE_G * f->meshes[f->bodies[i].mesh].skin;
    }
    f->tally.rise = fmax(f->tally.rise, (energy(f) - f->tally.energy_first) / weight);
}

/* ------------------------------------------------------------------------ run */

static double milliseconds(clock_t from)
{
    return 1e3 * (double)(clock() - from) / CLOCKS_PER_SEC;
}

static void frame(struct fixture *f, bool talk)
{
    struct carom_stats stats;
    double deepest, ms;
    clock_t from;
    int status, still;

    from = clock();
    status = carom_world_step(f->world);
    ms = milliseconds(from);
    f->tally.frames++;
    f->tally.worst_ms = fmax(f->tally.worst_ms, ms);
    f->tally.total_ms += ms;
    if (status < 0) {
        f->error = status;
        return;
    }
    if ((status & CAROM_SUBSTEP_CAP) && f->tally.cut++ == 0) {
        f->tally.cut_first = f->tally.frames;
    }
    for (int i = 0; i < f->body_count; i++) {
        if (f->bodies[i].mass > 0) {
            look(f, i);
        }
    }
    deepest = watch_crossings(f);
    still = watch_still(f, (status & CAROM_SUBSTEP_CAP) != 0);
    watch_energy(f);
    if (f->scene->watch) {
        f->scene->watch(f);
    }
    if (talk) {
        lab_expect(carom_stats(f->world, &stats), "stats");
        printf("frame %4ld: status %d, sub-steps %u, hits %u, contacts %u, candidates %u, sweeps "
               "%u; crossing %.3f skin, still %d, fastest %.4f /s, drift %.5f, energy %+.3f, %.2f "
               "ms\n",
               f->tally.frames, status, (unsigned)stats.substeps, (unsigned)stats.hits,
               (unsigned)stats.contacts, (unsigned)stats.candidates, (unsigned)stats.sweeps,
               deepest, still, fixture_fastest(f), fixture_farthest(f), f->tally.rise, ms);
    }
}

/* The demands on every scene, besides its own. */
static bool sound(struct fixture *f, int frames)
{
    const struct fixture_tally *t = &f->tally;

    if (f->error) {
        fixture_say(f, "frame %ld: %s", t->frames, carom_result_text(f->error));
    }
    if (f->late) {
        fixture_say(f, "given up for time");
    }
    if (t->crossed) {
        fixture_say(f, "bodies %d and %d cross from frame %d", t->crossed_pair[0],
                    t->crossed_pair[1], t->crossed_first);
    }
    if (t->cut) {
        fixture_say(f, "cut short from frame %ld", t->cut_first);
    }
    if (t->still > 3) {
        fixture_say(f, "body %d stands still from frame %ld", t->still_body, t->still_first);
    }
    if (t->rise > RISE_ALLOWED) {
        fixture_say(f, "energy rises by %.1f m g skin", t->rise);
    }
    return !f->error && t->frames == frames && !t->crossed && t->still <= 3 && t->cut == 0 &&
           t->rise <= RISE_ALLOWED;
}

void fixture_run(struct fixture *f, int frames, double seconds, bool talk)
{
    bool does;

    watch_crossings(f);
    if (f->tally.crossed) {
        fixture_say(f, "the scene is wrong: bodies cross before the first frame");
        return;
    }
    while (f->tally.frames < frames && !f->error && !f->late) {
        frame(f, talk);
        f->late = seconds > 0 && f->tally.total_ms > 1e3 * seconds;
    }
    does = f->scene->judge == NULL || f->scene->judge(f);
    f->passed = sound(f, frames) && does;
}

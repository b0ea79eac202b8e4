/* SPDX-License-Identifier: MIT */
/* A world with one moving body over a stationary one, watched in double precision. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "lab.h"
#include "open_cases.h"

/* Well above the rounding of coordinates, far below the skin. */
#define CROSSING_TOLERANCE 1e-9
/* Units a frame: 1/20 unit a second. */
#define SLIP (0.05 / 60)

/* ---------------------------------------------------------------------- TAP */

static struct {
    unsigned count, failed;
} tests;

void lab_report(bool ok, const char *name, const char *format, ...)
{
    va_list arguments;

    tests.count++;
    tests.failed += !ok;
    printf("%s %u - %s (", ok ? "ok" : "not ok", tests.count, name);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    puts(")");
    fflush(stdout);
}

int lab_finish(void)
{
    open_cases_print();
    printf("1..%u\n", tests.count);
    return tests.failed != 0 || tests.count == 0;
}

bool lab_given(const char *word, int count, char **words)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(words[i], word) == 0) {
            return true;
        }
    }
    return false;
}

int lab_expect(int result, const char *what)
{
    if (result < 0) {
        printf("Bail out! %s: %s\n", what, carom_result_text(result));
        exit(1);
    }
    return result;
}

void *lab_need(size_t bytes)
{
    void *memory = calloc(1, bytes);

    if (!memory) {
        puts("Bail out! no memory");
        exit(1);
    }
    return memory;
}

/* ------------------------------------------------------------------- numbers */

double lab_double(int64_t fixed, int bits)
{
    return ldexp((double)fixed, -bits);
}

int64_t lab_fixed(double value, int bits)
{
    return llrint(ldexp(value, bits));
}

carom_quat_q30 lab_turn(double x, double y, double z, double angle)
{
    double scale = sin(angle / 2) / sqrt(x * x + y * y + z * z);
    carom_quat_q30 q = {{(int32_t)lab_fixed(cos(angle / 2), 30), (int32_t)lab_fixed(x * scale, 30),
                         (int32_t)lab_fixed(y * scale, 30), (int32_t)lab_fixed(z * scale, 30)}};

    return q;
}

void lab_quaternion(double out[4], const carom_quat_q30 *q)
{
    bool none = (q->c[0] | q->c[1] | q->c[2] | q->c[3]) == 0;

    for (int k = 0; k < 4; k++) {
        out[k] = none ? k == 0 : lab_double(q->c[k], 30);
    }
}

static void turn(double out[3], const struct oracle_matrix *m, const double v[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = m->row[k][0] * v[0] + m->row[k][1] * v[1] + m->row[k][2] * v[2];
    }
}

void lab_rotate(double out[3], const carom_quat_q30 *q, const double v[3])
{
    const double nowhere[3] = {0};
    struct oracle_pose pose;
    double wxyz[4];

    lab_quaternion(wxyz, q);
    pose = oracle_pose_make(nowhere, wxyz, nowhere);
    turn(out, &pose.rotation, v);
}

/* xorshift64* */
double lab_random(uint64_t *state, double low, double high)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return low + (high - low) * ldexp((double)((*state * 0x2545f4914f6cdd1du) >> 11), -53);
}

carom_quat_q30 lab_random_turn(uint64_t *state)
{
    double axis[3], square;

    do {
        square = 0;
        for (int k = 0; k < 3; k++) {
            axis[k] = lab_random(state, -1, 1);
            square += axis[k] * axis[k];
        }
    } while (square > 1 || square < 0.01);
    return lab_turn(axis[0], axis[1], axis[2], lab_random(state, 0, 2 * acos(-1)));
}

/* -------------------------------------------------------------------- meshes */

#define SOLID(name)                                                                                \
    {                                                                                              \
        name##_vertices, name##_faces, sizeof name##_vertices / 6, sizeof name##_faces / 6, 12,    \
            CAROM_SOLID                                                                            \
    }

static const int16_t box_vertices[8][3] = BOX_CORNERS(2048, 1229, 614);
const struct carom_mesh_raw lab_box = SOLID(box);

static const int16_t plate_vertices[8][3] = BOX_CORNERS(2048, 1638, 32);
#define plate_faces box_faces
const struct carom_mesh_raw lab_plate = SOLID(plate);

static const int16_t tetrahedron_vertices[4][3] = {
    {-1900, -1400, -900}, {2100, -1200, -900}, {100, 2000, -800}, {-200, 300, 2000}};
static const uint16_t tetrahedron_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const struct carom_mesh_raw lab_tetrahedron = SOLID(tetrahedron);

/* The outline of the L, counter-clockwise, below and above. */
#define OUTLINE(z)                                                                                 \
    {0, 0, z}, {4096, 0, z}, {4096, 1400, z}, {1300, 1400, z}, {1300, 3300, z},                    \
    {                                                                                              \
        0, 3300, z                                                                                 \
    }
static const int16_t l_vertices[12][3] = {OUTLINE(0), OUTLINE(1100)};
static const uint16_t l_faces[20][3] = {{0, 2, 1},  {0, 3, 2},  {0, 4, 3},   {0, 5, 4}, {6, 7, 8},
                                        {6, 8, 9},  {6, 9, 10}, {6, 10, 11}, {0, 1, 7}, {0, 7, 6},
                                        {1, 2, 8},  {1, 8, 7},  {2, 3, 9},   {2, 9, 8}, {3, 4, 10},
                                        {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}};
const struct carom_mesh_raw lab_l = SOLID(l);

#define SHEET 10240
static const int16_t sheet_vertices[4][3] = {
    {-SHEET, -SHEET, 0}, {SHEET, -SHEET, 0}, {-SHEET, SHEET, 0}, {SHEET, SHEET, 0}};
static const uint16_t sheet_faces[2][3] = {{0, 1, 3}, {0, 3, 2}};
const struct carom_mesh_raw lab_sheet = {sheet_vertices, sheet_faces, 4, 2, 8, CAROM_SURFACE};

#define GRID 48
const struct carom_mesh_raw *lab_grid(void)
{
    static int16_t vertices[(GRID + 1) * (GRID + 1)][3];
    static uint16_t faces[2 * GRID * GRID][3];
    static const struct carom_mesh_raw grid = {(const int16_t(*)[3])vertices,
                                               (const uint16_t(*)[3])faces,
                                               (GRID + 1) * (GRID + 1),
                                               2 * GRID * GRID,
                                               8,
                                               CAROM_SURFACE};

    for (int v = 0; v < (GRID + 1) * (GRID + 1); v++) {
        vertices[v][0] = (int16_t)((v % (GRID + 1) * 2 - GRID) * 160);
        vertices[v][1] = (int16_t)((v / (GRID + 1) * 2 - GRID) * 160);
    }
    for (int f = 0; f < GRID * GRID; f++) {
        int low = f / GRID * (GRID + 1) + f % GRID, high = low + GRID + 1;
        int corners[2][3] = {{low, low + 1, high + 1}, {low, high + 1, high}};

        for (int k = 0; k < 3; k++) {
            faces[2 * f][k] = (uint16_t)corners[0][k];
            faces[2 * f + 1][k] = (uint16_t)corners[1][k];
        }
    }
    return &grid;
}

/* ---------------------------------------------------------------------- mass */

/*
 * Volume, centre and second moments, by summing the tetrahedra between each face and the origin.
 * With corners 0, a, b, c and six times the volume d, the integral of x_i x_j is d (sum_i sum_j +
 * a_i a_j + b_i b_j + c_i c_j) / 120, sum = a + b + c.
 */
struct oracle_body lab_weigh(const struct oracle_mesh *mesh, double centre[3])
{
    struct oracle_body body = {.mass = 0};
    double volume = 0, first[3] = {0}, second[3][3] = {{0}};

    for (size_t f = 0; f < mesh->face_count; f++) {
        const double *a = mesh->vertices[mesh->faces[f][0]];
        const double *b = mesh->vertices[mesh->faces[f][1]];
        const double *c = mesh->vertices[mesh->faces[f][2]];
        double d = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);

        volume += d / 6;
        for (int i = 0; i < 3; i++) {
            double sum = a[i] + b[i] + c[i];

            first[i] += d * sum / 24;
            for (int j = 0; j < 3; j++) {
                second[i][j] +=
                    d * (sum * (a[j] + b[j] + c[j]) + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) /
                    120;
            }
        }
    }
    body.mass = volume;
    for (int i = 0; i < 3; i++) {
        centre[i] = first[i] / volume;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;

        body.inertia[i] =
            (second[j][j] + second[k][k]) / volume - centre[j] * centre[j] - centre[k] * centre[k];
        /* xy, yz, zx */
        body.inertia[3 + i] = centre[i] * centre[j] - second[i][j] / volume;
    }
    return body;
}

/* --------------------------------------------------------------------- worlds */

struct oracle_mesh lab_doubles(const struct carom_mesh_raw *raw)
{
    return oracle_mesh_make(raw->vertices, raw->vertex_count, raw->faces, raw->face_count,
                            raw->quantum_bits);
}

static void prepare(struct lab *lab)
{
    struct oracle_body weight;

    lab->config = scene_config();
    lab->ground = lab_doubles(&lab->scene.ground.mesh->raw);
    lab->body = lab_doubles(&lab->scene.body.mesh->raw);
    lab->skin = lab_double(lab->scene.body.mesh->radius_q22, 22) / 2048;
    weight = lab_weigh(&lab->body, lab->centre);
    lab->mass = weight.mass;
    memcpy(lab->inertia, weight.inertia, sizeof lab->inertia);
}

struct lab *lab_load_scene(const char *name)
{
    struct lab *lab = lab_need(sizeof *lab);

    lab->mesh_block = lab_need(SCENE_MESH_BYTES);
    lab_expect(scene_load(&lab->scene, name, NULL, lab->mesh_block, SCENE_MESH_BYTES), name);
    prepare(lab);
    return lab;
}

struct lab *lab_load(const struct carom_mesh_raw *ground, const struct carom_mesh_raw *body)
{
    struct lab *lab = lab_need(sizeof *lab);
    size_t ground_bytes = CAROM_MESH_BYTES(ground->vertex_count, ground->face_count);
    size_t body_bytes = CAROM_MESH_BYTES(body->vertex_count, body->face_count);

    struct carom_mesh *meshes = lab_need(2 * sizeof *meshes + ground_bytes + body_bytes);
    char *index = (char *)(meshes + 2);

    lab->mesh_block = meshes;
    lab_expect(carom_mesh_build(&meshes[0], ground, index, ground_bytes), "ground");
    lab_expect(carom_mesh_build(&meshes[1], body, index + ground_bytes, body_bytes), "body");
    lab->scene.ground.mesh = &meshes[0];
    lab->scene.ground.stationary = true;
    lab->scene.body.mesh = &meshes[1];
    prepare(lab);
    lab_surface(lab, 0.5, 0.5);
    return lab;
}

void lab_surface(struct lab *lab, double e, double mu)
{
    struct carom_body_def *defs[2] = {&lab->scene.ground, &lab->scene.body};

    for (int i = 0; i < 2; i++) {
        defs[i]->restitution_q30 = (int32_t)lab_fixed(e, 30);
        defs[i]->friction_q16 = (uint32_t)lab_fixed(mu, 16);
    }
}

void lab_start(struct lab *lab)
{
    const struct carom_caps *caps = &lab->config.caps;
    size_t bytes = CAROM_WORLD_BYTES(caps->bodies, caps->pairs, caps->contacts, caps->faces,
                                     caps->entries, caps->candidates);

    free(lab->world_block);
    lab->world_block = lab_need(bytes);
    lab_expect(scene_make(&lab->scene, &lab->config, lab->world_block, bytes, &lab->world),
               "world");
}

void lab_free(struct lab *lab)
{
    oracle_mesh_free(&lab->ground);
    oracle_mesh_free(&lab->body);
    free(lab->mesh_block);
    free(lab->world_block);
    free(lab);
}

struct carom_body_state lab_state(const struct carom_world *world, int body)
{
    struct carom_body_state state;

    lab_expect(carom_body_get(world, body, &state), "body");
    return state;
}

bool lab_asleep(const struct lab *lab)
{
    return lab_state(lab->world, SCENE_BODY).asleep;
}

void lab_read(struct oracle_body *body, const struct carom_world *world, int number)
{
    struct carom_body_state state = lab_state(world, number);

    lab_quaternion(body->quaternion, &state.rotation);
    for (int k = 0; k < 3; k++) {
        body->position[k] = lab_double(state.position.c[k], 32);
        body->velocity[k] = lab_double(state.velocity.c[k], 40);
        body->spin[k] = lab_double(state.spin.c[k], 40);
    }
}

struct oracle_body lab_body(const struct lab *lab)
{
    struct oracle_body body = {.mass = lab->mass};

    memcpy(body.inertia, lab->inertia, sizeof body.inertia);
    lab_read(&body, lab->world, SCENE_BODY);
    return body;
}

static void gravity_of(const struct lab *lab, double gravity[3])
{
    for (int k = 0; k < 3; k++) {
        gravity[k] = lab_double(lab->config.gravity.c[k], 40);
    }
}

double lab_energy(const struct lab *lab)
{
    struct oracle_body body = lab_body(lab);
    double gravity[3];

    gravity_of(lab, gravity);
    return oracle_energy(&body, gravity);
}

/* Vertices are relative to the mesh's own centre; lab_weigh may differ in the last bit. */
struct oracle_pose lab_pose_of(const struct carom_world *world, int body,
                               const struct carom_mesh *mesh)
{
    struct oracle_body at;
    double centre[3];

    lab_read(&at, world, body);
    for (int k = 0; k < 3; k++) {
        centre[k] = lab_double(mesh->mass.centre.c[k], 22);
    }
    return oracle_pose_make(at.position, at.quaternion, centre);
}

struct oracle_pose lab_pose(const struct lab *lab, int body)
{
    return lab_pose_of(lab->world, body,
                       body == SCENE_BODY ? lab->scene.body.mesh : lab->scene.ground.mesh);
}

struct oracle_crossings lab_crossings(const struct lab *lab)
{
    struct oracle_pose ground = lab_pose(lab, SCENE_GROUND), body = lab_pose(lab, SCENE_BODY);

    return oracle_crossings(&lab->body, &body, &lab->ground, &ground, CROSSING_TOLERANCE);
}

double lab_lowest(const struct lab *lab, const double up[3])
{
    struct oracle_pose pose = lab_pose(lab, SCENE_BODY);
    double lowest = HUGE_VAL;

    for (size_t v = 0; v < lab->body.vertex_count; v++) {
        double place[3], height = 0;

        turn(place, &pose.rotation, lab->body.vertices[v]);
        for (int k = 0; k < 3; k++) {
            height += up[k] * (place[k] + pose.position[k]);
        }
        lowest = fmin(lowest, height);
    }
    return lowest;
}

/* ---------------------------------------------------------------------- watch */

/* Whether a contact that carries weight slips. */
static bool slides(const struct lab *lab)
{
    struct carom_contact contacts[64];
    struct oracle_body body = lab_body(lab);
    int n = carom_contacts(lab->world, contacts, 64);

    for (int i = 0; i < n && i < 64; i++) {
        double arm[3], velocity[3], along = 0, square = 0;

        for (int k = 0; k < 3; k++) {
            arm[k] = lab_double(contacts[i].point.c[k], 32) - body.position[k];
        }
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;

            velocity[k] = body.velocity[k] + body.spin[a] * arm[b] - body.spin[b] * arm[a];
            along += velocity[k] * lab_double(contacts[i].normal.c[k], 30);
            square += velocity[k] * velocity[k];
        }
        if (contacts[i].impulse_q40 > 0 && square - along * along > SLIP * SLIP) {
            return true;
        }
    }
    return false;
}

static void watch_events(const struct lab *lab, struct lab_tally *tally)
{
    const struct carom_event *events;
    int n = carom_events(lab->world, &events);

    for (int i = 0; i < n; i++) {
        tally->hits += events[i].kind == CAROM_EVENT_HIT;
        tally->begins += events[i].kind == CAROM_EVENT_BEGIN;
        tally->ends += events[i].kind == CAROM_EVENT_END;
    }
}

static void watch_energy(const struct lab *lab, struct lab_tally *tally, bool contact)
{
    double gravity[3], weight, energy = lab_energy(lab);

    gravity_of(lab, gravity);
    weight = lab->mass *
             sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    if (tally->frames == 1) {
        tally->energy_first = energy;
    } else if (contact) {
        tally->contact_rise =
            fmax(tally->contact_rise, (energy - tally->energy) / (weight * lab->skin));
    } else {
        tally->flight_change = fmax(tally->flight_change, fabs(energy / tally->energy - 1));
    }
    tally->energy_change = fmax(tally->energy_change, fabs(energy / tally->energy_first - 1));
    tally->energy = energy;
}

int lab_step(struct lab *lab, struct lab_tally *tally)
{
    int status = lab_expect(carom_world_step(lab->world), "step");
    struct carom_stats stats;

    if (!tally) {
        return status;
    }
    lab_expect(carom_stats(lab->world, &stats), "stats");
    tally->frames++;
    tally->capped += (status & CAROM_SUBSTEP_CAP) != 0;
    tally->substeps[stats.substeps < 64 ? stats.substeps : 64]++;
    tally->crossed += lab_crossings(lab).pairs != 0;
    tally->touching += stats.contacts != 0;
    tally->sliding += slides(lab);
    watch_events(lab, tally);
    watch_energy(lab, tally, stats.contacts != 0 || stats.hits != 0);
    return status;
}

uint32_t lab_substeps(const struct lab_tally *tally, double share)
{
    double frames = 0;
    uint32_t n = 0;

    while (n < 64 && (frames += tally->substeps[n]) < share * (double)tally->frames) {
        n++;
    }
    return n;
}

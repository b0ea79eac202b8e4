/* SPDX-License-Identifier: MIT */
/* Worlds of many bodies, watched in double precision through the public interface. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "crowd.h"
#include "real.h"

/* Bounds on the rise of an island's energy in a frame (DESIGN.md). */
#define LIFT_ALLOWED   0.2
#define IMPACT_ALLOWED 0x1p-24
#define ULP_Q40        0x1p-40
#define LINK_PLACES                                                                                \
    0x1p-26 /* units: the places that links keep, and the last place of a rotation on a long arm */
#define LINK_LEFT         0.125   /* skins: a solve ends when anchors are that close */
#define ROTATION_ROUNDING 0x1p-29 /* radians */

/* bodies, pairs, contacts, faces, entries, candidates, joints, extras */
#define CAPS                                                                                       \
    CROWD_BODIES, CROWD_BODIES *(CROWD_BODIES - 1) / 2, 4096, 65535, 65535, 65535, 0, CROWD_BODIES

static void gravity_of(const struct crowd *crowd, double gravity[3])
{
    for (int k = 0; k < 3; k++) {
        gravity[k] = lab_double(crowd->config.gravity.c[k], 40);
    }
}

static bool moves(const struct crowd *crowd, int body)
{
    return !crowd->bodies[body].def.stationary && !crowd->bodies[body].def.kinematic;
}

static bool active(const struct crowd *crowd, int body)
{
    const struct crowd_seen *now = &crowd->bodies[body].now;

    return moves(crowd, body) && !now->state.asleep && !now->state.out;
}

/* -------------------------------------------------------------------- worlds */

struct crowd *crowd_new(void)
{
    struct crowd *crowd = lab_need(sizeof *crowd);

    crowd->config = scene_config();
    crowd->config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    return crowd;
}

void crowd_free(struct crowd *crowd)
{
    for (int i = 0; i < crowd->mesh_count; i++) {
        oracle_mesh_free(&crowd->meshes[i].solid);
        free(crowd->meshes[i].vertices);
        free(crowd->meshes[i].block);
    }
    free(crowd->block);
    free(crowd);
}

int crowd_mesh(struct crowd *crowd, const struct carom_mesh_raw *raw)
{
    struct crowd_mesh *mesh = &crowd->meshes[crowd->mesh_count];
    size_t bytes = CAROM_MESH_BYTES(raw->vertex_count, raw->face_count);
    double centre[3];

    lab_expect(crowd->mesh_count < CROWD_MESHES ? CAROM_OK : CAROM_ERR_MESH_SIZE, "meshes");
    mesh->block = lab_need(bytes);
    lab_expect(carom_mesh_build(&mesh->mesh, raw, mesh->block, bytes), "mesh");
    mesh->solid = lab_doubles(raw);
    if (raw->kind == CAROM_SOLID) {
        mesh->weight = lab_weigh(&mesh->solid, centre);
    }
    mesh->radius = lab_double(mesh->mesh.radius_q22, 22);
    mesh->skin = fmax(0x1p-14, mesh->radius / 2048);
    return crowd->mesh_count++;
}

/* Sixteen thousand quanta for the largest coordinate, unless quanta would be too small. */
int crowd_solid(struct crowd *crowd, const struct carom_mesh_raw *raw, const double scale[3])
{
    struct carom_mesh_raw scaled = *raw;
    int16_t(*vertices)[3] = lab_need(raw->vertex_count * sizeof *vertices);
    double largest = 0;
    int mesh;

    for (uint32_t v = 0; v < raw->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(raw->vertices[v][k] * scale[k]));
        }
    }
    largest = ldexp(largest, -raw->quantum_bits);
    scaled.quantum_bits = 7;
    while (scaled.quantum_bits < 20 && ldexp(largest, scaled.quantum_bits + 1) <= 16384) {
        scaled.quantum_bits++;
    }
    for (uint32_t v = 0; v < raw->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            vertices[v][k] = (int16_t)lrint(
                ldexp(raw->vertices[v][k] * scale[k], scaled.quantum_bits - raw->quantum_bits));
        }
    }
    scaled.vertices = (const int16_t(*)[3])vertices;
    mesh = crowd_mesh(crowd, &scaled);
    crowd->meshes[mesh].vertices = vertices;
    return mesh;
}

int crowd_box(struct crowd *crowd, double x, double y, double z)
{
    /* the sides of lab_box, in quanta of 2^-12 */
    const double scale[3] = {x * 4096 / 4096, y * 4096 / 2458, z * 4096 / 1228};

    return crowd_solid(crowd, &lab_box, scale);
}

#define RINGS    5
#define SEGMENTS 10
int crowd_ball(struct crowd *crowd, double radius)
{
    static int16_t vertices[RINGS * SEGMENTS][3];
    static uint16_t faces[2 * (RINGS - 1) * SEGMENTS + 2 * (SEGMENTS - 2)][3];
    static const struct carom_mesh_raw ball = {(const int16_t(*)[3])vertices,
                                               (const uint16_t(*)[3])faces,
                                               sizeof vertices / sizeof *vertices,
                                               sizeof faces / sizeof *faces,
                                               12,
                                               CAROM_SOLID};
    const double pi = acos(-1), scale[3] = {radius, radius, radius};
    int n = 0;

    for (int v = 0; v < RINGS * SEGMENTS; v++) {
        double up = pi * (v / SEGMENTS + 0.5) / RINGS, around = 2 * pi * (v % SEGMENTS) / SEGMENTS;

        vertices[v][0] = (int16_t)lrint(-4096 * cos(up));
        vertices[v][1] = (int16_t)lrint(4096 * sin(up) * cos(around));
        vertices[v][2] = (int16_t)lrint(4096 * sin(up) * sin(around));
    }
    for (int v = 0; v < (RINGS - 1) * SEGMENTS; v++) {
        int next = v % SEGMENTS == SEGMENTS - 1 ? v + 1 - SEGMENTS : v + 1;
        int corners[2][3] = {{v, v + SEGMENTS, next}, {next, v + SEGMENTS, next + SEGMENTS}};

        for (int f = 0; f < 6; f++) {
            faces[n + f / 3][f % 3] = (uint16_t)corners[f / 3][2 - f % 3];
        }
        n += 2;
    }
    for (int v = 1; v < SEGMENTS - 1; v++) {
        int last = (RINGS - 1) * SEGMENTS;
        int corners[2][3] = {{0, v + 1, v}, {last, last + v, last + v + 1}};

        for (int f = 0; f < 6; f++) {
            faces[n + f / 3][f % 3] = (uint16_t)corners[f / 3][f % 3];
        }
        n += 2;
    }
    return crowd_solid(crowd, &ball, scale);
}

struct carom_body_def *crowd_body(struct crowd *crowd, int mesh)
{
    struct crowd_body *body = &crowd->bodies[crowd->body_count];

    lab_expect(crowd->body_count < CROWD_BODIES ? CAROM_OK : CAROM_ERR_BODIES_FULL, "bodies");
    memset(body, 0, sizeof *body);
    body->mesh = mesh;
    body->def.mesh = &crowd->meshes[mesh].mesh;
    body->def.stationary = body->def.mesh->raw.kind == CAROM_SURFACE;
    body->def.restitution_q30 = CAROM_ONE_Q30 / 2;
    body->def.friction_q16 = 1u << 15;
    crowd->body_count++;
    return &body->def;
}

void crowd_clear(struct crowd *crowd)
{
    crowd->body_count = 0;
}

void crowd_place(struct carom_body_def *def, double x, double y, double z)
{
    def->position = (carom_v3_q32){{lab_fixed(x, 32), lab_fixed(y, 32), lab_fixed(z, 32)}};
}

void crowd_surface(struct crowd *crowd, double e, double mu)
{
    for (int i = 0; i < crowd->body_count; i++) {
        crowd->bodies[i].def.restitution_q30 = (int32_t)lab_fixed(e, 30);
        crowd->bodies[i].def.friction_q16 = (uint32_t)lab_fixed(mu, 16);
    }
}

void crowd_move(struct carom_body_def *def, const double velocity[3], const double spin[3])
{
    for (int k = 0; k < 3; k++) {
        def->velocity.c[k] = lab_fixed(velocity[k], 40);
        def->spin.c[k] = lab_fixed(spin[k], 40);
    }
}

int crowd_start(struct crowd *crowd)
{
    const struct carom_caps *caps = &crowd->config.caps;
    size_t bytes =
        CAROM_WORLD_BYTES(caps->bodies, caps->pairs, caps->contacts, caps->faces, caps->entries,
                          caps->candidates, caps->joints, caps->extras, caps->hits);

    if (!crowd->block) {
        crowd->block = lab_need(bytes);
    }
    lab_expect(carom_world_init(crowd->block, bytes, &crowd->config, &crowd->world), "world");
    memset(crowd->touching, 0, sizeof crowd->touching);
    memset(crowd->where, CROWD_OVER, sizeof crowd->where);
    memset(crowd->beside, 0, sizeof crowd->beside);
    for (int i = 0; i < crowd->body_count; i++) {
        struct crowd_body *body = &crowd->bodies[i];
        int result = carom_body_add(crowd->world, &body->def);

        if (result < 0) {
            return result;
        }
        body->mass = body->def.mass_q20 ? lab_double(body->def.mass_q20, 20)
                                        : crowd->meshes[body->mesh].weight.mass;
    }
    crowd_look(crowd);
    return CAROM_OK;
}

/* --------------------------------------------------------------------- looking */

static void look_at_box(struct crowd_seen *seen, const struct crowd *crowd, int body)
{
    const struct crowd_mesh *mesh = &crowd->meshes[crowd->bodies[body].mesh];
    struct oracle_pose pose = lab_pose_of(crowd->world, body, &mesh->mesh);

    for (int k = 0; k < 3; k++) {
        seen->low[k] = HUGE_VAL;
        seen->high[k] = -HUGE_VAL;
        for (size_t v = 0; v < mesh->solid.vertex_count; v++) {
            double at = real_dot(pose.rotation.row[k], mesh->solid.vertices[v]) + pose.position[k];

            seen->low[k] = fmin(seen->low[k], at);
            seen->high[k] = fmax(seen->high[k], at);
        }
    }
}

/* Angular momentum about the origin: x p + R I R^T w. */
static void look_at_angular(struct crowd_seen *seen)
{
    const double *i = seen->body.inertia, nowhere[3] = {0};
    const double tensor[3][3] = {{i[0], i[3], i[5]}, {i[3], i[1], i[4]}, {i[5], i[4], i[2]}};
    struct oracle_pose pose = oracle_pose_make(nowhere, seen->body.quaternion, nowhere);
    double spin[3] = {0}, own[3], across[3];

    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            spin[k] += pose.rotation.row[j][k] * seen->body.spin[j];
        }
    }
    for (int k = 0; k < 3; k++) {
        own[k] = seen->body.mass * real_dot(tensor[k], spin);
    }
    real_cross(across, spin, own);
    seen->sway = real_length(across);
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;

        seen->angular[k] = real_dot(pose.rotation.row[k], own) +
                           seen->body.position[m] * seen->momentum[n] -
                           seen->body.position[n] * seen->momentum[m];
    }
}

static void look_at(struct crowd *crowd, int i)
{
    struct crowd_body *body = &crowd->bodies[i];
    struct crowd_seen *seen = &body->now;
    const double none[3] = {0};
    double gravity[3];

    gravity_of(crowd, gravity);
    seen->state = lab_state(crowd->world, i);
    seen->body = crowd->meshes[body->mesh].weight;
    seen->body.mass = moves(crowd, i) ? body->mass : 0;
    lab_read(&seen->body, crowd->world, i);
    look_at_box(seen, crowd, i);
    seen->kinetic = oracle_energy(&seen->body, none);
    seen->potential = -seen->body.mass * real_dot(gravity, seen->body.position);
    for (int k = 0; k < 3; k++) {
        seen->momentum[k] = seen->body.mass * seen->body.velocity[k];
    }
    look_at_angular(seen);
}

void crowd_look(struct crowd *crowd)
{
    for (int i = 0; i < crowd->body_count; i++) {
        look_at(crowd, i);
        crowd->bodies[i].before = crowd->bodies[i].now;
    }
}

/* ---------------------------------------------------------------------- islands */

static bool drives(const struct crowd *crowd, int body)
{
    return crowd->bodies[body].drives || crowd->bodies[body].def.kinematic;
}

/* Put two bodies into one island, or note that one of them touches a static body. */
static void unite(struct crowd *crowd, int a, int b)
{
    int from = crowd->bodies[a].island, to = crowd->bodies[b].island;

    crowd->bodies[a].driven |= drives(crowd, b);
    crowd->bodies[b].driven |= drives(crowd, a);
    if (!moves(crowd, a) || !moves(crowd, b)) {
        crowd->bodies[a].grounded |= !moves(crowd, b);
        crowd->bodies[b].grounded |= !moves(crowd, a);
        return;
    }
    for (int i = 0; i < crowd->body_count; i++) {
        if (crowd->bodies[i].island == (from > to ? from : to)) {
            crowd->bodies[i].island = from > to ? to : from;
        }
    }
}

static void touch(struct crowd *crowd, int a, int b)
{
    crowd->bodies[a].touching = crowd->bodies[b].touching = true;
    unite(crowd, a, b);
}

static void unite_links(struct crowd *crowd)
{
    for (int i = 0; i < crowd->link_count; i++) {
        const struct crowd_link *link = &crowd->links[i];

        if (!link->there) {
            continue;
        }
        crowd->bodies[link->a].driven |= link->works;
        crowd->bodies[link->a].linked = true;
        if (link->b < 0) {
            crowd->bodies[link->a].grounded = true;
        } else {
            crowd->bodies[link->b].linked = true;
            unite(crowd, link->a, link->b);
        }
    }
}

/* Unite the bodies that touched in this frame into islands. */
static void find_islands(struct crowd *crowd, struct crowd_tally *tally)
{
    const struct carom_event *events;
    int n = carom_events(crowd->world, &events);

    for (int i = 0; i < crowd->body_count; i++) {
        crowd->bodies[i].island = i;
        crowd->bodies[i].touching = crowd->bodies[i].grounded = false;
        crowd->bodies[i].driven = crowd->bodies[i].linked = false;
    }
    for (int i = 0; i < n; i++) {
        const struct carom_event *e = &events[i];

        tally->out += e->kind == CAROM_EVENT_OUT;
        tally->hits += e->kind == CAROM_EVENT_HIT;
        if (e->kind == CAROM_EVENT_HIT) {
            touch(crowd, e->a, e->b);
        } else if (e->kind == CAROM_EVENT_BEGIN || e->kind == CAROM_EVENT_END) {
            crowd->touching[e->a][e->b] = e->kind == CAROM_EVENT_BEGIN;
        }
    }
    for (int a = 0; a < crowd->body_count; a++) {
        for (int b = 0; b < crowd->body_count; b++) {
            /* bodies that left the world before are frozen, and go on touching */
            if (crowd->touching[a][b] && !crowd->bodies[a].before.state.out &&
                !crowd->bodies[b].before.state.out) {
                touch(crowd, a, b);
            }
        }
    }
    unite_links(crowd);
}

double crowd_least_inertia(const double i[6])
{
    double determinant = i[0] * (i[1] * i[2] - i[4] * i[4]) - i[3] * (i[3] * i[2] - i[4] * i[5]) +
                         i[5] * (i[3] * i[4] - i[1] * i[5]);
    double trace = i[0] + i[1] + i[2];

    return trace > 0 ? 2 * determinant / (trace * trace) : 1;
}

/*
 * The energy that rounding may add to a body. Some units of the last place of its momenta, of its
 * place and of the reported velocities, once more in every few sub-steps. Each sub-step, and each
 * slice of half a radian, rounds its rotation to q30: if the angular momentum L stays while the
 * body turns by an angle, the energy changes by up to w x L times that angle.
 */
static double noise(const struct crowd *crowd, const struct crowd_body *body)
{
    const struct crowd_seen *seen = &body->now;
    double v = real_length(seen->body.velocity), w = real_length(seen->body.spin), m = body->mass;
    double r = crowd->meshes[body->mesh].radius, gravity[3], once;

    gravity_of(crowd, gravity);
    once =
        8 * ULP_Q40 * (v + w + m * (v + w + r * w)) +
        64 * ULP_Q40 * ULP_Q40 * (m + 1 / m + 1 / (m * crowd_least_inertia(seen->body.inertia))) +
        0x1p-31 * m * real_length(gravity);
    return (1 + crowd->substeps / 4) * once +
           ROTATION_ROUNDING * (crowd->substeps + 2 * w + 1) * fmax(seen->sway, body->before.sway);
}

/* ------------------------------------------------------------------------ watch */

/*
 * The energy that the springs of an island took up in the frame. `rounding` is the part from the
 * last places of their ends.
 */
static double stored_in(const struct crowd *crowd, int island, double *rounding)
{
    double rise = 0;

    *rounding = 0;

    for (int i = 0; i < crowd->link_count; i++) {
        const struct crowd_link *link = &crowd->links[i];

        if (link->there && crowd->bodies[link->a].island == island) {
            rise += link->stored[1] - link->stored[0];
            *rounding += link->noise[0] + link->noise[1];
        }
    }
    return rise;
}

static void watch_energy(const struct crowd *crowd, int island, struct crowd_tally *tally)
{
    double rounding, rise = stored_in(crowd, island, &rounding), kinetic[2] = {0}, weight = 0;
    double gravity[3], allowed;
    bool linked = false, touching = false;

    gravity_of(crowd, gravity);
    for (int i = island; i < crowd->body_count; i++) {
        const struct crowd_body *body = &crowd->bodies[i];

        if (body->island != island || !moves(crowd, i)) {
            continue;
        }
        if (body->driven) {
            return;
        }
        linked |= body->linked;
        touching |= body->touching;
        /* a body that hangs on a lifted one moves with it; as one body, both have more weight and
         * the larger skin */
        weight += body->touching || body->linked
                      ? body->mass * real_length(gravity) * crowd->meshes[body->mesh].skin
                      : 0;
        kinetic[0] += body->before.kinetic;
        kinetic[1] += body->now.kinetic;
        rise +=
            body->now.kinetic - body->before.kinetic + body->now.potential - body->before.potential;
        rounding += noise(crowd, body);
    }
    if (linked && !touching) {
        return; /* watch_groups does that */
    }
    rounding += IMPACT_ALLOWED * fmax(kinetic[0], kinetic[1]);
    allowed = rounding + LIFT_ALLOWED * weight;
    if (weight > 0) {
        tally->lift = fmax(tally->lift, (rise - rounding) / weight);
    }
    if (allowed > 0 && rise / allowed > tally->rise) {
        tally->rise = rise / allowed;
        tally->rise_frame = tally->frames;
        tally->rise_body = island;
    }
}

/* Only gravity changes the momentum of bodies that touch nothing stationary. */
static void watch_momentum(const struct crowd *crowd, int island, struct crowd_tally *tally)
{
    double change[3] = {0}, turn[3] = {0}, gravity[3];
    double size = 0, turn_size = 0, rounding = 0, moment = 0;

    gravity_of(crowd, gravity);
    for (int i = island; i < crowd->body_count; i++) {
        const struct crowd_body *body = &crowd->bodies[i];
        double from_origin = real_length(body->now.body.position);

        if (body->island != island || !moves(crowd, i)) {
            continue;
        }
        if (body->grounded) {
            return;
        }
        for (int k = 0; k < 3; k++) {
            change[k] += body->now.momentum[k] - body->before.momentum[k] - body->mass * gravity[k];
            turn[k] += body->now.angular[k] - body->before.angular[k];
        }
        size += real_length(body->now.momentum) + body->mass * real_length(gravity);
        turn_size += real_length(body->now.angular);
        rounding += 8 * ULP_Q40 * (1 + body->mass);
        moment += 8 * ULP_Q40 * (1 + body->mass) * (1 + from_origin);
    }
    if (size > 0) {
        tally->momentum = fmax(tally->momentum, (real_length(change) - rounding) / size);
    }
    if (turn_size > 0 && real_length(gravity) == 0) {
        tally->angular = fmax(tally->angular, (real_length(turn) - moment) / turn_size);
    }
}

static void count_resting(const struct crowd *crowd, struct crowd_tally *tally)
{
    double gravity[3];

    gravity_of(crowd, gravity);
    tally->asleep = tally->slow = 0;
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_seen *now = &crowd->bodies[i].now;
        double speed = real_length(now->body.velocity) +
                       crowd->meshes[crowd->bodies[i].mesh].radius * real_length(now->body.spin);

        tally->asleep += moves(crowd, i) && now->state.asleep;
        tally->slow += moves(crowd, i) && (now->state.asleep || speed < real_length(gravity) / 8);
    }
}

void crowd_group_links(struct crowd *crowd)
{
    bool changed = true;
    int before[CROWD_BODIES];

    memcpy(before, crowd->group_of, sizeof before);
    for (int i = 0; i < crowd->body_count; i++) {
        crowd->group_of[i] = i;
    }
    while (changed) {
        changed = false;
        for (int i = 0; i < crowd->link_count; i++) {
            const struct crowd_link *link = &crowd->links[i];
            int *a = &crowd->group_of[link->a], *b = link->b < 0 ? a : &crowd->group_of[link->b];

            if (link->there && link->b >= 0 && moves(crowd, link->b) && *a != *b) {
                *a = *b = *a < *b ? *a : *b;
                changed = true;
            }
        }
    }
    /* other groups start again */
    for (int i = 0; i < crowd->body_count; i++) {
        for (int k = 0; k < crowd->body_count; k++) {
            if ((before[k] == i) != (crowd->group_of[k] == i)) {
                crowd->groups[i] = (struct crowd_group){0, 0};
            }
        }
    }
}

/*
 * The kinetic and spring energy of a group, and all its energy. False when the group is touched or
 * driven.
 */
static bool look_at_group(const struct crowd *crowd, int group, double *moves_or_held, double *rise,
                          double *rounding)
{
    bool alone = true;
    double gravity[3];

    gravity_of(crowd, gravity);
    *moves_or_held = *rise = *rounding = 0;
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_body *body = &crowd->bodies[i];

        if (crowd->group_of[i] == group && moves(crowd, i)) {
            *rise += body->now.kinetic + body->now.potential - body->before.kinetic -
                     body->before.potential;
            *moves_or_held += body->now.kinetic;
            *rounding += body->mass * ((LINK_PLACES + LINK_LEFT * crowd->meshes[body->mesh].skin) *
                                           real_length(gravity) +
                                       LINK_PLACES * LINK_PLACES);
            alone = alone && !body->touching && !body->driven && !body->now.state.out;
        }
    }
    for (int i = 0; i < crowd->link_count; i++) {
        const struct crowd_link *link = &crowd->links[i];

        if (link->there && crowd->group_of[link->a] == group) {
            *rise += link->stored[1] - link->stored[0];
            *moves_or_held += link->stored[1];
            alone = alone && !link->works;
        }
    }
    return alone;
}

/* A touched group may not get back the energy that it lost before. */
static void watch_groups(struct crowd *crowd, struct crowd_tally *tally)
{
    for (int i = 0; i < crowd->body_count; i++) {
        struct crowd_group *group = &crowd->groups[i];
        double now, rise, rounding;

        if (!crowd->bodies[i].linked || crowd->group_of[i] != i) {
            continue;
        }
        if (look_at_group(crowd, i, &now, &rise, &rounding)) {
            group->gained += rise;
        } else {
            group->gained = fmax(group->gained, 0);
        }
        group->most = fmax(group->most, now);
        if (group->gained - rounding > tally->gained * group->most) {
            tally->gained = (group->gained - rounding) / group->most;
            tally->gained_frame = tally->frames;
            tally->gained_body = i;
        }
    }
}

int crowd_step(struct crowd *crowd, struct crowd_tally *tally)
{
    int status = carom_world_step(crowd->world);

    if (status >= 0) {
        crowd_watch(crowd, status, tally);
    }
    return status;
}

void crowd_watch(struct crowd *crowd, int status, struct crowd_tally *tally)
{
    struct carom_stats stats;

    lab_expect(carom_stats(crowd->world, &stats), "stats");
    crowd->substeps = stats.substeps;
    tally->frames++;
    tally->capped += (status & CAROM_SUBSTEP_CAP) != 0;
    for (int i = 0; i < crowd->body_count; i++) {
        crowd->bodies[i].before = crowd->bodies[i].now;
        if (active(crowd, i) || crowd->bodies[i].def.kinematic ||
            lab_state(crowd->world, i).asleep != crowd->bodies[i].now.state.asleep) {
            look_at(crowd, i);
        }
    }
    find_islands(crowd, tally);
    for (int i = 0; i < crowd->body_count; i++) {
        if (!moves(crowd, i) || crowd->bodies[i].island != i || crowd->bodies[i].now.state.out) {
            continue;
        }
        watch_energy(crowd, i, tally);
        if (!(status & CAROM_SUBSTEP_CAP)) {
            watch_momentum(crowd, i, tally);
        }
    }
    watch_groups(crowd, tally);
    crowd_watch_crossings(crowd, tally);
    count_resting(crowd, tally);
}

/* SPDX-License-Identifier: MIT */
/* The bodies of a crowd that cross or lie inside each other, judged by all of their faces. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "crowd.h"
#include "real.h"

/* True for a body that nothing can push; two of these may cross each other. */
static bool is_still(const struct crowd_body *body)
{
    return body->def.stationary || body->def.kinematic;
}

/* Well above the rounding of coordinates, far below the skin. */
#define CROSSING_TOLERANCE 1e-9
/* Bodies that passed each other are apart when so many skins are between them. */
#define PASS_SKINS 2

static bool is_surface(const struct crowd *crowd, int body)
{
    return crowd->bodies[body].def.mesh->raw.kind == CAROM_SURFACE;
}

static const struct oracle_mesh *mesh_of(const struct crowd *crowd, int body)
{
    return &crowd->meshes[crowd->bodies[body].mesh].solid;
}

static struct oracle_pose pose_of(const struct crowd *crowd, int body)
{
    return lab_pose_of(crowd->world, body, crowd->bodies[body].def.mesh);
}

static bool boxes_meet(const struct crowd_seen *a, const struct crowd_seen *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) {
            return false;
        }
    }
    return true;
}

static bool box_within(const struct crowd_seen *a, const struct crowd_seen *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] < b->low[k] || a->high[k] > b->high[k]) {
            return false;
        }
    }
    return true;
}

/* --------------------------------------------------------------------- inside */

/* A corner of a body, in the axes of another one's mesh. */
static void corner_seen_from(double out[3], const struct oracle_mesh *a,
                             const struct oracle_pose *pose_a, const struct oracle_pose *pose_b)
{
    double at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = real_dot(pose_a->rotation.row[k], a->vertices[0]) + pose_a->position[k] -
                pose_b->position[k];
    }
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int i = 0; i < 3; i++) {
            out[k] += pose_b->rotation.row[i][k] * at[i];
        }
    }
}

static void corner_seen_now(double out[3], const struct crowd *crowd, int a, int b)
{
    struct oracle_pose pose_a = pose_of(crowd, a), pose_b = pose_of(crowd, b);

    corner_seen_from(out, mesh_of(crowd, a), &pose_a, &pose_b);
}

static void note_inside(struct crowd_tally *tally, int a, int b)
{
    if (tally->inside == 0) {
        tally->inside_first = tally->frames;
        tally->inside_pair[0] = a;
        tally->inside_pair[1] = b;
    }
    tally->inside++;
}

void crowd_let_pass(struct crowd *crowd, int a, int b, enum crowd_pass pass)
{
    crowd->pass[a][b] = crowd->pass[b][a] = (uint8_t)pass;
}

/* A bound on the way of a corner in the last frame, unless it was faster in between. */
static double way_of(const struct crowd *crowd, int body)
{
    const struct crowd_body *b = &crowd->bodies[body];

    return real_length(b->before.body.velocity) + real_length(b->now.body.velocity) +
           2 * crowd->meshes[b->mesh].radius;
}

/*
 * Which side of a surface a body's first corner is on: over it or under it, as seen along its z, or
 * within a distance of the space beside its box.
 */
static enum crowd_where where_is(const struct crowd *crowd, int a, int b, double distance)
{
    const int16_t(*box)[3] = crowd->bodies[b].def.mesh->box;
    const int bits = crowd->bodies[b].def.mesh->raw.quantum_bits;
    double at[3];

    corner_seen_now(at, crowd, a, b);
    for (int k = 0; k < 2; k++) {
        if (at[k] < real(box[0][k], bits) + distance || at[k] > real(box[1][k], bits) - distance) {
            return CROWD_BESIDE;
        }
    }
    at[2] += CROSSING_TOLERANCE;
    return at[2] < real(box[1][2], bits) && oracle_under(mesh_of(crowd, b), at) ? CROWD_UNDER
                                                                                : CROWD_OVER;
}

/*
 * A body gets from one side of a surface to the other only beside it. Bodies begin over it. Once a
 * body was beside it, or if it swings by a joint, it may have gone there and back within a frame.
 */
static void watch_surfaces(struct crowd *crowd, struct crowd_tally *tally)
{
    for (int b = 0; b < crowd->body_count; b++) {
        for (int a = 0; a < crowd->body_count && is_surface(crowd, b); a++) {
            enum crowd_where was = (enum crowd_where)crowd->where[a], now;
            const bool turns_back = crowd->beside[a] || crowd->bodies[a].linked;

            if (is_still(&crowd->bodies[a]) || crowd->bodies[a].now.state.out ||
                crowd->pass[a][b] != CROWD_MEET) {
                continue;
            }
            now = where_is(crowd, a, b, turns_back ? way_of(crowd, a) : 0);
            crowd->beside[a] |= now == CROWD_BESIDE;
            if (was != CROWD_BESIDE && now != CROWD_BESIDE && now != was) {
                note_inside(tally, a, b);
            }
            crowd->where[a] = (uint8_t)now;
        }
    }
}

/* Whether the first corner of one body is inside another body, or below it. */
static bool corner_inside(const struct crowd *crowd, int a, int b, const struct oracle_pose *pose_a,
                          const struct oracle_pose *pose_b)
{
    double at[3];

    if (is_surface(crowd, a)) {
        return false;
    }
    corner_seen_from(at, mesh_of(crowd, a), pose_a, pose_b);
    return is_surface(crowd, b) ? oracle_under(mesh_of(crowd, b), at)
                                : oracle_inside(mesh_of(crowd, b), at);
}

int crowd_overlap(const struct crowd *crowd, int a, int b, const struct oracle_pose *pose_a,
                  const struct oracle_pose *pose_b, double near)
{
    const struct oracle_mesh *of_a = mesh_of(crowd, a), *of_b = mesh_of(crowd, b);
    struct oracle_crossings found =
        oracle_crossings(of_a, pose_a, of_b, pose_b, CROSSING_TOLERANCE);

    if (found.pairs > 0 && found.depth > near) {
        return 1;
    }
    if (found.pairs > 0 || oracle_near(of_a, pose_a, of_b, pose_b, near)) {
        return -1;
    }
    return corner_inside(crowd, a, b, pose_a, pose_b) || corner_inside(crowd, b, a, pose_b, pose_a);
}

int crowd_overlap_now(const struct crowd *crowd, int a, int b, double near)
{
    struct oracle_pose pose_a = pose_of(crowd, a), pose_b = pose_of(crowd, b);

    return crowd_overlap(crowd, a, b, &pose_a, &pose_b, near);
}

/* The box of a body's mesh, turned with the body, along the world's axes: it may be larger than that of the body. */
static void turned_box(const struct crowd *crowd, int body, double low[3], double high[3])
{
    const struct oracle_mesh *mesh = mesh_of(crowd, body);
    const struct oracle_pose pose = pose_of(crowd, body);

    for (int k = 0; k < 3; k++) {
        low[k] = high[k] = pose.position[k];
    }
    for (int i = 0; i < 3; i++) {
        double least = mesh->vertices[0][i], most = least;

        for (size_t v = 1; v < mesh->vertex_count; v++) {
            least = fmin(least, mesh->vertices[v][i]);
            most = fmax(most, mesh->vertices[v][i]);
        }
        for (int k = 0; k < 3; k++) {
            double along = pose.rotation.row[k][i];

            low[k] += fmin(along * least, along * most);
            high[k] += fmax(along * least, along * most);
        }
    }
}

double crowd_box_gap(const struct crowd *crowd, int a, int b)
{
    double low[2][3], high[2][3], gap = -HUGE_VAL;

    turned_box(crowd, a, low[0], high[0]);
    turned_box(crowd, b, low[1], high[1]);
    for (int k = 0; k < 3; k++) {
        gap = fmax(gap, fmax(low[0][k] - high[1][k], low[1][k] - high[0][k]));
    }
    return gap;
}

/* Whether body a is inside b, when no face of a crosses one of b. */
static bool is_inside(const struct crowd *crowd, int a, int b)
{
    double at[3];

    if (is_surface(crowd, a) || is_surface(crowd, b) ||
        !box_within(&crowd->bodies[a].now, &crowd->bodies[b].now)) {
        return false;
    }
    corner_seen_now(at, crowd, a, b);
    return oracle_inside(mesh_of(crowd, b), at);
}

/* ------------------------------------------------------------------- crossings */

static bool changed(const struct crowd_body *body)
{
    return memcmp(&body->before.state.position, &body->now.state.position,
                  sizeof body->now.state.position) != 0 ||
           memcmp(&body->before.state.rotation, &body->now.state.rotation,
                  sizeof body->now.state.rotation) != 0;
}

/* The gap that a resting contact of two bodies keeps. */
static double skin_of(const struct crowd *crowd, int a, int b)
{
    double skin = 0;

    for (int i = 0; i < 2; i++) {
        const struct crowd_body *body = &crowd->bodies[i == 0 ? a : b];

        skin = fmax(skin, is_still(body) ? 0 : crowd->meshes[body->mesh].skin);
    }
    return skin;
}

static void note_crossing(const struct crowd *crowd, struct crowd_tally *tally, int a, int b,
                          const struct oracle_crossings *found)
{
    const double depth = found->depth;

    if (tally->crossed_first == 0) {
        tally->crossed_first = tally->frames;
        tally->crossed_pair[0] = a;
        tally->crossed_pair[1] = b;
        tally->crossed_face[0] = found->face_a;
        tally->crossed_face[1] = found->face_b;
    }
    tally->crossed_depth = fmax(tally->crossed_depth, depth);
    tally->crossed_skins = fmax(tally->crossed_skins, depth / skin_of(crowd, a, b));
}

/*
 * Whether two bodies may cross. A pair that may pass until it is apart, and is apart, may not any
 * more.
 */
static bool passes(struct crowd *crowd, int a, int b)
{
    if (crowd->pass[a][b] == CROWD_PASS_ONCE &&
        crowd_overlap_now(crowd, a, b, PASS_SKINS * skin_of(crowd, a, b)) == 0) {
        crowd_let_pass(crowd, a, b, CROWD_MEET);
    }
    return crowd->pass[a][b] != CROWD_MEET;
}

void crowd_watch_crossings(struct crowd *crowd, struct crowd_tally *tally)
{
    const bool all = crowd->look_every > 1 || tally->frames <= 1;
    bool crossed = false;

    watch_surfaces(crowd, tally);
    if (crowd->look_every > 1 && tally->frames % crowd->look_every != 0) {
        return;
    }
    for (int i = 0; i < crowd->body_count; i++) {
        for (int j = 0; j < i; j++) {
            const struct crowd_body *a = &crowd->bodies[i], *b = &crowd->bodies[j];
            struct oracle_pose pose_a, pose_b;
            struct oracle_crossings found;

            /* a body out of range meets nothing */
            if (a->now.state.out || b->now.state.out || !(all || changed(a) || changed(b)) ||
                (is_still(a) && is_still(b)) || passes(crowd, i, j)) {
                continue;
            }
            found.pairs = 0;
            if (boxes_meet(&a->now, &b->now)) {
                pose_a = pose_of(crowd, i);
                pose_b = pose_of(crowd, j);
                found = oracle_crossings(mesh_of(crowd, i), &pose_a, mesh_of(crowd, j), &pose_b,
                                         CROSSING_TOLERANCE);
            }
            if (found.pairs != 0) {
                note_crossing(crowd, tally, i, j, &found);
                crossed = true;
            } else if (is_inside(crowd, i, j)) {
                note_inside(tally, i, j);
            } else if (is_inside(crowd, j, i)) {
                note_inside(tally, j, i);
            }
        }
    }
    tally->crossed += crossed;
}

/* SPDX-License-Identifier: MIT */
/* The first hit of two bodies, found by a step, by all pairs of features, and by poses that cross. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "first_hit_track.h"
#include "lab.h"
#include "real.h"

#define UNIT  (1.0 / 4194304) /* the last place of q22, to which positions are rounded */
#define LEVEL 12              /* units: bodies are followed to a surface that is so much closer */

/* --------------------------------------------------------------------- world */

/* bodies, pairs, contacts, faces, entries, candidates */
#define CAPS 2, 1, 1024, 65535, 65535, 65535
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];

static int expect(int result, const char *what)
{
    if (result < 0) {
        printf("Bail out! %s: %s\n", what, carom_result_text(result));
        exit(1);
    }
    return result;
}

static struct carom_world *make_world(const struct first_hit_motion *motion)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .gravity = motion->gravity};
    struct carom_world *world;

    expect(carom_world_init(block, sizeof block, &config, &world), "world");
    for (int i = 0; i < 2; i++) {
        struct carom_body_def def = motion->def[i];

        def.overlap =
            CAROM_OVERLAP_PASS; /* overlaps are random, at a place that only a search asks about */
        expect(carom_body_add(world, &def), "body");
    }
    return world;
}

/* ------------------------------------------------------------- every feature */

struct search {
    struct boyse_pair pair;
    struct boyse_hit best;
    int32_t parts; /* parts of the window */
    bool found;
};

/* The part of the window in which the surfaces meet. */
static int64_t part_of(const struct search *s, const struct boyse_hit *hit)
{
    int64_t part = (int64_t)hit->root_q30 * s->parts / CAROM_ONE_Q30;

    return part < s->parts ? part : s->parts - 1;
}

/*
 * Order of hits: the part in which the surfaces meet, time, kind, then the numbers of the features.
 */
static bool comes_first(const struct search *s, const struct boyse_hit *p,
                        const struct boyse_hit *q)
{
    if (part_of(s, p) != part_of(s, q)) {
        return part_of(s, p) < part_of(s, q);
    }
    if (p->t_q30 != q->t_q30) {
        return p->t_q30 < q->t_q30;
    }
    if (p->candidate.kind != q->candidate.kind) {
        return p->candidate.kind < q->candidate.kind;
    }
    if (p->candidate.i != q->candidate.i) {
        return p->candidate.i < q->candidate.i;
    }
    return p->candidate.j < q->candidate.j;
}

static void ask(struct search *s, uint8_t kind, uint32_t i, uint32_t j)
{
    struct boyse_hit hit;
    uint32_t roots = 0;

    hit.candidate = (struct candidate){0, kind, i, j};
    if (boyse_first(&s->pair, &hit.candidate, &hit, &roots) &&
        ((void)step_put_off(&s->pair, &hit), !s->found || comes_first(s, &hit, &s->best))) {
        s->best = hit;
        s->found = true;
    }
}

static void search_all(struct search *s, const struct first_hit_mesh *a,
                       const struct first_hit_mesh *b)
{
    for (uint32_t i = 0; i < a->vertex_count; i++) {
        for (uint32_t j = 0; j < b->mesh.raw.face_count; j++) {
            ask(s, CANDIDATE_VERTEX_FACE, a->vertices[i], j);
        }
    }
    for (uint32_t i = 0; i < b->vertex_count; i++) {
        for (uint32_t j = 0; j < a->mesh.raw.face_count; j++) {
            ask(s, CANDIDATE_FACE_VERTEX, b->vertices[i], j);
        }
    }
    for (uint32_t i = 0; i < a->edge_count; i++) {
        for (uint32_t j = 0; j < b->edge_count; j++) {
            ask(s, CANDIDATE_EDGE_EDGE, a->edges[i], b->edges[j]);
        }
    }
    if (s->found) {
        boyse_touch(&s->pair, &s->best.candidate, s->best.root_q30, &s->best.touch);
    }
}

static bool same_hit(const struct boyse_hit *p, const struct boyse_hit *q)
{
    const struct boyse_touch *s = &p->touch, *t = &q->touch;

    return p->t_q30 == q->t_q30 && p->root_q30 == q->root_q30 &&
           candidate_compare(&p->candidate, &q->candidate) == 0 && s->gap_q22 == t->gap_q22 &&
           s->valid == t->valid && s->sign == t->sign &&
           memcmp(&s->normal, &t->normal, sizeof s->normal) == 0;
}

/* The distance of the features where their lines cross, between a stop and a later root. */
static double distance_between(const struct first_hit_motion *motion,
                               const struct first_hit_track track[2], const struct boyse_hit *hit,
                               const double n[3])
{
    double from = lab_double(hit->t_q30, 30), to = lab_double(hit->root_q30, 30);
    struct first_hit_features at = {0};

    for (int i = 0; i < 40; i++) {
        double middle = (from + to) / 2;

        at = first_hit_features(motion, track, &hit->candidate, n, middle);
        *(at.gap > 0 ? &from : &to) = middle;
    }
    return at.distance;
}

/* The least distance of the features from the root on, in steps that skip no closer place. */
static double distance_after(const struct first_hit_motion *motion,
                             const struct first_hit_track track[2], const struct boyse_hit *hit,
                             const double n[3])
{
    double t = lab_double(hit->root_q30, 30), speed = first_hit_speed(track), least = HUGE_VAL;

    while (t <= 1 && least > 4 * UNIT) {
        double distance = first_hit_features(motion, track, &hit->candidate, n, t).distance;

        least = fmin(least, distance);
        t += fmax(distance, 2 * UNIT) / speed;
    }
    return least;
}

/* Whether the features were farther apart than the event gap since their lines last crossed. */
static bool were_open(const struct first_hit_motion *motion, const struct first_hit_track track[2],
                      const struct boyse_hit *hit, const double n[3], double wanted)
{
    bool open = false;

    for (int i = 0; i < 64; i++) {
        double t = lab_double(hit->t_q30, 30) * i / 64;
        double gap = first_hit_features(motion, track, &hit->candidate, n, t).gap;

        open = gap > 0 && (open || gap > wanted);
    }
    return open;
}

/*
 * Judge whether the bodies stop at the event gap, or at less if they were never farther apart, and
 * whether the features then meet.
 *
 * The kernel stops within a few units of the last place of the gap. It follows a polynomial of 29
 * bits, the gap times the sine, to a surface 12 units closer. For edges, 12 units over their sine
 * count, but no more than half of the event gap at the start, so some edges that pass each other
 * that close count as hits. Where edges are nearly parallel, the kernel stops within half of the
 * event gap. A vertex counts as above a face up to 4 units beyond each of its sides seen along an
 * axis, 12 units above it; beyond a sharp corner that is farther.
 */
static void judge_hit(const struct first_hit_motion *motion, const struct first_hit_track track[2],
                      const struct boyse_hit *hit, struct first_hit_verdict *verdict)
{
    double speed = first_hit_speed(track), slack = 8 * UNIT + speed * ldexp(1, -29), n[3];
    double size = speed + track[0].radius + track[1].radius, allowed;
    struct first_hit_features stop, root;

    for (int k = 0; k < 3; k++) {
        n[k] = lab_double(hit->touch.normal.c[k], 30);
    }
    stop = first_hit_features(motion, track, &hit->candidate, n, lab_double(hit->t_q30, 30));
    root = first_hit_features(motion, track, &hit->candidate, n, lab_double(hit->root_q30, 30));
    verdict->gap = stop.gap;
    verdict->meet = root.gap < 0 ? distance_between(motion, track, hit, n)
                                 : distance_after(motion, track, hit, n);
    verdict->aside = stop.distance > 1.05 * verdict->event_gap + slack;
    allowed = (LEVEL + 5) * UNIT + size * ldexp(1, -25) / root.sine;
    if (hit->candidate.kind == CANDIDATE_EDGE_EDGE) {
        allowed += fmin(LEVEL * UNIT / root.sine, verdict->event_gap);
        slack += fmin(root.sine, stop.sine) < 1. / 64 ? verdict->event_gap / 2 : 0;
    } else {
        allowed += (LEVEL + 6) * UNIT / root.sharp;
    }
    verdict->early = stop.gap > verdict->event_gap + slack || verdict->meet > allowed;
    verdict->late = stop.gap < verdict->event_gap - slack &&
                    were_open(motion, track, hit, n, verdict->event_gap + slack);
}

/* -------------------------------------------------------------------- judge */

/* The end of the time that both paths take from the start of the frame. */
static int32_t window_end(const struct step *s)
{
    int32_t from_q30, to_q30;

    (void)step_window(s, 0, &from_q30, &to_q30);
    return to_q30;
}

/*
 * Move the bodies to the hit, on paths set up again for the time up to the hit. A turn over a part
 * of a slice is not a part of the turn over the whole. While a body turns by an angle a, its spin
 * changes by at most a times itself (Euler's equations; no moment of inertia exceeds the sum of the
 * others). So the turn over a part t differs from t a by at most t (1 - t) a^2 / 2 <= a^2 / 8, and
 * the step may stop that far from the surface.
 */
static void go_to_hit(struct step *s, const struct first_hit_motion *motion,
                      const struct boyse_hit *hit, struct first_hit_verdict *verdict)
{
    enum step_event event;
    uint32_t number;
    struct first_hit_track track[2];
    double allowed = 8 * UNIT + 1.01 * verdict->event_gap, n[3];
    bool cut = true;

    first_hit_read_tracks(track, s);
    for (int i = 0; i < 2; i++) {
        double angle = 2 * real_length(track[i].u);

        allowed += angle * angle / 8 * track[i].radius;
    }
    allowed += first_hit_speed(track) * ldexp(1, -29);
    step_close_window(s, 0, 0, window_end(s));
    for (uint32_t i = 0; i < 2; i++) {
        s->w->bodies[i].clock.member = true;
    }
    expect(step_search_members(s), "search");
    for (event = STEP_HIT; cut;) {
        cut = false;
        event = step_next(s, &number);
        if (event == STEP_HIT) {
            s->now_q30 = 0;
            expect(step_cut(s, number, &cut), "cut");
        }
    }
    verdict->late |= event == STEP_END;
    for (uint32_t i = 0; i < 2; i++) {
        if (step_active(s, i)) {
            step_leave_path(s, i, event == STEP_HIT ? s->w->meetings[0].hit_q30 : window_end(s));
            body_place(&s->w->bodies[i], &s->next->bodies[i]);
        }
    }
    first_hit_read_tracks(track, s);
    verdict->crossed = first_hit_cross(motion, track, 0);
    for (int k = 0; k < 3; k++) {
        n[k] = lab_double(hit->touch.normal.c[k], 30);
    }
    verdict->left = first_hit_features(motion, track, &hit->candidate, n, 0).gap;
    verdict->early |= event == STEP_HIT && verdict->left > allowed;
}

void first_hit_judge(const struct first_hit_motion *motion, struct first_hit_verdict *verdict)
{
    struct carom_world *w = make_world(motion);
    struct search search = {.parts = 1, .found = false};
    struct first_hit_track track[2];
    struct step s;
    struct step_visitor v;

    memset(verdict, 0, sizeof *verdict);
    step_begin(&s, w);
    expect(step_begin_regions(&s), "regions");
    if (motion->in_contact) {
        expect(step_start_contacts(&s), "contacts");
    }
    for (uint32_t i = 0; i < 2; i++) {
        if (step_active(&s, i)) {
            expect(step_set_path(&s, i), "path");
        }
    }
    v.found = false;
    if (w->pools[CAROM_POOL_pairs].used > 0) {
        step_open_window(&s, 0, 0, window_end(&s));
        v.from_q30 = 0;
        v.to_q30 = window_end(&s);
        v.parts = search.parts = step_parts(&s, 0);
        expect(step_first_hit(&s, 0, &v), "first hit");
        if (v.found) {
            struct boyse_pair *pair = step_set_pair(w, 0);

            boyse_pair_for(pair, &v.hit.candidate);
            boyse_touch(pair, &v.hit.candidate, v.hit.root_q30, &v.hit.touch);
        }
    }
    verdict->hit = v.found;
    boyse_pair_init(&search.pair, &w->bodies[1], &w->bodies[0]);
    search_all(&search, motion->mesh[1], motion->mesh[0]);
    verdict->different =
        verdict->hit != search.found || (search.found && !same_hit(&v.hit, &search.best));
    verdict->event_gap = lab_double(search.pair.skin_q22 / 2, 22);
    first_hit_read_tracks(track, &s);
    verdict->crossing =
        first_hit_crossing(motion, track, verdict->hit ? lab_double(v.hit.t_q30, 30) : 1);
    verdict->missed = verdict->crossing <= 1;
    if (verdict->hit) {
        verdict->t_q30 = v.hit.t_q30;
        verdict->candidate = v.hit.candidate;
        judge_hit(motion, track, &v.hit, verdict);
        go_to_hit(&s, motion, &v.hit, verdict);
    }
}

/* The winding number of a mesh around a point: the solid angle of its faces, over 4 pi. */
static double winding(const struct first_hit_mesh *mesh, const struct oracle_pose *pose,
                      const double p[3])
{
    double angle = 0;

    for (size_t f = 0; f < mesh->doubles.face_count; f++) {
        double d[3][3], size[3], x[3];

        for (int k = 0; k < 3; k++) {
            first_hit_point(d[k], mesh, pose, mesh->doubles.faces[f][k]);
            for (int i = 0; i < 3; i++) {
                d[k][i] -= p[i];
            }
            size[k] = real_length(d[k]);
        }
        real_cross(x, d[1], d[2]);
        angle += 2 * atan2(real_dot(d[0], x),
                           size[0] * size[1] * size[2] + real_dot(d[0], d[1]) * size[2] +
                               real_dot(d[1], d[2]) * size[0] + real_dot(d[2], d[0]) * size[1]);
    }
    return angle / (4 * acos(-1));
}

bool first_hit_overlap(const struct first_hit_motion *motion)
{
    struct carom_world *w = make_world(motion);
    struct oracle_pose pose[2];
    struct first_hit_track track[2];
    struct step s;

    step_begin(&s, w);
    for (int i = 0; i < 2; i++) {
        body_place(&w->bodies[i], &s.next->bodies[i]);
    }
    first_hit_read_tracks(track, &s);
    if (first_hit_cross(motion, track, 0)) {
        return true;
    }
    for (int i = 0; i < 2; i++) {
        pose[i] = first_hit_pose(&track[i], motion->mesh[i]->centre, 0);
    }
    for (int i = 0; i < 2; i++) {
        double p[3];

        first_hit_point(p, motion->mesh[i], &pose[i], 0);
        if (motion->mesh[1 - i]->mesh.raw.kind == CAROM_SOLID &&
            winding(motion->mesh[1 - i], &pose[1 - i], p) > 0.5) {
            return true;
        }
    }
    return false;
}

/* False when a thin body spins faster than a caller may set. */
static bool can_begin(const struct carom_body_state *state)
{
    double spin[3], velocity[3];

    for (int k = 0; k < 3; k++) {
        spin[k] = lab_double(state->spin.c[k], 40);
        velocity[k] = lab_double(state->velocity.c[k], 40);
    }
    return !state->out && real_length(spin) < 10 && real_length(velocity) < 10;
}

void first_hit_later(struct first_hit_motion *motion, int frames)
{
    struct carom_world *w = make_world(motion);
    struct carom_body_state state[2] = {{.out = false}};

    for (int frame = 0; frame < frames; frame++) {
        expect(carom_world_step(w), "step");
        for (int i = 0; i < 2; i++) {
            expect(carom_body_get(w, i, &state[i]), "state");
        }
        if (!can_begin(&state[0]) || !can_begin(&state[1])) {
            return;
        }
        for (int i = 0; i < 2; i++) {
            motion->def[i].position = state[i].position;
            motion->def[i].rotation = state[i].rotation;
            motion->def[i].velocity = state[i].velocity;
            motion->def[i].spin = state[i].spin;
        }
    }
}

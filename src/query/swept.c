/* SPDX-License-Identifier: MIT */
/*
 * The first hit of a mesh on a way, by the candidates and the collision test of a step, in parts of
 * the way of half a radius each. The bodies of the world are copied as far as the test needs them,
 * and candidates go to the caller's workspace: so nothing that a step keeps is touched, except the
 * made z-lists of a moving surface, and a call takes less stack than a step.
 */
#include "query.h"
#include "ahead.h"
#include "../contact/contact.h"

#define CANDIDATES 32
/* Lists for each part; length of a list's first window. */
#define LISTS  16
#define WINDOW 512
/* A way is at most this many radii long; parts of it are half a radius. */
#define WAY_RADII    512
#define TURN_MAX_Q30 (CAROM_ONE_Q30 / 4)

/* A call: all of it is in the caller's workspace. */
struct swept {
    struct candidate_visitor base;
    struct carom_world *w;
    const struct carom_mesh_way *way;
    struct body bodies[2]; /* the mesh on a part of its way; the body at hand */
    uint16_t number;       /* of the body at hand in the world */
    struct body_state state;
    bool straight;            /* the mesh does not turn */
    int32_t length_q30;       /* part of the way that each part takes */
    int32_t from_q30, to_q30; /* the part at hand */
    bool set;                 /* the scratch's pair holds both bodies on that part */

    /* the first hit, and where the part of the way begins that holds it */
    bool found;
    uint16_t body;
    struct boyse_hit hit;
    int32_t hit_from_q30;

    /* a part is asked by the faces ahead, or gathered */
    union {
        struct ahead ahead;
        struct {
            struct interfere work;
            struct candidate candidates[CANDIDATES];
        };
    };
};

_Static_assert(sizeof(struct swept) <= sizeof(struct carom_cast_workspace), "CAROM_CAST_BYTES");
_Static_assert(_Alignof(struct swept) <= _Alignof(struct carom_cast_workspace),
               "carom_cast_workspace");

/* ---------------------------------------------------------------------- ways */

/* Set the mesh's path over a part of its way. */
static void set_path(struct swept *s, int32_t from_q30, int32_t to_q30)
{
    struct body *a = &s->bodies[0];
    struct body_path *path = &a->path;

    body_place(a, &s->state);
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = carom_shl(s->way->way.c[k], 8);
        path->u.c[k] = s->way->turn.c[k];
    }
    path->turns = (path->u.c[0] | path->u.c[1] | path->u.c[2]) != 0;
    path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
    if (from_q30 > 0 || to_q30 < CAROM_ONE_Q30) {
        body_cut_path(a, &s->state, from_q30, to_q30);
    }
}

/* Check the way's range, and set the length of parts: at most half a radius. Any numbers may come in. */
static int check_way(struct swept *s)
{
    const int32_t *u = s->way->turn.c;
    const int64_t turn[3] = {u[0], u[1], u[2]};
    const int64_t radius_q32 = (int64_t)s->bodies[0].def.radius_q22 << 10;
    int64_t length_q32;

    if (!world_each_within(s->way->way.c, (int64_t)BODY_WORLD_LIMIT << 32) ||
        !world_each_within(turn, TURN_MAX_Q30) ||
        carom_dot(u, u) > (int64_t)TURN_MAX_Q30 * TURN_MAX_Q30) {
        return CAROM_ERR_RANGE;
    }
    length_q32 = fix_length(s->way->way.c);
    if (length_q32 > WAY_RADII * radius_q32) {
        return CAROM_ERR_RANGE;
    }
    s->straight = (s->way->turn.c[0] | s->way->turn.c[1] | s->way->turn.c[2]) == 0;
    s->length_q30 = CAROM_ONE_Q30 / (int32_t)(2 * length_q32 / radius_q32 + 1);
    return CAROM_OK;
}

/* True if both spheres, and some skins, stay apart between two places of the way. */
static bool stays_apart(const struct swept *s, const struct body *b, const struct body_state *at,
                        int32_t from_q30, int32_t to_q30)
{
    const struct body *a = &s->bodies[0];
    int64_t reach_q32 = ((int64_t)a->def.radius_q22 + b->def.radius_q22) << 10;

    reach_q32 += (int64_t)(a->def.skin_q22 + b->def.skin_q22) << 13;
    for (int k = 0; k < 3; k++) {
        int64_t way = s->way->way.c[k], d = s->state.position.c[k] - at->position.c[k];
        int64_t start = d + fix_mul_q30(way, from_q30), end = d + fix_mul_q30(way, to_q30);

        if ((start > reach_q32 && end > reach_q32) || (start < -reach_q32 && end < -reach_q32)) {
            return true;
        }
    }
    return false;
}

/* ---------------------------------------------------------------------- hits */

static bool is_before(const struct swept *s, const struct boyse_hit *hit)
{
    if (s->from_q30 != s->hit_from_q30) {
        return s->from_q30 < s->hit_from_q30;
    }
    if (hit->t_q30 != s->hit.t_q30 || s->number != s->body) {
        return hit->t_q30 < s->hit.t_q30; /* of equal hits the lower body's, which came first */
    }
    return candidate_compare(&hit->candidate, &s->hit.candidate) < 0;
}

static void visit_swept(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct swept *s = (struct swept *)self;
    struct boyse_pair *pair = world_pair(s->w);
    uint32_t roots = 0;

    if (n > 0 && !s->set) {
        set_path(s, s->from_q30, s->to_q30);
        boyse_pair_begin(pair, &s->bodies[0], &s->bodies[1]);
        s->set = true;
    }
    for (uint32_t i = 0; i < n; i++) {
        struct boyse_hit hit;

        boyse_pair_for(pair, &c[i]);
        if (boyse_first(pair, &c[i], &hit, &roots)) {
            hit.candidate = c[i];
            if (!s->found || is_before(s, &hit)) {
                s->found = true;
                s->body = s->number;
                s->hit = hit;
                s->hit_from_q30 = s->from_q30;
            }
        }
    }
}

/* Copy what the collision test needs of a body of the world. */
static void copy_body(struct swept *s, uint32_t i)
{
    const struct body *from = &s->w->bodies[i];
    struct body *b = &s->bodies[1];

    memset(b, 0, sizeof *b);
    b->def.mesh = from->def.mesh;
    b->def.moving = from->def.moving;
    b->def.radius_q22 = from->def.radius_q22;
    b->def.skin_q22 = from->def.skin_q22;
    s->number = (uint16_t)i;
    body_place(b, &world_now(s->w)->bodies[i]);
}

/* --------------------------------------------------------------------- parts */

static void begin_part(struct swept *s, int32_t from_q30)
{
    s->from_q30 = from_q30;
    s->to_q30 = s->length_q30 < CAROM_ONE_Q30 - from_q30 ? from_q30 + s->length_q30 : CAROM_ONE_Q30;
    s->set = false;
}

/* True if that part lies beyond the hit that is known. */
static bool is_behind(const struct swept *s, int32_t from_q30)
{
    return s->found && from_q30 > s->hit_from_q30;
}

/* Test the part at hand against the body: gather all candidates near it. */
static int ask_part(struct swept *s)
{
    static const struct pair pair = {0, 1};
    const struct interfere_pairs all = {s->bodies, &pair, 1};
    const struct interfere_span span = {0, 0, CAROM_ONE_Q30, UINT32_MAX, false};
    struct pool pool = {CANDIDATES, 0, 0, 0};
    struct pair_work meeting = {0};
    struct body_state start = s->state;
    int result;

    set_path(s, s->from_q30, s->to_q30);
    for (int k = 0; k < 3; k++) {
        start.position.c[k] = carom_shl(body_path(&s->bodies[0])->origin_q22[k], 10);
    }
    start.rotation = body_path(&s->bodies[0])->q;
    body_region_begin(&s->bodies[0], &start, CAROM_ONE_Q30, CAROM_ONE_Q30, 0);
    body_region_begin(&s->bodies[1], &world_now(s->w)->bodies[s->number], CAROM_ONE_Q30,
                      CAROM_ONE_Q30, 0);
    s->work = s->w->interfere;
    s->work.candidates = s->candidates;
    s->work.candidate_pool = &pool;
    s->work.meetings = &meeting;
    result = interfere_visit_pair(&s->work, &all, 0, &span, false, &s->base);
    interfere_take_lists(&s->w->interfere, &s->work);
    return result;
}

/*
 * End of what still matters of the part: if the known hit is in this part, the hit plus a little,
 * for equally early ones; that may end a little beyond the part, which does no harm.
 */
static int32_t end_of_part(const struct swept *s)
{
    int64_t part_q30 = s->to_q30 - s->from_q30;

    return s->found && s->hit_from_q30 == s->from_q30
               ? s->from_q30 + (int32_t)(part_q30 * s->hit.t_q30 >> 30) + 2
               : s->to_q30;
}

/* Test the windows of a stretch, up to its first hit. */
static void ask_windows(struct swept *s, int32_t from_q30, int32_t to_q30)
{
    struct ahead *h = &s->ahead;
    int32_t window = WINDOW;

    for (int32_t at = 0, to; (at = ahead_first(h, at)) < h->end; at = to) {
        int32_t place_q30 = (int32_t)((int64_t)(to_q30 - from_q30) * at >> TIMES_BITS);

        if (from_q30 + place_q30 > end_of_part(s)) {
            return;
        }
        to = at + window < h->end ? at + window : h->end;
        window *= 2;
        ahead_visit(h, at, to, &s->base);
    }
}

/*
 * Test the part at hand against the body by the faces ahead, list by list. Returns false if those are too many.
 */
static bool ask_ahead(struct swept *s)
{
    struct ahead *h = &s->ahead;
    int32_t from = s->from_q30;

    for (int lists = 0; lists < LISTS; lists++) {
        int32_t to = end_of_part(s);

        if (from >= to || !ahead_stretch(h, from, to)) {
            return true;
        }
        if (!ahead_list(h)) {
            return false;
        }
        ask_windows(s, from, to);
        if (h->end == AHEAD_WHOLE) {
            return true;
        }
        from += (int32_t)((int64_t)(to - from) * h->end >> TIMES_BITS);
    }
    return false;
}

/*
 * Test parts of a straight way by the faces ahead, up to one that must be gathered. Returns its
 * start, or the end of what matters of the way.
 */
static int32_t ask_straight(struct swept *s, int32_t from_q30)
{
    body_place(&s->bodies[0], &s->state);
    if (!ahead_begin(&s->ahead, &s->w->interfere, &s->bodies[0], &s->bodies[1], &s->way->way,
                     s->length_q30)) {
        return from_q30;
    }
    for (; from_q30 < CAROM_ONE_Q30 && !is_behind(s, from_q30); from_q30 = s->to_q30) {
        begin_part(s, from_q30);
        if (!ask_ahead(s)) {
            break;
        }
    }
    return from_q30;
}

/* Test the mesh on its way against one body. */
static int ask_body(struct swept *s, uint32_t i)
{
    const struct body_state *at = &world_now(s->w)->bodies[i];
    int32_t from_q30 = 0;
    int result = CAROM_OK;

    copy_body(s, i);
    while (result == CAROM_OK) {
        from_q30 = s->straight ? ask_straight(s, from_q30) : from_q30;
        if (from_q30 >= CAROM_ONE_Q30 || is_behind(s, from_q30)) {
            return CAROM_OK;
        }
        begin_part(s, from_q30);
        if (!stays_apart(s, &s->bodies[1], at, from_q30, s->to_q30)) {
            result = ask_part(s);
        }
        from_q30 = s->to_q30;
    }
    return result;
}

/* -------------------------------------------------------------------- results */

/* The face at a feature that looks most along a world direction. */
static uint16_t face_of(const struct body *b, bool vertex, uint32_t feature,
                        const carom_v3_q30 *along)
{
    const struct carom_mesh *mesh = b->def.mesh;
    uint32_t first = vertex ? mesh->ring_start[feature] : 0;
    uint32_t end = vertex ? mesh->ring_start[feature + 1] : 1;
    int64_t most = INT64_MIN;
    uint16_t best = 0;
    int32_t n[3];

    carom_rotate_back(n, &b->path.start.r, along->c);
    for (uint32_t r = first; r < end; r++) {
        const struct carom_edge *edge = &mesh->edges[vertex ? mesh->ring[r] >> 1 : feature];

        for (int side = 0; side < 2; side++) {
            if (edge->face[side] != CAROM_NO_FACE &&
                carom_dot(n, mesh->faces[edge->face[side]].normal.c) > most) {
                most = carom_dot(n, mesh->faces[edge->face[side]].normal.c);
                best = edge->face[side];
            }
        }
    }
    return best;
}

static void set_faces(const struct swept *s, struct carom_mesh_hit *out)
{
    const struct candidate *c = &s->hit.candidate;
    const struct body *a = &s->bodies[0], *b = &s->bodies[1];
    carom_v3_q30 against;

    for (int k = 0; k < 3; k++) {
        against.c[k] = -out->normal.c[k];
    }
    if (c->kind == CANDIDATE_VERTEX_FACE) {
        out->own_face = face_of(a, true, c->i, &against);
        out->face = (uint16_t)c->j;
    } else if (c->kind == CANDIDATE_FACE_VERTEX) {
        out->own_face = (uint16_t)c->j;
        out->face = face_of(b, true, c->i, &out->normal);
    } else {
        out->own_face = face_of(a, false, c->i, &against);
        out->face = face_of(b, false, c->j, &out->normal);
    }
}

/*
 * Fill in the hit. The pair is set up twice: on the path for the normal, then at the hit's pose for
 * the point.
 */
FIX_OWN_FRAME static void complete(struct swept *s, struct carom_mesh_hit *out)
{
    struct boyse_pair *pair = world_pair(s->w);
    struct boyse_touch touch;
    carom_v3_q40 arm[2];
    carom_v3_q32 way;

    if (s->number != s->body) {
        copy_body(s, s->body);
    }
    begin_part(s, s->hit_from_q30);
    set_path(s, s->from_q30, s->to_q30);
    boyse_pair_begin(pair, &s->bodies[0], &s->bodies[1]);
    boyse_pair_for(pair, &s->hit.candidate);
    boyse_touch(pair, &s->hit.candidate, s->hit.root_q30, &touch);
    out->normal = touch.normal;
    out->body = s->body;
    out->t_q30 = s->from_q30 + (int32_t)((int64_t)(s->to_q30 - s->from_q30) * s->hit.t_q30 >> 30);
    set_path(s, 0, CAROM_ONE_Q30);
    way = body_way_at(&s->bodies[0], out->t_q30);
    out->rotation = body_rotation_at(&s->bodies[0], out->t_q30);
    for (int k = 0; k < 3; k++) {
        out->position.c[k] = s->state.position.c[k] + way.c[k];
    }
    s->state.position = out->position;
    s->state.rotation = out->rotation;
    body_place(&s->bodies[0], &s->state);
    boyse_pair_begin(pair, &s->bodies[0], &s->bodies[1]);
    boyse_pair_for(pair, &s->hit.candidate);
    contact_place(pair, &s->hit.candidate, &out->normal, arm);
    for (int k = 0; k < 3; k++) {
        out->point.c[k] = out->position.c[k] + (arm[0].c[k] >> 8);
    }
    set_faces(s, out);
}

static bool begins_in_overlap(struct swept *s, const struct carom_query_filter *filter)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (query_wants(s->w, filter, i) && query_overlaps(s->w, &s->bodies[0], &s->state, i)) {
            return true;
        }
    }
    return false;
}

/* Test all bodies that the mesh comes near. */
static int ask_bodies(struct swept *s, const struct carom_query_filter *filter)
{
    const struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
        if (w->bodies[i].def.mesh &&
            !stays_apart(s, &w->bodies[i], &world_now(w)->bodies[i], 0, CAROM_ONE_Q30) &&
            query_wants(w, filter, i)) {
            result = ask_body(s, i);
        }
    }
    return result;
}

int carom_cast_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                    const struct carom_mesh_way *way, const struct carom_query_filter *filter,
                    struct carom_cast_workspace *workspace, struct carom_mesh_hit *hit)
{
    struct swept *s = (struct swept *)workspace;
    int result;

    if (!world || !mesh || !mesh->mesh || !way || !workspace || !hit) {
        return CAROM_ERR_NULL;
    }
    s->base.visit = visit_swept;
    s->w = world;
    s->way = way;
    s->found = false;
    result = query_put(mesh, &s->bodies[0], &s->state);
    result = result < 0 ? result : check_way(s);
    if (result < 0) {
        return result;
    }
    if (begins_in_overlap(s, filter)) {
        return CAROM_ERR_OVERLAP;
    }
    world_begin_gather(world);
    result = ask_bodies(s, filter);
    if (result == CAROM_OK && s->found) {
        complete(s, hit);
        result = 1;
    }
    return result;
}

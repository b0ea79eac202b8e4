/* SPDX-License-Identifier: MIT */
/*
 * Surfaces that the caller moves. A surface jumps between steps; bodies that it went into are
 * lifted out of it along its z, with everything that touches them. The collision test says how far:
 * from a place surely above the surface bodies go down until they are at the event gap, or back
 * where they were.
 */
#include "world.h"
#include "../boyse/boyse.h"
#include "../interfere/narrow.h"

struct lift {
    struct candidate_visitor base;
    struct carom_world *w;
    struct body_state *states; /* where bodies will be, as far as known */
    uint32_t surface;
    int64_t up_q30[3];   /* the surface's z, world axes */
    int64_t rise_q32;    /* bound on how much higher the surface is */
    int32_t pair_number; /* pair that the scratch's boyse_pair is set up for; -1: none */
    /* the first hit */
    bool found;
    int32_t t_q30;
    struct candidate hit;
};

/* Set a body's path from its state, by a way along the surface's z; and its region. */
static void set_path(const struct lift *l, struct body *b, const struct body_state *s,
                     int64_t way_q32)
{
    body_place(b, s);
    for (int k = 0; k < 3; k++) {
        b->path.v.c[k] = fix_mul(way_q32, (int32_t)l->up_q30[k], 22);
    }
    body_region_begin(b, s, CAROM_ONE_Q30, CAROM_ONE_Q30, 0);
}

static void shift(const struct lift *l, struct body_state *s, int64_t way_q32)
{
    for (int k = 0; k < 3; k++) {
        s->position.c[k] += fix_mul_q30(way_q32, (int32_t)l->up_q30[k]);
    }
}

/* True if two bodies may touch and do not pass each other at present. */
static bool solid(const struct lift *l, uint32_t i, uint32_t k)
{
    const struct pair p = world_name_pair(l->w, i, k);

    return broad_may_touch(&l->w->bodies[i], &l->w->bodies[k]) &&
           !world_goes_through(l->w, world_now(l->w), &p);
}

static bool movable(const struct lift *l, uint32_t i)
{
    return l->w->bodies[i].def.mesh && l->w->bodies[i].def.moving && !l->states[i].out;
}

/* Find the islands of bodies that touched in the last step, with no lift yet. */
static void find_islands(struct carom_world *w)
{
    const struct world_state *now = world_now(w);

    island_find(w->bodies, w->body_count, now->touching, now->touching_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        PHASE_BEGIN(w->bodies[i].solve.work_phase, BODY_LIFT);
        w->bodies[i].solve.lift_q32 = 0;
    }
}

static int add_pair(struct carom_world *w, uint32_t a, uint32_t b)
{
    int32_t place = pool_take(&w->pools[CAROM_POOL_pairs]);

    if (place < 0) {
        return CAROM_ERR_PAIRS_FULL;
    }
    w->pairs[place] = (struct pair){(uint16_t)a, (uint16_t)b};
    return CAROM_OK;
}

static int visit(struct lift *l,
                 void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t))
{
    struct carom_world *w = l->w;

    l->base.visit = f;
    l->pair_number = -1;
    l->found = false;
    world_begin_gather(w);
    return interfere_visit(&w->interfere, w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used,
                           &l->base);
}

static bool hits(struct lift *l, const struct candidate *c, struct boyse_hit *hit)
{
    const struct pair *p = &l->w->pairs[c->pair];
    struct boyse_pair *pair = world_pair(l->w);
    uint32_t roots = 0;

    if (l->pair_number != c->pair) {
        boyse_pair_init(pair, &l->w->bodies[p->a], &l->w->bodies[p->b]);
        l->pair_number = c->pair;
    }
    return boyse_first(pair, c, hit, &roots);
}

/* ---------------------------------------------------- out of the surface, from above */

/* At this height above its place a body is surely above the surface. */
static int64_t clear_q32(const struct lift *l, const struct body *b)
{
    return l->rise_q32 + ((int64_t)b->def.skin_q22 << 10);
}

/* Raise each island's lift to where one of its bodies lands on the surface. */
static void visit_landing(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct lift *l = (struct lift *)self;
    struct boyse_hit hit;

    for (uint32_t i = 0; i < n; i++) {
        const struct body *a = &l->w->bodies[l->w->pairs[c[i].pair].a];
        struct body *island = &l->w->bodies[a->island.lowest];

        if (hits(l, &c[i], &hit)) {
            int64_t lift_q32 = fix_mul_q30(clear_q32(l, a), CAROM_ONE_Q30 - hit.t_q30);

            if (lift_q32 > *body_lift_q32(island)) {
                *body_lift_q32(island) = lift_q32;
            }
        }
    }
}

/* Pair a body with the surface for its way down from above it, if the surface can have gone into it. */
FIX_OWN_FRAME static int pair_raised(struct lift *l, uint32_t i)
{
    struct carom_world *w = l->w;
    struct body *b = &w->bodies[i];
    const int64_t height_q32 = clear_q32(l, b);
    struct body_state raised;

    if (!movable(l, i) || !solid(l, i, l->surface) ||
        !broad_near(&w->bodies[l->surface], &l->states[l->surface], b, &l->states[i],
                    (int32_t)(height_q32 >> 10))) {
        return CAROM_OK;
    }
    raised = l->states[i];
    shift(l, &raised, height_q32);
    set_path(l, b, &raised, -height_q32);
    return add_pair(w, i, l->surface);
}

/* Find how far each island must be lifted by the surface itself. */
static int find_lifts(struct lift *l)
{
    struct carom_world *w = l->w;
    int result = CAROM_OK;

    pool_clear(&w->pools[CAROM_POOL_pairs]);
    set_path(l, &w->bodies[l->surface], &l->states[l->surface], 0);
    for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
        result = pair_raised(l, i);
    }
    return result == CAROM_OK ? visit(l, visit_landing) : result;
}

/* ------------------------------------------------------------ past other bodies */

static void visit_first(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct lift *l = (struct lift *)self;
    struct boyse_hit hit;

    for (uint32_t i = 0; i < n; i++) {
        if (hits(l, &c[i], &hit) &&
            (!l->found || hit.t_q30 < l->t_q30 ||
             (hit.t_q30 == l->t_q30 && candidate_compare(&c[i], &l->hit) < 0))) {
            l->found = true;
            l->t_q30 = hit.t_q30;
            l->hit = c[i];
        }
    }
}

static int64_t lift_of(const struct carom_world *w, uint32_t i)
{
    return *body_lift_q32(&w->bodies[w->bodies[i].island.lowest]);
}

/* Pair bodies that are lifted by different ways and are near each other on the way. */
static int pair_lifted(struct lift *l)
{
    struct carom_world *w = l->w;
    int result = CAROM_OK;

    pool_clear(&w->pools[CAROM_POOL_pairs]);
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].def.mesh) {
            set_path(l, &w->bodies[i], &l->states[i], movable(l, i) ? lift_of(w, i) : 0);
        }
    }
    for (uint32_t a = 0; a < w->body_count; a++) {
        for (uint32_t b = 0; b < w->body_count && movable(l, a) && result == CAROM_OK; b++) {
            bool pair = w->bodies[b].def.mesh && b != l->surface && !l->states[b].out &&
                        (!w->bodies[b].def.moving || b < a) && solid(l, a, b);
            int64_t most = lift_of(w, a);

            most = pair && w->bodies[b].def.moving && lift_of(w, b) > most ? lift_of(w, b) : most;
            if (pair && most > 0 && (!w->bodies[b].def.moving || lift_of(w, b) != lift_of(w, a)) &&
                broad_near(&w->bodies[a], &l->states[a], &w->bodies[b], &l->states[b],
                           (int32_t)(most >> 10) + 1)) {
                result = add_pair(w, a, b);
            }
        }
    }
    return result;
}

/* Lift bodies that lifted ones would run into. */
static int spread(struct lift *l)
{
    struct carom_world *w = l->w;

    for (int round = 0; round < WORLD_LIFT_ROUNDS; round++) {
        int result = pair_lifted(l);
        const struct pair *p;
        int64_t most;

        if (result == CAROM_OK && w->pools[CAROM_POOL_pairs].used > 0) {
            result = visit(l, visit_first);
        } else {
            l->found = false;
        }
        if (result < 0 || !l->found) {
            return result;
        }
        p = &w->pairs[l->hit.pair];
        if (!w->bodies[p->b].def.moving) {
            return CAROM_ERR_BLOCKED;
        }
        most = lift_of(w, p->a) > lift_of(w, p->b) ? lift_of(w, p->a) : lift_of(w, p->b);
        *body_lift_q32(&w->bodies[w->bodies[p->a].island.lowest]) = most;
        *body_lift_q32(&w->bodies[w->bodies[p->b].island.lowest]) = most;
    }
    return CAROM_ERR_BLOCKED;
}

/* Lift bodies that the surface went into; their states go into the state that is not current. */
static int lift_all(struct carom_world *w, uint32_t surface, int64_t rise_q22)
{
    struct lift l = {
        .w = w, .states = world_next(w)->bodies, .surface = surface, .rise_q32 = rise_q22 << 10};
    carom_m3_q30 r;
    int result;

    if (rise_q22 > (int64_t)WORLD_WAY_MAX << 22) {
        return CAROM_ERR_RANGE;
    }

    memcpy(l.states, world_now(w)->bodies, w->body_count * sizeof *l.states);
    find_islands(w);
    fix_matrix(&r, &l.states[surface].rotation);
    for (int k = 0; k < 3; k++) {
        l.up_q30[k] = r.c[k][2];
    }
    result = rise_q22 > 0 ? find_lifts(&l) : CAROM_OK;
    if (result == CAROM_OK && rise_q22 > 0) {
        result = spread(&l);
    }
    for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
        if (movable(&l, i) && lift_of(w, i) > 0) {
            shift(&l, &l.states[i], lift_of(w, i));
        }
    }
    return result;
}

/* ----------------------------------------------------------------- the calls */

int carom_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                        size_t bytes)
{
    static const struct mesh_moving moving = {mesh_drift_vertex,    mesh_drift_edge,
                                              mesh_drift_face,      mesh_list_face,
                                              interfere_area_under, interfere_make_lists};

    return mesh_surface_build(mesh, raw, mem, bytes, &moving);
}

/* Wake bodies on or near a moved surface; they start counting quiet frames anew. */
static void stir(struct carom_world *w, uint32_t body)
{
    struct world_state *now = w->now;

    world_wake_around(w, body);
    for (uint32_t i = 0; i < now->touching_count; i++) {
        if (now->touching[i].b == body) {
            now->bodies[now->touching[i].a].quiet = 0;
        }
    }
}

static void forget_found(struct carom_world *w)
{
    w->regions_stale = true;
    for (uint32_t i = 0; i < w->body_count; i++) {
        body_not_standing(&w->bodies[i]); /* paths, regions and boxes have changed */
    }
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    interfere_forget_lists(&w->interfere);
}

static int move(struct carom_world *w, int body, const int16_t (*vertices)[3], bool drifts)
{
    struct carom_surface *s;
    int64_t rise_q22;
    int result;

    if (!w || !vertices) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    s = w->bodies[body].def.mesh->surface;
    if (!s) {
        return CAROM_ERR_ARGUMENT;
    }
    if (memcmp(s->now, vertices, s->mesh->raw.vertex_count * sizeof s->now[0]) == 0) {
        if (!drifts) {
            mesh_surface_halt(s);
        }
        return CAROM_OK; /* nothing moved: nothing wakes */
    }
    result = mesh_surface_try(s, vertices, drifts, &rise_q22);
    if (result == CAROM_OK) {
        forget_found(w);
        result = drifts ? lift_all(w, (uint32_t)body, rise_q22) : CAROM_OK;
        if (result < 0) {
            mesh_surface_undo(s);
        }
        forget_found(w);
    }
    if (result < 0) {
        return result;
    }
    mesh_surface_keep(s);
    w->bodies[body].def.radius_q22 = s->mesh->radius_q22;
    if (drifts) {
        memcpy(world_now(w)->bodies, world_next(w)->bodies,
               w->body_count * sizeof *world_now(w)->bodies);
    } else {
        mesh_surface_halt(s);
    }
    stir(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_surface_move(struct carom_world *w, int body, const int16_t (*vertices)[3])
{
    return move(w, body, vertices, true);
}

int carom_surface_set(struct carom_world *w, int body, const int16_t (*vertices)[3])
{
    return move(w, body, vertices, false);
}

void world_halt_surfaces(struct carom_world *w)
{
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].def.mesh && mesh_drift_most(w->bodies[i].def.mesh) > 0) {
            mesh_surface_halt(w->bodies[i].def.mesh->surface);
            body_not_standing(&w->bodies[i]); /* its region had room for the drift */
            w->regions_stale = true;
        }
    }
}

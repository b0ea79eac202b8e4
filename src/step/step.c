/* SPDX-License-Identifier: MIT */
/*
 * world_step - one frame, top to bottom: the paper's figures 4 and 5.
 *
 * A frame is a sequence of events: a pair hits, or the slice of a body ends. Each event changes its
 * own bodies at its own time; all others continue along their paths.
 *
 * The next state is built beside the current one and replaces it at the very end. So an error on
 * the way leaves the world as it was.
 */
#include "parts.h"

/* Hits of one body in a frame, unless the caller sets another cap. */
#define EVENTS_OF_A_BODY 32

/* Forget what the last step found. */
FIX_APART static void forget(struct carom_world *w)
{
    w->event_count = 0;
    w->rest.joints.states = w->now->joints;
    w->regions_stale = true;
    pool_clear(&w->pools[CAROM_POOL_hits]);
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
}

FIX_APART static void begin_clock(struct body *b)
{
    b->clock.touched = b->clock.contact != BODY_FLIES;
    b->clock.contact = BODY_FLIES;
    b->clock.stands = b->clock.strained = b->clock.pressed = false;
    b->clock.placed = b->clock.member = false;
    b->clock.from_q30 = b->clock.to_q30 = 0;
    b->clock.events = b->clock.cuts = b->clock.shorter = 0;
    PHASE_BEGIN(b->solve.work_phase, BODY_WORK);
    b->solve.work2 = (struct fix_wide){0, 0};
}

/*
 * Copy the bodies that move. A body that stands still, or that sleeps in both states, is the same
 * in both already: it slept in the step before, and anything that changes a body wakes it. Returns
 * the number of bodies that are awake.
 */
static uint32_t copy_bodies(struct carom_world *w, struct world_state *next)
{
    const struct world_state *now = world_now(w);
    uint32_t active = 0;

    for (uint32_t i = 0; i < w->body_count; i++) {
        const struct body_state *from = &now->bodies[i];
        struct body_state *to = &next->bodies[i];

        if (w->bodies[i].def.goes && !(from->asleep && to->asleep)) {
            *to = *from;
            active += broad_active(&w->bodies[i], from);
        }
        begin_clock(&w->bodies[i]);
    }
    return active;
}

/* True if every contact takes the smaller e and the smaller mu of its bodies. */
static bool is_plain(const struct carom_world *w)
{
    const struct contact_list *list = &w->rest.list;

    return w->pools[CAROM_POOL_extras].used == 0 && !w->config.contact &&
           (list->restitution_rule | list->friction_rule) == CAROM_SMALLER;
}

/* Begin with extras and joints; most worlds have none. */
FIX_APART static void begin_rare(struct step *s)
{
    struct carom_world *w = s->w;

    if (w->pools[CAROM_POOL_extras].used > 0) {
        s->led = step_begin_routes(s);
    }
    if (w->joint_steps) {
        w->joint_steps->begin(s);
    }
    step_act(s);
}

/* Keep the events of kinematic bodies that stopped, and no others. Returns how many there are. */
FIX_APART static uint32_t keep_blocked(struct carom_world *w)
{
    uint32_t kept = 0;

    for (uint32_t i = 0; i < w->event_count; i++) {
        if (w->events[i].kind == CAROM_EVENT_BLOCKED) {
            w->events[kept++] = w->events[i];
        }
    }
    return kept;
}

/* Begin a frame; if `s->anew`, once more, after the solve at its start stopped kinematic bodies. */
static void begin(struct step *s, struct carom_world *w)
{
    const struct world_state *now = world_now(w);
    struct world_state *next = world_next(w);

    s->w = w;
    s->next = next;
    s->now_q30 = 0;
    s->cut_short = s->pairs_changed = s->led = s->broke = s->strained = false;
    s->event_cap = w->config.substep_cap > 0 ? w->config.substep_cap : EVENTS_OF_A_BODY;
    s->rare = w->pools[CAROM_POOL_extras].used > 0 || w->joint_steps || w->passing;
    w->rest.list.plain = is_plain(w);
    s->active = copy_bodies(w, next);
    memcpy(next->warm, now->warm, now->warm_count * sizeof *next->warm);
    next->warm_count = now->warm_count;
    next->touching_count = next->through_count = 0;

    w->rest.pairs = w->pairs;
    w->rest.bodies = w->bodies;
    w->rest.states = next->bodies;
    w->rest.body_count = w->body_count;
    w->rest.warm = next->warm;
    w->rest.warm_count = next->warm_count;
    w->rest.sweeps = w->rest.impacts = w->rest.energy_rules = 0;
    interfere_begin_frame(&w->interfere);
    memset(&w->stats, 0, sizeof w->stats);
    w->stats.substeps = 1;
    w->event_count = s->anew ? keep_blocked(w) : 0;
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    pool_clear(&w->pools[CAROM_POOL_hits]);
    if (s->rare) {
        begin_rare(s);
    }
    s->anew = false;
}

void step_begin(struct step *s, struct carom_world *w)
{
    s->anew = false;
    begin(s, w);
}

/* Set the paths of all bodies at the start of the frame and find the first hits on them. */
static int set_out(struct step *s)
{
    struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
        w->bodies[i].clock.member = step_active(s, i);
        if (w->bodies[i].clock.member) {
            result = step_set_path(s, i);
        }
    }
    step_mark(w, CAROM_STAGE_PREDICT);
    return result == CAROM_OK ? step_search_members(s) : result;
}

/* End the slice of a body and begin the next one. */
static int end_slice(struct step *s, uint32_t i)
{
    int32_t before_q30 = s->now_q30;
    int result;

    for (uint32_t k = 0; k < s->w->body_count; k++) {
        s->w->bodies[k].clock.member = k == i;
    }
    s->w->stats.substeps++;
    s->now_q30 = s->w->bodies[i].clock.to_q30;
    if (s->w->bodies[i].clock.shorter > 0) {
        s->w->bodies[i].clock.shorter--;
    }
    step_leave_path(s, i, s->now_q30);
    result = step_set_path(s, i);
    step_mark(s->w, CAROM_STAGE_PREDICT);
    if (s->w->bodies[i].def.sensor) {
        s->now_q30 = before_q30; /* the slice of a sensor is no event for others */
    }
    return result == CAROM_OK ? step_search_members(s) : result;
}

/* Take events one by one until the frame has no more. */
static int run(struct step *s)
{
    enum step_event event;
    uint32_t number = 0;
    int result = CAROM_OK;

    while (result == CAROM_OK && (event = step_next(s, &number)) != STEP_END) {
        bool cut = false;

        if (event == STEP_SLICE) {
            result = s->w->bodies[number].def.joined == BODY_ALONE ? end_slice(s, number)
                                                                   : step_rejoin(s, number);
            continue;
        }
        if (step_let_pass(s, number)) {
            continue;
        }
        result = step_cut(s, number, &cut);
        if (result == CAROM_OK && !cut) {
            result = step_answer(s, number);
        }
    }
    return result;
}

/* Move every body to its place at the end of the frame. */
static void arrive(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (step_active(s, i) && !s->w->bodies[i].clock.stands) {
            step_leave_path(s, i, CAROM_ONE_Q30);
        }
    }
    if (s->rare) {
        step_end_routes(s);
        if (s->w->joint_steps) {
            s->w->joint_steps->project(s);
        }
    }
    step_mark(s->w, CAROM_STAGE_ADVANCE);
}

/* End the clock of a body that stood still. It kept its clock for the energy check. */
static void stop_clock(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    if (b->clock.stands && step_active(s, i)) {
        body_region_advance(b, CAROM_ONE_Q30 - b->clock.from_q30,
                            CAROM_ONE_Q30 - b->clock.from_q30);
        b->clock.from_q30 = b->clock.to_q30 = CAROM_ONE_Q30;
    }
}

/* Keep awake the bodies on a moving surface, however slow it is. */
static void keep_carried_awake(struct step *s)
{
    const struct contact_list *list = &s->w->rest.list;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct contact *c = &list->contacts[i];
        const struct pair *p = &s->w->pairs[c->key.pair];

        if (c->drift && (c->drift->c[0] | c->drift->c[1] | c->drift->c[2]) != 0) {
            s->next->bodies[p->a].quiet = s->next->bodies[p->b].quiet = 0;
        }
    }
}

/* End a whole frame. */
static int finish(struct step *s)
{
    struct carom_world *w = s->w;
    int result = step_note_faces(s);

    if (result < 0) {
        return result;
    }
    if (s->next->touching_count > 0 || w->joint_steps || s->strained) {
        step_limit_energy(s);
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        stop_clock(s, i);
        (void)step_retire(s, i);
    }
    if (w->config.sleep) {
        if (s->rare && w->pools[CAROM_POOL_extras].used > 0) {
            keep_carried_awake(s);
            step_keep_awake(s);
        }
        rest_sleep(&w->rest, s->next->touching, s->next->touching_count);
    }
    step_drop_warm(s);
    result = step_finish_events(s);
    if (s->rare && w->passing && result == CAROM_OK) {
        result = step_finish_through(s);
    }
    if (s->rare && w->joint_steps && result == CAROM_OK) {
        result = w->joint_steps->break_joints(s);
    }
    return result;
}

/* True if a step would change nothing. */
static bool is_idle(const struct carom_world *w)
{
    const struct world_state *now = world_now(w);

    for (uint32_t i = 0; i < w->body_count; i++) {
        if (broad_active(&w->bodies[i], &now->bodies[i])) {
            return false;
        }
    }
    CAROM_ASSERT(now->warm_count == 0); /* see step_drop_warm */
    return !w->sense_anew;
}

/*
 * Step a world in which nothing is awake. The result of the first such frame holds for all that
 * follow.
 */
static void step_idle(struct carom_world *w)
{
    if (!w->idle) {
        forget(w);
        world_halt_surfaces(w);
        memset(&w->stats, 0, sizeof w->stats);
        w->stats.substeps = w->stats.gathers = 1;
        w->idle = true;
    }
    if (w->config.ticks) {
        w->stats.ticks[CAROM_STAGE_COMMIT] = 0;
        w->stats.over_stage = CAROM_STAGE_COMMIT;
        step_mark(w, CAROM_STAGE_COMMIT);
        w->stats.total_ticks = w->stats.ticks[CAROM_STAGE_COMMIT];
    }
}

/*
 * Begin the frame, up to the solve at its start. If that solve stops kinematic bodies, the frame
 * begins anew with these where they are: springs and contacts were measured on their routes.
 */
static int start(struct step *s, struct carom_world *w)
{
    int result;

    s->anew = false;
    do {
        begin(s, w);
        result = step_begin_regions(s);
        if (result == CAROM_OK && s->rare && w->sense_anew) {
            step_sense_start(s);
        }
        result = result == CAROM_OK ? step_start_contacts(s) : result;
    } while (s->anew);
    return result;
}

/* Step one frame. `single`: regions last for this frame only. */
static int step_frame(struct carom_world *w, bool single, bool *cut_short)
{
    struct step s;
    int result;

    s.single = single;
    result = start(&s, w);
    if (result == CAROM_OK) {
        result = set_out(&s);
    }
    if (result == CAROM_OK) {
        result = run(&s);
    }
    if (result == CAROM_OK) {
        arrive(&s);
        result = finish(&s);
    }
    if (result < 0) {
        forget(w);
        return result;
    }
    *cut_short = s.cut_short;
    w->now = s.next;
    world_halt_surfaces(w);
    if (s.rare) {
        w->sense_anew = false;
        if (s.broke) {
            w->joint_steps->regroup(w);
        }
        world_halt_routes(w);
    }
    step_mark(w, CAROM_STAGE_COMMIT);
    step_finish_stats(w);
    return result;
}

/*
 * Errors that may vanish if regions last one frame only: regions of several frames hold more faces
 * and pairs, and reach farther.
 */
static bool may_be_less(int error)
{
    return error == CAROM_ERR_FACES_FULL || error == CAROM_ERR_PAIRS_FULL ||
           error == CAROM_ERR_RANGE;
}

int carom_world_step(struct carom_world *w)
{
    int status = CAROM_OK;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (w->config.ticks) {
        w->start_tick = w->mark_tick = w->config.ticks();
    }
    if (w->idle || is_idle(w)) {
        step_idle(w);
    } else {
        bool cut_short = false;

        status = step_frame(w, false, &cut_short);
        if (may_be_less(status)) {
            status = step_frame(w, true, &cut_short);
        }
        if (cut_short) {
            status = CAROM_SUBSTEP_CAP;
        }
    }
    if (status >= 0 && w->config.budget_ticks && w->stats.total_ticks > w->config.budget_ticks) {
        status |= CAROM_OVER_BUDGET;
    }
    return status;
}

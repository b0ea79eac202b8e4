/* SPDX-License-Identifier: MIT */
/* Kinematic bodies within a step: their paths, the islands that they carry, and what stops them. */
#include "../solve/rigid.h"
#include "parts.h"

static const struct body_route still = {.slice_bits = 0};

/* True if the end of a route is in range. A body whose route leaves the range stops. */
static bool ends_in_range(const struct body_state *s, const struct body_route *route)
{
    carom_v3_q32 end;

    for (int k = 0; k < 3; k++) {
        end.c[k] = s->position.c[k] + carom_round(route->velocity.c[k], 8);
    }
    return world_position_in_range(&end);
}

static void begin_route(struct step *s, uint32_t i)
{
    struct carom_world *w = s->w;
    const struct body_state *state = &world_now(w)->bodies[i];
    struct body *b = &w->bodies[i];
    struct body_extra *extra = b->def.extra;

    if (extra->drive.kind == BODY_DRIVE_TO) {
        w->route_to(b, state, &extra->drive.position, &extra->drive.rotation, &extra->route);
    } else {
        body_route_on(b, state, &extra->drive.velocity, &extra->drive.spin, &extra->route);
    }
    extra->blocked = extra->blocked && s->anew;
    if (extra->blocked || !ends_in_range(state, &extra->route)) {
        extra->route = still;
    }
    b->clock.stands = extra->blocked;
    b->clock.to_q30 = CAROM_ONE_Q30 >> extra->route.slice_bits;
    b->clock.placed = true;
}

bool step_begin_routes(struct step *s)
{
    struct carom_world *w = s->w;
    bool any = false;

    for (uint32_t i = 0; i < w->body_count; i++) {
        if (body_travels(&w->bodies[i])) {
            begin_route(s, i);
            any = true;
        }
    }
    return any;
}

/* Put kinematic bodies into exactly the pose they were led to: slices are rounded. */
void step_end_routes(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];

        if (body_travels(b) && !b->clock.stands && b->def.extra->drive.kind == BODY_DRIVE_TO) {
            s->next->bodies[i].position = b->def.extra->drive.position;
            s->next->bodies[i].rotation = b->def.extra->drive.rotation;
        }
    }
}

void step_keep_awake(struct step *s)
{
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        const struct pair *p = &s->next->touching[i];

        if (body_travels(&s->w->bodies[p->b])) {
            s->next->bodies[p->a].quiet = 0;
        }
    }
    if (s->w->joint_steps) {
        s->w->joint_steps->keep_awake(s);
    }
}

/* ------------------------------------------------------------------- stopping */

void step_note_blocked(struct step *s, uint32_t i, uint32_t by)
{
    struct body_extra *extra = s->w->bodies[i].def.extra;

    if (!extra->blocked && step_may_note(s->w)) {
        step_add_event(s->w, CAROM_EVENT_BLOCKED, (uint16_t)i, (uint16_t)by);
    }
    extra->blocked = true;
}

void step_block(struct step *s, uint32_t i, uint32_t by)
{
    struct body *b = &s->w->bodies[i];

    if (b->clock.stands) {
        return;
    }
    step_leave_path(s, i, s->now_q30);
    b->def.extra->route = still;
    b->clock.stands = b->clock.member = true;
    step_note_blocked(s, i, by);
}

/*
 * A body of an island that a kinematic body pushes by a contact or leads by a joint; ISLAND_END:
 * none.
 */
static uint32_t pushed_by(const struct step *s, uint32_t first, uint32_t led)
{
    const struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->rest.list.pool->used; n++) {
        const struct pair *p = &w->pairs[w->rest.list.contacts[n].key.pair];

        if (w->bodies[p->a].island.lowest == first && p->b == led) {
            return p->a;
        }
    }
    return w->joint_steps ? w->joint_steps->led_by(s, first, led) : ISLAND_END;
}

void step_block_pushers(struct step *s, const struct pair *p)
{
    const struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->rest.list.pool->used; n++) {
        const struct contact *c = &w->rest.list.contacts[n];
        const struct pair *q = &w->pairs[c->key.pair];

        if (w->bodies[q->a].clock.member && body_travels(&w->bodies[q->b]) && c->drift &&
            contact_rise_q40(c->drift, &c->normal) > 0) {
            step_block(s, q->b, q->a);
        }
    }
    if (w->joint_steps) {
        w->joint_steps->block_leaders(s);
    }
    if (body_travels(&w->bodies[p->b])) {
        step_block(s, p->b, p->a);
    }
}

/* ---------------------------------------------------------------- going along */

/* Velocity of a point of the world that moves with a kinematic body. */
static carom_v3_q40 motion_at(const struct body *led, const carom_v3_q32 *point)
{
    carom_v3_q40 arm, v;

    for (int k = 0; k < 3; k++) {
        int64_t centre_q32 = carom_shl(body_origin_q22(led)[k], 10) + led->path.start_x_q32[k];

        arm.c[k] = carom_shl(point->c[k] - centre_q32, 8);
    }
    body_route_velocity(led, &arm, &v);
    return v;
}

/*
 * True if an island that moves with a kinematic body approaches nothing that stands still or moves
 * on a route.
 */
static bool is_free_to_go(const struct step *s, uint32_t first, const struct body *led)
{
    const struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->rest.list.pool->used; n++) {
        const struct contact *c = &w->rest.list.contacts[n];
        const struct pair *p = &w->pairs[c->key.pair];
        carom_v3_q32 point;
        carom_v3_q40 v;

        if (w->bodies[p->a].island.lowest != first || w->bodies[p->b].def.moving) {
            continue;
        }
        point = contact_point(c);
        v = motion_at(led, &point);
        for (int k = 0; c->drift && k < 3; k++) {
            v.c[k] -= c->drift->c[k];
        }
        if (rest_along_q40(&v, &c->normal) <
            -carom_shl(c->skin_q22 / STEP_NO_APPROACH_DIVISOR, 18)) {
            return false;
        }
    }
    for (uint32_t i = rest_island_first(&w->rest, first); i != ISLAND_END;
         i = rest_island_next(&w->rest, i)) {
        carom_v3_q40 v = motion_at(led, &s->next->bodies[i].position);

        if (!world_motion_in_range(&w->bodies[i], &v, &led->def.extra->route.spin)) {
            return false;
        }
    }
    return true;
}

/*
 * Move every body of the island as a part of the kinematic one. The energy that this takes is work.
 */
static void go_along(struct step *s, uint32_t first, const struct body *led)
{
    struct carom_world *w = s->w;

    for (uint32_t i = rest_island_first(&w->rest, first); i != ISLAND_END;
         i = rest_island_next(&w->rest, i)) {
        struct body_state *state = &s->next->bodies[i];
        struct fix_wide work = {0, 0}, before = {0, 0};
        carom_v3_q40 v = motion_at(led, &state->position);

        body_add_kinetic2_of(&before, &w->bodies[i], state);
        body_set_motion(&w->bodies[i], state, &v, &led->def.extra->route.spin);
        body_add_kinetic2_of(&work, &w->bodies[i], state);
        fix_wide_subtract(&work, &before);
        fix_wide_add(body_work2(&w->bodies[i]), &work);
    }
}

bool step_carry_island(struct step *s, uint32_t first, bool hard)
{
    const struct carom_world *w = s->w;

    for (int stop = hard; stop < 2; stop++) {
        for (uint32_t i = 0; i < w->body_count; i++) {
            const struct body *led = &w->bodies[i];
            uint32_t by =
                body_travels(led) && !led->clock.stands ? pushed_by(s, first, i) : ISLAND_END;

            if (by == ISLAND_END) {
                continue;
            }
            if (stop) {
                step_block(s, i, by);
            } else if (is_free_to_go(s, first, led)) {
                go_along(s, first, led);
                return true;
            }
        }
    }
    return false;
}

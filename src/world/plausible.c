/* SPDX-License-Identifier: MIT */
/* Could a state that was read be what a step has left? SPEC.md, section 8, derives the bounds. */
#include "world.h"

/*
 * A normalised rotation's squared length is 1 within 2^-28. A normal of edges is a vector divided
 * by its length, at least 0.002, which is right to some units.
 */
#define ROTATION_BITS 27
#define NORMAL_BITS   16
/* A kept impulse over the lighter body's mass, units a frame: 2^10 V*, and V* is at most 2^8. */
#define IMPULSE_BITS 18
/* Impulses were rounded to their unit, and their direction to 2^-30. */
#define IMPULSE_NOISE_Q40 ((int64_t)1 << 24)
/* A body on a moving surface may be this far above it, q22. */
#define SURFACE_GAP_Q22 ((int32_t)32 << 22)

/*
 * True if flags are plausible. A sleeping body has no momenta, and is neither out nor woken since
 * the last step.
 */
static bool flags_plausible(const struct body *b, const struct body_state *s)
{
    if (!b->def.moving) {
        return (s->asleep | s->out | s->quiet | s->woken) == 0;
    }
    return s->asleep <= 1 && s->out <= 1 && s->woken <= 1 && s->quiet <= REST_QUIET_FRAMES &&
           s->asleep + s->out + s->woken <= 1 &&
           (!s->asleep || (fix_sum(s->momentum.c) | fix_sum(s->angular.c)) == 0);
}

static bool body_plausible(const struct body *b, const struct body_state *s,
                           const carom_v3_q40 *gravity, const struct carom_forces *forces)
{
    const carom_v3_q40 *force = &forces->force;

    return world_is_unit(s->rotation.c, 4, ROTATION_BITS) && world_in_range(b, s) &&
           flags_plausible(b, s) &&
           (b->def.moving ||
            ((force->c[0] | force->c[1] | force->c[2]) == 0 && !world_forces_need_extra(forces))) &&
           world_check_forces(b, gravity, forces) == CAROM_OK;
}

bool world_drive_plausible(const struct body *b, const struct body_state *s,
                           const struct body_drive *drive)
{
    if (drive->kind == BODY_DRIVE_NONE) {
        return true;
    }
    if (drive->kind == BODY_DRIVE_ON) {
        return world_drive_in_range(b, &drive->velocity, &drive->spin) &&
               (fix_sum(drive->velocity.c) | fix_sum(drive->spin.c)) != 0;
    }
    return drive->kind == BODY_DRIVE_TO && world_is_unit(drive->rotation.c, 4, ROTATION_BITS) &&
           world_leads(drive, s) && world_pose_in_reach(b, s, &drive->position, &drive->rotation);
}

/* True if a pair is named as broad.h says. */
static bool pair_plausible(const struct carom_world *w, uint16_t a, uint16_t b)
{
    return a < w->body_count && b < w->body_count && w->bodies[a].def.moving &&
           w->bodies[b].def.mesh && (a > b || !w->bodies[b].def.moving);
}

/* -1, 0 or 1 if the pair a, b comes before, at or after c, d. */
static int order(uint16_t a, uint16_t b, uint16_t c, uint16_t d)
{
    return a != c ? (a < c ? -1 : 1) : b != d ? (b < d ? -1 : 1) : 0;
}

/* The largest kept impulse that a solve can give a body, q40; at most 2^60. */
static int64_t most_impulse_q40(const struct body *b)
{
    const int64_t most = (int64_t)1 << 60;

    /* the mass is below 2^(30 - e) */
    return 40 + IMPULSE_BITS + 30 - b->def.mass.e > 60
               ? most
               : fix_mul_scaled((int64_t)1 << (40 + IMPULSE_BITS), b->def.mass);
}

/*
 * True if an impulse presses along the normal by no more than a solve can give, see SPEC.md.
 * Friction must be within the widest cone there is, not that of the bodies' materials: the caller's
 * callback may have chosen any.
 */
FIX_APART static bool impulse_plausible(const struct carom_world *w, const struct rest_warm *warm)
{
    const struct body *a = &w->bodies[warm->a], *b = &w->bodies[warm->b];
    const struct rest_warm_parts parts = rest_warm_parts(warm);
    int64_t most_q40 = most_impulse_q40(a), across_q40;

    if (b->def.moving && most_impulse_q40(b) < most_q40) {
        most_q40 = most_impulse_q40(b);
    }
    if (parts.normal_q40 > most_q40 || parts.normal_q40 < -IMPULSE_NOISE_Q40) {
        return false;
    }
    across_q40 = parts.normal_q40 / (1 << 16) * CAROM_MU_MAX_Q16;
    across_q40 += across_q40 / 64 + most_q40 / (1 << 20) + IMPULSE_NOISE_Q40;
    return world_each_within(parts.tangent.c, across_q40);
}

/* True if the arm ends at a's surface, within the possible gap. */
static bool arm_plausible(const struct carom_world *w, const struct rest_warm *warm)
{
    const struct body *a = &w->bodies[warm->a], *b = &w->bodies[warm->b];
    int32_t skin_q22 = a->def.skin_q22 > b->def.skin_q22 ? a->def.skin_q22 : b->def.skin_q22;
    int32_t most_q22 = a->def.radius_q22 + BODY_MARGIN_SKINS * skin_q22 +
                       (b->def.mesh->surface ? SURFACE_GAP_Q22 : 0);
    const int64_t arm[3] = {warm->arm.c[0], warm->arm.c[1], warm->arm.c[2]};

    return world_each_within(arm, most_q22);
}

/* True if an earlier kept impulse of the pair has the same place and normal. */
static bool repeats(const struct rest_warm *first, const struct rest_warm *warm)
{
    for (const struct rest_warm *kept = warm;
         kept-- > first && kept->a == warm->a && kept->b == warm->b;) {
        if (memcmp(&kept->arm, &warm->arm, sizeof kept->arm) == 0 &&
            memcmp(&kept->normal, &warm->normal, sizeof kept->normal) == 0) {
            return true;
        }
    }
    return false;
}

/* True if a body moves and is awake. */
static bool awake(const struct carom_world *w, const struct world_state *s, uint16_t i)
{
    return w->bodies[i].def.moving && broad_active(&w->bodies[i], &s->bodies[i]);
}

/* True if kept impulses belong to touching pairs, in their order, with at least one body awake. */
static bool warm_plausible(const struct carom_world *w, const struct world_state *s)
{
    const struct pair *t = s->touching, *end = t + s->touching_count;

    for (const struct rest_warm *i = s->warm; i < s->warm + s->warm_count; i++) {
        while (t < end && order(t->a, t->b, i->a, i->b) < 0) {
            t++;
        }
        if (t == end || order(t->a, t->b, i->a, i->b) != 0 || !arm_plausible(w, i) ||
            !world_is_unit(i->normal.c, 3, NORMAL_BITS) || !impulse_plausible(w, i) ||
            !(awake(w, s, i->a) || awake(w, s, i->b)) || repeats(s->warm, i)) {
            return false;
        }
    }
    return true;
}

static bool pairs_plausible(const struct carom_world *w, const struct pair *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct pair *p = &list[i];

        if (!pair_plausible(w, p->a, p->b) || (i > 0 && order(p[-1].a, p[-1].b, p->a, p->b) >= 0)) {
            return false;
        }
    }
    return true;
}

bool world_plausible(struct carom_world *w, const struct world_state *s,
                     const carom_v3_q40 *gravity)
{
    if (!world_gravity_in_range(gravity)) {
        return false;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        if (b->def.mesh && !body_plausible(b, &s->bodies[i], gravity, &body_loaded(b)->forces)) {
            return false;
        }
    }
    return pairs_plausible(w, s->touching, s->touching_count) &&
           pairs_plausible(w, world_through(w, s), s->through_count) && warm_plausible(w, s);
}

/* SPDX-License-Identifier: MIT */
/* The energy rule of contact over a frame, island by island. */
#include "../solve/parts.h"
#include "energy.h"

/* Rounding may add this part of the kinetic energy: an excess below 2^-24 of it is ignored. */
#define SLACK_BITS 24

/*
 * Add the gain in height, less what moving surfaces and closing skins account for: -2 m a.(way from
 * one place to another), with q40 times q32 brought to q40.
 */
static void add_lifted2(struct fix_wide *sum, const struct body *b, const struct body_state *from,
                        const struct body_state *to)
{
    for (int k = 0; k < 3; k++) {
        int64_t weight_q40 = fix_mul_scaled(b->def.acceleration.c[k], b->def.mass);
        int64_t way_q32 = to->position.c[k] - from->position.c[k];

        fix_wide_add_product(sum, -2 * weight_q40, carom_shl(way_q32, 8));
    }
    fix_wide_subtract(sum, body_worked2(b));
    if (b->clock.contact != BODY_FLIES) {
        body_add_lift2(sum, b, -1);
    }
}

/* True if an island may have gained energy: not if closing skins account for all of it. */
static bool may_gain(const struct step *s, uint32_t first)
{
    struct fix_wide most = {0, 0};

    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        const struct body *b = &s->w->bodies[i];
        const struct body_state *from = &world_now(s->w)->bodies[i], *to = &s->next->bodies[i];

        if (!from->out) {
            body_add_kinetic2_most(&most, b, to);
            add_lifted2(&most, b, from, to);
        }
    }
    return fix_wide_sign(&most) > 0;
}

struct step_account step_audit(const struct step *s, uint32_t first)
{
    struct step_account sum;

    memset(&sum, 0, sizeof sum);
    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        const struct body *b = &s->w->bodies[i];
        const struct body_state *from = &world_now(s->w)->bodies[i], *to = &s->next->bodies[i];

        if (from->out) {
            continue;
        }
        body_add_kinetic2_of(&sum.before, b, from);
        body_add_kinetic2_of(to->out ? &sum.left : &sum.kinetic, b, to);
        add_lifted2(&sum.excess, b, from, to);
    }
    fix_wide_add(&sum.excess, &sum.kinetic);
    fix_wide_add(&sum.excess, &sum.left);
    fix_wide_subtract(&sum.excess, &sum.before);
    if (s->w->joint_steps) {
        s->w->joint_steps->add_joints2(s, first, &sum.excess, &sum.taken, &sum.kept);
        fix_wide_add(&sum.excess, &sum.taken);
    }
    return sum;
}

struct fix_wide step_beside2(const struct step *s, const struct rest_rigid *rigid,
                             const struct fix_wide *all)
{
    struct fix_wide sum = {0, 0}, beside = *all;

    for (uint32_t i = rigid->first; i != ISLAND_END; i = rest_island_next(&s->w->rest, i)) {
        struct body_state state = rest_rigid_state(&s->w->rest, rigid, i);

        body_add_kinetic2_of(&sum, &s->w->bodies[i], &state);
    }
    fix_wide_subtract(&beside, &sum);
    return beside;
}

static bool moved(const struct body_state *from, const struct body_state *to)
{
    return memcmp(&from->position, &to->position, sizeof from->position) != 0 ||
           memcmp(&from->rotation, &to->rotation, sizeof from->rotation) != 0;
}

/*
 * Put the island back where the frame found it. Bodies that are out go back as well, and stay out:
 * they left the world in this frame, since one that is out joins no island. The momenta become zero,
 * or a quarter of what they were: with all of them the island would do the same in every later frame.
 */
static void rewind_island(struct step *s, uint32_t first, bool halt)
{
    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        const struct body_state *before = &world_now(s->w)->bodies[i];
        struct body_state *state = &s->next->bodies[i];

        s->w->bodies[i].clock.rewound = true;
        state->position = before->position;
        state->rotation = before->rotation;
        for (int k = 0; k < 3; k++) {
            state->momentum.c[k] = halt ? 0 : before->momentum.c[k] / 4;
            state->angular.c[k] = halt ? 0 : before->angular.c[k] / 4;
        }
    }
}

/* True if two bodies must not overlap: they may touch, and do not pass in this frame. */
static bool are_solid(const struct step *s, uint32_t i, uint32_t k)
{
    const struct pair p = world_name_pair(s->w, i, k);
    uint32_t number = step_find_pair(s->w, &p);

    return broad_may_touch(&s->w->bodies[i], &s->w->bodies[k]) &&
           (number == UINT32_MAX || !s->w->meetings[number].passes);
}

/* A body that moved to where a body of another island was before. ISLAND_END: none. */
static uint32_t intruder(struct step *s, uint32_t body)
{
    const struct world_state *before = world_now(s->w);
    const struct body *b = &s->w->bodies[body];

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *other = &s->w->bodies[i];
        const struct interfere_placed was = {b, &before->bodies[body]};
        const struct interfere_placed is = {other, &s->next->bodies[i]};

        if (broad_active(other, is.state) && other->island.lowest != b->island.lowest &&
            moved(&before->bodies[i], is.state) && are_solid(s, body, i) &&
            broad_near(b, was.state, other, is.state, b->def.skin_q22) &&
            world_overlap(s->w, was, is)) {
            return i;
        }
    }
    return ISLAND_END;
}

/*
 * Put the island back where the frame found it. Any island that went to that place is undone as
 * well, and so on: where the frame found them, no two bodies overlap. Islands on the ground stop, or
 * they would do the same in each frame.
 */
static void hold_still(struct step *s, uint32_t first)
{
    bool again = true;

    s->w->regions_stale = true;
    rewind_island(s, first, s->w->bodies[first].clock.grounded);
    while (again) {
        again = false;
        for (uint32_t i = 0; i < s->w->body_count; i++) {
            uint32_t by = s->w->bodies[i].clock.rewound ? intruder(s, i) : ISLAND_END;

            if (by != ISLAND_END) {
                uint32_t other = s->w->bodies[by].island.lowest;

                rewind_island(s, other, s->w->bodies[other].clock.grounded);
                if (!s->w->bodies[by].def.moving) {
                    step_note_blocked(s, by, i);
                }
                again = true;
            }
        }
    }
}

int32_t step_factor_q30(const struct fix_wide *kinetic, const struct fix_wide *excess)
{
    struct fix_wide kept = *kinetic;
    struct fix_scaled ratio;

    fix_wide_subtract(&kept, excess);
    if (fix_wide_sign(&kept) <= 0) {
        return 0;
    }
    ratio = fix_wide_ratio(&kept, kinetic); /* below 1 */
    return (int32_t)fix_sqrt((uint64_t)fix_mul_scaled((int64_t)1 << 60, ratio));
}

/* True if a moving kinematic body touches an island or leads it by a joint. */
static bool is_pushed(const struct step *s, uint32_t first)
{
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        const struct pair *p = &s->next->touching[i];

        if (s->w->bodies[p->a].island.lowest == first && body_travels(&s->w->bodies[p->b])) {
            return true;
        }
    }
    return s->w->joint_steps && s->w->joint_steps->led_by(s, first, ISLAND_END) != ISLAND_END;
}

/* Scale the momenta of the island's bodies that left the world. */
static void scale_left(struct step *s, uint32_t first, int32_t factor_q30)
{
    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        struct body_state *state = &s->next->bodies[i];

        for (int k = 0; state->out && k < 3; k++) {
            state->momentum.c[k] = fix_mul_q30(state->momentum.c[k], factor_q30);
            state->angular.c[k] = fix_mul_q30(state->angular.c[k], factor_q30);
        }
    }
}

/* Take the slack of rounding from the excess; true if something is left. */
static bool gains(const struct step_account *sum)
{
    struct fix_wide over = sum->excess, all = sum->kinetic, slack;

    fix_wide_add(&all, &sum->left);
    slack = fix_wide_down(&all, SLACK_BITS);
    fix_wide_subtract(&over, &slack);
    return fix_wide_sign(&over) > 0;
}

struct step_account step_settle_left(struct step *s, uint32_t first)
{
    struct step_account sum = step_audit(s, first);

    if (gains(&sum) && fix_wide_sign(&sum.left) > 0) {
        scale_left(s, first, step_factor_q30(&sum.left, &sum.excess));
        sum = step_audit(s, first);
    }
    return sum;
}

/*
 * The factor that takes the excess out of a motion's momenta. Where the motion has too little, what
 * limits and damping took again does not count.
 */
static int32_t factor_of(const struct fix_wide *motion, struct step_account *sum)
{
    int32_t factor_q30 = step_factor_q30(motion, &sum->excess);

    if (factor_q30 == 0) {
        step_forgive_taken(sum);
        factor_q30 = gains(sum) ? step_factor_q30(motion, &sum->excess) : CAROM_ONE_Q30;
    }
    return factor_q30;
}

/*
 * Take the excess of an island in the air out of its bodies' motion against each other. True if that
 * has too little. One body may gain some that left its path for a hit which was no contact: between
 * the ends of a slice a turning path does not keep the energy. Where the common motion has nearly all
 * of the energy, its roundings may leave an excess, and the second round takes that.
 */
static FIX_OWN_FRAME bool limit_free(struct step *s, uint32_t first, struct step_account *sum)
{
    struct rest_rigid rigid;

    if (rest_is_alone(&s->w->rest, first) || !rest_rigid_motion(&s->w->rest, first, &rigid)) {
        return true;
    }
    for (int round = 0; round < 2 && gains(sum); round++) {
        struct fix_wide beside = step_beside2(s, &rigid, &sum->kinetic);
        int32_t factor_q30 = factor_of(&beside, sum);

        if (factor_q30 == CAROM_ONE_Q30) {
            break;
        }
        rest_scale_free(&s->w->rest, &rigid, factor_q30);
        if (factor_q30 == 0) {
            return true;
        }
        *sum = step_audit(s, first);
    }
    return false;
}

/*
 * Take the excess out of an island's momenta. True if it is in the air and its rigid motion alone has
 * more energy than it may have.
 */
static FIX_OWN_FRAME bool limit_island(struct step *s, uint32_t first)
{
    struct step_account sum = step_settle_left(s, first);
    int32_t factor_q30;

    if (!gains(&sum)) {
        return false;
    }
    if (!s->w->bodies[first].clock.grounded) {
        return limit_free(s, first, &sum);
    }
    factor_q30 = factor_of(&sum.kinetic, &sum);
    if (factor_q30 == 0 && is_pushed(s, first)) {
        rest_scale_grounded(&s->w->rest, first, 0); /* the kinematic body may be where it was */
    } else if (factor_q30 == 0) {
        hold_still(s, first); /* it climbed by more energy than it has to give */
    } else {
        rest_scale_grounded(&s->w->rest, first, factor_q30);
    }
    return false;
}

void step_forgive_taken(struct step_account *sum)
{
    if (fix_wide_sign(&sum->excess) > 0) {
        fix_wide_subtract(&sum->excess, &sum->taken);
        if (fix_wide_sign(&sum->excess) < 0) {
            sum->excess = (struct fix_wide){0, 0};
        }
    }
}

/*
 * Bodies in contact took the gravity of the rest of the frame before they moved. An island in the
 * air whose bodies stand still gives back the gravity of the time that it dropped. Then it has the
 * momentum that gravity gave it on its way, and scaling its motion about the common velocity takes
 * out whatever it gained. On the ground, impulses answer the weight and belong to it; there the
 * audit alone decides.
 */
static void give_back_gravity(struct step *s, uint32_t first)
{
    for (uint32_t i = first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        const struct body *b = &s->w->bodies[i];

        for (int k = 0;
             step_active(s, i) && b->clock.stands && b->clock.contact != BODY_FLIES && k < 3; k++) {
            s->next->bodies[i].momentum.c[k] -= fix_mul_scaled(
                fix_mul_q30(b->def.acceleration.c[k], CAROM_ONE_Q30 - b->clock.from_q30),
                b->def.mass);
        }
    }
}

/*
 * Limit an island that touched something. `surely`: skip the cheap test whether it may have gained.
 * True as limit_island is.
 */
static bool limit_touched(struct step *s, uint32_t first, bool surely)
{
    if (s->cut_short && !s->w->bodies[first].clock.grounded) {
        give_back_gravity(s, first);
    }
    return (surely || may_gain(s, first)) && limit_island(s, first);
}

/*
 * The very last resort for an island in the air: its turn about its centre gives what is left of the
 * excess, or its whole motion does, or it stays where it was. So it loses momentum; a gain of energy
 * could go on growing.
 */
static FIX_OWN_FRAME void slow_down(struct step *s, uint32_t first)
{
    struct step_account sum = step_audit(s, first);
    struct rest_rigid common;
    int32_t turn_q30 = 0, all_q30;

    step_forgive_taken(&sum);
    if (!gains(&sum)) {
        return;
    }
    all_q30 = step_factor_q30(&sum.kinetic, &sum.excess);
    if (rest_rigid_motion(&s->w->rest, first, &common)) {
        struct fix_wide turn;

        memset(&common.spin, 0, sizeof common.spin);
        turn = step_beside2(s, &common, &sum.kinetic);
        turn_q30 = step_factor_q30(&turn, &sum.excess);
    }
    if (turn_q30 > 0) {
        rest_scale_turn(&s->w->rest, &common, turn_q30);
    } else if (all_q30 > 0) {
        rest_scale_grounded(&s->w->rest, first, all_q30);
    } else {
        hold_still(s, first);
    }
    s->w->stats.calmed++;
}

void step_undo(struct step *s, uint32_t first)
{
    if (s->w->bodies[first].clock.grounded) {
        hold_still(s, first);
    } else if (!step_go_as_one(s, first)) {
        slow_down(s, first);
    }
}

/*
 * The rule of an island: joints alone conserve, contact may not add. A kinematic body is an island of
 * its own and has no energy, though a joint to a body that left the world may still hang on it.
 */
static void limit(struct step *s, uint32_t first)
{
    const struct body *b = &s->w->bodies[first];
    struct fix_wide *owed;

    if (!b->def.mesh || !b->def.moving) {
        return;
    }
    owed = s->w->joint_steps ? s->w->joint_steps->owed2(s, first) : NULL;
    if (b->clock.touched) {
        if (limit_touched(s, first, owed != NULL)) {
            step_undo(s, first);
        }
        if (owed) {
            *owed = (struct fix_wide){0, 0};
        }
    } else if (owed) {
        s->w->joint_steps->conserve(s, first, owed);
    }
}

void step_limit_energy(struct step *s)
{
    struct carom_world *w = s->w;

    island_begin(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].clock.touched = w->bodies[i].clock.contact != BODY_FLIES ||
                                     w->bodies[i].clock.stands || w->bodies[i].clock.strained;
        w->bodies[i].clock.grounded = w->bodies[i].clock.rewound = false;
    }
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        const struct pair *p = &s->next->touching[i];

        w->bodies[p->a].clock.touched = true;
        island_join(w->bodies, p);
        w->bodies[p->a].clock.grounded |= !w->bodies[p->b].def.moving;
    }
    if (w->joint_steps) {
        /* a body that leaves in this frame takes energy of its island along */
        w->rest.joints.calls->join(&w->rest, world_now(w)->bodies);
        w->joint_steps->ground(s);
    }
    island_end(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[w->bodies[i].island.lowest].clock.touched |= w->bodies[i].clock.touched;
        w->bodies[w->bodies[i].island.lowest].clock.grounded |= w->bodies[i].clock.grounded;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].island.lowest == i) {
            limit(s, i);
        }
    }
}

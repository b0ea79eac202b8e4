/* SPDX-License-Identifier: MIT */
/* The ground and up to three solids with contacts set by hand, for the tests of rest. */
#include "hand.h"

#include "real.h"

struct hand hand;
const struct pair hand_pairs[4] = {{1, 0}, {2, 1}, {3, 0}, {2, 0}};

static int64_t q40(double v)
{
    return real_round(v * real_power2(40));
}

void hand_set_surface(double e, double mu)
{
    for (int i = 0; i < HAND_BODIES; i++) {
        hand.bodies[i].def.restitution_q30 = (int32_t)real_round(e * CAROM_ONE_Q30);
        hand.bodies[i].def.friction_q16 = (uint32_t)real_round(mu * 65536);
    }
}

void hand_set_motion(int body, const double v[3], const double w[3])
{
    carom_v3_q40 v_q40, w_q40;

    for (int k = 0; k < 3; k++) {
        v_q40.c[k] = q40(v[k]);
        w_q40.c[k] = q40(w[k]);
    }
    body_set_motion(&hand.bodies[body], &hand.states[body], &v_q40, &w_q40);
}

void hand_set_gravity(double x, double y, double z)
{
    for (int i = 0; i < HAND_BODIES; i++) {
        hand.bodies[i].def.acceleration = (carom_v3_q40){{q40(x), q40(y), q40(z)}};
        hand.bodies[i].def.acceleration_q40 = fix_length(hand.bodies[i].def.acceleration.c);
    }
}

void hand_clear_contacts(void)
{
    hand.pool = (struct pool){HAND_CONTACTS, 0, 0, 0};
    hand.rest.sweeps = hand.rest.impacts = hand.rest.energy_rules = 0;
    for (int i = 0; i < HAND_BODIES; i++) {
        body_place(&hand.bodies[i], &hand.states[i]);
        hand.bodies[i].clock.contact = BODY_FLIES;
    }
}

void hand_begin(int moving, double fall)
{
    memset(&hand.rest, 0, sizeof hand.rest);
    hand.rest.gauss = &hand.gauss;
    hand.rest.works = hand.works;
    hand.rest.rolls = hand.rolls;
    for (int i = 0; i < HAND_BODIES; i++) {
        shape_body(i == 0 ? &hand.ground : &hand.solid, i > 0, &hand.bodies[i], &hand.states[i]);
    }
    hand_set_gravity(0, 0, -fall);
    hand.rest.list = (struct contact_list){.contacts = hand.contacts, .pool = &hand.pool};
    hand.rest.pairs = hand_pairs;
    hand.rest.bodies = hand.bodies;
    hand.rest.states = hand.states;
    hand.rest.body_count = (uint32_t)moving + 1;
    hand.rest.warm = hand.warm;
    hand_clear_contacts();
}

void hand_make_cube(void)
{
    shape_plane(&hand.ground, 9, 2, 4096);
    shape_box(&hand.solid, 12, 4096, 4096, 4096);
}

void hand_make_box(void)
{
    shape_plane(&hand.ground, 9, 2, 4096);
    shape_box(&hand.solid, 12, 4096, 2458, 1228);
}

void hand_touch(uint16_t number, uint32_t vertex, const int32_t arm_q22[3], carom_v3_q30 normal,
                int32_t gap_q22)
{
    const struct candidate key = {number, CANDIDATE_VERTEX_FACE, vertex, 0};
    const struct pair *p = &hand_pairs[number];
    carom_v3_q40 arm[2];

    boyse_pair_init(&hand.pair, &hand.bodies[p->a], &hand.bodies[p->b]);
    for (int k = 0; k < 3; k++) {
        arm[0].c[k] = carom_shl(arm_q22[k], 18);
        arm[1].c[k] =
            arm[0].c[k] +
            carom_shl(hand.states[p->a].position.c[k] - hand.states[p->b].position.c[k], 8);
    }
    CHECK(contact_insert(&hand.rest.list, &hand.pair, &key, &normal, gap_q22, arm));
}

const carom_v3_q30 hand_up = {{0, 0, CAROM_ONE_Q30}};

void hand_touch_corners_of(uint16_t number, int32_t gap_q22)
{
    for (uint32_t v = 0; v < 4; v++) {
        int32_t arm[3];

        for (int k = 0; k < 3; k++) {
            arm[k] = hand.solid.vertices[v][k] * 1024;
        }
        hand_touch(number, v, arm, hand_up, gap_q22);
    }
}

void hand_touch_corners(int32_t gap_q22)
{
    hand_touch_corners_of(0, gap_q22);
}

void hand_velocity_of(int body, double v[3], double w[3])
{
    carom_v3_q40 v_q40, w_q40;

    body_velocity(&hand.bodies[body], &hand.states[body], &v_q40);
    body_spin(&hand.bodies[body], &hand.states[body], &hand.bodies[body].path.start.r, &w_q40);
    for (int k = 0; k < 3; k++) {
        v[k] = real(v_q40.c[k], 40);
        w[k] = real(w_q40.c[k], 40);
    }
}

double hand_pressure(const struct contact *c, double *across)
{
    double p[3], n[3], along;

    for (int k = 0; k < 3; k++) {
        p[k] = real(c->impulse_q40.c[k], 40);
        n[k] = real(c->normal.c[k], 30);
    }
    along = real_dot(p, n);
    for (int k = 0; k < 3; k++) {
        p[k] -= along * n[k];
    }
    *across = real_length(p);
    return along;
}

bool hand_enter_contact(int32_t tau_q30)
{
    if (!rest_enter_contact(&hand.rest)) {
        return false;
    }
    for (uint32_t i = 0; i < hand.rest.body_count; i++) {
        if (hand.bodies[i].clock.contact == BODY_ENTERS) {
            body_accelerate(&hand.bodies[i], &hand.states[i], tau_q30);
        }
    }
    rest_load_entered(&hand.rest);
    return true;
}

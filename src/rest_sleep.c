/* SPDX-License-Identifier: MIT */
/* Sleep: what has been quiet for a while stops being computed, island by island. */
#include "rest.h"

#define QUIET_FRAMES 20

static bool is_quiet(const struct body *b, const struct body_state *s, int64_t limit_q40)
{
    carom_m3_q30 m;
    carom_v3_q40 v, w;

    body_matrix(&m, &s->rotation);
    body_velocity(b, s, &v);
    body_spin(b, s, &m, &w);
    return b->in_contact &&
           fix_length(v.c) + fix_mul(fix_length(w.c), b->radius_q22, 22) < limit_q40;
}

void rest_sleep(const struct body *bodies, struct body_state *states, uint32_t body_count,
                const struct pair *touching, uint32_t touching_count, const carom_v3_q40 *gravity)
{
    /* an eighth of what gravity gives in a frame: a body that falls is never that slow for long */
    int64_t limit_q40 = fix_length(gravity->c) / 8;
    bool again = true;

    for (uint32_t i = 0; i < body_count; i++) {
        if (!broad_active(&bodies[i], &states[i])) {
            continue;
        }
        if (!is_quiet(&bodies[i], &states[i], limit_q40)) {
            states[i].quiet = 0;
        } else if (states[i].quiet < QUIET_FRAMES) {
            states[i].quiet++;
        }
    }
    /* an island sleeps as a whole: one restless body keeps its neighbours awake */
    while (again) {
        again = false;
        for (uint32_t i = 0; i < touching_count; i++) {
            struct body_state *a = &states[touching[i].a], *b = &states[touching[i].b];

            if (bodies[touching[i].a].moving && bodies[touching[i].b].moving &&
                (a->quiet == QUIET_FRAMES) != (b->quiet == QUIET_FRAMES)) {
                *(a->quiet == QUIET_FRAMES ? &a->quiet : &b->quiet) = QUIET_FRAMES - 1;
                again = true;
            }
        }
    }
    for (uint32_t i = 0; i < body_count; i++) {
        if (broad_active(&bodies[i], &states[i]) && states[i].quiet == QUIET_FRAMES) {
            states[i].asleep = 1;
            memset(&states[i].momentum, 0, sizeof states[i].momentum);
            memset(&states[i].angular, 0, sizeof states[i].angular);
        }
    }
}

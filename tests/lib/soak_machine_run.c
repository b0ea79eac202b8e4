/* SPDX-License-Identifier: MIT */
/* Machines: their setup when the bodies are there, and the calls before a frame. */
#include <string.h>

#include "real.h"
#include "soak.h"

/* ---------------------------------------------------------------------- callback */

/* Whether the callback drops the contacts of two bodies; never with bodies of the ground. */
static bool drops(const struct soak_machine *m, int a, int b)
{
    int low = a < b ? a : b, high = a < b ? b : a;

    return m->asks && low >= m->first && ((uint64_t)(low * 31 + high * 17) + m->seed) % 5 == 0;
}

/* The callback also sets other e and mu by face. */
static bool ask(void *user, struct carom_touch *touch)
{
    const struct soak_machine *m = user;

    if ((touch->face_a + touch->face_b) % 3 == 0) {
        touch->restitution_q30 = (int32_t)(((touch->face_a * 7 + m->seed) % 9) << 27);
        touch->friction_q16 = (uint32_t)(((touch->face_b * 5 + m->seed) % 9) << 13);
    }
    return !drops(m, touch->a, touch->b);
}

void soak_machine_ask(struct soak_world *w)
{
    w->crowd->config.contact = w->machine->asks ? ask : NULL;
    w->crowd->config.contact_user = w->machine;
}

/* ----------------------------------------------------------------------- passing */

/* True if two filters let bodies meet, by the rule that carom.h states. */
static bool may_meet(const struct carom_filter *p, const struct carom_filter *q)
{
    static const struct carom_filter usual = {1, 0xffff, 0}, zero;
    const struct carom_filter *a = memcmp(p, &zero, sizeof zero) == 0 ? &usual : p;
    const struct carom_filter *b = memcmp(q, &zero, sizeof zero) == 0 ? &usual : q;

    if (a->group == b->group && a->group != 0) {
        return a->group > 0;
    }
    return (a->category & b->mask) != 0 && (b->category & a->mask) != 0;
}

bool soak_machine_may_meet(const struct soak_world *w, int a, int b)
{
    return may_meet(&w->machine->filters[a], &w->machine->filters[b]);
}

static bool ignore(const struct soak_machine *m, int a, int b)
{
    for (int i = 0; i < m->joint_count; i++) {
        const struct soak_joint *j = &m->joints[i];

        if (!j->gone && !j->def.touch &&
            ((j->def.a == a && j->def.b == b) || (j->def.a == b && j->def.b == a))) {
            return true;
        }
    }
    return false;
}

static bool pass(const struct soak_world *w, int a, int b)
{
    const struct carom_body_def *p = &w->crowd->bodies[a].def, *q = &w->crowd->bodies[b].def;

    return p->sensor || q->sensor || p->one_way != CAROM_BOTH_WAYS ||
           q->one_way != CAROM_BOTH_WAYS || !soak_machine_may_meet(w, a, b) ||
           drops(w->machine, a, b) || ignore(w->machine, a, b);
}

/* A pair that passed and may touch from now on still passes until it is apart. */
void soak_machine_let_pass(struct soak_world *w)
{
    for (int a = 0; a < w->crowd->body_count; a++) {
        for (int b = 0; b < a; b++) {
            if (pass(w, a, b)) {
                crowd_let_pass(w->crowd, a, b, CROWD_PASS);
            } else if (w->crowd->pass[a][b] == CROWD_PASS) {
                crowd_let_pass(w->crowd, a, b, CROWD_PASS_ONCE);
            }
        }
    }
}

/* ------------------------------------------------------------------------- start */

static int set_belt(struct soak_world *w, int body)
{
    const struct carom_body_def *def = &w->crowd->bodies[body].def;
    struct carom_material material = {
        def->restitution_q30, def->friction_q16, CAROM_ROLLING_Q16, {{0}}};

    for (int k = 0; k < 3; k++) {
        material.surface_velocity.c[k] = lab_fixed(soak_uniform(&w->machine->r, -0.05, 0.05), 40);
    }
    w->crowd->bodies[body].drives = true;
    return carom_body_set_material(w->crowd->world, body, &material);
}

static int set_faces(struct soak_world *w, int body)
{
    struct soak_machine *m = w->machine;

    return carom_body_set_face_materials(w->crowd->world, body, m->materials, 4, m->of_face);
}

/* Stationary bodies get belts; others get faces of several materials. */
static int set_materials(struct soak_world *w)
{
    struct soak_machine *m = w->machine;
    int error = CAROM_OK;

    for (int i = 0; i < 4; i++) {
        m->materials[i] =
            (struct carom_material){(int32_t)real_round(soak_uniform(&m->r, 0, 1) * CAROM_ONE_Q30),
                                    (uint32_t)real_round(soak_uniform(&m->r, 0, 1.5) * 65536),
                                    CAROM_ROLLING_Q16,
                                    {{0}}};
    }
    for (int f = 0; f < SOAK_FACES; f++) {
        m->of_face[f] = (uint8_t)soak_pick(&m->r, 4);
    }
    for (int i = 0; i < w->crowd->body_count && error >= 0; i++) {
        int what = soak_pick(&m->r, 3);

        if (what == 0 && (i < m->first || w->crowd->bodies[i].def.kinematic)) {
            error = set_belt(w, i);
        } else if (what == 1) {
            error = set_faces(w, i);
        }
    }
    return error;
}

static int set_damping(struct soak_world *w)
{
    struct soak_machine *m = w->machine;
    int error = CAROM_OK;

    for (int i = m->first; i < w->crowd->body_count && error >= 0; i++) {
        const struct carom_body_def *def = &w->crowd->bodies[i].def;
        double straight = soak_powers(&m->r, 1e-4, 0.5), turn = soak_powers(&m->r, 1e-4, 0.5);

        if (!def->stationary && !def->kinematic && soak_pick(&m->r, 2) == 0) {
            error = carom_body_set_damping(w->crowd->world, i,
                                           (int32_t)real_round(straight * CAROM_ONE_Q30),
                                           (int32_t)real_round(turn * CAROM_ONE_Q30));
        }
    }
    return error;
}

static int add_joints(struct soak_world *w)
{
    struct soak_machine *m = w->machine;

    for (int i = 0; i < m->joint_count; i++) {
        int number = carom_joint_add(w->crowd->world, &m->joints[i].def);

        if (number < 0) {
            return number;
        }
        lab_expect(number == i ? CAROM_OK : CAROM_ERR_JOINT, "number of a joint");
        soak_joint_note(w->crowd, &m->joints[i]);
        w->seen->links[i] = (struct crowd_link){m->joints[i].def.a,
                                                m->joints[i].def.b,
                                                true,
                                                m->joints[i].def.drive.motor,
                                                {0, 0},
                                                {0, 0}};
        w->exact = w->exact && m->joints[i].def.b >= m->first &&
                   !w->crowd->bodies[m->joints[i].def.b].def.stationary;
    }
    w->crowd->links = w->seen->links;
    w->crowd->link_count = m->joint_count;
    crowd_group_links(w->crowd);
    return CAROM_OK;
}

static void pass_at_start(struct soak_world *w)
{
    for (int a = 0; a < w->crowd->body_count; a++) {
        for (int b = 0; b < a; b++) {
            bool put = w->crowd->bodies[a].def.overlap == CAROM_OVERLAP_PASS ||
                       w->crowd->bodies[b].def.overlap == CAROM_OVERLAP_PASS;

            if (put) {
                crowd_let_pass(w->crowd, a, b, CROWD_PASS_ONCE);
            }
        }
    }
    soak_machine_let_pass(w);
}

int soak_machine_start(struct soak_world *w)
{
    struct soak_machine *m = w->machine;
    int error = CAROM_OK;

    w->seen->start = *m;
    if (m->belts) {
        error = set_materials(w);
    }
    if (error >= 0 && m->damped) {
        error = set_damping(w);
    }
    if (error >= 0) {
        error = add_joints(w);
    }
    pass_at_start(w);
    w->exact = w->exact && !m->led && !m->belts && !m->damped;
    return error;
}

/* -------------------------------------------------------------------- before a frame */

/* A motor reverses, a spring's rest length changes, a joint is removed. */
static int change_joint(struct soak_world *w)
{
    struct soak_machine *m = w->machine;
    int number = soak_pick(&m->r, m->joint_count), what = soak_pick(&m->r, 4);
    struct soak_joint *joint = &m->joints[number];

    if (joint->gone) {
        return CAROM_OK;
    }
    if (what == 0) {
        joint->gone = joint->removed = true;
        return carom_joint_remove(w->crowd->world, number);
    }
    joint->def.drive.motor_speed_q40 = -joint->def.drive.motor_speed_q40;
    joint->def.drive.rest_q32 -= joint->def.drive.rest_q32 / 4;
    return carom_joint_set(w->crowd->world, number, &joint->def.drive);
}

static int change_filter(struct soak_world *w)
{
    struct soak_machine *m = w->machine;
    int from = soak_pick(&m->r, w->crowd->body_count), to = soak_pick(&m->r, w->crowd->body_count);

    if (to < m->first) {
        return CAROM_OK;
    }
    m->filters[to] = m->filters[from];
    return carom_body_set_filter(w->crowd->world, to, &m->filters[to]);
}

int soak_machine_act(struct soak_world *w, long frame)
{
    struct soak_machine *m = w->machine;
    int error = CAROM_OK;

    for (int i = 0; i < w->crowd->body_count; i++) {
        if (w->crowd->bodies[i].def.kinematic) {
            soak_lead(w->crowd->world, i, &m->leaders[i], frame, &m->r);
        }
    }
    if (m->joint_count > 0 && soak_pick(&m->r, 60) == 0) {
        error = change_joint(w);
    }
    if (m->filtered && soak_pick(&m->r, 60) == 0 && error >= 0) {
        error = change_filter(w);
    }
    soak_machine_let_pass(w);
    return error;
}

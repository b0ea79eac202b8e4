/* SPDX-License-Identifier: MIT */
/* Calls as bytes: one description of each call serves the writer and the reader. */
#include "../num/fnv.h"
#include "call.h"

/* ------------------------------------------------------------------- numbers */

static uint8_t code_byte(struct replay_coder *c, uint8_t byte)
{
    if (c->at >= c->size) {
        c->bad = true;
        return 0;
    }
    if (c->out) {
        c->out[c->at] = byte;
    }
    return c->out ? c->out[c->at++] : c->in[c->at++];
}

/* Seven bits a byte, the lowest first. The sign is the lowest bit of all, so small numbers are short. */
static uint64_t fold_sign(int64_t v)
{
    return v < 0 ? ~((uint64_t)v << 1) : (uint64_t)v << 1;
}

static int64_t unfold_sign(uint64_t v)
{
    return (int64_t)(v >> 1 ^ (v & 1 ? UINT64_MAX : 0));
}

int64_t replay_number(struct replay_coder *c, int64_t value, int64_t low, int64_t high)
{
    uint64_t left = fold_sign(value), read = 0;
    uint32_t shift = 0;
    uint8_t byte;

    do {
        byte = code_byte(c, (uint8_t)((left & 0x7f) | (left > 0x7f ? 0x80 : 0)));
        read |= (uint64_t)(byte & 0x7f) << shift;
        left >>= 7;
        shift += 7;
    } while (byte & 0x80 && shift < 64);
    value = unfold_sign(read);
    if (c->bad || value < low || value > high) {
        c->bad = true;
        return low <= 0 ? 0 : low; /* no range lies below 0 */
    }
    return value;
}

uint64_t replay_fixed(struct replay_coder *c, uint64_t value, int bytes)
{
    uint64_t read = 0;

    for (int i = 0; i < bytes; i++) {
        read |= (uint64_t)code_byte(c, (uint8_t)(value >> 8 * i)) << 8 * i;
    }
    return read;
}

static void code_i64(struct replay_coder *c, int64_t *v)
{
    *v = replay_number(c, *v, INT64_MIN, INT64_MAX);
}

static void code_i32(struct replay_coder *c, int32_t *v)
{
    *v = (int32_t)replay_number(c, *v, INT32_MIN, INT32_MAX);
}

static void code_u32(struct replay_coder *c, uint32_t *v)
{
    *v = (uint32_t)replay_number(c, *v, 0, UINT32_MAX);
}

static void code_u16(struct replay_coder *c, uint16_t *v)
{
    *v = (uint16_t)replay_number(c, *v, 0, UINT16_MAX);
}

static void code_u8(struct replay_coder *c, uint8_t *v)
{
    *v = (uint8_t)replay_number(c, *v, 0, UINT8_MAX);
}

static void code_bool(struct replay_coder *c, bool *v)
{
    *v = replay_number(c, *v, 0, 1) != 0;
}

static void code_three(struct replay_coder *c, int64_t v[3])
{
    for (int k = 0; k < 3; k++) {
        code_i64(c, &v[k]);
    }
}

static void code_rotation(struct replay_coder *c, carom_quat_q30 *q)
{
    for (int k = 0; k < 4; k++) {
        code_i32(c, &q->c[k]);
    }
}

/* ------------------------------------------------------------- what is given */

static void code_config(struct replay_coder *c, struct carom_config *g)
{
    bool asks = g->contact != NULL;

#define CODE_CAP(name, bytes, low, high) code_u32(c, &g->caps.name);
    CAROM_POOLS(CODE_CAP)
#undef CODE_CAP
    code_three(c, g->gravity.c);
    code_bool(c, &g->sleep);
    code_u8(c, &g->substep_cap);
    code_u8(c, &g->sweep_cap);
    code_bool(c, &asks);
    if (c->in) { /* the player sets its own function */
        g->contact_user = asks ? g : NULL;
    }
}

static void code_filter(struct replay_coder *c, struct carom_filter *f)
{
    code_u16(c, &f->category);
    code_u16(c, &f->mask);
    f->group = (int16_t)replay_number(c, f->group, INT16_MIN, INT16_MAX);
}

static void code_def(struct replay_coder *c, struct carom_body_def *d)
{
    code_bool(c, &d->stationary);
    code_bool(c, &d->kinematic);
    code_three(c, d->position.c);
    code_rotation(c, &d->rotation);
    code_three(c, d->velocity.c);
    code_three(c, d->spin.c);
    code_u32(c, &d->mass_q20);
    code_i32(c, &d->restitution_q30);
    code_u32(c, &d->friction_q16);
    code_filter(c, &d->filter);
    code_bool(c, &d->sensor);
    code_u8(c, &d->one_way);
    code_u8(c, &d->overlap);
}

static void code_state(struct replay_coder *c, struct carom_body_state *s)
{
    code_three(c, s->position.c);
    code_rotation(c, &s->rotation);
    code_three(c, s->velocity.c);
    code_three(c, s->spin.c);
    code_u8(c, &s->overlap);
}

void replay_material(struct replay_coder *c, struct carom_material *m)
{
    code_i32(c, &m->restitution_q30);
    code_u32(c, &m->friction_q16);
    code_u32(c, &m->rolling_q16);
    code_three(c, m->surface_velocity.c);
}

static void code_drive(struct replay_coder *c, struct carom_joint_drive *d)
{
    code_bool(c, &d->limited);
    code_i64(c, &d->lower_q32);
    code_i64(c, &d->upper_q32);
    code_bool(c, &d->motor);
    code_i64(c, &d->motor_speed_q40);
    code_i64(c, &d->motor_most_q40);
    code_bool(c, &d->spring);
    code_i64(c, &d->rest_q32);
    code_i64(c, &d->stiffness_q40);
    code_i64(c, &d->damping_q40);
}

static void code_joint(struct replay_coder *c, struct carom_joint_def *d)
{
    code_u8(c, &d->kind);
    code_bool(c, &d->touch);
    d->a = (int)replay_number(c, d->a, INT32_MIN, INT32_MAX);
    d->b = (int)replay_number(c, d->b, INT32_MIN, INT32_MAX);
    code_three(c, d->anchor.c);
    code_three(c, d->anchor_b.c);
    for (int k = 0; k < 3; k++) {
        code_i32(c, &d->axis.c[k]);
    }
    code_drive(c, &d->drive);
    code_i64(c, &d->most_impulse_q40);
}

void replay_joint(struct replay_coder *c, struct joint *j)
{
    code_bool(c, &j->used);
    if (!j->used) {
        return;
    }
    code_u8(c, &j->kind);
    code_bool(c, &j->touch);
    code_u16(c, &j->a);
    code_u16(c, &j->b);
    for (int s = 0; s < 2; s++) {
        code_three(c, j->arm[s].c);
        code_rotation(c, &j->frame[s]);
    }
    code_i64(c, &j->most_impulse_q40);
}

/* --------------------------------------------------------------------- calls */

/* Arguments of calls that act by a vector, a place or numbers. */
static void code_act(struct replay_coder *c, struct replay_call *call)
{
    switch (call->op) {
    case CAROM_CALL_body_set_force_at:
    case CAROM_CALL_body_push:
        code_three(c, call->u.act.vector.c);
        code_three(c, call->u.act.point.c);
        break;
    case CAROM_CALL_world_set_gravity:
    case CAROM_CALL_body_set_force:
    case CAROM_CALL_body_set_torque:
    case CAROM_CALL_body_push_centre:
    case CAROM_CALL_body_twist:
        code_three(c, call->u.act.vector.c);
        break;
    case CAROM_CALL_world_set_combine:
    case CAROM_CALL_body_set_damping:
    case CAROM_CALL_body_set_gravity_scale:
    case CAROM_CALL_body_set_mass:
        for (int k = 0; k < 2; k++) { /* all are 32 bits; a mass has no sign */
            call->u.numbers[k] = replay_number(c, call->u.numbers[k], INT32_MIN, UINT32_MAX);
        }
        break;
    case CAROM_CALL_body_set_face_materials:
        code_u32(c, &call->faces);
        code_u32(c, &call->count);
        break;
    case CAROM_CALL_surface_move:
    case CAROM_CALL_surface_set:
    case CAROM_CALL_snapshot_load:
        code_u32(c, &call->count);
        break;
    default:
        break;
    }
}

void replay_code(struct replay_coder *c, struct replay_call *call)
{
    if (call->op != CAROM_CALL_world_step && call->op != CAROM_CALL_world_init) {
        code_i32(c, &call->body);
    }
    switch (call->op) {
    case CAROM_CALL_world_init:
        code_config(c, &call->u.config);
        break;
    case CAROM_CALL_body_add:
        code_u32(c, &call->mesh);
        code_def(c, &call->u.def);
        break;
    case CAROM_CALL_body_set:
        code_state(c, &call->u.state);
        break;
    case CAROM_CALL_body_move_to:
        code_three(c, call->u.pose.position.c);
        code_rotation(c, &call->u.pose.rotation);
        break;
    case CAROM_CALL_body_set_filter:
        code_filter(c, &call->u.filter);
        break;
    case CAROM_CALL_body_set_material:
        replay_material(c, &call->u.material);
        break;
    case CAROM_CALL_joint_add:
        code_joint(c, &call->u.joint);
        break;
    case CAROM_CALL_joint_set:
        code_drive(c, &call->u.drive);
        break;
    default:
        code_act(c, call);
        break;
    }
}

bool replay_is_of_body(uint8_t op)
{
    return op >= CAROM_CALL_body_remove && op <= CAROM_CALL_surface_set;
}

bool replay_has_data(uint8_t op)
{
    return op == CAROM_CALL_body_set_face_materials || op == CAROM_CALL_surface_move ||
           op == CAROM_CALL_surface_set || op == CAROM_CALL_snapshot_load;
}

/* ------------------------------------------------------------ calls that come again */

uint32_t replay_find(const struct carom_replay_memory *m, const uint8_t *bytes, size_t size)
{
    for (uint32_t i = 0; i < CAROM_REPLAY_SLOTS; i++) {
        if (m->slots[i].size == size && memcmp(m->slots[i].bytes, bytes, size) == 0) {
            return i;
        }
    }
    return UINT32_MAX;
}

void replay_follow(struct carom_replay_memory *m, uint32_t slot)
{
    m->slots[m->last].next = (uint8_t)slot;
    m->last = (uint8_t)slot;
}

void replay_keep(struct carom_replay_memory *m, const uint8_t *bytes, size_t size)
{
    struct carom_replay_slot *slot = &m->slots[m->fresh];

    if (size > CAROM_REPLAY_SLOT_BYTES) {
        return;
    }
    slot->size = (uint8_t)size;
    memcpy(slot->bytes, bytes, size);
    replay_follow(m, m->fresh);
    m->fresh = (uint8_t)((m->fresh + 1) % CAROM_REPLAY_SLOTS);
}

uint32_t replay_sum(uint32_t sum, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        sum = fnv32_add(sum, bytes[i]);
    }
    return sum;
}

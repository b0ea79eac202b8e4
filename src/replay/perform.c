/* SPDX-License-Identifier: MIT */
/* Make a recorded call on a world, for the player; its name and what counts of its result, for the recorder, too. */
#include "call.h"

static int do_act(struct carom_world *w, const struct replay_call *c)
{
    const carom_v3_q40 *vector = &c->u.act.vector;

    switch (c->op) {
    case CAROM_CALL_world_set_gravity:
        return carom_world_set_gravity(w, vector);
    case CAROM_CALL_body_set_force:
        return carom_body_set_force(w, c->body, vector);
    case CAROM_CALL_body_set_force_at:
        return carom_body_set_force_at(w, c->body, vector, &c->u.act.point);
    case CAROM_CALL_body_set_torque:
        return carom_body_set_torque(w, c->body, vector);
    case CAROM_CALL_body_push:
        return carom_body_push(w, c->body, vector, &c->u.act.point);
    case CAROM_CALL_body_push_centre:
        return carom_body_push_centre(w, c->body, vector);
    default: /* a player makes worlds and steps itself, and no other call is left */
        CAROM_ASSERT(c->op == CAROM_CALL_body_twist);
        return carom_body_twist(w, c->body, vector);
    }
}

static int do_numbers(struct carom_world *w, const struct replay_call *c)
{
    const int64_t *n = c->u.numbers;

    switch (c->op) {
    case CAROM_CALL_world_set_combine:
        return carom_world_set_combine(w, (enum carom_combine)n[0], (enum carom_combine)n[1]);
    case CAROM_CALL_body_set_gravity_scale:
        return carom_body_set_gravity_scale(w, c->body, (int32_t)n[0]);
    case CAROM_CALL_body_set_damping:
        return carom_body_set_damping(w, c->body, (int32_t)n[0], (int32_t)n[1]);
    case CAROM_CALL_body_set_mass:
        return carom_body_set_mass(w, c->body, (uint32_t)n[0]);
    default:
        return do_act(w, c);
    }
}

static int do_data(struct carom_world *w, const struct replay_call *c)
{
    switch (c->op) {
    case CAROM_CALL_body_set_face_materials:
        return carom_body_set_face_materials(w, c->body, (const struct carom_material *)c->data,
                                             c->count, c->of_face);
    case CAROM_CALL_surface_move:
        return carom_surface_move(w, c->body, c->vertices);
    case CAROM_CALL_surface_set:
        return carom_surface_set(w, c->body, c->vertices);
    case CAROM_CALL_snapshot_load:
        return carom_snapshot_load(w, c->data, c->count);
    default:
        return do_numbers(w, c);
    }
}

int replay_do(struct carom_world *w, const struct replay_call *c)
{
    switch (c->op) {
    case CAROM_CALL_body_add:
        return carom_body_add(w, &c->u.def);
    case CAROM_CALL_body_remove:
        return carom_body_remove(w, c->body);
    case CAROM_CALL_body_set:
        return carom_body_set(w, c->body, &c->u.state);
    case CAROM_CALL_body_move_to:
        return carom_body_move_to(w, c->body, &c->u.pose);
    case CAROM_CALL_body_set_filter:
        return carom_body_set_filter(w, c->body, &c->u.filter);
    case CAROM_CALL_body_set_material:
        return carom_body_set_material(w, c->body, &c->u.material);
    case CAROM_CALL_joint_add:
        return carom_joint_add(w, &c->u.joint);
    case CAROM_CALL_joint_remove:
        return carom_joint_remove(w, c->body);
    case CAROM_CALL_joint_set:
        return carom_joint_set(w, c->body, &c->u.drive);
    default:
        return do_data(w, c);
    }
}

int replay_result(uint8_t op, int result)
{
    return op == CAROM_CALL_world_step && result > 0 ? result & ~CAROM_OVER_BUDGET : result;
}

const char *carom_replay_call_name(int call)
{
    static const char *const names[CAROM_CALL_COUNT] = {"none",
#define NAME(name) "carom_" #name,
                                                        CAROM_REPLAY_CALLS(NAME)
#undef NAME
    };

    return call >= 0 && call < CAROM_CALL_COUNT ? names[call] : "unknown";
}

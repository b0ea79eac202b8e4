/* SPDX-License-Identifier: MIT */
/* Kinematic bodies between steps: the caller leads them. */
#include "world.h"

bool world_is_kinematic(const struct body *b)
{
    return b->def.extra && b->def.extra->kinematic;
}

bool world_drive_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *spin)
{
    return world_motion_in_range(b, v, spin) && fix_length(spin->c) <= WORLD_ROUTE_SPIN_MAX_Q40;
}

bool world_leads(const struct body_drive *drive, const struct body_state *s)
{
    if (drive->kind == BODY_DRIVE_TO) {
        return memcmp(&drive->position, &s->position, sizeof s->position) != 0 ||
               memcmp(&drive->rotation, &s->rotation, sizeof s->rotation) != 0;
    }
    return drive->kind == BODY_DRIVE_ON;
}

void world_drive(struct carom_world *w, uint32_t body, const struct body_drive *drive)
{
    struct body *b = &w->bodies[body];

    b->def.extra->drive = *drive;
    b->def.goes = world_leads(drive, &world_now(w)->bodies[body]);
    if (!b->def.goes) {
        b->def.extra->drive.kind = BODY_DRIVE_NONE;
        return;
    }
    w->idle = false;
    if (w->joint_steps) {
        w->joint_steps->wake_led(w, (uint16_t)body);
    }
}

struct body_drive world_drive_on(const carom_v3_q40 *v, const carom_v3_q40 *spin)
{
    struct body_drive drive = {.kind = BODY_DRIVE_NONE};

    if ((fix_sum(v->c) | fix_sum(spin->c)) != 0) {
        drive.kind = BODY_DRIVE_ON;
        drive.velocity = *v;
        drive.spin = *spin;
    }
    return drive;
}

bool world_pose_in_reach(const struct body *b, const struct body_state *s,
                         const carom_v3_q32 *position, const carom_quat_q30 *rotation)
{
    struct body_route route;
    int64_t way_q32[3];

    if (!world_position_in_range(position)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        way_q32[k] = position->c[k] - s->position.c[k];
    }
    if (!world_each_within(way_q32, (int64_t)BODY_SPEED_LIMIT << 32)) {
        return false;
    }
    body_route_to(b, s, position, rotation, &route);
    return world_motion_in_range(b, &route.velocity, &route.spin);
}

int carom_body_move_to(struct carom_world *w, int body, const struct carom_pose *pose)
{
    struct body_drive drive = {.kind = BODY_DRIVE_TO};
    const struct body_state *s;
    carom_quat_q30 q;

    if (!w || !pose) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    q = pose->rotation;
    /* a rotation that is normalised already is kept to the last bit */
    if (!world_is_kinematic(&w->bodies[body]) ||
        !(world_is_unit(q.c, 4, 28) || world_rotation_valid(&q))) {
        return CAROM_ERR_ARGUMENT;
    }
    s = &world_now(w)->bodies[body];
    if (!world_pose_in_reach(&w->bodies[body], s, &pose->position, &q)) {
        return CAROM_ERR_RANGE;
    }
    drive.position = pose->position;
    drive.rotation = q;
    w->route_to = body_route_to;
    world_drive(w, (uint32_t)body, &drive);
    return CAROM_OK;
}

void world_halt_routes(struct carom_world *w)
{
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        if (b->def.mesh && body_travels(b)) {
            /* a step relies on bodies that stand still being equal in both states */
            w->states[0].bodies[i] = w->states[1].bodies[i] = w->now->bodies[i];
            b->def.goes = b->def.extra->drive.kind == BODY_DRIVE_ON;
            b->def.extra->drive.kind = b->def.goes ? BODY_DRIVE_ON : BODY_DRIVE_NONE;
        }
    }
}

/* SPDX-License-Identifier: MIT */
#include "scene_games.h"

int scene_part(struct scene_parts *parts, int mesh, const struct carom_body_def *def)
{
    struct carom_body_def own = *def;
    const int64_t c = def->rotation.c[0], s = def->rotation.c[3];
    const carom_v3_q22 *centre;
    int64_t cosine_q30 = CAROM_ONE_Q30, sine_q30 = 0;

    own.mesh = parts->scene->mesh[mesh];
    centre = &own.mesh->mass.centre;
    /* parts whose centre is not in their origin start as they are, or turned about z */
    if (s != 0) {
        cosine_q30 = (c * c - s * s) / CAROM_ONE_Q30;
        sine_q30 = 2 * c * s / CAROM_ONE_Q30;
    }
    own.position.c[0] += (cosine_q30 * centre->c[0] - sine_q30 * centre->c[1]) / (1 << 20);
    own.position.c[1] += (sine_q30 * centre->c[0] + cosine_q30 * centre->c[1]) / (1 << 20);
    own.position.c[2] += (int64_t)centre->c[2] * 1024;
    if (parts->result >= 0) {
        parts->result = carom_body_add(parts->world, &own);
    }
    return parts->result;
}

int scene_joint(struct scene_parts *parts, const struct carom_joint_def *def)
{
    if (parts->result >= 0) {
        parts->result = carom_joint_add(parts->world, def);
    }
    return parts->result;
}

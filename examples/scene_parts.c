/* SPDX-License-Identifier: MIT */
/* Helpers of the game scenes: add bodies and joints, throw a body, write text. */
#include "scene_games.h"

#include <string.h>

#include "carom_body.h"

int scene_part(struct scene_parts *parts, int mesh, const struct carom_body_def *def)
{
    struct carom_body_def own = *def;
    const int64_t c = def->rotation.c[0], s = def->rotation.c[3];
    const carom_v3_q22 *centre;
    int64_t cosine_q30 = CAROM_ONE_Q30, sine_q30 = 0;

    own.mesh = parts->scene->mesh[mesh];
    centre = &own.mesh->mass.centre;
    /* parts whose centre is not at their origin start unturned, or turned about z */
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

int scene_game_before(const struct scene_game *game, struct carom_world *world, int frame,
                      uint32_t keys)
{
    if (keys == SCENE_NOBODY) {
        keys = game->script ? game->script(world, frame) : 0;
    }
    return game->before ? game->before(world, frame, keys) : CAROM_OK;
}

int scene_throw(struct carom_world *world, int body, const carom_v3_q32 *from,
                const carom_v3_q40 *velocity)
{
    const int64_t slow_q40 = CAROM_VELOCITY_MM_S(500, FPS);
    struct carom_body_state state;
    int result = carom_body_get(world, body, &state);

    for (int k = 0; k < 3; k++) {
        if (result < 0 || state.velocity.c[k] > slow_q40 || state.velocity.c[k] < -slow_q40) {
            return result;
        }
    }
    state = (struct carom_body_state){.position = *from, .velocity = *velocity};
    state.rotation.c[0] = CAROM_ONE_Q30;
    result = carom_body_set(world, body, &state);
    return result == CAROM_ERR_OVERLAP ? CAROM_OK : result;
}

int64_t scene_upright(const struct carom_world *world, int body)
{
    static const int64_t up_q30[3] = {0, 0, CAROM_ONE_Q30};
    int64_t out_q30[3] = {0};

    carom_body_world_vector(world, body, up_q30, out_q30);
    return out_q30[2];
}

/* --------------------------------------------------------------------- pictures */

#define TWO(ramp)   ramp, ramp
#define GREEN_A     TWO(SCENE_GREEN), TWO(SCENE_MEADOW)
#define GREEN_B     TWO(SCENE_MEADOW), TWO(SCENE_GREEN)
#define ROW(square) square, square, square, square, square, square, square, square
#define ROWS        ROW(GREEN_A), ROW(GREEN_B)
/* Squares of two faces. */
const uint8_t scene_yard_faces[YARD_FACES] = {ROWS, ROWS, ROWS, ROWS, ROWS, ROWS, ROWS, ROWS};

char *scene_say_number(char *text, int number, const char *words)
{
    char digits[12];
    int count = 0;

    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) {
        *text++ = digits[--count];
    }
    while (*words) {
        *text++ = *words++;
    }
    *text = 0;
    return text;
}

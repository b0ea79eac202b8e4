/* SPDX-License-Identifier: MIT */
/* The pad of a board plays with a scene: keys, frame rate, figures. */
#include "scene_play.h"

#include <string.h>

#define FPS         60
#define UNDRAWN_MAX 3

/* Upwards, a little off the centre, so that the body turns. */
#define THROW_MM_S 3500
#define THROW_X_MM 200
#define THROW_Y_MM (-300)
#define FALLEN_MM  (-12000)
/* Gravity tilted by 20 degrees. */
#define GRAVITY(thousandths) CAROM_GRAVITY_MM_S2(-9810 * (thousandths) / 1000, FPS)
#define UPRIGHT              1000
#define TILTED_UP            940
#define TILTED_ASIDE         342

static carom_v3_q40 gravity_of(uint32_t keys)
{
    int x = !!(keys & PORT_PAD_LEFT) - !!(keys & PORT_PAD_RIGHT);
    int y = !!(keys & PORT_PAD_DOWN) - !!(keys & PORT_PAD_UP);

    return (carom_v3_q40){{GRAVITY(x * TILTED_ASIDE), GRAVITY(y * TILTED_ASIDE),
                           GRAVITY(x != 0 || y != 0 ? TILTED_UP : UPRIGHT)}};
}

/* The mass is the volume: scenes set none. */
static void throw_up(const struct scene *scene, struct carom_world *world, carom_v3_q32 centre)
{
    int64_t mass_q16 = scene->body.mesh->mass.volume_q32 >> 16;
    int64_t speed_q24 = CAROM_VELOCITY_MM_S(THROW_MM_S, FPS) >> 16;
    carom_v3_q40 impulse = {{0, 0, mass_q16 * speed_q24}};

    centre.c[0] += CAROM_POSITION_MM(THROW_X_MM);
    centre.c[1] += CAROM_POSITION_MM(THROW_Y_MM);
    carom_body_push(world, SCENE_BODY, &impulse,
                    &centre); /* a body that would become too fast stays as it is */
}

bool scene_play_keys(struct scene_play *play, const struct scene *scene, struct carom_world *world,
                     uint32_t keys)
{
    uint32_t pressed = keys & ~play->held;
    carom_v3_q40 gravity = gravity_of(keys);
    struct carom_body_state state;

    play->held = keys;
    play->lines ^= (pressed & PORT_PAD_SELECT) != 0;
    play->plain ^= (pressed & PORT_PAD_B) != 0;
    if (carom_body_get(world, SCENE_BODY, &state) < 0 || (pressed & PORT_PAD_START) ||
        state.position.c[2] < CAROM_POSITION_MM(FALLEN_MM)) {
        return false;
    }
    if (scene->game) {
        return true; /* a game reads the other keys itself */
    }
    if (pressed & PORT_PAD_A) {
        throw_up(scene, world, state.position);
    }
    carom_world_set_gravity(world, &gravity);
    return true;
}

bool scene_play_draws(struct scene_play *play)
{
    bool late = (int32_t)(port_ticks() - play->due) > 0;

    if (late && play->undrawn < UNDRAWN_MAX) {
        play->undrawn++;
        play->due += port_ticks_hz / FPS;
        return false;
    }
    while ((int32_t)(port_ticks() - play->due) < 0) {
    }
    /* lost time is not made up for */
    play->due = (late ? port_ticks() : play->due) + port_ticks_hz / FPS;
    play->undrawn = 0;
    return true;
}

/* ------------------------------------------------------------------ figures */

/* Digits of 3 x 5 pixels: an octal digit for each row, the top row first. */
#define DIGIT_COLUMNS 3
#define DIGIT_ROWS    5
static const uint16_t digits[10] = {075557, 026227, 071747, 071717, 055711,
                                    074717, 074757, 071111, 075757, 075717};

static void set_pixel(void *row, uint8_t format, int32_t x, bool white)
{
    switch (format) {
    case PORT_PALETTE8:
        ((uint8_t *)row)[x] = white ? 255 : 0;
        break;
    case PORT_XRGB8888:
        ((uint32_t *)row)[x] = white ? 0xffffff : 0;
        break;
    default:
        ((uint16_t *)row)[x] = white ? 0xffff : 0;
        break;
    }
}

/* Draw a number in one line of digits; it ends left of column x. */
static void put_number(void *row, uint8_t format, int32_t x, int32_t line, uint32_t number)
{
    do {
        uint32_t shape = digits[number % 10] >> (DIGIT_ROWS - 1 - line) * DIGIT_COLUMNS;

        x -= DIGIT_COLUMNS + 1;
        for (int32_t i = 0; i < DIGIT_COLUMNS; i++) {
            set_pixel(row, format, x + i, shape >> (DIGIT_COLUMNS - 1 - i) & 1);
        }
        number /= 10;
    } while (number > 0);
}

void scene_play_figures(const struct port_fb *fb, uint32_t step, uint32_t draw)
{
    for (int32_t y = fb->height - SCENE_PLAY_ROWS; y < fb->height; y++) {
        int32_t line = y - (fb->height - 2 - DIGIT_ROWS);
        void *row =
            fb->row ? fb->row(NULL, 0, fb->width, y) : (uint8_t *)fb->pixels + y * fb->stride;

        for (int32_t x = 0; x < fb->width; x++) {
            set_pixel(row, fb->format, x, false);
        }
        if (line >= 0 && line < DIGIT_ROWS) {
            put_number(row, fb->format, fb->width / 3, line, step);
            put_number(row, fb->format, 2 * fb->width / 3, line, draw);
            put_number(row, fb->format, fb->width, line, step + draw);
        }
    }
}

/* SPDX-License-Identifier: MIT */
/*
 * scene_games.h - scenes that are more than bodies: joints, bodies that are led, belts, sensors, rays. Each
 * is a function that puts the bodies and joints into a world and one that goes on before each frame, by the keys of
 * a pad. While nobody plays a script presses them, which goes by the world and the number of the frame alone.
 */
#ifndef CAROM_SCENE_GAMES_H
#define CAROM_SCENE_GAMES_H

#include "carom_joint.h"
#include "models.h"
#include "scene.h"

#define FPS 60
#define POSITION(x, y, z)                                                                          \
    {                                                                                              \
        {                                                                                          \
            CAROM_POSITION_MM(x), CAROM_POSITION_MM(y), CAROM_POSITION_MM(z)                       \
        }                                                                                          \
    }
#define VELOCITY(x, y, z)                                                                          \
    {                                                                                              \
        {                                                                                          \
            CAROM_VELOCITY_MM_S(x, FPS), CAROM_VELOCITY_MM_S(y, FPS), CAROM_VELOCITY_MM_S(z, FPS)  \
        }                                                                                          \
    }
#define SPIN(x, y, z)                                                                              \
    {                                                                                              \
        {                                                                                          \
            CAROM_SPIN_MRAD_S(x, FPS), CAROM_SPIN_MRAD_S(y, FPS), CAROM_SPIN_MRAD_S(z, FPS)        \
        }                                                                                          \
    }

/* NULL in the place of a function: the game does not do that. */
struct scene_game {
    struct carom_caps caps;
    struct carom_camera camera;
    /* Add the bodies but the ground, and the joints. Returns >= 0 or an error. */
    int (*fill)(const struct scene *scene, struct carom_world *world);
    /* The keys that it presses before a frame while nobody plays: a sum of enum port_pad. */
    uint32_t (*script)(const struct carom_world *world, int frame);
    /* Prepares a frame, 1 being the first, with these keys held; NULL: nothing to do. Returns >= 0 or an error. */
    int (*before)(struct carom_world *world, int frame, uint32_t keys);
    /* Take the camera along; NULL: it stays. */
    void (*look)(const struct carom_world *world, struct carom_camera *camera);
    /* A line of text over the picture. */
    void (*say)(const struct carom_world *world, char text[SCENE_TEXT]);
    /* How bodies look, by their numbers: ramps of scene_paint's palette. NULL: as usual. */
    const struct carom_body_paint *paints;
    uint32_t paint_count;
    const uint32_t
        *rgb; /* SCENE_RAMPS colours, 0x00RRGGBB, the first not used; NULL: the usual ones */
};

/* Prepare a frame of a game. Returns >= 0 or an error. */
int scene_game_before(const struct scene_game *game, struct carom_world *world, int frame,
                      uint32_t keys);

/*
 * Colours of games, by the ramps of carom_draw_palette that they stand in: a display with a palette of its own
 * shows those.
 */
enum scene_ramp {
    SCENE_GREEN = CAROM_RAMP_STATIONARY,
    SCENE_WOOD = CAROM_RAMP_MOVING,
    SCENE_RED = CAROM_RAMP_STATIONARY_HOT,
    SCENE_YELLOW = CAROM_RAMP_MOVING_HOT,
    SCENE_MEADOW = CAROM_RAMP_BLUE,
    SCENE_DARK = CAROM_RAMP_VIOLET,
    SCENE_RAMPS
};
/* The squares of the yard, in two greens. */
extern const uint8_t scene_yard_faces[YARD_FACES];
/*
 * How a scene looks: that of a game by its paints; else (NULL, or without any) its bodies have colours in turn, and faces that
 * interfere are pink. It is there once, and good until the next call. scene_look.c
 */
const struct carom_paint *scene_paint(const struct scene_game *game);
/* Write a number and some words; returns where the text goes on. */
char *scene_say_number(char *text, int number, const char *words);

extern const struct scene_game scene_door, scene_chain, scene_crusher, scene_conveyor, scene_car,
    scene_walker, scene_lockstep, scene_gears, scene_screw, scene_newton, scene_dominoes,
    scene_cards, scene_arch, scene_bowl, scene_pour, scene_espresso, scene_espresso_fine;

/* Numbers of bodies and joints, in the order in which `fill` adds them. */
enum { DOOR_LEAF = SCENE_BODY, DOOR_BALL };
enum { DOOR_HINGE };
#define DOOR_OPEN_MRAD 1400
#define CHAIN_LINKS    20
enum { CRUSHER_BLOCK = SCENE_BODY, CRUSHER_BOX };
enum { CONVEYOR_BELT = SCENE_BODY, CONVEYOR_BOX };
#define CONVEYOR_BOXES  4
#define CONVEYOR_MM_S   1000
#define CRUSHER_FRAMES  240 /* down and up */
#define CRUSHER_WAY_MM  1400
#define CRUSHER_HIGH_MM 2000

/* The car: each wheel has a hub; the front ones turn about the upright, the rear ones go up and down. */
#define CAR_WHEELS  4
#define CAR_RAMPS   3
#define CAR_TOWERS  3
#define CAR_PICKUPS 8
enum {
    CAR_CHASSIS = SCENE_BODY,
    CAR_HUB,
    CAR_WHEEL = CAR_HUB + CAR_WHEELS,
    CAR_RAMP = CAR_WHEEL + CAR_WHEELS,
    CAR_TOWER = CAR_RAMP + CAR_RAMPS,
    CAR_PICKUP = CAR_TOWER + CAR_TOWERS
};
enum { CAR_MOUNT, CAR_AXLE = CAR_MOUNT + CAR_WHEELS }; /* joints */
enum {
    WALKER = SCENE_BODY,
    WALKER_STEPS,
    WALKER_PLATFORM,
    WALKER_RAMP,
    WALKER_DOOR,
    WALKER_MAT,
    WALKER_WALL,
    WALKER_BLOCK = WALKER_WALL + 2,
    WALKER_CRATE
};

/* Two rinks of as many bodies each, and packets that fly over them. */
#define LOCKSTEP_RINK_BODIES 7
#define LOCKSTEP_DELAY       9 /* ticks; the longest there is in the scene */
#define LOCKSTEP_BODIES      (1 + 2 * LOCKSTEP_RINK_BODIES + 2 * LOCKSTEP_DELAY)

/* Wheels, each with a hinge of the same number less one; then the board behind them. */
#define GEARS 4
enum { GEARS_FIRST = SCENE_BODY, GEARS_BOARD = GEARS_FIRST + GEARS };
#define GEARS_TEETH                                                                                \
    {                                                                                              \
        10, 24, 16, 12                                                                             \
    }
#define GEARS_TURNS_A_MINUTE 48 /* of the first */

/* Lengths as in tools/machines.py. */
enum { SCREW_NUT = SCENE_BODY, SCREW_BOLT, SCREW_HEAD };
#define SCREW_PITCH_MM 400
#define SCREW_PLAY_MM  12   /* of the nut on the bolt, to either side */
#define SCREW_WAY_MM   1750 /* down to the head */

/* The cradle: its frame is after the balls. The script lifts others after so many frames. */
#define NEWTON_BALLS  5
#define NEWTON_FRAMES 320
enum { NEWTON_BALL = SCENE_BODY };
/* The row of dominoes, and what runs into it. */
#define DOMINOES       40
#define DOMINOES_START 20 /* the frame in which the script throws */
enum { DOMINOES_FIRST = SCENE_BODY, DOMINOES_BALL = DOMINOES_FIRST + DOMINOES };
/* The house of cards: 12 that lean, 3 that lie. */
#define CARDS_STOREYS 3
#define CARDS         15
#define CARDS_START   240
enum { CARDS_FIRST = SCENE_BODY, CARDS_BALL = CARDS_FIRST + CARDS, CARDS_TOP = CARDS_BALL - 2 };
/* The arch: the keystone and pairs beside it, plinths, the ball. */
#define ARCH_STONES 13
#define ARCH_START  240
enum { ARCH_KEYSTONE = SCENE_BODY, ARCH_BALL = ARCH_KEYSTONE + ARCH_STONES + 2 };
/* The bowl and what falls into it. */
#define BOWL_PIECES 6
#define BOWL_TOSS   540
enum { BOWL = SCENE_BODY, BOWL_PIECE };
/* Things of four shapes in turn, then what they are poured out of and into. */
#define POUR_THINGS 32
enum { POUR_THING = SCENE_BODY, POUR_BUCKET = POUR_THING + POUR_THINGS, POUR_TRAY };
#define POUR_FRAMES 720 /* until all that was poured lies still and the bucket is up again */

/* A builder puts parts into a world: after the first error it adds nothing more. */
struct scene_parts {
    const struct scene *scene;
    struct carom_world *world;
    int result;
};
/* A body of the scene's i-th mesh, whose origin is at def->position. Returns its number. */
int scene_part(struct scene_parts *parts, int mesh, const struct carom_body_def *def);
/* A joint. Returns its number. */
int scene_joint(struct scene_parts *parts, const struct carom_joint_def *def);

/*
 * Throw a body that is slow from a place, upright; one that is faster than 0.5 m/s goes on. So a key may be held. Returns
 * >= 0 or an error; that something is in the way is none.
 */
int scene_throw(struct carom_world *world, int body, const carom_v3_q32 *from,
                const carom_v3_q40 *velocity);
/* How far a body's z axis points up: the cosine of its lean, q30. */
int64_t scene_upright(const struct carom_world *world, int body);

#endif

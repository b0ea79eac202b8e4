/* SPDX-License-Identifier: MIT */
/*
 * scene_games.h - scenes with more than bodies: joints, kinematic bodies, belts, sensors, rays.
 *
 * Each scene is a function that adds bodies and joints to a world, and one that runs before each
 * frame with the keys of a pad. While nobody plays, a script presses keys; it depends only on the
 * world and on the number of the frame.
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

/* A function may be NULL: the game has none. */
struct scene_game {
    struct carom_caps caps;
    struct carom_camera camera;
    /* Add the bodies except the ground, and the joints. Returns >= 0 or an error. */
    int (*fill)(const struct scene *scene, struct carom_world *world);
    /* The keys that the script presses before a frame: a sum of enum port_pad. */
    uint32_t (*script)(const struct carom_world *world, int frame);
    /* Prepare a frame, from 1 on, with these keys held; NULL: nothing to do. Returns >= 0 or an error. */
    int (*before)(struct carom_world *world, int frame, uint32_t keys);
    /* Move the camera; NULL: it stays. */
    void (*look)(const struct carom_world *world, struct carom_camera *camera);
    /* Write a line of text for the picture. */
    void (*say)(const struct carom_world *world, char text[SCENE_TEXT]);
    /* The look of bodies, by body number: ramps of scene_paint's palette. NULL: the default. */
    const struct carom_body_paint *paints;
    uint32_t paint_count;
    const uint32_t
        *rgb; /* SCENE_RAMPS colours, 0x00RRGGBB, the first unused; NULL: the default ones */
};

/* Prepare a frame of a game. Returns >= 0 or an error. */
int scene_game_before(const struct scene_game *game, struct carom_world *world, int frame,
                      uint32_t keys);

/*
 * Colours of games, named after their ramps in carom_draw_palette: a display with a fixed palette
 * shows the colours of these ramps.
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
 * The look of a scene. A game has its paints; without paints (or with NULL) bodies have colours in
 * turn, and interfering faces are pink. There is one paint, valid until the next call. Defined in
 * scene_look.c.
 */
const struct carom_paint *scene_paint(const struct scene_game *game);
/* Write a number and some words. Returns the place at which the text continues. */
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

/* The car: each wheel has a hub. Front hubs turn about the upright; rear hubs go up and down. */
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
#define LOCKSTEP_DELAY       9 /* longest delay of a packet in the scene, ticks */
#define LOCKSTEP_BODIES      (1 + 2 * LOCKSTEP_RINK_BODIES + 2 * LOCKSTEP_DELAY)

/* Wheels; wheel n is on hinge n - 1. Behind them stands the board. */
#define GEARS 4
enum { GEARS_FIRST = SCENE_BODY, GEARS_BOARD = GEARS_FIRST + GEARS };
#define GEARS_TEETH                                                                                \
    {                                                                                              \
        10, 24, 16, 12                                                                             \
    }
#define GEARS_TURNS_A_MINUTE 48 /* of the first wheel */

/* Lengths as in tools/machines.py. */
enum { SCREW_NUT = SCENE_BODY, SCREW_BOLT, SCREW_HEAD };
#define SCREW_PITCH_MM 400
#define SCREW_PLAY_MM  12   /* play of the nut on the bolt, to either side */
#define SCREW_WAY_MM   1750 /* way of the nut down to the head */

/*
 * The cradle: the frame comes after the balls. After so many frames the script lifts another number
 * of balls.
 */
#define NEWTON_BALLS  5
#define NEWTON_FRAMES 320
enum { NEWTON_BALL = SCENE_BODY };
/* The row of dominoes, and the ball that runs into it. */
#define DOMINOES       40
#define DOMINOES_START 20 /* frame in which the script throws */
enum { DOMINOES_FIRST = SCENE_BODY, DOMINOES_BALL = DOMINOES_FIRST + DOMINOES };
/* The house of cards: 12 leaning, 3 lying. */
#define CARDS_STOREYS 3
#define CARDS         15
#define CARDS_START   240
enum { CARDS_FIRST = SCENE_BODY, CARDS_BALL = CARDS_FIRST + CARDS, CARDS_TOP = CARDS_BALL - 2 };
/* The arch: the keystone and pairs beside it, plinths, the ball. */
#define ARCH_STONES 13
#define ARCH_START  240
enum { ARCH_KEYSTONE = SCENE_BODY, ARCH_BALL = ARCH_KEYSTONE + ARCH_STONES + 2 };
/* The bowl and the things that fall into it. */
#define BOWL_PIECES 6
#define BOWL_TOSS   540
enum { BOWL = SCENE_BODY, BOWL_PIECE };
/* Things of four shapes in turn, then the bucket and the tray. */
#define POUR_THINGS 32
enum { POUR_THING = SCENE_BODY, POUR_BUCKET = POUR_THING + POUR_THINGS, POUR_TRAY };
#define POUR_FRAMES 720 /* until all things lie still and the bucket is up again */

/* A builder adds parts to a world. After the first error it adds nothing more. */
struct scene_parts {
    const struct scene *scene;
    struct carom_world *world;
    int result;
};
/* Add a body of the scene's i-th mesh, whose origin is at def->position. Returns its number. */
int scene_part(struct scene_parts *parts, int mesh, const struct carom_body_def *def);
/* Add a joint. Returns its number. */
int scene_joint(struct scene_parts *parts, const struct carom_joint_def *def);

/*
 * Throw a slow body from a place, upright. A body faster than 0.5 m/s goes on, so a key may be held. Returns >= 0 or an
 * error; nothing is thrown if something is in the way.
 */
int scene_throw(struct carom_world *world, int body, const carom_v3_q32 *from,
                const carom_v3_q40 *velocity);
/* Cosine of the angle between a body's z axis and the upright, q30. */
int64_t scene_upright(const struct carom_world *world, int body);

#endif

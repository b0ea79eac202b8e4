/* SPDX-License-Identifier: MIT */
/*
 * models.h - raw meshes for the scenes of games, made by tools/gen_shapes: z up, a unit is a metre, at most 1024 quanta
 * to a unit. A model that a program does not name is not linked.
 *
 *   static _Alignas(8) uint8_t wheel_block[CAROM_MESH_BYTES(WHEEL_VERTICES, WHEEL_FACES)];
 *   struct carom_mesh wheel;
 *
 *   carom_mesh_build(&wheel, &wheel_mesh, wheel_block, sizeof wheel_block);
 */
#ifndef CAROM_MODELS_H
#define CAROM_MODELS_H

#include "carom.h"

extern const struct carom_mesh_raw character_mesh; /* a capsule, 1.75 high, about its middle */
extern const struct carom_mesh_raw wheel_mesh;     /* a wheel with 16 sides, 0.2 wide along y */
extern const struct carom_mesh_raw car_mesh;       /* 3.5 long along x, without wheels */
extern const struct carom_mesh_raw door_mesh;      /* 0.9 wide along x; its hinge is the z axis */
extern const struct carom_mesh_raw link_mesh;      /* a link of a chain, 0.5 long along x */
extern const struct carom_mesh_raw ramp_mesh;      /* 2 long along x, to a height of 0.5 */
extern const struct carom_mesh_raw steps_mesh;     /* four steps, to a height of 0.6 */
extern const struct carom_mesh_raw jump_mesh;      /* a ramp 3 long along x, to a height of 0.35 */
extern const struct carom_mesh_raw tower_mesh;     /* 1.2 x 1.2, 5 high */
extern const struct carom_mesh_raw mat_mesh;       /* 2.4 long along x, 0.03 thick */
extern const struct carom_mesh_raw rink_mesh;      /* a floor of 8 x 6 with walls, at height 0 */
extern const struct carom_mesh_raw puck_mesh;      /* a puck with 8 sides, 0.5 high, from 0 */
extern const struct carom_mesh_raw
    gear10_mesh; /* wheels with so many teeth about y, 0.1 of diameter a tooth */
extern const struct carom_mesh_raw gear24_mesh;
extern const struct carom_mesh_raw gear16_mesh;
extern const struct carom_mesh_raw gear12_mesh;
extern const struct carom_mesh_raw board_mesh;    /* 6 long along x, 4.2 high, 0.15 thick */
extern const struct carom_mesh_raw bolt_mesh;     /* a thread of pitch 0.4 about z, up from 0 */
extern const struct carom_mesh_raw nut_mesh;      /* its nut, six-sided, 0.63 high */
extern const struct carom_mesh_raw hexagon_mesh;  /* the bolt's head, 0.35 high */
extern const struct carom_mesh_raw domino_mesh;   /* 0.125 thick along x, 0.75 high, from 0 */
extern const struct carom_mesh_raw pendulum_mesh; /* a ball on two rods, 1.6 below 0 */
extern const struct carom_mesh_raw beam_mesh;     /* 2.9 long along x, 0.06 thick */
extern const struct carom_mesh_raw post_mesh;     /* as thick, 2.4 high, from 0 */
extern const struct carom_mesh_raw card_mesh;     /* 0.02 thick along x, 1 high, about its middle */
extern const struct carom_mesh_raw cover_mesh;    /* a card that lies, 0.81 long along x */
extern const struct carom_mesh_raw stone_mesh;    /* a keystone, 2 above the axis of its arch */
extern const struct carom_mesh_raw plinth_mesh;   /* 0.9 x 0.9, 0.8 high, from 0 */
extern const struct carom_mesh_raw bowl_mesh;     /* 3 across, 1.1 high, from 0, hollow */
extern const struct carom_mesh_raw cup_mesh;      /* 1 across, 0.5 high, from 0, hollow */
extern const struct carom_mesh_raw ring_mesh;     /* small things that are not convex, 0.4 across */
extern const struct carom_mesh_raw star_mesh;
extern const struct carom_mesh_raw hook_mesh;
extern const struct carom_mesh_raw beaker_mesh;
extern const struct carom_mesh_raw
    bucket_mesh; /* open above, 1.36 x 1.36 and 0.9 deep inside, from its floor */
extern const struct carom_mesh_raw tray_mesh;     /* the same, 2.4 x 1.9 and 0.45 deep */
extern const struct carom_mesh_raw espresso_mesh; /* 1.9 high, about its middle */
extern const struct carom_mesh_raw mandelbrot512_mesh, mandelbrot3200_mesh; /* surfaces of 8 x 8 */
/* The ramps of their faces. */
extern const uint8_t espresso_ramps[], mandelbrot512_ramps[], mandelbrot3200_ramps[];
extern const struct carom_mesh_raw yard_mesh; /* a surface of 48 x 48 with hills and a rim */

#define CHARACTER_VERTICES 50
#define CHARACTER_FACES    96
#define WHEEL_VERTICES     32
#define WHEEL_FACES        60
#define CAR_VERTICES       22
#define CAR_FACES          40
#define DOOR_VERTICES      8
#define DOOR_FACES         12
#define LINK_VERTICES      32
#define LINK_FACES         64
#define RAMP_VERTICES      6
#define RAMP_FACES         8
#define STEPS_VERTICES     20
#define STEPS_FACES        36
#define JUMP_VERTICES      6
#define JUMP_FACES         8
#define TOWER_VERTICES     8
#define TOWER_FACES        12
#define MAT_VERTICES       8
#define MAT_FACES          12
#define RINK_VERTICES      16
#define RINK_FACES         28
#define PUCK_VERTICES      16
#define PUCK_FACES         28
#define DOMINO_VERTICES    8
#define DOMINO_FACES       12
#define PENDULUM_VERTICES  61
#define PENDULUM_FACES     110
#define BEAM_VERTICES      8
#define BEAM_FACES         12
#define POST_VERTICES      8
#define POST_FACES         12
#define CARD_VERTICES      8
#define CARD_FACES         12
#define COVER_VERTICES     8
#define COVER_FACES        12
#define STONE_VERTICES     8
#define STONE_FACES        12
#define PLINTH_VERTICES    8
#define PLINTH_FACES       12
#define BOWL_VERTICES      96
#define BOWL_FACES         188
#define CUP_VERTICES       60
#define CUP_FACES          116
#define YARD_VERTICES      289
#define YARD_FACES         512

#endif

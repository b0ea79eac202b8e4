/* SPDX-License-Identifier: MIT */
/*
 * scene.h - the scenes of the examples and tests: bodies that move over one that does not.
 *
 *   head        the paper's: a human head of 1876 faces, dropped with spin on a field of 3034
 *   head450     the same with 450 faces on a field of 386
 *   head836     with 836 on 512
 *   head48      a head of 48 faces and half the size on 128, one hit a frame
 *   head100     with 100 on 128
 *   head-spin   the head thrown at 4 units/s, turning by 8 radians/s; another way: head-spin2
 *   growth-N    the head put on fields of N = 512, 3034, 12012 or 49928 faces
 *   apart       the head a thousand units above the field
 *   box         a box of three different sides, dropped on a plane
 *   pair        a tetrahedron and a box that fall on the plane one after the other
 *   brick       the box on the plane, with fewer hits of a body and fewer sweeps
 *   boxes3      three boxes that fall on the field of 128 faces one after the other
 *   boxes10     ten of them, put on the plane
 *   stack10     ten of them on each other
 *   pile        16 boxes, tetrahedra and L-shapes, poured on the field
 *   pile32      32 bodies of 12 to 80 faces, poured on the field
 *   flight32    the same, thrown up from just above the field
 *   sheet       a box on a sheet of 800 faces that waves
 *   user        a mesh of the caller's in place of the head
 *
 * and those of scene_games.h, which a board with meshes in ROM has when its board.mk names one:
 *
 *   door        a door on a hinge with limits, and a ball that opens it
 *   chain       20 links on ball joints, which swings
 *   crusher     a kinematic block that comes down on a box
 *   conveyor    boxes on a belt whose surface moves
 *   espresso    figure 8's: an espresso machine of 836 faces, dropped on a Mandelbrot field of 512
 *   espresso-fine  the same on a field of 3200
 *   car         a car of hinges, motors and springs, ramps, things to pick up, a camera that follows
 *   walker      someone who goes up steps, on a platform that moves, down a ramp and through a door
 *   gears       four toothed wheels of different size, of which a motor turns the first
 *   screw       a nut turns down a bolt by its weight, and is wound up again
 *   pour        a bucket of 32 rings, stars, hooks and beakers is poured into a tray
 *   newton      Newton's cradle: five balls on hinges
 *   dominoes    a row of 40, which a ball brings down
 *   cards       a house of three storeys that stands by friction, until a ball comes
 *   arch        13 stones without mortar, until a ball comes
 *   bowl        cups and balls that fall into a bowl
 *   lockstep    two worlds fed the same keys over a bad link, and what flies over it
 *
 * A frame is 1/60 s and a unit 1 m.
 *
 *   static _Alignas(8) uint8_t mesh_block[SCENE_MESH_BYTES], world_block[SCENE_WORLD_BYTES];
 *   struct carom_config config = scene_config();
 *   struct scene scene;
 *   struct carom_world *world;
 *
 *   scene_load(&scene, "head", NULL, mesh_block, sizeof mesh_block);
 *   scene_make(&scene, &config, world_block, sizeof world_block, &world);
 */
#ifndef CAROM_SCENE_H
#define CAROM_SCENE_H

#include "carom_draw.h"

/* Body numbers. */
enum { SCENE_GROUND, SCENE_BODY };

#define SCENE_MESHES 6 /* of bodies, in one scene */

/* A sheet of squares, two faces each. */
#define SCENE_SHEET_SIDE     20
#define SCENE_SHEET_VERTICES ((SCENE_SHEET_SIDE + 1) * (SCENE_SHEET_SIDE + 1))
#define SCENE_SHEET_FACES    (2 * SCENE_SHEET_SIDE * SCENE_SHEET_SIDE)
struct scene_sheet {
    int16_t vertices[SCENE_SHEET_VERTICES][3];
    uint16_t faces[SCENE_SHEET_FACES][3];
};

struct scene_game; /* see scene_games.h */
/* In place of keys: nobody plays, so a game's script does. */
#define SCENE_NOBODY UINT32_MAX
#define SCENE_TEXT   40 /* characters of a game's text, the last one 0 */

struct scene {
    struct carom_body_def ground, body;
    int other_count;                             /* bodies besides these two */
    const struct carom_mesh *mesh[SCENE_MESHES]; /* the moving bodies use them in turn */
    int mesh_count;
    const struct scene_recipe *recipe;
    const struct carom_camera *camera;
    struct carom_caps caps;
    struct scene_sheet *sheet;     /* the ground, if it waves; otherwise NULL */
    const struct scene_game *game; /* the rules of a game; otherwise NULL */
};

/*
 * Bytes for the meshes of any scene except `user` and the growth of the field; for those as well;
 * and for a world of any scene.
 */
#define SCENE_MESH_BYTES                                                                           \
    (SCENE_MESH(SCENE_HEAD_VERTICES, SCENE_HEAD_FACES) +                                           \
     SCENE_MESH(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES))
#define SCENE_LARGE_MESH_BYTES                                                                     \
    (SCENE_MESH(SCENE_HEAD_VERTICES, SCENE_HEAD_FACES) +                                           \
     SCENE_MESH(SCENE_LARGE_VERTICES, SCENE_LARGE_FACES))
/* A mesh and the memory to which it refers. */
#define SCENE_MESH(vertices, faces)                                                                \
    ((sizeof(struct carom_mesh) + 7) / 8 * 8 + CAROM_MESH_BYTES(vertices, faces))
#define SCENE_HEAD_VERTICES  940
#define SCENE_HEAD_FACES     1876
#define SCENE_FIELD_VERTICES 1596
#define SCENE_FIELD_FACES    3034
#define SCENE_LARGE_VERTICES 25281 /* counts of the finest field */
#define SCENE_LARGE_FACES    49928

/*
 * Capacities of worlds (bodies, pairs, contacts, faces, entries, candidates): of one body, of a pile, of 32, of the
 * sheet. A board with little memory has its own for all of its scenes (board.mk).
 */
#ifdef BOARD_CAPS
#define SCENE_CAPS       BOARD_CAPS
#define SCENE_PILE_CAPS  BOARD_CAPS
#define SCENE_LARGE_CAPS BOARD_CAPS
#define SCENE_SHEET_CAPS BOARD_CAPS
#else
#define SCENE_CAPS       2, 1, 64, 1024, 256, 1024
#define SCENE_PILE_CAPS  17, 128, 384, 2048, 256, 2048
#define SCENE_LARGE_CAPS 33, 256, 768, 4096, 1, 4096
#define SCENE_SHEET_CAPS 2, 1, 64, 1024, 512, 1024
#endif
/* Whether there are games, and the capacities of the game with the most bodies, the dominoes. */
#if defined SCENE_ROM && !defined SCENE_ROM_GAMES
#define SCENE_GAMES     0
#define SCENE_GAME_CAPS SCENE_LARGE_CAPS
#else
#define SCENE_GAMES 1
#ifdef BOARD_GAME_CAPS
#define SCENE_GAME_CAPS BOARD_GAME_CAPS
#else
#define SCENE_GAME_CAPS 42, 128, 224, 512, 0, 1024
#endif
#endif
#define SCENE_MORE_(a, b) ((a) > (b) ? (a) : (b))
#define SCENE_WORLD_BYTES                                                                          \
    SCENE_MORE_(CAROM_WORLD_BYTES(SCENE_LARGE_CAPS), CAROM_WORLD_BYTES(SCENE_GAME_CAPS))

/* The generated raw meshes; a number in a name is the number of faces. */
extern const struct carom_mesh_raw head_mesh, head48_mesh, head80_mesh, head100_mesh, head450_mesh,
    head836_mesh, field_mesh, field128_mesh, field386_mesh, field512_mesh, field12012_mesh,
    field49928_mesh;

/* SCENE_CAPS, gravity, sleep, no timing. scene_make uses the capacities of a pile where it needs them. */
struct carom_config scene_config(void);

/*
 * Build the meshes of a scene, or find them in ROM, and define the starts of its bodies.
 *   user  the mesh of scene `user`, scaled by a power of two to about the size of the head; else NULL
 *   mem   aligned to 8: SCENE_MESH_BYTES; for `user`, SCENE_MESH of its counts and of the field; unused for meshes in ROM
 *
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT for an unknown name, or one that is not in ROM; or what carom_mesh_build
 *          returned.
 */
int scene_load(struct scene *scene, const char *name, const struct carom_mesh_raw *user, void *mem,
               size_t bytes);

/* Make a world in its own block and add the bodies. Returns CAROM_OK or an error. */
int scene_make(const struct scene *scene, const struct carom_config *config, void *block,
               size_t bytes, struct carom_world **world);

/*
 * The n-th scene that scene_load knows and a line about it; NULL past the last one. A board with
 * meshes in ROM loads only its own scenes.
 */
const char *scene_name(int n);
const char *scene_text(int n);

/* The definition of the i-th moving body at its start; 0 is scene->body. */
void scene_body(const struct scene *scene, int i, struct carom_body_def *def);

/* Prepare a frame, from 1 on: the sheet moves, a game goes on. Returns CAROM_OK or an error. */
int scene_before(struct scene *scene, struct carom_world *world, int frame);
/* The same for scene->sheet; it needs nothing else of the scene. */
int scene_sheet_move(struct scene_sheet *sheet, struct carom_world *world, int frame);

/*
 * The meshes of a scene, for scene_load: it sets scene->ground.mesh, mesh, mesh_count and sheet. Either scene_built.c
 * defines it, which builds them in mem, or scene_rom.c, which has them in ROM.
 */
int scene_meshes(struct scene *scene, const char *name, const struct carom_mesh_raw *user,
                 void *mem, size_t bytes);

/* The indexed meshes of a scene, as tools/rom_scene writes them. */
struct scene_rom {
    const char *name;
    const struct carom_mesh *ground;
    const struct carom_mesh *mesh[SCENE_MESHES]; /* NULL after the last */
};

/* The sheet: the places of its vertices before a frame, and the raw mesh of the first frame. */
void scene_sheet_shape(int16_t (*vertices)[3], int32_t frame);
struct carom_mesh_raw scene_sheet_raw(struct scene_sheet *sheet);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * view_parts.h - the interfaces between the files of the viewer. view.c: the scene and its time.
 * view_acts.c: acts. view_hand.c: the hand that holds a body. view_link.c: links. view_camera.c:
 * the camera. view_paint.c: colours. view_lines.c: contacts and cells. view_panel.c: text and bars.
 */
#ifndef CAROM_VIEW_PARTS_H
#define CAROM_VIEW_PARTS_H

#include "scene.h"
#include "show.h"
#include "view.h"

/* ---------------------------------------------------------------------- acts */

enum view_act_kind { VIEW_KEYS, VIEW_GRAB, VIEW_HAND, VIEW_DROP, VIEW_ACT_KINDS };

/*
 * An act, done before the step of a frame; frames count from 1. Lengths are in 2^-10 units, so links
 * are short and hold all of an act.
 *   KEYS  the sum of the keys held
 *   GRAB  a body and a place of its mesh
 *   HAND  the place of the hand in the world
 */
#define VIEW_ACT_BITS 10
struct view_act {
    int32_t frame;
    uint8_t kind;
    int32_t n[4];
};
/*
 * The number of an act's numbers, and their range: the same for all except GRAB's first number, a
 * body.
 */
extern const uint8_t view_act_numbers[VIEW_ACT_KINDS];
bool view_act_is_sound(const struct view_act *act);

#define VIEW_ACTS_MAX  20000
#define VIEW_FRAME_MAX (1 << 24)
struct view_acts {
    struct view_act list[VIEW_ACTS_MAX];
    uint32_t count, done;
    int32_t given; /* frame of the last act of a link; no other act is taken until then */
};
extern struct view_acts view_acts;

void view_acts_clear(void);
/* True if acts of a link are still to be done. */
bool view_acts_follow(void);
/* Do the acts before a frame. */
void view_acts_before(struct carom_world *world, int32_t frame);
/* The held keys; SCENE_NOBODY before the first one. */
uint32_t view_acts_keys(void);

/* ---------------------------------------------------------------------- hand */

/* The hand that holds a place of a body. */
struct view_hand {
    bool holds;
    int body;           /* its id */
    carom_v3_q32 local; /* the place, in the body's mesh */
    carom_v3_q32 at;    /* the goal of the place */
};
extern struct view_hand view_hand;
/* Move the hand: view_hand.at from the next frame on. */
extern carom_v3_q32 view_hand_at;
/*
 * Move the hand to the place at which a pixel shows the plane through the hand that faces the
 * camera. False if the pixel shows no part of the plane.
 */
bool view_hand_reach(int32_t x, int32_t y);
void view_hand_grab(const struct carom_world *world, int body, const carom_v3_q32 *local);
/* Push the held body, before a step. */
void view_hand_pull(struct carom_world *world);

/* --------------------------------------------------------------------- looks */

void view_camera_reset(void);
/* The present camera. */
const struct carom_camera *view_scene_camera(void);
/* The picture of view_size, with its workspace. */
const struct carom_picture *view_picture(void);

/* The scene's own paint, changed by the toggles, without lines. */
const struct carom_paint *view_paint(const struct carom_world *world,
                                     const struct carom_paint *scene_own, uint32_t toggles);

/* The cells that are searched, as lines that bodies hide. */
#define VIEW_LINES_MAX 4096
void view_cells(const struct carom_world *world, struct carom_paint *paint);
/* Draw contacts over a finished picture. */
void view_contacts(const struct carom_world *world, const struct carom_picture *picture,
                   struct carom_rect *touched);
/* Draw the hand's pull, likewise. */
void view_hand_draw(const struct carom_world *world, const struct carom_picture *picture,
                    struct carom_rect *touched);

/* Mean times of steps and pictures. */
void view_panel_reset(void);
void view_panel_step(const struct carom_stats *stats);
void view_panel_drew(uint32_t ticks);
/* Draw text and bars over a finished picture. */
void view_panel(const struct carom_picture *picture, uint32_t toggles, struct carom_rect *touched);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * view_parts.h - what the files of the viewer share. view.c has the scene and the time, view_acts.c what was done to the
 * world, view_hand.c the hand that holds a body, view_link.c links, view_camera.c the camera, view_paint.c colours,
 * view_lines.c contacts and cells, view_panel.c text and bars.
 */
#ifndef CAROM_VIEW_PARTS_H
#define CAROM_VIEW_PARTS_H

#include "scene.h"
#include "show.h"
#include "view.h"

/* ---------------------------------------------------------------------- acts */

enum view_act_kind { VIEW_KEYS, VIEW_GRAB, VIEW_HAND, VIEW_DROP, VIEW_ACT_KINDS };

/*
 * What is done before the step of a frame, 1 being the first. Lengths are 2^-10 units, so that links are short and hold
 * all of it.
 *   KEYS  the sum of what is held
 *   GRAB  a body and a place of its mesh
 *   HAND  where the hand is in the world
 */
#define VIEW_ACT_BITS 10
struct view_act {
    int32_t frame;
    uint8_t kind;
    int32_t n[4];
};
/* How many numbers an act has, and within what they are: the same for all of them but GRAB's first, a body. */
extern const uint8_t view_act_numbers[VIEW_ACT_KINDS];
bool view_act_is_sound(const struct view_act *act);

#define VIEW_ACTS_MAX  20000
#define VIEW_FRAME_MAX (1 << 24)
struct view_acts {
    struct view_act list[VIEW_ACTS_MAX];
    uint32_t count, done;
    int32_t given; /* frame of the last act of a link; nothing else is done until then */
};
extern struct view_acts view_acts;

void view_acts_clear(void);
/* Whether acts of a link are still to be done. */
bool view_acts_follow(void);
/* Do what is to be done before a frame. */
void view_acts_before(struct carom_world *world, int32_t frame);
/* Keys that are held; SCENE_NOBODY before the first one. */
uint32_t view_acts_keys(void);

/* ---------------------------------------------------------------------- hand */

/* The hand that holds a place of a body. */
struct view_hand {
    bool holds;
    int body;           /* its id */
    carom_v3_q32 local; /* the place, of its mesh */
    carom_v3_q32 at;    /* where it is to be */
};
extern struct view_hand view_hand;
/* Where the pointer has it: view_hand.at from the next frame on. */
extern carom_v3_q32 view_hand_at;
/* Let that be where a pixel shows the plane through it that faces the camera; false where it shows none of it. */
bool view_hand_reach(int32_t x, int32_t y);
void view_hand_grab(const struct carom_world *world, int body, const carom_v3_q32 *local);
/* Push what it holds, before a step. */
void view_hand_pull(struct carom_world *world);

/* --------------------------------------------------------------------- looks */

void view_camera_reset(void);
/* The camera that the scene has now. */
const struct carom_camera *view_scene_camera(void);
/* The picture that view_size gave; its workspace is there. */
const struct carom_picture *view_picture(void);

/* The scene's own paint, with what the toggles change. The lines are not in it. */
const struct carom_paint *view_paint(const struct carom_world *world,
                                     const struct carom_paint *scene_own, uint32_t toggles);

/* The cells that are asked, as lines that bodies hide. */
#define VIEW_LINES_MAX 4096
void view_cells(const struct carom_world *world, struct carom_paint *paint);
/* Contacts, over a picture that is drawn. */
void view_contacts(const struct carom_world *world, const struct carom_picture *picture,
                   struct carom_rect *touched);
/* What the hand pulls, likewise. */
void view_hand_draw(const struct carom_world *world, const struct carom_picture *picture,
                    struct carom_rect *touched);

/* Means of what steps and pictures took. */
void view_panel_reset(void);
void view_panel_step(const struct carom_stats *stats);
void view_panel_drew(uint32_t ticks);
/* Text and bars, over a picture that is drawn. */
void view_panel(const struct carom_picture *picture, uint32_t toggles, struct carom_rect *touched);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * view.h - a scene to look at and to play with: all parts of `make view` and of the page, except
 * the window. It calls nothing of an operating system. There is one view; its memory is static.
 *
 * An act changes the world: a key that goes down or up, a place that is grabbed, a hand that moves,
 * a hand that lets go. An act has a frame and a few numbers. A link is the scene's name and its
 * acts, so that the same bodies move in the same way anywhere. A change of the view (camera,
 * toggles, pause, slow motion) is no act.
 */
#ifndef CAROM_VIEW_H
#define CAROM_VIEW_H

#include "carom_draw.h"
#include "port.h"

/* Toggles of pictures; flags are a sum of these. */
enum view_toggle {
    VIEW_FACES = 1,    /* interfering faces coloured */
    VIEW_CONTACTS = 2, /* contacts with their normals and impulses */
    VIEW_CELLS = 4,    /* cells of the z-lists that are searched, each at its highest entry */
    VIEW_LEAVES = 8,   /* leaves of the meshes, in colours */
    VIEW_WIRE = 16,    /* edges, not faces */
    VIEW_SHADOWS = 32,
    VIEW_BARS = 64, /* stages of a step against the budget */
    VIEW_TEXT = 128 /* the scene's name, the frame, the hash */
};

/*
 * Begin a scene anew, without acts.
 *   name  a scene of scene.h; "user" with a mesh of the caller's, which is copied; otherwise `mesh` is NULL
 * Returns  CAROM_OK or the error of scene_load or scene_make; the previous scene is closed then
 */
int view_open(const char *name, const struct carom_mesh_raw *mesh);

/* Begin the same scene anew, without acts. Returns as view_open. */
int view_restart(void);

/*
 * Set the picture to draw into, CAROM_XRGB8888. The view provides picture->workspace and ->paint itself.
 * Returns CAROM_OK or CAROM_ERR_ARGUMENT.
 */
int view_size(const struct carom_picture *picture);

/* ------------------------------------------------------------------- looking */

void view_toggles(uint32_t toggles); /* a sum of enum view_toggle */
uint32_t view_usual(void);           /* the toggles that suit the scene */
/* Turn the camera about its target, by the pixels that a pointer moved. */
void view_orbit(int32_t x, int32_t y);
void view_pan(int32_t x, int32_t y); /* move camera and target */
void view_zoom(int32_t steps);       /* an eighth nearer a step; negative: farther */
void view_home(void); /* the scene's own camera; in a game it follows the player again */
/* The camera. Valid until the next call. */
const struct carom_camera *view_camera(void);

/* -------------------------------------------------------------------- acting */

/*
 * Keys held from the next frame on: a sum of enum port_pad. A game's script plays until the first
 * key.
 */
void view_keys(uint32_t keys);

/*
 * Take hold of the body that the picture shows at pixel (x, y). A well damped spring draws the
 * place towards the pointer, in the plane through the place that faces the camera. A body that is
 * let go flies on.
 * Returns  true if a moving body is there
 */
bool view_grab(int32_t x, int32_t y);
void view_drag(int32_t x, int32_t y);
void view_drop(void);

/* ---------------------------------------------------------------------- time */

void view_pause(bool paused);
int view_single(void);     /* one step if paused; returns as view_frame */
void view_slow(int32_t n); /* a step every n calls of view_frame, 1 to 60 */

/*
 * Go on by a sixtieth of a second: step, unless paused or slow.
 * Returns  the number of steps, 0 or 1; the error of carom_world_step: the world stands still until view_restart
 */
int view_frame(void);

/* Lines of text over the middle of the pictures; NULL: none. The caller keeps them. */
void view_note(const char *text);

/* Draw the picture of view_size with all that the toggles ask for. Returns CAROM_OK or an error of carom_draw. */
int view_draw(void);

/* -------------------------------------------------------------------- asking */

int32_t view_step_count(void);              /* steps since the scene began */
uint64_t view_hash(void);                   /* carom_world_hash */
const struct carom_stats *view_stats(void); /* statistics of the last step, in port_ticks */
const struct carom_world *view_world(void); /* NULL if no scene is open */
const char *view_scene(void);
const char *view_says(void); /* a game's line of text, or "" */

/*
 * Write the scene and all acts so far as text of at most `room` bytes, including the final 0. The
 * text holds only letters, digits, '-', '_', '.' and '~', so it may stand in the address of a
 * page. Scene "user" has no link.
 * Returns  its length; CAROM_ERR_MEMORY; CAROM_ERR_ARGUMENT for "user"
 */
int view_link(char *text, size_t room);

/*
 * Open the scene of a link and repeat its acts at their frames. Until the last act is done,
 * view_keys, view_grab, view_drag and view_drop do nothing.
 * Returns  the frame of the last act; CAROM_ERR_ARGUMENT for a text that is no link: the previous scene stays
 */
int view_follow(const char *text);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * window.h - the interface between the two files of the window. window.c: scenes, time, the
 * picture. input.c: keys and pointer.
 */
#ifndef CAROM_PORT_SDL2_WINDOW_H
#define CAROM_PORT_SDL2_WINDOW_H

#include <SDL.h>
#include <stdbool.h>
#include <stdint.h>

struct window {
    SDL_Window *window;
    SDL_Surface *picture; /* has the viewer's pixels */
    bool changed;         /* the picture must be drawn again */
    bool over;
    int scene; /* index of scene_name */
    uint32_t toggles, held;
    bool paused, help, user;
    int slow;
    bool grabs, turns, pans;
    int stands; /* the error at which the world stopped */
    bool aims;  /* a link is followed to its state */
    int aim_frame;
    char aim_hash[17];
};
extern struct window the;

void window_restart(void);
void window_next_scene(int way);
void window_say_link(void);
void window_pause(bool paused);
/* Note the result of a step. */
void window_stepped(int result);
void window_slow_down(int way);
void window_size(void);

/* input.c */
void input_handle(const SDL_Event *event);

#endif

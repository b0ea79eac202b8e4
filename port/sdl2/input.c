/* SPDX-License-Identifier: MIT */
/* Keys and pointer of the window. */
#include "port.h"
#include "view.h"
#include "window.h"

static const char help_text[] = "drag a body     take it and throw it\n"
                                "drag elsewhere  turn the view\n"
                                "right drag      move the view\n"
                                "wheel           nearer, farther\n"
                                "Home            the scene's own view\n"
                                "\n"
                                "Space           pause\n"
                                "S               one step\n"
                                "-  =            slower, faster\n"
                                "R               begin anew\n"
                                "N  P            next, previous scene\n"
                                "K               link, to the clipboard\n"
                                "\n"
                                "F               interfering faces\n"
                                "C               contacts, impulses\n"
                                "G               cells of the z-lists\n"
                                "L  W            leaves, edges\n"
                                "D               shadows\n"
                                "B               time by stage\n"
                                "T  H            text, this help\n"
                                "\n"
                                "arrows X Z      the pad of a game\n"
                                "Escape          leave";

/* ---------------------------------------------------------------------- keys */

static const struct {
    SDL_Keycode key;
    uint32_t toggle;
} toggles[] = {{SDLK_f, VIEW_FACES},  {SDLK_c, VIEW_CONTACTS}, {SDLK_g, VIEW_CELLS},
               {SDLK_l, VIEW_LEAVES}, {SDLK_w, VIEW_WIRE},     {SDLK_d, VIEW_SHADOWS},
               {SDLK_b, VIEW_BARS},   {SDLK_t, VIEW_TEXT}};

static const struct {
    SDL_Keycode key;
    uint32_t pad;
} pads[] = {{SDLK_RIGHT, PORT_PAD_RIGHT},   {SDLK_LEFT, PORT_PAD_LEFT},
            {SDLK_UP, PORT_PAD_UP},         {SDLK_DOWN, PORT_PAD_DOWN},
            {SDLK_x, PORT_PAD_A},           {SDLK_z, PORT_PAD_B},
            {SDLK_y, PORT_PAD_B},           {SDLK_RETURN, PORT_PAD_START},
            {SDLK_LSHIFT, PORT_PAD_SELECT}, {SDLK_RSHIFT, PORT_PAD_SELECT}};

static void pad_key(SDL_Keycode key, bool down)
{
    for (size_t i = 0; i < SDL_arraysize(pads); i++) {
        if (pads[i].key == key) {
            the.held = down ? the.held | pads[i].pad : the.held & ~pads[i].pad;
            view_keys(the.held);
        }
    }
}

static void toggle_key(SDL_Keycode key)
{
    for (size_t i = 0; i < SDL_arraysize(toggles); i++) {
        if (toggles[i].key == key) {
            the.toggles ^= toggles[i].toggle;
            view_toggles(the.toggles);
            the.changed = true;
        }
    }
}

static void key_down(SDL_Keycode key)
{
    pad_key(key, true);
    toggle_key(key);
    switch (key) {
    case SDLK_ESCAPE:
        the.over = true;
        break;
    case SDLK_h:
        the.help = !the.help;
        view_note(the.help ? help_text : NULL);
        the.changed = true;
        break;
    case SDLK_SPACE:
        window_pause(!the.paused);
        break;
    case SDLK_s:
        window_pause(true);
        window_stepped(view_single());
        break;
    case SDLK_MINUS:
        window_slow_down(1);
        break;
    case SDLK_EQUALS:
    case SDLK_PLUS:
        window_slow_down(-1);
        break;
    case SDLK_r:
        window_restart();
        break;
    case SDLK_n:
        window_next_scene(1);
        break;
    case SDLK_p:
        window_next_scene(-1);
        break;
    case SDLK_k:
        window_say_link();
        break;
    case SDLK_HOME:
        view_home();
        the.changed = true;
        break;
    default:
        break;
    }
}

/* ------------------------------------------------------------------- pointer */

/* The pixel of the picture under a place of the window, which may be larger. */
static SDL_Point in_picture(int x, int y)
{
    int width, height;

    SDL_GetWindowSize(the.window, &width, &height);
    return (SDL_Point){x * the.picture->w / (width > 0 ? width : 1),
                       y * the.picture->h / (height > 0 ? height : 1)};
}

static void button_down(const SDL_MouseButtonEvent *event)
{
    const SDL_Point at = in_picture(event->x, event->y);
    const bool left = event->button == SDL_BUTTON_LEFT;

    the.pans = !left || SDL_GetModState() & KMOD_SHIFT;
    the.grabs = left && !the.pans && view_grab(at.x, at.y);
    the.turns = !the.pans && !the.grabs;
    the.changed = true;
}

static void button_up(void)
{
    view_drop();
    the.grabs = the.turns = the.pans = false;
    the.changed = true;
}

static void motion(const SDL_MouseMotionEvent *event)
{
    const SDL_Point at = in_picture(event->x, event->y);

    if (the.grabs) {
        view_drag(at.x, at.y);
    } else if (the.turns) {
        view_orbit(event->xrel, event->yrel);
    } else if (the.pans) {
        view_pan(event->xrel, event->yrel);
    }
    the.changed = the.changed || the.grabs || the.turns || the.pans;
}

void input_handle(const SDL_Event *event)
{
    switch (event->type) {
    case SDL_QUIT:
        the.over = true;
        break;
    case SDL_WINDOWEVENT:
        if (event->window.event == SDL_WINDOWEVENT_SIZE_CHANGED) {
            window_size();
        } else if (event->window.event == SDL_WINDOWEVENT_FOCUS_LOST) {
            the.held = 0;
            view_keys(0);
        }
        the.changed = true;
        break;
    case SDL_KEYDOWN:
        if (event->key.repeat == 0 || event->key.keysym.sym == SDLK_s) {
            key_down(event->key.keysym.sym);
        }
        break;
    case SDL_KEYUP:
        pad_key(event->key.keysym.sym, false);
        break;
    case SDL_MOUSEBUTTONDOWN:
        button_down(&event->button);
        break;
    case SDL_MOUSEBUTTONUP:
        button_up();
        break;
    case SDL_MOUSEMOTION:
        motion(&event->motion);
        break;
    case SDL_MOUSEWHEEL:
        view_zoom(event->wheel.y);
        the.changed = true;
        break;
    default:
        break;
    }
}

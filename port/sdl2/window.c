/* SPDX-License-Identifier: MIT */
/*
 * A window of SDL2 on the viewer of examples/view.h: build/host/window.elf scene=NAME, or
 * mesh=FILE (a blob of carom-mesh) or link=TEXT. `make view` builds and starts it. The program
 * prints the link when K is pressed, and reports whether a followed link ended in its state.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port.h"
#include "scene.h"
#include "view.h"
#include "window.h"

#define SIDE_MAX      2048 /* of a picture */
#define LATE_MAX      4    /* late frames that are caught up with */
#define MESH_VERTICES 24000
#define MESH_BYTES    CAROM_BLOB_BYTES(MESH_VERTICES, 2 * MESH_VERTICES)
#define LINK_BYTES    (1 << 18)
#define SLOWEST       32

struct window the;
static uint32_t pixels[SIDE_MAX * SIDE_MAX];
static struct carom_mesh_raw mesh;

/* ------------------------------------------------------------------- options */

static const char *option(int count, char **words, const char *name)
{
    const size_t length = strlen(name);

    for (int i = 1; i < count; i++) {
        if (strncmp(words[i], name, length) == 0 && words[i][length] == '=') {
            return words[i][length + 1] ? words[i] + length + 1 : NULL;
        }
    }
    return NULL;
}

static void leave(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    SDL_Quit();
    exit(1);
}

static int expect(int result, const char *what)
{
    if (result < 0) {
        leave(what, carom_result_text(result));
    }
    return result;
}

static void read_mesh(const char *file)
{
    static uint8_t blob[MESH_BYTES + 64];
    static _Alignas(8) uint8_t block[MESH_BYTES];
    const long bytes = port_read_file(file, blob, sizeof blob);

    if (bytes < 0) {
        leave(file, "cannot be read");
    }
    expect(carom_mesh_read(&mesh, blob, (size_t)bytes, block, sizeof block), file);
    the.user = true;
}

/* -------------------------------------------------------------------- scenes */

static int number_of(const char *name)
{
    for (int i = 0; scene_name(i); i++) {
        if (strcmp(scene_name(i), name) == 0) {
            return i;
        }
    }
    return -1;
}

static void set_title(void)
{
    char title[160];

    snprintf(title, sizeof title, "Carom: %s%s - H for help", view_scene(),
             the.stands     ? ", stands still"
             : the.paused   ? ", paused"
             : the.slow > 1 ? ", slow"
                            : "");
    SDL_SetWindowTitle(the.window, title);
}

/* Begin a scene with the toggles that suit it; the others stay. */
static void began(void)
{
    const uint32_t suits = VIEW_FACES | VIEW_SHADOWS;

    the.stands = 0;
    the.scene = number_of(view_scene());
    the.toggles = (the.toggles & ~suits) | view_usual();
    view_toggles(the.toggles);
    the.changed = true;
    set_title();
}

static void open_scene(const char *name)
{
    the.aims = false;
    expect(view_open(name, strcmp(name, "user") == 0 ? &mesh : NULL), name);
    began();
}

/* `user` exists with a mesh only. */
void window_next_scene(int way)
{
    int count = 0;

    while (scene_name(count)) {
        count++;
    }
    do {
        the.scene = (the.scene + count + way) % count;
    } while (!the.user && strcmp(scene_name(the.scene), "user") == 0);
    open_scene(scene_name(the.scene));
}

void window_restart(void)
{
    the.aims = false;
    expect(view_restart(), view_scene());
    began();
}

/* Read LINK, or LINK/FRAME/HASH as the page has it. */
static void follow(const char *text)
{
    static char link[LINK_BYTES];
    const size_t length = strcspn(text, "/");
    int last;

    if (length >= sizeof link) {
        leave("link", "too long");
    }
    memcpy(link, text, length);
    link[length] = 0;
    last = expect(view_follow(link), "link");
    if (text[length]) {
        the.aims = sscanf(text + length, "/%d/%16[0-9a-f]", &the.aim_frame, the.aim_hash) == 2;
        if (!the.aims || the.aim_frame < last) {
            leave("link", "cut or changed");
        }
    }
    began();
}

void window_say_link(void)
{
    static char link[LINK_BYTES + 64];
    const int length = view_link(link, LINK_BYTES);

    if (length < 0) {
        printf("no link: %s\n", carom_result_text(length));
        return;
    }
    snprintf(link + length, 64, "/%d/%016llx", (int)view_step_count(),
             (unsigned long long)view_hash());
    SDL_SetClipboardText(link);
    printf("link %s\n", link);
    fflush(stdout);
}

/* ---------------------------------------------------------------------- time */

void window_pause(bool paused)
{
    the.paused = paused;
    view_pause(paused);
    set_title();
}

/* At the frame of a link: compare the state with the link's. */
static void compare(void)
{
    char hash[17];

    if (the.aims && view_step_count() == the.aim_frame) {
        snprintf(hash, sizeof hash, "%016llx", (unsigned long long)view_hash());
        printf("frame %d: %s %s\n", the.aim_frame, hash,
               strcmp(hash, the.aim_hash) == 0 ? "is the hash of the link"
                                               : "is not the hash of the link");
        fflush(stdout);
        the.aims = false;
        window_pause(true);
    }
}

void window_stepped(int result)
{
    if (result < 0 && the.stands == 0) {
        the.stands = result;
        printf("the world stands still: %s\n", carom_result_text(result));
        set_title();
    }
    if (result > 0) {
        the.changed = true;
        compare();
    }
}

void window_slow_down(int way)
{
    the.slow = way > 0 ? the.slow * 2 : the.slow / 2;
    the.slow = the.slow < 1 ? 1 : the.slow > SLOWEST ? SLOWEST : the.slow;
    view_slow(the.slow);
    set_title();
}

/* -------------------------------------------------------------------- window */

void window_size(void)
{
    int width, height;
    struct carom_picture picture = {.pixels = pixels, .format = CAROM_XRGB8888};

    SDL_GetWindowSize(the.window, &width, &height);
    picture.width = width < 1 ? 1 : width > SIDE_MAX ? SIDE_MAX : width;
    picture.height = height < 1 ? 1 : height > SIDE_MAX ? SIDE_MAX : height;
    picture.stride = picture.width * (int32_t)sizeof pixels[0];
    SDL_FreeSurface(the.picture);
    the.picture = SDL_CreateRGBSurfaceWithFormatFrom(pixels, picture.width, picture.height, 32,
                                                     picture.stride, SDL_PIXELFORMAT_RGB888);
    if (!the.picture) {
        leave("picture", SDL_GetError());
    }
    expect(view_size(&picture), "picture");
    the.changed = true;
}

static void draw(void)
{
    SDL_Surface *shown = SDL_GetWindowSurface(the.window);

    expect(view_draw(), "draw");
    if (!shown) {
        leave("window", SDL_GetError());
    }
    SDL_BlitScaled(the.picture, NULL, shown, NULL);
    SDL_UpdateWindowSurface(the.window);
    the.changed = false;
}

/* Step each sixtieth of a second; after a longer delay, catch up with LATE_MAX frames only. */
static void run(void)
{
    const uint64_t hz = SDL_GetPerformanceFrequency();
    uint64_t due = SDL_GetPerformanceCounter();
    SDL_Event event;

    while (!the.over) {
        const uint64_t now = SDL_GetPerformanceCounter();

        while (SDL_PollEvent(&event)) {
            input_handle(&event);
        }
        due = now > due + LATE_MAX * hz / 60 ? now : due;
        for (; due <= now; due += hz / 60) {
            window_stepped(view_frame());
        }
        if (the.changed) {
            draw();
        }
        SDL_Delay(2);
    }
}

/*
 * SDL has drivers that show nothing, and takes one of them if there is no other. Use one only if
 * the user asks for it.
 */
static bool has_display(void)
{
    static const char *const blind[] = {"dummy", "offscreen", "evdev"};
    const char *driver;

    if (SDL_Init(SDL_INIT_VIDEO) < 0) {
        return false;
    }
    driver = SDL_GetCurrentVideoDriver();
    for (size_t i = 0; i < SDL_arraysize(blind) && !getenv("SDL_VIDEODRIVER"); i++) {
        if (strcmp(driver, blind[i]) == 0) {
            SDL_SetError("only %s", driver);
            return false;
        }
    }
    return true;
}

static void open_window(void)
{
    if (!has_display()) {
        fprintf(stderr,
                "There is no display to open a window on (SDL: %s).\n"
                "`make run BOARD=host SCENE=head` makes pictures in out/head, `make web` a page.\n",
                SDL_GetError());
        exit(1);
    }
    the.window = SDL_CreateWindow("Carom", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, 1024,
                                  720, SDL_WINDOW_RESIZABLE);
    if (!the.window) {
        leave("window", SDL_GetError());
    }
}

int main(int count, char **words)
{
    const char *scene = option(count, words, "scene"), *file = option(count, words, "mesh");
    const char *link = option(count, words, "link");

    if (file) {
        read_mesh(file);
    }
    open_window();
    the.slow = 1;
    the.toggles = VIEW_TEXT;
    if (link) {
        follow(link);
    } else {
        open_scene(file ? "user" : scene ? scene : "head");
    }
    window_size();
    run();
    SDL_Quit();
    return 0;
}

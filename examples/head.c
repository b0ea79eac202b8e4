/* SPDX-License-Identifier: MIT */
/*
 * Play a scene of scene.h: each frame steps, draws, shows, and prints a row of figures to the console.
 *
 * Options: scene=NAME (of scene.h)  frames=600  mesh=file (scene user)  awake=1 (no sleep)
 *                   budget=N: ticks that a step may take, counted like its stages; column "over"
 *          names the costliest stage of a step that takes more          only=N: draw and show
 *          frame N only          scenes=1: print the names of the scenes that scene.h knows, with
 *          a line about each, and end          play=1: the pad plays (scene_play.h). Without
 *          arguments it runs as a game, without end
 *
 * A game of scene_games.h obeys the pad's keys with and without play=1.
 */
#include "carom_draw.h"
#include "port.h"
#include "scene.h"
#include "scene_games.h"
#include "scene_play.h"
#include "show.h"

#ifdef SCENE_ROM
/* A board with meshes in ROM has no memory for other meshes, nor for moving ones. */
static uint8_t mesh_block[1];
#define BOARD_MOVES   SCENE_GAMES /* something runs before each frame */
#define USER_VERTICES SCENE_HEAD_VERTICES
#define USER_FACES    SCENE_HEAD_FACES
#else
#define BOARD_MOVES 1
/* Size of the largest mesh that `mesh=` may name. */
#ifndef USER_VERTICES
#define USER_VERTICES 24000
#endif
#define USER_FACES (2 * USER_VERTICES)
#define USER_MESH_BYTES                                                                            \
    (SCENE_MESH(USER_VERTICES, USER_FACES) + SCENE_MESH(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES))
static _Alignas(8) uint8_t
    mesh_block[USER_MESH_BYTES > SCENE_LARGE_MESH_BYTES ? USER_MESH_BYTES : SCENE_LARGE_MESH_BYTES];
static _Alignas(8) uint8_t user_block[CAROM_BLOB_BYTES(USER_VERTICES, USER_FACES)];
static uint8_t file_block[CAROM_BLOB_BYTES(USER_VERTICES, USER_FACES) + 64];
#endif

/*
 * The scene if the options name none; and what a tick counts on a port that counts no instructions.
 */
#ifndef BOARD_SCENE
#define BOARD_SCENE head
#endif
#ifndef BOARD_UNIT
#define BOARD_UNIT nanoseconds
#endif
#define TEXT_OF(name) #name
#define TEXT(macro)   TEXT_OF(macro)

/* Enough to draw any scene in one part, or what the board has; 0: the board shows nothing. */
#ifndef BOARD_DRAW_BYTES
#define BOARD_DRAW_BYTES                                                                           \
    CAROM_DRAW_BYTES(USER_VERTICES + SCENE_FIELD_VERTICES, USER_FACES + SCENE_FIELD_FACES)
#endif

/* Bodies of the largest world: the first of its capacities. */
#define FIRST_OF(first, ...) first
#define BODIES_OF(...)       FIRST_OF(__VA_ARGS__)
#define BODIES_MOST          SCENE_MORE_(BODIES_OF(SCENE_LARGE_CAPS), BODIES_OF(SCENE_GAME_CAPS))

#define BOARD_DRAWS (BOARD_DRAW_BYTES > 0)

static _Alignas(8) uint8_t world_block[SCENE_WORLD_BYTES];
static _Alignas(8) uint8_t draw_block[BOARD_DRAWS ? BOARD_DRAW_BYTES : 1];

/* Return a result that is not an error. An error is printed and ends the program. */
static int expect(int result, const char *what)
{
    if (result < 0) {
        port_print("%s: %s\n", what, carom_result_text(result));
        port_exit(1);
    }
    return result;
}

/* Instructions if the port counts them; otherwise ticks. */
static unsigned long cost(uint32_t ticks)
{
    return (unsigned long)(port_instructions(port_ticks_hz) ? port_instructions(ticks) : ticks);
}

/* The largest number of ticks that is at most so many instructions. */
static uint32_t ticks_of(unsigned long most)
{
    uint32_t ticks = 0;

    for (uint32_t bit = (uint32_t)1 << 31; bit; bit >>= 1) {
        if (cost(ticks | bit) <= most) {
            ticks |= bit;
        }
    }
    return ticks;
}

static void print_hash(const struct carom_world *world)
{
    uint64_t hash = carom_world_hash(world);

    /* in two halves: newlib's small printf has no 64-bit formats */
    port_print("%08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffff));
}

/* Read the mesh that the option mesh=file names. True if the option is given. */
static bool read_mesh(struct carom_mesh_raw *user)
{
    const char *file = port_option("mesh");

    if (!file) {
        return false;
    }
#ifdef SCENE_ROM
    (void)user;
    port_print("mesh=: this board has no memory for it\n");
    port_exit(1);
#else
    long bytes = port_read_file(file, file_block, sizeof file_block);

    if (bytes < 0) {
        port_print("%s: cannot be read\n", file);
        port_exit(1);
    }
    expect(carom_mesh_read(user, file_block, (size_t)bytes, user_block, sizeof user_block), file);
    return true;
#endif
}

static void print_scenes(void)
{
    for (int i = 0; scene_name(i); i++) {
        port_print("scene %s: %s\n", scene_name(i), scene_text(i));
    }
}

static void load(struct scene *scene)
{
    const char *name = port_option("scene") ? port_option("scene") : TEXT(BOARD_SCENE);
    struct carom_mesh_raw user;
    bool is_user = read_mesh(&user);

    int result = scene_load(scene, name, is_user ? &user : NULL, mesh_block, sizeof mesh_block);

    if (result == CAROM_ERR_ARGUMENT) {
        print_scenes();
    }
    expect(result, name);
    port_print("scene %s: %d x %lu faces on %lu\n", name, 1 + scene->other_count,
               (unsigned long)scene->body.mesh->raw.face_count,
               (unsigned long)scene->ground.mesh->raw.face_count);
}

static void print_columns(void)
{
    port_print("unit %s\n", port_instructions(port_ticks_hz) ? "instructions" : TEXT(BOARD_UNIT));
    port_print("columns frame,status,substeps,hits,contacts,candidates,faces");
    for (int stage = 0; stage < CAROM_STAGE_COUNT; stage++) {
        port_print(",%s", carom_stage_name(stage));
    }
    port_print(",total,draw,over,hash\n");
}

static void print_frame(const struct carom_world *world, int frame, int status, uint32_t draw_ticks)
{
    const struct carom_face_ref *faces;
    struct carom_stats stats;

    expect(carom_stats(world, &stats), "stats");
    port_print("frame %d,%d,%lu,%lu,%lu,%lu,%d", frame, status, (unsigned long)stats.substeps,
               (unsigned long)stats.hits, (unsigned long)stats.contacts,
               (unsigned long)stats.candidates,
               expect(carom_interfering_faces(world, &faces), "faces"));
    for (int stage = 0; stage < CAROM_STAGE_COUNT; stage++) {
        port_print(",%lu", cost(stats.ticks[stage]));
    }
    port_print(",%lu,%lu,%s,", cost(stats.total_ticks), cost(draw_ticks),
               status & CAROM_OVER_BUDGET ? carom_stage_name((int)stats.over_stage) : "-");
    print_hash(world);
}

static void print_usage(const struct carom_world *world)
{
    struct carom_usage usage[CAROM_POOL_COUNT];

    expect(carom_usage(world, usage), "usage");
    for (int pool = 0; pool < CAROM_POOL_COUNT; pool++) {
        port_print("usage %s,%lu,%lu,%lu,%lu\n", usage[pool].name, (unsigned long)usage[pool].size,
                   (unsigned long)usage[pool].used, (unsigned long)usage[pool].peak,
                   (unsigned long)usage[pool].refused);
    }
}

/* Draw a game's line of text at the top; the next picture overwrites it. */
static void say(const struct show *show, const struct carom_world *world,
                const struct carom_picture *picture, struct carom_drawn *drawn)
{
    const struct carom_text where = {.x = 2,
                                     .y = 2,
                                     .scale = (uint8_t)(1 + picture->width / 400),
                                     .opaque = true,
                                     .colour = CAROM_COLOUR_WHITE,
                                     .paper = CAROM_COLOUR_BLACK};
    char text[SCENE_TEXT];

    show_say(show, world, text);
    if (text[0]) {
        expect(carom_draw_text(picture, &where, text, &drawn->touched), "text");
    }
}

/*
 * The colours of a scene. Displays with greys keep the default palette, which tells bodies from the
 * ground.
 */
static const struct carom_paint *paint_for(const struct show *show, const struct port_fb *fb)
{
    return !BOARD_DRAWS || fb->format == PORT_GREY4 ? NULL : show_paint(show);
}

/*
 * Draw the changes in the upper `height` rows of a framebuffer, if there is one. Returns the ticks
 * that it took.
 */
static uint32_t draw(const struct carom_world *world, const struct show *show,
                     const struct port_fb *fb, int32_t height, enum carom_draw_style style)
{
    static struct carom_drawn_body bodies[BODIES_MOST];
    static struct carom_drawn drawn = {.bodies = bodies, .room = BODIES_MOST};
    struct carom_picture picture = {.pixels = fb->pixels,
                                    .width = fb->width,
                                    .height = height,
                                    .stride = fb->stride,
                                    .format = fb->format,
                                    .row = fb->row,
                                    .workspace = draw_block,
                                    .workspace_bytes = sizeof draw_block,
                                    .paint = paint_for(show, fb)};
    uint32_t start = port_ticks();

    if (!BOARD_DRAWS || !(fb->pixels || fb->row)) {
        return 0;
    }
    expect(carom_draw_changes(world, show_camera(show, world), &picture, style, &drawn), "draw");
    say(show, world, &picture, &drawn);
    return port_ticks() - start;
}

/* The display, with the scene's own palette if the display can have one. */
static struct port_fb display(const struct show *show)
{
    struct port_fb fb = port_fb();

    if (BOARD_DRAWS && fb.palette) {
        fb.palette(show_paint(show)->palette);
    }
    return fb;
}

static struct carom_world *make(const struct scene *scene)
{
    struct carom_config config = scene_config();
    struct carom_world *world;

    config.ticks = port_ticks;
    config.budget_ticks = port_option("budget") ? ticks_of(port_number("budget", 0)) : 0;
    config.sleep = port_option("awake") == NULL;
    expect(scene_make(scene, &config, world_block, sizeof world_block, &world), "world");
    return world;
}

static struct carom_world *start(struct show *show)
{
    struct carom_world *world;
    struct scene scene;
    const struct carom_caps *caps = &scene.caps;

    load(&scene);
    world = make(&scene);
    port_print("world %lu\n",
               (unsigned long)CAROM_WORLD_BYTES(caps->bodies, caps->pairs, caps->contacts,
                                                caps->faces, caps->entries, caps->candidates,
                                                caps->joints, caps->extras, caps->hits));
    *show = show_of(&scene);
    return world;
}

/* The held keys. Until the first key goes down, the script plays. */
static uint32_t keys_held(void)
{
    static bool played;
    uint32_t keys = port_input();

    played |= keys != 0;
    return played ? keys : SCENE_NOBODY;
}

/* Print a row of figures for a frame. */
static void report(int frames)
{
    struct show show;
    struct carom_world *world = start(&show);
    struct port_fb fb = display(&show);
    const int only = (int)port_number("only", 0);
    uint32_t first;

    /* draw the whole picture now, so that a frame draws only its changes */
    first = only ? 0 : draw(world, &show, &fb, fb.height, CAROM_DRAW_FLAT);
    port_print("first picture %lu\n", cost(first));
    print_columns();
    for (int frame = 1; frame <= frames; frame++) {
        const bool shown = !only || frame == only;
        uint32_t draw_ticks = 0;
        int status;

        if (BOARD_MOVES) {
            expect(show_before(&show, world, frame, keys_held()), "scene");
        }
        status = expect(carom_world_step(world), "step");
        if (shown) {
            draw_ticks = draw(world, &show, &fb, fb.height, CAROM_DRAW_FLAT);
            port_present();
        }
        print_frame(world, frame, status, draw_ticks);
    }
    print_usage(world);
    if (port_stack()) {
        port_print("stack %lu\n", (unsigned long)port_stack());
    }
    port_print("hash ");
    print_hash(world);
}

/* Play with the pad; frames == 0: without end. */
static void play(int frames)
{
#if SCENE_GAMES
    static struct scene
        scene; /* static: the stack of a small board has no room for a game's scene */
#else
    struct scene scene;
#endif
    struct show show;
    struct carom_world *world;
    struct port_fb fb;
    struct scene_play play = {.due = port_ticks()};
    uint32_t draw_ticks = 0;
    struct carom_stats stats;
    int age = 0; /* frames since the scene began */

    load(&scene);
    world = make(&scene);
    show = show_of(&scene);
    fb = display(&show);
    for (int frame = 1; frames == 0 || frame <= frames; frame++) {
        uint32_t keys = keys_held();

        /* the player may have done more than the pools hold */
        age++;
        if (!scene_play_keys(&play, &scene, world, keys == SCENE_NOBODY ? 0 : keys) ||
            show_before(&show, world, age, keys) < 0 || carom_world_step(world) < 0) {
            world = make(&scene);
            age = 0;
        }
        if (scene_play_draws(&play)) {
            expect(carom_stats(world, &stats), "stats");
            draw_ticks = draw(world, &show, &fb, fb.height - (play.plain ? 0 : SCENE_PLAY_ROWS),
                              play.lines && !fb.row ? CAROM_DRAW_WIRE : CAROM_DRAW_FLAT);
            if (!play.plain) {
                scene_play_figures(&fb, stats.total_ticks, draw_ticks);
            }
            port_present();
        }
    }
    port_print("hash ");
    print_hash(world);
}

int main(void)
{
    int frames;

    port_init();
    if (port_option("scenes")) {
        print_scenes();
        port_exit(0);
    }
    frames = (int)port_number("frames", port_arg(0) ? 600 : 0);
    if (BOARD_DRAWS && (frames == 0 || port_option("play"))) {
        play(frames);
    } else {
        report(frames);
    }
    port_exit(0);
}

/* SPDX-License-Identifier: MIT */
/* The viewer: the scene on show, its time, and its pictures. */
#include "view.h"

#include <string.h>

#include "view_parts.h"

/* ------------------------------------------------------------------- memory */

/* Size of the largest mesh of scene `user`. */
#define USER_VERTICES 24000
#define USER_FACES    (2 * USER_VERTICES)
#define USER_MESH_BYTES                                                                            \
    (SCENE_MESH(USER_VERTICES, USER_FACES) + SCENE_MESH(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES))
#define NAME_BYTES  32
#define BODIES_ROOM 1024
/* Bodies, lines, and the outlines of shadows. */
#define DRAW_BYTES                                                                                 \
    (CAROM_DRAW_BYTES(USER_VERTICES + 26000, USER_FACES + 50000) + VIEW_LINES_MAX * 52 + (1 << 19))

static _Alignas(8) uint8_t mesh_block[SCENE_MORE_(USER_MESH_BYTES, SCENE_LARGE_MESH_BYTES)];
static _Alignas(8) uint8_t world_block[SCENE_WORLD_BYTES];
static _Alignas(8) uint8_t draw_block[DRAW_BYTES];
static int16_t user_vertices[USER_VERTICES][3];
static uint16_t user_faces[USER_FACES][3];

static struct {
    char name[NAME_BYTES];
    struct carom_mesh_raw user; /* of scene `user` */
    struct scene scene;
    struct show show;
    struct carom_world *world; /* NULL if no scene is open */
    int32_t steps;
    int error; /* error of the last step; CAROM_OK: the scene goes on */
    bool paused;
    int32_t slow, calls; /* a step every `slow` calls; calls since the last step */
    uint32_t toggles;
    struct carom_stats stats;
    char says[SCENE_TEXT];
    struct carom_picture picture;
} view = {.slow = 1, .toggles = VIEW_FACES | VIEW_SHADOWS};

static struct carom_drawn_body drawn_bodies[BODIES_ROOM];
static struct carom_drawn drawn;

/* Forget the last picture. */
static void forget_picture(void)
{
    drawn = (struct carom_drawn){.bodies = drawn_bodies, .room = BODIES_ROOM};
}

/* -------------------------------------------------------------------- scenes */

static int make_world(void)
{
    struct carom_config config = scene_config();
    int result;

    config.ticks = port_ticks;
    result = scene_load(&view.scene, view.name, view.user.vertices ? &view.user : NULL, mesh_block,
                        sizeof mesh_block);
    if (result >= 0) {
        result = scene_make(&view.scene, &config, world_block, sizeof world_block, &view.world);
    }
    if (result < 0) {
        view.world = NULL;
    }
    return result;
}

static int begin(void)
{
    int result;

    view.world = NULL;
    view.steps = 0;
    view.calls = 0;
    view.error = CAROM_OK;
    view.says[0] = 0;
    view.stats = (struct carom_stats){.total_ticks = 0};
    view_acts_clear();
    view_hand.holds = false;
    view_panel_reset();
    forget_picture();
    result = make_world();
    if (result >= 0) {
        view.show = show_of(&view.scene);
        show_say(&view.show, view.world, view.says);
    }
    return result < 0 ? result : CAROM_OK;
}

static int take_mesh(const struct carom_mesh_raw *mesh)
{
    if (mesh->vertex_count > USER_VERTICES || mesh->face_count > USER_FACES) {
        return CAROM_ERR_MEMORY;
    }
    memmove(user_vertices, mesh->vertices, mesh->vertex_count * sizeof user_vertices[0]);
    memmove(user_faces, mesh->faces, mesh->face_count * sizeof user_faces[0]);
    view.user = *mesh;
    view.user.vertices = (const int16_t(*)[3])user_vertices;
    view.user.faces = (const uint16_t(*)[3])user_faces;
    return CAROM_OK;
}

int view_open(const char *name, const struct carom_mesh_raw *mesh)
{
    size_t length = strlen(name);
    int result = CAROM_OK;

    view.world = NULL;
    if (length >= NAME_BYTES) {
        return CAROM_ERR_ARGUMENT;
    }
    memmove(view.name, name, length + 1);
    view.user = (struct carom_mesh_raw){.vertices = NULL};
    if (mesh) {
        result = take_mesh(mesh);
    }
    if (result >= 0) {
        result = begin();
    }
    view_camera_reset();
    return result;
}

int view_restart(void)
{
    return view.name[0] ? begin() : CAROM_ERR_ARGUMENT;
}

/* ---------------------------------------------------------------------- time */

static int step(void)
{
    int result;

    if (!view.world || view.error < 0) {
        return view.world ? view.error : CAROM_ERR_NULL;
    }
    view_acts_before(view.world, view.steps + 1);
    result = show_before(&view.show, view.world, view.steps + 1, view_acts_keys());
    if (result >= 0) {
        view_hand_pull(view.world);
        result = carom_world_step(view.world);
    }
    if (result < 0) {
        view.error = result;
        return result;
    }
    view.steps++;
    carom_stats(view.world, &view.stats);
    view_panel_step(&view.stats);
    show_say(&view.show, view.world, view.says);
    return 1;
}

void view_pause(bool paused)
{
    view.paused = paused;
}

int view_single(void)
{
    return view.paused ? step() : 0;
}

void view_slow(int32_t n)
{
    view.slow = n < 1 ? 1 : n > 60 ? 60 : n;
    view.calls = 0;
}

int view_frame(void)
{
    if (view.error < 0) {
        return view.error;
    }
    if (view.paused || ++view.calls < view.slow) {
        return 0;
    }
    view.calls = 0;
    return step();
}

/* ------------------------------------------------------------------- looking */

void view_toggles(uint32_t toggles)
{
    view.toggles = toggles;
    forget_picture();
}

uint32_t view_usual(void)
{
    const struct carom_paint *own = view.world ? show_paint(&view.show) : NULL;

    return VIEW_SHADOWS | (own && own->hide_interfering ? 0 : VIEW_FACES);
}

const struct carom_camera *view_scene_camera(void)
{
    static const struct carom_camera somewhere = {.eye = {{0, -((int64_t)5 << 32), 0}},
                                                  .focal_q16 = 1 << 16};

    return view.world ? show_camera(&view.show, view.world) : &somewhere;
}

const struct carom_picture *view_picture(void)
{
    return &view.picture;
}

int view_size(const struct carom_picture *picture)
{
    if (picture->format != CAROM_XRGB8888 || !picture->pixels || picture->width < 1 ||
        picture->height < 1) {
        return CAROM_ERR_ARGUMENT;
    }
    view.picture = *picture;
    view.picture.row = NULL;
    view.picture.workspace = draw_block;
    view.picture.workspace_bytes = sizeof draw_block;
    forget_picture();
    return CAROM_OK;
}

/* Draw lines and text over the bodies. */
static void draw_over(const struct carom_picture *picture)
{
    if (view.toggles & VIEW_CONTACTS) {
        view_contacts(view.world, picture, &drawn.touched);
    }
    view_hand_draw(view.world, picture, &drawn.touched);
    view_panel(picture, view.toggles, &drawn.touched);
}

int view_draw(void)
{
    struct carom_picture picture = view.picture;
    struct carom_paint paint;
    uint32_t start = port_ticks();
    int result;

    if (!view.world || !picture.pixels) {
        return CAROM_ERR_NULL;
    }
    paint = *view_paint(view.world, show_paint(&view.show), view.toggles);
    if (view.toggles & VIEW_CELLS) {
        view_cells(view.world, &paint);
    }
    picture.paint = &paint;
    result =
        carom_draw_changes(view.world, view_camera(), &picture,
                           view.toggles & VIEW_WIRE ? CAROM_DRAW_WIRE : CAROM_DRAW_FLAT, &drawn);
    if (result >= 0) {
        view_panel_drew(port_ticks() - start);
        draw_over(&picture);
    }
    return result;
}

/* -------------------------------------------------------------------- asking */

int32_t view_step_count(void)
{
    return view.steps;
}

uint64_t view_hash(void)
{
    return carom_world_hash(view.world);
}

const struct carom_stats *view_stats(void)
{
    return &view.stats;
}

const struct carom_world *view_world(void)
{
    return view.world;
}

const char *view_scene(void)
{
    return view.name;
}

const char *view_says(void)
{
    return view.says;
}

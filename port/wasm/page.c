/* SPDX-License-Identifier: MIT */
/*
 * page.c - the viewer of view.h in a page: memory for the data between the viewer and JavaScript.
 * The page calls all other functions directly: board.mk exports them. Text goes both ways in
 * page_text, with a 0 at its end.
 */
#include "port.h"
#include "scene.h"
#include "view.h"

#define EXPORT       __attribute__((used, visibility("default")))
#define IMPORT(name) __attribute__((import_module("page"), import_name(#name)))
#define PIXELS_MAX   (1920 * 1080)
#define TEXT_BYTES   (1 << 18)
#define VERTICES_MAX 24000 /* vertices of a mesh that the page brings */
#define FACES_MAX    (2 * VERTICES_MAX)

/* Microseconds, by the browser's clock, which advances in steps of its own. */
IMPORT(ticks) uint32_t page_ticks(void);
const uint32_t port_ticks_hz = 1000000;

uint32_t port_ticks(void)
{
    return page_ticks();
}

EXPORT char page_text[TEXT_BYTES];
EXPORT int16_t page_vertices[VERTICES_MAX][3];
EXPORT uint16_t page_faces[FACES_MAX][3];
EXPORT uint32_t page_shown[PIXELS_MAX]; /* in the order of a canvas: red in the lowest byte */

static uint32_t pixels[PIXELS_MAX];
static _Alignas(8) uint8_t mesh_check[CAROM_MESH_BYTES(VERTICES_MAX, FACES_MAX)];
static struct carom_picture picture;

/* Room for text, vertices, faces and pixels; and the number of stages. */
int page_room(int what)
{
    static const int room[] = {TEXT_BYTES, VERTICES_MAX, FACES_MAX, PIXELS_MAX, CAROM_STAGE_COUNT};

    return room[what];
}

/*
 * Open scene `user` with the mesh in page_vertices and page_faces. If the mesh is refused, the
 * present scene stays.
 */
int page_open_mesh(uint32_t vertices, uint32_t faces)
{
    struct carom_mesh_raw raw = {page_vertices, page_faces, vertices, faces, 12, CAROM_SOLID};
    int result;

    if (vertices > VERTICES_MAX || faces > FACES_MAX) {
        return CAROM_ERR_MEMORY;
    }
    result = carom_mesh_check(&raw, mesh_check, sizeof mesh_check);
    return result < 0 ? result : view_open("user", &raw);
}

int page_size(int32_t width, int32_t height)
{
    if (width < 1 || height < 1 || width > PIXELS_MAX / height) {
        return CAROM_ERR_ARGUMENT;
    }
    picture = (struct carom_picture){.pixels = pixels,
                                     .width = width,
                                     .height = height,
                                     .stride = width * (int32_t)sizeof pixels[0],
                                     .format = CAROM_XRGB8888};
    return view_size(&picture);
}

int page_draw(void)
{
    int result = view_draw();

    for (int32_t i = 0; i < picture.width * picture.height; i++) {
        uint32_t rgb = pixels[i];

        page_shown[i] = 0xff000000u | (rgb & 0xff) << 16 | (rgb & 0xff00) | (rgb >> 16 & 0xff);
    }
    return result;
}

/* Microseconds that the last step took for a stage; past the last stage, for all of it. */
uint32_t page_took(int stage)
{
    const struct carom_stats *stats = view_stats();

    return stage < CAROM_STAGE_COUNT ? stats->ticks[stage] : stats->total_ticks;
}

/* True if the scene on show is a game, which obeys the keys of a pad. */
int page_is_game(void)
{
    return view_says()[0] != 0;
}

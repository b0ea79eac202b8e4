/* SPDX-License-Identifier: MIT */
#include "draw.h"

#define WIRE_SHADE (DRAW_SHADES * 3 / 4)

/* ---------------------------------------------------------------- wireframe */

static bool faces_eye(const struct draw_body *body, const struct carom_face *face)
{
    return carom_dot(face->normal.c, body->eye) >
           (int64_t)(face->offset_q22 >> body->shift) * CAROM_ONE_Q30;
}

static void draw_edge(const struct carom_picture *picture, const struct draw_body *body,
                      uint16_t from, uint16_t to, uint32_t colour)
{
    struct draw_vertex end[DRAW_CLIP_MAX];
    const uint16_t numbers[2] = {from, to};

    if ((draw_vertex(body, from, &end[0]) && draw_vertex(body, to, &end[1])) ||
        draw_clip(body, numbers, 2, end) >= 2) {
        draw_line(picture, &end[0], &end[1], colour);
    }
}

/*
 * The edges that are drawn for a face: an edge belongs to the first of its two faces, and is seen
 * when either of them looks at the eye.
 */
static void draw_face_wire(const struct carom_picture *picture, const struct draw_body *body,
                           uint32_t number)
{
    const struct carom_mesh *mesh = body->mesh;
    const struct carom_face *face = &mesh->faces[number];
    bool front = faces_eye(body, face);
    uint32_t colour =
        draw_colour(picture->format, draw_ramp_entry(body->moving, false, WIRE_SHADE));

    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[face->edge[k]];

        if (edge->face[0] == number && (front || (edge->face[1] != CAROM_NO_FACE &&
                                                  faces_eye(body, &mesh->faces[edge->face[1]])))) {
            draw_edge(picture, body, edge->vertex[0], edge->vertex[1], colour);
        }
    }
}

static void draw_body_wire(const struct carom_picture *picture, const struct draw_body *body)
{
    const struct carom_mesh *mesh = body->mesh;

    for (uint32_t l = 0; l < mesh->leaf_count; l++) {
        const struct carom_leaf *leaf = &mesh->leaves[l];

        if (draw_sees_sphere(body, &leaf->centre, leaf->radius_q22)) {
            for (uint32_t i = 0; i < leaf->face_count; i++) {
                draw_face_wire(picture, body, mesh->leaf_faces[leaf->first_face + i]);
            }
        }
    }
}

static bool see_body(struct draw_body *body, const struct draw_view *view,
                     const struct carom_world *world, uint32_t number)
{
    return world->bodies[number].mesh &&
           draw_body_init(body, view, &world->bodies[number], &world_now(world)->bodies[number]);
}

/* The interfering faces, over what was drawn of them before. */
static void draw_hot_wire(const struct carom_picture *picture, const struct draw_view *view,
                          const struct carom_world *world)
{
    const struct carom_face_ref *refs;
    int count = carom_interfering_faces(world, &refs);
    struct draw_body body;
    bool seen = false;

    for (int i = 0; i < count; i++) {
        if (i == 0 || refs[i].body != refs[i - 1].body) {
            seen = see_body(&body, view, world, refs[i].body);
        }
        if (seen && refs[i].face < body.mesh->raw.face_count) {
            const uint16_t *corner = body.mesh->raw.faces[refs[i].face];
            uint32_t entry = draw_ramp_entry(body.moving, true, WIRE_SHADE);

            for (int k = 0; k < 3; k++) {
                draw_edge(picture, &body, corner[k], corner[(k + 1) % 3],
                          draw_colour(picture->format, entry));
            }
        }
    }
}

static void draw_wire(const struct carom_world *world, struct draw_view *view,
                      const struct carom_picture *picture)
{
    struct draw_body body;

    for (int32_t y = 0; y < picture->height; y++) {
        draw_ground(picture, y, 0, picture->width);
    }
    for (uint32_t i = 0; i < world->body_count; i++) {
        if (see_body(&body, view, world, i)) {
            draw_body_wire(picture, &body);
        }
    }
    draw_hot_wire(picture, view, world);
}

/* -------------------------------------------------------------------- entry */

/* What carom.h says of a picture. */
static int check_picture(const struct carom_picture *picture, enum carom_draw_style style)
{
    static const uint8_t pixel_bytes[] = {1, 2, 4};
    int32_t bytes;

    if (style != CAROM_DRAW_FLAT && style != CAROM_DRAW_WIRE) {
        return CAROM_ERR_ARGUMENT;
    }
    if (picture->width < 1 || picture->width > 2 * DRAW_GUARD || picture->height < 1 ||
        picture->height > 2 * DRAW_GUARD || picture->format > CAROM_XRGB8888) {
        return CAROM_ERR_ARGUMENT;
    }
    bytes = pixel_bytes[picture->format];
    if (picture->stride < picture->width * bytes || picture->stride % bytes != 0) {
        return CAROM_ERR_ARGUMENT;
    }
    if ((uintptr_t)picture->pixels % (uintptr_t)bytes != 0) {
        return CAROM_ERR_MEMORY;
    }
    return CAROM_OK;
}

int carom_draw(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style)
{
    struct draw_view view;
    int result;

    if (world == NULL || camera == NULL || picture == NULL || picture->pixels == NULL ||
        (style == CAROM_DRAW_FLAT && picture->workspace == NULL)) {
        return CAROM_ERR_NULL;
    }
    result = check_picture(picture, style);
    if (result == CAROM_OK) {
        result = draw_view_init(&view, camera, picture->width, picture->height);
    }
    if (result != CAROM_OK) {
        return result;
    }
    draw_view_rect(&view, draw_whole(&view, picture));
    if (style == CAROM_DRAW_FLAT) {
        return draw_flat(world, &view, picture);
    }
    draw_wire(world, &view, picture);
    return CAROM_OK;
}

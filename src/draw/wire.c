/* SPDX-License-Identifier: MIT */
/* CAROM_DRAW_WIRE: edges of front faces, interfering faces, lines. */
#include "draw.h"

#define WIRE_SHADE (DRAW_SHADES * 3 / 4)

/* -------------------------------------------------------------------- lines */

static void put_pixel(const struct draw_view *view, const struct carom_picture *picture, int32_t x,
                      int32_t y, uint32_t colour)
{
    const struct draw_rect *rect = &view->rect;

    if (x >= rect->x0 && x < rect->x1 && y >= rect->y0 && y < rect->y1) {
        draw_run(draw_pixels(view, picture, y), draw_pixel_shift(picture->format), x, x + 1,
                 colour);
    }
}

/*
 * One pixel a column, or a row for a steep line, between the pixels that hold the ends. Starting at
 * the lower end makes the pixels independent of the line's direction.
 */
void draw_line(const struct draw_view *view, const struct carom_picture *picture,
               const struct draw_vertex *a, const struct draw_vertex *b, uint32_t colour)
{
    int32_t from[2] = {draw_x(a->yx_q4) >> 4, (draw_y(a->yx_q4) - 7) >> 4};
    int32_t to[2] = {draw_x(b->yx_q4) >> 4, (draw_y(b->yx_q4) - 7) >> 4};
    int32_t size[2] = {to[0] - from[0], to[1] - from[1]};
    int major = carom_abs(size[1]) > carom_abs(size[0]);
    int32_t minor_q16, step_q16 = 0, n;

    if (size[major] < 0) {
        memcpy(from, to, sizeof from);
        size[0] = -size[0];
        size[1] = -size[1];
    }
    n = size[major];
    /* |size| <= 2^11 pixels: the error of a step, 2^-16, grows to 2^-5 of a pixel at the far end */
    if (n > 0) {
        step_q16 = size[!major] * (1 << 16) / n;
    }
    minor_q16 = from[!major] * (1 << 16) + (1 << 15);
    for (int32_t i = 0; i <= n; i++) {
        int32_t at[2];

        at[major] = from[major] + i;
        at[!major] = minor_q16 >> 16;
        put_pixel(view, picture, at[0], at[1], colour);
        minor_q16 += step_q16;
    }
}

/* ---------------------------------------------------------------- wireframe */

static bool faces_eye(const struct draw_body *body, const struct carom_face *face)
{
    return carom_dot(face->normal.c, body->eye) >
           (int64_t)(face->offset_q22 >> body->shift) * CAROM_ONE_Q30;
}

static void draw_edge(const struct draw_view *view, const struct carom_picture *picture,
                      const struct draw_body *body, uint16_t from, uint16_t to, uint32_t colour)
{
    struct draw_vertex end[DRAW_CLIP_MAX];
    const uint16_t numbers[2] = {from, to};

    if ((draw_vertex(body, from, &end[0]) && draw_vertex(body, to, &end[1])) ||
        draw_clip(body, numbers, 2, end) >= 2) {
        draw_line(view, picture, &end[0], &end[1], colour);
    }
}

/*
 * Draw a face's edges. An edge belongs to the first of its two faces, and shows if either face
 * looks at the eye.
 */
static void draw_face_wire(const struct draw_view *view, const struct carom_picture *picture,
                           const struct draw_body *body, uint32_t number)
{
    const struct carom_mesh *mesh = body->mesh;
    const struct carom_face *face = &mesh->faces[number];
    bool front = faces_eye(body, face);
    uint32_t ramp = draw_face_ramp(&body->coat, picture->paint, number);
    uint32_t colour = draw_colour(picture, ramp * DRAW_SHADES + WIRE_SHADE);

    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[face->edge[k]];

        if (edge->face[0] == number && (front || (edge->face[1] != CAROM_NO_FACE &&
                                                  faces_eye(body, &mesh->faces[edge->face[1]])))) {
            draw_edge(view, picture, body, edge->vertex[0], edge->vertex[1], colour);
        }
    }
}

static void draw_body_wire(const struct draw_view *view, const struct carom_picture *picture,
                           const struct draw_body *body)
{
    const struct carom_mesh *mesh = body->mesh;

    for (uint32_t l = 0; l < mesh->leaf_count; l++) {
        const struct carom_leaf *leaf = &mesh->leaves[l];

        if (draw_sees_sphere(body, &leaf->centre, leaf->radius_q22)) {
            for (uint32_t i = 0; i < leaf->face_count; i++) {
                draw_face_wire(view, picture, body, mesh->leaf_faces[leaf->first_face + i]);
            }
        }
    }
}

static bool see_body(struct draw_body *body, const struct draw_view *view,
                     const struct draw_source *source, uint32_t number)
{
    struct carom_body_look look;

    if (!draw_look(source, number, &look) || !draw_body_init(body, view, &look)) {
        return false;
    }
    draw_paint_body(&body->coat, source->paint, number);
    return true;
}

/* Draw the interfering faces over their first wireframe. */
static void draw_hot_wire(const struct carom_picture *picture, const struct draw_view *view,
                          const struct draw_source *source)
{
    const struct carom_face_ref *refs = source->hot;
    struct draw_body body;
    bool seen = false;

    for (int i = 0; i < source->hot_count; i++) {
        if (i == 0 || refs[i].body != refs[i - 1].body) {
            seen = see_body(&body, view, source, refs[i].body);
        }
        if (seen && refs[i].face < body.mesh->raw.face_count) {
            const uint16_t *corner = body.mesh->raw.faces[refs[i].face];
            uint32_t entry = body.coat.hot * (uint32_t)DRAW_SHADES + WIRE_SHADE;

            for (int k = 0; k < 3; k++) {
                draw_edge(view, picture, &body, corner[k], corner[(k + 1) % 3],
                          draw_colour(picture, entry));
            }
        }
    }
}

static void draw_lines(const struct carom_picture *picture, const struct draw_view *view)
{
    const struct carom_paint *paint = picture->paint;

    for (uint32_t i = 0; paint && i < paint->line_count; i++) {
        const struct carom_paint_line *line = &paint->lines[i];
        struct draw_vertex ends[2];

        if (draw_segment(view, &line->from, &line->to, ends)) {
            draw_line(view, picture, &ends[0], &ends[1], draw_colour(picture, line->colour));
        }
    }
}

void draw_wire(const struct draw_source *source, struct draw_view *view,
               const struct carom_picture *picture, const struct draw_rect *part)
{
    struct draw_body body;

    /* a line may leave its place by a pixel: draw what is that near, too */
    draw_view_rect(view,
                   (struct draw_rect){part->x0 - 2, part->y0 - 2, part->x1 + 2, part->y1 + 2});
    view->rect = *part;
    for (int32_t y = part->y0; y < part->y1; y++) {
        draw_run(draw_pixels(view, picture, y), draw_pixel_shift(picture->format), part->x0,
                 part->x1, draw_ground(view, picture, y));
    }
    for (uint32_t i = 0; i < source->count; i++) {
        if (see_body(&body, view, source, i)) {
            draw_body_wire(view, picture, &body);
        }
    }
    draw_hot_wire(picture, view, source);
    draw_lines(picture, view);
}

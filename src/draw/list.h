/* SPDX-License-Identifier: MIT */
/* list - put faces and their corners into the list of what shows in a part of the picture. */
#ifndef CAROM_SRC_DRAW_LIST_H
#define CAROM_SRC_DRAW_LIST_H

#include "draw.h"

#define LIST_VERTICES_MAX 0x8000u
#define LIST_FACES_MAX    0xffffu

/* Free bytes between vertices and faces. */
static inline size_t list_room(const struct draw_list *list)
{
    return (size_t)((const uint8_t *)(list->faces - (list->face_count - 1)) -
                    (const uint8_t *)(list->vertices + list->vertex_count));
}

/*
 * The palette entry of a face. Shade 0 faces straight away from the light, so that the far side
 * keeps its relief without a second light. The light is a little short, so that shades stay below
 * DRAW_SHADES; the ramp is in the bits above.
 */
static inline uint32_t list_colour(const struct draw_body *body, const struct carom_paint *paint,
                                   const carom_v3_q30 *normal, uint32_t number)
{
    uint32_t colour = ((uint32_t)(carom_dot(normal->c, body->light.c) >> 32) + body->ramp) >> 24;

    if (body->hot) {
        bool hot = body->hot[number >> 5] >> (number & 31) & 1;

        if (paint) {
            uint32_t ramp = hot ? body->coat.hot : draw_face_ramp(&body->coat, paint, number);

            return ramp * DRAW_SHADES + colour % DRAW_SHADES;
        }
        if (hot) {
            colour += (DRAW_STATIONARY_HOT - DRAW_STATIONARY) * DRAW_SHADES;
        }
    }
    return colour;
}

/* Add a vertex and return its place. There must be room. */
static inline uint32_t list_vertex(struct draw_list *list, struct draw_vertex vertex)
{
    list->vertices[list->vertex_count] = vertex;
    return list->vertex_count++;
}

/* List a face by its first row, if it shows in the part. There must be room. */
static inline void list_face(const struct draw_rect *rect, struct draw_list *list, uint32_t i,
                             uint32_t j, uint32_t k, uint32_t colour, bool inside)
{
    int32_t a = list->vertices[i].yx_q4, b = list->vertices[j].yx_q4;
    int32_t c = list->vertices[k].yx_q4, top, end;
    struct draw_face *face;
    uint16_t *row;

    /* the top corner first */
    if (b < a && b <= c) {
        int32_t yx_q4 = a;
        uint32_t place = i;

        a = b, b = c, c = yx_q4;
        i = j, j = k, k = place;
    } else if (c < a) {
        int32_t yx_q4 = a;
        uint32_t place = i;

        a = c, c = b, b = yx_q4;
        i = k, k = j, j = place;
    }
    top = draw_row(a);
    end = draw_row(b > c ? b : c);
    if (!inside) {
        int32_t left = rect->x0 * 16, right = rect->x1 * 16;

        top = top > rect->y0 ? top : rect->y0;
        if (top >= rect->y1 || (draw_x(a) < left && draw_x(b) < left && draw_x(c) < left) ||
            (draw_x(a) >= right && draw_x(b) >= right && draw_x(c) >= right)) {
            return;
        }
    }
    if (top >= end) {
        return;
    }
    face = &list->faces[-(int32_t)list->face_count];
    row = &list->rows[top - rect->y0];
    face->corner[0] = (uint16_t)i;
    face->corner[1] = (uint16_t)j;
    face->corner[2] = (uint16_t)k;
    face->next = *row;
    face->colour = (uint16_t)colour;
    *row = (uint16_t)list->face_count++;
}

#endif

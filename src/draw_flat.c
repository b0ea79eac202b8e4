/* SPDX-License-Identifier: MIT */
#include "draw.h"

/* Where a pass over the world is. */
struct flat {
    const struct carom_world *world;
    struct draw_view *view;
    struct draw_list list;
    struct draw_body body;
    uint16_t *seen; /* a vertex of the body -> where it is in the list; 0 when it is not */
    uint32_t *hot;  /* a bit for each face of the body: whether it interferes; or NULL */
    uint32_t *hot_bits;
    struct draw_vertex *vertices;
    uint8_t *end; /* of the workspace */
    bool full;
};

/* ------------------------------------------------------------ into the list */

/* The number of a new vertex, or 0 when there is no room. */
static uint32_t list_vertex(struct draw_list *list, struct draw_vertex vertex)
{
    if (list->room < (int32_t)sizeof vertex || list->vertex_count == UINT16_MAX) {
        return 0;
    }
    list->room -= (int32_t)sizeof vertex;
    list->vertices[list->vertex_count] = vertex;
    return list->vertex_count++;
}

/*
 * List a face that shows in the part of the picture, by its first row. Returns false when there is
 * no room.
 */
static bool list_face(const struct draw_view *view, struct draw_list *list, uint32_t i, uint32_t j,
                      uint32_t k, uint32_t colour)
{
    const struct draw_vertex *a = &list->vertices[i], *b = &list->vertices[j];
    const struct draw_vertex *c = &list->vertices[k];
    int32_t top = a->y_q4, low = b->y_q4 > c->y_q4 ? b->y_q4 : c->y_q4;
    int32_t left = view->rect.x0 * 16 - view->middle_q4[0];
    int32_t right = view->rect.x1 * 16 - view->middle_q4[0];
    struct draw_face *face;
    uint16_t *row;

    /* the top corner first */
    if (b->y_q4 < top && b->y_q4 <= c->y_q4) {
        uint32_t first = i;

        low = c->y_q4 > top ? c->y_q4 : top;
        top = b->y_q4;
        i = j;
        j = k;
        k = first;
    } else if (c->y_q4 < top) {
        uint32_t first = i;

        low = b->y_q4 > top ? b->y_q4 : top;
        top = c->y_q4;
        i = k;
        k = j;
        j = first;
    }
    top = (top + view->middle_q4[1] + 7) >> 4;
    low = (low + view->middle_q4[1] + 7) >> 4;
    top = top > view->rect.y0 ? top : view->rect.y0;
    if (top >= low || top >= view->rect.y1 ||
        (a->x_q4 < left && b->x_q4 < left && c->x_q4 < left) ||
        (a->x_q4 >= right && b->x_q4 >= right && c->x_q4 >= right)) {
        return true;
    }
    if (list->room < (int32_t)sizeof *face || list->face_count == UINT16_MAX) {
        return false;
    }
    list->room -= (int32_t)sizeof *face;
    face = &list->faces[-(int32_t)list->face_count];
    row = &list->rows[top - view->rect.y0];
    *face = (struct draw_face){{(uint16_t)i, (uint16_t)j, (uint16_t)k}, *row, (uint16_t)colour};
    *row = (uint16_t)list->face_count++;
    return true;
}

static bool list_clipped(struct flat *f, const uint16_t numbers[3], uint32_t colour)
{
    struct draw_vertex corner[DRAW_CLIP_MAX];
    uint32_t place[DRAW_CLIP_MAX];
    int n = draw_clip(&f->body, numbers, 3, corner);

    for (int i = 0; i < n; i++) {
        place[i] = list_vertex(&f->list, corner[i]);
        if (place[i] == 0) {
            return false;
        }
    }
    for (int i = 2; i < n; i++) {
        if (!list_face(f->view, &f->list, place[0], place[i - 1], place[i], colour)) {
            return false;
        }
    }
    return true;
}

static bool see_face(struct flat *f, uint32_t number, uint32_t colour)
{
    const uint16_t *numbers = f->body.mesh->raw.faces[number];
    const struct draw_vertex *vertices = f->list.vertices;
    uint32_t place[3];

    for (int k = 0; k < 3; k++) {
        place[k] = f->seen[numbers[k]];
        if (place[k] == 0) {
            place[k] = list_vertex(&f->list, draw_vertex(&f->body, numbers[k]));
            f->seen[numbers[k]] = (uint16_t)place[k];
            if (place[k] == 0) {
                return false;
            }
        }
    }
    if (vertices[place[0]].w_q26 == 0 || vertices[place[1]].w_q26 == 0 ||
        vertices[place[2]].w_q26 == 0) {
        return list_clipped(f, numbers, colour);
    }
    return list_face(f->view, &f->list, place[0], place[1], place[2], colour);
}

/* ------------------------------------------------------- over bodies, faces */

/*
 * Shade 0 looks straight away from the light: the far side keeps its relief without a second light.
 * The light is a little short, so that shades stay below DRAW_SHADES; the ramp is in the bits above.
 */
static uint32_t face_colour(const struct draw_body *body, const carom_v3_q30 *normal, bool hot)
{
    uint32_t ramp = draw_ramp_entry(body->moving, hot, 0);

    return ((uint32_t)(carom_dot(normal->c, body->light.c) >> 32) + (ramp << 24) + (1u << 28)) >>
           24;
}

static bool see_leaf(struct flat *f, const struct carom_leaf *leaf)
{
    const struct draw_body *body = &f->body;
    const struct carom_mesh *mesh = body->mesh;
    const uint16_t *numbers = &mesh->leaf_faces[leaf->first_face];
    int shift = 2 + body->shift;

    for (uint32_t i = 0; i < leaf->face_count; i++) {
        uint32_t number = numbers[i];
        const struct carom_face *face = &mesh->faces[number];

        /* q(20 - shift): nothing shows of a face that is seen so much edge-on that it matters */
        if ((int32_t)(carom_dot(face->normal.c, body->eye) >> 32) > face->offset_q22 >> shift) {
            bool hot = f->hot && (f->hot[number >> 5] >> (number & 31) & 1);

            if (!see_face(f, number, face_colour(body, &face->normal, hot))) {
                return false;
            }
        }
    }
    return true;
}

/* Mark the interfering faces of a body. */
static void mark_hot(struct flat *f, uint32_t number)
{
    const struct carom_face_ref *refs;
    int count = carom_interfering_faces(f->world, &refs);
    uint32_t faces = f->body.mesh->raw.face_count;

    f->hot = NULL;
    for (int i = 0; i < count; i++) {
        if (refs[i].body == number && refs[i].face < faces) {
            if (f->hot == NULL) {
                f->hot = f->hot_bits;
                memset(f->hot, 0, (faces + 31) / 32 * sizeof f->hot[0]);
            }
            f->hot[refs[i].face >> 5] |= 1u << (refs[i].face & 31);
        }
    }
}

/* List what shows in the part; false when there is no room for all of it. */
static bool see_part(struct flat *f)
{
    const struct carom_world *world = f->world;
    const struct draw_rect *rect = &f->view->rect;

    f->list.vertices = f->vertices;
    f->list.faces = (struct draw_face *)(void *)f->end;
    f->list.vertex_count = f->list.face_count = 1;
    f->list.room = (int32_t)(f->end - (uint8_t *)f->vertices) - 16;
    memset(f->list.rows, 0, (size_t)(rect->y1 - rect->y0) * sizeof f->list.rows[0]);
    for (uint32_t i = 0; i < world->body_count; i++) {
        const struct body *from = &world->bodies[i];
        const struct carom_mesh *mesh = from->mesh;

        if (mesh == NULL ||
            !draw_body_init(&f->body, f->view, from, &world_now(world)->bodies[i])) {
            continue;
        }
        mark_hot(f, i);
        memset(f->seen, 0, mesh->raw.vertex_count * sizeof f->seen[0]);
        for (uint32_t l = 0; l < mesh->leaf_count; l++) {
            const struct carom_leaf *leaf = &mesh->leaves[l];

            if (draw_sees_sphere(&f->body, &leaf->centre, leaf->radius_q22) && !see_leaf(f, leaf)) {
                return false;
            }
        }
    }
    return true;
}

/* -------------------------------------------------------------------- parts */

#define ROOM_LEAST 4096

/* Lay out the workspace. */
static bool make_flat(struct flat *f, const struct carom_picture *picture)
{
    uint8_t *at = picture->workspace;
    size_t vertices = 0, faces = 0;

    for (uint32_t i = 0; i < f->world->body_count; i++) {
        const struct carom_mesh *mesh = f->world->bodies[i].mesh;

        if (mesh) {
            vertices = mesh->raw.vertex_count > vertices ? mesh->raw.vertex_count : vertices;
            faces = mesh->raw.face_count > faces ? mesh->raw.face_count : faces;
        }
    }
    f->end = at + picture->workspace_bytes / 8 * 8;
    f->hot_bits = (uint32_t *)(void *)at;
    at += (faces + 31) / 32 * sizeof f->hot_bits[0];
    f->seen = (uint16_t *)(void *)at;
    at += vertices * sizeof f->seen[0];
    f->list.rows = (uint16_t *)(void *)at;
    at += (size_t)picture->height * sizeof f->list.rows[0];
    at += (0 - (uintptr_t)at) & 7;
    f->vertices = (struct draw_vertex *)(void *)at;
    return at + ROOM_LEAST <= f->end;
}

int draw_flat(const struct carom_world *world, struct draw_view *view,
              const struct carom_picture *picture)
{
    struct flat f = {.world = world, .view = view};
    struct draw_rect part = {0, 0, picture->width, picture->height};

    if (!make_flat(&f, picture)) {
        return CAROM_ERR_MEMORY;
    }
    draw_view_rect(view, part);
    see_part(&f);
    draw_rows(view, &f.list, picture);
    return CAROM_OK;
}

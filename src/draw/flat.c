/* SPDX-License-Identifier: MIT */
#include "draw.h"

#define OUTSIDE   0x8000u /* in place of a vertex's place, which is below */
#define FACES_MAX 0xffffu

/* The most that a leaf may list: its faces, clipped, and their corners. */
#define LEAF_FACES    (CAROM_LEAF_FACES * (DRAW_CLIP_MAX - 2))
#define LEAF_VERTICES (CAROM_LEAF_VERTICES + CAROM_LEAF_FACES * DRAW_CLIP_MAX)
#define LEAF_ROOM                                                                                  \
    (LEAF_FACES * sizeof(struct draw_face) + LEAF_VERTICES * sizeof(struct draw_vertex))

#define LINE_ROOM (2 * sizeof(struct draw_face) + 4 * sizeof(struct draw_vertex))

/* Where a pass over the world is. */
struct flat {
    const struct draw_source *source;
    struct draw_view *view;
    struct draw_list list;
    struct draw_body body;
    uint16_t *seen; /* a vertex of the body -> where it is in the list; 0 when it is not */
    uint32_t *hot;  /* a bit for each face of the body: whether it interferes; NULL for none */
    bool painted;   /* the body, by the paint; `hot` is there then */
    uint32_t *hot_bits;
    uint16_t *rows;
    struct draw_vertex *vertices;
    uint8_t *end;     /* of the workspace */
    uint32_t largest; /* of the solids, its number; none: their count */
};

/* ------------------------------------------------------------ into the list */

/* The number of a new vertex. There must be room. */
static inline uint32_t list_vertex(struct draw_list *list, struct draw_vertex vertex)
{
    list->vertices[list->vertex_count] = vertex;
    return list->vertex_count++;
}

/* List a face by its first row, if it shows in the part of the picture. There must be room. */
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

static void list_clipped(struct flat *f, const uint16_t numbers[3], uint32_t colour)
{
    struct draw_vertex corner[DRAW_CLIP_MAX];
    uint32_t place[DRAW_CLIP_MAX];
    int n = draw_clip(&f->body, numbers, 3, corner);

    for (int i = 0; i < n; i++) {
        place[i] = list_vertex(&f->list, corner[i]);
    }
    for (int i = 2; i < n; i++) {
        list_face(&f->view->rect, &f->list, place[0], place[i - 1], place[i], colour, false);
    }
}

/* Where a vertex of the body is in the list: OUTSIDE when it has no place there. */
static uint32_t see_vertex(struct flat *f, uint32_t number)
{
    uint32_t place = OUTSIDE;

    if (draw_vertex(&f->body, number, &f->list.vertices[f->list.vertex_count])) {
        place = f->list.vertex_count++;
    }
    f->seen[number] = (uint16_t)place;
    return place;
}

/* Whether a face is covered: its corners are, and what covers is round. */
static bool hidden(const struct flat *f, const struct draw_cover *cover, uint32_t i, uint32_t j,
                   uint32_t k)
{
    const struct draw_vertex *vertices = f->list.vertices;

    return draw_covers(cover, &vertices[i]) && draw_covers(cover, &vertices[j]) &&
           draw_covers(cover, &vertices[k]);
}

/* A face that looks at the eye. */
static inline void see_face(struct flat *f, uint32_t number, uint32_t colour, bool inside,
                            const struct draw_cover *cover)
{
    const uint16_t *numbers = f->body.mesh->raw.faces[number];
    uint32_t i = f->seen[numbers[0]], j = f->seen[numbers[1]], k = f->seen[numbers[2]];

    if (i == 0) {
        i = see_vertex(f, numbers[0]);
    }
    if (j == 0) {
        j = see_vertex(f, numbers[1]);
    }
    if (k == 0) {
        k = see_vertex(f, numbers[2]);
    }
    if ((i | j | k) & OUTSIDE) {
        list_clipped(f, numbers, colour);
    } else if (!(cover && hidden(f, cover, i, j, k))) {
        list_face(&f->view->rect, &f->list, i, j, k, colour, inside);
    }
}

/* ------------------------------------------------------- over bodies, faces */

/*
 * Shade 0 looks straight away from the light: the far side keeps its relief without a second light.
 * The light is a little short, so that shades stay below DRAW_SHADES; the ramp is in the bits above.
 */
static inline uint32_t face_colour(const struct draw_body *body, const carom_v3_q30 *normal)
{
    return ((uint32_t)(carom_dot(normal->c, body->light.c) >> 32) + body->ramp) >> 24;
}

/* The same of a face of a body that has paint. */
static uint32_t paint_colour(const struct flat *f, uint32_t number, uint32_t colour, bool hot)
{
    const struct draw_coat *coat = &f->body.coat;
    uint32_t ramp = hot ? coat->hot : draw_face_ramp(coat, f->source->paint, number);

    return ramp * DRAW_SHADES + colour % DRAW_SHADES;
}

/* List what shows of a leaf, which may be known to be inside of the part. There must be room for the most that it may be. */
static void see_leaf(struct flat *f, const struct carom_leaf *leaf, bool inside,
                     const struct draw_cover *cover)
{
    const struct draw_body *body = &f->body;
    const struct carom_face *faces = body->mesh->faces;
    const uint16_t *numbers = &body->mesh->leaf_faces[leaf->first_face];
    const uint16_t *end = numbers + leaf->face_count;
    const int32_t eye[3] = {body->eye[0], body->eye[1], body->eye[2]};
    int shift = 2 + body->shift;

    while (numbers < end) {
        uint32_t number = *numbers++;
        const struct carom_face *face = &faces[number];

        /* q(20 - shift): what is seen so much edge-on that it matters does not show */
        if ((int32_t)(carom_dot(face->normal.c, eye) >> 32) > face->offset_q22 >> shift) {
            uint32_t colour = face_colour(body, &face->normal);

            if (f->hot) {
                bool hot = f->hot[number >> 5] >> (number & 31) & 1;

                if (f->painted) {
                    colour = paint_colour(f, number, colour, hot);
                } else if (hot) {
                    colour += (DRAW_STATIONARY_HOT - DRAW_STATIONARY) * DRAW_SHADES;
                }
            }
            see_face(f, number, colour, inside, cover);
        }
    }
}

/* Mark the interfering faces of a body. */
static void mark_hot(struct flat *f, uint32_t number)
{
    const struct carom_face_ref *refs = f->source->hot;
    uint32_t faces = f->body.mesh->raw.face_count;
    const size_t bytes = (faces + 31) / 32 * sizeof f->hot_bits[0];

    f->hot = NULL;
    if (f->painted) {
        f->hot = f->hot_bits;
        memset(f->hot, 0, bytes);
    }
    for (int i = 0; i < f->source->hot_count; i++) {
        if (refs[i].body == number && refs[i].face < faces) {
            if (f->hot == NULL) {
                f->hot = f->hot_bits;
                memset(f->hot, 0, bytes);
            }
            f->hot[refs[i].face >> 5] |= 1u << (refs[i].face & 31);
        }
    }
}

static size_t room(const struct draw_list *list)
{
    return (size_t)((const uint8_t *)(list->faces - (list->face_count - 1)) -
                    (const uint8_t *)(list->vertices + list->vertex_count));
}

/* List the lines of the paint; false when there is no room for all of them. */
static bool see_lines(struct flat *f)
{
    const struct carom_paint *paint = f->source->paint;

    for (uint32_t i = 0; paint && i < paint->line_count; i++) {
        const struct carom_paint_line *line = &paint->lines[i];
        struct draw_vertex ends[2], corner[4];
        uint32_t at = f->list.vertex_count;

        if (!draw_segment(f->view, &line->from, &line->to, ends)) {
            continue;
        }
        if (room(&f->list) < LINE_ROOM || at + 4 > OUTSIDE || f->list.face_count + 2 > FACES_MAX) {
            return false;
        }
        draw_ribbon(ends, corner);
        for (int k = 0; k < 4; k++) {
            list_vertex(&f->list, corner[k]);
        }
        list_face(&f->view->rect, &f->list, at, at + 1, at + 2, line->colour, false);
        list_face(&f->view->rect, &f->list, at, at + 2, at + 3, line->colour, false);
    }
    return true;
}

/* List what shows in the part; false when there is no room for all of it. */
static bool see_part(struct flat *f)
{
    const struct draw_rect *rect = &f->view->rect;

    f->list.vertices = f->vertices;
    f->list.faces = (struct draw_face *)(void *)f->end;
    f->list.vertex_count = f->list.face_count = 1;
    f->list.rows = f->rows;
    memset(f->rows, 0, (size_t)(rect->y1 - rect->y0) * sizeof f->rows[0]);
    for (uint32_t i = 0; i < f->source->count; i++) {
        struct carom_body_look look;
        const struct carom_mesh *mesh;
        bool covered = f->view->cover.radius2_q8 > 0 && i != f->view->cover.body;

        if (!draw_look(f->source, i, &look) || !draw_body_init(&f->body, f->view, &look)) {
            continue;
        }
        mesh = look.mesh;
        f->painted = f->source->paint != NULL;
        draw_paint_body(&f->body.coat, f->source->paint, i);
        mark_hot(f, i);
        memset(f->seen, 0, mesh->raw.vertex_count * sizeof f->seen[0]);
        for (uint32_t l = 0; l < mesh->leaf_count; l++) {
            const struct carom_leaf *leaf = &mesh->leaves[l];
            int sees = f->body.sees;
            bool may;

            if (sees != 2) {
                sees = draw_sees_sphere(&f->body, &leaf->centre, leaf->radius_q22);
            }
            if (sees) {
                if (room(&f->list) < LEAF_ROOM || f->list.vertex_count + LEAF_VERTICES > OUTSIDE ||
                    f->list.face_count + LEAF_FACES > FACES_MAX) {
                    return false;
                }
                may = covered && draw_may_cover(f->view, &f->body, leaf);
                see_leaf(f, leaf, sees == 2, may ? &f->view->cover : NULL);
            }
        }
    }
    return see_lines(f);
}

/* -------------------------------------------------------------------- parts */

/* For some leaves, and for some 60 faces of a row. */
#define ROOM_LEAST 8160

/* Lay out the workspace, and find the largest solid. */
static bool make_flat(struct flat *f, const struct carom_picture *picture)
{
    uint8_t *at = (uint8_t *)picture->workspace;
    size_t vertices = 0, faces = 0, bytes;
    int32_t radius_q22 = 0;

    f->largest = f->source->count;
    for (uint32_t i = 0; i < f->source->count; i++) {
        const struct carom_mesh *mesh = draw_mesh(f->source, i);

        if (mesh) {
            vertices = mesh->raw.vertex_count > vertices ? mesh->raw.vertex_count : vertices;
            faces = mesh->raw.face_count > faces ? mesh->raw.face_count : faces;
            if (mesh->raw.kind == CAROM_SOLID && mesh->radius_q22 > radius_q22) {
                radius_q22 = mesh->radius_q22;
                f->largest = i;
            }
        }
    }
    bytes = (faces + 31) / 32 * sizeof f->hot_bits[0] + vertices * sizeof f->seen[0] +
            (size_t)picture->height * sizeof f->rows[0];
    bytes = (bytes + 7) / 8 * 8;
    if ((uintptr_t)at % 8 != 0 || picture->workspace_bytes / 8 * 8 < bytes + ROOM_LEAST) {
        return false;
    }
    f->hot_bits = (uint32_t *)(void *)at;
    f->seen = (uint16_t *)(void *)(f->hot_bits + (faces + 31) / 32);
    f->rows = f->seen + vertices;
    f->vertices = (struct draw_vertex *)(void *)(at + bytes);
    f->end = at + picture->workspace_bytes / 8 * 8;
    return true;
}

/*
 * Draw a part of the picture; false when the workspace is too small for it, unless it must be
 * drawn.
 */
static bool try_part(struct flat *f, const struct carom_picture *picture, struct draw_rect part,
                     bool must)
{
    draw_view_rect(f->view, part);
    if (!see_part(f) && !must) {
        return false;
    }
    f->list.room = room(&f->list);
    return draw_rows(f->view, &f->list, picture, must);
}

/*
 * All at once when the workspace is large enough; otherwise fewer rows, and when a single one is
 * too much, fewer columns. A pixel is drawn in any case, with as many of its faces as there is room
 * for: some 60 in front of each other when it is smallest.
 */
int draw_flat(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, struct draw_rect rect)
{
    struct flat f = {.source = source, .view = view};
    int32_t x = rect.x0, y = rect.y0, columns = rect.x1 - rect.x0, rows = rect.y1 - rect.y0;

    if (!make_flat(&f, picture)) {
        return CAROM_ERR_MEMORY;
    }
    draw_cover_init(view, source, f.largest);
    while (y < rect.y1) {
        struct draw_rect part = {x, y, x + columns, y + rows};

        part.x1 = part.x1 < rect.x1 ? part.x1 : rect.x1;
        part.y1 = part.y1 < rect.y1 ? part.y1 : rect.y1;
        if (try_part(&f, picture, part, rows == 1 && columns == 1)) {
            x = part.x1 < rect.x1 ? part.x1 : rect.x0;
            y = part.x1 < rect.x1 ? y : part.y1;
        } else if (rows > 1) {
            rows = (rows + 1) / 2;
        } else {
            columns = (columns + 1) / 2;
        }
    }
    return CAROM_OK;
}

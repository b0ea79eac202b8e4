/* SPDX-License-Identifier: MIT */
/* CAROM_DRAW_FLAT: list the faces that show in a part of the picture, then have its rows drawn. */
#include "list.h"

#define OUTSIDE LIST_VERTICES_MAX /* marks a vertex without a place in the list; places are below */

/* The most that a leaf may list: its faces, clipped, and their corners. */
#define LEAF_FACES    (CAROM_LEAF_FACES * (DRAW_CLIP_MAX - 2))
#define LEAF_VERTICES (CAROM_LEAF_VERTICES + CAROM_LEAF_FACES * DRAW_CLIP_MAX)
#define LEAF_ROOM                                                                                  \
    (LEAF_FACES * sizeof(struct draw_face) + LEAF_VERTICES * sizeof(struct draw_vertex))

/* State of a pass over the world. */
struct flat {
    const struct draw_source *source;
    struct draw_view *view;
    struct draw_list list;
    struct draw_body body;
    struct draw_shades shades;
    uint16_t *shade_room;
    uint16_t *seen; /* for each vertex of the body, its place in the list; 0: not visited */
    uint32_t *hot_bits;
    uint16_t *rows;
    struct draw_vertex *vertices;
    uint8_t *end;  /* end of the workspace for lists */
    void *scratch; /* after that, scratch memory for shadows */
    size_t scratch_bytes;
    uint32_t largest; /* number of the largest solid; number of bodies if there is none */
};

/* ------------------------------------------------------------ into the list */

FIX_OWN_FRAME static void list_clipped(struct flat *f, uint32_t number, uint32_t colour)
{
    struct draw_vertex corner[DRAW_CLIP_MAX];
    uint32_t place[DRAW_CLIP_MAX];
    int n = draw_clip(&f->body, f->body.mesh->raw.faces[number], 3, corner);

    for (int i = 0; i < n; i++) {
        place[i] = list_vertex(&f->list, corner[i]);
    }
    for (int i = 2; i < n; i++) {
        list_face(&f->view->rect, &f->list, place[0], place[i - 1], place[i], colour, false);
    }
}

/* Project a vertex into the list and return its place; OUTSIDE if it cannot be projected. */
static uint32_t see_vertex(struct flat *f, uint32_t number)
{
    uint32_t place = OUTSIDE;

    if (draw_vertex(&f->body, number, &f->list.vertices[f->list.vertex_count])) {
        place = f->list.vertex_count++;
    }
    f->seen[number] = (uint16_t)place;
    return place;
}

/* True if a face is covered: its corners are, and the cover is convex. */
static bool hidden(const struct flat *f, const struct draw_cover *cover, uint32_t i, uint32_t j,
                   uint32_t k)
{
    const struct draw_vertex *vertices = f->list.vertices;

    return draw_covers(cover, &vertices[i]) && draw_covers(cover, &vertices[j]) &&
           draw_covers(cover, &vertices[k]);
}

/* List a face with shades from corner to corner. */
static void see_shaded(struct flat *f, uint32_t number, const uint32_t place[3], uint32_t colour,
                       bool inside, const struct draw_cover *cover)
{
    const struct carom_smooth *smooth = f->source->paint->smooth;

    if ((place[0] | place[1] | place[2]) & OUTSIDE) {
        smooth->list_clipped(&f->shades, number, &f->view->rect, &f->list, colour);
    } else if (!(cover && hidden(f, cover, place[0], place[1], place[2]))) {
        smooth->list(&f->shades, number, &f->view->rect, &f->list, place, colour, inside);
    }
}

/* List a face that looks at the eye. */
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
    if (f->shades.at) {
        const uint32_t place[3] = {i, j, k};

        see_shaded(f, number, place, colour, inside, cover);
    } else if ((i | j | k) & OUTSIDE) {
        list_clipped(f, number, colour);
    } else if (!(cover && hidden(f, cover, i, j, k))) {
        list_face(&f->view->rect, &f->list, i, j, k, colour, inside);
    }
}

/* ------------------------------------------------------- over bodies, faces */

/*
 * List what shows of a leaf. inside: the leaf is known to be inside the part. There must be room
 * for the most that a leaf may list.
 */
FIX_OWN_FRAME static void see_leaf(struct flat *f, const struct carom_leaf *leaf, bool inside,
                                   const struct draw_cover *cover)
{
    const struct carom_paint *paint = f->source->paint;
    const struct draw_body *body = &f->body;
    const struct carom_face *faces = body->mesh->faces;
    const uint16_t *numbers = &body->mesh->leaf_faces[leaf->first_face];
    const uint16_t *end = numbers + leaf->face_count;
    const int32_t eye[3] = {body->eye[0], body->eye[1], body->eye[2]};
    int shift = 2 + body->shift;

    while (numbers < end) {
        uint32_t number = *numbers++;
        const struct carom_face *face = &faces[number];

        /* q(20 - shift); truncation only matters for faces seen so edge-on that they do not show */
        if ((int32_t)(carom_dot(face->normal.c, eye) >> 32) > face->offset_q22 >> shift) {
            uint32_t colour = list_colour(body, paint, &face->normal, number);

            see_face(f, number, colour, inside, cover);
        }
    }
}

/* Mark a body's interfering faces. */
static void mark_hot(struct flat *f, uint32_t number)
{
    const struct carom_face_ref *refs = f->source->hot;
    uint32_t faces = f->body.mesh->raw.face_count;
    const size_t bytes = (faces + 31) / 32 * sizeof f->hot_bits[0];

    f->body.hot = f->source->paint ? f->hot_bits : NULL;
    if (f->body.hot) {
        memset(f->hot_bits, 0, bytes);
    }
    for (int i = 0; i < f->source->hot_count; i++) {
        if (refs[i].body == number && refs[i].face < faces) {
            if (f->body.hot == NULL) {
                f->body.hot = f->hot_bits;
                memset(f->hot_bits, 0, bytes);
            }
            f->hot_bits[refs[i].face >> 5] |= 1u << (refs[i].face & 31);
        }
    }
}

/* Prepare for a body's shades, none of which is known yet. */
static void begin_shades(struct flat *f)
{
    f->shades.at = NULL;
    if (f->shade_room) {
        f->shades = (struct draw_shades){&f->body, f->shade_room, draw_crease(f->source->paint),
                                         f->view->shade_q24};
        memset(f->shade_room, 0, f->body.mesh->raw.vertex_count * sizeof f->shade_room[0]);
    }
}

/*
 * True if there is room for the most that a leaf may list. With smooth shades each face may have a
 * tint, which takes a face's room.
 */
static bool has_room(const struct flat *f)
{
    size_t tints = f->shade_room ? LEAF_FACES : 0;

    return list_room(&f->list) >= LEAF_ROOM + tints * sizeof(struct draw_face) + DRAW_ROWS_ROOM &&
           f->list.vertex_count + LEAF_VERTICES <= LIST_VERTICES_MAX &&
           f->list.face_count + LEAF_FACES + tints <= LIST_FACES_MAX;
}

/* List the paint's lines. Returns false if there is not room for all. */
FIX_OWN_FRAME static bool see_lines(struct flat *f)
{
    const struct carom_paint *paint = f->source->paint;

    for (uint32_t i = 0; paint && i < paint->line_count; i++) {
        const struct carom_paint_line *line = &paint->lines[i];
        struct draw_vertex ends[2], corner[4];
        uint32_t at = f->list.vertex_count;

        if (!draw_segment(f->view, &line->from, &line->to, ends)) {
            continue;
        }
        if (!has_room(f)) { /* for a leaf: a line takes less */
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

/* List what shows in the part. Returns false if there is not room for all. */
static bool see_part(struct flat *f)
{
    const struct carom_shadows *shadows = draw_shadows(f->source);
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
        draw_paint_body(&f->body.coat, f->source->paint, i);
        mark_hot(f, i);
        begin_shades(f);
        memset(f->seen, 0, mesh->raw.vertex_count * sizeof f->seen[0]);
        for (uint32_t l = 0; l < mesh->leaf_count; l++) {
            const struct carom_leaf *leaf = &mesh->leaves[l];
            int sees = f->body.sees;
            bool may;

            if (sees != 2) {
                sees = draw_sees_sphere(&f->body, &leaf->centre, leaf->radius_q22);
            }
            if (sees) {
                if (!has_room(f)) {
                    return false;
                }
                may = covered && draw_may_cover(f->view, &f->body, leaf);
                see_leaf(f, leaf, sees == 2, may ? &f->view->cover : NULL);
            }
        }
        if (shadows && !shadows->list(f->source, f->view, &f->shades, &f->body, i, &f->list,
                                      f->scratch, f->scratch_bytes)) {
            return false;
        }
    }
    return see_lines(f);
}

/* -------------------------------------------------------------------- parts */

/* Room for some leaves, and for some 60 faces in a row. */
#define ROOM_LEAST 8160

/*
 * Lay out the workspace, and find the largest solid. Returns false if the workspace is too small.
 */
static bool make_flat(struct flat *f, const struct carom_picture *picture)
{
    uint8_t *at = (uint8_t *)picture->workspace;
    size_t vertices = 0, faces = 0, shades, bytes;
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
    shades = draw_smooth(f->source->paint) ? vertices : 0;
    bytes = (bytes + shades * sizeof f->shade_room[0] + 7) / 8 * 8;
    if ((uintptr_t)at % 8 != 0 || picture->workspace_bytes / 8 * 8 < bytes + ROOM_LEAST) {
        return false;
    }
    f->hot_bits = (uint32_t *)(void *)at;
    f->seen = (uint16_t *)(void *)(f->hot_bits + (faces + 31) / 32);
    f->shade_room = shades ? f->seen + vertices : NULL;
    f->rows = f->seen + vertices + shades;
    f->vertices = (struct draw_vertex *)(void *)(at + bytes);
    f->end = at + picture->workspace_bytes / 8 * 8;
    f->scratch_bytes = 0;
    if (draw_shadows(f->source)) {
        f->scratch_bytes = ((size_t)(f->end - (uint8_t *)f->vertices) - ROOM_LEAST) / 24 * 8;
        f->end -= f->scratch_bytes;
    }
    f->scratch = f->end;
    return true;
}

/*
 * Draw a part of the picture. Returns false if the workspace is too small for it and it need not be
 * drawn.
 */
static bool try_part(struct flat *f, const struct carom_picture *picture, struct draw_rect part,
                     bool must)
{
    draw_view_rect(f->view, part);
    if (!see_part(f) && !must) {
        return false;
    }
    f->list.room = list_room(&f->list);
    return draw_rows(f->view, &f->list, picture, must);
}

/*
 * Draw everything at once if the workspace is large enough; else halve the number of rows, and when
 * a single row is too much, the columns. A single pixel is drawn in any case, with as many faces as
 * there is room for: some 60 in front of each other in the smallest workspace.
 */
int draw_flat(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, const struct draw_rect *rect)
{
    const struct carom_shadows *shadows = draw_shadows(source);
    struct flat f = {.source = source, .view = view};
    int32_t x = rect->x0, y = rect->y0, columns = rect->x1 - rect->x0, rows = rect->y1 - rect->y0;

    if (!make_flat(&f, picture)) {
        return CAROM_ERR_MEMORY;
    }
    draw_cover_init(view, source, f.largest);
    if (shadows) {
        shadows->init(source, view);
    }
    while (y < rect->y1) {
        struct draw_rect part = {x, y, x + columns, y + rows};

        part.x1 = part.x1 < rect->x1 ? part.x1 : rect->x1;
        part.y1 = part.y1 < rect->y1 ? part.y1 : rect->y1;
        if (try_part(&f, picture, part, rows == 1 && columns == 1)) {
            x = part.x1 < rect->x1 ? part.x1 : rect->x0;
            y = part.x1 < rect->x1 ? y : part.y1;
        } else if (rows > 1) {
            rows = (rows + 1) / 2;
        } else {
            columns = (columns + 1) / 2;
        }
    }
    return CAROM_OK;
}

/* SPDX-License-Identifier: MIT */
#include "draw.h"

/* The state of a walk over the rows of a part. */
struct rows {
    const struct draw_view *view;
    const struct draw_list *list;
    uint8_t format;
    struct draw_span *free;
    struct draw_span *fresh;  /* those that begin in the row at hand, from left to right */
    struct draw_span **spans; /* those of the row, from left to right; a sentinel at the end */
    struct draw_span **last;  /* the list of the row before, in the same way */
    uint32_t count;
    struct draw_span sentinel;
};

/* The row of the picture whose middle is the first not above y. */
static inline int32_t row_of(const struct draw_view *view, int32_t y_q4)
{
    return (y_q4 + view->middle_q4[1] + 7) >> 4;
}

/*
 * One side of a span, along the edge from a down to b, at the middle of a row that it crosses.
 *
 * It depends on the edge and the row alone, so that faces that share an edge meet without a gap or
 * an overlap. Corners are at most 2^15 apart, so the quotient is at most 2^30 in size; times the
 * part of the edge above the row it is less than that of dx, 2^30.
 */
static inline void set_side(const struct draw_view *view, struct draw_span *span, int side,
                            const struct draw_vertex *a, const struct draw_vertex *b, int32_t row)
{
    int32_t slope_q15 = (b->x_q4 - a->x_q4) * (1 << 15) / (b->y_q4 - a->y_q4);
    int32_t below_q4 = row * 16 + 8 - view->middle_q4[1] - a->y_q4;

    /* A pixel is right of the side when its middle is: 2^14 less, and rounded up. */
    span->x_q15[side] = (a->x_q4 + view->middle_q4[0]) * (1 << 11) + (1 << 14) - 1 +
                        ((slope_q15 * below_q4) >> 4);
    span->step_q15[side] = slope_q15;
}

/* Set a span to a row of its face; false when the face ended before it. */
static bool set_sides(const struct rows *r, struct draw_span *span, int32_t row)
{
    const struct draw_vertex *vertices = r->list->vertices;
    const struct draw_vertex *a = &vertices[span->face->corner[0]];
    const struct draw_vertex *b = &vertices[span->face->corner[1]];
    const struct draw_vertex *c = &vertices[span->face->corner[2]];
    int32_t end_b = row_of(r->view, b->y_q4), end_c = row_of(r->view, c->y_q4), end;

    if (row < end_b) {
        set_side(r->view, span, 0, a, b, row);
        end = end_b;
        if (row < end_c) {
            set_side(r->view, span, 1, a, c, row);
            end = end_c < end_b ? end_c : end_b;
        } else {
            set_side(r->view, span, 1, c, b, row);
        }
    } else if (row < end_c) {
        set_side(r->view, span, 0, b, c, row);
        set_side(r->view, span, 1, a, c, row);
        end = end_c;
    } else {
        return false;
    }
    span->rows = end - row;
    return true;
}

static void set_depths(const struct rows *r, struct draw_span *span)
{
    const struct draw_vertex *vertices = r->list->vertices;
    uint32_t a = vertices[span->face->corner[0]].w_q26;
    uint32_t b = vertices[span->face->corner[1]].w_q26;
    uint32_t c = vertices[span->face->corner[2]].w_q26;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;

    span->w_low = low < c ? low : c;
    span->w_high = high > c ? high : c;
}

/* Begin with the faces of a row. */
static bool begin_faces(struct rows *r, int32_t row)
{
    uint32_t number = r->list->rows[row - r->view->rect.y0];

    r->fresh = NULL;
    while (number) {
        const struct draw_face *face = &r->list->faces[-(int32_t)number];
        struct draw_span *span = r->free, **place = &r->fresh;

        if (span == NULL) {
            return false;
        }
        r->free = span->next;
        span->face = face;
        span->pixel = draw_colour(r->format, face->colour);
        set_sides(r, span, row);
        set_depths(r, span);
        while (*place && (*place)->x_q15[0] < span->x_q15[0]) {
            place = &(*place)->next;
        }
        span->next = *place;
        *place = span;
        number = face->next;
    }
    return true;
}

/* Put a span behind those of the row that begin left of it. */
static inline void put(struct draw_span **end, struct draw_span *span)
{
    int32_t x_q15 = span->x_q15[0];

    for (; end[-1]->x_q15[0] > x_q15; end--) {
        end[0] = end[-1];
    }
    end[0] = span;
}

/* Make the spans of a row from those of the row before and the ones that begin. */
static void step_row(struct rows *r, int32_t row)
{
    struct draw_span **from = r->spans + 1, **to = r->last + 1, **end = from + r->count;
    struct draw_span *fresh = r->fresh;
    int32_t fresh_x = fresh ? fresh->x_q15[0] : INT32_MAX;

    for (; from < end; from++) {
        struct draw_span *span = *from;

        span->x_q15[0] += span->step_q15[0];
        span->x_q15[1] += span->step_q15[1];
        if (--span->rows == 0 && !set_sides(r, span, row)) {
            span->next = r->free;
            r->free = span;
            continue;
        }
        while (fresh_x < span->x_q15[0]) {
            put(to++, fresh);
            fresh = fresh->next;
            fresh_x = fresh ? fresh->x_q15[0] : INT32_MAX;
        }
        put(to++, span);
    }
    for (; fresh; fresh = fresh->next) {
        put(to++, fresh);
    }
    *to = &r->sentinel;
    end = r->last;
    r->last = r->spans;
    r->spans = end;
    r->count = (uint32_t)(to - end) - 1;
}

static void fill_row(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1)
{
    int32_t x = s->x, end = x, gate = x;
    uint32_t pixel = s->ground;
    const struct draw_span *top = NULL;

    for (;;) {
        const struct draw_span *span = *spans++;
        int32_t a = span->x_q15[0] >> 15, b = span->x_q15[1] >> 15;

        if (a >= b) {
            continue;
        }
        if (a >= x1) {
            break;
        }
        if (a < gate) {
            s->x = x;
            s->top = end > x ? top : NULL;
            s->end = end;
            draw_overlap(s, span);
            top = s->top;
            x = s->x;
            end = x;
            gate = x;
            if (top) {
                end = gate = s->end;
                pixel = top->pixel;
            }
            if (s->under_count > 0) {
                gate = INT32_MAX;
            }
            continue;
        }
        draw_fill(s, x, end, pixel);
        if (a > end) {
            draw_fill(s, end, a, s->ground);
        }
        top = span;
        pixel = span->pixel;
        x = a;
        end = gate = b;
    }
    s->x = x;
    s->top = end > x ? top : NULL;
    s->end = end;
    draw_advance(s, x1);
}

/* Lay out the room: spans, and two lists of as many with a sentinel at both ends. */
static void make_room(struct rows *r, struct draw_span *low)
{
    size_t each = sizeof(struct draw_span) + 2 * sizeof(struct draw_span *);
    size_t room = (size_t)r->list->room, n = (room - 4 * sizeof(struct draw_span *)) / each;

    r->free = NULL;
    for (size_t i = 0; i < n; i++) {
        low[i].next = r->free;
        r->free = &low[i];
    }
    r->spans = (struct draw_span **)(void *)(low + n);
    r->last = r->spans + n + 2;
    r->sentinel.x_q15[0] = r->view->rect.x1 * (1 << 15);
    r->sentinel.x_q15[1] = r->sentinel.x_q15[0] + (1 << 15);
    r->count = 0;
}

bool draw_rows(const struct draw_view *view, const struct draw_list *list,
               const struct carom_picture *picture)
{
    struct rows r = {.view = view, .list = list, .format = picture->format};
    struct draw_sweep s = {.view = view, .vertices = list->vertices};
    struct draw_span lowest = {.x_q15 = {INT32_MIN, INT32_MIN}};
    const struct draw_rect *rect = &view->rect;

    make_room(&r, (struct draw_span *)(void *)(list->vertices + list->vertex_count));
    r.spans[0] = r.last[0] = &lowest;
    s.pixel_shift = picture->format;
    for (int32_t y = rect->y0; y < rect->y1; y++) {
        if (!begin_faces(&r, y)) {
            return false;
        }
        step_row(&r, y);
        s.row = (uint8_t *)picture->pixels + (size_t)y * (size_t)picture->stride;
        s.safe = s.row + ((size_t)rect->x1 << s.pixel_shift) - 3;
        s.y = y;
        s.x = rect->x0;
        s.top = NULL;
        s.under_count = 0;
        s.ground =
            draw_colour(picture->format, (uint32_t)(y * DRAW_SHADES / picture->height));
        fill_row(&s, r.spans + 1, rect->x1);
    }
    return true;
}

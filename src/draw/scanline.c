/* SPDX-License-Identifier: MIT */
/*
 * Draw a part row by row: keep each row's spans from left to right, and have their pixels filled.
 */
#include "row.h"

/* State of a walk over the rows of a part. */
struct rows {
    const struct draw_view *view;
    const struct draw_list *list;
    const uint32_t *palette;
    uint8_t format;
    struct draw_span *free;                /* list of spans to use again */
    struct draw_span *unused, *unused_end; /* spans never used */
    struct draw_span *fresh;  /* spans that begin in the present row, from left to right */
    struct draw_span **spans; /* spans of the row from left to right, with a sentinel at the end */
    struct draw_span **last;  /* the same for the row before */
    uint32_t count;
    struct draw_span sentinel;
};

/*
 * Set one side of a span, along the edge from a down to b, at the middle of a row that it crosses.
 *
 * It depends on the edge and the row alone, so that faces that share an edge meet without a gap or
 * an overlap. Bounds: corners are at most 2^15 apart, so the quotient is at most 2^30 in size;
 * times the part of the edge above the row it is less than dx times 2^15, 2^30. A pixel is right of
 * the side if its middle is: subtract 2^14 and round up.
 */
static inline void set_side(struct draw_span *span, int side, int32_t a, int32_t b, int32_t row)
{
    int32_t slope_q15 = draw_divide((draw_x(b) - draw_x(a)) * (1 << 15), draw_y(b) - draw_y(a));
    int32_t below_q4 = row * 16 + 15 - draw_y(a);

    span->x_q15[side] =
        draw_x(a) * (1 << 11) + ((slope_q15 * below_q4 + (((1 << 14) - 1) << 4)) >> 4);
    span->step_q15[side] = slope_q15;
}

/* Set a span at the first row of its face, or of the part. */
static inline void begin_span(struct draw_span *span, const struct draw_vertex *vertices,
                              int32_t row)
{
    const uint16_t *corner = span->face->corner;
    int32_t a = vertices[corner[0]].yx_q4, b = vertices[corner[1]].yx_q4;
    int32_t c = vertices[corner[2]].yx_q4;
    int32_t rows_b = draw_row(b) - row, rows_c = draw_row(c) - row;

    span->w_high = 0;
    span->row = DRAW_NO_ROW;
    span->rest = 0;
    if (rows_b <= 0) {
        set_side(span, 0, b, c, row);
        set_side(span, 1, a, c, row);
        span->until = row + rows_c;
        return;
    }
    set_side(span, 0, a, b, row);
    span->until = row + rows_b;
    if (rows_c <= 0) {
        set_side(span, 1, c, b, row);
        return;
    }
    set_side(span, 1, a, c, row);
    span->rest = rows_c - rows_b;
    if (rows_c < rows_b) {
        span->until = row + rows_c;
    }
}

/* Continue a span along its face's third edge. */
static inline void turn_span(struct draw_span *span, const struct draw_vertex *vertices,
                             int32_t row)
{
    int32_t b = vertices[span->face->corner[1]].yx_q4, c = vertices[span->face->corner[2]].yx_q4;

    if (span->rest > 0) {
        set_side(span, 0, b, c, row);
        span->until = row + span->rest;
    } else {
        set_side(span, 1, c, b, row);
        span->until = row - span->rest;
    }
    span->rest = 0;
}

/*
 * Make spans for the faces that begin in a row, sorted by their left side. Returns false if there
 * is no room.
 */
static bool begin_faces(struct rows *r, int32_t row)
{
    uint32_t number = r->list->rows[row - r->view->rect.y0];

    r->fresh = NULL;
    while (number) {
        const struct draw_face *face = &r->list->faces[-(int32_t)number];
        struct draw_span *span = r->free, **place = &r->fresh;
        uint32_t colour;

        if (span) {
            r->free = span->next;
        } else if (r->unused < r->unused_end) {
            span = r->unused++;
        } else {
            return false;
        }
        span->face = face;
        colour = face->colour & DRAW_COLOUR;
        span->pixel = r->format == CAROM_XRGB8888   ? r->palette[colour]
                      : r->format == CAROM_PALETTE8 ? colour * 0x01010101u
                                                    : draw_entry(r->format, r->palette, colour);
        begin_span(span, r->list->vertices, row);
        while (*place && (*place)->x_q15[0] < span->x_q15[0]) {
            place = &(*place)->next;
        }
        span->next = *place;
        *place = span;
        number = face->next;
    }
    return true;
}

/* Insert a span from the right end, behind spans that begin left of it. */
static inline void put(struct draw_span **end, struct draw_span *span)
{
    int32_t x_q15 = span->x_q15[0];

    for (; end[-1]->x_q15[0] > x_q15; end--) {
        end[0] = end[-1];
    }
    end[0] = span;
}

/* Make a row's spans from those of the row before and the fresh ones. */
static void step_row(struct rows *r, int32_t row)
{
    struct draw_span **from = r->spans + 1, **to = r->last + 1, **end = from + r->count;
    struct draw_span *fresh = r->fresh;
    int32_t fresh_x = fresh ? fresh->x_q15[0] : INT32_MAX;

    int32_t last_x = INT32_MIN; /* left side of the rightmost span so far */

    for (; from < end; from++) {
        struct draw_span *span = *from;
        int32_t x0 = span->x_q15[0] + span->step_q15[0];
        int32_t x1 = span->x_q15[1] + span->step_q15[1];

        span->x_q15[0] = x0;
        span->x_q15[1] = x1;
        if (span->until == row) {
            if (span->rest == 0) {
                span->next = r->free;
                r->free = span;
                continue;
            }
            turn_span(span, r->list->vertices, row);
            x0 = span->x_q15[0];
        }
        while (fresh_x < x0) {
            put(to++, fresh);
            last_x = fresh_x > last_x ? fresh_x : last_x;
            fresh = fresh->next;
            fresh_x = fresh ? fresh->x_q15[0] : INT32_MAX;
        }
        if (x0 >= last_x) {
            *to++ = span;
            last_x = x0;
        } else {
            put(to++, span);
        }
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

/* A copy for pixels of 4 bytes, whose size is then a constant. */
DRAW_OUT_OF_LINE void fill_row_4(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1)
{
    fill_row(s, spans, x1, 2, false);
}

static void fill_row_any(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1)
{
    fill_row(s, spans, x1, s->pixel_shift, false);
}

/* Lay out the room: spans, and two lists of them with sentinels at both ends. */
static void make_room(struct rows *r, struct draw_span *low)
{
    size_t each = sizeof(struct draw_span) + 2 * sizeof(struct draw_span *);
    size_t room = r->list->room, n = (room - DRAW_ROWS_ROOM) / each;

    CAROM_ASSERT(room >= DRAW_ROWS_ROOM);
    r->free = NULL;
    r->unused = low;
    r->unused_end = low + n;
    r->spans = (struct draw_span **)(void *)(low + n);
    r->last = r->spans + n + 2;
    r->sentinel.x_q15[0] = r->view->rect.x1 * (1 << 15);
    r->sentinel.x_q15[1] = r->sentinel.x_q15[0] + (1 << 15);
    r->count = 0;
}

bool draw_rows(const struct draw_view *view, const struct draw_list *list,
               const struct carom_picture *picture, bool must)
{
    struct rows r = {
        .view = view, .list = list, .palette = draw_palette(picture), .format = picture->format};
    const struct carom_smooth *smooth = draw_smooth(picture->paint);
    struct draw_sweep s = {.view = view, .vertices = list->vertices, .smooth = smooth};
    struct draw_span lowest = {.x_q15 = {INT32_MIN, INT32_MIN}};
    const struct draw_rect *rect = &view->rect;

    make_room(&r, (struct draw_span *)(void *)(list->vertices + list->vertex_count));
    r.spans[0] = r.last[0] = &lowest;
    s.pixel_shift = draw_pixel_shift(picture->format);
    s.palette = r.palette;
    s.format = r.format;
    for (int32_t y = rect->y0; y < rect->y1; y++) {
        if (!begin_faces(&r, y) && !must) {
            return false;
        }
        step_row(&r, y);
        s.row = draw_pixels(view, picture, y);
        s.safe = rect->x1 - 3;
        s.y = y;
        s.x = rect->x0;
        s.under_count = 0;
        s.under_high = 0;
        s.ground = draw_ground(view, picture, y);
        if (smooth) {
            smooth->row(&s, r.spans + 1, rect->x1);
        } else if (s.pixel_shift == 2) {
            fill_row_4(&s, r.spans + 1, rect->x1);
        } else {
            fill_row_any(&s, r.spans + 1, rect->x1);
        }
    }
    return true;
}

/* SPDX-License-Identifier: MIT */
/*
 * Shades from corner to corner of a face. At a vertex all faces between two creases share one
 * shade, the mean of theirs, so both faces of an edge show the same along it. Neighbouring faces in
 * one plane count as one face, so that it does not matter how a plane was cut into triangles.
 */
#include "list.h"
#include "row.h"

#define HALF_SHADE_Q8 128
#define MOST_Q8       ((DRAW_SHADES - 1) * 256 - 1)
#define STEEP_Q16                                                                                  \
    ((int64_t)1 << 21)       /* all shades within a pixel: the face is thinner than a pixel */
#define PLANE_Q30 1073578288 /* cosine of a degree */

/* ----------------------------------------------------------------- vertices */

/* A face at a vertex, and the number of that corner. */
struct face_corner {
    uint32_t face;
    int k;
};

/* Faces that share a shade at a vertex: the sum of their shades, and how many count. */
struct fan {
    int64_t sum_q24;
    int32_t count;
};

/*
 * Go to the next face around a vertex, counter-clockwise if forward. Returns false at a border or a
 * crease. Sets `bends` if the face is in another plane.
 */
static bool go_on(const struct draw_shades *shades, uint32_t vertex, struct face_corner *at,
                  bool forward, bool *bends)
{
    const struct carom_mesh *mesh = shades->body->mesh;
    const struct carom_face *face = &mesh->faces[at->face];
    const struct carom_edge *edge = &mesh->edges[face->edge[!forward ? at->k
                                                            : at->k  ? at->k - 1
                                                                     : 2]];
    uint32_t number = edge->face[edge->face[0] == at->face];
    const uint16_t *corner;
    int32_t cosine_q30;

    if (number == CAROM_NO_FACE) {
        return false;
    }
    cosine_q30 = (int32_t)(carom_dot(face->normal.c, mesh->faces[number].normal.c) >> 30);
    if (cosine_q30 < shades->crease_q30) {
        return false;
    }
    corner = mesh->raw.faces[number];
    at->face = number;
    at->k = corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
    *bends = cosine_q30 < PLANE_Q30;
    return true;
}

static int64_t shade_of(const struct draw_shades *shades, uint32_t face)
{
    const struct carom_face *f = &shades->body->mesh->faces[face];

    return (carom_dot(f->normal.c, shades->body->light.c) >> 32) + (int64_t)shades->shade_q24;
}

/*
 * Add the faces that follow a face. Returns true if they come round to it; else `at` is the last
 * face before a border or crease.
 */
static bool add_fan(const struct draw_shades *shades, uint32_t vertex, struct face_corner *at,
                    bool forward, struct fan *fan)
{
    const uint32_t first = at->face;
    bool bends = false;

    while (go_on(shades, vertex, at, forward, &bends)) {
        if (at->face == first) {
            /* the first face lies in the plane of one that was added */
            if (!bends && fan->count > 1) {
                fan->sum_q24 -= shade_of(shades, first);
                fan->count--;
            }
            return true;
        }
        if (bends) {
            fan->sum_q24 += shade_of(shades, at->face);
            fan->count++;
        }
    }
    return false;
}

static int32_t mean_q8(const struct fan *fan)
{
    return draw_divide((int32_t)(fan->sum_q24 >> 16), fan->count);
}

/* The shade of a corner. Remembers it if all faces at the vertex share it. */
static int32_t corner_q8(const struct draw_shades *shades, uint32_t face, int k)
{
    const uint32_t vertex = shades->body->mesh->raw.faces[face][k];
    struct face_corner at = {face, k};
    struct fan fan = {shade_of(shades, face), 1};

    if (shades->at[vertex] != 0 && shades->at[vertex] != DRAW_SHADES_MANY) {
        return shades->at[vertex] - 1;
    }
    if (shades->at[vertex] == 0 && add_fan(shades, vertex, &at, true, &fan)) {
        shades->at[vertex] = (uint16_t)(mean_q8(&fan) + 1);
        return mean_q8(&fan);
    }
    if (shades->at[vertex] != 0) {
        add_fan(shades, vertex, &at, true, &fan);
    }
    /* start at a crease, the same for all faces that share the shade */
    shades->at[vertex] = DRAW_SHADES_MANY;
    fan = (struct fan){shade_of(shades, at.face), 1};
    add_fan(shades, vertex, &at, false, &fan);
    return mean_q8(&fan);
}

static void find_corners(const struct draw_shades *shades, uint32_t face, int32_t shade_q8[3])
{
    for (int k = 0; k < 3; k++) {
        shade_q8[k] = corner_q8(shades, face, k);
    }
}

/* Twice the area of a, b, c seen along an axis, signed; below 2^48. */
static int64_t turn(const int32_t a[3], const int32_t b[3], const int32_t c[3], int axis)
{
    int i = fix_next(axis), j = fix_next(i);
    int64_t bi = (b[i] >> 8) - (a[i] >> 8), bj = (b[j] >> 8) - (a[j] >> 8);
    int64_t ci = (c[i] >> 8) - (a[i] >> 8), cj = (c[j] >> 8) - (a[j] >> 8);

    return bi * cj - bj * ci;
}

static void find_between(const struct draw_shades *shades, uint32_t face, int32_t (*at)[3], int n,
                         int32_t *shade_q8)
{
    int32_t corner[3][3], of[3];
    int64_t area = 0;
    int axis = 0;

    find_corners(shades, face, of);
    for (int k = 0; k < 3; k++) {
        draw_place(shades->body, shades->body->mesh->raw.faces[face][k], corner[k]);
    }
    for (int k = 0; k < 3; k++) {
        int64_t seen = turn(corner[0], corner[1], corner[2], k);

        if (carom_abs(seen) > carom_abs(area)) {
            area = seen;
            axis = k;
        }
    }
    for (int i = 0; i < n; i++) {
        int64_t second = turn(corner[0], at[i], corner[2], axis);
        int64_t third = turn(corner[0], corner[1], at[i], axis);

        /* areas are below 2^48, shades below 2^13 */
        shade_q8[i] = of[0];
        if (area != 0) {
            shade_q8[i] += (int32_t)((second * (of[1] - of[0]) + third * (of[2] - of[0])) / area);
        }
    }
}

/* -------------------------------------------------------------------- faces */

static int32_t limit(int32_t value, int32_t most)
{
    return value < 0 ? 0 : value > most ? most : value;
}

/*
 * The shade for pixels, which blend from the middle of one palette entry to the middle of the next.
 */
static int32_t within_q8(int32_t shade_q8)
{
    return limit(shade_q8 - HALF_SHADE_Q8, MOST_Q8);
}

static void put_halves(uint16_t half[2], int64_t value)
{
    half[0] = (uint16_t)((uint32_t)value >> 16);
    half[1] = (uint16_t)value;
}

static int32_t from_halves(const uint16_t half[2])
{
    return (int32_t)((uint32_t)half[0] << 16 | half[1]);
}

/*
 * Set a shade that is linear over the picture, as depth is in depth.c. Bounds: corners are at most
 * 2^15 apart, shades 2^13, so numerators are at most 2^29. The area is scaled to 15 bits; 2^31
 * divided by it is at most 2^17. Returns false for a face too thin to be shaded.
 */
static bool find_tint(struct draw_tint *tint, const struct draw_list *list,
                      const struct draw_face *plane, const int32_t shade_q8[3])
{
    const struct draw_vertex *a = &list->vertices[plane->corner[0]];
    const struct draw_vertex *b = &list->vertices[plane->corner[1]];
    const struct draw_vertex *c = &list->vertices[plane->corner[2]];
    int32_t xa = draw_x(a->yx_q4), ya = draw_y(a->yx_q4);
    int32_t x1 = draw_x(b->yx_q4) - xa, y1 = draw_y(b->yx_q4) - ya;
    int32_t x2 = draw_x(c->yx_q4) - xa, y2 = draw_y(c->yx_q4) - ya;
    int32_t area_q8 = x2 * y1 - x1 * y2;
    int32_t s1 = shade_q8[1] - shade_q8[0], s2 = shade_q8[2] - shade_q8[0];
    int64_t inverse, right, below;
    int up;

    if (area_q8 < 256) {
        return false;
    }
    up = 15 - fix_bits32((uint32_t)area_q8);
    inverse = draw_divide(INT32_MAX, up > 0 ? area_q8 << up : area_q8 >> -up);
    right = (s2 * y1 - s1 * y2) * inverse >> (19 - up);
    below = (s1 * x2 - s2 * x1) * inverse >> (19 - up);
    tint->at_q8 = (uint16_t)shade_q8[0];
    put_halves(tint->right_q16, right);
    put_halves(tint->below_q16, below);
    return carom_abs(right) < STEEP_Q16 && carom_abs(below) < STEEP_Q16;
}

static void add_tint(struct draw_list *list, struct draw_face *face, const int32_t shade_q8[3])
{
    struct draw_face *next = &list->faces[-(int32_t)list->face_count];
    const uint32_t base = face->colour & ~(uint32_t)(DRAW_SHADES - 1);
    struct draw_tint tint;
    int32_t q8[3];

    for (int k = 0; k < 3; k++) {
        q8[k] = within_q8(shade_q8[k]);
    }
    if (carom_abs(q8[1] - q8[0]) <= 1 && carom_abs(q8[2] - q8[0]) <= 1) {
        face->colour = (uint16_t)(base + (uint32_t)(shade_q8[0] >> 8));
    } else if (find_tint(&tint, list, draw_plane(face), q8)) {
        face->colour = (uint16_t)(base | DRAW_TINT);
        memcpy(next, &tint, sizeof tint);
        list->face_count++;
    } else {
        int32_t sum_q8 = shade_q8[0] + shade_q8[1] + shade_q8[2];

        face->colour = (uint16_t)(base + (uint32_t)(sum_q8 / (3 << 8)));
    }
}

/* List a face with its corners' shades. */
static void list_with(const struct draw_rect *rect, struct draw_list *list, const uint32_t place[3],
                      const int32_t shade_q8[3], uint32_t colour, bool inside)
{
    uint32_t number = list->face_count;
    int top = 0;
    int32_t turned[3];
    struct draw_face *face;

    list_face(rect, list, place[0], place[1], place[2], colour, inside);
    if (list->face_count == number) {
        return;
    }
    face = &list->faces[-(int32_t)number];
    while (place[top] != face->corner[0]) {
        top++;
    }
    for (int k = 0; k < 3; k++) {
        turned[k] = shade_q8[(top + k) % 3];
    }
    add_tint(list, face, turned);
}

static void list_smooth(const struct draw_shades *shades, uint32_t face,
                        const struct draw_rect *rect, struct draw_list *list,
                        const uint32_t place[3], uint32_t colour, bool inside)
{
    int32_t shade_q8[3];

    find_corners(shades, face, shade_q8);
    list_with(rect, list, place, shade_q8, colour, inside);
}

static void list_clipped(const struct draw_shades *shades, uint32_t face,
                         const struct draw_rect *rect, struct draw_list *list, uint32_t colour)
{
    const struct draw_body *body = shades->body;
    int32_t polygon[DRAW_CLIP_MAX][3], shade_q8[DRAW_CLIP_MAX];
    struct draw_vertex on[DRAW_CLIP_MAX];
    uint32_t place[DRAW_CLIP_MAX];
    int n;

    for (int k = 0; k < 3; k++) {
        draw_place(body, body->mesh->raw.faces[face][k], polygon[k]);
    }
    n = draw_clip_placed(body, polygon, 3, on);
    find_between(shades, face, polygon, n, shade_q8);
    for (int i = 0; i < n; i++) {
        place[i] = list_vertex(list, on[i]);
    }
    for (int i = 2; i < n; i++) {
        const uint32_t corner[3] = {place[0], place[i - 1], place[i]};
        const int32_t of[3] = {shade_q8[0], shade_q8[i - 1], shade_q8[i]};

        list_with(rect, list, corner, of, colour, false);
    }
}

/* ------------------------------------------------------------------- pixels */

/* Ordered dithering: when a pixel of a 4 x 4 square takes the next shade, 1/32 to 31/32. */
static const uint8_t order[4][4] = {
    {1, 17, 5, 21}, {25, 9, 29, 13}, {7, 23, 3, 19}, {31, 15, 27, 11}};

/* A colour between a palette entry and the next, rounded down. */
static uint32_t mix(const uint32_t *entry, uint32_t part_q8)
{
    uint32_t a = entry[0], b = entry[1], keep = 256 - part_q8;
    uint32_t ends = (a & 0xff00ff) * keep + (b & 0xff00ff) * part_q8;
    uint32_t middle = (a & 0x00ff00) * keep + (b & 0x00ff00) * part_q8;

    return (ends >> 8 & 0xff00ff) | (middle >> 8 & 0x00ff00);
}

/* Shades for each step of grey in a ramp, q16. */
static int32_t coarse_q16(const struct draw_sweep *s, uint32_t base)
{
    int32_t low = (int32_t)(draw_entry(s->format, s->palette, base) & 15);
    int32_t high = (int32_t)(draw_entry(s->format, s->palette, base + DRAW_SHADES - 1) & 15);
    int32_t greys = high > low ? high - low : low - high;

    return draw_divide((DRAW_SHADES - 1) << 16, greys > 0 ? greys : 1);
}

/*
 * The palette entry of a pixel when shades are dithered: pick by whole shades, pick_coarse by steps
 * of grey.
 */
static uint32_t pick(int32_t shade_q16, uint32_t order_32)
{
    return (uint32_t)(shade_q16 + (int32_t)order_32 * (1 << 11)) >> 16;
}

static uint32_t pick_coarse(int32_t shade_q16, int32_t coarse_q16, uint32_t order_32)
{
    int32_t aside = coarse_q16 / 32 * ((int32_t)order_32 - 16);

    return (uint32_t)limit((shade_q16 + aside + (1 << 15)) >> 16, DRAW_SHADES - 1);
}

/* Shades along a row: that of pixel `from`, and the growth a pixel. */
struct shade_line {
    int32_t from, to, q16, step_q16;
    bool within; /* all are in range; a pixel hardly in its face may not be */
};

static struct shade_line find_line(const struct draw_sweep *s, const struct draw_span *span,
                                   int32_t from, int32_t to)
{
    const struct draw_tint *tint = draw_tint(span->face);
    int32_t yx_q4 = s->vertices[draw_plane(span->face)->corner[0]].yx_q4;
    int32_t right = from_halves(tint->right_q16), below = from_halves(tint->below_q16);
    int64_t q4 = (int64_t)right * (from * 16 + 8 - draw_x(yx_q4)) +
                 (int64_t)below * (s->y * 16 + 15 - draw_y(yx_q4));
    struct shade_line line = {from, to, tint->at_q8 * 256 + (int32_t)(q4 >> 4), right, true};
    int32_t last = line.q16 + right * (to - 1 - from);

    line.within = line.q16 >= 0 && last >= 0 && line.q16 <= MOST_Q8 * 256 && last <= MOST_Q8 * 256;
    return line;
}

/* Draw the pixels of a line; format and within are compile-time constants. */
DRAW_INLINE void shade_pixels(const struct draw_sweep *s, const struct shade_line *line,
                              uint32_t base, uint8_t format, bool within)
{
    const uint8_t *pattern = order[s->y & 3];
    const uint32_t *palette = s->palette;
    uint8_t *row = s->row;
    int32_t shade_q16 = line->q16, step_q16 = line->step_q16, to = line->to;

    for (int32_t x = line->from; x < to; x++, shade_q16 += step_q16) {
        int32_t q16 = within ? shade_q16 : limit(shade_q16, MOST_Q8 * 256);

        if (format == CAROM_PALETTE8) {
            row[x] = (uint8_t)(base + pick(q16, pattern[x & 3]));
        } else if (format == CAROM_XRGB8888) {
            ((draw_pixel4 *)(void *)row)[x] =
                mix(&palette[base + (uint32_t)(q16 >> 16)], (uint32_t)q16 >> 8 & 255);
        } else {
            ((draw_half *)(void *)row)[x] =
                (uint16_t)draw_entry(format, palette, base + pick(q16, pattern[x & 3]));
        }
    }
}

static void shade_greys(const struct draw_sweep *s, const struct shade_line *line, uint32_t base)
{
    const int32_t coarse = coarse_q16(s, base);
    int32_t shade_q16 = line->q16;

    for (int32_t x = line->from; x < line->to; x++, shade_q16 += line->step_q16) {
        uint32_t entry =
            pick_coarse(limit(shade_q16, MOST_Q8 * 256), coarse, order[s->y & 3][x & 3]);

        draw_run(s->row, s->pixel_shift, x, x + 1, draw_entry(s->format, s->palette, base + entry));
    }
}

/* The rare cases: 16 bits, greys, and shades that must be clamped. */
DRAW_OUT_OF_LINE void shade_others(const struct draw_sweep *s, const struct shade_line *line,
                                   uint32_t base)
{
    if (s->format == CAROM_GREY4) {
        shade_greys(s, line, base);
    } else if (s->format == CAROM_PALETTE8) {
        shade_pixels(s, line, base, CAROM_PALETTE8, false);
    } else if (s->format == CAROM_XRGB8888) {
        shade_pixels(s, line, base, CAROM_XRGB8888, false);
    } else {
        shade_pixels(s, line, base, s->format, false);
    }
}

static void shade_run(const struct draw_sweep *s, const struct draw_span *span, int32_t from,
                      int32_t to)
{
    const struct shade_line line = find_line(s, span, from, to);
    const uint32_t base = span->face->colour & DRAW_COLOUR;

    if (line.within && s->format == CAROM_PALETTE8) {
        shade_pixels(s, &line, base, CAROM_PALETTE8, true);
    } else if (line.within && s->format == CAROM_XRGB8888) {
        shade_pixels(s, &line, base, CAROM_XRGB8888, true);
    } else {
        shade_others(s, &line, base);
    }
}

static void shade_row(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1)
{
    fill_row(s, spans, x1, s->pixel_shift, true);
}

static uint32_t shade_ground(const struct carom_picture *picture, int32_t y, int32_t shade_q8)
{
    const uint32_t *palette = draw_palette(picture);
    int32_t q8 = within_q8(shade_q8);

    if (picture->format == CAROM_XRGB8888) {
        return mix(&palette[q8 >> 8], (uint32_t)q8 & 255);
    }
    return draw_entry(picture->format, palette, pick(q8 * 256, order[y & 3][0]));
}

const struct carom_smooth carom_smooth = {
    .list = list_smooth,
    .list_clipped = list_clipped,
    .corners = find_corners,
    .between = find_between,
    .tint = add_tint,
    .row = shade_row,
    .run = shade_run,
    .ground = shade_ground,
};

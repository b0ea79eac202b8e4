/* SPDX-License-Identifier: MIT */
/* carom_draw_changes: find what changed since the last picture, and draw only those rectangles. */
#include "../num/fnv.h"
#include "draw.h"

/* Drawing a part costs as much on top as drawing this many pixels. */
#define PART_PIXELS 2048

/* ---------------------------------------------------------------- rectangles */

static int32_t area(const struct carom_rect *r)
{
    return (r->x1 - r->x0) * (r->y1 - r->y0);
}

/* Add a rectangle to the changed ones; merge rectangles where that costs less. */
static void add_rect(struct carom_drawn *drawn, struct carom_rect rect)
{
    int i = 0;

    if (draw_is_empty(&rect)) {
        return;
    }
    while (i < drawn->changed_count) {
        struct carom_rect *other = &drawn->changed[i++], both = draw_around(&rect, other);

        if (area(&both) <= area(&rect) + area(other) + PART_PIXELS ||
            drawn->changed_count == CAROM_DRAWN_RECTS) {
            rect = both;
            *other = drawn->changed[--drawn->changed_count];
            i = 0; /* the merged one may reach others */
        }
    }
    drawn->changed[drawn->changed_count++] = rect;
}

/* -------------------------------------------------------------------- bodies */

/* The search for what changed since the last picture. */
struct changes {
    struct draw_source source;
    struct draw_view view;                   /* of the whole picture */
    const struct carom_face_ref *refs, *end; /* interfering faces of bodies not yet visited */
    uint64_t lines_hash;
};

/*
 * A body as it is to be shown, except for its place on the picture; empty if there is no such body.
 */
static struct carom_drawn_body look(const struct draw_source *source, uint32_t number)
{
    struct carom_drawn_body now = {.moves = 0};

    if (draw_look(source, number, &now.look) && now.look.mesh->surface) {
        now.moves = now.look.mesh->surface->moves;
    }
    now.ramp = draw_paint_ramp(source->paint, number);
    return now;
}

static bool same_body(const struct carom_drawn_body *before, const struct carom_drawn_body *now)
{
    const struct carom_body_look *a = &before->look, *b = &now->look;

    return a->mesh == b->mesh && a->moving == b->moving && before->moves == now->moves &&
           before->ramp == now->ramp &&
           memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
           memcmp(&a->rotation, &b->rotation, sizeof a->rotation) == 0;
}

/* The rectangle around a body, or around those of its faces that are given. */
static struct carom_rect find_rect(const struct changes *c, const struct carom_body_look *look,
                                   const struct carom_face_ref *faces, ptrdiff_t count)
{
    const struct carom_mesh_raw *raw = &look->mesh->raw;
    struct draw_extent extent;
    struct draw_body body;

    draw_extent_begin(&extent);
    if (draw_body_init(&body, &c->view, look)) {
        for (uint32_t v = 0; faces == NULL && v < raw->vertex_count; v++) {
            draw_extent_add(&extent, &body, v);
        }
        for (ptrdiff_t i = 0; i < count; i++) {
            for (int k = 0; k < 3 && faces[i].face < raw->face_count; k++) {
                draw_extent_add(&extent, &body, raw->faces[faces[i].face][k]);
            }
        }
    }
    return draw_on_picture(&c->view, draw_extent_end(&extent, &c->view));
}

/* Largest reach, q16, at which a body's place is still representable from the eye. */
#define REACH_MOST ((int64_t)1024 << 16)

/*
 * The rectangle around a body and its shadows, which lie between the body and its copy moved by the
 * shadows' reach.
 */
static struct carom_rect find_all(const struct changes *c, uint32_t number,
                                  const struct carom_body_look *look)
{
    const struct carom_shadows *shadows = draw_shadows(&c->source);
    int64_t reach = shadows ? shadows->reach(&c->source, &c->view, number, look) : 0;
    struct carom_body_look end = *look;
    struct draw_extent extent;
    struct draw_body body;

    if (reach == 0) {
        return find_rect(c, look, NULL, 0);
    }
    if (reach > REACH_MOST) {
        return draw_on_picture(&c->view, c->view.rect);
    }
    for (int k = 0; k < 3; k++) {
        end.position.c[k] -= c->view.sun.c[k] * reach >> 14;
    }
    draw_extent_begin(&extent);
    for (int i = 0; i < 2; i++) {
        draw_body_place(&body, &c->view, i ? &end : look);
        for (uint32_t v = 0; v < look->mesh->raw.vertex_count; v++) {
            draw_extent_add(&extent, &body, v);
        }
    }
    return draw_on_picture(&c->view, draw_extent_end(&extent, &c->view));
}

/*
 * Visit a body: add what changes of it to `drawn`, unless everything is drawn anyway. The rectangle
 * of a body at rest is only found once it moves.
 */
static void see_body(struct changes *c, struct carom_drawn *drawn, uint32_t number)
{
    struct carom_drawn_body *before = &drawn->bodies[number], now = look(&c->source, number);
    const struct carom_face_ref *hot = c->refs;
    bool same = drawn->shows && same_body(before, &now);

    while (c->refs < c->end && c->refs->body == number) {
        c->refs++;
    }
    if (now.look.mesh && hot < c->refs) {
        now.hot = find_rect(c, &now.look, hot, c->refs - hot);
    }
    if (same) {
        now.all = before->all;
    } else if (now.look.mesh) {
        const bool known = drawn->shows || now.look.moving;

        now.all = known ? find_all(c, number, &now.look) : draw_on_picture(&c->view, c->view.rect);
    }
    if (drawn->shows) {
        add_rect(drawn, same ? before->hot : before->all);
        add_rect(drawn, same ? now.hot : now.all);
    }
    *before = now;
}

/* --------------------------------------------------------------------- lines */

/* A hash of the paint's lines; 0 without lines. */
FIX_OWN_FRAME static uint64_t hash_lines(const struct carom_paint *paint)
{
    uint64_t hash = paint && paint->line_count ? FNV_START : 0;

    for (uint32_t i = 0; paint && i < paint->line_count; i++) {
        const struct carom_paint_line *line = &paint->lines[i];
        const carom_v3_q32 *const point[2] = {&line->from, &line->to};

        for (int k = 0; k < 6 * 8; k++) {
            hash = fnv_add(hash, (uint8_t)(point[k / 24]->c[k / 8 % 3] >> (k % 8 * 8)));
        }
        hash = fnv_add(fnv_add(hash, (uint8_t)line->colour), (uint8_t)(line->colour >> 8));
    }
    return hash;
}

/* The rectangle around all lines. */
static struct carom_rect find_lines(const struct changes *c)
{
    const struct carom_paint *paint = c->source.paint;
    struct carom_rect all = {0, 0, 0, 0};

    for (uint32_t i = 0; paint && i < paint->line_count; i++) {
        struct draw_vertex ends[2];

        if (draw_segment(&c->view, &paint->lines[i].from, &paint->lines[i].to, ends)) {
            draw_touch(&all, draw_on_picture(&c->view, draw_segment_rect(&c->view, ends)));
        }
    }
    return all;
}

static void see_lines(const struct changes *c, struct carom_drawn *drawn)
{
    if (c->lines_hash != drawn->lines_hash || !drawn->shows) {
        struct carom_rect now = find_lines(c);

        if (drawn->shows) {
            add_rect(drawn, drawn->lines);
            add_rect(drawn, now);
        }
        drawn->lines = now;
        drawn->lines_hash = c->lines_hash;
    }
}

/* ------------------------------------------------------------------- picture */

/* True if a paint b, which may be NULL, agrees with the one before but for lines and bodies' ramps. */
static bool same_paint(const struct carom_paint *a, const struct carom_paint *b)
{
    static const struct carom_paint none = {0};

    b = b ? b : &none;
    return a->palette == b->palette && draw_ramps(a) == draw_ramps(b) &&
           a->hide_interfering == b->hide_interfering &&
           a->interfering_ramp == b->interfering_ramp &&
           memcmp(&a->light, &b->light, sizeof a->light) == 0 && a->ambient_q30 == b->ambient_q30 &&
           a->shadows == b->shadows && a->horizon == b->horizon && a->smooth == b->smooth &&
           a->crease_q30 == b->crease_q30;
}

/* True if the picture was drawn before on the same pixels, in the same way. */
static bool same_picture(const struct carom_drawn *drawn, const struct carom_camera *camera,
                         const struct carom_picture *picture, enum carom_draw_style style)
{
    const struct carom_picture *old = &drawn->picture;

    return drawn->shows && drawn->style == (uint8_t)style && old->pixels == picture->pixels &&
           old->width == picture->width && old->height == picture->height &&
           old->stride == picture->stride && old->format == picture->format &&
           old->row == picture->row && old->context == picture->context &&
           same_paint(&drawn->paint, picture->paint) &&
           drawn->camera.focal_q16 == camera->focal_q16 &&
           memcmp(&drawn->camera.eye, &camera->eye, sizeof camera->eye) == 0 &&
           memcmp(&drawn->camera.target, &camera->target, sizeof camera->target) == 0;
}

/*
 * Number of bodies to visit: those of the last picture or those of the world, whichever are more.
 */
static uint32_t body_count(const struct changes *c, const struct carom_drawn *drawn)
{
    bool more = drawn->shows && drawn->count > c->source.count;

    return more ? drawn->count : c->source.count;
}

/* True if nothing has moved since the last picture, and no face interferes or did. */
FIX_OWN_FRAME static bool stands_still(const struct changes *c, const struct carom_drawn *drawn)
{
    uint32_t count = body_count(c, drawn);

    if (!draw_is_empty(&drawn->touched) || c->lines_hash != drawn->lines_hash) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct carom_drawn_body *before = &drawn->bodies[i], now = look(&c->source, i);

        if (!same_body(before, &now) || !draw_is_empty(&before->hot)) {
            return false;
        }
    }
    return c->refs == c->end;
}

/* The pixels of the picture that something else has written to. */
static struct carom_rect touched_in(const struct changes *c, const struct carom_rect *touched)
{
    const struct carom_rect all = draw_on_picture(&c->view, c->view.rect);

    return (struct carom_rect){
        touched->x0 > all.x0 ? touched->x0 : all.x0, touched->y0 > all.y0 ? touched->y0 : all.y0,
        touched->x1 < all.x1 ? touched->x1 : all.x1, touched->y1 < all.y1 ? touched->y1 : all.y1};
}

/* Find the changed rectangles, and note what the picture shows. */
FIX_OWN_FRAME static void find_changes(struct changes *c, const struct carom_camera *camera,
                                       const struct carom_picture *picture,
                                       enum carom_draw_style style, struct carom_drawn *drawn)
{
    uint32_t count = body_count(c, drawn);

    draw_view_rect(&c->view, draw_whole(&c->view, picture));
    for (uint32_t i = 0; i < count; i++) {
        see_body(c, drawn, i);
    }
    see_lines(c, drawn);
    add_rect(drawn, touched_in(c, &drawn->touched));
    drawn->touched = (struct carom_rect){0, 0, 0, 0};
    if (!drawn->shows) {
        add_rect(drawn, draw_on_picture(&c->view, c->view.rect));
    }
    drawn->count = c->source.count;
    drawn->camera = *camera;
    drawn->picture = *picture;
    drawn->paint = picture->paint ? *picture->paint : (struct carom_paint){.palette = NULL};
    drawn->style = (uint8_t)style;
}

int carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                       const struct carom_picture *picture, enum carom_draw_style style,
                       struct carom_drawn *drawn)
{
    struct changes c;
    int result = drawn == NULL || drawn->bodies == NULL ? CAROM_ERR_NULL
                                                        : draw_check(world, camera, picture, style);
    bool same;

    if (result != CAROM_OK) {
        return result;
    }
    draw_source_init(&c.source, world, picture->paint);
    if (c.source.count > drawn->room) {
        return CAROM_ERR_MEMORY;
    }
    same = same_picture(drawn, camera, picture, style);
    c.refs = c.source.hot;
    c.end = c.refs + c.source.hot_count;
    c.lines_hash = hash_lines(picture->paint);
    drawn->changed_count = 0;
    if (same && stands_still(&c, drawn)) {
        return CAROM_OK;
    }
    result = draw_view_init(&c.view, camera, picture->width, picture->height);
    if (result == CAROM_OK) {
        draw_paint_light(&c.view, picture->paint);
        drawn->shows = same;
        find_changes(&c, camera, picture, style, drawn);
    }
    for (int i = 0; result == CAROM_OK && i < drawn->changed_count; i++) {
        const struct carom_rect *r = &drawn->changed[i];
        const int32_t *middle = c.view.middle;
        const struct draw_rect part = {r->x0 - middle[0], r->y0 - middle[1], r->x1 - middle[0],
                                       r->y1 - middle[1]};

        result = draw_part(&c.source, &c.view, picture, style, &part);
        drawn->shows = result == CAROM_OK;
    }
    return result;
}

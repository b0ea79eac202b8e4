/* SPDX-License-Identifier: MIT */
/* Pictures: calls that must change nothing of the world, and write no pixel outside, whatever their arguments are. */
#include <string.h>

#include "fuzz.h"

static void triangle(void *context, const carom_v3_q32 corner[3], const carom_v3_q30 *normal,
                     uint32_t colour)
{
    (void)context;
    (void)corner;
    (void)normal;
    (void)colour;
}

static void point(void *context, const carom_v3_q32 *at, uint32_t colour)
{
    (void)context;
    (void)at;
    (void)colour;
}

static void set_camera(struct fuzz *f, struct carom_camera *camera)
{
    memset(camera, 0, sizeof *camera);
    fuzz_vector(f, camera->eye.c, 35);
    fuzz_vector(f, camera->target.c, 33);
    camera->focal_q16 = (int32_t)(fuzz_pick(f, 9) ? 1 << 16 : fuzz_number(f, 30) & INT32_MAX);
}

/* The largest palette that there is. */
static const uint32_t palette[256 * CAROM_RAMP_SHADES] = {0x123456, 0xffffffff};

/* Set colours of bodies and faces, light, shadows and lines, of any kind. */
static void set_paint(struct fuzz *f, struct carom_paint *paint)
{
    int64_t light[3];

    memset(paint, 0, sizeof *paint);
    fuzz_vector(f, light, 30);
    for (int k = 0; k < 3; k++) {
        paint->light.c[k] = (int32_t)(uint32_t)light[k];
    }
    paint->bodies = f->body_paint;
    paint->body_count = (uint32_t)fuzz_pick(f, 3);
    for (uint32_t i = 0; i < paint->body_count; i++) {
        f->body_paint[i].faces = fuzz_pick(f, 4) ? NULL : f->of_face;
        f->body_paint[i].ramp = (uint8_t)(fuzz_pick(f, 9) ? 2 : fuzz_pick(f, 256));
    }
    paint->lines = f->lines;
    paint->line_count = (uint32_t)(fuzz_pick(f, 20) ? fuzz_pick(f, 3) : 5000);
    for (uint32_t i = 0; i < paint->line_count && i < FUZZ_LINES; i++) {
        fuzz_vector(f, f->lines[i].from.c, 34);
        fuzz_vector(f, f->lines[i].to.c, 34);
        f->lines[i].colour = (uint16_t)fuzz_pick(f, fuzz_pick(f, 9) ? 256 : 65536);
    }
    paint->horizon = fuzz_pick(f, 2);
    paint->shadows = fuzz_pick(f, 3) ? NULL : &carom_shadows;
    paint->smooth = fuzz_pick(f, 3) ? NULL : &carom_smooth;
    paint->crease_q30 = fuzz_pick(f, 4) ? 0 : (int32_t)(uint32_t)fuzz_number(f, 30);
    paint->ambient_q30 = (int32_t)(uint32_t)fuzz_number(f, 29);
    paint->hide_interfering = fuzz_pick(f, 2);
    paint->interfering_ramp = (uint8_t)(fuzz_pick(f, 9) ? 0 : fuzz_pick(f, 256));
    if (fuzz_pick(f, 4) == 0) {
        paint->ramps = fuzz_pick(f, 4) ? 8 : (uint32_t)fuzz_pick(f, 300);
        paint->palette = paint->ramps == 8 ? carom_draw_palette : palette;
    }
}

static int debug(struct fuzz *f, const struct carom_paint *paint)
{
    struct carom_contact contacts[4];
    struct carom_paint_line lines[4];
    struct carom_debug_lines kept = {lines, 4, 0, 0};
    struct carom_debug d;

    memset(&d, 0, sizeof d);
    d.triangle = fuzz_pick(f, 2) ? triangle : NULL;
    d.line = fuzz_pick(f, 2) ? carom_debug_keep_line : NULL;
    d.point = fuzz_pick(f, 2) ? point : NULL;
    d.context = &kept;
    d.paint = fuzz_pick(f, 2) ? paint : NULL;
    d.size_q32 = fuzz_pick(f, 3) ? 0 : fuzz_number(f, 38);
    d.contacts = fuzz_pick(f, 4) ? contacts : NULL;
    d.contact_room = fuzz_pick(f, 20) ? fuzz_pick(f, 5) : -fuzz_pick(f, 9);
    return carom_debug_draw(f->world, (uint32_t)fuzz_pick(f, fuzz_pick(f, 9) ? 256 : 1024), &d);
}

/* Memory for a row: the picture's, or a row of its own for each. */
static void *row(void *context, int32_t x0, int32_t x1, int32_t y)
{
    struct fuzz *f = (struct fuzz *)context;

    (void)x0;
    (void)x1;
    return f->pixels + y * FUZZ_PIXELS;
}

static void set_picture(struct fuzz *f, struct carom_picture *picture)
{
    memset(picture, 0, sizeof *picture);
    picture->pixels = f->pixels;
    picture->width = fuzz_pick(f, 8) ? FUZZ_PIXELS : fuzz_pick(f, FUZZ_PIXELS + 1) - 1;
    picture->height = fuzz_pick(f, 8) ? FUZZ_PIXELS : fuzz_pick(f, FUZZ_PIXELS + 1) - 1;
    picture->stride = FUZZ_PIXELS * 4;
    picture->format = (uint8_t)fuzz_pick(f, 6);
    picture->workspace = f->workspace;
    picture->workspace_bytes =
        fuzz_pick(f, 9) ? FUZZ_WORKSPACE : (size_t)fuzz_pick(f, FUZZ_WORKSPACE);
    picture->row = fuzz_pick(f, 5) ? NULL : row;
    picture->context = f;
}

static int put_text(struct fuzz *f, const struct carom_picture *picture, struct carom_rect *touched)
{
    struct carom_text text = {.scale = (uint8_t)(fuzz_pick(f, 6) ? 1 : fuzz_pick(f, 256))};
    char letters[8];

    text.x = (int32_t)(uint32_t)fuzz_number(f, 6);
    text.y = (int32_t)(uint32_t)fuzz_number(f, 6);
    text.opaque = fuzz_pick(f, 2);
    text.colour = (uint16_t)fuzz_pick(f, 300);
    text.paper = (uint16_t)fuzz_pick(f, 300);
    for (int i = 0; i < 7; i++) {
        letters[i] = (char)fuzz_pick(f, 128);
    }
    letters[7] = '\0';
    return carom_draw_text(picture, &text, letters, touched);
}

static int put_line(struct fuzz *f, const struct carom_camera *camera,
                    const struct carom_picture *picture, struct carom_rect *touched)
{
    carom_v3_q32 from, to;

    fuzz_vector(f, from.c, 34);
    fuzz_vector(f, to.c, 34);
    return carom_draw_line(camera, picture, &from, &to, (uint32_t)fuzz_pick(f, 300), touched);
}

/* Changes from one camera to another must end as the picture itself. */
static int draw_changes(struct fuzz *f, const struct carom_camera *camera,
                        const struct carom_picture *picture, enum carom_draw_style style)
{
    static const struct carom_drawn nothing;
    struct carom_drawn drawn = nothing;
    struct carom_picture other = *picture;
    struct carom_camera before;
    int result;

    drawn.bodies = f->drawn;
    drawn.room = FUZZ_BODIES;
    set_camera(f, &before);
    (void)carom_draw_changes(f->world, fuzz_pick(f, 2) ? camera : &before, picture, style, &drawn);
    (void)put_text(f, picture, &drawn.touched);
    result = carom_draw_changes(f->world, camera, picture, style, &drawn);
    if (result < 0 || picture->row) {
        return result;
    }
    memcpy(f->others, f->pixels, FUZZ_PIXELS * FUZZ_PIXELS * sizeof *f->pixels);
    other.pixels = f->others;
    result = carom_draw(f->world, camera, &other, style);
    return memcmp(f->others, f->pixels, FUZZ_PIXELS * FUZZ_PIXELS * sizeof *f->pixels) == 0
               ? result
               : FUZZ_DIFFERS;
}

int fuzz_draw(struct fuzz *f)
{
    enum carom_draw_style style = fuzz_pick(f, 4) ? CAROM_DRAW_FLAT : CAROM_DRAW_WIRE;
    struct carom_picture picture;
    struct carom_camera camera;
    struct carom_ray_hit hit;
    struct carom_paint paint;
    struct carom_ray ray;
    int32_t x;

    set_camera(f, &camera);
    set_paint(f, &paint);
    set_picture(f, &picture);
    picture.paint = fuzz_pick(f, 2) ? &paint : NULL;
    switch (fuzz_pick(f, 8)) {
    case 0:
        return debug(f, &paint);
    case 1:
        x = fuzz_pick(f, 40) - 8;
        return carom_draw_pick(f->world, &camera, &picture, x, fuzz_pick(f, 40) - 8, NULL, &hit);
    case 2:
        x = (int32_t)(uint32_t)fuzz_number(f, 16);
        return carom_view_ray(&camera, picture.width, picture.height, x,
                              (int32_t)(uint32_t)fuzz_number(f, 16), &ray);
    case 3:
        return put_text(f, &picture, NULL);
    case 4:
        return put_line(f, &camera, &picture, NULL);
    case 5:
    case 6:
        return draw_changes(f, &camera, &picture, style);
    default:
        return carom_draw(f->world, &camera, &picture, style);
    }
}

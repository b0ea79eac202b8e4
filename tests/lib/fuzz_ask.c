/* SPDX-License-Identifier: MIT */
/* Queries and pictures: calls that must change nothing, whatever their arguments are. */
#include <string.h>

#include "fuzz.h"

/* ------------------------------------------------------------------------ questions */

static bool wants(void *context, int body)
{
    (void)context;
    return body % 3 != 0;
}

static void set_filter(struct fuzz *f, struct carom_query_filter *filter)
{
    memset(filter, 0, sizeof *filter);
    filter->mask = (uint16_t)(fuzz_pick(f, 3) ? 0 : fuzz_pick(f, 65536));
    filter->flags = (uint16_t)fuzz_pick(f, 4);
    filter->wants = fuzz_pick(f, 3) ? NULL : wants;
}

static int ask_ray(struct fuzz *f, const struct carom_query_filter *filter)
{
    struct carom_ray_hit hits[3];
    struct carom_ray ray;

    fuzz_vector(f, ray.from.c, 35);
    fuzz_vector(f, ray.way.c, 36);
    return fuzz_pick(f, 2)
               ? carom_cast_ray(f->world, &ray, filter, hits)
               : carom_cast_ray_all(f->world, &ray, filter, hits, (uint32_t)fuzz_pick(f, 4));
}

static int ask_mesh(struct fuzz *f, const struct carom_query_filter *filter)
{
    struct carom_query_mesh mesh;
    struct carom_mesh_way way;
    struct carom_mesh_hit hit;
    uint16_t bodies[4];
    int64_t turn[3];

    memset(&mesh, 0, sizeof mesh);
    mesh.mesh = &f->meshes[fuzz_pick(f, FUZZ_MESHES)];
    fuzz_vector(f, mesh.position.c, 34);
    fuzz_rotation(f, &mesh.rotation);
    fuzz_vector(f, way.way.c, 35);
    fuzz_vector(f, turn, 27);
    for (int k = 0; k < 3; k++) {
        way.turn.c[k] = (int32_t)(uint32_t)turn[k];
    }
    return fuzz_pick(f, 2)
               ? carom_cast_mesh(f->world, &mesh, &way, filter, &hit)
               : carom_overlap_mesh(f->world, &mesh, filter, bodies, (uint32_t)fuzz_pick(f, 5));
}

int fuzz_ask(struct fuzz *f)
{
    struct carom_query_filter filter;
    struct carom_closest closest;
    struct carom_face_pair pairs[8];

    set_filter(f, &filter);
    switch (fuzz_pick(f, 5)) {
    case 0:
        return ask_ray(f, fuzz_pick(f, 3) ? &filter : NULL);
    case 1:
        return ask_mesh(f, fuzz_pick(f, 3) ? &filter : NULL);
    case 2:
        return carom_query_faces(f->world, fuzz_body(f), fuzz_body(f), pairs,
                                 (uint32_t)fuzz_pick(f, 9));
    case 3: /* asks first which faces interfere, and there may be none */
        return carom_query_inside(f->world, fuzz_body(f), fuzz_body(f));
    default:
        return carom_closest_points(f->world, fuzz_body(f), fuzz_body(f), &closest);
    }
}

/* ------------------------------------------------------------------------- pictures */

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

/* Set colours of bodies and faces, light and lines, of any kind. */
static void set_paint(struct fuzz *f, struct carom_paint *paint, struct carom_body_paint bodies[2],
                      struct carom_paint_line lines[4])
{
    int64_t light[3];

    memset(paint, 0, sizeof *paint);
    for (int i = 0; i < 2; i++) {
        bodies[i] =
            (struct carom_body_paint){NULL, (uint8_t)(fuzz_pick(f, 9) ? 2 : fuzz_pick(f, 256))};
    }
    for (int i = 0; i < 4; i++) {
        fuzz_vector(f, lines[i].from.c, 34);
        fuzz_vector(f, lines[i].to.c, 34);
        lines[i].colour = (uint16_t)fuzz_pick(f, fuzz_pick(f, 9) ? 256 : 65536);
    }
    fuzz_vector(f, light, 30);
    for (int k = 0; k < 3; k++) {
        paint->light.c[k] = (int32_t)(uint32_t)light[k];
    }
    paint->bodies = bodies;
    paint->body_count = (uint32_t)fuzz_pick(f, 3);
    paint->lines = lines;
    paint->line_count = (uint32_t)(fuzz_pick(f, 20) ? fuzz_pick(f, 5) : 5000);
    paint->ambient_q30 = (int32_t)(uint32_t)fuzz_number(f, 29);
    paint->hide_interfering = fuzz_pick(f, 2);
    paint->interfering_ramp = (uint8_t)(fuzz_pick(f, 9) ? 0 : fuzz_pick(f, 256));
    if (fuzz_pick(f, 4) == 0) {
        paint->palette = carom_draw_palette;
        paint->ramps = fuzz_pick(f, 4) ? 8 : (uint32_t)fuzz_pick(f, 300);
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

int fuzz_draw(struct fuzz *f)
{
    struct carom_body_paint bodies[2];
    struct carom_paint_line lines[4];
    struct carom_picture picture;
    struct carom_camera camera;
    struct carom_ray_hit hit;
    struct carom_paint paint;
    struct carom_ray ray;

    set_camera(f, &camera);
    set_paint(f, &paint, bodies, lines);
    memset(&picture, 0, sizeof picture);
    picture.pixels = f->pixels;
    picture.width = fuzz_pick(f, 20) ? FUZZ_PIXELS : fuzz_pick(f, FUZZ_PIXELS + 1) - 1;
    picture.height = fuzz_pick(f, 20) ? FUZZ_PIXELS : fuzz_pick(f, FUZZ_PIXELS + 1) - 1;
    picture.stride = FUZZ_PIXELS * 4;
    picture.format = (uint8_t)fuzz_pick(f, 6);
    picture.workspace = f->workspace;
    picture.workspace_bytes = fuzz_pick(f, 9) ? CAROM_DRAW_BYTES(FUZZ_VERTICES, FUZZ_VERTICES)
                                              : (size_t)fuzz_pick(f, 20000);
    picture.paint = fuzz_pick(f, 2) ? &paint : NULL;
    switch (fuzz_pick(f, 4)) {
    case 0:
        return debug(f, &paint);
    case 1:
        return carom_draw_pick(f->world, &camera, &picture, fuzz_pick(f, 40) - 8,
                               fuzz_pick(f, 40) - 8, NULL, &hit);
    case 2:
        return carom_view_ray(&camera, picture.width, picture.height,
                              (int32_t)(uint32_t)fuzz_number(f, 16),
                              (int32_t)(uint32_t)fuzz_number(f, 16), &ray);
    default:
        return carom_draw(f->world, &camera, &picture,
                          fuzz_pick(f, 2) ? CAROM_DRAW_FLAT : CAROM_DRAW_WIRE);
    }
}

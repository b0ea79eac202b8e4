/* SPDX-License-Identifier: MIT */
/* Queries: calls that must change nothing, whatever their arguments are. */
#include <string.h>

#include "fuzz.h"

/* ------------------------------------------------------------------------ questions */

static struct carom_cast_workspace workspace;

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
               ? carom_cast_mesh(f->world, &mesh, &way, filter, &workspace, &hit)
               : carom_overlap_mesh(f->world, &mesh, filter, bodies, (uint32_t)fuzz_pick(f, 5));
}

static int ask_faces(struct fuzz *f)
{
    struct carom_face_pair pairs[8];
    const int a = fuzz_body(f), b = fuzz_body(f);

    return carom_query_faces(f->world, a, b, pairs, (uint32_t)fuzz_pick(f, 9));
}

int fuzz_ask(struct fuzz *f)
{
    struct carom_query_filter filter;
    struct carom_closest closest;
    int a;

    set_filter(f, &filter);
    switch (fuzz_pick(f, 5)) {
    case 0:
        return ask_ray(f, fuzz_pick(f, 3) ? &filter : NULL);
    case 1:
        return ask_mesh(f, fuzz_pick(f, 3) ? &filter : NULL);
    case 2:
        return ask_faces(f);
    case 3: /* asks first which faces interfere, and there may be none */
        a = fuzz_body(f);
        return carom_query_inside(f->world, a, fuzz_body(f));
    default:
        a = fuzz_body(f);
        return carom_closest_points(f->world, a, fuzz_body(f), &closest);
    }
}

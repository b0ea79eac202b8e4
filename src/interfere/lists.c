/* SPDX-License-Identifier: MIT */
/*
 * Make z-lists within a step, for surfaces that move. If the pool of entries is too small the lists
 * are made in chunks, and the pairs are gathered once for each chunk. Every (face, cell) entry is
 * in one of the chunks, so no pair is lost.
 */
#include "narrow.h"

/* True if the face's bounding rectangle meets the area. */
static bool face_in(const struct carom_mesh *mesh, uint32_t face, const struct interfere_area *area)
{
    const uint16_t *corner = mesh->raw.faces[face];
    const int16_t *p = mesh->raw.vertices[corner[0]], *q = mesh->raw.vertices[corner[1]],
                  *r = mesh->raw.vertices[corner[2]];

    for (int k = 0; k < 2; k++) {
        int32_t low = area->low[k], high = area->high[k];

        if ((p[k] < low && q[k] < low && r[k] < low) ||
            (p[k] > high && q[k] > high && r[k] > high)) {
            return false;
        }
    }
    return true;
}

/* True if the lists at hand are complete, of that mesh, and cover the area. */
static bool hold(const struct interfere *in, const struct carom_mesh *mesh,
                 const struct interfere_area *area)
{
    return in->listed == mesh && in->area.low[0] <= area->low[0] &&
           in->area.low[1] <= area->low[1] && in->area.high[0] >= area->high[0] &&
           in->area.high[1] >= area->high[1];
}

/* Enlarge the requested area a little: a body that a hit deflects asks again in the same step. */
static struct interfere_area grown(const struct interfere_area *area)
{
    struct interfere_area more = *area;

    for (int k = 0; k < 2; k++) {
        int32_t by = (area->high[k] - area->low[k]) / INTERFERE_AREA_DIVISOR;

        more.low[k] -= by;
        more.high[k] += by;
    }
    return more;
}

bool interfere_make_lists(struct interfere *in, const struct carom_mesh *mesh,
                          const struct interfere_area *area, struct interfere_place *from)
{
    const struct interfere_area more = grown(area);
    bool first = from->face == 0 && from->cells == 0;

    if (first && hold(in, mesh, area)) {
        return true;
    }
    in->listed = NULL;
    zlist_clear(&in->lists);
    for (; from->face < mesh->raw.face_count; from->face++, from->cells = 0) {
        if (face_in(mesh, from->face, &more) &&
            !mesh->surface->does->list_face(mesh, from->face, &in->lists, &from->cells)) {
            return false;
        }
    }
    in->listed = first ? mesh : NULL;
    in->area = more;
    return true;
}

struct interfere_area interfere_area_under(const struct body *bodies, const struct pair *pairs,
                                           uint32_t pair_count, uint16_t b)
{
    struct interfere_area area = {{INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN}};
    const struct body *surface = &bodies[b];
    int shift = 32 - surface->def.mesh->raw.quantum_bits;
    carom_m3_q30 r;

    fix_matrix(&r, &surface->search.region.q);
    for (uint32_t i = 0; i < pair_count; i++) {
        const struct body *a = &bodies[pairs[i].a];
        int64_t way[3], around_q22 = (int64_t)a->def.radius_q22 + a->search.reach_q22 +
                                     surface->search.reach_q22;
        int32_t around = (int32_t)(around_q22 >> (shift - 10)) + 2;

        for (int k = 0; k < 3; k++) {
            way[k] = a->search.region.at.c[k] - surface->search.region.at.c[k];
        }
        fix_rotate_back(way, &r, way);
        for (int k = 0; pairs[i].b == b && k < 2; k++) {
            /* places are below 2^14 units, hence 2^34 quanta; clamp before the cast */
            int64_t at = way[k] >> shift;
            int32_t middle = (int32_t)(at < -(1 << 20) ? -(1 << 20) : at > 1 << 20 ? 1 << 20 : at);

            area.low[k] = middle - around < area.low[k] ? middle - around : area.low[k];
            area.high[k] = middle + around > area.high[k] ? middle + around : area.high[k];
        }
    }
    return area;
}

void interfere_forget_lists(struct interfere *in)
{
    in->listed = NULL;
}

/* SPDX-License-Identifier: MIT */
/*
 * The outline of a solid, as the light sees it: edges between lit and unlit faces. All that the
 * solid shades lies behind it. A sweep across the light cuts its inside into trapezoids. At each
 * height the edges are ordered from left to right, and a stretch is inside where more of the edges
 * before it go up than down, or the other way round. If edges cross between two heights their order
 * half way counts.
 */
#include "../num/sort.h"
#include "outline.h"

/* Two coordinates across the light of a point in view coordinates. */
static void across(const struct draw_outline *o, const int32_t at[3], int32_t pq[2])
{
    for (int k = 0; k < 2; k++) {
        pq[k] = (int32_t)(carom_dot(o->across[k].c, at) >> 30);
    }
}

static bool is_lit(const struct draw_body *body, uint32_t face)
{
    return carom_dot(body->mesh->faces[face].normal.c, body->light.c) > 0;
}

/* Add an edge whose lit side is on the left. A level edge bounds nothing and is left out. */
static void add_edge(struct draw_outline *o, const struct draw_body *body, uint32_t from,
                     uint32_t to)
{
    struct draw_outline_edge *edge = &o->edges[o->edge_count];
    int32_t a[2], b[2];

    draw_place(body, from, edge->at[0]);
    draw_place(body, to, edge->at[1]);
    across(o, edge->at[0], a);
    across(o, edge->at[1], b);
    if (a[1] == b[1]) {
        return;
    }
    edge->up = a[1] < b[1] ? 1 : -1;
    edge->trapezoid = 0;
    if (edge->up < 0) {
        draw_place(body, to, edge->at[0]);
        draw_place(body, from, edge->at[1]);
    }
    edge->p[0] = edge->up > 0 ? a[0] : b[0];
    edge->p[1] = edge->up > 0 ? b[0] : a[0];
    edge->q[0] = edge->up > 0 ? a[1] : b[1];
    edge->q[1] = edge->up > 0 ? b[1] : a[1];
    o->edge_count++;
}

/* List the edges of the outline. Returns false if there are more than fit. */
static bool find_edges(struct draw_outline *o, const struct draw_body *body, uint32_t most)
{
    const struct carom_mesh *mesh = body->mesh;

    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        const struct carom_edge *edge = &mesh->edges[e];
        bool first = is_lit(body, edge->face[0]);

        if (first != is_lit(body, edge->face[1])) {
            if (o->edge_count == most) {
                return false;
            }
            add_edge(o, body, edge->vertex[!first], edge->vertex[first]);
        }
    }
    return true;
}

/* The part of an edge below a height, q30. */
static int64_t part_of(const struct draw_outline_edge *edge, int32_t q)
{
    return ((int64_t)q - edge->q[0]) * CAROM_ONE_Q30 / ((int64_t)edge->q[1] - edge->q[0]);
}

void draw_outline_point(const struct draw_outline *o, uint32_t number, int32_t q, int32_t at[3])
{
    const struct draw_outline_edge *edge = &o->edges[number];
    int64_t part_q30 = part_of(edge, q);

    for (int k = 0; k < 3; k++) {
        at[k] =
            edge->at[0][k] + (int32_t)(((int64_t)edge->at[1][k] - edge->at[0][k]) * part_q30 >> 30);
    }
}

/* -------------------------------------------------------------------- sweep */

/* Order the active edges from left to right, half way between two heights. */
static void order_edges(struct draw_outline *o, uint32_t count, int32_t low, int32_t high)
{
    int32_t q = (int32_t)(((int64_t)low + high) >> 1);

    for (uint32_t i = 0; i < count; i++) {
        const struct draw_outline_edge *edge = &o->edges[o->active[i]];
        uint16_t number = o->active[i];
        int64_t p = edge->p[0] + (((int64_t)edge->p[1] - edge->p[0]) * part_of(edge, q) >> 30);
        uint32_t at = i;

        for (; at > 0 && o->place[at - 1] > p; at--) {
            o->place[at] = o->place[at - 1];
            o->active[at] = o->active[at - 1];
        }
        o->place[at] = p;
        o->active[at] = number;
    }
}

/* Extend the trapezoid between two edges that ends at `low`, or begin one. Returns false if there is no room. */
static bool add_stretch(struct draw_outline *o, uint16_t left, uint16_t right, int32_t low,
                        int32_t high, uint32_t most)
{
    struct draw_outline_edge *edge = &o->edges[left];
    struct draw_trapezoid *t = &o->trapezoids[edge->trapezoid];

    if (edge->trapezoid < o->trapezoid_count && t->left == left && t->right == right &&
        t->high == low) {
        t->high = high;
        return true;
    }
    if (o->trapezoid_count == most) {
        return false;
    }
    edge->trapezoid = (uint16_t)o->trapezoid_count;
    o->trapezoids[o->trapezoid_count++] = (struct draw_trapezoid){left, right, low, high};
    return true;
}

/* Add the stretches between the ordered edges. Returns false if there is no room. */
static bool add_stretches(struct draw_outline *o, uint32_t count, int32_t low, int32_t high,
                          uint32_t most)
{
    int winding = 0;
    uint16_t left = 0;

    for (uint32_t i = 0; i < count; i++) {
        int before = winding;

        winding += o->edges[o->active[i]].up;
        if (before == 0) {
            left = o->active[i];
        } else if (winding == 0 && !add_stretch(o, left, o->active[i], low, high, most)) {
            return false;
        }
    }
    return true;
}

/* Remove edges that end at or below a height. */
static uint32_t drop_ended(struct draw_outline *o, uint32_t count, int32_t q)
{
    uint32_t n = 0;

    for (uint32_t i = 0; i < count; i++) {
        if (o->edges[o->active[i]].q[1] > q) {
            o->active[n++] = o->active[i];
        }
    }
    return n;
}

/* A key of a height and an edge's end, which sorts by height. */
static uint64_t key_of(int32_t q, uint32_t edge)
{
    return (uint64_t)((uint32_t)q ^ 0x80000000u) << 32 | edge;
}

static int32_t height_of(uint64_t key)
{
    return (int32_t)((uint32_t)(key >> 32) ^ 0x80000000u);
}

static bool sweep(struct draw_outline *o, uint32_t most)
{
    uint32_t active = 0, n = 2 * o->edge_count;

    /* number 2 e is the begin of edge e, 2 e + 1 its end */
    for (uint32_t i = 0; i < n; i++) {
        o->keys[i] = key_of(o->edges[i / 2].q[i % 2], i);
    }
    sort_keys(o->keys, n);
    for (uint32_t i = 0; i < n;) {
        int32_t q = height_of(o->keys[i]);

        active = drop_ended(o, active, q);
        for (; i < n && height_of(o->keys[i]) == q; i++) {
            uint32_t end = (uint32_t)o->keys[i];

            if (end % 2 == 0) {
                o->active[active++] = (uint16_t)(end / 2);
            }
        }
        if (i < n) {
            int32_t next = height_of(o->keys[i]);

            order_edges(o, active, q, next);
            if (!add_stretches(o, active, q, next, most)) {
                return false;
            }
        }
    }
    return true;
}

/* ------------------------------------------------------------------- outline */

/* Find two directions across the light. */
static void find_across(struct draw_outline *o, const int32_t sun[3])
{
    int64_t v[3] = {0, 0, 0};
    int flat = carom_abs(sun[0]) >
               carom_abs(sun[1]); /* of x and y, the one that the light is more along */

    v[flat ? 0 : 1] = -(int64_t)sun[2];
    v[2] = sun[flat ? 0 : 1];
    fix_normalise(&o->across[0], v);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        v[k] = (int64_t)sun[i] * o->across[0].c[j] - (int64_t)sun[j] * o->across[0].c[i];
    }
    fix_normalise(&o->across[1], v);
}

/* numbers of trapezoids, three for each edge, have 16 bits */
#define MOST_EDGES (0xffff / 3)

#define EDGE_BYTES                                                                                 \
    (sizeof(struct draw_outline_edge) + 3 * sizeof(uint64_t) + 3 * sizeof(struct draw_trapezoid) + \
     sizeof(uint16_t))

bool draw_outline_find(struct draw_outline *o, const struct draw_body *body, const int32_t sun[3],
                       void *scratch, size_t bytes)
{
    size_t most = bytes / EDGE_BYTES;

    most = most < MOST_EDGES ? most : MOST_EDGES;
    o->keys = (uint64_t *)scratch; /* two for each edge */
    o->place = (int64_t *)(o->keys + 2 * most);
    o->edges = (struct draw_outline_edge *)(void *)(o->place + most);
    o->trapezoids = (struct draw_trapezoid *)(void *)(o->edges + most);
    o->active = (uint16_t *)(void *)(o->trapezoids + 3 * most);
    o->edge_count = o->trapezoid_count = 0;
    find_across(o, sun);
    return find_edges(o, body, (uint32_t)most) && sweep(o, 3 * (uint32_t)most);
}

void draw_outline_across(const struct draw_outline *o, const int32_t at[3], int32_t pq[2])
{
    across(o, at, pq);
}

/* SPDX-License-Identifier: MIT */
/* The first hit of a ray in a world, or all hits in order. */
#include "query.h"

#define LIMIT_Q32     ((int64_t)1 << (15 + 32))
#define WAY_LEAST_Q32 ((int64_t)1 << (32 - 20))

bool query_wants(const struct carom_world *w, const struct carom_query_filter *filter,
                 uint32_t body)
{
    const struct body *b = &w->bodies[body];

    if (!b->def.mesh || world_now(w)->bodies[body].out) {
        return false;
    }
    if (b->def.sensor && !(filter && (filter->flags & CAROM_QUERY_SENSORS))) {
        return false;
    }
    return !filter || ((filter->mask == 0 || (b->def.category & filter->mask) != 0) &&
                       (!filter->wants || filter->wants(filter->context, (int)body)));
}

static int check_ray(const struct carom_ray *ray)
{
    int64_t longest = 0;

    if (!world_each_within(ray->from.c, LIMIT_Q32) || !world_each_within(ray->way.c, LIMIT_Q32)) {
        return CAROM_ERR_RANGE;
    }
    for (int k = 0; k < 3; k++) {
        longest = carom_abs(ray->way.c[k]) > longest ? carom_abs(ray->way.c[k]) : longest;
    }
    return longest < WAY_LEAST_Q32 ? (int)CAROM_ERR_ARGUMENT : CAROM_OK;
}

/* Hits found so far: the first `room` ones, in order. */
struct cast {
    struct query_struck base;
    const struct carom_world *w;
    struct carom_ray_hit *hits;
    uint32_t room, count;
    bool more;    /* there are more than fit */
    bool nearest; /* only the first hit is wanted */
    uint16_t body;
};

/* A place on a ray as t in q48, three digits of 16 bits. length < 2^48. */
static int64_t part_q48(int64_t way_q32, int64_t length_q32)
{
    uint64_t rest = (uint64_t)way_q32, by = (uint64_t)length_q32, t = 0;

    if (way_q32 >= length_q32) {
        return (int64_t)1 << 48;
    }
    for (int digit = 0; digit < 3; digit++) {
        rest <<= 16;
        t = t << 16 | rest / by;
        rest %= by;
    }
    return (int64_t)t;
}

static int64_t key_of(const struct carom_ray_hit *hit)
{
    return (int64_t)hit->t_q30 << 18 | (int64_t)hit->t_rest;
}

/* True if a hit comes before b in order; false if they are equal. */
static bool is_before(int64_t t_q48, uint16_t body, uint16_t face, const struct carom_ray_hit *b)
{
    int64_t t_b = key_of(b);

    if (t_q48 != t_b) {
        return t_q48 < t_b;
    }
    return body != b->body ? body < b->body : face < b->face;
}

/* Insert a hit in order; ignore one that is there already. */
static void take_hit(struct query_struck *self, struct query_ray *ray,
                     const struct query_strike *strike)
{
    struct cast *c = (struct cast *)self;
    int64_t t_q48 = part_q48(strike->way_q32, ray->length_q32);
    uint32_t place = c->count;

    while (place > 0 && is_before(t_q48, c->body, strike->face, &c->hits[place - 1])) {
        place--;
    }
    if (place > 0 && c->hits[place - 1].body == c->body &&
        c->hits[place - 1].face == strike->face) {
        return;
    }
    if (c->count == c->room) {
        c->more = true;
        if (place == c->room) {
            return;
        }
    } else {
        c->count++;
    }
    memmove(&c->hits[place + 1], &c->hits[place], (c->count - 1 - place) * sizeof *c->hits);
    c->hits[place].body = c->body;
    c->hits[place].face = strike->face;
    c->hits[place].t_q30 = (int32_t)(t_q48 >> 18);
    c->hits[place].t_rest = (uint32_t)(t_q48 & ((1 << 18) - 1));
    if (c->nearest) {
        ray->end_q32 = strike->way_q32 + 1 < ray->end_q32 ? strike->way_q32 + 1 : ray->end_q32;
    }
}

/* Set a hit's place and its normal in world axes. */
static void complete(const struct carom_world *w, const struct carom_ray *ray,
                     struct carom_ray_hit *hit)
{
    const struct carom_mesh *mesh = w->bodies[hit->body].def.mesh;
    carom_m3_q30 r;

    fix_matrix(&r, &world_now(w)->bodies[hit->body].rotation);
    carom_rotate(hit->normal.c, &r, mesh->faces[hit->face].normal.c);
    for (int k = 0; k < 3; k++) {
        hit->point.c[k] = ray->from.c[k] + fix_mul_q30(ray->way.c[k], hit->t_q30) +
                          fix_mul(ray->way.c[k], (int32_t)hit->t_rest, 48);
    }
}

static void cast(struct cast *c, const struct carom_ray *ray,
                 const struct carom_query_filter *filter)
{
    const struct carom_world *w = c->w;
    struct query_ray carried;

    for (uint32_t i = 0; i < w->body_count; i++) {
        if (!w->bodies[i].def.mesh ||
            !query_carry(&carried, ray, &w->bodies[i], &world_now(w)->bodies[i]) ||
            !query_wants(w, filter, i)) {
            continue;
        }
        c->body = (uint16_t)i;
        carried.back = filter && (filter->flags & CAROM_QUERY_BACK);
        if (c->nearest && c->count > 0) {
            /* no farther than the hit that is known; t is rounded down */
            int64_t end_q32 =
                fix_mul_q30(carried.length_q32, c->hits[0].t_q30) + (carried.length_q32 >> 30) + 2;

            carried.end_q32 = end_q32 < carried.length_q32 ? end_q32 : carried.length_q32;
        }
        query_march(&carried, &c->base);
    }
    for (uint32_t i = 0; i < c->count; i++) {
        complete(w, ray, &c->hits[i]);
    }
}

int carom_cast_ray(const struct carom_world *world, const struct carom_ray *ray,
                   const struct carom_query_filter *filter, struct carom_ray_hit *hit)
{
    struct carom_ray_hit found;
    struct cast c = {{take_hit}, world, &found, 1, 0, false, true, 0};
    int result;

    if (!world || !ray || !hit) {
        return CAROM_ERR_NULL;
    }
    result = check_ray(ray);
    if (result < 0) {
        return result;
    }
    cast(&c, ray, filter);
    if (c.count > 0) {
        *hit = found;
    }
    return (int)c.count;
}

int carom_cast_ray_all(const struct carom_world *world, const struct carom_ray *ray,
                       const struct carom_query_filter *filter, struct carom_ray_hit *hits,
                       uint32_t room)
{
    struct cast c = {{take_hit}, world, hits, room, 0, false, false, 0};
    int result;

    if (!world || !ray || (!hits && room > 0)) {
        return CAROM_ERR_NULL;
    }
    result = check_ray(ray);
    if (result < 0) {
        return result;
    }
    cast(&c, ray, filter);
    return c.more ? CAROM_ERR_FACES_FULL : (int)c.count;
}

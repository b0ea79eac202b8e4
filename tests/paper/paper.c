/* SPDX-License-Identifier: MIT */
/* The paper's interference detection: bounding box, z-lists by scan conversion, overlap in z. */
#include "paper.h"
#include "mesh/mesh.h"

#define VERTICES 65535
#define PIXELS   (PAPER_SIDE * PAPER_SIDE)
#define CORNERS  7    /* corners of a triangle clipped by four planes */
#define SEEN     4096 /* pairs that are remembered, so that each is handed over once */
/* Faces closer to upright than 1 in 65536 are left out: no pixel's centre sees them. */
#define UPRIGHT_Q30 (1 << 14)

/* An entry of a z-list, packed so that writing and comparing take few instructions. */
struct paper_entry {
    uint32_t z_face; /* z, 0 .. 65535 over the height of the box, and the face below */
    uint32_t link;   /* the next entry, of lower or equal z, or NONE; and the mesh of its face */
};
#define NONE 0x0fffffffu
#define OF_A 0x80000000u
#define OF_B 0x40000000u
#define DOWN 0x20000000u /* the face looks down: a ray from above leaves its body there */

static struct {
    uint32_t head[PIXELS]; /* the highest entry of a pixel, and the meshes of its faces */
    struct paper_entry entry[PAPER_ENTRIES];
    uint32_t used, refused;
    int32_t placed_q20[2][VERTICES][3]; /* of a, of b */
    uint32_t seen[SEEN];
} buffer;

/* The box of the moving mesh, and the size of a pixel. */
struct paper_box {
    int32_t low_q20[3], high_q20[3];
    int64_t scale_q30[2]; /* from q20 to pixels, q4 */
    int z_shift;          /* from q20 to an entry's z */
};

/* A face that is being scanned. */
struct paper_face {
    uint32_t number, bits;         /* for its entries */
    int32_t z0, z1;                /* its unclipped extent, in units of entries */
    int64_t z_q32, dx_q32, dy_q32; /* over the box: at the centre of pixel 0, 0, and the step to the
                                    * next pixel */
};

/* A row of a face's pixels: x0 <= x < x1. */
struct paper_run {
    int32_t y, x0, x1;
};

/* ------------------------------------------------------------------- places */

static void place(const struct paper_placed *p, int body)
{
    for (uint32_t v = 0; v < p->mesh->raw.vertex_count; v++) {
        carom_v3_q22 local = mesh_vertex(p->mesh, v);
        int32_t *out = buffer.placed_q20[body][v];

        for (int k = 0; k < 3; k++) {
            /* the upper word: q30 times q22 is q52 */
            out[k] = (int32_t)(carom_dot(p->r->c[k], local.c) >> 32) + p->at_q20[k];
        }
    }
}

/* The extent of a body along an axis. */
static void extent(int body, uint32_t vertex_count, int k, int32_t *low, int32_t *high)
{
    *low = INT32_MAX;
    *high = INT32_MIN;
    for (uint32_t v = 0; v < vertex_count; v++) {
        int32_t x = buffer.placed_q20[body][v][k];

        *low = x < *low ? x : *low;
        *high = x > *high ? x : *high;
    }
}

static void bound(struct paper_box *box, uint32_t vertex_count)
{
    for (int k = 0; k < 3; k++) {
        extent(0, vertex_count, k, &box->low_q20[k], &box->high_q20[k]);
        box->high_q20[k]++; /* no side is 0 */
    }
    for (int k = 0; k < 2; k++) {
        int64_t side = (int64_t)box->high_q20[k] - box->low_q20[k];

        box->scale_q30[k] = ((int64_t)(16 * PAPER_SIDE) << 30) / side;
    }
    box->z_shift = 0;
    while ((((int64_t)box->high_q20[2] - box->low_q20[2]) >> box->z_shift) > UINT16_MAX) {
        box->z_shift++;
    }
}

/* The paper's simple test, along z only. */
static bool may_meet(const struct paper_box *box, const struct paper_placed *b)
{
    int32_t low, high;

    extent(1, b->mesh->raw.vertex_count, 2, &low, &high);
    return low <= box->high_q20[2] && high >= box->low_q20[2];
}

/* ----------------------------------------------------------------- clipping */

struct polygon {
    int n;
    int32_t xy_q20[CORNERS][2];
};

/*
 * Cut off the part beyond a limit along axis k; `sign` is 1 for an upper limit, -1 for a lower one.
 */
static void clip(struct polygon *p, int k, int sign, int32_t limit)
{
    struct polygon from = *p;

    p->n = 0;
    for (int i = 0; i < from.n; i++) {
        const int32_t *a = from.xy_q20[i], *b = from.xy_q20[i + 1 < from.n ? i + 1 : 0];
        int64_t over_a = sign * ((int64_t)a[k] - limit), over_b = sign * ((int64_t)b[k] - limit);

        if (over_a <= 0) {
            p->xy_q20[p->n][0] = a[0];
            p->xy_q20[p->n++][1] = a[1];
        }
        if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
            int64_t along = (int64_t)b[1 - k] - a[1 - k];

            /* places are within 2^30, so the product is below 2^62 */
            p->xy_q20[p->n][k] = limit;
            p->xy_q20[p->n++][1 - k] = a[1 - k] + (int32_t)(along * over_a / (over_a - over_b));
        }
    }
}

/* The part of a face over the box, in pixels; false when there is none. */
static bool project(const struct paper_box *box, const int32_t *const corner[3],
                    int32_t xy_q4[CORNERS][2], int *n)
{
    struct polygon p = {3, {{0}}};

    for (int i = 0; i < 3; i++) {
        p.xy_q20[i][0] = corner[i][0];
        p.xy_q20[i][1] = corner[i][1];
    }
    for (int k = 0; k < 2; k++) {
        int32_t low = box->low_q20[k], high = box->high_q20[k];
        bool below = false, above = false;

        for (int i = 0; i < p.n; i++) {
            below = below || p.xy_q20[i][k] < low;
            above = above || p.xy_q20[i][k] > high;
        }
        if (below) {
            clip(&p, k, -1, low);
        }
        if (above) {
            clip(&p, k, 1, high);
        }
    }
    for (int i = 0; i < p.n; i++) {
        for (int k = 0; k < 2; k++) {
            /* a place in the box times its scale: at most 8192 of q30 */
            int64_t x = (int64_t)p.xy_q20[i][k] - box->low_q20[k];

            xy_q4[i][k] = (int32_t)((x * box->scale_q30[k]) >> 30);
        }
    }
    *n = p.n;
    return p.n >= 3;
}

/* ----------------------------------------------------------------- scanning */

/*
 * If two z are equal, the later one lies above. b is entered before a, so touching faces count as
 * crossing.
 */
static void enter(uint32_t pixel, uint32_t z, const struct paper_face *f)
{
    uint32_t above = z << 16 | 0xffff, here = buffer.used, first = buffer.head[pixel];
    uint32_t next = first & NONE, *link = &buffer.head[pixel];

    if (here == PAPER_ENTRIES) {
        buffer.refused++;
        return;
    }
    buffer.used = here + 1;
    *link = first | f->bits;
    while (next != NONE && buffer.entry[next].z_face > above) {
        link = &buffer.entry[next].link;
        next = *link & NONE;
    }
    buffer.entry[here].z_face = z << 16 | f->number;
    buffer.entry[here].link = next | f->bits;
    *link = (*link & ~NONE) | here;
}

/*
 * A row of a face that leaves the box. The part above the box counts as at its top, so that a ray
 * knows whether it is inside; the part below ends nothing within the box and is left out.
 */
static void enter_clipped(const struct paper_box *box, const struct paper_face *f,
                          const struct paper_run *run, int64_t z_q32)
{
    uint32_t pixel = (uint32_t)(run->y * PAPER_SIDE);

    for (int32_t x = run->x0; x < run->x1; x++, z_q32 += f->dx_q32) {
        int64_t high = z_q32 >> (box->z_shift + 12);
        int32_t z = high < f->z0 ? f->z0 : high > f->z1 ? f->z1 : (int32_t)high;

        if (z >= 0) {
            enter(pixel + (uint32_t)x, z > UINT16_MAX ? UINT16_MAX : (uint32_t)z, f);
        }
    }
}

/*
 * One row of a face. If both ends are within the box by a unit of z, steps of 2^-15 of that unit
 * are fine enough: 512 steps are off by 2^-6.
 */
static void enter_run(const struct paper_box *box, const struct paper_face *f,
                      const struct paper_run *run)
{
    int shift = box->z_shift + 12;
    int64_t z_q32 = f->z_q32 + run->x0 * f->dx_q32 + run->y * f->dy_q32;
    int64_t first = z_q32 >> shift, last = (z_q32 + (run->x1 - run->x0 - 1) * f->dx_q32) >> shift;
    uint32_t pixel = (uint32_t)(run->y * PAPER_SIDE + run->x0), z_q15, step_q15;

    if (first < 1 || last < 1 || first >= UINT16_MAX || last >= UINT16_MAX) {
        enter_clipped(box, f, run, z_q32);
        return;
    }
    z_q15 = (uint32_t)(z_q32 >> (shift - 15));
    step_q15 = (uint32_t)(f->dx_q32 >> (shift - 15));
    for (int32_t n = run->x1 - run->x0; n > 0; n--, pixel++, z_q15 += step_q15) {
        enter(pixel, z_q15 >> 15, f);
    }
}

/*
 * The plane of a face over the box. With its normal n, z falls by n.x / n.z for a step along x; a
 * pixel is 1/512 of a side, 2^-9 q20 = 2^3 q32.
 *
 * Bounds: sides are below 2^26 and n below 2^30, so a step is below 2^59 before it is divided by at
 * least 2^14, and below 2^45; 512 of them below 2^54. The two products of `fall` are below 2^61
 * each, and the quotient below 2^48, or 2^60 in q32.
 */
static void set_plane(struct paper_face *f, const struct paper_box *box, const int32_t n[3],
                      const int32_t corner[3])
{
    int64_t fall = 0, step_q32[2];

    for (int k = 0; k < 2; k++) {
        int32_t side = box->high_q20[k] - box->low_q20[k];

        fall += (int64_t)n[k] * ((int64_t)box->low_q20[k] - corner[k]);
        step_q32[k] = -((int64_t)n[k] * side * 8) / n[2];
    }
    f->dx_q32 = step_q32[0];
    f->dy_q32 = step_q32[1];
    f->z_q32 = ((int64_t)corner[2] - box->low_q20[2] - fall / n[2]) * 4096 +
               (step_q32[0] + step_q32[1]) / 2;
}

/*
 * Note where an edge, from its lower end a up to b, has its first pixel on the right in each row
 * whose centre it crosses; the rows go into `rows`. The slope is off by 2^-16, so x by no more than
 * 2^-7 of a pixel in all rows.
 *
 * Bounds: corners are within 2^13 of q4, the slope within 2^29; with more than one row, a step of 16
 * in y is so flat that it fits as well.
 */
static void walk_edge(int16_t x[PAPER_SIDE], int32_t rows[2], const int32_t a[2],
                      const int32_t b[2])
{
    int32_t y = (a[1] + 7) >> 4, y_end = (b[1] + 7) >> 4, slope_q16, x_q20, step_q20;

    if (y >= y_end) {
        return;
    }
    rows[0] = y < rows[0] ? y : rows[0];
    rows[1] = y_end > rows[1] ? y_end : rows[1];
    slope_q16 = (b[0] - a[0]) * 65536 / (b[1] - a[1]);
    x_q20 = a[0] * 65536 + (int32_t)((int64_t)slope_q16 * (16 * y + 8 - a[1]));
    x_q20 += 8 * 65536 - 1; /* ceil((x - 8) / 16) */
    step_q20 = y + 1 < y_end ? slope_q16 * 16 : 0;
    for (; y < y_end; y++, x_q20 += step_q20) {
        x[y] = (int16_t)(x_q20 >> 20);
    }
}

/*
 * Every pixel of a face over the box. The face is a convex polygon, counter-clockwise unless it
 * looks down.
 */
static void fill(const struct paper_box *box, const struct paper_face *f,
                 const int32_t xy_q4[CORNERS][2], int count)
{
    int16_t x[2][PAPER_SIDE]; /* left, right */
    int32_t rows[2] = {PAPER_SIDE, 0};
    int up = f->bits & DOWN ? 0 : 1;
    struct paper_run run;

    for (int i = 0; i < count; i++) {
        const int32_t *a = xy_q4[i], *b = xy_q4[i + 1 < count ? i + 1 : 0];

        if (a[1] < b[1]) {
            walk_edge(x[up], rows, a, b);
        } else {
            walk_edge(x[1 - up], rows, b, a);
        }
    }
    for (run.y = rows[0]; run.y < rows[1]; run.y++) {
        run.x0 = x[0][run.y];
        run.x1 = x[1][run.y];
        if (run.x0 < run.x1) {
            enter_run(box, f, &run);
        }
    }
}

static void scan_face(const struct paper_box *box, const struct paper_placed *p, uint8_t body,
                      uint16_t number)
{
    const uint16_t *v = p->mesh->raw.faces[number];
    const int32_t *const corner[3] = {buffer.placed_q20[body][v[0]], buffer.placed_q20[body][v[1]],
                                      buffer.placed_q20[body][v[2]]};
    int32_t n[3], xy_q4[CORNERS][2], low = INT32_MAX, high = INT32_MIN;
    struct paper_face f;
    int count;

    for (int i = 0; i < 3; i++) {
        low = corner[i][2] < low ? corner[i][2] : low;
        high = corner[i][2] > high ? corner[i][2] : high;
    }
    carom_rotate(n, p->r, p->mesh->faces[number].normal.c);
    if (high < box->low_q20[2] || carom_abs(n[2]) < UPRIGHT_Q30 ||
        !project(box, corner, xy_q4, &count)) {
        return;
    }
    f.number = number;
    f.bits = (body ? OF_B : OF_A) | (n[2] < 0 ? DOWN : 0);
    f.z0 = (low - box->low_q20[2]) >> box->z_shift;
    f.z1 = (high - box->low_q20[2]) >> box->z_shift;
    set_plane(&f, box, n, corner[0]);
    fill(box, &f, (const int32_t(*)[2])xy_q4, count);
}

static void scan_mesh(const struct paper_box *box, const struct paper_placed *p, uint8_t body)
{
    for (uint32_t face = 0; face < p->mesh->raw.face_count; face++) {
        scan_face(box, p, body, (uint16_t)face);
    }
}

/* ------------------------------------------------------------------ reading */

static void hand_over(struct paper_visitor *visitor, const struct paper_entry *one,
                      const struct paper_entry *other)
{
    uint16_t a = (uint16_t)(one->link & OF_B ? other : one)->z_face;
    uint16_t b = (uint16_t)(one->link & OF_B ? one : other)->z_face;
    uint32_t key = (uint32_t)a << 16 | b, *seen = &buffer.seen[(a * 61u + b) % SEEN];

    if (*seen != key) {
        *seen = key;
        visitor->visit(visitor, a, b);
    }
}

/*
 * Go down one pixel. A ray enters a body by a face that looks up and leaves it by one that looks
 * down. A face that the ray meets inside of the other body interferes with that body's faces next
 * to it.
 */
static void read_pixel(uint32_t at, struct paper_visitor *visitor)
{
    const struct paper_entry *last = NULL;
    int inside_a = 0, inside_b = 0;

    for (; at != NONE; at = last->link & NONE) {
        const struct paper_entry *entry = &buffer.entry[at];
        int step = entry->link & DOWN ? -1 : 1;

        if ((inside_a > 0 || inside_b > 0) && ((entry->link ^ last->link) & OF_B)) {
            hand_over(visitor, last, entry);
        }
        *(entry->link & OF_B ? &inside_b : &inside_a) += step;
        last = entry;
    }
}

void paper_pairs(const struct paper_placed *a, const struct paper_placed *b,
                 struct paper_visitor *visitor)
{
    struct paper_box box;

    place(a, 0);
    place(b, 1);
    bound(&box, a->mesh->raw.vertex_count);
    if (!may_meet(&box, b)) {
        return;
    }
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        buffer.head[pixel] = NONE;
    }
    memset(buffer.seen, 0xff, sizeof buffer.seen); /* no pair: faces are below 65535 */
    buffer.used = 0;
    scan_mesh(&box, a, 0);
    scan_mesh(&box, b, 1);
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        if ((buffer.head[pixel] & OF_A) && (buffer.head[pixel] & OF_B)) {
            read_pixel(buffer.head[pixel] & NONE, visitor);
        }
    }
}

uint32_t paper_refused(void)
{
    return buffer.refused;
}

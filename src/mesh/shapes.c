/* SPDX-License-Identifier: MIT */
/*
 * Shapes for programs that bring no meshes. All but the box are solids of revolution: rings of `sides` vertices
 * from the bottom to the top, with a pole or a flat polygon at either end.
 */
#include "carom_shapes.h"

#include "../num/fix.h"

#define COORDINATE_MAX 32767

struct turned {
    struct carom_mesh_raw raw;
    int16_t (*vertices)[3];
    uint16_t (*faces)[3];
    int32_t radius,
        half; /* quanta; half: from the origin to where the hemispheres begin, or to the ends */
    int32_t sides, rings;
    bool round; /* rings on two hemispheres; else all of them have the whole radius */
    int32_t bottom_pole, top_pole; /* 1: there is one */
};

/* ------------------------------------------------------------------ sine, cosine */

#define TWO_PI_Q50 INT64_C(7074237752028440)

/*
 * 1 - x^2 / (n (n + 1)) (1 - x^2 / ((n - 2) (n - 1)) ...) down to n = last, a Taylor series. x^2 <
 * 0.62 in q30, so each product is below 2^60. The omitted terms are below 2^-31, and six roundings
 * cost less than 2^-28.
 */
static int64_t series(int64_t square_q30, int32_t last)
{
    int64_t sum = CAROM_ONE_Q30;

    for (int32_t n = last + 10; n >= last; n -= 2) {
        sum = CAROM_ONE_Q30 - carom_round(square_q30 * sum, 30) / (n * (n + 1));
    }
    return sum;
}

/*
 * Cosine and sine of turn / of whole turns, 0 <= turn <= of <= 128. The angle is mirrored into the
 * first eighth of a turn, so that mirrored vertices agree to the bit.
 */
static void direction(int64_t out_q30[2], int32_t turn, int32_t of)
{
    const int32_t eighth = 8 * turn / of, left = 8 * turn - eighth * of;
    const int32_t part = eighth & 1 ? of - left : left; /* the angle is part / (8 of) turns */
    const int64_t x = carom_round(TWO_PI_Q50 * part / (8 * of), 20), xx = carom_round(x * x, 30);
    const int64_t sine = carom_round(x * series(xx, 2), 30), cosine = series(xx, 1);
    const bool swapped = ((eighth + 1) & 2) != 0;

    out_q30[0] = swapped ? sine : cosine;
    out_q30[1] = swapped ? cosine : sine;
    if (((eighth + 2) & 4) != 0) {
        out_q30[0] = -out_q30[0];
    }
    if ((eighth & 4) != 0) {
        out_q30[1] = -out_q30[1];
    }
}

/* --------------------------------------------------------------------- vertices */

/* To the nearest integer, halves away from 0, so that mirrored vertices agree. */
static int32_t nearest(int64_t v_q30)
{
    return (int32_t)(v_q30 < 0 ? -carom_round(-v_q30, 30) : carom_round(v_q30, 30));
}

/* The width of a ring, and its place along z; rings count from the bottom. */
static void ring_place(const struct turned *t, int32_t ring, int64_t *scale_q30, int32_t *z)
{
    const int32_t quarter = t->sides / 4;
    const bool lower = t->round ? ring < quarter : ring == 0;
    int32_t up = t->half;

    *scale_q30 = CAROM_ONE_Q30;
    if (t->round) {
        int64_t from_pole[2];

        direction(from_pole, lower ? ring + 1 : t->rings - ring, t->sides);
        *scale_q30 = from_pole[1];
        up += nearest(t->radius * from_pole[0]);
    }
    *z = lower ? -up : up;
}

static void put_vertex(struct turned *t, int32_t x, int32_t y, int32_t z)
{
    int16_t *v = t->vertices[t->raw.vertex_count++];

    v[0] = (int16_t)x;
    v[1] = (int16_t)y;
    v[2] = (int16_t)z;
}

static void put_vertices(struct turned *t)
{
    const int32_t end = t->half + (t->round ? t->radius : 0);

    if (t->bottom_pole) {
        put_vertex(t, 0, 0, -end);
    }
    for (int32_t ring = 0; ring < t->rings; ring++) {
        int64_t scale_q30;
        int32_t z;

        ring_place(t, ring, &scale_q30, &z);
        for (int32_t j = 0; j < t->sides; j++) {
            int64_t around[2];

            direction(around, j, t->sides);
            put_vertex(t, nearest(t->radius * (int64_t)nearest(scale_q30 * around[0])),
                       nearest(t->radius * (int64_t)nearest(scale_q30 * around[1])), z);
        }
    }
    if (t->top_pole) {
        put_vertex(t, 0, 0, end);
    }
}

/*
 * The number of a vertex. Row -1 is the bottom pole, row `rings` the top one; j counts around, from
 * -1 to 2 n.
 */
static uint16_t at(const struct turned *t, int32_t row, int32_t j)
{
    if (row < 0) {
        return 0;
    }
    j = (j + t->sides) % t->sides;
    return (uint16_t)(t->bottom_pole + row * t->sides + (row < t->rings ? j : 0));
}

/* ------------------------------------------------------------------------- faces */

/*
 * The side of a face's plane on which a place lies: above 0 is outside. Coordinates are below 2^15,
 * so the result is below 2^51.
 */
static int64_t side_of(const struct turned *t, const uint16_t face[3], const int16_t place[3])
{
    const int16_t *a = t->vertices[face[0]];
    int32_t e[3][3];
    int64_t n[3];

    for (int k = 0; k < 3; k++) {
        e[0][k] = t->vertices[face[1]][k] - a[k];
        e[1][k] = t->vertices[face[2]][k] - a[k];
        e[2][k] = place[k] - a[k];
    }
    fix_cross(n, e[0], e[1]);
    return n[0] * e[2][0] + n[1] * e[2][1] + n[2] * e[2][2];
}

static void put_face(struct turned *t, uint16_t a, uint16_t b, uint16_t c)
{
    uint16_t *f = t->faces[t->raw.face_count++];

    f[0] = a;
    f[1] = b;
    f[2] = c;
}

/*
 * True if the newest face, in sector j above a row, looks away from the origin and none of its
 * neighbours' vertices is outside it. If this holds for all faces of a closed mesh around the
 * origin the mesh is convex.
 */
static bool is_convex(const struct turned *t, int32_t row, int32_t j)
{
    static const int16_t origin[3] = {0, 0, 0};
    const uint16_t *face = t->faces[t->raw.face_count - 1];

    if (side_of(t, face, origin) >= 0) {
        return false;
    }
    for (int32_t r = row - 1; r <= row + 2; r++) {
        for (int32_t k = j - 1; k <= j + 2; k++) {
            if (r >= -t->bottom_pole && r < t->rings + t->top_pole &&
                side_of(t, face, t->vertices[at(t, r, k)]) > 0) {
                return false;
            }
        }
    }
    return true;
}

/*
 * Put the faces of a sector between a row and the next: one triangle at a pole, else two, along the
 * diagonal that bulges out. Returns false if the result is not convex.
 */
static bool put_sector(struct turned *t, int32_t row, int32_t j)
{
    const uint16_t a = at(t, row, j), b = at(t, row, j + 1);
    const uint16_t c = at(t, row + 1, j + 1), d = at(t, row + 1, j);
    const uint16_t first[3] = {a, b, c};

    if (c == d) {
        put_face(t, a, b, c);
        return is_convex(t, row, j);
    }
    if (a == b) {
        put_face(t, a, c, d);
        return is_convex(t, row, j);
    }
    if (side_of(t, first, t->vertices[d]) <= 0) {
        put_face(t, a, b, c);
        if (!is_convex(t, row, j)) {
            return false;
        }
        put_face(t, a, c, d);
    } else {
        put_face(t, a, b, d);
        if (!is_convex(t, row, j)) {
            return false;
        }
        put_face(t, b, c, d);
    }
    return is_convex(t, row, j);
}

static bool put_faces(struct turned *t)
{
    for (int32_t row = -t->bottom_pole; row < t->rings - 1 + t->top_pole; row++) {
        for (int32_t j = 0; j < t->sides; j++) {
            if (!put_sector(t, row, j)) {
                return false;
            }
        }
    }
    for (int32_t j = 1; j < t->sides - 1; j++) {
        if (!t->bottom_pole) {
            put_face(t, at(t, 0, 0), at(t, 0, j + 1), at(t, 0, j));
        }
        if (!t->top_pole) {
            put_face(t, at(t, t->rings - 1, 0), at(t, t->rings - 1, j), at(t, t->rings - 1, j + 1));
        }
    }
    return true;
}

/* ------------------------------------------------------------------------ shapes */

static int check(const struct carom_mesh_raw *raw, const struct carom_shape_room *room)
{
    if (!raw || !room || !room->vertices || !room->faces) {
        return CAROM_ERR_NULL;
    }
    return room->quantum_bits < 7 || room->quantum_bits > 20 ? (int)CAROM_ERR_ARGUMENT : CAROM_OK;
}

/* A raw mesh over a room's arrays, still empty. */
static struct carom_mesh_raw empty(const struct carom_shape_room *room)
{
    struct carom_mesh_raw raw;

    raw.vertices = (const int16_t(*)[3])room->vertices;
    raw.faces = (const uint16_t(*)[3])room->faces;
    raw.vertex_count = raw.face_count = 0;
    raw.quantum_bits = room->quantum_bits;
    raw.kind = CAROM_SOLID;
    return raw;
}

/* Make a solid of revolution; t holds its form and nothing else yet. */
static int turn(struct carom_mesh_raw *raw, const struct carom_shape_room *room, struct turned *t)
{
    const int error = check(raw, room);
    const int32_t poles = t->bottom_pole + t->top_pole;
    int32_t vertices, faces;

    if (error) {
        return error;
    }
    if (t->radius < 1 || t->radius > COORDINATE_MAX || t->half > COORDINATE_MAX) {
        return CAROM_ERR_ARGUMENT;
    }
    if (t->round && t->half + t->radius > COORDINATE_MAX) {
        return CAROM_ERR_RANGE;
    }
    /* Euler: a closed mesh of triangles has 2 V - 4 faces */
    vertices = t->rings * t->sides + poles;
    faces = 2 * vertices - 4;
    if ((uint32_t)vertices > room->vertex_count || (uint32_t)faces > room->face_count) {
        return CAROM_ERR_MEMORY;
    }
    t->raw = empty(room);
    t->vertices = room->vertices;
    t->faces = room->faces;
    put_vertices(t);
    if (!put_faces(t)) {
        return CAROM_ERR_RANGE;
    }
    *raw = t->raw;
    return CAROM_OK;
}

int carom_shape_box(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                    const int32_t half[3])
{
    struct turned t = {.half = 0};
    const int error = check(raw, room);

    if (error || !half) {
        return error ? error : CAROM_ERR_NULL;
    }
    for (int k = 0; k < 3; k++) {
        if (half[k] < 1 || half[k] > COORDINATE_MAX) {
            return CAROM_ERR_ARGUMENT;
        }
    }
    if (room->vertex_count < CAROM_BOX_VERTICES || room->face_count < CAROM_BOX_FACES) {
        return CAROM_ERR_MEMORY;
    }
    t.raw = empty(room);
    t.vertices = room->vertices;
    t.faces = room->faces;
    for (int v = 0; v < CAROM_BOX_VERTICES; v++) {
        put_vertex(&t, v & 1 ? half[0] : -half[0], v & 2 ? half[1] : -half[1],
                   v & 4 ? half[2] : -half[2]);
    }
    for (int k = 0; k < 3; k++) {
        /* corners of a side count up along both other axes, `right` and `back` */
        const int right = 1 << fix_next(k), back = 1 << fix_next(fix_next(k)), far = 1 << k;

        put_face(&t, 0, (uint16_t)back, (uint16_t)(right + back));
        put_face(&t, 0, (uint16_t)(right + back), (uint16_t)right);
        put_face(&t, (uint16_t)far, (uint16_t)(far + right), (uint16_t)(far + right + back));
        put_face(&t, (uint16_t)far, (uint16_t)(far + right + back), (uint16_t)(far + back));
    }
    *raw = t.raw;
    return CAROM_OK;
}

/* A shape of two hemispheres; the equator has a ring for each if they are apart. */
static int turn_round(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                      int32_t radius, int32_t half, uint32_t sides)
{
    struct turned t = {.radius = radius, .half = half, .sides = (int32_t)sides, .round = true};

    if (sides < 4 || sides > CAROM_SHAPE_SIDES || sides % 4) {
        return CAROM_ERR_ARGUMENT;
    }
    t.rings = t.sides / 2 - (half == 0);
    t.bottom_pole = t.top_pole = 1;
    return turn(raw, room, &t);
}

/* A shape of rings of the whole radius: two, or one below a tip. */
static int turn_straight(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                         int32_t radius, int32_t half, uint32_t sides, int32_t rings)
{
    struct turned t = {.radius = radius, .half = half, .sides = (int32_t)sides, .rings = rings};

    if (sides < 3 || sides > CAROM_SHAPE_SIDES || half < 1) {
        return CAROM_ERR_ARGUMENT;
    }
    t.top_pole = rings == 1;
    return turn(raw, room, &t);
}

int carom_shape_sphere(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                       int32_t radius, uint32_t sides)
{
    return turn_round(raw, room, radius, 0, sides);
}

int carom_shape_capsule(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                        int32_t radius, int32_t half_length, uint32_t sides)
{
    return half_length < 1 ? CAROM_ERR_ARGUMENT : turn_round(raw, room, radius, half_length, sides);
}

int carom_shape_cylinder(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                         int32_t radius, int32_t half_height, uint32_t sides)
{
    return turn_straight(raw, room, radius, half_height, sides, 2);
}

int carom_shape_cone(struct carom_mesh_raw *raw, const struct carom_shape_room *room,
                     int32_t radius, int32_t half_height, uint32_t sides)
{
    return turn_straight(raw, room, radius, half_height, sides, 1);
}

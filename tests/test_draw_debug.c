/* SPDX-License-Identifier: MIT */
/*
 * carom_debug_draw: its triangles and lines against the mesh, by hand, and against sums over the
 * whole mesh.
 */
#include "carom_debug.h"
#include "lib/draw_scene.h"

enum { ROOM = 64 };

static struct record {
    int triangles, lines, points, of_colour[256];
    carom_v3_q32 from[ROOM], to[ROOM], point[ROOM];
    int64_t volume_q18;  /* six times the volume of all triangles */
    int64_t normals_q30; /* largest error of their normals */
} record;

static carom_v3_q32 centre;

/* The vector away from the centre, in q6 and rounded; cubes lie within 2^7 of the centre. */
static void away(const carom_v3_q32 *from, int32_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = (int32_t)carom_round(from->c[k] - centre.c[k], 12);
    }
}

static void take_triangle(void *context, const carom_v3_q32 corner[3], const carom_v3_q30 *normal,
                          uint32_t colour)
{
    int32_t at[3][3];
    int64_t cross[3], length2 = 0;

    CHECK_SAME(context, &record);
    CHECK_LESS(colour, 256);
    record.triangles++;
    record.of_colour[colour & 255]++;
    for (int i = 0; i < 3; i++) {
        away(&corner[i], at[i]);
    }
    fix_cross(cross, at[1], at[2]);
    for (int k = 0; k < 3; k++) { /* q40 times q20 */
        record.volume_q18 += (cross[k] >> 20) * at[0][k] >> 22;
        length2 += (int64_t)normal->c[k] * normal->c[k] >> 30;
    }
    CHECK_NEAR(length2, CAROM_ONE_Q30, 64);
    /* a face of the cube is half a unit from the middle, along its normal */
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(carom_dot(at[i], normal->c) >> 30, 1 << 19, 64);
    }
}

static void take_line(void *context, const carom_v3_q32 *from, const carom_v3_q32 *to,
                      uint32_t colour)
{
    CHECK_SAME(context, &record);
    CHECK_LESS(colour, 256);
    if (record.lines < ROOM) {
        record.from[record.lines] = *from;
        record.to[record.lines] = *to;
    }
    record.lines++;
    record.of_colour[colour & 255]++;
}

static void take_point(void *context, const carom_v3_q32 *at_point, uint32_t colour)
{
    CHECK_SAME(context, &record);
    CHECK_LESS(colour, 256);
    if (record.points < ROOM) {
        record.point[record.points] = *at_point;
    }
    record.points++;
}

static struct carom_contact contacts[32];

static struct carom_debug all_of(void)
{
    struct carom_debug debug = {.triangle = take_triangle,
                                .line = take_line,
                                .point = take_point,
                                .context = &record,
                                .contacts = contacts,
                                .contact_room = 32};

    memset(&record, 0, sizeof record);
    return debug;
}

/* The square of a line's length, in q20. */
static int64_t length2_q20(int i)
{
    int64_t sum = 0;

    for (int k = 0; k < 3; k++) {
        int64_t d = (record.to[i].c[k] - record.from[i].c[k]) >> 12; /* q20 */

        sum += d * d >> 20;
    }
    return sum;
}

static struct carom_world *one_cube(void)
{
    struct carom_world *world = new_world();

    centre = at(Q32(3, 1), Q32(-700, 7), Q32(5, 3));
    add(world, &cube, centre, oblique, true);
    return world;
}

/* A turned cube of side 1: its volume is 1, its 18 edges are 12 sides and 6 diagonals. */
static void one_body(void)
{
    struct carom_world *world = one_cube();
    struct carom_debug debug = all_of();
    int sides = 0, diagonals = 0;

    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_FACES, &debug), CAROM_OK);
    CHECK_EQ(record.triangles, 12);
    CHECK_NEAR(record.volume_q18, 6 << 18, 200);
    CHECK_EQ(record.of_colour[DRAW_MOVING * DRAW_SHADES + 24], 12);
    CHECK_EQ(record.lines + record.points, 0);
    debug = all_of();
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_EDGES, &debug), CAROM_OK);
    CHECK_EQ(record.lines, 18);
    for (int i = 0; i < 18; i++) {
        bool side = length2_q20(i) < 3 << 19;

        CHECK_NEAR(length2_q20(i), side ? 1 << 20 : 2 << 20, 16);
        sides += side;
        diagonals += !side;
    }
    CHECK_EQ(sides, 12);
    CHECK_EQ(diagonals, 6);
    debug = all_of();
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_BOXES, &debug), CAROM_OK);
    CHECK_EQ(record.lines, 12);
    for (int i = 0; i < 12; i++) {
        CHECK_NEAR(length2_q20(i), 1 << 20, 16);
    }
    CHECK_EQ(record.of_colour[CAROM_COLOUR_WHITE], 12);
}

/* The columns of the rotation (1, 2, 2, 4) / 5. */
static void axes(void)
{
    static const int8_t to_25[3][3] = {{-15, 16, 12}, {0, -15, 20}, {20, 12, 9}};
    struct carom_world *world = one_cube();
    struct carom_debug debug = all_of();

    debug.size_q32 = Q32(2, 1);
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_AXES, &debug), CAROM_OK);
    CHECK_EQ(record.lines, 3);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_EQ(record.of_colour[CAROM_COLOUR_RED + axis], 1);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(record.from[axis].c[k], centre.c[k]);
            CHECK_NEAR(record.to[axis].c[k] - centre.c[k], Q32(2 * to_25[axis][k], 25), 64);
        }
    }
    /* each as long as the cube's radius, half of the square root of 3 */
    debug = all_of();
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_AXES, &debug), CAROM_OK);
    CHECK_NEAR(length2_q20(0), 3 << 18, 64);
}

static void velocities(void)
{
    struct carom_world *world = one_cube();
    struct carom_debug debug = all_of();
    struct carom_body_state state;

    CHECK_EQ(carom_body_get(world, 0, &state), CAROM_OK);
    for (int k = 0; k < 3; k++) {
        state.velocity.c[k] = (k - 1) * ((int64_t)3 << 40) / 16;
    }
    CHECK_EQ(carom_body_set(world, 0, &state), CAROM_OK);
    add(world, &plain, at(0, 0, 0), upright, false); /* which has none */
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_VELOCITIES, &debug), CAROM_OK);
    CHECK_EQ(record.lines, 1);
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(record.to[0].c[k] - centre.c[k], Q32(3 * (k - 1), 1), 1 << 16);
    }
}

/* A cube on a square: its contacts, and the faces that the step listed. */
static void touching(void)
{
    struct carom_world *world = new_world();
    struct carom_debug debug = all_of();
    struct carom_body_paint body_paints[] = {{NULL, 0}, {NULL, 5}};
    struct carom_paint paint = {.bodies = body_paints, .body_count = 2};
    const struct carom_face_ref *refs;
    struct carom_body_state state;
    carom_v3_q40 gravity = {{0, 0, -((int64_t)1 << 30)}};
    int n, hot, cube_hot = 0;

    add(world, &square, at(0, 0, 0), upright, false);
    add(world, &cube, at(0, 0, Q32(501, 1000)), upright, true);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    for (int i = 0; i < 30; i++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
    centre = state.position;
    n = carom_contacts(world, contacts, 32);
    CHECK_AT_LEAST(n, 3);
    CHECK_AT_MOST(n, 32);
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_CONTACTS, &debug), CAROM_OK);
    CHECK_EQ(record.points, n);
    CHECK_EQ(record.lines, n);
    CHECK_EQ(record.of_colour[CAROM_COLOUR_YELLOW], n);
    for (int i = 0; i < n; i++) {
        CHECK_EQ(memcmp(&record.point[i], &contacts[i].point, sizeof record.point[i]), 0);
        /* half of the cube's radius: its square is 3 / 16 */
        CHECK_NEAR(length2_q20(i), 3 << 16, 64);
    }
    debug = all_of();
    debug.contact_room = 2;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_CONTACTS, &debug), CAROM_OK);
    CHECK_EQ(record.points, 2);

    /* like the cube's sides, triangles of the square are half a unit from the middle, below it */
    hot = carom_interfering_faces(world, &refs);
    for (int i = 0; i < hot; i++) {
        cube_hot += refs[i].body == 1;
    }
    CHECK_MORE(hot, 0);
    CHECK_MORE(cube_hot, 0);
    CHECK_EQ(carom_body_remove(world, 0),
             CAROM_OK); /* its normal does not point away from the middle */
    debug = all_of();
    debug.paint = &paint;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_INTERFERING, &debug), CAROM_OK);
    hot = carom_interfering_faces(world, &refs);
    cube_hot = 0;
    for (int i = 0; i < hot; i++) {
        cube_hot += refs[i].body == 1;
    }
    CHECK_EQ(record.triangles, cube_hot);
    CHECK_EQ(record.of_colour[DRAW_MOVING_HOT * DRAW_SHADES + 24], cube_hot);
    debug = all_of();
    debug.paint = &paint;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_INTERFERING | CAROM_DEBUG_FACES, &debug),
             CAROM_OK);
    CHECK_EQ(record.triangles, 12);
    CHECK_EQ(record.of_colour[5 * DRAW_SHADES + 24], 12 - cube_hot);
}

/* A cube that lies on its top, on another cube: only those faces are hot, and a contact's line has any length that is asked for. */
static void upside_down(void)
{
    static const carom_quat_q30 over = {{0, CAROM_ONE_Q30, 0, 0}};
    const carom_v3_q40 gravity = {{0, 0, -((int64_t)1 << 30)}};
    struct carom_world *world = new_world();
    struct carom_debug debug = all_of();
    const struct carom_face_ref *refs;
    struct carom_body_state state;
    int n, hot, cube_hot = 0;

    add(world, &cube, at(0, 0, 0), upright, false);
    add(world, &cube, at(Q32(1, 4), Q32(1, 8), Q32(1001, 1000)), over, true);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    for (int i = 0; i < 30; i++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    n = carom_contacts(world, contacts, 32);
    CHECK_AT_LEAST(n, 3);
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_CONTACTS, &debug), CAROM_OK);
    CHECK_NEAR(length2_q20(0), 3 << 16, 64); /* both have this radius */
    debug = all_of();
    debug.size_q32 = Q32(2, 1);
    debug.point = NULL;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_CONTACTS, &debug), CAROM_OK);
    CHECK_EQ(record.points, 0);
    CHECK_EQ(record.lines, n);
    CHECK_NEAR(length2_q20(0), 4 << 20, 64);
    hot = carom_interfering_faces(world, &refs);
    for (int i = 0; i < hot; i++) {
        if (refs[i].body == 1) {
            CHECK_AT_LEAST(cube.faces[refs[i].face].normal.c[2], 0); /* its top or a side */
            cube_hot++;
        }
    }
    CHECK_MORE(cube_hot, 0);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK); /* the triangles of one body are counted */
    debug = all_of();
    debug.triangle = NULL;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_INTERFERING, &debug), CAROM_OK);
    CHECK_EQ(record.triangles, 0);
    debug = all_of();
    CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
    centre = state.position;
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_INTERFERING, &debug), CAROM_OK);
    CHECK_EQ(record.triangles, cube_hot);
    CHECK_EQ(record.of_colour[DRAW_MOVING_HOT * DRAW_SHADES + 24], cube_hot);
}

/* Lines that a caller keeps are the lines of a picture. */
static void kept(void)
{
    static struct carom_paint_line room[10];
    struct carom_debug_lines lines = {.lines = room, .room = 10};
    struct carom_debug debug = {.line = carom_debug_keep_line, .context = &lines};
    struct carom_world *world = one_cube();
    carom_v3_q32 out = at(Q32(16384, 1) + 1, 0, 0);

    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_AXES | CAROM_DEBUG_FACES, &debug), CAROM_OK);
    CHECK_EQ(lines.count, 3);
    CHECK_EQ(lines.lost, 0);
    CHECK_EQ(room[2].colour, CAROM_COLOUR_BLUE);
    CHECK_EQ(memcmp(&room[0].from, &centre, sizeof centre), 0);
    carom_debug_keep_line(&lines, &centre, &out, 0);
    carom_debug_keep_line(&lines, &out, &centre, 0);
    CHECK_EQ(lines.count, 3);
    CHECK_EQ(lines.lost, 2);
    CHECK_EQ(carom_debug_draw(world, CAROM_DEBUG_BOXES, &debug), CAROM_OK);
    CHECK_EQ(lines.count, 10);
    CHECK_EQ(lines.lost, 2 + 3 + 12 - 10);
}

static void errors(void)
{
    struct carom_world *world = one_cube();
    struct carom_debug debug = all_of();
    struct carom_paint paint = {.ambient_q30 = -1};

    CHECK_EQ(carom_debug_draw(NULL, 1, &debug), CAROM_ERR_NULL);
    CHECK_EQ(carom_debug_draw(world, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_debug_draw(world, 256, &debug), CAROM_ERR_ARGUMENT);
    debug.contacts = NULL;
    CHECK_EQ(carom_debug_draw(world, 1, &debug), CAROM_ERR_NULL);
    debug.contact_room = -1;
    CHECK_EQ(carom_debug_draw(world, 1, &debug), CAROM_ERR_ARGUMENT);
    debug.contact_room = 0;
    debug.size_q32 = -1;
    CHECK_EQ(carom_debug_draw(world, 1, &debug), CAROM_ERR_ARGUMENT);
    debug.size_q32 = Q32(256, 1) + 1;
    CHECK_EQ(carom_debug_draw(world, 1, &debug), CAROM_ERR_ARGUMENT);
    debug.size_q32 = 0;
    debug.paint = &paint;
    CHECK_EQ(carom_debug_draw(world, 1, &debug), CAROM_ERR_ARGUMENT);
    CHECK_EQ(record.triangles, 0);
    debug = (struct carom_debug){.size_q32 = Q32(256, 1)};
    CHECK_EQ(carom_debug_draw(world, 255, &debug), CAROM_OK); /* there is no body 255 */
}

const struct test tests_draw_debug[] = {
    {"draw_debug/one_body", one_body},       {"draw_debug/axes", axes},
    {"draw_debug/velocities", velocities},   {"draw_debug/touching", touching},
    {"draw_debug/upside_down", upside_down}, {"draw_debug/kept", kept},
    {"draw_debug/errors", errors},           {0},
};

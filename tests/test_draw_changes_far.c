/* SPDX-License-Identifier: MIT */
/*
 * carom_draw_changes where there is much room: more rectangles than are kept, shadows from beyond what can be represented, surfaces
 * that come under shadows, interfering faces of a mesh that is gone, pictures that go to a display row by row.
 */
#include "lib/draw_scene.h"

#define BODIES   12
#define FAR_CAPS BODIES, 20, 64, 256, 256, 512
enum { WIDTH = 400, HEIGHT = 300, ALL = WIDTH * HEIGHT };

static _Alignas(8) uint8_t far_block[CAROM_WORLD_BYTES(FAR_CAPS)],
    far_workspace[CAROM_DRAW_BYTES(8 * BODIES, 12 * BODIES) + 24576]; /* with shadows */
static uint8_t full[HEIGHT][WIDTH], shown[HEIGHT][WIDTH], other[HEIGHT][WIDTH];
static struct carom_drawn_body drawn_bodies[BODIES];
static struct carom_drawn drawn;
static struct carom_world *world;

static struct carom_picture picture_of(void *to, const struct carom_paint *paint)
{
    struct carom_picture picture =
        picture_of_size(to, WIDTH, HEIGHT, far_workspace, sizeof far_workspace);

    picture.paint = paint;
    return picture;
}

/* A new world, nothing of which is drawn yet. */
static void begin(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(FAR_CAPS)};

    CHECK_EQ(carom_world_init(far_block, sizeof far_block, &config, &world), CAROM_OK);
    build_meshes();
    drawn = (struct carom_drawn){.bodies = drawn_bodies, .room = BODIES};
    memset(shown, 0, sizeof shown);
}

/* Draw what changed; all must be as in a full picture. Returns how many pixels were drawn. */
static int32_t draw_again(const struct carom_picture *picture)
{
    const struct carom_picture whole = picture_of(full, picture->paint);
    int32_t area = 0;

    CHECK_EQ(carom_draw(world, &above, &whole, CAROM_DRAW_FLAT), CAROM_OK);
    CHECK_EQ(carom_draw_changes(world, &above, picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
    for (int i = 0; i < drawn.changed_count; i++) {
        const struct carom_rect *r = &drawn.changed[i];

        area += (r->x1 - r->x0) * (r->y1 - r->y0);
    }
    return area;
}

static int32_t draw_shown(const struct carom_paint *paint)
{
    const struct carom_picture picture = picture_of(shown, paint);
    const int32_t area = draw_again(&picture);

    CHECK_EQ(memcmp(full, shown, sizeof full), 0);
    return area;
}

/* Turn the first bodies. */
static void turn(int bodies, carom_quat_q30 to)
{
    for (int i = 0; i < bodies; i++) {
        struct carom_body_state state;

        CHECK_EQ(carom_body_get(world, i, &state), CAROM_OK);
        state.rotation = to;
        CHECK_EQ(carom_body_set(world, i, &state), CAROM_OK);
    }
}

/*
 * Twelve cubes turn. They are some 50 pixels wide and a hundred apart: the rectangle around two has 2048 pixels more than they have,
 * so that none merge for their own sake.
 */
static void apart(void)
{
    static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(8, 12)];
    const struct carom_mesh_raw raw = {cube_vertices, box_faces, 8, 12, 13, CAROM_SOLID};
    struct carom_mesh
        small; /* of half a unit: at 75 pixels a unit 38 wide, with corners up to 65 */

    begin();
    CHECK_EQ(carom_mesh_build(&small, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
    for (int i = 0; i < BODIES; i++) {
        add(world, &small, at(Q32(4 * (i % 4) - 6, 3), Q32(22 * (i / 4) - 22, 15), 0), oblique,
            true);
    }
    CHECK_EQ(draw_shown(NULL), ALL);
    for (int n = 1; n <= BODIES; n++) {
        turn(n, upright);
        CHECK_AT_MOST(draw_shown(NULL), n <= CAROM_DRAWN_RECTS ? 2 * n * 70 * 70 : 2 * ALL);
        CHECK_EQ(drawn.changed_count <= CAROM_DRAWN_RECTS, true);
        CHECK_EQ(n >= CAROM_DRAWN_RECTS || drawn.changed_count == n, true);
        turn(n, oblique);
        draw_shown(NULL);
    }
}

/* A cube high above the world, and far aside, moves: its shadow falls two thousand units away, on the plain that is shown. */
static void high(void)
{
    const struct carom_paint paint = {.shadows = &carom_shadows, .light = {{6000, 0, 8000}}};
    struct carom_body_state state;

    begin();
    add(world, &plain, at(0, 0, -Q32(1, 1)), upright, false);
    add(world, &cube, at(Q32(1500, 1), 0, Q32(1999, 1)), oblique, true); /* 5 : 4 : 3 */
    CHECK_EQ(draw_shown(&paint), ALL);
    memcpy(other, full, sizeof other);
    for (int i = 0; i < 3; i++) {
        CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
        state.position.c[1] += Q32(1, 4);
        CHECK_EQ(carom_body_set(world, 1, &state), CAROM_OK);
        CHECK_MORE(draw_shown(&paint), 0);
        CHECK_DIFFER(memcmp(other, full, sizeof other), 0); /* the shadow is there and has moved */
    }
}

/* A surface comes into a picture with shadows: it casts none, and takes them. */
static void surface(void)
{
    const struct carom_paint paint = {.shadows = &carom_shadows};

    begin();
    add(world, &cube, at(0, 0, Q32(1, 1)), oblique, true);
    CHECK_EQ(draw_shown(&paint), ALL);
    add(world, &square, at(Q32(1, 2), 0, 0), upright, false);
    CHECK_AT_LEAST(draw_shown(&paint), 150 * 150);
    CHECK_AT_MOST(draw_shown(&paint), ALL / 2);
    CHECK_EQ(draw_shown(&paint), 0);
}

/* Faces that interfered belong to a mesh that is gone; the one in its place has fewer. */
static void stale(void)
{
    const struct carom_face_ref *refs;
    int more = 0;

    begin();
    add(world, &cube, at(0, 0, 0), upright, false);
    add(world, &cube, at(Q32(1, 4), Q32(1, 8), Q32(1001, 1000)), upright, true);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    CHECK_EQ(draw_shown(NULL), ALL);
    for (int i = 0; i < carom_interfering_faces(world, &refs); i++) {
        more += refs[i].body == 0 && refs[i].face >= 2;
    }
    CHECK_MORE(more, 0);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    add(world, &square, at(0, 0, 0), upright, false);
    CHECK_MORE(draw_shown(NULL), 0);
    CHECK_EQ(carom_interfering_faces(world, &refs) >= more, true);
}

static void *row_of(void *context, int32_t x0, int32_t x1, int32_t y)
{
    CHECK_LESS(x0, x1);
    return ((uint8_t(*)[WIDTH])context)[y];
}

/* Another display, which has the rows in the reverse order. */
static void *row_from_below(void *context, int32_t x0, int32_t x1, int32_t y)
{
    CHECK_LESS(x0, x1);
    return ((uint8_t(*)[WIDTH])context)[HEIGHT - 1 - y];
}

/* The display, and what it is given, are parts of the picture: another one gets all of it. */
static void displays(void)
{
    struct carom_picture picture = picture_of(NULL, NULL);

    begin();
    add(world, &plain, at(0, 0, -Q32(1, 1)), upright, false);
    add(world, &cube, at(0, 0, 0), oblique, true);
    memset(other, 0, sizeof other);
    picture.row = row_of;
    picture.context = shown;
    CHECK_EQ(draw_again(&picture), ALL);
    CHECK_EQ(memcmp(full, shown, sizeof full), 0);
    CHECK_EQ(draw_again(&picture), 0);
    picture.context = other;
    CHECK_EQ(draw_again(&picture), ALL);
    CHECK_EQ(memcmp(full, other, sizeof full), 0);
    CHECK_EQ(draw_again(&picture), 0);
    picture.row = row_from_below;
    CHECK_EQ(draw_again(&picture), ALL);
    for (int y = 0; y < HEIGHT; y++) {
        CHECK_EQ(memcmp(full[y], other[HEIGHT - 1 - y], WIDTH), 0);
    }
    CHECK_EQ(draw_again(&picture), 0);
}

const struct test tests_draw_changes_far[] = {
    {"draw_changes_far/apart", apart},       {"draw_changes_far/high", high},
    {"draw_changes_far/surface", surface},   {"draw_changes_far/stale", stale},
    {"draw_changes_far/displays", displays}, {0},
};

/* SPDX-License-Identifier: MIT */
#include "draw.h"
#include "mesh.h"
#include "world.h"

#define WIRE_SHADE (DRAW_SHADES * 3 / 4)

/* What one walk over the world needs to know. */
struct draw_pass {
    struct draw_canvas canvas;
    struct draw_view view;
    enum carom_draw_style style;
};

static bool faces_eye(const carom_v3_q30 *normal, const struct draw_corner *corner)
{
    /* corner->at is where the corner is from the eye */
    return carom_dot(normal->c, corner->at) < 0;
}

static uint32_t ramp_colour(const struct draw_pass *pass, const struct draw_body *body,
                            int32_t shade, bool hot)
{
    int32_t ramp = hot ? (body->moving ? DRAW_MOVING_HOT : DRAW_STATIONARY_HOT)
                       : (body->moving ? DRAW_MOVING : DRAW_STATIONARY);

    return draw_colour(pass->canvas.picture->format, (uint32_t)(ramp * DRAW_SHADES + shade));
}

/*
 * Shade 0 looks straight away from the light: the far side keeps its relief without a second light.
 */
static uint32_t face_colour(const struct draw_pass *pass, const struct draw_body *body,
                            const carom_v3_q30 *normal, bool hot)
{
    int32_t shade = (int32_t)((carom_dot(normal->c, body->light.c) + ((int64_t)1 << 60)) >> 56);

    if (shade < 0) {
        shade = 0;
    } else if (shade >= DRAW_SHADES) {
        shade = DRAW_SHADES - 1;
    }
    return ramp_colour(pass, body, shade, hot);
}

/* A face with projected corners, clipped when it has to be. */
static void draw_face(const struct draw_pass *pass, const struct draw_body *body,
                      const struct draw_corner *a, const struct draw_corner *b,
                      const struct draw_corner *c, uint32_t colour)
{
    if (a->out & b->out & c->out) {
        return; /* all beyond one side of the picture */
    }
    if ((a->out | b->out | c->out) & DRAW_OUT_CLIP) {
        struct draw_corner polygon[SCAN_MAX] = {*a, *b, *c};
        int n = draw_clip_face(body, polygon);

        for (int i = 2; i < n; i++) {
            draw_triangle(&pass->canvas, &polygon[0], &polygon[i - 1], &polygon[i], colour);
        }
    } else {
        draw_triangle(&pass->canvas, a, b, c, colour);
    }
}

static void draw_edge(const struct draw_pass *pass, const struct draw_body *body,
                      const struct draw_corner *a, const struct draw_corner *b, uint32_t colour)
{
    if (a->out & b->out) {
        return;
    }
    if ((a->out | b->out) & DRAW_OUT_CLIP) {
        struct draw_corner line[2] = {*a, *b};

        if (draw_clip_line(body, line)) {
            draw_line(&pass->canvas, &line[0], &line[1], colour);
        }
    } else {
        draw_line(&pass->canvas, a, b, colour);
    }
}

static void project_corners(const struct draw_body *body, struct draw_corner *corner, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        draw_corner_project(body, &corner[i]);
    }
}

/* The front faces of a leaf. */
static void draw_leaf_flat(const struct draw_pass *pass, const struct draw_body *body,
                           const struct carom_leaf *leaf, struct draw_corner *corner)
{
    const struct carom_mesh *mesh = body->mesh;
    const uint16_t *numbers = &mesh->leaf_faces[leaf->first_face];
    const uint8_t(*corners)[3] = &mesh->leaf_corners[leaf->first_face];
    uint32_t front = 0; /* bit i: face i looks at the eye */

    for (uint32_t i = 0; i < leaf->face_count; i++) {
        if (faces_eye(&mesh->faces[numbers[i]].normal, &corner[corners[i][0]])) {
            front |= 1u << i;
        }
    }
    if (front == 0) {
        return;
    }
    project_corners(body, corner, leaf->vertex_count);
    for (uint32_t i = 0; i < leaf->face_count; i++) {
        if (front >> i & 1) {
            draw_face(pass, body, &corner[corners[i][0]], &corner[corners[i][1]],
                      &corner[corners[i][2]],
                      face_colour(pass, body, &mesh->faces[numbers[i]].normal, false));
        }
    }
}

/*
 * Which edges of a face are to be drawn for it, bit k for edge k: an edge belongs to the first of
 * its two faces, and is seen when either of them looks at the eye.
 */
static uint8_t seen_edges(const struct carom_mesh *mesh, uint32_t number, const uint8_t corners[3],
                          const struct draw_corner *corner)
{
    const struct carom_face *face = &mesh->faces[number];
    bool front = faces_eye(&face->normal, &corner[corners[0]]);
    uint8_t seen = 0;

    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[face->edge[k]];

        if (edge->face[0] == number &&
            (front || (edge->face[1] != CAROM_NO_FACE &&
                       faces_eye(&mesh->faces[edge->face[1]].normal, &corner[corners[k]])))) {
            seen |= (uint8_t)(1u << k);
        }
    }
    return seen;
}

static void draw_leaf_wire(const struct draw_pass *pass, const struct draw_body *body,
                           const struct carom_leaf *leaf, struct draw_corner *corner)
{
    const struct carom_mesh *mesh = body->mesh;
    const uint16_t *numbers = &mesh->leaf_faces[leaf->first_face];
    const uint8_t(*corners)[3] = &mesh->leaf_corners[leaf->first_face];
    uint8_t seen[CAROM_LEAF_FACES];

    for (uint32_t i = 0; i < leaf->face_count; i++) {
        seen[i] = seen_edges(mesh, numbers[i], corners[i], corner);
    }
    project_corners(body, corner, leaf->vertex_count);
    for (uint32_t i = 0; i < leaf->face_count; i++) {
        for (int k = 0; k < 3; k++) {
            if (seen[i] >> k & 1) {
                draw_edge(pass, body, &corner[corners[i][k]], &corner[corners[i][(k + 1) % 3]],
                          ramp_colour(pass, body, WIRE_SHADE, false));
            }
        }
    }
}

static void draw_body(const struct draw_pass *pass, const struct draw_body *body)
{
    const struct carom_mesh *mesh = body->mesh;
    const carom_v3_q22 origin = {{0, 0, 0}};

    if (!draw_sees_sphere(body, &origin, mesh->radius_q22)) {
        return;
    }
    for (uint32_t l = 0; l < mesh->leaf_count; l++) {
        const struct carom_leaf *leaf = &mesh->leaves[l];
        struct draw_corner corner[CAROM_LEAF_VERTICES];

        if (!draw_sees_sphere(body, &leaf->centre, leaf->radius_q22)) {
            continue;
        }
        for (uint32_t i = 0; i < leaf->vertex_count; i++) {
            draw_corner_place(body, mesh->leaf_vertices[leaf->first_vertex + i], &corner[i]);
        }
        if (pass->style == CAROM_DRAW_WIRE) {
            draw_leaf_wire(pass, body, leaf, corner);
        } else {
            draw_leaf_flat(pass, body, leaf, corner);
        }
    }
}

/* An interfering face, over what was drawn of it before. */
static void draw_hot_face(const struct draw_pass *pass, const struct draw_body *body,
                          uint32_t number)
{
    const uint16_t *vertices = body->mesh->raw.faces[number];
    const carom_v3_q30 *normal = &body->mesh->faces[number].normal;
    struct draw_corner corner[3];
    bool front;

    for (int k = 0; k < 3; k++) {
        draw_corner_place(body, vertices[k], &corner[k]);
    }
    front = faces_eye(normal, &corner[0]);
    project_corners(body, corner, 3);
    if (pass->style == CAROM_DRAW_WIRE) {
        for (int k = 0; k < 3; k++) {
            draw_edge(pass, body, &corner[k], &corner[(k + 1) % 3],
                      ramp_colour(pass, body, WIRE_SHADE, true));
        }
    } else if (front) {
        draw_face(pass, body, &corner[0], &corner[1], &corner[2],
                  face_colour(pass, body, normal, true));
    }
}

/* Body number `number` as the camera sees it; false when there is none. */
static bool see_body(struct draw_body *body, const struct draw_pass *pass,
                     const struct carom_world *world, int number)
{
    struct carom_body_state state;
    bool moving;
    const struct carom_mesh *mesh = world_mesh(world, number, &moving);

    if (mesh == NULL || carom_body_get(world, number, &state) != CAROM_OK) {
        return false;
    }
    draw_body_init(body, &pass->view, mesh, &state);
    body->moving = moving;
    return true;
}

/*
 * Every body, then the interfering faces once more. The second time gives the same depths, and a
 * pixel at equal depth is written, so they show exactly where they are visible.
 */
static void draw_world(const struct draw_pass *pass, const struct carom_world *world)
{
    const struct carom_face_ref *refs;
    int places = world_body_places(world);
    int count = carom_interfering_faces(world, &refs);
    struct draw_body body;
    bool seen = false;

    for (int i = 0; i < places; i++) {
        if (see_body(&body, pass, world, i)) {
            draw_body(pass, &body);
        }
    }
    for (int i = 0; i < count; i++) {
        if (i == 0 || refs[i].body != refs[i - 1].body) {
            seen = see_body(&body, pass, world, refs[i].body);
        }
        if (seen && refs[i].face < body.mesh->raw.face_count) {
            draw_hot_face(pass, &body, refs[i].face);
        }
    }
}

/* What carom.h says of a picture. */
static int check_picture(const struct carom_picture *picture, enum carom_draw_style style)
{
    static const uint8_t pixel_bytes[] = {1, 2, 4};
    int32_t bytes;

    if (style != CAROM_DRAW_FLAT && style != CAROM_DRAW_WIRE) {
        return CAROM_ERR_ARGUMENT;
    }
    if (picture->width < 1 || picture->width > 2 * DRAW_GUARD || picture->height < 1 ||
        picture->height > 2 * DRAW_GUARD || picture->format > CAROM_XRGB8888) {
        return CAROM_ERR_ARGUMENT;
    }
    bytes = pixel_bytes[picture->format];
    if (picture->stride < picture->width * bytes || picture->stride % bytes != 0) {
        return CAROM_ERR_ARGUMENT;
    }
    if ((uintptr_t)picture->pixels % (uintptr_t)bytes != 0) {
        return CAROM_ERR_MEMORY;
    }
    if (style == CAROM_DRAW_FLAT) {
        if (picture->workspace == NULL) {
            return CAROM_ERR_NULL;
        }
        if ((uintptr_t)picture->workspace % 8 != 0 ||
            picture->workspace_bytes < CAROM_DRAW_BYTES(picture->width, 1)) {
            return CAROM_ERR_MEMORY;
        }
    }
    return CAROM_OK;
}

int carom_draw(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style)
{
    struct draw_pass pass = {.style = style};
    int32_t rows;
    int result;

    if (world == NULL || camera == NULL || picture == NULL || picture->pixels == NULL) {
        return CAROM_ERR_NULL;
    }
    result = check_picture(picture, style);
    if (result == CAROM_OK) {
        result = draw_view_init(&pass.view, camera, picture->width, picture->height);
    }
    if (result != CAROM_OK) {
        return result;
    }
    pass.canvas.picture = picture;
    rows = picture->height;
    if (style == CAROM_DRAW_FLAT) {
        size_t fit = picture->workspace_bytes / CAROM_DRAW_BYTES(picture->width, 1);

        pass.canvas.depth = picture->workspace;
        if (fit < (size_t)rows) {
            rows = (int32_t)fit;
        }
    }
    for (int32_t y = 0; y < picture->height; y += rows) {
        int32_t end = y + rows < picture->height ? y + rows : picture->height;
        struct scan_rect rect = {0, y, picture->width, end};

        pass.canvas.rect = rect;
        draw_view_rect(&pass.view, rect);
        draw_clear(&pass.canvas);
        draw_world(&pass, world);
    }
    return CAROM_OK;
}

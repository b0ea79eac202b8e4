/* SPDX-License-Identifier: MIT */
/* The cover: pixels that the largest body surely hides what is behind it from. */
#include "draw.h"

#define MARGIN_Q4     32 /* two pixels, for the rounding of corners */
#define RADIUS_MIN_Q4 96 /* a smaller cover hides too little to pay */
#define LIMIT_Q4      (DRAW_GUARD * 16)

/*
 * The radius of a ball about the centre of mass that lies within the solid. If the centre is behind
 * the planes of all faces it is inside, and no face is nearer than the nearest plane. Negative if
 * there is none.
 */
static int32_t ball_within(const struct carom_mesh *mesh)
{
    const struct carom_face *end = mesh->faces + mesh->raw.face_count;
    int32_t least = mesh->radius_q22;

    for (const struct carom_face *face = mesh->faces; face < end; face++) {
        if (face->offset_q22 < least) {
            least = face->offset_q22;
        }
    }
    return least;
}

/* From the eye to a body's centre of mass, in view axes, q16: below 2^31. */
static void way_to(const struct draw_view *view, const carom_v3_q32 *position, int64_t way[3])
{
    for (int k = 0; k < 3; k++) {
        way[k] = (position->c[k] - view->eye.c[k]) >> 16;
    }
    fix_rotate(way, &view->axes, way);
}

/*
 * A line of sight through the ball enters the body before it is as far away as the ball's centre,
 * so whatever is farther is hidden. On the picture the ball is an ellipse, which reaches at least
 * focal radius / distance from its centre's projection in every direction.
 */
void draw_cover_init(struct draw_view *view, const struct draw_source *source, uint32_t body)
{
    struct draw_cover *cover = &view->cover;
    int64_t way[3], world_way[3], distance, x_q4, y_q4, radius_q4;
    struct carom_body_look look;
    int32_t radius_q16;

    cover->radius2_q8 = 0;
    if (!draw_look(source, body, &look)) {
        return;
    }
    way_to(view, &look.position, way);
    /* all of the body must be beyond the near plane */
    if (way[2] <= (look.mesh->radius_q22 >> 6) + (1 << 12)) {
        return;
    }
    distance = fix_length(way) + 1;
    radius_q16 = ball_within(look.mesh) >> 6;
    /* way < 2^31, focal <= 2^31: products fit */
    x_q4 = way[0] * view->focal_q16 / way[2] >> 12;
    y_q4 = way[1] * view->focal_q16 / way[2] >> 12;
    radius_q4 = (radius_q16 * view->focal_q16 / distance >> 12) - MARGIN_Q4;
    if (radius_q4 < RADIUS_MIN_Q4 || carom_abs(x_q4) > LIMIT_Q4 || carom_abs(y_q4) > LIMIT_Q4) {
        return;
    }
    radius_q4 = radius_q4 < LIMIT_Q4 ? radius_q4 : LIMIT_Q4;
    cover->body = body;
    cover->radius2_q8 = (uint32_t)(radius_q4 * radius_q4);
    cover->x_q4 = (int32_t)x_q4 + (view->round_q29[0] >> 15);
    cover->y_q4 = (int32_t)y_q4 + (view->round_q29[1] >> 15);
    cover->w_q26 = (uint32_t)(((int64_t)1 << 42) / distance) - 1;
    cover->slope_q16 = (int32_t)(((int64_t)radius_q16 << 16) / distance);
    fix_rotate_back(world_way, &view->axes, way);
    fix_normalise(&cover->axis, world_way);
}

/* An estimate, which only decides whether the exact question is worth asking. */
bool draw_may_cover(const struct draw_view *view, const struct draw_body *body,
                    const struct carom_leaf *leaf)
{
    int64_t along, reach, length2 = 0;
    int32_t at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = (leaf->centre.c[k] >> body->shift) - body->eye[k];
        length2 += (int64_t)at[k] * at[k];
    }
    along = carom_dot(body->cover.c, at) >> 30;
    reach = (along * view->cover.slope_q16 >> 16) + (leaf->radius_q22 >> body->shift);
    return along > 0 && length2 - along * along < reach * reach;
}

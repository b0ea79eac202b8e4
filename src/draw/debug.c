/* SPDX-License-Identifier: MIT */
/* carom_debug_draw: hand a world to other renderers as triangles, lines and points. */
#include "carom_debug.h"
#include "draw.h"

#define FLAGS_ALL    (2 * CAROM_DEBUG_JOINTS - 1)
#define SIZE_MAX_Q32 ((int64_t)256 << 32)
#define SHADE        (DRAW_SHADES * 3 / 4)
#define FRAMES_AHEAD 16

/* The body at hand, and where its parts are sent. */
struct scribe {
    const struct carom_debug *debug;
    uint32_t flags;
    struct carom_body_look look;
    carom_m3_q30 turn;
    struct draw_coat coat;
};

/* ------------------------------------------------------------------- places */

/*
 * A vertex of the mesh in world axes. Bounds: quanta are below 2^16 and at most 2^-7 units, so a
 * coordinate in q32 is below 2^41, and below 2^42 after the centre of mass is subtracted; positions
 * are below 2^45.
 */
static carom_v3_q32 place(const struct scribe *s, const int16_t quanta[3])
{
    const struct carom_mesh *mesh = s->look.mesh;
    int64_t at[3];
    carom_v3_q32 out;

    for (int k = 0; k < 3; k++) {
        at[k] = carom_shl(quanta[k], 32 - mesh->raw.quantum_bits) -
                carom_shl(mesh->mass.centre.c[k], 32 - 22);
    }
    fix_rotate(at, &s->turn, at);
    for (int k = 0; k < 3; k++) {
        out.c[k] = s->look.position.c[k] + at[k];
    }
    return out;
}

/* The point at a distance from another along a direction. */
static carom_v3_q32 along(const carom_v3_q32 *from, const int32_t direction_q30[3],
                          int64_t size_q32)
{
    carom_v3_q32 out;

    for (int k = 0; k < 3; k++) {
        out.c[k] = from->c[k] + fix_mul_q30(size_q32, direction_q30[k]);
    }
    return out;
}

static int64_t radius_q32(const struct carom_mesh *mesh)
{
    return carom_shl(mesh->radius_q22, 32 - 22);
}

static void line(const struct scribe *s, const carom_v3_q32 *from, const carom_v3_q32 *to,
                 uint32_t colour)
{
    if (s->debug->line) {
        s->debug->line(s->debug->context, from, to, colour);
    }
}

/* ------------------------------------------------------------------- bodies */

/* Send the faces; refs .. end are the body's interfering ones, in order. */
static void hand_faces(const struct scribe *s, const struct carom_face_ref *refs,
                       const struct carom_face_ref *end)
{
    const struct carom_mesh *mesh = s->look.mesh;

    for (uint32_t f = 0; s->debug->triangle && f < mesh->raw.face_count; f++) {
        bool hot = refs < end && refs->face == f;
        uint32_t ramp = hot ? s->coat.hot : draw_face_ramp(&s->coat, s->debug->paint, f);
        carom_v3_q32 corner[3];
        carom_v3_q30 normal;

        while (refs < end && refs->face == f) {
            refs++;
        }
        if (!hot && !(s->flags & CAROM_DEBUG_FACES)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            corner[k] = place(s, mesh->raw.vertices[mesh->raw.faces[f][k]]);
        }
        carom_rotate(normal.c, &s->turn, mesh->faces[f].normal.c);
        s->debug->triangle(s->debug->context, corner, &normal, ramp * DRAW_SHADES + SHADE);
    }
}

static void hand_edges(const struct scribe *s)
{
    const struct carom_mesh *mesh = s->look.mesh;

    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        const struct carom_edge *edge = &mesh->edges[i];
        carom_v3_q32 from = place(s, mesh->raw.vertices[edge->vertex[0]]);
        carom_v3_q32 to = place(s, mesh->raw.vertices[edge->vertex[1]]);
        uint32_t ramp = draw_face_ramp(&s->coat, s->debug->paint, edge->face[0]);

        line(s, &from, &to, ramp * DRAW_SHADES + SHADE);
    }
}

/*
 * Corner i is at the upper side along axis k if bit k is set; corners that differ by one bit share
 * an edge.
 */
static void hand_box(const struct scribe *s)
{
    const struct carom_mesh *mesh = s->look.mesh;
    carom_v3_q32 corner[8];

    for (int i = 0; i < 8; i++) {
        int16_t at[3];

        for (int k = 0; k < 3; k++) {
            at[k] = mesh->box[i >> k & 1][k];
        }
        corner[i] = place(s, at);
    }
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            if (!(i >> k & 1)) {
                line(s, &corner[i], &corner[i | 1 << k], CAROM_COLOUR_WHITE);
            }
        }
    }
}

static void hand_axes(const struct scribe *s)
{
    int64_t size_q32 = s->debug->size_q32 ? s->debug->size_q32 : radius_q32(s->look.mesh);

    for (int axis = 0; axis < 3; axis++) {
        int32_t direction[3];
        carom_v3_q32 to;

        for (int k = 0; k < 3; k++) {
            direction[k] = s->turn.c[k][axis];
        }
        to = along(&s->look.position, direction, size_q32);
        line(s, &s->look.position, &to, (uint32_t)(CAROM_COLOUR_RED + axis));
    }
}

static void hand_velocity(const struct scribe *s, const struct carom_world *world, uint32_t number)
{
    struct carom_body_state state;

    if (s->look.moving) {
        carom_v3_q32 to;

        (void)carom_body_get(world, (int)number, &state); /* there is one: it was looked at */
        for (int k = 0; k < 3; k++) {                     /* velocities are below 64 units: 2^46 */
            to.c[k] = s->look.position.c[k] + (state.velocity.c[k] * FRAMES_AHEAD >> (40 - 32));
        }
        line(s, &s->look.position, &to, CAROM_COLOUR_CYAN);
    }
}

/* ----------------------------------------------------------------- contacts */

/* Send each contact as a line of half the smaller body's radius. */
static void hand_contacts(const struct scribe *s, const struct carom_world *world)
{
    const struct carom_debug *debug = s->debug;
    int n = carom_contacts(world, debug->contacts, debug->contact_room);

    for (int i = 0; i < n && i < debug->contact_room; i++) {
        const struct carom_contact *c = &debug->contacts[i];
        int64_t a_q32 = radius_q32(carom_body_mesh(world, c->a));
        int64_t b_q32 = radius_q32(carom_body_mesh(world, c->b));
        int64_t size_q32 = debug->size_q32 ? debug->size_q32 : (a_q32 < b_q32 ? a_q32 : b_q32) / 2;
        carom_v3_q32 to = along(&c->point, c->normal.c, size_q32);

        if (debug->point) {
            debug->point(debug->context, &c->point, CAROM_COLOUR_YELLOW);
        }
        line(s, &c->point, &to, CAROM_COLOUR_YELLOW);
    }
}

/* --------------------------------------------------------------- the world */

static int check(const struct carom_world *world, uint32_t flags, const struct carom_debug *debug)
{
    struct carom_picture picture = {.format = CAROM_XRGB8888};

    if (world == NULL || debug == NULL || (debug->contact_room > 0 && debug->contacts == NULL)) {
        return CAROM_ERR_NULL;
    }
    if (flags > FLAGS_ALL || debug->size_q32 < 0 || debug->size_q32 > SIZE_MAX_Q32 ||
        debug->contact_room < 0) {
        return CAROM_ERR_ARGUMENT;
    }
    picture.paint = debug->paint;
    return draw_check_paint(&picture);
}

static void hand_body(const struct scribe *s, const struct carom_world *world, uint32_t number,
                      const struct carom_face_ref *refs, const struct carom_face_ref *end)
{
    if (s->flags & (CAROM_DEBUG_FACES | CAROM_DEBUG_INTERFERING)) {
        hand_faces(s, refs, end);
    }
    if (s->flags & CAROM_DEBUG_EDGES) {
        hand_edges(s);
    }
    if (s->flags & CAROM_DEBUG_BOXES) {
        hand_box(s);
    }
    if (s->flags & CAROM_DEBUG_AXES) {
        hand_axes(s);
    }
    if (s->flags & CAROM_DEBUG_VELOCITIES) {
        hand_velocity(s, world, number);
    }
}

int carom_debug_draw(const struct carom_world *world, uint32_t flags,
                     const struct carom_debug *debug)
{
    const struct carom_face_ref *refs, *end;
    struct draw_source source;
    struct scribe s = {.debug = debug, .flags = flags};
    int result = check(world, flags, debug);

    if (result != CAROM_OK) {
        return result;
    }
    draw_source_init(&source, world, debug->paint);
    refs = source.hot;
    end = flags & CAROM_DEBUG_INTERFERING ? refs + source.hot_count : refs;
    for (uint32_t i = 0; i < source.count; i++) {
        const struct carom_face_ref *first = refs;

        while (refs < end && refs->body == i) {
            refs++;
        }
        if (draw_look(&source, i, &s.look)) {
            fix_matrix(&s.turn, &s.look.rotation);
            s.coat = draw_usual_coat(s.look.moving);
            draw_paint_body(&s.coat, debug->paint, i);
            hand_body(&s, world, i, first, refs);
        }
    }
    if (flags & CAROM_DEBUG_CONTACTS) {
        hand_contacts(&s, world);
    }
    return CAROM_OK;
}

void carom_debug_keep_line(void *context, const carom_v3_q32 *from, const carom_v3_q32 *to,
                           uint32_t colour)
{
    struct carom_debug_lines *kept = (struct carom_debug_lines *)context;

    if (kept->count >= kept->room || !draw_point_in_range(from) || !draw_point_in_range(to)) {
        kept->lost++;
        return;
    }
    kept->lines[kept->count++] = (struct carom_paint_line){*from, *to, (uint16_t)colour};
}

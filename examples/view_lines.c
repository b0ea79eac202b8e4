/* SPDX-License-Identifier: MIT */
/* Lines that show the engine's work: cells of z-lists, contacts with their normals and impulses. */
#include "carom_body.h"
#include "carom_debug.h"
#include "view_parts.h"

#define CONTACTS_MAX 512
#define CELL_COLOUR  CAROM_COLOUR_CYAN
#define HIT_COLOUR   CAROM_COLOUR_YELLOW

/* --------------------------------------------------------------------- cells */

/* The z-lists of a body that are searched for another body. */
struct asked {
    const struct carom_world *world;
    int body;
    const struct carom_mesh *mesh;
    const struct carom_face_ref *hot; /* its interfering faces, in order */
    int hot_count;
    int32_t low[3], high[3]; /* box around the other body, quanta of the mesh */
    struct carom_debug_lines *lines;
};

static bool is_hot(const struct asked *q, uint16_t face)
{
    int low = 0, high = q->hot_count;

    while (low < high) {
        const int middle = (low + high) / 2;

        if (q->hot[middle].face < face) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < q->hot_count && q->hot[low].face == face;
}

/* Draw a square in the mesh's axes, at a height. */
static void draw_cell(const struct asked *q, int32_t x, int32_t y, int32_t z, uint32_t colour)
{
    const int bits = 32 - q->mesh->raw.quantum_bits;
    const int32_t side = (int32_t)1 << q->mesh->grid_shift;
    carom_v3_q32 corner[4];

    for (int i = 0; i < 4; i++) {
        const carom_v3_q32 local = {{carom_shl(x + (i == 1 || i == 2 ? side : 0), bits),
                                     carom_shl(y + (i >= 2 ? side : 0), bits), carom_shl(z, bits)}};

        if (carom_body_world_point(q->world, q->body, &local, &corner[i]) < 0) {
            return;
        }
    }
    for (int i = 0; i < 4; i++) {
        carom_debug_keep_line(q->lines, &corner[i], &corner[(i + 1) % 4], colour);
    }
}

/* Draw a cell at its highest entry near the other body, if it has one. */
static void show_cell(const struct asked *q, int32_t column, int32_t row)
{
    const struct carom_mesh *mesh = q->mesh;
    const uint32_t cell = (uint32_t)(row * mesh->grid_nx + column);
    int32_t top = INT32_MIN;
    bool hot = false;

    for (uint32_t i = mesh->cell_start[cell]; i < mesh->cell_start[cell + 1]; i++) {
        const struct carom_zref *entry = &mesh->zrefs[i];

        if (entry->z0 <= q->high[2] && entry->z1 >= q->low[2]) {
            top = entry->z1 > top ? entry->z1 : top;
            hot = hot || is_hot(q, entry->face);
        }
    }
    if (top > INT32_MIN) {
        draw_cell(q, mesh->grid_x0 + (column << mesh->grid_shift),
                  mesh->grid_y0 + (row << mesh->grid_shift), top, hot ? HIT_COLOUR : CELL_COLOUR);
    }
}

static int32_t cell_at(int32_t quanta, int32_t from, const struct carom_mesh *mesh, int32_t count)
{
    const int32_t cell = (quanta - from) >> mesh->grid_shift;

    return cell < 0 ? 0 : cell >= count ? count - 1 : cell;
}

static void show_cells(const struct asked *q)
{
    const struct carom_mesh *mesh = q->mesh;
    const int32_t side_x = mesh->grid_nx << mesh->grid_shift;
    const int32_t side_y = mesh->grid_ny << mesh->grid_shift;

    if (q->high[0] < mesh->grid_x0 || q->low[0] > mesh->grid_x0 + side_x ||
        q->high[1] < mesh->grid_y0 || q->low[1] > mesh->grid_y0 + side_y) {
        return;
    }
    for (int32_t row = cell_at(q->low[1], mesh->grid_y0, mesh, mesh->grid_ny);
         row <= cell_at(q->high[1], mesh->grid_y0, mesh, mesh->grid_ny); row++) {
        for (int32_t column = cell_at(q->low[0], mesh->grid_x0, mesh, mesh->grid_nx);
             column <= cell_at(q->high[0], mesh->grid_x0, mesh, mesh->grid_nx); column++) {
            show_cell(q, column, row);
        }
    }
}

/* The box around the sphere of body a, in the axes of the mesh that is searched; a surface includes everything below it. */
static bool find_box(struct asked *q, const struct carom_body_look *a)
{
    const int bits = 32 - q->mesh->raw.quantum_bits;
    carom_v3_q32 local;

    if (carom_body_local_point(q->world, q->body, &a->position, &local) < 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        const int64_t radius = (int64_t)a->mesh->radius_q22 * 1024;
        const int64_t low = (local.c[k] - radius) >> bits, high = (local.c[k] + radius) >> bits;

        q->low[k] = low < -(1 << 24) ? -(1 << 24) : low > 1 << 24 ? 1 << 24 : (int32_t)low;
        q->high[k] = high < -(1 << 24) ? -(1 << 24) : high > 1 << 24 ? 1 << 24 : (int32_t)high;
        if (q->high[k] < q->mesh->box[0][k] ||
            (q->low[k] > q->mesh->box[1][k] && (k < 2 || q->mesh->raw.kind != CAROM_SURFACE))) {
            return false;
        }
    }
    if (q->mesh->raw.kind == CAROM_SURFACE) {
        q->low[2] = INT16_MIN;
        q->high[2] = INT16_MAX;
    }
    return true;
}

/* A step searches the z-lists of the stationary body, or of the lower number if both move. */
void view_cells(const struct carom_world *world, struct carom_paint *paint)
{
    static struct carom_paint_line room[VIEW_LINES_MAX];
    struct carom_debug_lines lines = {room, VIEW_LINES_MAX, 0, 0};
    const struct carom_face_ref *faces = NULL;
    const int face_count = carom_interfering_faces(world, &faces);
    int next = 0;

    for (int b = 0; b < carom_body_count(world); b++) {
        struct asked q = {.world = world, .body = b, .lines = &lines};
        struct carom_body_look look, other;

        while (next < face_count && faces[next].body < b) {
            next++;
        }
        q.hot = faces + next;
        while (next < face_count && faces[next].body == b) {
            next++;
            q.hot_count++;
        }
        if (carom_body_look(world, b, &look) < 0) {
            continue;
        }
        q.mesh = look.mesh;
        for (int a = look.moving ? b + 1 : 0; a < carom_body_count(world); a++) {
            if (a != b && carom_body_look(world, a, &other) >= 0 && other.moving &&
                find_box(&q, &other)) {
                show_cells(&q);
            }
        }
    }
    paint->lines = room;
    paint->line_count = lines.count;
}

/* ------------------------------------------------------------------ contacts */

static void line(const struct carom_picture *picture, const carom_v3_q32 *from,
                 const carom_v3_q30 *along, int64_t length_q32, uint32_t colour,
                 struct carom_rect *touched)
{
    carom_v3_q32 to;

    for (int k = 0; k < 3; k++) {
        to.c[k] = from->c[k] + (length_q32 >> 12) * along->c[k] / (1 << 18);
    }
    carom_draw_line(view_camera(), picture, from, &to, colour, touched);
}

/* A small cross, perpendicular to the normal. */
static void cross(const struct carom_picture *picture, const struct carom_contact *c,
                  int64_t size_q32, struct carom_rect *touched)
{
    const carom_v3_q30 *n = &c->normal;
    const bool flat = n->c[2] > CAROM_ONE_Q30 / 2 || n->c[2] < -CAROM_ONE_Q30 / 2;
    const carom_v3_q30 aside = {{flat ? CAROM_ONE_Q30 : 0, 0, flat ? 0 : CAROM_ONE_Q30}};
    carom_v3_q30 arm[2];

    carom_cross(arm[0].c, n->c, aside.c, 30);
    carom_cross(arm[1].c, n->c, arm[0].c, 30);
    for (int i = 0; i < 2; i++) {
        line(picture, &c->point, &arm[i], size_q32, CAROM_COLOUR_YELLOW, touched);
        line(picture, &c->point, &arm[i], -size_q32, CAROM_COLOUR_YELLOW, touched);
    }
}

/*
 * Length of the line for an impulse: a quarter of the body's radius for its weight over a frame, at
 * most four radii.
 */
static int64_t impulse_length(const struct carom_world *world, const struct carom_contact *c,
                              int64_t radius_q32)
{
    const int64_t g_q40 = -scene_config().gravity.c[2];
    uint32_t mass_q20 = 0;
    int64_t weight_q40, length;

    carom_body_mass(world, c->a, &mass_q20);
    weight_q40 = (g_q40 >> 10) * (int64_t)mass_q20 >> 10;
    if (weight_q40 < 1 << 8) {
        return 0;
    }
    /* impulses are cut to 2^10 weights, so 2^14 times that stays in range */
    length = c->impulse_q40 >> 10 > weight_q40 ? 1 << 14 : c->impulse_q40 * 16 / weight_q40;
    length = (radius_q32 >> 6) * length;
    return length > 4 * radius_q32 ? 4 * radius_q32 : length;
}

void view_contacts(const struct carom_world *world, const struct carom_picture *picture,
                   struct carom_rect *touched)
{
    static struct carom_contact contacts[CONTACTS_MAX];
    const int count = carom_contacts(world, contacts, CONTACTS_MAX);

    for (int i = 0; i < count && i < CONTACTS_MAX; i++) {
        const struct carom_contact *c = &contacts[i];
        const struct carom_mesh *mesh = carom_body_mesh(world, c->a);
        int64_t radius_q32;

        if (!mesh) {
            continue;
        }
        radius_q32 = (int64_t)mesh->radius_q22 * 1024;
        cross(picture, c, radius_q32 / 12, touched);
        line(picture, &c->point, &c->normal, radius_q32 / 2, CAROM_COLOUR_YELLOW, touched);
        line(picture, &c->point, &c->normal, impulse_length(world, c, radius_q32), CAROM_COLOUR_RED,
             touched);
    }
}

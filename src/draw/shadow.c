/* SPDX-License-Identifier: MIT */
/*
 * Shadows. The shadow on a face is its part inside the prisms behind a solid's outline (prism.h), a
 * polygon each. It is drawn as a decal over the face in a darker shade, so its edge is exact at every
 * size of the picture.
 */
#include "list.h"
#include "prism.h"

/* A solid that casts shadows. */
struct caster {
    struct prism_set set;
    int32_t from[3]; /* from the body to the solid, world axes, q16 */
    int32_t radius;  /* q16 */
};

/* The body that shadows fall on. */
struct receiver {
    const struct draw_source *source;
    const struct draw_view *view;
    const struct draw_body *body;
    const struct draw_shades *shades;
    struct draw_list *list;
    carom_v3_q32 position;
    carom_m3_q30 turn; /* its axes to the world's */
    int32_t sun[3];    /* towards the light, view coordinates */
    void *scratch;     /* for an outline and its prisms */
    size_t bytes;
};

static void init(const struct draw_source *source, struct draw_view *view)
{
    struct draw_body body;
    int shift = 0;

    for (uint32_t i = 0; i < source->count; i++) {
        struct carom_body_look look;

        if (draw_look(source, i, &look)) {
            draw_body_place(&body, view, &look);
            shift = body.shift > shift ? body.shift : shift;
        }
    }
    view->shift_least = shift;
}

/* ------------------------------------------------------------------- decals */

/* The shadowed shade of a face; it keeps some relief. */
static uint32_t shadowed(uint32_t colour)
{
    uint32_t shade = colour % DRAW_SHADES;

    return colour - shade + shade * 3 / 8;
}

/*
 * The shadowed shade of a corner. Beyond the lit side it is continued, so that it joins the shade
 * of faces that look away from the light.
 */
static int32_t shadowed_q8(const struct receiver *r, int32_t shade_q8)
{
    int32_t middle = (int32_t)(r->view->shade_q24 >> 16), dark = shade_q8 * 3 / 8;

    return shade_q8 <= middle ? shade_q8 : fix_larger(dark, 3 * middle - 2 * shade_q8);
}

/* A lit triangle inside the guard band. */
struct lit {
    int32_t corner[3][3];     /* view coordinates */
    struct draw_vertex on[3]; /* on the picture, equal to the face's corners to the bit */
    uint32_t colour;          /* its colour in shadow */
    int32_t shade_q8[3];      /* its corners' shades in shadow, if the body is smooth */
    uint32_t plane[3];        /* places of the corners in the list; all 0: not listed yet */
};

/* The most that the decals of one prism on one triangle may take. */
#define DECAL_VERTICES (3 + DRAW_CLIP_MAX)
#define DECAL_FACES    (3 * (DRAW_CLIP_MAX - 2)) /* each with its plane and its tint */
#define DECAL_ROOM                                                                                 \
    (DECAL_VERTICES * sizeof(struct draw_vertex) + DECAL_FACES * sizeof(struct draw_face))

static bool has_room(const struct draw_list *list)
{
    return list_room(list) >= DECAL_ROOM + DRAW_ROWS_ROOM &&
           list->vertex_count + DECAL_VERTICES <= LIST_VERTICES_MAX &&
           list->face_count + DECAL_FACES <= LIST_FACES_MAX;
}

/* List the corners whose plane gives the decals of a triangle their depth; once. */
static void list_plane(const struct receiver *r, struct lit *lit)
{
    for (int k = 0; k < 3 && lit->plane[2] == 0; k++) {
        lit->plane[k] = list_vertex(r->list, lit->on[k]);
    }
}

/*
 * Rotate a triangle's corners on the picture so that the top one is first, as in a face. The polygon
 * to cut may begin anywhere.
 */
static void top_first(struct lit *lit)
{
    const struct lit was = *lit;
    int32_t a = lit->on[0].yx_q4, b = lit->on[1].yx_q4, c = lit->on[2].yx_q4;
    int top = b < a && b <= c ? 1 : c < a ? 2 : 0;

    for (int k = 0; k < 3; k++) {
        int from = (top + k) % 3;

        lit->on[k] = was.on[from];
        lit->shade_q8[k] = was.shade_q8[from];
    }
}

/* List a triangle of a shadow, and after it the plane that gives its depth. */
static void list_decal(const struct receiver *r, const struct lit *lit, uint32_t a, uint32_t b,
                       uint32_t c)
{
    uint32_t before = r->list->face_count;

    list_face(&r->view->rect, r->list, a, b, c, lit->colour | DRAW_DECAL, false);
    if (r->list->face_count > before) {
        struct draw_face *plane = &r->list->faces[-(int32_t)r->list->face_count++];

        for (int k = 0; k < 3; k++) {
            plane->corner[k] = (uint16_t)lit->plane[k];
        }
        if (r->shades->at) {
            r->source->paint->smooth->tint(r->list, plane + 1, lit->shade_q8);
        }
    }
}

static int32_t sign(int32_t a)
{
    return (a > 0) - (a < 0);
}

/*
 * Push the corners of a convex polygon outward by a sixteenth of a pixel along x, y or both. Two
 * parts of a shadow that meet along a line round their corners on it independently of each other;
 * grown, they overlap instead of leaving lit pixels between them. A corner between two edges that
 * look the same way moves no farther than each edge needs: else the shadow would be wider there,
 * as where the seam of two faces crosses its edge.
 */
static void grow(struct draw_vertex *corner, int n)
{
    int32_t x[DRAW_CLIP_MAX], y[DRAW_CLIP_MAX];

    for (int i = 0; i < n; i++) {
        x[i] = draw_x(corner[i].yx_q4);
        y[i] = draw_y(corner[i].yx_q4);
    }
    for (int i = 0; i < n; i++) {
        int before = (i + n - 1) % n, after = (i + 1) % n;
        /* counter-clockwise with y down: the outward normal of an edge (dx, dy) is (-dy, dx) */
        int32_t right = sign(y[before] - y[i]) + sign(y[i] - y[after]);
        int32_t down = sign(x[i] - x[before]) + sign(x[after] - x[i]);

        corner[i].yx_q4 = (y[i] + sign(down)) * (1 << 16) + ((x[i] + sign(right)) & 0xffff);
    }
}

/* List the part of a triangle inside a prism, a polygon of n corners. */
FIX_OWN_FRAME static void list_polygon(const struct receiver *r, struct lit *lit,
                                       int32_t polygon[DRAW_CLIP_MAX][3], int n)
{
    const uint32_t faces = r->list->face_count, vertices = r->list->vertex_count;
    struct draw_vertex corner[DRAW_CLIP_MAX];
    uint32_t place[DRAW_CLIP_MAX], last = lit->plane[2];

    list_plane(r, lit);
    for (int i = 0; i < n; i++) {
        corner[i] = draw_clipped_vertex(r->body, polygon[i]);
    }
    grow(corner, n);
    for (int i = 0; i < n; i++) {
        place[i] = list_vertex(r->list, corner[i]);
    }
    for (int i = 2; i < n; i++) {
        list_decal(r, lit, place[0], place[i - 1], place[i]);
    }
    if (r->list->face_count == faces) { /* nothing of it shows: free its corners */
        r->list->vertex_count = vertices;
        lit->plane[2] = last;
    }
}

/* Cut a triangle to the inside of a prism, and list what is left. Returns false if there is too little room. */
static bool list_shadow(const struct receiver *r, struct lit *lit, const struct prism *prism)
{
    int32_t polygon[DRAW_CLIP_MAX][3];
    int n;

    memcpy(polygon, lit->corner, sizeof lit->corner);
    n = prism_cut(prism, polygon, 3);
    if (n < 3) {
        return true;
    }
    if (!has_room(r->list)) {
        return false;
    }
    list_polygon(r, lit, polygon, n);
    return true;
}

/* List a solid's shadows on a triangle. */
static bool shade_triangle(const struct receiver *r, const struct caster *c, struct lit *lit)
{
    struct prism_extent extent = PRISM_NOTHING;

    for (int k = 0; k < 3; k++) {
        prism_reach(&extent, &c->set.outline, lit->corner[k]);
    }
    for (uint32_t i = 0; i < c->set.count; i++) {
        if (prism_overlap(&extent, &c->set.prisms[i].extent) &&
            !list_shadow(r, lit, &c->set.prisms[i])) {
            return false;
        }
    }
    return true;
}

/* List a solid's shadows on a face, of which the guard band may leave several triangles. */
static bool shade_face(const struct receiver *r, const struct caster *c, uint32_t face)
{
    int32_t polygon[DRAW_CLIP_MAX][3];
    struct draw_vertex on[DRAW_CLIP_MAX];
    struct prism_extent extent = PRISM_NOTHING;
    int32_t shade_q8[DRAW_CLIP_MAX] = {0};
    bool fits = true;
    int n;

    for (int k = 0; k < 3; k++) {
        draw_place(r->body, r->body->mesh->raw.faces[face][k], polygon[k]);
        prism_reach(&extent, &c->set.outline, polygon[k]);
    }
    if (!prism_overlap(&extent, &c->set.extent)) {
        return true;
    }
    n = draw_clip_placed(r->body, polygon, 3, on);
    if (r->shades->at) {
        r->source->paint->smooth->between(r->shades, face, polygon, n, shade_q8);
    }
    for (int i = 2; i < n && fits; i++) {
        const int corner[3] = {0, i - 1, i};
        struct lit lit = {.colour =
                              shadowed(list_colour(r->body, r->source->paint,
                                                   &r->body->mesh->faces[face].normal, face))};

        for (int k = 0; k < 3; k++) {
            memcpy(lit.corner[k], polygon[corner[k]], sizeof lit.corner[k]);
            lit.on[k] = on[corner[k]];
            lit.shade_q8[k] = shadowed_q8(r, shade_q8[corner[k]]);
        }
        top_first(&lit);
        fits = shade_triangle(r, c, &lit);
    }
    return fits;
}

/* ---------------------------------------------------------- bodies and leaves */

/*
 * True if a sphere may shade another: it is not behind it, and the ray through its centre passes
 * closely enough. from: the way to its centre; radius: sum of both radii; q16, below 2^29.
 */
static bool may_shade(const struct draw_view *view, const int32_t from[3], int32_t radius)
{
    int64_t along = carom_dot(from, view->sun.c) >> 30;

    /* squares are below 2^60, three of them below 2^62 */
    return along >= -radius && carom_dot(from, from) - along * along <=
                                   ((int64_t)radius + 4) * (radius + 4) + 64 * along;
}

static int32_t radius_q16(int32_t radius_q22)
{
    return (radius_q22 >> 6) + 1;
}

/* The centre of a leaf from the centre of its body, world axes, q16. */
static void leaf_centre(int32_t out[3], const carom_m3_q30 *turn, const struct carom_leaf *leaf)
{
    int32_t at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = leaf->centre.c[k] >> 6;
    }
    carom_rotate(out, turn, at);
}

static int64_t find_reach(const struct draw_source *source, const struct draw_view *view,
                          uint32_t number, const struct carom_body_look *look)
{
    int64_t reach = 0;

    if (look->mesh->raw.kind != CAROM_SOLID) {
        return 0;
    }
    for (uint32_t i = 0; i < source->count; i++) {
        struct carom_body_look other;
        int32_t from[3], radius;

        if (i == number || !draw_look(source, i, &other)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            from[k] = (int32_t)((look->position.c[k] - other.position.c[k]) >> 16);
        }
        radius = radius_q16(look->mesh->radius_q22) + radius_q16(other.mesh->radius_q22);
        if (may_shade(view, from, radius)) {
            int64_t along = (carom_dot(from, view->sun.c) >> 30) + radius;

            reach = along > reach ? along : reach;
        }
    }
    return reach;
}

/*
 * True if a face takes the light as far as its own body lets it: with shades at corners, if one of
 * its corners does.
 */
static bool takes_light(const struct receiver *r, uint32_t number)
{
    int32_t shade_q8[3], middle = (int32_t)(r->view->shade_q24 >> 16);

    if (r->shades->at == NULL) {
        return carom_dot(r->body->mesh->faces[number].normal.c, r->body->light.c) > 0;
    }
    r->source->paint->smooth->corners(r->shades, number, shade_q8);
    return fix_largest(shade_q8) > middle;
}

/* True if a face looks at the eye and takes the light. */
static bool may_be_shaded(const struct receiver *r, uint32_t number)
{
    const struct draw_body *body = r->body;
    const struct carom_face *face = &body->mesh->faces[number];

    return takes_light(r, number) && (int32_t)(carom_dot(face->normal.c, body->eye) >> 32) >
                                         face->offset_q22 >> (2 + body->shift);
}

/* List a solid's shadows on the body. */
FIX_OWN_FRAME static bool shade_by_caster(const struct receiver *r, const struct caster *c)
{
    const struct carom_mesh *mesh = r->body->mesh;

    for (uint32_t l = 0; l < mesh->leaf_count; l++) {
        const struct carom_leaf *leaf = &mesh->leaves[l];
        const uint16_t *numbers = &mesh->leaf_faces[leaf->first_face];
        int32_t way[3];

        leaf_centre(way, &r->turn, leaf);
        for (int k = 0; k < 3; k++) {
            way[k] = c->from[k] - way[k];
        }
        if (!may_shade(r->view, way, c->radius + radius_q16(leaf->radius_q22)) ||
            draw_sees_sphere(r->body, &leaf->centre, leaf->radius_q22) == 0) {
            continue;
        }
        for (uint32_t i = 0; i < leaf->face_count; i++) {
            if (may_be_shaded(r, numbers[i]) && !shade_face(r, c, numbers[i])) {
                return false;
            }
        }
    }
    return true;
}

/* Make a solid's prisms. Returns false if its outline does not fit. */
FIX_OWN_FRAME static bool make_prisms(const struct receiver *r, struct caster *c,
                                      const struct carom_body_look *look)
{
    struct draw_body body;

    draw_body_place(&body, r->view, look);
    return prism_make_all(&c->set, &body, r->sun, r->scratch, r->bytes);
}

/* shade_by_caster, unless the solid is too far aside or its outline does not fit. */
static bool shade_by(const struct receiver *r, const struct carom_body_look *look)
{
    struct caster c = {.radius = radius_q16(look->mesh->radius_q22)};

    for (int k = 0; k < 3; k++) {
        c.from[k] = (int32_t)((look->position.c[k] - r->position.c[k]) >> 16);
    }
    if (!may_shade(r->view, c.from, c.radius + radius_q16(r->body->mesh->radius_q22))) {
        return true;
    }
    return !make_prisms(r, &c, look) || shade_by_caster(r, &c);
}

/* Set where the body is, and where the light comes from as its vertices are placed. */
FIX_OWN_FRAME static void place_receiver(struct receiver *r, uint32_t number)
{
    struct carom_body_look own;
    struct draw_body frame;

    (void)draw_look(r->source, number, &own); /* it is there: its faces are in the list */
    r->position = own.position;
    fix_matrix(&r->turn, &own.rotation);
    draw_body_of_points(&frame, r->view, r->body->shift);
    for (int k = 0; k < 3; k++) {
        r->sun[k] = (int32_t)(carom_dot(frame.to_view.c[k], r->view->sun.c) >> 30);
    }
}

static bool list_shadows(const struct draw_source *source, const struct draw_view *view,
                         const struct draw_shades *shades, const struct draw_body *body,
                         uint32_t number, struct draw_list *list, void *scratch, size_t bytes)
{
    struct receiver r = {.source = source,
                         .view = view,
                         .body = body,
                         .shades = shades,
                         .list = list,
                         .scratch = scratch,
                         .bytes = bytes};
    struct carom_body_look look;

    place_receiver(&r, number);
    for (uint32_t i = 0; i < source->count; i++) {
        if (i != number && draw_look(source, i, &look) && look.mesh->raw.kind == CAROM_SOLID &&
            !shade_by(&r, &look)) {
            return false;
        }
    }
    return true;
}

const struct carom_shadows carom_shadows = {
    .init = init,
    .reach = find_reach,
    .list = list_shadows,
};

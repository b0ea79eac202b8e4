/* SPDX-License-Identifier: MIT */
/*
 * Edges of a mesh: found by sorting the sides of faces, listed at each vertex, and owned by a face
 * if the surface bends there.
 */
#include "build.h"

/*
 * An edge is flat if the sine of the angle by which the surface turns there is within 1e-5: rounded
 * vertices make coplanar faces turn by about that much. The sine is -n0 . m, where m lies in face 1
 * at right angles to the edge.
 */
#define FLAT_Q30 10737

/*
 * A face's side as a key: its two vertices, the lower one first, a bit if it runs from the higher
 * one, and the side's number. Sorting makes the sides of one edge neighbours.
 */
#define KEY_BACKWARD ((uint64_t)1 << 31)

static void make_keys(const struct carom_mesh_raw *raw, uint64_t *keys)
{
    for (uint32_t side = 0; side < 3 * raw->face_count; side++) {
        const uint16_t *corner = raw->faces[side / 3];
        uint64_t from = corner[side % 3], to = corner[(side + 1) % 3];

        keys[side] =
            from < to ? from << 48 | to << 32 | side : to << 48 | from << 32 | KEY_BACKWARD | side;
    }
}

static bool same_edge(uint64_t a, uint64_t b)
{
    return a >> 32 == b >> 32;
}

/* Count the edges and judge them. */
static int count_edges(struct mesh_builder *b)
{
    const struct carom_mesh_raw *raw = &b->mesh->raw;
    const uint64_t *keys = b->keys;
    uint32_t n = 3 * raw->face_count, count = 0;
    bool open = false, wrong = false;

    for (uint32_t i = 0; i < n; count++) {
        uint32_t first = i++;
        bool twice = i < n && same_edge(keys[first], keys[i]);

        if (!twice) {
            open = true;
            continue;
        }
        wrong |= ((keys[first] ^ keys[i]) & KEY_BACKWARD) == 0; /* both run the same way */
        for (i++; i < n && same_edge(keys[first], keys[i]); i++) {
            wrong = true;
        }
    }
    if (open && raw->kind == CAROM_SOLID) {
        return CAROM_ERR_MESH_OPEN;
    }
    if (wrong) {
        return CAROM_ERR_MESH_EDGE;
    }
    /*
     * A closed mesh has 3/2 edges a face. Seen from above a surface is a graph drawn in the plane without
     * crossings, which has at most 3 edges a vertex, less 6. Both fit CAROM_MESH_BYTES.
     */
    if (count > CAROM_MESH_EDGES_(raw->vertex_count, raw->face_count)) {
        return CAROM_ERR_MESH_SURFACE;
    }
    b->mesh->edge_count = count;
    return CAROM_OK;
}

/* The vertices of an edge, from a side of its face 0. */
static void join_edge(const struct mesh_builder *b, struct carom_edge *e, uint32_t side)
{
    const uint16_t *corner = b->mesh->raw.faces[side / 3];

    e->vertex[0] = corner[side % 3];
    e->vertex[1] = corner[(side + 1) % 3];
}

/* Where an edge lies. */
static void place_edge(const struct mesh_builder *b, struct carom_edge *e)
{
    const struct carom_mesh_raw *raw = &b->mesh->raw;
    int64_t along_q22[3];

    for (int k = 0; k < 3; k++) {
        int32_t quanta = raw->vertices[e->vertex[1]][k] - raw->vertices[e->vertex[0]][k];

        along_q22[k] = carom_shl(quanta, 22 - raw->quantum_bits);
    }
    (void)fix_normalise(&e->direction, along_q22);  /* not 0: the face has an area */
    e->length_q22 = (int32_t)fix_length(along_q22); /* at most the box's diagonal */
}

/* How the surface bends at an edge. */
enum bend { FLAT, OUTWARDS, INWARDS };

/*
 * A border counts as an edge that bends outwards. Where the surface folds back by more than a right
 * angle it cannot be flat, so doubtful cases count as outwards: a thin blade is sharp.
 */
static enum bend bend_at(const struct mesh_builder *b, const struct carom_edge *e)
{
    const int32_t *n0, *n1;
    int32_t inward[3];
    int64_t limit_q60 = (int64_t)FLAT_Q30 * CAROM_ONE_Q30, rise_q60;

    if (e->face[1] == CAROM_NO_FACE) {
        return OUTWARDS;
    }
    n0 = b->faces[e->face[0]].normal.c;
    n1 = b->faces[e->face[1]].normal.c;
    /* face 1 runs against the edge; its inside is to the left of its sides */
    carom_cross(inward, e->direction.c, n1, 30);
    rise_q60 = carom_dot(n0, inward);
    if (rise_q60 < (carom_dot(n0, n1) < 0 ? limit_q60 : -limit_q60)) {
        return OUTWARDS;
    }
    return rise_q60 > limit_q60 ? INWARDS : FLAT;
}

/* Make the edges from the sorted sides, and enter them in their faces. */
static void make_edges(struct mesh_builder *b)
{
    uint32_t n = 3 * b->mesh->raw.face_count, i = 0;

    for (uint32_t number = 0; number < b->mesh->edge_count; number++) {
        struct carom_edge *e = &b->edges[number];
        uint32_t first = i++, side0 = (uint32_t)(b->keys[first] & (KEY_BACKWARD - 1));

        e->face[0] = (uint16_t)(side0 / 3);
        e->face[1] = CAROM_NO_FACE;
        b->faces[side0 / 3].edge[side0 % 3] = number;
        if (i < n && same_edge(b->keys[first], b->keys[i])) {
            uint32_t side1 = (uint32_t)(b->keys[i++] & (KEY_BACKWARD - 1));

            e->face[1] = (uint16_t)(side1 / 3);
            b->faces[side1 / 3].edge[side1 % 3] = number;
        }
        join_edge(b, e, side0);
    }
}

/*
 * List the edges at each vertex: count them, turn the counts into the places where the lists end,
 * and fill the lists from their ends, which leaves the places at the lists' starts.
 */
static void make_rings(struct mesh_builder *b)
{
    struct carom_mesh *mesh = b->mesh;
    uint32_t *start, *ring;
    uint32_t end = 0;

    ARENA_CARVE(&b->arena, start, mesh->raw.vertex_count + 1);
    ARENA_CARVE(&b->arena, ring, 2 * mesh->edge_count);
    for (uint32_t i = 0; i < 2 * mesh->edge_count; i++) {
        start[b->edges[i / 2].vertex[i % 2]]++;
    }
    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        end += start[v];
        start[v] = end;
    }
    start[mesh->raw.vertex_count] = end;
    for (uint32_t i = 2 * mesh->edge_count; i-- > 0;) {
        ring[--start[b->edges[i / 2].vertex[i % 2]]] = i;
    }
    mesh->ring_start = start;
    mesh->ring = ring;
}

/* The bit of an edge in `own` and `behind` of its face 0. */
static uint8_t edge_flag(const struct mesh_builder *b, uint32_t edge)
{
    const struct carom_face *face = &b->faces[b->edges[edge].face[0]];
    int k = face->edge[0] == edge ? 0 : face->edge[1] == edge ? 1 : 2;

    return (uint8_t)(8 << k);
}

/*
 * Give every vertex at an edge that bends to the first face that has it as a corner: as `behind` if
 * no edge there bends outwards.
 */
static void own_vertices(struct mesh_builder *b)
{
    const struct carom_mesh *mesh = b->mesh;

    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        uint32_t first = CAROM_NO_FACE;
        bool sharp = false, bends = false;

        for (uint32_t i = mesh->ring_start[v]; i < mesh->ring_start[v + 1]; i++) {
            uint32_t edge = mesh->ring[i] / 2;
            const struct carom_face *owner = &b->faces[b->edges[edge].face[0]];

            for (int side = 0; side < 2; side++) {
                uint32_t face = b->edges[edge].face[side];

                first = face < first ? face : first;
            }
            sharp |= (owner->own & edge_flag(b, edge)) != 0;
            bends |= (owner->behind & edge_flag(b, edge)) != 0;
        }
        if (sharp || bends) {
            const uint16_t *corner = mesh->raw.faces[first];
            int k = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;

            *(sharp ? &b->faces[first].own : &b->faces[first].behind) |= (uint8_t)(1 << k);
        }
    }
}

void mesh_shape_edges(struct mesh_builder *b)
{
    for (uint32_t f = 0; f < b->mesh->raw.face_count; f++) {
        b->faces[f].own = b->faces[f].behind = 0;
    }
    for (uint32_t i = 0; i < b->mesh->edge_count; i++) {
        struct carom_face *owner = &b->faces[b->edges[i].face[0]];
        enum bend bend;

        place_edge(b, &b->edges[i]);
        bend = bend_at(b, &b->edges[i]);
        owner->own |= bend == OUTWARDS ? edge_flag(b, i) : 0;
        owner->behind |= bend == INWARDS ? edge_flag(b, i) : 0;
    }
    own_vertices(b);
}

int mesh_build_edges(struct mesh_builder *b)
{
    int error;

    make_keys(&b->mesh->raw, b->keys);
    sort_keys(b->keys, 3 * b->mesh->raw.face_count);
    error = count_edges(b);
    if (error) {
        return error;
    }
    ARENA_CARVE(&b->arena, b->edges, b->mesh->edge_count);
    b->mesh->edges = b->edges;
    make_edges(b);
    make_rings(b);
    mesh_shape_edges(b);
    return CAROM_OK;
}

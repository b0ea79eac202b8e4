/* SPDX-License-Identifier: MIT */
/*
 * Cut the faces of a mesh into leaves: clusters of neighbours, with a sphere and a slab around
 * each.
 */
#include "build.h"

/* A face's number in the low bits of its key. */
static uint16_t key_face(uint64_t key)
{
    return (uint16_t)(key & 0xffff);
}

/* Three times coordinate `axis` of a face's centre, in quanta above the box; below 2^18. */
static uint32_t centre3(const struct carom_mesh *mesh, uint16_t face, int axis)
{
    const uint16_t *corner = mesh->raw.faces[face];
    int32_t sum = mesh->raw.vertices[corner[0]][axis] + mesh->raw.vertices[corner[1]][axis] +
                  mesh->raw.vertices[corner[2]][axis];

    return (uint32_t)(sum - 3 * mesh->box[0][axis]);
}

/* The axis along which the centres of n faces spread most. */
static int widest_axis(const struct carom_mesh *mesh, const uint64_t *keys, uint32_t n)
{
    uint32_t widest = 0;
    int best = 0;

    for (int axis = 0; axis < 3; axis++) {
        uint32_t low = UINT32_MAX, high = 0;

        for (uint32_t i = 0; i < n; i++) {
            uint32_t c = centre3(mesh, key_face(keys[i]), axis);

            low = c < low ? c : low;
            high = c > high ? c : high;
        }
        if (high - low > widest) {
            widest = high - low;
            best = axis;
        }
    }
    return best;
}

static void sort_along(const struct carom_mesh *mesh, uint64_t *keys, uint32_t n, int axis)
{
    for (uint32_t i = 0; i < n; i++) {
        uint16_t face = key_face(keys[i]);

        keys[i] = (uint64_t)centre3(mesh, face, axis) << 16 | face;
    }
    sort_keys(keys, n);
}

/* The arrays that hold the leaves, and how much of them is used. */
struct leaf_builder {
    struct carom_leaf *leaves;
    uint16_t *faces, *vertices;
    uint8_t (*corners)[3];
    uint32_t face_count, vertex_count;
};

/* Add a face to a leaf. Returns false if that would make it too large. */
static bool add_face(struct leaf_builder *l, struct carom_leaf *leaf, const uint16_t corner[3],
                     uint16_t face)
{
    uint16_t *vertices = &l->vertices[leaf->first_vertex];
    uint32_t place = leaf->first_face + leaf->face_count;
    int count = leaf->vertex_count;

    CAROM_ASSERT(leaf->face_count < CAROM_LEAF_FACES); /* no more are handed over */
    for (int k = 0; k < 3; k++) {
        int i = 0;

        while (i < count && vertices[i] != corner[k]) {
            i++;
        }
        if (i == CAROM_LEAF_VERTICES) {
            return false;
        }
        vertices[i] = corner[k];
        l->corners[place][k] = (uint8_t)i;
        count += i == count;
    }
    l->faces[place] = face;
    leaf->face_count++;
    leaf->vertex_count = (uint8_t)count;
    return true;
}

/*
 * Set the sphere around a leaf, about the middle of its box. Bounds: the middle is within the
 * mesh's box, so differences fit q22 as vertices do.
 */
static void bound_leaf(const struct carom_mesh *mesh, struct carom_leaf *leaf)
{
    const uint16_t *vertices = &mesh->leaf_vertices[leaf->first_vertex];

    for (int k = 0; k < 3; k++) {
        int32_t low = INT16_MAX, high = INT16_MIN;

        for (int i = 0; i < leaf->vertex_count; i++) {
            int32_t c = mesh->raw.vertices[vertices[i]][k];

            low = c < low ? c : low;
            high = c > high ? c : high;
        }
        leaf->centre.c[k] =
            (int32_t)(carom_shl(low + high, 21 - mesh->raw.quantum_bits) - mesh->mass.centre.c[k]);
    }
    leaf->radius_q22 = 0;
    for (int i = 0; i < leaf->vertex_count; i++) {
        carom_v3_q22 p = mesh_vertex(mesh, vertices[i]);
        int64_t from_centre[3];

        for (int k = 0; k < 3; k++) {
            from_centre[k] = (int64_t)p.c[k] - leaf->centre.c[k];
        }
        leaf->radius_q22 = (int32_t)mesh_longest(leaf->radius_q22, from_centre);
    }
}

/* Set the slab that holds a leaf, and which of its vertices its faces own. */
static void set_slab(const struct carom_mesh *mesh, struct carom_leaf *leaf)
{
    const uint16_t *vertices = &mesh->leaf_vertices[leaf->first_vertex];
    int64_t sum[3] = {0, 0, 0};

    leaf->owned = 0;
    for (uint32_t i = leaf->first_face; i < leaf->first_face + leaf->face_count; i++) {
        const struct carom_face *face = &mesh->faces[mesh->leaf_faces[i]];

        for (int k = 0; k < 3; k++) {
            sum[k] += face->normal.c[k];
            leaf->owned |= face->own & 1 << k ? 1u << mesh->leaf_corners[i][k] : 0;
        }
    }
    if (!fix_normalise(&leaf->axis, sum)) {
        leaf->axis = (carom_v3_q30){{0, 0, CAROM_ONE_Q30}};
    }
    leaf->low_q22 = INT32_MAX;
    leaf->high_q22 = INT32_MIN;
    for (int i = 0; i < leaf->vertex_count; i++) {
        carom_v3_q22 p = mesh_vertex(mesh, vertices[i]);
        int32_t height = (int32_t)carom_round(carom_dot(leaf->axis.c, p.c), 30);

        leaf->low_q22 = height < leaf->low_q22 ? height : leaf->low_q22;
        leaf->high_q22 = height > leaf->high_q22 ? height : leaf->high_q22;
    }
}

void mesh_shape_leaves(struct mesh_builder *b)
{
    for (uint32_t i = 0; i < b->mesh->leaf_count; i++) {
        bound_leaf(b->mesh, &b->leaves[i]);
        set_slab(b->mesh, &b->leaves[i]);
    }
}

/*
 * Make leaves of up to CAROM_LEAF_FACES neighbouring faces: one, or two if there are too many
 * vertices for one, since any ten faces fit.
 */
static void add_leaves(const struct carom_mesh *mesh, struct leaf_builder *l, uint32_t *leaf_count,
                       const uint64_t *keys, uint32_t n)
{
    for (uint32_t i = 0; i < n;) {
        struct carom_leaf *leaf = &l->leaves[(*leaf_count)++];

        leaf->first_face = l->face_count;
        leaf->first_vertex = l->vertex_count;
        while (i < n && add_face(l, leaf, mesh->raw.faces[key_face(keys[i])], key_face(keys[i]))) {
            i++;
        }
        l->face_count += leaf->face_count;
        l->vertex_count += leaf->vertex_count;
    }
}

/*
 * Halve the faces across their widest axis until each part fits a leaf. A left part is a multiple
 * of a leaf, so that all leaves but the last can be full. The stack holds the end of each waiting
 * range; a range begins where the one before it ended. A left part is at most half of its range, so
 * 16 places do for 65535 faces.
 */
static void split_faces(const struct carom_mesh *mesh, struct leaf_builder *l, uint32_t *leaf_count,
                        uint64_t *keys)
{
    uint32_t end[16], depth = 0, first = 0;

    end[depth++] = mesh->raw.face_count;
    while (depth > 0) {
        uint32_t n = end[depth - 1] - first;

        if (n <= CAROM_LEAF_FACES) {
            add_leaves(mesh, l, leaf_count, &keys[first], n);
            first = end[--depth];
        } else {
            uint32_t leaves = (n + CAROM_LEAF_FACES - 1) / CAROM_LEAF_FACES;

            sort_along(mesh, &keys[first], n, widest_axis(mesh, &keys[first], n));
            CAROM_ASSERT(depth < 16);
            end[depth++] = first + leaves / 2 * CAROM_LEAF_FACES;
        }
    }
}

void mesh_build_leaves(struct mesh_builder *b)
{
    struct carom_mesh *mesh = b->mesh;
    const uint32_t n = mesh->raw.face_count, v = mesh->raw.vertex_count;
    struct leaf_builder l = {0};

    ARENA_CARVE(&b->arena, l.leaves, CAROM_MESH_LEAVES_(v, n));
    ARENA_CARVE(&b->arena, l.faces, n);
    ARENA_CARVE(&b->arena, l.vertices, CAROM_MESH_LEAF_VERTICES_(v, n));
    ARENA_CARVE(&b->arena, l.corners, n);
    for (uint32_t f = 0; f < n; f++) {
        b->keys[f] = f;
    }
    split_faces(mesh, &l, &mesh->leaf_count, b->keys);
    mesh->leaves = l.leaves;
    mesh->leaf_faces = l.faces;
    mesh->leaf_vertices = l.vertices;
    mesh->leaf_corners = (const uint8_t(*)[3])l.corners;
    b->leaves = l.leaves;
    mesh_shape_leaves(b);
}

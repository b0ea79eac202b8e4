/* SPDX-License-Identifier: MIT */
/*
 * Carry a leaf of a into b's frame at mid-span: its vertices, its slab, and its faces' boxes and
 * planes.
 */
#include "narrow.h"

/* Carry coordinate k of the leaf's vertices into b's frame, and set its swept box along k. */
static void place_axis(struct interfere *in, const carom_v3_q22 local[CAROM_LEAF_VERTICES], int k)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    struct interfere_leaf *l = in->leaf;
    /* copies: the compiler must assume that a store may alias `in` */
    const int32_t row[3] = {in->leaf->to_b.c[k][0], in->leaf->to_b.c[k][1], in->leaf->to_b.c[k][2]},
                  at = in->leaf->at.c[k];
    const carom_v3_q22 *end = local + l->leaf->vertex_count;
    int32_t low = INT32_MAX, high = INT32_MIN, *to = &l->p[0].c[k];

    for (; local < end; local++, to += 3) {
        int32_t x = interfere_dot(row, local->c) + at;

        *to = x;
        low = x < low ? x : low;
        high = x > high ? x : high;
    }
    l->quanta_low[k] = interfere_quanta(mb, low - l->reach.c[k], k);
    l->quanta_high[k] = interfere_quanta(mb, high + l->reach.c[k], k) + 1;
}

/* A length in quanta, q15, saturated to 32 bits. */
FIX_APART static int32_t to_quanta_q15(const struct carom_mesh *mesh, int64_t x_q18)
{
    int64_t x_q15 = x_q18 * ((int64_t)1 << (mesh->raw.quantum_bits - 3));

    return x_q15 > INT32_MAX ? INT32_MAX : x_q15 < -INT32_MAX ? -INT32_MAX : (int32_t)x_q15;
}

/*
 * Set the interval that the leaf sweeps along its slab's axis, measured from b's origin. Bounds:
 * axis times a vertex of b is below 2^15 sqrt(3) times 2^15 in magnitude, which fits 32 bits. Each
 * component of the axis is rounded by up to half a unit, so the product is off by up to half the
 * sum of the vertex's coordinates (rounding_q15).
 */
static void place_slab(struct interfere *in)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    struct interfere_leaf *l = in->leaf;
    int32_t axis_q30[3], at_q18, reach_q18, rounding_q15 = 0;

    carom_rotate(axis_q30, &in->leaf->to_b, l->leaf->axis.c);
    at_q18 =
        interfere_dot(axis_q30, in->leaf->at.c) + (interfere_dot(axis_q30, mb->mass.centre.c) >> 2);
    for (int k = 0; k < 3; k++) {
        int32_t low = -mb->box[0][k], high = mb->box[1][k];

        l->axis_q15[k] = (int32_t)carom_round(axis_q30[k], 15);
        rounding_q15 += (low > high ? low : high) / 2 + 1;
    }
    /* low_q22 and high_q22 are measured in a's own axes; to_b preserves them but for its skew */
    reach_q18 = interfere_reach_q18(l, axis_q30) +
                (int32_t)(fix_mul(in->a->def.radius_q22, in->leaf->skew_q30, 30) >> 4) + 2 +
                (rounding_q15 >> (mb->raw.quantum_bits - 3));
    l->slab_low_q15 = to_quanta_q15(mb, (int64_t)at_q18 + (l->leaf->low_q22 >> 4) - reach_q18);
    l->slab_high_q15 = to_quanta_q15(mb, (int64_t)at_q18 + (l->leaf->high_q22 >> 4) + reach_q18);
}

bool interfere_place_leaf(struct interfere *in)
{
    const struct carom_mesh *ma = in->a->def.mesh;
    struct interfere_leaf *l = in->leaf;
    const struct carom_leaf *leaf = l->leaf;
    const uint16_t *vertex = &ma->leaf_vertices[leaf->first_vertex];
    /* copies: see place_axis */
    const int16_t(*quanta)[3] = ma->raw.vertices;
    const int32_t one = (int32_t)1 << (22 - ma->raw.quantum_bits), x = -ma->mass.centre.c[0],
                  y = -ma->mass.centre.c[1], z = -ma->mass.centre.c[2];
    carom_v3_q22 local[CAROM_LEAF_VERTICES], *end = local + leaf->vertex_count;

    for (carom_v3_q22 *to = local; to < end; to++) {
        const int16_t *from = quanta[*vertex++];

        to->c[0] = from[0] * one + x;
        to->c[1] = from[1] * one + y;
        to->c[2] = from[2] * one + z;
    }
    place_axis(in, local, 2);
    if (!interfere_reaches_leaf(in)) {
        return false;
    }
    place_axis(in, local, 0);
    place_axis(in, local, 1);
    place_slab(in);
    l->listed = false;
    return true;
}

void interfere_list_faces(struct interfere *in)
{
    struct interfere_leaf *l = in->leaf;

    l->listed = true;
    l->boxed = l->placed = l->up = 0;
    l->asked = false;
    for (uint32_t i = 0; i < l->leaf->face_count; i++) {
        const uint8_t *corner = interfere_corners(in, i);

        l->corners[i] = 1u << corner[0] | 1u << corner[1] | 1u << corner[2];
        l->own_edges[i] = in->a->def.mesh->faces[interfere_face(in, i)].own >> 3;
    }
}

void interfere_box_face(struct interfere *in, uint32_t i)
{
    struct interfere_leaf *l = in->leaf;
    const uint8_t *corner = interfere_corners(in, i);

    l->boxed |= (uint16_t)(1u << i);
    interfere_bound(&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]], &l->face_low[i],
                    &l->face_high[i]);
    for (int k = 0; k < 3; k++) {
        l->face_low[i].c[k] -= l->reach.c[k];
        l->face_high[i].c[k] += l->reach.c[k];
    }
}

void interfere_place_plane(struct interfere *in, uint32_t i)
{
    struct interfere_leaf *l = in->leaf;
    struct interfere_plane *plane = &l->planes[i];
    int32_t offset_q18, reach_q18;

    l->placed |= (uint16_t)(1u << i);
    carom_rotate(plane->n_q30, &l->to_b, in->a->def.mesh->faces[interfere_face(in, i)].normal.c);
    offset_q18 = interfere_dot(plane->n_q30, l->p[interfere_corners(in, i)[0]].c);
    reach_q18 = interfere_reach_q18(l, plane->n_q30);
    plane->above_q18 = offset_q18 + reach_q18;
    plane->below_q18 = offset_q18 - reach_q18;
}

/* True if a face of a may look up along b's z at some time of the span. */
static inline bool looks_up(const struct interfere *in, uint32_t face)
{
    return interfere_dot(in->leaf->to_b.c[2], in->a->def.mesh->faces[face].normal.c) >
           -(in->leaf->cone_q30 >> 2) - 1;
}

/* True if the leaf's face i, or one across an edge that it owns, may look up. */
static bool has_up(const struct interfere *in, uint32_t i)
{
    const struct carom_mesh *ma = in->a->def.mesh;
    const uint32_t face = interfere_face(in, i);
    uint32_t own = in->leaf->own_edges[i];

    if (looks_up(in, face)) {
        return true;
    }
    for (int k = 0; own != 0; k++, own >>= 1) {
        if ((own & 1) && looks_up(in, ma->edges[ma->faces[face].edge[k]].face[1])) {
            return true;
        }
    }
    return false;
}

uint32_t interfere_faces_up(struct interfere *in)
{
    struct interfere_leaf *l = in->leaf;

    if (!l->asked) {
        l->asked = true;
        for (uint32_t i = 0; i < l->leaf->face_count; i++) {
            l->up |= (uint16_t)(has_up(in, i) ? 1u << i : 0);
        }
    }
    return l->up;
}

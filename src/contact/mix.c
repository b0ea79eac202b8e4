/* SPDX-License-Identifier: MIT */
/* Mix the materials of two bodies at a contact. */
#include "contact.h"

int32_t contact_mix_restitution(const struct contact_list *list, int32_t a_q30, int32_t b_q30)
{
    switch (list->restitution_rule) {
    case CAROM_LARGER:
        return fix_larger(a_q30, b_q30);
    case CAROM_PRODUCT:
        return carom_mul_q30(a_q30, b_q30);
    case CAROM_MEAN:
        return (a_q30 + b_q30) / 2; /* both are at most 2^30 */
    default:
        return fix_smaller(a_q30, b_q30);
    }
}

uint32_t contact_mix_friction(const struct contact_list *list, uint32_t a_q16, uint32_t b_q16)
{
    uint64_t product_q32 = (uint64_t)a_q16 * b_q16; /* below 2^37 */

    switch (list->friction_rule) {
    case CAROM_LARGER:
        return a_q16 > b_q16 ? a_q16 : b_q16;
    case CAROM_PRODUCT:
        return product_q32 >> 16 < CAROM_MU_MAX_Q16 ? (uint32_t)(product_q32 >> 16)
                                                    : CAROM_MU_MAX_Q16;
    case CAROM_MEAN:
        return fix_sqrt(product_q32);
    default:
        return a_q16 < b_q16 ? a_q16 : b_q16;
    }
}

static void look(const struct carom_mesh *mesh, uint32_t face, const int32_t along_q30[3],
                 uint32_t *best, int64_t *most_q60)
{
    int64_t here_q60 = carom_dot(mesh->faces[face].normal.c, along_q30);

    if (*best == CAROM_NO_FACE || here_q60 > *most_q60 || (here_q60 == *most_q60 && face < *best)) {
        *best = face;
        *most_q60 = here_q60;
    }
}

static void look_at_edge(const struct carom_mesh *mesh, uint32_t edge, const int32_t along_q30[3],
                         uint32_t *best, int64_t *most_q60)
{
    for (int k = 0; k < 2; k++) {
        if (mesh->edges[edge].face[k] != CAROM_NO_FACE) {
            look(mesh, mesh->edges[edge].face[k], along_q30, best, most_q60);
        }
    }
}

uint32_t contact_face(const struct body *b, const struct candidate *key, int side,
                      const carom_v3_q30 *normal)
{
    /* key->i is a vertex, of a or b, and key->j a face of the other; of edges i is a's */
    bool vertex = key->kind == (side == 0 ? CANDIDATE_VERTEX_FACE : CANDIDATE_FACE_VERTEX);
    const struct carom_mesh *mesh = b->def.mesh;
    uint32_t best = CAROM_NO_FACE;
    int32_t along_q30[3];
    int64_t most_q60 = 0;

    carom_rotate_back(along_q30, &b->path.start.r, normal->c);
    for (int k = 0; side == 0 && k < 3; k++) {
        along_q30[k] = -along_q30[k]; /* N looks from b to a */
    }
    if (key->kind == CANDIDATE_EDGE_EDGE) {
        look_at_edge(mesh, side == 0 ? key->i : key->j, along_q30, &best, &most_q60);
        return best;
    }
    if (!vertex) {
        return key->j;
    }
    for (uint32_t n = mesh->ring_start[key->i]; n < mesh->ring_start[key->i + 1]; n++) {
        look_at_edge(mesh, mesh->ring[n] / 2, along_q30, &best, &most_q60);
    }
    return best;
}

/* The material of a side's face at a contact; NULL if the body has none by face. */
static const struct carom_material *material(const struct body *b, const struct candidate *key,
                                             int side, const carom_v3_q30 *normal)
{
    if (!b->def.extra || !b->def.extra->materials) {
        return NULL;
    }
    return &b->def.extra
                ->materials[b->def.extra->face_material[contact_face(b, key, side, normal)]];
}

/* Add sign times the velocity of a body's surface, in world axes. */
static void add_surface(const struct body *b, const struct carom_material *m, int sign,
                        carom_v3_q40 *sum)
{
    int64_t own[3];

    if (!b->def.extra) {
        return;
    }
    fix_rotate(own, &b->path.start.r, m ? m->surface_velocity.c : b->def.extra->surface_velocity.c);
    for (int k = 0; k < 3; k++) {
        sum->c[k] += sign * own[k];
    }
}

bool contact_mix_materials(const struct contact_list *list, const struct boyse_pair *pair,
                           const struct candidate *key, const carom_v3_q30 *normal,
                           carom_v3_q40 *drift, struct contact_mixed *mixed)
{
    const struct body *a = pair->a, *b = pair->b;
    const struct carom_material *of_a = material(a, key, 0, normal);
    const struct carom_material *of_b = material(b, key, 1, normal);
    carom_v3_q40 along = {{0, 0, 0}};
    int64_t out_q40;

    add_surface(a, of_a, -1, &along);
    add_surface(b, of_b, 1, &along);
    /* along the contact only: a part out of it would lift */
    out_q40 = fix_dot_q30(along.c, normal->c);
    for (int k = 0; k < 3; k++) {
        drift->c[k] += along.c[k] - fix_mul_q30(out_q40, normal->c[k]);
    }
    mixed->restitution_q30 =
        contact_mix_restitution(list, of_a ? of_a->restitution_q30 : a->def.restitution_q30,
                                of_b ? of_b->restitution_q30 : b->def.restitution_q30);
    mixed->friction_q16 =
        contact_mix_friction(list, of_a ? of_a->friction_q16 : a->def.friction_q16,
                             of_b ? of_b->friction_q16 : b->def.friction_q16);
    return of_a || of_b || (along.c[0] | along.c[1] | along.c[2]) != 0;
}

/* SPDX-License-Identifier: MIT */
/* The effect of the toggles on the look of a scene: interfering faces, shadows, leaves. */
#include <string.h>

#include "view_parts.h"

#define LEAF_FACES_MAX  (1 << 17) /* of all meshes together */
#define LEAF_MESHES_MAX 64
#define LEAF_RAMPS      7
#define BODIES_MAX      1024
#define RAMPS_MAX       64

/* Faces of a mesh, by the ramps of their leaves. */
struct leaf_faces {
    const struct carom_mesh *mesh;
    uint32_t first;
};

static uint8_t leaf_ramps[LEAF_FACES_MAX];
static struct leaf_faces leaf_meshes[LEAF_MESHES_MAX];
static uint32_t leaf_mesh_count, leaf_face_count;
static struct carom_body_paint bodies[BODIES_MAX];
static uint32_t palette[RAMPS_MAX * CAROM_RAMP_SHADES];

/* The ramps of a mesh's faces, from `ramp` on; NULL if there is no room. */
static const uint8_t *faces_of(const struct carom_mesh *mesh, uint8_t ramp)
{
    uint8_t *faces = &leaf_ramps[leaf_face_count];

    for (uint32_t i = 0; i < leaf_mesh_count; i++) {
        if (leaf_meshes[i].mesh == mesh) {
            return &leaf_ramps[leaf_meshes[i].first];
        }
    }
    if (leaf_mesh_count == LEAF_MESHES_MAX ||
        mesh->raw.face_count > LEAF_FACES_MAX - leaf_face_count) {
        return NULL;
    }
    for (uint32_t leaf = 0; leaf < mesh->leaf_count; leaf++) {
        for (uint32_t i = 0; i < mesh->leaves[leaf].face_count; i++) {
            faces[mesh->leaf_faces[mesh->leaves[leaf].first_face + i]] =
                (uint8_t)(ramp + leaf % LEAF_RAMPS);
        }
    }
    leaf_meshes[leaf_mesh_count++] = (struct leaf_faces){mesh, leaf_face_count};
    leaf_face_count += mesh->raw.face_count;
    return faces;
}

/* The scene's palette, and behind it a ramp for every seventh leaf. */
static void paint_leaves(const struct carom_world *world, struct carom_paint *paint)
{
    static const uint32_t rgb[LEAF_RAMPS] = {0x4c8bd0, 0xd8a03c, 0x58a868, 0xb46fb8,
                                             0x52b4b0, 0xc8785c, 0x9aa05a};
    const uint32_t own = paint->palette ? paint->ramps : 8;
    const int count = carom_body_count(world);

    if (own + LEAF_RAMPS > RAMPS_MAX) {
        return;
    }
    memcpy(palette, paint->palette ? paint->palette : carom_draw_palette,
           own * CAROM_RAMP_SHADES * sizeof palette[0]);
    for (uint32_t i = 0; i < LEAF_RAMPS; i++) {
        carom_draw_ramp(&palette[(own + i) * CAROM_RAMP_SHADES], rgb[i]);
    }
    leaf_mesh_count = leaf_face_count = 0;
    for (int i = 0; i < count && i < BODIES_MAX; i++) {
        const struct carom_mesh *mesh = carom_body_mesh(world, i);

        bodies[i] = (struct carom_body_paint){mesh ? faces_of(mesh, (uint8_t)own) : NULL, 0};
    }
    paint->palette = palette;
    paint->ramps = own + LEAF_RAMPS;
    paint->bodies = bodies;
    paint->body_count = count < BODIES_MAX ? (uint32_t)count : BODIES_MAX;
}

const struct carom_paint *view_paint(const struct carom_world *world,
                                     const struct carom_paint *scene_own, uint32_t toggles)
{
    static struct carom_paint paint;

    paint = scene_own ? *scene_own : (struct carom_paint){.palette = NULL};
    paint.hide_interfering = !(toggles & VIEW_FACES);
    paint.shadows = toggles & VIEW_SHADOWS ? &carom_shadows : NULL;
    if (toggles & VIEW_LEAVES) {
        paint_leaves(world, &paint);
    }
    return &paint;
}

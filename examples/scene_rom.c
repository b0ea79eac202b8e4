/* SPDX-License-Identifier: MIT */
/* The meshes of a board's scenes in ROM, indexed when the program was built. */
#include <string.h>

#include "scene.h"

/* rom_scenes.h, which the Makefile writes, has a line ROM_SCENE(identifier) for each. */
#define ROM_SCENE(identifier) extern const struct scene_rom rom_##identifier;
#include "rom_scenes.h"
#undef ROM_SCENE
#define ROM_SCENE(identifier) &rom_##identifier,
static const struct scene_rom *const scenes[] = {
#include "rom_scenes.h"
};

int scene_meshes(struct scene *scene, const char *name, const struct carom_mesh_raw *user,
                 void *mem, size_t bytes)
{
    (void)mem;
    (void)bytes;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0] && !user; i++) {
        if (strcmp(name, scenes[i]->name) == 0) {
            scene->ground.mesh = scenes[i]->ground;
            while (scene->mesh_count < SCENE_MESHES && scenes[i]->mesh[scene->mesh_count]) {
                scene->mesh[scene->mesh_count] = scenes[i]->mesh[scene->mesh_count];
                scene->mesh_count++;
            }
            return CAROM_OK;
        }
    }
    return CAROM_ERR_ARGUMENT;
}

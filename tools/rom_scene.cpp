/* SPDX-License-Identifier: MIT */
/*
 * rom_scene NAME: the meshes of a scene of examples/scene.h, indexed, as a C source that defines
 * struct scene_rom rom_NAME. Characters of the name that are neither letters nor digits become
 * underscores.
 */
#include <cstdio>
#include <cstdlib>
#include <string>

#include "mesh_rom.hpp"

extern "C" {
#include "scene.h"
}

int main(int argc, char **argv)
{
    static uint64_t memory[SCENE_MESH_BYTES / 8];
    static scene loaded;
    std::string id, bodies;

    if (argc != 2) {
        std::fprintf(stderr, "usage: rom_scene NAME\n");
        return 2;
    }
    if (const int result = scene_load(&loaded, argv[1], nullptr, memory, sizeof memory)) {
        std::fprintf(stderr, "rom_scene: %s: %s\n", argv[1], carom_result_text(result));
        return 1;
    }
    if (loaded.sheet) {
        std::fprintf(stderr, "rom_scene: %s: its ground moves and needs RAM\n", argv[1]);
        return 1;
    }
    for (const char *c = argv[1]; *c; c++) {
        id += std::isalnum(static_cast<unsigned char>(*c)) ? *c : '_';
    }
    std::printf("/* SPDX-License-Identifier: MIT */\n"
                "/* Made by rom_scene %s: do not edit. */\n#include \"scene.h\"\n\n%s",
                argv[1], rom::c_source(*loaded.ground.mesh, "ground", true).c_str());
    for (int i = 0; i < loaded.mesh_count; i++) {
        const std::string name = "body" + std::to_string(i);

        std::printf("%s", rom::c_source(*loaded.mesh[i], name, true).c_str());
        bodies += (i ? ", &" : "&") + name;
    }
    std::printf("\nextern const struct scene_rom rom_%s;\n"
                "const struct scene_rom rom_%s = {\"%s\", &ground, {%s}};\n",
                id.c_str(), id.c_str(), argv[1], bodies.c_str());
    return 0;
}

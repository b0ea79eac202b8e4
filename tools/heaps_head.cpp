/* SPDX-License-Identifier: MIT */
/* The scene `head`: Carom's world, and its data for other libraries. */
#include <cmath>

#include "expect.hpp"
#include "heaps.hpp"

extern "C" {
#include "scene.h"
}

namespace
{

using namespace heaps;

constexpr int FPS = 60;

const scene &loaded()
{
    static uint64_t block[SCENE_MESH_BYTES / sizeof(uint64_t)];
    static scene scene;
    static const int once = expect(scene_load(&scene, "head", nullptr, block, sizeof block));

    (void)once;
    return scene;
}

Mesh mesh_of(const carom_mesh &from)
{
    Mesh mesh;

    for (uint32_t v = 0; v < from.raw.vertex_count; v++) {
        std::array<float, 3> at;

        for (size_t k = 0; k < 3; k++) {
            at[k] = static_cast<float>(std::ldexp(from.raw.vertices[v][k], -from.raw.quantum_bits) -
                                       std::ldexp(from.mass.centre.c[k], -22));
        }
        mesh.vertices.push_back(at);
    }
    for (uint32_t f = 0; f < from.raw.face_count; f++) {
        const uint16_t *face = from.raw.faces[f];

        mesh.faces.push_back({face[0], face[1], face[2]});
    }
    return mesh;
}

class Carom : public Heap
{
  public:
    Carom() : block_(SCENE_WORLD_BYTES / sizeof(uint64_t))
    {
        carom_config config = scene_config();

        config.sleep = false;
        expect(carom_world_init(block_.data(), block_.size() * sizeof block_[0], &config, &world_));
        expect(carom_body_add(world_, &loaded().ground));
        body_ = expect(carom_body_add(world_, &loaded().body));
    }
    const char *name() const override
    {
        return "carom";
    }
    void step() override
    {
        troubled_ += expect(carom_world_step(world_)) != CAROM_OK;
    }
    double height(int) const override
    {
        carom_body_state state;

        expect(carom_body_get(world_, body_, &state));
        return std::ldexp(static_cast<double>(state.position.c[2]), -32);
    }
    int troubled() const override
    {
        return troubled_;
    }

  private:
    std::vector<uint64_t> block_;
    carom_world *world_;
    int body_, troubled_ = 0;
};

} // namespace

heaps::Scene heaps::head_scene()
{
    const carom_body_def &body = loaded().body;
    const carom_sym3 &inertia = body.mesh->mass.inertia;
    Scene scene = {mesh_of(*body.mesh),
                   mesh_of(*loaded().ground.mesh),
                   {{}, {1, 0, 0, 0}},
                   {},
                   {},
                   {},
                   std::ldexp(body.friction_q16, -16),
                   std::ldexp(body.restitution_q30, -30)};

    for (int k = 0; k < 3; k++) {
        scene.start.position[k] = std::ldexp(static_cast<double>(body.position.c[k]), -32);
        scene.velocity[k] = FPS * std::ldexp(static_cast<double>(body.velocity.c[k]), -40);
        scene.spin[k] = FPS * std::ldexp(static_cast<double>(body.spin.c[k]), -40);
    }
    for (int k = 0; k < 6; k++) {
        scene.inertia[k] = std::ldexp(inertia.m[k], -inertia.e);
    }
    return scene;
}

heaps::Made heaps::make_carom_head()
{
    return std::make_unique<Carom>();
}

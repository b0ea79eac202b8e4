/* SPDX-License-Identifier: MIT */
/* Carom: a world of boxes over a plane, awake or until all of them sleep. */
#include <cmath>

#include "expect.hpp"
#include "heaps.hpp"
#include "heaps_box.h"

namespace
{

using namespace heaps;

constexpr int ASLEEP_BY = 1200; /* steps */

class Carom : public Heap
{
  public:
    explicit Carom(const std::vector<Start> &boxes, bool sleep = false)
    {
        const auto n = static_cast<uint32_t>(boxes.size());
        const carom_caps caps =
            CAROM_CAPS(n + 1, 16 * n, 24 * n < 4096 ? 24 * n : 4096, 65535, 1, 65535);
        carom_config config = {};
        carom_body_def def = {};

        block_.resize(CAROM_WORLD_BYTES(caps.bodies, caps.pairs, caps.contacts, caps.faces,
                                        caps.entries, caps.candidates) /
                      sizeof block_[0]);
        config.caps = caps;
        config.sleep = sleep;
        config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
        expect(carom_mesh_build(&plane_, &plane_raw, plane_block_, sizeof plane_block_));
        expect(carom_mesh_build(&box_, &box_raw, box_block_, sizeof box_block_));
        expect(carom_world_init(block_.data(), block_.size() * sizeof block_[0], &config, &world_));
        def.mesh = &plane_;
        def.stationary = true;
        def.friction_q16 = static_cast<uint32_t>(FRICTION * 65536);
        expect(carom_body_add(world_, &def));
        def.mesh = &box_;
        def.stationary = false;
        for (const Start &start : boxes) {
            for (int k = 0; k < 3; k++) {
                def.position.c[k] = std::llround(std::ldexp(start.position[k], 32));
            }
            for (int k = 0; k < 4; k++) {
                def.rotation.c[k] =
                    static_cast<int32_t>(std::lround(std::ldexp(start.quaternion[k], 30)));
            }
            expect(carom_body_add(world_, &def));
        }
    }
    const char *name() const override
    {
        return "carom";
    }
    void step() override
    {
        troubled_ += expect(carom_world_step(world_)) != CAROM_OK;
    }
    double height(int box) const override
    {
        carom_body_state state;

        expect(carom_body_get(world_, box + 1, &state));
        return std::ldexp(static_cast<double>(state.position.c[2]), -32);
    }
    int troubled() const override
    {
        return troubled_;
    }
    bool asleep(int box) const
    {
        carom_body_state state;

        expect(carom_body_get(world_, box + 1, &state));
        return state.asleep;
    }

  private:
    std::vector<uint64_t> block_;
    alignas(8) uint8_t plane_block_[CAROM_MESH_BYTES(4, 2)];
    alignas(8) uint8_t box_block_[CAROM_MESH_BYTES(8, 12)];
    carom_mesh plane_, box_;
    carom_world *world_;
    int troubled_ = 0;
};

} // namespace

heaps::Made heaps::make_carom(const std::vector<Start> &boxes)
{
    return std::make_unique<Carom>(boxes);
}

heaps::Made heaps::make_asleep(const std::vector<Start> &boxes)
{
    auto heap = std::make_unique<Carom>(boxes, true);
    int asleep = 0, step = 0;

    while (asleep < static_cast<int>(boxes.size()) && step++ < ASLEEP_BY) {
        heap->step();
        asleep = 0;
        for (int i = 0; i < static_cast<int>(boxes.size()); i++) {
            asleep += heap->asleep(i);
        }
    }
    return step <= ASLEEP_BY ? std::move(heap) : nullptr;
}

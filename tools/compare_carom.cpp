/* SPDX-License-Identifier: MIT */
/* Carom: two bodies of a world, and their interfering faces at the given poses. */

#include "compare.hpp"
#include "expect.hpp"

namespace
{

using namespace compare;

/*
 * Room for all faces: in the worst pose one or two faces of the head cross each face of the ground.
 */
#define CAPS 2, 1, 64, 8192, 1, 1024
constexpr uint32_t PAIRS = 65535;

class Carom : public Contender
{
  public:
    Carom(const Mesh &moving, const Mesh &still) : pairs_(PAIRS)
    {
        carom_config config = {};
        carom_body_def def = {};

        config.caps = CAROM_CAPS(CAPS);
        expect(carom_world_init(block_, sizeof block_, &config, &world_));
        def.mesh = &still.carom;
        def.stationary = true;
        still_ = expect(carom_body_add(world_, &def));
        def.mesh = &moving.carom;
        def.stationary = false;
        def.overlap = CAROM_OVERLAP_PASS; /* poses may cross the ground */
        moving_ = expect(carom_body_add(world_, &def));
    }
    const char *name() const override
    {
        return "carom";
    }
    void place(const Pose &pose) override
    {
        carom_body_state state = pose.state;

        state.overlap = CAROM_OVERLAP_PASS;
        expect(carom_body_set(world_, moving_, &state));
    }
    void query() override
    {
        count_ = carom_query_faces(world_, moving_, still_, pairs_.data(), PAIRS);
    }
    size_t found() const override
    {
        return static_cast<size_t>(expect(count_));
    }
    std::vector<Pair> pairs() const override
    {
        std::vector<Pair> all;

        for (size_t i = 0; i < found(); i++) {
            all.push_back({pairs_[i].a, pairs_[i].b});
        }
        return all;
    }

  private:
    alignas(8) uint8_t block_[CAROM_WORLD_BYTES(CAPS)];
    carom_world *world_;
    int moving_, still_, count_ = 0;
    std::vector<carom_face_pair> pairs_;
};

} // namespace

compare::Made compare::make_carom(const Mesh &moving, const Mesh &still)
{
    return std::make_unique<Carom>(moving, still);
}

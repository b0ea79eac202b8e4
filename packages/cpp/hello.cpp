/* SPDX-License-Identifier: MIT */
/* examples/hello.c in C++. */
#include <stdio.h>
#include "carom.hpp"

using namespace carom::literals;

/* A tetrahedron and a triangle to fall on, counter-clockwise from outside; 256 quanta a metre. */
static const int16_t corners[][3] = {{99, 99, 99}, {99, -99, -99}, {-99, 99, -99}, {-99, -99, 99}};
static const uint16_t sides[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const int16_t far_corners[][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const uint16_t side[][3] = {{0, 1, 2}};

/* bodies, pairs, contacts, faces, entries, candidates */
static carom::World<carom::Caps<2, 1, 16, 16, 32, 64>> world;
static carom::Mesh ground(far_corners, side, carom::Kind::surface);
static carom::Mesh solid(corners, sides);
static constexpr carom::Fps<60> fps;

int main()
{
    if (!ground.built() || !solid.built() ||
        !world.start({fps(0_m_s2, 0_m_s2, -9.81_m_s2), /* sleep */ true}) ||
        !world.add(carom::BodyDef(ground).stationary().friction(0.5_of_1))) {
        return 1;
    }
    const auto body = world.add(carom::BodyDef(solid)
                                    .position({0_m, 0_m, 2_m})
                                    .spin(fps(0.9_rad_s, 0_rad_s, 0_rad_s))
                                    .friction(0.5_of_1));
    if (!body) {
        return 1;
    }
    for (int frame = 1; world.step(); frame++) {
        const auto state = body->state();

        if (frame % 10 == 0) {
            printf("frame %2d: %4d mm up\n", frame, static_cast<int>(state->position().z / 1_mm));
        }
        if (state->asleep()) {
            break;
        }
    }
    return 0;
}

/* SPDX-License-Identifier: MIT */
/*
 * Tests of carom.hpp: literals have the bits of carom_fix.h's macros, hello's world ends in the
 * hash of the C program, and a body, a joint and a query behave as their units say.
 */
#define main hello
#include "hello.cpp"
#undef main

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

using namespace carom;

#define SAME(cpp, c) static_assert((cpp).raw() == (c), "not the bits of the C macro")
SAME(Length(2_m), CAROM_POSITION_M(2));
SAME(Length(1.5_m), CAROM_POSITION_MM(1500));
SAME(Length(-1.234_m), CAROM_POSITION_MM(-1234));
SAME(Length(4'095.999_m), CAROM_POSITION_MM(4095999));
SAME(Length::times(-1234, 1_mm), CAROM_POSITION_MM(-1234));
SAME(fps(0.9_rad_s), CAROM_SPIN_MRAD_S(900, 60));
SAME(fps(-9.81_m_s2), CAROM_GRAVITY_MM_S2(-9810, 60));
SAME(fps(-9810_mm_s2), CAROM_GRAVITY_MM_S2(-9810, 60));
SAME(Fps<50>::times(-9810, 1_mm_s2), CAROM_GRAVITY_MM_S2(-9810, 50));
SAME(fps(3.7_m_s), CAROM_VELOCITY_MM_S(3700, 60));
SAME(fps(-90_deg_s), CAROM_SPIN_DEG_S(-90, 60));
SAME(fps(360_deg_s), CAROM_SPIN_DEG_S(360, 60));
SAME(Part(0.707_of_1), CAROM_RATIO(707, 1000, 30));
SAME(Mass(2.5_kg), CAROM_MASS_G(2500));
SAME(Mass(70_g), CAROM_MASS_G(70));
SAME(fps(1.25_N), CAROM_FORCE_MN(1250, 60));
SAME(fps(1.25_N_s), CAROM_IMPULSE_MN_S(1250, 60));
SAME(fps(1.25_N_m), CAROM_TORQUE_MN_M(1250, 60));
SAME(fps(1.25_N_m_s), CAROM_TWIST_MN_M_S(1250, 60));
SAME(Friction(0.5_of_1), 1 << 15);
SAME(Restitution(1_of_1), CAROM_ONE_Q30);
SAME(0.5_m_frame, int64_t(1) << 39);
static_assert(Length(-0.5_mm) / 1_mm == -1 && Length(2_m) / 3_mm == 666, "rounded down");

static void check(bool held, const char *what)
{
    if (!held) {
        fprintf(stderr, "failed: %s\n", what);
        exit(1);
    }
}
#define CHECK(condition) check((condition) ? true : false, #condition)

static World<Caps<4, 8, 64, 64, 0, 256, 1, 4, 4>> free_world;
static uint8_t snapshot[4096];

static bool near(int64_t raw, int64_t wanted, int64_t off)
{
    return raw > wanted - off && raw < wanted + off;
}

/* Without gravity: velocities show the effect of pushes, forces and a motor. */
static void test_free()
{
    CHECK(!free_world.step() && free_world.step().code() == CAROM_ERR_NULL);
    CHECK(free_world.start({}));
    const auto body = free_world.add(BodyDef(solid).position({0_m, 0_m, 9_m}).mass(2_kg));
    const auto led = free_world.add(BodyDef(solid).position({5_m, 0_m, 9_m}).kinematic());
    const auto turned = free_world.add(BodyDef(solid).position({-5_m, 0_m, 9_m}).mass(1_kg));

    CHECK(body && led && turned && led->number() == 1);
    const auto hinge =
        free_world.add(JointDef::hinge(*turned, {-5_m, 0_m, 9_m}, {0_of_1, 0_of_1, 1_of_1},
                                       HingeDrive().motor(fps(2_rad_s), fps(50_N_m))));
    CHECK(hinge);
    CHECK(body->push(fps(4_N_s, 0_N_s, 0_N_s)));
    CHECK(near(body->state()->velocity().x.raw(), CAROM_VELOCITY_M_S(2, 60), 1 << 16));
    CHECK(body->force(fps(0_N, 6_N, 0_N)));
    CHECK(led->move_to({5_m, 0.5_m, 9_m}));
    CHECK(free_world.step());
    CHECK(near(body->state()->velocity().y.raw(), CAROM_VELOCITY_MM_S(50, 60), 1 << 16));
    CHECK(led->state()->position().y == Length(0.5_m));
    CHECK(near(turned->state()->spin().z.raw(), CAROM_SPIN_MRAD_S(2000, 60), 1 << 24));

    const auto hit = free_world.cast_ray({5_m, 0.5_m, 20_m}, {0_m, 0_m, -20_m});
    CHECK(hit.code() == 1 && hit->body == led->number());
    CHECK(free_world.cast_ray({5_m, 5_m, 20_m}, {0_m, 0_m, -20_m}).code() == 0);

    const auto saved = free_world.save(snapshot, sizeof snapshot);
    const uint64_t hash = free_world.hash();
    CHECK(saved && free_world.step() && free_world.hash() != hash);
    CHECK(free_world.load(snapshot, static_cast<size_t>(saved.code())));
    CHECK(free_world.hash() == hash);

    State moved = *body->state();
    CHECK(body->set(moved.position({1_m, 1_m, 1_m})));
    CHECK(body->state()->position().x == Length(1_m));
    CHECK(hinge->remove() && !hinge->state() && body->remove() && !body->state());
    CHECK(!free_world.add(BodyDef(solid).position({5_m, 0.5_m, 9_m})));
    CHECK(!body->mass(1_kg) && body->mass(1_kg).code() == CAROM_ERR_BODY);
}

/* hello's world: its last events, and its hash. */
static void test_hello()
{
    CHECK(hello() == 0);
    bool rested = false;
    for (const carom_event &event : world.events()) {
        rested = rested || (event.kind == CAROM_EVENT_REST && event.a == 1);
    }
    CHECK(rested);
    fprintf(stderr, "hash %016" PRIx64 "\n", world.hash());
}

int main()
{
    CHECK(!Mesh(corners, side).built() &&
          Mesh(corners, side).built().code() == CAROM_ERR_MESH_OPEN);
    test_free();
    test_hello();
    return 0;
}

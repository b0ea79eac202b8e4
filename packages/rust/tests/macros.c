/* SPDX-License-Identifier: MIT */
/* Prints the macros that src/macros.rs has in Rust, with the same arguments in the same order, and the sizes of structs. */
#include <inttypes.h>
#include <stdio.h>
#include "carom_body.h"
#include "carom_debug.h"
#include "carom_joint.h"
#include "carom_query.h"

#define SAY(value)       printf("%" PRId64 "\n", (int64_t)(value))
#define SAY_SIZE(struct) printf(#struct " %zu %zu\n", sizeof(struct), _Alignof(struct))
#define COUNT(list)      (sizeof(list) / sizeof *(list))

static void say_meshes(void)
{
    static const uint32_t counts[] = {3, 4, 8, 32, 33, 100, 940, 1876, 20000, 65535};

    for (size_t v = 0; v < COUNT(counts); v++) {
        for (size_t f = 0; f < COUNT(counts); f++) {
            SAY(CAROM_MESH_BYTES(counts[v], counts[f]));
            SAY(CAROM_SURFACE_BYTES(counts[v], counts[f]));
            SAY(CAROM_BLOB_BYTES(counts[v], counts[f]));
            SAY(CAROM_DRAW_BYTES(counts[v], counts[f]));
            SAY(CAROM_DRAW_BYTES_LEAST(counts[v], counts[f]));
        }
    }
}

/* All worlds whose nine capacities each have one of two values. */
static void say_worlds(void)
{
    static const uint32_t few[] = {1, 1, 1, 1, 0, 1, 0, 0, 0};
    static const uint32_t many[] = {100, 333, 77, 1000, 64, 2047, 9, 15, 21};

    for (int choice = 0; choice < 512; choice++) {
        uint32_t n[9];

        for (int i = 0; i < 9; i++) {
            n[i] = choice >> i & 1 ? many[i] : few[i];
        }
        SAY(CAROM_WORLD_BYTES(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]));
    }
}

static void say_units(void)
{
    static const int numbers[] = {0, 1, -1, 90, -359, 9810, -9810, 1234567};
    static const int rates[] = {1, 25, 60, 1000};

    for (size_t i = 0; i < COUNT(numbers); i++) {
        SAY(CAROM_POSITION_MM(numbers[i]));
        for (size_t k = 0; k < COUNT(rates); k++) {
            SAY(CAROM_VELOCITY_MM_S(numbers[i], rates[k]));
            SAY(CAROM_SPIN_MRAD_S(numbers[i], rates[k]));
            SAY(CAROM_SPIN_DEG_S(numbers[i], rates[k]));
            SAY(CAROM_GRAVITY_MM_S2(numbers[i], rates[k]));
            SAY(CAROM_FORCE_MN(numbers[i], rates[k]));
            SAY(CAROM_IMPULSE_MN_S(numbers[i], rates[k]));
        }
    }
    for (int small = -110; small <= 110; small += 11) {
        SAY(CAROM_ANGLE_MRAD(small * 10));
        SAY(CAROM_ANGLE_DEG(small));
        SAY(CAROM_RATIO(small, 7, 30));
    }
    SAY(CAROM_MASS_G(70));
    SAY(CAROM_MASS_G(1000000));
}

int main(void)
{
    say_meshes();
    say_worlds();
    say_units();
    SAY_SIZE(struct carom_mesh);
    SAY_SIZE(struct carom_config);
    SAY_SIZE(struct carom_body_def);
    SAY_SIZE(struct carom_body_state);
    SAY_SIZE(struct carom_event);
    SAY_SIZE(struct carom_contact);
    SAY_SIZE(struct carom_touch);
    SAY_SIZE(struct carom_stats);
    SAY_SIZE(struct carom_usage);
    SAY_SIZE(struct carom_joint_def);
    SAY_SIZE(struct carom_joint_state);
    SAY_SIZE(struct carom_ray_hit);
    SAY_SIZE(struct carom_mesh_hit);
    SAY_SIZE(struct carom_cast_workspace);
    SAY_SIZE(struct carom_closest);
    SAY_SIZE(struct carom_material);
    SAY_SIZE(struct carom_forces);
    SAY_SIZE(struct carom_picture);
    SAY_SIZE(struct carom_debug);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Small worlds of shapes at random places, for the tests of queries between steps. */
#include <string.h>

#include "asked.h"
#include "real.h"

#define CAPS ASKED_BODIES, 15, 64, 256, 64, 64

static _Alignas(8) uint8_t block[ASKED_WORLDS][CAROM_WORLD_BYTES(CAPS)];

const carom_quat_q30 upright = {{CAROM_ONE_Q30, 0, 0, 0}};

struct carom_world *asked_world(int number)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                        .gravity = {{0, 0, -((int64_t)1 << 31)}}};
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block[number], sizeof block[number], &config, &world), CAROM_OK);
    return world;
}

int asked_add(struct carom_world *world, const struct carom_mesh *mesh, bool moving, int64_t x,
              int64_t y, int64_t z, carom_quat_q30 turn)
{
    struct carom_body_def def;

    memset(&def, 0, sizeof def);
    def.mesh = mesh;
    def.overlap = CAROM_OVERLAP_PASS; /* bodies may overlap */
    def.stationary = !moving || mesh->raw.kind == CAROM_SURFACE;
    def.position = (carom_v3_q32){{x, y, z}};
    def.rotation = turn;
    def.restitution_q30 = CAROM_ONE_Q30 / 2;
    return carom_body_add(world, &def);
}

void asked_place(const struct carom_mesh *mesh, const carom_v3_q32 *position,
                 const carom_quat_q30 *rotation, double out[][3])
{
    double w = rotation->c[0], x = rotation->c[1], y = rotation->c[2], z = rotation->c[3];
    double n = w * w + x * x + y * y + z * z;
    double m[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};

    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        carom_v3_q22 p = mesh_vertex(mesh, v);

        for (int k = 0; k < 3; k++) {
            out[v][k] = real(position->c[k], 32);
            for (int i = 0; i < 3; i++) {
                out[v][k] += m[k][i] / n * real(p.c[i], 22);
            }
        }
    }
}

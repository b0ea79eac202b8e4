/* SPDX-License-Identifier: MIT */
/*
 * host_rays - 1,000,000 rays against the field of 3034 faces, the head and other meshes, turned at
 * random. For each ray, as the engine rounds it to the mesh's axes, the test finds the first face
 * in 128-bit arithmetic by trying every face. Its method is not the engine's: it takes the sign of
 * the volume that the ray spans with each edge, and compares distances as cross-multiplied
 * fractions. In double precision it measures how far the rounded ray is from the given one.
 *
 *   host_rays.elf [rays]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "query/query.h"
#include "scene.h"
#include "lib/shapes.h"

__extension__ typedef __int128 wide;

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(1, 1, 1, 1, 0, 1)];
static struct shape shapes[3];
static struct scene scene;
static unsigned long tried, met, wrong, off;
static double worst;

/* ------------------------------------------------------------------ exact */

/* A point of the rounded ray at z = 0, and the direction, in 2^-30 quanta by the mesh's axes. */
static void line(const struct query_ray *ray, int64_t at[3], int64_t way[3])
{
    at[ray->axis[2]] = 0;
    way[ray->axis[2]] = CAROM_ONE_Q30;
    for (int i = 0; i < 2; i++) {
        at[ray->axis[i]] = ray->at_q30[i];
        way[ray->axis[i]] = ray->slope_q30[i];
    }
}

/*
 * The sign of way . ((a - at) x (b - at)). When that is 0, the sign for a ray moved along one of
 * its two other axes, then along the other one. Moving `at` by e changes the volume by -way . (e x
 * (b - a)).
 */
static int volume(const struct query_ray *ray, const int64_t at[3], const int64_t way[3],
                  const int16_t *a, const int16_t *b)
{
    int64_t p[3];
    wide sum = 0;

    for (int k = 0; k < 3; k++) {
        p[k] = a[k] * (int64_t)CAROM_ONE_Q30 - at[k];
    }
    /* (a - at) x (b - a) is below 2^68, with the way 2^100 */
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        sum += ((wide)p[i] * (b[j] - a[j]) - (wide)p[j] * (b[i] - a[i])) * way[k];
    }
    if (sum != 0) {
        return sum > 0 ? 1 : -1;
    }
    for (int axis = 0; axis < 2; axis++) {
        int64_t e[3] = {0, 0, 0};
        wide change = 0;

        e[ray->axis[axis]] = 1;
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;

            change -= way[k] * ((wide)e[i] * (b[j] - a[j]) - (wide)e[j] * (b[i] - a[i]));
        }
        if (change != 0) {
            return change > 0 ? 1 : -1;
        }
    }
    return 0;
}

/* floor of n / d */
static wide floor_of(wide n, wide d)
{
    wide q = n / d;

    return q - ((n % d != 0) && ((n < 0) != (d < 0)));
}

/* The first face, by trying all; distances are rounded as query.h says. */
static long first_of_all(const struct query_ray *ray, int64_t *best_way)
{
    const struct carom_mesh_raw *raw = &ray->mesh->raw;
    int64_t at[3], way[3];
    long best = -1;

    line(ray, at, way);
    for (uint32_t f = 0; f < raw->face_count; f++) {
        const int16_t *p[3];
        int64_t n[3], z;
        wide above = 0, below = 0;
        int side;

        for (int k = 0; k < 3; k++) {
            p[k] = raw->vertices[raw->faces[f][k]];
        }
        side = volume(ray, at, way, p[0], p[1]);
        if (side == 0 || volume(ray, at, way, p[1], p[2]) != side ||
            volume(ray, at, way, p[2], p[0]) != side) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;

            n[k] = (int64_t)(p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) -
                   (int64_t)(p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
        }
        for (int k = 0; k < 3; k++) {
            above += (wide)n[k] * (p[0][k] * (int64_t)CAROM_ONE_Q30 - at[k]);
            below += (wide)n[k] * way[k];
        }
        /* a face that is seen from outside points against the ray */
        if (!ray->back && (below > 0) == ray->up) {
            continue;
        }
        z = (int64_t)floor_of(above * ((wide)1 << (32 - raw->quantum_bits)), below);
        z = ray->up ? z - ray->start_q32 : ray->start_q32 - z;
        if (z >= 0 && z <= ray->length_q32 && (best < 0 || z < *best_way)) {
            best = (long)f;
            *best_way = z;
        }
    }
    return best;
}

/* ----------------------------------------------------------------- doubles */

/* The distance between the rounded ray and the given one at both ends of the mesh's box, units. */
static double error_of(const struct query_ray *carried, const struct carom_ray *ray,
                       const struct body_state *state)
{
    const struct carom_mesh *mesh = carried->mesh;
    double w = state->rotation.c[0], x = state->rotation.c[1], y = state->rotation.c[2],
           z = state->rotation.c[3], n = w * w + x * x + y * y + z * z;
    double m[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    double from[3], way[3], most = 0;
    int axis = carried->axis[2];

    for (int k = 0; k < 3; k++) {
        from[k] = way[k] = 0;
        for (int i = 0; i < 3; i++) {
            from[k] += m[i][k] / n * (double)(ray->from.c[i] - state->position.c[i]) / 4294967296.0;
            way[k] += m[i][k] / n * (double)ray->way.c[i] / 4294967296.0;
        }
        from[k] += mesh->mass.centre.c[k] / 4194304.0;
    }
    for (int end = 0; end < 2; end++) {
        double at = ldexp(mesh->box[end][axis], -mesh->raw.quantum_bits);
        double t = (at - from[axis]) / way[axis];

        /* nothing is asked beyond the ray's ends */
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        at = from[axis] + t * way[axis];
        for (int i = 0; i < 2; i++) {
            double here =
                (double)carried->at_q30[i] / 1073741824.0 * ldexp(1, -mesh->raw.quantum_bits) +
                carried->slope_q30[i] / 1073741824.0 * at;
            double there = from[carried->axis[i]] + t * way[carried->axis[i]];

            most = fabs(here - there) > most ? fabs(here - there) : most;
        }
    }
    return most;
}

/* -------------------------------------------------------------------- rays */

static struct carom_ray random_ray(struct test_random *r, int64_t size, const struct body_state *s)
{
    struct carom_ray ray;
    int special = (int)test_random_range(r, 0, 15), axis = (int)test_random_range(r, 0, 2);
    int64_t far = special >= 12 ? 512 : 4;

    for (int k = 0; k < 3; k++) {
        int64_t to = test_random_range(r, -size, size);

        ray.from.c[k] = test_random_range(r, -far * size, far * size);
        if (special >= 4 && special < 10 && k == 2) {
            ray.from.c[k] = test_random_range(r, 0, far * size);
        }
        ray.way.c[k] = (to - ray.from.c[k]) * (special == 10 ? 2 : 1);
        if ((special == 0 && k != axis) || (special == 1 && k == axis)) {
            ray.way.c[k] = 0;
            ray.from.c[k] = to;
        }
        if (special == 2 && k != axis) {
            ray.way.c[k] >>= 24;
            ray.from.c[k] = to;
        }
        if (special == 3) {
            ray.from.c[k] = carom_shl(ray.from.c[k] >> 26, 26);
            ray.way.c[k] = carom_shl(ray.way.c[k] >> 26, 26);
        }
        ray.from.c[k] += s->position.c[k];
    }
    if ((ray.way.c[0] | ray.way.c[1] | ray.way.c[2]) >> 12 == 0) {
        ray.way.c[axis] = size;
    }
    return ray;
}

static void try_ray(struct carom_world *world, struct test_random *r, int64_t size)
{
    const struct body_state *state = &world_now(world)->bodies[0];
    struct carom_ray ray = random_ray(r, size, state);
    const struct carom_query_filter filter = {
        .flags = (uint16_t)(test_random_next(r) % 4 == 0 ? CAROM_QUERY_BACK : 0)};
    struct query_ray carried;
    struct carom_ray_hit hit;
    int found = carom_cast_ray(world, &ray, &filter, &hit);
    int64_t way = 0;
    long face = -1;

    tried++;
    if (query_carry(&carried, &ray, &world->bodies[0], state)) {
        double error = error_of(&carried, &ray, state);
        double reach = ldexp((double)fix_length(ray.way.c), -32) +
                       ldexp((double)world->bodies[0].def.radius_q22, -22);

        carried.back = filter.flags != 0;
        face = first_of_all(&carried, &way);
        error /= reach > 8 ? reach / 8 : 1;
        worst = error > worst ? error : worst;
        off += error > 0x1p-25;
    }
    met += face >= 0;
    if (found != (face >= 0) || (found && hit.face != face)) {
        if (wrong++ < 5) {
            printf("# ray %lu: %d, face %d, against face %ld\n", tried, found,
                   found ? hit.face : -1, face);
        }
    }
}

int main(int argc, char **argv)
{
    static _Alignas(8) uint8_t memory[SCENE_MESH_BYTES];
    unsigned long rays = argc > 1 ? strtoul(argv[1], NULL, 10) : 30000;
    const struct carom_config config = {.caps = CAROM_CAPS(1, 1, 1, 1, 0, 1)};
    struct test_random r = {1};
    struct carom_world *world = NULL;
    const struct carom_mesh *mesh[5];

    if (scene_load(&scene, "head", NULL, memory, sizeof memory) != CAROM_OK) {
        return 2;
    }
    shape_ball(&shapes[0], 20, 32000);
    shape_box(&shapes[1], 7, 32766, 20000, 9000);
    shape_field(&shapes[2], 9, 24, 170, 900, 3);
    mesh[0] = scene.ground.mesh;
    mesh[1] = scene.body.mesh;
    for (int i = 0; i < 3; i++) {
        mesh[2 + i] = &shapes[i].mesh;
    }
    for (unsigned long n = 0; n < rays; n++) {
        if (n % 100 == 0) {
            struct carom_body_def def;

            memset(&def, 0, sizeof def);
            def.mesh = mesh[n / 100 % 10 > 4 ? 0 : n / 100 % 5];
            def.overlap = CAROM_OVERLAP_PASS; /* bodies may overlap */
            def.stationary = true;
            if (n / 100 % 3) {
                def.rotation = shape_random_turn(&r);
            }
            for (int k = 0; k < 3; k++) {
                def.position.c[k] = test_random_range(&r, -(INT64_C(1) << 44), INT64_C(1) << 44);
            }
            if (carom_world_init(block, sizeof block, &config, &world) != CAROM_OK ||
                carom_body_add(world, &def) != 0) {
                return 2;
            }
        }
        /* towards places within 3/4 of the radius along each axis; the farthest rays begin 12,000
         * units away */
        try_ray(world, &r,
                ((int64_t)world->bodies[0].def.radius_q22 << 10) * 3 / 4 < (INT64_C(24) << 32)
                    ? ((int64_t)world->bodies[0].def.radius_q22 << 10) * 3 / 4
                    : INT64_C(24) << 32);
    }
    printf("# %lu rays, %lu met; the carried ray is off by 2^%.1f units at most over 8 units\n",
           tried, met, log2(worst));
    printf("%s 1 - rays/every_face (%lu wrong)\n", wrong ? "not ok" : "ok", wrong);
    printf("%s 2 - rays/carried (%lu off)\n", off ? "not ok" : "ok", off);
    printf("1..2\n");
    return wrong || off;
}

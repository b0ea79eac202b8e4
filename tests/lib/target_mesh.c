/* SPDX-License-Identifier: MIT */
/* Meshes of a fuzzer: shapes of any numbers, meshes of tests with corners and faces changed, and blobs of them. */
#include <stdlib.h>
#include <string.h>

#include "bytes.h"
#include "carom_shapes.h"
#include "edits.h"
#include "target.h"

enum { VERTICES = 64, FACES = 120 };

static struct fuzz fuzz;
static int16_t vertices[VERTICES][3];
static uint16_t faces[FACES][3];

static int32_t any(int bits)
{
    return (int32_t)(uint32_t)fuzz_number(&fuzz, bits);
}

/* A shape, or what it is refused with; `raw` is written only when it is made. */
static int make_shape(struct carom_mesh_raw *raw)
{
    const struct carom_shape_room room = {vertices, faces, (uint32_t)fuzz_pick(&fuzz, VERTICES + 1),
                                          FACES, (uint8_t)(fuzz_pick(&fuzz, 16) + 6)};
    const uint32_t sides = (uint32_t)(fuzz_pick(&fuzz, 9) ? fuzz_pick(&fuzz, 14) : any(8));
    const int32_t half[3] = {any(13), any(13), any(13)};

    switch (fuzz_pick(&fuzz, 5)) {
    case 0:
        return carom_shape_box(raw, &room, half);
    case 1:
        return carom_shape_sphere(raw, &room, half[0], sides);
    case 2:
        return carom_shape_capsule(raw, &room, half[0], half[1], sides);
    case 3:
        return carom_shape_cylinder(raw, &room, half[0], half[1], sides);
    default:
        return carom_shape_cone(raw, &room, half[0], half[1], sides);
    }
}

/* A mesh of the tests with a few numbers changed. */
static void make_changed(struct carom_mesh_raw *raw)
{
    static const struct carom_mesh_raw *const known[] = {&lab_box, &lab_tetrahedron, &lab_l,
                                                         &lab_plate, &lab_sheet};

    *raw = *known[fuzz_pick(&fuzz, 5)];
    memcpy(vertices, raw->vertices, raw->vertex_count * sizeof *vertices);
    memcpy(faces, raw->faces, raw->face_count * sizeof *faces);
    raw->vertices = (const int16_t(*)[3])vertices;
    raw->faces = (const uint16_t(*)[3])faces;
    raw->quantum_bits = (uint8_t)(fuzz_pick(&fuzz, 4) ? 12 : fuzz_pick(&fuzz, 24));
    raw->kind = (uint8_t)(fuzz_pick(&fuzz, 8) ? raw->kind : fuzz_pick(&fuzz, 3));
    for (int n = fuzz_pick(&fuzz, 8); n > 0; n--) {
        const uint32_t v = (uint32_t)fuzz_pick(&fuzz, (int)raw->vertex_count);
        const int k = fuzz_pick(&fuzz, 3);

        vertices[v][k] =
            (int16_t)(fuzz_pick(&fuzz, 2) ? any(14) : vertices[v][k] + fuzz_pick(&fuzz, 9) - 4);
    }
    if (fuzz_pick(&fuzz, 4) == 0) {
        const uint32_t face = (uint32_t)fuzz_pick(&fuzz, (int)raw->face_count);
        const int k = fuzz_pick(&fuzz, 3);

        faces[face][k] = (uint16_t)fuzz_pick(&fuzz, (int)raw->vertex_count + 2);
    }
    raw->face_count -= fuzz_pick(&fuzz, 9) ? 0 : (uint32_t)fuzz_pick(&fuzz, (int)raw->face_count);
}

/* The blob of a mesh, changed, with its sum corrected; it is read into `raw`. */
static int make_blob(struct carom_mesh_raw *raw)
{
    static uint8_t blob[EDIT_BLOB_BYTES(VERTICES, FACES)];
    static _Alignas(8) uint8_t room[CAROM_BLOB_BYTES(VERTICES, FACES)];
    size_t size;

    make_changed(raw);
    size = edit_write_blob(raw, blob);
    if (fuzz_pick(&fuzz, 3) == 0) {
        edit_bytes(&fuzz.chance, blob, fuzz_pick(&fuzz, 2) ? 16 : size);
    }
    size -= fuzz_pick(&fuzz, 8) ? 0 : (size_t)fuzz_pick(&fuzz, (int)size);
    bytes_mend(blob, size);
    return carom_mesh_read(raw, blob, size, room, sizeof room);
}

/* A body of the mesh among others: it steps, and answers a ray. */
static void use(const struct carom_mesh *mesh)
{
    struct carom_body_def def;
    struct carom_ray_hit hit;
    struct carom_ray ray;
    const char *fault;
    int result;

    fuzz_body_def(&fuzz, &def);
    def.mesh = mesh;
    def.stationary |= mesh->raw.kind == CAROM_SURFACE;
    (void)carom_body_add(fuzz.world, &def);
    fuzz_vector(&fuzz, ray.from.c, 34);
    fuzz_vector(&fuzz, ray.way.c, 35);
    (void)carom_cast_ray(fuzz.world, &ray, NULL, &hit);
    for (int i = 0; i < 2; i++) {
        fault = fuzz_try_step(fuzz.world, &result);
        target_expect(fault, result);
    }
}

void target_mesh(const uint8_t *bytes, size_t count)
{
    struct carom_mesh_raw raw;
    struct carom_mesh mesh;
    bool moves;
    size_t size;
    void *mem;
    int result = CAROM_OK;

    fuzz_begin_bytes(&fuzz, bytes, count);
    switch (fuzz_pick(&fuzz, 3)) {
    case 0:
        result = make_shape(&raw);
        break;
    case 1:
        result = make_blob(&raw);
        break;
    default:
        make_changed(&raw);
        break;
    }
    if (result < 0) {
        return;
    }
    moves = raw.kind == CAROM_SURFACE && fuzz_pick(&fuzz, 2);
    size = moves ? CAROM_SURFACE_BYTES(raw.vertex_count, raw.face_count)
                 : CAROM_MESH_BYTES(raw.vertex_count, raw.face_count);
    mem = lab_need(size); /* no byte more, so that one written beyond is seen */
    result = moves ? carom_surface_build(&mesh, &raw, mem, size)
                   : carom_mesh_build(&mesh, &raw, mem, size);
    if (result >= 0) {
        use(&mesh);
    }
    free(mem);
}

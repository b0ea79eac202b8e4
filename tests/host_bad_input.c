/* SPDX-License-Identifier: MIT */
/*
 * host_bad_input - bad input to a running world. Each call is refused with the error that says what
 * is wrong, nothing is written, and the world goes on exactly like one that never saw any of the
 * calls.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/lab.h"
#include "num/fnv.h"

enum { FRAMES_BEFORE = 60, FRAMES_AFTER = 60 };

/* The name of the current test, and its failures. */
static struct {
    struct carom_world *world;
    uint64_t hash;
    int calls, wrong;
} now;

static void begin(struct carom_world *world)
{
    now.world = world;
    now.hash = carom_world_hash(world);
    now.calls = now.wrong = 0;
}

static void end(const char *name)
{
    lab_report(now.wrong == 0 && now.calls > 0, name, "%d calls", now.calls);
}

static void check(bool ok, const char *call, int line, int result)
{
    now.calls++;
    if (!ok) {
        now.wrong++;
        printf("# %s:%d: %s: %d, %s\n", __FILE__, line, call, result, carom_result_text(result));
    }
}

/* Check that the call gives the error and that the world keeps its hash. */
#define REFUSED(call, error) refused((call), (error), #call, __LINE__)
static void refused(int result, int error, const char *call, int line)
{
    check(result == error && carom_world_hash(now.world) == now.hash, call, line, result);
}

/* ---------------------------------------------------------------------- NULL */

static void test_null(struct lab *lab)
{
    struct carom_world *w = lab->world, *none;
    struct carom_body_def def = lab->scene.ground;
    struct carom_body_state state;
    struct carom_usage usage[CAROM_POOL_COUNT];
    struct carom_stats stats;
    const struct carom_event *events;
    const struct carom_face_ref *faces;
    struct carom_contact contact;
    static _Alignas(8) uint8_t bytes[4096];

    begin(w);
    carom_body_get(w, SCENE_BODY, &state);
    REFUSED(carom_world_init(NULL, sizeof bytes, &lab->config, &none), CAROM_ERR_NULL);
    REFUSED(carom_world_init(bytes, sizeof bytes, NULL, &none), CAROM_ERR_NULL);
    REFUSED(carom_world_init(bytes, sizeof bytes, &lab->config, NULL), CAROM_ERR_NULL);
    REFUSED(carom_body_add(NULL, &def), CAROM_ERR_NULL);
    REFUSED(carom_body_add(w, NULL), CAROM_ERR_NULL);
    def.mesh = NULL;
    REFUSED(carom_body_add(w, &def), CAROM_ERR_NULL);
    REFUSED(carom_body_remove(NULL, 0), CAROM_ERR_NULL);
    REFUSED(carom_body_get(NULL, 0, &state), CAROM_ERR_NULL);
    REFUSED(carom_body_get(w, 0, NULL), CAROM_ERR_NULL);
    REFUSED(carom_body_set(NULL, 0, &state), CAROM_ERR_NULL);
    REFUSED(carom_body_set(w, 0, NULL), CAROM_ERR_NULL);
    REFUSED(carom_world_step(NULL), CAROM_ERR_NULL);
    REFUSED(carom_events(NULL, &events), CAROM_ERR_NULL);
    REFUSED(carom_events(w, NULL), CAROM_ERR_NULL);
    REFUSED(carom_interfering_faces(NULL, &faces), CAROM_ERR_NULL);
    REFUSED(carom_interfering_faces(w, NULL), CAROM_ERR_NULL);
    REFUSED(carom_contacts(NULL, &contact, 1), CAROM_ERR_NULL);
    REFUSED(carom_contacts(w, NULL, 1), CAROM_ERR_NULL);
    REFUSED(carom_stats(NULL, &stats), CAROM_ERR_NULL);
    REFUSED(carom_stats(w, NULL), CAROM_ERR_NULL);
    REFUSED(carom_usage(NULL, usage), CAROM_ERR_NULL);
    REFUSED(carom_usage(w, NULL), CAROM_ERR_NULL);
    REFUSED(carom_snapshot_size(NULL), CAROM_ERR_NULL);
    REFUSED(carom_snapshot_save(NULL, bytes, sizeof bytes), CAROM_ERR_NULL);
    REFUSED(carom_snapshot_save(w, NULL, sizeof bytes), CAROM_ERR_NULL);
    REFUSED(carom_snapshot_load(NULL, bytes, sizeof bytes), CAROM_ERR_NULL);
    REFUSED(carom_snapshot_load(w, NULL, sizeof bytes), CAROM_ERR_NULL);
    check(carom_world_hash(NULL) == 0, "carom_world_hash(NULL)", __LINE__, 0);
    end("bad_input/null");
}

static void test_null_drawing(struct lab *lab)
{
    static uint32_t pixels[16 * 16];
    static _Alignas(8) uint8_t rows[CAROM_DRAW_BYTES(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES)];
    struct carom_picture bad, picture = {.pixels = pixels,
                                         .width = 16,
                                         .height = 16,
                                         .stride = 64,
                                         .format = CAROM_XRGB8888,
                                         .workspace = rows,
                                         .workspace_bytes = sizeof rows};
    const struct carom_camera *camera = lab->scene.camera;
    struct carom_camera inside = *camera;
    struct carom_world *w = lab->world;
    bool untouched = true;

    inside.target = inside.eye;
    begin(w);
    REFUSED(carom_draw(NULL, camera, &picture, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    REFUSED(carom_draw(w, NULL, &picture, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    REFUSED(carom_draw(w, camera, NULL, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    bad = picture;
    bad.pixels = NULL;
    REFUSED(carom_draw(w, camera, &bad, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    bad = picture;
    bad.workspace = NULL;
    REFUSED(carom_draw(w, camera, &bad, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    bad = picture;
    bad.width = 0;
    REFUSED(carom_draw(w, camera, &bad, CAROM_DRAW_FLAT), CAROM_ERR_ARGUMENT);
    bad = picture;
    bad.workspace_bytes = CAROM_DRAW_BYTES_LEAST(0, 0) / 2;
    REFUSED(carom_draw(w, camera, &bad, CAROM_DRAW_FLAT), CAROM_ERR_MEMORY);
    REFUSED(carom_draw(w, &inside, &picture, CAROM_DRAW_FLAT), CAROM_ERR_ARGUMENT);
    for (int i = 0; i < 16 * 16; i++) {
        untouched = untouched && pixels[i] == 0;
    }
    check(untouched, "no pixel is written", __LINE__, 0);
    end("bad_input/drawing");
}

/* --------------------------------------------------------------------- bodies */

static void test_bodies(struct lab *lab)
{
    const struct carom_body_def good = lab->scene.ground;
    struct carom_world *w = lab->world;
    struct carom_body_def def;

#define REFUSED_WITH(field, value, error)                                                          \
    def = good;                                                                                    \
    def.field = (value);                                                                           \
    REFUSED(carom_body_add(w, &def), (error))

    begin(w);
    REFUSED_WITH(restitution_q30, -1, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(restitution_q30, CAROM_ONE_Q30 + 1, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(friction_q16, CAROM_MU_MAX_Q16 + 1, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(rotation.c[0], CAROM_ONE_Q30 / 2, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(rotation.c[3], INT32_MIN, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(position.c[0], ((int64_t)4096 << 32) + 1, CAROM_ERR_RANGE);
    REFUSED_WITH(position.c[1], INT64_MIN, CAROM_ERR_RANGE);
    REFUSED_WITH(stationary, false, CAROM_ERR_ARGUMENT); /* a SURFACE is not allowed to move */
    def = good;
    REFUSED(carom_body_add(w, &def), CAROM_ERR_BODIES_FULL);
    REFUSED(carom_body_remove(w, -1), CAROM_ERR_BODY);
    REFUSED(carom_body_remove(w, 2), CAROM_ERR_BODY);
    REFUSED(carom_body_remove(w, INT32_MAX), CAROM_ERR_BODY);
    end("bad_input/bodies");
}

/* Mass and speed limits of a moving body, in a world that has none. */
static void test_moving(const struct lab *lab)
{
    struct lab *other = lab_load_scene("box");
    const struct carom_body_def good = lab->scene.body;
    struct carom_world *w;
    struct carom_body_def def;

    lab_start(other);
    w = other->world;
    carom_body_remove(w, SCENE_BODY);
    begin(w);
    REFUSED_WITH(mass_q20, (1 << 10) - 1, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(mass_q20, (1 << 30) + 1, CAROM_ERR_ARGUMENT);
    REFUSED_WITH(velocity.c[2], (int64_t)64 << 40, CAROM_ERR_RANGE);
    REFUSED_WITH(velocity.c[1], INT64_MIN, CAROM_ERR_RANGE);
    REFUSED_WITH(spin.c[0], -((int64_t)64 << 40), CAROM_ERR_RANGE);
    REFUSED_WITH(spin.c[0], INT64_MIN, CAROM_ERR_RANGE);
    end("bad_input/moving");
    lab_free(other);
}

static void test_states(struct lab *lab)
{
    struct carom_world *w = lab->world;
    struct carom_body_state good, state;

#define NOT_SET(field, value, error)                                                               \
    state = good;                                                                                  \
    state.field = (value);                                                                         \
    REFUSED(carom_body_set(w, SCENE_BODY, &state), (error))

    begin(w);
    carom_body_get(w, SCENE_BODY, &good);
    REFUSED(carom_body_get(w, -1, &state), CAROM_ERR_BODY);
    REFUSED(carom_body_get(w, 2, &state), CAROM_ERR_BODY);
    REFUSED(carom_body_set(w, 2, &good), CAROM_ERR_BODY);
    NOT_SET(rotation.c[0], INT32_MAX, CAROM_ERR_ARGUMENT);
    NOT_SET(position.c[2], INT64_MAX, CAROM_ERR_RANGE);
    NOT_SET(velocity.c[0], (int64_t)64 << 40, CAROM_ERR_RANGE);
    NOT_SET(spin.c[1], -((int64_t)64 << 40), CAROM_ERR_RANGE);
    /* each component is in range, their length is not */
    state = good;
    state.velocity.c[0] = state.velocity.c[1] = (int64_t)50 << 40;
    REFUSED(carom_body_set(w, SCENE_BODY, &state), CAROM_ERR_RANGE);
    end("bad_input/states");
}

/* Forces and pushes. Body SCENE_GROUND is static. */
static void test_forces(struct lab *lab)
{
    const int64_t much = ((int64_t)1 << 40) + 1, extreme[2] = {INT64_MIN, INT64_MAX};
    const carom_v3_q40 none = {{0, 0, 0}}, too_much = {{0, 0, much}};
    const carom_v3_q32 origin = {{0, 0, 0}}, beyond = {{0, ((int64_t)4096 << 32) + 1, 0}};
    struct carom_world *w = lab->world;

    begin(w);
    REFUSED(carom_world_set_gravity(NULL, &none), CAROM_ERR_NULL);
    REFUSED(carom_world_set_gravity(w, NULL), CAROM_ERR_NULL);
    REFUSED(carom_world_set_gravity(w, &too_much), CAROM_ERR_RANGE);
    REFUSED(carom_body_set_force(NULL, SCENE_BODY, &none), CAROM_ERR_NULL);
    REFUSED(carom_body_set_force(w, SCENE_BODY, NULL), CAROM_ERR_NULL);
    REFUSED(carom_body_set_force(w, SCENE_GROUND, &none), CAROM_ERR_ARGUMENT);
    REFUSED(carom_body_set_force(w, -1, &none), CAROM_ERR_BODY);
    REFUSED(carom_body_set_force(w, 2, &none), CAROM_ERR_BODY);
    REFUSED(carom_body_set_force(w, SCENE_BODY, &too_much), CAROM_ERR_RANGE);
    REFUSED(carom_body_push(NULL, SCENE_BODY, &none, &origin), CAROM_ERR_NULL);
    REFUSED(carom_body_push(w, SCENE_BODY, NULL, &origin), CAROM_ERR_NULL);
    REFUSED(carom_body_push(w, SCENE_BODY, &none, NULL), CAROM_ERR_NULL);
    REFUSED(carom_body_push(w, SCENE_GROUND, &none, &origin), CAROM_ERR_ARGUMENT);
    REFUSED(carom_body_push(w, INT32_MAX, &none, &origin), CAROM_ERR_BODY);
    REFUSED(carom_body_push(w, SCENE_BODY, &none, &beyond), CAROM_ERR_RANGE);
    for (int i = 0; i < 6; i++) {
        carom_v3_q40 v = none;
        carom_v3_q32 point = origin;

        v.c[i / 2] = extreme[i % 2];
        point.c[i / 2] = extreme[i % 2];
        REFUSED(carom_world_set_gravity(w, &v), CAROM_ERR_RANGE);
        REFUSED(carom_body_set_force(w, SCENE_BODY, &v), CAROM_ERR_RANGE);
        REFUSED(carom_body_push(w, SCENE_BODY, &v, &origin), CAROM_ERR_RANGE);
        REFUSED(carom_body_push(w, SCENE_BODY, &none, &point), CAROM_ERR_RANGE);
    }
    end("bad_input/forces");
}

/* --------------------------------------------------------------------- worlds */

static void test_init(struct lab *lab)
{
    enum { BYTES = CAROM_WORLD_BYTES(SCENE_CAPS) };
    static _Alignas(8) uint8_t block[BYTES + 8];
    const struct carom_config good = scene_config();
    struct carom_config config = good;
    struct carom_world *untouched = NULL, *world = NULL;

#define NO_WORLD(field, value, error)                                                              \
    config = good;                                                                                 \
    config.field = (value);                                                                        \
    REFUSED(carom_world_init(block, sizeof block, &config, &world), (error))

    begin(lab->world);
    REFUSED(carom_world_init(block, BYTES - 1, &good, &world), CAROM_ERR_MEMORY);
    REFUSED(carom_world_init(block + 4, BYTES, &good, &world), CAROM_ERR_MEMORY);
    NO_WORLD(caps.bodies, 0, CAROM_ERR_ARGUMENT);
    NO_WORLD(caps.pairs, 0, CAROM_ERR_ARGUMENT);
    NO_WORLD(caps.contacts, 4097, CAROM_ERR_ARGUMENT);
    NO_WORLD(caps.faces, 65536, CAROM_ERR_ARGUMENT);
    NO_WORLD(caps.entries, 65536, CAROM_ERR_ARGUMENT);
    NO_WORLD(caps.candidates, UINT32_MAX, CAROM_ERR_ARGUMENT);
    NO_WORLD(gravity.c[2], ((int64_t)1 << 40) + 1, CAROM_ERR_RANGE);
    check(world == untouched, "no world comes out", __LINE__, 0);
    check(carom_world_init(block, BYTES, &good, &world) == CAROM_OK, "enough bytes", __LINE__, 0);
    end("bad_input/init");
}

static void test_snapshots(struct lab *lab)
{
    static uint8_t bytes[4096], altered[4096];
    struct carom_world *w = lab->world;
    int size = carom_snapshot_save(w, bytes, sizeof bytes);

    begin(w);
    check(size > 0 && size == carom_snapshot_size(w), "size", __LINE__, size);
    REFUSED(carom_snapshot_save(w, altered, (size_t)size - 1), CAROM_ERR_MEMORY);
    for (int k = 0; k < size; k++) {
        REFUSED(carom_snapshot_load(w, bytes, (size_t)k), CAROM_ERR_FORMAT);
        memcpy(altered, bytes, (size_t)size);
        altered[k] ^= 0x10;
        REFUSED(carom_snapshot_load(w, altered, (size_t)size), CAROM_ERR_FORMAT);
    }
    REFUSED(carom_snapshot_load(w, bytes, (size_t)size + 1), CAROM_ERR_FORMAT);
    /* the whole snapshot is a copy of the world */
    REFUSED(carom_snapshot_load(w, bytes, (size_t)size), CAROM_OK);
    end("bad_input/snapshots");
}

/* --------------------------------------------------------------------- meshes */

#define BLOCK_BYTES CAROM_MESH_BYTES(64, 64)
static _Alignas(8) uint8_t block[BLOCK_BYTES + 8];

/* Check that carom_mesh_build and carom_mesh_check give the error and make no mesh. */
#define NO_MESH(raw, error) no_mesh((raw), (error), __LINE__)
static void no_mesh(const struct carom_mesh_raw *raw, int error, int line)
{
    struct carom_mesh mesh, before;
    int result;

    memset(&mesh, 0x5a, sizeof mesh);
    before = mesh;
    result = carom_mesh_build(&mesh, raw, block, BLOCK_BYTES);
    refused(result, error, "carom_mesh_build", line);
    check(memcmp(&mesh, &before, sizeof mesh) == 0, "the mesh is not written", line, result);
    refused(carom_mesh_check(raw, block, BLOCK_BYTES), error, "carom_mesh_check", line);
}

static void test_meshes(struct lab *lab)
{
    static int16_t vertices[8][3];
    static uint16_t faces[13][3];
    struct carom_mesh_raw raw;

#define START()                                                                                    \
    raw = lab_box;                                                                                 \
    memcpy(vertices, lab_box.vertices, sizeof vertices);                                           \
    memcpy(faces, lab_box.faces, 12 * sizeof faces[0]);                                            \
    raw.vertices = (const int16_t(*)[3])vertices;                                                  \
    raw.faces = (const uint16_t(*)[3])faces

    begin(lab->world);
    START();
    raw.face_count = 11;
    NO_MESH(&raw, CAROM_ERR_MESH_OPEN);
    START();
    for (int f = 0; f < 12; f++) {
        faces[f][1] = lab_box.faces[f][2];
        faces[f][2] = lab_box.faces[f][1];
    }
    NO_MESH(&raw, CAROM_ERR_MESH_INSIDE_OUT);
    START();
    raw.face_count = 0;
    NO_MESH(&raw, CAROM_ERR_MESH_EMPTY);
    START();
    raw.vertex_count = 70000;
    NO_MESH(&raw, CAROM_ERR_MESH_SIZE);
    START();
    raw.face_count = 65536;
    NO_MESH(&raw, CAROM_ERR_MESH_SIZE);
    START();
    faces[7][2] = 8;
    NO_MESH(&raw, CAROM_ERR_MESH_INDEX);
    START();
    faces[7][2] = faces[7][1];
    NO_MESH(&raw, CAROM_ERR_MESH_INDEX);
    START();
    memcpy(vertices[1], vertices[0], sizeof vertices[0]);
    NO_MESH(&raw, CAROM_ERR_MESH_DEGENERATE);
    START();
    memcpy(faces[12], faces[0], sizeof faces[0]);
    raw.face_count = 13;
    NO_MESH(&raw, CAROM_ERR_MESH_EDGE);
    START();
    raw.kind = CAROM_SURFACE;
    NO_MESH(&raw, CAROM_ERR_MESH_SURFACE);
    START();
    raw.kind = 2;
    NO_MESH(&raw, CAROM_ERR_ARGUMENT);
    START();
    raw.quantum_bits = 21;
    NO_MESH(&raw, CAROM_ERR_ARGUMENT);
    START();
    raw.quantum_bits = 6;
    NO_MESH(&raw, CAROM_ERR_ARGUMENT);
    START();
    raw.vertices = NULL;
    NO_MESH(&raw, CAROM_ERR_NULL);
    START();
    raw.faces = NULL;
    NO_MESH(&raw, CAROM_ERR_NULL);
    NO_MESH(NULL, CAROM_ERR_NULL);
    end("bad_input/meshes");
}

static void test_mesh_memory(struct lab *lab)
{
    struct carom_mesh mesh;
    const size_t enough = CAROM_MESH_BYTES(8, 12);

    begin(lab->world);
    REFUSED(carom_mesh_build(NULL, &lab_box, block, BLOCK_BYTES), CAROM_ERR_NULL);
    REFUSED(carom_mesh_build(&mesh, &lab_box, NULL, BLOCK_BYTES), CAROM_ERR_NULL);
    REFUSED(carom_mesh_check(&lab_box, NULL, BLOCK_BYTES), CAROM_ERR_NULL);
    REFUSED(carom_mesh_build(&mesh, &lab_box, block, enough - 1), CAROM_ERR_MEMORY);
    REFUSED(carom_mesh_check(&lab_box, block, enough - 1), CAROM_ERR_MEMORY);
    REFUSED(carom_mesh_build(&mesh, &lab_box, block + 1, enough), CAROM_ERR_MEMORY);
    REFUSED(carom_mesh_build(&mesh, &lab_box, block, enough), CAROM_OK);
    end("bad_input/mesh_memory");
}

/* The box in the format that the converter writes (src/mesh/blob.c). Returns its bytes. */
static size_t write_blob(uint8_t *out)
{
    const uint8_t header[16] = {'C', 'R', 'M', '1', 1, CAROM_SOLID, 12, 0, 8, 0, 0, 0, 12, 0, 0, 0};
    uint64_t fnv = FNV_START;
    size_t n = sizeof header;

    memcpy(out, header, n);
    for (int i = 0; i < 8 * 3 + 12 * 3; i++) {
        uint16_t word =
            i < 24 ? (uint16_t)lab_box.vertices[i / 3][i % 3] : lab_box.faces[(i - 24) / 3][i % 3];

        out[n++] = (uint8_t)word;
        out[n++] = (uint8_t)(word >> 8);
    }
    for (size_t i = 0; i < n; i++) {
        fnv = fnv_add(fnv, out[i]);
    }
    for (int i = 0; i < 8; i++) {
        out[n++] = (uint8_t)(fnv >> (8 * i));
    }
    return n;
}

static void test_blobs(struct lab *lab)
{
    static uint8_t blob[256];
    static _Alignas(8) uint8_t memory[CAROM_BLOB_BYTES(8, 12)];
    struct carom_mesh_raw raw;
    struct carom_mesh mesh;
    size_t bytes = write_blob(blob);

    begin(lab->world);
    REFUSED(carom_mesh_read(NULL, blob, bytes, memory, sizeof memory), CAROM_ERR_NULL);
    REFUSED(carom_mesh_read(&raw, NULL, bytes, memory, sizeof memory), CAROM_ERR_NULL);
    REFUSED(carom_mesh_read(&raw, blob, bytes, NULL, sizeof memory), CAROM_ERR_NULL);
    REFUSED(carom_mesh_read(&raw, blob, bytes, memory, sizeof memory - 1), CAROM_ERR_MEMORY);
    for (size_t k = 0; k < bytes; k++) {
        REFUSED(carom_mesh_read(&raw, blob, k, memory, sizeof memory), CAROM_ERR_FORMAT);
        blob[k] ^= 1;
        REFUSED(carom_mesh_read(&raw, blob, bytes, memory, sizeof memory), CAROM_ERR_FORMAT);
        blob[k] ^= 1;
    }
    REFUSED(carom_mesh_read(&raw, blob, bytes, memory, sizeof memory), CAROM_OK);
    REFUSED(carom_mesh_build(&mesh, &raw, block, BLOCK_BYTES), CAROM_OK);
    check(mesh.mass.volume_q32 == lab->scene.body.mesh->mass.volume_q32, "the same volume",
          __LINE__, 0);
    end("bad_input/blobs");
}

/* ------------------------------------------------------------------------ run */

static struct lab *load(void)
{
    static const struct carom_camera camera = {.eye = {{0, -((int64_t)5 << 32), 0}},
                                               .focal_q16 = 1 << 16};
    struct lab *lab = lab_load(&lab_sheet, &lab_box);

    lab->scene.camera = &camera;
    lab->scene.body.position.c[2] = lab_fixed(1, 32);
    lab->scene.body.rotation = lab_turn(1, 2, 3, 1);
    lab_start(lab);
    for (int frame = 0; frame < FRAMES_BEFORE; frame++) {
        lab_step(lab, NULL);
    }
    return lab;
}

int main(void)
{
    struct lab *lab = load(), *spared = load();
    struct lab_tally tally = {0};
    bool same = true;

    test_null(lab);
    test_null_drawing(lab);
    test_bodies(lab);
    test_moving(lab);
    test_states(lab);
    test_forces(lab);
    test_init(lab);
    test_snapshots(lab);
    test_meshes(lab);
    test_mesh_memory(lab);
    test_blobs(lab);
    for (int frame = 0; frame < FRAMES_AFTER; frame++) {
        lab_step(lab, &tally);
        lab_step(spared, NULL);
        same = same && carom_world_hash(lab->world) == carom_world_hash(spared->world);
    }
    lab_report(same && tally.touching > 0, "bad_input/goes_on",
               "%d frames like the world that was spared", FRAMES_AFTER);
    lab_free(lab);
    lab_free(spared);
    return lab_finish();
}

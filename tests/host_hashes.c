/* SPDX-License-Identifier: MIT */
/*
 * State hashes on the way through six scenes. test_hashes.sh builds this with other compilers and
 * options and for the boards, and compares every line that starts with "# hash".
 *
 * Each scene runs twice, the second time in memory full of rubbish: the same hashes must come out.
 */
#include <string.h>

#include "lab.h"
#include "port.h"

#define EVERY 50 /* frames from one line to the next */
#define LINES 64

static struct carom_mesh meshes[2];
static _Alignas(8) uint8_t mesh_block[SCENE_MESH_BYTES];
static _Alignas(8) uint8_t world_block[SCENE_WORLD_BYTES];
static unsigned count, failed;

/* A body over a ground, built where the scenes of scene.h are. */
static int load(struct scene *scene, const struct carom_mesh_raw *ground,
                const struct carom_mesh_raw *body)
{
    const size_t bytes = CAROM_MESH_BYTES(ground->vertex_count, ground->face_count);
    int result;

    memset(scene, 0, sizeof *scene);
    scene->ground.mesh = &meshes[0];
    scene->ground.stationary = true;
    scene->body.mesh = &meshes[1];
    result = carom_mesh_build(&meshes[0], ground, mesh_block, bytes);
    if (result >= 0) {
        result = carom_mesh_build(&meshes[1], body, mesh_block + bytes, sizeof mesh_block - bytes);
    }
    return result;
}

static void set_surface(struct scene *scene, int32_t e_q30, uint32_t mu_q16)
{
    scene->ground.restitution_q30 = scene->body.restitution_q30 = e_q30;
    scene->ground.friction_q16 = scene->body.friction_q16 = mu_q16;
}

/* ---------------------------------------------------------------------- scenes */

/* The paper's head on its field, until it sleeps. */
static int load_head(struct scene *scene)
{
    return scene_load(scene, "head", NULL, mesh_block, sizeof mesh_block);
}

/* A box that bounces for ever. */
static int load_bounce(struct scene *scene)
{
    int result = load(scene, &lab_sheet, &lab_box);

    set_surface(scene, CAROM_ONE_Q30, 0);
    scene->body.position.c[2] = CAROM_POSITION_MM(3000);
    scene->body.rotation = (carom_quat_q30){{858993459, 644245094, 0, 0}}; /* 4/5, 3/5 */
    scene->body.spin.c[0] = CAROM_SPIN_MRAD_S(1300, 60);
    scene->body.spin.c[1] = CAROM_SPIN_MRAD_S(-700, 60);
    scene->body.spin.c[2] = CAROM_SPIN_MRAD_S(1100, 60);
    return result;
}

/* A box that slides down a slope: half the angle has the tangent 1/6, so it is 19 degrees. */
static int load_ramp(struct scene *scene)
{
    int result = load(scene, &lab_sheet, &lab_box);
    const carom_quat_q30 tilt = {{1059163177, 0, 176527196, 0}}; /* 6 and 1 over sqrt 37 */

    set_surface(scene, CAROM_ONE_Q30 / 2, 3 << 12);
    scene->ground.rotation = scene->body.rotation = tilt;
    scene->body.position.c[2] = CAROM_POSITION_MM(180);
    return result;
}

/* An L that tumbles down the same slope and comes to rest. */
static int load_l(struct scene *scene)
{
    int result = load(scene, &lab_sheet, &lab_l);

    set_surface(scene, CAROM_ONE_Q30 / 2, 1 << 15);
    scene->ground.rotation = (carom_quat_q30){{1059163177, 0, 176527196, 0}};
    scene->body.position.c[2] = CAROM_POSITION_MM(2500);
    scene->body.rotation = (carom_quat_q30){{644245094, 0, 858993459, 0}};
    scene->body.spin.c[0] = CAROM_SPIN_MRAD_S(2300, 60);
    scene->body.spin.c[2] = CAROM_SPIN_MRAD_S(-1900, 60);
    return result;
}

/* Sixteen bodies poured on the field, until they sleep. */
static int load_pile(struct scene *scene)
{
    return scene_load(scene, "pile", NULL, mesh_block, sizeof mesh_block);
}

/* A box on a sheet that waves. */
static int load_sheet(struct scene *scene)
{
    return scene_load(scene, "sheet", NULL, mesh_block, sizeof mesh_block);
}

/* ------------------------------------------------------------------------- run */

/* The hashes of one run, a line each; returns how many, or an error. */
static int run(int (*loaded)(struct scene *), int frames, int rubbish, uint64_t hashes[LINES])
{
    static struct scene scene;
    struct carom_config config = scene_config();
    struct carom_world *world;
    int result, lines = 0;

    memset(mesh_block, rubbish, sizeof mesh_block);
    memset(world_block, rubbish, sizeof world_block);
    result = loaded(&scene);
    if (result >= 0) {
        result = scene_make(&scene, &config, world_block, sizeof world_block, &world);
    }
    for (int frame = 1; frame <= frames && result >= 0; frame++) {
        result = scene_before(&scene, world, frame);
        if (result >= 0) {
            result = carom_world_step(world);
        }
        if (frame % EVERY == 0) {
            hashes[lines++] = carom_world_hash(world);
        }
    }
    return result < 0 ? result : lines;
}

static void test(const char *name, int (*loaded)(struct scene *), int frames)
{
    static uint64_t first[LINES], second[LINES];
    int lines = run(loaded, frames, 0, first), again = run(loaded, frames, 0xa5, second);
    bool ok = lines == frames / EVERY && again == lines;

    for (int i = 0; i < lines; i++) {
        /* in two halves: the small printf of newlib has no 64-bit formats */
        port_print("# hash %s %d %08lx%08lx\n", name, (i + 1) * EVERY,
                   (unsigned long)(first[i] >> 32), (unsigned long)(first[i] & 0xffffffff));
        ok = ok && first[i] == second[i];
    }
    /* at least while things move, no two states are the same */
    ok = ok && first[0] != first[1];
    count++;
    failed += !ok;
    port_print("%s %u - hashes/%s (%d frames, twice: %s)\n", ok ? "ok" : "not ok", count, name,
               frames,
               carom_result_text(lines < 0   ? lines
                                 : again < 0 ? again
                                             : CAROM_OK));
}

int main(void)
{
    port_init();
    test("head", load_head, 600);
    test("bounce", load_bounce, 2000);
    test("ramp", load_ramp, 300);
    test("l", load_l, 400);
    test("pile", load_pile, 300);
    test("sheet", load_sheet, 600);
    port_print("1..%u\n", count);
    port_exit(failed != 0);
}

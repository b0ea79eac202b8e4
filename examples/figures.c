/* SPDX-License-Identifier: MIT */
/*
 * The paper's figure 6: a body where it first meets the ground, just before the solve of the
 * impact. The faces that went to the collision test are coloured. Three pictures: the scene, a
 * close view, and a view from below.
 *
 * Options: scene=NAME (of scene.h)  pictures=DIRECTORY
 */
#include <string.h>

#include "carom_draw.h"
#include "port.h"
#include "scene.h"
#include "show.h"

enum { FRAMES_MOST = 600, SHADOWS = 1 << 17, WHOLE_Q16 = 1 << 16 };

static _Alignas(8) uint8_t mesh_block[SCENE_MESH_BYTES], world_block[SCENE_WORLD_BYTES];
static _Alignas(8) uint8_t
    draw_block[SHADOWS + CAROM_DRAW_BYTES(SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES,
                                          SCENE_HEAD_FACES + SCENE_FIELD_FACES)];

static int expect(int result, const char *what)
{
    if (result < 0) {
        port_print("%s: %s\n", what, carom_result_text(result));
        port_exit(1);
    }
    return result;
}

/* By body number: the ramp of each face; 0 is the default one. */
static uint8_t ramps[2][SCENE_FIELD_FACES];

/* True if the body hits something in one more step. */
static bool hits(struct carom_world *world)
{
    struct carom_stats stats;

    expect(carom_world_step(world), "step");
    expect(carom_stats(world, &stats), "stats");
    return stats.hits > 0;
}

/* Step to the end of the frame of the first hit; `before` gets the state of the body where that frame began. */
static void find_hit(struct carom_world *world, struct carom_body_state *before)
{
    int frame = 0;

    do {
        frame++;
        if (frame > FRAMES_MOST) {
            port_print("it hits nothing\n");
            port_exit(1);
        }
        expect(carom_body_get(world, SCENE_BODY, before), "state");
    } while (!hits(world));
    port_print("first %d\n", frame);
}

/* Note the ramps of the faces that interfered in the last step, and print how many each body has. */
static void note_faces(const struct carom_world *world)
{
    const struct carom_face_ref *faces;
    int count[2] = {0, 0};
    int found = expect(carom_interfering_faces(world, &faces), "faces");

    for (int i = 0; i < found; i++) {
        uint16_t body = faces[i].body;

        ramps[body][faces[i].face] =
            body == SCENE_BODY ? CAROM_RAMP_MOVING_HOT : CAROM_RAMP_STATIONARY_HOT;
        count[body]++;
    }
    port_print("interfering %d %d\n", count[SCENE_BODY], count[SCENE_GROUND]);
}

/* True if the body hits something on the first part of its way through a frame. */
static bool hits_within(struct carom_world *world, const struct carom_body_state *before,
                        int64_t part_q16)
{
    struct carom_body_state state = *before;

    for (int k = 0; k < 3; k++) {
        state.velocity.c[k] = before->velocity.c[k] * part_q16 / WHOLE_Q16;
        state.spin.c[k] = before->spin.c[k] * part_q16 / WHOLE_Q16;
    }
    expect(carom_body_set(world, SCENE_BODY, &state), "place");
    return hits(world);
}

/* Move the body as far as it goes without a hit. That is the world's last step. */
static void stop_before_hit(struct carom_world *world, const struct carom_body_state *before)
{
    const carom_v3_q40 none = {{0, 0, 0}};
    int64_t part_q16 = 0;

    expect(carom_world_set_gravity(world, &none), "gravity");
    for (int64_t bit = WHOLE_Q16 / 2; bit; bit /= 2) {
        part_q16 += hits_within(world, before, part_q16 + bit) ? 0 : bit;
    }
    hits_within(world, before, part_q16);
}

/*
 * The scene's own paint, with two ramps of its palette for interfering faces. A game uses every ramp, so its faces keep
 * theirs.
 */
static const struct carom_paint *paint_of(const struct show *show)
{
    static uint32_t palette[256];
    static struct carom_body_paint bodies[] = {{.faces = ramps[0]}, {.faces = ramps[1]}};
    static struct carom_paint paint;

    paint = *show_paint(show);
    paint.hide_interfering = true;
    if (!show->game) {
        memcpy(palette, paint.palette, sizeof palette);
        carom_draw_ramp(&palette[CAROM_RAMP_STATIONARY_HOT * CAROM_RAMP_SHADES], 0xff0070);
        carom_draw_ramp(&palette[CAROM_RAMP_MOVING_HOT * CAROM_RAMP_SHADES], 0xff6000);
        paint.palette = palette;
        paint.bodies = bodies;
        paint.body_count = 2;
    }
    return &paint;
}

static void picture(const struct carom_world *world, const struct carom_camera *camera,
                    const struct carom_paint *paint)
{
    const struct port_fb fb = port_fb();
    const struct carom_picture picture = {.pixels = fb.pixels,
                                          .width = fb.width,
                                          .height = fb.height,
                                          .stride = fb.stride,
                                          .format = fb.format,
                                          .workspace = draw_block,
                                          .workspace_bytes = sizeof draw_block,
                                          .paint = paint};

    expect(carom_draw(world, camera, &picture, CAROM_DRAW_FLAT), "draw");
    port_present();
}

/*
 * A close view of the place where the body touches: from the side to which it leans, or from below
 * if the ground hides nothing there.
 */
static struct carom_camera close_by(const struct carom_camera *camera, const carom_v3_q32 *body,
                                    const carom_v3_q32 *point, bool under)
{
    struct carom_camera close = {.target = *point, .focal_q16 = camera->focal_q16};

    for (int k = 0; k < 3; k++) {
        int64_t from_scene = (camera->eye.c[k] - camera->target.c[k]) / 8;
        int64_t aside = k < 2 ? 3 * (point->c[k] - body->c[k]) : 0;

        close.eye.c[k] = point->c[k] + (under ? from_scene : from_scene + aside);
    }
    if (under) {
        close.eye.c[2] = point->c[2] - CAROM_POSITION_MM(900);
    }
    return close;
}

int main(void)
{
    static struct scene scene;
    const char *name = port_option("scene") ? port_option("scene") : "head";
    const struct carom_config config = scene_config();
    struct carom_contact contact;
    struct carom_body_state before;
    struct carom_camera close;
    struct carom_world *world;
    struct show show;

    port_init();
    expect(scene_load(&scene, name, NULL, mesh_block, sizeof mesh_block), name);
    expect(scene_make(&scene, &config, world_block, sizeof world_block, &world), "world");
    port_print("faces %lu %lu\n", (unsigned long)scene.body.mesh->raw.face_count,
               (unsigned long)scene.ground.mesh->raw.face_count);
    show = show_of(&scene);
    find_hit(world, &before);
    note_faces(world);
    expect(carom_contacts(world, &contact, 1) > 0 ? CAROM_OK : CAROM_ERR_ARGUMENT, "contacts");
    stop_before_hit(world, &before);
    picture(world, scene.camera, paint_of(&show));
    for (int under = 0; under < 2; under++) {
        close = close_by(scene.camera, &before.position, &contact.point, under);
        picture(world, &close, paint_of(&show));
    }
    port_exit(0);
}

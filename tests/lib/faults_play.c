/* SPDX-License-Identifier: MIT */
/*
 * Full pools: a small world that makes every call that can meet one. Boxes lie on a surface that moves; two pass each other; a
 * kinematic one comes by; others hang together, or hover where only a surface that rises far comes near them.
 */
#include <stdlib.h>

#include "box.h"
#include "carom_body.h"
#include "carom_joint.h"
#include "faults.h"
#include "lab.h"

enum { SIDE = 4, CORNERS = (SIDE + 1) * (SIDE + 1), SQUARES = SIDE * SIDE };
/* Bodies of the play, in the order in which they come. */
enum { GROUND, FIRST, SECOND, GHOST, LED, LINKED, WALL, FAR };

struct faults_play {
    struct carom_world *world;
    void *block;
    struct carom_mesh box, ground;
    _Alignas(8) uint8_t box_block[CAROM_MESH_BYTES(8, 12)];
    _Alignas(8) uint8_t ground_block[CAROM_SURFACE_BYTES(CORNERS, 2 * SQUARES)];
    int16_t corners[CORNERS][3];
    uint16_t faces[2 * SQUARES][3];
    int joint;
};

static const int16_t box_vertices[8][3] = BOX_CORNERS(2048, 1229, 614);
static const struct carom_mesh_raw box_raw = {box_vertices, box_faces, 8, 12, 12, CAROM_SOLID};

/* Heights of the ground, which lifts by so many quanta in the middle. */
static void shape_ground(struct faults_play *p, int lift)
{
    for (int v = 0; v < CORNERS; v++) {
        int x = v % (SIDE + 1) - SIDE / 2, y = v / (SIDE + 1) - SIDE / 2;

        p->corners[v][0] = (int16_t)(x * 1024);
        p->corners[v][1] = (int16_t)(y * 1024);
        p->corners[v][2] = (int16_t)(abs(x) + abs(y) < 2 ? lift : 0);
    }
}

static void make_ground(struct faults_play *p)
{
    const struct carom_mesh_raw raw = {(const int16_t(*)[3])p->corners,
                                       (const uint16_t(*)[3])p->faces,
                                       CORNERS,
                                       2 * SQUARES,
                                       8,
                                       CAROM_SURFACE};

    shape_ground(p, 0);
    for (int i = 0; i < SQUARES; i++) {
        int low = i / SIDE * (SIDE + 1) + i % SIDE, high = low + SIDE + 1;
        const int corner[2][3] = {{low, low + 1, high + 1}, {low, high + 1, high}};

        for (int k = 0; k < 6; k++) {
            p->faces[2 * i + k / 3][k % 3] = (uint16_t)corner[k / 3][k % 3];
        }
    }
    lab_expect(carom_surface_build(&p->ground, &raw, p->ground_block, sizeof p->ground_block),
               "ground");
}

static struct carom_body_def def_of(const struct faults_play *p, double x, double y, double z)
{
    return (struct carom_body_def){
        .mesh = &p->box,
        .friction_q16 = 1 << 15,
        .position = {{lab_fixed(x, 32), lab_fixed(y, 32), lab_fixed(z, 32)}}};
}

/* ---------------------------------------------------------------------- calls */

static int add_ground(struct faults_play *p)
{
    const struct carom_body_def def = {
        .mesh = &p->ground, .stationary = true, .friction_q16 = 1 << 15};

    return carom_body_add(p->world, &def);
}

static int add_first(struct faults_play *p)
{
    const struct carom_body_def def = def_of(p, 0, 0, 0.3);

    return carom_body_add(p->world, &def);
}

static int add_second(struct faults_play *p)
{
    const struct carom_body_def def = def_of(p, 0.3, 0.1, 0.8);

    return carom_body_add(p->world, &def);
}

/* Inside the first one, which it passes. */
static int add_ghost(struct faults_play *p)
{
    struct carom_body_def def = def_of(p, 0.2, 0.1, 0.35);

    def.overlap = CAROM_OVERLAP_PASS;
    return carom_body_add(p->world, &def);
}

static int add_led(struct faults_play *p)
{
    struct carom_body_def def = def_of(p, -3, 0, 0.4);

    def.kinematic = true;
    def.velocity.c[0] = lab_fixed(0.05, 40);
    return carom_body_add(p->world, &def);
}

static int add_linked(struct faults_play *p)
{
    struct carom_body_def def = def_of(p, 2, 0, 1.2);

    def.filter = (struct carom_filter){2, 2, 0};
    return carom_body_add(p->world, &def);
}

/* It overlaps the linked one, which it may not touch. */
static int add_wall(struct faults_play *p)
{
    struct carom_body_def def = def_of(p, 2.2, 0.2, 1.25);

    def.filter = (struct carom_filter){4, 4, 0};
    return carom_body_add(p->world, &def);
}

static int add_far(struct faults_play *p)
{
    const struct carom_body_def def = def_of(p, 2, 2.5, 0.3);

    return carom_body_add(p->world, &def);
}

/* One more that hovers: places in a ring. */
static int add_hovering(struct faults_play *p)
{
    int n = carom_body_count(p->world) - FAR;
    const struct carom_body_def def = def_of(p, 1.6 * (n % 3) - 1.6, n < 4 ? -2.2 : 2.2, 2.5);

    return carom_body_add(p->world, &def);
}

static int let_hover(struct faults_play *p)
{
    return carom_body_set_gravity_scale(p->world, carom_body_count(p->world) - 1, 0);
}

static int set_far(struct faults_play *p)
{
    struct carom_body_state state = lab_state(p->world, FAR);

    /* over the second one, which it passes */
    state.position = (carom_v3_q32){{lab_fixed(0.35, 32), lab_fixed(0.2, 32), lab_fixed(0.9, 32)}};
    state.overlap = CAROM_OVERLAP_PASS;
    return carom_body_set(p->world, FAR, &state);
}

static int meet_wall(struct faults_play *p)
{
    const struct carom_filter filter = {2, 6, 0};

    return carom_body_set_filter(p->world, LINKED, &filter);
}
static int meet_linked(struct faults_play *p)
{
    const struct carom_filter filter = {4, 6, 0};

    return carom_body_set_filter(p->world, WALL, &filter);
}

static int link(struct faults_play *p, int a, int b)
{
    struct carom_joint_def def = {.kind = CAROM_JOINT_BALL, .a = a, .b = b};
    struct carom_body_state state = lab_state(p->world, a);

    def.anchor = state.position;
    return carom_joint_add(p->world, &def);
}

static int link_world(struct faults_play *p)
{
    return link(p, LINKED, CAROM_WORLD);
}

/* The ghost is inside the second one while a joint lets them ignore each other. */
static int link_ghost(struct faults_play *p)
{
    return p->joint = link(p, GHOST, SECOND);
}

static int put_ghost(struct faults_play *p)
{
    struct carom_body_state state = lab_state(p->world, GHOST);
    const struct carom_body_state second = lab_state(p->world, SECOND);

    state.position = second.position;
    state.position.c[0] += lab_fixed(0.1, 32);
    state.overlap = CAROM_OVERLAP_PASS;
    return carom_body_set(p->world, GHOST, &state);
}

static int unlink_ghost(struct faults_play *p)
{
    return carom_joint_remove(p->world, p->joint);
}

static int set_material(struct faults_play *p)
{
    const struct carom_material material = {.friction_q16 = 1 << 14, .rolling_q16 = 1 << 12};

    return carom_body_set_material(p->world, FIRST, &material);
}

static int set_faces(struct faults_play *p)
{
    static const struct carom_material materials[2] = {{.friction_q16 = 1 << 14},
                                                       {.friction_q16 = 1 << 16}};
    static const uint8_t of_face[12] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};

    return carom_body_set_face_materials(p->world, SECOND, materials, 2, of_face);
}

static int set_torque(struct faults_play *p)
{
    const carom_v3_q40 torque = {{0, 0, lab_fixed(1e-4, 40)}};

    return carom_body_set_torque(p->world, GHOST, &torque);
}

static int set_scale(struct faults_play *p)
{
    return carom_body_set_gravity_scale(p->world, LINKED, 1 << 15);
}

static int set_damping(struct faults_play *p)
{
    return carom_body_set_damping(p->world, WALL, 1 << 20, 1 << 20);
}

static int set_force_at(struct faults_play *p)
{
    const carom_v3_q40 force = {{lab_fixed(1e-4, 40), 0, 0}};
    const carom_v3_q32 point = {{0, 0, lab_fixed(1.5, 32)}};

    return carom_body_set_force_at(p->world, FAR, &force, &point);
}

static int move(struct faults_play *p, int lift)
{
    shape_ground(p, lift);
    return carom_surface_move(p->world, GROUND, (const int16_t(*)[3])p->corners);
}

static int raise(struct faults_play *p)
{
    return move(p, 60);
}
static int raise_far(struct faults_play *p)
{
    return move(p, 500);
}
static int sink(struct faults_play *p)
{
    return move(p, 20);
}

static int step(struct faults_play *p)
{
    return carom_world_step(p->world);
}

/* A snapshot of this world into itself: an extra too few shows when it is made. */
static int reload(struct faults_play *p)
{
    static uint8_t bytes[1 << 16];
    int size = lab_expect(carom_snapshot_save(p->world, bytes, sizeof bytes), "snapshot");

    return carom_snapshot_load(p->world, bytes, (size_t)size);
}

/* Pairs of faces: with room for fewer than there are, an error. */
static int query(struct faults_play *p)
{
    static struct carom_face_pair pairs[256];
    int count = carom_query_faces(p->world, SECOND, GHOST, pairs, 256);

    for (int room = 0; room < count; room++) {
        if (carom_query_faces(p->world, SECOND, GHOST, pairs, (uint32_t)room) !=
            CAROM_ERR_FACES_FULL) {
            return CAROM_ERR_ARGUMENT;
        }
    }
    return count;
}

#define STEPS  step, step, step, step, step, step, step, step, step, step
#define HOVERS add_hovering, let_hover, add_hovering, let_hover, add_hovering, let_hover
static int (*const calls[])(struct faults_play *) = {
    add_ground, add_first, add_second,  add_ghost,    add_led,      add_linked,
    add_wall,   add_far,   set_far,     meet_wall,    meet_linked,  link_world,
    link_ghost, put_ghost, query,       unlink_ghost, set_material, set_faces,
    set_torque, set_scale, set_damping, set_force_at, HOVERS,       HOVERS,
    STEPS,      reload,    STEPS,       raise,        step,         raise_far,
    STEPS,      sink,      STEPS,       query,        reload,       STEPS};

/* The first step: extras are given by then, and all bodies are there. */
int faults_play_settled(void)
{
    int i = 0;

    while (calls[i] != step) {
        i++;
    }
    return i;
}

int faults_play_length(void)
{
    return (int)(sizeof calls / sizeof *calls);
}

int faults_play_call(struct faults_play *play, int i)
{
    return calls[i](play);
}

struct faults_play *faults_play_new(const struct carom_caps *caps)
{
    struct faults_play *p = lab_need(sizeof *p);
    struct carom_config config = {.caps = *caps, .sleep = true};
    size_t bytes = carom_world_bytes(caps);
    int result;

    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    p->block = lab_need(bytes + 8);
    lab_expect(carom_mesh_build(&p->box, &box_raw, p->box_block, sizeof p->box_block), "box");
    make_ground(p);
    result = carom_world_init(p->block, bytes, &config, &p->world);
    if (result < 0) {
        faults_play_free(p);
        return NULL;
    }
    return p;
}

void faults_play_free(struct faults_play *play)
{
    free(play->block);
    free(play);
}

struct carom_world *faults_play_world(const struct faults_play *play)
{
    return play->world;
}

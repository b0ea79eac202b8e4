/* SPDX-License-Identifier: MIT */
/* Full pools: the watched calls. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "carom_body.h"
#include "carom_joint.h"
#include "faults.h"
#include "plays.h"

struct faults faults;

enum {
    BODY_ADD,
    BODY_SET,
    SET_FILTER,
    SURFACE_MOVE,
    STEP,
    LOAD,
    SET_MATERIAL,
    SET_FACES,
    SET_FORCE_AT,
    SET_TORQUE,
    SET_SCALE,
    SET_DAMPING,
    JOINT_ADD,
    JOINT_REMOVE,
    QUERY_FACES
};
const char *const faults_names[FAULTS_CALLS] = {"carom_body_add",
                                                "carom_body_set",
                                                "carom_body_set_filter",
                                                "carom_surface_move",
                                                "carom_world_step",
                                                "carom_snapshot_load",
                                                "carom_body_set_material",
                                                "carom_body_set_face_materials",
                                                "carom_body_set_force_at",
                                                "carom_body_set_torque",
                                                "carom_body_set_gravity_scale",
                                                "carom_body_set_damping",
                                                "carom_joint_add",
                                                "carom_joint_remove",
                                                "carom_query_faces"};

bool faults_full(int result)
{
    return result == CAROM_ERR_BODIES_FULL || result == CAROM_ERR_PAIRS_FULL ||
           result == CAROM_ERR_CONTACTS_FULL || result == CAROM_ERR_FACES_FULL ||
           result == CAROM_ERR_NO_ENTRIES || result == CAROM_ERR_EXTRAS_FULL ||
           result == CAROM_ERR_JOINTS_FULL;
}

long faults_total(void)
{
    long sum = 0;

    for (int i = 0; i < FAULTS_CALLS; i++) {
        sum += faults.failures[i];
    }
    return sum;
}

/* Structures are cleared before they are filled, so their padding is the same. */
static uint64_t fold(uint64_t digest, const void *bytes, size_t count)
{
    const uint8_t *byte = bytes;

    for (size_t i = 0; i < count; i++) {
        digest = (digest ^ byte[i]) * 0x100000001b3u;
    }
    return digest;
}

static uint64_t look_at_body(const struct carom_world *world, int body, uint64_t digest)
{
    struct {
        struct carom_body_state state;
        struct carom_material material;
        struct carom_forces forces;
        struct carom_filter filter;
        struct carom_body_look look;
        uint32_t mass;
        int result, id;
        void *user;
    } seen;

    memset(&seen, 0, sizeof seen);
    seen.result = carom_body_get(world, body, &seen.state);
    seen.id = carom_body_id(world, body);
    seen.user = carom_body_user(world, body);
    carom_body_material(world, body, &seen.material);
    carom_body_forces(world, body, &seen.forces);
    carom_body_get_filter(world, body, &seen.filter);
    carom_body_look(world, body, &seen.look);
    carom_body_mass(world, body, &seen.mass);
    return fold(digest, &seen, sizeof seen);
}

static uint64_t look_at_lists(const struct carom_world *world, uint64_t digest)
{
    const struct carom_event *events;
    const struct carom_face_ref *faces;
    static struct carom_contact contacts[4096];
    int count = carom_events(world, &events);

    digest = fold(digest, events, (size_t)count * sizeof *events);
    count = carom_interfering_faces(world, &faces);
    digest = fold(digest, faces, (size_t)count * sizeof *faces);
    memset(contacts, 0, sizeof contacts);
    count = carom_contacts(world, contacts, 4096);
    return fold(digest, contacts, (size_t)count * sizeof *contacts);
}

uint64_t faults_look(struct carom_world *world, bool lists)
{
    static uint8_t snapshot[1 << 20];
    int bytes = carom_snapshot_save(world, snapshot, sizeof snapshot);
    uint64_t digest = fold(PLAY_DIGEST, snapshot, bytes < 0 ? 0 : (size_t)bytes);
    int bodies = carom_body_count(world), joints = carom_joint_count(world);

    for (int i = 0; i < bodies; i++) {
        digest = look_at_body(world, i, digest);
    }
    for (int i = 0; i < joints; i++) {
        struct carom_joint_state joint;

        memset(&joint, 0, sizeof joint);
        carom_joint_get(world, i, &joint);
        digest = fold(digest, &joint, sizeof joint);
    }
    return lists ? look_at_lists(world, digest) : digest;
}

/* ---------------------------------------------------------------------- calls */

static bool refused(void)
{
    return ++faults.calls == faults.stop;
}

/* Calls that forget what the last step found, also when they fail. */
static bool forgets(int call)
{
    return call == STEP || call == SURFACE_MOVE;
}

static int judge(struct carom_world *world, uint64_t before, int call, int result)
{
    if (!faults_full(result)) {
        return result;
    }
    faults.failures[call]++;
    faults.failed = faults.calls;
    if (faults_look(world, !forgets(call)) != before) {
        printf("# %s: %s, and the world has changed\n", faults_names[call],
               carom_result_text(result));
        faults.changed++;
    }
    if (forgets(call)) {
        const struct carom_event *events;
        const struct carom_face_ref *faces;

        faults.listed += (call == STEP && carom_events(world, &events) != 0) ||
                         carom_interfering_faces(world, &faces) != 0 ||
                         carom_contacts(world, NULL, 0) != 0;
    }
    return result;
}

#define WATCH(call, number, parameters, arguments)                                                 \
    int __real_##call parameters;                                                                  \
    int __wrap_##call parameters;                                                                  \
    int __wrap_##call parameters                                                                   \
    {                                                                                              \
        uint64_t before = faults_look(w, !forgets(number));                                        \
                                                                                                   \
        return refused() ? CAROM_ERR_ARGUMENT : judge(w, before, number, __real_##call arguments); \
    }

WATCH(carom_body_add, BODY_ADD, (struct carom_world * w, const struct carom_body_def *a), (w, a))
WATCH(carom_body_set, BODY_SET, (struct carom_world * w, int i, const struct carom_body_state *a),
      (w, i, a))
WATCH(carom_body_set_filter, SET_FILTER,
      (struct carom_world * w, int i, const struct carom_filter *a), (w, i, a))
WATCH(carom_surface_move, SURFACE_MOVE, (struct carom_world * w, int i, const int16_t (*a)[3]),
      (w, i, a))
WATCH(carom_world_step, STEP, (struct carom_world * w), (w))
WATCH(carom_snapshot_load, LOAD, (struct carom_world * w, const void *a, size_t n), (w, a, n))
WATCH(carom_body_set_material, SET_MATERIAL,
      (struct carom_world * w, int i, const struct carom_material *a), (w, i, a))
WATCH(carom_body_set_face_materials, SET_FACES,
      (struct carom_world * w, int i, const struct carom_material *a, uint32_t n,
       const uint8_t *of),
      (w, i, a, n, of))
WATCH(carom_body_set_force_at, SET_FORCE_AT,
      (struct carom_world * w, int i, const carom_v3_q40 *a, const carom_v3_q32 *b), (w, i, a, b))
WATCH(carom_body_set_torque, SET_TORQUE, (struct carom_world * w, int i, const carom_v3_q40 *a),
      (w, i, a))
WATCH(carom_body_set_gravity_scale, SET_SCALE, (struct carom_world * w, int i, int32_t a),
      (w, i, a))
WATCH(carom_body_set_damping, SET_DAMPING, (struct carom_world * w, int i, int32_t a, int32_t b),
      (w, i, a, b))
WATCH(carom_joint_add, JOINT_ADD, (struct carom_world * w, const struct carom_joint_def *a), (w, a))
WATCH(carom_joint_remove, JOINT_REMOVE, (struct carom_world * w, int i), (w, i))
WATCH(carom_query_faces, QUERY_FACES,
      (struct carom_world * w, int i, int j, struct carom_face_pair *a, uint32_t n),
      (w, i, j, a, n))

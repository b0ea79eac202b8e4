/* SPDX-License-Identifier: MIT */
/*
 * carom_replay.h - record the calls that a program makes on a world, and play them again anywhere.
 *
 * A recording is a small file: the meshes, every call that changes the world, what contact callbacks answered and
 * a check of the state after each step. The same calls give the same bits everywhere, so what plays it finds
 * the same states, or names the first frame and stage that differ. docs/replay.md has the format and recipes.
 *
 * For every function of Carom that changes a world there is one that records: carom_record_body_push for carom_body_push,
 * with the recording as its first argument. A source that defines CAROM_RECORDER, an expression for a struct
 * carom_record *, before it includes this header, or is compiled with -include of a header that does so, has each such
 * call recorded as it stands. Who does not call these links none of it. The rules at the top of carom.h hold.
 */
#ifndef CAROM_REPLAY_H
#define CAROM_REPLAY_H

#include "carom_body.h"
#include "carom_joint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The functions that change a world, without carom_; their order is that of the format. */
#define CAROM_REPLAY_CALLS(X)                                                                      \
    X(world_init)                                                                                  \
    X(world_step)                                                                                  \
    X(world_set_gravity)                                                                           \
    X(world_set_combine)                                                                           \
    X(body_add)                                                                                    \
    X(body_remove)                                                                                 \
    X(body_set)                                                                                    \
    X(body_move_to)                                                                                \
    X(body_set_filter)                                                                             \
    X(body_set_force)                                                                              \
    X(body_set_force_at)                                                                           \
    X(body_set_torque)                                                                             \
    X(body_set_gravity_scale)                                                                      \
    X(body_set_damping)                                                                            \
    X(body_push)                                                                                   \
    X(body_push_centre)                                                                            \
    X(body_twist)                                                                                  \
    X(body_set_material)                                                                           \
    X(body_set_face_materials)                                                                     \
    X(body_set_mass)                                                                               \
    X(surface_move)                                                                                \
    X(surface_set)                                                                                 \
    X(snapshot_load)                                                                               \
    X(joint_add)                                                                                   \
    X(joint_remove)                                                                                \
    X(joint_set)

enum carom_replay_call {
    CAROM_CALL_NONE,
#define CAROM_CALL_NAME(name) CAROM_CALL_##name,
    CAROM_REPLAY_CALLS(CAROM_CALL_NAME)
#undef CAROM_CALL_NAME
        CAROM_CALL_COUNT
};
/* "carom_body_push" of CAROM_CALL_body_push; "unknown" for a number that is none. */
const char *carom_replay_call_name(int call);

/* Calls that were made lately: one that comes again takes a part of a byte. */
#define CAROM_REPLAY_SLOTS      32
#define CAROM_REPLAY_SLOT_BYTES 96
struct carom_replay_slot {
    uint8_t size, next, bytes[CAROM_REPLAY_SLOT_BYTES];
};
struct carom_replay_memory {
    struct carom_replay_slot slots[CAROM_REPLAY_SLOTS];
    uint8_t last, fresh;
};
#define CAROM_REPLAY_MESHES 32

/* Parts of a step that are compared, in this order, when a recording has stages; the state, the last, always is. */
enum carom_replay_part {
    CAROM_REPLAY_INTERFERE, /* interfering faces */
    CAROM_REPLAY_BOYSE,     /* counts of the search for hits */
    CAROM_REPLAY_CONTACT,   /* contacts: bodies, points, normals and gaps */
    CAROM_REPLAY_IMPACT,    /* counts of impacts */
    CAROM_REPLAY_REST,      /* impulses of contacts, counts of sweeps */
    CAROM_REPLAY_STATE,     /* carom_world_hash; of the stage "commit" */
    CAROM_REPLAY_PARTS
};
/* The name of the stage that a part belongs to: "interfere", "boyse", ...; "commit" of the state. */
const char *carom_replay_part_name(int part);
/* Digests of the parts after a step; digests[CAROM_REPLAY_STATE] is carom_world_hash. CAROM_OK or CAROM_ERR_NULL. */
int carom_replay_digests(const struct carom_world *world, uint64_t digests[CAROM_REPLAY_PARTS]);

/* ------------------------------------------------------------------ recording */

/* Where the bytes of a recording go, a few at a time, in order. Whoever cannot keep them notes it. */
typedef void carom_record_write(void *user, const void *bytes, size_t count);

/*
 * A recording, of the first world that is made by it or given to carom_record_world; calls on other worlds go through unrecorded. It must stay
 * where it is until it has ended or that world is gone. All of it is Carom's own.
 */
struct carom_record {
    carom_record_write *write; /* NULL: nothing is recorded */
    void *user;
    struct carom_world
        *world; /* NULL before carom_record_world_init or carom_record_world, and after the end */
    carom_contact_function *contact;
    void *contact_user;
    uint32_t asked; /* questions about contacts since the last answer that was written */
    uint32_t frames, sum, run, mesh_count;
    bool stages;
    uint64_t meshes[CAROM_REPLAY_MESHES];
    struct carom_replay_memory memory;
};

/*
 * Begin to record: writes the header.
 *   stages  keep digests of the stages, too: 10 bytes more a frame, and a difference is named by its stage
 *   note    what the program says of itself, such as its version and processor; up to 63 bytes are kept; or NULL
 * Returns CAROM_OK or CAROM_ERR_NULL for record or write.
 */
int carom_record_begin(struct carom_record *record, carom_record_write *write, void *user,
                       bool stages, const char *note);
/*
 * End a recording: writes the count of frames, the state and a sum of all bytes. Calls go through from then on. A
 * recording without an end, of a program that crashed, can be played as far as it goes.
 */
int carom_record_end(struct carom_record *record);

/*
 * Record a world that is there already, from where it is, after carom_record_begin: its meshes, bodies, joints and a snapshot are
 * written at once. Its state stays as it is. Ids that the program has go on to name the same bodies.
 *   mem    to make the snapshot in; free again after the call
 *   bytes  carom_snapshot_size(world) at least
 * Returns CAROM_OK; CAROM_ERR_NULL; CAROM_ERR_MEMORY for too few bytes; CAROM_ERR_ARGUMENT for a recording that has a
 * world, has not begun or has ended. After an error nothing was written.
 */
int carom_record_world(struct carom_record *record, struct carom_world *world, void *mem,
                       size_t bytes);

/*
 * As the functions without record_, recorded; calls that change nothing because of NULL are not. With record NULL, or
 * one that has ended, they are those functions. A step writes what it is about to do before it does it.
 */
int carom_record_world_init(struct carom_record *record, void *mem, size_t bytes,
                            const struct carom_config *config, struct carom_world **world);
int carom_record_world_step(struct carom_record *record, struct carom_world *world);
int carom_record_world_set_gravity(struct carom_record *record, struct carom_world *world,
                                   const carom_v3_q40 *gravity);
int carom_record_world_set_combine(struct carom_record *record, struct carom_world *world,
                                   enum carom_combine restitution, enum carom_combine friction);
int carom_record_body_add(struct carom_record *record, struct carom_world *world,
                          const struct carom_body_def *def);
int carom_record_body_remove(struct carom_record *record, struct carom_world *world, int body);
int carom_record_body_set(struct carom_record *record, struct carom_world *world, int body,
                          const struct carom_body_state *state);
int carom_record_body_move_to(struct carom_record *record, struct carom_world *world, int body,
                              const struct carom_pose *pose);
int carom_record_body_set_filter(struct carom_record *record, struct carom_world *world, int body,
                                 const struct carom_filter *filter);
int carom_record_body_set_force(struct carom_record *record, struct carom_world *world, int body,
                                const carom_v3_q40 *force);
int carom_record_body_set_force_at(struct carom_record *record, struct carom_world *world, int body,
                                   const carom_v3_q40 *force, const carom_v3_q32 *point);
int carom_record_body_set_torque(struct carom_record *record, struct carom_world *world, int body,
                                 const carom_v3_q40 *torque);
int carom_record_body_set_gravity_scale(struct carom_record *record, struct carom_world *world,
                                        int body, int32_t scale_q16);
int carom_record_body_set_damping(struct carom_record *record, struct carom_world *world, int body,
                                  int32_t linear_q30, int32_t angular_q30);
int carom_record_body_push(struct carom_record *record, struct carom_world *world, int body,
                           const carom_v3_q40 *impulse, const carom_v3_q32 *point);
int carom_record_body_push_centre(struct carom_record *record, struct carom_world *world, int body,
                                  const carom_v3_q40 *impulse);
int carom_record_body_twist(struct carom_record *record, struct carom_world *world, int body,
                            const carom_v3_q40 *angular);
int carom_record_body_set_material(struct carom_record *record, struct carom_world *world, int body,
                                   const struct carom_material *material);
int carom_record_body_set_face_materials(struct carom_record *record, struct carom_world *world,
                                         int body, const struct carom_material *materials,
                                         uint32_t count, const uint8_t *of_face);
/* Masses, surfaces that move, states and joints likewise. */
int carom_record_body_set_mass(struct carom_record *record, struct carom_world *world, int body,
                               uint32_t mass_q20);
int carom_record_surface_move(struct carom_record *record, struct carom_world *world, int body,
                              const int16_t (*vertices)[3]);
int carom_record_surface_set(struct carom_record *record, struct carom_world *world, int body,
                             const int16_t (*vertices)[3]);
int carom_record_snapshot_load(struct carom_record *record, struct carom_world *world,
                               const void *in, size_t bytes);
int carom_record_joint_add(struct carom_record *record, struct carom_world *world,
                           const struct carom_joint_def *def);
int carom_record_joint_remove(struct carom_record *record, struct carom_world *world, int joint);
int carom_record_joint_set(struct carom_record *record, struct carom_world *world, int joint,
                           const struct carom_joint_drive *drive);

/* --------------------------------------------------------------------- playing */

enum carom_replay_result {
    CAROM_REPLAY_END,     /* the recording is over, and whole */
    CAROM_REPLAY_FRAME,   /* a frame was played, and is as it was recorded */
    CAROM_REPLAY_DIFFERS, /* a frame was played and differs: see carom_replay */
    CAROM_REPLAY_CUT      /* the file ends here without its end */
};

enum carom_replay_difference {
    CAROM_REPLAY_SAME,
    CAROM_REPLAY_IN_RESULT, /* `call` returned `found`, recorded was `wanted` */
    CAROM_REPLAY_IN_ANSWER, /* in `call` a contact was not asked about that was when it was recorded */
    CAROM_REPLAY_IN_PART, /* `part` of the step, low bits of its digest */
    CAROM_REPLAY_IN_SUM   /* the file was altered, or the end does not fit */
};

/* A player. What comes first is for the caller to read, the rest is Carom's own. */
struct carom_replay {
    struct carom_world *world; /* NULL before it is made */
    uint32_t frames;           /* that were played; one that differs is the last of them */
    const char *note;          /* note_bytes, without a zero after them */
    uint8_t note_bytes;
    uint8_t difference; /* enum carom_replay_difference */
    uint8_t part;       /* enum carom_replay_part */
    uint8_t call;       /* enum carom_replay_call: the last one that was played */
    int64_t wanted, found;

    const uint8_t *file;
    size_t bytes, at;
    uint8_t *mem;
    size_t room, used, block_bytes, scratch_bytes;
    uint8_t *block, *scratch;
    struct carom_mesh *meshes[CAROM_REPLAY_MESHES];
    uint32_t mesh_count, run, asked;
    bool stages;
    struct carom_replay_memory memory;
};

/*
 * Begin to play a recording.
 *   file  all of it; must stay as it is
 *   mem   aligned to 8; for the world, the meshes, materials of faces, and the vertices of one move of a surface
 * Returns CAROM_OK; CAROM_ERR_NULL; CAROM_ERR_FORMAT for a file that is none or of another version; CAROM_ERR_MEMORY.
 */
int carom_replay_begin(struct carom_replay *replay, const void *file, size_t bytes, void *mem,
                       size_t room);
/*
 * Play on to the end of a step. Goes on after a difference, too.
 * Returns enum carom_replay_result; CAROM_ERR_FORMAT for bytes that mean nothing; CAROM_ERR_MEMORY. After an error or
 * the end there is nothing more to be played.
 */
int carom_replay_frame(struct carom_replay *replay);

#ifdef __cplusplus
}
#endif

#ifdef CAROM_RECORDER
#define carom_world_init(...)        carom_record_world_init(CAROM_RECORDER, __VA_ARGS__)
#define carom_world_step(...)        carom_record_world_step(CAROM_RECORDER, __VA_ARGS__)
#define carom_world_set_gravity(...) carom_record_world_set_gravity(CAROM_RECORDER, __VA_ARGS__)
#define carom_world_set_combine(...) carom_record_world_set_combine(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_add(...)          carom_record_body_add(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_remove(...)       carom_record_body_remove(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set(...)          carom_record_body_set(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_move_to(...)      carom_record_body_move_to(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_filter(...)   carom_record_body_set_filter(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_force(...)    carom_record_body_set_force(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_force_at(...) carom_record_body_set_force_at(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_torque(...)   carom_record_body_set_torque(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_gravity_scale(...)                                                          \
    carom_record_body_set_gravity_scale(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_damping(...)  carom_record_body_set_damping(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_push(...)         carom_record_body_push(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_push_centre(...)  carom_record_body_push_centre(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_twist(...)        carom_record_body_twist(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_material(...) carom_record_body_set_material(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_face_materials(...)                                                         \
    carom_record_body_set_face_materials(CAROM_RECORDER, __VA_ARGS__)
#define carom_body_set_mass(...) carom_record_body_set_mass(CAROM_RECORDER, __VA_ARGS__)
#define carom_surface_move(...)  carom_record_surface_move(CAROM_RECORDER, __VA_ARGS__)
#define carom_surface_set(...)   carom_record_surface_set(CAROM_RECORDER, __VA_ARGS__)
#define carom_snapshot_load(...) carom_record_snapshot_load(CAROM_RECORDER, __VA_ARGS__)
#define carom_joint_add(...)     carom_record_joint_add(CAROM_RECORDER, __VA_ARGS__)
#define carom_joint_remove(...)  carom_record_joint_remove(CAROM_RECORDER, __VA_ARGS__)
#define carom_joint_set(...)     carom_record_joint_set(CAROM_RECORDER, __VA_ARGS__)
#endif

#endif

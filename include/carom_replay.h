/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Record the calls that a program makes on a world, and play them again anywhere. @ref rules hold.
 */
#ifndef CAROM_REPLAY_H
#define CAROM_REPLAY_H

#include "carom_body.h"
#include "carom_joint.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup record Recording
 * Write the calls that a program makes on a world to a small file.
 *
 * A recording holds the meshes, every call that changes the world, the answers of contact functions, and a check of
 * the state after each step. The same calls give the same bits everywhere, so a player finds the same states, or names
 * the first frame and stage that differ. docs/replay.md has the format and recipes.
 *
 * Each function of Carom that changes a world has a function that records: carom_record_body_push() for
 * carom_body_push(), with the recording as its first argument. To record calls as they stand, a source defines
 * CAROM_RECORDER, an expression for a struct #carom_record *, before it includes this header; `-include` of a header
 * that does so serves a whole program. A program that does not record links none of it.
 * @{
 */

/** Memory of a recording or a player for calls made lately: a call that comes again takes part of a byte. */
#define CAROM_REPLAY_SLOTS 32
/** Bytes of the longest call that is remembered. */
#define CAROM_REPLAY_SLOT_BYTES 96
/** A call made lately. Carom's own. */
struct carom_replay_slot {
    uint8_t size;                           /**< bytes of the call */
    uint8_t next;                           /**< slot of the call that followed it */
    uint8_t bytes[CAROM_REPLAY_SLOT_BYTES]; /**< the call, as it is written */
};
/** Calls made lately. Carom's own. */
struct carom_replay_memory {
    struct carom_replay_slot slots[CAROM_REPLAY_SLOTS]; /**< the calls */
    uint8_t last;                                       /**< slot of the last call */
    uint8_t fresh;                                      /**< slot that the next new call takes */
};
/** Most meshes of a recording. */
#define CAROM_REPLAY_MESHES 32

/**
 * Takes the bytes of a recording, a few at a time, in order. If it cannot keep them, it must remember that itself.
 *
 * @param user   as given to carom_record_begin()
 * @param bytes  the bytes
 * @param count  how many
 */
typedef void carom_record_write(void *user, const void *bytes, size_t count);

/**
 * A recording of one world: the first that carom_record_world_init() makes or carom_record_world() is given.
 *
 * Calls on other worlds go through unrecorded. It must stay where it is until it has ended or that world is gone. All
 * of it is Carom's own.
 */
struct carom_record {
    carom_record_write *write;       /**< where bytes go; NULL: nothing is recorded */
    void *user;                      /**< first argument of `write` */
    struct carom_world *world;       /**< the world; NULL before it is known, and after the end */
    carom_contact_function *contact; /**< the contact function of the world */
    void *contact_user;              /**< its first argument */
    uint32_t asked;      /**< questions about contacts since the last answer that was written */
    uint32_t frames;     /**< frames recorded */
    uint32_t sum;        /**< sum of all bytes */
    uint32_t run;        /**< calls that came in the order of the last time, not yet written */
    uint32_t mesh_count; /**< meshes written */
    bool stages;         /**< digests of the stages are kept, too */
    uint64_t meshes[CAROM_REPLAY_MESHES]; /**< hashes of the meshes written */
    struct carom_replay_memory memory;    /**< calls made lately */
};

/**
 * Begin to record. Writes the header.
 *
 * @param[out] record  the recording
 * @param write        where its bytes go
 * @param user         first argument of `write`; may be NULL
 * @param stages       keep digests of the stages: 10 bytes more a frame, and a difference is named by its stage
 * @param note         text of the program, such as its version and processor; up to 63 bytes are kept; may be NULL
 * @return CAROM_OK
 */
int carom_record_begin(struct carom_record *record, carom_record_write *write, void *user,
                       bool stages, const char *note);

/**
 * End a recording. Writes the number of frames, the state, and a sum of all bytes.
 *
 * From then on calls go through unrecorded. A recording without an end, of a program that crashed, plays as far as it
 * goes.
 */
int carom_record_end(struct carom_record *record);

/**
 * Record a world that exists already, from where it is. Call it after carom_record_begin().
 *
 * It writes the meshes, bodies, joints and a snapshot of the world. The state does not change, and ids that the
 * program has keep naming the same bodies.
 *
 * @param record  a recording that has begun and has no world
 * @param mem     room for a snapshot; free again after the call
 * @param bytes   size of `mem`, at least carom_snapshot_size()
 * @return CAROM_OK; CAROM_ERR_MEMORY for too few bytes; CAROM_ERR_ARGUMENT for a recording that has a world, has not
 *         begun or has ended. After an error nothing was written.
 */
int carom_record_world(struct carom_record *record, struct carom_world *world, void *mem,
                       size_t bytes);

/** @} */
/**
 * @defgroup recorded Calls that record
 * The functions that change a world, recorded.
 *
 * Each does what the function without `record_` does, and returns what it returns. A call that fails because of NULL is
 * not recorded. If `record` is NULL or has ended, nothing is. A step writes what it is about to do before it does it.
 * @{
 */

/** carom_world_init(), recorded. */
int carom_record_world_init(struct carom_record *record, void *mem, size_t bytes,
                            const struct carom_config *config, struct carom_world **world);
/** carom_world_step(), recorded. */
int carom_record_world_step(struct carom_record *record, struct carom_world *world);
/** carom_world_set_gravity(), recorded. */
int carom_record_world_set_gravity(struct carom_record *record, struct carom_world *world,
                                   const carom_v3_q40 *gravity);
/** carom_world_set_combine(), recorded. */
int carom_record_world_set_combine(struct carom_record *record, struct carom_world *world,
                                   enum carom_combine restitution, enum carom_combine friction);
/** carom_body_add(), recorded. */
int carom_record_body_add(struct carom_record *record, struct carom_world *world,
                          const struct carom_body_def *def);
/** carom_body_remove(), recorded. */
int carom_record_body_remove(struct carom_record *record, struct carom_world *world, int body);
/** carom_body_set(), recorded. */
int carom_record_body_set(struct carom_record *record, struct carom_world *world, int body,
                          const struct carom_body_state *state);
/** carom_body_move_to(), recorded. */
int carom_record_body_move_to(struct carom_record *record, struct carom_world *world, int body,
                              const struct carom_pose *pose);
/** carom_body_set_filter(), recorded. */
int carom_record_body_set_filter(struct carom_record *record, struct carom_world *world, int body,
                                 const struct carom_filter *filter);
/** carom_body_set_force(), recorded. */
int carom_record_body_set_force(struct carom_record *record, struct carom_world *world, int body,
                                const carom_v3_q40 *force);
/** carom_body_set_force_at(), recorded. */
int carom_record_body_set_force_at(struct carom_record *record, struct carom_world *world, int body,
                                   const carom_v3_q40 *force, const carom_v3_q32 *point);
/** carom_body_set_torque(), recorded. */
int carom_record_body_set_torque(struct carom_record *record, struct carom_world *world, int body,
                                 const carom_v3_q40 *torque);
/** carom_body_set_gravity_scale(), recorded. */
int carom_record_body_set_gravity_scale(struct carom_record *record, struct carom_world *world,
                                        int body, int32_t scale_q16);
/** carom_body_set_damping(), recorded. */
int carom_record_body_set_damping(struct carom_record *record, struct carom_world *world, int body,
                                  int32_t linear_q30, int32_t angular_q30);
/** carom_body_push(), recorded. */
int carom_record_body_push(struct carom_record *record, struct carom_world *world, int body,
                           const carom_v3_q40 *impulse, const carom_v3_q32 *point);
/** carom_body_push_centre(), recorded. */
int carom_record_body_push_centre(struct carom_record *record, struct carom_world *world, int body,
                                  const carom_v3_q40 *impulse);
/** carom_body_twist(), recorded. */
int carom_record_body_twist(struct carom_record *record, struct carom_world *world, int body,
                            const carom_v3_q40 *angular);
/** carom_body_set_material(), recorded. */
int carom_record_body_set_material(struct carom_record *record, struct carom_world *world, int body,
                                   const struct carom_material *material);
/** carom_body_set_face_materials(), recorded. */
int carom_record_body_set_face_materials(struct carom_record *record, struct carom_world *world,
                                         int body, const struct carom_material *materials,
                                         uint32_t count, const uint8_t *of_face);
/** carom_body_set_mass(), recorded. */
int carom_record_body_set_mass(struct carom_record *record, struct carom_world *world, int body,
                               uint32_t mass_q20);
/** carom_surface_move(), recorded. */
int carom_record_surface_move(struct carom_record *record, struct carom_world *world, int body,
                              const int16_t (*vertices)[3]);
/** carom_surface_set(), recorded. */
int carom_record_surface_set(struct carom_record *record, struct carom_world *world, int body,
                             const int16_t (*vertices)[3]);
/** carom_snapshot_load(), recorded. */
int carom_record_snapshot_load(struct carom_record *record, struct carom_world *world,
                               const void *in, size_t bytes);
/** carom_joint_add(), recorded. */
int carom_record_joint_add(struct carom_record *record, struct carom_world *world,
                           const struct carom_joint_def *def);
/** carom_joint_remove(), recorded. */
int carom_record_joint_remove(struct carom_record *record, struct carom_world *world, int joint);
/** carom_joint_set(), recorded. */
int carom_record_joint_set(struct carom_record *record, struct carom_world *world, int joint,
                           const struct carom_joint_drive *drive);

/** @} */
/**
 * @defgroup play Playing
 * Make the calls of a recording again, and compare what comes of them.
 * @{
 */

/** The functions that change a world, without carom_, in the order of the format: X(name). */
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

/** The number of each call: CAROM_CALL_world_init, CAROM_CALL_world_step, ... in the order of #CAROM_REPLAY_CALLS. */
enum carom_replay_call {
    CAROM_CALL_NONE, /**< no call */
/** @cond */
#define CAROM_CALL_NAME(name) CAROM_CALL_##name,
    CAROM_REPLAY_CALLS(CAROM_CALL_NAME)
#undef CAROM_CALL_NAME
    /** @endcond */
    CAROM_CALL_COUNT /**< one more than the last call */
};

/** Returns the name of a call: "carom_body_push" of CAROM_CALL_body_push; "unknown" for any other number. */
const char *carom_replay_call_name(int call);

/** Parts of a step that are compared, in this order, if a recording has stages. The state is always compared. */
enum carom_replay_part {
    CAROM_REPLAY_INTERFERE, /**< interfering faces */
    CAROM_REPLAY_BOYSE,     /**< counts of the search for hits */
    CAROM_REPLAY_CONTACT,   /**< contacts: bodies, points, normals and gaps */
    CAROM_REPLAY_IMPACT,    /**< counts of impacts */
    CAROM_REPLAY_REST,      /**< impulses of contacts, counts of sweeps */
    CAROM_REPLAY_STATE,     /**< carom_world_hash(); of the stage "commit" */
    CAROM_REPLAY_PARTS      /**< how many parts there are */
};

/** Returns the name of the stage that a part belongs to: "interfere", "boyse", ...; "commit" of the state. */
const char *carom_replay_part_name(int part);

/**
 * Compute digests of the parts after a step.
 *
 * @param[out] digests  digests[#CAROM_REPLAY_STATE] is carom_world_hash()
 * @return CAROM_OK
 */
int carom_replay_digests(const struct carom_world *world, uint64_t digests[CAROM_REPLAY_PARTS]);

/** Results of carom_replay_frame(). */
enum carom_replay_result {
    CAROM_REPLAY_END,     /**< the recording is over, and whole */
    CAROM_REPLAY_FRAME,   /**< a frame was played, and is as it was recorded */
    CAROM_REPLAY_DIFFERS, /**< a frame was played and differs: carom_replay.difference */
    CAROM_REPLAY_CUT      /**< the file stops here, without its end */
};

/** How a frame differs from the recording. */
enum carom_replay_difference {
    CAROM_REPLAY_SAME,      /**< it does not */
    CAROM_REPLAY_IN_RESULT, /**< `call` returned `found`; recorded was `wanted` */
    CAROM_REPLAY_IN_ANSWER, /**< in `call` nobody asked about a contact that was asked about when it was recorded */
    CAROM_REPLAY_IN_PART, /**< `part` of the step; `wanted` and `found` are low bits of its digest */
    CAROM_REPLAY_IN_SUM   /**< the file was altered, or its end does not fit */
};

/** A player. The caller may read the members down to `found`; the rest is Carom's own. */
struct carom_replay {
    struct carom_world *world; /**< the world; NULL before it is made */
    uint32_t frames;           /**< frames played; one that differs is the last of them */
    const char *note;          /**< note of carom_record_begin(), without a zero after it */
    uint8_t note_bytes;        /**< length of the note */
    uint8_t difference;        /**< #carom_replay_difference: the first one of the frame */
    uint8_t part;              /**< #carom_replay_part that differs */
    uint8_t call;   /**< #carom_replay_call: the last one played, or the first one that differs */
    int64_t wanted; /**< recorded value */
    int64_t found;  /**< value that differs from it */

    const uint8_t *file;                            /**< Carom's own: the recording */
    size_t bytes;                                   /**< Carom's own: its size */
    size_t at;                                      /**< Carom's own: next byte of it */
    uint8_t *mem;                                   /**< Carom's own: the caller's memory */
    size_t room;                                    /**< Carom's own: its size */
    size_t used;                                    /**< Carom's own: bytes of it in use */
    size_t block_bytes;                             /**< Carom's own: size of the world's block */
    size_t scratch_bytes;                           /**< Carom's own: size of `scratch` */
    uint8_t *block;                                 /**< Carom's own: the world's block */
    uint8_t *scratch;                               /**< Carom's own: for vertices of a surface */
    struct carom_mesh *meshes[CAROM_REPLAY_MESHES]; /**< Carom's own: meshes read */
    uint32_t mesh_count;                            /**< Carom's own: how many */
    uint32_t run;                                   /**< Carom's own: calls left of a run */
    uint32_t asked;                    /**< Carom's own: questions since the last answer */
    bool stages;                       /**< Carom's own: the recording has digests of stages */
    struct carom_replay_memory memory; /**< Carom's own: calls made lately */
};

/**
 * Begin to play a recording.
 *
 * @param[out] replay  the player
 * @param file         all of the recording; must stay as it is
 * @param bytes        its size
 * @param mem          aligned to 8: for the world, the meshes, materials of faces, and the vertices of one move of a
 *                     surface
 * @param room         size of `mem`
 * @return CAROM_OK; CAROM_ERR_FORMAT for a file that is no recording, or of another version; CAROM_ERR_MEMORY
 */
int carom_replay_begin(struct carom_replay *replay, const void *file, size_t bytes, void *mem,
                       size_t room);

/**
 * Play on to the end of a step, also after a difference.
 *
 * @return #carom_replay_result; CAROM_ERR_FORMAT for bytes that mean nothing; CAROM_ERR_MEMORY. After an error or the
 *         end there is nothing more to play.
 */
int carom_replay_frame(struct carom_replay *replay);

/** @} */

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

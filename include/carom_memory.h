/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Capacities of a world, and the bytes that they take. carom.h includes this header. @ref rules hold.
 */
#ifndef CAROM_MEMORY_H
#define CAROM_MEMORY_H

#include "carom_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup memory Memory of a world
 * Capacities, and the size of the block that carom_world_init() takes.
 *
 * Capacities are written as a list of six to nine numbers, in the order of #carom_caps:
 *
 *     #define CAPS 2, 1, 64, 512, 256, 1024
 *     static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
 *     struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
 * @{
 */

/**
 * The pools of a world: X(name, bytes for each item, smallest capacity, largest capacity).
 *
 * This list gives the size of the block, the initialiser, the names and the usage report. #carom_caps describes them.
 */
#define CAROM_POOLS(X)                                                                             \
    X(bodies, CAROM_BODY_BYTES, 1, 4095)                                                           \
    X(pairs, CAROM_PAIR_BYTES, 1, 65535)                                                           \
    X(contacts, CAROM_CONTACT_BYTES, 1, 4096)                                                      \
    X(faces, CAROM_FACE_BYTES, 1, 65535)                                                           \
    X(entries, CAROM_ENTRY_BYTES, 0, 65535)                                                        \
    X(candidates, CAROM_CANDIDATE_BYTES, 1, 65535)                                                 \
    X(joints, CAROM_JOINT_BYTES, 0, 4095)                                                          \
    X(extras, CAROM_EXTRA_BYTES, 0, 4095)                                                          \
    X(hits, CAROM_HIT_BYTES, 0, 65535)

/** Capacities of a world. */
struct carom_caps {
    uint32_t bodies; /**< bodies, moving and stationary; 1 to 4095 */
    /**
     * pairs of bodies: near each other in one frame; or touching (asleep or not), overlapping a sensor, or passing
     * each other; 1 to 65535
     */
    uint32_t pairs;
    uint32_t contacts; /**< contacts within the margin, neighbouring ones merged; 1 to 4096 */
    uint32_t faces;    /**< interfering faces of one frame; 1 to 65535 */
    /**
     * entries of the z-lists that a step makes for surfaces that move, under the bodies over them; a working pool; 0
     * if all meshes are rigid, since these bring their lists
     */
    uint32_t entries;
    /** vertex/face and edge/edge pairs kept; a working pool: fewer cost time, not results; 1 to 65535 */
    uint32_t candidates;
    uint32_t joints; /**< joints; 0 to 4095 */
    /**
     * bodies that have more than a mesh, a mass, e and mu: kinematic ones, and those with rolling friction, materials
     * by face, torque, damping; a contact function needs 1; 0 to 4095
     */
    uint32_t extras;
    uint32_t hits; /**< hits of a frame whose details carom_event_hit() tells; 0 to 65535 */
};

/** The number of each pool: CAROM_POOL_bodies, CAROM_POOL_pairs, ... in the order of #CAROM_POOLS. */
enum carom_pool {
/** @cond */
#define CAROM_POOL_NAME(name, bytes, low, high) CAROM_POOL_##name,
    CAROM_POOLS(CAROM_POOL_NAME)
#undef CAROM_POOL_NAME
    /** @endcond */
    CAROM_POOL_COUNT /**< how many pools there are */
};

/** An initialiser of #carom_caps: six to nine numbers in its order. Those left out are 0. */
#define CAROM_CAPS(...) CAROM_CAPS_(__VA_ARGS__, 0, 0, 0, 0)
#define CAROM_CAPS_(b, p, c, f, e, n, j, x, h, ...)                                                \
    {                                                                                              \
        b, p, c, f, e, n, j, x, h                                                                  \
    }

/** Bytes of the block of a world, a multiple of 8: a constant expression of six to nine capacities. */
#define CAROM_WORLD_BYTES(...) CAROM_WORLD_BYTES_(__VA_ARGS__, 0, 0, 0, 0)
#define CAROM_WORLD_BYTES_(b, p, c, f, e, n, j, x, h, ...)                                         \
    (((size_t)CAROM_WORLD_FIXED_BYTES + (size_t)(b)*CAROM_BODY_BYTES +                             \
      (size_t)(p)*CAROM_PAIR_BYTES + (size_t)(c)*CAROM_CONTACT_BYTES +                             \
      (size_t)(f)*CAROM_FACE_BYTES + (size_t)(e)*CAROM_ENTRY_BYTES +                               \
      ((e) > 0 ? CAROM_HEADS_BYTES : 0) + ((e) + (x) > 0 ? (size_t)(c)*CAROM_DRIFT_BYTES : 0) +    \
      ((x) > 0 ? (size_t)(c)*CAROM_MIXED_BYTES : 0) + (size_t)(n)*CAROM_CANDIDATE_BYTES +          \
      (size_t)(j)*CAROM_JOINT_BYTES + (size_t)(x)*CAROM_EXTRA_BYTES +                              \
      (size_t)(h)*CAROM_HIT_BYTES +                                                                \
      CAROM_MORE_(CAROM_SOLVE_BYTES_((size_t)(p), (size_t)(c)),                                    \
                  CAROM_FOUND_BYTES_((size_t)(b), (size_t)(p), (size_t)(j)) +                      \
                      CAROM_SCRATCH_BYTES) +                                                       \
      7) /                                                                                         \
     8 * 8)
#define CAROM_FOUND_BYTES_(b, p, j) ((2 * (p) + (b) + (j)) * sizeof(struct carom_event))
#define CAROM_SOLVE_BYTES_(p, c)    ((c)*CAROM_WORK_BYTES + CAROM_LESS_(p, c) * CAROM_ROLL_BYTES)

/**
 * Most bytes of a snapshot of a world, for carom_snapshot_save(): a constant expression of six to nine capacities.
 *
 * carom_snapshot_size() says how many a world takes now, mostly far fewer.
 */
#define CAROM_SNAPSHOT_BYTES(...) CAROM_SNAPSHOT_BYTES_(__VA_ARGS__, 0, 0, 0, 0)
#define CAROM_SNAPSHOT_BYTES_(b, p, c, f, e, n, j, x, h, ...)                                      \
    ((size_t)72 + (size_t)(b)*131 + (size_t)(c)*60 + (size_t)(p)*4 + (size_t)(j)*181 +             \
     (size_t)(x)*87)

/** As #CAROM_WORLD_BYTES, for capacities known only at run time; 0 for NULL. */
size_t carom_world_bytes(const struct carom_caps *caps);

/*
 * Bytes for one of each, with its share of the lists that follow it, where a pointer has at most 32 bits, and 64.
 * Assertions in src/world/world.c hold them.
 */
#define CAROM_BYTES_(narrow, wide) (sizeof(void *) > 4 ? (wide) : (narrow))
/** Bytes of a block for each body. */
#define CAROM_BODY_BYTES CAROM_BYTES_(816, 824)
/** Bytes of a block for each pair. */
#define CAROM_PAIR_BYTES CAROM_BYTES_(64, 64)
/** Bytes of a block for each contact. */
#define CAROM_CONTACT_BYTES CAROM_BYTES_(224, 248)
/** Bytes of a block for each interfering face. */
#define CAROM_FACE_BYTES 4
/** Bytes of a block for each entry. */
#define CAROM_ENTRY_BYTES 8
/** Bytes of a block for each candidate. */
#define CAROM_CANDIDATE_BYTES 12
/** Bytes of a block for each joint. */
#define CAROM_JOINT_BYTES CAROM_BYTES_(2192, 2216)
/** Bytes of a block for each extra. */
#define CAROM_EXTRA_BYTES CAROM_BYTES_(208, 216)
/** Bytes of a block for each hit. */
#define CAROM_HIT_BYTES 40
/** Bytes of a block whatever its capacities. */
#define CAROM_WORLD_FIXED_BYTES CAROM_BYTES_(744, 992)
/** Bytes of a block that has entries. */
#define CAROM_HEADS_BYTES 2048
/** Bytes of a block for each contact, where there are entries or extras. */
#define CAROM_DRIFT_BYTES 24
/** Bytes of a block for each contact, where there are extras. */
#define CAROM_MIXED_BYTES 8

/*
 * Stages work in one room in turn. The room holds a search, beside the events that the end of a step finds; or a
 * solve, which takes bytes for each contact and for as many pairs as have one.
 */
/** Bytes of the working room for a search. */
#define CAROM_SCRATCH_BYTES CAROM_BYTES_(1880, 1952)
/** Bytes of the working room for each contact of a solve. */
#define CAROM_WORK_BYTES CAROM_BYTES_(200, 208)
/** Bytes of the working room for each pair of a solve that has a contact. */
#define CAROM_ROLL_BYTES 64

/** @} */

#ifdef __cplusplus
}
#endif

#endif

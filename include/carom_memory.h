/* SPDX-License-Identifier: MIT */
/*
 * carom_memory.h - how many of all a world can hold, and the bytes that this takes. carom.h includes it, and the
 * rules at its top hold.
 */
#ifndef CAROM_MEMORY_H
#define CAROM_MEMORY_H

#include "carom_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Capacities of a world, in this order. One list gives the block's size, the initialiser, the names
 * and the usage report.
 *
 *   bodies      moving and stationary
 *   pairs       of bodies near each other in one frame; of bodies that touch, asleep or not, or that
 *               overlap a sensor or pass each other
 *   contacts    places within the margin, neighbouring ones merged
 *   faces       interfering faces of one frame
 *   entries     of z-lists made within a step, for surfaces that move under the bodies over them;
 *               working; none when all meshes are rigid: these bring theirs
 *   candidates  vertex/face and edge/edge pairs kept; working: fewer cost time, not results
 *
 * The rest may be left out, which makes them 0:
 *
 *   joints      between bodies, or a body and the world
 *   extras      bodies with more than a mesh, a mass, e and mu: filters' callbacks, materials, torque, ...
 *   hits        impacts of a frame whose place, normal and faces are noted
 *
 *   X(name, bytes for each, smallest allowed, largest allowed)
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

/*
 * Bytes for one of each, its share of the lists that follow it included, where a pointer has 32 bits
 * or fewer, and 64; held by assertions.
 */
#define CAROM_BYTES_(narrow, wide) (sizeof(void *) > 4 ? (wide) : (narrow))
#define CAROM_BODY_BYTES           CAROM_BYTES_(816, 824)
#define CAROM_PAIR_BYTES           CAROM_BYTES_(64, 64)
#define CAROM_CONTACT_BYTES        CAROM_BYTES_(224, 248)
#define CAROM_FACE_BYTES           4
#define CAROM_ENTRY_BYTES          8
#define CAROM_CANDIDATE_BYTES      12
#define CAROM_JOINT_BYTES          CAROM_BYTES_(2160, 2180)
#define CAROM_EXTRA_BYTES          CAROM_BYTES_(208, 216)
#define CAROM_HIT_BYTES            40
#define CAROM_WORLD_FIXED_BYTES    CAROM_BYTES_(744, 992)
/* For any entries at all; and for each contact, where there are entries or extras. */
#define CAROM_HEADS_BYTES 2048
#define CAROM_DRIFT_BYTES 24
#define CAROM_MIXED_BYTES 8 /* for extras alone */
/*
 * Stages work in this room one after the other. A search takes so much, beside the events that the end of a
 * step finds; a solve takes so much for each contact, and for as many pairs as have one.
 */
#define CAROM_SCRATCH_BYTES CAROM_BYTES_(1712, 1744)
#define CAROM_WORK_BYTES    CAROM_BYTES_(200, 208)
#define CAROM_ROLL_BYTES    64

enum carom_pool {
#define CAROM_POOL_NAME(name, bytes, low, high) CAROM_POOL_##name,
    CAROM_POOLS(CAROM_POOL_NAME)
#undef CAROM_POOL_NAME
        CAROM_POOL_COUNT
};

struct carom_caps {
    uint32_t bodies, pairs, contacts, faces, entries, candidates, joints, extras, hits;
};
/* An initialiser of them from six to nine numbers in that order. */
#define CAROM_CAPS(...) CAROM_CAPS_(__VA_ARGS__, 0, 0, 0, 0)
#define CAROM_CAPS_(b, p, c, f, e, n, j, x, h, ...)                                                \
    {                                                                                              \
        b, p, c, f, e, n, j, x, h                                                                  \
    }

/*
 * Bytes of the block of a world, a multiple of 8. The arguments are six to nine capacities in the order above, so
 *
 *   #define CAPS 2, 1, 64, 512, 256, 1024
 *   static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
 *   struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
 */
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

/* The same where the capacities are known only at run time; 0 for NULL. */
size_t carom_world_bytes(const struct carom_caps *caps);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* Calls on a world as bytes: recorded, and played again. docs/replay.md has the format. */
#ifndef CAROM_SRC_CALL_H
#define CAROM_SRC_CALL_H

#include "../world/joints.h"
#include "carom_replay.h"

#define REPLAY_VERSION  1
#define REPLAY_MAGIC    "CRPL"
#define REPLAY_STAGES   1 /* bit of the header's flags */
#define REPLAY_NOTE_MAX 63
#define REPLAY_CALL_BYTES                                                                          \
    256 /* more than any call takes: numbers of at most 10 bytes, 19 of a joint */
#define REPLAY_FULL_EVERY 64 /* frames: a state is written whole every so often */

/* First bytes of what is not a call in full; a lower byte is the number of a call. */
enum replay_token {
    REPLAY_TOKEN_END = 0,
    REPLAY_TOKEN_ANEW = 0x3a,  /* of older recordings: sleeping bodies look for sensors */
    REPLAY_TOKEN_JOINT = 0x3b, /* a joint that existed when a recording began */
    REPLAY_TOKEN_CHECK = 0x3c, /* the check of a step, after its answers and its result */
    REPLAY_TOKEN_MESH = 0x3d,
    REPLAY_TOKEN_ANSWER = 0x3e,
    REPLAY_TOKEN_RESULT = 0x3f,
    REPLAY_TOKEN_SLOT = 0x40, /* plus the number of a slot: the call of that slot */
    REPLAY_TOKEN_RUN =
        0x80 /* plus the count less one: a run of calls, each of them the successor of the one before */
};
#define REPLAY_RUN_MAX 128

/* A force or an impulse on a body, and the place where it acts. */
struct replay_act {
    carom_v3_q40 vector;
    carom_v3_q32 point;
};

/* A call with its arguments. Pointers in it are to data that is written behind it. */
struct replay_call {
    uint8_t op;     /* enum carom_replay_call */
    int32_t body;   /* body or joint number */
    uint32_t mesh;  /* of body_add */
    uint32_t count; /* vertices, bytes or materials behind the call */
    uint32_t faces; /* of materials: so many face numbers follow */
    const void *data;
    const int16_t (*vertices)[3]; /* vertices of surfaces, kept by type */
    const uint8_t *of_face;
    union {
        struct carom_config config;
        struct carom_body_def def;
        struct carom_body_state state;
        struct carom_pose pose;
        struct carom_filter filter;
        struct replay_act act;
        struct carom_material material;
        int64_t numbers[2];
        struct carom_joint_def joint;
        struct carom_joint_drive drive;
    } u;
};

/* Bytes that are written (out) or read (in); one direction at a time. */
struct replay_coder {
    uint8_t *out;
    const uint8_t *in;
    size_t at, size;
    bool bad; /* there was no room, or the bytes read mean nothing */
};
/* A number within low to high: writes the given one, or returns the one read. */
int64_t replay_number(struct replay_coder *c, int64_t value, int64_t low, int64_t high);
/* A number of so many bytes, the lowest first. */
uint64_t replay_fixed(struct replay_coder *c, uint64_t value, int bytes);
void replay_material(struct replay_coder *c, struct carom_material *m);
/* A joint, as it is between its bodies. */
void replay_joint(struct replay_coder *c, struct joint *j);
/* A call without the data behind it; op is known already. */
void replay_code(struct replay_coder *c, struct replay_call *call);

/* True if `body` of a call is a body; otherwise it is a joint, or unused. */
bool replay_is_of_body(uint8_t op);
/* True if data follow a call; such a call is not remembered. */
bool replay_has_data(uint8_t op);
/* Make a call that is no step. */
int replay_do(struct carom_world *world, const struct replay_call *call);
/* The part of a result that is the same everywhere. A budget depends on time. */
int replay_result(uint8_t op, int result);

/* Find the slot of a call that comes again, or UINT32_MAX; note it as the successor of the last call; keep a new call. */
uint32_t replay_find(const struct carom_replay_memory *m, const uint8_t *bytes, size_t size);
void replay_follow(struct carom_replay_memory *m, uint32_t slot);
void replay_keep(struct carom_replay_memory *m, const uint8_t *bytes, size_t size);

/* 32-bit FNV-1a of a file's bytes. */
uint32_t replay_sum(uint32_t sum, const uint8_t *bytes, size_t count);

#endif

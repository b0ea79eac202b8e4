/* SPDX-License-Identifier: MIT */
/*
 * carom.h - real-time impact dynamics of polygon meshes, in integers.
 *
 * Worlds, bodies and steps; meshes are in carom_mesh.h and capacities in carom_memory.h, which this includes. More about
 * bodies is in carom_body.h, joints in carom_joint.h, questions in carom_query.h, drawing in carom_draw.h. Rules that
 * hold everywhere:
 *
 *   - Right-handed axes. A face's corners run counter-clockwise seen from outside. N, the normal of
 *     a contact between bodies a and b, points from b into a.
 *   - Lengths are in world units; a unit is about the size of a body. Time is counted in frames:
 *     one carom_world_step is one frame, and velocities are per frame. carom_fix.h has the formats and
 *     macros that convert from SI.
 *   - Functions return a value >= 0 (CAROM_OK, a status or a count) or a negative enum carom_error.
 *     After an error no state has changed and no output is written; after a step that failed, what
 *     "the last step found" is empty.
 *   - Pointers must not be NULL unless a comment says so; NULL gives CAROM_ERR_NULL.
 *   - Nothing is allocated. The caller's blocks must stay where they are while they are in use, and
 *     a world refers to the meshes that its bodies were made from.
 *   - The same calls give the same bits on every processor and compiler.
 *   - A world is one thread's at a time. Worlds in several threads may share meshes, but for those of
 *     carom_surface_build.
 */
#ifndef CAROM_H
#define CAROM_H

#include "carom_memory.h"
#include "carom_mesh.h"
#include "carom_version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ results */

enum carom_status {
    CAROM_OK = 0,
    CAROM_OVER_BUDGET = 1, /* bit: the step took more ticks than config.budget_ticks */
    CAROM_SUBSTEP_CAP = 2  /* bit: a body used up its hits; its island stood from there on */
};

enum carom_error {
    CAROM_ERR_NULL = -1,        /* a pointer that must not be NULL is */
    CAROM_ERR_ARGUMENT = -2,    /* a value outside its stated range, e.g. e or mu */
    CAROM_ERR_RANGE = -3,       /* a number outside what the formats hold */
    CAROM_ERR_MEMORY = -4,      /* the caller's block is too small, or not aligned to 8 bytes */
    CAROM_ERR_BODY = -5,        /* no body of this number */
    CAROM_ERR_BODIES_FULL = -6, /* output pools that are short */
    CAROM_ERR_PAIRS_FULL = -7,
    CAROM_ERR_CONTACTS_FULL = -8,
    CAROM_ERR_FACES_FULL = -9,
    CAROM_ERR_MESH_EMPTY = -10,      /* no faces, or no volume */
    CAROM_ERR_MESH_SIZE = -11,       /* more than 65535 vertices or 65535 faces */
    CAROM_ERR_MESH_INDEX = -12,      /* a face names a vertex that is not there, or one twice */
    CAROM_ERR_MESH_DEGENERATE = -13, /* a face without area */
    CAROM_ERR_MESH_OPEN = -14,       /* a SOLID with an edge that has one face */
    CAROM_ERR_MESH_EDGE = -15,       /* an edge with three faces, or two of the same direction */
    CAROM_ERR_MESH_INSIDE_OUT = -16, /* a SOLID of negative volume, a SURFACE that looks down */
    CAROM_ERR_MESH_SURFACE = -17,    /* a SURFACE face that is not single-valued in z */
    CAROM_ERR_FORMAT = -18,          /* a blob or snapshot that is not whole */
    CAROM_ERR_BLOCKED = -19,         /* a surface would press a body into a stationary one */
    CAROM_ERR_NO_ENTRIES = -20,      /* a surface that moves needs a world of some entries */
    CAROM_ERR_EXTRAS_FULL = -21,     /* the pool of extras has none left for this body */
    CAROM_ERR_OVERLAP = -22,         /* a body would cross another, or be inside it */
    CAROM_ERR_JOINT = -23,           /* no joint of this number */
    CAROM_ERR_JOINTS_FULL = -24
};

/* A short English text for any result. Never NULL. */
const char *carom_result_text(int result);

/* ------------------------------------------------------------------- worlds */

struct carom_world; /* lives at the start of the caller's block */

/* A place where two bodies touch, or are about to: what config.contact is asked about. */
struct carom_touch {
    uint16_t a, b; /* body numbers */
    uint16_t face_a,
        face_b; /* an edge or a vertex is of the face at it that looks most at the other body */
    carom_v3_q32 point;  /* of the world, halfway between the surfaces */
    carom_v3_q30 normal; /* from b into a */
    int64_t
        speed_q40; /* at which they come together along it, units / frame; negative: they part */
    int32_t restitution_q30; /* in/out; what is out of 0 .. 1 is cut to it */
    uint32_t friction_q16;   /* in/out; 0 .. 4 likewise */
};

/*
 * A function that is asked about each contact of a step, before anything is solved: where the frame begins about
 * every place where bodies are within five skins of each other, then at each hit about those of the bodies that the
 * hit moves. One after the other in a fixed order: by a, then b, then the features. It may change e and mu; with false it
 * drops the contact, and then all contacts of the two bodies: until the frame ends they
 * go through each other, whatever they hit. In the next frame it is asked again, though not about places where
 * they are in each other already: who drops a contact drops it until they are apart, or they may stick.
 * A body that a one_way side lets through passes until both are apart, and nobody is asked about it any more.
 * A body that sleeps and is touched wakes before anybody is asked.
 *
 * It must depend on nothing but its arguments, or the same calls do not give the same bits, and may call no
 * function of this world. A step that fails is taken back and may have asked in vain; one may ask twice.
 */
typedef bool carom_contact_function(void *user, struct carom_touch *touch);

struct carom_config {
    struct carom_caps caps;
    carom_v3_q40 gravity; /* at first; units / frame^2, each component within +-1 */
    bool sleep;           /* bodies at rest sleep until something wakes them */
    uint8_t substep_cap;  /* hits of a body in a frame; with the last its island stands for the rest
                                of the frame; 0: 32 */
    uint8_t sweep_cap;    /* sweeps over several contacts; 0: 40 to 70. Fewer bound the cost of a
                                frame; what has not settled goes on in the next */
    uint32_t (*ticks)(void); /* a free-running counter for carom_stats; NULL: no timing */
    uint32_t budget_ticks;   /* a step that takes more returns CAROM_OVER_BUDGET; 0: no budget */
    carom_contact_function
        *contact;       /* NULL: nobody is asked. Needs an extra: caps.extras of 1 or more */
    void *contact_user; /* its first argument */
};

/*
 * Make an empty world in the caller's block.
 *   mem    aligned to 8; bytes >= CAROM_WORLD_BYTES(caps): one byte less is CAROM_ERR_MEMORY
 *   world  out
 */
int carom_world_init(void *mem, size_t bytes, const struct carom_config *config,
                     struct carom_world **world);

#define CAROM_MU_MAX_Q16 (4 << 16)

/*
 * Which bodies may touch. Two of the same group, other than 0, always do when it is positive and never when
 * it is negative. Else each one's category must have a bit of the other one's mask. Bodies that may
 * not touch go through each other and cost nothing. All zero stands for the default: category 1, mask 0xffff, group 0.
 */
struct carom_filter {
    uint16_t category, mask;
    int16_t group;
};

/*
 * A body that is solid from one side: along this axis of its mesh. It stops a body that comes upon one of
 * its faces, edges or vertices from there: the normal at the first hit, from this body to the other, is
 * within about 75 degrees of the axis (its cosine is 1/4 or more). A body that comes from anywhere else passes, until
 * the two are apart again.
 */
enum carom_one_way {
    CAROM_BOTH_WAYS, /* solid from all sides */
    CAROM_ONE_WAY_X,
    CAROM_ONE_WAY_Y,
    CAROM_ONE_WAY_Z,
    CAROM_ONE_WAY_MINUS_X,
    CAROM_ONE_WAY_MINUS_Y,
    CAROM_ONE_WAY_MINUS_Z
};

/*
 * Bodies start apart: what a body does that is added or set where it crosses another one that it may touch,
 * or lies inside it. Less than about a skin, 1/2048 of a radius, is no crossing. Two stationary bodies may
 * lie in each other, and nothing touches a sensor.
 */
enum carom_overlap {
    CAROM_OVERLAP_REFUSE,   /* CAROM_ERR_OVERLAP, and nothing has changed */
    CAROM_OVERLAP_PUSH_OUT, /* it goes the shortest way out of 27: up against gravity, and along the
                               world's axes and between these; within 60 units and two radii. When each
                               of them is blocked, CAROM_ERR_BLOCKED */
    CAROM_OVERLAP_PASS      /* the two go through each other until they are apart */
};

struct carom_body_def {
    const struct carom_mesh *mesh;
    bool stationary;
    bool kinematic;          /* goes where it is led, whatever is in the way; takes an extra */
    carom_v3_q32 position;   /* of the centre of mass; of a SURFACE's origin. Within +-4096 */
    carom_quat_q30 rotation; /* of length 1 within 2^-10; all zero means none */
    carom_v3_q40 velocity;   /* units / frame; |velocity| + radius |spin| below 64 */
    carom_v3_q40 spin;       /* radians / frame in world axes, length below 64 */
    uint32_t mass_q20;       /* 2^-10 .. 2^10; 0: the mesh's volume, density 1 */
    int32_t restitution_q30; /* e, 0 .. 1; a pair takes the smaller of its two */
    uint32_t friction_q16;   /* mu, 0 .. 4; a pair takes the smaller of its two */
    struct carom_filter filter;
    bool
        sensor; /* says what overlaps it, by CAROM_EVENT_SENSOR_BEGIN and _END, and touches nothing */
    uint8_t one_way; /* enum carom_one_way */
    uint8_t overlap; /* enum carom_overlap: where it crosses another body at the start */
    void *user;      /* the caller's, see carom_body_user */
};

/*
 * Add a body. Returns its number (>= 0) or an error: CAROM_ERR_ARGUMENT for e, mu, mass or rotation
 * out of range, CAROM_ERR_RANGE for a place or speed out of range, CAROM_ERR_BODIES_FULL,
 * CAROM_ERR_NO_ENTRIES; CAROM_ERR_OVERLAP, CAROM_ERR_BLOCKED as enum carom_overlap says, and
 * CAROM_ERR_PAIRS_FULL for bodies that are to pass. A SURFACE must be stationary.
 */
int carom_body_add(struct carom_world *world, const struct carom_body_def *def);
/* Take a body away; what touches it wakes. Its number may be given to the next one that is added. */
int carom_body_remove(struct carom_world *world, int body);

struct carom_body_state {
    carom_v3_q32 position;
    carom_quat_q30 rotation;
    carom_v3_q40 velocity; /* derived from the momenta that are the state */
    carom_v3_q40 spin;
    bool asleep;
    bool out; /* left the world's range: frozen in its last pose, touched by nothing. Also what
                 became faster than 64 units or 2^15 radians a frame */
    uint8_t overlap; /* to carom_body_set: enum carom_overlap; carom_body_get gives REFUSE */
};
/* Where a body is and how it moves. */
int carom_body_get(const struct carom_world *world, int body, struct carom_body_state *state);

/* A body as a renderer sees it. */
struct carom_body_look {
    const struct carom_mesh *mesh;
    carom_v3_q32 position;
    carom_quat_q30 rotation;
    bool moving;
};
/* For whoever draws it. CAROM_ERR_BODY for a number that is free, too. */
int carom_body_look(const struct carom_world *world, int body, struct carom_body_look *look);
/* The mesh of a body; NULL when there is none of this number. */
const struct carom_mesh *carom_body_mesh(const struct carom_world *world, int body);
/* The numbers of all bodies are below this. */
int carom_body_count(const struct carom_world *world);
/*
 * Place a body and wake it, with what touched it and what is near to its new place; a stationary
 * body that is set where it is wakes nothing. asleep and out are ignored. As for carom_body_add, a body that
 * would cross another one is refused unless `overlap` says otherwise. A body that passes another one goes on to do so,
 * and one that is set where it is, to change how it moves, is never refused. A kinematic body is put there at
 * once, and goes on with the velocity and the spin, which is at most pi, in each step from then on, as if it was led.
 */
int carom_body_set(struct carom_world *world, int body, const struct carom_body_state *state);

struct carom_pose {
    carom_v3_q32 position;
    carom_quat_q30 rotation; /* of length 1 within 2^-10; all zero means none */
};
/*
 * Lead a kinematic body to a pose: it is there at the end of the next step, and stands still after that until
 * it is told to go on. On the way its centre goes straight and it turns evenly about one axis, by the
 * shorter turn. It pushes and carries what it touches. A body that it would crush stops it for the rest of the step: the
 * step reports CAROM_EVENT_BLOCKED, and carom_body_get says how far it came; it may be led on in the next one.
 * The step asks what it would reach. carom_body_set does not lead it on any more.
 *
 *   pose  within +-4096 units; as far as a body may go in a frame: way + radius x turn below 64 units
 *
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that is not kinematic or a rotation of another
 *          length; CAROM_ERR_RANGE for a pose too far away or out of range.
 */
int carom_body_move_to(struct carom_world *world, int body, const struct carom_pose *pose);

/*
 * Which bodies a body may touch, from now on; all zero stands for the default. If it is another filter, what touches
 * the body wakes and is near to it, and pairs are made new. Bodies that overlap when a filter lets them touch go
 * through each other until they are apart.
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_PAIRS_FULL when so many pass.
 */
int carom_body_set_filter(struct carom_world *world, int body, const struct carom_filter *filter);
/* The filter of a body; CAROM_ERR_BODY. */
int carom_body_get_filter(const struct carom_world *world, int body, struct carom_filter *filter);

/*
 * Change gravity, and wake every body if it is another. CAROM_ERR_RANGE for a component beyond +-1,
 * by itself or with a body's force / mass.
 */
int carom_world_set_gravity(struct carom_world *world, const carom_v3_q40 *gravity);

/*
 * Let a force act through a moving body's centre of mass until it is changed; wakes the body, and
 * what is connected with it by touching, if it is another.
 *   force  mass x units / frame^2
 * Returns CAROM_OK; CAROM_ERR_ARGUMENT for a stationary body; CAROM_ERR_RANGE when a component of
 *         gravity + force / mass is beyond +-1.
 */
int carom_body_set_force(struct carom_world *world, int body, const carom_v3_q40 *force);

/*
 * Give a moving body an impulse at once, and wake it with what is connected with it by touching.
 *   impulse  mass x units / frame
 *   point    of the world at which it acts, on the body or not; each component within +-4096
 * Returns CAROM_OK; CAROM_ERR_ARGUMENT for a stationary body or one that left the world;
 *         CAROM_ERR_RANGE when the body would become faster than carom_body_set may make it.
 */
int carom_body_push(struct carom_world *world, int body, const carom_v3_q40 *impulse,
                    const carom_v3_q32 *point);

/*
 * Let a surface of carom_surface_build have other vertices, of the same topology. The surface stands
 * still within a step; in the next one whatever touches it finds it moving by what its vertices have
 * moved by since the last step, in a frame. What touches it or is near it wakes. Moving bodies that
 * the surface went into are lifted out of it along its z, with what touches them: that is its work.
 * Interfering faces and contacts of the last step are forgotten.
 *
 *   vertices  as many as the mesh has; copied
 *
 * Returns  CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that is no such surface;
 *          CAROM_ERR_RANGE for a coordinate more than 16 units from where it was in the last step, or
 *          for what carom_mesh_build does not take; CAROM_ERR_MESH_DEGENERATE, _INSIDE_OUT, _SURFACE;
 *          CAROM_ERR_BLOCKED when what would be lifted runs into a stationary body;
 *          CAROM_ERR_PAIRS_FULL, _FACES_FULL.
 */
int carom_surface_move(struct carom_world *world, int body, const int16_t (*vertices)[3]);
/*
 * Put a surface there at once, as if it had been there in the last step: as carom_body_set with a
 * stationary body, whatever is in the way stays where it is. Before a snapshot is taken back.
 */
int carom_surface_set(struct carom_world *world, int body, const int16_t (*vertices)[3]);

/*
 * Move the world by one frame. All or nothing.
 * Returns  CAROM_OK or a sum of carom_status bits; CAROM_ERR_PAIRS_FULL, CAROM_ERR_CONTACTS_FULL,
 *          CAROM_ERR_FACES_FULL; CAROM_ERR_RANGE when a body is too fast beside too large a mesh:
 *          their radii and the way of a frame and a third must stay below 256 units together.
 * Source   paper figures 4 and 5
 */
int carom_world_step(struct carom_world *world);

/* -------------------------------------------------- what the last step found */

enum carom_event_kind {
    CAROM_EVENT_BEGIN, /* a and b began to touch */
    CAROM_EVENT_HIT,   /* the pair's hardest impact of the frame */
    CAROM_EVENT_END,   /* a and b no longer touch */
    CAROM_EVENT_REST,  /* a fell asleep */
    CAROM_EVENT_OUT,   /* a left the world's range and is frozen */
    CAROM_EVENT_WAKE,  /* a woke, in the step or since the one before */
    CAROM_EVENT_CUT,   /* at a hit of a and b one of them used up its hits: both, and what touched
                          them, stood for the rest of the frame */
    CAROM_EVENT_SENSOR_BEGIN, /* b began to overlap a, a sensor */
    CAROM_EVENT_SENSOR_END, /* b no longer overlaps the sensor a. Both in one frame: b went through,
                                 or dipped into it, within the frame */
    CAROM_EVENT_BREAK,      /* joint a took more than it bears, and holds nothing any more */
    CAROM_EVENT_BLOCKED /* kinematic body a would have crushed b: it stopped, see carom_body_move_to */
};

struct carom_event {
    uint8_t kind;
    uint16_t a, b;       /* body numbers; b is unused (0) for REST, OUT and WAKE */
    uint16_t details;    /* of a HIT, for carom_event_hit; 0: none are kept */
    int64_t speed_q40;   /* HIT: approach speed along the normal, units / frame */
    int64_t impulse_q40; /* HIT: normal impulse, mass x units / frame */
};

/*
 * Events of the last step, in a fixed order. At most 3 a pair and 2 a body: never a failure. A CUT
 * for which there is no room is left out; stats.cut_islands counts all of them. So are both events of a body that
 * was in a sensor within the frame alone. A sensor and a body of which neither moves freely (stationary, kinematic) do
 * not look for each other: a sensor that is to see kinematic bodies moves freely itself.
 */
int carom_events(const struct carom_world *world, const struct carom_event **events);

/* Where a HIT was: at the hardest impact of the pair in the frame, which the event is about. */
struct carom_hit {
    carom_v3_q32 point;  /* of the world, halfway between the surfaces */
    carom_v3_q30 normal; /* from b into a */
    uint16_t face_a,
        face_b; /* an edge or a vertex is of the face at it that looks most at the other body */
};
/*
 * The details of a HIT event of the last step. The first of a frame have them, as many as the world has `hits`.
 * Returns CAROM_OK; CAROM_ERR_ARGUMENT for an event that has none.
 */
int carom_event_hit(const struct carom_world *world, const struct carom_event *event,
                    struct carom_hit *hit);

struct carom_face_ref {
    uint16_t body, face;
};
/*
 * Faces of the pairs handed to the collision test, sorted by body and face (paper figure 6). Pairs are
 * found for some frames at once, as long as the bodies go on as they do: a frame may list those of
 * the one before.
 */
int carom_interfering_faces(const struct carom_world *world, const struct carom_face_ref **faces);

struct carom_contact {
    carom_v3_q32 point;
    carom_v3_q30 normal; /* from b into a */
    int32_t gap_q22;     /* distance of the surfaces, negative when they overlap */
    int64_t impulse_q40; /* along the normal, in the last solve */
    uint16_t a, b;
};
/* Copy up to `max` contacts of the last solve of the step; returns how many there are. */
int carom_contacts(const struct carom_world *world, struct carom_contact *contacts, int max);

/* -------------------------------------------------- bodies where they are now */

struct carom_face_pair {
    uint16_t a, b; /* a face of each of two bodies */
};
/*
 * The pairs of faces of bodies a and b that interfere where the bodies are now, whatever their motion:
 * every pair that has a point in common, each once, and hardly any that comes close and has none. The
 * order is the same everywhere.
 *   out   may be NULL when room is 0
 *   room  pairs that `out` can hold
 * Returns how many there are; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself;
 *         CAROM_ERR_FACES_FULL when there are more than `room`: `out` then holds some of them.
 */
int carom_query_faces(struct carom_world *world, int a, int b, struct carom_face_pair *out,
                      uint32_t room);
/*
 * Whether body a lies inside body b, or under it if that is a SURFACE. No faces of theirs may
 * interfere: then all of a is where its first vertex is, unless it is of several parts.
 * Returns 1 or 0; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself.
 */
int carom_query_inside(const struct carom_world *world, int a, int b);

enum carom_stage {
    CAROM_STAGE_PREDICT,
    CAROM_STAGE_BROAD,
    CAROM_STAGE_INTERFERE,
    CAROM_STAGE_BOYSE,
    CAROM_STAGE_CONTACT,
    CAROM_STAGE_IMPACT,
    CAROM_STAGE_REST,
    CAROM_STAGE_ADVANCE,
    CAROM_STAGE_COMMIT,
    CAROM_STAGE_COUNT
};
/* "predict", "broad", ...; "unknown" for a number that is no stage. */
const char *carom_stage_name(int stage);

struct carom_stats {
    uint32_t ticks[CAROM_STAGE_COUNT]; /* config.ticks by stage; 0 without it */
    uint32_t total_ticks;
    uint32_t over_stage;  /* the dearest stage of a step over its budget */
    uint32_t substeps;    /* 1, and one for each hit that was answered and each slice that ended */
    uint32_t hits;        /* that were answered */
    uint32_t gathers;     /* searches for the candidates of one pair */
    uint32_t refinements; /* paths of a pair that were set again to end at its hit, or tried to */
    uint32_t candidates;  /* found by all gathers of the step */
    uint32_t roots;       /* candidates that came to the exact test */
    uint32_t contacts;    /* points of the last solve */
    uint32_t sweeps;      /* of all solves of several contacts */
    uint32_t impacts;     /* contacts solved as impacts */
    uint32_t energy_rule; /* impacts that the energy rule changed */
    uint32_t cut_islands; /* CAROM_EVENT_CUT: islands that began to stand, or were hit again */
    uint32_t calmed;      /* islands and pairs that went on as one body, or came to rest on what
                             stands still: a solve did not part them, or nothing pressed them together */
};
/* What the last step did, by stage. */
int carom_stats(const struct carom_world *world, struct carom_stats *stats);

struct carom_usage {
    const char *name;
    uint32_t size, used, peak, refused; /* used: in the last step; peak, refused: since init */
};
/* How full the pools are, in the order of CAROM_POOLS. */
int carom_usage(const struct carom_world *world, struct carom_usage usage[CAROM_POOL_COUNT]);

/* ----------------------------------------------------------- hash, snapshot */

/* 64-bit FNV-1a of the bytes that carom_snapshot_save writes; 0 for NULL. */
uint64_t carom_world_hash(const struct carom_world *world);

/* Bytes of a snapshot of this world now, or an error. */
int carom_snapshot_size(const struct carom_world *world);
/*
 * Write the dynamic state, the same bytes on every machine. Returns the bytes written or an error.
 */
int carom_snapshot_save(const struct carom_world *world, void *out, size_t bytes);
/*
 * Take a snapshot back into a world that holds the same bodies, surfaces that move being where they
 * were (carom_surface_set; carom_surface_move, too, when it was taken between one and the step).
 * CAROM_ERR_FORMAT for bytes that are not whole, hold a value that no step could have left, or belong
 * to other bodies or surfaces elsewhere; CAROM_ERR_EXTRAS_FULL; the world is then as it was. Masses
 * and materials are not in it: who changes them sets them as they were before the snapshot is taken back.
 */
int carom_snapshot_load(struct carom_world *world, const void *in, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif

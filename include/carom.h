/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Worlds, bodies and steps: the interface of Carom, a real-time impact dynamics engine for polygon meshes, in integers.
 *
 * This header includes carom_mesh.h (meshes) and carom_memory.h (capacities). A program includes the others as it
 * needs them: carom_body.h, carom_joint.h, carom_query.h, carom_draw.h, carom_debug.h, carom_shapes.h, carom_replay.h.
 */
/**
 * @page rules Rules that hold everywhere
 *
 * - **Axes** are right-handed. The corners of a face run counter-clockwise seen from outside. The normal of a contact
 *   between bodies a and b points from b into a.
 * - **Units.** Lengths are in world units; a unit is about the size of a body. Time is counted in frames: one
 *   carom_world_step() is one frame, and velocities are per frame. A name ends in the fractional bits of its number:
 *   `speed_q40` counts 2^-40 units a frame. carom_fix.h has the formats and macros that convert from SI.
 * - **Results.** A function that returns `int` returns a value of 0 or more (CAROM_OK, a status or a count) or a
 *   negative #carom_error.
 * - **All or nothing.** After an error no state has changed and no output is written, unless the comment names what
 *   is. After a step that failed, the lists of what the step found are empty.
 * - **NULL.** A pointer must not be NULL unless its comment says so. A function that returns `int` answers NULL with
 *   CAROM_ERR_NULL; the comments do not repeat this.
 * - **Ranges.** A value outside its stated range gives an error. Only the inline arithmetic of carom_fix.h does not
 *   check: there ranges are the caller's duty.
 * - **Memory** is the caller's, and nothing is allocated. A block stays where it is while it is in use. A world
 *   refers to the meshes of its bodies, so they must outlive it.
 * - **Threads.** One thread at a time uses a world. Worlds in several threads may share meshes, except meshes of
 *   carom_surface_build().
 * - **Determinism.** The same calls give the same bits on every processor and compiler.
 */
#ifndef CAROM_H
#define CAROM_H

#include "carom_memory.h"
#include "carom_mesh.h"
#include "carom_version.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup results Results
 * The values that functions return.
 * @{
 */

/** Results that are no errors. A step returns a sum of these bits. */
enum carom_status {
    CAROM_OK = 0,          /**< success */
    CAROM_OVER_BUDGET = 1, /**< bit: the step took more than carom_config.budget_ticks */
    /** bit: a body had used up its hits, so its island stood still for the rest of the frame (#CAROM_EVENT_CUT) */
    CAROM_SUBSTEP_CAP = 2
};

/** Errors. All are negative. */
enum carom_error {
    CAROM_ERR_NULL = -1,             /**< a pointer that must not be NULL is NULL */
    CAROM_ERR_ARGUMENT = -2,         /**< a value outside its stated range, for example e or mu */
    CAROM_ERR_RANGE = -3,            /**< a number larger than the formats hold */
    CAROM_ERR_MEMORY = -4,           /**< a block that is too small, or not aligned to 8 */
    CAROM_ERR_BODY = -5,             /**< no body has this number */
    CAROM_ERR_BODIES_FULL = -6,      /**< no room for another body */
    CAROM_ERR_PAIRS_FULL = -7,       /**< no room for another pair of bodies */
    CAROM_ERR_CONTACTS_FULL = -8,    /**< no room for another contact */
    CAROM_ERR_FACES_FULL = -9,       /**< no room for another interfering face, or result */
    CAROM_ERR_MESH_EMPTY = -10,      /**< a mesh without faces, or without volume */
    CAROM_ERR_MESH_SIZE = -11,       /**< more than 65535 vertices or 65535 faces */
    CAROM_ERR_MESH_INDEX = -12,      /**< a face names an unknown vertex, or one twice */
    CAROM_ERR_MESH_DEGENERATE = -13, /**< a face without area */
    CAROM_ERR_MESH_OPEN = -14,       /**< an edge of a SOLID has only one face */
    CAROM_ERR_MESH_EDGE = -15,       /**< an edge has three faces, or two that run the same way */
    CAROM_ERR_MESH_INSIDE_OUT = -16, /**< a part of a SOLID is inside out, a SURFACE looks down */
    CAROM_ERR_MESH_SURFACE = -17,    /**< a face of a SURFACE is not single-valued in z */
    CAROM_ERR_FORMAT = -18,          /**< a blob or snapshot cut, altered or of another world */
    CAROM_ERR_BLOCKED = -19,         /**< a body would be pressed into another one */
    CAROM_ERR_NO_ENTRIES = -20,      /**< a surface that moves needs a world with `entries` */
    CAROM_ERR_EXTRAS_FULL = -21,     /**< no room for the extra that the body needs */
    CAROM_ERR_OVERLAP = -22,         /**< a body would cross another one, or lie inside it */
    CAROM_ERR_JOINT = -23,           /**< no joint has this number */
    CAROM_ERR_JOINTS_FULL = -24      /**< no room for another joint */
};

/** Returns a short English text for any result. Never NULL. */
const char *carom_result_text(int result);

/** @} */
/**
 * @defgroup worlds Worlds
 * Make a world in a block of memory, and choose what holds for all of it.
 * @{
 */

/** A world. It lives at the start of the caller's block. */
struct carom_world;

/** A contact that carom_config.contact is asked about: a place where two bodies touch, or soon will. */
struct carom_touch {
    uint16_t a;      /**< body number */
    uint16_t b;      /**< body number */
    uint16_t face_a; /**< face of a. An edge or a vertex counts as its face that looks most at b */
    uint16_t face_b; /**< face of b, likewise */
    carom_v3_q32 point;  /**< place in the world, halfway between the surfaces */
    carom_v3_q30 normal; /**< unit normal, from b into a */
    int64_t speed_q40;   /**< approach speed along the normal, units / frame; negative: they part */
    int32_t restitution_q30; /**< in/out: e, clamped to 0 to 1 */
    uint32_t friction_q16;   /**< in/out: mu, clamped to 0 to 4 */
};

/**
 * A function that is asked about each contact of a step before the solve. It may change e and mu, or drop the contact.
 *
 * When a frame begins, it is asked about every place where two bodies are within five skins of each other. At each
 * hit it is asked about the contacts of the bodies that the hit moves. Contacts come in a fixed order: by a, then b,
 * then features.
 *
 * Returning false drops all contacts of the two bodies: they go through each other until the frame ends. The next
 * frame asks again, but not about places where the bodies already overlap. So drop a contact in every frame until
 * the bodies are apart, or they may stick. Nobody is asked about a body that passes the open side of a one-way body.
 * A sleeping body that is touched wakes before anybody is asked.
 *
 * The function must depend on its arguments alone, or the same calls do not give the same bits. It must not call a
 * function of this world. A step that fails is undone after it asked; a step may ask twice about one contact.
 *
 * @param user   carom_config.contact_user; may be NULL
 * @param touch  the contact
 * @return true to keep the contact, false to drop it
 */
typedef bool carom_contact_function(void *user, struct carom_touch *touch);

/** The settings of a new world. Any field except `caps` may be zero. */
struct carom_config {
    struct carom_caps caps; /**< capacities, see #CAROM_CAPS */
    carom_v3_q40 gravity;   /**< gravity at first, units / frame^2; each component within +-1 */
    bool sleep;             /**< bodies at rest sleep until something wakes them */
    /** most hits of one body in a frame; at the last one its island stands for the rest of the frame; 0: 32 */
    uint8_t substep_cap;
    /**
     * most sweeps over several contacts; 0: 40 to 70. Fewer bound the cost of a frame; the next frame settles the
     * rest
     */
    uint8_t sweep_cap;
    uint32_t (*ticks)(void); /**< a free-running counter for #carom_stats; NULL: no timing */
    uint32_t budget_ticks;   /**< a step that takes more returns CAROM_OVER_BUDGET; 0: no budget */
    /** asked about contacts; NULL: nobody. Needs caps.extras >= 1 */
    carom_contact_function *contact;
    void *contact_user; /**< first argument of `contact`; may be NULL */
};

/**
 * Make an empty world in the caller's block.
 *
 * @param mem         block, aligned to 8; the world lives there
 * @param bytes       size of the block, at least #CAROM_WORLD_BYTES of the capacities
 * @param config      copied
 * @param[out] world  the world
 * @return CAROM_OK; CAROM_ERR_ARGUMENT for a capacity out of range, or a contact function without extras;
 *         CAROM_ERR_RANGE for gravity; CAROM_ERR_MEMORY for a block that is too small or not aligned
 */
int carom_world_init(void *mem, size_t bytes, const struct carom_config *config,
                     struct carom_world **world);

/**
 * Change gravity. A different value wakes every body.
 *
 * @param gravity  units / frame^2, each component within +-1
 * @return CAROM_OK; CAROM_ERR_RANGE for a component out of range, by itself or with the force / mass of a body
 */
int carom_world_set_gravity(struct carom_world *world, const carom_v3_q40 *gravity);

/** @} */
/**
 * @defgroup bodies Bodies
 * Add bodies to a world, place them, lead them, and read where they are.
 *
 * A body is named by its number, or by its id (carom_body_id()). carom_body.h has materials, forces and places.
 * @{
 */

/** Largest coefficient of friction, mu = 4. */
#define CAROM_MU_MAX_Q16 (4 << 16)

/**
 * Which bodies may touch. All zero means the default: category 1, mask 0xffff, group 0.
 *
 * Two bodies of the same group, other than 0, always touch if the group is positive and never if it is negative.
 * Otherwise the category of each must share a bit with the mask of the other. Bodies that may not touch go through
 * each other and cost nothing.
 */
struct carom_filter {
    uint16_t category; /**< bits: the categories of the body */
    uint16_t mask;     /**< bits: the categories that it may touch */
    int16_t group;     /**< a group that overrules both; 0: none */
};

/**
 * The sides from which a body is solid, by an axis of its mesh.
 *
 * A one-way body stops others that come from the side to which the axis points: the normal at the first hit, from
 * this body to the other, is within about 75 degrees of the axis (its cosine is 1/4 or more). A body that comes from
 * elsewhere passes until the two are apart.
 */
enum carom_one_way {
    CAROM_BOTH_WAYS,       /**< solid from all sides */
    CAROM_ONE_WAY_X,       /**< solid from +x */
    CAROM_ONE_WAY_Y,       /**< solid from +y */
    CAROM_ONE_WAY_Z,       /**< solid from +z */
    CAROM_ONE_WAY_MINUS_X, /**< solid from -x */
    CAROM_ONE_WAY_MINUS_Y, /**< solid from -y */
    CAROM_ONE_WAY_MINUS_Z  /**< solid from -z */
};

/**
 * The answer to a body that is added or set where it crosses another body that it may touch, or lies inside it.
 *
 * An overlap of less than about a skin, 1/2048 of a radius, does not count. Two stationary bodies may overlap, and
 * nothing touches a sensor.
 */
enum carom_overlap {
    CAROM_OVERLAP_REFUSE, /**< the call fails with CAROM_ERR_OVERLAP */
    /**
     * the body moves out the shortest way of 27: up against gravity, along the world's axes, and between these; at
     * most 60 units and two radii. If all are blocked, the call fails with CAROM_ERR_BLOCKED
     */
    CAROM_OVERLAP_PUSH_OUT,
    CAROM_OVERLAP_PASS /**< the two go through each other until they are apart */
};

/** The definition of a new body. Any field except `mesh` may be zero. */
struct carom_body_def {
    /** a built mesh; it outlives the body. A SURFACE must be stationary */
    const struct carom_mesh *mesh;
    bool stationary; /**< never moves */
    /** goes where the caller leads it, and pushes what is in the way; takes an extra */
    bool kinematic;
    /** centre of mass (SURFACE: origin of the mesh), units, within +-4096 */
    carom_v3_q32 position;
    carom_quat_q30 rotation; /**< of length 1 within 2^-10; all zero: none */
    carom_v3_q40 velocity;   /**< units / frame; |velocity| + radius |spin| below 64 */
    carom_v3_q40 spin;       /**< angular velocity, radians / frame, world axes; length below 64 */
    uint32_t mass_q20;       /**< 2^-10 to 2^10; 0: the volume of the mesh, at density 1 */
    /** e, 0 to 1; a pair uses the smaller one (carom_world_set_combine()) */
    int32_t restitution_q30;
    uint32_t friction_q16;      /**< mu, 0 to 4; likewise */
    struct carom_filter filter; /**< which bodies it may touch */
    bool sensor; /**< touches nothing; #CAROM_EVENT_SENSOR_BEGIN and _END report what overlaps it */
    uint8_t one_way; /**< #carom_one_way */
    uint8_t overlap; /**< #carom_overlap: what to do if it overlaps another body now */
    void *user;      /**< the caller's pointer, see carom_body_user(); may be NULL */
};

/**
 * Add a body.
 *
 * @param def    copied, except the mesh
 * @return the number of the body (>= 0);
 *         CAROM_ERR_ARGUMENT for e, mu, mass, rotation, `one_way` or `overlap` out of range, for a SURFACE that is not
 *         stationary, and for a body that is stationary and kinematic;
 *         CAROM_ERR_RANGE for a position, speed or size out of range;
 *         CAROM_ERR_BODIES_FULL; CAROM_ERR_EXTRAS_FULL; CAROM_ERR_NO_ENTRIES for a surface that moves;
 *         CAROM_ERR_OVERLAP, CAROM_ERR_BLOCKED by #carom_overlap; CAROM_ERR_PAIRS_FULL for too many that pass
 */
int carom_body_add(struct carom_world *world, const struct carom_body_def *def);

/**
 * Remove a body and its joints. Whatever touches it wakes. A later body may get its number.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_remove(struct carom_world *world, int body);

/** Where a body is, and how it moves. */
struct carom_body_state {
    carom_v3_q32 position;   /**< centre of mass (SURFACE: origin of the mesh), units */
    carom_quat_q30 rotation; /**< from the mesh's axes to the world's */
    carom_v3_q40 velocity;   /**< units / frame, derived from the momentum, which is the state */
    carom_v3_q40 spin;       /**< radians / frame, world axes, derived from the angular momentum */
    bool asleep;             /**< at rest until something wakes it; carom_body_set() ignores it */
    /**
     * left the world's range, or became faster than 64 units or 2^15 radians a frame: frozen in its last pose,
     * touched by nothing; carom_body_set() ignores it
     */
    bool out;
    uint8_t overlap; /**< #carom_overlap, for carom_body_set(); carom_body_get() writes REFUSE */
};

/**
 * Read where a body is and how it moves.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_get(const struct carom_world *world, int body, struct carom_body_state *state);

/** A body as a renderer sees it. */
struct carom_body_look {
    const struct carom_mesh *mesh; /**< its mesh */
    carom_v3_q32 position;         /**< centre of mass (SURFACE: origin of the mesh), units */
    carom_quat_q30 rotation;       /**< from the mesh's axes to the world's */
    bool moving;                   /**< not stationary */
};

/**
 * Read what a renderer needs of a body.
 *
 * @return CAROM_OK; CAROM_ERR_BODY, also for a free number below carom_body_count()
 */
int carom_body_look(const struct carom_world *world, int body, struct carom_body_look *look);

/** Returns the mesh of a body; NULL if there is no such body. */
const struct carom_mesh *carom_body_mesh(const struct carom_world *world, int body);

/** Returns an upper bound: the numbers of all bodies are below it. */
int carom_body_count(const struct carom_world *world);

/**
 * Place a body, and set its velocity and spin.
 *
 * The body wakes, with whatever touched it and whatever is near its new place. Setting a stationary body where it
 * already is wakes nothing. Setting a body where it already is, to change how it moves, is never refused; elsewhere
 * an overlap is handled by carom_body_state.overlap, as in carom_body_add(). A body that passes another one goes on
 * passing it.
 *
 * A kinematic body jumps there. Every later step moves it by the velocity and the spin (at most pi), as if led.
 *
 * @param state  ranges as in #carom_body_def; `asleep` and `out` are ignored
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for rotation or `overlap`; CAROM_ERR_RANGE for position or
 *         speed; CAROM_ERR_OVERLAP, CAROM_ERR_BLOCKED, CAROM_ERR_PAIRS_FULL as carom_body_add()
 */
int carom_body_set(struct carom_world *world, int body, const struct carom_body_state *state);

/** A place and an orientation. */
struct carom_pose {
    carom_v3_q32 position;   /**< units, each component within +-4096 */
    carom_quat_q30 rotation; /**< of length 1 within 2^-10; all zero: none */
};

/**
 * Lead a kinematic body to a pose. The next step takes it there; after that it stands still until led again.
 *
 * On the way the centre moves in a straight line, and the body turns evenly about one axis, by the shorter turn. It
 * pushes and carries what it touches. If it would crush a body, it stops for the rest of the step: the step reports
 * #CAROM_EVENT_BLOCKED, carom_body_get() says how far it came, and the next call may lead it on. This call ends a
 * motion that carom_body_set() began.
 *
 * @param body   a kinematic body
 * @param pose   distance + radius x turn below 64 units from where the body is
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that is not kinematic, or a rotation of another
 *         length; CAROM_ERR_RANGE for a pose too far away or out of range
 */
int carom_body_move_to(struct carom_world *world, int body, const struct carom_pose *pose);

/**
 * Choose which bodies a body may touch, from now on.
 *
 * A different filter wakes the body, with whatever touches it and whatever is near. Bodies that overlap when a filter
 * lets them touch go through each other until they are apart.
 *
 * @param filter  all zero: the default
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_PAIRS_FULL if too many pairs pass each other
 */
int carom_body_set_filter(struct carom_world *world, int body, const struct carom_filter *filter);

/**
 * Read the filter of a body.
 *
 * @return CAROM_OK; CAROM_ERR_BODY
 */
int carom_body_get_filter(const struct carom_world *world, int body, struct carom_filter *filter);

/**
 * Let a force act through the centre of mass of a moving body, until it is changed.
 *
 * A different force wakes the body and all that is connected with it by touching.
 *
 * @param body   a moving body
 * @param force  mass x units / frame^2
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that does not move freely; CAROM_ERR_RANGE if a
 *         component of gravity + force / mass is beyond +-1
 */
int carom_body_set_force(struct carom_world *world, int body, const carom_v3_q40 *force);

/**
 * Give a moving body an impulse at once. The body and all that is connected with it by touching wake.
 *
 * @param body     a moving body
 * @param impulse  mass x units / frame
 * @param point    place in the world where it acts, on the body or not; each component within +-4096
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body that does not move freely or left the world;
 *         CAROM_ERR_RANGE if the body would become faster than carom_body_set() allows
 */
int carom_body_push(struct carom_world *world, int body, const carom_v3_q40 *impulse,
                    const carom_v3_q32 *point);

/** @} */
/**
 * @defgroup surfaces Surfaces that move
 * Give a height field other vertices between steps.
 *
 * The mesh comes from carom_surface_build(), and its world needs `entries`.
 * @{
 */

/**
 * Move the vertices of a surface.
 *
 * The surface stands still within a step. The next step gives its contacts the velocity with which its vertices moved
 * since the last step. Whatever touches it or is near it wakes. Moving bodies that the
 * surface went into are lifted out along its z, with whatever touches them; the surface does that work. The
 * interfering faces and contacts of the last step are forgotten, also by a call that fails because of a lift: with
 * CAROM_ERR_BLOCKED, or a pool that is full.
 *
 * @param body      a body whose mesh is of carom_surface_build()
 * @param vertices  quanta, as many as the mesh has; copied
 * @return CAROM_OK; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body without such a mesh;
 *         CAROM_ERR_RANGE for a coordinate more than 16 units from where it was in the last step, or a surface that is
 *         too large for carom_mesh_build(); CAROM_ERR_MESH_DEGENERATE, CAROM_ERR_MESH_INSIDE_OUT,
 *         CAROM_ERR_MESH_SURFACE; CAROM_ERR_BLOCKED if a lifted body runs into a stationary one;
 *         CAROM_ERR_PAIRS_FULL; CAROM_ERR_FACES_FULL
 */
int carom_surface_move(struct carom_world *world, int body, const int16_t (*vertices)[3]);

/**
 * Put a surface there at once, as if it had been there in the last step.
 *
 * Whatever is in the way stays where it is. Call this before carom_snapshot_load(), to restore the surfaces that a
 * snapshot does not hold.
 *
 * @param body      a body whose mesh is of carom_surface_build()
 * @param vertices  quanta, as many as the mesh has; copied
 * @return as carom_surface_move(), without CAROM_ERR_BLOCKED and the errors of full pools
 */
int carom_surface_set(struct carom_world *world, int body, const int16_t (*vertices)[3]);

/** @} */
/**
 * @defgroup step A step
 * Move a world by one frame.
 * @{
 */

/**
 * Move the world by one frame.
 *
 * @return CAROM_OK or a sum of #carom_status bits; CAROM_ERR_PAIRS_FULL, CAROM_ERR_CONTACTS_FULL,
 *         CAROM_ERR_FACES_FULL; CAROM_ERR_RANGE if a body is too fast beside too large a mesh: their radii and the
 *         distance of a frame and a third must stay below 256 units together. After an error the world is as it was
 *         before, bit for bit.
 *
 * @source paper, figures 4 and 5
 */
int carom_world_step(struct carom_world *world);

/** @} */
/**
 * @defgroup found What the last step found
 * Events, interfering faces and contacts of the last step.
 * @{
 */

/** Kinds of events. a and b are an event's bodies. */
enum carom_event_kind {
    CAROM_EVENT_BEGIN, /**< a and b began to touch */
    CAROM_EVENT_HIT,   /**< a hit b: the hardest impact of the pair in this frame */
    CAROM_EVENT_END,   /**< a and b no longer touch */
    CAROM_EVENT_REST,  /**< a fell asleep */
    CAROM_EVENT_OUT,   /**< a left the world's range and is frozen */
    CAROM_EVENT_WAKE,  /**< a woke, in this step or since the one before */
    /**
     * a hit of a and b used up the hits of one of them: both, and whatever touched them, stood still for the rest of
     * the frame
     */
    CAROM_EVENT_CUT,
    CAROM_EVENT_SENSOR_BEGIN, /**< b began to overlap the sensor a */
    /** b no longer overlaps the sensor a. BEGIN and END in one frame: b went through it, or dipped into it */
    CAROM_EVENT_SENSOR_END,
    CAROM_EVENT_BREAK, /**< joint a took more than carom_joint_def.most_impulse_q40, and broke */
    CAROM_EVENT_BLOCKED /**< kinematic body a would have crushed b, and stopped: carom_body_move_to() */
};

/** An event of a step. */
struct carom_event {
    uint8_t kind;        /**< #carom_event_kind */
    uint16_t a;          /**< body number; of BREAK: joint number */
    uint16_t b;          /**< body number; 0 where the kind has no b */
    uint16_t details;    /**< HIT: for carom_event_hit(); 0: no details were kept */
    int64_t speed_q40;   /**< HIT: approach speed along the normal, units / frame */
    int64_t impulse_q40; /**< HIT: normal impulse, mass x units / frame */
};

/**
 * List the events of the last step, in a fixed order.
 *
 * There are at most 3 events a pair and 2 a body, so a step never fails for them. Two kinds are left out where there
 * is no room: CUT (carom_stats.cut_islands counts all of them), and BEGIN with END of a body that was in a sensor
 * only within the frame. A sensor and a body of which neither moves freely (stationary, kinematic) do not look for
 * each other: a sensor that is to see kinematic bodies must move freely.
 *
 * @param[out] events  the list; it holds until the next call that changes the world
 * @return how many there are
 */
int carom_events(const struct carom_world *world, const struct carom_event **events);

/** Where a HIT was: the hardest impact of the pair in the frame. */
struct carom_hit {
    carom_v3_q32 point;  /**< place in the world, halfway between the surfaces */
    carom_v3_q30 normal; /**< unit normal, from b into a */
    uint16_t face_a; /**< face of a. An edge or a vertex counts as its face that looks most at b */
    uint16_t face_b; /**< face of b, likewise */
};

/**
 * Read the details of a HIT event of the last step. The first hits of a frame have them, as many as carom_caps.hits.
 *
 * @return CAROM_OK; CAROM_ERR_ARGUMENT for an event without details
 */
int carom_event_hit(const struct carom_world *world, const struct carom_event *event,
                    struct carom_hit *hit);

/** A face of a body. */
struct carom_face_ref {
    uint16_t body; /**< body number */
    uint16_t face; /**< face number in its mesh */
};

/**
 * List the interfering faces: those of the pairs that the collision test was given, sorted by body and face.
 *
 * Pairs are gathered for several frames at once while the bodies keep to their paths, so a frame may list the faces
 * of the frame before.
 *
 * @param[out] faces  the list; it holds until the next call that changes the world
 * @return how many there are
 *
 * @source paper, figure 6
 */
int carom_interfering_faces(const struct carom_world *world, const struct carom_face_ref **faces);

/** A contact of the last solve. */
struct carom_contact {
    carom_v3_q32 point;  /**< place in the world, halfway between the surfaces */
    carom_v3_q30 normal; /**< unit normal, from b into a */
    int32_t gap_q22;     /**< distance of the surfaces, units; negative: they overlap */
    int64_t impulse_q40; /**< along the normal, in the last solve, mass x units / frame */
    uint16_t a;          /**< body number */
    uint16_t b;          /**< body number */
};

/**
 * Copy the contacts of the last solve of the step. After a surface was moved there are none until the next step; a body that is
 * removed takes its contacts along.
 *
 * @param[out] contacts  may be NULL if `max` is 0
 * @param max            how many to copy at most
 * @return how many there are, which may be more than `max`
 */
int carom_contacts(const struct carom_world *world, struct carom_contact *contacts, int max);

/** @} */
/**
 * @defgroup now Bodies where they are
 * Which faces of two bodies interfere where the bodies are now. carom_query.h has rays and other questions.
 * @{
 */

/** A face of each of two bodies. */
struct carom_face_pair {
    uint16_t a; /**< face number in the mesh of the first body */
    uint16_t b; /**< face number in the mesh of the second body */
};

/**
 * List the pairs of faces of two bodies that interfere where the bodies are now, whatever their motion.
 *
 * The list has every pair with a point in common, each once, and hardly any other. Its order is the same everywhere.
 *
 * @param world     the world; its state does not change
 * @param a         a body
 * @param b         another body
 * @param[out] out  the pairs; may be NULL if `room` is 0
 * @param room      how many pairs `out` can hold
 * @return how many there are; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself; CAROM_ERR_FACES_FULL if there
 *         are more than `room`: `out` then holds some of them
 */
int carom_query_faces(struct carom_world *world, int a, int b, struct carom_face_pair *out,
                      uint32_t room);

/**
 * Ask if body a lies inside body b, or below b if b is a SURFACE.
 *
 * No faces of the two may interfere. Then the first vertex of a decides for all of a, if the mesh of a is connected.
 *
 * @return 1 or 0; CAROM_ERR_BODY; CAROM_ERR_ARGUMENT for a body and itself
 */
int carom_query_inside(const struct carom_world *world, int a, int b);

/** @} */
/**
 * @defgroup report Cost and room
 * How much the last step did, how long each stage took, and how full the pools are.
 * @{
 */

/** The stages of a step. DESIGN.md describes them. */
enum carom_stage {
    CAROM_STAGE_PREDICT,   /**< paths of the bodies without hits */
    CAROM_STAGE_BROAD,     /**< broad phase: pairs of bodies near each other */
    CAROM_STAGE_INTERFERE, /**< interference detection: candidates of a pair */
    CAROM_STAGE_BOYSE,     /**< collision test: times of impact of candidates */
    CAROM_STAGE_CONTACT,   /**< contacts where a frame begins, and at a hit */
    CAROM_STAGE_IMPACT,    /**< solves with an impact in them */
    CAROM_STAGE_REST,      /**< solves without an impact: resting contacts, joints */
    CAROM_STAGE_ADVANCE,   /**< bodies move to the next hit */
    CAROM_STAGE_COMMIT,    /**< the end of the frame: events, sleep */
    CAROM_STAGE_COUNT      /**< how many stages there are */
};

/** Returns the name of a stage: "predict", "broad", ...; "unknown" for any other number. */
const char *carom_stage_name(int stage);

/** Counts and ticks of the last step. */
struct carom_stats {
    uint32_t ticks[CAROM_STAGE_COUNT]; /**< ticks of carom_config.ticks by stage; 0 without it */
    uint32_t total_ticks;              /**< ticks of the step */
    uint32_t over_stage;               /**< the stage that took most, of a step over its budget */
    uint32_t substeps; /**< 1, plus one for each answered hit and each slice that ended */
    uint32_t hits;     /**< hits that were answered */
    uint32_t gathers;  /**< searches for the candidates of one pair */
    /** times that a pair's paths were, or were to be, set again to end at its hit */
    uint32_t refinements;
    uint32_t candidates;  /**< candidates that all gathers found */
    uint32_t roots;       /**< candidates that came to the exact test */
    uint32_t contacts;    /**< contacts of the last solve */
    uint32_t sweeps;      /**< sweeps of all solves of several contacts */
    uint32_t impacts;     /**< contacts solved as impacts */
    uint32_t energy_rule; /**< impacts that the energy rule changed */
    /** islands that stood still as #CAROM_EVENT_CUT says, or were hit again */
    uint32_t cut_islands;
    /**
     * islands and pairs that went on as one body, or came to rest on what stands still, because a solve did not part
     * them, nothing pressed them together, or their contacts gained energy
     */
    uint32_t calmed;
};

/** Read what the last step did. */
int carom_stats(const struct carom_world *world, struct carom_stats *stats);

/** How full a pool is. */
struct carom_usage {
    const char *name; /**< the name in #CAROM_POOLS */
    uint32_t size;    /**< capacity */
    uint32_t used;    /**< in use in the last step */
    uint32_t peak;    /**< most in use since carom_world_init() */
    uint32_t refused; /**< requests refused since carom_world_init() */
};

/** Read how full the pools are, in the order of #CAROM_POOLS. */
int carom_usage(const struct carom_world *world, struct carom_usage usage[CAROM_POOL_COUNT]);

/** @} */
/**
 * @defgroup state Hash and snapshot
 * The state of a world as a number, and as bytes that restore it on any machine.
 * @{
 */

/** Returns the 64-bit FNV-1a hash of the bytes that carom_snapshot_save() writes; 0 for NULL. */
uint64_t carom_world_hash(const struct carom_world *world);

/** Returns the bytes that a snapshot of this world takes now, or an error. */
int carom_snapshot_size(const struct carom_world *world);

/**
 * Write the dynamic state, the same bytes on every machine.
 *
 * Masses, materials, meshes and capacities are not part of it.
 *
 * @param[out] out  the snapshot
 * @param bytes     room at `out`, at least carom_snapshot_size(); #CAROM_SNAPSHOT_BYTES always suffices
 * @return the bytes written; CAROM_ERR_MEMORY
 */
int carom_snapshot_save(const struct carom_world *world, void *out, size_t bytes);

/**
 * Restore a snapshot in a world that holds the same bodies.
 *
 * First put surfaces that move where they were: carom_surface_set(), and carom_surface_move() if the snapshot was
 * taken between that call and the step. A program that changes masses and materials also sets them as they were
 * before this call.
 *
 * @param in     the snapshot
 * @param bytes  its size
 * @return CAROM_OK; CAROM_ERR_FORMAT for bytes that are cut or altered, hold a value that no step leaves, or belong to
 *         other bodies, or to surfaces elsewhere; CAROM_ERR_EXTRAS_FULL
 */
int carom_snapshot_load(struct carom_world *world, const void *in, size_t bytes);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

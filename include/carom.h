/* SPDX-License-Identifier: MIT */
/*
 * carom.h - real-time impact dynamics of polygon meshes, in integers.
 *
 * The public interface but for drawing, which carom_draw.h has. Rules that hold everywhere:
 *
 *   - Right-handed axes. A face's corners run counter-clockwise seen from outside. N, the normal of
 * a contact between bodies a and b, points from b into a.
 *   - Lengths are in world units; a unit is about the size of a body. Time is counted in frames:
 * one carom_world_step is one frame, and velocities are per frame. carom_fix.h has the formats and
 *     macros that convert from SI.
 *   - Functions return a value >= 0 (CAROM_OK, a status or a count) or a negative enum carom_error.
 *     After an error no state has changed and no output is written; after a step that failed, what
 *     "the last step found" is empty.
 *   - Pointers must not be NULL unless a comment says so; NULL gives CAROM_ERR_NULL.
 *   - Nothing is allocated. The caller's blocks must stay where they are while they are in use, and
 *     a world refers to the meshes that its bodies were made from.
 *   - The same calls give the same bits on every processor and compiler.
 */
#ifndef CAROM_H
#define CAROM_H

#include "carom_fix.h"

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
    CAROM_ERR_NO_ENTRIES = -20       /* a surface that moves needs a world of some entries */
};

/* A short English text for any result. Never NULL. */
const char *carom_result_text(int result);

/* ------------------------------------------------------------------- meshes */

enum carom_mesh_kind {
    CAROM_SOLID = 0,  /* closed, oriented outwards */
    CAROM_SURFACE = 1 /* a height field: open, one z over each x, y, solid below; stationary */
};

/*
 * A mesh as it comes from a converter: triangles over int16 vertices. One quantum, the step of a
 * vertex coordinate, is 2^-quantum_bits world units.
 */
struct carom_mesh_raw {
    const int16_t (*vertices)[3]; /* quanta */
    const uint16_t (*faces)[3];   /* vertex numbers, counter-clockwise from outside */
    uint32_t vertex_count;        /* 3 .. 65535 */
    uint32_t face_count;          /* 1 .. 65535 */
    uint8_t quantum_bits;         /* 7 .. 20 */
    uint8_t kind;                 /* enum carom_mesh_kind */
};

/* A symmetric 3 x 3 matrix: xx, yy, zz, xy, yz, zx, each times 2^-e. */
struct carom_sym3 {
    int32_t m[6];
    int32_t e;
};

/* Mass properties of a SOLID at density 1. */
struct carom_mass {
    int64_t volume_q32;        /* cubic units */
    carom_v3_q22 centre;       /* of mass, in the mesh's coordinates */
    struct carom_sym3 inertia; /* divided by the mass, about the centre of mass; square units */
};

/*
 * H with H H^T = J^-1, J being the inertia over the mass: three columns, each times its 2^-e, in 1 / units.
 * No place of the mesh, nor one within some skins of it, has a component of H_k x place above 2^reach_bits.
 */
struct carom_spread {
    int32_t column[3][3];
    int8_t e[3], reach_bits;
};

/* What follows up to carom_mesh is Carom's own: visible so that you can reserve room for it. */
struct carom_edge {
    uint16_t vertex[2];
    uint16_t face[2];       /* face[0] runs with the edge; face[1] is CAROM_NO_FACE at a border */
    carom_v3_q30 direction; /* from vertex[0] to vertex[1] */
    int32_t length_q22;
};
#define CAROM_NO_FACE 0xffffu

struct carom_face {
    carom_v3_q30 normal;
    int32_t offset_q22; /* of its plane along the normal, from the centre of mass */
    uint32_t edge[3];   /* edge k joins corners k and k+1 */
    uint8_t own;        /* bits 0-2: corner k is tested for this face; bits 3-5: edge k is */
};

/* A cluster of neighbouring faces: what interference detection culls first. */
#define CAROM_LEAF_FACES    14
#define CAROM_LEAF_VERTICES 32
struct carom_leaf {
    carom_v3_q22 centre; /* of a sphere around the leaf, about the centre of mass */
    int32_t radius_q22;
    carom_v3_q30 axis;         /* the mean normal of its faces, and how far it reaches */
    int32_t low_q22, high_q22; /* along that from the centre of mass */
    uint32_t owned;            /* its vertices that are tested for one of its faces, a bit each */
    uint32_t first_face;       /* into leaf_faces */
    uint32_t first_vertex;     /* into leaf_vertices */
    uint8_t face_count, vertex_count;
};

/* An entry of a mesh's own z-lists. */
struct carom_zref {
    int16_t z0, z1; /* quanta */
    uint16_t face;
};

struct carom_surface;

/* An indexed mesh, ready to be used by bodies of any world. Read only after the build. */
struct carom_mesh {
    struct carom_mesh_raw raw;
    struct carom_mass mass;                  /* SOLID; zero for a SURFACE */
    struct carom_sym3 inverse, inverse_rest; /* their sum: of mass.inertia; zero if it has none */
    struct carom_spread spread;              /* zero as well then */
    uint32_t edge_count, leaf_count, zref_count;
    int32_t radius_q22;       /* of the sphere around the centre of mass (SURFACE: the origin) */
    int16_t box[2][3];        /* quanta: lowest and highest corner */
    int32_t grid_x0, grid_y0; /* quanta: corner of the cell grid over x, y */
    uint8_t grid_shift, grid_nx, grid_ny; /* cells of 2^shift quanta */
    const struct carom_face *faces;
    const struct carom_edge *edges;
    const uint32_t *ring_start; /* vertex v's edges are ring[ring_start[v] .. ring_start[v+1]) */
    const uint32_t *ring; /* edge number * 2 + 1 when the edge ends at v, + 0 when it starts */
    const struct carom_leaf *leaves;
    const uint16_t *leaf_faces;
    const uint16_t *leaf_vertices;
    const uint8_t (*leaf_corners)[3]; /* a leaf face's corners as places in its leaf's vertices */
    const uint32_t *cell_start; /* cell c's entries are zrefs[cell_start[c] .. cell_start[c+1]) */
    const struct carom_zref *zrefs; /* sorted by z1, highest first */
    struct carom_surface *surface;  /* of carom_surface_build; else NULL */
};

/*
 * Memory that carom_mesh_build needs for any mesh of so many vertices and faces; a constant
 * expression and a multiple of 8, so that blocks can lie end to end. Derived in SPEC.md.
 */
#define CAROM_MESH_BYTES(vertices, faces) CAROM_MESH_BYTES_((size_t)(vertices), (size_t)(faces))
#define CAROM_MESH_BYTES_(v, f)                                                                    \
    (CAROM_ARRAY_(struct carom_face, f) +                                                          \
     CAROM_ARRAY_(struct carom_edge, CAROM_MESH_EDGES_(v, f)) + CAROM_ARRAY_(uint32_t, (v) + 1) +  \
     CAROM_ARRAY_(uint32_t, 2 * CAROM_MESH_EDGES_(v, f)) +                                         \
     CAROM_ARRAY_(struct carom_leaf, CAROM_MESH_LEAVES_(v, f)) + CAROM_ARRAY_(uint16_t, f) +       \
     CAROM_ARRAY_(uint16_t, CAROM_MESH_LEAF_VERTICES_(v, f)) + CAROM_ARRAY_(uint8_t, 3 * (f)) +    \
     CAROM_ARRAY_(uint32_t, CAROM_MESH_CELLS_(f) + 1) +                                            \
     CAROM_ARRAY_(struct carom_zref, CAROM_MESH_ENTRIES_(f)))
/* The most there may be of edges, of leaves and their vertices, of cells and of their entries. */
#define CAROM_MESH_EDGES_(v, f)                                                                    \
    CAROM_MORE_(3 * (f) / 2, CAROM_LESS_(3 * (f), 3 * (v)-6)) /* v is 3 or more */
#define CAROM_MESH_LEAVES_(v, f)                                                                   \
    (((f) + CAROM_LEAF_FACES - 1) / CAROM_LEAF_FACES * ((v) > CAROM_LEAF_VERTICES ? 2 : 1))
#define CAROM_MESH_LEAF_VERTICES_(v, f) CAROM_LESS_(3 * (f), (v)*CAROM_MESH_LEAVES_(v, f))
#define CAROM_MESH_CELLS_(f)            CAROM_LESS_(1024, 2 * (f) / 3 + 1)
#define CAROM_MESH_ENTRIES_(f)          (8 * (f))
#define CAROM_ARRAY_(type, n)           (((n) * sizeof(type) + 7) / 8 * 8)
#define CAROM_LESS_(a, b)               ((a) < (b) ? (a) : (b))
#define CAROM_MORE_(a, b)               ((a) > (b) ? (a) : (b))

/*
 * Whether a raw mesh can be built: what carom_mesh_build would return.
 *   scratch  CAROM_MESH_BYTES(vertices, faces) bytes, aligned to 8; overwritten
 */
int carom_mesh_check(const struct carom_mesh_raw *raw, void *scratch, size_t bytes);

/*
 * Check and index a mesh: edges, planes, bounds, clusters, mass and its own z-lists.
 *
 *   mesh   out  ready to use; refers to raw's arrays and to mem
 *   raw    in   its arrays must outlive the mesh
 *   mem    in   CAROM_MESH_BYTES(vertices, faces) bytes, aligned to 8; overwritten
 *
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT for kind or quantum_bits; CAROM_ERR_MEMORY;
 *          CAROM_ERR_RANGE for a box with a side over 256 or a diagonal over 384 units, or one that
 *          winds around itself so often that its volume does not fit;
 *          or the first CAROM_ERR_MESH_... that holds. mesh is written only for CAROM_OK.
 */
int carom_mesh_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                     size_t bytes);

/*
 * A SURFACE whose vertices may be moved while it is in a world, by carom_surface_move. As
 * carom_mesh_build, but
 *
 *   mesh   must stay where it is; for one body of one world
 *   raw    its vertices are copied and not needed any more; its faces must outlive the mesh
 *   mem    CAROM_SURFACE_BYTES(vertices, faces) bytes of RAM: what is built and two copies of the
 *          vertices live in it
 *
 * Returns  CAROM_ERR_ARGUMENT for a SOLID as well.
 */
#define CAROM_SURFACE_BYTES(vertices, faces)                                                       \
    (CAROM_MESH_BYTES(vertices, faces) + ((size_t)12 * (size_t)(vertices) + 80 + 7) / 8 * 8)
int carom_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                        size_t bytes);

/*
 * Read a mesh from the binary blob that the mesh converter writes (layout: SPEC.md).
 *   mem  receives vertices and faces: CAROM_BLOB_BYTES(vertices, faces) bytes, aligned to 8
 * Returns CAROM_OK; CAROM_ERR_FORMAT for a blob that is truncated or altered; CAROM_ERR_MEMORY.
 */
#define CAROM_BLOB_BYTES(vertices, faces)                                                          \
    ((size_t)6 * (size_t)(vertices) + (size_t)6 * (size_t)(faces) + 16)
int carom_mesh_read(struct carom_mesh_raw *raw, const void *blob, size_t blob_bytes, void *mem,
                    size_t bytes);

/* ------------------------------------------------------- a world's memory */

/*
 * Capacities of a world, in this order. One list gives the block's size, the initialiser, the names
 * and the usage report.
 *
 *   bodies      moving and stationary
 *   pairs       of bodies near each other in one frame; of bodies that touch, asleep or not
 *   contacts    places within the margin, neighbouring ones merged
 *   faces       interfering faces of one frame
 *   entries     of z-lists made within a step, for surfaces that move under the bodies over them;
 *               working; none when all meshes are rigid: these bring theirs
 *   candidates  vertex/face and edge/edge pairs kept; working: fewer cost time, not results
 *
 *   X(name, bytes for each, smallest allowed, largest allowed)
 */
#define CAROM_POOLS(X)                                                                             \
    X(bodies, CAROM_BODY_BYTES, 1, 4095)                                                           \
    X(pairs, CAROM_PAIR_BYTES, 1, 65535)                                                           \
    X(contacts, CAROM_CONTACT_BYTES, 1, 4096)                                                      \
    X(faces, CAROM_FACE_BYTES, 1, 65535)                                                           \
    X(entries, CAROM_ENTRY_BYTES, 0, 65535)                                                        \
    X(candidates, CAROM_CANDIDATE_BYTES, 1, 65535)

/*
 * Bytes for one of each, its share of the lists that follow it included, where a pointer has 32 bits
 * or fewer, and 64; held by assertions.
 */
#define CAROM_BYTES_(narrow, wide) (sizeof(void *) > 4 ? (wide) : (narrow))
#define CAROM_BODY_BYTES           CAROM_BYTES_(800, 800)
#define CAROM_PAIR_BYTES           CAROM_BYTES_(64, 64)
#define CAROM_CONTACT_BYTES        CAROM_BYTES_(224, 248)
#define CAROM_FACE_BYTES           4
#define CAROM_ENTRY_BYTES          8
#define CAROM_CANDIDATE_BYTES      12
#define CAROM_WORLD_FIXED_BYTES    CAROM_BYTES_(584, 768)
/* For any entries at all: once, and for each contact. */
#define CAROM_HEADS_BYTES 2048
#define CAROM_DRIFT_BYTES 24
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
    uint32_t bodies, pairs, contacts, faces, entries, candidates;
};

/*
 * Bytes of the block of a world. The arguments are the six capacities in the order above, so
 *
 *   #define CAPS 2, 1, 64, 512, 256, 1024
 *   static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
 *   struct carom_config config = {.caps = {CAPS}};
 */
#define CAROM_WORLD_BYTES(...) CAROM_WORLD_BYTES_(__VA_ARGS__)
#define CAROM_WORLD_BYTES_(b, p, c, f, e, n)                                                       \
    ((size_t)CAROM_WORLD_FIXED_BYTES + (size_t)(b)*CAROM_BODY_BYTES +                              \
     (size_t)(p)*CAROM_PAIR_BYTES + (size_t)(c)*CAROM_CONTACT_BYTES +                              \
     (size_t)(f)*CAROM_FACE_BYTES + (size_t)(e)*CAROM_ENTRY_BYTES +                                \
     ((e) > 0 ? CAROM_HEADS_BYTES + (size_t)(c)*CAROM_DRIFT_BYTES : 0) +                           \
     (size_t)(n)*CAROM_CANDIDATE_BYTES +                                                           \
     CAROM_MORE_(CAROM_SOLVE_BYTES_((size_t)(p), (size_t)(c)),                                     \
                 CAROM_FOUND_BYTES_((size_t)(b), (size_t)(p)) + CAROM_SCRATCH_BYTES))
#define CAROM_FOUND_BYTES_(b, p) ((2 * (p) + (b)) * sizeof(struct carom_event))
#define CAROM_SOLVE_BYTES_(p, c) ((c)*CAROM_WORK_BYTES + CAROM_LESS_(p, c) * CAROM_ROLL_BYTES)

/* ------------------------------------------------------------------- worlds */

struct carom_world; /* lives at the start of the caller's block */

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
};

/*
 * Make an empty world in the caller's block.
 *   mem    aligned to 8; bytes >= CAROM_WORLD_BYTES(caps): one byte less is CAROM_ERR_MEMORY
 *   world  out
 */
int carom_world_init(void *mem, size_t bytes, const struct carom_config *config,
                     struct carom_world **world);

#define CAROM_MU_MAX_Q16 (4 << 16)

struct carom_body_def {
    const struct carom_mesh *mesh;
    bool stationary;
    carom_v3_q32 position;   /* of the centre of mass; of a SURFACE's origin. Within +-4096 */
    carom_quat_q30 rotation; /* of length 1 within 2^-10; all zero means none */
    carom_v3_q40 velocity;   /* units / frame; |velocity| + radius |spin| below 64 */
    carom_v3_q40 spin;       /* radians / frame in world axes, length below 64 */
    uint32_t mass_q20;       /* 2^-10 .. 2^10; 0: the mesh's volume, density 1 */
    int32_t restitution_q30; /* e, 0 .. 1; a pair takes the smaller of its two */
    uint32_t friction_q16;   /* mu, 0 .. 4; a pair takes the smaller of its two */
};

/*
 * Add a body. Returns its number (>= 0) or an error: CAROM_ERR_ARGUMENT for e, mu, mass or rotation
 * out of range, CAROM_ERR_RANGE for a place or speed out of range, CAROM_ERR_BODIES_FULL,
 * CAROM_ERR_NO_ENTRIES. A SURFACE must be stationary.
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
 * body that is set where it is wakes nothing. asleep and out are ignored.
 */
int carom_body_set(struct carom_world *world, int body, const struct carom_body_state *state);

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
    CAROM_EVENT_CUT    /* at a hit of a and b one of them used up its hits: both, and what touched
                          them, stood for the rest of the frame */
};

struct carom_event {
    uint8_t kind;
    uint16_t a, b;       /* body numbers; b is unused (0) for REST, OUT and WAKE */
    int64_t speed_q40;   /* HIT: approach speed along the normal, units / frame */
    int64_t impulse_q40; /* HIT: normal impulse, mass x units / frame */
};

/*
 * Events of the last step, in a fixed order. At most 3 a pair and 2 a body: never a failure. A CUT
 * for which there is no room is left out; stats.cut_islands counts all of them.
 */
int carom_events(const struct carom_world *world, const struct carom_event **events);

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
 * to other bodies or surfaces elsewhere; the world is then as it was.
 */
int carom_snapshot_load(struct carom_world *world, const void *in, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif

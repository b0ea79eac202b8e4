/* SPDX-License-Identifier: MIT */
/*
 * parts - what the files that solve several contacts share: velocities and masses of contacts, sweeps,
 * and the energy rule.
 */
#ifndef CAROM_SRC_REST_PARTS_H
#define CAROM_SRC_REST_PARTS_H

#include "rest.h"

/*
 * dv has this many bits below the solver's unit: a share of 1/2 makes every other change of it a tie,
 * and ties go upward. du has turn_bits + 1, for a place may move by so much less than du.
 */
#define REST_FINER_BITS 3

/* When dv or du use more than these the unit is too small, and there is a larger one. */
#define REST_USED_BITS 29

/*
 * Sweeps end when no velocity changes by more than this, in solver units. Contacts of a body or two that
 * slide or roll settle over the frames, and creep by what is left: so few have a residual of their own.
 */
#define REST_FEW               8
#define REST_RESIDUAL_EXACT    1
#define REST_RESIDUAL_IMPACT   (1 << (REST_BITS - 20))
#define REST_RESIDUAL_REST     (1 << (REST_BITS - 13))
#define REST_RESIDUAL_REST_FEW (1 << (REST_BITS - 16))

struct rest_sweep {
    int unit;     /* a solver unit of velocity is 2^unit of q40 */
    bool plastic; /* impacts end at 0: the frictionless solution of the energy rule */
    bool frictionless;
    bool calm;  /* without momentum, each sweep takes energy away */
    bool exact; /* to the last place, calm as well: an impact of a body or two */
    int32_t residual;
    int64_t loose_q40; /* a change of velocity that is as good as none; 0: none is */
    bool rolls;        /* resting contact, with rolling friction: no contact is an impact */
    bool ran_out;      /* out: they ended before the residual was reached */
};

/* The body and state on a side of a contact: 0 is a, 1 is b. */
inline struct body *rest_body(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->bodies[side == 0 ? p->a : p->b];
}

static inline struct body_state *rest_state(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->states[side == 0 ? p->a : p->b];
}

/* Find the islands that the contacts make, and list the contacts by island, then by key. */
void rest_list_islands(struct rest *r);
/* Take up the island whose contacts begin at r->first; false when they are all idle. */
bool rest_take_island(struct rest *r);

/* Contact i, below r->count, of the island at hand. */
inline struct contact *rest_contact(const struct rest *r, uint32_t i)
{
    return &r->list.contacts[r->list.contacts[r->first + i].order];
}

/* True if contact n is there and belongs to the pair of contact i. */
static inline bool rest_same_pair(const struct rest *r, uint32_t i, uint32_t n)
{
    return n < r->count && rest_contact(r, n)->key.pair == rest_contact(r, i)->key.pair;
}

/* Whether one body moves in the island, or two. */
static inline bool rest_up_to_two(const struct rest *r)
{
    uint16_t next = r->bodies[r->island].island.next;

    return next == ISLAND_END || r->bodies[next].island.next == ISLAND_END;
}

/* Add `times` twice what a surface that moves does by a contact's impulse, q80; 1 or -1 times. */
void rest_add_work2(struct fix_wide *sum, const struct contact *c, int times);

/* Row i of a symmetric matrix, xx yy zz xy yz zx, times v. */
static inline int64_t rest_row(const int32_t m[6], int i, const int32_t v[3])
{
    const int32_t row[3] = {m[fix_sym3_at[i][0]], m[fix_sym3_at[i][1]], m[fix_sym3_at[i][2]]};

    return carom_dot(row, v);
}

/* A body's R H; then K of its contacts and the steps of a sweep. */
void rest_prepare_body(struct body *b);
/* Returns false when a body's turn_bits had to be raised: then all of its contacts must be prepared anew. */
bool rest_prepare_masses(struct contact *c);
/* K^-1, which a contact needs when it pushes; many that rest do not. */
void rest_invert(struct contact *c);
/* What a contact that slides needs besides. */
void rest_prepare_slide(struct contact *c);

/* Add to a velocity; returns which bits it uses. The sum wraps: what outgrows its bits begins anew. */
static inline uint32_t rest_add(int32_t *v, int32_t change)
{
    *v = (int32_t)((uint32_t)*v + (uint32_t)change);
    return (uint32_t)(*v ^ (*v >> 31));
}

static inline int32_t turn_by(const struct contact_lever *lever, int k, const int32_t own[3], int s)
{
    return (int32_t)fix_round((int64_t)lever->turn[0][k] * own[0] +
                                  (int64_t)lever->turn[1][k] * own[1] +
                                  (int64_t)lever->turn[2][k] * own[2],
                              s);
}

/* By how many bits products of turn and an impulse with so many fractional bits are finer than du. */
static inline int rest_turn_shift(const struct body *b, int fine_bits)
{
    return 30 + fine_bits - 2 * b->solve.turn_bits;
}

/*
 * dv and du of a body by an impulse below 2^31 with so many fractional bits. `turn` has units of
 * 2^(turn_bits - 31), du of 2^-(turn_bits + 1).
 */
static inline void rest_push_side(struct body *b, const struct contact_lever *lever,
                                  const int32_t impulse[3], int fine_bits)
{
    struct body_path *in = body_solve(b);
    const int down = fine_bits - REST_FINER_BITS, s = rest_turn_shift(b, fine_bits);
    int32_t own[3] = {impulse[0], impulse[1], impulse[2]};

    if (lever->share_q30 != CAROM_ONE_Q30) {
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            own[k] = carom_mul_q30(own[k], lever->share_q30);
        }
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        in->used |=
            rest_add(&in->dv[k], own[k] >> down) | rest_add(&in->du[k], turn_by(lever, k, own, s));
    }
}

/* Give the bodies an impulse on a, and its opposite on b; the components are below 2^31. */
void rest_push(struct contact *c, const int32_t impulse[3]);
/* |v|^2 of a vector of at most 31 bits. */
static inline uint64_t rest_square32(const int32_t v[3])
{
    return (uint64_t)((int64_t)v[0] * v[0]) + (uint64_t)((int64_t)v[1] * v[1]) +
           (uint64_t)((int64_t)v[2] * v[2]);
}

/* Bits that four numbers use, signs apart. */
inline uint64_t rest_used(const int64_t v[4])
{
    int64_t used = v[3] ^ (v[3] >> 63);

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        used |= v[k] ^ (v[k] >> 63);
    }
    return (uint64_t)used;
}

/* Shift four numbers down; until each has at most so many bits, which most have: returns how far. */
int rest_shift_down(int64_t v[4], int down);
inline int rest_shrink(int64_t v[4], int bits)
{
    uint64_t all = rest_used(v);

    return all >> bits == 0 ? 0 : rest_shift_down(v, fix_bits(all) - bits);
}
/* v cut to a length of `limit`, which is at most 2^45; returns whether it was longer. */
bool rest_cut(int64_t v[3], int64_t limit);

/*
 * Sweeps in the island at hand begin with a unit and with velocities in it, perhaps with kept impulses; then with
 * what these change velocities by. That may not fit, as later velocities may not: then the unit is enlarged,
 * and sums are formed anew. They end with the impulses of the contacts, to the last place of q40.
 */
void rest_choose_unit(const struct rest *r, struct rest_sweep *sw);
void rest_begin_sweeps(struct rest *r, const struct rest_sweep *sw);
bool rest_sum_up(struct rest *r);
void rest_enlarge_unit(struct rest *r, struct rest_sweep *sw);
void rest_end_sweeps(struct rest *r, const struct rest_sweep *sw);

/* Start from the impulses of the last frame. */
void rest_load_warm(struct rest *r, const struct rest_sweep *sw);

/*
 * Rolling friction of the pair whose first contact in the island is the i-th. Before the sweeps,
 * when it returns whether there is any; a step of a sweep, which returns how much a velocity moved;
 * a step of the acceleration; the result, with none a result of 0.
 */
bool rest_roll_prepare(struct rest *r, uint32_t i, const struct rest_sweep *sw);
int64_t rest_roll_sweep(struct rest *r, uint32_t i, int32_t quiet);
void rest_roll_accelerate(struct contact *c, int32_t part_q30);
void rest_roll_finish(struct contact *c, const struct rest_sweep *sw);

/*
 * What follows works on the island at hand.
 *
 * Sweep until the residual is reached; impulses go to impulse_q40 of the contacts, not to the
 * bodies. Takes velocity_q40 of the contacts, whose place they need.
 */
void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm);

/* p += P, L += r x P and a moment on a, the same against b; of one contact, and of all. */
void rest_apply_at(struct rest *r, const struct contact *c, const int64_t impulse_q40[3],
                   const int64_t moment_q40[3]);
void rest_apply(struct rest *r);

/* e and mu at a contact; by its materials, where the list is not `plain`. */
int32_t rest_mixed_restitution(const struct rest *r, const struct contact *c);
uint32_t rest_mixed_friction(const struct rest *r, const struct contact *c);
inline int32_t rest_restitution_at(const struct rest *r, const struct contact *c)
{
    return r->list.plain ? rest_plain_restitution(rest_body(r, c, 0), rest_body(r, c, 1))
                         : rest_mixed_restitution(r, c);
}
inline uint32_t rest_friction_at(const struct rest *r, const struct contact *c)
{
    return r->list.plain ? rest_plain_friction(rest_body(r, c, 0), rest_body(r, c, 1))
                         : rest_mixed_friction(r, c);
}

/* The wanted normal velocity of a contact after the solve. */
void rest_prepare_target(const struct rest *r, struct contact *c, int32_t tau_q30);
/* Whether a contact is so slow that its bodies lie; where they bounce for ever, along and across. */
bool rest_lies(const struct rest *r, const struct contact *c);

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b) by the velocities that the bodies were given last. */
void rest_relative_velocity(const struct contact *c, carom_v3_q40 *v);
/* V.N */
int64_t rest_speed_q40(const struct contact *c);
/* Before another solve of a contact: its impulse is the one that was wanted, V is that before. */
void rest_want(struct contact *c);

/*
 * Give contact i of a face on a face the normal of one before it that differs by a hair, or its
 * opposite. Takes velocity_q40 of the contact.
 */
void rest_share_normal(struct rest *r, uint32_t i);

/* Set the momenta of the island's bodies aside before a solve. */
void rest_save_momenta(struct rest *r);

/*
 * The energy rule for several contacts, after the impulses were applied: if energy rose above what
 * it was before, and where contact `lifts` above what that may add, go back towards the frictionless
 * plastic solution as far as needed. In lasting contact it may rise by a 256th: the frame gives that back
 * in the end.
 */
void rest_energy_rule(struct rest *r, bool lifts, bool lasting);

/*
 * After sweeps that ran out: take out without friction what places still approach by, where they do.
 */
void rest_part(struct rest *r);
/* Whether a contact approaches by more than it was asked to and a small part of its skin a frame. */
bool rest_approaches(struct rest *r);

/*
 * The functions that a solve calls for joints. carom_joint_add sets the table, so that who has no joints links none of
 * them. All but the first two are about the island at hand.
 */
struct rest_sweep;
struct joint_calls {
    /* islands of bodies that joints hold; with states, but for those that are out of the world */
    void (*join)(struct rest *r, const struct body_state *states);
    void (*join_solved)(struct rest *r);     /* of those that are solved now */
    void (*load_velocities)(struct rest *r); /* of bodies that no contact asked for */
    void (*enter)(
        struct rest *
            r); /* whoever hangs on a body that newly is in contact is so too; others' joints are idle */
    bool (*take)(struct rest *r); /* list its joints; whether all are idle */
    bool (*take_next)(
        struct rest *r); /* an island without contacts, which has a joint that is not idle */
    /* before the sweeps: levers and K^-1, false when a body's turn_bits had to be raised; the largest change wanted */
    bool (*prepare)(struct rest *r);
    int64_t (*largest_q40)(const struct rest *r);
    /* velocities in the unit, and no impulses; the kept ones; a larger unit; what impulses change velocities by */
    void (*begin)(struct rest *r, const struct rest_sweep *sw);
    void (*load_warm)(struct rest *r, const struct rest_sweep *sw);
    void (*enlarge)(struct rest *r, const struct rest_sweep *sw, int bits);
    void (*sum_up)(struct rest *r);
    void (*drop)(struct rest *r); /* impulses */
    /* a sweep: how much a velocity moved; how far it agrees with the step beyond the last one; that step */
    int64_t (*sweep)(struct rest *r, int32_t quiet);
    int64_t (*agrees)(const struct rest *r, int32_t most);
    void (*accelerate)(struct rest *r, int32_t part_q30);
    /* after them: impulses to momentum; to the bodies; what is kept of them, and the work of limits and motors */
    void (*end)(struct rest *r, const struct rest_sweep *sw);
    void (*apply)(struct rest *r);
    void (*book)(struct rest *r);
};

/* The table of every world that has joints. */
extern const struct joint_calls joint_calls;

static inline bool rest_has_joints(const struct rest *r)
{
    return r->joints.first != 0;
}

/* Keep the impulses of all resting contacts for the next frame. */
void rest_store_warm(struct rest *r);

#endif

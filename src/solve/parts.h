/* SPDX-License-Identifier: MIT */
/*
 * parts - what the files that solve several contacts share: velocities and masses of contacts, sweeps,
 * and the energy rule.
 */
#ifndef CAROM_SRC_REST_PARTS_H
#define CAROM_SRC_REST_PARTS_H

#include "rest.h"

/*
 * dv has this many bits below the solver's unit: a share of 1/2 makes every other change of it a
 * tie, and ties round upward. du has turn_bits + 1 bits, because a place may move by that much less
 * than du.
 */
#define REST_FINER_BITS 3

/* If dv or du use more bits than this the unit is too small and is enlarged. */
#define REST_USED_BITS 29

/* Most turn_bits of a body, which bounds K: a place that would turn farther counts as turning so far. */
#define REST_TURN_BITS_MAX 14

struct rest_sweep {
    int unit;     /* a solver unit of velocity is 2^unit of q40 */
    bool plastic; /* impacts end at V.N = 0: the plastic solution of the energy rule */
    bool parts;   /* with plastic: but contacts that are nearly closed open */
    bool frictionless;
    bool calm;  /* without momentum each sweep takes energy away */
    bool exact; /* to the last place, and calm: an impact of one body or two */
    int32_t residual;
    int64_t loose_q40; /* a change of velocity below this counts as none; 0: no such limit */
    bool rolls;        /* resting contact with rolling friction: no contact is an impact */
    bool ran_out;      /* out: the sweeps ended before the residual was reached */
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
/*
 * Set r->count and r->island for the island whose contacts begin at r->first. Returns false if all
 * are idle.
 */
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

/* True if at most two bodies move in the island. */
static inline bool rest_up_to_two(const struct rest *r)
{
    uint16_t next = r->bodies[r->island].island.next;

    return next == ISLAND_END || r->bodies[next].island.next == ISLAND_END;
}

/*
 * Add `times` twice the work that a moving surface does by a contact's impulse, q80; times is 1 or
 * -1.
 */
void rest_add_work2(struct fix_wide *sum, const struct contact *c, int times);

/* Row i of a symmetric matrix, xx yy zz xy yz zx, times v. */
static inline int64_t rest_row(const int32_t m[6], int i, const int32_t v[3])
{
    const int32_t row[3] = {m[fix_sym3_at[i][0]], m[fix_sym3_at[i][1]], m[fix_sym3_at[i][2]]};

    return carom_dot(row, v);
}

/* Set a body's R H. Before its contacts' K and sweep steps. */
void rest_prepare_body(struct body *b);
/*
 * Set K and shares of a contact. Returns false if a body's turn_bits had to be raised: then all of
 * its contacts must be prepared anew.
 */
bool rest_prepare_masses(struct contact *c);
/* Set K^-1, which a contact needs once it pushes; many resting contacts never do. */
void rest_invert(struct contact *c);
/* Set what a contact needs besides if it slides. */
void rest_prepare_slide(struct contact *c);

/*
 * Add to a velocity; returns the bits in use. The sum wraps: a velocity that outgrows its bits
 * begins anew.
 */
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

/*
 * The number of bits by which products of turn and an impulse with fine_bits fractional bits are
 * finer than du.
 */
static inline int rest_turn_shift(const struct body *b, int fine_bits)
{
    return 30 + fine_bits - 2 * b->solve.turn_bits;
}

/*
 * Change dv and du of a body by an impulse below 2^31 with fine_bits fractional bits. `turn` has
 * units of 2^(turn_bits - 31), du of 2^-(turn_bits + 1).
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

/* Apply an impulse to a, and its opposite to b; components are below 2^31. */
void rest_push(struct contact *c, const int32_t impulse[3]);
/* |v|^2 of a vector of at most 31 bits. */
static inline uint64_t rest_square32(const int32_t v[3])
{
    return (uint64_t)((int64_t)v[0] * v[0]) + (uint64_t)((int64_t)v[1] * v[1]) +
           (uint64_t)((int64_t)v[2] * v[2]);
}

/* The bits that four numbers use, without signs. */
inline uint64_t rest_used(const int64_t v[4])
{
    int64_t used = v[3] ^ (v[3] >> 63);

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        used |= v[k] ^ (v[k] >> 63);
    }
    return (uint64_t)used;
}

/*
 * rest_shift_down: shift four numbers down. rest_shrink: until each has at most `bits` bits, which
 * is mostly so; returns the shift.
 */
int rest_shift_down(int64_t v[4], int down);
inline int rest_shrink(int64_t v[4], int bits)
{
    uint64_t all = rest_used(v);

    return all >> bits == 0 ? 0 : rest_shift_down(v, fix_bits(all) - bits);
}
/* Cut v to a length of `limit`, at most 2^45. Returns true if it was longer. */
bool rest_cut(int64_t v[3], int64_t limit);

/*
 * Begin and end of sweeps in the island at hand. rest_choose_unit sets the unit; rest_begin_sweeps
 * sets velocities in it and no impulses; rest_sum_up sets dv and du from the impulses, false if
 * they do not fit; rest_enlarge_unit then takes a larger unit, and sums are formed anew;
 * rest_end_sweeps sets the contacts' impulses, to the last place of q40.
 */
void rest_choose_unit(const struct rest *r, struct rest_sweep *sw);
void rest_begin_sweeps(struct rest *r, const struct rest_sweep *sw);
bool rest_sum_up(struct rest *r);
void rest_enlarge_unit(struct rest *r, struct rest_sweep *sw);
void rest_end_sweeps(struct rest *r, const struct rest_sweep *sw);

/* Start contacts from the kept impulses of the last frame. */
void rest_load_warm(struct rest *r, const struct rest_sweep *sw);

/*
 * Rolling friction of the pair whose first contact in the island is the i-th. Before the sweeps:
 * returns true if there is any. A step of a sweep: returns how much a velocity moved. A step of the
 * acceleration. The result; 0 if there was none.
 */
bool rest_roll_prepare(struct rest *r, uint32_t i, const struct rest_sweep *sw);
int64_t rest_roll_sweep(struct rest *r, uint32_t i, int32_t quiet);
void rest_roll_accelerate(struct contact *c, int32_t part_q30);
void rest_roll_finish(struct contact *c, const struct rest_sweep *sw);

/*
 * From here on functions work on the island at hand.
 *
 * Sweep until the residual is reached. Impulses go to the contacts, not to the bodies. Uses up
 * velocity_q40 of the contacts, whose room the sweeps need.
 */
void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm);

/*
 * Apply an impulse P and a moment on a, and their opposites on b: p += P, L += r x P + moment; of
 * one contact; of all contacts and joints.
 */
void rest_apply_at(struct rest *r, const struct contact *c, const int64_t impulse_q40[3],
                   const int64_t moment_q40[3]);
void rest_apply(struct rest *r);

/* e and mu at a contact, by its materials unless the list is `plain`. */
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

/* Set the wanted normal velocity of a contact after the solve. */
void rest_prepare_target(const struct rest *r, struct contact *c, int32_t tau_q30);
/*
 * True if a contact is so slow that its bodies lie on each other; if they bounce for ever, slow
 * along and across.
 */
bool rest_lies(const struct rest *r, const struct contact *c);

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b), from the velocities loaded last. */
void rest_relative_velocity(const struct contact *c, carom_v3_q40 *v);
/* V.N */
int64_t rest_speed_q40(const struct contact *c);
/* Before a further solve of a contact: its impulse becomes the wanted one, and V is set anew. */
void rest_want(struct contact *c);

/*
 * Give contact i of two faces the normal (or its opposite) of a contact before it, if that differs
 * by a hair. Reads velocity_q40 of the contact.
 */
void rest_share_normal(struct rest *r, uint32_t i);

/* Save the momenta of the island's bodies before a solve. */
void rest_save_momenta(struct rest *r);

/*
 * The energy rule for several contacts, after impulses were applied. If energy rose above its value
 * before, plus what `lifts` allows, go back towards the frictionless plastic solution as far as
 * needed. In lasting contact it may rise by a 256th, which the end of the frame takes back.
 */
void rest_energy_rule(struct rest *r, bool lifts, bool lasting);

/*
 * After sweeps that ran out: remove the approach of places that still approach, without friction.
 */
void rest_part(struct rest *r);
/* True if a contact approaches faster than its target and a small part of its skin a frame. */
bool rest_approaches(struct rest *r);

/*
 * The functions that a solve calls for joints. carom_joint_add sets the table, so that programs
 * without joints link none of them. All but the first two are about the island at hand.
 */
struct rest_sweep;
struct joint_calls {
    /*
     * join the islands of bodies that joints hold; with states, except bodies that are out of the
     * world
     */
    void (*join)(struct rest *r, const struct body_state *states);
    void (*join_solved)(struct rest *r);     /* the same for joints that are solved now */
    void (*load_velocities)(struct rest *r); /* of bodies that no contact loaded */
    /* bodies connected to one newly in contact enter contact, too; other joints become idle */
    void (*enter)(struct rest *r);
    bool (*take)(struct rest *r); /* list the island's joints; returns true if all are idle */
    /* take an island without contacts that has a joint which is not idle; false if none is left */
    bool (*take_next)(struct rest *r);
    /*
     * before the sweeps: set levers and K^-1, false if a body's turn_bits had to be raised; the
     * largest wanted change
     */
    bool (*prepare)(struct rest *r);
    int64_t (*largest_q40)(const struct rest *r);
    /*
     * set velocities in the unit and no impulses; load the kept impulses; take a larger unit; add
     * the impulses' effect to the bodies' sums
     */
    void (*begin)(struct rest *r, const struct rest_sweep *sw);
    void (*load_warm)(struct rest *r, const struct rest_sweep *sw);
    void (*enlarge)(struct rest *r, const struct rest_sweep *sw, int bits);
    void (*sum_up)(struct rest *r);
    void (*drop)(struct rest *r); /* forget impulses */
    /*
     * a sweep: returns how much a velocity moved; agreement with the step beyond the last sweep;
     * such a step
     */
    int64_t (*sweep)(struct rest *r, int32_t quiet);
    int64_t (*agrees)(const struct rest *r, int32_t most);
    void (*accelerate)(struct rest *r, int32_t part_q30);
    /*
     * after the sweeps: impulses as momentum; apply them; keep them, and book the work of limits
     * and motors
     */
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

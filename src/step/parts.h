/* SPDX-License-Identifier: MIT */
/*
 * parts - declarations shared by the files of a step: the paper's figures 4 and 5; the constants
 * are in SPEC.md section 6.
 *
 * In: the current state of all bodies. Out: the state one frame later, events, statistics.
 *
 * Each body has a clock of its own. Its path takes the part of the frame from from_q30 to to_q30,
 * and its state is that at the start of the path. Each pair of bodies that are near each other has
 * candidates and its next hit. The step takes events one by one in the order of time. An event
 * changes its own bodies and no others.
 *
 * Files, roughly in the order of a frame:
 *
 *   step      one frame, top to bottom
 *   act       damping and torque, where the frame begins
 *   led       kinematic bodies: their paths, the islands they carry, what stops them
 *   regions   regions of bodies, and the pairs whose regions meet
 *   contacts  the static check, chords, and the solves
 *   clock     paths: set, left at a time, viewed at a time; ends of slices
 *   slice     the longest slice of a body; clock ticks of the stages
 *   search    the next hit of a pair
 *   visit     the candidates of a pair: kept, or gathered
 *   cut       paths set again so that they end at a hit
 *   pass      hits without an answer: of sensors and of one-way bodies
 *   side      the sides on which a one-way body is solid
 *   ask       the caller's say on contacts
 *   answer    a hit: its island, the contacts, the solve, and the last resort
 *   energy    the energy rule over the frame
 *   as_one    an island that goes through a frame as one rigid body
 *   noted     the list of interfering faces
 *   finish    bodies that leave the world, events, statistics
 *   connect   joints in a step; joint_add, joint_measure, joint_energy and joint_led go with it
 */
#ifndef CAROM_SRC_STEP_PARTS_H
#define CAROM_SRC_STEP_PARTS_H

#include "../world/world.h"

/* The state of a step, shared by all of its files. */
struct step {
    struct carom_world *w;
    struct world_state *next;
    int32_t now_q30; /* time of the last event, Q30 of the frame */
    uint32_t active; /* number of bodies that are awake */
    bool rare;       /* true if there are extras, joints or passing pairs; most worlds have none */
    bool led;        /* true if a kinematic body moves */
    bool anew;   /* the frame begins again: kinematic bodies that its first solve stopped stand */
    bool single; /* true if regions last no longer than the frame */
    bool pairs_changed; /* true if the list of interfering faces must be made again */
    bool broke;         /* true if a joint broke */
    bool cut_short;     /* true if an island stands still for a part of the frame */
    bool strained;      /* true if a body left a turning path before its end */
    uint32_t event_cap; /* hits of one body at which it stops */
};

inline bool step_active(const struct step *s, uint32_t i)
{
    return broad_active(&s->w->bodies[i], &s->next->bodies[i]);
}

/* Start the next state as a copy of the current one, without events or contacts. */
void step_begin(struct step *s, struct carom_world *w);

/* Damp bodies and add the angular momentum of their torques. */
void step_act(struct step *s);

/* Book the ticks since the last mark on a stage. */
void step_mark(struct carom_world *w, enum carom_stage stage);

/* -------------------------------------------------------------------- clocks */

/* State of a body at a time of its path. */
struct body_state step_state_at(const struct step *s, uint32_t i, int32_t t_q30);

/*
 * Leave the path of a body at a time. Its state becomes that at the time; it has no path until one
 * is set.
 */
void step_leave_path(struct step *s, uint32_t i, int32_t t_q30);

/*
 * Place a body where it is at a time, with a path without motion; look_away gives it its own path
 * again. Its state and its clock do not change.
 */
void step_look_at(struct step *s, uint32_t i, int32_t t_q30);
void step_look_away(struct step *s, uint32_t i);

/* Set the path of a body from now on. Set a new region if the path leaves the old one. */
int step_set_path(struct step *s, uint32_t i);

/* The longest slice, at most left_q30, that the turn and the way of a body allow. */
int32_t step_slice(const struct step *s, uint32_t i, int32_t left_q30);

/* ------------------------------------------------------------ regions and pairs */

/* Regions and pairs at the start of a frame: renew those that no longer hold. */
int step_begin_regions(struct step *s);

/* Set the region of a body whose present path takes slice_q30, then its pairs. */
int step_set_region(struct step *s, uint32_t i, int32_t slice_q30);

/* Index of a pair; UINT32_MAX if its bodies are not near each other. */
uint32_t step_find_pair(const struct carom_world *w, const struct pair *p);

/* Give bodies that were woken a region where they are. */
int step_adopt_woken(struct step *s);

/* ------------------------------------------------------------------------ pairs */

/* A visitor of a pair's candidates. */
struct step_visitor {
    struct candidate_visitor base;
    struct step *step;
    uint32_t number;          /* index of the pair */
    int32_t from_q30, to_q30; /* the part of the frame that is searched */
    bool found;
    int32_t parts;        /* number of parts in which the window is gathered, in order of time */
    struct boyse_hit hit; /* its times are those of the present paths */
    int32_t hit_q30;      /* time of the hit, Q30 of the frame */
    int32_t margin_q22;   /* margin within which contacts are kept */
    int32_t clear_q22;    /* bound on the approach before features meet, see boyse_static */
    int error;
};

/* Set up a pair with the present paths of its bodies. There is room for one pair. */
struct boyse_pair *step_set_pair(struct carom_world *w, uint32_t number);

/* True if two meshes have so many faces that turns are cut. */
bool step_many_faces(const struct body *a, const struct body *b);

/*
 * True if the bodies go or turn so far in their regions that too many candidates would be kept.
 * Then candidates are gathered for the present paths only.
 */
bool step_goes_far(const struct step *s, const struct pair *p);

/* The part of its window in which the surfaces of a hit meet. */
int32_t step_part_of(const struct step_visitor *v, const struct boyse_hit *hit);

/* Drop the kept candidates of a part of the window if they are needed for a later time. */
void step_drop_part(struct pair_work *m, int32_t to_q30);

/* Hand every candidate of a pair to f. */
int step_visit(struct step *s, uint32_t number, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t));

/*
 * True if the spheres around a pair's bodies, grown by more_q22, stay apart on the present paths.
 * Then no candidates need be gathered.
 */
bool step_stay_apart(const struct step *s, uint32_t number, int64_t more_q22);

/* The window of a pair, the time that both paths have in common. False if there is none. */
bool step_window(const struct step *s, uint32_t number, int32_t *from_q30, int32_t *to_q30);
/* Cut the paths of both bodies to a window; set their own paths again. */
void step_open_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30);
void step_close_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30);

/*
 * Number of parts in which the candidates of a window are gathered if they are to be kept. More
 * than one only for bodies that turn in flight. A hit whose surfaces meet in an earlier part comes
 * first.
 */
int32_t step_parts(const struct step *s, uint32_t number);
/*
 * Find the first hit of a pair on the paths of a window: sets v->found and v->hit. In hit.touch
 * only `valid` is set; it is true if the hit was put off.
 */
int step_first_hit(struct step *s, uint32_t number, struct step_visitor *v);
/*
 * Put off a hit that takes no time and could not be solved there, to the first time at which it can
 * be. True if that is later.
 */
bool step_put_off(struct boyse_pair *pair, struct boyse_hit *hit);

/* Find the next hit of a pair; of all pairs that have a member. */
int step_search(struct step *s, uint32_t number);
int step_search_members(struct step *s);

/*
 * The first event: a pair's hit, with the pair's index, or the end of a body's slice, with the
 * body's.
 */
enum step_event { STEP_END, STEP_HIT, STEP_SLICE };
enum step_event step_next(const struct step *s, uint32_t *number);

/* ------------------------------------------------------------------------- hits */

/*
 * Set the paths of a pair's bodies again so that they end at its hit: the turn over a part of a
 * slice is not that part of the whole turn. *tried: true if it was attempted. Then another hit may
 * be first, and pairs may have other indices.
 */
int step_cut(struct step *s, uint32_t number, bool *tried);

/* The hit of a pair, with the features as they meet. */
struct boyse_hit step_hit_of(struct step *s, uint32_t number);

/*
 * True if two bodies are solid to each other in this frame: neither is a sensor, and they do not
 * pass.
 */
static inline bool step_is_solid(const struct pair_work *m)
{
    return !m->senses && !m->passes;
}
/* True if the hit of a pair needs no answer. The pair then passes until the frame ends. */
bool step_let_pass(struct step *s, uint32_t number);
/* True if both bodies of a pair are solid along N, which points from b into a. */
bool step_solid_along(const struct step *s, const struct pair *p, const carom_v3_q30 *normal,
                      int32_t t_q30);
/* Drop contacts on the sides from which a one-way body is not solid. */
void step_drop_other_side(struct step *s, uint32_t number);
/* Mark sensor pairs that overlap at the start of a step: a body was added or set into a sensor. */
void step_sense_start(struct step *s);
/* Note the passing pairs that still overlap when the frame ends, and the events of sensors. */
int step_finish_through(struct step *s);
extern const struct step_joint_calls step_joint_calls;

/*
 * End the slice of a body that joints connect: all bodies of its group leave their paths, and their
 * joints are solved.
 */
int step_rejoin(struct step *s, uint32_t body);

/* Answer the hit of a pair. */
int step_answer(struct step *s, uint32_t number);

/*
 * Solve bodies that lie on others. They take the frame's gravity at once, held by the last frame's
 * impulses.
 */
int step_start_contacts(struct step *s);

/* Check the contacts of a pair. They replace the pair's old contacts in the list. */
int step_check_pair(struct step *s, uint32_t number);
/*
 * Merge and thin the contacts of the list, and note which pairs touch. `members`: only contacts of
 * members can be new.
 */
int step_settle_contacts(struct step *s, bool members);
/* Ask the caller about all contacts, or about those of members. */
void step_ask_contacts(struct step *s, bool members);
/*
 * Find the bodies that enter contact and give them the rest of the frame's gravity at once. Returns
 * true if there are any.
 */
bool step_enter_contact(struct step *s);
/* Solve the contacts that are not idle. */
int step_solve(struct step *s, bool warm);

/*
 * Append an event while there is room. Before the end of a step there is room for as many hits and
 * cuts as pairs and bodies; the rest is for the end's events.
 */
bool step_may_note(const struct carom_world *w);
void step_add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b);

/*
 * True if a pair is in a state's list of touching pairs. Add a pair to the list: CAROM_OK or
 * CAROM_ERR_PAIRS_FULL.
 */
bool step_is_touching(const struct world_state *s, const struct pair *p);
int step_note_touching(struct step *s, const struct pair *p);

/* ----------------------------------------------------------------------- energy */

/*
 * Limit the energy of each island at the end of a frame. Contact may not add any, except by lifting
 * bodies within their skins; if it did, the momenta of the island are scaled down. Two causes
 * exist. A body in contact takes gravity before it moves, so one whose direction turns upwards
 * would climb for nothing. A body that stands still for a part of the frame keeps no account of
 * what it owes. Here an island is the bodies that touching in this step or joints connect.
 */
void step_limit_energy(struct step *s);
/*
 * Undo the frame for an island in the air and move it as one rigid body. But for rounding it then
 * has no more energy than before. False, and nothing changes, if a body of it slept or falls
 * otherwise than the others, if it turns too fast, or if another body is near.
 */
bool step_go_as_one(struct step *s, uint32_t first);

/* ---------------------------------------------------------------- kinematic bodies */

/*
 * The routes of kinematic bodies for the frame, where their clocks begin; and at the end the poses
 * they were led to. step_begin_routes returns true if any body moves.
 */
bool step_begin_routes(struct step *s);
void step_end_routes(struct step *s);

/*
 * View the path of a kinematic body from now on for a slice, no longer than the rest of its own;
 * place it where it is now.
 */
void step_look_ahead(struct step *s, uint32_t i, int32_t slice_q30);
void step_look_back(struct step *s, uint32_t i);

/*
 * The last resort for an island that kinematic bodies push. It moves with one of them as one rigid
 * body, if that approaches nothing else; otherwise all of them stop, and the island with them.
 * `hard`: it has moved along before. False if none pushes it.
 */
bool step_carry_island(struct step *s, uint32_t first, bool hard);
/* Stop a kinematic body for the rest of the frame, because body `by` is in its way. */
void step_block(struct step *s, uint32_t i, uint32_t by);
/* Stop the kinematic bodies that push or lead members, and the one of the pair. */
void step_block_pushers(struct step *s, const struct pair *p);
/* Report that body `by` blocks a kinematic body, once a frame. */
void step_note_blocked(struct step *s, uint32_t i, uint32_t by);

/* Reset the quiet time of bodies that lie on a moving kinematic body. */
void step_keep_awake(struct step *s);

/* ------------------------------------------------------------------------ finish */

/* Drop impulses that the next frame cannot use. */
void step_drop_warm(struct step *s);

/*
 * Freeze a body that left the range of the formats. It stays where it is, or in the pose in which
 * it began the frame if that place is out of range. It has the energy with which it began the
 * frame. True if it was frozen.
 */
bool step_retire(struct step *s, uint32_t i);
/* The same as world_in_range, faster for most bodies. */
bool step_in_range(const struct body *b, const struct body_state *s);

/* Make the list of interfering faces, if pairs were gathered in this step. */
int step_note_faces(struct step *s);

/* True if a step computed nothing of a pair: both of its bodies rest, before it and after it. */
bool step_left_alone(const struct step *s, const struct pair *p);

/* Report begin and end of touching, waking and rest: CAROM_OK or CAROM_ERR_PAIRS_FULL. */
int step_finish_events(struct step *s);
void step_finish_stats(struct carom_world *w);

#endif

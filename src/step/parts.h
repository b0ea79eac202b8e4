/* SPDX-License-Identifier: MIT */
/*
 * What the files of a step share. Each body has a clock of its own: its path takes a part of the frame,
 * from_q30 to to_q30, and its state is that at the path's start. Each pair of bodies that are near each
 * other has candidates and its next hit. The step takes events one by one in the order of time, and an
 * event changes the bodies that it belongs to and nobody else.
 *
 *   step      the frame on one page
 *   clock     paths: set, left at a time, looked at in a place; the ends of slices
 *   act       damping and torque, where the frame begins
 *   slice     the longest slice of a body, ticks
 *   regions   regions of bodies, and the pairs that these make
 *   search    the next hit of a pair
 *   cut       paths that are set again for the hit they lead to
 *   pass      hits that nothing answers: of sensors, and from the side on which a body is not solid
 *   side      from which side bodies are solid
 *   ask       what the caller says of contacts
 *   answer    a hit: the island that it belongs to, its contacts, the solve, and the last resort
 *   contacts  the static check, chords, and what contacts leave behind
 *   joints    what of them a step solves, and where they are going to be
 *   energy    of contact over the frame; rigid: the motion of an island as one body
 *   led       kinematic bodies: their paths, what they take along, what stops them
 *   finish    events, statistics
 *   noted     the list of interfering faces
 */
#ifndef CAROM_SRC_STEP_PARTS_H
#define CAROM_SRC_STEP_PARTS_H

#include "../world/world.h"

/* Less than a thousandth of a frame is no time to go on for. */
#define STEP_SLICE_MIN_Q30 (1 << 20)

/* What the whole step works on. */
struct step {
    struct carom_world *w;
    struct world_state *next;
    int32_t now_q30;    /* of the last event */
    uint32_t active;    /* bodies that are awake */
    bool rare;          /* there are extras, joints or pairs that may pass: most worlds have none */
    bool led;           /* a kinematic body is led somewhere */
    bool single;        /* regions last no longer than the frame */
    bool pairs_changed; /* interfering faces are others */
    bool broke;         /* finish: some joint */
    bool cut_short;     /* some island stands still for a part of the frame */
    uint32_t event_cap; /* hits of a body */
};

inline bool step_active(const struct step *s, uint32_t i)
{
    return broad_active(&s->w->bodies[i], &s->next->bodies[i]);
}

/* Start the next state as a copy of the current one, with nothing found yet. */
void step_begin(struct step *s, struct carom_world *w);

/* Damp bodies, and give them the angular momentum of their torques. */
void step_act(struct step *s);

/* Book the ticks since the last mark on a stage. */
void step_mark(struct carom_world *w, enum carom_stage stage);

/* -------------------------------------------------------------------- clocks */

/* The state that a body has at a time of its path. */
struct body_state step_state_at(const struct step *s, uint32_t i, int32_t t_q30);

/* Leave the path of a body at a time: its state is that there, and it has no path until one is set. */
void step_leave_path(struct step *s, uint32_t i, int32_t t_q30);

/*
 * Look at a body where it is at a time, by a path of no motion; go back to its own path. Its state and
 * its clock stay as they are.
 */
void step_look_at(struct step *s, uint32_t i, int32_t t_q30);
void step_look_away(struct step *s, uint32_t i);

/* Set the path of a body from now on, and its region when it leaves the one it has. */
int step_set_path(struct step *s, uint32_t i);

/* The longest slice, of a time that is left, that the turn and the way of a body allow. */
int32_t step_slice(const struct step *s, uint32_t i, int32_t left_q30);

/* ------------------------------------------------------------ regions and pairs */

/* Regions and pairs at the start of a frame: those that do not hold any more are set anew. */
int step_begin_regions(struct step *s);

/* Set the region of a body, whose path is at hand and takes slice_q30, and its pairs. */
int step_set_region(struct step *s, uint32_t i, int32_t slice_q30);

/* The number of a pair, or UINT32_MAX when its bodies are not near each other. */
uint32_t step_find_pair(const struct carom_world *w, const struct pair *p);

/* Give a body that was woken a region where it is. */
int step_adopt(struct step *s, uint32_t i);

/* ------------------------------------------------------------------------ pairs */

/* A visitor of a pair's candidates. */
struct step_visitor {
    struct candidate_visitor base;
    struct step *step;
    uint32_t number;          /* of the pair */
    int32_t from_q30, to_q30; /* the time of the frame that is looked at */
    bool found;
    int32_t parts;        /* of the window, in which candidates are gathered one after the other */
    struct boyse_hit hit; /* its times are those of the paths at hand */
    int32_t hit_q30;      /* and that in the frame */
    int32_t margin_q22;   /* of contacts */
    int32_t clear_q22;    /* what they have left, see boyse_static */
    int error;
};

/* Set up a pair with the paths of its bodies at hand, in the room there is for one. */
struct boyse_pair *step_set_pair(struct carom_world *w, uint32_t number);

/* Whether two meshes have so many faces that turns are to be cut. */
bool step_many_faces(const struct body *a, const struct body *b);

/*
 * Bodies that go or turn far in their regions would have candidates without number: these are gathered for the
 * paths at hand alone, and not kept.
 */
bool step_goes_far(const struct step *s, const struct pair *p);

/* In which of the parts of its window a hit's surfaces meet. */
int32_t step_part_of(const struct step_visitor *v, const struct boyse_hit *hit);

/* Drop the candidates of a part of the window when they are asked for up to a time beyond it. */
void step_drop_part(struct pair_work *m, int32_t to_q30);

/* Hand every candidate of a pair to f. */
int step_visit(struct step *s, uint32_t number, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t));

/*
 * Whether the spheres around a pair's bodies, and so much more, stay apart on the paths at hand: then
 * nothing of theirs meets, and nothing need be gathered.
 */
bool step_stay_apart(const struct step *s, uint32_t number, int64_t more_q22);

/* The window of a pair: the time that both paths take, when there is any. */
bool step_window(const struct step *s, uint32_t number, int32_t *from_q30, int32_t *to_q30);
/* Paths of both bodies for a window; and back to their own. */
void step_open_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30);
void step_close_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30);

/*
 * In how many parts candidates of a pair's window that are to be kept are gathered: of bodies in flight that
 * turn. A hit whose surfaces meet in an earlier part comes first.
 */
int32_t step_parts(const struct step *s, uint32_t number);
/* The first hit of a pair on the paths at hand, which a window made: v->found, v->hit but for touch. */
int step_first_hit(struct step *s, uint32_t number, struct step_visitor *v);
/*
 * Put a hit off that takes no time, when nothing could be solved there yet: to the time when something
 * can. Whether that is later.
 */
bool step_put_off(const struct boyse_pair *pair, struct boyse_hit *hit);

/* Find the next hit of a pair; of all pairs of bodies that are members. */
int step_search(struct step *s, uint32_t number);
int step_search_members(struct step *s);

/* The first of all hits, and the body whose slice ends first; what comes first: its time. */
enum step_event { STEP_END, STEP_HIT, STEP_SLICE };
enum step_event step_next(const struct step *s, uint32_t *number);

/* ------------------------------------------------------------------------- hits */

/*
 * Set the paths of a pair's bodies again so that they end at its hit: the turn over a part of a slice is
 * not a part of the turn over the whole. Whether that was tried: then there may be another hit first, and
 * pairs may have other numbers.
 */
int step_cut(struct step *s, uint32_t number, bool *tried);

/* The hit of a pair, with the features as they meet. */
struct boyse_hit step_hit_of(struct step *s, uint32_t number);

/* Whether two bodies are solid to each other in this frame: neither is a sensor, and they do not pass. */
static inline bool step_is_solid(const struct pair_work *m)
{
    return !m->senses && !m->passes;
}
/* Whether nothing is to answer the hit of a pair, which then passes until the frame ends. */
bool step_let_pass(struct step *s, uint32_t number);
/* Whether both bodies of a pair are solid along N, which points from b into a. */
bool step_solid_along(const struct step *s, const struct pair *p, const carom_v3_q30 *normal,
                      int32_t t_q30);
/* Drop the contacts of a pair on those sides of a body from which it is not solid. */
void step_drop_other_side(struct step *s, uint32_t number);
/* Bodies that were added or set into a sensor have met it. */
void step_sense_start(struct step *s);
/* Which pairs go through each other when the frame ends, and what sensors found. */
int step_finish_through(struct step *s);
extern const struct step_joint_calls step_joint_calls;

/* The end of a slice of a body that joints connect: its group leaves its paths, and joints are solved. */
int step_rejoin(struct step *s, uint32_t body);

/* Answer the hit of a pair. */
int step_answer(struct step *s, uint32_t number);

/* Bodies that lie on others: gravity at once, held up by last frame's impulses. */
int step_start_contacts(struct step *s);

/* Take the contacts of a pair into the list in the place of those it has there. */
int step_check_pair(struct step *s, uint32_t number);
/* Sort out the contacts of the list: each place once, and which pairs touch. `members`: only contacts of members may be new. */
int step_settle_contacts(struct step *s, bool members);
/* Ask the caller about the contacts of the list, or those of members alone. */
void step_ask_contacts(struct step *s, bool members);
/* Solve those contacts that are not idle. */
int step_solve(struct step *s, bool warm);

/*
 * Append an event while there is room. Before the end of a step there is room for as many hits and cuts as
 * there may be pairs and bodies: the rest is for what the end finds.
 */
bool step_may_note(const struct carom_world *w);
void step_add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b);

/*
 * Whether a pair is in a state's list of touching ones; note that it touches in this step, with
 * CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
bool step_is_touching(const struct world_state *s, const struct pair *p);
int step_note_touching(struct step *s, const struct pair *p);

/* ----------------------------------------------------------------------- energy */

/*
 * Contact must not gain energy over a frame, beyond lifting bodies within their skins: scale the
 * momenta of an island down if it did. A body in contact takes gravity before it moves, so one that
 * is turned upwards on its way would climb for nothing; and one that stands still for a part of the
 * frame has lost track of what it owes. An island is what was connected by touching in this step.
 */
void step_limit_energy(struct step *s);

/*
 * The last resort for an island that a solve did not part: at rest when it touches what stands still,
 * else in its motion as one rigid body. `hard`: see step_carry_island.
 */
void step_calm_island(struct step *s, uint32_t body, bool hard);

/* ---------------------------------------------------------------- kinematic bodies */

/*
 * The routes of kinematic bodies for the frame, where their clocks begin; and the poses they were led to.
 * step_begin_routes returns whether any is led somewhere.
 */
bool step_begin_routes(struct carom_world *w);
void step_end_routes(struct step *s);

/*
 * The path of a kinematic body from now on for a slice, which must not be longer than what is left of its
 * own; back to where it is now.
 */
void step_look_ahead(struct step *s, uint32_t i, int32_t slice_q30);
void step_look_back(struct step *s, uint32_t i);

/*
 * The last resort for an island that kinematic bodies push: it goes along with one of them as one rigid
 * body, where that approaches nothing else; or all of them stop, and the island with them. `hard`: it has
 * gone along already. False when none pushes it.
 */
bool step_carry_island(struct step *s, uint32_t first, bool hard);
/* A kinematic body stops for what is left of the frame, since another is in its way. */
void step_block(struct step *s, uint32_t i, uint32_t by);
/* So do those that push or lead members, and that of the pair. */
void step_block_pushers(struct step *s, const struct pair *p);
/* Say that a kinematic body was blocked by a body, once a frame. */
void step_note_blocked(struct step *s, uint32_t i, uint32_t by);

/* A body that lies on a kinematic one that is led somewhere has not been quiet. */
void step_keep_awake(struct step *s);

/* ------------------------------------------------------------------------ finish */

/* Keep the impulses of contacts that the next frame may continue. */
void step_drop_warm(struct step *s);

/*
 * Freeze a body that left the range of the formats: where it is, or when that place is out of range in
 * the pose it began the frame with. Returns whether it did.
 */
bool step_retire(struct step *s, uint32_t i);
/* The same as world_in_range, sooner for most. */
bool step_in_range(const struct body *b, const struct body_state *s);

/* The list of interfering faces, when pairs were gathered in this step. */
int step_note_faces(struct step *s);

/* Begin and end of touching, waking and rest; CAROM_OK or CAROM_ERR_PAIRS_FULL. */
int step_finish_events(struct step *s);
void step_finish_stats(struct carom_world *w);

#endif

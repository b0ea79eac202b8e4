/* SPDX-License-Identifier: MIT */
/*
 * world_step_parts - what the files of a step share. world_step.c is the pipeline; the others are
 * its stations: gather (regions, candidates), move (predict, first hit, advance), contacts (static
 * check, solve), energy (of contact over the frame), finish (events, statistics).
 */
#ifndef CAROM_SRC_WORLD_STEP_PARTS_H
#define CAROM_SRC_WORLD_STEP_PARTS_H

#include "../world/world.h"

/* Less than a thousandth of a frame is no time to go on for. */
#define STEP_SLICE_MIN_Q30 (1 << 20)

/* What the whole step works on. */
struct step {
    struct carom_world *w;
    struct world_state *next;
    int32_t left_q30; /* of the frame */
    int32_t
        path_q30; /* the slice that the paths at hand are of, and no state changed since; or 0 */
    uint32_t substep_cap;
    struct boyse_hit hit;
};

/* Start the next state as a copy of the current one, with nothing found yet. */
void step_begin(struct step *s, struct carom_world *w);

/* A visitor of candidates that knows which pair they belong to. */
struct step_visitor {
    struct candidate_visitor base;
    struct step *step;
    struct boyse_pair *pair;
    int32_t pair_number; /* that `pair` is set up for; -1: none */
    bool found;
    int error;
};

/* Hand every candidate to f. */
int step_visit(struct step *s, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t));
void step_select_pair(struct step_visitor *v, const struct candidate *c);
/* Set the pair of a candidate up for it, in the room there is for one. */
struct boyse_pair *step_set_pair(const struct carom_world *w, const struct candidate *c);

/* Book the ticks since the last mark on a stage. */
void step_mark(struct carom_world *w, enum carom_stage stage);

/* Give every body a path of no motion at its present pose. */
void step_place_all(struct step *s);

/* Set the paths of a slice. */
void step_predict_all(struct step *s, int32_t tau_q30);

/*
 * Set the paths of a slice, and gather pairs, interfering faces and candidates for a region around
 * them that may last for some frames; or for the paths at hand, of a slice, alone.
 */
int step_gather(struct step *s);
int step_gather_slice(struct step *s, int32_t slice_q30);

/* Whether a body may leave its region on its path, which takes slice_q30. */
bool step_leaves_region(const struct step *s, int32_t slice_q30);

/* The same at the start of a frame, unless the last frame's still hold. */
int step_gather_first(struct step *s);

/* Pairs have new numbers after they were gathered again; this one is still there. */
uint16_t step_pair_number(const struct carom_world *w, const struct pair *p);

/* The longest slice of what is left that every body's turn allows. */
int32_t step_slice(const struct step *s);

/* Set the paths of that slice. */
int step_predict(struct step *s, int32_t *slice_q30);

/* The earliest hit on the paths, into s->hit. */
int step_first_hit(struct step *s, bool *found);

/* Go to t of the paths. */
void step_advance(struct step *s, int32_t t_q30, int32_t slice_q30);

/*
 * Go to the hit, on paths that end at it. `met` is false when it turns out to be one of a long path
 * only: then the bodies went on a part of the slice in which nothing is hit.
 */
int step_go_to_hit(struct step *s, int32_t slice_q30, bool *met);

/* Bodies that lie on others: gravity at once, held up by last frame's impulses. */
int step_start_contacts(struct step *s);

/* Resolve the hit: the impact, then what it left slow goes into continuous contact. */
int step_respond(struct step *s);

/* Append an event while there is room. */
void step_add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b);

/*
 * Whether a pair is in a state's list of touching ones; note that it touches in this step, with
 * CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
bool step_is_touching(const struct world_state *s, const struct pair *p);
int step_note_touching(struct step *s, const struct pair *p);

/*
 * Contact must not gain energy over a frame, beyond lifting bodies within their skins: scale the
 * momenta of an island down if it did. A body in contact takes gravity before it moves, so one that
 * is turned upwards on its way would climb for nothing; and a frame cut short has lost track of what
 * it owes. An island is what was connected by touching in this step.
 */
void step_limit_energy(struct step *s, bool cut_short);

/* Keep the impulses of contacts that the next frame may continue. */
void step_drop_warm(struct step *s);

/*
 * Freeze bodies that left the range of the formats: where they are, or when that place is out of
 * range in the pose they began the frame with. Returns whether any did.
 */
bool step_retire(struct step *s);

/* Begin and end of touching, waking and rest; CAROM_OK or CAROM_ERR_PAIRS_FULL. */
int step_finish_events(struct step *s);
void step_finish_stats(struct carom_world *w);

#endif

/* SPDX-License-Identifier: MIT */
/*
 * Each call of a step that may fail is made to fail, in turn: pairs and contacts that have no room, lists of pairs that touch or
 * overlap, gathers, lists of faces, impacts out of range. Random worlds and machines step frame by frame. If all calls from the
 * k-th on fail, the step returns that error and the world is as before. If the k-th alone fails, the step's second try comes to
 * the same state as if nothing had failed; or the error is one that has no second try, and the world is as before. Calls of all
 * kinds are counted together, then those of each kind alone: a kind that is rare fails as often as the others.
 *
 *   host_errors        a few worlds
 *   host_errors long   twenty times as many; five times as many for each kind alone
 */
#include <stdio.h>
#include <string.h>

#include "lib/soak.h"
#include "step/parts.h"

enum { WORLDS = 4, MORE = 20, KIND_WORLDS = 12, KIND_MORE = 5, FRAMES = 40, NEVER = 0, TRIES = 10 };

/*
 * Kinds of calls; ANY: all of them. Others are all calls within a cut of paths, or within an end of a slice of jointed bodies.
 */
enum kind {
    PAIRS,
    TOUCHES,
    THROUGH,
    PARTINGS,
    REGIONS,
    GATHERS,
    FACES,
    CONTACTS,
    HITS,
    IMPACTS,
    CUTS,
    REJOINS,
    ANY,
    KINDS
};

static struct {
    struct carom_world *world; /* its step is watched; NULL: nothing fails */
    enum kind kind;            /* only calls of this kind fail */
    long calls[KINDS], first;  /* calls so far; the first that fails */
    bool later;                /* calls after the first fail, too */
    enum kind within;          /* CUTS or REJOINS; otherwise ANY */
    int error;                 /* of the last call that failed */
} fault;

/* Count a call, and say whether it is to fail with an error. */
static bool fails(enum kind kind, int error)
{
    const long calls = fault.calls[fault.kind];

    if (!fault.world) {
        return false;
    }
    fault.calls[kind]++;
    fault.calls[ANY]++;
    fault.calls[fault.within] += fault.within != ANY;
    if (fault.first == NEVER || fault.calls[fault.kind] == calls ||
        (fault.later ? calls + 1 < fault.first : calls + 1 != fault.first)) {
        return false;
    }
    fault.error = error;
    return true;
}

/* ----------------------------------------------- functions that the linker puts in place of the engine's */

int32_t __real_pool_take(struct pool *p);
int32_t __wrap_pool_take(struct pool *p);
int32_t __wrap_pool_take(struct pool *p)
{
    if (fault.world && p == &fault.world->pools[CAROM_POOL_pairs] &&
        fails(PAIRS, CAROM_ERR_PAIRS_FULL)) {
        p->refused++;
        return -1;
    }
    return __real_pool_take(p);
}

int __real_step_note_touching(struct step *s, const struct pair *p);
int __wrap_step_note_touching(struct step *s, const struct pair *p);
int __wrap_step_note_touching(struct step *s, const struct pair *p)
{
    return fails(TOUCHES, CAROM_ERR_PAIRS_FULL) ? (int)CAROM_ERR_PAIRS_FULL
                                                : __real_step_note_touching(s, p);
}

int __real_world_note_through(const struct carom_world *w, struct world_state *s,
                              const struct pair *p);
int __wrap_world_note_through(const struct carom_world *w, struct world_state *s,
                              const struct pair *p);
int __wrap_world_note_through(const struct carom_world *w, struct world_state *s,
                              const struct pair *p)
{
    return fails(THROUGH, CAROM_ERR_PAIRS_FULL) ? (int)CAROM_ERR_PAIRS_FULL
                                                : __real_world_note_through(w, s, p);
}

int __real_world_part_joint(struct carom_world *w, struct world_state *s, const struct joint *j);
int __wrap_world_part_joint(struct carom_world *w, struct world_state *s, const struct joint *j);
int __wrap_world_part_joint(struct carom_world *w, struct world_state *s, const struct joint *j)
{
    return fails(PARTINGS, CAROM_ERR_PAIRS_FULL) ? (int)CAROM_ERR_PAIRS_FULL
                                                 : __real_world_part_joint(w, s, j);
}

int __real_step_set_region(struct step *s, uint32_t i, int32_t slice_q30);
int __wrap_step_set_region(struct step *s, uint32_t i, int32_t slice_q30);
int __wrap_step_set_region(struct step *s, uint32_t i, int32_t slice_q30)
{
    return fails(REGIONS, CAROM_ERR_PAIRS_FULL) ? (int)CAROM_ERR_PAIRS_FULL
                                                : __real_step_set_region(s, i, slice_q30);
}

/* These two fail only if a call within them does. */
int __real_step_cut(struct step *s, uint32_t number, bool *tried);
int __wrap_step_cut(struct step *s, uint32_t number, bool *tried);
int __wrap_step_cut(struct step *s, uint32_t number, bool *tried)
{
    int result;

    fault.within = CUTS;
    result = __real_step_cut(s, number, tried);
    fault.within = ANY;
    return result;
}

int __real_step_rejoin(struct step *s, uint32_t body);
int __wrap_step_rejoin(struct step *s, uint32_t body);
int __wrap_step_rejoin(struct step *s, uint32_t body)
{
    int result;

    fault.within = REJOINS;
    result = __real_step_rejoin(s, body);
    fault.within = ANY;
    return result;
}

int __real_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out);
int __wrap_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out);
int __wrap_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out)
{
    return fails(IMPACTS, CAROM_ERR_RANGE) ? (int)CAROM_ERR_RANGE : __real_impact_solve(g, in, out);
}

int __real_interfere_visit_pair(struct interfere *in, const struct interfere_pairs *all,
                                uint32_t number, const struct interfere_span *span, bool keep,
                                struct candidate_visitor *visitor);
int __wrap_interfere_visit_pair(struct interfere *in, const struct interfere_pairs *all,
                                uint32_t number, const struct interfere_span *span, bool keep,
                                struct candidate_visitor *visitor);
int __wrap_interfere_visit_pair(struct interfere *in, const struct interfere_pairs *all,
                                uint32_t number, const struct interfere_span *span, bool keep,
                                struct candidate_visitor *visitor)
{
    return fails(GATHERS, CAROM_ERR_RANGE)
               ? (int)CAROM_ERR_RANGE
               : __real_interfere_visit_pair(in, all, number, span, keep, visitor);
}

bool __real_contact_add(struct contact_list *list, struct boyse_pair *pair,
                        const struct candidate *c, int32_t margin_q22, int32_t *clear_q22);
bool __wrap_contact_add(struct contact_list *list, struct boyse_pair *pair,
                        const struct candidate *c, int32_t margin_q22, int32_t *clear_q22);
bool __wrap_contact_add(struct contact_list *list, struct boyse_pair *pair,
                        const struct candidate *c, int32_t margin_q22, int32_t *clear_q22)
{
    return !fails(CONTACTS, CAROM_ERR_CONTACTS_FULL) &&
           __real_contact_add(list, pair, c, margin_q22, clear_q22);
}

bool __real_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit);
bool __wrap_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit);
bool __wrap_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit)
{
    return !fails(HITS, CAROM_ERR_CONTACTS_FULL) && __real_contact_force(list, pair, hit);
}

void __real_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);
void __wrap_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);
void __wrap_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n)
{
    if (fails(FACES, CAROM_ERR_FACES_FULL)) {
        in->error = CAROM_ERR_FACES_FULL;
    } else {
        __real_interfere_note_faces(in, all, c, n);
    }
}

/* ----------------------------------------------------------------------- worlds */

static struct soak_world world;
static uint64_t wanted[FRAMES + 1]; /* states of the run in which nothing fails */
static long called[KINDS];          /* calls in that run */

/* The results of a kind. */
static struct tally {
    int worlds;
    long failed, again, wrong, changed, lost;
} tallies[KINDS];

static bool begin(uint64_t seed, bool machine)
{
    soak_make(&world, seed);
    if (machine) {
        soak_machine_make(&world, true);
    }
    return crowd_start(world.crowd) >= 0 && (!machine || soak_machine_start(&world) >= 0);
}

/* A step in which a call fails; `first` of NEVER: none does. */
static int step(long first, bool later)
{
    int result;

    fault.world = world.crowd->world;
    memset(fault.calls, 0, sizeof fault.calls);
    fault.first = first;
    fault.later = later;
    fault.within = ANY;
    fault.error = CAROM_OK;
    result = carom_world_step(fault.world);
    fault.world = NULL;
    return result;
}

static bool act(int frame)
{
    return !world.machine || soak_machine_act(&world, frame) >= 0;
}

/* The run in which nothing fails; false if it ends in an error by itself. */
static bool run_whole(uint64_t seed, bool machine)
{
    bool good = begin(seed, machine);

    memset(called, 0, sizeof called);
    for (int frame = 1; good && frame <= FRAMES; frame++) {
        good = act(frame) && step(NEVER, false) >= 0;
        for (int kind = 0; kind < KINDS; kind++) {
            called[kind] += fault.calls[kind];
        }
        wanted[frame] = carom_world_hash(world.crowd->world);
    }
    soak_free(&world);
    return good;
}

/* After an error: it is the one that was made, and the world is as before. */
static void look(int result, uint64_t before)
{
    struct tally *tally = &tallies[fault.kind];

    tally->failed++;
    tally->wrong += result != fault.error;
    tally->changed += carom_world_hash(world.crowd->world) != before;
}

/*
 * Let a frame's step fail from the k-th call on, for k that grow until the step goes well. Returns its result.
 */
static int fail_all(struct test_random *r)
{
    const uint64_t before = carom_world_hash(world.crowd->world);

    for (long k = 1;; k += 1 + k / 2 + test_random_range(r, 0, 1)) {
        int result = step(k, true);

        if (result >= 0) {
            tallies[fault.kind].again +=
                fault.error != CAROM_OK; /* whose second try had no such call */
            return result;
        }
        look(result, before);
    }
}

/*
 * Let one of a frame's calls fail, of as many as the step before had; or it and all later ones. The second try of the step goes
 * well, or the next step does.
 */
static int fail_one(struct test_random *r, long calls, bool later)
{
    const uint64_t before = carom_world_hash(world.crowd->world);
    int result = step(1 + test_random_range(r, 0, calls), later);

    if (result >= 0) {
        tallies[fault.kind].again += fault.error != CAROM_OK;
        return result;
    }
    look(result, before);
    return step(NEVER, false);
}

static int fail(struct test_random *r, int frame, long calls)
{
    if (fault.kind != ANY) {
        return fail_one(r, calls, test_random_range(r, 0, 1) == 0);
    }
    return frame % 2 == 0 ? fail_one(r, calls, false) : fail_all(r);
}

static void run_failing(uint64_t seed, bool machine)
{
    struct test_random r = {seed};
    long calls = 0;

    lab_expect(begin(seed, machine) ? CAROM_OK : CAROM_ERR_ARGUMENT,
               "a world that was made before");
    for (int frame = 1; frame <= FRAMES; frame++) {
        int result = act(frame) ? fail(&r, frame, calls) : -1;

        calls = fault.calls[fault.kind];
        if (result < 0 || carom_world_hash(world.crowd->world) != wanted[frame]) {
            printf("# world %llu, frame %d: another state\n", (unsigned long long)seed, frame);
            tallies[fault.kind].lost++;
            break;
        }
    }
    soak_free(&world);
}

/*
 * Calls of a kind that make a world one for that kind. Joints break once, and few paths are cut; other calls are made in most
 * frames.
 */
static long enough(enum kind kind)
{
    return kind == PARTINGS ? 1 : kind == CUTS ? 2 : FRAMES / 4;
}

/* Let calls of the kinds from `first` to `last` fail, in as many worlds of each. */
static void fail_kinds(enum kind first, enum kind last, bool machine, int worlds)
{
    bool more = true;

    memset(tallies, 0, sizeof tallies);
    for (uint64_t seed = 1; more && seed < (uint64_t)worlds * TRIES; seed++) {
        bool good = run_whole(seed, machine);

        more = false;
        for (int kind = (int)first; kind <= (int)last; kind++) {
            struct tally *tally = &tallies[kind];

            if (good && tally->worlds < worlds && called[kind] >= enough((enum kind)kind)) {
                tally->worlds++;
                fault.kind = (enum kind)kind;
                run_failing(seed, machine);
            }
            more |= tally->worlds < worlds;
        }
    }
}

static void report(const char *name, enum kind kind, int worlds, long least)
{
    const struct tally *t = &tallies[kind];

    lab_report(t->worlds == worlds && t->wrong + t->changed + t->lost == 0 &&
                   t->failed + t->again >= least,
               name,
               "%ld steps in which calls failed, %ld that went well at the second try; %ld other "
               "errors, %ld states that changed, %ld worlds that went another way",
               t->failed, t->again, t->wrong, t->changed, t->lost);
}

/* With the assertions, the search for worlds with calls of each kind takes a minute. */
#ifndef CAROM_DEBUG
/* Fewer steps that fail than a third of the calls in these worlds would mean that too little was asked. */
static void each_kind_alone(int worlds)
{
    static const char *const names[] = {"errors/pairs",    "errors/touching", "errors/through",
                                        "errors/partings", "errors/regions",  "errors/gathers",
                                        "errors/faces",    "errors/contacts", "errors/hits",
                                        "errors/impacts",  "errors/cuts",     "errors/rejoins"};

    fail_kinds((enum kind)0, (enum kind)(ANY - 1), true, worlds);
    for (int kind = 0; kind < ANY; kind++) {
        report(names[kind], (enum kind)kind, worlds, worlds / 3 * enough((enum kind)kind));
    }
}
#endif

int main(int count, char **words)
{
    const bool more = lab_given("long", count, words);
    const int worlds = more ? WORLDS * MORE : WORLDS;

    for (int machine = 0; machine < 2; machine++) {
        fail_kinds(ANY, ANY, machine, worlds);
        report(machine ? "errors/machines" : "errors/worlds", ANY, worlds, (long)worlds * FRAMES);
    }
#ifndef CAROM_DEBUG
    each_kind_alone(more ? KIND_WORLDS * KIND_MORE : KIND_WORLDS);
#endif
    return lab_finish();
}

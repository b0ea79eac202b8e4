/* SPDX-License-Identifier: MIT */
/*
 * Each call of a step that may fail is made to fail, in turn: pairs and contacts that have no room, gathers, lists of faces,
 * impacts out of range. Random worlds and machines step frame by frame. If all calls from the k-th on fail, the step returns
 * that error and the world is as before. If the k-th alone fails, the step's second try comes to the same state as if nothing
 * had failed; or the error is one that has no second try, and the world is as before.
 *
 *   host_errors        a few worlds
 *   host_errors long   twenty times as many
 */
#include <stdio.h>

#include "lib/soak.h"
#include "world/world.h"

enum { WORLDS = 4, MORE = 20, FRAMES = 40, NEVER = 0 };

static struct {
    struct carom_world *world; /* its step is watched; NULL: nothing fails */
    long calls, first;         /* calls so far; the first that fails */
    bool later;                /* calls after the first fail, too */
    int error;                 /* of the last call that failed */
} fault;

/* Count a call, and say whether it is to fail with an error. */
static bool fails(int error)
{
    if (!fault.world || fault.first == NEVER) {
        fault.calls += fault.world != NULL;
        return false;
    }
    fault.calls++;
    if (fault.later ? fault.calls < fault.first : fault.calls != fault.first) {
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
    if (fault.world && p == &fault.world->pools[CAROM_POOL_pairs] && fails(CAROM_ERR_PAIRS_FULL)) {
        p->refused++;
        return -1;
    }
    return __real_pool_take(p);
}

int __real_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out);
int __wrap_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out);
int __wrap_impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out)
{
    return fails(CAROM_ERR_RANGE) ? (int)CAROM_ERR_RANGE : __real_impact_solve(g, in, out);
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
    return fails(CAROM_ERR_RANGE)
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
    return !fails(CAROM_ERR_CONTACTS_FULL) &&
           __real_contact_add(list, pair, c, margin_q22, clear_q22);
}

bool __real_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit);
bool __wrap_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit);
bool __wrap_contact_force(struct contact_list *list, const struct boyse_pair *pair,
                          const struct boyse_hit *hit)
{
    return !fails(CAROM_ERR_CONTACTS_FULL) && __real_contact_force(list, pair, hit);
}

void __real_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);
void __wrap_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);
void __wrap_interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n)
{
    if (fails(CAROM_ERR_FACES_FULL)) {
        in->error = CAROM_ERR_FACES_FULL;
    } else {
        __real_interfere_note_faces(in, all, c, n);
    }
}

/* ----------------------------------------------------------------------- worlds */

static struct soak_world world;
static uint64_t wanted[FRAMES + 1]; /* states of the run in which nothing fails */
static long failed, again, wrong, changed, lost;

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
    fault.calls = 0;
    fault.first = first;
    fault.later = later;
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

    for (int frame = 1; good && frame <= FRAMES; frame++) {
        good = act(frame) && step(NEVER, false) >= 0;
        wanted[frame] = carom_world_hash(world.crowd->world);
    }
    soak_free(&world);
    return good;
}

/* After an error: it is the one that was made, and the world is as before. */
static void look(int result, uint64_t before)
{
    failed++;
    wrong += result != fault.error;
    changed += carom_world_hash(world.crowd->world) != before;
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
            again += fault.error != CAROM_OK; /* whose second try had no such call */
            return result;
        }
        look(result, before);
    }
}

/* Let one of a frame's calls fail, of as many as the step before had. The second try of the step goes well. */
static int fail_one(struct test_random *r, long calls)
{
    const uint64_t before = carom_world_hash(world.crowd->world);
    int result = step(1 + test_random_range(r, 0, calls), false);

    if (result >= 0) {
        again += fault.error != CAROM_OK;
        return result;
    }
    look(result, before);
    return step(NEVER, false);
}

static void run_failing(uint64_t seed, bool machine)
{
    struct test_random r = {seed};
    long calls = 0;

    lab_expect(begin(seed, machine) ? CAROM_OK : CAROM_ERR_ARGUMENT,
               "a world that was made before");
    for (int frame = 1; frame <= FRAMES; frame++) {
        int result = act(frame) ? frame % 2 == 0 ? fail_one(&r, calls) : fail_all(&r) : -1;

        calls = fault.calls;
        if (result < 0 || carom_world_hash(world.crowd->world) != wanted[frame]) {
            printf("# world %llu, frame %d: another state\n", (unsigned long long)seed, frame);
            lost++;
            break;
        }
    }
    soak_free(&world);
}

static void test(const char *name, bool machine, int worlds)
{
    int made = 0;

    failed = again = wrong = changed = lost = 0;
    for (uint64_t seed = 1; made < worlds; seed++) {
        if (run_whole(seed, machine)) {
            made++;
            run_failing(seed, machine);
        }
    }
    lab_report(wrong + changed + lost == 0 && failed > worlds * FRAMES && again > worlds, name,
               "%ld steps in which calls failed, %ld that went well at the second try; %ld other "
               "errors, %ld states that "
               "changed, %ld worlds that went another way",
               failed, again, wrong, changed, lost);
}

int main(int count, char **words)
{
    const int worlds = lab_given("long", count, words) ? WORLDS * MORE : WORLDS;

    test("errors/worlds", false, worlds);
    test("errors/machines", true, worlds);
    return lab_finish();
}

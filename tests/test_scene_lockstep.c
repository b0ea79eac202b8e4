/* SPDX-License-Identifier: MIT */
/*
 * Two sides of a game over random links (examples/scene_net.h). After every agreed frame both have
 * the world of a third one that has all keys at once, no matter what the links lose, delay and
 * reorder. A side whose keys were changed on the way notices.
 */
#include <string.h>

#include "port.h"
#include "scene_net.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define LINKS 200
#else
#define LINKS 1
#endif
#define FRAMES    60
#define MOST_LOSS 128 /* parts of 256 */
#define TICKS     (40 * FRAMES)

static struct scene scene;
static struct net_side sides[NET_PLAYERS];
static struct net_link links[NET_PLAYERS];
static _Alignas(8) uint8_t blocks[NET_PLAYERS + 1][CAROM_WORLD_BYTES(RINK_CAPS)];
static uint8_t saved[NET_PLAYERS][RINK_SNAPSHOT_BYTES];
static uint8_t keys[FRAMES + 1][NET_PLAYERS];
static uint64_t truth[FRAMES + 1];
static int compared, foretold, undone;

/* Keys that are held for about a third of a second. */
static void press(struct test_random *r)
{
    for (int i = 0; i < NET_PLAYERS; i++) {
        keys[0][i] = 0;
        for (int frame = 1; frame <= FRAMES; frame++) {
            keys[frame][i] = test_random_range(r, 0, 19) == 0
                                 ? (uint8_t)(test_random_next(r) >> 32 & 0xf0)
                                 : keys[frame - 1][i];
        }
    }
}

/* The world that has all keys at once. */
static void play_truth(void)
{
    struct carom_world *world;

    CHECK_AT_LEAST(rink_world(&scene, blocks[NET_PLAYERS], sizeof blocks[0], &world), 0);
    truth[0] = carom_world_hash(world);
    for (int frame = 1; frame <= FRAMES; frame++) {
        CHECK_AT_LEAST(rink_act(world, keys[frame]), 0);
        CHECK_AT_LEAST(carom_world_step(world), 0);
        truth[frame] = carom_world_hash(world);
    }
}

static void begin(struct test_random *r, int loss, int least, int most)
{
    CHECK_AT_LEAST(
        scene_load(&scene, "lockstep", NULL, shape_scene_block, sizeof shape_scene_block), 0);
    press(r);
    play_truth();
    compared = foretold = undone = 0;
    for (int i = 0; i < NET_PLAYERS; i++) {
        struct carom_world *world;

        memset(&links[i], 0, sizeof links[i]);
        links[i].state = test_random_next(r);
        links[i].loss = (uint8_t)loss;
        links[i].delay_least = (uint8_t)least;
        links[i].delay_most = (uint8_t)most;
        CHECK_AT_LEAST(rink_world(&scene, blocks[i], sizeof blocks[i], &world), 0);
        CHECK_AT_LEAST(net_begin(&sides[i], i, world, rink_act, saved[i], sizeof saved[i]), 0);
    }
}

/*
 * One tick of one side, with every frame that it agreed to in that tick. Returns whether all are
 * right.
 */
static bool tick_side(int i, int32_t tick)
{
    struct net_side *side = &sides[i];
    const int32_t before = side->agreed;
    const uint8_t press_now = keys[side->frame < FRAMES ? side->frame + 1 : FRAMES][i];
    bool same = true;

    net_take(side, &links[!i], tick);
    if (side->frame < FRAMES || side->agreed < FRAMES) {
        /* a side that has no more frames to play agrees to the frames that exist */
        CHECK_AT_LEAST(net_frame(side, press_now), 0);
    }
    net_send(side, &links[i], tick);
    for (int32_t frame = before + 1; frame <= side->agreed && frame <= FRAMES; frame++) {
        same = same && net_hash(side, frame) == truth[frame];
        compared++;
    }
    undone += side->undone;
    if (side->stepped > side->agreed && side->stepped <= FRAMES) {
        foretold += carom_world_hash(side->world) != truth[side->stepped];
    }
    return same;
}

static bool done(void)
{
    return sides[0].agreed >= FRAMES && sides[1].agreed >= FRAMES;
}

/* Links with any loss up to a half and any delay up to 12 ticks. */
static void test_links(void)
{
    struct test_random r = {2024};
    int all_foretold = 0, all_undone = 0;

    for (int link = 0; link < LINKS; link++) {
        const int loss = (int)test_random_range(&r, 0, MOST_LOSS);
        const int most = (int)test_random_range(&r, 1, NET_DELAY);
        const int least = (int)test_random_range(&r, 1, most);
        bool same = true;

        begin(&r, loss, least, most);
        for (int32_t tick = 1; tick <= TICKS && !done(); tick++) {
            same = tick_side(0, tick) && same;
            same = tick_side(1, tick) && same;
        }
        CHECK(same);
        CHECK(done());
        CHECK_AT_LEAST(compared, NET_PLAYERS * FRAMES);
        CHECK_EQ(sides[0].apart, 0);
        CHECK_EQ(sides[1].apart, 0);
        all_foretold += foretold;
        all_undone += undone;
    }
    /* the links were bad enough: predicted frames were wrong and were taken back */
    CHECK_MORE(all_foretold, LINKS);
    CHECK_MORE(all_undone, LINKS * FRAMES);
}

/*
 * One bit of one key in one arriving packet is changed: both sides see different hashes from that
 * frame on.
 */
static void test_changed_key(void)
{
    struct test_random r = {5};
    const int32_t changed = FRAMES / 2;
    bool same = true;

    begin(&r, 0, 3, 3);
    for (int32_t tick = 1; tick <= TICKS && !done(); tick++) {
        same = tick_side(0, tick) && same;
        for (int k = 0; k < NET_FLYING; k++) {
            struct net_packet *packet = &links[0].flying[k];

            if (packet->there && packet->sent == tick && tick == changed) {
                packet->keys[packet->count - 1] ^= PORT_PAD_RIGHT;
            }
        }
        same = tick_side(1, tick) && same;
        if (sides[1].agreed < changed) {
            CHECK(same);
        }
    }
    CHECK(!same);
    CHECK_EQ(net_hash(&sides[0], changed - 1), net_hash(&sides[1], changed - 1));
    CHECK_DIFFER(net_hash(&sides[0], changed), net_hash(&sides[1], changed));
    /* packets report it; each side names the first frame that it heard of */
    CHECK(sides[0].apart >= changed || sides[1].apart >= changed);
    CHECK(sides[0].apart == 0 || sides[0].apart >= changed);
    CHECK(sides[1].apart == 0 || sides[1].apart >= changed);
}

/* When nothing arrives, a side goes on for NET_AHEAD frames and waits; then it catches up. */
static void test_cut(void)
{
    struct test_random r = {11};

    begin(&r, 0, 1, 1);
    for (int32_t tick = 1; tick <= 2 * NET_AHEAD; tick++) {
        CHECK_EQ(net_frame(&sides[0], keys[1][0]), tick <= NET_AHEAD);
    }
    CHECK_EQ(sides[0].frame, NET_AHEAD);
    CHECK_EQ(sides[0].agreed, 0);
    CHECK_EQ(net_hash(&sides[0], 0), truth[0]);
}

const struct test tests_scene_lockstep[] = {
    {"scene_lockstep/links", test_links},
    {"scene_lockstep/changed_key", test_changed_key},
    {"scene_lockstep/cut", test_cut},
    {0},
};

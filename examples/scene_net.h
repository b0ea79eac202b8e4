/* SPDX-License-Identifier: MIT */
/*
 * scene_net.h - two machines play one game over a link that loses, delays and reorders. Each steps a world of its
 * own: by the keys of both players where it has them, and else by the last keys that it has of the other one. When more
 * keys arrive it takes its last agreed frame back, a snapshot, and steps again with what was pressed. Nothing but keys goes over
 * the link; the hash that goes with them says whether the worlds are the same.
 *
 *   net_begin(&side[0], 0, world[0], act, saved[0], sizeof saved[0]); and the other one
 *   every tick, for both: net_take(&side[i], &link[!i], tick); net_frame(&side[i], keys);
 *                         net_send(&side[i], &link[i], tick);
 */
#ifndef CAROM_SCENE_NET_H
#define CAROM_SCENE_NET_H

#include "scene.h"

enum {
    NET_PLAYERS = 2,
    NET_AHEAD = 32, /* frames that a side goes on without the other one's keys; then it waits */
    NET_KEPT = 2 * NET_AHEAD,  /* frames whose keys and hashes a side knows */
    NET_DELAY = 12,            /* ticks that a packet takes at most */
    NET_FLYING = NET_DELAY + 1 /* packets on their way at most: one leaves a tick */
};

/* All that the other one may not have yet, so that a lost packet needs no other answer than the next one. */
struct net_packet {
    bool there, lost;
    int32_t sent, due;    /* ticks */
    int32_t first, count; /* frames whose keys are in it */
    int32_t has;          /* the last frame of which the sender has the other one's keys */
    int32_t agreed;       /* the last frame that the sender stepped with all keys */
    uint64_t hash;        /* of its world after that */
    uint8_t keys[NET_KEPT];
};

/* One direction. Chance is a sequence of integers, the same everywhere. */
struct net_link {
    uint64_t state;                  /* any seed */
    uint8_t loss;                    /* so many of 256 packets */
    uint8_t delay_least, delay_most; /* 1 .. NET_DELAY ticks */
    struct net_packet flying[NET_FLYING];
};

struct net_side {
    struct carom_world *world; /* after `stepped` frames */
    /* Does what the keys of both players say, before a step. Returns >= 0 or an error. */
    int (*act)(struct carom_world *world, const uint8_t keys[NET_PLAYERS]);
    uint8_t *saved; /* the world after the agreed frame */
    size_t room, bytes;
    int me;
    int32_t frame;   /* of which this player has pressed keys */
    int32_t stepped; /* to which the world is: `frame`, or an error was returned */
    int32_t agreed;  /* to which the keys of both are known */
    int32_t known;   /* of the other's */
    int32_t has;     /* of which the other one has ours */
    int32_t undone;  /* frames taken back in the last tick */
    int32_t apart;   /* a frame after which the hash of the other one was another; 0: none */
    uint8_t keys[NET_PLAYERS][NET_KEPT];
    uint64_t hash[NET_KEPT]; /* after agreed frames */
};

/*
 * A side whose world is as the game begins, the same for both.
 *   saved, room  carom_snapshot_size of the world at any time
 * Returns >= 0 or an error.
 */
int net_begin(struct net_side *side, int me, struct carom_world *world,
              int (*act)(struct carom_world *world, const uint8_t keys[NET_PLAYERS]),
              uint8_t *saved, size_t room);

/* Take what has arrived by a tick. */
void net_take(struct net_side *side, struct net_link *link, int32_t tick);

/*
 * Go on by a frame with this player's keys. Returns 1, 0 when the side waits for the other one and has not taken
 * the keys, or an error.
 */
int net_frame(struct net_side *side, uint8_t keys);

/* Send what the other one may not have. */
void net_send(struct net_side *side, struct net_link *link, int32_t tick);

/* The hash after an agreed frame, one of the last NET_KEPT. */
uint64_t net_hash(const struct net_side *side, int32_t frame);

/*
 * What they play in the scene `lockstep`: two pucks shove a ball and boxes in a rink.
 *   fill  the bodies, into a world of these capacities
 *   act   keys are those of a pad
 */
#define RINK_CAPS           8, 32, 96, 256, 0, 1024
#define RINK_SNAPSHOT_BYTES 16384 /* more than this world ever needs; net_begin and net_frame ask */
enum { RINK_FLOOR, RINK_PUCK, RINK_BALL = RINK_PUCK + NET_PLAYERS, RINK_BOX, RINK_BOXES = 3 };
enum { RINK_BODIES = RINK_BOX + RINK_BOXES };
int rink_world(const struct scene *scene, void *block, size_t bytes, struct carom_world **world);
int rink_act(struct carom_world *world, const uint8_t keys[NET_PLAYERS]);

#endif

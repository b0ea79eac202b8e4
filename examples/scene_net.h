/* SPDX-License-Identifier: MIT */
/*
 * scene_net.h - two machines play one game over a link that loses, delays and reorders packets.
 *
 * Each machine steps its own world: with the keys of both players where it has them, otherwise
 * with the last keys that it has of the other player. When more keys arrive, it restores its last
 * agreed frame from a snapshot and steps again with the right keys. Only keys go over the link,
 * with a hash that shows whether the worlds are the same.
 *
 *     net_begin(&side[0], 0, world[0], act, saved[0], sizeof saved[0]); and the other one; every
 *   tick, for both: net_take(&side[i], &link[!i], tick); net_frame(&side[i], keys);
 *                         net_send(&side[i], &link[i], tick);
 */
#ifndef CAROM_SCENE_NET_H
#define CAROM_SCENE_NET_H

#include "scene.h"

enum {
    NET_PLAYERS = 2,
    NET_AHEAD = 32, /* frames that a side goes on without the other side's keys before it waits */
    NET_KEPT = 2 * NET_AHEAD,  /* frames whose keys and hashes a side keeps */
    NET_DELAY = 12,            /* longest flight of a packet, ticks */
    NET_FLYING = NET_DELAY + 1 /* most packets in flight: one leaves a tick */
};

/* Everything that the other side may lack, so the next packet makes up for a lost one. */
struct net_packet {
    bool there, lost;
    int32_t sent, due;    /* ticks */
    int32_t first, count; /* frames whose keys it holds */
    int32_t has;          /* the last frame for which the sender has the other side's keys */
    int32_t agreed;       /* the last frame that the sender stepped with all keys */
    uint64_t hash;        /* hash of the sender's world after that frame */
    uint8_t keys[NET_KEPT];
};

/* One direction of the link. Losses and delays follow a sequence of integers, the same everywhere. */
struct net_link {
    uint64_t state;                  /* any seed */
    uint8_t loss;                    /* packets lost of 256 */
    uint8_t delay_least, delay_most; /* range of delays, 1 to NET_DELAY ticks */
    struct net_packet flying[NET_FLYING];
};

struct net_side {
    struct carom_world *world; /* after `stepped` frames */
    /* Applies the keys of both players before a step. Returns >= 0 or an error. */
    int (*act)(struct carom_world *world, const uint8_t keys[NET_PLAYERS]);
    uint8_t *saved; /* snapshot after the agreed frame */
    size_t room, bytes;
    int me;
    int32_t frame;   /* last frame for which this player has pressed keys */
    int32_t stepped; /* frames that the world has stepped: `frame`, unless an error was returned */
    int32_t agreed;  /* last frame for which both players' keys are known */
    int32_t known;   /* last frame for which the other player's keys are known */
    int32_t has;     /* last frame for which the other side has our keys */
    int32_t undone;  /* frames undone in the last tick */
    int32_t apart;   /* a frame after which the two hashes differed; 0: none */
    uint8_t keys[NET_PLAYERS][NET_KEPT];
    uint64_t hash[NET_KEPT]; /* after agreed frames */
};

/*
 * Make a side. Its world is at the beginning of the game, the same for both sides.
 *   saved, room  carom_snapshot_size of the world at any time
 * Returns >= 0 or an error.
 */
int net_begin(struct net_side *side, int me, struct carom_world *world,
              int (*act)(struct carom_world *world, const uint8_t keys[NET_PLAYERS]),
              uint8_t *saved, size_t room);

/* Take the packets that have arrived by a tick. */
void net_take(struct net_side *side, struct net_link *link, int32_t tick);

/*
 * Advance by a frame with this player's keys. Returns 1; 0 if the side waits for the other one and
 * did not take the keys; or an error.
 */
int net_frame(struct net_side *side, uint8_t keys);

/* Send everything that the other side may lack. */
void net_send(struct net_side *side, struct net_link *link, int32_t tick);

/* The hash after an agreed frame, one of the last NET_KEPT. */
uint64_t net_hash(const struct net_side *side, int32_t frame);

/*
 * The game of the scene `lockstep`: two pucks push a ball and boxes in a rink.
 *   fill  adds the bodies to a world of these capacities
 *   act   keys are those of a pad
 */
#define RINK_CAPS           8, 32, 96, 256, 0, 1024
#define RINK_SNAPSHOT_BYTES 16384 /* more than this world needs; net_begin and net_frame check */
enum { RINK_FLOOR, RINK_PUCK, RINK_BALL = RINK_PUCK + NET_PLAYERS, RINK_BOX, RINK_BOXES = 3 };
enum { RINK_BODIES = RINK_BOX + RINK_BOXES };
int rink_world(const struct scene *scene, void *block, size_t bytes, struct carom_world **world);
int rink_act(struct carom_world *world, const uint8_t keys[NET_PLAYERS]);

#endif

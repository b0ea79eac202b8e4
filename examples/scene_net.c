/* SPDX-License-Identifier: MIT */
/* Two machines play one game over a bad link: prediction, snapshots and rollback. */
#include "scene_net.h"

#include <string.h>

/* Knuth's MMIX generator; the upper bits are used. */
static uint32_t chance(struct net_link *link, uint32_t below)
{
    link->state = link->state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(link->state >> 33) % below;
}

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* The agreed frame is the one to which a side goes back. */
static int save(struct net_side *side)
{
    int bytes = carom_snapshot_save(side->world, side->saved, side->room);

    side->hash[side->agreed % NET_KEPT] = carom_world_hash(side->world);
    side->bytes = bytes < 0 ? 0 : (size_t)bytes;
    return bytes;
}

int net_begin(struct net_side *side, int me, struct carom_world *world,
              int (*act)(struct carom_world *world, const uint8_t keys[NET_PLAYERS]),
              uint8_t *saved, size_t room)
{
    *side = (struct net_side){.world = world, .act = act, .saved = saved, .room = room, .me = me};
    return save(side);
}

uint64_t net_hash(const struct net_side *side, int32_t frame)
{
    return side->hash[frame % NET_KEPT];
}

/* Check that the other side has the same world, for a frame that this side also has. */
static void compare(struct net_side *side, const struct net_packet *packet)
{
    if (packet->agreed <= side->agreed && packet->agreed > side->agreed - NET_KEPT &&
        packet->hash != net_hash(side, packet->agreed) && side->apart == 0) {
        side->apart = packet->agreed;
    }
}

static void receive(struct net_side *side, const struct net_packet *packet)
{
    const int32_t last = packet->first + packet->count - 1;

    for (int32_t frame = side->known + 1; frame <= last; frame++) {
        side->keys[!side->me][frame % NET_KEPT] = packet->keys[frame - packet->first];
        side->known = frame;
    }
    if (packet->has > side->has) {
        side->has = packet->has;
    }
    compare(side, packet);
}

void net_take(struct net_side *side, struct net_link *link, int32_t tick)
{
    for (int i = 0; i < NET_FLYING; i++) {
        struct net_packet *packet = &link->flying[i];

        if (packet->there && packet->due <= tick) {
            packet->there = false;
            if (!packet->lost) {
                receive(side, packet);
            }
        }
    }
}

/* Step a frame with both players' keys; unknown keys of the other side are taken to be its last known ones. */
static int step(struct net_side *side)
{
    const int32_t frame = side->stepped + 1;
    uint8_t keys[NET_PLAYERS];
    int result;

    keys[side->me] = side->keys[side->me][frame % NET_KEPT];
    keys[!side->me] = side->keys[!side->me][least(frame, side->known) % NET_KEPT];
    result = side->act(side->world, keys);
    result = result < 0 ? result : carom_world_step(side->world);
    side->stepped = result < 0 ? side->stepped : frame;
    return result;
}

/* Go back to the agreed frame, then step to the last frame whose keys are all known. */
static int agree(struct net_side *side, int32_t last)
{
    int result = CAROM_OK;

    side->undone = side->stepped - side->agreed;
    if (side->undone > 0) {
        result = carom_snapshot_load(side->world, side->saved, side->bytes);
        side->stepped = result < 0 ? side->stepped : side->agreed;
    }
    while (result >= 0 && side->agreed < last) {
        result = step(side);
        if (result >= 0) {
            side->agreed = side->stepped;
            result = save(side);
        }
    }
    return result;
}

int net_frame(struct net_side *side, uint8_t keys)
{
    const bool goes = side->frame - least(side->frame, side->known) < NET_AHEAD;
    int32_t last;
    int result = CAROM_OK;

    if (goes) {
        side->frame++;
        side->keys[side->me][side->frame % NET_KEPT] = keys;
    }
    side->undone = 0;
    last = least(side->frame, side->known);
    if (last > side->agreed) {
        result = agree(side, last);
    }
    while (result >= 0 && side->stepped < side->frame) {
        result = step(side);
    }
    return result < 0 ? result : goes;
}

/* Some entry is free, because a packet flies for NET_DELAY ticks at most. */
static struct net_packet *room_for(struct net_link *link)
{
    int i = 0;

    while (i < NET_FLYING - 1 && link->flying[i].there) {
        i++;
    }
    return &link->flying[i];
}

void net_send(struct net_side *side, struct net_link *link, int32_t tick)
{
    struct net_packet *packet = room_for(link);

    memset(packet, 0, sizeof *packet);
    packet->there = true;
    packet->lost = chance(link, 256) < link->loss;
    packet->sent = tick;
    packet->due =
        tick + link->delay_least + (int32_t)chance(link, 1u + link->delay_most - link->delay_least);
    packet->first = side->has + 1;
    packet->count = side->frame - side->has;
    packet->has = side->known;
    packet->agreed = side->agreed;
    packet->hash = net_hash(side, side->agreed);
    for (int32_t i = 0; i < packet->count; i++) {
        packet->keys[i] = side->keys[side->me][(packet->first + i) % NET_KEPT];
    }
}

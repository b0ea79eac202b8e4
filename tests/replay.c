/* SPDX-License-Identifier: MIT */
/*
 * replay - play a recording: replay.elf file=FILE, or the file that is built in. Ends with status
 * 0 if all is the same, 1 for a difference and 2 for a file that cannot be played.
 *
 *   each=1   a line a frame: its state and what its calls were
 *   trace=F  the results of frame F's stages, and the places of its bodies after it
 */

#include "carom_replay.h"
#include "port.h"

#ifdef REPLAY_BUILT_IN /* for a board that is short of memory: the file lies in the image, and all
                        * RAM that is left is room for the world */
extern const uint8_t replay_file[], replay_file_end[];
extern uint8_t room_start[], room_end[]; /* defined in linker/sections.ld */
#else
#define FILE_BYTES (2u << 20)
#define ROOM       (6u << 20)
static uint8_t replay_file[FILE_BYTES];
static const uint8_t *replay_file_end;
static _Alignas(8) uint8_t room_start[ROOM];
static uint8_t *const room_end = room_start + ROOM;
#endif

static struct carom_replay player;

static void put(const char *text)
{
    while (*text) {
        port_putc(*text++);
    }
}

static void put_hex(uint64_t number)
{
    for (int shift = 60; shift >= 0; shift -= 4) {
        port_putc("0123456789abcdef"[number >> shift & 15]);
    }
}

static void put_number(int64_t number)
{
    char digits[24], *at = digits + sizeof digits - 1;
    uint64_t left = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;

    *at = 0;
    do {
        *--at = (char)('0' + left % 10);
        left /= 10;
    } while (left > 0);
    put(number < 0 ? "-" : "");
    put(at);
}

static void put_three(const char *what, const int64_t v[3])
{
    put(what);
    for (int k = 0; k < 3; k++) {
        put(" ");
        put_number(v[k]);
    }
}

/* Print stages and bodies, a line each, so that two machines' lines can be compared. */
static void trace(void)
{
    uint64_t digests[CAROM_REPLAY_PARTS];
    struct carom_body_state s;

    if (carom_replay_digests(player.world, digests) < 0) {
        return;
    }
    for (int part = 0; part < CAROM_REPLAY_PARTS; part++) {
        put("stage ");
        put(carom_replay_part_name(part));
        put(" ");
        put_hex(digests[part]);
        put("\n");
    }
    for (int body = 0; body < carom_body_count(player.world); body++) {
        if (carom_body_get(player.world, body, &s) >= 0) {
            put("body ");
            put_number(body);
            put_three(" position", s.position.c);
            put_three(" velocity", s.velocity.c);
            put_three(" spin", s.spin.c);
            put(s.asleep ? " asleep\n" : "\n");
        }
    }
}

static void put_frame(uint32_t calls)
{
    put("frame ");
    put_number(player.frames);
    put(" ");
    put_hex(carom_world_hash(player.world));
    put(" calls ");
    put_hex(calls);
    put("\n");
}

static void put_difference(void)
{
    if (player.difference == CAROM_REPLAY_IN_SUM) {
        put("the file was altered: its sum or its end does not fit\n");
        return;
    }
    put("frame ");
    put_number(player.frames);
    if (player.difference == CAROM_REPLAY_IN_PART) {
        put(", stage ");
        put(player.stages ? carom_replay_part_name(player.part) : "not recorded");
        put(" differs: low bits ");
        put_hex((uint64_t)player.found);
        put(", recorded ");
        put_hex((uint64_t)player.wanted);
    } else {
        put(", ");
        put(carom_replay_call_name(player.call));
        put(player.difference == CAROM_REPLAY_IN_RESULT ? " returns another result: "
                                                        : " asks about other contacts: ");
        put_number(player.found);
        put(", recorded ");
        put_number(player.wanted);
    }
    put("\n");
}

/* The program's exit status for the player's last result. */
static int verdict(int result)
{
    if (result == CAROM_REPLAY_DIFFERS) {
        put_difference();
        return 1;
    }
    if (result < 0) {
        put("frame ");
        put_number(player.frames + 1);
        put(" cannot be played: ");
        put(carom_result_text(result));
        if (result == CAROM_ERR_MEMORY) {
            put(": the board has room for ");
            put_number(room_end - room_start);
            put(" bytes of world and meshes");
        }
        put("\n");
        return 2;
    }
    put_number(player.frames);
    put(" frames, the same");
    put(result == CAROM_REPLAY_CUT ? "; the file is cut short there\n" : "\n");
    return result == CAROM_REPLAY_CUT ? 2 : 0;
}

/* Read the whole file into memory. */
static bool read_file(void)
{
#ifndef REPLAY_BUILT_IN
    const char *name = port_option("file");
    const long bytes = name ? port_read_file(name, replay_file, sizeof replay_file) : -1;

    if (bytes < 0 || (size_t)bytes == sizeof replay_file) {
        return false;
    }
    replay_file_end = replay_file + bytes;
#endif
    return true;
}

int main(void)
{
    bool each;
    uint32_t traced;
    int result;

    port_init();
    each = port_number("each", 0) != 0;
    traced = port_number("trace", 0);
    if (!read_file()) {
        put("file=FILE names no file, or one that is too large\n");
        port_exit(2);
    }
    result = carom_replay_begin(&player, replay_file, (size_t)(replay_file_end - replay_file),
                                room_start, (size_t)(room_end - room_start));
    result = result < 0 ? result : CAROM_REPLAY_FRAME;
    while (result == CAROM_REPLAY_FRAME) {
        const size_t from = player.at;

        result = carom_replay_frame(&player);
        if (each && player.world && result > 0) {
            put_frame((uint32_t)(player.at - from));
        }
        if (traced != 0 && player.frames == traced && result > 0) {
            trace();
            traced = 0;
        }
    }
    port_exit(verdict(result));
}

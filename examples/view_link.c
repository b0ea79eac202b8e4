/* SPDX-License-Identifier: MIT */
/*
 * Links: the scene's name and, if there are acts, '~', their number and the acts. A number has five
 * bits a digit, the lowest first, and a sixth bit while more digits follow; digits are those of
 * base64 for addresses (RFC 4648). An act is 4 times the frames since the last act plus its kind,
 * then its numbers, each as the difference from the last act of the kind. Signs are in the lowest
 * bit.
 */
#include <string.h>

#include "view_parts.h"

#define MARK        '~'
#define NAME_BYTES  32
#define DIGITS_MOST 7 /* 35 bits */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/* The last act of each kind, for differences. */
struct before {
    int32_t frame;
    int32_t n[VIEW_ACT_KINDS][4];
};

/* ------------------------------------------------------------------- writing */

struct writer {
    char *text;
    size_t room, length; /* the final 0 is not counted; a length above the room means that the text
                          * does not fit */
};

static void put(struct writer *w, char c)
{
    if (w->length + 1 < w->room) {
        w->text[w->length] = c;
    }
    w->length++;
}

static void put_number(struct writer *w, uint64_t v)
{
    for (; v >> 5; v >>= 5) {
        put(w, digits[32 | (v & 31)]);
    }
    put(w, digits[v]);
}

static void put_signed(struct writer *w, int64_t v)
{
    put_number(w, v < 0 ? ((uint64_t)-v << 1) - 1 : (uint64_t)v << 1);
}

static void put_act(struct writer *w, struct before *before, const struct view_act *act)
{
    put_number(w, (uint64_t)(act->frame - before->frame) * VIEW_ACT_KINDS + act->kind);
    before->frame = act->frame;
    for (int i = 0; i < view_act_numbers[act->kind]; i++) {
        put_signed(w, (int64_t)act->n[i] - before->n[act->kind][i]);
        before->n[act->kind][i] = act->n[i];
    }
}

int view_link(char *text, size_t room)
{
    struct writer w = {text, room, 0};
    struct before before = {0};

    if (!view_world() || strcmp(view_scene(), "user") == 0) {
        return CAROM_ERR_ARGUMENT;
    }
    for (const char *name = view_scene(); *name; name++) {
        put(&w, *name);
    }
    if (view_acts.count > 0) {
        put(&w, MARK);
        put_number(&w, view_acts.count);
        for (uint32_t i = 0; i < view_acts.count; i++) {
            put_act(&w, &before, &view_acts.list[i]);
        }
    }
    if (w.length >= room) {
        return CAROM_ERR_MEMORY;
    }
    text[w.length] = 0;
    return (int)w.length;
}

/* ------------------------------------------------------------------- reading */

struct reader {
    const char *at;
    bool ok;
};

/* The value of a digit; -1 for any other character. */
static int digit_of(char c)
{
    for (int i = 0; i < 64; i++) {
        if (digits[i] == c) {
            return i;
        }
    }
    return -1;
}

static uint64_t take_number(struct reader *r)
{
    uint64_t v = 0;

    for (int i = 0; i < DIGITS_MOST && r->ok; i++) {
        const int digit = digit_of(*r->at);

        if (digit < 0) {
            break;
        }
        r->at++;
        v |= (uint64_t)(digit & 31) << 5 * i;
        if (digit < 32) {
            return v;
        }
    }
    r->ok = false;
    return 0;
}

static int64_t take_signed(struct reader *r)
{
    const uint64_t v = take_number(r);

    return v & 1 ? -(int64_t)(v >> 1) - 1 : (int64_t)(v >> 1);
}

static void take_act(struct reader *r, struct before *before, struct view_act *act)
{
    const uint64_t head = take_number(r);
    const uint64_t frame = (uint64_t)before->frame + head / VIEW_ACT_KINDS;

    *act = (struct view_act){.kind = (uint8_t)(head % VIEW_ACT_KINDS)};
    for (int i = 0; i < view_act_numbers[act->kind]; i++) {
        const int64_t n = before->n[act->kind][i] + take_signed(r);

        r->ok = r->ok && n >= INT32_MIN && n <= INT32_MAX;
        act->n[i] = before->n[act->kind][i] = r->ok ? (int32_t)n : 0;
    }
    r->ok = r->ok && frame >= 1 && frame <= VIEW_FRAME_MAX && view_act_is_sound(act);
    act->frame = before->frame = r->ok ? (int32_t)frame : 1;
}

/* Read the acts of a link, into `list` if it is not NULL. Returns how many, or -1 for a text that is no link. */
static int64_t take_acts(const char *text, struct view_act *list)
{
    struct reader r = {text, true};
    struct before before = {0};
    const uint64_t count = take_number(&r);
    struct view_act act;

    if (count < 1 || count > VIEW_ACTS_MAX) {
        return -1;
    }
    for (uint64_t i = 0; i < count && r.ok; i++) {
        take_act(&r, &before, list ? &list[i] : &act);
    }
    return r.ok && !*r.at ? (int64_t)count : -1;
}

/* True if scene.h knows the scene, and the scene needs no mesh of the caller's. */
static bool is_scene(const char *name)
{
    for (int i = 0; scene_name(i); i++) {
        if (strcmp(name, scene_name(i)) == 0) {
            return strcmp(name, "user") != 0;
        }
    }
    return false;
}

int view_follow(const char *text)
{
    char name[NAME_BYTES];
    size_t length = 0;
    int64_t count = 0;
    int result;

    while (text[length] && text[length] != MARK && length < NAME_BYTES - 1) {
        name[length] = text[length];
        length++;
    }
    name[length] = 0;
    text += length;
    if ((*text && *text != MARK) || !is_scene(name)) {
        return CAROM_ERR_ARGUMENT;
    }
    if (*text == MARK) {
        count = take_acts(++text, NULL);
    }
    if (count < 0) {
        return CAROM_ERR_ARGUMENT;
    }
    result = view_open(name, NULL);
    if (result >= 0 && count > 0) {
        take_acts(text, view_acts.list);
        view_acts.count = (uint32_t)count;
        view_acts.given = view_acts.list[count - 1].frame;
    }
    return result < 0 ? result : (int)view_acts.given;
}

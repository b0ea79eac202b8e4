/* SPDX-License-Identifier: MIT */
/* Playing: make the calls of a file again and compare the results. No byte of the file is trusted. */
#include "../num/fnv.h"
#include "play.h"

static bool next_is(const struct carom_replay *p, uint8_t token)
{
    return p->run == 0 && p->at < p->bytes && p->file[p->at] == token;
}

/* Keep the first difference of a frame. */
static void differ(struct carom_replay *p, int difference, int64_t wanted, int64_t found)
{
    if (p->difference == CAROM_REPLAY_SAME) {
        p->difference = (uint8_t)difference;
        p->wanted = wanted;
        p->found = found;
    }
}

/* ----------------------------------------------------------------------- contacts */

/* An answer of the program: to which question since the last one, and what it was. */
struct answer {
    int64_t asked, e_q30, mu_q16;
    bool keep;
};

/* Read the answer that the file has next. Returns the bytes that it takes; 0 if the file ends in it. */
static size_t read_answer(const struct carom_replay *p, struct answer *answer)
{
    struct replay_coder c = play_rest(p);

    c.at = 1;
    answer->asked = replay_number(&c, 0, 1, UINT32_MAX);
    answer->keep = replay_fixed(&c, 0, 1) != 0;
    answer->e_q30 = replay_number(&c, 0, INT32_MIN, INT32_MAX);
    answer->mu_q16 = replay_number(&c, 0, 0, UINT32_MAX);
    return c.bad ? 0 : c.at;
}

/* Answer as the program did, if the next bytes of the file are about this question. */
static bool answer_as_recorded(void *user, struct carom_touch *touch)
{
    struct carom_replay *p = (struct carom_replay *)user;
    struct answer answer;
    size_t bytes;

    p->asked++;
    if (!next_is(p, REPLAY_TOKEN_ANSWER)) {
        return true;
    }
    bytes = read_answer(p, &answer);
    if (bytes == 0 || (uint32_t)answer.asked != p->asked) {
        return true;
    }
    p->at += bytes;
    p->asked = 0;
    touch->restitution_q30 = (int32_t)answer.e_q30;
    touch->friction_q16 = (uint32_t)answer.mu_q16;
    return answer.keep;
}

/* -------------------------------------------------------------------------- calls */

static int make_world(struct carom_replay *p, struct replay_call *call)
{
    struct carom_config *config = &call->u.config;
    const size_t bytes = carom_world_bytes(&config->caps);

    config->contact = config->contact_user ? answer_as_recorded : NULL;
    config->contact_user = p;
    if (!play_take_again(p, &p->block, &p->block_bytes, bytes)) {
        return CAROM_ERR_MEMORY;
    }
    p->world = NULL;
    return carom_world_init(p->block, p->block_bytes, config, &p->world) < 0 ? (int)CAROM_ERR_FORMAT
                                                                             : CAROM_OK;
}

/* Compare the state after a step with the recorded one. Returns what carom_replay_frame returns. */
static int check(struct carom_replay *p)
{
    struct replay_coder c = play_rest(p);
    uint64_t digests[CAROM_REPLAY_PARTS];

    p->frames++;
    if (!next_is(p, REPLAY_TOKEN_CHECK)) {
        return p->at < p->bytes ? (int)CAROM_ERR_FORMAT : CAROM_REPLAY_CUT;
    }
    c.at = 1;
    carom_replay_digests(p->world, digests);
    for (int part = p->stages ? 0 : CAROM_REPLAY_STATE; part < CAROM_REPLAY_PARTS; part++) {
        const bool full = part == CAROM_REPLAY_STATE && p->frames % REPLAY_FULL_EVERY == 0;
        const uint64_t wanted = replay_fixed(&c, 0, full ? 8 : 2);
        const uint64_t found = full ? digests[part] : digests[part] & 0xffff;

        if (wanted != found && !c.bad && p->difference == CAROM_REPLAY_SAME) {
            p->part = (uint8_t)part;
            differ(p, CAROM_REPLAY_IN_PART, (int64_t)wanted, (int64_t)found);
        }
    }
    if (!play_done(p, &c)) {
        return CAROM_REPLAY_CUT; /* the program ended in this step */
    }
    return p->difference == CAROM_REPLAY_SAME ? CAROM_REPLAY_FRAME : CAROM_REPLAY_DIFFERS;
}

/* Compare the result of a call with the recorded one. */
static int compare_result(struct carom_replay *p, int result)
{
    int64_t wanted = 0;

    if (next_is(p, REPLAY_TOKEN_ANSWER)) {
        struct answer answer;

        if (read_answer(p, &answer) == 0) {
            return CAROM_REPLAY_CUT; /* the program ended in this step */
        }
        differ(p, CAROM_REPLAY_IN_ANSWER, 0, p->asked);
        return CAROM_REPLAY_DIFFERS;
    }
    if (next_is(p, REPLAY_TOKEN_RESULT)) {
        struct replay_coder c = play_rest(p);

        c.at = 1;
        wanted = replay_number(&c, 0, INT32_MIN, INT32_MAX);
        if (!play_done(p, &c)) {
            return CAROM_REPLAY_CUT;
        }
    }
    if (result != wanted && p->run == 0 && p->at >= p->bytes) {
        return CAROM_REPLAY_CUT; /* the program ended before the result was written */
    }
    if (result != wanted) {
        differ(p, CAROM_REPLAY_IN_RESULT, wanted, result);
    }
    return CAROM_OK;
}

/* Beside enum carom_replay_result: the next call is a step, which carom_replay_frame makes. */
#define STEP_IS_NEXT (CAROM_REPLAY_CUT + 1)

/* Make a call and compare its result. Returns an error of the file, STEP_IS_NEXT, or CAROM_OK. */
static int perform(struct carom_replay *p, struct replay_call *call)
{
    struct carom_mesh **mesh = NULL;
    int result;

    if (p->difference == CAROM_REPLAY_SAME) { /* else it names the call that differs */
        p->call = call->op;
    }
    if (call->op == CAROM_CALL_world_init) {
        return make_world(p, call);
    }
    if (call->op == CAROM_CALL_body_add && call->mesh < CAROM_REPLAY_MESHES) {
        mesh = &p->meshes[call->mesh];
        call->u.def.mesh = *mesh;
    }
    if (!p->world || (call->op == CAROM_CALL_body_add && !call->u.def.mesh)) {
        return CAROM_ERR_FORMAT;
    }
    if (call->op == CAROM_CALL_world_step) {
        return STEP_IS_NEXT;
    }
    result = replay_do(p->world, call);
    if (mesh && (*mesh)->surface) {
        *mesh = NULL; /* such a mesh belongs to one body */
    }
    return compare_result(p, result);
}

/* Play a call of a slot. */
FIX_OWN_FRAME static int perform_again(struct carom_replay *p, uint8_t slot)
{
    const struct carom_replay_slot *s = &p->memory.slots[slot];
    struct replay_coder c = {.in = s->bytes, .at = 1, .size = s->size};
    struct replay_call call = {.op = s->bytes[0]};

    if (s->size == 0) {
        return CAROM_ERR_FORMAT;
    }
    replay_follow(&p->memory, slot);
    replay_code(&c, &call);
    CAROM_ASSERT(!c.bad); /* these bytes were read before */
    return perform(p, &call);
}

/* Play a call that is written in full. */
FIX_OWN_FRAME static int perform_new(struct carom_replay *p, uint8_t op)
{
    const uint8_t *bytes = p->file + p->at - 1;
    struct replay_coder c = play_rest(p);
    struct replay_call call = {.op = op};
    int result;

    replay_code(&c, &call);
    if (!play_done(p, &c)) {
        return p->at >= p->bytes ? CAROM_REPLAY_CUT : (int)CAROM_ERR_FORMAT;
    }
    if (!replay_has_data(op)) {
        replay_keep(&p->memory, bytes, c.at + 1);
        return perform(p, &call);
    }
    if (!p->world) {
        return CAROM_ERR_FORMAT;
    }
    result = play_data(p, &call);
    return result < 0 ? result : perform(p, &call);
}

/* Check that the end fits the file. */
FIX_OWN_FRAME static int end(struct carom_replay *p)
{
    const uint32_t sum = replay_sum(FNV32_START, p->file, p->bytes - 4); /* the header is longer */
    struct replay_coder c = play_rest(p);
    const uint64_t frames = replay_fixed(&c, 0, 4), hash = replay_fixed(&c, 0, 8);
    const uint64_t wanted = replay_fixed(&c, 0, 4);

    if (!play_done(p, &c)) {
        return CAROM_REPLAY_CUT;
    }
    if (p->at != p->bytes || wanted != sum || frames != p->frames ||
        hash != carom_world_hash(p->world)) {
        differ(p, CAROM_REPLAY_IN_SUM, (int64_t)wanted, sum);
        p->at = p->bytes;
        return CAROM_REPLAY_DIFFERS;
    }
    return CAROM_REPLAY_END;
}

static int go_on(struct carom_replay *p)
{
    uint8_t token;

    if (p->run > 0) {
        p->run--;
        return perform_again(p, p->memory.slots[p->memory.last].next);
    }
    if (p->at >= p->bytes) {
        return CAROM_REPLAY_CUT;
    }
    token = p->file[p->at++];
    if (token >= REPLAY_TOKEN_RUN) {
        p->run = (uint32_t)(token - REPLAY_TOKEN_RUN) + 1;
        return CAROM_OK;
    }
    if (token >= REPLAY_TOKEN_SLOT && token < REPLAY_TOKEN_SLOT + CAROM_REPLAY_SLOTS) {
        return perform_again(p, (uint8_t)(token - REPLAY_TOKEN_SLOT));
    }
    if (token == REPLAY_TOKEN_MESH) {
        return play_mesh(p);
    }
    if (token == REPLAY_TOKEN_JOINT) {
        return play_joint(p);
    }
    if (token == REPLAY_TOKEN_ANEW && p->world) {
        return CAROM_OK; /* the load before it said so already */
    }
    return token < CAROM_CALL_COUNT ? perform_new(p, token) : CAROM_ERR_FORMAT;
}

/* Play on until a step is next. Returns STEP_IS_NEXT, or what carom_replay_frame returns. */
FIX_OWN_FRAME static int play_calls(struct carom_replay *p)
{
    int result = CAROM_OK;

    while (result == CAROM_OK) {
        if (next_is(p, REPLAY_TOKEN_END)) {
            p->at++;
            return end(p);
        }
        result = go_on(p);
    }
    return result;
}

/* Compare a step with the recorded one: its result, and the state after it. */
FIX_OWN_FRAME static int check_step(struct carom_replay *p, int result)
{
    result = compare_result(p, replay_result(CAROM_CALL_world_step, result));
    return result == CAROM_OK ? check(p) : result;
}

/* The step is made here, above nothing else on the stack: it goes deepest. */
int carom_replay_frame(struct carom_replay *p)
{
    int result;

    if (!p) {
        return CAROM_ERR_NULL;
    }
    p->difference = CAROM_REPLAY_SAME;
    result = play_calls(p);
    return result == STEP_IS_NEXT ? check_step(p, carom_world_step(p->world)) : result;
}

int carom_replay_begin(struct carom_replay *p, const void *file, size_t bytes, void *mem,
                       size_t room)
{
    struct replay_coder c = {.in = (const uint8_t *)file, .at = 4, .size = bytes};
    uint64_t version, flags;

    if (!p || !file || !mem) {
        return CAROM_ERR_NULL;
    }
    memset(p, 0, sizeof *p);
    if ((uintptr_t)mem % 8 != 0) {
        return CAROM_ERR_MEMORY;
    }
    version = replay_fixed(&c, 0, 1);
    flags = replay_fixed(&c, 0, 1);
    p->note_bytes = (uint8_t)replay_fixed(&c, 0, 1);
    if (c.bad || memcmp(file, REPLAY_MAGIC, 4) != 0 || version != REPLAY_VERSION ||
        flags > REPLAY_STAGES || p->note_bytes > REPLAY_NOTE_MAX || p->note_bytes > bytes - c.at) {
        return CAROM_ERR_FORMAT;
    }
    p->file = (const uint8_t *)file;
    p->bytes = bytes;
    p->note = (const char *)p->file + c.at;
    p->at = c.at + p->note_bytes;
    p->stages = flags & REPLAY_STAGES;
    p->mem = (uint8_t *)mem;
    p->room = room;
    return CAROM_OK;
}

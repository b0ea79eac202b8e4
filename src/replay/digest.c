/* SPDX-License-Identifier: MIT */
/* Digests: for each stage, one number of all that the stage found in a step. */
#include "../num/fnv.h"
#include "../world/world.h"
#include "call.h"

static uint64_t add(uint64_t digest, int64_t number)
{
    for (int i = 0; i < 8; i++) {
        digest = fnv_add(digest, (uint8_t)((uint64_t)number >> 8 * i));
    }
    return digest;
}

static uint64_t add_all(uint64_t digest, const uint32_t *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        digest = add(digest, numbers[i]);
    }
    return digest;
}

static uint64_t add_three(uint64_t digest, const int64_t v[3])
{
    return add(add(add(digest, v[0]), v[1]), v[2]);
}

static uint64_t of_faces(const struct carom_world *w)
{
    uint64_t digest = FNV_START;

    for (uint32_t i = 0; i < w->pools[CAROM_POOL_faces].used; i++) {
        digest =
            add(digest, (int64_t)w->interfere.faces[i].body << 16 | w->interfere.faces[i].face);
    }
    return digest;
}

static uint64_t of_contact(const struct carom_world *w, const struct contact *c, uint64_t digest)
{
    const struct pair *p = &w->pairs[c->key.pair];
    const carom_v3_q32 point = contact_point(c);

    digest = add(digest, (int64_t)p->a << 16 | p->b);
    digest = add_three(digest, point.c);
    for (int k = 0; k < 3; k++) {
        digest = add(digest, c->normal.c[k]);
    }
    return add(digest, c->gap_q22);
}

int carom_replay_digests(const struct carom_world *w, uint64_t digests[CAROM_REPLAY_PARTS])
{
    if (!w || !digests) {
        return CAROM_ERR_NULL;
    }
    {
        const struct carom_stats *s = &w->stats;
        const uint32_t search[] = {s->substeps, s->hits,        s->gathers,
                                   s->roots,    s->refinements, s->candidates};
        const uint32_t impact[] = {s->impacts, s->energy_rule, s->cut_islands};
        const uint32_t rest[] = {s->contacts, s->sweeps, s->calmed};

        digests[CAROM_REPLAY_INTERFERE] = of_faces(w);
        digests[CAROM_REPLAY_BOYSE] = add_all(FNV_START, search, sizeof search / sizeof *search);
        digests[CAROM_REPLAY_CONTACT] = FNV_START;
        digests[CAROM_REPLAY_IMPACT] = add_all(FNV_START, impact, sizeof impact / sizeof *impact);
        digests[CAROM_REPLAY_REST] = add_all(FNV_START, rest, sizeof rest / sizeof *rest);
    }
    for (uint32_t i = 0; i < w->pools[CAROM_POOL_contacts].used; i++) {
        const struct contact *c = &w->rest.list.contacts[i];

        digests[CAROM_REPLAY_CONTACT] = of_contact(w, c, digests[CAROM_REPLAY_CONTACT]);
        digests[CAROM_REPLAY_REST] =
            add(digests[CAROM_REPLAY_REST], rest_along_q40(contact_impulse(c), &c->normal));
    }
    digests[CAROM_REPLAY_STATE] = carom_world_hash(w);
    return CAROM_OK;
}

const char *carom_replay_part_name(int part)
{
    /* in the order of enum carom_replay_part */
    static const uint8_t stages[CAROM_REPLAY_PARTS] = {CAROM_STAGE_INTERFERE, CAROM_STAGE_BOYSE,
                                                       CAROM_STAGE_CONTACT,   CAROM_STAGE_IMPACT,
                                                       CAROM_STAGE_REST,      CAROM_STAGE_COMMIT};

    return carom_stage_name(part >= 0 && part < CAROM_REPLAY_PARTS ? stages[part] : -1);
}

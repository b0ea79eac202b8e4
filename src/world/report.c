/* SPDX-License-Identifier: MIT */
/* Reports of the last step, and the texts of the public enums. */
#include "world.h"

int carom_version(void)
{
    return CAROM_VERSION;
}

const char *carom_result_text(int result)
{
    static const char *const errors[] = {
        "unknown error",
        "a pointer that must not be NULL is",
        "a value outside its stated range",
        "a number outside what the formats hold",
        "the block of memory is too small or not aligned to 8 bytes",
        "no body of this number",
        "the pool of bodies is full",
        "the pool of pairs is full",
        "the pool of contacts is full",
        "the pool of interfering faces is full",
        "the mesh has no faces or no volume",
        "the mesh has more than 65535 vertices or faces",
        "a face names a vertex that is not there, or one twice",
        "a face has no area",
        "the mesh is open: a solid needs two faces at every edge",
        "an edge has three faces, or two that run the same way",
        "the mesh is inside out",
        "the surface is not single-valued in z",
        "the data is truncated, altered or of another kind",
        "a surface would press a body into a stationary one",
        "a surface that moves needs a world of some entries",
        "the pool of extras has none left for this body",
        "the body would cross another, or be inside it",
        "no joint of this number",
        "the pool of joints is full",
    };
    const int count = (int)(sizeof errors / sizeof errors[0]);

    if (result < 0) {
        return result > -count ? errors[-result] : errors[0];
    }
    if (result > (CAROM_OVER_BUDGET | CAROM_SUBSTEP_CAP)) {
        return "ok, a number or a count";
    }
    switch (result & (CAROM_OVER_BUDGET | CAROM_SUBSTEP_CAP)) {
    case 0:
        return "ok";
    case CAROM_OVER_BUDGET:
        return "ok, over the frame budget";
    case CAROM_SUBSTEP_CAP:
        return "ok, but some island used up its hits and stood still for a part of the frame";
    default:
        return "ok, but over the frame budget, and some island stood still for a part of the frame";
    }
}

const char *carom_stage_name(int stage)
{
    static const char *const names[CAROM_STAGE_COUNT] = {
        "predict", "broad", "interfere", "boyse", "contact", "impact", "rest", "advance", "commit"};

    return stage >= 0 && stage < CAROM_STAGE_COUNT ? names[stage] : "unknown";
}

int carom_events(const struct carom_world *w, const struct carom_event **events)
{
    if (!w || !events) {
        return CAROM_ERR_NULL;
    }
    *events = w->events;
    return (int)w->event_count;
}

int carom_event_hit(const struct carom_world *w, const struct carom_event *event,
                    struct carom_hit *hit)
{
    if (!w || !event || !hit) {
        return CAROM_ERR_NULL;
    }
    if (event->kind != CAROM_EVENT_HIT || event->details == 0 ||
        event->details > w->pools[CAROM_POOL_hits].used) {
        return CAROM_ERR_ARGUMENT;
    }
    *hit = w->hits[event->details - 1];
    return CAROM_OK;
}

int carom_interfering_faces(const struct carom_world *w, const struct carom_face_ref **faces)
{
    if (!w || !faces) {
        return CAROM_ERR_NULL;
    }
    *faces = w->interfere.faces;
    return (int)w->pools[CAROM_POOL_faces].used;
}

int carom_contacts(const struct carom_world *w, struct carom_contact *out, int max)
{
    int n;

    if (!w || (!out && max > 0)) {
        return CAROM_ERR_NULL;
    }
    n = (int)w->pools[CAROM_POOL_contacts].used;
    for (int i = 0; i < n && i < max; i++) {
        const struct contact *c = &w->rest.list.contacts[i];
        const struct pair *p = &w->pairs[c->key.pair];

        memset(&out[i], 0, sizeof out[i]);
        out[i].a = p->a;
        out[i].b = p->b;
        out[i].normal = c->normal;
        out[i].gap_q22 = c->gap_q22;
        out[i].point = contact_point(c);
        out[i].impulse_q40 = rest_along_q40(contact_impulse(c), &c->normal);
    }
    return n;
}

int carom_stats(const struct carom_world *w, struct carom_stats *stats)
{
    if (!w || !stats) {
        return CAROM_ERR_NULL;
    }
    *stats = w->stats;
    return CAROM_OK;
}

int carom_usage(const struct carom_world *w, struct carom_usage usage[CAROM_POOL_COUNT])
{
    static const char *const names[CAROM_POOL_COUNT] = {
#define NAME(name, item, low, high) #name,
        CAROM_POOLS(NAME)
#undef NAME
    };

    if (!w || !usage) {
        return CAROM_ERR_NULL;
    }
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        usage[i].name = names[i];
        usage[i].size = w->pools[i].size;
        usage[i].used = w->pools[i].used;
        usage[i].peak = w->pools[i].peak;
        usage[i].refused = w->pools[i].refused;
    }
    return CAROM_OK;
}

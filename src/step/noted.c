/* SPDX-License-Identifier: MIT */
/* The list of interfering faces. */
#include "parts.h"

static void visit_faces(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    const struct carom_world *w = ((struct step_visitor *)self)->step->w;
    const struct interfere_pairs all = {w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used};

    interfere_note_faces(&((struct step_visitor *)self)->step->w->interfere, &all, c, n);
}

static void place(struct step *s, uint32_t i)
{
    if (step_active(s, i)) {
        body_place(&s->w->bodies[i], &s->next->bodies[i]);
    }
}

int step_note_faces(struct step *s)
{
    struct interfere *in = &s->w->interfere;
    struct step_visitor v;
    int result = CAROM_OK;

    if (in->gathers == 0 && !s->pairs_changed) {
        return CAROM_OK;
    }
    pool_clear(in->face_pool);
    in->error = CAROM_OK;
    for (uint32_t n = 0; n < s->w->pools[CAROM_POOL_pairs].used && result == CAROM_OK; n++) {
        const struct pair *p = &s->w->pairs[n];

        if (!step_is_solid(&s->w->meetings[n]) ||
            (!step_active(s, p->a) && !step_active(s, p->b))) {
            continue;
        }
        if (step_goes_far(s, p)) { /* the part of the path that was gathered has ended */
            place(s, p->a);
            place(s, p->b);
        }
        v.from_q30 = v.to_q30 = CAROM_ONE_Q30;
        v.parts = 1;
        result = step_visit(s, n, &v, visit_faces);
        result = result == CAROM_OK ? in->error : result;
    }
    interfere_finish(in);
    return result;
}

/* SPDX-License-Identifier: MIT */
/* Questions about two bodies of a world between its steps: faces that cross, inside. */
#include "world.h"

/* Check a question about two bodies, and turn them into numbers. Returns CAROM_OK or the error. */
static int check_bodies(const struct carom_world *w, int *a, int *b)
{
    if (!world_find_body(w, a) || !world_find_body(w, b)) {
        return CAROM_ERR_BODY;
    }
    return *a == *b ? (int)CAROM_ERR_ARGUMENT : CAROM_OK;
}

static struct interfere_placed placed(const struct carom_world *w, int body)
{
    return (struct interfere_placed){&w->bodies[body], &world_now(w)->bodies[body]};
}

int carom_query_faces(struct carom_world *w, int a, int b, struct carom_face_pair *out,
                      uint32_t room)
{
    int result;

    if (!w || (!out && room > 0)) {
        return CAROM_ERR_NULL;
    }
    result = check_bodies(w, &a, &b);
    return result < 0 ? result
                      : interfere_query(&w->interfere, placed(w, a), placed(w, b), out,
                                        room < INT32_MAX ? room : INT32_MAX);
}

int carom_query_inside(const struct carom_world *w, int a, int b)
{
    int result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    result = check_bodies(w, &a, &b);
    return result < 0 ? result : interfere_inside(placed(w, a), placed(w, b));
}

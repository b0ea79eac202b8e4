/* SPDX-License-Identifier: MIT */
/*
 * Numbers from a stream of random ones, or from bytes: as many as the range needs, lowest first. Callers draw in an order that
 * C lays down, so an input means the same to every compiler.
 */
#include "chance.h"

int64_t chance_range(struct chance *c, int64_t low, int64_t high)
{
    const uint64_t span = (uint64_t)high - (uint64_t)low;
    uint64_t v = 0;

    if (!c->bytes) {
        return test_random_range(&c->r, low, high);
    }
    for (int shift = 0; shift < 64 && span >> shift > 0 && c->left > 0; shift += 8) {
        v |= (uint64_t)*c->bytes++ << shift;
        c->left--;
    }
    return (int64_t)((uint64_t)low + (span == UINT64_MAX ? v : v % (span + 1)));
}

int chance_pick(struct chance *c, int count)
{
    return (int)chance_range(c, 0, count - 1);
}

int64_t chance_number(struct chance *c, int bits)
{
    static const int64_t extreme[] = {0,         1,        -1, INT64_MAX, INT64_MIN, INT64_MIN + 1,
                                      INT32_MAX, INT32_MIN};
    const int64_t most = (int64_t)1 << bits;
    int64_t v;

    switch (chance_pick(c, 24)) {
    case 0:
        return extreme[chance_pick(c, 8)];
    case 1:
        v = (int64_t)((uint64_t)1 << chance_pick(c, 63));
        return v - chance_pick(c, 3);
    case 2:
        v = -(int64_t)((uint64_t)1 << chance_pick(c, 63));
        return v + chance_pick(c, 3);
    default:
        v = chance_range(c, -most, most);
        return v >> chance_pick(c, bits);
    }
}

bool chance_over(const struct chance *c)
{
    return c->bytes && c->left == 0;
}

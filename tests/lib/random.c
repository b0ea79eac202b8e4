/* SPDX-License-Identifier: MIT */
/* Random numbers for tests, the same on every machine. */
#include "test.h"

uint64_t test_random_next(struct test_random *r)
{
    /* splitmix64 */
    uint64_t z = (r->state += 0x9e3779b97f4a7c15u);

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

int64_t test_random_range(struct test_random *r, int64_t low, int64_t high)
{
    const uint64_t span = (uint64_t)high - (uint64_t)low, v = test_random_next(r);

    return (int64_t)((uint64_t)low + (span == UINT64_MAX ? v : v % (span + 1)));
}

/* SPDX-License-Identifier: MIT */
/*
 * The functions that the compiler calls for arithmetic, by libgcc's names: Debian's libgcc for related processors has instructions that
 * an R3000 lacks.
 */
#include <stdint.h>

uint64_t __udivmoddi4(uint64_t n, uint64_t d, uint64_t *rest); /* bare/divide.c */

uint64_t __udivdi3(uint64_t n, uint64_t d);
uint64_t __umoddi3(uint64_t n, uint64_t d);
int64_t __divdi3(int64_t n, int64_t d);
int64_t __moddi3(int64_t n, int64_t d);
uint64_t __ashldi3(uint64_t a, int by);
uint64_t __lshrdi3(uint64_t a, int by);
int64_t __ashrdi3(int64_t a, int by);
int __clzsi2(uint32_t a);
int __clzdi2(uint64_t a);

static uint64_t size_of(int64_t a)
{
    return a < 0 ? 0 - (uint64_t)a : (uint64_t)a;
}

uint64_t __udivdi3(uint64_t n, uint64_t d)
{
    uint64_t rest;

    return __udivmoddi4(n, d, &rest);
}

uint64_t __umoddi3(uint64_t n, uint64_t d)
{
    uint64_t rest;

    __udivmoddi4(n, d, &rest);
    return rest;
}

int64_t __divdi3(int64_t n, int64_t d)
{
    uint64_t q = __udivdi3(size_of(n), size_of(d));

    return (int64_t)((n < 0) != (d < 0) ? 0 - q : q);
}

/* The rest has the sign of n. */
int64_t __moddi3(int64_t n, int64_t d)
{
    uint64_t rest = __umoddi3(size_of(n), size_of(d));

    return (int64_t)(n < 0 ? 0 - rest : rest);
}

/* Shift by 0 to 63; a word is shifted by 0 to 31. */
uint64_t __ashldi3(uint64_t a, int by)
{
    uint32_t high = (uint32_t)(a >> 32), low = (uint32_t)a;

    if (by >= 32) {
        high = low << (by - 32);
        low = 0;
    } else if (by > 0) {
        high = high << by | low >> (32 - by);
        low <<= by;
    }
    return (uint64_t)high << 32 | low;
}

uint64_t __lshrdi3(uint64_t a, int by)
{
    uint32_t high = (uint32_t)(a >> 32), low = (uint32_t)a;

    if (by >= 32) {
        low = high >> (by - 32);
        high = 0;
    } else if (by > 0) {
        low = low >> by | high << (32 - by);
        high >>= by;
    }
    return (uint64_t)high << 32 | low;
}

/* Shift in the sign: a negative number is complemented, shifted, and complemented again. */
int64_t __ashrdi3(int64_t a, int by)
{
    return a < 0 ? ~(int64_t)__lshrdi3(~(uint64_t)a, by) : (int64_t)__lshrdi3((uint64_t)a, by);
}

int __clzsi2(uint32_t a)
{
    int zeros = 0;

    for (int half = 16; half > 0; half /= 2) {
        if (a >> (32 - half) == 0) {
            zeros += half;
            a <<= half;
        }
    }
    return zeros;
}

int __clzdi2(uint64_t a)
{
    return a >> 32 ? __clzsi2((uint32_t)(a >> 32)) : 32 + __clzsi2((uint32_t)a);
}

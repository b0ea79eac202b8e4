/* SPDX-License-Identifier: MIT */
/*
 * 64-bit quotients for a processor that divides 32 bits by 32 at best (ARMv6-M, MIPS I). libgcc's
 * functions find one bit at a time, or are for later processors.
 */
#include <stdint.h>

uint64_t __udivmoddi4(uint64_t n, uint64_t d, uint64_t *rest);
int64_t __gnu_ldivmod_helper(int64_t n, int64_t d, int64_t *rest);

/* Divide two digits of 16 bits by one. The highest bit of d is set; the rest and n's upper word are below d. */
static uint32_t divide_digit(uint32_t *rest, uint32_t next, uint32_t d)
{
    uint32_t q = *rest / (d >> 16), r = *rest - q * (d >> 16);

    /* d's lower digit was left out, so q is too large by at most two: 2^16 + 1, and the product
     * fits */
    while (q * (d & 0xffff) > (r << 16 | next)) {
        q--;
        r += d >> 16;
        if (r >> 16) {
            break;
        }
    }
    *rest = (*rest << 16 | next) - q * d;
    return q;
}

/* high:low / d, high < d. */
static uint32_t divide_words(uint32_t high, uint32_t low, uint32_t d)
{
    int shift = __builtin_clz(d);
    uint32_t first;

    if (shift > 0) {
        high = high << shift | low >> (32 - shift);
        low <<= shift;
        d <<= shift;
    }
    first = divide_digit(&high, low >> 16, d);
    return first << 16 | divide_digit(&high, low & 0xffff, d);
}

/*
 * Divide by 33 bits or more. Half of n divided by the upper 32 bits of d is right or one too large
 * when it is scaled back. So subtract one, and the remainder shows which.
 */
static uint32_t divide_by_wide(uint64_t n, uint64_t d)
{
    int shift = __builtin_clz((uint32_t)(d >> 32));
    uint32_t q =
        divide_words((uint32_t)(n >> 33), (uint32_t)(n >> 1), (uint32_t)(d << shift >> 32));

    q >>= 31 - shift;
    q -= q > 0;
    return q + (n - q * d >= d);
}

uint64_t __udivmoddi4(uint64_t n, uint64_t d, uint64_t *rest)
{
    uint32_t high = (uint32_t)(n >> 32), low = (uint32_t)n, divisor = (uint32_t)d, first = 0;
    uint64_t q;

    if (d >> 32) {
        q = divide_by_wide(n, d);
    } else if (high == 0) {
        q = low / divisor;
    } else {
        if (high >= divisor) {
            first = high / divisor;
            high -= first * divisor;
        }
        q = (uint64_t)first << 32 | divide_words(high, low, divisor);
    }
    *rest = n - q * d;
    return q;
}

/* The helper of __aeabi_ldivmod. The remainder has the sign of n. */
int64_t __gnu_ldivmod_helper(int64_t n, int64_t d, int64_t *rest)
{
    uint64_t r, size = n < 0 ? 0 - (uint64_t)n : (uint64_t)n;
    uint64_t q = __udivmoddi4(size, d < 0 ? 0 - (uint64_t)d : (uint64_t)d, &r);

    *rest = (int64_t)(n < 0 ? 0 - r : r);
    return (int64_t)((n < 0) != (d < 0) ? 0 - q : q);
}

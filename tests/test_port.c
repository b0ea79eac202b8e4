/* SPDX-License-Identifier: MIT */
/*
 * A board counts: its ticks go on, and the instructions of a loop are exact. A board copies: some
 * boards have their own function for that.
 */
#include <string.h>

#include "port.h"
#include "lib/test.h"

/* Two instructions a round. */
#if defined __arm__
#define ROUND ".syntax unified\n1: subs %0, %0, #1\nbne 1b\n"
#elif defined __riscv
#define ROUND "1: addi %0, %0, -1\nbnez %0, 1b\n"
#endif

#ifdef ROUND
/* Not inlined: the same instructions around the loop every time. */
__attribute__((noinline, noclone)) static uint32_t spent(uint32_t rounds)
{
    uint32_t start = port_ticks();

    __asm__ volatile(ROUND : "+r"(rounds) : : "cc");
    return port_instructions(port_ticks() - start);
}
#endif

static void instructions(void)
{
#ifdef ROUND
    static const uint32_t rounds[] = {2, 3, 4, 5, 7, 10, 100, 1001, 65537, 1000000};
    const uint32_t one = spent(1);

    for (uint32_t i = 0; port_instructions(port_ticks_hz) && i < sizeof rounds / sizeof rounds[0];
         i++) {
        CHECK_EQ(spent(rounds[i]) - one, 2 * (rounds[i] - 1));
    }
#endif
    CHECK_EQ(port_instructions(0), 0);
}

static void ticks(void)
{
    uint32_t start = port_ticks(), last = 0, now;

    /* a stopped counter would hang the test, so the loop has an end */
    for (uint32_t i = 0; last < 1000 && i < 1000000; i++) {
        now = port_ticks() - start;
        CHECK_AT_LEAST(now, last);
        last = now;
    }
    CHECK_AT_LEAST(last, 1000);
}

/*
 * Every size, and both ends at every place within a word: the bytes are copied, and nothing beside
 * them.
 */
static void copies(void)
{
    enum { MOST = 21, ROOM = MOST + 8 };

    for (uint32_t i = 0; i < 16 * MOST; i++) {
        volatile size_t from = i % 4, to = i / 4 % 4, size = i / 16;
        _Alignas(4) uint8_t source[ROOM], target[ROOM];
        bool right = true;

        for (uint32_t k = 0; k < ROOM; k++) {
            source[k] = (uint8_t)(k + 1);
            target[k] = (uint8_t)(k + 101);
        }
        CHECK_SAME(memcpy(target + to, source + from, size), target + to);
        for (uint32_t k = 0; k < ROOM; k++) {
            bool inside = k >= to && k < to + size;

            right = right && target[k] == (inside ? source[k - to + from] : (uint8_t)(k + 101));
        }
        CHECK(right);
    }
}

const struct test tests_port[] = {
    {"port/instructions", instructions}, {"port/ticks", ticks}, {"port/copies", copies}, {0}};

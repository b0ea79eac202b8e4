/* SPDX-License-Identifier: MIT */
/*
 * Caches need a table of pages that tells which memory they hold. This table has sections of 1 MB,
 * in the format of ARMv6 (ARM1176JZF-S Technical Reference Manual, chapter 6).
 */
#include "memory.h"

#include <stdint.h>

#define SECTION_BITS  20
#define SECTIONS      4096
#define SECTION       0x00c02u /* read and write for all */
#define CACHED        0x0100cu /* written back, and a line is fetched for a write */
#define GATHERED      0x01000u /* not cached, but writes are gathered */
#define DEVICE        0x00004u
#define EXECUTE_NEVER 0x00010u

/* The Zero's memory and the peripherals behind it. */
#define MEMORY_SECTIONS  512
#define PERIPHERALS_FROM 0x200
#define PERIPHERALS_TO   0x210

/* Bits of the control register. */
#define MMU_ON      (1u << 0)
#define DATA_ON     (1u << 2)
#define BRANCHES_ON (1u << 11)
#define CODE_ON     (1u << 12)
#define FORMAT_V6   (1u << 23)

static _Alignas(4 * SECTIONS) uint32_t table[SECTIONS];

void memory_barrier(void)
{
    __asm__ volatile("mcr p15, 0, %0, c7, c10, 4" : : "r"(0) : "memory");
}

static void map(uint32_t from, uint32_t to, uint32_t kind)
{
    for (uint32_t i = from; i < to; i++) {
        table[i] = i << SECTION_BITS | kind | SECTION;
    }
}

void memory_start(const void *framebuffer, size_t bytes)
{
    uint32_t first = (uint32_t)(uintptr_t)framebuffer >> SECTION_BITS, control;
    uint32_t last = ((uint32_t)(uintptr_t)framebuffer + bytes - 1) >> SECTION_BITS;

    map(0, MEMORY_SECTIONS, CACHED);
    map(first, last + 1, GATHERED | EXECUTE_NEVER);
    map(PERIPHERALS_FROM, PERIPHERALS_TO, DEVICE | EXECUTE_NEVER);
    memory_barrier();
    __asm__ volatile("mcr p15, 0, %1, c7, c7, 0\n" /* both caches are empty */
                     "mcr p15, 0, %1, c8, c7, 0\n" /* and the cached entries of the table */
                     "mcr p15, 0, %2, c2, c0, 0\n"
                     "mcr p15, 0, %1, c2, c0, 2\n"  /* which is the only table */
                     "mcr p15, 0, %3, c3, c0, 0\n"  /* domain 0 obeys its permissions */
                     "mcr p15, 0, %1, c7, c10, 4\n" /* wait until that is done */
                     "mrc p15, 0, %0, c1, c0, 0\n"
                     "orr %0, %0, %4\n"
                     "mcr p15, 0, %0, c1, c0, 0\n"
                     "mcr p15, 0, %1, c7, c5, 4\n" /* refetch instructions */
                     : "=&r"(control)
                     : "r"(0), "r"(table), "r"(1),
                       "r"(MMU_ON | DATA_ON | BRANCHES_ON | CODE_ON | FORMAT_V6)
                     : "memory");
}

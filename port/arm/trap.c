/* SPDX-License-Identifier: MIT */
/* The semihosting trap of an ARM: a breakpoint on a Cortex-M, a supervisor call on the others. */
#include "semihost.h"

intptr_t semihost_call(intptr_t operation, const void *block)
{
    register intptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = block;

#if __ARM_ARCH_PROFILE == 'M'
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
#else
    __asm__ volatile("svc 0x123456" : "+r"(r0) : "r"(r1) : "memory", "lr");
#endif
    return r0;
}

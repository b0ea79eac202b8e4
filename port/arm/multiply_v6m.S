/* SPDX-License-Identifier: MIT */
/*
 * The 64-bit product for a processor whose product of 32 x 32 bits has 32 bits (ARMv6-M,
 * Cortex-M0). The engine's arithmetic there spends nearly all of its time in it: 24 instructions
 * and no memory; libgcc takes 41.
 *
 * (r1:r0) * (r3:r2), modulo 2^64, to r1:r0. For the lower words a = a1:a0 and b = b1:b0, in halves,
 *
 *   a b = 2^32 a1 b1 + 2^16 (a0 b1 + a1 b0) + a0 b0
 *
 * and the upper words count only in the upper word of the product.
 */
    .syntax unified
    .cpu cortex-m0
    .section .text.__aeabi_lmul, "ax", %progbits
    .thumb
    .balign 4
    .global __aeabi_lmul, __muldi3
    .type __aeabi_lmul, %function
    .type __muldi3, %function
    .thumb_func
__aeabi_lmul:
    .thumb_func
__muldi3:
    muls r1, r2
    muls r3, r0
    adds r1, r3
    mov ip, r1      /* the part of the upper words: no other register is free */
    lsrs r3, r0, #16
    lsrs r1, r2, #16
    muls r1, r3     /* a1 b1 */
    add ip, r1
    lsrs r1, r2, #16
    uxth r0, r0
    uxth r2, r2
    muls r1, r0     /* a0 b1 */
    muls r3, r2     /* a1 b0 */
    muls r2, r0     /* a0 b0 */
    adds r3, r1     /* the middle; movs keeps its carry */
    movs r1, #0
    adcs r1, r1
    lsls r1, #16
    lsls r0, r3, #16
    lsrs r3, #16
    adds r0, r2
    adcs r1, r3
    add r1, ip
    bx lr
    .size __aeabi_lmul, . - __aeabi_lmul

    .section .note.GNU-stack, "", %progbits

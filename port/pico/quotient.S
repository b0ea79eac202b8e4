/* SPDX-License-Identifier: MIT */
/*
 * Quotients of 32 bits by the RP2040's divider, which takes 8 cycles (datasheet, section 2.3.1.5);
 * libgcc's functions take a hundred. Nothing interrupts them, so the divider's registers need not
 * be saved.
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .equ SIO_TOP, 0xd0
    .equ UNSIGNED_DIVIDEND, 0x60
    .equ UNSIGNED_DIVISOR, 0x64
    .equ SIGNED_DIVIDEND, 0x68
    .equ SIGNED_DIVISOR, 0x6c
    .equ QUOTIENT, 0x70
    .equ REMAINDER, 0x74

/* r0 / r1 to r0, the remainder to r1. A branch to the next instruction takes two cycles. */
    .macro divide name, also, dividend, divisor
    .section .text.\name, "ax", %progbits
    .balign 4
    .global \name, \also
    .type \name, %function
    .type \also, %function
    .thumb_func
\name:
    .thumb_func
\also:
    movs r2, #SIO_TOP
    lsls r2, #24
    str r0, [r2, #\dividend]
    str r1, [r2, #\divisor]
    b 1f
1:  b 1f
1:  b 1f
1:  b 1f
1:  ldr r1, [r2, #REMAINDER]
    ldr r0, [r2, #QUOTIENT]
    bx lr
    .size \name, . - \name
    .endm

    divide __aeabi_uidiv, __aeabi_uidivmod, UNSIGNED_DIVIDEND, UNSIGNED_DIVISOR
    divide __aeabi_idiv, __aeabi_idivmod, SIGNED_DIVIDEND, SIGNED_DIVISOR

    .section .note.GNU-stack, "", %progbits

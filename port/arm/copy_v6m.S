/* SPDX-License-Identifier: MIT */
/*
 * memcpy for a processor that cannot read words at odd addresses (ARMv6-M): by words where both addresses allow it. The small C
 * library copies byte by byte.
 */
    .syntax unified
    .cpu cortex-m0
    .section .text.memcpy, "ax", %progbits
    .thumb
    .balign 4
    .global memcpy, __aeabi_memcpy, __aeabi_memcpy4, __aeabi_memcpy8
    .type memcpy, %function
    .thumb_func
memcpy:
    .thumb_func
__aeabi_memcpy:
    .thumb_func
__aeabi_memcpy4:
    .thumb_func
__aeabi_memcpy8:
    mov ip, r0      /* the result */
    movs r3, r0
    orrs r3, r1
    lsls r3, #30
    bne 3f
    subs r2, #4
    blo 2f
1:  ldmia r1!, {r3}
    stmia r0!, {r3}
    subs r2, #4
    bhs 1b
2:  adds r2, #4
3:  subs r2, #1     /* the rest, or everything, from the end */
    blo 5f
4:  ldrb r3, [r1, r2]
    strb r3, [r0, r2]
    subs r2, #1
    bhs 4b
5:  mov r0, ip
    bx lr
    .size memcpy, . - memcpy

    .section .note.GNU-stack, "", %progbits

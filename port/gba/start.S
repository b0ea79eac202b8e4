/* SPDX-License-Identifier: MIT */
/*
 * The head of a Game Boy Advance cartridge, and the way from it to start().
 *
 * The logo is left empty, because we may not distribute it. Emulators start without it; a console
 * needs it and the check sum after it, and cartridge tools fill in both (gbafix).
 */
    .section .vectors, "ax"
    .arm
    .global reset
reset:
    b go
    .space 156                /* the logo */
    .ascii "CAROM\0\0\0\0\0\0\0" /* title */
    .ascii "CRME"             /* game code */
    .ascii "00"               /* maker */
    .byte 0x96, 0, 0          /* fixed value, unit, device */
    .space 7
    .byte 0                   /* version */
    .byte 0                   /* check sum, by a cartridge tool */
    .space 2

/* Interrupts are never enabled. The processor starts in system mode, and uses no other stack. */
    .section .text, "ax"
go:
    mov r0, #0x1f
    msr cpsr_c, r0
    ldr sp, =stack_top
    ldr r0, =gba_start
    bx r0
    .pool

    .section .note.GNU-stack, "", %progbits

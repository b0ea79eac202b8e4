/* SPDX-License-Identifier: MIT */
/*
 * The vectors of a classic ARM (ARM9 and its relatives), at address 0: every exception is a fault.
 */
    .section .vectors, "ax"
    .arm
    b reset
    b exception /* undefined instruction */
    b exception /* supervisor call: the emulator has taken the semihosting calls before */
    b exception /* prefetch abort */
    b exception /* data abort */
    b exception /* reserved */
    b exception /* interrupt */
    b exception /* fast interrupt */

    .global reset
reset:
    ldr sp, =stack_top
    b start

/* Each mode has its own stack pointer; the program is lost, so its stack may be used again. */
exception:
    ldr sp, =stack_top
    mov r0, lr
    b fault

    .section .note.GNU-stack, "", %progbits

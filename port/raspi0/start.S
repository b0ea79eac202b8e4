/* SPDX-License-Identifier: MIT */
/*
 * From the loader to start(), and the vectors. The program runs in system mode, whose stack pointer and return address no exception
 * touches.
 */
    .section .vectors, "ax"
    .arm
    .balign 32
    .global reset
reset:
vectors:
    b go
    b exception /* undefined instruction */
    b no_host   /* supervisor call: semihosting takes its own before it comes here */
    b exception /* prefetch abort */
    b exception /* data abort */
    b exception /* reserved */
    b exception /* interrupt */
    b exception /* fast interrupt */

go:
    msr cpsr_c, #0xdf /* system mode, no interrupts */
    ldr sp, =stack_top
    ldr r0, =vectors
    mcr p15, 0, r0, c12, c0, 0 /* the vectors are here, not at address 0 */
    b start

/*
 * On a board without an emulator nobody answers a semihosting call: it succeeds and does nothing.
 */
no_host:
    mov r0, #0
    movs pc, lr

/* Each mode has its own stack pointer; the program is lost, so its stack may be used again. */
exception:
    ldr sp, =stack_top
    mov r0, lr
    b fault
    .pool

    .section .note.GNU-stack, "", %progbits

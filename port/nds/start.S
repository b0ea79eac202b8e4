/* SPDX-License-Identifier: MIT */
/*
 * From the loader to start() on a Nintendo DS's ARM946E-S: caches, the two RAMs of the processor
 * (ITCM for code, DTCM for the stack) and its vectors. It does not rely on any state that the
 * loader left.
 */
    .section .vectors, "ax"
    .arm
    .global reset
reset:
    b go
    .space 60                 /* the room for arguments comes next (bare/arguments.c), at 64 */

    .section .text, "ax"
/* The code at address 0, where the ITCM is: every exception is a fault. */
vectors:
    .rept 8
    ldr pc, handler
    .endr
handler:
    .word exception
vectors_end:

/* Each mode has its own stack pointer; the program is lost, so its stack may be used again. */
exception:
    ldr sp, =stack_top
    mov r0, lr
    b fault

go:
    mov r0, #0x04000000
    str r0, [r0, #0x208]      /* interrupt master: bit 0 is off */
    mov r0, #0xdf             /* system mode, no interrupts */
    msr cpsr_c, r0

    /* write back what the data cache still holds of the image: 32 lines of each of 4 sets */
    mov r1, #0
1:  mov r2, #0
2:  orr r3, r1, r2
    mcr p15, 0, r3, c7, c14, 2
    add r2, r2, #32
    cmp r2, #1024
    bne 2b
    adds r1, r1, #0x40000000
    bne 1b
    mcr p15, 0, r1, c7, c10, 4 /* wait until it has been written */

    /* caches, protection and the RAMs off; then forget what the caches hold */
    mrc p15, 0, r0, c1, c0, 0
    ldr r2, =0x51005          /* ITCM, DTCM, instruction cache, data cache, protection */
    bic r0, r0, r2
    mcr p15, 0, r0, c1, c0, 0
    mcr p15, 0, r1, c7, c5, 0
    mcr p15, 0, r1, c7, c6, 0

    /* region 0 is everything, uncached; region 1 the 4 MB of main memory, cached and written back */
    mov r0, #0x3f
    mcr p15, 0, r0, c6, c0, 0
    ldr r0, =0x0200002b
    mcr p15, 0, r0, c6, c1, 0
    .irp region, c2, c3, c4, c5, c6, c7
    mcr p15, 0, r1, c6, \region, 0 /* the others are not in use */
    .endr
    mov r0, #2
    mcr p15, 0, r0, c2, c0, 0 /* data of region 1 */
    mcr p15, 0, r0, c2, c0, 1 /* instructions */
    mcr p15, 0, r0, c3, c0, 0 /* write buffer */
    mov r0, #0x33             /* both may be read and written */
    mcr p15, 0, r0, c5, c0, 2
    mcr p15, 0, r0, c5, c0, 3

    /* DTCM: 16 KB over the stack; ITCM: 32 KB from 0 on, repeated up to main memory */
    ldr r0, =stack_bottom
    orr r0, r0, #0x0a
    mcr p15, 0, r0, c9, c1, 0
    mov r0, #0x20
    mcr p15, 0, r0, c9, c1, 1

    mrc p15, 0, r0, c1, c0, 0
    orr r0, r0, r2
    ldr r2, =0xa000           /* low vectors; a load into the pc changes to Thumb */
    bic r0, r0, r2
    mcr p15, 0, r0, c1, c0, 0

    /* vectors, then the code that runs from the ITCM */
    ldr r0, =vectors
    ldr r1, =vectors_end
    mov r2, #0
3:  ldr r3, [r0], #4
    str r3, [r2], #4
    cmp r0, r1
    blo 3b
    ldr r0, =fast_load
    ldr r1, =fast_start
    ldr r2, =fast_end
4:  cmp r1, r2
    ldrlo r3, [r0], #4
    strlo r3, [r1], #4
    blo 4b

    ldr sp, =stack_top
    b start
    .pool

    .section .note.GNU-stack, "", %progbits

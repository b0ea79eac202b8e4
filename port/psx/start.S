/* SPDX-License-Identifier: MIT */
/*
 * From the loader to start(). The loader leaves the BIOS's interrupts on. They are turned off: no
 * program here waits for an interrupt, and interrupts would count as cycles.
 */
    .section .vectors, "ax"
    .set noreorder
    .global reset
reset:
    mtc0 $0, $12
    lui $sp, %hi(stack_top)
    j start
    addiu $sp, $sp, %lo(stack_top)

    .section .note.GNU-stack, "", %progbits

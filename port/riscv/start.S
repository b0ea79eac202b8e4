/* SPDX-License-Identifier: MIT */
/* From reset to start() on a RISC-V without an operating system: machine mode, one processor. */
    .section .vectors, "ax"
    .global reset
reset:
    .option push
    .option norelax /* the linker's short addresses are relative to gp */
    la gp, __global_pointer$
    .option pop
    la sp, stack_top
    la tp, bss_start /* data of the only thread come first */
    la t0, exception
    csrw mtvec, t0
    j start

/* No program here uses interrupts: every trap is a fault. The stack may be used again. */
    .balign 4
exception:
    la sp, stack_top
    csrr a0, mepc
    j fault

/*
 * The semihosting trap: a breakpoint between two shifts that have no other effect. It must lie in one page and not be compressed.
 * Arguments and result are where C has them.
 */
    .option push
    .option norvc
    .balign 16
    .global semihost_call
semihost_call:
    slli zero, zero, 0x1f
    ebreak
    srai zero, zero, 7
    ret
    .option pop

    .section .note.GNU-stack, "", %progbits

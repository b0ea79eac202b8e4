/* SPDX-License-Identifier: MIT */
/*
 * The first 256 bytes of the flash. The RP2040's boot ROM copies them into RAM and runs them if the
 * last four are the check sum of the others (tools/uf2.py checks that). They set up the
 * memory-mapped reading of the flash, which the ROM leaves off, and start the program that follows.
 *
 * Any serial flash knows the command 03h: read, at an address of 24 bits. The datasheet's section
 * 4.10 describes the interface.
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .equ SSI, 0x18000000
    .equ CTRLR0, 0x00
    .equ CTRLR1, 0x04
    .equ SSIENR, 0x08
    .equ BAUDR, 0x14
    .equ SPI_CTRLR0, 0xf4
    .equ VTOR, 0xe000ed08
    .equ VECTORS, 0x10000100

    .section .vectors, "ax", %progbits
loader:
    ldr r0, =SSI
    movs r1, #0
    str r1, [r0, #SSIENR]   /* off, while it changes */
    movs r1, #4
    str r1, [r0, #BAUDR]    /* a quarter of the system's clock: 31 MHz at 125; flashes take 50 */
    ldr r1, =0x001f0300     /* one data line, words of 32 bits; after a command as many bits come back */
    str r1, [r0, #CTRLR0]
    movs r1, #0
    str r1, [r0, #CTRLR1]   /* one word a command */
    ldr r1, =0x03000218     /* the command 03h, of 8 bits, and 24 bits of address */
    movs r2, #SPI_CTRLR0
    str r1, [r0, r2]
    movs r1, #1
    str r1, [r0, #SSIENR]
    ldr r0, =VTOR
    ldr r1, =VECTORS
    str r1, [r0]
    ldmia r1!, {r2, r3}     /* the stack, and the entry point */
    msr msp, r2
    bx r3
    .balign 4
    .pool
    .org 252
    .word 0x983e81ee /* the check sum; tools/uf2.py prints the right one */

    .section .note.GNU-stack, "", %progbits

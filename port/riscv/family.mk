# SPDX-License-Identifier: MIT
# Shared by the RISC-V boards: picolibc, semihosting, the processor's own count of instructions.
CROSS := riscv64-unknown-elf-
NEED := riscv picolibc qemu-riscv
PORT += port/newlib/syscalls.c port/bare/semihost.c port/bare/start.c port/riscv/start.S port/riscv/counter.c
FAMILY_CFLAGS := --specs=picolibc.specs
FAMILY_LDFLAGS := --specs=picolibc.specs

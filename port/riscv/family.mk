# SPDX-License-Identifier: MIT
# RISC-V boards without an operating system, which emulation gives semihosting; picolibc is their C library.
CROSS := riscv64-unknown-elf-
NEED := riscv picolibc qemu-riscv
FAMILY_PORT := port/riscv/start.S port/riscv/counter.c port/newlib/syscalls.c
FAMILY_CFLAGS := --specs=picolibc.specs
FAMILY_LDFLAGS := --specs=picolibc.specs

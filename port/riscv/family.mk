# SPDX-License-Identifier: MIT
# RISC-V boards without an operating system, which emulation gives semihosting; picolibc is their C library.
CROSS := riscv64-unknown-elf-
FAMILY_PORT := port/riscv/start.S port/riscv/counter.c
FAMILY_CFLAGS := --specs=picolibc.specs
FAMILY_LDFLAGS := --specs=picolibc.specs

# SPDX-License-Identifier: MIT
# QEMU's virt with a 32-bit RISC-V that multiplies, at a nominal 100 MHz, and a display on its PCI bus.
FAMILY := riscv
ARCH := -march=rv32im -mabi=ilp32 -misa-spec=2.2
PORT := port/riscv32/virt.c
QEMU := qemu-system-riscv32 -M virt -bios none -device bochs-display,romfile=
ICOUNT_SHIFT := 0
PICTURES := 1
CPU := RV32IM
CLOCK_MHZ := 100
DISPLAY := bochs-display
SCENES := head:15

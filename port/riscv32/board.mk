# SPDX-License-Identifier: MIT
# QEMU's virt with a 32-bit RISC-V that multiplies, at a nominal 100 MHz, and a display on its PCI bus.
FAMILY := riscv
ARCH := -march=rv32im -mabi=ilp32 -misa-spec=2.2
PORT := port/riscv32/virt.c
QEMU := qemu-system-riscv32 -M virt -bios none -device bochs-display,romfile=
ICOUNT_SHIFT := 0
# Half of a frame at 15 frames a second, the other half being the program's own.
BUDGET := 3330000
PICTURES := 1

# SPDX-License-Identifier: MIT
# QEMU's virt with a 32-bit RISC-V that multiplies, and a display on its PCI bus.
FAMILY := riscv
ARCH := -march=rv32im -mabi=ilp32 -misa-spec=2.2
PORT := port/riscv32/virt.c
QEMU := qemu-system-riscv32 -M virt -bios none -device bochs-display,romfile=
ICOUNT_SHIFT := 0
# While a picture is taken, there is no timer to which the emulator could skip.
ICOUNT_SLEEP := on
PICTURES := 1
CPU := RV32IM
CLOCK_MHZ := 100
DISPLAY := bochs-display
SCENES := head:17 head450:37 head836:33 sheet:25 pile:3 box:60 car walker:35 door:22 crusher:2 conveyor:12 gears:3 screw:2 newton:7 dominoes:1 cards arch:1 bowl:5 pour espresso:33 espresso-fine:25

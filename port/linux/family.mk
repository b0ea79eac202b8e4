# SPDX-License-Identifier: MIT
# Other processors' Linux programs under QEMU's user mode, with the instructions that they execute counted.
HOSTED := 1
PORT += port/linux/console.c port/linux/counter.c
FAMILY_LDFLAGS := -static
RUNNER := build/tools/count.so

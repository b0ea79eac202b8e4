# SPDX-License-Identifier: MIT
# Linux programs of other processors under QEMU's user mode, which counts their instructions.
HOSTED := 1
PORT += port/linux/console.c port/linux/counter.c
FAMILY_LDFLAGS := -static
RUNNER := build/tools/count.so

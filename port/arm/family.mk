# SPDX-License-Identifier: MIT
# Shared by the Arm boards: newlib's nano, semihosting, QEMU's instruction count.
CROSS := arm-none-eabi-
NEED := arm newlib qemu-arm
PORT += port/newlib/syscalls.c port/bare/semihost.c port/bare/start.c port/arm/trap.c port/arm/icount.c
FAMILY_LDFLAGS := --specs=nano.specs

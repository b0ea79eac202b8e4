# SPDX-License-Identifier: MIT
# What the Arm boards share: newlib's nano, semihosting, QEMU's instruction count.
CROSS := arm-none-eabi-
NEED := arm newlib qemu-arm
PORT += port/newlib/syscalls.c port/arm/semihost.c port/arm/start.c port/arm/icount.c
FAMILY_LDFLAGS := --specs=nano.specs

# SPDX-License-Identifier: MIT
CROSS := arm-none-eabi-
FAMILY_PORT := port/arm/trap.c port/arm/icount.c port/newlib/syscalls.c
FAMILY_LDFLAGS := --specs=nano.specs

/* SPDX-License-Identifier: MIT */
/* count.h - the memory that tools/count.c, which counts, shares with port/linux/counter.c, which reads. */
#ifndef CAROM_PORT_LINUX_COUNT_H
#define CAROM_PORT_LINUX_COUNT_H

#define COUNT_FILE  100 /* a file descriptor that emulator and program share */
#define COUNT_BYTES 4096

#endif

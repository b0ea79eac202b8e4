/* SPDX-License-Identifier: MIT */
/* count.h - where tools/count.c, which counts, and port/linux/counter.c, which reads, meet. */
#ifndef CAROM_PORT_LINUX_COUNT_H
#define CAROM_PORT_LINUX_COUNT_H

#define COUNT_FILE  100 /* a file descriptor, which emulator and program share */
#define COUNT_BYTES 4096

#endif

/* SPDX-License-Identifier: MIT */
/* A failed assertion of a debug build of the engine (CAROM_DEBUG): print it and leave. */
#include "port.h"

_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

_Noreturn void carom_assert_failed(const char *text, const char *file, int line)
{
    port_print("%s:%d: assertion failed: %s\n", file, line, text);
    port_exit(126);
}

/* SPDX-License-Identifier: MIT */
/* expect - Carom's results in tools: an error ends the program. */
#ifndef CAROM_TOOLS_EXPECT_HPP
#define CAROM_TOOLS_EXPECT_HPP

#include <cstdio>
#include <cstdlib>

#include "carom.h"

/* Returns the result. For an error, prints the library and the error, and exits with 1. */
inline int expect(int result, const char *whose = "carom")
{
    if (result < 0) {
        std::fprintf(stderr, "%s: %s\n", whose, carom_result_text(result));
        std::exit(1);
    }
    return result;
}

#endif

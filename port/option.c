/* SPDX-License-Identifier: MIT */
/* Arguments of the form name=value, for every board. */
#include <string.h>

#include "port.h"

const char *port_option(const char *name)
{
    size_t length = strlen(name);
    const char *argument;

    for (int n = 1; (argument = port_arg(n)) != NULL; n++) {
        if (strncmp(argument, name, length) == 0 && argument[length] == '=') {
            return argument + length + 1;
        }
    }
    return NULL;
}

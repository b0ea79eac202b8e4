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

uint32_t port_number(const char *name, uint32_t otherwise)
{
    const char *digits = port_option(name);
    uint32_t number = 0;

    if (!digits) {
        return otherwise;
    }
    while (*digits >= '0' && *digits <= '9') {
        number = 10 * number + (uint32_t)(*digits++ - '0');
    }
    return number;
}

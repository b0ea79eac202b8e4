/* SPDX-License-Identifier: MIT */
/*
 * Arguments of a program without a shell: a runner writes them into the image, behind the vectors,
 * each ended by a space. A program that is only switched on has none.
 */
#include "port.h"

#define ROOM          256
#define ARGUMENTS_MAX 12

__attribute__((section(".vectors"), used)) static const volatile char room[ROOM] = {0};

/* Cut the line at its spaces, in a copy, because the image is read-only. */
const char *port_arg(int n)
{
    static char line[ROOM];
    static const char *argument[ARGUMENTS_MAX];
    static int count = -1;

    if (count < 0) {
        char before = ' ';

        count = 0;
        for (size_t i = 0; i < ROOM - 1 && room[i]; i++) {
            if (room[i] != ' ') {
                line[i] = room[i];
                if (before == ' ' && count < ARGUMENTS_MAX) {
                    argument[count++] = &line[i];
                }
            }
            before = room[i];
        }
    }
    return n >= 0 && n < count ? argument[n] : NULL;
}

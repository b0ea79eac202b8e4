/* SPDX-License-Identifier: MIT */
/* A program of a bare board that asks for memory in vain: status 0 when there is no byte of heap. */
#include <stddef.h>
#include <stdlib.h>

#ifdef __PICOLIBC__
#define _sbrk sbrk
#endif
void *_sbrk(ptrdiff_t bytes);

int main(void)
{
    void *volatile got = malloc(1);

    return got != NULL || _sbrk(1) != (void *)-1 || _sbrk(4096) != (void *)-1;
}

/* SPDX-License-Identifier: MIT */
/*
 * bare_heap - a program of a bare board that asks for memory. The board has no byte of heap, so it
 * must fail: status 0 then.
 */
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

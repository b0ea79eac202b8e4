/* SPDX-License-Identifier: MIT */
/* examples/hello.c, which also prints the hash of its world: taken after each step, where the program reads its body. */
#include "carom.h"

static uint64_t hash;

static int get(const struct carom_world *world, int body, struct carom_body_state *state)
{
    hash = carom_world_hash(world);
    return carom_body_get(world, body, state);
}

#define main           hello
#define carom_body_get get
#include "../examples/hello.c"
#undef main

int main(void)
{
    const int status = hello();

    printf("hash %016llx\n", (unsigned long long)hash);
    return status;
}

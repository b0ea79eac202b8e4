/* SPDX-License-Identifier: MIT */
/* The list of inputs that once failed. */
#include "inputs.h"

#include <stddef.h>

const struct input inputs[] = {
    {"ask", "carom_cast_mesh: a turn of INT32_MIN",
     "d0020100d0cececececececece0700000000007a00000e007a71252500710671252d7171d301cece0800cece0000"
     "000000ffffffffffffffff71257161ceff0100"},
    {"calls", "carom_cast_mesh: a way of 2^62 units",
     "00000000fcfcb20e0e0e41603d000000000000000001006040000b1a7690905b98aa3d30a60e60f060f02d00a00f"
     "60f00dac60f0a00f4a00a00fa00f00800e"},
    {"snapshot", "a kept impulse above 2^40 units left the friction cone",
     "baad08d1ab21fbfbfbfbfbfbfbfbfbfbfbfb72eb6e29010000000000000100000000000001000000010000af00c"
     "a"},
    {"snapshot", "a jointed body out of range set out with its group's slice",
     "d207f39cfcfcfcfcfcfcfcfc2e2326fcfcfcfcfcfcfcfcfc21fc811032238fc32019af2393beb9db40bf2dca47"
     "9515cb9480ca479555cb948003502c1e"},
    {NULL, NULL, NULL}, /* the end */
};

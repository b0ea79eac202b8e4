/* SPDX-License-Identifier: MIT */
/* For Arduino, which looks for headers here: the public one. */
#include "../include/carom_shapes.h"

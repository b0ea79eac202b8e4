/* SPDX-License-Identifier: MIT */
/* Capacities come from Kconfig, here its defaults. */
#include "carom_zephyr.h"

static const struct carom_caps caps = CAROM_CAPS(CAROM_ZEPHYR_CAPS);
extern const struct carom_caps *const app_caps;
const struct carom_caps *const app_caps = &caps;
char app_world[CAROM_WORLD_BYTES(CAROM_ZEPHYR_CAPS)];

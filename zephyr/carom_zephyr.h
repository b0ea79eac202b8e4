/* SPDX-License-Identifier: MIT */
/* The capacities that Kconfig has: CAROM_WORLD_BYTES(CAROM_ZEPHYR_CAPS), CAROM_CAPS(CAROM_ZEPHYR_CAPS). */
#ifndef CAROM_ZEPHYR_H
#define CAROM_ZEPHYR_H

#include "carom.h"

#define CAROM_ZEPHYR_CAPS                                                                          \
    CONFIG_CAROM_BODIES, CONFIG_CAROM_PAIRS, CONFIG_CAROM_CONTACTS, CONFIG_CAROM_FACES,            \
        CONFIG_CAROM_ENTRIES, CONFIG_CAROM_CANDIDATES, CONFIG_CAROM_JOINTS, CONFIG_CAROM_EXTRAS,   \
        CONFIG_CAROM_HITS

#endif

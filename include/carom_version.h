/* SPDX-License-Identifier: MIT */
/**
 * @file
 * The version of Carom. Only this file states it; builds and packages read it from here.
 */
#ifndef CAROM_VERSION_H
#define CAROM_VERSION_H

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup version Version
 * Versions are semantic (semver.org).
 *
 * MAJOR changes when a program has to change. MINOR changes when something is added, or results change. PATCH changes
 * when a fault is mended. While MAJOR is 0, MINOR may do what MAJOR does. CHANGELOG.md says what changed.
 * @{
 */

/** Changes when a program has to change. */
#define CAROM_VERSION_MAJOR 0
/** Changes when something is added, or results change. */
#define CAROM_VERSION_MINOR 9
/** Changes when a fault is mended. */
#define CAROM_VERSION_PATCH 0

/** The version as text: "0.9.0". */
#define CAROM_VERSION_TEXT                                                                         \
    CAROM_QUOTE_(CAROM_VERSION_MAJOR)                                                              \
    "." CAROM_QUOTE_(CAROM_VERSION_MINOR) "." CAROM_QUOTE_(CAROM_VERSION_PATCH)
/** The version as a number to compare by: 10000 MAJOR + 100 MINOR + PATCH. */
#define CAROM_VERSION                                                                              \
    (CAROM_VERSION_MAJOR * 10000 + CAROM_VERSION_MINOR * 100 + CAROM_VERSION_PATCH)
#define CAROM_QUOTE_(number)  CAROM_QUOTED_(number)
#define CAROM_QUOTED_(number) #number

/**
 * Returns the #CAROM_VERSION that the library was compiled with.
 *
 * A program that sees another number was compiled with headers of another version. It should stop: sizes of blocks
 * may differ.
 */
int carom_version(void);

/** @} */

#ifdef __cplusplus
}
#endif

#endif

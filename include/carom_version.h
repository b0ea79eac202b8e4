/* SPDX-License-Identifier: MIT */
/*
 * carom_version.h - the version of Carom: the only place that says it. Builds and packages read it from here.
 *
 * Versions are semantic (semver.org). MAJOR changes when a program has to; MINOR when something is added, or results
 * change; PATCH when a fault is mended. While MAJOR is 0, MINOR may do what MAJOR does. CHANGELOG.md says which it was.
 */
#ifndef CAROM_VERSION_H
#define CAROM_VERSION_H

#ifdef __cplusplus
extern "C" {
#endif

#define CAROM_VERSION_MAJOR 0
#define CAROM_VERSION_MINOR 9
#define CAROM_VERSION_PATCH 0

/* "0.9.0"; and one number to compare by: 10000 MAJOR + 100 MINOR + PATCH. */
#define CAROM_VERSION_TEXT                                                                         \
    CAROM_QUOTE_(CAROM_VERSION_MAJOR)                                                              \
    "." CAROM_QUOTE_(CAROM_VERSION_MINOR) "." CAROM_QUOTE_(CAROM_VERSION_PATCH)
#define CAROM_VERSION                                                                              \
    (CAROM_VERSION_MAJOR * 10000 + CAROM_VERSION_MINOR * 100 + CAROM_VERSION_PATCH)
#define CAROM_QUOTE_(number)  CAROM_QUOTED_(number)
#define CAROM_QUOTED_(number) #number

/*
 * The CAROM_VERSION that the library was compiled with. A program that has another one was compiled with headers of
 * another version, and had better stop: sizes of blocks may differ.
 */
int carom_version(void);

#ifdef __cplusplus
}
#endif

#endif

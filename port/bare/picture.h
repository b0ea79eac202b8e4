/* SPDX-License-Identifier: MIT */
/* picture.h - pictures of a board without a display that QEMU models, as files on the host. */
#ifndef CAROM_PORT_BARE_PICTURE_H
#define CAROM_PORT_BARE_PICTURE_H

#include "port.h"

#define PICTURE_WIDTH_MAX 512

/*
 * With the option pictures=DIRECTORY, write a framebuffer (PORT_RGB565 or PORT_XRGB8888) by
 * semihosting as DIRECTORY/frame-0001.ppm and so on, one number a call. Without the option, do
 * nothing.
 */
void picture_write(const struct port_fb *fb);

#endif

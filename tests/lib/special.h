/* SPDX-License-Identifier: MIT */
/*
 * special - two convex bodies that meet in a special position: their features lie exactly over each
 * other, or are off by a unit of the last place, or by up to 1/1000 of a unit. Host only.
 *
 * A number determines a case. The lower body has a feature that looks up: a peak, a ridge or the
 * flat top of a frustum; the upper body has one that looks down. They meet at a known place and
 * time; the bodies begin some frames earlier.
 */
#ifndef CAROM_TESTS_SPECIAL_H
#define CAROM_TESTS_SPECIAL_H

#include "crossing.h"

enum special_class {
    SPECIAL_PEAK_PEAK,
    SPECIAL_PEAK_RIDGE,
    SPECIAL_PEAK_FACE,
    SPECIAL_PEAK_BORDER,  /* over an edge or a corner of a flat top */
    SPECIAL_RIDGE_ACROSS, /* a ridge over another at any angle */
    SPECIAL_RIDGE_ALONG,  /* parallel, up to a yaw of 0.2 degrees */
    SPECIAL_RIDGE_END,    /* the same, and only the ends meet */
    SPECIAL_RIDGE_BORDER, /* a ridge along an edge of a flat top */
    SPECIAL_FACE_FACE,    /* flat tops, their edges over each other */
    SPECIAL_CLASSES
};
extern const char *const special_names[SPECIAL_CLASSES];

#define SPECIAL_VERTICES 10
#define SPECIAL_FACES    16

struct special_shape {
    int16_t vertices[SPECIAL_VERTICES][3];
    uint16_t faces[SPECIAL_FACES][3];
    struct carom_mesh_raw raw;
    struct carom_mesh mesh;
    double top[3]; /* the feature's place, units of the mesh; it looks along z */
    _Alignas(8) uint8_t block[CAROM_MESH_BYTES(SPECIAL_VERTICES, SPECIAL_FACES)];
};

struct special {
    long number;
    enum special_class class;
    struct special_shape shape[2]; /* lower, upper */
    struct carom_body_def def[2];  /* the same */
    bool upper_first;              /* the upper one is body 0 */
    carom_v3_q40 gravity;
    double up[3], skin;
    /* the random choices, for a report */
    double size[2], slope[2][2], offset, yaw, speed, slant, spin, time, weight;
};

/* Pose a body's hull, relative to the first place of body 0. */
void special_place(struct crossing_hull *hull, const struct special *s, int which,
                   const carom_v3_q32 *position, const carom_quat_q30 *rotation);

/* Make case `number`, always the same; ends the program when a mesh does not build. */
void special_make(struct special *s, long number);

#endif

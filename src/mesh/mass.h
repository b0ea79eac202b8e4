/* SPDX-License-Identifier: MIT */
/*
 * mass - volume, centre of mass and inertia of a closed mesh, by the divergence theorem over its
 * faces, in integers: sums are exact in 128 bits and rounded once.
 */
#ifndef CAROM_SRC_MASS_H
#define CAROM_SRC_MASS_H

#include "carom.h"
#include "../num/fix.h"

/*
 * Mass properties of a closed, outward-oriented mesh.
 *
 *   raw   in   the mesh, already checked
 *   out   volume in cubic units, centre of mass, and inertia divided by mass (square units) about
 *         the centre of mass in the mesh's axes
 *
 * Error    1e-8 of the largest entry
 * Returns  CAROM_OK; CAROM_ERR_MESH_EMPTY when the volume is zero; CAROM_ERR_MESH_INSIDE_OUT when it is
 *          negative, or no solid has this centre or these moments, since a part is inside out;
 *          CAROM_ERR_RANGE when the mesh winds around its inside more than once. Unless CAROM_OK,
 *          nothing is written.
 */
int mass_of_mesh(const struct carom_mesh_raw *raw, struct carom_mass *out);

/*
 * Inverse of a symmetric positive matrix with a shared exponent, as a sum of two matrices.
 *   in    xx, yy, zz, xy, yz, zx times 2^-e, each within 2^30
 *   out   the inverse, to 30 bits
 *   rest  its remainder, to 2^-59 of the largest entry: across the axis of a thin body 30 bits for
 *         all entries leave hardly any
 * Returns 0, or -1 if the matrix is singular.
 */
int mass_invert(const struct carom_sym3 *in, struct carom_sym3 *out, struct carom_sym3 *rest);

/*
 * H with H H^T = in^-1, for a matrix that has an inverse.
 *   out  its columns; not reach_bits
 * Error  2^-27 of a column, whatever the others are: minors are exact, so nothing cancels
 */
void mass_spread(const struct carom_sym3 *in, struct carom_spread *out);

#endif

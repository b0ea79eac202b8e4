/* SPDX-License-Identifier: MIT */
/*
 * Sides of edges: no operation overflows, the axis is that of the largest component, and a point left of all edges is over the triangle.
 *
 * bound: coordinates below 2^29, so that edges are below 2^30; normals above INT32_MIN; for plane_outside all factors below 2^30
 * mutant: src/num/plane.h: x > y ? (x > z ? 0 : 2) -> x > y ? (x > z ? 0 : 1)
 */
#include "proof.h"
#include "num/plane.h"

static void any(int32_t *out, int count, int64_t limit)
{
    for (int k = 0; k < count; k++) {
        out[k] = (int32_t)proof_range(-limit, limit);
    }
}

void proof(void)
{
    int32_t a[3], b[3], c[3], p[3], n[3], edge[2], off[2], reach[2];
    int side[3], over;

    any(a, 3, (1 << 29) - 1);
    any(b, 3, (1 << 29) - 1);
    any(c, 3, (1 << 29) - 1);
    any(p, 3, (1 << 29) - 1);
    any(n, 3, INT32_MAX);
    any(edge, 2, (1 << 30) - 1);
    any(off, 2, (1 << 30) - 1);
    reach[0] = (int32_t)proof_range(0, (1 << 30) - 1);
    reach[1] = (int32_t)proof_range(0, (1 << 30) - 1);
    proof_check(fix_abs32(n[plane_axis(n)]) == fix_largest(n));
    side[0] = plane_side(a, b, p);
    side[1] = plane_side(b, c, p);
    side[2] = plane_side(c, a, p);
    over = plane_over(a, b, c, p);
    proof_check(over == (side[0] == side[1] && side[1] == side[2] ? side[0] : 0) && side[0] >= -1 &&
                side[0] <= 1);
    proof_check(!(plane_outside(edge, off, reach, true) && plane_outside(edge, off, reach, false)));
}

/* SPDX-License-Identifier: MIT */
/* Volume, centre of mass and inertia of a mesh; the inverse of its inertia and a root of that. */
#include "mass.h"

/* A matrix whose smallest eigenvalue is below 2^-24 of the largest counts as singular. */
#define SINGULAR_BITS 24
/*
 * Rounding may take this much from a second moment, in units of the inertia's mantissas. A ratio is right to two
 * units: a moment is off by three and a half, and the two other entries of its row by two each.
 */
#define ROUNDED 8

/*
 * Each face spans a tetrahedron with the origin. With det = a . (b x c) and s = a + b + c its
 * signed volume is det / 6, its first moment det / 24 s, and its second moments det / 120 (s_i s_j
 * + a_i a_j + b_i b_j + c_i c_j). Over a closed mesh the parts outside cancel, whatever the origin.
 * The sums are taken twice: about the origin of the vertices for volume and centre, then about the
 * centre for second moments, so that nothing large is subtracted.
 */

/* Corners about a chosen origin. */
struct tetrahedron {
    int32_t p[3][3];
};

/* Vertices times 2^bits, about an origin of the same format. */
struct frame {
    const struct carom_mesh_raw *raw;
    int32_t origin[3];
    int bits;
};

static void load(struct tetrahedron *t, const struct frame *f, uint32_t face)
{
    for (int i = 0; i < 3; i++) {
        const int16_t *v = f->raw->vertices[f->raw->faces[face][i]];

        for (int k = 0; k < 3; k++) {
            t->p[i][k] = v[k] * (1 << f->bits) - f->origin[k];
            CAROM_ASSERT(carom_abs(t->p[i][k]) <= 1 << 20);
        }
    }
}

/* a . (b x c). Range: coordinates up to 2^20, so each product of b and c is <= 2^40, each component
 * of the cross product <= 2^41 and the result <= 3 * 2^61. */
static int64_t determinant(const struct tetrahedron *t)
{
    int64_t across[3];

    fix_cross(across, t->p[1], t->p[2]);
    return t->p[0][0] * across[0] + t->p[0][1] * across[1] + t->p[0][2] * across[2];
}

/* Sums over the faces, without their divisors. */
struct sums {
    struct fix_wide det, moment[3], second[6];
};

/*
 * Bounds: for vertices in quanta, <= 2^15, det < 3 * 2^46; about the centre coordinates are < 2^20
 * and det < 3 * 2^61. A sum of corners is below 2^22, a sum of products < 12 * 2^40; so sums over
 * 65535 faces, two of them together, are < 2^124.
 */
static void sum_faces(const struct frame *about, struct sums *out)
{
    memset(out, 0, sizeof *out);
    for (uint32_t f = 0; f < about->raw->face_count; f++) {
        struct tetrahedron t;
        int64_t det;
        int32_t s[3];

        load(&t, about, f);
        det = determinant(&t);
        fix_wide_add_product(&out->det, det, 1);
        for (int k = 0; k < 3; k++) {
            s[k] = t.p[0][k] + t.p[1][k] + t.p[2][k];
            fix_wide_add_product(&out->moment[k], det, s[k]);
        }
        for (int n = 0; n < 6; n++) {
            int i = n % 3, j = n < 3 ? i : fix_next(i);
            int64_t sum = (int64_t)s[i] * s[j];

            for (int c = 0; c < 3; c++) {
                sum += (int64_t)t.p[c][i] * t.p[c][j];
            }
            fix_wide_add_product(&out->second[n], det, sum);
        }
    }
}

/*
 * n / d to the nearest whole number; n becomes the remainder. A ratio has 30 bits and the quotient
 * up to 35, so the remainder of the first ratio is divided again.
 */
static int64_t wide_quotient(struct fix_wide *n, int64_t d)
{
    int64_t q = fix_mul_scaled(1, fix_wide_over(n, d));

    fix_wide_add_product(n, -q, d);
    return q + fix_mul_scaled(1, fix_wide_over(n, d));
}

/*
 * Six times the volume in cubic quanta, and the centre of mass with `bits` fractional bits, at most
 * 19.
 *
 * A mesh that does not overlap itself has 6 volume <= 6 * 2^48 < 2^51: more means that it winds
 * around its inside more than once.
 */
static int volume_and_centre(const struct carom_mesh_raw *raw, int bits, int64_t *volume6,
                             int64_t centre[3])
{
    const struct frame quanta = {raw, {0, 0, 0}, 0};
    struct sums sums;

    sum_faces(&quanta, &sums);
    if (fix_wide_sign(&sums.det) <= 0) {
        return fix_wide_sign(&sums.det) < 0 ? CAROM_ERR_MESH_INSIDE_OUT : CAROM_ERR_MESH_EMPTY;
    }
    if (fix_wide_bits(&sums.det) > 51) {
        return CAROM_ERR_RANGE;
    }
    *volume6 = fix_wide_shift(&sums.det, 0);
    for (int k = 0; k < 3; k++) {
        /* moments of quanta are below 2^84 */
        fix_wide_shift_up(&sums.moment[k], bits);
        centre[k] = wide_quotient(&sums.moment[k], 4 * *volume6);
    }
    return CAROM_OK;
}

static void find_box(const struct carom_mesh_raw *raw, int32_t low[3], int32_t high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INT16_MAX;
        high[k] = INT16_MIN;
    }
    for (uint32_t f = 0; f < raw->face_count; f++) {
        for (int i = 0; i < 3; i++) {
            const int16_t *v = raw->vertices[raw->faces[f][i]];

            for (int k = 0; k < 3; k++) {
                low[k] = v[k] < low[k] ? v[k] : low[k];
                high[k] = v[k] > high[k] ? v[k] : high[k];
            }
        }
    }
}

/*
 * Twenty times the volume's det, and the entries xx, yy, zz, xy, yz, zx of the inertia in the same
 * scale: inertia / mass = inertia20 / det20.
 */
static void second_moments(const struct frame *about, struct fix_wide *det20,
                           struct fix_wide inertia20[6])
{
    struct sums sums;

    sum_faces(about, &sums);
    memset(inertia20, 0, 6 * sizeof *inertia20);
    fix_wide_shift_up(&sums.det, 2);
    *det20 = sums.det;
    fix_wide_shift_up(&sums.det, 2);
    fix_wide_add(det20, &sums.det);
    for (int i = 0; i < 3; i++) {
        fix_wide_add(&inertia20[i], &sums.second[fix_next(i)]);
        fix_wide_add(&inertia20[i], &sums.second[fix_next(fix_next(i))]);
        fix_wide_subtract(&inertia20[3 + i], &sums.second[3 + i]);
    }
}

/* Bring six ratios to the exponent of the largest. */
static void share_exponent(struct carom_sym3 *out, const struct fix_scaled ratio[6])
{
    out->e = ratio[0].e; /* the diagonal is positive */
    for (int n = 1; n < 6; n++) {
        if (ratio[n].m != 0 && ratio[n].e < out->e) {
            out->e = ratio[n].e;
        }
    }
    for (int n = 0; n < 6; n++) {
        int shift = ratio[n].e - out->e;

        out->m[n] =
            ratio[n].m == 0 || shift > 31 ? 0 : (int32_t)fix_round_shift(ratio[n].m, -shift);
    }
}

/* volume6 / 6 cubic quanta in q32 cubic units. Bounds: volume6 < 2^51, shifted by 11 at most. */
static int64_t volume_q32(int64_t volume6, int quantum_bits)
{
    int up = 32 - 3 * quantum_bits;
    int64_t n = up > 0 ? carom_shl(volume6, up) : volume6;
    int64_t d = up > 0 ? 6 : carom_shl(6, -up);

    return (n + d / 2) / d;
}

/* The cofactors and the determinant of a symmetric matrix, exact: entries of 2^30 give below 2^61 and 2^93. */
struct adjugate {
    int64_t cofactor[6];
    struct fix_wide det;
};

static void find_adjugate(struct adjugate *out, const int32_t m[6])
{
    static const uint8_t row[6] = {0, 1, 2, 0, 1, 2}, col[6] = {0, 1, 2, 1, 2, 0};

    out->det = (struct fix_wide){0, 0};
    for (int n = 0; n < 6; n++) {
        const uint8_t *a = fix_sym3_at[(row[n] + 1) % 3], *b = fix_sym3_at[(row[n] + 2) % 3];
        int i = (col[n] + 1) % 3, j = (col[n] + 2) % 3;

        out->cofactor[n] = (int64_t)m[a[i]] * m[b[j]] - (int64_t)m[a[j]] * m[b[i]];
    }
    for (int k = 0; k < 3; k++) {
        fix_wide_add_product(&out->det, m[fix_sym3_at[0][k]], out->cofactor[fix_sym3_at[0][k]]);
    }
}

/* True if a matrix whose first entry is positive is positive in all directions. */
static bool is_positive(const struct adjugate *a)
{
    return fix_wide_sign(&a->det) > 0 && a->cofactor[0] > 0 && a->cofactor[1] > 0 &&
           a->cofactor[2] > 0;
}

/*
 * True if a solid may have an inertia I: its second moments, tr I / 2 - I, are positive in all directions. A mesh with
 * a part that is inside out may have a moment I1 above I2 + I3, and its spin would have no path (SPEC.md, 5.1).
 */
static bool is_of_solid(const int32_t inertia[6])
{
    const int64_t half = ((int64_t)inertia[0] + inertia[1] + inertia[2]) / 2 + ROUNDED;
    int32_t second[6];
    struct adjugate a;

    for (int n = 0; n < 6; n++) {
        second[n] = n < 3 ? (int32_t)(half - inertia[n]) : -inertia[n];
    }
    find_adjugate(&a, second);
    return second[0] > 0 && is_positive(&a);
}

int mass_of_mesh(const struct carom_mesh_raw *raw, struct carom_mass *out)
{
    struct frame about = {raw, {0, 0, 0}, 0};
    struct carom_mass mass;
    struct fix_wide det20, inertia20[6];
    struct fix_scaled ratio[6];
    int32_t low[3], high[3], extent = 1;
    int64_t volume6, centre[3];
    int to_q22 = 22 - raw->quantum_bits; /* fractional bits of a quantum in q22 */
    int bits, error;

    find_box(raw, low, high);
    for (int k = 0; k < 3; k++) {
        extent = high[k] - low[k] > extent ? high[k] - low[k] : extent;
    }
    /* the finest format that keeps coordinates about the centre below 2^20 */
    about.bits = 20 - fix_bits((uint64_t)extent);
    bits = about.bits > to_q22 ? about.bits : to_q22;
    error = volume_and_centre(raw, bits, &volume6, centre);
    if (error) {
        return error;
    }
    for (int k = 0; k < 3; k++) {
        if (centre[k] < carom_shl(low[k], bits) || centre[k] > carom_shl(high[k], bits)) {
            return CAROM_ERR_MESH_INSIDE_OUT; /* some part of it is inside out */
        }
        mass.centre.c[k] = (int32_t)fix_round_shift(centre[k], to_q22 - bits);
        about.origin[k] = (int32_t)fix_round_shift(centre[k], about.bits - bits);
    }
    second_moments(&about, &det20, inertia20);
    for (int n = 0; n < 6; n++) {
        if (n < 3 && fix_wide_sign(&inertia20[n]) <= 0) {
            return CAROM_ERR_MESH_INSIDE_OUT;
        }
        ratio[n] = fix_wide_ratio(&inertia20[n], &det20);
    }
    share_exponent(&mass.inertia, ratio);
    if (!is_of_solid(mass.inertia.m)) {
        return CAROM_ERR_MESH_INSIDE_OUT;
    }
    mass.inertia.e += 2 * (raw->quantum_bits + about.bits);
    mass.volume_q32 = volume_q32(volume6, raw->quantum_bits);
    *out = mass;
    return CAROM_OK;
}

/* The inverse is the adjugate over the determinant; both are exact, so thin bodies lose nothing to cancellation. */
int mass_invert(const struct carom_sym3 *in, struct carom_sym3 *out, struct carom_sym3 *rest)
{
    struct adjugate a;
    struct fix_scaled ratio[6];
    uint64_t all = 0, size = 0;

    find_adjugate(&a, in->m);
    for (int n = 0; n < 6; n++) {
        all |= (uint64_t)carom_abs(a.cofactor[n]);
        size |= (uint64_t)carom_abs(in->m[n]);
    }
    if (!is_positive(&a) ||
        fix_wide_bits(&a.det) < fix_bits(all) + fix_bits(size) - SINGULAR_BITS) {
        return -1;
    }
    for (int n = 0; n < 6; n++) {
        const struct fix_wide wide = fix_wide_mul(a.cofactor[n], 1);

        ratio[n] = fix_wide_ratio(&wide, &a.det);
    }
    share_exponent(out, ratio);
    for (int n = 0; n < 6; n++) {
        /* cofactor 2^e - m det, at most 1.5 det: 2^e is below 2^62, m times an entry below 2^60 */
        struct fix_wide left = fix_wide_mul(a.cofactor[n], (int64_t)1 << out->e);

        for (int k = 0; k < 3; k++) {
            int64_t part = -(int64_t)out->m[n] * in->m[fix_sym3_at[0][k]];

            fix_wide_add_product(&left, part, a.cofactor[fix_sym3_at[0][k]]);
        }
        rest->m[n] = (int32_t)fix_mul_scaled((int64_t)1 << 29, fix_wide_ratio(&left, &a.det));
    }
    out->e -= in->e;
    rest->e = out->e + 29;
    return 0;
}

/* v / sqrt(x y 2^-e) as 30 bits and an exponent; x and y above 0. */
static void root_column(int32_t out[3], int8_t *out_e, const int64_t v[3], struct fix_scaled x,
                        struct fix_scaled y, int e)
{
    int bits = fix_bits3(v), both = x.e + y.e + e + 2, odd = both & 1;
    uint32_t root = fix_sqrt((uint64_t)((int64_t)x.m * y.m) << (2 + odd)); /* at least 2^30 */

    for (int k = 0; k < 3; k++) {
        out[k] = (int32_t)(fix_round_shift(v[k], 30 - bits) * CAROM_ONE_Q30 / root);
    }
    *out_e = (int8_t)(60 - bits - (both + odd) / 2);
}

/*
 * With a = xx, b = yy, d = xy and so on the columns are (1, 0, 0) / sqrt(a), (-d, a, 0) / sqrt(a (a b - d d)),
 * and the third column of the adjugate over sqrt((a b - d d) det).
 */
void mass_spread(const struct carom_sym3 *in, struct carom_spread *out)
{
    const int32_t *m = in->m, rows[2][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}};
    const int64_t first[3] = {1, 0, 0}, second[3] = {-m[3], m[0], 0}, last[3] = {m[5], m[4], m[2]};
    const struct fix_scaled one = fix_scale(1, 0), corner = fix_scale(m[0], 0);
    struct fix_scaled minor;
    struct fix_wide det = {0, 0};
    int64_t third[3];

    fix_cross(third, rows[0], rows[1]);
    minor = fix_scale(third[2], 0);
    fix_wide_add_dot(&det, last, third);
    root_column(out->column[0], &out->e[0], first, corner, one, in->e);
    root_column(out->column[1], &out->e[1], second, corner, minor, in->e);
    root_column(out->column[2], &out->e[2], third, minor, fix_wide_over(&det, 1), in->e);
}

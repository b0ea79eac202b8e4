/* SPDX-License-Identifier: MIT */
/* The places of a joint's anchors and axes, and their errors by row. */
#include "joint.h"

extern inline bool joint_holds(const struct joint_list *list, uint32_t i);

bool joint_has_coordinate(uint8_t kind)
{
    return kind == CAROM_JOINT_HINGE || kind == CAROM_JOINT_SLIDER || kind == CAROM_JOINT_DISTANCE;
}

int64_t joint_product_q40(int64_t a_q40, int64_t b_q40)
{
    const int64_t most = (int64_t)1 << 60;
    struct fix_wide product = fix_wide_mul(a_q40, b_q40);

    if (fix_wide_bits(&product) > 100) {
        return fix_wide_sign(&product) < 0 ? -most : most;
    }
    return fix_wide_shift(&product, 40);
}

bool joint_is_driven(const struct joint *j, const struct joint_state *s)
{
    return joint_has_coordinate(j->kind) && (s->drive.limited || s->drive.motor || s->drive.spring);
}

/* ---------------------------------------------------------------- places, axes */

/* An anchor in world axes, q40. */
static void anchor_q40(const struct joint *j, int side, const struct joint_pose *pose,
                       int64_t out[3])
{
    carom_m3_q30 r;

    fix_matrix(&r, &pose->rotation);
    fix_rotate(out, &r, j->arm[side].c);
    for (int k = 0; k < 3; k++) {
        out[k] += carom_shl(pose->position.c[k], 8);
    }
}

carom_v3_q32 joint_anchor(const struct joint *j, int side, const struct joint_pose *pose)
{
    carom_v3_q32 at;

    anchor_q40(j, side, pose, at.c);
    for (int k = 0; k < 3; k++) {
        at.c[k] = carom_round(at.c[k], 8);
    }
    return at;
}

/* The joint's axes on a side; of length 1 within some units of the last place. */
static carom_quat_q30 axes_of(const struct joint *j, int side, const struct joint_pose *pose)
{
    const int32_t *p = pose->rotation.c, *q = j->frame[side].c;
    carom_quat_q30 out;

    for (int k = 0; k < 3; k++) {
        int m = fix_next(k), n = fix_next(m);

        /* four products of numbers up to 1.001: below 2^63 */
        out.c[1 + k] =
            (int32_t)carom_round((int64_t)p[0] * q[1 + k] + (int64_t)p[1 + k] * q[0] +
                                     (int64_t)p[1 + m] * q[1 + n] - (int64_t)p[1 + n] * q[1 + m],
                                 30);
    }
    out.c[0] = (int32_t)carom_round((int64_t)p[0] * q[0] - carom_dot(p + 1, q + 1), 30);
    return out;
}

carom_v3_q30 joint_axis(const struct joint *j, const struct joint_pose *pose_b)
{
    carom_quat_q30 axes = axes_of(j, 1, pose_b);
    carom_m3_q30 m;

    fix_matrix(&m, &axes);
    return (carom_v3_q30){{m.c[0][2], m.c[1][2], m.c[2][2]}};
}

#define ANGLE_PI_Q40 3454217652358

/* The angle of (x, y) from x on, q40, x >= 0: turned to y = 0 by arcs whose tangents are powers of two. */
static int64_t angle_q40(int64_t x, int64_t y)
{
    static const int64_t arc_q40[] = {863554413089, 509785937287,
                                      269356888665, 136729762476,
                                      68630207382,  34348560106,
                                      17178471287,  8589759836,
                                      4294945451,   2147480917,
                                      1073741483,   536870869,
                                      268435451,    134217727,
                                      67108864,     33554432,
                                      16777216,     8388608,
                                      4194304,      2097152,
                                      1048576,      524288,
                                      262144,       131072,
                                      65536,        32768,
                                      16384,        8192,
                                      4096,         2048,
                                      1024,         512,
                                      256,          128,
                                      64,           32,
                                      16,           8};
    int64_t angle = 0;

    x = carom_shl(x, 20);
    y = carom_shl(y, 20);
    for (int k = 0; k < (int)(sizeof arc_q40 / sizeof arc_q40[0]); k++) {
        int64_t dx = y >> k, dy = x >> k;

        if (y > 0) {
            x += dx;
            y -= dy;
            angle += arc_q40[k];
        } else {
            x -= dx;
            y += dy;
            angle -= arc_q40[k];
        }
    }
    return angle;
}

/* By how much a is turned about the axis: twice the angle of the rotation's part about it. */
static int64_t twist_q40(const carom_quat_q30 *q)
{
    bool back = q->c[0] < 0;

    return 2 *
           (back ? angle_q40(-(int64_t)q->c[0], -(int64_t)q->c[3]) : angle_q40(q->c[0], q->c[3]));
}

int64_t joint_turned_q40(int64_t from_q40, int64_t to_q40)
{
    int64_t turned = to_q40 - from_q40;

    return turned > ANGLE_PI_Q40    ? turned - 2 * ANGLE_PI_Q40
           : turned < -ANGLE_PI_Q40 ? turned + 2 * ANGLE_PI_Q40
                                    : turned;
}

/* ----------------------------------------------------------------------- errors */

/* Column `at` of a matrix: a direction of its axes. */
static void column(const carom_m3_q30 *m, int at, int32_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = m->c[k][at];
    }
}

static int64_t along(const int64_t v[3], const carom_m3_q30 *axes, int at)
{
    int32_t d[3];

    column(axes, at, d);
    return fix_dot_q30(v, d);
}

/* Set the errors of the angular rows: small rotations of a's axes against b's. */
static void measure_turn(const struct joint *j, const carom_quat_q30 *a, const carom_quat_q30 *b,
                         const carom_m3_q30 *axes, struct joint_error *out)
{
    if (j->kind == CAROM_JOINT_HINGE) {
        carom_m3_q30 own;
        int32_t z[3], x[3], y[3];

        fix_matrix(&own, a);
        column(&own, 2, z);
        column(axes, 0, x);
        column(axes, 1, y);
        out->row_q40[3] = -carom_round(carom_dot(z, y), 20);
        out->row_q40[4] = carom_round(carom_dot(z, x), 20);
    } else {
        carom_quat_q30 q;
        int first = j->kind == CAROM_JOINT_SLIDER ? 2 : 3;

        fix_turn_between(&q, b, a);
        for (int k = 0; k < 3; k++) {
            out->row_q40[first + k] = carom_shl(q.c[0] < 0 ? -q.c[1 + k] : q.c[1 + k], 11);
        }
    }
}

void joint_measure(const struct joint *j, const struct joint_pose pose[2], struct joint_error *out)
{
    carom_quat_q30 a = axes_of(j, 0, &pose[0]), b = axes_of(j, 1, &pose[1]);
    carom_m3_q30 axes;
    int64_t at[2][3], apart[3];

    memset(out, 0, sizeof *out);
    fix_matrix(&axes, &b);
    for (int s = 0; s < 2; s++) {
        anchor_q40(j, s, &pose[s], at[s]);
    }
    for (int k = 0; k < 3; k++) {
        apart[k] = at[0][k] - at[1][k];
    }
    if (j->kind == CAROM_JOINT_DISTANCE) {
        out->coordinate_q40 = fix_length(apart);
        return;
    }
    if (j->kind == CAROM_JOINT_SLIDER) {
        out->row_q40[0] = along(apart, &axes, 0);
        out->row_q40[1] = along(apart, &axes, 1);
        out->coordinate_q40 = along(apart, &axes, 2);
    } else {
        memcpy(out->row_q40, apart, sizeof apart);
    }
    if (j->kind != CAROM_JOINT_BALL) {
        measure_turn(j, &a, &b, &axes, out);
    }
    if (j->kind == CAROM_JOINT_HINGE) {
        carom_quat_q30 q;

        fix_turn_between(&q, &b, &a);
        out->coordinate_q40 = twist_q40(&q);
    }
}

/* ------------------------------------------------------------------------- rows */

static void set_arm(struct joint_lever *lever, const int64_t arm_q40[3])
{
    int up = 30 - fix_bits3(arm_q40);

    up = up < 12 ? up : 12; /* an arm below 2^-22 may be rounded */
    lever->arm_bits = 40 + up;
    for (int k = 0; k < 3; k++) {
        lever->arm[k] = (int32_t)fix_round_shift(arm_q40[k], up);
    }
}

static void set_points(struct joint *j, const struct joint_pose pose[2], int64_t apart[3])
{
    int64_t at[2][3], arm[3];

    anchor_q40(j, 0, &pose[0], at[0]);
    anchor_q40(j, 1, &pose[1], at[1]);
    for (int k = 0; k < 3; k++) {
        apart[k] = at[0][k] - at[1][k];
    }
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < 3; k++) {
            int64_t point = j->kind == CAROM_JOINT_DISTANCE ? at[s][k]
                            : j->kind == CAROM_JOINT_SLIDER ? at[0][k]
                                                            : at[1][k] + apart[k] / 2;

            arm[k] = point - carom_shl(pose[s].position.c[k], 8);
        }
        set_arm(&j->work.lever[s], arm);
    }
}

static void add_axis(struct joint_work *work, const carom_m3_q30 *axes, int at, bool angular)
{
    column(axes, at, work->direction[work->rows]);
    work->angular = (uint8_t)(work->angular | (angular ? 1 << work->rows : 0));
    work->rows++;
}

void joint_set_rows(struct joint *j, const struct joint_state *s, const struct joint_pose pose[2])
{
    struct joint_work *work = &j->work;
    carom_quat_q30 b = axes_of(j, 1, &pose[1]);
    carom_m3_q30 axes,
        world = {{{CAROM_ONE_Q30, 0, 0}, {0, CAROM_ONE_Q30, 0}, {0, 0, CAROM_ONE_Q30}}};
    int64_t apart[3];
    bool driven = joint_is_driven(j, s);

    fix_matrix(&axes, &b);
    set_points(j, pose, apart);
    work->rows = 0;
    work->angular = 0;
    for (int k = 0; k < 3 && j->kind != CAROM_JOINT_SLIDER && j->kind != CAROM_JOINT_DISTANCE;
         k++) {
        add_axis(work, &world, k, false);
    }
    switch (j->kind) {
    case CAROM_JOINT_HINGE:
        add_axis(work, &axes, 0, true);
        add_axis(work, &axes, 1, true);
        break;
    case CAROM_JOINT_SLIDER:
        add_axis(work, &axes, 0, false);
        add_axis(work, &axes, 1, false);
        /* fall through */
    case CAROM_JOINT_FIXED:
        for (int k = 0; k < 3; k++) {
            add_axis(work, &axes, k, true);
        }
        break;
    default:
        break;
    }
    work->held = work->rows;
    if (driven) {
        add_axis(work, &axes, 2, j->kind == CAROM_JOINT_HINGE);
        if (j->kind == CAROM_JOINT_DISTANCE) {
            carom_v3_q30 n = {{0, 0, CAROM_ONE_Q30}};

            (void)fix_normalise(&n, apart);
            memcpy(work->direction[0], n.c, sizeof n.c);
        }
    }
}

/* SPDX-License-Identifier: MIT */
/* Errors of joints of random worlds, in double precision, from the poses of their bodies alone. */
#include <math.h>
#include <string.h>

#include "real.h"
#include "soak.h"

/* A joint in the world, from the present poses of its bodies. */
struct place {
    double at[2][3], axis[2][3];
    double
        turned[4]; /* rotation of a against b since the joint was added, in b's axes at that time */
};

static int body_of(const struct soak_joint *joint, int side)
{
    return side == 0 ? joint->def.a : joint->def.b;
}

/* Position and rotation of a body; the world is at the origin. */
static void pose_of(const struct crowd *crowd, int body, double at[3], double q[4])
{
    struct carom_body_state s;

    memset(at, 0, 3 * sizeof *at);
    memset(q, 0, 4 * sizeof *q);
    q[0] = 1;
    if (body == CAROM_WORLD) {
        return;
    }
    s = lab_state(crowd->world, body);
    lab_quaternion(q, &s.rotation);
    for (int k = 0; k < 3; k++) {
        at[k] = real(s.position.c[k], 32);
    }
}

/* p^-1 q of unit quaternions. */
static void since(double out[4], const double p[4], const double q[4])
{
    double across[3];

    real_cross(across, p + 1, q + 1);
    out[0] = p[0] * q[0] + real_dot(p + 1, q + 1);
    for (int k = 0; k < 3; k++) {
        out[k + 1] = p[0] * q[k + 1] - q[0] * p[k + 1] - across[k];
    }
}

/* q p^-1: a rotation in the world from one pose to another. */
static void between(double out[4], const double p[4], const double q[4])
{
    double across[3];

    real_cross(across, p + 1, q + 1);
    out[0] = p[0] * q[0] + real_dot(p + 1, q + 1);
    for (int k = 0; k < 3; k++) {
        out[k + 1] = p[0] * q[k + 1] - q[0] * p[k + 1] + across[k];
    }
}

void soak_joint_note(const struct crowd *crowd, struct soak_joint *joint)
{
    for (int side = 0; side < 2; side++) {
        const carom_v3_q32 *anchor = side == 1 && joint->def.kind == CAROM_JOINT_DISTANCE
                                         ? &joint->def.anchor_b
                                         : &joint->def.anchor;
        double at[3], away[3], axis[3], m[3][3];

        pose_of(crowd, body_of(joint, side), at, joint->turn[side]);
        real_matrix(m, joint->turn[side]);
        for (int k = 0; k < 3; k++) {
            away[k] = real(anchor->c[k], 32) - at[k];
            axis[k] = real(joint->def.axis.c[k], 30);
        }
        real_rotate_back(joint->arm[side], m, away);
        real_rotate_back(joint->axis[side], m, axis);
    }
}

static void find(const struct crowd *crowd, const struct soak_joint *joint, struct place *p)
{
    double by[2][4];

    for (int side = 0; side < 2; side++) {
        double at[3], q[4], m[3][3];

        pose_of(crowd, body_of(joint, side), at, q);
        real_matrix(m, q);
        real_rotate(p->at[side], m, joint->arm[side]);
        real_rotate(p->axis[side], m, joint->axis[side]);
        for (int k = 0; k < 3; k++) {
            p->at[side][k] += at[k];
        }
        between(by[side], joint->turn[side], q);
    }
    since(p->turned, by[1], by[0]);
}

static double angle_of(const double q[4])
{
    return 2 * atan2(real_length(q + 1), fabs(q[0]));
}

/* The coordinate of a joint, by carom_joint.h: an angle, a way or a distance. */
static double coordinate(const struct soak_joint *joint, const struct place *p)
{
    double apart[3], axis[3];

    for (int k = 0; k < 3; k++) {
        apart[k] = p->at[0][k] - p->at[1][k];
        axis[k] = real(joint->def.axis.c[k], 30);
    }
    switch (joint->def.kind) {
    case CAROM_JOINT_HINGE:
        return 2 * atan2(real_dot(p->turned + 1, axis) * (p->turned[0] < 0 ? -1 : 1),
                         fabs(p->turned[0]));
    case CAROM_JOINT_SLIDER:
        return real_dot(apart, p->axis[1]);
    case CAROM_JOINT_DISTANCE:
        return real_length(apart);
    default:
        return 0;
    }
}

double soak_joint_energy(const struct crowd *crowd, const struct soak_joint *joint, double *noise)
{
    const struct carom_joint_drive *d = &joint->def.drive;
    struct place p;
    double at, stretch, place;

    *noise = 0;
    if (!d->spring || joint->gone) {
        return 0;
    }
    find(crowd, joint, &p);
    at = coordinate(joint, &p);
    stretch = at - real(d->rest_q32, 32);
    if (d->limited) { /* no less than at the limit */
        at = fmax(real(d->lower_q32, 32), fmin(real(d->upper_q32, 32), at));
        stretch = fmax(fabs(stretch), fabs(at - real(d->rest_q32, 32)));
    }
    /* a rotation is known to q30, and an anchor to that times its arm; for a hinge only rotations
     * count */
    place = 0x1p-29 * (1 + (joint->def.kind == CAROM_JOINT_HINGE
                                ? 0
                                : real_length(joint->arm[0]) + real_length(joint->arm[1])));
    *noise = real(d->stiffness_q40, 40) * (fabs(stretch) + place) * place;
    return real(d->stiffness_q40, 40) * stretch * stretch / 2;
}

/* The smaller skin of a joint's moving bodies. */
static double smaller_skin(const struct crowd *crowd, const struct soak_joint *joint)
{
    double skin = crowd->meshes[crowd->bodies[joint->def.a].mesh].skin;

    if (joint->def.b != CAROM_WORLD && !crowd->bodies[joint->def.b].def.stationary) {
        skin = fmin(skin, crowd->meshes[crowd->bodies[joint->def.b].mesh].skin);
    }
    return skin;
}

static double apart_of(const struct soak_joint *joint, const struct place *p)
{
    double apart[3], along;

    for (int k = 0; k < 3; k++) {
        apart[k] = p->at[0][k] - p->at[1][k];
    }
    along = real_dot(apart, p->axis[1]);
    for (int k = 0; k < 3 && joint->def.kind == CAROM_JOINT_SLIDER; k++) {
        apart[k] -= along * p->axis[1][k];
    }
    return joint->def.kind == CAROM_JOINT_DISTANCE ? 0 : real_length(apart);
}

static double turned_off(const struct soak_joint *joint, const struct place *p)
{
    double across[3];

    if (joint->def.kind == CAROM_JOINT_HINGE) {
        real_cross(across, p->axis[0], p->axis[1]);
        return atan2(real_length(across), real_dot(p->axis[0], p->axis[1]));
    }
    return joint->def.kind == CAROM_JOINT_SLIDER || joint->def.kind == CAROM_JOINT_FIXED
               ? angle_of(p->turned)
               : 0;
}

void soak_joint_look(const struct crowd *crowd, const struct soak_joint *joint, int number,
                     long frame, struct soak_off *off)
{
    const struct carom_joint_drive *d = &joint->def.drive;
    double skin = smaller_skin(crowd, joint), c, beyond = 0;
    struct place p;

    find(crowd, joint, &p);
    c = coordinate(joint, &p);
    if (apart_of(joint, &p) / skin > off->apart) {
        off->apart = apart_of(joint, &p) / skin;
        off->frame = frame;
        off->joint = number;
    }
    off->axes = fmax(off->axes, turned_off(joint, &p));
    if (d->limited) {
        beyond = fmax(0, fmax(real(d->lower_q32, 32) - c, c - real(d->upper_q32, 32)));
    }
    if (joint->def.kind == CAROM_JOINT_HINGE) {
        off->bent = fmax(off->bent, beyond);
    } else {
        off->beyond = fmax(off->beyond, beyond / skin);
    }
}

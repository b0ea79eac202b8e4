/* SPDX-License-Identifier: MIT */
/*
 * fixture_statics - whether bodies in a plane can stand: whether forces within the friction cones
 * at given contacts can hold given weights, by non-negative least squares.
 */
#ifndef CAROM_TESTS_FIXTURE_STATICS_H
#define CAROM_TESTS_FIXTURE_STATICS_H

#define STATICS_BODIES   64
#define STATICS_CONTACTS 160

struct statics_contact {
    int a, b;                   /* bodies; -1: the ground */
    double point[2], normal[2]; /* x, z; from b into a, a unit vector */
};

struct statics {
    int body_count, contact_count;
    double middle[STATICS_BODIES][2], weight[STATICS_BODIES];
    struct statics_contact contacts[STATICS_CONTACTS];
};

/*
 * The weights and torques that the best forces leave unbalanced, as a part of all weights; nearly 0
 * when the bodies can stand.
 */
double statics_rest(const struct statics *s, double mu);

#endif

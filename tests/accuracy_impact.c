/* SPDX-License-Identifier: MIT */
/*
 * The impulse of one contact, against the oracle of impact_real.h. Rows of out/accuracy.csv:
 *
 *   impulse9, impulse15              the oracle sees real numbers, the engine what they are rounded
 *                                    to: arms to 30 bits, V.N at least |V| / 128
 *   impulse9_q22, impulse15_q22      the same with arms in q22, as contacts have them: no bar
 *   impulse9_given, impulse15_given  both see the same rounded numbers: V.N at least |V| / 1024
 *   restitution                      V'.N - (-e V.N), relative to V.N
 *
 * 9 is one mover, 15 two. The error of an impulse is |P - P of the oracle| / |P of the oracle|.
 */
#include "lib/accuracy.h"

#include <stdio.h>

#include "lib/impact_real.h"

static struct gauss workspace;

static struct vector error_of(const struct impact_result *result, const struct real_answer *exact)
{
    return difference(vector_q40(result->impulse.c), exact->impulse);
}

static scalar relative(const struct impact_result *result, const struct real_answer *exact)
{
    return length(error_of(result, exact)) / length(exact->impulse);
}

/*
 * Near the borders between sticking, sliding and wedging, the rounding of the inputs alone decides
 * which of them happens. The impulse jumps there, and either answer is right. Returns the error, or
 * -1 when there is no impulse.
 */
static double impulse_error(const struct real_impact *real, const struct impact *in,
                            unsigned *either)
{
    struct real_impact given = real_from_engine(in);
    struct real_contact contact, given_contact;
    struct real_answer exact;
    struct impact_result result;
    enum real_way way, given_way;
    scalar error, other;

    if (impact_solve(&workspace, in, &result) != CAROM_OK) {
        return -1;
    }
    real_prepare(real, &contact);
    real_prepare(&given, &given_contact);
    way = real_choose(real, &contact);
    given_way = real_choose(&given, &given_contact);
    real_solve(real, &contact, way, &exact);
    error = relative(&result, &exact);
    if (way != given_way) {
        ++*either;
        real_solve(real, &contact, given_way, &exact);
        other = relative(&result, &exact);
        error = other < error ? other : error;
    }
    return (double)error;
}

struct row {
    const char *kernel;
    int movers, arm_bits, graze;
    bool given; /* the oracle sees the rounded numbers */
    struct accuracy_bar bar;
};

static void impulses(const struct row *row, size_t cases)
{
    struct accuracy a = accuracy_begin(row->kernel, cases);
    uint64_t random = 1;
    unsigned either = 0;

    for (size_t i = 0; i < a.wanted; i++) {
        struct real_impact real;
        struct impact in;
        double error;

        real_random_impact(&random, row->movers, row->graze, &real);
        in = real_to_engine(&real, row->arm_bits);
        if (row->given) {
            real = real_from_engine(&in);
        }
        error = impulse_error(&real, &in, &either);
        if (error < 0) {
            accuracy_fail(&a);
        } else {
            accuracy_add(&a, error);
        }
    }
    accuracy_end(&a, &row->bar);
    if (either > 0) {
        fprintf(stderr, "# %s: %u cases at a jump of the impulse, either answer accepted\n",
                row->kernel, either);
    }
}

/*
 * P is rounded to 2^-40, which changes V by about 2^-40 over the smaller mass m*. So V.N is at
 * least 2^20 units of 2^-40, and m* V.N at least 2^23 of them.
 */
static struct real_impact random_speed(uint64_t *random, int movers)
{
    struct real_impact real;
    scalar speed, mass = 0;
    int heavier = (int)(real_random(random) % 6);

    real_random_impact(random, movers, 7, &real);
    for (int b = 0; b < 2; b++) {
        struct real_body *body = &real.body[b];

        body->mass = scaled(body->mass, heavier);
        mass = body->moving && (mass == 0 || body->mass < mass) ? body->mass : mass;
    }
    do {
        speed = real_spread(random, -20, 3);
    } while (mass * speed < 0x1p-17L);
    speed /= magnitude(dot(real.velocity, real.normal));
    real.velocity = times(speed, real.velocity);
    return real;
}

static void restitution(size_t cases)
{
    struct accuracy a = accuracy_begin("restitution", cases);
    uint64_t random = 2;

    for (size_t i = 0; i < a.wanted; i++) {
        struct real_impact real = random_speed(&random, 1 + (int)(i % 2));
        struct impact in = real_to_engine(&real, 30);
        struct real_contact contact;
        struct impact_result result;
        struct vector change;

        if (impact_solve(&workspace, &in, &result) != CAROM_OK) {
            accuracy_fail(&a);
            continue;
        }
        real = real_from_engine(&in);
        real_prepare(&real, &contact);
        change = matrix_times(&contact.k, vector_q40(result.impulse.c));
        accuracy_add(&a,
                     (double)magnitude((contact.speed + dot(real.normal, change) - real.target) /
                                       contact.speed));
    }
    accuracy_end(&a, &(struct accuracy_bar){.max = 1e-6});
}

int main(int argc, char **argv)
{
    static const struct accuracy_bar bar = {.p9999 = 2e-7, .max = 1e-6}, none = {.max = 0};
    const struct row rows[] = {
        {"impulse9", 1, 30, 7, false, bar},       {"impulse15", 2, 30, 7, false, bar},
        {"impulse9_q22", 1, 22, 7, false, none},  {"impulse15_q22", 2, 22, 7, false, none},
        {"impulse9_given", 1, 30, 10, true, bar}, {"impulse15_given", 2, 30, 10, true, bar},
    };
    size_t cases = accuracy_cases(argc, argv, 200000);

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        impulses(&rows[i], cases);
    }
    restitution(cases);
    return accuracy_finish();
}

/* SPDX-License-Identifier: MIT */
/*
 * Heavy bodies on light ones: what a solve reports about itself, and the normals of faces that lie
 * on each other.
 */
#include "solve/rigid.h"
#include "lib/hand.h"
#include "lib/real.h"

#ifdef TEST_LONG
#define CASES 400
#else
#define CASES 20
#endif

#define LEAN 3e-4

/* Cube 2 on cube 1, shifted by a part of a side; cube 1 has mass 1. */
static void stack(double mass, double x, double y, double fall)
{
    hand_make_cube();
    hand_begin(2, fall);
    body_set_mass(&hand.bodies[2], fix_scale(real_round(mass * 1024), 10));
    hand.states[2].position.c[0] = real_round(x * real_power2(32));
    hand.states[2].position.c[1] = real_round(y * real_power2(32));
    hand.states[2].position.c[2] = (int64_t)1 << 32;
    hand_clear_contacts();
}

/* V.N of a contact, from the bodies' momenta. */
static double speed_of(const struct contact *c)
{
    double speed = 0;

    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;
        double v[3], w[3], r[3], at[3];

        if (!b) {
            continue;
        }
        hand_velocity_of((int)(b - hand.bodies), v, w);
        for (int k = 0; k < 3; k++) {
            r[k] = real(c->side[s].arm_q30[k], contact_arm_bits(b));
        }
        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;

            at[k] = v[k] + w[m] * r[n] - w[n] * r[m];
            speed += (s == 0 ? 1 : -1) * at[k] * real(c->normal.c[k], 30);
        }
    }
    return speed;
}

static double slowest(void)
{
    double least = 0;

    for (uint32_t i = 0; i < hand.pool.used; i++) {
        double speed = speed_of(&hand.contacts[i]);

        least = speed < least ? speed : least;
    }
    return least;
}

/*
 * Impacts of masses up to 1000:1. Either no place approaches by more than a 32nd of a skin a frame,
 * or the island is reported as unsettled. As one rigid body on the ground it approaches nowhere.
 */
static void test_unsettled(void)
{
    struct test_random r = {3};
    long settled = 0, unsettled = 0;

    for (int n = 0; n < CASES; n++) {
        double mass = n % 4 ? real_power2((int)test_random_range(&r, 0, 10)) : 1, bound;
        double x = real(test_random_range(&r, -300, 300), 10);
        double y = real(test_random_range(&r, -300, 300), 10);

        stack(mass, x, y, 1 / 367.0);
        hand_set_surface(0, n % 3 ? 0.5 : 0);
        hand_set_motion(2, (double[3]){0.01, 0, -0.125}, (double[3]){0.01, 0.02, 0});
        hand_touch_corners_of(0, hand.bodies[1].def.skin_q22 / 2);
        hand_touch_corners_of(1, hand.bodies[1].def.skin_q22 / 2);
        CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
        bound = real(hand.bodies[1].def.skin_q22, 22) / 32 + 1e-8;
        CHECK_EQ(hand.bodies[1].solve.unsettled, hand.bodies[2].solve.unsettled);
        CHECK(hand.bodies[1].solve.unsettled || slowest() > -bound);
        CHECK(mass > 1 || !hand.bodies[1].solve.unsettled);
        *(hand.bodies[1].solve.unsettled ? &unsettled : &settled) += 1;
        rest_unite(&hand.rest, 1, true);
        CHECK_EQ(slowest(), 0);
    }
    CHECK_MORE(settled, CASES / 4);
    CHECK_MORE(unsettled, 0);
}

/* The lower corners of the upper cube, with a normal that leans along x. */
static void touch_leaning(void)
{
    const int64_t leaning[3] = {real_round(LEAN * 1e9), 0, 1000000000};
    carom_v3_q30 normal;

    fix_normalise(&normal, leaning);
    for (uint32_t v = 0; v < 4; v++) {
        int32_t arm[3];

        for (int k = 0; k < 3; k++) {
            arm[k] = hand.solid.vertices[v][k] * 1024;
        }
        hand_touch(1, v, arm, normal, hand.bodies[1].def.skin_q22);
    }
}

/*
 * A cube under another one that is 1000 times as heavy, without friction, between normals that
 * differ by 3e-4. With different normals below and above, it would be pushed aside at 0.3 g. A cube
 * that slides along the lean by more than a 64th of a skin a frame keeps its normals.
 */
static void test_share(void)
{
    const double g = 1 / 367.0;

    for (int slides = 0; slides < 2; slides++) {
        double v[3], w[3];

        stack(1000, 0, 0, g);
        hand_set_surface(0, 0);
        hand_set_motion(2, (double[3]){slides ? 0.25 : 0, 0, 0}, (double[3]){0, 0, 0});
        hand_touch_corners_of(0, hand.bodies[1].def.skin_q22);
        touch_leaning();
        CHECK(hand_enter_contact(CAROM_ONE_Q30));
        CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, true), CAROM_OK);
        CHECK_EQ((hand.contacts[4].normal.c[0] == 0), !slides);
        hand_velocity_of(1, v, w);
        CHECK(slides || real_abs(v[0]) < 1e-5 * g);
    }
}

/* Whether an edge of the solid lies in its side at z = -1/2 or 1/2. */
static bool borders(uint32_t edge, bool upper)
{
    const struct carom_edge *e = &hand.solid.mesh.edges[edge];

    return (hand.solid.vertices[e->vertex[0]][2] > 0) == upper &&
           (hand.solid.vertices[e->vertex[1]][2] > 0) == upper;
}

/*
 * Cube 2 on cube 1, turned by 0.3 about z and by a lean about x. Edges at the border of the faces
 * between them get the normal of cube 1's face, unless the faces or the normal lean too much.
 */
static void test_flatten(void)
{
    static const double leans[] = {0, LEAN, -LEAN, 0.004};

    for (int n = 0; n < 8; n++) {
        const double lean = leans[n % 4];
        const int64_t leaning[3] = {n < 4 ? 3000 : 20000, -2000, 1000000};
        carom_v3_q30 given;
        double sine, cosine, s, c;

        real_sine_cosine(0.15, &sine, &cosine);
        real_sine_cosine(lean / 2, &s, &c);
        stack(1, 0, 0, 0);
        hand.states[2].rotation = (carom_quat_q30){{(int32_t)real_round(c * cosine * CAROM_ONE_Q30),
                                                    (int32_t)real_round(s * cosine * CAROM_ONE_Q30),
                                                    (int32_t)real_round(-s * sine * CAROM_ONE_Q30),
                                                    (int32_t)real_round(c * sine * CAROM_ONE_Q30)}};
        hand_clear_contacts();
        fix_normalise(&given, leaning);
        boyse_pair_init(&hand.pair, &hand.bodies[2], &hand.bodies[1]);
        for (uint32_t i = 0; i < hand.solid.mesh.edge_count; i++) {
            for (uint32_t j = 0; j < hand.solid.mesh.edge_count; j++) {
                const struct candidate key = {1, CANDIDATE_EDGE_EDGE, i, j};
                const bool flat =
                    n < 4 && real_abs(lean) < 9e-4 && borders(i, false) && borders(j, true);
                carom_v3_q30 normal = given;

                contact_flatten(&hand.pair, &key, &normal);
                CHECK_EQ(memcmp(&normal, flat ? &hand_up : &given, sizeof normal), 0);
            }
        }
    }
}

/* A cube on a plane and one below it: edges get the normal of the plane's side that they are on. */
static void test_flatten_both_sides(void)
{
    const struct carom_mesh *plane = &hand.ground.mesh;

    stack(1, 0, 0, 0);
    boyse_pair_init(&hand.pair, &hand.bodies[1], &hand.bodies[0]);
    for (int n = 0; n < 2; n++) {
        const bool under = n == 1;
        const int64_t leaning[3] = {3000, -2000, under ? -1000000 : 1000000};
        const carom_v3_q30 side = {{0, 0, under ? -CAROM_ONE_Q30 : CAROM_ONE_Q30}};
        carom_v3_q30 given;

        fix_normalise(&given, leaning);
        for (uint32_t i = 0; i < hand.solid.mesh.edge_count; i++) {
            for (uint32_t j = 0; j < plane->edge_count; j++) {
                const struct candidate key = {0, CANDIDATE_EDGE_EDGE, i, j};
                carom_v3_q30 normal = given;

                contact_flatten(&hand.pair, &key, &normal);
                CHECK_EQ(memcmp(&normal, borders(i, under) ? &side : &given, sizeof normal), 0);
            }
        }
    }
}

const struct test tests_solve_rest_stack[] = {
    {"solve_rest_stack/unsettled", test_unsettled},
    {"solve_rest_stack/share", test_share},
    {"solve_rest_stack/flatten", test_flatten},
    {"solve_rest_stack/flatten_both_sides", test_flatten_both_sides},
    {0},
};

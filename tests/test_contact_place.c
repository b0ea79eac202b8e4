/* SPDX-License-Identifier: MIT */
/* Places of contacts against the features of duo.h in double precision. */
#include "contact/contact.h"
#include "lib/duo.h"
#include "lib/real.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 5000
#else
#define CASES 40
#endif

/* Both bodies turned at random, a few units apart, anywhere in the world. */
static void place_bodies(struct test_random *r)
{
    int64_t far[3];

    duo_begin(true);
    for (int k = 0; k < 3; k++) {
        far[k] = test_random_range(r, -((int64_t)1 << 43), (int64_t)1 << 43);
    }
    for (int s = 0; s < 2; s++) {
        duo.state[s].rotation = shape_random_turn(r);
        for (int k = 0; k < 3; k++) {
            duo.state[s].position.c[k] =
                far[k] + test_random_range(r, -((int64_t)1 << 33), (int64_t)1 << 33);
        }
        body_place(&duo.body[s], &duo.state[s]);
    }
    boyse_pair_init(&duo.pair, &duo.body[0], &duo.body[1]);
    duo_read_motion();
}

/* Halfway between the vertex and the plane, or the nearest points of two lines. */
static void expect(const struct duo_features *f, const struct candidate *c, double place[3])
{
    double d[3], b = 0, s = 0;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        b = real_dot(f->e[0], f->e[1]);
        for (int k = 0; k < 3; k++) {
            d[k] = f->from[0][k] - f->from[1][k];
        }
        s = (b * real_dot(d, f->e[1]) - real_dot(d, f->e[0])) / (f->sine * f->sine);
    }
    for (int k = 0; k < 3; k++) {
        place[k] = (c->kind == CANDIDATE_EDGE_EDGE ? f->from[0][k] + s * f->e[0][k] : f->p[k]) -
                   f->n[k] * f->gap / 2;
    }
}

static struct candidate random_candidate(struct test_random *r, int kind)
{
    struct candidate c = {0, (uint8_t)kind, 0, 0};
    const struct carom_mesh *a = &duo.shape[0].mesh, *b = &duo.shape[1].mesh;

    if (kind == CANDIDATE_EDGE_EDGE) {
        c.i = (uint32_t)test_random_range(r, 0, (int)a->edge_count - 1);
        c.j = (uint32_t)test_random_range(r, 0, (int)b->edge_count - 1);
    } else {
        const struct carom_mesh *of_vertex = kind == CANDIDATE_VERTEX_FACE ? a : b;
        const struct carom_mesh *of_face = kind == CANDIDATE_VERTEX_FACE ? b : a;

        c.i = (uint32_t)test_random_range(r, 0, (int)of_vertex->raw.vertex_count - 1);
        c.j = (uint32_t)test_random_range(r, 0, (int)of_face->raw.face_count - 1);
    }
    return c;
}

static void check(int kind)
{
    struct test_random r = {(uint64_t)kind + 1};
    unsigned wrong = 0, apart = 0, checked = 0;

    for (int n = 0; n < CASES; n++) {
        struct candidate c;
        struct duo_features f;
        carom_v3_q30 normal;
        carom_v3_q40 arm[2];
        double place[3], limit;

        if (n % 20 == 0) {
            shape_box(&duo.shape[0], 12, 4096, (int)test_random_range(&r, 500, 8000), 3000);
            shape_tetrahedron(&duo.shape[1], 12, (int)test_random_range(&r, 500, 8000));
        }
        place_bodies(&r);
        c = random_candidate(&r, kind);
        duo_features_at(&f, &c, 0);
        if (f.sine < 0.01) {
            continue;
        }
        checked++;
        expect(&f, &c, place);
        for (int k = 0; k < 3; k++) {
            normal.c[k] = (int32_t)real_round(f.n[k] * CAROM_ONE_Q30);
        }
        contact_place(&duo.pair, &c, &normal, arm);
        /* 2^-28 of the size of things; the place where nearly parallel lines cross far away is less
         * certain */
        limit = (4 + real_abs(place[0] - f.pose[0].x[0]) + real_abs(place[1] - f.pose[0].x[1]) +
                 real_abs(place[2] - f.pose[0].x[2])) *
                real_power2(-28) / f.sine;
        for (int s = 0; s < 2; s++) {
            for (int k = 0; k < 3; k++) {
                wrong += real_abs(f.pose[s].x[k] + real(arm[s].c[k], 40) - place[k]) > limit;
            }
        }
        for (int k = 0; k < 3; k++) {
            apart += arm[0].c[k] - arm[1].c[k] !=
                     carom_shl(duo.state[1].position.c[k] - duo.state[0].position.c[k], 8);
        }
    }
    CHECK_EQ(wrong, 0);
    CHECK_EQ(apart, 0);
    CHECK_MORE(checked, CASES / 2);
}

static void vertex_face(void)
{
    check(CANDIDATE_VERTEX_FACE);
}

static void face_vertex(void)
{
    check(CANDIDATE_FACE_VERTEX);
}

static void edge_edge(void)
{
    check(CANDIDATE_EDGE_EDGE);
}

const struct test tests_contact_place[] = {{"contact_place/vertex_face", vertex_face},
                                           {"contact_place/face_vertex", face_vertex},
                                           {"contact_place/edge_edge", edge_edge},
                                           {0}};

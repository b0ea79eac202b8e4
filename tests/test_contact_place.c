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

/* --------------------------------------------------------------------- faces */

/* How far a face looks along a direction of the world. */
static double looks_along(int side, uint32_t face, struct duo_pose *pose, const double n[3])
{
    double p[3][3], d[2][3], across[3], normal[3];

    for (int k = 0; k < 3; k++) {
        carom_v3_q22 v = mesh_vertex(&duo.shape[side].mesh, duo.shape[side].faces[face][k]);

        for (int i = 0; i < 3; i++) {
            p[k][i] = real(v.c[i], 22);
        }
    }
    for (int i = 0; i < 3; i++) {
        d[0][i] = p[1][i] - p[0][i];
        d[1][i] = p[2][i] - p[0][i];
    }
    real_cross(across, d[0], d[1]);
    real_rotate(normal, pose->r, across);
    return real_dot(normal, n) / real_length(normal);
}

/* True if a face has the vertex of a key, or both ends of its edge. */
static bool has_feature(int side, uint32_t face, const struct candidate *key)
{
    const struct carom_edge *edge = &duo.shape[side].mesh.edges[side == 0 ? key->i : key->j];
    bool edges = key->kind == CANDIDATE_EDGE_EDGE;
    int found = 0;

    for (int k = 0; k < 3; k++) {
        uint32_t v = duo.shape[side].faces[face][k];

        found += edges ? v == edge->vertex[0] || v == edge->vertex[1] : v == key->i;
    }
    return found == (edges ? 2 : 1);
}

/*
 * The face of a contact is the one of its face feature; at an edge or a vertex it is, among the
 * faces there, the one that looks most towards the other body.
 */
static void faces(void)
{
    static const int kinds[] = {CANDIDATE_EDGE_EDGE, CANDIDATE_VERTEX_FACE, CANDIDATE_FACE_VERTEX};
    struct test_random r = {9};

    shape_box(&duo.shape[0], 12, 4096, 2500, 3000);
    shape_tetrahedron(&duo.shape[1], 12, 3000);
    for (int n = 0; n < CASES; n++) {
        struct candidate c;
        struct duo_features f;
        carom_v3_q30 normal;
        double towards[2][3], length;

        place_bodies(&r);
        c = random_candidate(&r, kinds[n % 3]);
        duo_features_at(&f, &c, 0);
        for (int k = 0; k < 3; k++) {
            towards[0][k] = real(test_random_range(&r, -1000, 1000), 10) + 1e-9;
        }
        length = real_length(towards[0]);
        for (int k = 0; k < 3; k++) {
            /* the normal looks from b to a */
            towards[0][k] /= -length;
            towards[1][k] = -towards[0][k];
            normal.c[k] = (int32_t)real_round(towards[1][k] * CAROM_ONE_Q30);
        }
        for (int side = 0; side < 2; side++) {
            uint32_t face = contact_face(&duo.body[side], &c, side, &normal);
            double most = -1;

            CHECK_LESS(face, duo.shape[side].raw.face_count);
            if (c.kind != CANDIDATE_EDGE_EDGE && side != duo_vertex_side(c.kind)) {
                CHECK_EQ(face, c.j);
                continue;
            }
            for (uint32_t i = 0; i < duo.shape[side].raw.face_count; i++) {
                double here = looks_along(side, i, &f.pose[side], towards[side]);

                most = has_feature(side, i, &c) && here > most ? here : most;
            }
            if (face < duo.shape[side].raw.face_count) {
                CHECK(has_feature(side, face, &c));
                CHECK_LESS(most - looks_along(side, face, &f.pose[side], towards[side]), 1e-7);
            }
        }
    }
}

const struct test tests_contact_place[] = {{"contact_place/vertex_face", vertex_face},
                                           {"contact_place/face_vertex", face_vertex},
                                           {"contact_place/edge_edge", edge_edge},
                                           {"contact_place/faces", faces},
                                           {0}};

/* SPDX-License-Identifier: MIT */
/* Contacts: features, normals, margins, merging, full pools. */
#include "contact/contact.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CONTACTS   64
#define CANDIDATES 4096
#ifdef TEST_LONG
#define CLEAR_CASES 2000
#else
#define CLEAR_CASES 8
#endif

static struct shape shape_a, shape_b;
static struct body bodies[2];
static struct body_state states[2];
static struct boyse_pair pair;
static struct contact contacts[CONTACTS], first[CONTACTS];
static struct candidate candidates[CANDIDATES];
static uint32_t candidate_count;
static struct pool pool;
static struct contact_list list = {.contacts = contacts, .pool = &pool};

/* Both bodies at rest in the middle; the test moves a, then calls place(). */
static void begin(void)
{
    pool = (struct pool){CONTACTS, 0, 0, 0};
    shape_body(&shape_a, true, &bodies[0], &states[0]);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    candidate_count = shape_candidates(&shape_a, &shape_b, 0, candidates, CANDIDATES);
    CHECK_AT_MOST(candidate_count, CANDIDATES);
}

static void place(void)
{
    body_place(&bodies[0], &states[0]);
    body_place(&bodies[1], &states[1]);
    boyse_pair_init(&pair, &bodies[0], &bodies[1]);
}

/* Find the contacts of all candidates, starting with any of them; false when they do not fit. */
static bool find(int32_t margin_q22, uint32_t start)
{
    int32_t clear_q22 = INT32_MAX;
    bool fits = true;

    pool_clear(&pool);
    for (uint32_t n = 0; n < candidate_count; n++) {
        fits = fits && contact_add(&list, &pair, &candidates[(start + n) % candidate_count],
                                   margin_q22, &clear_q22);
    }
    return fits;
}

static bool in_order(void)
{
    for (uint32_t i = 1; i < pool.used; i++) {
        if (candidate_compare(&contacts[i - 1].key, &contacts[i].key) >= 0) {
            return false;
        }
    }
    return true;
}

/*
 * A box of 1 x 0.6 x 0.3 above a plane of 2 x 2 squares of 4 units, with its corners off the edges.
 */
static void box_over_plane(int32_t gap_q22)
{
    shape_box(&shape_a, 12, 4096, 2400, 1200);
    shape_plane(&shape_b, 9, 2, 2048);
    begin();
    states[0].position.c[0] = (int64_t)3 << 30;
    states[0].position.c[1] = (int64_t)3 << 29;
    states[0].position.c[2] = carom_shl((600 << 10) + gap_q22, 10);
    place();
}

/* -------------------------------------------------------------------- shapes */

static void check_four_corners(int32_t gap_q22)
{
    uint8_t seen = 0;

    CHECK(in_order());
    contact_merge(&list);
    CHECK_EQ(pool.used, 4);
    for (uint32_t i = 0; i < pool.used; i++) {
        const struct contact *c = &contacts[i];
        uint32_t v = c->key.i;

        CHECK_EQ(c->key.kind, CANDIDATE_VERTEX_FACE);
        CHECK_EQ(c->key.pair, 0);
        CHECK_EQ(c->normal.c[0], 0);
        CHECK_EQ(c->normal.c[1], 0);
        CHECK_EQ(c->normal.c[2], CAROM_ONE_Q30);
        CHECK_EQ(c->gap_q22, gap_q22);
        CHECK_EQ(c->skin_q22, bodies[0].def.skin_q22);
        CHECK_SAME(c->side[0].body, &bodies[0]);
        CHECK_SAME(c->side[1].body, NULL);
        CHECK_LESS(v, 4); /* the lower corners, each once */
        CHECK(!(seen >> v & 1));
        seen |= (uint8_t)(1 << v);
        for (int k = 0; k < 2; k++) {
            CHECK_EQ(contact_arm(c).c[k], shape_a.vertices[v][k] * 1024);
            CHECK_EQ(contact_point(c).c[k],
                     states[0].position.c[k] + shape_a.vertices[v][k] * ((int64_t)1 << 20));
        }
        /* halfway between the surfaces */
        CHECK_NEAR(contact_point(c).c[2], carom_shl(gap_q22, 10) / 2, 1024);
        CHECK_NEAR(contact_arm(c).c[2], -600 * 1024 - gap_q22 / 2, 1);
    }
    CHECK_EQ(seen, 15);
}

static void test_flat(void)
{
    int32_t skin;

    box_over_plane(0);
    skin = bodies[0].def.skin_q22;
    for (int32_t gap = -2 * skin; gap <= 5 * skin; gap += skin / 2) {
        box_over_plane(gap);
        CHECK(find(5 * skin, 0));
        check_four_corners(gap);
    }
}

/* The same, turned and far out: normals and gaps are right within the rounding of places. */
static void test_tilted(void)
{
    struct test_random r = {1};

    for (int n = 0; n < 8; n++) {
        double m[3][3], q[4], local[3], world[3], up[3] = {0, 0, 1}, normal[3];
        int32_t gap = (int32_t)test_random_range(&r, -1000, 1500);

        box_over_plane(gap);
        for (int k = 0; k < 3; k++) {
            local[k] = real(states[0].position.c[k], 32);
        }
        states[1].rotation = shape_random_turn(&r);
        body_normalise(&states[1].rotation);
        states[0].rotation = states[1].rotation;
        for (int k = 0; k < 4; k++) {
            q[k] = states[1].rotation.c[k];
        }
        real_matrix(m, q);
        real_rotate(world, m, local);
        real_rotate(normal, m, up);
        for (int k = 0; k < 3; k++) {
            states[1].position.c[k] = test_random_range(&r, -((int64_t)1 << 43), (int64_t)1 << 43);
            states[0].position.c[k] =
                states[1].position.c[k] + real_round(world[k] * real_power2(32));
        }
        place();
        CHECK(find(2000, 0));
        CHECK(in_order());
        contact_merge(&list);
        CHECK_EQ(pool.used, 4);
        for (uint32_t i = 0; i < pool.used; i++) {
            CHECK_NEAR(contacts[i].gap_q22, gap, 4);
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(contacts[i].normal.c[k], real_round(normal[k] * CAROM_ONE_Q30), 16);
            }
        }
    }
}

/* An edge on a face touches at its two ends. */
static void test_edge_on_face(void)
{
    int64_t height_q32 = real_round((1200 + 600) / real_sqrt(2) * (1 << 20));

    shape_box(&shape_a, 12, 4096, 2400, 1200);
    shape_plane(&shape_b, 9, 2, 2048);
    begin();
    /* an eighth of a turn about x: half sides 1200 and 600 add up */
    states[0].rotation = (carom_quat_q30){{992008094, 410903207, 0, 0}};
    states[0].position.c[0] = (int64_t)3 << 30;
    states[0].position.c[1] = (int64_t)3 << 29;
    states[0].position.c[2] = height_q32 + (500 << 10);
    place();
    CHECK(find(1000, 0));
    contact_merge(&list);
    CHECK_EQ(pool.used, 2);
    CHECK_NEAR(contact_point(&contacts[0]).c[0] + contact_point(&contacts[1]).c[0],
               (int64_t)3 << 31, 1 << 12);
    CHECK_NEAR(carom_abs(contact_point(&contacts[0]).c[0] - contact_point(&contacts[1]).c[0]),
               (int64_t)1 << 32, 1 << 12);
    for (uint32_t i = 0; i < 2; i++) {
        CHECK_NEAR(contacts[i].gap_q22, 500, 2);
        CHECK_EQ(contacts[i].normal.c[2], CAROM_ONE_Q30);
        CHECK_NEAR(contact_point(&contacts[i]).c[1], (int64_t)3 << 29, (int64_t)1 << 31);
    }
}

/* Two edges that cross have one contact, along their cross product. */
static void test_crossing_edges(void)
{
    for (int flip = 0; flip < 2; flip++) {
        int sign = flip ? -1 : 1;

        shape_box(&shape_a, 12, 4096, 2400, 1200);
        shape_box(&shape_b, 10, 1024, 4096, 1024);
        begin();
        states[0].rotation = (carom_quat_q30){{992008094, 410903207, 0, 0}};
        states[1].rotation = (carom_quat_q30){{992008094, 0, 410903207, 0}};
        /* heights of the ridges: 1800 / sqrt 2 quanta of 2^-12, 1 / sqrt 2 */
        states[0].position.c[2] =
            sign * (real_round((1800. / 4096 + 1) / real_sqrt(2) * real_power2(32)) + (700 << 10));
        states[0].position.c[0] = (int64_t)1 << 30; /* meets a off its middle */
        place();
        CHECK(find(1000, 0));
        CHECK_EQ(pool.used, 1);
        CHECK_EQ(contacts[0].key.kind, CANDIDATE_EDGE_EDGE);
        CHECK_NEAR(contacts[0].gap_q22, 700, 3);
        CHECK_NEAR(contacts[0].normal.c[2], sign * CAROM_ONE_Q30, 4);
        CHECK_NEAR(contact_point(&contacts[0]).c[0], 0, 1 << 12);
        CHECK_NEAR(contact_arm(&contacts[0]).c[0], -(1 << 20), 4);
    }
}

/* -------------------------------------------------------------------- rules */

static void test_margin(void)
{
    int32_t skin;

    box_over_plane(700);
    skin = bodies[0].def.skin_q22;
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 4);
    CHECK(find(699, 0));
    CHECK_EQ(pool.used, 0);
    /* features deeper than two skins and a half have no contact */
    box_over_plane(-(skin * 5 / 2));
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 4);
    box_over_plane(-(skin * 5 / 2) - 1);
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 0);
    /* beside the plane there is nothing to touch */
    box_over_plane(0);
    states[0].position.c[0] = (int64_t)6 << 32;
    place();
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 0);
}

/* Whether the contacts are the same, and whether no solver data is left in them. */
static bool same_contact(const struct contact *p, const struct contact *q)
{
    bool same = memcmp(p, q, offsetof(struct contact, side)) == 0 && p->idle == q->idle &&
                p->resting == q->resting && p->impact == q->impact && p->work == NULL &&
                q->work == NULL &&
                memcmp(&p->impulse_q40, &q->impulse_q40, sizeof p->impulse_q40) == 0;

    for (int s = 0; s < 2; s++) {
        same = same && p->side[s].body == q->side[s].body &&
               (!p->side[s].body ||
                memcmp(p->side[s].arm_q30, q->side[s].arm_q30, sizeof p->side[s].arm_q30) == 0);
    }
    return same;
}

/* Whether the contacts are the first ones found. */
static bool same_contacts(uint32_t count)
{
    bool same = true;

    for (uint32_t n = 0; n < count; n++) {
        same = same && same_contact(&first[n], &contacts[n]);
    }
    return same;
}

/* The list depends neither on the order of the candidates nor on how often one comes. */
static void test_order(void)
{
    int32_t clear_q22 = INT32_MAX;
    uint32_t count;

    shape_box(&shape_a, 12, 4096, 2400, 1200);
    shape_field(&shape_b, 12, 4, 2048, 0, 1); /* corners on edges of the field */
    begin();
    states[0].position.c[2] = carom_shl((600 << 10) + 300, 10);
    place();
    CHECK(find(700, 0));
    CHECK(in_order());
    count = pool.used;
    CHECK_MORE(count, 4);
    memcpy(first, contacts, sizeof first);
    for (uint32_t start = 1; start < candidate_count; start += candidate_count / 13) {
        memset(contacts, 0xa5, sizeof contacts);
        CHECK(find(700, start));
        CHECK_EQ(pool.used, count);
        CHECK(same_contacts(count));
    }
    for (uint32_t n = 0; n < candidate_count; n++) {
        CHECK(contact_add(&list, &pair, &candidates[n], 700, &clear_q22));
    }
    CHECK_EQ(pool.used, count);
    CHECK(same_contacts(count));
}

/* Doubtful contacts that are found again are in the list once; the others are dropped. */
static void test_doubt(void)
{
    int32_t clear_q22 = INT32_MAX;
    uint32_t count;

    box_over_plane(300);
    CHECK(find(700, 0));
    count = pool.used;
    memcpy(first, contacts, sizeof first);
    for (uint32_t start = 0; start < candidate_count; start += candidate_count / 5) {
        contact_doubt_pair(&list, 0);
        CHECK(!contact_has_pair(&list, 0));
        for (uint32_t n = 0; n < candidate_count; n++) {
            CHECK(contact_add(&list, &pair, &candidates[(start + n) % candidate_count], 700,
                              &clear_q22));
        }
        CHECK(contact_has_pair(&list, 0));
        CHECK(!contact_has_pair(&list, 1));
        contact_drop_doubted(&list);
        CHECK_EQ(pool.used, count);
        CHECK(in_order());
        CHECK(same_contacts(count));
    }
    contact_doubt_pair(&list, 0);
    CHECK(contact_add(&list, &pair, &first[1].key, 700, &clear_q22));
    contact_drop_doubted(&list);
    CHECK_EQ(pool.used, 1);
    CHECK(same_contact(&first[1], &contacts[0]));
}

/* A box above another, turned a little against it, with its lower side nearly on the upper side. */
static void box_over_box(struct test_random *r)
{
    shape_box(&shape_a, 12, 4096, 2400, 1200);
    shape_box(&shape_b, 12, 4000, 2600, 1200);
    begin();
    for (int k = 0; k < 3; k++) {
        int64_t more = k < 2 ? (int64_t)1 << 30 : (int64_t)1 << 19;

        states[0].position.c[k] = test_random_range(r, -more, more);
        states[0].rotation.c[1 + k] = (int32_t)test_random_range(r, -(1 << 18), 1 << 18);
    }
    states[0].rotation.c[3] *= 512;
    body_normalise(&states[0].rotation);
    states[0].position.c[2] += (int64_t)1200 << 20;
    place();
}

/* Set a's path: distance and rotation, together. */
static void set_path(struct test_random *r, int32_t way_q22)
{
    struct body_path *path = &bodies[0].path;
    int32_t turn_q30 = (int32_t)(((int64_t)way_q22 << 28) / bodies[0].def.radius_q22);

    for (int k = 0; k < 3; k++) {
        path->v.c[k] = carom_shl(test_random_range(r, -way_q22 / 6, way_q22 / 6), 18);
        path->u.c[k] = (int32_t)test_random_range(r, -turn_q30 / 3, turn_q30 / 3);
    }
    path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
    path->turns = true;
    boyse_pair_init(&pair, &bodies[0], &bodies[1]);
}

static bool hits(uint32_t number)
{
    struct boyse_hit hit;
    uint32_t roots = 0;

    return boyse_first(&pair, &candidates[number], &hit, &roots);
}

/*
 * A motion of no more than the clearance that the static check found between two features does not
 * make them meet.
 */
static void test_clear(void)
{
    struct test_random r = {5};
    int clear = 0, hit = 0;

    for (int n = 0; n < CLEAR_CASES; n++) {
        box_over_box(&r);
        for (uint32_t k = 0; k < candidate_count; k++) {
            int32_t clear_q22 = INT32_MAX;

            place();
            pool_clear(&pool);
            CHECK(
                contact_add(&list, &pair, &candidates[k], 2 * bodies[0].def.skin_q22, &clear_q22));
            if (clear_q22 > 0) {
                clear++;
                set_path(&r, clear_q22);
                CHECK(!hits(k));
                set_path(&r, 8 * clear_q22);
                hit += hits(k);
            }
        }
    }
    CHECK_MORE(clear, CLEAR_CASES);
    CHECK_MORE(hit, 0);
}

/* Two contacts with one normal are one, with the smaller gap, if they are nearer than two skins in the L1 norm. */
static void test_merge_near(void)
{
    struct contact lower;
    int32_t skin, down;

    box_over_plane(300);
    CHECK(find(700, 0));
    lower = contacts[0];
    skin = lower.skin_q22;
    down = contact_arm_bits(&bodies[0]) - 22;
    for (int32_t apart = 2 * skin - 3; apart <= 2 * skin + 3; apart++) {
        for (int part = 0; part <= 4; part++) {
            const int32_t x = apart * part / 4, y = x - apart;

            contacts[0] = contacts[1] = lower;
            contacts[1].key.i++;
            contacts[1].gap_q22--;
            contacts[1].side[0].arm_q30[0] += x * (1 << down);
            contacts[1].side[0].arm_q30[1] += y * (1 << down);
            pool.used = 2;
            contact_merge(&list);
            CHECK_EQ(pool.used, apart < 2 * skin ? 1 : 2);
            CHECK_EQ(contacts[0].gap_q22, lower.gap_q22 - (apart < 2 * skin));
        }
    }
}

/* A corner on a vertex of the ground meets six faces there: one contact, with the smallest gap. */
static void test_merge(void)
{
    int32_t least = INT32_MAX;

    shape_box(&shape_a, 12, 4096, 2048, 1200);
    shape_plane(&shape_b, 12, 4, 2048);
    begin();
    states[0].position.c[2] = carom_shl((600 << 10) + 300, 10);
    place();
    CHECK(find(700, 0));
    CHECK_AT_LEAST(pool.used, 8);
    for (uint32_t i = 0; i < pool.used; i++) {
        contacts[i].gap_q22 += (int32_t)(i * 7 % 5); /* differences that rounding may leave */
        least = contacts[i].gap_q22 < least ? contacts[i].gap_q22 : least;
    }
    contact_merge(&list);
    CHECK_EQ(pool.used, 4);
    CHECK(in_order());
    for (uint32_t i = 0; i < 4; i++) {
        CHECK_AT_LEAST(contacts[i].gap_q22, 300);
        CHECK_AT_MOST(contacts[i].gap_q22, 304);
        least = contacts[i].gap_q22 == least ? -1 : least;
    }
    CHECK_EQ(least, -1);
    contact_merge(&list); /* nothing more to do */
    CHECK_EQ(pool.used, 4);
}

/*
 * The distance of a place from the segment between two others; also returns the segment's length.
 */
static double off_line(const struct contact *c, const struct contact *one,
                       const struct contact *other, double *length)
{
    double d[3], e[3], part;

    for (int k = 0; k < 3; k++) {
        double from = real(contact_arm(one).c[k], 22);

        d[k] = real(contact_arm(other).c[k], 22) - from;
        e[k] = real(contact_arm(c).c[k], 22) - from;
    }
    *length = real_length(d);
    part = real_dot(d, e) / real_dot(d, d);
    part = part < 0 ? 0 : part > 1 ? 1 : part;
    for (int k = 0; k < 3; k++) {
        e[k] -= part * d[k];
    }
    return real_length(e);
}

/* Whether a place is within so many 32nds of a line between two of n others. */
static bool hardly_stands_out(const struct contact *c, uint32_t n, double parts)
{
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < i; j++) {
            double length, off = off_line(c, &contacts[i], &contacts[j], &length);

            if (off <= parts / 32 * length) {
                return true;
            }
        }
    }
    return false;
}

/*
 * Two boxes lie on each other. Only corners of their common part that hardly stand out are dropped.
 */
static void test_thin(void)
{
    struct test_random r = {11};
    uint32_t dropped = 0, kept = 0, most = 0;

    for (uint32_t n = 0; n < 10 * CLEAR_CASES; n++) {
        uint32_t found, left, at = 0;

        box_over_box(&r);
        place();
        CHECK(find(2 * bodies[0].def.skin_q22, 0));
        contact_merge(&list);
        found = pool.used;
        memcpy(first, contacts, found * sizeof *contacts);
        left = found > 0 ? contact_thin(contacts, found) : 0;
        CHECK_AT_MOST(left, found);
        CHECK_AT_LEAST(left, (found < 4 ? found : 4));
        most = left > most ? left : most;
        kept += left;
        for (uint32_t i = 0; i < found; i++) {
            if (at < left && candidate_compare(&first[i].key, &contacts[at].key) == 0) {
                at++;
            } else {
                dropped++;
                CHECK_EQ(first[i].key.kind, CANDIDATE_EDGE_EDGE);
                /* a neighbour that it stood between may be gone, too */
                CHECK(hardly_stands_out(&first[i], left, 2));
            }
        }
        CHECK_EQ(at, left);
    }
    CHECK_MORE(dropped, CLEAR_CASES);
    CHECK_MORE(kept, dropped);
    CHECK_MORE(most, 4);
}

/* Four corners of a square, and a crossing in the middle of a side. */
static void square(int32_t out_q22)
{
    static const int32_t side = 1 << 21;
    const int32_t at[5][2] = {
        {-side, -side}, {side, -side}, {side, side}, {-side, side}, {0, -side - out_q22}};

    box_over_plane(300);
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 4);
    contacts[4] = contacts[3];
    contacts[4].key.kind = CANDIDATE_EDGE_EDGE;
    for (int i = 0; i < 5; i++) {
        int shift = contact_arm_bits(&bodies[0]) - 22;

        contacts[i].side[0].arm_q30[0] = (int32_t)carom_shl(at[i][0], shift);
        contacts[i].side[0].arm_q30[1] = (int32_t)carom_shl(at[i][1], shift);
    }
}

static void test_thin_keeps(void)
{
    carom_v3_q40 drift = {{0, 0, 1}};
    const int32_t side = 1 << 22;

    square(side / 40);
    CHECK_EQ(contact_thin(contacts, 5), 4);
    square(0);
    CHECK_EQ(contact_thin(contacts, 5), 4);
    square(side / 25); /* it stands out */
    CHECK_EQ(contact_thin(contacts, 5), 5);
    square(side / 40); /* it is nearer than both */
    contacts[4].gap_q22 -= 100;
    CHECK_EQ(contact_thin(contacts, 5), 5);
    square(side / 40); /* its feature is a vertex */
    contacts[4].key.kind = contacts[3].key.kind;
    CHECK_EQ(contact_thin(contacts, 5), 5);
    square(side / 40); /* it is on another face */
    contacts[4].normal.c[0] += 1 << 21;
    CHECK_EQ(contact_thin(contacts, 5), 5);
    square(side / 40); /* the surface moves */
    contacts[4].drift = &drift;
    CHECK_EQ(contact_thin(contacts, 5), 5);
    square(side / 40); /* four hold a face */
    contacts[3] = contacts[4];
    CHECK_EQ(contact_thin(contacts, 4), 4);
}

static void test_full(void)
{
    box_over_plane(300);
    pool.size = 4;
    CHECK(find(700, 0));
    CHECK_EQ(pool.used, 4);
    CHECK_EQ(pool.refused, 0);
    pool.size = 3;
    CHECK(!find(700, 0));
    CHECK_EQ(pool.used, 3);
    CHECK_AT_LEAST(pool.refused, 1);
    CHECK(in_order());
    /* a pair that is no contact needs no place */
    pool.size = 0;
    CHECK(find(299, 0));
}

/* The edge of a shape whose ends have these coordinates along two axes, in quanta. */
static uint32_t edge_at(const struct shape *s, int first, int at_first, int second, int at_second,
                        uint32_t after)
{
    for (uint32_t i = after; i < s->mesh.edge_count; i++) {
        const uint16_t *v = s->mesh.edges[i].vertex;

        if (s->vertices[v[0]][first] == at_first && s->vertices[v[1]][first] == at_first &&
            s->vertices[v[0]][second] == at_second && s->vertices[v[1]][second] == at_second) {
            return i;
        }
    }
    CHECK(false);
    return 0;
}

/*
 * The hit of the event is among the contacts, once. A lower edge of the box crosses the middle of
 * the plane, where two edges of the plane end: two hits at one place.
 */
static void test_force(void)
{
    struct boyse_hit hit;
    const struct contact *c = &contacts[4];
    int32_t skin;

    box_over_plane(300);
    states[0].position.c[0] = (int64_t)1 << 31;
    states[0].position.c[1] = (int64_t)1 << 28;
    place();
    skin = bodies[0].def.skin_q22;
    memset(&hit, 0, sizeof hit);
    hit.touch.normal.c[2] = CAROM_ONE_Q30;
    CHECK(find(700, 0));
    contact_merge(&list);
    CHECK_EQ(pool.used, 4);
    /* a corner that was found already, by its key; the same corner on another face */
    hit.candidate = contacts[2].key;
    CHECK(contact_force(&list, &pair, &hit));
    CHECK_EQ(pool.used, 4);
    /* that face is nearly as steep: the contact now belongs to it, with the same gap */
    hit.candidate.j ^= 1;
    hit.touch.normal.c[0] = CAROM_ONE_Q30 / 100;
    CHECK(contact_force(&list, &pair, &hit));
    CHECK_EQ(pool.used, 4);
    CHECK(in_order());
    CHECK_EQ(candidate_compare(&contacts[2].key, &hit.candidate), 0);
    CHECK_EQ(contacts[2].normal.c[0], CAROM_ONE_Q30 / 100);
    CHECK_EQ(contacts[2].gap_q22, contacts[3].gap_q22 < skin / 2 ? contacts[3].gap_q22 : skin / 2);
    hit.touch.normal.c[0] = 0;
    /* a new place: the box's centre is 1/2 and 1/16 from the crossing */
    hit.candidate =
        (struct candidate){0, CANDIDATE_EDGE_EDGE, edge_at(&shape_a, 0, -2048, 2, -600, 0),
                           edge_at(&shape_b, 1, 0, 2, 0, 0)};
    CHECK(contact_force(&list, &pair, &hit));
    CHECK_EQ(pool.used, 5);
    CHECK(in_order());
    CHECK_EQ(c->key.kind, CANDIDATE_EDGE_EDGE);
    CHECK_EQ(c->gap_q22, skin / 2);
    CHECK_EQ(contact_arm(c).c[0], -(1 << 21));
    CHECK_EQ(contact_arm(c).c[1], -(1 << 18));
    CHECK_NEAR(contact_arm(c).c[2], -600 * 1024 - 150, 1);
    /* the unit of length is 1, the power of two above the radius */
    CHECK_EQ(bodies[0].def.unit_bits, 22);
    CHECK_NEAR(c->side[0].arm_q30[0], -(1 << 29), 2);
    CHECK_NEAR(c->side[0].arm_q30[1], -(1 << 26), 2);
    CHECK_NEAR(c->side[0].arm_q30[2], -(600 * 1024 + 150) * 256, 2);
    CHECK_NEAR(contact_point(c).c[0], 0, 2);
    CHECK_NEAR(contact_point(c).c[1], 0, 2);
    CHECK_NEAR(contact_point(c).c[2], 150 * 1024, 2);
    /* the same place and normal, by other features */
    hit.candidate.j = edge_at(&shape_b, 1, 0, 2, 0, hit.candidate.j + 1);
    CHECK(contact_force(&list, &pair, &hit));
    CHECK_EQ(pool.used, 5);
    /* the same place with another normal needs room */
    hit.touch.normal = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    pool.size = 5;
    CHECK(!contact_force(&list, &pair, &hit));
    pool.size = CONTACTS;
    CHECK(contact_force(&list, &pair, &hit));
    CHECK_EQ(pool.used, 6);
    CHECK(in_order());
    CHECK(contacts[4].normal.c[1] == CAROM_ONE_Q30 || contacts[5].normal.c[1] == CAROM_ONE_Q30);
}

/* ------------------------------------------------------------- indeterminate */

/* The smallest rise along n of the edges that leave a vertex; n is in world axes. */
static double least_rise(const struct shape *s, const struct body *b, uint32_t v, const double n[3])
{
    double least = 1;

    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        for (int k = 0; k < 9; k++) {
            uint16_t other = s->faces[f][k % 3];
            int32_t d[3];
            double e[3];

            if (s->faces[f][k / 3] != v || other == v) {
                continue;
            }
            for (int i = 0; i < 3; i++) {
                d[i] = s->vertices[other][i] - s->vertices[v][i];
            }
            carom_rotate(d, &b->path.start.r, d);
            for (int i = 0; i < 3; i++) {
                e[i] = d[i];
            }
            least =
                real_dot(e, n) / real_length(e) < least ? real_dot(e, n) / real_length(e) : least;
        }
    }
    return least;
}

/* Along each normal, neither body leans into the other; all contacts are at the tip. */
static void check_normals(uint32_t vertex_a, int32_t reach)
{
    CHECK_AT_LEAST(pool.used, 1);
    for (uint32_t i = 0; i < pool.used; i++) {
        double n[3];

        for (int k = 0; k < 3; k++) {
            n[k] = real(contacts[i].normal.c[k], 30);
            CHECK_NEAR(contact_point(&contacts[i]).c[k], 0, (int64_t)reach << 10);
        }
        CHECK_MORE(n[2], 0);
        CHECK_AT_LEAST(least_rise(&shape_a, &bodies[0], vertex_a, n), -0.03);
        CHECK_NEAR(contacts[i].gap_q22, 0, 8);
    }
}

/* Vertex 0 of a cube points down, along the diagonal, in the origin. */
static void corner_down(void)
{
    double cosine = real_sqrt((1 + real_sqrt(1. / 3)) / 2);
    double sine = real_sqrt((1 - real_sqrt(1. / 3)) / 4);

    shape_box(&shape_a, 12, 2048, 2048, 2048);
    begin();
    states[0].rotation.c[0] = (int32_t)real_round(cosine * CAROM_ONE_Q30);
    states[0].rotation.c[1] = (int32_t)real_round(sine * CAROM_ONE_Q30);
    states[0].rotation.c[2] = -states[0].rotation.c[1];
    body_normalise(&states[0].rotation);
    states[0].position.c[2] = real_round(real_sqrt(3) / 4 * real_power2(32));
}

static void test_vertex_on_vertex(void)
{
    /* on the tip of a pyramid, in the middle of a field whose other heights are all 0 */
    shape_field(&shape_b, 12, 2, 2048, 0, 0);
    shape_b.vertices[4][2] = 1024;
    CHECK_EQ(carom_mesh_build(&shape_b.mesh, &shape_b.raw, shape_b.block, sizeof shape_b.block),
             CAROM_OK);
    corner_down();
    states[1].position.c[2] = -((int64_t)1 << 30);
    place();
    CHECK(find(300, 0));
    check_normals(0, 300);
    CHECK_AT_LEAST(pool.used, 3); /* a cone of normals: at least its three corners */
    contact_merge(&list);
    check_normals(0, 300);
    for (uint32_t i = 0; i < pool.used; i++) {
        double back[3];

        for (int k = 0; k < 3; k++) {
            back[k] = -real(contacts[i].normal.c[k], 30);
        }
        CHECK_AT_LEAST(least_rise(&shape_b, &bodies[1], 4, back), -0.03);
    }
}

static void test_vertex_on_edge(void)
{
    /* on a ridge along y, in the middle of a face's edge */
    shape_field(&shape_b, 12, 2, 2048, 0, 0);
    for (int y = 0; y < 3; y++) {
        shape_b.vertices[3 * y + 1][2] = 1024;
    }
    CHECK_EQ(carom_mesh_build(&shape_b.mesh, &shape_b.raw, shape_b.block, sizeof shape_b.block),
             CAROM_OK);
    corner_down();
    states[1].position.c[1] = (int64_t)1 << 30;
    states[1].position.c[2] = -((int64_t)1 << 30);
    place();
    CHECK(find(300, 0));
    check_normals(0, 300);
    contact_merge(&list);
    check_normals(0, 300);
    CHECK_EQ(pool.used, 2); /* left and right of the ridge, and perpendicular to it */
    for (uint32_t i = 0; i < pool.used; i++) {
        CHECK_NEAR(contacts[i].normal.c[1], 0, 4);
    }
}

/* The product of two coefficients of friction is limited as each of them is. */
static void test_product(void)
{
    const struct contact_list mixed = {.friction_rule = CAROM_PRODUCT};

    CHECK_EQ(contact_mix_friction(&mixed, 1 << 15, 1 << 15), 1 << 14);
    CHECK_EQ(contact_mix_friction(&mixed, 2 << 16, 2 << 16), CAROM_MU_MAX_Q16);
    CHECK_EQ(contact_mix_friction(&mixed, 3 << 16, 2 << 16), CAROM_MU_MAX_Q16);
}

const struct test tests_contact[] = {
    {"contact/flat", test_flat},
    {"contact/tilted", test_tilted},
    {"contact/edge_on_face", test_edge_on_face},
    {"contact/crossing_edges", test_crossing_edges},
    {"contact/margin", test_margin},
    {"contact/order", test_order},
    {"contact/doubt", test_doubt},
    {"contact/clear", test_clear},
    {"contact/merge_near", test_merge_near},
    {"contact/merge", test_merge},
    {"contact/thin", test_thin},
    {"contact/thin_keeps", test_thin_keeps},
    {"contact/full", test_full},
    {"contact/force", test_force},
    {"contact/vertex_on_vertex", test_vertex_on_vertex},
    {"contact/vertex_on_edge", test_vertex_on_edge},
    {"contact/product", test_product},
    {0},
};

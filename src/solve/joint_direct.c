/* SPDX-License-Identifier: MIT */
/*
 * Solve all held rows of an island's joints at once: A x = the velocities that they lack, A_rs the
 * change of V of row r by an impulse along row s. A is symmetric, positive definite and mostly 0:
 * joints couple only where they share a body. Cholesky's factor C, A = C C^T, is kept by rows, each
 * from the first joint that shares a body on, so that a chain takes six numbers a row. With a
 * diagonal near 1 no entry of C is above 1.
 *
 * If the room is too small joints are swept one by one.
 */
#include "joint_parts.h"

/*
 * A row that repeats rows before it, as in loops or two joints between the same bodies, has a pivot
 * of nothing but rounding. It gets no impulse of its own; dividing by such a pivot would give
 * impulses without measure.
 *
 * That is a pivot of at most PIVOT_MIN_Q60. If the row is the sum of rows before it times y, the
 * entries of C, rounded to q30, leave a pivot of roundings times 1 and y. Roundings of either sign
 * add up to some 2^-31 times 1 plus the sum of y^2; 2^-PIVOT_NOISE_BITS leaves room. A pivot above
 * PIVOT_SURE_Q60 is sure without y.
 */
#define PIVOT_MIN_Q60    ((int64_t)1 << (60 - 24))
#define PIVOT_NOISE_BITS 28
#define PIVOT_SURE_Q60   ((int64_t)1 << (60 - 10))
/*
 * The square of the length of a row of C, which is at most 1 but for rounding. Where A is far from
 * what it should be, as bodies spin many times a frame, entries beyond this are left out: two rows
 * have a product below 2^63 by the inequality of Cauchy and Schwarz.
 */
#define LENGTH2_MAX_Q60 ((uint64_t)4 << 60)

static struct joint *next_of(const struct rest *r, const struct joint *j)
{
    return j->next == 0 ? NULL : &r->joints.joints[j->next - 1];
}

static struct joint *first_of(const struct rest *r)
{
    CAROM_ASSERT(rest_has_joints(r));
    return &r->joints.joints[r->joints.first - 1];
}

static bool shares_body(const struct joint_work *a, const struct joint_work *b)
{
    for (int s = 0; s < 2; s++) {
        const struct body *own = a->lever[s].body;

        if (own && (own == b->lever[0].body || own == b->lever[1].body)) {
            return true;
        }
    }
    return false;
}

/*
 * Set the place of each row, and the first row that it couples to. Returns false if the room is too
 * small.
 */
static bool lay_out(struct rest *r)
{
    uint32_t place = 0, used = 0;

    for (struct joint *j = first_of(r); j; j = next_of(r, j)) {
        struct joint_work *work = &j->work;
        uint32_t first = place;

        work->row_at = (uint16_t)place;
        for (struct joint *k = first_of(r); k != j && first == place; k = next_of(r, k)) {
            first = shares_body(&k->work, work) ? k->work.row_at : place;
        }
        for (int i = 0; i < work->held; i++, place++) {
            struct joint_row *row = &r->joints.rows[place];

            row->first = (uint16_t)first;
            row->start = used;
            used += place - first;
        }
    }
    return used <= r->joints.room_size;
}

/* Sum of products of rows i and k, from the first column of both up to `end`. */
static int64_t product_q60(const struct rest *r, const struct joint_row *i,
                           const struct joint_row *k, uint32_t end)
{
    uint32_t from = i->first > k->first ? i->first : k->first;
    const int32_t *a = &r->joints.room[i->start + from - i->first];
    const int32_t *b = &r->joints.room[k->start + from - k->first];
    int64_t sum = 0;

    for (uint32_t n = from; n < end; n++) {
        sum += (int64_t)*a++ * *b++;
    }
    return sum;
}

/* Row i of C^T x = z, x in place of z; the rows after it are done. */
static inline void substitute_back(struct rest *r, uint32_t i)
{
    struct joint_row *rows = r->joints.rows;
    const int32_t *c = &r->joints.room[rows[i].start];

    rows[i].x = fix_mul_scaled(rows[i].x, rows[i].inverse);
    for (uint32_t k = rows[i].first; k < i; k++) {
        rows[k].x -= fix_mul_q30(rows[i].x, *c++);
    }
}

/*
 * True if the pivot of the row at a place is but rounding; the row's other entries of C are set. It
 * stops as soon as y suffices, at 2^8 at most, so no y outgrows its bits.
 */
static bool is_noise(struct rest *r, uint32_t place, int64_t pivot_q60)
{
    struct joint_row *rows = r->joints.rows;
    const struct joint_row *row = &rows[place];
    int64_t sum_q30 = CAROM_ONE_Q30, most_q30 = pivot_q60 >> (30 - PIVOT_NOISE_BITS);

    if (pivot_q60 <= PIVOT_MIN_Q60 || pivot_q60 > PIVOT_SURE_Q60) {
        return pivot_q60 <= PIVOT_MIN_Q60;
    }
    for (uint32_t n = 0; n < place; n++) {
        rows[n].x = n < row->first ? 0 : r->joints.room[row->start + n - row->first];
    }
    for (uint32_t n = place; n-- > 0 && sum_q30 <= most_q30;) {
        int64_t y_q15;

        substitute_back(r, n);
        y_q15 = rest_within(rows[n].x >> 15, INT32_MAX);
        sum_q30 += y_q15 * y_q15;
    }
    return sum_q30 > most_q30;
}

/*
 * The entry of C in row i of joint j, in the column of row n of joint k. The entries before it are
 * done.
 */
static int32_t entry_of(const struct rest *r, const struct joint_work *j, int i,
                        const struct joint_work *k, int n)
{
    const struct joint_row *row = &r->joints.rows[j->row_at + i];
    const struct joint_row *other = &r->joints.rows[k->row_at + n];
    int64_t left_q60 =
        joint_entry(j, i, k, n, 60) - product_q60(r, row, other, (uint32_t)(k->row_at + n));

    return rest_within(fix_mul_scaled(left_q60, other->inverse) >> 30, CAROM_ONE_Q30);
}

/* Factor row i of joint j; the rows before it are done. */
static void factor_row(struct rest *r, const struct joint *j, int i)
{
    const struct joint_work *work = &j->work;
    uint32_t place = work->row_at + (uint32_t)i;
    struct joint_row *row = &r->joints.rows[place];
    int32_t *c = &r->joints.room[row->start];
    uint64_t length2_q60 = 0;
    int64_t pivot_q60;

    for (struct joint *k = first_of(r);; k = next_of(r, k)) {
        int end = k == j ? i : k->work.held;

        for (int n = 0; n < end && k->work.row_at >= row->first; n++) {
            int32_t entry = entry_of(r, work, i, &k->work, n);
            uint64_t square_q60 = (uint64_t)((int64_t)entry * entry);

            if (length2_q60 + square_q60 > LENGTH2_MAX_Q60) {
                entry = 0;
                square_q60 = 0;
            }
            length2_q60 += square_q60;
            c[k->work.row_at + n - row->first] = entry;
        }
        if (k == j) {
            break;
        }
    }
    pivot_q60 = joint_entry(work, i, work, i, 60) - (int64_t)length2_q60;
    row->inverse = (struct fix_scaled){0, 0};
    if (!is_noise(r, place, pivot_q60)) {
        row->inverse = fix_scaled_inverse(fix_scale((int64_t)fix_sqrt((uint64_t)pivot_q60), 30));
    }
}

bool joint_factor(struct rest *r)
{
    if (!lay_out(r)) {
        return false;
    }
    for (struct joint *j = first_of(r); j; j = next_of(r, j)) {
        for (int i = 0; i < j->work.held; i++) {
            factor_row(r, j, i);
        }
    }
    return true;
}

/* Solve C C^T x = the rows' x, in place. */
static void substitute(struct rest *r, uint32_t n)
{
    struct joint_row *rows = r->joints.rows;

    for (uint32_t i = 0; i < n; i++) {
        const int32_t *c = &r->joints.room[rows[i].start];
        int64_t sum = rows[i].x;

        for (uint32_t k = rows[i].first; k < i; k++) {
            sum -= fix_mul_q30(rows[k].x, *c++);
        }
        rows[i].x = fix_mul_scaled(sum, rows[i].inverse);
    }
    for (uint32_t i = n; i-- > 0;) {
        substitute_back(r, i);
    }
}

/* The changes of a joint's impulses by the solution. */
static void changes_of(const struct rest *r, const struct joint *j, int64_t change[JOINT_ROWS])
{
    for (int i = 0; i < JOINT_ROWS; i++) {
        change[i] = i < j->work.held ? r->joints.rows[j->work.row_at + i].x : 0;
    }
}

/* The effect on a body of all impulses, or of their changes. */
static struct joint_sum sum_of(const struct rest *r, const struct body *b, bool changes)
{
    struct joint_sum sum = {{0, 0, 0}, {0, 0, 0}};

    for (struct joint *j = first_of(r); j; j = next_of(r, j)) {
        for (int s = 0; s < 2; s++) {
            int64_t change[JOINT_ROWS];

            if (j->work.lever[s].body != b) {
                continue;
            }
            changes_of(r, j, change);
            joint_add_effect(&j->work, s, changes ? change : j->work.impulse, &sum);
        }
    }
    return sum;
}

void joint_sum_up(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        struct body_path *in = body_solve(&r->bodies[i]);
        struct joint_sum sum = sum_of(r, &r->bodies[i], false);
        int64_t dv[3], du[3];

        joint_round_sum(&r->bodies[i], &sum, dv, du);
        for (int k = 0; k < 3; k++) {
            in->wide_dv[k] += dv[k];
            in->wide_du[k] += du[k];
        }
    }
}

static void push_all(struct rest *r)
{
    for (struct joint *j = first_of(r); j; j = next_of(r, j)) {
        int64_t change[JOINT_ROWS];

        changes_of(r, j, change);
        joint_note(&j->work, change);
    }
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        struct joint_sum sum = sum_of(r, &r->bodies[i], true);

        joint_move(&r->bodies[i], &sum);
    }
}

int64_t joint_solve_held(struct rest *r, int32_t quiet)
{
    struct joint_row *rows = r->joints.rows;
    int32_t moved = 0;
    uint32_t n = 0;

    for (struct joint *j = first_of(r); j; j = next_of(r, j)) {
        for (int i = 0; i < j->work.held; i++, n++) {
            int32_t lack = -joint_present(&j->work, i);

            moved = rows[n].inverse.m == 0 ? moved : fix_larger(moved, fix_abs32(lack));
            rows[n].x = carom_shl(lack, JOINT_FINE_BITS);
        }
    }
    if (moved < quiet) {
        return 0;
    }
    substitute(r, n);
    push_all(r);
    return moved;
}

/* SPDX-License-Identifier: MIT */
/*
 * host_first_hit - the first hit of random motions, judged by the oracle of first_hit.h: 10,000
 * motions of small meshes, with one mover or two, and 50 of the head against itself.
 *
 *   host_first_hit.elf            a fiftieth of the motions; prints TAP
 *   host_first_hit.elf all        all of them in two processes; prints the rows of out/oracle.csv
 *   host_first_hit.elf ROW N      one motion of one row (numbers from 0), in full
 *   host_first_hit.elf special FROM COUNT   special positions alone
 *
 * A row of the table stands for the motions of a pair of meshes:
 *
 *   mesh_a, mesh_b  a moves, b stands still or moves as well
 *   movers          1 or 2
 *   motions, hits   how many, and how many of them hit
 *   aside           at the hit the features are the event gap apart along N, but N does not yet lead
 *                   from one to the other: a body that comes in flat stops over or beside an edge
 *   different       the pipeline's hit is not, bit for bit, the first hit of all feature pairs
 *   missed          faces cross before the hit, or without one
 *   early           at the hit they are farther apart along N, or never meet
 *   late            they are nearer, although they were farther apart before
 *   crossed         faces cross where the step goes to
 *
 * The last five must be 0. Each motion that counts there is named on standard error.
 */
#define _DEFAULT_SOURCE /* fork, mmap */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lib/first_hit.h"
#include "lib/lab.h"
#include "lib/special.h"

#define MOTIONS      160 /* motions of a pair of meshes */
#define HEAD_MOTIONS 25
#define SHARE        50 /* make test runs one motion of so many */
#define PROCESSES    2
/* Motions that end in special positions; a fourth of them hit in the first frame. */
#define SPECIAL_CASES  100000
#define SPECIAL_STRIDE 50

/* ---------------------------------------------------------------------- rows */

struct row {
    int mesh_a, mesh_b, movers;
    long motions, hits, aside, different, missed, early, late, crossed;
};

#define ROWS_MAX 80
struct table {
    struct row rows[ROWS_MAX];
    int count;
};

static void add_row(struct table *t, int mesh_a, int mesh_b, int movers)
{
    t->rows[t->count++] = (struct row){.mesh_a = mesh_a, .mesh_b = mesh_b, .movers = movers};
}

/*
 * Every pair of meshes with one mover and, once for each pair, with two; then the head against
 * itself.
 */
static void make_rows(struct table *t)
{
    for (int a = 0; a < FIRST_HIT_SOLIDS; a++) {
        for (int b = 0; b <= FIRST_HIT_FIELD; b++) {
            add_row(t, a, b, 1);
        }
    }
    for (int a = 0; a < FIRST_HIT_SOLIDS; a++) {
        for (int b = 0; b <= a; b++) {
            add_row(t, a, b, 2);
        }
    }
    add_row(t, FIRST_HIT_HEAD1876, FIRST_HIT_HEAD1876, 1);
    add_row(t, FIRST_HIT_HEAD1876, FIRST_HIT_HEAD1876, 2);
}

static int motions_of(const struct row *row)
{
    return row->mesh_a == FIRST_HIT_HEAD1876 ? HEAD_MOTIONS : MOTIONS;
}

static void tell(int row, int n, const struct first_hit_verdict *v)
{
    fprintf(stderr,
            "row %d motion %d:%s%s%s%s%s%s t %.9f kind %d i %u j %u gap %.9f of %.9f, meet %.9f, "
            "crossing %.9f, left %.9f\n",
            row, n, v->hit ? " hit" : "", v->different ? " different" : "",
            v->missed ? " missed" : "", v->early ? " early" : "", v->late ? " late" : "",
            v->crossed ? " crossed" : "", lab_double(v->t_q30, 30), v->candidate.kind,
            (unsigned)v->candidate.i, (unsigned)v->candidate.j, v->gap, v->event_gap, v->meet,
            v->crossing, v->left);
}

static void count(struct row *row, const struct first_hit_verdict *v)
{
    row->motions++;
    row->hits += v->hit;
    row->aside += v->aside;
    row->different += v->different;
    row->missed += v->missed;
    row->early += v->early;
    row->late += v->late;
    row->crossed += v->crossed;
}

static bool is_bad(const struct first_hit_verdict *v)
{
    return v->different || v->missed || v->early || v->late || v->crossed;
}

static void run(struct row *row, int number, int n)
{
    struct first_hit_motion motion;
    struct first_hit_verdict verdict;

    first_hit_make_motion(&motion, row->mesh_a, row->mesh_b, row->movers, n);
    first_hit_judge(&motion, &verdict);
    count(row, &verdict);
    if (is_bad(&verdict)) {
        tell(number, n, &verdict);
    }
}

/* Run every `every`-th motion of all rows, beginning with number `first`. */
static void run_share(struct table *t, int first, int every)
{
    for (int r = 0; r < t->count; r++) {
        int motions = motions_of(&t->rows[r]), step = every < motions ? every : motions;

        for (int n = (first + r) % step; n < motions; n += step) {
            run(&t->rows[r], r, n);
        }
    }
}

/*
 * Run every `every`-th of the special positions (special.h) that are reached within the first
 * frame, beginning with number `first`. They show whether candidates that matter only in special
 * positions are gathered and tested.
 */
static void run_special(struct row *row, long first, long every, long until, bool told)
{
    for (long number = first; number < until; number += every) {
        static struct special s;
        struct first_hit_mesh mesh[2];
        struct first_hit_motion motion;
        struct first_hit_verdict verdict;
        int lower;

        special_make(&s, number);
        if (s.time > 0.95) {
            continue;
        }
        lower = s.def[0].stationary || (!s.def[1].stationary && !s.upper_first) ? 0 : 1;
        memset(&motion, 0, sizeof motion);
        memset(mesh, 0, sizeof mesh);
        for (int i = 0; i < 2; i++) {
            int shape = lower == 0 ? i : 1 - i;

            mesh[i].mesh = s.shape[shape].mesh;
            first_hit_make_mesh(&mesh[i], "special", 0.05 * s.size[shape]);
            motion.mesh[i] = &mesh[i];
            motion.def[i] = s.def[shape];
        }
        motion.gravity = s.gravity;
        if (!first_hit_overlap(&motion)) {
            first_hit_judge(&motion, &verdict);
            count(row, &verdict);
            if (told || is_bad(&verdict)) {
                tell(-1, (int)number, &verdict);
            }
        }
        for (int i = 0; i < 2; i++) {
            first_hit_free_mesh(&mesh[i]);
        }
    }
}

static bool fails(const struct row *row)
{
    return row->different || row->missed || row->early || row->late || row->crossed ||
           row->hits == 0;
}

static void add_up(struct row *sum, const struct row *row)
{
    sum->motions += row->motions;
    sum->hits += row->hits;
    sum->aside += row->aside;
    sum->different += row->different;
    sum->missed += row->missed;
    sum->early += row->early;
    sum->late += row->late;
    sum->crossed += row->crossed;
}

/* Run all motions, divided among processes that count in shared memory. */
static int run_all(struct table *table)
{
    struct table *parts = mmap(NULL, PROCESSES * sizeof *parts, PROT_READ | PROT_WRITE,
                               MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    bool failed = parts == MAP_FAILED;
    int status;

    for (int i = 0; i < PROCESSES && !failed; i++) {
        pid_t child = fork();

        if (child == 0) {
            parts[i] = *table;
            run_share(&parts[i], i, PROCESSES);
            _exit(0);
        }
        failed = child < 0;
    }
    while (wait(&status) >= 0) {
        failed |= status != 0;
    }
    puts("mesh_a,mesh_b,movers,motions,hits,aside,different,missed,early,late,crossed");
    for (int r = 0; r < table->count && !failed; r++) {
        struct row *row = &table->rows[r];

        for (int i = 0; i < PROCESSES; i++) {
            add_up(row, &parts[i].rows[r]);
        }
        printf("%s,%s,%d,%ld,%ld,%ld,%ld,%ld,%ld,%ld,%ld\n", first_hit_meshes[0][row->mesh_a].name,
               first_hit_meshes[0][row->mesh_b].name, row->movers, row->motions, row->hits,
               row->aside, row->different, row->missed, row->early, row->late, row->crossed);
    }
    for (int r = 0; r < table->count; r++) {
        failed |= fails(&table->rows[r]);
    }
    return failed;
}

static void report_row(const struct row *sum, const char *name)
{
    lab_report(!fails(sum), name,
               "%ld motions, %ld hits, %ld aside, %ld different, %ld missed, %ld early, %ld late, "
               "%ld crossed",
               sum->motions, sum->hits, sum->aside, sum->different, sum->missed, sum->early,
               sum->late, sum->crossed);
}

/* Report the rows with so many movers as one line of TAP. */
static void report(const struct table *table, const char *name, int movers)
{
    struct row sum = {0};

    for (int r = 0; r < table->count; r++) {
        if (table->rows[r].movers == movers) {
            add_up(&sum, &table->rows[r]);
        }
    }
    report_row(&sum, name);
}

int main(int argc, char **argv)
{
    static struct table table;
    struct row special = {.movers = 2};

    first_hit_make_meshes();
    make_rows(&table);
    if (argc == 2 && strcmp(argv[1], "all") == 0) {
        return run_all(&table);
    }
    if (argc == 4) {
        struct row row = {.movers = 2};

        run_special(&row, atol(argv[2]), 1, atol(argv[2]) + atol(argv[3]), atol(argv[3]) == 1);
        report_row(&row, "first_hit/special");
        return lab_finish();
    }
    if (argc == 3) {
        int row = atoi(argv[1]), n = atoi(argv[2]);
        struct first_hit_motion motion;
        struct first_hit_verdict verdict;

        first_hit_make_motion(&motion, table.rows[row].mesh_a, table.rows[row].mesh_b,
                              table.rows[row].movers, n);
        first_hit_judge(&motion, &verdict);
        tell(row, n, &verdict);
        return 0;
    }
    run_share(&table, 0, SHARE);
    report(&table, "first_hit/one_mover", 1);
    report(&table, "first_hit/two_movers", 2);
    run_special(&special, 0, SPECIAL_STRIDE, SPECIAL_CASES, false);
    report_row(&special, "first_hit/special");
    return lab_finish();
}

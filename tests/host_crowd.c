/* SPDX-License-Identifier: MIT */
/*
 * host_crowd - two and many moving bodies: impacts against the analytic answers, Newton's cradle,
 * stacks that stand, a heap of 32 bodies poured on the field. The scenes of many bodies run once
 * as they are, and once with a single sub-step a frame. A single sub-step may cost time, but may
 * cause neither crossings nor energy.
 *
 *   host_crowd        what make test runs
 *   host_crowd long   stacks asleep for 10,000 frames, every impact and more heaps
 *   host_crowd PART   the tests whose names contain PART
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/crowd.h"
#include "lib/real.h"

static const double restitutions[] = {0, 0.5, 1};

static const struct oracle_body *now(const struct crowd *crowd, int body)
{
    return &crowd->bodies[body].now.body;
}

/* ---------------------------------------------------------------------- head-on */

/*
 * Two boxes meet face on face, in line. Afterwards they have the velocities of two colliding
 * points, and nothing turns. The whole scene is turned, so that no axis is special.
 */
static void test_head_on(void)
{
    static const double masses[][2] = {{1, 1}, {1, 3}, {50, 0.5}, {1000, 1}, {1, 1000}};
    struct crowd *crowd = crowd_new();
    int mesh[2] = {crowd_box(crowd, 1, 0.6, 0.3), crowd_box(crowd, 0.5, 0.7, 0.9)};
    double worst = 0, worst_spin = 0;
    long runs = 0, missed = 0, crossed = 0;

    crowd->config.gravity = (carom_v3_q40){{0}};
    crowd->config.sleep = false;
    for (int n = 0; n < 5 * 3 * 2 * 2; n++) {
        const double *mass = masses[n % 5], e = restitutions[n / 5 % 3];
        const double speed[2] = {0.1, n / 15 % 2 ? -0.03 : 0};
        const carom_quat_q30 turn = lab_turn(1, 2, 3, n / 30 % 2 ? 0.7 : 0);
        struct crowd_tally tally = {0};
        double along[3], x[3] = {1, 0, 0}, total = mass[0] + mass[1], after[2];

        crowd_clear(crowd);
        lab_rotate(along, &turn, x);
        for (int i = 0; i < 2; i++) {
            struct carom_body_def *def = crowd_body(crowd, mesh[i]);
            double side = i == 0 ? -0.75 : 0.75, velocity[3], still[3] = {0};

            for (int k = 0; k < 3; k++) {
                velocity[k] = speed[i] * along[k];
            }
            def->rotation = turn;
            crowd_place(def, side * along[0], side * along[1], side * along[2]);
            crowd_move(def, velocity, still);
            def->mass_q20 = (uint32_t)lab_fixed(mass[i], 20);
        }
        crowd_surface(crowd, e, 0.5);
        lab_expect(crowd_start(crowd), "head-on");
        while (tally.frames < 20) {
            lab_expect(crowd_step(crowd, &tally), "head-on");
        }
        for (int i = 0; i < 2; i++) {
            double gone[3];

            after[i] = (mass[0] * speed[0] + mass[1] * speed[1] -
                        (i == 0 ? 1 : -1) * mass[1 - i] * e * (speed[0] - speed[1])) /
                       total;
            for (int k = 0; k < 3; k++) {
                gone[k] = now(crowd, i)->velocity[k] - after[i] * along[k];
            }
            worst = fmax(worst, real_length(gone) / (speed[0] - speed[1]));
            worst_spin = fmax(worst_spin, real_length(now(crowd, i)->spin) / (speed[0] - speed[1]));
        }
        missed += tally.hits == 0;
        crossed += tally.crossed;
        runs++;
    }
    lab_report(worst <= 1e-6 && worst_spin <= 1e-6 && missed == 0 && crossed == 0, "crowd/head_on",
               "%ld impacts, %ld missed, velocities within %.1e, spins within %.1e of the speed, "
               "%ld frames cross",
               runs, missed, worst, worst_spin, crossed);
    crowd_free(crowd);
}

/* ------------------------------------------------------------------- off-centre */

/* One body of an impact at a known place: its inverse inertia about world axes. */
struct side {
    double mass, arm[3], inverse[3][3];
};

/* The inverse of m R I R^T. Its columns are the cross products of a symmetric matrix's rows. */
static void invert_inertia(struct side *side, const struct oracle_body *body)
{
    const double *i = body->inertia, nowhere[3] = {0};
    const double tensor[3][3] = {{i[0], i[3], i[5]}, {i[3], i[1], i[4]}, {i[5], i[4], i[2]}};
    struct oracle_pose pose = oracle_pose_make(nowhere, body->quaternion, nowhere);
    double world[3][3] = {{0}}, across[3][3], determinant;

    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            for (int c = 0; c < 3; c++) {
                world[a][b] += body->mass * pose.rotation.row[a][c] *
                               real_dot(tensor[c], pose.rotation.row[b]);
            }
        }
    }
    for (int a = 0; a < 3; a++) {
        real_cross(across[a], world[(a + 1) % 3], world[(a + 2) % 3]);
    }
    determinant = real_dot(world[0], across[0]);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            side->inverse[b][a] = across[a][b] / determinant;
        }
    }
    side->mass = body->mass;
}

/* The change of spin that an impulse on the arm gives. */
static void turn_by(double out[3], const struct side *side, const double impulse[3])
{
    double moment[3];

    real_cross(moment, side->arm, impulse);
    for (int k = 0; k < 3; k++) {
        out[k] = real_dot(side->inverse[k], moment);
    }
}

/*
 * Bodies that do not turn meet corner on face or edge on edge, without friction. The impulse is (1
 * + e) V.N / (1/m + 1/m' + turning). The time of the hit and the gap at that time do not matter,
 * because both bodies move along N. They meet at the end of a frame, so the frame is over before
 * they can touch again. Body 1 is a.
 */
static void expect_after(const struct crowd *crowd, const double normal[3], double e,
                         const double on_b[3], double velocity[2][3], double spin[2][3])
{
    struct side side[2];
    double relative[3], unit = 0, impulse[3];

    for (int i = 0; i < 2; i++) {
        const struct oracle_body *body = now(crowd, i);
        double turned[3], lifted[3];

        invert_inertia(&side[i], body);
        for (int k = 0; k < 3; k++) {
            side[i].arm[k] = on_b[k] - body->position[k];
        }
        turn_by(turned, &side[i], normal);
        real_cross(lifted, turned, side[i].arm);
        unit += 1 / body->mass + real_dot(lifted, normal);
    }
    for (int k = 0; k < 3; k++) {
        relative[k] = now(crowd, 1)->velocity[k] - now(crowd, 0)->velocity[k];
    }
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            impulse[k] =
                (i == 1 ? -1 : 1) * (1 + e) * real_dot(relative, normal) / unit * normal[k];
            velocity[i][k] = now(crowd, i)->velocity[k] + impulse[k] / side[i].mass;
        }
        turn_by(spin[i], &side[i], impulse);
    }
}

struct off_centre {
    long runs, missed, crossed;
    double velocity, spin; /* the largest errors, relative */
    int worst;
};

/* The angular momentum about the centre of a body that has this spin in this pose. */
static void spin_momentum(double out[3], const struct oracle_body *body, const double spin[3])
{
    struct side side;
    double across[3][3], determinant;

    invert_inertia(&side, body);
    for (int a = 0; a < 3; a++) {
        real_cross(across[a], side.inverse[(a + 1) % 3], side.inverse[(a + 2) % 3]);
    }
    determinant = real_dot(side.inverse[0], across[0]);
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int a = 0; a < 3; a++) {
            out[k] += across[a][k] * spin[a] / determinant;
        }
    }
}

static void collide(struct crowd *crowd, const int mesh[2], const double mass[2], double e,
                    enum crowd_how how, bool both, uint64_t *random, struct off_centre *sum)
{
    const double speed = 0.1, still[3] = {0};
    struct crowd_tally tally = {0};
    double normal[3], along[3], velocity[2][3], spin[2][3], point[3], hit = speed * 3.99;
    struct oracle_body before[2];
    struct carom_stats stats;

    crowd_clear(crowd);
    for (int i = 0; i < 2; i++) {
        crowd_body(crowd, mesh[i])->mass_q20 = (uint32_t)lab_fixed(mass[i], 20);
    }
    crowd->bodies[0].def.rotation = lab_random_turn(random);
    if (!crowd_meet(crowd, 1, 0, how, hit, 0, random, normal, along, point)) {
        lab_expect(CAROM_ERR_ARGUMENT, "no way to meet");
    }
    for (int i = 0; i < 2; i++) {
        double share = i == 1 ? (both ? 0.6 : 1) : (both ? -0.4 : 0);

        for (int k = 0; k < 3; k++) {
            velocity[i][k] = share * speed * along[k];
        }
        crowd_move(&crowd->bodies[i].def, velocity[i], still);
    }
    crowd_surface(crowd, e, 0);
    lab_expect(crowd_start(crowd), "off-centre");
    expect_after(crowd, normal, e, point, velocity, spin);
    before[0] = *now(crowd, 0);
    before[1] = *now(crowd, 1);
    while (tally.hits == 0 && tally.frames < 10) {
        lab_expect(crowd_step(crowd, &tally), "off-centre");
    }
    lab_expect(carom_stats(crowd->world, &stats), "stats");
    sum->missed += tally.hits != 1 || stats.hits != 1;
    for (int i = 0; i < 2; i++) {
        double wrong[3], wanted[3], found[3], error;

        for (int k = 0; k < 3; k++) {
            wrong[k] = now(crowd, i)->velocity[k] - velocity[i][k];
        }
        error = real_length(wrong) / speed;
        sum->velocity = fmax(sum->velocity, error);
        /* an uneven body's spin changes after the hit, its angular momentum does not */
        spin_momentum(wanted, &before[i], spin[i]);
        spin_momentum(found, now(crowd, i), now(crowd, i)->spin);
        for (int k = 0; k < 3; k++) {
            wrong[k] = found[k] - wanted[k];
        }
        sum->spin = fmax(sum->spin, real_length(wrong) / real_length(wanted));
    }
    sum->crossed += tally.crossed;
    sum->runs++;
}

static void test_off_centre(int each)
{
    static const double masses[][2] = {{1, 1}, {1, 3}, {20, 0.4}, {1, 500}};
    static const char *names[2] = {"crowd/corner_on_face", "crowd/edge_on_edge"};
    struct crowd *crowd = crowd_new();
    const double twice[3] = {2, 2, 2}, one[3] = {1, 1, 1};
    int meshes[4] = {crowd_box(crowd, 1, 0.6, 0.3), crowd_solid(crowd, &lab_tetrahedron, one),
                     crowd_solid(crowd, &lab_l, one), crowd_solid(crowd, &lab_tetrahedron, twice)};
    uint64_t random = 5;

    crowd->config.gravity = (carom_v3_q40){{0}};
    crowd->config.sleep = false;
    for (int how = 0; how < 2; how++) {
        struct off_centre sum = {0};

        for (int n = 0; n < each; n++) {
            int mesh[2] = {meshes[n % 4], meshes[n / 4 % 4]};

            collide(crowd, mesh, masses[n % 3 + n / 7 % 2], restitutions[n % 3],
                    how == 0 ? CROWD_CORNER : CROWD_EDGE, n % 2, &random, &sum);
        }
        lab_report(sum.velocity <= 1e-6 && sum.spin <= 1e-6 && sum.missed == 0 && sum.crossed == 0,
                   names[how],
                   "%ld impacts, %ld missed, velocities within %.1e, angular momenta within %.1e, "
                   "%ld frames cross",
                   sum.runs, sum.missed, sum.velocity, sum.spin, sum.crossed);
    }
    crowd_free(crowd);
}

/* ------------------------------------------------------------------------ cradle */

/*
 * Five bodies in a row, a hundredth of a unit apart. The first comes in, and the last flies off as
 * fast.
 */
static void cradle(int mesh, struct crowd *crowd, uint8_t cap, const char *name)
{
    const double speed = 0.08, still[3] = {0};
    const carom_quat_q30 turn = lab_turn(2, -1, 3, 0.6);
    struct crowd_tally tally = {0};
    double along[3], x[3] = {1, 0, 0}, velocity[3], worst = 0;

    lab_rotate(along, &turn, x);
    crowd_clear(crowd);
    for (int i = 0; i < 5; i++) {
        struct carom_body_def *def = crowd_body(crowd, mesh);
        double place = i * 1.01 - (i == 0);

        for (int k = 0; k < 3; k++) {
            velocity[k] = speed * along[k];
        }
        def->rotation = turn;
        crowd_place(def, place * along[0], place * along[1], place * along[2]);
        crowd_move(def, i == 0 ? velocity : still, still);
    }
    crowd_surface(crowd, 1, 0);
    crowd->config.substep_cap = cap;
    lab_expect(crowd_start(crowd), name);
    while (tally.frames < (cap == 1 ? 60 : 30)) {
        lab_expect(crowd_step(crowd, &tally), name);
    }
    for (int i = 0; i < 5; i++) {
        double wrong[3];

        for (int k = 0; k < 3; k++) {
            wrong[k] = now(crowd, i)->velocity[k] - (i == 4 ? velocity[k] : 0);
        }
        worst = fmax(worst, real_length(wrong) / speed);
        worst = fmax(worst, real_length(now(crowd, i)->spin) / speed);
    }
    lab_report(worst <= 1e-5 && tally.crossed == 0 && tally.rise <= 1 && tally.hits == 4 &&
                   tally.out == 0,
               name,
               "%ld hits, speeds within %.1e, %ld frames cross, energy rises by %.2g of the bound, "
               "%ld capped",
               tally.hits, worst, tally.crossed, tally.rise, tally.capped);
}

static void test_cradle(void)
{
    struct crowd *crowd = crowd_new();
    int box = crowd_box(crowd, 1, 0.6, 0.8), ball = crowd_ball(crowd, 0.5 / cos(acos(-1) / 10));

    crowd->config.gravity = (carom_v3_q40){{0}};
    crowd->config.sleep = false;
    cradle(box, crowd, 0, "crowd/cradle_boxes");
    cradle(ball, crowd, 0, "crowd/cradle_balls");
    cradle(box, crowd, 1, "crowd/cradle_boxes_cap_1");
    cradle(ball, crowd, 1, "crowd/cradle_balls_cap_1");
    crowd_free(crowd);
}

/* ------------------------------------------------------------------------ stacks */

struct stack {
    int boxes;
    bool sleep;
    uint8_t cap;
    long frames;
    double drift; /* allowed drift, units */
};

/*
 * Boxes of 1 x 0.9 x 0.8 units on each other, on a sheet of many triangles. Each is turned a
 * little, and begins one skin above the box below.
 */
static void test_stack(const struct stack *how, const char *name)
{
    struct crowd *crowd = crowd_new();
    int ground = crowd_mesh(crowd, lab_grid()), box = crowd_box(crowd, 1, 0.9, 0.8);
    double skin = crowd->meshes[box].skin, drift = 0;
    struct crowd_tally tally = {0};
    long asleep_at = 0;

    crowd->config.sleep = how->sleep;
    crowd->config.substep_cap = how->cap;
    crowd_body(crowd, ground);
    for (int i = 0; i < how->boxes; i++) {
        struct carom_body_def *def = crowd_body(crowd, box);

        def->rotation = lab_turn(0, 0, 1, 0.1 + 0.05 * i);
        crowd_place(def, 0.01 * (i % 3), -0.01 * (i % 2), (0.8 + skin) * i + 0.4 + skin);
    }
    lab_expect(crowd_start(crowd), name);
    while (tally.frames < how->frames) {
        lab_expect(crowd_step(crowd, &tally), name);
        if (tally.asleep == how->boxes && asleep_at == 0) {
            asleep_at = tally.frames;
        }
    }
    for (int i = 1; i <= how->boxes; i++) {
        double moved[3];

        for (int k = 0; k < 3; k++) {
            moved[k] =
                now(crowd, i)->position[k] - lab_double(crowd->bodies[i].def.position.c[k], 32);
        }
        drift = fmax(drift, real_length(moved));
    }
    lab_report(drift <= how->drift && tally.crossed == 0 && tally.rise <= 1 && tally.out == 0 &&
                   (!how->sleep || tally.asleep == how->boxes),
               name,
               "%ld frames, asleep from %ld on, moved by %.1e, %ld frames cross, energy rises by "
               "%.2g of the bound in frame %ld, %ld capped",
               tally.frames, asleep_at, drift, tally.crossed, tally.rise, tally.rise_frame,
               tally.capped);
    crowd_free(crowd);
}

struct tower {
    bool stands;
    double fastest; /* fastest body at the end, units or radians a frame */
};

/* Ten boxes fall on each other. Each is moved aside from the box below and turned a little. */
static struct tower run_tower(uint64_t seed, struct crowd_tally *tally)
{
    struct crowd *crowd = crowd_new();
    int ground = crowd_box(crowd, 8, 8, 1), box = crowd_box(crowd, 1, 1, 1);
    struct tower end = {true, 0};
    uint64_t state = seed;

    crowd->config.sleep = false;
    crowd_body(crowd, ground)->stationary = true;
    for (int i = 0; i < 10; i++) {
        struct carom_body_def *def = crowd_body(crowd, box);

        def->rotation = lab_turn(lab_random(&state, -1, 1), lab_random(&state, -1, 1),
                                 lab_random(&state, -1, 1), lab_random(&state, 0, 0.04));
        crowd_place(def, lab_random(&state, -0.05, 0.05), lab_random(&state, -0.05, 0.05),
                    1.2 + 1.3 * i);
    }
    lab_expect(crowd_start(crowd), "crowd/towers");
    for (int frame = 0; frame < 800; frame++) {
        lab_expect(crowd_step(crowd, tally), "crowd/towers");
    }
    for (int i = 1; i <= 10; i++) {
        end.fastest = fmax(end.fastest, real_length(now(crowd, i)->velocity));
        end.fastest = fmax(end.fastest, real_length(now(crowd, i)->spin));
        end.stands = end.stands && now(crowd, i)->position[2] > i - 0.1;
    }
    crowd_free(crowd);
    return end;
}

/*
 * A tower sways. It comes to rest or it falls over: one in four may fall, because the towers are
 * built carelessly. It must not sway for ever from what the solves leave over. Gravity gives 2.7e-3
 * a frame.
 */
static void test_towers(void)
{
    struct crowd_tally tally = {0};
    double fastest = 0;
    int stand = 0;

    for (uint64_t seed = 1; seed <= 16; seed++) {
        struct tower end = run_tower(seed, &tally);

        stand += end.stands;
        fastest = end.stands ? fmax(fastest, end.fastest) : fastest;
    }
    lab_report(stand >= 12 && fastest < 1e-4 && tally.crossed == 0, "crowd/towers",
               "%d of 16 stand, the fastest body of theirs at %.1e a frame, %ld frames cross, %ld "
               "capped",
               stand, fastest, tally.crossed, tally.capped);
}

/* -------------------------------------------------------------------------- heap */

#define HEAP 32

/* Walls just outside of the field's rim. A body that leaves the field would fall for ever. */
static void add_kerb(struct crowd *crowd)
{
    const int walls[2] = {crowd_box(crowd, 0.4, 8, 2), crowd_box(crowd, 8, 0.4, 2)};

    for (int i = 0; i < 4; i++) {
        struct carom_body_def *def = crowd_body(crowd, walls[i / 2]);
        double at = i % 2 == 0 ? 4.21 : -4.21;

        def->stationary = true;
        crowd_place(def, i < 2 ? at : 0, i < 2 ? 0 : at, 0.7);
    }
}

/*
 * Boxes, tetrahedra, Ls, balls and two small heads are poured in layers of nine into a hollow of
 * the field. All are asleep within 400 frames, or within 1200 with one sub-step a frame. In other
 * heaps a ball may leave the hollow and roll a while longer: they have twice the time.
 */
static void test_heap(uint64_t seed, uint8_t cap, const char *name)
{
    struct crowd *crowd = crowd_new();
    const double half[3] = {0.5, 0.5, 0.5}, small[3] = {0.3, 0.3, 0.3};
    int field = crowd_mesh(crowd, &field_mesh);
    int meshes[5] = {crowd_box(crowd, 0.5, 0.35, 0.25), crowd_solid(crowd, &lab_tetrahedron, half),
                     crowd_solid(crowd, &lab_l, half), crowd_ball(crowd, 0.25),
                     crowd_solid(crowd, &head_mesh, small)};
    struct crowd_tally tally = {0};
    uint64_t random = seed;
    long slow_at = 0, limit = cap == 1 ? 1200 : seed == 1 ? 400 : 800;

    crowd->config.substep_cap = cap;
    crowd_body(crowd, field);
    add_kerb(crowd);
    for (int i = 0; i < HEAP; i++) {
        struct carom_body_def *def = crowd_body(crowd, meshes[i % 16 == 5 ? 4 : i % 4]);
        double velocity[3], spin[3];

        for (int k = 0; k < 3; k++) {
            velocity[k] = lab_random(&random, -1, 1) / 60;
            spin[k] = lab_random(&random, -3, 3) / 60;
        }
        def->rotation = lab_random_turn(&random);
        crowd_place(def, -1.6 + (i % 3 - 1) * 0.85 + lab_random(&random, -0.1, 0.1),
                    (i / 3 % 3 - 1) * 0.85 + lab_random(&random, -0.1, 0.1), 0.7 + i / 9 * 0.9);
        crowd_move(def, velocity, spin);
    }
    lab_expect(crowd_start(crowd), name);
    while (tally.frames < limit && tally.asleep < HEAP) {
        lab_expect(crowd_step(crowd, &tally), name);
        slow_at = tally.slow < HEAP ? tally.frames + 1 : slow_at;
    }
    lab_report(tally.asleep == HEAP && tally.crossed == 0 && tally.out == 0 && tally.rise <= 1 &&
                   (cap == 1 || tally.capped * 100 <= tally.frames),
               name,
               "%ld of %d slow from frame %ld on, %ld asleep after %ld; %ld frames cross from %ld "
               "on (%.1e), energy rises by %.2g of the bound in frame %ld, %.2g m g skin, %ld "
               "capped, %ld out",
               tally.slow, HEAP, slow_at, tally.asleep, tally.frames, tally.crossed,
               tally.crossed_first, tally.crossed_depth, tally.rise, tally.rise_frame, tally.lift,
               tally.capped, tally.out);
    crowd_free(crowd);
}

/* ------------------------------------------------------------------------- main */

static const char *part = "";

static bool wanted(const char *name)
{
    return strstr(name, part) != NULL;
}

int main(int argc, char **argv)
{
    const bool whole = argc > 1 && strcmp(argv[1], "long") == 0;
    const struct {
        struct stack how;
        const char *name;
    } stacks[] = {
        {{5, true, 0, 10000, 0.02}, "crowd/stack_5_asleep"},
        {{10, true, 0, 10000, 0.1}, "crowd/stack_10_asleep"},
        {{5, false, 0, 1000, 0.02}, "crowd/stack_5_awake"},
        {{10, false, 0, 1000, 0.1}, "crowd/stack_10_awake"},
        {{5, true, 1, 1000, 0.02}, "crowd/stack_5_cap_1"},
        {{10, true, 1, 1000, 0.1}, "crowd/stack_10_cap_1"},
    };

    part = argc > 1 && !whole ? argv[1] : "";
    if (wanted("crowd/head_on")) {
        test_head_on();
    }
    if (wanted("crowd/corner_on_face") || wanted("crowd/edge_on_edge")) {
        test_off_centre(whole ? 2000 : 300);
    }
    if (wanted("crowd/cradle")) {
        test_cradle();
    }
    for (size_t i = 0; i < sizeof stacks / sizeof *stacks; i++) {
        if (wanted(stacks[i].name)) {
            test_stack(&stacks[i].how, stacks[i].name);
        }
    }
    if (wanted("crowd/towers")) {
        test_towers();
    }
    for (uint64_t seed = 1; seed <= (whole ? 8 : 1); seed++) {
        char name[2][32];

        snprintf(name[0], sizeof name[0], "crowd/heap_%d", (int)seed);
        snprintf(name[1], sizeof name[1], "crowd/heap_%d_cap_1", (int)seed);
        for (int i = 0; i < 2; i++) {
            if (wanted(name[i])) {
                test_heap(seed, (uint8_t)i, name[i]);
            }
        }
    }
    return lab_finish();
}

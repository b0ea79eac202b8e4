/* SPDX-License-Identifier: MIT */
/*
 * host_soak - random worlds by number, watched by an independent checker (soak.h). `make soak`
 * runs many.
 *
 *   host_soak                    50 worlds but for the open cases, a test a property
 *   host_soak rows FIRST COUNT   a row of CSV a world
 *   host_soak SEED [FROM TO]     one world frame by frame, looked at in each; from .. to with its bodies
 *
 * A plain number names a world of bodies alone, uNUMBER one of bodies that get under a surface, mNUMBER a
 * machine, wNUMBER a wild machine (soak_machine.h).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/open_cases.h"
#include "lib/real.h"
#include "lib/soak.h"

/*
 * The worlds that `make test` runs: the first ones, and the ones in which an earlier engine failed.
 */
#define FIRST 30
static const uint64_t known[] = {53,    103,   173,   178,   215,   267,   340,   406,   425,
                                 496,   502,   601,   626,   646,   740,   748,   792,   893,
                                 963,   1060,  1098,  1113,  1455,  1468,  1513,  1608,  1678,
                                 1719,  1754,  1791,  1953,  1973,  1977,  2123,  2257,  2391,
                                 2502,  4920,  25328, 26955, 31197, 32845, 35778, 39309, 40350,
                                 41135, 46144, 50051, 57246, 66172, 78597, 78700, 89294};
enum kind { BODIES = 0, UNDER = 'u', MACHINE = 'm', WILD = 'w' };
/* A world's name: "12", "u12", "m12", "w12"; and how many of its frames to run, or 0 for all. */
struct name {
    uint64_t seed;
    enum kind kind;
    int frames;
};
/*
 * Machines in which a sum of an earlier engine left its 32 or 64 bits: the debug build notices.
 * In w68 that was in frame 55, and a frame of it takes as long as all frames of another world. m377 went on otherwise from a
 * snapshot: a broken joint had noted that two bodies which had left the world pass each other. m150 and m772 gained energy: by impulses
 * of joints that repeat each other, and by a body that left its joints and the world.
 * In m289 and m590 a sensor reported a body that was apart from it. m12, m67 and m691 gained energy by
 * springs on long levers, or hung in the air for energy that they never had; m604 and m800 by bodies that left their joints and the world.
 * m125, m590, m791, m828, m865 and w86 had joints that contradict each other and gained what no motion of theirs could
 * give back; m123 stood still where that was undone. m1426 has weak springs, m1429 a hit that a callback drops, and m1871 a spring that
 * presses a body into a wall. In m2242 a motor held a body against a spring, in m2080 joints' limits took what their solves had given
 * in a touched group: bodies stood still. In m4614 a spring pressed a body into a limit and another one drew it off, in m4703 a body
 * swung about another one and pressed it into a third: these seemed to move, and did not. m5577 gained energy by hits that a callback
 * drops where nothing touched, m4514 by roundings of a group's common motion, and in m5674 a motor pressed two bodies against each other
 * until they stood. In m5710 a group stops a kinematic body in each frame, and springs pulled by the way that it did not take. In m4943
 * the motor of one joint presses a body into the limit of another, and bodies that swing about it pulled it off.
 */
static const struct name known_machines[] = {
    {50, MACHINE, 0},    {102, MACHINE, 0},    {121, MACHINE, 0},    {150, MACHINE, 0},
    {377, MACHINE, 0},   {590, MACHINE, 0},    {772, MACHINE, 0},    {12, MACHINE, 0},
    {67, MACHINE, 0},    {289, MACHINE, 0},    {604, MACHINE, 0},    {691, MACHINE, 0},
    {800, MACHINE, 20},  {125, MACHINE, 60},   {791, MACHINE, 80},   {828, MACHINE, 120},
    {865, MACHINE, 80},  {1426, MACHINE, 60},  {1429, MACHINE, 140}, {1871, MACHINE, 60},
    {123, MACHINE, 90},  {2080, MACHINE, 50},  {2242, MACHINE, 50},  {4614, MACHINE, 20},
    {4703, MACHINE, 20}, {4943, MACHINE, 110}, {4514, MACHINE, 0},   {5577, MACHINE, 190},
    {5674, MACHINE, 30}, {5710, MACHINE, 225}, {14, WILD, 0},        {68, WILD, 60},
    {86, WILD, 60},      {123, WILD, 0}};
/* Largest share of frames that may be cut short. */
#define CUT_ALLOWED 0.01

static struct soak_world world;

static unsigned faces_of(const struct crowd *crowd)
{
    unsigned faces = 0;

    for (int i = 0; i < crowd->body_count; i++) {
        faces += crowd->bodies[i].def.mesh->raw.face_count;
    }
    return faces;
}

/* ------------------------------------------------------------------------ rows */

static const char columns[] =
    "seed,bodies,faces,ground,pace,gravity,sleep,frames,crossed,inside,escaped,skins,error,error_"
    "frame,"
    "still,still_frame,cut,cut_longest,energy,momentum,slow,out,drawn_again,step_seconds,step_"
    "frame,"
    "seconds,candidates,substeps,fullest,joints,apart,axes,beyond,bent,touched_apart,touched_axes,"
    "touched_beyond,touched_bent,breaks,blocked,sensed,sensor_asked,sensor_frame,other_frame,"
    "momentum_off,angular_off,gained,refused,faults";

static const char *prefix(void)
{
    return world.under ? "u" : !world.machine ? "" : world.machine->wild ? "w" : "m";
}

/* Print the figures that only a machine has. */
static void print_machine(const struct soak_result *r)
{
    static const struct soak_seen none;
    const struct soak_seen *s = r->seen ? r->seen : &none;

    printf("%d,%.3g,%.3g,%.3g,%.3g,", world.machine ? world.machine->joint_count : 0, s->free.apart,
           s->free.axes, s->free.beyond, s->free.bent);
    printf("%.3g,%.3g,%.3g,%.3g,%ld,%ld,%ld,%ld,%ld,%ld,%.2g,%.2g,%.3g,%d,", s->any.apart,
           s->any.axes, s->any.beyond, s->any.bent, s->breaks, s->blocked, s->sensed,
           s->sensor_asked, s->sensor_frame, s->other_frame, r->tally.momentum, r->tally.angular,
           r->tally.gained, s->refused);
}

static void print_row(const struct soak_result *r)
{
    const struct crowd_tally *t = &r->tally;
    const char *between = "";

    printf("%s%llu,%d,%u,%s,%s,%.3g,%d,", prefix(), (unsigned long long)world.seed,
           world.crowd->body_count, faces_of(world.crowd), soak_ground_names[world.ground],
           soak_pace_names[world.pace], world.gravity, world.crowd->config.sleep);
    printf("%ld,%ld,%ld,%ld,%.3g,%s,%ld,%d,%ld,%ld,%ld,%.3g,%ld,%d,%ld,%d,%.4f,%ld,%.3f,%u,%u,%u,",
           t->frames, t->crossed, t->inside, r->escaped_frame, t->crossed_skins,
           r->error < 0 ? carom_result_text(r->error) : "", r->error_frame, r->still.longest,
           r->still.frame, t->capped, r->cut_longest, t->rise, r->momentum_frame, r->unfinished,
           t->out, world.drawn_again, r->step_seconds, r->step_frame, r->seconds, r->candidates,
           r->substeps, r->fullest);
    print_machine(r);
    for (enum soak_fault fault = 0; fault < SOAK_FAULTS; fault++) {
        if (soak_has(r, fault)) {
            printf("%s%s", between, soak_fault_names[fault]);
            between = "; ";
        }
    }
    puts("");
    fflush(stdout);
}

/* The world at a place in the list that `make test` runs; false behind the last one. */
static bool known_name(enum kind kind, size_t place, struct name *name)
{
    const size_t more = place - FIRST;

    *name = (struct name){place + 1, kind, 0};
    if (place < FIRST) {
        return true;
    }
    if (kind == MACHINE && more < sizeof known_machines / sizeof *known_machines) {
        *name = known_machines[more];
        return true;
    }
    if (kind == BODIES && more < sizeof known / sizeof *known) {
        name->seed = known[more];
        return true;
    }
    return false;
}

static struct name read_name(const char *text)
{
    bool plain = *text >= '0' && *text <= '9';

    return (struct name){strtoull(plain ? text : text + 1, NULL, 10),
                         plain ? BODIES : (enum kind) * text, 0};
}

static void make(struct name name)
{
    if (name.kind == UNDER) {
        soak_make_under(&world, name.seed);
    } else {
        soak_make(&world, name.seed);
    }
    if (name.kind == MACHINE || name.kind == WILD) {
        soak_machine_make(&world, name.kind == WILD);
    }
}

static void run(struct name name, struct soak_result *r)
{
    make(name);
    if (soak_start(&world, r)) {
        while (soak_step(&world, r) && r->tally.frames != name.frames) {
        }
    }
}

static void print_rows(struct name name, uint64_t count)
{
    struct soak_result result;

    puts(columns);
    for (uint64_t end = name.seed + count; name.seed < end; name.seed++) {
        run(name, &result);
        print_row(&result);
        soak_free(&world);
    }
}

/* ---------------------------------------------------------------- frame by frame */

static void print_bodies(const struct crowd *crowd)
{
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_body *body = &crowd->bodies[i];
        const struct oracle_body *b = &body->now.body;

        if (!body->def.stationary) {
            printf("#   %d: x %.9f %.9f %.9f v %.4g %.4g %.4g w %.4g %.4g %.4g, energy %.12g%s%s\n",
                   i, b->position[0], b->position[1], b->position[2], b->velocity[0],
                   b->velocity[1], b->velocity[2], b->spin[0], b->spin[1], b->spin[2],
                   body->now.kinetic + body->now.potential, body->now.state.asleep ? " asleep" : "",
                   body->now.state.out ? " out" : "");
        }
    }
}

static void print_contacts(const struct crowd *crowd)
{
    static struct carom_contact contacts[4096];
    int n = carom_contacts(crowd->world, contacts, 4096);

    for (int i = 0; i < n; i++) {
        const struct carom_contact *c = &contacts[i];

        printf("#   %d on %d: gap %.4g skins of %d, impulse %.4g, normal %.6f %.6f %.6f\n", c->a,
               c->b, real(c->gap_q22, 22) / crowd->meshes[crowd->bodies[c->a].mesh].skin, c->a,
               real(c->impulse_q40, 40), real(c->normal.c[0], 30), real(c->normal.c[1], 30),
               real(c->normal.c[2], 30));
    }
}

static void describe_joints(const struct soak_machine *m)
{
    static const char *const kinds[] = {"ball", "hinge", "slider", "distance", "fixed"};

    for (int i = 0; i < m->joint_count; i++) {
        const struct carom_joint_def *def = &m->joints[i].def;
        const struct carom_joint_drive *d = &def->drive;

        printf("# joint %d: %s of %d and %d%s", i, kinds[def->kind], def->a, def->b,
               def->touch ? "" : ", ignore each other");
        if (d->limited) {
            printf(", %.4g to %.4g", real(d->lower_q32, 32), real(d->upper_q32, 32));
        }
        if (d->motor) {
            printf(", motor of %.3g, at most %.3g", real(d->motor_speed_q40, 40),
                   real(d->motor_most_q40, 40));
        }
        if (d->spring) {
            printf(", spring of %.3g about %.3g, damping %.3g", real(d->stiffness_q40, 40),
                   real(d->rest_q32, 32), real(d->damping_q40, 40));
        }
        printf(def->most_impulse_q40 ? ", bears %.3g\n" : "\n", real(def->most_impulse_q40, 40));
    }
    printf("# machine:%s%s%s%s\n", m->asks ? " callback" : "", m->belts ? " belts" : "",
           m->damped ? " damping" : "", m->filtered ? " filters" : "");
}

static void describe_role(const struct carom_body_def *def)
{
    const struct carom_filter *f = &def->filter;

    if (def->kinematic || def->sensor || def->one_way) {
        printf("%s%s%s, ", def->kinematic ? "kinematic " : "", def->sensor ? "sensor " : "",
               def->one_way ? "one way" : "");
    }
    if (f->category || f->group) {
        printf("category %u, mask %u, group %d, ", f->category, f->mask, f->group);
    }
}

static void describe(void)
{
    const struct crowd *crowd = world.crowd;

    printf("# seed %s%llu: %d bodies, %u faces, ground %s, %s, gravity %.3g, sleep %d%s\n",
           prefix(), (unsigned long long)world.seed, crowd->body_count, faces_of(crowd),
           soak_ground_names[world.ground], soak_pace_names[world.pace], world.gravity,
           crowd->config.sleep, world.exact ? ", masses powers of two" : "");
    for (int i = 0; i < crowd->body_count; i++) {
        const struct crowd_body *body = &crowd->bodies[i];

        printf("# body %d: %s of %u faces, radius %.3g, ", i,
               world.kinds[i] < SOAK_KINDS ? soak_kind_names[world.kinds[i]] : "surface",
               body->def.mesh->raw.face_count, crowd->meshes[body->mesh].radius);
        describe_role(&body->def);
        if (body->def.stationary) {
            printf("stationary");
        } else {
            printf("mass %.4g", real(body->def.mass_q20, 20));
        }
        printf(", e %.3g, mu %.3g\n", real(body->def.restitution_q30, 30),
               real(body->def.friction_q16, 16));
    }
    if (world.machine) {
        describe_joints(world.machine);
    }
}

static void print_frame(const struct soak_result *r, const struct crowd_tally *before, double took)
{
    const struct crowd_tally *t = &r->tally;
    struct carom_stats stats;

    lab_expect(carom_stats(world.crowd->world, &stats), "stats");
    printf("frame %ld: %s%s, %u sub-steps, %u hits, %u candidates, %u contacts, %.4f s",
           t->frames + (r->status < 0), r->status < 0 ? carom_result_text(r->status) : "",
           r->status > 0 ? "cut short" : "whole", stats.substeps, stats.hits, stats.candidates,
           stats.contacts, took);
    if (t->crossed > before->crossed) {
        printf(", CROSSES (deepest so far %.3g skins, faces %d:%u and %d:%u)", t->crossed_skins,
               t->crossed_pair[0], t->crossed_face[0], t->crossed_pair[1], t->crossed_face[1]);
    }
    if (t->inside > before->inside) {
        printf(", INSIDE (first %d in %d)", t->inside_pair[0], t->inside_pair[1]);
    }
    if (r->seen && r->seen->sensor_frame == t->frames) {
        printf(", SENSOR (%d and %d)", r->seen->sensor, r->seen->visitor);
    }
    if (r->escaped_frame == t->frames) {
        printf(", ESCAPED (%d)", r->escaped);
    }
    if (t->rise > 1 && t->rise > before->rise) {
        printf(", ENERGY %.3g of what is allowed, body %d", t->rise, t->rise_body);
    }
    if (t->gained > before->gained && t->gained > SOAK_GAINED) {
        printf(", GAINED %.3g, group of body %d", t->gained, t->gained_body);
    }
    if (r->momentum_frame == t->frames) {
        printf(", MOMENTUM");
    }
    for (int i = 0; i < world.crowd->body_count; i++) {
        if (r->still.run[i] > 0) {
            printf(", %d stands still (%d)", i, r->still.run[i]);
        }
    }
    puts("");
}

static void show(struct name name, long from, long to)
{
    struct soak_result r;
    bool goes_on;

    make(name);
    describe();
    world.crowd->look_every = 1;
    goes_on = soak_start(&world, &r);
    if (r.tally.crossed + r.tally.inside > 0) {
        puts("NOT APART before the first frame");
    }
    while (goes_on) {
        struct crowd_tally before = r.tally;
        double seconds = r.seconds;

        goes_on = soak_step(&world, &r);
        print_frame(&r, &before, r.seconds - seconds);
        if (r.status >= 0 && r.tally.frames >= from && r.tally.frames <= to) {
            print_bodies(world.crowd);
            print_contacts(world.crowd);
        }
        fflush(stdout);
    }
    puts(columns);
    print_row(&r);
    soak_free(&world);
}

/* ----------------------------------------------------------------------- tests */

struct sum {
    long worlds, frames;
    long first_frames, cut; /* of the first worlds; in 31197, a hard one, each frame is cut short */
    long faults[SOAK_FAULTS];
    char first[SOAK_FAULTS][32]; /* the name of the first world with the fault */
    double deepest, rise, step_seconds, still, work, apart; /* worst values */
};

/* The test of each fault, named after its figure; some faults have no test. */
static const char *const what_of[SOAK_FAULTS] = {[SOAK_CROSSES] = "crossings_in_skins",
                                                 [SOAK_ERROR] = "errors",
                                                 [SOAK_STANDS_STILL] =
                                                     "frames_that_one_stands_still",
                                                 [SOAK_CUT] = "share_of_frames_cut_short",
                                                 [SOAK_ENERGY] = "energy_of_the_bound",
                                                 [SOAK_MOMENTUM] = "momentum",
                                                 [SOAK_MUCH_WORK] = "candidates_for_each_face",
                                                 [SOAK_JOINT] = "anchors_apart_in_skins",
                                                 [SOAK_SENSOR] = "sensors",
                                                 [SOAK_OTHER] = "another_hash"};

static void add(struct sum *sum, const struct soak_result *r)
{
    sum->worlds++;
    sum->frames += r->tally.frames;
    sum->deepest = fmax(sum->deepest, r->tally.crossed_skins);
    sum->rise = fmax(sum->rise, r->tally.rise);
    sum->still = fmax(sum->still, r->still.longest);
    sum->work = fmax(sum->work, (double)r->candidates / fmax(r->faces, 1));
    sum->apart = fmax(sum->apart, r->seen ? r->seen->free.apart : 0);
    sum->step_seconds = fmax(sum->step_seconds, r->step_seconds);
    for (enum soak_fault fault = 0; fault < SOAK_FAULTS; fault++) {
        bool has = soak_has(r, fault);

        if (has && sum->faults[fault]++ == 0) {
            snprintf(sum->first[fault], sizeof sum->first[fault], "%s%llu", prefix(),
                     (unsigned long long)world.seed);
        }
    }
}

static void report(const struct sum *sum, enum soak_fault fault, bool ok, const char *name,
                   double worst)
{
    char how[64] = "";

    if (!ok) {
        snprintf(how, sizeof how, ", run host_soak.elf %s", sum->first[fault]);
    }
    lab_report(ok, name, "%ld worlds, %ld frames, %ld worlds fail, worst %.3g%s", sum->worlds,
               sum->frames, sum->faults[fault], worst, how);
}

/* Run some worlds of a kind; the names of their tests begin with its name. */
static void test(const char *title, enum kind kind)
{
    const bool machine = kind == MACHINE;
    struct sum sum = {0};
    struct name name;
    char names[SOAK_FAULTS][64];
    double worst[SOAK_FAULTS] = {0};

    for (size_t i = 0; known_name(kind, i, &name); i++) {
        struct soak_result result;

        if (open_case(title, (long)name.seed)) {
            continue;
        }
        run(name, &result);
        add(&sum, &result);
        sum.first_frames += i < FIRST ? result.tally.frames : 0;
        sum.cut += i < FIRST ? result.tally.capped : 0;
        soak_free(&world);
    }
    worst[SOAK_CROSSES] = sum.deepest;
    worst[SOAK_STANDS_STILL] = sum.still;
    worst[SOAK_CUT] = (double)sum.cut / (double)sum.first_frames;
    worst[SOAK_ENERGY] = sum.rise;
    worst[SOAK_MUCH_WORK] = sum.work;
    worst[SOAK_JOINT] = sum.apart;
    for (enum soak_fault fault = 0; fault < SOAK_FAULTS; fault++) {
        if (machine && fault == SOAK_JOINT) {
            /* known to fail (docs/soak.md): joints that contradict each other */
            printf("# %s/%s: %ld of %ld worlds fail, worst %.3g\n", title, what_of[fault],
                   sum.faults[fault], sum.worlds, worst[fault]);
        } else if (what_of[fault] && (machine || fault < SOAK_JOINT)) {
            snprintf(names[fault], sizeof names[fault], "%s/%s", title, what_of[fault]);
            report(&sum, fault,
                   fault == SOAK_CUT ? worst[fault] <= CUT_ALLOWED : sum.faults[fault] == 0,
                   names[fault], worst[fault]);
        }
    }
    printf("# the slowest step took %.3g s\n", sum.step_seconds);
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "rows") == 0) {
        print_rows(read_name(argv[2]), strtoull(argv[3], NULL, 10));
        return 0;
    }
    if (argc > 1) {
        show(read_name(argv[1]), argc > 3 ? atol(argv[2]) : 1, argc > 3 ? atol(argv[3]) : 0);
        return 0;
    }
#ifdef TEST_LONG /* with sanitizers, machines are enough: they have all parts of the others */
    test("soak", BODIES);
    test("under", UNDER);
#endif
    test("machine", MACHINE);
    return lab_finish();
}

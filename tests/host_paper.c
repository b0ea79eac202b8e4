/* SPDX-License-Identifier: MIT */
/*
 * host_paper - a scene runs with the paper's own interference detection, which the Makefile links
 * here in place of Carom's. It finds crossing faces where pixels can see them.
 */
#include <math.h>
#include <string.h>

#include "lib/lab.h"
#include "paper/paper.h"

#define POSES  100
#define FRAMES 120
#define FACES  64

/* ----------------------------------------------------------------------- pairs */

struct found {
    struct paper_visitor base;
    bool pair[FACES][2];
    unsigned long count;
};

static void note(struct paper_visitor *self, uint16_t face_a, uint16_t face_b)
{
    struct found *found = (struct found *)self;

    found->pair[face_a][face_b] = true;
    found->count++;
}

/* The rotation of a pose in the engine's format. */
static carom_m3_q30 axes(const struct oracle_pose *pose)
{
    carom_m3_q30 m;

    for (int i = 0; i < 9; i++) {
        m.c[i / 3][i % 3] = (int32_t)lab_fixed(pose->rotation.row[i / 3][i % 3], 30);
    }
    return m;
}

static void corners(double out[3][3], const struct oracle_mesh *mesh,
                    const struct oracle_pose *pose, size_t face)
{
    for (int k = 0; k < 3; k++) {
        const double *v = mesh->vertices[mesh->faces[face][k]];

        for (int i = 0; i < 3; i++) {
            const double *row = pose->rotation.row[i];

            out[k][i] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + pose->position[i];
        }
    }
}

/*
 * The depth by which faces cross. 0 when one of them is steeper than 1 in 5: seen from above, such
 * a face may be too narrow to cover the centre of a pixel.
 */
static double depth(double p[3][3], double q[3][3])
{
    double deepest = 0, n[3], u[3], v[3];

    for (int i = 0; i < 3; i++) {
        u[i] = p[1][i] - p[0][i];
        v[i] = p[2][i] - p[0][i];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    if (fabs(n[2]) < 0.2 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        deepest = fmax(deepest, oracle_piercing(p[k], p[(k + 1) % 3], q[0], q[1], q[2]));
        deepest = fmax(deepest, oracle_piercing(q[k], q[(k + 1) % 3], p[0], p[1], p[2]));
    }
    return deepest;
}

/*
 * A body at random poses through a large tilted plane, and above it. Faces that cross by a tenth of
 * the body do so over many pixels.
 */
static void test_pairs(const char *name, const struct carom_mesh_raw *raw)
{
    struct lab *lab = lab_load(&lab_sheet, raw);
    struct found found = {.base.visit = note};
    struct paper_placed a = {.mesh = lab->scene.body.mesh}, b = {.mesh = lab->scene.ground.mesh};
    unsigned long crossing = 0, missed = 0, above = 0;
    carom_m3_q30 axes_a, axes_b;
    uint64_t state = 7;

    a.r = &axes_a;
    b.r = &axes_b;
    for (int i = 0; i < POSES; i++) {
        double z = lab_random(&state, -0.2, 0.2), turn_a[4], turn_b[4];
        const double at[3] = {0, 0, z}, none[3] = {0, 0, 0};
        const carom_quat_q30 turn = lab_random_turn(&state), tilt = lab_turn(0.6, 0.8, 0, 0.3);
        struct oracle_pose pose_a, pose_b;

        lab_quaternion(turn_a, &turn);
        lab_quaternion(turn_b, &tilt);
        pose_a = oracle_pose_make(at, turn_a, lab->centre);
        pose_b = oracle_pose_make(none, turn_b, none);
        axes_a = axes(&pose_a);
        axes_b = axes(&pose_b);
        a.at_q20[2] = (int32_t)lab_fixed(z, 20);
        memset(found.pair, 0, sizeof found.pair);
        paper_pairs(&a, &b, &found.base);
        for (size_t f = 0; f < lab->body.face_count; f++) {
            for (size_t g = 0; g < 2; g++) {
                double p[3][3], q[3][3];

                corners(p, &lab->body, &pose_a, f);
                corners(q, &lab->ground, &pose_b, g);
                if (depth(p, q) > 0.1) {
                    crossing++;
                    missed += !found.pair[f][g];
                }
            }
        }
        found.count = 0;
        a.at_q20[2] = 2 << 20; /* no body here is wider than 1.2 */
        paper_pairs(&a, &b, &found.base);
        above += found.count;
    }
    lab_report(crossing > POSES && missed == 0 && above == 0 && paper_refused() == 0, name,
               "%lu of %lu crossing pairs missed, %lu found in the air", missed, crossing, above);
    lab_free(lab);
}

/* ----------------------------------------------------------------------- scene */

static void test_scene(void)
{
    struct lab *lab = lab_load_scene("head");
    struct lab_tally tally = {0};
    unsigned long candidates = 0, faces = 0;
    const struct carom_face_ref *refs;

    lab_start(lab);
    for (int frame = 0; frame < FRAMES; frame++) {
        struct carom_stats stats;

        lab_step(lab, &tally);
        lab_expect(carom_stats(lab->world, &stats), "stats");
        candidates += stats.candidates;
        faces += (unsigned long)lab_expect(carom_interfering_faces(lab->world, &refs), "faces");
    }
    /* the method may miss contacts, so faces may cross; but the head does not fall through the
     * field */
    lab_report(tally.hits > 0 && candidates > 0 && faces > 2 && lab_body(lab).position[2] > 0,
               "paper/head",
               "%ld hits, %lu candidates, %lu interfering faces, %ld of %d frames cross",
               tally.hits, candidates, faces, tally.crossed, FRAMES);
    lab_free(lab);
}

int main(void)
{
    test_pairs("paper/box", &lab_box);
    test_pairs("paper/tetrahedron", &lab_tetrahedron);
    test_pairs("paper/l", &lab_l);
    test_scene();
    return lab_finish();
}

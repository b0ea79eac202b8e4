/* SPDX-License-Identifier: MIT */
/*
 * carom-compare - a moving mesh against a stationary one, through Carom, ODE, Bullet and FCL.
 *
 * Poses are recorded from Carom's own run of the scene `head` with these meshes. Its bodies never
 * cross, so the ends of frames would have no overlaps. A pose is the place where a frame would end
 * if nothing were in the way: an engine that looks for overlaps is asked about such poses.
 *
 * tools/compare.py runs this and explains the figures. Rows to the console:
 *
 *   phase,NAME,FRAMES                           apart, near, contact
 *   microseconds,PHASE,CONTENDER,MEAN
 *   agreement,POSES,CONTENDER,FRAMES,DISAGREE   with the judge, on whether faces cross
 *   recall,POSES,CONTENDER,CROSSING,FOUND       crossing face pairs
 *
 * As `count` it runs under callgrind instead, and labels the counts PHASE,CONTENDER,FRAMES.
 */
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include <valgrind/callgrind.h>

#include "compare.hpp"
#include "expect.hpp"

extern "C" {
#include "lib/oracle.h"
#include "scene.h"
}

namespace
{

using namespace compare;

constexpr int FRAMES = 240, ROUNDS = 9;
/* Faces that pierce by a billionth of a unit cross: rotations are rounded to 2^-30. */
constexpr double TOLERANCE = 1e-9;

/* Memory that starts at a multiple of 8. */
using Block = std::vector<uint64_t>;

size_t bytes(const Block &block)
{
    return block.size() * sizeof block[0];
}

Block make_block(size_t least)
{
    return Block(least / sizeof(uint64_t) + 1);
}

/* ------------------------------------------------------------------- meshes */

struct Loaded {
    Block raw_block, block;
    Mesh mesh;
    oracle_mesh judged; /* about the origin of the file */

    explicit Loaded(const char *file)
    {
        std::ifstream in(file, std::ios::binary);
        const std::string blob{std::istreambuf_iterator<char>(in), {}};
        carom_mesh_raw raw;

        raw_block = make_block(blob.size());
        expect(carom_mesh_read(&raw, blob.data(), blob.size(), raw_block.data(), bytes(raw_block)),
               file);
        block = make_block(CAROM_MESH_BYTES(raw.vertex_count, raw.face_count));
        expect(carom_mesh_build(&mesh.carom, &raw, block.data(), bytes(block)), file);
        judged = oracle_mesh_make(raw.vertices, raw.vertex_count, raw.faces, raw.face_count,
                                  raw.quantum_bits);
        for (size_t v = 0; v < judged.vertex_count; v++) {
            const int32_t *centre = mesh.carom.mass.centre.c;

            mesh.vertices.push_back({judged.vertices[v][0] - std::ldexp(centre[0], -22),
                                     judged.vertices[v][1] - std::ldexp(centre[1], -22),
                                     judged.vertices[v][2] - std::ldexp(centre[2], -22)});
        }
        for (size_t f = 0; f < judged.face_count; f++) {
            mesh.faces.push_back({judged.faces[f][0], judged.faces[f][1], judged.faces[f][2]});
        }
    }
};

/* -------------------------------------------------------------------- poses */

Pose pose_of(const carom_body_state &state)
{
    Pose pose = {state, {}, {}};
    double length = 0;

    for (int k = 0; k < 4; k++) {
        pose.quaternion[k] = std::ldexp(static_cast<double>(state.rotation.c[k]), -30);
        length += pose.quaternion[k] * pose.quaternion[k];
    }
    for (double &c : pose.quaternion) {
        c /= std::sqrt(length);
    }
    for (int k = 0; k < 3; k++) {
        pose.position[k] = std::ldexp(static_cast<double>(state.position.c[k]), -32);
    }
    return pose;
}

/* A world of a scene's moving body, with or without its ground. */
struct World {
    Block block = make_block(SCENE_WORLD_BYTES);
    carom_world *world;
    int body;

    World(const scene &scene, bool grounded)
    {
        carom_config config = scene_config();

        config.sleep = false;
        expect(carom_world_init(block.data(), bytes(block), &config, &world), "world");
        if (grounded) {
            expect(carom_body_add(world, &scene.ground), "ground");
        }
        body = expect(carom_body_add(world, &scene.body), "body");
    }
    carom_body_state state() const
    {
        carom_body_state state;

        expect(carom_body_get(world, body, &state), "state");
        return state;
    }
};

/*
 * The poses at the ends of frames, and the poses at which frames would end if nothing were in the
 * way.
 */
struct Run {
    std::vector<Pose> committed, free;

    Run(const Mesh &moving, const Mesh &still)
    {
        static scene scene;
        Block meshes = make_block(SCENE_MESH_BYTES);

        expect(scene_load(&scene, "head", nullptr, meshes.data(), bytes(meshes)), "scene");
        scene.body.mesh = &moving.carom;
        scene.ground.mesh = &still.carom;

        World run(scene, true), alone(scene, false);

        for (int frame = 0; frame < FRAMES; frame++) {
            const carom_body_state before = run.state();

            expect(carom_body_set(alone.world, alone.body, &before), "set");
            expect(carom_world_step(alone.world), "flight");
            free.push_back(pose_of(alone.state()));
            expect(carom_world_step(run.world), "step");
            committed.push_back(pose_of(run.state()));
        }
    }
};

/* ------------------------------------------------------------------- phases */

struct Judge {
    const Loaded &moving, &still;

    oracle_pose pose(const Pose &at) const
    {
        double centre[3];

        for (int k = 0; k < 3; k++) {
            centre[k] = std::ldexp(moving.mesh.carom.mass.centre.c[k], -22);
        }
        return oracle_pose_make(at.position, at.quaternion, centre);
    }
    size_t crossing(const Pose &at) const
    {
        const double none[3] = {0, 0, 0}, straight[4] = {1, 0, 0, 0};
        const oracle_pose pose_moving = pose(at),
                          pose_still = oracle_pose_make(none, straight, none);

        return oracle_crossings(&moving.judged, &pose_moving, &still.judged, &pose_still, TOLERANCE)
            .pairs;
    }
    /* The corners of a face of the moving mesh. */
    void place(double out[3][3], const oracle_pose &at, uint32_t face) const
    {
        for (int k = 0; k < 3; k++) {
            const double *v = moving.judged.vertices[moving.judged.faces[face][k]];

            for (int i = 0; i < 3; i++) {
                const double *row = at.rotation.row[i];

                out[k][i] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + at.position[i];
            }
        }
    }
    bool crosses(const oracle_pose &at, Pair pair) const
    {
        double p[3][3];
        const double *q[3];

        place(p, at, pair.moving);
        for (int k = 0; k < 3; k++) {
            q[k] = still.judged.vertices[still.judged.faces[pair.still][k]];
        }
        for (int k = 0; k < 3; k++) {
            if (oracle_piercing(p[k], p[(k + 1) % 3], q[0], q[1], q[2]) > TOLERANCE ||
                oracle_piercing(q[k], q[(k + 1) % 3], p[0], p[1], p[2]) > TOLERANCE) {
                return true;
            }
        }
        return false;
    }
    bool boxes_meet(const Pose &at) const
    {
        const oracle_pose placed = pose(at);

        for (int k = 0; k < 3; k++) {
            double low = INFINITY, high = -INFINITY, low_still = INFINITY, high_still = -INFINITY;

            for (size_t v = 0; v < moving.judged.vertex_count; v++) {
                const double *p = moving.judged.vertices[v], *row = placed.rotation.row[k];
                const double x = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + placed.position[k];

                low = std::min(low, x);
                high = std::max(high, x);
            }
            for (size_t v = 0; v < still.judged.vertex_count; v++) {
                low_still = std::min(low_still, still.judged.vertices[v][k]);
                high_still = std::max(high_still, still.judged.vertices[v][k]);
            }
            if (high < low_still || low > high_still) {
                return false;
            }
        }
        return true;
    }
};

struct Phase {
    const char *name;
    std::vector<Pose> poses;
};

std::vector<Phase> phases_of(const Judge &judge, const std::vector<Pose> &poses)
{
    std::vector<Phase> phases = {{"apart", {}}, {"near", {}}, {"contact", {}}};

    for (const Pose &pose : poses) {
        phases[!judge.boxes_meet(pose)     ? 0
               : judge.crossing(pose) == 0 ? 1
                                           : 2]
            .poses.push_back(pose);
    }
    return phases;
}

/* -------------------------------------------------------------------- costs */

/* Under callgrind: the instructions of every query of a phase. */
void count_instructions(Contender &contender, const Phase &phase)
{
    const std::string label =
        std::string(phase.name) + "," + contender.name() + "," + std::to_string(phase.poses.size());

    for (const Pose &pose : phase.poses) {
        contender.place(pose);
        CALLGRIND_TOGGLE_COLLECT;
        contender.query();
        CALLGRIND_TOGGLE_COLLECT;
    }
    CALLGRIND_DUMP_STATS_AT(label.c_str());
}

/* The mean over the queries of the best time of each. */
void take_times(Contender &contender, const Phase &phase)
{
    using Clock = std::chrono::steady_clock;
    std::vector<double> best(phase.poses.size(), INFINITY);
    double sum = 0;

    for (int round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < best.size(); i++) {
            contender.place(phase.poses[i]);
            const Clock::time_point start = Clock::now();
            contender.query();
            const std::chrono::duration<double, std::micro> took = Clock::now() - start;

            best[i] = std::min(best[i], took.count());
        }
    }
    for (double each : best) {
        sum += each;
    }
    std::printf("microseconds,%s,%s,%.3f\n", phase.name, contender.name(),
                sum / static_cast<double>(best.size()));
}

/* --------------------------------------------------------------------- main */

std::vector<Made> contenders(const Mesh &moving, const Mesh &still)
{
    std::vector<Made> made;

    made.push_back(make_carom(moving, still));
    made.push_back(make_paper(moving, still));
    made.push_back(make_ode(moving, still));
    made.push_back(make_bullet(moving, still));
    made.push_back(make_fcl(moving, still));
    return made;
}

/* The crossing pairs among the pairs that a contender found, each counted once. */
size_t crossing_found(const Judge &judge, const Pose &pose, const Contender &contender)
{
    const oracle_pose at = judge.pose(pose);
    std::vector<Pair> pairs = contender.pairs();
    const auto key = [](Pair p) { return std::make_pair(p.moving, p.still); };

    std::sort(pairs.begin(), pairs.end(), [&](Pair p, Pair q) { return key(p) < key(q); });
    pairs.erase(
        std::unique(pairs.begin(), pairs.end(), [&](Pair p, Pair q) { return key(p) == key(q); }),
        pairs.end());
    return static_cast<size_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](Pair p) { return judge.crosses(at, p); }));
}

/*
 * For contenders that report face pairs: the number of frames in which they differ from FCL on
 * whether any pair crosses, and the number of crossing pairs that they found. The judge checks each
 * reported pair, because some are only near.
 */
void compare_findings(const Judge &judge, const char *which, const std::vector<Pose> &poses)
{
    const Made fcl = make_fcl(judge.moving.mesh, judge.still.mesh);
    const Made asked[] = {make_carom(judge.moving.mesh, judge.still.mesh),
                          make_paper(judge.moving.mesh, judge.still.mesh)};
    size_t differs[2] = {0, 0}, found[2] = {0, 0}, judge_differs = 0, crossing = 0;

    for (const Pose &pose : poses) {
        const size_t all = judge.crossing(pose);

        fcl->place(pose);
        fcl->query();
        judge_differs += (all > 0) != (fcl->found() > 0);
        crossing += all;
        for (int i = 0; i < 2; i++) {
            asked[i]->place(pose);
            asked[i]->query();
            const size_t own = crossing_found(judge, pose, *asked[i]);

            differs[i] += (own > 0) != (fcl->found() > 0);
            found[i] += own;
        }
    }
    std::printf("agreement,%s,judge,%zu,%zu\n", which, poses.size(), judge_differs);
    for (int i = 0; i < 2; i++) {
        std::printf("agreement,%s,%s,%zu,%zu\n", which, asked[i]->name(), poses.size(), differs[i]);
        std::printf("recall,%s,%s,%zu,%zu\n", which, asked[i]->name(), crossing, found[i]);
    }
}

} // namespace

int main(int argc, char **argv)
{
    if (argc != 4 || (std::strcmp(argv[1], "time") != 0 && std::strcmp(argv[1], "count") != 0)) {
        std::fprintf(stderr, "usage: carom-compare time|count MOVING.crm STILL.crm\n");
        return 2;
    }
    const Loaded moving(argv[2]), still(argv[3]);
    const Judge judge = {moving, still};
    const Run run(moving.mesh, still.mesh);
    const std::vector<Phase> phases = phases_of(judge, run.free);
    const bool counting = std::strcmp(argv[1], "count") == 0;

    for (const Phase &phase : phases) {
        std::printf("phase,%s,%zu\n", phase.name, phase.poses.size());
    }
    for (const Made &contender : contenders(moving.mesh, still.mesh)) {
        for (const Phase &phase : phases) {
            Phase measured = {phase.name, {}};

            for (size_t i = 0; i < phase.poses.size(); i += contender->stride()) {
                measured.poses.push_back(phase.poses[i]);
            }
            if (!measured.poses.empty()) {
                contender->place(measured.poses[0]);
                contender->query(); /* do the library's one-time work here */
                (counting ? count_instructions : take_times)(*contender, measured);
            }
        }
    }
    if (!counting) {
        compare_findings(judge, "free", run.free);
        compare_findings(judge, "committed", run.committed);
    }
    return 0;
}

/* SPDX-License-Identifier: MIT */
/*
 * carom-heaps - boxes that fall on each other through Carom, ODE and Bullet, step by step.
 *
 * usage: carom-heaps CONTENDER BOXES SEED
 *
 * Under callgrind: instructions are counted in two phases, FALLING and RESTING, which are labelled
 * PHASE,STEPS. To the console: how high the boxes lie on average, how many lie under the plane, and how
 * many steps went wrong by the library's own report.
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <valgrind/callgrind.h>

#include "heaps.hpp"

namespace
{

struct Phase {
    const char *label;
    int first, last; /* steps from 1 */
};
constexpr Phase phases[] = {{"falling", 1, 60}, {"settling", 61, 120}, {"resting", 121, 180}};

/* Uniform in +-1: the same everywhere. */
double chance(unsigned &state)
{
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 23) - 1;
}

/* Boxes along an edge of a layer. */
int side(int boxes)
{
    return boxes <= 16 ? 2 : boxes <= 64 ? 3 : boxes <= 128 ? 4 : 5;
}

} // namespace

std::vector<heaps::Start> heaps::layout(int boxes, unsigned seed)
{
    const int edge = side(boxes);
    std::vector<Start> all;
    unsigned state = seed;

    for (int i = 0; i < boxes; i++) {
        const int layer = i / (edge * edge), place = i % (edge * edge);
        double q[4] = {1, 0, 0, 0}, length = 1;
        Start start;

        start.position[0] = 1.15 * (place % edge - (edge - 1) / 2.0) + 0.05 * chance(state);
        start.position[1] = 1.15 * (place / edge - (edge - 1) / 2.0) + 0.05 * chance(state);
        start.position[2] = 0.7 + 1.3 * layer;
        for (int k = 1; k < 4; k++) {
            q[k] = 0.03 * chance(state);
            length += q[k] * q[k];
        }
        for (int k = 0; k < 4; k++) {
            start.quaternion[k] = q[k] / std::sqrt(length);
        }
        all.push_back(start);
    }
    return all;
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        heaps::Made (*make)(const std::vector<heaps::Start> &);
    } contenders[] = {
        {"carom", heaps::make_carom}, {"ode", heaps::make_ode}, {"bullet", heaps::make_bullet}};
    heaps::Made heap;
    int boxes = argc == 4 ? std::atoi(argv[2]) : 0, step = 0, under = 0;
    double sum = 0;

    for (const auto &c : contenders) {
        if (boxes > 0 && std::strcmp(argv[1], c.name) == 0) {
            heap = c.make(heaps::layout(boxes, static_cast<unsigned>(std::atoi(argv[3]))));
        }
    }
    if (!heap) {
        std::fprintf(stderr, "usage: carom-heaps carom|ode|bullet BOXES SEED\n");
        return 2;
    }
    for (const Phase &phase : phases) {
        CALLGRIND_TOGGLE_COLLECT;
        while (step < phase.last) {
            heap->step();
            step++;
        }
        CALLGRIND_TOGGLE_COLLECT;
        char label[64];
        std::snprintf(label, sizeof label, "%s,%d", phase.label, phase.last - phase.first + 1);
        CALLGRIND_DUMP_STATS_AT(label);
    }
    for (int i = 0; i < boxes; i++) {
        under += heap->height(i) < 0;
        sum += heap->height(i);
    }
    std::printf("%.3f,%d,%d\n", sum / boxes, under, heap->troubled());
    return 0;
}

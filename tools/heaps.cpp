/* SPDX-License-Identifier: MIT */
/*
 * carom-heaps - boxes that fall on each other through Carom, ODE and Bullet, step by step.
 *
 * usage: carom-heaps CONTENDER BOXES SEED
 *        carom-heaps CONTENDER head
 *        carom-heaps layout BOXES SEED
 *
 * `head` runs whole steps of the scene of that name. `layout` prints the places where boxes begin,
 * a box a line. Under callgrind with --instr-atstart=no --collect-atstart=no, instructions are
 * counted in phases of 60 steps, labelled PHASE,STEPS: falling, settling, resting; or asleep, for
 * a sleeping heap of Carom. The program prints the mean height of the bodies, the number of bodies
 * below z = 0, and the number of steps that went wrong by the library's own report.
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <valgrind/callgrind.h>

#include "heaps.hpp"

namespace
{

/* Uniform in +-1; the same on every machine. */
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

namespace
{

const struct {
    const char *name;
    heaps::Made (*make)(const std::vector<heaps::Start> &);
} contenders[] = {{"carom", heaps::make_carom},
                  {"asleep", heaps::make_asleep},
                  {"ode", heaps::make_ode},
                  {"bullet", heaps::make_bullet}};

heaps::Made make_head(const std::string &name)
{
    return name == "carom"    ? heaps::make_carom_head()
           : name == "ode"    ? heaps::make_ode_head(heaps::head_scene())
           : name == "bullet" ? heaps::make_bullet_head(heaps::head_scene())
                              : nullptr;
}

heaps::Made make_heap(const std::string &name, const std::vector<heaps::Start> &boxes)
{
    for (const auto &c : contenders) {
        if (name == c.name && !boxes.empty()) {
            return c.make(boxes);
        }
    }
    return nullptr;
}

/* Print positions, then quaternions, for programs that make the same heap. */
void print_layout(const std::vector<heaps::Start> &boxes)
{
    for (const heaps::Start &start : boxes) {
        const double *x = start.position, *q = start.quaternion;

        std::printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", x[0], x[1], x[2], q[0], q[1],
                    q[2], q[3]);
    }
}

/* Instrument only the measured steps: the rest runs many times faster. */
void measure(heaps::Heap &heap, const char *label, int steps)
{
    char text[64];

    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_TOGGLE_COLLECT;
    for (int i = 0; i < steps; i++) {
        heap.step();
    }
    CALLGRIND_TOGGLE_COLLECT;
    std::snprintf(text, sizeof text, "%s,%d", label, steps);
    CALLGRIND_DUMP_STATS_AT(text);
    CALLGRIND_STOP_INSTRUMENTATION;
}

} // namespace

int main(int argc, char **argv)
{
    const std::string name = argc > 1 ? argv[1] : "", what = argc > 2 ? argv[2] : "";
    const int boxes = what == "head" ? 1 : std::atoi(what.c_str());
    const auto seed = static_cast<unsigned>(argc > 3 ? std::atoi(argv[3]) : 1);
    const std::vector<heaps::Start> starts = heaps::layout(boxes, seed);
    int under = 0;
    double sum = 0;

    if (name == "layout" && boxes > 0) {
        print_layout(starts);
        return 0;
    }
    const heaps::Made heap = what == "head" ? make_head(name) : make_heap(name, starts);
    if (!heap && name == "asleep" && boxes > 0) {
        std::fprintf(stderr, "the heap does not sleep\n");
        return 1;
    }
    if (!heap) {
        std::fprintf(stderr, "usage: carom-heaps carom|ode|bullet|asleep BOXES SEED\n"
                             "       carom-heaps carom|ode|bullet head\n"
                             "       carom-heaps layout BOXES SEED\n");
        return 2;
    }
    if (name == "asleep") {
        measure(*heap, "asleep", 60);
    } else {
        for (const char *phase : {"falling", "settling", "resting"}) {
            measure(*heap, phase, 60);
        }
    }
    for (int i = 0; i < boxes; i++) {
        under += heap->height(i) < 0;
        sum += heap->height(i);
    }
    std::printf("%.3f,%d,%d\n", sum / boxes, under, heap->troubled());
    return 0;
}

/* SPDX-License-Identifier: MIT */
/*
 * heaps - many boxes that fall on each other, through Carom and others.
 *
 * Unit boxes of mass 1 in layers over a plane at z = 0, slightly turned and displaced; gravity
 * 9.81 m/s^2, 60 steps a second, friction 0.5, no restitution, no sleep. Each library has its
 * default settings. Also the scene `head` of Carom's examples, without sleep.
 */
#ifndef CAROM_TOOLS_HEAPS_HPP
#define CAROM_TOOLS_HEAPS_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace heaps
{

constexpr double GRAVITY = -9.81, STEP = 1.0 / 60, FRICTION = 0.5;

struct Start {
    double position[3];
    double quaternion[4]; /* w, x, y, z; of length 1 */
};

/*
 * The places where the boxes of a heap begin, the same for every library; each seed gives another
 * heap.
 */
std::vector<Start> layout(int boxes, unsigned seed);

class Heap
{
  public:
    virtual ~Heap() = default;
    virtual const char *name() const = 0;
    virtual void step() = 0;
    /* The height of a box's centre. */
    virtual double height(int box) const = 0;
    /* The number of steps that went wrong, by the library's own report. */
    virtual int troubled() const
    {
        return 0;
    }
};

using Made = std::unique_ptr<Heap>;

Made make_carom(const std::vector<Start> &boxes);
/* A heap of Carom in which all boxes sleep; null if they do not sleep after a while. */
Made make_asleep(const std::vector<Start> &boxes);
Made make_ode(const std::vector<Start> &boxes);
Made make_bullet(const std::vector<Start> &boxes);

/* A mesh about its centre of mass, in units. */
struct Mesh {
    std::vector<std::array<float, 3>> vertices;
    std::vector<std::array<int, 3>> faces;
};

/* The scene `head`: a head of mass 1 that falls on a field. */
struct Scene {
    Mesh head, field;
    Start start;
    double velocity[3], spin[3]; /* units and radians a second */
    double inertia[6];           /* xx, yy, zz, xy, yz, zx */
    double friction, restitution;
};

Made make_carom_head();
Made make_ode_head(const Scene &scene);
Made make_bullet_head(const Scene &scene);
/* As in Carom's examples. */
Scene head_scene();

} // namespace heaps

#endif

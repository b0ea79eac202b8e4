/* SPDX-License-Identifier: MIT */
/*
 * compare - Carom and others on the same meshes at the same poses.
 *
 * A contender finds all contacts of a moving mesh with a stationary one, as its library does it,
 * including the library's test of boxes. It already has the poses.
 */
#ifndef CAROM_TOOLS_COMPARE_HPP
#define CAROM_TOOLS_COMPARE_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "carom.h"

namespace compare
{

/* A mesh for Carom, and the same vertices about its centre of mass, in units, exactly. */
struct Mesh {
    struct carom_mesh carom;
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<uint32_t, 3>> faces;
};

/* The pose of the moving body, in two forms; the other body is at the origin, unturned. */
struct Pose {
    struct carom_body_state state;
    double position[3];
    double quaternion[4]; /* w, x, y, z; of length 1 */
};

struct Pair {
    uint32_t moving, still; /* faces */
};

class Contender
{
  public:
    virtual ~Contender() = default;
    virtual const char *name() const = 0;
    /* Set the pose of the moving body. Not measured. */
    virtual void place(const Pose &pose) = 0;
    /* Find the contacts. Measured. */
    virtual void query() = 0;
    /* The number of things that the query found: contacts, face pairs or the like. */
    virtual size_t found() const = 0;
    /* A slow contender is measured only at every stride-th pose. */
    virtual size_t stride() const
    {
        return 1;
    }
    /* The face pairs that were found; ODE and Bullet do not report them. */
    virtual std::vector<Pair> pairs() const
    {
        return {};
    }
};

using Made = std::unique_ptr<Contender>;

/* Meshes must outlive the contenders made of them. */
Made make_carom(const Mesh &moving, const Mesh &still);
Made make_paper(const Mesh &moving, const Mesh &still);
Made make_ode(const Mesh &moving, const Mesh &still);
Made make_bullet(const Mesh &moving, const Mesh &still);
Made make_fcl(const Mesh &moving, const Mesh &still);

} // namespace compare

#endif

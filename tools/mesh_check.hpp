/* SPDX-License-Identifier: MIT */
/*
 * mesh_check - the last part of the mesh converter: checks that a surface is a height field, and computes the mass of a solid.
 */
#ifndef CAROM_TOOLS_MESH_CHECK_HPP
#define CAROM_TOOLS_MESH_CHECK_HPP

#include "mesh_mend.hpp"

namespace mend
{

/* ------------------------------------------------------------------- surfaces */

/* True if two faces, both counter-clockwise from above, share an area seen from above. */
inline bool overlap_xy(const Mesh &mesh, const Face &f, const Face &g)
{
    const Face *pair[2] = {&f, &g};

    for (int side = 0; side < 2; side++) {
        const Face &own = *pair[side], &other = *pair[1 - side];

        for (size_t k = 0; k < 3; k++) {
            const Vertex &a = mesh.vertices[own[k]], &b = mesh.vertices[own[(k + 1) % 3]];

            if (std::all_of(other.begin(), other.end(),
                            [&](uint32_t v) { return area_xy(a, b, mesh.vertices[v]) <= 0; })) {
                return false;
            }
        }
    }
    return true;
}

inline void check_looks_up(const Mesh &mesh)
{
    std::vector<std::string> steep;

    for (const Face &f : mesh.faces) {
        if (normal_of(mesh, f)[2] <= 0) {
            steep.push_back(describe(mesh, f));
        }
    }
    if (!steep.empty()) {
        throw Refusal(counted(steep.size(), "face") +
                      " upright or overhanging: a SURFACE has one z at each x, y. Turn the mesh so "
                      "that z is up, take off walls, or convert it as a SOLID" +
                      listed(steep));
    }
}

/* No two faces of a surface may lie above each other: compare those in a common cell. */
inline void check_single_layer(const Mesh &mesh)
{
    Vertex low = mesh.vertices[0], high = low;

    for (const Vertex &v : mesh.vertices) {
        for (size_t k = 0; k < 2; k++) {
            low[k] = std::min(low[k], v[k]);
            high[k] = std::max(high[k], v[k]);
        }
    }
    const int32_t width = std::max(high[0] - low[0], high[1] - low[1]);
    const int32_t cell = 1 + width / int32_t(1 + std::sqrt(double(mesh.faces.size())));
    std::map<std::pair<int32_t, int32_t>, std::vector<uint32_t>> cells;
    std::set<std::pair<uint32_t, uint32_t>> overlaps;
    std::vector<std::string> lines;

    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        const Face &face = mesh.faces[f];
        const Vertex &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
                     &c = mesh.vertices[face[2]];
        const auto [x0, x1] = std::minmax({a[0] / cell, b[0] / cell, c[0] / cell});
        const auto [y0, y1] = std::minmax({a[1] / cell, b[1] / cell, c[1] / cell});

        for (int32_t y = y0; y <= y1; y++) {
            for (int32_t x = x0; x <= x1; x++) {
                std::vector<uint32_t> &neighbours = cells[{x, y}];

                for (uint32_t other : neighbours) {
                    if (overlap_xy(mesh, face, mesh.faces[other])) {
                        overlaps.insert({other, f});
                    }
                }
                neighbours.push_back(f);
            }
        }
    }
    for (const auto &[f, g] : overlaps) {
        lines.push_back(describe(mesh, mesh.faces[f]) + " and " + describe(mesh, mesh.faces[g]));
    }
    if (!lines.empty()) {
        throw Refusal(
            counted(lines.size(), "pair") +
            " of faces above each other: a SURFACE has one z at each x, y; keep one layer" +
            listed(lines));
    }
}

/* ----------------------------------------------------------------------- mass */

struct Mass {
    double volume;
    Point centre;
    std::array<double, 6> inertia; /* xx yy zz xy yz zx about the centre, divided by the mass */
};

/* By tetrahedra from the first vertex, so that the terms of a far-off mesh stay small. */
inline Mass mass_of(const Mesh &mesh)
{
    const Point origin = in_units(mesh, 0);
    double volume = 0;
    Point first = {0, 0, 0};
    double second[3][3] = {{0}};
    Mass mass;

    for (const Face &f : mesh.faces) {
        Point p[4]; /* the three corners and their sum */

        for (size_t k = 0; k < 3; k++) {
            p[3][k] = 0;
            for (size_t i = 0; i < 3; i++) {
                p[i][k] = in_units(mesh, f[i])[k] - origin[k];
                p[3][k] += p[i][k];
            }
        }
        const double v = (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                          p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                          p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
                         6;

        volume += v;
        for (size_t j = 0; j < 3; j++) {
            first[j] += v * p[3][j] / 4;
            for (size_t k = 0; k < 3; k++) {
                for (size_t i = 0; i < 4; i++) {
                    second[j][k] += v * p[i][j] * p[i][k] / 20;
                }
            }
        }
    }
    mass.volume = volume;
    for (size_t j = 0; j < 3; j++) {
        mass.centre[j] = origin[j] + first[j] / volume;
        for (size_t k = 0; k < 3; k++) {
            second[j][k] = second[j][k] / volume - first[j] * first[k] / (volume * volume);
        }
    }
    mass.inertia = {second[1][1] + second[2][2],
                    second[2][2] + second[0][0],
                    second[0][0] + second[1][1],
                    -second[0][1],
                    -second[1][2],
                    -second[2][0]};
    for (double &entry : mass.inertia) { /* rounding noise around 0 would only confuse */
        entry = std::fabs(entry) < 1e-12 * mass.inertia[0] ? 0 : entry;
    }
    return mass;
}

/* The volume that the file's own corners enclose, before they are snapped. */
inline double volume_of(const Soup &soup)
{
    double volume = 0;

    for (const Face &f : soup.faces) {
        Point p[3];

        for (size_t i = 0; i < 3; i++) {
            for (size_t k = 0; k < 3; k++) {
                p[i][k] = soup.points[f[i]][k] - soup.points[0][k];
            }
        }
        volume += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                   p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                   p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
                  6;
    }
    return std::fabs(volume);
}

/*
 * A warning if quanta change the volume by more than a hundredth; otherwise empty. A file with
 * double or inverted faces, holes or parts within parts has no volume to compare with.
 */
inline std::string doubt_about_volume(const Soup &soup, const Mesh &mesh)
{
    for (const std::string &what : mesh.mended) {
        if (what.find("given twice") != std::string::npos || what.find("turned") == 0 ||
            what.find("closed") == 0 || what.find("simplified") == 0 ||
            what.find("dropped a part") == 0) {
            return "";
        }
    }
    const double before = volume_of(soup), ratio = mass_of(mesh).volume / before;

    if (!(before > 0) || std::fabs(ratio - 1) <= 0.01) {
        return "";
    }
    return format(
        "rounding to quanta of 2^-%d units makes the volume %.3g times what the file has: "
        "enlarge the mesh with --scale, or give a larger --quantum-bits",
        mesh.bits, ratio);
}

} // namespace mend

#endif

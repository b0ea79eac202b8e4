/* SPDX-License-Identifier: MIT */
/*
 * mesh_edges - exact measures of the faces of a welded mesh, and its edges: the faces of each edge,
 * and the edges that bound nothing.
 *
 * Coordinates are below 2^15, so a cross product of two edges is below 2^34 and a determinant of
 * three corners below 2^51.
 */
#ifndef CAROM_TOOLS_MESH_EDGES_HPP
#define CAROM_TOOLS_MESH_EDGES_HPP

#include "mesh_soup.hpp"

namespace mend
{

using Normal = std::array<int64_t, 3>;

/* Twice the area along the normal, exact. */
inline Normal normal_of(const Mesh &mesh, const Face &face)
{
    const Vertex &a = mesh.vertices[face[0]];
    int64_t e[2][3];

    for (size_t k = 0; k < 3; k++) {
        e[0][k] = mesh.vertices[face[1]][k] - a[k];
        e[1][k] = mesh.vertices[face[2]][k] - a[k];
    }
    return {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
            e[0][0] * e[1][1] - e[0][1] * e[1][0]};
}

inline bool has_area(const Mesh &mesh, const Face &face)
{
    return normal_of(mesh, face) != Normal{0, 0, 0};
}

/* Twice the area of a, b, c seen from above, exact; positive when counter-clockwise. */
inline int64_t area_xy(const Vertex &a, const Vertex &b, const Vertex &c)
{
    return int64_t(b[0] - a[0]) * (c[1] - a[1]) - int64_t(b[1] - a[1]) * (c[0] - a[0]);
}

struct EdgeUse {
    uint32_t face;
    bool forward; /* the face runs from the lower vertex to the higher */
};
using EdgeUses = std::map<Edge, std::vector<EdgeUse>>;

inline EdgeUses edges_of(const Mesh &mesh)
{
    EdgeUses uses;

    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        for (size_t k = 0; k < 3; k++) {
            const uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];

            uses[{std::min(a, b), std::max(a, b)}].push_back({f, a < b});
        }
    }
    return uses;
}

/* Open edges, sorted by hole: edges that share a vertex belong to one hole. */
inline std::vector<std::string> holes(const Mesh &mesh, const EdgeUses &uses)
{
    std::map<uint32_t, std::vector<Edge>> at;
    std::set<Edge> seen;
    std::vector<std::string> lines;
    size_t number = 0;

    for (const auto &[edge, faces] : uses) {
        if (faces.size() == 1) {
            at[edge.first].push_back(edge);
            at[edge.second].push_back(edge);
        }
    }
    for (const auto &start : at) {
        std::vector<Edge> hole, next = start.second;

        while (!next.empty()) {
            const Edge edge = next.back();

            next.pop_back();
            if (seen.insert(edge).second) {
                hole.push_back(edge);
                for (uint32_t v : {edge.first, edge.second}) {
                    next.insert(next.end(), at[v].begin(), at[v].end());
                }
            }
        }
        if (!hole.empty()) {
            lines.push_back("hole " + std::to_string(++number) + ", " +
                            counted(hole.size(), "edge"));
        }
        for (const Edge &edge : hole) {
            lines.push_back("  " + describe(mesh, edge));
        }
    }
    return lines;
}

inline void check_crowded(const Mesh &mesh, const EdgeUses &uses)
{
    std::vector<std::string> crowded;

    for (const auto &[edge, faces] : uses) {
        if (faces.size() > 2) {
            crowded.push_back(describe(mesh, edge) + ": " + counted(faces.size(), "face"));
        }
    }
    if (!crowded.empty()) {
        throw Refusal(counted(crowded.size(), "non-manifold edge") +
                      ", where more than two faces meet: take the parts apart there" +
                      listed(crowded));
    }
}

inline void check_open(const Mesh &mesh, const EdgeUses &uses)
{
    const auto open = std::count_if(uses.begin(), uses.end(),
                                    [](const auto &use) { return use.second.size() == 1; });

    if (open && !mesh.surface) {
        throw Refusal(counted(size_t(open), "open edge") +
                      ", where only one face is: a SOLID must be closed. Flat holes are filled "
                      "with --close; otherwise fill them in the editor, weld more with a smaller "
                      "--quantum-bits, or use --surface for a height field" +
                      listed(holes(mesh, uses)));
    }
}

} // namespace mend

#endif

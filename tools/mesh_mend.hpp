/* SPDX-License-Identifier: MIT */
/*
 * mesh_mend - what the mesh converter does to the faces of a welded mesh: it mends those without
 * area and those given twice, refuses edges that bound nothing, and turns all faces one way.
 *
 * Decisions about single faces and edges are exact: coordinates are below 2^15, so a cross product
 * of two edges is below 2^34 and a determinant of three corners below 2^51.
 */
#ifndef CAROM_TOOLS_MESH_MEND_HPP
#define CAROM_TOOLS_MESH_MEND_HPP

#include "mesh_soup.hpp"

namespace mend
{

using Normal = std::array<int64_t, 3>;

/* ----------------------------------------------------------- faces, one by one */

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

inline void drop_collapsed_faces(Mesh &mesh)
{
    const size_t before = mesh.faces.size();
    const auto collapsed = [](const Face &f) {
        return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
    };

    mesh.faces.erase(std::remove_if(mesh.faces.begin(), mesh.faces.end(), collapsed),
                     mesh.faces.end());
    if (mesh.faces.size() < before) {
        mesh.mended.push_back("dropped " + counted(before - mesh.faces.size(), "face") +
                              " with two equal corners");
    }
}

/* The same three corners can be listed in two windings; this tells them apart. */
inline bool winding(Face f)
{
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f[1] < f[2];
}

/*
 * Of faces with the same corners, two of the same winding are one face given twice, and two of
 * opposite windings are a plate that the weld made flat, which bounds nothing: both go.
 */
inline void drop_double_faces(Mesh &mesh)
{
    std::map<std::set<uint32_t>, std::array<size_t, 2>> counts; /* by winding, still to be kept */
    std::vector<Face> kept;
    size_t twice = 0, flat = 0;

    for (const Face &f : mesh.faces) {
        size_t &count = counts[{f.begin(), f.end()}][winding(f)];

        twice += count;
        count = 1;
    }
    for (auto &[corners, count] : counts) {
        if (count[0] && count[1]) {
            count = {0, 0};
            flat += 2;
        }
    }
    for (const Face &f : mesh.faces) {
        size_t &count = counts[{f.begin(), f.end()}][winding(f)];

        if (count) {
            kept.push_back(f);
        }
        count = 0;
    }
    mesh.faces = kept;
    if (twice) {
        mesh.mended.push_back("dropped " + counted(twice, "face") + " given twice");
    }
    if (flat) {
        mesh.mended.push_back("dropped " + counted(flat, "face") + " back to back");
    }
}

/* -------------------------------------------------------------------- edges */

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

/*
 * Mend one face whose corners lie on a line. Its middle corner lies on the edge of the other two,
 * so the neighbour over that edge is cut there in two, and the second half takes the face's place.
 * At a border there is no neighbour and the face just goes: its other two edges are the border.
 */
inline bool mend_sliver(Mesh &mesh, uint32_t sliver, const EdgeUses &uses, std::vector<bool> &gone,
                        std::vector<bool> &touched)
{
    Face corners = mesh.faces[sliver];

    std::sort(corners.begin(), corners.end(),
              [&](uint32_t a, uint32_t b) { return mesh.vertices[a] < mesh.vertices[b]; });

    if (touched[sliver]) {
        return false; /* it has other edges than `uses` knows: the next round takes it */
    }

    const uint32_t low = corners[0], middle = corners[1], high = corners[2];
    const std::vector<EdgeUse> &pair = uses.at({std::min(low, high), std::max(low, high)});

    if (pair.size() == 1) {
        gone[sliver] = true;
        return true;
    }
    if (pair.size() != 2) {
        return false;
    }
    const uint32_t other = pair[0].face == sliver ? pair[1].face : pair[0].face;

    if (touched[other]) {
        return false;
    }
    touched[other] = touched[sliver] = true;
    mesh.faces[sliver] = mesh.faces[other];
    std::replace(mesh.faces[sliver].begin(), mesh.faces[sliver].end(), low, middle);
    std::replace(mesh.faces[other].begin(), mesh.faces[other].end(), high, middle);
    return true;
}

inline void mend_slivers(Mesh &mesh)
{
    size_t mended = 0;

    for (bool again = true; again && mended <= mesh.triangles;) {
        const EdgeUses uses = edges_of(mesh);
        std::vector<bool> gone(mesh.faces.size()), touched(mesh.faces.size());
        std::vector<Face> kept;

        again = false;
        for (uint32_t f = 0; f < mesh.faces.size(); f++) {
            if (!has_area(mesh, mesh.faces[f]) && mend_sliver(mesh, f, uses, gone, touched)) {
                mended++;
                again = true;
            }
        }
        for (uint32_t f = 0; f < mesh.faces.size(); f++) {
            if (!gone[f]) {
                kept.push_back(mesh.faces[f]);
            }
        }
        mesh.faces = kept;
    }
    if (mended) {
        mesh.mended.push_back("mended " + counted(mended, "face") + " without area");
    }
}

inline void check_counts(const Mesh &mesh)
{
    if (mesh.vertices.size() > count_max || mesh.faces.size() > count_max) {
        throw Refusal(counted(mesh.vertices.size(), "vertex") + " and " +
                      counted(mesh.faces.size(), "face") +
                      " after welding, but at most 65535 of each are possible: simplify the mesh");
    }
}

/* The engine's own limits of a mesh's box. */
inline void check_size(const Mesh &mesh)
{
    Point low = in_units(mesh, 0), high = low, side;

    for (uint32_t v = 0; v < mesh.vertices.size(); v++) {
        const Point p = in_units(mesh, v);

        for (size_t k = 0; k < 3; k++) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    for (size_t k = 0; k < 3; k++) {
        side[k] = high[k] - low[k];
    }
    const double longest = *std::max_element(side.begin(), side.end());
    const double diagonal = std::hypot(side[0], side[1], side[2]);

    if (longest > side_max || diagonal > diagonal_max) {
        throw Refusal(
            format("%.10g x %.10g x %.10g units is too large: a side may have %g units and "
                   "the diagonal %g; shrink the mesh, e.g. with --scale %.3g",
                   side[0], side[1], side[2], side_max, diagonal_max,
                   std::min(side_max / longest, diagonal_max / diagonal) * 0.99));
    }
}

inline void check_faces(const Mesh &mesh)
{
    std::vector<std::string> flat;

    if (mesh.faces.empty()) {
        throw Refusal("no face is left after welding: the mesh is too small; enlarge it with "
                      "--scale or give a larger --quantum-bits");
    }
    for (const Face &f : mesh.faces) {
        if (!has_area(mesh, f)) {
            flat.push_back(describe(mesh, f));
        }
    }
    if (!flat.empty()) {
        throw Refusal(counted(flat.size(), "face") +
                      " without area: remove them in the editor, or give a larger --quantum-bits" +
                      listed(flat));
    }
}

/* Open edges, those of a hole behind one another: edges that share a vertex are of one hole. */
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

inline void check_edges(const Mesh &mesh, const EdgeUses &uses)
{
    std::vector<std::string> crowded;
    size_t open = 0;

    for (const auto &[edge, faces] : uses) {
        if (faces.size() == 1) {
            open++;
        } else if (faces.size() > 2) {
            crowded.push_back(describe(mesh, edge) + ": " + counted(faces.size(), "face"));
        }
    }
    if (!crowded.empty()) {
        throw Refusal(counted(crowded.size(), "non-manifold edge") +
                      ", where more than two faces meet: take the parts apart there" +
                      listed(crowded));
    }
    if (open && !mesh.surface) {
        throw Refusal(counted(open, "open edge") +
                      ", where only one face is: a SOLID must be closed. Fill the holes, weld more "
                      "with a smaller --quantum-bits, or use --surface for a height field" +
                      listed(holes(mesh, uses)));
    }
}

/* ------------------------------------------------------------------ windings */

inline void turn(Face &face)
{
    std::swap(face[1], face[2]);
}

/* Six times the volume between a face and the origin. */
inline double volume6(const Mesh &mesh, const Face &face)
{
    const Normal n = normal_of(mesh, face);
    const Vertex &a = mesh.vertices[face[0]];

    return double(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
}

/* A connected set of faces. */
struct Part {
    std::vector<uint32_t> faces;
    Vertex low, high; /* box */
    double measure;   /* SOLID: six times the volume; SURFACE: twice the area seen from above */
};

/* Collect the part of a face and give its faces one winding, that of most of them. */
inline Part orient_part(Mesh &mesh, const EdgeUses &uses, uint32_t seed, std::vector<bool> &seen,
                        size_t &turned)
{
    Part part;
    std::map<uint32_t, bool> against; /* the seed's winding, as the file has it */
    size_t count = 0;

    part.faces.push_back(seed);
    seen[seed] = true;
    against[seed] = false;
    for (size_t i = 0; i < part.faces.size(); i++) {
        const uint32_t f = part.faces[i];

        for (size_t k = 0; k < 3; k++) {
            const uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];

            for (const EdgeUse &use : uses.at({std::min(a, b), std::max(a, b)})) {
                const bool differs = against[f] != (use.forward == (a < b));

                if (use.face == f) {
                    continue;
                }
                if (!seen[use.face]) {
                    seen[use.face] = true;
                    against[use.face] = differs;
                    part.faces.push_back(use.face);
                } else if (against[use.face] != differs) {
                    throw Refusal("the faces have no two sides, as on a Moebius strip, near " +
                                  describe(mesh, Edge{a, b}) + ": repair them in the editor");
                }
            }
        }
    }
    for (const auto &[face, differs] : against) {
        count += differs;
    }
    const bool minority = count * 2 <= part.faces.size();

    for (const auto &[face, differs] : against) {
        if (differs == minority) {
            turn(mesh.faces[face]);
            turned++;
        }
    }
    return part;
}

inline void measure(const Mesh &mesh, Part &part)
{
    part.low = part.high = mesh.vertices[mesh.faces[part.faces[0]][0]];
    part.measure = 0;
    for (uint32_t f : part.faces) {
        part.measure +=
            mesh.surface ? double(normal_of(mesh, mesh.faces[f])[2]) : volume6(mesh, mesh.faces[f]);
        for (uint32_t v : mesh.faces[f]) {
            for (size_t k = 0; k < 3; k++) {
                part.low[k] = std::min(part.low[k], mesh.vertices[v][k]);
                part.high[k] = std::max(part.high[k], mesh.vertices[v][k]);
            }
        }
    }
}

inline bool encloses(const Part &outer, const Part &inner)
{
    for (size_t k = 0; k < 3; k++) {
        if (outer.low[k] >= inner.low[k] || outer.high[k] <= inner.high[k]) {
            return false;
        }
    }
    return outer.measure > 0;
}

/* Parts that both are full and whose boxes cross are named: what both hold counts twice. */
inline void note_overlaps(Mesh &mesh, const std::vector<Part> &parts)
{
    const auto box = [&](const Part &part) {
        Point low, high;

        for (size_t k = 0; k < 3; k++) {
            low[k] = std::ldexp(part.low[k], -mesh.bits);
            high[k] = std::ldexp(part.high[k], -mesh.bits);
        }
        return place(low) + " - " + place(high);
    };
    for (size_t i = 0; i < parts.size() && mesh.notes.size() < listed_max; i++) {
        for (size_t j = 0; j < i && mesh.notes.size() < listed_max; j++) {
            bool cross = parts[i].measure > 0 && parts[j].measure > 0;

            for (size_t k = 0; k < 3; k++) {
                cross = cross && parts[i].low[k] < parts[j].high[k] &&
                        parts[j].low[k] < parts[i].high[k];
            }
            if (cross) {
                mesh.notes.push_back("the parts in the boxes " + box(parts[j]) + " and " +
                                     box(parts[i]) +
                                     " may overlap: the volume of what both hold counts twice");
            }
        }
    }
}

/* One winding a part, then outwards (SOLID) or up (SURFACE). A part of negative volume within the
 * box of another is a cavity and stays. */
inline void orient(Mesh &mesh, const EdgeUses &uses)
{
    std::vector<bool> seen(mesh.faces.size());
    std::vector<Part> parts;
    size_t disagreed = 0, inwards = 0, cavities = 0;
    double total = 0;

    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        if (!seen[f]) {
            parts.push_back(orient_part(mesh, uses, f, seen, disagreed));
            measure(mesh, parts.back());
            total += parts.back().measure;
        }
    }
    const auto turn_part = [&](Part &part) {
        for (uint32_t f : part.faces) {
            turn(mesh.faces[f]);
        }
        part.measure = -part.measure;
        inwards += part.faces.size();
    };

    if (total < 0) {
        std::for_each(parts.begin(), parts.end(), turn_part);
    }
    for (Part &part : parts) {
        const bool inside =
            !mesh.surface && std::any_of(parts.begin(), parts.end(),
                                         [&](const Part &other) { return encloses(other, part); });

        if (part.measure < 0 && inside) {
            cavities++;
        } else if (part.measure < 0) {
            turn_part(part);
        }
    }
    if (!mesh.surface) {
        note_overlaps(mesh, parts);
    }
    if (disagreed) {
        mesh.mended.push_back("turned " + counted(disagreed, "face") +
                              " that disagreed with their neighbours");
    }
    if (inwards) {
        mesh.mended.push_back(
            "turned " + counted(inwards, "face") +
            (mesh.surface ? " that looked down" : " of a part that was inside out"));
    }
    if (cavities) {
        mesh.mended.push_back("kept " + counted(cavities, "part") +
                              " of negative volume as hollow");
    }
}

} // namespace mend

#endif

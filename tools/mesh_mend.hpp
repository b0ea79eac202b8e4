/* SPDX-License-Identifier: MIT */
/*
 * mesh_mend - mends single faces of a welded mesh: faces without area and faces given twice. It refuses what it cannot mend.
 */
#ifndef CAROM_TOOLS_MESH_MEND_HPP
#define CAROM_TOOLS_MESH_MEND_HPP

#include "mesh_edges.hpp"

namespace mend
{

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

/* Three corners can have two windings; this tells them apart. */
inline bool winding(Face f)
{
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f[1] < f[2];
}

/*
 * Faces with the same corners. Two with one winding are a face given twice. Two with opposite
 * windings are a plate that the weld made flat; it bounds nothing, so both are removed.
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

/*
 * Mend one face whose corners lie on a line. Its middle corner lies on the edge of the other two.
 * So the neighbour across that edge is cut in two there, and the second half takes the face's
 * place. At a border there is no neighbour, and the face is removed: its other two edges are the
 * border.
 */
inline bool mend_sliver(Mesh &mesh, uint32_t sliver, const EdgeUses &uses, std::vector<bool> &gone,
                        std::vector<bool> &touched)
{
    Face corners = mesh.faces[sliver];

    std::sort(corners.begin(), corners.end(),
              [&](uint32_t a, uint32_t b) { return mesh.vertices[a] < mesh.vertices[b]; });

    if (touched[sliver]) {
        return false; /* its edges are newer than `uses`: the next round mends it */
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
                      " after welding, but at most 65535 of each are possible: bring it down with "
                      "--simplify");
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

} // namespace mend

#endif

/* SPDX-License-Identifier: MIT */
/*
 * mesh_simplify - reduces a welded mesh to a number of faces, with meshoptimizer. It removes vertices and moves none, so the rest lies on
 * the quanta of the mesh.
 */
#ifndef CAROM_TOOLS_MESH_SIMPLIFY_HPP
#define CAROM_TOOLS_MESH_SIMPLIFY_HPP

#include <meshoptimizer.h>

#include "mesh_mend.hpp"
#include "mesh_parts.hpp"

namespace mend
{

/* The mesh that meshoptimizer makes; `error` gets the distance that it reports, in units. */
inline Mesh simplified(const Mesh &mesh, size_t target, double &error)
{
    std::vector<float> positions;
    std::vector<unsigned> in, out(mesh.faces.size() * 3);
    float relative = 0;
    Mesh result = mesh;

    for (const Vertex &v : mesh.vertices) {
        positions.insert(positions.end(), {float(v[0]), float(v[1]), float(v[2])});
    }
    for (const Face &f : mesh.faces) {
        in.insert(in.end(), f.begin(), f.end());
    }
    out.resize(meshopt_simplify(out.data(), in.data(), in.size(), positions.data(),
                                mesh.vertices.size(), 3 * sizeof(float), target * 3, 1e9f, 0,
                                &relative));
    const double extent =
        meshopt_simplifyScale(positions.data(), mesh.vertices.size(), 3 * sizeof(float));

    error = std::ldexp(double(relative) * extent, -mesh.bits);
    result.faces.clear();
    for (size_t i = 0; i < out.size(); i += 3) {
        result.faces.push_back({out[i], out[i + 1], out[i + 2]});
    }
    return result;
}

/* For each face a number that it shares with the faces connected to it by edges of two faces. */
inline std::vector<uint32_t> sheets_of(const Mesh &mesh, const EdgeUses &uses)
{
    std::vector<uint32_t> sheet(mesh.faces.size());

    for (uint32_t f = 0; f < sheet.size(); f++) {
        sheet[f] = f;
    }
    const auto root = [&](uint32_t f) {
        while (sheet[f] != f) {
            f = sheet[f] = sheet[sheet[f]];
        }
        return f;
    };
    for (const auto &[edge, faces] : uses) {
        if (faces.size() == 2) {
            sheet[root(faces[0].face)] = root(faces[1].face);
        }
    }
    for (uint32_t f = 0; f < sheet.size(); f++) {
        sheet[f] = root(f);
    }
    return sheet;
}

/*
 * The library may pinch off a small bubble, which then hangs at one edge with four faces. Where
 * more than two faces share an edge, only the largest of their sheets stays.
 */
inline void drop_bubbles(Mesh &mesh)
{
    const EdgeUses uses = edges_of(mesh);
    const std::vector<uint32_t> sheet = sheets_of(mesh, uses);
    std::vector<size_t> size(mesh.faces.size());
    std::set<uint32_t> gone;
    std::vector<Face> kept;

    for (uint32_t s : sheet) {
        size[s]++;
    }
    for (const auto &[edge, faces] : uses) {
        const auto larger = [&](const EdgeUse &a, const EdgeUse &b) {
            return size[sheet[a.face]] < size[sheet[b.face]];
        };
        const uint32_t main = sheet[std::max_element(faces.begin(), faces.end(), larger)->face];

        for (const EdgeUse &use : faces) {
            if (faces.size() > 2 && sheet[use.face] != main) {
                gone.insert(sheet[use.face]);
            }
        }
    }
    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        if (!gone.count(sheet[f])) {
            kept.push_back(mesh.faces[f]);
        }
    }
    mesh.faces = kept;
}

/* Vertices minus edges plus faces: 2 for each ball, 0 for each torus. */
inline int64_t euler_number(const Mesh &mesh, const EdgeUses &uses)
{
    return int64_t(mesh.vertices.size()) - int64_t(uses.size()) + int64_t(mesh.faces.size());
}

/* True if all edges are sound, all faces have an area, and no part or handle is lost. */
inline bool is_sound(const Mesh &mesh, size_t parts, int64_t euler)
{
    try {
        const EdgeUses uses = edges_of(mesh);
        Mesh copy = mesh;

        check_faces(mesh);
        check_crowded(mesh, uses);
        check_open(mesh, uses);
        return parts_of(copy, uses).size() == parts && euler_number(mesh, uses) == euler;
    } catch (const Refusal &) {
        return false;
    }
}

inline double measure_of(const std::vector<Part> &parts)
{
    double sum = 0;

    for (const Part &part : parts) {
        sum += std::fabs(part.measure);
    }
    return sum;
}

/* Simplify and mend; false if the result is not sound. */
inline bool try_simplify(Mesh &less, const Mesh &mesh, size_t parts, size_t target, double &error)
{
    const int64_t euler = euler_number(mesh, edges_of(mesh));

    less = simplified(mesh, target, error);
    drop_collapsed_faces(less);
    drop_double_faces(less);
    mend_slivers(less);
    drop_bubbles(less);
    drop_unused_vertices(less);
    less.mended = mesh.mended;
    return !less.faces.empty() && is_sound(less, parts, euler);
}

[[noreturn]] inline void refuse_simplify(const Mesh &mesh, size_t parts, size_t most)
{
    size_t target = most;
    Mesh less = mesh;
    double error;

    do {
        target += 1 + target / 4;
    } while (target < mesh.faces.size() && !try_simplify(less, mesh, parts, target, error));
    throw Refusal(format("--simplify %zu cannot be reached: %zu faces can, of %zu, with all parts "
                         "and handles of the mesh kept",
                         most, target < mesh.faces.size() ? less.faces.size() : mesh.faces.size(),
                         mesh.faces.size()));
}

/*
 * Reduce a mesh to at most so many faces. If the result is not sound (two sheets share an edge), try
 * fewer faces: the library then removes other vertices.
 *
 * parts  the parts of the mesh before that
 */
inline void simplify(Mesh &mesh, const std::vector<Part> &parts, size_t most)
{
    const size_t attempts = 12, before = mesh.faces.size();
    Mesh less;
    double error = 0;

    for (size_t i = 0; i < attempts; i++) {
        if (try_simplify(less, mesh, parts.size(), most - most * i / (2 * attempts), error) &&
            less.faces.size() <= most) {
            Mesh copy = less;
            const double ratio = measure_of(parts_of(copy, edges_of(copy))) / measure_of(parts);

            mesh = less;
            mesh.mended.push_back(
                format("simplified %zu faces to %zu, about %.3g units off; %s %+.3g %%", before,
                       mesh.faces.size(), error, mesh.surface ? "area from above" : "volume",
                       100 * (ratio - 1)));
            return;
        }
    }
    refuse_simplify(mesh, parts.size(), most);
}

} // namespace mend

#endif

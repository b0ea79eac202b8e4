/* SPDX-License-Identifier: MIT */
/*
 * mesh_simplify - brings a welded mesh down to a number of faces, with meshoptimizer. It leaves out
 * vertices and moves none, so what is left lies on the quanta of the mesh.
 */
#ifndef CAROM_TOOLS_MESH_SIMPLIFY_HPP
#define CAROM_TOOLS_MESH_SIMPLIFY_HPP

#include <meshoptimizer.h>

#include "mesh_mend.hpp"
#include "mesh_parts.hpp"

namespace mend
{

/* What meshoptimizer makes of a mesh; `error` gets the distance that it tells, in units. */
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

/* Whether all edges are as they must be, and all faces have an area. */
inline bool is_sound(const Mesh &mesh)
{
    try {
        const EdgeUses uses = edges_of(mesh);
        Mesh copy = mesh;

        check_faces(mesh);
        check_crowded(mesh, uses);
        check_open(mesh, uses);
        parts_of(copy, uses);
    } catch (const Refusal &) {
        return false;
    }
    return true;
}

inline double measure_of(const std::vector<Part> &parts)
{
    double sum = 0;

    for (const Part &part : parts) {
        sum += std::fabs(part.measure);
    }
    return sum;
}

/*
 * Bring a mesh to at most so many faces. Where what is left is not sound (two sheets that came to
 * share an edge), fewer faces are tried: the library then takes other vertices away.
 *   parts  those of the mesh as it is
 */
inline void simplify(Mesh &mesh, const std::vector<Part> &parts, size_t most)
{
    const size_t before = mesh.faces.size();
    size_t reached = before;
    double error = 0;

    for (size_t attempt = 0; attempt < 12; attempt++) {
        Mesh less = simplified(mesh, most - most * attempt / 24, error);

        less.mended.clear();
        drop_collapsed_faces(less);
        drop_double_faces(less);
        mend_slivers(less);
        drop_unused_vertices(less);
        if (less.faces.empty() || !is_sound(less)) {
            continue;
        }
        reached = std::min(reached, less.faces.size());
        if (less.faces.size() > most) {
            continue;
        }
        less.mended = mesh.mended;
        mesh = less;

        const double ratio = measure_of(parts_of(less, edges_of(less))) / measure_of(parts);

        mesh.mended.push_back(
            format("simplified %zu faces to %zu, at most %.3g units off; %s %+.3g %%", before,
                   mesh.faces.size(), error, mesh.surface ? "area from above" : "volume",
                   100 * (ratio - 1)));
        return;
    }
    throw Refusal(format("--simplify %zu: the fewest faces that were reached with the mesh still "
                         "sound are %zu, of %zu; give a larger number",
                         most, reached, before));
}

} // namespace mend

#endif

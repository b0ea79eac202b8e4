/* SPDX-License-Identifier: MIT */
/* mesh_make - the steps from the contents of a file to a mesh that the engine takes. */
#ifndef CAROM_TOOLS_MESH_MAKE_HPP
#define CAROM_TOOLS_MESH_MAKE_HPP

#include "mesh_check.hpp"
#include "mesh_close.hpp"
#include "mesh_parts.hpp"
#include "mesh_simplify.hpp"

namespace mend
{

/* Mend single faces. */
inline void mend_faces(Mesh &mesh)
{
    drop_collapsed_faces(mesh);
    drop_double_faces(mesh);
    mend_slivers(mesh);
    drop_unused_vertices(mesh);
    check_faces(mesh);
}

inline void close_mesh(Mesh &mesh)
{
    const EdgeUses uses = edges_of(mesh);

    check_crowded(mesh, uses);
    parts_of(mesh, uses); /* the windings distinguish a ring from two discs */
    close_holes(mesh, uses);
}

inline Mesh make_mesh(const Soup &soup, bool surface, int asked_bits, const Repairs &repairs)
{
    Mesh mesh = weld(soup, surface, choose_bits(soup.points, asked_bits));

    if (!repairs.most_faces) {
        check_counts(mesh);
    }
    mend_faces(mesh);
    check_size(mesh);
    if (repairs.close) {
        close_mesh(mesh);
    }

    EdgeUses uses = edges_of(mesh);

    check_crowded(mesh, uses);
    check_open(mesh, uses);
    std::vector<Part> parts = parts_of(mesh, uses);

    if (repairs.most_faces && mesh.faces.size() > repairs.most_faces) {
        simplify(mesh, parts, repairs.most_faces);
        uses = edges_of(mesh);
        parts = parts_of(mesh, uses);
    }
    check_counts(mesh);
    arrange(mesh, parts, repairs.overlaps);
    mesh.edges = edges_of(mesh).size();
    if (surface) {
        check_looks_up(mesh);
        check_single_layer(mesh);
    } else if (mass_of(mesh).volume <= 0) {
        throw Refusal("the mesh has no volume: for a height field use --surface");
    }
    return mesh;
}

} // namespace mend

#endif

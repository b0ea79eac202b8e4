/* SPDX-License-Identifier: MIT */
/* Indexed meshes as C source, to lie in ROM. */
#include "mesh_rom.hpp"

#include <sstream>

namespace
{

template <typename Number> std::string list(const Number *numbers, int count)
{
    std::string text = "{";

    for (int i = 0; i < count; i++) {
        text += (i ? ", " : "") + std::to_string(numbers[i]);
    }
    return text + "}";
}

std::string sym3(const carom_sym3 &m)
{
    return "{" + list(m.m, 6) + ", " + std::to_string(m.e) + "}";
}

std::string spread(const carom_spread &s)
{
    std::string all = "{{";

    for (const auto &column : s.column) {
        all += list(column, 3) + ", ";
    }
    return all + "}, " + list(s.e, 3) + ", " + std::to_string(s.reach_bits) + "}";
}

/* An array of `count` elements, each written by `element`. */
template <typename Element>
void array(std::ostream &out, const std::string &declaration, size_t count, Element element)
{
    out << "static const " << declaration << " = {\n";
    for (size_t i = 0; i < count; i++) {
        out << "    " << element(i) << ",\n";
    }
    out << "};\n";
}

std::string face(const carom_face &f)
{
    return "{{" + list(f.normal.c, 3) + "}, " + std::to_string(f.offset_q22) + ", " +
           list(f.edge, 3) + ", " + std::to_string(f.own) + ", " + std::to_string(f.behind) + "}";
}

std::string edge(const carom_edge &e)
{
    return "{" + list(e.vertex, 2) + ", " + list(e.face, 2) + ", {" + list(e.direction.c, 3) +
           "}, " + std::to_string(e.length_q22) + "}";
}

std::string leaf(const carom_leaf &l)
{
    const int64_t rest[] = {l.low_q22,      l.high_q22,   l.owned,       l.first_face,
                            l.first_vertex, l.face_count, l.vertex_count};
    std::string text = "{{" + list(l.centre.c, 3) + "}, " + std::to_string(l.radius_q22) + ", {" +
                       list(l.axis.c, 3) + "}";

    for (int64_t number : rest) {
        text += ", " + std::to_string(number);
    }
    return text + "}";
}

/* The sums of vertices and faces that the leaves name. */
size_t leaf_vertices(const carom_mesh &mesh)
{
    const carom_leaf &last = mesh.leaves[mesh.leaf_count - 1];

    return last.first_vertex + last.vertex_count;
}

size_t leaf_faces(const carom_mesh &mesh)
{
    const carom_leaf &last = mesh.leaves[mesh.leaf_count - 1];

    return last.first_face + last.face_count;
}

void write_arrays(std::ostream &out, const carom_mesh &mesh, const std::string &name)
{
    const size_t cells = size_t(mesh.grid_nx) * mesh.grid_ny;
    const auto number = [](auto numbers) {
        return [numbers](size_t i) { return std::to_string(numbers[i]); };
    };

    array(out, "int16_t " + name + "_vertices[][3]", mesh.raw.vertex_count,
          [&](size_t i) { return list(mesh.raw.vertices[i], 3); });
    array(out, "uint16_t " + name + "_corners[][3]", mesh.raw.face_count,
          [&](size_t i) { return list(mesh.raw.faces[i], 3); });
    array(out, "struct carom_face " + name + "_faces[]", mesh.raw.face_count,
          [&](size_t i) { return face(mesh.faces[i]); });
    array(out, "struct carom_edge " + name + "_edges[]", mesh.edge_count,
          [&](size_t i) { return edge(mesh.edges[i]); });
    array(out, "uint32_t " + name + "_ring_start[]", mesh.raw.vertex_count + 1,
          number(mesh.ring_start));
    array(out, "uint32_t " + name + "_ring[]", mesh.ring_start[mesh.raw.vertex_count],
          number(mesh.ring));
    array(out, "struct carom_leaf " + name + "_leaves[]", mesh.leaf_count,
          [&](size_t i) { return leaf(mesh.leaves[i]); });
    array(out, "uint16_t " + name + "_leaf_faces[]", leaf_faces(mesh), number(mesh.leaf_faces));
    array(out, "uint16_t " + name + "_leaf_vertices[]", leaf_vertices(mesh),
          number(mesh.leaf_vertices));
    array(out, "uint8_t " + name + "_leaf_corners[][3]", leaf_faces(mesh),
          [&](size_t i) { return list(mesh.leaf_corners[i], 3); });
    array(out, "uint32_t " + name + "_cell_start[]", cells + 1, number(mesh.cell_start));
    array(out, "struct carom_zref " + name + "_zrefs[]", mesh.zref_count, [&](size_t i) {
        const int32_t numbers[] = {mesh.zrefs[i].z0, mesh.zrefs[i].z1, mesh.zrefs[i].face};

        return list(numbers, 3);
    });
}

} // namespace

int rom::index(carom_mesh &mesh, const carom_mesh_raw &raw, std::vector<uint64_t> &memory)
{
    memory.resize(CAROM_MESH_BYTES(raw.vertex_count, raw.face_count) / 8);
    return carom_mesh_build(&mesh, &raw, memory.data(), memory.size() * 8);
}

std::string rom::c_source(const carom_mesh &mesh, const std::string &name, bool is_static)
{
    const carom_mass &mass = mesh.mass;
    std::ostringstream out;

    write_arrays(out, mesh, name);
    out << (is_static ? "static " : "") << "const struct carom_mesh " << name << " = {\n"
        << "    .raw = {" << name << "_vertices, " << name << "_corners, " << mesh.raw.vertex_count
        << ", " << mesh.raw.face_count << ", " << int(mesh.raw.quantum_bits) << ", "
        << (mesh.raw.kind == CAROM_SURFACE ? "CAROM_SURFACE" : "CAROM_SOLID") << "},\n"
        << "    .mass = {INT64_C(" << mass.volume_q32 << "), {" << list(mass.centre.c, 3) << "}, "
        << sym3(mass.inertia) << "},\n"
        << "    .inverse = " << sym3(mesh.inverse) << ",\n"
        << "    .inverse_rest = " << sym3(mesh.inverse_rest) << ",\n"
        << "    .spread = " << spread(mesh.spread) << ",\n"
        << "    .edge_count = " << mesh.edge_count << ",\n"
        << "    .leaf_count = " << mesh.leaf_count << ",\n"
        << "    .zref_count = " << mesh.zref_count << ",\n"
        << "    .radius_q22 = " << mesh.radius_q22 << ",\n"
        << "    .box = {" << list(mesh.box[0], 3) << ", " << list(mesh.box[1], 3) << "},\n"
        << "    .grid_x0 = " << mesh.grid_x0 << ",\n"
        << "    .grid_y0 = " << mesh.grid_y0 << ",\n"
        << "    .grid_shift = " << int(mesh.grid_shift) << ",\n"
        << "    .grid_nx = " << int(mesh.grid_nx) << ",\n"
        << "    .grid_ny = " << int(mesh.grid_ny) << ",\n";
    for (const char *part : {"faces", "edges", "ring_start", "ring", "leaves", "leaf_faces",
                             "leaf_vertices", "leaf_corners", "cell_start", "zrefs"}) {
        out << "    ." << part << " = " << name << "_" << part << ",\n";
    }
    out << "};\n";
    return out.str();
}

/* SPDX-License-Identifier: MIT */
/* mesh_write - a mesh as a C source, indexed or not, or as a binary blob; files are whole or absent. */
#ifndef CAROM_TOOLS_MESH_WRITE_HPP
#define CAROM_TOOLS_MESH_WRITE_HPP

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mesh_rom.hpp"
#include "mesh_soup.hpp"

namespace mend
{

/* A line of three numbers each. */
template <typename Triple> void write_triples(std::ostream &out, const std::vector<Triple> &triples)
{
    for (const Triple &t : triples) {
        out << "    {" << t[0] << ", " << t[1] << ", " << t[2] << "},\n";
    }
}

inline std::string c_head(const std::string &from)
{
    return "/* SPDX-License-Identifier: MIT */\n/* Made by carom-mesh from " +
           std::filesystem::path(from).filename().string() +
           ": do not edit. */\n#include \"carom.h\"\n\n";
}

/* prefix: the prefix of the names of its arrays. */
inline std::string c_source(const Mesh &mesh, const std::string &name, const std::string &prefix)
{
    std::ostringstream out;

    out << "extern const struct carom_mesh_raw " << name << ";\n\n"
        << "static const int16_t " << prefix << "vertices[" << mesh.vertices.size() << "][3] = {\n";
    write_triples(out, mesh.vertices);
    out << "};\n\nstatic const uint16_t " << prefix << "faces[" << mesh.faces.size()
        << "][3] = {\n";
    write_triples(out, mesh.faces);
    out << "};\n\nconst struct carom_mesh_raw " << name << " = {\n"
        << "    .vertices = " << prefix << "vertices,\n"
        << "    .faces = " << prefix << "faces,\n"
        << "    .vertex_count = " << mesh.vertices.size() << ",\n"
        << "    .face_count = " << mesh.faces.size() << ",\n"
        << "    .quantum_bits = " << mesh.bits << ",\n"
        << "    .kind = " << (mesh.surface ? "CAROM_SURFACE" : "CAROM_SOLID") << ",\n"
        << "};\n";
    return out.str();
}

/* A mesh as the engine indexes it, with the memory to which it refers. */
struct Indexed {
    std::vector<std::array<int16_t, 3>> vertices;
    std::vector<std::array<uint16_t, 3>> faces;
    std::vector<uint64_t> memory;
    carom_mesh mesh;

    explicit Indexed(const Mesh &from)
    {
        for (const Vertex &v : from.vertices) {
            vertices.push_back({int16_t(v[0]), int16_t(v[1]), int16_t(v[2])});
        }
        for (const Face &f : from.faces) {
            faces.push_back({uint16_t(f[0]), uint16_t(f[1]), uint16_t(f[2])});
        }

        const carom_mesh_raw raw = {reinterpret_cast<const int16_t(*)[3]>(vertices.data()),
                                    reinterpret_cast<const uint16_t(*)[3]>(faces.data()),
                                    uint32_t(vertices.size()),
                                    uint32_t(faces.size()),
                                    uint8_t(from.bits),
                                    uint8_t(from.surface ? CAROM_SURFACE : CAROM_SOLID)};

        if (const int result = rom::index(mesh, raw, memory)) {
            throw Refusal(std::string("the engine does not take it: ") + carom_result_text(result));
        }
    }
    Indexed(const Indexed &) = delete;
};

/* The same, indexed. */
inline std::string c_source_indexed(const Mesh &mesh, const std::string &name)
{
    return "extern const struct carom_mesh " + name + ";\n\n" +
           rom::c_source(Indexed(mesh).mesh, name, false);
}

/* Append the low bytes of a number, lowest first. */
inline void put(std::string &blob, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        blob += static_cast<char>(number >> (8 * i) & 0xff);
    }
}

/* The layout that carom_mesh_read reads (src/mesh/blob.c). */
inline std::string binary_blob(const Mesh &mesh)
{
    std::string blob = "CRM1";
    uint64_t hash = 0xcbf29ce484222325u; /* 64-bit FNV-1a */

    put(blob, 1, 1);
    put(blob, mesh.surface, 1);
    put(blob, uint64_t(mesh.bits), 1);
    put(blob, 0, 1);
    put(blob, mesh.vertices.size(), 4);
    put(blob, mesh.faces.size(), 4);
    for (const Vertex &v : mesh.vertices) {
        for (int32_t c : v) {
            put(blob, uint64_t(c), 2);
        }
    }
    for (const Face &f : mesh.faces) {
        for (uint32_t v : f) {
            put(blob, v, 2);
        }
    }
    for (char c : blob) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    put(blob, hash, 8);
    return blob;
}

inline void write_file(const std::string &path, const std::string &content)
{
    std::ofstream file(path, std::ios::binary);

    file << content;
    file.close();
    if (!file) {
        std::remove(path.c_str());
        throw Refusal("cannot write " + path + ": check the folder and the space on the disk");
    }
}

struct Output {
    std::string path, content;
};

/* Write all files or none. */
inline void write_files(const std::vector<Output> &outputs)
{
    size_t written = 0;

    try {
        for (const Output &output : outputs) {
            write_file(output.path, output.content);
            written++;
        }
    } catch (const Refusal &) {
        while (written > 0) {
            std::remove(outputs[--written].path.c_str());
        }
        throw;
    }
}

} // namespace mend

#endif

/* SPDX-License-Identifier: MIT */
/*
 * mesh_read - reads a mesh file of any format through assimp and joins all its meshes, each with
 * the transform of its node. First it detects incomplete files that assimp accepts as complete.
 */
#ifndef CAROM_TOOLS_MESH_READ_HPP
#define CAROM_TOOLS_MESH_READ_HPP

#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/time.h>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "mesh_soup.hpp"

namespace mend
{

/* ------------------------------------------------------------- is it all there */

inline void check_readable(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);

    if (!file || std::filesystem::is_directory(path)) {
        throw Refusal("cannot be opened: check the path");
    }
    if (file.peek() == std::ifstream::traits_type::eof()) {
        throw Refusal("the file is empty: export the mesh again");
    }
}

inline std::string extension(const std::string &path)
{
    std::string text = std::filesystem::path(path).extension().string();

    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return text;
}

constexpr char truncated[] = "the file is truncated: export the mesh again";

/* assimp accepts a text STL that stops early. */
inline void check_stl_is_whole(const std::string &path)
{
    std::ifstream file(path);
    std::string word;
    bool facets = false, ended = false;

    if (!(file >> word) || word != "solid") {
        return; /* binary: assimp compares its length */
    }
    while (file >> word) {
        facets = facets || word == "facet";
        ended = word == "endsolid" || (ended && word != "facet");
    }
    if (facets && !ended) {
        throw Refusal(std::string(truncated) + " (a text STL ends with 'endsolid')");
    }
}

/* A property of a PLY element: one number, or a number of items and the items. */
struct PlyProperty {
    size_t size = 0;       /* bytes of the number or of an item */
    size_t count_size = 0; /* bytes of the number of items; 0: not a list */
};

struct PlyElement {
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat { text, little, big };

inline size_t ply_type_size(const std::string &type)
{
    static const std::map<std::string, size_t> sizes = {
        {"char", 1},  {"uchar", 1},   {"short", 2},  {"ushort", 2},  {"int", 4},   {"uint", 4},
        {"int8", 1},  {"uint8", 1},   {"int16", 2},  {"uint16", 2},  {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8},
    };
    const auto entry = sizes.find(type);

    if (entry == sizes.end()) {
        throw Refusal("the header names an unknown type '" + type + "': export the mesh again");
    }
    return entry->second;
}

inline std::vector<PlyElement> read_ply_header(std::istream &file, PlyFormat &format)
{
    std::vector<PlyElement> elements;
    std::string line;

    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string keyword, type, count_type;

        words >> keyword >> type;
        if (keyword == "end_header") {
            return elements;
        }
        if (keyword == "format") {
            format = type == "ascii"               ? PlyFormat::text
                     : type == "binary_big_endian" ? PlyFormat::big
                                                   : PlyFormat::little;
        } else if (keyword == "element") {
            elements.emplace_back();
            words >> elements.back().count;
        } else if (keyword == "property" && !elements.empty()) {
            PlyProperty property;

            if (type == "list") {
                words >> count_type >> type;
                property.count_size = ply_type_size(count_type);
            }
            property.size = ply_type_size(type);
            elements.back().properties.push_back(property);
        }
    }
    throw Refusal(truncated);
}

/* Read a number of items; false at the end of the file. */
inline bool read_ply_count(std::istream &file, PlyFormat format, size_t size, uint64_t &count)
{
    unsigned char bytes[8];

    if (format == PlyFormat::text) {
        return bool(file >> count);
    }
    file.read(reinterpret_cast<char *>(bytes), std::streamsize(size));
    count = 0;
    for (size_t i = 0; i < size; i++) {
        count = count << 8 | bytes[format == PlyFormat::big ? i : size - 1 - i];
    }
    return bool(file);
}

inline bool skip_ply_items(std::istream &file, PlyFormat format, size_t size, uint64_t count)
{
    std::string word;

    for (uint64_t i = 0; i < count; i++) {
        if (format == PlyFormat::text) {
            file >> word;
        } else {
            file.ignore(std::streamsize(size));
        }
        if (!file || (format != PlyFormat::text && file.gcount() != std::streamsize(size))) {
            return false;
        }
    }
    return true;
}

/* assimp fills in zeros where a PLY is too short, or reads past its end. */
inline void check_ply_is_whole(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    PlyFormat format = PlyFormat::text;

    for (const PlyElement &element : read_ply_header(file, format)) {
        if (element.count > 0 && element.properties.empty()) {
            /* it takes no bytes, so the end of the file would not stop its count, here or in assimp */
            throw Refusal("the header has an element without properties: export the mesh again");
        }
        for (uint64_t i = 0; i < element.count; i++) {
            for (const PlyProperty &property : element.properties) {
                uint64_t items = 1;

                if ((property.count_size &&
                     !read_ply_count(file, format, property.count_size, items)) ||
                    !skip_ply_items(file, format, property.size, items)) {
                    throw Refusal(truncated);
                }
            }
        }
    }
}

/* An OBJ has no mark of its end, but its last line should have a line end. */
inline std::string doubt_about_obj(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);

    file.seekg(-1, std::ios::end);
    return file.get() == '\n' ? "" : "the last line has no end: the file may be truncated";
}

/* ------------------------------------------------------------------- joining */

inline void check_finite(const Point &p)
{
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
        throw Refusal("the vertex " + place(p) +
                      " is not a finite number: repair it in the editor");
    }
}

/*
 * assimp fills a list that a text PLY cuts off with zeros, up to any count. It takes minutes to
 * cut that polygon into triangles. A polygon round holes passes some vertices twice.
 */
inline void check_corners(const aiMesh &mesh)
{
    for (unsigned i = 0; i < mesh.mNumFaces; i++) {
        const unsigned corners = mesh.mFaces[i].mNumIndices;

        if (corners / 2 > mesh.mNumVertices) {
            throw Refusal("a face has " + std::to_string(corners) + " corners, and the mesh " +
                          std::to_string(mesh.mNumVertices) +
                          " vertices: the file is damaged; export the mesh again");
        }
    }
}

inline void join_mesh(Soup &soup, const aiMesh &in, const aiMatrix4x4 &m, double scale)
{
    const uint32_t base = static_cast<uint32_t>(soup.points.size());
    const bool mirrored = m.Determinant() < 0;

    for (unsigned i = 0; i < in.mNumVertices; i++) {
        const aiVector3D &v = in.mVertices[i];
        Point p = {
            (double(m.a1) * v.x + double(m.a2) * v.y + double(m.a3) * v.z + double(m.a4)) * scale,
            (double(m.b1) * v.x + double(m.b2) * v.y + double(m.b3) * v.z + double(m.b4)) * scale,
            (double(m.c1) * v.x + double(m.c2) * v.y + double(m.c3) * v.z + double(m.c4)) * scale,
        };

        check_finite(p);
        soup.points.push_back(p);
    }
    for (unsigned i = 0; i < in.mNumFaces; i++) {
        const aiFace &f = in.mFaces[i];

        if (f.mNumIndices == 3) { /* points and lines are no part of a mesh of faces */
            soup.faces.push_back({base + f.mIndices[0], base + f.mIndices[mirrored ? 2 : 1],
                                  base + f.mIndices[mirrored ? 1 : 2]});
        }
    }
}

inline void join_nodes(Soup &soup, const aiScene &scene, const aiNode &node,
                       const aiMatrix4x4 &parent, double scale, const std::string &object)
{
    const aiMatrix4x4 transform = parent * node.mTransformation;

    const std::string name = node.mName.C_Str();
    const bool taken = object.empty() || name == object;

    if (node.mNumMeshes) {
        soup.objects.push_back(name);
    }
    for (unsigned i = 0; i < node.mNumMeshes && taken; i++) {
        join_mesh(soup, *scene.mMeshes[node.mMeshes[i]], transform, scale);
    }
    for (unsigned i = 0; i < node.mNumChildren; i++) {
        /* all nodes below an object belong to it */
        join_nodes(soup, scene, *node.mChildren[i], transform, scale, taken ? "" : object);
    }
}

/* Each node that has faces, as its own soup. */
inline void part_nodes(std::vector<Soup> &parts, const Soup &file, const aiScene &scene,
                       const aiNode &node, const aiMatrix4x4 &parent, double scale)
{
    const aiMatrix4x4 transform = parent * node.mTransformation;
    Soup soup = file;

    for (unsigned i = 0; i < node.mNumMeshes; i++) {
        join_mesh(soup, *scene.mMeshes[node.mMeshes[i]], transform, scale);
    }
    if (!soup.faces.empty()) {
        soup.objects = {node.mName.C_Str()};
        parts.push_back(soup);
    }
    for (unsigned i = 0; i < node.mNumChildren; i++) {
        part_nodes(parts, file, scene, *node.mChildren[i], transform, scale);
    }
}

/* Polygons of the whole node tree: a mesh counts once for each placement. */
inline size_t count_polygons(const aiScene &scene, const aiNode &node)
{
    size_t count = 0;

    for (unsigned i = 0; i < node.mNumMeshes; i++) {
        const aiMesh &mesh = *scene.mMeshes[node.mMeshes[i]];

        count += size_t(std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                                      [](const aiFace &f) { return f.mNumIndices >= 3; }));
    }
    for (unsigned i = 0; i < node.mNumChildren; i++) {
        count += count_polygons(scene, *node.mChildren[i]);
    }
    return count;
}

/*
 * assimp returns an OBJ's corners in the order of the faces; its `v` lines have the file's own
 * order.
 */
inline std::vector<Point> obj_vertex_order(const std::string &path, double scale)
{
    std::ifstream file(path);
    std::vector<Point> order;
    std::string line;

    while (std::getline(file, line)) {
        Point p;

        if (std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3) {
            for (double &c : p) {
                c *= scale;
            }
            check_finite(p);
            order.push_back(p);
        }
    }
    return order;
}

/* ------------------------------------------------------------------- reading */

/* Keeps assimp's complaints for the text of a refusal. */
class Complaints : public Assimp::LogStream
{
  public:
    explicit Complaints(std::string &text) : text_(text)
    {
    }
    void write(const char *message) override
    {
        text_ += std::string("\n  ") + message;
        while (!text_.empty() && text_.back() == '\n') {
            text_.pop_back();
        }
    }

  private:
    std::string &text_;
};

/*
 * Ends the process by SIGVTALRM when reading takes more of the processor's time than any file needs:
 * assimp may not come back from a damaged one. A whole file takes less than a second a megabyte.
 */
class TimeLimit
{
  public:
    explicit TimeLimit(const std::string &path)
    {
        set(10 + 4 * time_t(std::filesystem::file_size(path) >> 20));
    }
    ~TimeLimit()
    {
        set(0);
    }

  private:
    static void set(time_t seconds)
    {
        const itimerval once = {{0, 0}, {seconds, 0}};

        setitimer(ITIMER_VIRTUAL, &once, nullptr);
    }
};

struct LoggerEnd {
    ~LoggerEnd()
    {
        Assimp::DefaultLogger::kill();
    }
};

/* Read a file before assimp does: what looks odd about it, and its vertices in its own order. */
inline Soup examine(const std::string &path, double scale)
{
    const std::string kind = extension(path);
    Soup soup;

    check_readable(path);
    if (kind == ".stl") {
        check_stl_is_whole(path);
    } else if (kind == ".ply") {
        check_ply_is_whole(path);
    } else if (kind == ".obj") {
        soup.doubt = doubt_about_obj(path);
        soup.order = obj_vertex_order(path, scale);
    }
    return soup;
}

/* The scene of a file, its polygons cut into triangles, and their number. */
inline const aiScene &read_scene(Assimp::Importer &importer, const std::string &path,
                                 size_t &polygons)
{
    std::string complaints;
    const LoggerEnd end; /* declared first, so that it ends before the text that the logger writes
                          * to is gone */

    Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Complaints(complaints),
                                               Assimp::Logger::Err | Assimp::Logger::Warn);
    const TimeLimit limit(path);
    const aiScene *scene = importer.ReadFile(path, 0);

    if (!scene || !scene->mRootNode) {
        throw Refusal(
            "cannot be read: it is truncated or not a mesh file; export it again, e.g. as OBJ" +
            complaints);
    }
    polygons = count_polygons(*scene, *scene->mRootNode);
    if (polygons == 0) {
        throw Refusal("holds no faces: export the mesh, not only its points" + complaints);
    }
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const aiMesh &mesh = *scene->mMeshes[i];

        for (unsigned k = 0; k < mesh.mNumVertices; k++) {
            check_finite({mesh.mVertices[k].x, mesh.mVertices[k].y, mesh.mVertices[k].z});
        }
        check_corners(mesh);
    }
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (!scene) {
        throw Refusal("its polygons cannot be cut into triangles: triangulate it in the editor");
    }
    return *scene;
}

/* Every object of a file, or the one of a name with all objects below it. */
inline Soup read_file(const std::string &path, double scale, const std::string &object)
{
    Assimp::Importer importer;
    Soup soup = examine(path, scale);
    const aiScene &scene = read_scene(importer, path, soup.polygons);

    join_nodes(soup, scene, *scene.mRootNode, aiMatrix4x4(), scale, object);
    if (soup.faces.empty()) {
        throw Refusal("has no faces of an object '" + object + "'; it has" + listed(soup.objects));
    }
    soup.materials = scene.mNumMaterials;
    return soup;
}

/* Each object of a file by itself. */
inline std::vector<Soup> read_objects(const std::string &path, double scale)
{
    Assimp::Importer importer;
    std::vector<Soup> parts;
    size_t polygons;
    const Soup file = examine(path, scale);
    const aiScene &scene = read_scene(importer, path, polygons);

    part_nodes(parts, file, scene, *scene.mRootNode, aiMatrix4x4(), scale);
    return parts;
}

} // namespace mend

#endif

/* SPDX-License-Identifier: MIT */
/*
 * carom-mesh - turns a mesh file of any format that assimp reads into a mesh for Carom.
 *
 *   read     every mesh of the file with its node's transform, polygons cut into triangles
 *   soup     corners snapped to whole quanta of 2^-N units, equal corners made one vertex
 *   mend     faces without area, double faces, windings
 *   check    what carom_mesh_check would refuse, told with places and a way out
 *   write    a C source, a binary blob, or both; nothing unless all went well
 *
 * It runs on the host, so it may use floating point.
 */
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <getopt.h>

#include "mesh_check.hpp"
#include "mesh_mend.hpp"
#include "mesh_read.hpp"
#include "mesh_rom.hpp"

namespace
{

using namespace mend;

struct Options {
    std::string in, out_c, out_blob, name, object;
    bool surface = false, check_only = false, indexed = false;
    int bits = 0; /* 0: choose */
    double scale = 1;
    bool y_up = false, unit_said = false, millimetres = false;
};

/* -------------------------------------------------------------------- making */

Mesh make_mesh(const Soup &soup, bool surface, int asked_bits)
{
    Mesh mesh = weld(soup, surface, choose_bits(soup.points, asked_bits));

    drop_collapsed_faces(mesh);
    drop_double_faces(mesh);
    check_counts(mesh);
    mend_slivers(mesh);
    drop_unused_vertices(mesh);
    check_faces(mesh);
    check_size(mesh);

    const EdgeUses uses = edges_of(mesh);

    check_edges(mesh, uses);
    orient(mesh, uses);
    mesh.edges = uses.size();
    if (surface) {
        check_looks_up(mesh);
        check_single_layer(mesh);
    } else if (mass_of(mesh).volume <= 0) {
        throw Refusal("the mesh has no volume: for a height field use --surface");
    }
    return mesh;
}

/* y up to z up: a quarter of a turn about x. */
void turn_up(std::vector<Point> &points)
{
    for (Point &p : points) {
        p = {p[0], -p[2], p[1]};
    }
}

/* Few things that fall are 30 m long, and many files count millimetres. */
std::string doubt_about_unit(const std::vector<Point> &points)
{
    const double largest = largest_coordinate(points);

    return largest < 30
               ? ""
               : format("a coordinate of %.10g looks like millimetres: --unit mm divides by "
                        "1000, --unit m says that they are metres",
                        largest);
}

void add_doubt(std::string &doubt, const std::string &more)
{
    doubt += doubt.empty() || more.empty() ? more : "; " + more;
}

/* ------------------------------------------------------------------- writing */

/* A line of three numbers each. */
template <typename Triple> void write_triples(std::ostream &out, const std::vector<Triple> &triples)
{
    for (const Triple &t : triples) {
        out << "    {" << t[0] << ", " << t[1] << ", " << t[2] << "},\n";
    }
}

std::string c_head(const std::string &from)
{
    return "/* SPDX-License-Identifier: MIT */\n/* Made by carom-mesh from " +
           std::filesystem::path(from).filename().string() +
           ": do not edit. */\n#include \"carom.h\"\n\n";
}

std::string c_source(const Mesh &mesh, const std::string &name, const std::string &from)
{
    std::ostringstream out;

    out << c_head(from) << "extern const struct carom_mesh_raw " << name << ";\n\n"
        << "static const int16_t vertices[" << mesh.vertices.size() << "][3] = {\n";
    write_triples(out, mesh.vertices);
    out << "};\n\nstatic const uint16_t faces[" << mesh.faces.size() << "][3] = {\n";
    write_triples(out, mesh.faces);
    out << "};\n\nconst struct carom_mesh_raw " << name << " = {\n"
        << "    .vertices = vertices,\n"
        << "    .faces = faces,\n"
        << "    .vertex_count = " << mesh.vertices.size() << ",\n"
        << "    .face_count = " << mesh.faces.size() << ",\n"
        << "    .quantum_bits = " << mesh.bits << ",\n"
        << "    .kind = " << (mesh.surface ? "CAROM_SURFACE" : "CAROM_SOLID") << ",\n"
        << "};\n";
    return out.str();
}

/* Index a mesh as the engine does, and hand on what it refuses. */
std::string indexed_source(const Mesh &mesh, const std::string &name)
{
    std::vector<std::array<int16_t, 3>> vertices;
    std::vector<std::array<uint16_t, 3>> faces;
    std::vector<uint64_t> memory;
    carom_mesh indexed;

    for (const Vertex &v : mesh.vertices) {
        vertices.push_back({int16_t(v[0]), int16_t(v[1]), int16_t(v[2])});
    }
    for (const Face &f : mesh.faces) {
        faces.push_back({uint16_t(f[0]), uint16_t(f[1]), uint16_t(f[2])});
    }

    const carom_mesh_raw raw = {reinterpret_cast<const int16_t(*)[3]>(vertices.data()),
                                reinterpret_cast<const uint16_t(*)[3]>(faces.data()),
                                uint32_t(vertices.size()),
                                uint32_t(faces.size()),
                                uint8_t(mesh.bits),
                                uint8_t(mesh.surface ? CAROM_SURFACE : CAROM_SOLID)};

    if (const int result = rom::index(indexed, raw, memory)) {
        throw Refusal(std::string("the engine does not take it: ") + carom_result_text(result));
    }
    return name.empty() ? "" : rom::c_source(indexed, name, false);
}

/* The same, indexed. */
std::string c_source_indexed(const Mesh &mesh, const std::string &name, const std::string &from)
{
    return c_head(from) + "extern const struct carom_mesh " + name + ";\n\n" +
           indexed_source(mesh, name);
}

/* Append the low bytes of a number, lowest first. */
void put(std::string &blob, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        blob += static_cast<char>(number >> (8 * i) & 0xff);
    }
}

/* The layout that carom_mesh_read takes; see src/mesh/blob.c. */
std::string binary_blob(const Mesh &mesh)
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

void write_file(const std::string &path, const std::string &content)
{
    std::ofstream file(path, std::ios::binary);

    file << content;
    file.close();
    if (!file) {
        std::remove(path.c_str());
        throw Refusal("cannot write " + path + ": check the folder and the space on the disk");
    }
}

/* Both or none. */
void write_outputs(const Options &options, const Mesh &mesh)
{
    if (options.check_only) {
        return;
    }
    if (!options.out_blob.empty()) {
        write_file(options.out_blob, binary_blob(mesh));
    }
    if (!options.out_c.empty()) {
        try {
            write_file(options.out_c, (options.indexed ? c_source_indexed
                                                       : c_source)(mesh, options.name, options.in));
        } catch (const Refusal &) {
            std::remove(options.out_blob.c_str());
            throw;
        }
    }
}

void print_report(const Options &options, const Mesh &mesh, const Soup &soup,
                  const std::string &doubt)
{
    std::printf("%s: %s, quantum 2^-%d units\n", options.in.c_str(),
                mesh.surface ? "SURFACE" : "SOLID", mesh.bits);
    std::printf("  file      %zu polygons, %zu triangles\n", mesh.polygons, mesh.triangles);
    std::printf("  mesh      %zu faces, %zu edges, %zu vertices\n", mesh.faces.size(), mesh.edges,
                mesh.vertices.size());
    if (!mesh.surface) {
        const Mass m = mass_of(mesh);

        std::printf("  volume    %.9g\n", m.volume);
        std::printf("  centre    %.9g %.9g %.9g\n", m.centre[0], m.centre[1], m.centre[2]);
        std::printf("  inertia   %.9g %.9g %.9g %.9g %.9g %.9g (xx yy zz xy yz zx, by mass)\n",
                    m.inertia[0], m.inertia[1], m.inertia[2], m.inertia[3], m.inertia[4],
                    m.inertia[5]);
    }
    if (mesh.mended.empty()) {
        std::printf("  mended    nothing\n");
    }
    for (const std::string &what : mesh.mended) {
        std::printf("  mended    %s\n", what.c_str());
    }
    if (soup.objects.size() > 1 && options.object.empty()) {
        std::printf("  joined    %zu objects:%s\n", soup.objects.size(),
                    listed(soup.objects).c_str());
    }
    if (soup.materials > 1) {
        std::printf("  dropped   %zu materials and what they hold: a mesh has no colours\n",
                    soup.materials);
    }
    for (const std::string &what : mesh.notes) {
        std::printf("  note      %s\n", what.c_str());
    }
    if (!doubt.empty()) {
        std::printf("  note      %s\n", doubt.c_str());
    }
}

/* ------------------------------------------------------------------- command */

const char usage[] =
    "usage: carom-mesh [options] FILE       (obj, stl, ply, gltf, glb and what else assimp reads)\n"
    "  -o, --output FILE.c     write a C source\n"
    "  -b, --blob FILE.crm     write a binary blob\n"
    "      --index             the C source has the mesh indexed, for ROM: a struct carom_mesh\n"
    "      --check             write nothing\n"
    "      --surface           a height field, open, z up; otherwise a closed solid\n"
    "      --name NAME         of the mesh in the C source; otherwise the file's\n"
    "      --quantum-bits N    coordinates in steps of 2^-N units, N from 7 to 20\n"
    "      --scale F           multiply coordinates by F first\n"
    "      --unit mm|m         what a coordinate of the file counts; a unit of Carom is a metre\n"
    "      --object NAME       only the object of this name, with all below it; otherwise all, "
    "joined\n"
    "      --up y|z            which axis of the file is up; otherwise z\n";

/* An identifier of C from a file's name. */
std::string name_from(const std::string &path)
{
    std::string name = std::filesystem::path(path).stem().string();

    for (char &c : name) {
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ? "mesh_" + name
                                                                             : name;
}

bool is_identifier(const std::string &name)
{
    return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

double number_from(const char *option, const char *text)
{
    char *end;
    const double number = std::strtod(text, &end);

    if (*text == '\0' || *end != '\0' || !std::isfinite(number)) {
        throw Refusal(std::string(option) + ": not a number: " + text);
    }
    return number;
}

Options parse(int argc, char **argv)
{
    static const option long_options[] = {
        {"output", required_argument, nullptr, 'o'},
        {"blob", required_argument, nullptr, 'b'},
        {"index", no_argument, nullptr, 'i'},
        {"check", no_argument, nullptr, 'c'},
        {"surface", no_argument, nullptr, 's'},
        {"name", required_argument, nullptr, 'n'},
        {"quantum-bits", required_argument, nullptr, 'q'},
        {"scale", required_argument, nullptr, 'f'},
        {"unit", required_argument, nullptr, 'm'},
        {"object", required_argument, nullptr, 'j'},
        {"up", required_argument, nullptr, 'u'},
        {"help", no_argument, nullptr, 'h'},
        {nullptr, 0, nullptr, 0},
    };
    Options options;
    int letter;

    while ((letter = getopt_long(argc, argv, "o:b:h", long_options, nullptr)) != -1) {
        switch (letter) {
        case 'o':
            options.out_c = optarg;
            break;
        case 'b':
            options.out_blob = optarg;
            break;
        case 'i':
            options.indexed = true;
            break;
        case 'c':
            options.check_only = true;
            break;
        case 's':
            options.surface = true;
            break;
        case 'n':
            options.name = optarg;
            break;
        case 'q': {
            const double bits = number_from("--quantum-bits", optarg);

            if (bits < bits_min || bits > bits_max || bits != std::floor(bits)) {
                throw Refusal("--quantum-bits: a whole number from 7 to 20, not " +
                              std::string(optarg));
            }
            options.bits = int(bits);
            break;
        }
        case 'f':
            options.scale = number_from("--scale", optarg);
            if (options.scale <= 0) {
                throw Refusal("--scale: must be above 0");
            }
            break;
        case 'm':
            if (std::string(optarg) != "mm" && std::string(optarg) != "m") {
                throw Refusal("--unit: mm or m, not " + std::string(optarg));
            }
            options.unit_said = true;
            options.millimetres = std::string(optarg) == "mm";
            break;
        case 'j':
            options.object = optarg;
            break;
        case 'u':
            if (std::string(optarg) != "y" && std::string(optarg) != "z") {
                throw Refusal("--up: y or z, not " + std::string(optarg));
            }
            options.y_up = std::string(optarg) == "y";
            break;
        case 'h':
            std::fputs(usage, stdout);
            std::exit(0);
        default:
            std::fputs(usage, stderr);
            std::exit(2);
        }
    }
    if (optind != argc - 1) {
        std::fputs(usage, stderr);
        std::exit(2);
    }
    options.in = argv[optind];
    if (options.name.empty()) {
        options.name = name_from(options.in);
    } else if (!is_identifier(options.name)) {
        throw Refusal("--name: not an identifier of C: " + options.name);
    }
    return options;
}

} // namespace

int main(int argc, char **argv)
{
    Options options;
    std::string doubt;

    try {
        options = parse(argc, argv);

        Soup soup = read_file(options.in, options.scale * (options.millimetres ? 0.001 : 1),
                              options.object);

        if (options.y_up) {
            turn_up(soup.points);
            turn_up(soup.order);
        }
        doubt = soup.doubt;
        if (!options.unit_said) {
            add_doubt(doubt, doubt_about_unit(soup.points));
        }

        const Mesh mesh = make_mesh(soup, options.surface, options.bits);

        indexed_source(mesh, "");
        if (!options.surface) {
            add_doubt(doubt, doubt_about_volume(soup, mesh));
        }
        write_outputs(options, mesh);
        print_report(options, mesh, soup, doubt);
    } catch (const std::exception &refusal) {
        std::fprintf(stderr, "carom-mesh: %s%s%s\n", options.in.c_str(),
                     options.in.empty() ? "" : ": ", refusal.what());
        if (!doubt.empty()) {
            std::fprintf(stderr, "  note: %s\n", doubt.c_str());
        }
        return 1;
    }
    return 0;
}

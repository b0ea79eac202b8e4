/* SPDX-License-Identifier: MIT */
/*
 * carom-mesh - turns a mesh file of any format that assimp reads, a grid of heights or a shape's name
 * into a mesh for Carom.
 *
 *   read     every mesh of the file with its node's transform, polygons cut into triangles; or a grid, or a shape
 *   soup     corners snapped to whole quanta of 2^-N units, equal corners united into one vertex
 *   mend     faces without area, double faces, windings; open holes and too many faces, if asked to
 *   check    reports what carom_mesh_check would refuse, with places and a remedy
 *   write    a C source, a binary blob, a picture; nothing unless all steps succeeded
 *
 * It runs on the host, so it may use floating point.
 */
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "mesh_heights.hpp"
#include "mesh_make.hpp"
#include "mesh_options.hpp"
#include "mesh_preview.hpp"
#include "mesh_read.hpp"
#include "mesh_shape.hpp"
#include "mesh_write.hpp"

namespace
{

using namespace mend;

/* -------------------------------------------------------------------- making */

/* y up to z up: a quarter turn about x. */
void turn_up(std::vector<Point> &points)
{
    for (Point &p : points) {
        p = {p[0], -p[2], p[1]};
    }
}

/* Few falling bodies are 30 m long, and many files count millimetres. */
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

/* --------------------------------------------------------------------- parts */

/* A mesh that is written by itself, and its origin. */
struct Product {
    std::string name; /* an identifier of C */
    Soup soup;
    Mesh mesh;
    std::string doubt;
};

std::vector<Soup> read_parts(Options &options)
{
    const double scale = options.scale * (options.millimetres ? 0.001 : 1);

    if (!options.shape.empty()) {
        return {read_shape(options.shape, scale, options.bits)};
    }
    if (options.grid) {
        return {read_heights(options.in, options.heights, scale)};
    }
    if (options.objects) {
        return read_objects(options.in, scale);
    }
    return {read_file(options.in, scale, options.object)};
}

/* All names that the C source of a mesh defines, indexed or not. */
std::vector<std::string> symbols_of(const std::string &name)
{
    std::vector<std::string> symbols = {name};

    for (const char *array :
         {"vertices", "corners", "faces", "edges", "ring_start", "ring", "leaves", "leaf_faces",
          "leaf_vertices", "leaf_corners", "cell_start", "zrefs"}) {
        symbols.push_back(name + "_" + array);
    }
    return symbols;
}

/* An identifier from an object's name, numbered if another object has it. */
std::string name_part(const std::string &object, std::set<std::string> &taken)
{
    const std::string plain = identifier_from(object);
    std::string name = plain;

    for (int number = 2;; number++) {
        const std::vector<std::string> symbols = symbols_of(name);

        if (std::none_of(symbols.begin(), symbols.end(),
                         [&](const std::string &s) { return taken.count(s) > 0; })) {
            taken.insert(symbols.begin(), symbols.end());
            return name;
        }
        name = plain + "_" + std::to_string(number);
    }
}

void make_part(Product &part, const Options &options)
{
    Soup &soup = part.soup;

    if (options.y_up) {
        turn_up(soup.points);
        turn_up(soup.order);
    }
    part.doubt = soup.doubt;
    if (!options.unit_said && !options.grid && options.shape.empty()) {
        add_doubt(part.doubt, doubt_about_unit(soup.points));
    }
    part.mesh = make_mesh(soup, options.surface, options.bits, options.repairs);
    Indexed engine(part.mesh); /* the engine may refuse it */

    if (!options.surface) {
        add_doubt(part.doubt, doubt_about_volume(soup, part.mesh));
    }
}

/* ------------------------------------------------------------------- writing */

/* The path of a file that holds one part: FILE.crm, or FILE.NAME.crm if each object has its own. */
std::string path_of(const std::string &path, const Options &options, const Product &part)
{
    const std::filesystem::path plain(path);

    return options.objects ? (plain.parent_path() / plain.stem()).string() + "." + part.name +
                                 plain.extension().string()
                           : path;
}

std::string c_file(const Options &options, const std::vector<Product> &parts)
{
    std::string text = c_head(options.in);

    for (const Product &part : parts) {
        text += &part == &parts[0] ? "" : "\n";
        text += options.indexed
                    ? c_source_indexed(part.mesh, part.name)
                    : c_source(part.mesh, part.name, options.objects ? part.name + "_" : "");
    }
    return text;
}

void write_outputs(const Options &options, const std::vector<Product> &parts)
{
    std::vector<Output> outputs;

    for (const Product &part : parts) {
        if (!options.out_blob.empty()) {
            outputs.push_back({path_of(options.out_blob, options, part), binary_blob(part.mesh)});
        }
        if (!options.out_picture.empty()) {
            outputs.push_back({path_of(options.out_picture, options, part), preview(part.mesh)});
        }
    }
    if (!options.out_c.empty()) {
        outputs.push_back({options.out_c, c_file(options, parts)});
    }
    if (!options.check_only) {
        write_files(outputs);
    }
}

void print_report(const Options &options, const Product &part)
{
    const Mesh &mesh = part.mesh;
    const Soup &soup = part.soup;

    std::printf(
        "%s: %s%s, quantum 2^-%d units\n", options.in.c_str(),
        options.objects ? ("object '" + soup.objects[0] + "' as " + part.name + ": ").c_str() : "",
        mesh.surface ? "SURFACE" : "SOLID", mesh.bits);
    if (mesh.polygons) { /* polygons are not counted for a single object */
        std::printf("  file      %zu polygons, %zu triangles\n", mesh.polygons, mesh.triangles);
    }
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
    if (!part.doubt.empty()) {
        std::printf("  note      %s\n", part.doubt.c_str());
    }
}

/* Convert a file; returns the exit status. */
int convert(Options &options)
{
    std::vector<Product> parts;
    std::set<std::string> taken;

    try {
        for (const Soup &soup : read_parts(options)) {
            const std::string name =
                options.objects ? name_part(soup.objects[0], taken) : options.name;

            parts.push_back({name, soup, {}, ""});
            make_part(parts.back(), options);
        }
        write_outputs(options, parts);
        for (const Product &part : parts) {
            print_report(options, part);
        }
    } catch (const std::exception &refusal) {
        const bool of_object = options.objects && !parts.empty() && parts.back().mesh.edges == 0;

        std::fprintf(stderr, "carom-mesh: %s%s%s%s\n", options.in.c_str(),
                     options.in.empty() ? "" : ": ",
                     of_object ? ("object '" + parts.back().soup.objects[0] + "': ").c_str() : "",
                     refusal.what());
        if (!parts.empty() && !parts.back().doubt.empty()) {
            std::fprintf(stderr, "  note: %s\n", parts.back().doubt.c_str());
        }
        return 1;
    }
    return 0;
}

/*
 * Convert in a process of its own: damaged files make assimp's readers fail in ways that end the
 * process.
 */
int convert_apart(Options options)
{
    int status = 0;
    const pid_t child = fork();

    if (child < 0) { /* no process left: without the protection */
        return convert(options);
    }
    if (child == 0) {
        status = convert(options);
        std::fflush(nullptr);
        _exit(status);
    }
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) {
        return WEXITSTATUS(status);
    }
    std::fprintf(stderr,
                 "carom-mesh: %s: cannot be read: the library that reads it %s; the file is "
                 "damaged, export it again, e.g. as OBJ\n",
                 options.in.c_str(),
                 WTERMSIG(status) == SIGVTALRM ? "does not come to an end" : "failed");
    return 1;
}

} // namespace

int main(int argc, char **argv)
{
    try {
        return convert_apart(parse(argc, argv));
    } catch (const std::exception &refusal) {
        std::fprintf(stderr, "carom-mesh: %s\n", refusal.what());
        return 1;
    }
}

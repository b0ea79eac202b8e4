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
#include <cstdio>
#include <string>
#include <vector>

#include "mesh_check.hpp"
#include "mesh_mend.hpp"
#include "mesh_options.hpp"
#include "mesh_read.hpp"
#include "mesh_write.hpp"

namespace
{

using namespace mend;

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

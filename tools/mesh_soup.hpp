/* SPDX-License-Identifier: MIT */
/*
 * mesh_soup - the data of the mesh converter: a soup of triangles as a file holds it, and the mesh that it becomes when its corners are
 * snapped to whole quanta and welded.
 */
#ifndef CAROM_TOOLS_MESH_SOUP_HPP
#define CAROM_TOOLS_MESH_SOUP_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mend
{

using Point = std::array<double, 3>;   /* units */
using Vertex = std::array<int32_t, 3>; /* quanta */
using Face = std::array<uint32_t, 3>;
using Edge = std::pair<uint32_t, uint32_t>; /* lower vertex first */

constexpr int bits_min = 7, bits_max = 20;
constexpr size_t count_max = 65535;
constexpr double side_max = 256, diagonal_max = 384; /* units, of carom_mesh_build */
constexpr int32_t coordinate_max = 32767;
constexpr size_t listed_max = 100; /* places that a message lists */

/* Why a mesh cannot be used, and the remedy. */
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/* The contents of a file, joined. */
struct Soup {
    std::vector<Point> order; /* vertices in the file's own order, if the reader loses it */
    std::vector<Point> points;
    std::vector<Face> faces;
    size_t polygons = 0;
    std::vector<std::string> objects; /* names of the nodes that are joined */
    size_t materials = 0;
    std::string doubt; /* a remark on an odd file; empty: none */
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Face> faces;
    bool surface = false;
    int bits = 0;
    size_t polygons = 0, triangles = 0; /* numbers in the file */
    size_t edges = 0;
    std::vector<std::string> mended; /* a description of each change */
    std::vector<std::string> notes;  /* remarks on things that may not be intended */
};

/* Changes that are made only on request. */
struct Repairs {
    bool close = false;    /* fill flat holes */
    bool overlaps = false; /* allow parts that overlap */
    size_t most_faces = 0; /* reduce the mesh to so many faces; 0: no limit */
};

/* --------------------------------------------------------------------- texts */

__attribute__((format(printf, 1, 2))) inline std::string format(const char *pattern, ...)
{
    char text[512];
    va_list arguments;

    va_start(arguments, pattern);
    std::vsnprintf(text, sizeof text, pattern, arguments);
    va_end(arguments);
    return text;
}

inline std::string counted(size_t n, const std::string &what)
{
    const std::string plural = what == "vertex" ? "vertices" : what + "s";

    return std::to_string(n) + " " + (n == 1 ? what : plural);
}

inline std::string place(const Point &p)
{
    return format("(%.10g, %.10g, %.10g)", p[0], p[1], p[2]);
}

inline Point in_units(const Mesh &mesh, uint32_t vertex)
{
    Point p;

    for (size_t k = 0; k < 3; k++) {
        p[k] = std::ldexp(mesh.vertices[vertex][k], -mesh.bits);
    }
    return p;
}

inline std::string describe(const Mesh &mesh, const Edge &edge)
{
    return place(in_units(mesh, edge.first)) + " - " + place(in_units(mesh, edge.second));
}

inline std::string describe(const Mesh &mesh, const Face &face)
{
    return place(in_units(mesh, face[0])) + " " + place(in_units(mesh, face[1])) + " " +
           place(in_units(mesh, face[2]));
}

/* One line for each place, at most listed_max of them. */
inline std::string listed(const std::vector<std::string> &lines)
{
    std::string text;

    for (size_t i = 0; i < lines.size() && i < listed_max; i++) {
        text += "\n  " + lines[i];
    }
    if (lines.size() > listed_max) {
        text += "\n  and " + std::to_string(lines.size() - listed_max) + " more";
    }
    return text;
}

/* ------------------------------------------------------------------ snapping */

inline double largest_coordinate(const std::vector<Point> &points)
{
    double largest = 0;

    for (const Point &p : points) {
        for (double c : p) {
            largest = std::max(largest, std::fabs(c));
        }
    }
    return largest;
}

inline bool fits(double largest, int bits)
{
    return std::round(std::ldexp(largest, bits)) <= coordinate_max;
}

/* True if every coordinate is a whole number of quanta, up to the rounding of a file's text. */
inline bool exact_on(const std::vector<Point> &points, double largest, int bits)
{
    const double tolerance = std::ldexp(largest, bits - 20);

    return std::all_of(points.begin(), points.end(), [&](const Point &p) {
        return std::all_of(p.begin(), p.end(), [&](double c) {
            const double quanta = std::ldexp(c, bits);

            return std::fabs(quanta - std::round(quanta)) <= tolerance;
        });
    });
}

/* The quantum: the requested one, otherwise the file's own grid, otherwise the finest that fits. */
inline int choose_bits(const std::vector<Point> &points, int asked)
{
    const double largest = largest_coordinate(points);
    int finest = bits_max;

    while (finest >= bits_min && !fits(largest, finest)) {
        finest--;
    }
    if (finest < bits_min) {
        throw Refusal(
            format("a coordinate of %.10g units is too large: at most %.10g are possible; "
                   "shrink the mesh, e.g. with --scale %.3g, or move it to its origin",
                   largest, std::ldexp(coordinate_max, -bits_min),
                   std::ldexp(coordinate_max, -bits_min) / largest * 0.99));
    }
    if (asked > finest) {
        throw Refusal(format("a coordinate of %.10g units is too large for quanta of 2^-%d: use "
                             "--quantum-bits %d or less, or --scale",
                             largest, asked, finest));
    }
    if (asked) {
        return asked;
    }
    for (int bits = bits_min; bits < finest; bits++) {
        if (exact_on(points, largest, bits)) {
            return bits;
        }
    }
    return finest;
}

inline Vertex snap(const Point &p, int bits)
{
    Vertex v;

    for (size_t k = 0; k < 3; k++) {
        v[k] = static_cast<int32_t>(std::lround(std::ldexp(p[k], bits)));
    }
    return v;
}

/* Drop unused vertices; the others keep their order. */
inline void drop_unused_vertices(Mesh &mesh)
{
    std::vector<uint32_t> number(mesh.vertices.size(), 0);
    std::vector<Vertex> used;

    for (const Face &f : mesh.faces) {
        for (uint32_t v : f) {
            number[v] = 1;
        }
    }
    for (size_t v = 0; v < number.size(); v++) {
        if (number[v]) {
            number[v] = static_cast<uint32_t>(used.size());
            used.push_back(mesh.vertices[v]);
        }
    }
    for (Face &f : mesh.faces) {
        for (uint32_t &v : f) {
            v = number[v];
        }
    }
    mesh.vertices = used;
}

/* Snap and weld: vertices keep the order of the file, or of their first face. */
inline Mesh weld(const Soup &soup, bool surface, int bits)
{
    Mesh mesh;
    std::map<Vertex, uint32_t> numbers;
    std::vector<uint32_t> welded;
    const auto number_of = [&](const Point &p) {
        const Vertex v = snap(p, bits);
        const auto [entry, added] =
            numbers.try_emplace(v, static_cast<uint32_t>(mesh.vertices.size()));

        if (added) {
            mesh.vertices.push_back(v);
        }
        return entry->second;
    };

    mesh.surface = surface;
    mesh.bits = bits;
    mesh.polygons = soup.polygons;
    mesh.triangles = soup.faces.size();
    for (const Point &p : soup.order) {
        if (fits(largest_coordinate({p}), bits)) { /* an unused vertex may be anywhere */
            number_of(p);
        }
    }
    for (const Point &p : soup.points) {
        welded.push_back(number_of(p));
    }
    for (const Face &f : soup.faces) {
        mesh.faces.push_back({welded[f[0]], welded[f[1]], welded[f[2]]});
    }
    drop_unused_vertices(mesh);

    const size_t distinct = std::set<Point>(soup.points.begin(), soup.points.end()).size();

    if (distinct > mesh.vertices.size()) {
        mesh.mended.push_back("welded " + counted(distinct - mesh.vertices.size(), "vertex") +
                              " to others within a quantum");
    }
    return mesh;
}

} // namespace mend

#endif

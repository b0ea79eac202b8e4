/* SPDX-License-Identifier: MIT */
/*
 * mesh_cross - decides exactly whether two closed sets of faces cross, and whether one lies within
 * the other.
 *
 * Coordinates are below 2^15: a normal is below 2^34, the product of a corner's distance from a
 * plane and that normal below 2^52. Fractions of these numbers are compared in 128 bits.
 */
#ifndef CAROM_TOOLS_MESH_CROSS_HPP
#define CAROM_TOOLS_MESH_CROSS_HPP

#include "mesh_edges.hpp"

namespace mend
{

__extension__ typedef __int128 Wide;

/* A connected set of faces. */
struct Part {
    std::vector<uint32_t> faces;
    Vertex low, high; /* box */
    double measure;   /* SOLID: six times the volume; SURFACE: twice the area seen from above */
};

/* -------------------------------------------------------------- two triangles */

struct Fraction {
    Wide above, below; /* below > 0 */
};

inline bool operator<(const Fraction &a, const Fraction &b)
{
    return a.above * b.below < b.above * a.below;
}

/* Distances of the corners of a face from the plane of another, times the length of its normal. */
inline std::array<int64_t, 3> distances(const Mesh &mesh, const Face &face, const Normal &n,
                                        const Vertex &on)
{
    std::array<int64_t, 3> d;

    for (size_t i = 0; i < 3; i++) {
        const Vertex &v = mesh.vertices[face[i]];

        d[i] = n[0] * (v[0] - on[0]) + n[1] * (v[1] - on[1]) + n[2] * (v[2] - on[2]);
    }
    return d;
}

inline bool on_both_sides(const std::array<int64_t, 3> &d)
{
    const auto [low, high] = std::minmax_element(d.begin(), d.end());

    return *low < 0 && *high > 0;
}

/* A face with corners on both sides of a plane meets the plane between two places along an axis. */
inline std::pair<Fraction, Fraction> cut_along(const Mesh &mesh, const Face &face,
                                               const std::array<int64_t, 3> &d, size_t axis)
{
    std::vector<Fraction> cuts;

    for (size_t i = 0; i < 3; i++) {
        const size_t j = (i + 1) % 3;
        const Wide a = mesh.vertices[face[i]][axis], b = mesh.vertices[face[j]][axis];

        if (d[i] == 0) {
            cuts.push_back({a, 1});
        } else if ((d[i] < 0) != (d[j] < 0) && d[j] != 0) {
            const Wide sign = d[j] > d[i] ? 1 : -1;

            cuts.push_back({sign * (a * d[j] - b * d[i]), sign * (Wide(d[j]) - d[i])});
        }
    }
    return cuts[1] < cuts[0] ? std::make_pair(cuts[1], cuts[0]) : std::make_pair(cuts[0], cuts[1]);
}

/*
 * True if the interiors of two faces meet and their planes are not parallel. Two solids with such faces share a volume; solids that
 * only touch do not.
 */
inline bool faces_cross(const Mesh &mesh, const Face &f, const Face &g)
{
    const Normal m = normal_of(mesh, f), n = normal_of(mesh, g);
    const auto of_f = distances(mesh, f, n, mesh.vertices[g[0]]);

    if (!on_both_sides(of_f)) {
        return false;
    }
    const auto of_g = distances(mesh, g, m, mesh.vertices[f[0]]);

    if (!on_both_sides(of_g)) {
        return false;
    }
    size_t axis = 0; /* an axis that is not perpendicular to the common line of the two planes */

    while (axis < 2 && Wide(m[(axis + 1) % 3]) * n[(axis + 2) % 3] ==
                           Wide(m[(axis + 2) % 3]) * n[(axis + 1) % 3]) {
        axis++;
    }
    const auto [f0, f1] = cut_along(mesh, f, of_f, axis);
    const auto [g0, g1] = cut_along(mesh, g, of_g, axis);

    return f0 < g1 && g0 < f1;
}

/* ------------------------------------------------------------------ two parts */

/* A face and its box. */
struct Boxed {
    Vertex low, high;
    Face face;
};

inline bool boxes_cross(const Vertex &low_a, const Vertex &high_a, const Vertex &low_b,
                        const Vertex &high_b)
{
    for (size_t k = 0; k < 3; k++) {
        if (low_a[k] > high_b[k] || low_b[k] > high_a[k]) {
            return false;
        }
    }
    return true;
}

/* The faces of a part that reach into the box of another, by their lowest x. */
inline std::vector<Boxed> faces_in_box(const Mesh &mesh, const Part &part, const Part &box)
{
    std::vector<Boxed> found;

    for (uint32_t f : part.faces) {
        Boxed b = {mesh.vertices[mesh.faces[f][0]], mesh.vertices[mesh.faces[f][0]], mesh.faces[f]};

        for (uint32_t v : b.face) {
            for (size_t k = 0; k < 3; k++) {
                b.low[k] = std::min(b.low[k], mesh.vertices[v][k]);
                b.high[k] = std::max(b.high[k], mesh.vertices[v][k]);
            }
        }
        if (boxes_cross(b.low, b.high, box.low, box.high)) {
            found.push_back(b);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const Boxed &a, const Boxed &b) { return a.low[0] < b.low[0]; });
    return found;
}

/* Sweep along x: each face is compared with those of the other part that begin before it ends. */
inline bool parts_cross(const Mesh &mesh, const Part &a, const Part &b)
{
    const std::vector<Boxed> of_a = faces_in_box(mesh, a, b), of_b = faces_in_box(mesh, b, a);
    const auto meets = [&](const Boxed &f, const std::vector<Boxed> &others, size_t from) {
        for (size_t i = from; i < others.size() && others[i].low[0] <= f.high[0]; i++) {
            if (boxes_cross(f.low, f.high, others[i].low, others[i].high) &&
                faces_cross(mesh, f.face, others[i].face)) {
                return true;
            }
        }
        return false;
    };

    for (size_t i = 0, j = 0; i < of_a.size() || j < of_b.size();) {
        if (j == of_b.size() || (i < of_a.size() && of_a[i].low[0] <= of_b[j].low[0])) {
            if (meets(of_a[i++], of_b, j)) {
                return true;
            }
        } else if (meets(of_b[j++], of_a, i)) {
            return true;
        }
    }
    return false;
}

enum class Place { outside, on, inside };

/*
 * The side of an edge on which a point lies, seen from above; 0 only for an edge seen end on. A
 * point on the edge counts as if it were moved a little along x and much less along y.
 */
inline int64_t side_of_edge(const Vertex &a, const Vertex &b, const Vertex &p3)
{
    const int64_t dx = b[0] - a[0], dy = b[1] - a[1];
    const int64_t side = dx * (p3[1] - 3 * a[1]) - dy * (p3[0] - 3 * a[0]);

    return side ? side : dy ? -dy : dx;
}

/*
 * The place of a point, given in thirds, relative to a part: a ray upwards from the point counts
 * the faces. In thirds the middle of a face has whole numbers.
 */
inline Place place_of(const Mesh &mesh, const Part &part, const Vertex &p3)
{
    bool inside = false;

    for (uint32_t f : part.faces) {
        const Face &face = mesh.faces[f];
        const Vertex &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
                     &c = mesh.vertices[face[2]];
        const Normal n = normal_of(mesh, face);
        const int64_t height =
            n[0] * (p3[0] - 3 * a[0]) + n[1] * (p3[1] - 3 * a[1]) + n[2] * (p3[2] - 3 * a[2]);
        size_t axis = 0;
        int left = 0, right = 0;

        if (height == 0) { /* on the plane: test whether it is on the face, seen along its normal */
            for (size_t k = 1; k < 3; k++) {
                axis = std::abs(n[k]) > std::abs(n[axis]) ? k : axis;
            }
            const size_t x = (axis + 1) % 3, y = (axis + 2) % 3;

            for (const auto &[s, e] : {std::make_pair(&a, &b), {&b, &c}, {&c, &a}}) {
                const int64_t side = int64_t((*e)[x] - (*s)[x]) * (p3[y] - 3 * (*s)[y]) -
                                     int64_t((*e)[y] - (*s)[y]) * (p3[x] - 3 * (*s)[x]);
                left += side > 0;
                right += side < 0;
            }
            if (!left || !right) {
                return Place::on;
            }
            continue;
        }
        for (const auto &[s, e] : {std::make_pair(&a, &b), {&b, &c}, {&c, &a}}) {
            const int64_t side = side_of_edge(*s, *e, p3);

            left += side > 0;
            right += side < 0;
        }
        if (n[2] && (left == 3 || right == 3) && (height < 0) == (n[2] > 0)) {
            inside = !inside;
        }
    }
    return inside ? Place::inside : Place::outside;
}

enum class Relation { apart, within, overlap };

/* Compare the middles of the faces of a part, all or some of them, with another part. */
inline Relation sampled(const Mesh &mesh, const Part &part, const Part &other)
{
    const size_t work = 20000000; /* comparisons, less than a second */
    const size_t samples = std::max<size_t>(16, work / other.faces.size());
    const size_t step = 1 + part.faces.size() / samples;
    bool inside = false, outside = false;

    for (size_t i = 0; i < part.faces.size(); i += step) {
        const Face &f = mesh.faces[part.faces[i]];
        Vertex middle3;

        for (size_t k = 0; k < 3; k++) {
            middle3[k] = mesh.vertices[f[0]][k] + mesh.vertices[f[1]][k] + mesh.vertices[f[2]][k];
        }
        const Place place = place_of(mesh, other, middle3);

        inside |= place == Place::inside;
        outside |= place == Place::outside;
        if (inside && outside) {
            return Relation::overlap;
        }
    }
    return inside ? Relation::within : Relation::apart;
}

/* The relation of a part to another; `within`: the first lies in the second. */
inline Relation relation(const Mesh &mesh, const Part &part, const Part &other)
{
    return boxes_cross(part.low, part.high, other.low, other.high) ? sampled(mesh, part, other)
                                                                   : Relation::apart;
}

} // namespace mend

#endif

/* SPDX-License-Identifier: MIT */
/*
 * mesh_close - fills the flat holes of a mesh: loops of open edges that lie in one plane. A loop
 * inside another one that runs in the opposite direction bounds a ring together with it.
 */
#ifndef CAROM_TOOLS_MESH_CLOSE_HPP
#define CAROM_TOOLS_MESH_CLOSE_HPP

#include "mesh_fill.hpp"

namespace mend
{

constexpr size_t loop_max = 10000; /* edges; the time to fill grows with their square */

/* A loop of open edges: vertices in the order of a face that fills it. */
struct Hole {
    std::vector<uint32_t> vertices;
    Normal normal; /* twice the area along the plane's normal */
    double offset; /* distance of the plane from the origin along the normal, quanta */
    Loop flat;     /* seen from the side from which it runs counter-clockwise */
};

/* The open edges from each vertex, against the windings of their faces. */
inline std::map<uint32_t, std::vector<uint32_t>> open_ways(const EdgeUses &uses)
{
    std::map<uint32_t, std::vector<uint32_t>> ways;

    for (const auto &[edge, faces] : uses) {
        if (faces.size() == 1) {
            const bool forward = faces[0].forward;

            ways[forward ? edge.second : edge.first].push_back(forward ? edge.first : edge.second);
        }
    }
    return ways;
}

/* Loops that touch no other loop at a vertex; the others are reported. */
inline std::vector<Hole> loops_of(const Mesh &mesh, const EdgeUses &uses,
                                  std::vector<std::string> &left)
{
    const std::map<uint32_t, std::vector<uint32_t>> ways = open_ways(uses);
    std::set<uint32_t> seen;
    std::vector<Hole> found;

    for (const auto &[start, to] : ways) {
        Hole hole;
        uint32_t at = start;
        bool simple = true;

        while (simple && seen.insert(at).second) {
            const auto next = ways.find(at);

            hole.vertices.push_back(at);
            simple = next != ways.end() && next->second.size() == 1;
            at = simple ? next->second[0] : at;
        }
        if (simple && !hole.vertices.empty() && at == start) {
            found.push_back(hole);
        } else if (!hole.vertices.empty()) {
            left.push_back("at " + place(in_units(mesh, start)) +
                           ": its edges touch another hole's, so that there is no one loop");
        }
    }
    return found;
}

/* Find the plane of a hole; returns the largest distance of a vertex from it, in quanta. */
inline double find_plane(const Mesh &mesh, Hole &hole)
{
    const Vertex &origin = mesh.vertices[hole.vertices[0]];

    hole.normal = {0, 0, 0};
    for (size_t i = 1; i + 1 < hole.vertices.size(); i++) {
        const Normal n =
            normal_of(mesh, {hole.vertices[0], hole.vertices[i], hole.vertices[i + 1]});

        for (size_t k = 0; k < 3; k++) {
            hole.normal[k] += n[k];
        }
    }
    const double length =
        std::hypot(double(hole.normal[0]), double(hole.normal[1]), double(hole.normal[2]));
    double low = 0, high = 0;

    for (uint32_t v : hole.vertices) {
        double distance = 0;

        for (size_t k = 0; k < 3; k++) {
            distance += double(hole.normal[k]) * (mesh.vertices[v][k] - origin[k]) / length;
        }
        low = std::min(low, distance);
        high = std::max(high, distance);
    }
    hole.offset = (low + high) / 2;
    for (size_t k = 0; k < 3; k++) {
        hole.offset += double(hole.normal[k]) * origin[k] / length;
    }
    return (high - low) / 2;
}

/* Project along the axis that is closest to the plane's normal. */
inline void flatten(const Mesh &mesh, Hole &hole)
{
    size_t axis = 0;

    for (size_t k = 1; k < 3; k++) {
        axis = std::abs(hole.normal[k]) > std::abs(hole.normal[axis]) ? k : axis;
    }
    const bool from_above = hole.normal[axis] > 0;
    const size_t x = (axis + (from_above ? 1 : 2)) % 3, y = (axis + (from_above ? 2 : 1)) % 3;

    for (uint32_t v : hole.vertices) {
        hole.flat.push_back({mesh.vertices[v][x], mesh.vertices[v][y], v});
    }
}

/* True if a hole is flat and its loop simple; otherwise it is reported. */
inline bool can_fill(const Mesh &mesh, Hole &hole, std::vector<std::string> &left)
{
    const std::string where = "at " + place(in_units(mesh, hole.vertices[0])) + ", " +
                              counted(hole.vertices.size(), "edge") + ": ";
    const double off = find_plane(mesh, hole);

    if (hole.vertices.size() > loop_max) {
        left.push_back(where + format("more than %zu edges", loop_max));
    } else if (hole.normal == Normal{0, 0, 0}) {
        left.push_back(where + "it has no area");
    } else if (off > 1) {
        left.push_back(
            where + format("it is not flat: %.3g units off a plane", std::ldexp(off, -mesh.bits)));
    } else {
        flatten(mesh, hole);
        if (is_simple(hole.flat)) {
            return true;
        }
        left.push_back(where + "its edges cross each other");
    }
    return false;
}

/*
 * True if a hole lies in the plane of another one, within its loop, and runs in the opposite
 * direction.
 */
inline bool is_in_ring(const Mesh &mesh, const Hole &outer, const Hole &inner)
{
    double along = 0, length[2] = {0, 0};

    for (size_t k = 0; k < 3; k++) {
        along += double(outer.normal[k]) * double(inner.normal[k]);
        length[0] += double(outer.normal[k]) * double(outer.normal[k]);
        length[1] += double(inner.normal[k]) * double(inner.normal[k]);
    }
    if (along > -0.99 * std::sqrt(length[0] * length[1])) {
        return false;
    }
    Hole seen; /* the inner loop, projected like the outer one */
    double off = 0;

    seen.vertices = inner.vertices;
    seen.normal = outer.normal;
    flatten(mesh, seen);
    for (uint32_t v : inner.vertices) {
        double distance = -outer.offset;

        for (size_t k = 0; k < 3; k++) {
            distance += double(outer.normal[k]) * mesh.vertices[v][k] / std::sqrt(length[0]);
        }
        off = std::max(off, std::fabs(distance));
    }
    return off <= 2 && std::all_of(seen.flat.begin(), seen.flat.end(),
                                   [&](const Corner &c) { return is_within(outer.flat, c); });
}

/* For each hole the smallest hole with which it forms a ring; its own number: none. */
inline std::vector<size_t> rings(const Mesh &mesh, const std::vector<Hole> &found)
{
    std::vector<size_t> outer(found.size());

    for (size_t i = 0; i < found.size(); i++) {
        outer[i] = i;
        for (size_t j = 0; j < found.size(); j++) {
            if (j != i && is_in_ring(mesh, found[j], found[i]) &&
                (outer[i] == i || area_of(found[j].flat) < area_of(found[outer[i]].flat))) {
                outer[i] = j;
            }
        }
    }
    return outer;
}

/* Faces lie within a loop that is outermost, or within a ring. */
inline bool is_filled(const std::vector<size_t> &outer, size_t number)
{
    bool filled = true;

    while (outer[number] != number) {
        number = outer[number];
        filled = !filled;
    }
    return filled;
}

/* Fill one hole and the holes that form rings with it; false if that is impossible. */
inline bool close_hole(Mesh &mesh, const std::vector<Hole> &found, const std::vector<size_t> &outer,
                       size_t number)
{
    std::vector<Loop> inner;

    for (size_t i = 0; i < found.size(); i++) {
        if (i != number && outer[i] == number) {
            Hole seen;

            seen.vertices = found[i].vertices;
            seen.normal = found[number].normal;
            flatten(mesh, seen);
            inner.push_back(seen.flat);
        }
    }
    const std::vector<Face> faces = fill(found[number].flat, inner);

    mesh.faces.insert(mesh.faces.end(), faces.begin(), faces.end());
    return !faces.empty();
}

/* Fill all flat holes, or refuse and report those that are not flat. */
inline void close_holes(Mesh &mesh, const EdgeUses &uses)
{
    const size_t before = mesh.faces.size();
    std::vector<std::string> left;
    std::vector<Hole> found;

    for (Hole &hole : loops_of(mesh, uses, left)) {
        if (can_fill(mesh, hole, left)) {
            found.push_back(hole);
        }
    }
    const std::vector<size_t> outer = rings(mesh, found);

    for (size_t i = 0; i < found.size(); i++) {
        if (is_filled(outer, i) && !close_hole(mesh, found, outer, i)) {
            left.push_back("at " + place(in_units(mesh, found[i].vertices[0])) +
                           ": it meets another hole of its plane");
        }
    }
    if (!left.empty()) {
        throw Refusal(counted(left.size(), "hole") + " cannot be filled: fill them in the editor" +
                      listed(left));
    }
    if (!found.empty()) {
        mesh.mended.push_back("closed " + counted(found.size(), "hole") + ", " +
                              counted(mesh.faces.size() - before, "face") + " added");
    }
}

} // namespace mend

#endif

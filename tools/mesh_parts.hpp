/* SPDX-License-Identifier: MIT */
/*
 * mesh_parts - connected sets of faces: gives each one winding, turns it outwards, and finds parts that lie within others or overlap
 * them.
 */
#ifndef CAROM_TOOLS_MESH_PARTS_HPP
#define CAROM_TOOLS_MESH_PARTS_HPP

#include "mesh_cross.hpp"

namespace mend
{

inline void turn(Face &face)
{
    std::swap(face[1], face[2]);
}

/* Six times the volume between a face and the origin. */
inline double volume6(const Mesh &mesh, const Face &face)
{
    const Normal n = normal_of(mesh, face);
    const Vertex &a = mesh.vertices[face[0]];

    return double(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
}

/* Collect the part of a face and give its faces one winding, the one that most of them have. */
inline Part orient_part(Mesh &mesh, const EdgeUses &uses, uint32_t seed, std::vector<bool> &seen,
                        size_t &turned)
{
    Part part;
    std::map<uint32_t, bool> against; /* whether a face is against the winding of the seed, in the
                                       * file */
    size_t count = 0;

    part.faces.push_back(seed);
    seen[seed] = true;
    against[seed] = false;
    for (size_t i = 0; i < part.faces.size(); i++) {
        const uint32_t f = part.faces[i];

        for (size_t k = 0; k < 3; k++) {
            const uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];

            for (const EdgeUse &use : uses.at({std::min(a, b), std::max(a, b)})) {
                const bool differs = against[f] != (use.forward == (a < b));

                if (use.face == f) {
                    continue;
                }
                if (!seen[use.face]) {
                    seen[use.face] = true;
                    against[use.face] = differs;
                    part.faces.push_back(use.face);
                } else if (against[use.face] != differs) {
                    throw Refusal("the faces have no two sides, as on a Moebius strip, near " +
                                  describe(mesh, Edge{a, b}) + ": repair them in the editor");
                }
            }
        }
    }
    for (const auto &[face, differs] : against) {
        count += differs;
    }
    const bool minority = count * 2 <= part.faces.size();

    for (const auto &[face, differs] : against) {
        if (differs == minority) {
            turn(mesh.faces[face]);
            turned++;
        }
    }
    return part;
}

inline void measure(const Mesh &mesh, Part &part)
{
    part.low = part.high = mesh.vertices[mesh.faces[part.faces[0]][0]];
    part.measure = 0;
    for (uint32_t f : part.faces) {
        part.measure +=
            mesh.surface ? double(normal_of(mesh, mesh.faces[f])[2]) : volume6(mesh, mesh.faces[f]);
        for (uint32_t v : mesh.faces[f]) {
            for (size_t k = 0; k < 3; k++) {
                part.low[k] = std::min(part.low[k], mesh.vertices[v][k]);
                part.high[k] = std::max(part.high[k], mesh.vertices[v][k]);
            }
        }
    }
}

/* All parts of a mesh, each with one winding. */
inline std::vector<Part> parts_of(Mesh &mesh, const EdgeUses &uses)
{
    std::vector<bool> seen(mesh.faces.size());
    std::vector<Part> parts;
    size_t turned = 0;

    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        if (!seen[f]) {
            parts.push_back(orient_part(mesh, uses, f, seen, turned));
            measure(mesh, parts.back());
        }
    }
    if (turned) {
        mesh.mended.push_back("turned " + counted(turned, "face") +
                              " that disagreed with their neighbours");
    }
    return parts;
}

inline size_t turn_part(Mesh &mesh, Part &part)
{
    for (uint32_t f : part.faces) {
        turn(mesh.faces[f]);
    }
    part.measure = -part.measure;
    return part.faces.size();
}

inline std::string box_of(const Mesh &mesh, const Part &part)
{
    Point low, high;

    for (size_t k = 0; k < 3; k++) {
        low[k] = std::ldexp(part.low[k], -mesh.bits);
        high[k] = std::ldexp(part.high[k], -mesh.bits);
    }
    return place(low) + " - " + place(high);
}

/* For each part, the parts that it lies in. Pairs that overlap are refused, or noted if that is allowed. */
inline std::vector<std::vector<size_t>> nesting(Mesh &mesh, const std::vector<Part> &parts,
                                                bool allow)
{
    std::vector<std::vector<size_t>> outer(parts.size());
    std::vector<std::string> overlaps;

    for (size_t i = 0; i < parts.size(); i++) {
        for (size_t j = 0; j < i; j++) {
            if (!boxes_cross(parts[i].low, parts[i].high, parts[j].low, parts[j].high)) {
                continue;
            }
            const bool cross = parts_cross(mesh, parts[i], parts[j]);
            const Relation in = cross ? Relation::overlap : relation(mesh, parts[i], parts[j]);
            const Relation out = cross ? Relation::overlap : relation(mesh, parts[j], parts[i]);

            if (in == Relation::overlap || out == Relation::overlap) {
                overlaps.push_back(box_of(mesh, parts[j]) + " and " + box_of(mesh, parts[i]));
            } else if (in == Relation::within) {
                outer[i].push_back(j);
            } else if (out == Relation::within) {
                outer[j].push_back(i);
            }
        }
    }
    if (!overlaps.empty() && !allow) {
        throw Refusal(counted(overlaps.size(), "pair") +
                      " of parts overlap, and what both hold would count twice: unite them in the "
                      "editor, convert them one by one, or say --overlaps allow. Their boxes:" +
                      listed(overlaps));
    }
    if (!overlaps.empty()) {
        mesh.notes.push_back("the volume that two parts hold counts twice, those in the boxes" +
                             listed(overlaps));
    }
    return outer;
}

inline void drop_parts(Mesh &mesh, const std::vector<Part> &parts, const std::vector<bool> &drop)
{
    std::vector<bool> gone(mesh.faces.size());
    std::vector<Face> kept;

    for (size_t i = 0; i < parts.size(); i++) {
        for (uint32_t f : parts[i].faces) {
            gone[f] = drop[i];
        }
        if (drop[i]) {
            mesh.mended.push_back("dropped a part within another, which counts already: " +
                                  counted(parts[i].faces.size(), "face") + " in the box " +
                                  box_of(mesh, parts[i]));
        }
    }
    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        if (!gone[f]) {
            kept.push_back(mesh.faces[f]);
        }
    }
    mesh.faces = kept;
    drop_unused_vertices(mesh);
}

/*
 * Turn parts outwards and drop those that add nothing. Outermost parts come first: `full` counts
 * how often a place is solid before a part is considered. A part of negative volume in a place that
 * is solid once is a cavity and stays; a full part in a solid place adds nothing.
 */
inline void arrange_solid(Mesh &mesh, std::vector<Part> &parts, bool allow_overlaps)
{
    const std::vector<std::vector<size_t>> outer = nesting(mesh, parts, allow_overlaps);
    std::vector<size_t> order(parts.size());
    std::vector<bool> drop(parts.size());
    size_t inwards = 0, cavities = 0;

    for (size_t i = 0; i < order.size(); i++) {
        order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return outer[a].size() < outer[b].size(); });
    for (size_t i : order) {
        int full = 0;

        for (size_t j : outer[i]) {
            full += parts[j].measure > 0 ? 1 : -1;
        }
        if (parts[i].measure < 0 && full < 1) {
            inwards += turn_part(mesh, parts[i]);
        }
        drop[i] = full > (parts[i].measure < 0 ? 1 : 0);
        cavities += parts[i].measure < 0 && !drop[i];
    }
    if (inwards) {
        mesh.mended.push_back("turned " + counted(inwards, "face") +
                              " of a part that was inside out");
    }
    if (cavities) {
        mesh.mended.push_back("kept " + counted(cavities, "part") +
                              " of negative volume as hollow");
    }
    drop_parts(mesh, parts, drop);
}

/* Turn each part outwards (SOLID) or up (SURFACE). */
inline void arrange(Mesh &mesh, std::vector<Part> &parts, bool allow_overlaps)
{
    double total = 0;
    size_t turned = 0;

    for (const Part &part : parts) {
        total += part.measure;
    }
    for (Part &part : parts) {
        if (mesh.surface ? part.measure < 0 : total < 0) {
            turned += turn_part(mesh, part);
        }
    }
    if (turned) {
        mesh.mended.push_back(
            "turned " + counted(turned, "face") +
            (mesh.surface ? " that looked down" : " of a part that was inside out"));
    }
    if (!mesh.surface) {
        arrange_solid(mesh, parts, allow_overlaps);
    }
}

} // namespace mend

#endif

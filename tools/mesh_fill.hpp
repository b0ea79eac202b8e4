/* SPDX-License-Identifier: MIT */
/*
 * mesh_fill - cuts a flat polygon, with or without holes, into triangles: ears are clipped, in whole numbers. It uses every corner
 * and adds none.
 */
#ifndef CAROM_TOOLS_MESH_FILL_HPP
#define CAROM_TOOLS_MESH_FILL_HPP

#include "mesh_edges.hpp"

namespace mend
{

struct Corner {
    int64_t x, y;    /* quanta, in the plane */
    uint32_t vertex; /* of the mesh */
};
using Loop = std::vector<Corner>;

inline int64_t side_of(const Corner &a, const Corner &b, const Corner &p)
{
    const int64_t side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);

    return (side > 0) - (side < 0);
}

inline bool same_place(const Corner &a, const Corner &b)
{
    return a.x == b.x && a.y == b.y;
}

/* Twice the area, positive when the loop runs counter-clockwise. */
inline int64_t area_of(const Loop &loop)
{
    int64_t area = 0;

    for (size_t i = 0; i < loop.size(); i++) {
        const Corner &a = loop[i], &b = loop[(i + 1) % loop.size()];

        area += a.x * b.y - a.y * b.x;
    }
    return area;
}

/* True if p is on the segment from a to b, ends included. */
inline bool is_between(const Corner &a, const Corner &b, const Corner &p)
{
    return side_of(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

/* True if two segments have a common point; a shared corner does not count. */
inline bool lines_meet(const Corner &a, const Corner &b, const Corner &c, const Corner &d)
{
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) {
        return false;
    }
    if (side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0) {
        return true;
    }
    const auto inner = [](const Corner &s, const Corner &e, const Corner &p) {
        return !same_place(s, p) && !same_place(e, p) && is_between(s, e, p);
    };

    return inner(a, b, c) || inner(a, b, d) || inner(c, d, a) || inner(c, d, b);
}

inline bool meets_loop(const Corner &a, const Corner &b, const Loop &loop)
{
    for (size_t i = 0; i < loop.size(); i++) {
        if (lines_meet(a, b, loop[i], loop[(i + 1) % loop.size()])) {
            return true;
        }
    }
    return false;
}

/* True if the edges of a loop meet only at its corners, and no corner comes twice. */
inline bool is_simple(const Loop &loop)
{
    std::set<std::pair<int64_t, int64_t>> places;

    for (const Corner &c : loop) {
        if (!places.insert({c.x, c.y}).second) {
            return false;
        }
    }
    for (size_t i = 0; i < loop.size(); i++) {
        if (meets_loop(loop[i], loop[(i + 1) % loop.size()], loop)) {
            return false;
        }
    }
    return true;
}

/* True if a point lies within a loop or on it. */
inline bool is_within(const Loop &loop, const Corner &p)
{
    bool inside = false;

    for (size_t i = 0; i < loop.size(); i++) {
        const Corner &a = loop[i], &b = loop[(i + 1) % loop.size()];

        if (is_between(a, b, p)) {
            return true;
        }
        if ((a.y > p.y) != (b.y > p.y) && (side_of(a, b, p) > 0) == (b.y > a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

/* True if a line from corner i of a counter-clockwise loop starts into the loop. */
inline bool enters(const Loop &loop, size_t i, const Corner &p)
{
    const Corner &before = loop[(i + loop.size() - 1) % loop.size()], &at = loop[i],
                 &after = loop[(i + 1) % loop.size()];

    return side_of(before, at, after) > 0 ? side_of(before, at, p) > 0 && side_of(at, after, p) > 0
                                          : side_of(before, at, p) > 0 || side_of(at, after, p) > 0;
}

/*
 * Join a clockwise hole to the loop around it by a cut in both directions. False if no cut is free.
 */
inline bool join_hole(Loop &loop, const Loop &hole, const std::vector<Loop> &others)
{
    const auto first = std::max_element(hole.begin(), hole.end(),
                                        [](const Corner &a, const Corner &b) { return a.x < b.x; });
    std::vector<std::pair<int64_t, size_t>> nearest;

    for (size_t i = 0; i < loop.size(); i++) {
        const int64_t dx = loop[i].x - first->x, dy = loop[i].y - first->y;

        nearest.push_back({dx * dx + dy * dy, i});
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto &[distance, i] : nearest) {
        if (!enters(loop, i, *first) || meets_loop(loop[i], *first, loop) ||
            meets_loop(loop[i], *first, hole) ||
            std::any_of(others.begin(), others.end(),
                        [&, at = i](const Loop &o) { return meets_loop(loop[at], *first, o); })) {
            continue;
        }
        Loop cut(first, hole.end());

        cut.insert(cut.end(), hole.begin(), first + 1);
        cut.push_back(loop[i]);
        loop.insert(loop.begin() + std::ptrdiff_t(i) + 1, cut.begin(), cut.end());
        return true;
    }
    return false;
}

/* True if the triangle at corner i can be cut off: it has an area and contains no corner. */
inline bool is_ear(const Loop &loop, size_t i)
{
    const Corner &a = loop[(i + loop.size() - 1) % loop.size()], &b = loop[i],
                 &c = loop[(i + 1) % loop.size()];

    if (side_of(a, b, c) <= 0) {
        return false;
    }
    for (const Corner &p : loop) {
        if (side_of(a, b, p) >= 0 && side_of(b, c, p) >= 0 && side_of(c, a, p) >= 0 &&
            !same_place(p, a) && !same_place(p, b) && !same_place(p, c)) {
            return false;
        }
    }
    return loop.size() == 3 || !meets_loop(c, a, loop);
}

/* Cut a counter-clockwise loop and the clockwise holes in it into triangles; none if that is impossible. */
inline std::vector<Face> fill(Loop loop, std::vector<Loop> inner)
{
    std::vector<Face> faces;

    while (!inner.empty()) {
        const Loop hole = inner.back();

        inner.pop_back();
        if (!join_hole(loop, hole, inner)) {
            return {};
        }
    }
    for (size_t i = 0, passed = 0; loop.size() >= 3 && passed < loop.size();) {
        i %= loop.size();
        if (!is_ear(loop, i)) {
            i++;
            passed++;
            continue;
        }
        faces.push_back({loop[(i + loop.size() - 1) % loop.size()].vertex, loop[i].vertex,
                         loop[(i + 1) % loop.size()].vertex});
        loop.erase(loop.begin() + std::ptrdiff_t(i));
        i++; /* not twice in a row at one corner, because fans would be long and thin */
        passed = 0;
    }
    return loop.size() == 2 ? faces : std::vector<Face>();
}

} // namespace mend

#endif

/* SPDX-License-Identifier: MIT */
/* mesh_shape - the shapes of carom_shapes.h from a text such as sphere:0.5,16, lengths in units. */
#ifndef CAROM_TOOLS_MESH_SHAPE_HPP
#define CAROM_TOOLS_MESH_SHAPE_HPP

#include "carom_shapes.h"
#include "mesh_options.hpp"

namespace mend
{

struct ShapeKind {
    const char *name, *form;
    size_t lengths; /* numbers before the sides */
    bool round;     /* the last number is the number of sides */
};

inline const ShapeKind &shape_kind(const std::string &name)
{
    static const ShapeKind kinds[] = {
        {"box", "box:X,Y,Z", 3, false},
        {"sphere", "sphere:RADIUS,SIDES", 1, true},
        {"capsule", "capsule:RADIUS,LENGTH,SIDES", 2, true},
        {"cylinder", "cylinder:RADIUS,HEIGHT,SIDES", 2, true},
        {"cone", "cone:RADIUS,HEIGHT,SIDES", 2, true},
    };

    for (const ShapeKind &kind : kinds) {
        if (name == kind.name) {
            return kind;
        }
    }
    throw Refusal("--shape: no shape '" + name + "': box, sphere, capsule, cylinder or cone");
}

/* The numbers of a shape: lengths above 0, then the sides. */
inline std::vector<double> shape_numbers(const ShapeKind &kind, const std::string &text)
{
    const std::string wanted = std::string("--shape: ") + kind.form + " is wanted";
    std::vector<double> numbers;
    size_t from = 0;

    while (from <= text.size()) {
        const size_t to = std::min(text.find(',', from), text.size());

        numbers.push_back(number_from(wanted.c_str(), text.substr(from, to - from).c_str()));
        if (numbers.back() <= 0) {
            throw Refusal(wanted + ", each number above 0");
        }
        from = to + 1;
    }
    if (numbers.size() != kind.lengths + kind.round) {
        throw Refusal(wanted);
    }
    if (kind.round && (numbers.back() != std::floor(numbers.back()) || numbers.back() < 3 ||
                       numbers.back() > CAROM_SHAPE_SIDES)) {
        throw Refusal(wanted + format(", SIDES a whole number from 3 to %d", CAROM_SHAPE_SIDES));
    }
    return numbers;
}

/* Half of each length, as carom_shapes.h expects it; a radius stays as it is. */
inline std::vector<double> halves(const ShapeKind &kind, std::vector<double> numbers, double scale)
{
    numbers.resize(kind.lengths);
    for (size_t i = 0; i < kind.lengths; i++) {
        numbers[i] *= kind.round && i == 0 ? scale : scale / 2;
    }
    return numbers;
}

inline int call_shape(carom_mesh_raw &raw, const carom_shape_room &room, const std::string &name,
                      const std::vector<int32_t> &half, uint32_t sides)
{
    return name == "box"        ? carom_shape_box(&raw, &room, half.data())
           : name == "sphere"   ? carom_shape_sphere(&raw, &room, half[0], sides)
           : name == "capsule"  ? carom_shape_capsule(&raw, &room, half[0], half[1], sides)
           : name == "cylinder" ? carom_shape_cylinder(&raw, &room, half[0], half[1], sides)
                                : carom_shape_cone(&raw, &room, half[0], half[1], sides);
}

/*
 * A box has the quanta of its own grid, if it has one; a round shape has the finest quanta that
 * fit.
 */
inline int shape_bits(const ShapeKind &kind, const std::vector<double> &half, int asked)
{
    const bool capsule = std::string(kind.name) == "capsule";
    const double reach = capsule ? half[0] + half[1] : *std::max_element(half.begin(), half.end());
    int bits = choose_bits(kind.round ? std::vector<Point>{{reach, 0, 0}}
                                      : std::vector<Point>{{half[0], half[1], half[2]}},
                           asked);

    while (kind.round && !asked && bits < bits_max && fits(reach, bits + 1)) {
        bits++;
    }
    return bits;
}

/*
 * Make the shape that a text names. `bits` is the requested quantum, or 0, and becomes the used
 * one.
 */
inline Soup read_shape(const std::string &text, double scale, int &bits)
{
    const size_t colon = std::min(text.find(':'), text.size());
    const ShapeKind &kind = shape_kind(text.substr(0, colon));
    const std::vector<double> numbers =
        shape_numbers(kind, colon < text.size() ? text.substr(colon + 1) : "");
    const std::vector<double> half = halves(kind, numbers, scale);
    std::vector<int32_t> quanta;
    std::array<std::array<int16_t, 3>, CAROM_CAPSULE_VERTICES(CAROM_SHAPE_SIDES)> vertices;
    std::array<std::array<uint16_t, 3>, CAROM_CAPSULE_FACES(CAROM_SHAPE_SIDES)> faces;
    Soup soup;
    carom_mesh_raw raw;

    bits = shape_bits(kind, half, bits);
    for (double h : half) {
        quanta.push_back(int32_t(std::lround(std::ldexp(h, bits))));
    }
    const carom_shape_room room = {reinterpret_cast<int16_t(*)[3]>(vertices.data()),
                                   reinterpret_cast<uint16_t(*)[3]>(faces.data()),
                                   uint32_t(vertices.size()), uint32_t(faces.size()),
                                   uint8_t(bits)};
    const int result = call_shape(raw, room, kind.name, quanta, uint32_t(numbers.back()));

    if (result != CAROM_OK) {
        throw Refusal(format("the shape cannot be made in quanta of 2^-%d units (%s): %s", bits,
                             carom_result_text(result),
                             result == CAROM_ERR_ARGUMENT
                                 ? "a length is too small, or SIDES is no multiple of 4"
                                 : "give fewer SIDES or a larger --quantum-bits"));
    }
    for (uint32_t i = 0; i < raw.vertex_count; i++) {
        const int16_t *v = raw.vertices[i];

        soup.points.push_back(
            {std::ldexp(v[0], -bits), std::ldexp(v[1], -bits), std::ldexp(v[2], -bits)});
    }
    for (uint32_t i = 0; i < raw.face_count; i++) {
        soup.faces.push_back({raw.faces[i][0], raw.faces[i][1], raw.faces[i][2]});
    }
    soup.polygons = soup.faces.size();
    soup.objects = {kind.name};
    return soup;
}

} // namespace mend

#endif

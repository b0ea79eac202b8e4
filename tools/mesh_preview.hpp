/* SPDX-License-Identifier: MIT */
/*
 * mesh_preview - a picture of a mesh by Carom's own renderer: on the left from the front and above,
 * on the right from the back and below (for a SURFACE, which is visible from above only, from the
 * back and above). Each view fits the mesh, whatever its size.
 */
#ifndef CAROM_TOOLS_MESH_PREVIEW_HPP
#define CAROM_TOOLS_MESH_PREVIEW_HPP

#include "carom_draw.h"
#include "mesh_png.hpp"
#include "mesh_write.hpp"

namespace mend
{

namespace picture
{

constexpr int32_t side = 600,
                  fineness = 2; /* pixels of a view; drawn at so many times the resolution */
constexpr int32_t drawn = side * fineness;
constexpr double focal = 2; /* in picture heights: a long lens distorts little */
constexpr double margin =
    0.42;                /* part of a picture's side, from its middle, that a mesh may fill */
constexpr int bits = 11; /* quanta of the enlarged mesh, which is about 32 units long */
constexpr size_t lines_max = 4096;
constexpr double sharp = 0.94; /* cosine of 20 degrees: a fine mesh shows only sharper edges */

inline double dot(const Point &a, const Point &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point sum(const Point &a, const Point &b, double factor)
{
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

inline Point cross(const Point &a, const Point &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Point unit(const Point &a)
{
    return sum({0, 0, 0}, a, 1 / std::sqrt(dot(a, a)));
}

template <typename Vector> Vector fixed(const Point &p, int fraction)
{
    Vector v;

    for (size_t k = 0; k < 3; k++) {
        v.c[k] =
            static_cast<std::decay_t<decltype(v.c[0])>>(std::llround(std::ldexp(p[k], fraction)));
    }
    return v;
}

/*
 * The mesh around the origin, as large as whole quanta allow, because the renderer draws nothing
 * that is very close.
 */
inline Mesh enlarged(const Mesh &mesh)
{
    Mesh large = mesh;
    int32_t reach = 1;

    for (size_t k = 0; k < 3; k++) {
        const auto [low, high] =
            std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                [k](const Vertex &a, const Vertex &b) { return a[k] < b[k]; });
        const int32_t middle = ((*low)[k] + (*high)[k]) / 2;

        reach = std::max(reach, (*high)[k] - middle + 1);
        for (Vertex &v : large.vertices) {
            v[k] -= middle;
        }
    }
    for (Vertex &v : large.vertices) {
        for (int32_t &c : v) {
            c *= std::max(1, coordinate_max / reach);
        }
    }
    large.bits = bits;
    return large;
}

/* A view: the direction from the mesh to the eye, and right and up in the picture. */
struct View {
    Point back, right, up;
    Point target = {0, 0, 0};
    double distance = 0;
    const char *title;

    View(const Point &to_eye, const char *called) : back(unit(to_eye)), title(called)
    {
        right = unit(cross({0, 0, 1}, back));
        up = cross(back, right);
    }
    Point eye() const
    {
        return sum(target, back, distance);
    }
};

/*
 * Move the eye as close as the mesh fits, and the target to the middle of the picture, in a few
 * steps of both.
 */
inline void fit(View &view, const Mesh &mesh)
{
    for (int step = 0; step < 12; step++) {
        double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};

        view.distance = 0;
        for (uint32_t i = 0; i < mesh.vertices.size(); i++) {
            const Point p = sum(in_units(mesh, i), view.target, -1);
            const double aside =
                std::max(std::fabs(dot(p, view.right)), std::fabs(dot(p, view.up)));

            view.distance = std::max(view.distance, aside * focal / margin + dot(p, view.back));
        }
        for (uint32_t i = 0; i < mesh.vertices.size(); i++) {
            const Point p = sum(in_units(mesh, i), view.target, -1);
            const double depth = view.distance - dot(p, view.back);
            const double place[2] = {dot(p, view.right) / depth, dot(p, view.up) / depth};

            for (int k = 0; k < 2; k++) {
                low[k] = std::min(low[k], place[k]);
                high[k] = std::max(high[k], place[k]);
            }
        }
        view.target = sum(view.target, view.right, (low[0] + high[0]) / 2 * view.distance);
        view.target = sum(view.target, view.up, (low[1] + high[1]) / 2 * view.distance);
    }
    view.distance *= 1.01; /* the last step moved the target */
}

/* The mean direction of a surface: a surface that slopes away from the eye would show no face. */
inline Point mean_normal(const Mesh &mesh)
{
    Point total = {0, 0, 0};

    for (const Face &face : mesh.faces) {
        const Point a = in_units(mesh, face[0]);

        total =
            sum(total,
                cross(sum(in_units(mesh, face[1]), a, -1), sum(in_units(mesh, face[2]), a, -1)), 1);
    }
    return unit(total);
}

/* The sides of a mesh's box, units. */
inline Point sides_of(const Mesh &mesh)
{
    Point sides;

    for (size_t k = 0; k < 3; k++) {
        const auto [low, high] =
            std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                [k](const Vertex &a, const Vertex &b) { return a[k] < b[k]; });

        sides[k] = std::ldexp((*high)[k] - (*low)[k], -mesh.bits);
    }
    return sides;
}

/* A mesh as thin as a pixel shows nothing but its edges, and black edges would not be visible. */
inline bool is_needle(const Mesh &mesh)
{
    Point sides = sides_of(mesh);

    std::sort(sides.begin(), sides.end());
    return sides[1] * 150 < sides[2];
}

/* The edges to draw: all of them, or only the sharp and open ones of a mesh with too many. */
inline std::vector<carom_paint_line> lines_of(const Mesh &mesh)
{
    std::vector<carom_paint_line> lines;
    std::map<Edge, std::vector<Point>> normals;

    for (uint32_t f = 0; f < mesh.faces.size(); f++) {
        const Face &face = mesh.faces[f];
        const Point a = in_units(mesh, face[0]);
        const Point normal =
            unit(cross(sum(in_units(mesh, face[1]), a, -1), sum(in_units(mesh, face[2]), a, -1)));

        for (size_t k = 0; k < 3; k++) {
            normals[std::minmax(face[k], face[(k + 1) % 3])].push_back(normal);
        }
    }
    const bool all = normals.size() <= lines_max;
    const uint16_t colour = is_needle(mesh) ? CAROM_COLOUR_WHITE : CAROM_COLOUR_BLACK;

    for (const auto &[edge, beside] : normals) {
        if ((all || beside.size() < 2 || dot(beside[0], beside[1]) < sharp) &&
            lines.size() < lines_max) {
            lines.push_back({fixed<carom_v3_q32>(in_units(mesh, edge.first), 32),
                             fixed<carom_v3_q32>(in_units(mesh, edge.second), 32), colour});
        }
    }
    return lines;
}

inline void expect(int result)
{
    if (result < 0) {
        throw Refusal(std::string("the preview cannot be drawn: ") + carom_result_text(result));
    }
}

/* A world that holds only the mesh, in the mesh's coordinates. */
class Scene
{
  public:
    explicit Scene(const Mesh &mesh)
        : indexed_(mesh), memory_(carom_world_bytes(&config_.caps) / 8 + 1)
    {
        carom_body_def body = {};

        expect(carom_world_init(memory_.data(), memory_.size() * 8, &config_, &world_));
        body.mesh = &indexed_.mesh;
        for (size_t k = 0; k < 3; k++) {
            body.position.c[k] = int64_t(indexed_.mesh.mass.centre.c[k]) << 10;
        }
        body.stationary = true;
        expect(carom_body_add(world_, &body));
    }
    Scene(const Scene &) = delete;

    /* A square picture of 0x00RRGGBB. */
    std::vector<uint32_t> draw(const View &view, const std::vector<carom_paint_line> &lines,
                               const std::string &below) const
    {
        const carom_mesh_raw &raw = indexed_.mesh.raw;
        std::vector<uint32_t> pixels(size_t(drawn) * drawn);
        std::vector<uint64_t> workspace(
            (CAROM_DRAW_BYTES(raw.vertex_count, raw.face_count) + 52 * lines.size()) / 8 + 8);
        const carom_camera camera = {fixed<carom_v3_q32>(view.eye(), 32),
                                     fixed<carom_v3_q32>(view.target, 32), int32_t(focal * 65536)};
        const carom_body_paint skin = {
            nullptr,
            uint8_t(raw.kind == CAROM_SURFACE ? CAROM_RAMP_STATIONARY : CAROM_RAMP_MOVING)};
        carom_paint paint = {};
        carom_picture picture = {};

        paint.bodies = &skin;
        paint.body_count = 1;
        paint.light =
            fixed<carom_v3_q30>(unit(sum(sum(view.back, view.right, -1.3), view.up, 0.5)), 30);
        paint.ambient_q30 = 1 << 27;
        paint.lines = lines.data();
        paint.line_count = uint32_t(lines.size());
        picture.pixels = pixels.data();
        picture.width = picture.height = drawn;
        picture.stride = drawn * 4;
        picture.format = CAROM_XRGB8888;
        picture.workspace = workspace.data();
        picture.workspace_bytes = workspace.size() * 8;
        picture.paint = &paint;
        expect(carom_draw(world_, &camera, &picture, CAROM_DRAW_FLAT));
        write(picture, 10, view.title);
        write(picture, side - 10 - 2 * CAROM_TEXT_HEIGHT, below);
        return pixels;
    }

  private:
    static void write(const carom_picture &picture, int32_t y, const std::string &text)
    {
        carom_text where = {};

        where.x = 10 * fineness;
        where.y = y * fineness;
        where.scale = 2 * fineness;
        where.colour = CAROM_COLOUR_WHITE;
        expect(carom_draw_text(&picture, &where, text.c_str(), nullptr));
    }

    Indexed indexed_;
    carom_config config_ = {
        CAROM_CAPS(1, 1, 1, 1, 1, 1), {}, false, 0, 0, nullptr, 0, nullptr, nullptr};
    std::vector<uint64_t> memory_;
    carom_world *world_ = nullptr;
};

/*
 * Put a view into its half of the picture; each pixel is the mean of the pixels that were drawn for
 * it.
 */
inline void put_half(std::vector<uint8_t> &rgb, const std::vector<uint32_t> &pixels, int32_t half)
{
    for (int32_t y = 0; y < side; y++) {
        for (int32_t x = 0; x < side; x++) {
            for (int32_t k = 0; k < 3; k++) {
                uint32_t total = 0;

                for (int32_t i = 0; i < fineness * fineness; i++) {
                    const int32_t row = y * fineness + i / fineness;

                    total +=
                        pixels[size_t(row * drawn + x * fineness + i % fineness)] >> (16 - 8 * k) &
                        0xff;
                }
                rgb[size_t(3 * (y * 2 * side + half * side + x) + k)] =
                    uint8_t(total / (fineness * fineness));
            }
        }
    }
}

} // namespace picture

/* A PNG of two views side by side. */
inline std::string preview(const Mesh &mesh)
{
    using namespace picture;

    const Mesh large = enlarged(mesh);
    const Scene scene(large);
    const std::vector<carom_paint_line> lines = lines_of(large);
    View views[] = {{{0.6, -1, 0.7}, "front, above"}, {{-0.6, 1, -0.7}, "back, below"}};

    if (mesh.surface) {
        const Point looks = mean_normal(large);

        views[0] = {sum(unit({0.6, -1, 0.3}), looks, 1), "front, above"};
        views[1] = {sum(unit({-0.6, 1, 0.3}), looks, 1), "back, above"};
    }

    const Point sides = sides_of(mesh);
    const std::string size = format("%.4g x %.4g x %.4g units", sides[0], sides[1], sides[2]);
    std::vector<uint8_t> rgb(size_t(3 * 2 * side * side));

    for (int32_t i = 0; i < 2; i++) {
        fit(views[i], large);
        put_half(rgb, scene.draw(views[i], lines, i ? "" : size), i);
    }
    return png::written(rgb, 2 * side, side);
}

} // namespace mend

#endif

#include "render/mesh_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace render {

using agvd::Vec3;

namespace {

const Color back_color{0.06F, 0.13F, 0.55F};
constexpr int pair_width = 800, pair_height = 720;  // Of each of two meshes, in pixels.

// A warm light from above on the left, a cool one from the right, and ambient light from above.
Color shade(const Vec3& normal, const Color& surface) {
    const Vec3 key = Vec3(-0.45, 0.7, 0.75).normalized();
    const Vec3 fill = Vec3(0.9, 0.1, 0.35).normalized();
    const auto lit = [&](const Vec3& light) {
        return static_cast<float>(std::max(0.0, normal.dot(light)));
    };
    const auto sky = static_cast<float>(0.5 + 0.5 * normal.y());
    const Vec3 half = (key + Vec3::UnitZ()).normalized();
    const float gloss = 0.16F * static_cast<float>(std::pow(std::max(0.0, normal.dot(half)), 40));
    const Color light = Color(1.0F, 0.96F, 0.88F) * 0.78F * lit(key) +
                        Color(0.70F, 0.82F, 1.0F) * 0.26F * lit(fill) +
                        Color(0.80F, 0.88F, 1.0F) * (0.10F + 0.16F * sky);
    return surface.cwiseProduct(light) + Color::Constant(gloss);
}

}  // namespace

View::View(const agvd::MeshView& mesh, const std::array<double, 3>& degrees, int width, int height,
           int left) {
    const auto turn_about = [&](std::size_t k, const Vec3& axis) {
        return Eigen::AngleAxisd(degrees[k] * std::numbers::pi / 180, axis);
    };
    rotation_ =
        turn_about(2, Vec3::UnitZ()) * turn_about(0, Vec3::UnitX()) * turn_about(1, Vec3::UnitY());
    Eigen::AlignedBox3d box, screen;
    for (const Vec3& p : mesh.positions) box.extend(p);
    center_ = box.center();
    distance_ = 3.5 * box.diagonal().norm();
    for (const Vec3& p : mesh.positions) screen.extend(project(p));
    const Vec3 extent = screen.sizes();
    scale_ = 0.94 * std::min(width / extent.x(), height / extent.y());
    shift_ = Vec3(2 * left + width, height, 0) / 2 -
             scale_ * Vec3(screen.center().x(), -screen.center().y(), 0);
}

Vec3 View::project(const Vec3& point) const {
    Vec3 p = rotation_ * (point - center_);
    p /= 1 - p.z() / distance_;
    return p;
}

Vec3 View::to_pixels(const Vec3& point) const {
    const Vec3 p = project(point);
    return scale_ * Vec3(p.x(), -p.y(), p.z()) + shift_;
}

View View::moved_right(int pixels) const {
    View moved = *this;
    moved.shift_.x() += pixels;
    return moved;
}

void draw_mesh(const agvd::MeshView& mesh, const View& view, const FaceColor& color, bool is_wire,
               Canvas& canvas) {
    for (agvd::Index f = 0; f < mesh.triangles.size(); ++f) {
        const agvd::Triangle& t = mesh.triangles[f];
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const std::array corners{view.to_pixels(a), view.to_pixels(b), view.to_pixels(c)};
        const Vec3 screen_normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        const bool is_front = screen_normal.z() < 0;  // y points down
        Vec3 normal = view.turn((b - a).cross(c - a)).normalized();
        if (!is_front) normal = -normal;
        // Lines fade where triangles are only a few pixels large: otherwise lines would cover them.
        const double pixels = std::sqrt(std::abs(screen_normal.z()));
        const double opacity = is_wire ? 0.75 * std::clamp(pixels / 10, 0.1, 1.0) : 0.0;
        canvas.draw_triangle(corners, shade(normal, color(f, is_front)),
                             static_cast<float>(opacity));
    }
}

void draw_mesh(const agvd::MeshView& mesh, const View& view, const Color& front, bool is_wire,
               Canvas& canvas) {
    const auto color = [&](agvd::Index, bool is_front) { return is_front ? front : back_color; };
    draw_mesh(mesh, view, color, is_wire, canvas);
}

std::string picture_of_pair(const agvd::MeshView& left, const agvd::MeshView& right) {
    Canvas canvas(2 * pair_width, pair_height);
    const View view(left, default_degrees, pair_width, pair_height);
    draw_mesh(left, view, front_color, true, canvas);
    draw_mesh(right, view.moved_right(pair_width), front_color, true, canvas);
    canvas.shade_hollows(0.05 * std::min(pair_width, pair_height));
    return canvas.png();
}

}  // namespace render

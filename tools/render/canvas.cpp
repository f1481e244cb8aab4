// A z-buffer with several samples per pixel and side, which are averaged at the end. A triangle
// fills the samples that are in front; the distance from its edges, known from barycentric
// coordinates, gives thin dark lines. Hollows are darkened by comparing the depth of each pixel
// with that of pairs of opposite samples around it, so that a slope alone stays bright.
#include "render/canvas.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

#include "agvd/core/random.h"

namespace render {

using agvd::Vec2;
using agvd::Vec3;

namespace {

constexpr int samples = 3;  // per pixel and direction
constexpr float nothing = std::numeric_limits<float>::lowest();
const Color paper{1, 1, 1};
const Color ink{0.02F, 0.025F, 0.04F};

struct Box {
    int x0, y0, x1, y1;  // inclusive
};

// Samples whose centres may lie within `margin` of the points, cut to the picture.
template <std::size_t N>
Box bounds(const std::array<Vec3, N>& points, double margin, int width, int height) {
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const auto cut = [](double v, int size) {
        return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size - 1)));
    };
    return {cut(low.x() - margin - 1, width), cut(low.y() - margin - 1, height),
            cut(high.x() + margin + 1, width), cut(high.y() + margin + 1, height)};
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width * samples),
      height_(height * samples),
      depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), nothing),
      colors_(depth_.size(), paper) {}

std::size_t Canvas::index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
}

void Canvas::draw_triangle(const std::array<Vec3, 3>& corners, const Color& color,
                           float edge_opacity) {
    constexpr double half_line = 0.45 * samples;
    std::array<Vec3, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = corners[k] * samples;
    const double doubled_area = cross((c[1] - c[0]).head<2>(), (c[2] - c[0]).head<2>());
    if (doubled_area == 0) return;
    std::array<double, 3> height;  // of the corner over its opposite edge, in samples
    for (std::size_t k = 0; k < 3; ++k) {
        height[k] = std::abs(doubled_area) / (c[(k + 2) % 3] - c[(k + 1) % 3]).head<2>().norm();
    }
    const Box box = bounds(c, 0, width_, height_);
    for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) {
            const Vec2 p(x + 0.5, y + 0.5);
            std::array<double, 3> weight;
            double to_edge = std::numeric_limits<double>::max();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 a = c[(k + 1) % 3].head<2>(), b = c[(k + 2) % 3].head<2>();
                weight[k] = cross(b - a, p - a) / doubled_area;
                to_edge = std::min(to_edge, weight[k] * height[k]);
            }
            if (to_edge < 0) continue;
            const auto z = static_cast<float>(weight[0] * c[0].z() + weight[1] * c[1].z() +
                                              weight[2] * c[2].z());
            const std::size_t i = index(x, y);
            if (z <= depth_[i]) continue;
            depth_[i] = z;
            const float line = to_edge < half_line ? edge_opacity : 0;
            colors_[i] = color * (1 - line) + ink * line;
        }
    }
}

void Canvas::draw_line(const Vec3& a, const Vec3& b, const Color& color, double width,
                       double bias) {
    const Vec3 from = a * samples, to = b * samples, along = to - from;
    const double half = width * samples / 2;
    const double length_sq = along.head<2>().squaredNorm();
    const Box box = bounds(std::array{from, to}, half, width_, height_);
    for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) {
            const Vec2 p = Vec2(x + 0.5, y + 0.5) - from.head<2>();
            const double t =
                length_sq > 0 ? std::clamp(p.dot(along.head<2>()) / length_sq, 0.0, 1.0) : 0;
            if ((p - t * along.head<2>()).squaredNorm() > half * half) continue;
            if (is_visible(a + t * (b - a), bias)) colors_[index(x, y)] = color;
        }
    }
}

bool Canvas::is_visible(const Vec3& point, double bias) const {
    const Vec3 at = point * samples;
    // The samples around the point, so that it is not hidden by its own face where that is steep.
    const Box box = bounds(std::array{at}, 0, width_, height_);
    float farthest = std::numeric_limits<float>::max();
    for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) farthest = std::min(farthest, depth_[index(x, y)]);
    }
    return at.z() + bias * samples > farthest;
}

void Canvas::shade_hollows(double radius) {
    constexpr int pairs = 24;  // of opposite rays, so that a slope alone hides nothing
    constexpr float strength = 0.85F;
    std::array<Vec2, pairs> rays;
    for (int pair = 0; pair < pairs; ++pair) {
        const double angle = 3.0 * std::numbers::pi * pair / pairs;
        const double reach = radius * samples * (pair + 1) / pairs;
        rays[static_cast<std::size_t>(pair)] = reach * Vec2(std::cos(angle), std::sin(angle));
    }
    std::vector<float> light(depth_.size(), 1);
    // At the middle sample of each pixel, for all of them.
    for (int y = samples / 2; y < height_; y += samples) {
        for (int x = samples / 2; x < width_; x += samples) {
            const std::size_t i = index(x, y);
            if (depth_[i] == nothing) continue;
            double hidden = 0;
            const double turn = std::numbers::pi * agvd::random_unit(0, 0, i);
            const Vec2 axis(std::cos(turn), std::sin(turn));
            for (const Vec2& ray : rays) {
                const Vec2 way(axis.x() * ray.x() - axis.y() * ray.y(),
                               axis.x() * ray.y() + axis.y() * ray.x());
                const double reach = ray.norm();
                double rise = 0;
                for (const double side : {-1.0, 1.0}) {
                    const int u = x + static_cast<int>(side * way.x());
                    const int v = y + static_cast<int>(side * way.y());
                    if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
                    const float there = depth_[index(u, v)];
                    const double climb = (there == nothing ? -reach : there - depth_[i]) / reach;
                    rise += std::clamp(climb, -2.0, 2.0);
                }
                hidden += std::clamp(rise / 2, 0.0, 1.0) / pairs;
            }
            const float left = 1 - strength * static_cast<float>(std::min(1.0, 1.6 * hidden));
            for (int k = 0; k < samples * samples; ++k) {
                light[index(x - samples / 2 + k % samples, y - samples / 2 + k / samples)] = left;
            }
        }
    }
    for (std::size_t i = 0; i < light.size(); ++i) colors_[i] *= light[i];
}

std::string Canvas::png() const {
    const int columns = width_ / samples, rows = height_ / samples;
    std::vector<png_byte> bytes;
    bytes.reserve(depth_.size() / (samples * samples) * 3);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            Color sum = Color::Zero();
            for (int k = 0; k < samples * samples; ++k) {
                sum += colors_[index(column * samples + k % samples, row * samples + k / samples)];
            }
            for (const float linear : sum / (samples * samples)) {
                const float encoded = std::pow(std::clamp(linear, 0.0F, 1.0F), 1 / 2.2F);
                bytes.push_back(static_cast<png_byte>(std::lround(255 * encoded)));
            }
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns);
    image.height = static_cast<png_uint_32>(rows);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string file(size, '\0');
    // Fails without memory alone.
    if (png_image_write_to_memory(&image, file.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
        throw std::bad_alloc();
    }
    file.resize(size);
    return file;
}

}  // namespace render

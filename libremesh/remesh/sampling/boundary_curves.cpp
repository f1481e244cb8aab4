#include "remesh/sampling/boundary_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

constexpr double least_turn = std::numbers::pi / 4;
// In spacings: how far a corner's chords reach, and how near no second corner lies.
constexpr double corner_reach = 0.5;

// A loop as a closed curve with its length as parameter.
class Curve {
public:
    Curve(const Surface& surface, const std::vector<Index>& loop) : surface_(surface), loop_(loop) {
        up_to_.reserve(loop.size() + 1);
        up_to_.push_back(0);
        for (const Index h : loop) up_to_.push_back(up_to_.back() + surface.length_of(h));
    }
    [[nodiscard]] std::size_t size() const { return loop_.size(); }
    [[nodiscard]] double length() const { return up_to_.back(); }
    [[nodiscard]] double at(std::size_t vertex) const { return up_to_[vertex]; }
    [[nodiscard]] Index vertex(std::size_t i) const { return surface_.tail(loop_[i]); }
    [[nodiscard]] Vec3 position(double along) const {
        return agvd::position(surface_.mesh.view(), point(along));
    }

    [[nodiscard]] SurfacePoint point(double along) const {
        along -= std::floor(along / length()) * length();
        const auto after = std::upper_bound(up_to_.begin() + 1, up_to_.end() - 1, along);
        const auto i = static_cast<std::size_t>(after - up_to_.begin()) - 1;
        const double share = std::clamp((along - up_to_[i]) / (up_to_[i + 1] - up_to_[i]), 0., 1.);
        const Index h = loop_[i];
        SurfacePoint result{agvd::FaceId(Surface::face(h)), {0, 0, 0}};
        result.barycentric[h % 3] = 1 - share;
        result.barycentric[Surface::next(h) % 3] = share;
        return result;
    }

private:
    const Surface& surface_;
    const std::vector<Index>& loop_;
    std::vector<double> up_to_;  // Length before each vertex, then of all.
};

double turn(const Vec3& before, const Vec3& here, const Vec3& after) {
    const Vec3 in = here - before, out = after - here;
    return std::atan2(in.cross(out).norm(), in.dot(out));
}

// The lesser of the turn at the vertex and that of the chords.
double sharpness(const Surface& surface, const Curve& curve, std::size_t i, double reach) {
    const auto& p = surface.mesh.positions;
    const Vec3& here = p[curve.vertex(i)];
    const double here_turn = turn(p[curve.vertex((i + curve.size() - 1) % curve.size())], here,
                                  p[curve.vertex((i + 1) % curve.size())]);
    if (here_turn < least_turn) return 0;
    reach = std::min(reach, curve.length() / 3);
    return std::min(here_turn, turn(curve.position(curve.at(i) - reach), here,
                                    curve.position(curve.at(i) + reach)));
}

}  // namespace

std::vector<Index> find_corners(const Surface& surface, const std::vector<Index>& loop,
                                double spacing) {
    const double reach = corner_reach * spacing;
    const Curve curve(surface, loop);
    std::vector<std::pair<double, std::size_t>> candidates;  // (minus sharpness, place in the loop)
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double sharp = sharpness(surface, curve, i, reach);
        if (sharp >= least_turn) candidates.emplace_back(-sharp, i);
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::size_t> taken;
    for (const auto& [sharp, i] : candidates) {
        const bool is_free = std::none_of(taken.begin(), taken.end(), [&, at = i](std::size_t j) {
            const double apart = std::abs(curve.at(at) - curve.at(j));
            return std::min(apart, curve.length() - apart) < reach;
        });
        if (is_free) taken.push_back(i);
    }
    std::sort(taken.begin(), taken.end());
    std::vector<Index> corners;
    for (const std::size_t i : taken) corners.push_back(curve.vertex(i));
    return corners;
}

std::vector<SurfacePoint> sample_loop(const Surface& surface, const std::vector<Index>& loop,
                                      const std::vector<Index>& corners, double spacing) {
    const Curve curve(surface, loop);
    std::vector<double> ends;  // Where the pieces of the loop begin.
    for (std::size_t i = 0; i < curve.size() && ends.size() < corners.size(); ++i) {
        if (curve.vertex(i) == corners[ends.size()]) ends.push_back(curve.at(i));
    }
    if (ends.empty()) ends.push_back(0);
    // Fewest intervals of a piece, so that the loop gets three sites.
    const double fewest = std::ceil(3.0 / static_cast<double>(ends.size()));
    std::vector<SurfacePoint> sites;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double begin = ends[i];
        const double end = i + 1 < ends.size() ? ends[i + 1] : ends[0] + curve.length();
        const auto intervals =
            static_cast<Index>(std::max(fewest, std::round((end - begin) / spacing)));
        for (Index k = 0; k < intervals; ++k) {
            sites.push_back(curve.point(begin + (end - begin) * k / intervals));
        }
    }
    return sites;
}

}  // namespace remesh
